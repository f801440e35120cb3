"""Costs of a solve: measured ladders, their power laws, and forecasts for larger sizes."""

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from math import isfinite, nan
from typing import Any, ClassVar

import numpy as np
import xarray
from pandas import DataFrame, concat

from ...report.page import Plot, Table
from ...solving.amounts import short
from ...solving.outcome import Outcome
from ...solving.store import stored_size
from ...solving.task import Task
from ...statistics.costs import Law, NoLaw
from ...statistics.finding import FAILS, HOLDS, UNDECIDED, Claim, Finding
from .convergence import Ladder, costs_of, described, settings_of
from .cost_fit import GROWING, LABELS, MEMORY_FROM, STEPS, CostFit, fits_of
from .cost_ladders import AXES, ladders
from .diagram import Diagram, reported
from .figures import costs as workprecision_costs
from .forecasts import LARGEST, MEMORIES, Forecast, forecasts
from .reference import Outcomes

PLOT = "workprecision-costs"
# Settings of a solver that tables tell, with what stands where it lacks them.
SETTINGS = {"points": nan, "steps": nan, "tolerance": nan, "precision": "double"}


@dataclass(frozen=True)
class CostLadder:
    """A ladder of which the costs are measured; there is no truth, and no error."""

    name: str
    ladder: Ladder
    untimed: ClassVar[list[Task]] = []

    @property
    def timed(self) -> list[Task]:
        """Solves that have to be measured alone."""
        return list(self.ladder.solves)

    def datasets(self, outcomes: Outcomes) -> dict[str, xarray.Dataset]:
        """Costs (step,), by the name of the ladder."""
        solves, setting = self.ladder.solves, self.ladder.setting
        found = costs_of(solves, outcomes, "transform_pairs", "plain_product", "padded_product")
        found["stored_bytes"] = "step", [float(stored_size(s, Outcome(outcomes[s].rows))) for s in solves]
        measure, values = AXES[setting].measure, list(map(float, self.ladder.values))
        coordinates = {
            "step": ("step", list(range(len(solves)))),
            "value": ("step", values),
            "x": (
                "step",
                [outcomes[solve].rows[0].measures.get(measure, nan) for solve in solves] if measure else values,
            ),
            **settings_of(solves, SETTINGS),
        }
        about = {
            "contact": self.name,
            "title": self.ladder.label,
            "setting": setting,
            "solver": solves[0].solver.name,
        }
        return {self.name: described(xarray.Dataset(found, coordinates, about), solves[0].scene)}


def _findings(node: xarray.DataTree) -> Iterator[Finding]:
    """Exponents with their intervals, time over that of transforms, and forecasts with their checks."""
    fits = fits_of(node)
    yield from (_exponent(each, cost) for each in fits for cost in _exponents_of(each))
    yield from (_over_limit(each) for each in fits if np.isfinite(each.known("over_limit")).any())
    yield from (_forecast(each) for each in forecasts(fits) if each.kind != "stored")


def _plots(node: xarray.DataTree) -> Iterator[Plot]:
    """Costs, laws and forecasts in one figure; none without any ladder against points."""
    fits, name = fits_of(node), PLOT
    if not any(each.setting == "points" for each in fits):
        return
    tables = {
        name: concat([each.steps[list(STEPS)] for each in fits], ignore_index=True),
        f"{name}-laws": DataFrame([row for each in fits for row in _laws(each)]),
        f"{name}-forecasts": DataFrame([{**asdict(each), "held": each.held} for each in forecasts(fits)]),
    }
    options = {"largest": LARGEST, "memories": list(MEMORIES), "memory_from": MEMORY_FROM}
    yield workprecision_costs.plot(name, tables, {name: axis.label for name, axis in AXES.items()}, options)


