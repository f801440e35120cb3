"""What a solve costs: ladders measured, the powers they follow, and what those say of larger sizes."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import cached_property
from math import isfinite, nan
from typing import Any

import numpy as np
import xarray
from pandas import DataFrame

from ...amounts import HOUR, short
from ...finding import FAILS, HOLDS, UNDECIDED, Claim, Finding
from ...outcome import Outcome
from ...page import Block, Plot, Table
from ...plots import workprecision_costs
from ...rectangle import FAILED, SOLVED
from ...statistics.costs import REPEATABLE, Law, NoLaw, fit, fit_whole, held_out
from ...store import stored_size
from ...task import Task
from ...vocabulary import attributes
from .convergence import DIMENSIONS
from .costladders import AXES, ladders
from .reference import Outcomes
from .timed_solve import COSTS

# Points of a grid, or of a line, below which the memory of a solve drowns in that of the process.
MEMORY_FROM = 256**2
# Settings whose largest values are asked about; of the others, a power holds for all values or is none.
GROWING = ("points", "modes", "steps")
LABELS = {
    "processor": "processor time",
    "applications": "operator applications",
    "per_application": "time of an application",
    "per_transform": "time of an application, of n² log n",
    "memory": "memory",
}
LARGEST = 16384  # points a side that the 3D solver takes at most
GIBIBYTE = 2.0**30
MEMORIES = (24, 64, 128)  # of machines [GiB]
SURFACES = 10**5
# Rough ladders that stand for an ensemble, with the points that it takes: some that were measured.
ENSEMBLES = {"plane": (256, 512), "slide-rough": (256, 512), "mdr-rough": (5000, 10**5)}
MEASURED = (*COSTS, "repeats", "transform_pairs", "plain_product", "padded_product")


@dataclass(frozen=True)
class CostFit:
    """Costs of the steps of a ladder, arrays (steps,) with NaN where a solve failed, and the powers they follow.

    name : of the ladder
    dataset : of its steps, see CostDiagram.datasets
    """

    name: str
    dataset: xarray.Dataset

    def __getattr__(self, name: str) -> np.ndarray:
        """A variable of the dataset by its name."""
        if name.startswith("_") or name not in self.dataset:
            raise AttributeError(name)
        return self.dataset[name].values

    @property
    def solver(self) -> str:
        """Name of the solver."""
        return self.dataset.attrs["solver"]

    @property
    def dimension(self) -> str:
        """Dimensionality of the solver."""
        return DIMENSIONS[self.solver]

    @property
    def setting(self) -> str:
        """What costs are asked against."""
        return self.dataset.attrs["setting"]

    @property
    def title(self) -> str:
        """Dimensionality and label, for people."""
        label = self.dataset.attrs["title"]
        return label if self.dimension in label else f"{self.dimension} {label}"

    @property
    def nodes(self) -> np.ndarray:
        """Points of each step in all (steps,)."""
        points = self.points.astype(float)
        return points if self.solver == "MDR" else points**2

    @property
    def per_application(self) -> np.ndarray:
        """Processor time over operator applications [s]."""
        return self.processor / self.applications

    @property
    def limit(self) -> np.ndarray:
        """Processor time of the products by transforms alone [s], NaN where it was not measured."""
        plain = (self.transform_pairs - self.applications) * self.plain_product
        return self.applications * self.padded_product + plain

    @property
    def over_limit(self) -> np.ndarray:
        """Processor time over that of the products alone."""
        return self.processor / self.limit

    @cached_property
    def laws(self) -> Mapping[str, Law | NoLaw]:
        """Laws by the names of LABELS: costs against x, memory from MEMORY_FROM on; per_transform against n^2 log n."""
        enough, follows = self.nodes >= MEMORY_FROM, fit if self.setting in GROWING else fit_whole
        found = {name: follows(self.x, getattr(self, name)) for name in tuple(LABELS)[:3]}
        if self.dimension == "3D" and self.setting == "points":
            found["per_transform"] = follows(self.x**2 * np.log(self.x), self.per_application)
        return found | {"memory": follows(self.x[enough], self.memory[enough])}


@dataclass(frozen=True)
class Forecast:
    """One number that a law gives, with its interval of 95 % for one more measurement, NaN where not known.

    ladder : name of what the law was fitted to; title : for people
    what : is forecast; kind : short name of that
    found : the same as measured, NaN where it was not
    reason : why there is none, empty where there is one
    """

    ladder: str
    title: str
    kind: str
    what: str
    unit: str
    value: float = nan
    low: float = nan
    high: float = nan
    found: float = nan
    reason: str = ""

    @property
    def held(self) -> bool | None:
        """Whether what was found lies in the interval; None where nothing was found, or nothing forecast."""
        if self.reason or not isfinite(self.found):
            return None
        return self.low <= self.found <= self.high

    @property
    def factor(self) -> float:
        """Factor by which the forecast missed what was found."""
        return max(self.found / self.value, self.value / self.found)


def forecasts(fits: Sequence[CostFit]) -> list[Forecast]:
    """Forecasts of all ladders of points: held-out points first, as they say how far to trust the others."""
    by_points = {each.name: each for each in fits if each.setting == "points"}
    checks = {name: _checks(each) for name, each in by_points.items()}
    found = [check for own in checks.values() for check in own.values()]
    for name, each in by_points.items():
        if each.dimension == "3D":
            found += _largest(each, checks[name])
    for name, points in ENSEMBLES.items():
        if name in by_points:
            found += _ensembles(by_points[name], points)
    return found


def _checks(each) -> dict[str, Forecast]:
    """The largest grid from those below it: its time, and its memory."""
    enough, found = each.nodes >= MEMORY_FROM, {}
    for what, unit, part, cost in (
        ("time", "s", slice(None), each.processor),
        ("memory", "GiB", enough, each.memory / GIBIBYTE),
    ):
        x, law, seen = held_out(each.x[part], cost[part])
        found[what] = _of(law, x, each, f"held-out-{what}", f"{what} with {x:g} points, from fewer", unit, found=seen)
    return found


def _largest(each, checks) -> Iterator[Forecast]:
    """Nothing is forecast from a law that has missed already by more than scatter."""
    time, memory = (
        _unless_missed(each.laws[cost], checks[what]) for cost, what in (("processor", "time"), ("memory", "memory"))
    )
    yield _of(time, LARGEST, each, "largest-time", f"time with {LARGEST}² points", "s")
    yield _of(memory, LARGEST, each, "largest-memory", f"memory with {LARGEST}² points", "GiB", 1 / GIBIBYTE)
    for size in MEMORIES:
        told = each.name, each.title, f"points-in-{size}-gib", f"points a side that {size} GiB hold", "1"
        if isinstance(memory, NoLaw):
            yield Forecast(*told, reason=memory.reason)
        else:
            yield Forecast(*told, *memory.reach(size * GIBIBYTE))


def _unless_missed(law, check):
    if check.held is not False or check.factor <= 1 + REPEATABLE:
        return law
    return NoLaw(f"without its largest grid the law misses it by a factor of {check.factor:.2g}", nan, nan, nan)


def _ensembles(each, points) -> Iterator[Forecast]:
    """As many times what one surface was measured to take: how that scatters between surfaces is not known."""
    for n in points:
        grid = f"{n} points" if each.dimension == "1D" else f"{n}² points"
        told = each.name, each.title, f"surfaces-{n}", f"{SURFACES} surfaces with {grid}", "core hours"
        measured = each.processor[each.x == n]
        if np.isfinite(measured).any():
            yield Forecast(*told, float(measured[0]) * SURFACES / HOUR)
        else:
            yield Forecast(*told, reason="not measured")
    rows = each.stored_bytes[each.status == SOLVED]
    if len(rows):
        low, middle, high = (float(SURFACES * f(rows) / GIBIBYTE) for f in (np.min, np.median, np.max))
        what = f"rows of {SURFACES} surfaces on disk"
        yield Forecast(each.name, each.title, "stored", what, "GiB", middle, low, high)


def _of(law: Law | NoLaw, x, each, kind, what, unit, times=1.0, found=nan):
    if isinstance(law, NoLaw):
        return Forecast(each.name, each.title, kind, what, unit, found=found, reason=law.reason)
    low, high = law.interval(x)
    return Forecast(each.name, each.title, kind, what, unit, times * law.at(x), times * low, times * high, found)


@dataclass(frozen=True)
class CostDiagram:
    """What costs are asked of the solvers."""

    name: str
    title: str
    about: str

    def untimed(self, size: str) -> list[Task]:
        """Nothing: there is no error to measure."""
        return []

    def timed(self, size: str) -> list[Task]:
        """Solves that are measured alone, each once."""
        return list(dict.fromkeys(solve for ladder in ladders(size).values() for solve in ladder.solves))

    def datasets(self, size: str, outcomes: Outcomes) -> dict[str, xarray.Dataset]:
        """Costs (step,) of each ladder, by its name."""
        return {name: _dataset(name, ladder, outcomes) for name, ladder in ladders(size).items()}

    def findings(self, node: xarray.DataTree) -> list[Finding]:
        """Exponents with their intervals, time over that of transforms, and forecasts with their checks."""
        fits = fits_of(node)
        return [
            *(_exponent(each, cost) for each in fits for cost in _exponents_of(each)),
            *(_over_limit(each) for each in fits if np.isfinite(each.limit).any()),
            *(_forecast(each) for each in forecasts(fits) if each.kind != "stored"),
        ]

    def plots(self, node: xarray.DataTree) -> list[Plot]:
        """Costs, laws and forecasts in one figure; none without any ladder against points."""
        fits, name = fits_of(node), f"workprecision-{self.name}"
        if not any(each.setting == "points" for each in fits):
            return []
        tables = {
            name: [row for each in fits for row in _steps(each)],
            f"{name}-laws": [row for each in fits for row in _laws(each)],
            f"{name}-forecasts": [{**asdict(each), "held": each.held} for each in forecasts(fits)],
        }
        options = {"largest": LARGEST, "memories": list(MEMORIES), "memory_from": MEMORY_FROM}
        axes = {name: axis.label for name, axis in AXES.items()}
        return [workprecision_costs.plot(name, {key: DataFrame(rows) for key, rows in tables.items()}, axes, options)]

    def tables(self, node: xarray.DataTree) -> list[Block]:
        """Times along all that is no number of points."""
        rows = []
        for each in fits_of(node):
            known = np.isfinite(each.processor)
            if known.any():
                least, most = np.nanargmin(each.processor), np.nanargmax(each.processor)
                law = each.laws["processor"]
                rows.append(
                    {
                        "ladder": each.title,
                        "against": AXES[each.setting].label,
                        "from": short(np.nanmin(each.x)),
                        "to": short(np.nanmax(each.x)),
                        "least time [s]": short(each.processor[least]),
                        "longest time [s]": short(each.processor[most]),
                        "longest at": short(each.x[most]),
                        "power": short(law.exponent) if isinstance(law, Law) else f"none: {law.reason}",
                    }
                )
        return [Table("workprecision-cost-ranges", DataFrame(rows), "Processor time along each ladder.")] if rows else []


def fits_of(node: xarray.DataTree) -> list[CostFit]:
    """Every ladder with its laws."""
    return [CostFit(name, child.to_dataset(inherit=False)) for name, child in node.children.items()]


def _dataset(name, ladder, outcomes):
    rows = [outcomes[solve].rows[0] for solve in ladder.solves]
    measure, values = AXES[ladder.setting].measure, np.array(ladder.values, float)

    def measured(label):
        return "step", [row.measures.get(label, nan) for row in rows]

    found = {label: measured(label) for label in MEASURED}
    found |= {
        "applications": ("step", [row.applications for row in rows]),
        "stored_bytes": ("step", [float(stored_size(s, Outcome(outcomes[s].rows))) for s in ladder.solves]),
        "status": ("step", [SOLVED if row.reason is None else FAILED for row in rows]),
        "reason": ("step", [row.reason or "" for row in rows]),
    }
    solvers = [solve.solver for solve in ladder.solves]
    coordinates = {
        "step": ("step", list(range(len(rows)))),
        "value": ("step", values),
        "x": measured(measure) if measure else ("step", values),
        "points": ("step", [solver.points for solver in solvers]),
        "steps": ("step", [solver.steps for solver in solvers]),
        "tolerance": ("step", [getattr(solver, "tolerance", nan) for solver in solvers]),
        "precision": ("step", [getattr(solver, "precision", "double") for solver in solvers]),
    }
    about = {"contact": name, "title": ladder.label, "setting": ladder.setting, "solver": solvers[0].name}
    dataset = xarray.Dataset(found, coordinates, about)
    for label in dataset.variables:
        dataset[label].attrs = attributes(str(label), ladder.solves[0].scene)
    return dataset


def _exponents_of(each):
    if each.setting == "points":
        return ("processor", "memory") if each.dimension == "1D" else ("processor", "applications", "memory")
    return ("processor",) if each.setting in GROWING else ()


def _exponent(each, cost):
    law, setting = each.laws[cost], each.setting
    sentence = f"Power of the {setting} with which {LABELS[cost]} grows"
    claim = Claim(f"workprecision.costs.{cost}-{setting}", sentence, dimension=each.dimension)
    where, plot = each.title, "workprecision-costs"
    if isinstance(law, NoLaw):
        return Finding(claim, nan, where=where, reason=f"no power: {law.reason}", plot=plot)
    said = f"from {law.lowest:g} to {law.highest:g} {setting}"
    return Finding(claim, law.exponent, law.exponent_interval, 0.0, where=where, regime=said, plot=plot)


def _over_limit(each):
    claim = Claim(
        "workprecision.costs.over-transforms",
        "Time of a 3D solve from 256² points on over that of its products by transforms alone, largest",
        dimension=each.dimension,
    )
    ratios = each.over_limit[(each.nodes >= MEMORY_FROM) & np.isfinite(each.over_limit)]
    value, why = (float(ratios.max()), "") if len(ratios) else (nan, "not measured")
    return Finding(claim, value, where=each.title, reason=why, plot="workprecision-costs")


def _forecast(each: Forecast):
    """What is forecast is reported; what was left out and measured is a law that holds or not."""
    told = {"where": each.title, "reason": each.reason, "plot": "workprecision-costs"}
    if each.kind.startswith("held-out"):
        claim = Claim(
            f"workprecision.costs.{each.kind}",
            f"The {each.kind.split('-')[-1]} of the largest grid, left out, lies in the interval of its forecast",
            1.0,
            0.0,
            "Cost measured over the cost that the law of the smaller grids gives",
            dimension=each.title[:2],
        )
        stated = UNDECIDED if each.held is None else HOLDS if each.held else FAILS
        return Finding(claim, each.found / each.value, stated=stated, **told)
    claim = Claim(f"workprecision.costs.{each.kind}", each.what.capitalize(), unit=each.unit, dimension=each.title[:2])
    return Finding(claim, each.value, (each.low, each.high), 0.0, **told)


def _steps(each: CostFit) -> Iterator[dict[str, Any]]:
    for k in range(len(each.x)):
        yield {
            "ladder": each.name,
            "label": each.dataset.attrs["title"],
            "title": each.title,
            "solver": each.solver,
            "dimension": each.dimension,
            "along": each.setting,
            **{name: getattr(each, name)[k] for name in ("x", "points", "steps", "tolerance", "precision")},
            **{name: getattr(each, name)[k] for name in ("processor", "wall", "repeats", "memory")},
            "bytes_a_point": each.memory[k] / each.nodes[k],
            "applications": each.applications[k],
            "transform_pairs": each.transform_pairs[k],
            "seconds_an_application": each.per_application[k],
            "over_limit": each.over_limit[k],
            "stored_bytes": each.stored_bytes[k],
            "status": each.status[k],
            "reason": each.reason[k],
        }


def _laws(each: CostFit) -> Iterator[dict[str, Any]]:
    fitted = ("overhead", "factor", "centre", "scatter", "lowest", "highest", "count")
    for cost, law in each.laws.items():
        row = {"ladder": each.name, "dimension": each.dimension, "cost": LABELS[cost], "variable": cost}
        low, high = law.exponent_interval if isinstance(law, Law) else (nan, nan)
        row |= {"exponent": getattr(law, "exponent", nan), "low": low, "high": high}
        row |= {name: getattr(law, name, nan) for name in fitted}
        yield row | {"reason": getattr(law, "reason", "")} | {
            name: getattr(law, name, nan) for name in ("least", "most", "at_most")
        }


COSTS_DIAGRAM = CostDiagram(
    "costs",
    "What a solve costs",
    "Time, memory and operator applications of both solvers against points, modes, steps, speed and contact; the "
    "powers they follow, and what those say of larger sizes.",
)
