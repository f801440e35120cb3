"""A diagram: contacts solved along ladders of settings, the findings on them, their plots and tables."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import isfinite, nan
from typing import Any, Protocol

import xarray
from pandas import DataFrame

from ...report.page import Plot, Table
from ...solving.amounts import seconds, share, short
from ...solving.task import Task
from ...statistics.convergence import MeasuredLadder, answers, ladders
from ...statistics.finding import EXACT, REPORTED, Claim, Finding, sentences
from .convergence import DIMENSIONS, Convergence, orders_table, steps_table
from .figures import errors as workprecision
from .reference import Outcomes

# Wanted errors of which tables say what they take, and the one of which findings do.
LEVELS, WANTED = (1e-1, 3e-2, 1e-2, 1e-3, 1e-4), 1e-2
# Observed orders scatter, as the edge of a contact moves by whole pixels.
ORDER_TOLERANCE = 0.35


class Measurable(Protocol):
    """A contact, or a ladder of costs: what is solved for it, and the Datasets that come of it."""

    @property
    def untimed(self) -> list[Task]:
        """Tasks solved besides."""

    @property
    def timed(self) -> list[Task]:
        """Solves that have to be measured alone."""

    def datasets(self, outcomes: Outcomes) -> dict[str, xarray.Dataset]:
        """Everything measured, by the path below the name of the diagram."""


@dataclass(frozen=True)
class Diagram:
    """Diagram: measurements and findings of the command under one name.

    name : of the command and of files
    title, about : what is compared, how and why, for people
    contacts : at a size
    findings, plots, tables : of the Datasets of all contacts
    """

    name: str
    title: str
    about: str
    contacts: Callable[[str], Sequence[Measurable]]
    findings: Callable[[xarray.DataTree], Iterable[Finding]]
    plots: Callable[[xarray.DataTree], Iterable[Plot]]
    tables: Callable[[xarray.DataTree], Iterable[Table]] = lambda node: ()

    def untimed(self, size: str) -> list[Task]:
        """Tasks solved besides, each once."""
        return list(dict.fromkeys(task for each in self.contacts(size) for task in each.untimed))

    def timed(self, size: str) -> list[Task]:
        """Solves that are measured alone, each once."""
        return list(dict.fromkeys(task for each in self.contacts(size) for task in each.timed))

    def datasets(self, size: str, outcomes: Outcomes) -> dict[str, xarray.Dataset]:
        """Everything measured, by the path below the name of the diagram."""
        return {name: dataset for each in self.contacts(size) for name, dataset in each.datasets(outcomes).items()}


def convergence(
    name: str,
    title: str,
    about: str,
    contacts: Callable[[str], Sequence[Convergence]],
    more: Callable[[Mapping[str, list[MeasuredLadder]]], Iterable[Finding]] = lambda found: (),
) -> Diagram:
    """Diagram of errors over time of contacts, by points, tolerance, steps or whatever else is set.

    more : findings on all contacts besides orders and times, from their ladders by contact
    """

    def findings(node):
        found = ladders(_steps(node))
        own, steps, file = answers(found), _steps(node), f"workprecision-{name}"
        plots = {each.quantity: workprecision.part_of(file, steps, each.quantity) for each in own}
        orders = {contact: child["expected_order"] for contact, child in node.children.items()}
        by_points = [each for each in own if each.setting == "points"]
        for each in own:
            if each.setting in ("points", "steps"):
                expected = orders[each.contact].sel(quantity=each.quantity).item()
                yield order_finding(name, each, expected, plots[each.quantity])
        yield from (time_finding(name, each, plots[each.quantity]) for each in by_points)
        yield from (enough_finding(name, each, plots[each.quantity]) for each in own if each.setting != "points")
        whole: dict[str, list[MeasuredLadder]] = {}
        for each in found:
            whole.setdefault(each.contact, []).append(each)
        yield from more(whole)

    def plots(node):
        steps, file = _steps(node), f"workprecision-{name}"
        if len(steps):
            orders = orders_table(ladders(steps))
            yield from workprecision.plots(file, {file: steps, f"workprecision-orders-{name}": orders})

    def tables(node):
        sources = {contact: child.attrs["reference"] for contact, child in node.children.items()}
        rows = [
            {
                "contact": each.title,
                "quantity": each.label,
                "against": _against(sources[each.contact], each.reference_error),
                "ladder": each.ladder,
                **{f"within {share(level)}": each.cell(level) for level in LEVELS},
            }
            for each in answers(ladders(_steps(node)))
        ]
        caption = "The cheapest setting for each wanted error, from which on all finer ones keep it too."
        if rows:
            yield Table(f"workprecision-settings-{name}", DataFrame(rows), caption)

    return Diagram(name, title, about, contacts, findings, plots, tables)


def _steps(node):
    return steps_table(each.to_dataset(inherit=False) for each in node.children.values())


def _against(source, own):
    """Reference of a ladder, and how well it is known."""
    return f"{source}, known to {share(own)}" if own > 0 else source if isfinite(own) else f"{source}, not solved"


def order_finding(diagram: str, each: MeasuredLadder, expected: float = nan, plot: str = "") -> Finding:
    """Order at which the error of a ladder falls, against the one expected of points where there is one."""
    judged = isfinite(expected) and each.setting == "points"
    expected = expected if judged else nan
    claim = Claim(
        f"workprecision.{diagram}.order" + (f"-{short(expected)}" if judged else ""),
        f"The error falls with the power {short(expected)} of the points"
        if judged
        else "Observed order of the error",
        expected,
        ORDER_TOLERANCE if judged else nan,
        "Exponent fitted to the errors well above that of the reference",
        dimension=DIMENSIONS[each.solver],
    )
    order = each.order
    why = "" if isfinite(order.order) else each.unsolved or "too few steps show an error of their own"
    grid = 0.0 if isfinite(order.order) else nan
    return Finding(claim, order.order, order.interval, grid, EXACT, where_of(each), reason=why, plot=plot)


def time_finding(diagram: str, each: MeasuredLadder, plot: str = "") -> Finding:
    """Processor time to the wanted error."""
    k = None if each.reference_error > WANTED else each.reaching(WANTED)
    value = nan if k is None else float(each.processor[k])
    sentence, dimension = f"Processor time to {share(WANTED)}", DIMENSIONS[each.solver]
    meaning = "Least processor time of the cheapest step from which on all steps keep the error"
    told = where_of(each), "s", dimension, each.cell(WANTED), meaning
    return reported(f"{diagram}.time", sentence, value, *told, plot=plot)


def enough_finding(diagram: str, each: MeasuredLadder, plot: str = "") -> Finding:
    """Setting from which on nothing is gained, as what is left is of another origin."""
    claim = Claim(
        f"workprecision.{diagram}.enough-{each.setting.split()[0]}",
        f"The {each.setting} beyond which nothing is gained",
        meaning="Cheapest step from which on errors are within 1.5 times that of the last",
        dimension=DIMENSIONS[each.solver],
    )
    k = each.enough
    why = each.unsolved or ("" if k is not None else "the last step failed")
    if k == len(each.values) - 1:
        why = "every step gains"
    return Finding(claim, nan if k is None else float(each.values[k]), where=where_of(each), reason=why, plot=plot)


def where_of(each: MeasuredLadder) -> str:
    """Contact and quantity in words."""
    return f"{each.title}: {each.label}"


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


def advice(findings: Sequence[Finding]) -> list[str]:
    """One sentence for each claim: verdicts of what is claimed, the range of what is reported."""
    told: list[str] = []
    for name in dict.fromkeys(each.claim.id for each in findings):
        own = [each for each in findings if each.claim.id == name]
        told += [_range(own)] if own[0].claim.unit and all(e.verdict == REPORTED for e in own) else _counts(own)
    return told


def _range(own):
    sentence, unit = own[0].claim.sentence, own[0].claim.unit
    known = sorted((each for each in own if isfinite(each.value)), key=lambda each: each.value)
    missing = [each for each in own if not isfinite(each.value)]
    told = []
    if len(known) > 1 and _amount(known[0].value, unit) != _amount(known[-1].value, unit):
        told += [f"{_amount(e.value, unit)} ({_place(e)})" for e in (known[0], known[-1])]
        told = [" to ".join(told)]
    elif known:
        told = [f"{_amount(known[0].value, unit)} ({_place(known[0]) if len(known) == 1 else 'all'})"]
    if missing:
        why = f", {missing[0].reason}" if missing[0].reason else ""
        told.append(f"not known for {len(missing)} of {len(own)} ({_place(missing[0])}{why})")
    return f"{sentence}: {'; '.join(told)}."


def _counts(own):
    """Verdicts one by one of few findings, else how many, with the number that is furthest off."""
    if len(own) <= 3:
        return sentences(own)
    verdicts = [each.verdict for each in own]
    told = [f"{name} in {verdicts.count(name)} of {len(own)}" for name in dict.fromkeys(verdicts)]
    known = [each for each in own if isfinite(each.value)]
    claim = own[0].claim
    most = max(known, key=lambda each: abs(each.value - claim.expected), default=None)
    last = f"; furthest off {short(most.value)} ({_place(most)})" if most and isfinite(claim.expected) else ""
    return [f"{claim.sentence}: {', '.join(told)}{last}."]


def _amount(value, unit):
    if unit == "s":
        return seconds(value)
    return f"{short(value)}{'' if unit == '1' else ' ' + unit}"


def _place(each):
    return " ".join(part for part in (each.dimension, each.where) if part)