def _tables(node: xarray.DataTree) -> Iterator[Table]:
    """Times along all that is no number of points."""
    rows = []
    for each in fits_of(node):
        known = each.steps[np.isfinite(each.steps["processor"])].sort_values("processor", kind="stable")
        if len(known):
            law = each.laws["processor"]
            rows.append(
                {
                    "ladder": each.title,
                    "against": AXES[each.setting].label,
                    "from": short(each.steps["x"].min()),
                    "to": short(each.steps["x"].max()),
                    "least time [s]": short(known["processor"].iloc[0]),
                    "longest time [s]": short(known["processor"].iloc[-1]),
                    "longest at": short(known["x"].iloc[-1]),
                    "power": short(law.exponent) if isinstance(law, Law) else f"none: {law.reason}",
                }
            )
    if rows:
        yield Table("workprecision-cost-ranges", DataFrame(rows), "Processor time along each ladder.")


def _exponents_of(each):
    if each.setting == "points":
        return (
            ("processor", "memory") if each.dimension == "1D" else ("processor", "operator_applications", "memory")
        )
    return ("processor",) if each.setting in GROWING else ()


def _exponent(each, cost):
    law, setting = each.laws[cost], each.setting
    named = f"costs.{cost}-{setting}", f"Power of the {setting} with which {LABELS[cost]} grows"
    told = {"where": each.title, "dimension": each.dimension, "plot": PLOT}
    if isinstance(law, NoLaw):
        return reported(*named, nan, missing=f"no power: {law.reason}", **told)
    said = f"from {law.lowest:g} to {law.highest:g} {setting}"
    return reported(*named, law.exponent, scatter=law.exponent_interval, grid=0.0, regime=said, **told)


def _over_limit(each):
    sentence = "Time of a 3D solve from 256² points on over that of its products by transforms alone, largest"
    ratios = each.known("over_limit", MEMORY_FROM)
    value = max(filter(isfinite, ratios.tolist()), default=nan)
    told = {"dimension": each.dimension, "missing": "not measured", "plot": PLOT}
    return reported("costs.over-transforms", sentence, value, each.title, **told)


def _forecast(each: Forecast):
    """Findings of forecasts: a cost left out and then measured decides, a cost beyond all measured is reported."""
    dimension = each.title[:2]
    if not each.kind.startswith("held-out"):
        told: dict[str, Any] = {"scatter": (each.low, each.high), "grid": 0.0, "plot": PLOT}
        where = each.title, each.unit, dimension, each.reason
        return reported(f"costs.{each.kind}", each.what.capitalize(), each.value, *where, **told)
    claim = Claim(
        f"workprecision.costs.{each.kind}",
        f"The {each.kind.split('-')[-1]} of the largest grid, left out, lies in the interval of its forecast",
        1.0,
        0.0,
        "Cost measured over the cost that the law of the smaller grids gives",
        dimension=dimension,
    )
    stated = UNDECIDED if each.held is None else HOLDS if each.held else FAILS
    ratio = each.found / each.value
    return Finding(claim, ratio, where=each.title, reason=each.reason, stated=stated, plot=PLOT)


def _laws(each: CostFit) -> Iterator[dict[str, Any]]:
    fitted = ("overhead", "factor", "centre", "scatter", "lowest", "highest", "count")
    for cost, law in each.laws.items():
        row: dict[str, Any] = {"ladder": each.name, "dimension": each.dimension}
        row |= {"cost": LABELS[cost], "variable": cost}
        low, high = law.exponent_interval if isinstance(law, Law) else (nan, nan)
        row |= {"exponent": getattr(law, "exponent", nan), "low": low, "high": high}
        row |= {name: getattr(law, name, nan) for name in fitted}
        yield (
            row
            | {"reason": getattr(law, "reason", "")}
            | {name: getattr(law, name, nan) for name in ("least", "most", "at_most")}
        )


COSTS_DIAGRAM = Diagram(
    "costs",
    "What a solve costs",
    "Time, memory and operator applications of both solvers against points, modes, steps, speed and contact; the "
    "powers they follow, and their forecast for larger sizes.",
    lambda size: [CostLadder(name, ladder) for name, ladder in ladders(size).items()],
    _findings,
    _plots,
    _tables,
)
