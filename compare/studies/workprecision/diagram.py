"""A diagram: contacts solved along ladders of settings, the findings on them, their plots and tables."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import isfinite, nan
from typing import Any

import xarray
from pandas import DataFrame

from ...library.ready import DIAGRAMS
from ...report.page import Plot, Table
from ...solving.amounts import share, short
from ...statistics.convergence import MeasuredLadder, answers, ladders
from ...statistics.finding import EXACT, Claim, Finding
from .convergence import Convergence, dimension, orders_table, steps_table
from .ensemble import Ensemble
from .figures import errors

# Wanted errors of which tables say what they take, and the one of which findings do.
LEVELS, WANTED = (1e-1, 3e-2, 1e-2, 1e-3, 1e-4), 1e-2
# Observed orders scatter, as the edge of a contact moves by whole pixels.
ORDER_TOLERANCE = 0.35


@dataclass(frozen=True)
class Judged:
    """What the Datasets of a diagram come to."""

    findings: Sequence[Finding] = ()
    tables: Sequence[Table] = ()
    plots: Sequence[Plot] = ()


@dataclass(frozen=True)
class Diagram:
    """Diagram: measurements and findings of the command under one name.

    name : of library.ready.DIAGRAMS, and of files
    contacts : at a size
    judge : function of the Datasets of all contacts
    """

    name: str
    contacts: Callable[[str], Sequence[Convergence | Ensemble]]
    judge: Callable[[xarray.DataTree], Judged]

    @property
    def title(self) -> str:
        """Title for people."""
        return DIAGRAMS[self.name].title


def convergence(
    name: str,
    contacts: Callable[[str], Sequence[Convergence]],
    more: Callable[[Mapping[str, list[MeasuredLadder]]], Iterable[Finding]] = lambda found: (),
) -> Diagram:
    """Diagram of errors over time of contacts, by points, tolerance, steps or whatever else is set.

    more : findings on all contacts besides orders and times, from their ladders by contact
    """

    def judge(node: xarray.DataTree) -> Judged:
        steps = steps_table(node)
        if not len(steps):
            return Judged()
        found, file = ladders(steps), f"workprecision-{name}"
        own = answers(found)
        tables = {file: steps, f"workprecision-orders-{name}": orders_table(found)}
        plots = list(errors.plots(file, tables))
        whole: dict[str, list[MeasuredLadder]] = {}
        for each in found:
            whole.setdefault(each.contact, []).append(each)
        findings = [*_findings(name, own, node, plots), *more(whole)]
        rows = [
            {
                "contact": each.title,
                "quantity": each.label,
                "against": _against(node[each.contact].attrs["reference"], each.reference_error),
                "ladder": each.ladder,
                **{f"within {share(level)}": each.cell(level) for level in LEVELS},
            }
            for each in own
        ]
        caption = "The cheapest setting for each wanted error, from which on all finer ones keep it too."
        return Judged(findings, [Table(f"workprecision-settings-{name}", DataFrame(rows), caption)], plots)

    return Diagram(name, contacts, judge)


def _findings(name, own, node, plots):
    """Orders, then times by points, then what is enough of other settings."""

    def shown(each):
        return next(
            plot.name for plot in plots if each.quantity in plot.options.get("quantities", [each.quantity])
        )

    for each in own:
        if each.setting in ("points", "steps"):
            expected = node[each.contact]["expected_order"].sel(quantity=each.quantity).item()
            yield order_finding(name, each, expected, shown(each))
    yield from (time_finding(name, each, shown(each)) for each in own if each.setting == "points")
    yield from (enough_finding(name, each, shown(each)) for each in own if each.setting != "points")


def _against(source, own):
    """Reference of a ladder, and how well it is known."""
    return f"{source}, known to {share(own)}" if own > 0 else source if isfinite(own) else f"{source}, not solved"


def order_finding(diagram: str, each: MeasuredLadder, expected: float = nan, plot: str = "") -> Finding:
    """Order at which the error of a ladder falls, against the one expected of points where there is one."""
    judged = isfinite(expected) and each.setting == "points"
    order, power = each.order, short(expected)
    claim = Claim(
        f"workprecision.{diagram}.order" + (f"-{power}" if judged else ""),
        f"The error falls with the power {power} of the points" if judged else "Observed order of the error",
        expected if judged else nan,
        ORDER_TOLERANCE if judged else nan,
        "Exponent fitted to the errors well above that of the reference",
        dimension=dimension(each.solver),
    )
    known = isfinite(order.order)
    why = "" if known else each.unsolved or "too few steps show an error of their own"
    grid = 0.0 if known else nan
    return Finding(claim, order.order, order.interval, grid, EXACT, each.where, reason=why, plot=plot)


def time_finding(diagram: str, each: MeasuredLadder, plot: str = "") -> Finding:
    """Processor time to the wanted error."""
    k = None if each.reference_error > WANTED else each.reaching(WANTED)
    return reported(
        f"{diagram}.time",
        f"Processor time to {share(WANTED)}",
        nan if k is None else float(each.processor[k]),
        each.where,
        unit="s",
        dimension=dimension(each.solver),
        missing=each.cell(WANTED),
        meaning="Least processor time of the cheapest step from which on all steps keep the error",
        plot=plot,
    )


def enough_finding(diagram: str, each: MeasuredLadder, plot: str = "") -> Finding:
    """Setting from which on nothing is gained, as what is left is of another origin."""
    claim = Claim(
        f"workprecision.{diagram}.enough-{each.setting.split()[0]}",
        f"The {each.setting} beyond which nothing is gained",
        meaning="Cheapest step from which on errors are within 1.5 times that of the last",
        dimension=dimension(each.solver),
    )
    k = each.enough
    why = each.unsolved or ("" if k is not None else "the last step failed")
    if k == len(each.values) - 1:
        why = "every step gains"
    return Finding(claim, nan if k is None else float(each.values[k]), where=each.where, reason=why, plot=plot)


def reported(
    id: str,
    sentence: str,
    value: float,
    where: str = "",
    unit: str = "1",
    dimension: str = "3D",
    missing: str = "",
    meaning: str = "",
    **more: Any,
) -> Finding:
    """Finding of a number that is reported without a claim. missing : why, where it is not known"""
    claim = Claim(f"workprecision.{id}", sentence, meaning=meaning, unit=unit, dimension=dimension)
    return Finding(claim, value, where=where, reason="" if isfinite(value) else missing, **more)
