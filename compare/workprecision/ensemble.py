"""One rough scene whose answer is the mean over its surfaces: what either model takes to know it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import hypot, inf, nan, sqrt

import numpy as np

from bem3d import BEM
from mdr1d import MDR
from scene import Scene

from ..outcome import Outcome
from ..store import Task
from ..study import Task as Solves
from ..study import surfaces_of
from .contest import Known, Quantity, work
from .rung import COSTS, Rung
from .statistics import Bias, Draw, Scatter, Way, half_width

# Share of failed surfaces above which a mean over the others is not that over all.
FAILED = 0.02


@dataclass(frozen=True)
class Ensemble:
    """A rough scene with the grids on which both models answer it; the counterpart of a contest.

    name, title : as of a contest
    quantities : of which the mean over surfaces is asked for
    grids : points of the 3D solver, ascending, at least two; the last is that of the truth, the first that on
        which its scatter is averaged out
    surfaces, paired : drawn on the first grid; the first so many of them are solved on all grids
    lines : points of the 1D solver, ascending
    profiles : drawn on each
    timed_surfaces : of which the time is measured on each grid of the 3D solver
    scales : by the quantity's name, what errors are relative to; absent, the true mean
    """

    name: str
    title: str
    scene: Scene
    quantities: tuple[Quantity, ...]
    grids: tuple[int, ...]
    surfaces: int
    paired: int
    lines: tuple[int, ...]
    profiles: int
    timed_surfaces: int = 1
    scales: Mapping[str, float] = field(default_factory=dict)

    @property
    def timed(self) -> list[Rung]:
        """What has to be measured alone."""
        return [rung for solver in (*self._grid_solvers, *self._line_solvers) for rung in self._timed_of(solver)]

    @property
    def untimed(self) -> list[Task]:
        """What has to be solved besides: a task a surface in 3D, one for all profiles in 1D."""
        return [task for solver in (*self._grid_solvers, *self._line_solvers) for task in self._tasks_of(solver)]

    def judged(self, outcomes: Mapping[Task, Outcome]) -> "JudgedEnsemble":
        """All means with their errors and costs."""
        samples = {
            solver: _sample(solver, self._tasks_of(solver), self._timed_of(solver), outcomes, self.quantities)
            for solver in (*self._grid_solvers, *self._line_solvers)
        }
        grids = [samples[solver] for solver in self._grid_solvers]
        lines = [samples[solver] for solver in self._line_solvers]
        standings = {
            each.name: _standing(each, grids, lines, self.scales.get(each.name)) for each in self.quantities
        }
        return JudgedEnsemble(self, standings, (*grids, *lines))

    def drawn(self, count: int) -> tuple[Scene, ...]:
        """The scene with the seeds from its own on."""
        return surfaces_of(self.scene, count)

    @property
    def _grid_solvers(self):
        return tuple(BEM(points=points) for points in self.grids)

    @property
    def _line_solvers(self):
        return tuple(MDR(points=points) for points in self.lines)

    def _timed_of(self, solver):
        count = self.timed_surfaces if isinstance(solver, BEM) else 1
        return [Rung(solver, scene, work=work(solver)) for scene in self.drawn(count)]

    def _tasks_of(self, solver):
        if isinstance(solver, MDR):
            return [Solves(solver, self.drawn(self.profiles), work=work(solver) * self.profiles)]
        count = self.surfaces if solver.points == self.grids[0] else self.paired
        return [Solves(solver, (scene,), work=work(solver)) for scene in self.drawn(count)]


@dataclass(frozen=True)
class Sample:
    """Answers of one solver on one grid.

    values : by the quantity's name, (surfaces,), NaN where a solve failed or nothing touched
    costs : of one surface, the mean of those measured: processor, wall [s], memory [bytes],
        applications; NaN where one failed
    reasons : why solves failed, one each
    """

    solver: str
    points: int
    values: Mapping[str, np.ndarray]
    costs: Mapping[str, float]
    reasons: tuple[str, ...]

    @property
    def count(self) -> int:
        """Surfaces that were to be solved."""
        return next(iter(self.values.values())).size


@dataclass(frozen=True)
class Standing:
    """Where both models stand with one quantity.

    truth : mean over surfaces, with its whole error: half of the interval of 95 % and that of the grid
    statistical, discretisation : the two parts of that error, relative: the standard error, and what the finest
        grid leaves if the error falls with the first power of its points: as much as halving them changes; NaN,
        and with it the error of the truth, where more than FAILED of the surfaces have no answer
    freedom : degrees of freedom of the first
    ways : to it; relative to the scale of the truth
    """

    quantity: Quantity
    truth: Known
    statistical: float
    discretisation: float
    freedom: float
    ways: tuple[Way, ...]

    def of(self, solver: str) -> list[Way]:
        """Those of one solver."""
        return [way for way in self.ways if way.solver == solver]

    @property
    def floor(self) -> Bias | None:
        """Of the 1D model, on its finest grid: what no number of profiles passes."""
        own = self.of("MDR")
        return own[-1].bias if own else None


@dataclass(frozen=True)
class JudgedEnsemble:
    """An ensemble measured. standings : by the quantity's name; samples : of all grids of both solvers."""

    ensemble: Ensemble
    standings: Mapping[str, Standing]
    samples: tuple[Sample, ...]


def _sample(solver, tasks, timed, outcomes, quantities):
    rows = [row for task in tasks for row in outcomes[task].rows]
    values = {each.name: np.array([float(each.of(row, {})) for row in rows]) for each in quantities}
    measured = [outcomes[rung].rows[0].measures for rung in timed]
    costs = {name: float(np.mean([found.get(name, nan) for found in measured])) for name in COSTS}
    costs["applications"] = float(np.mean([outcomes[rung].rows[0].applications for rung in timed]))
    reasons = tuple(row.reason for row in rows if row.reason is not None)
    return Sample(solver.name, solver.points, values, costs, reasons)


def _standing(quantity: Quantity, grids: Sequence[Sample], lines: Sequence[Sample], scale: float | None):
    """Two levels for the truth: the scatter is averaged out on the first grid, corrected on the same surfaces."""
    name = quantity.name
    first, finest = grids[0].values[name], grids[-1].values[name]
    many = Scatter.of(first)
    corrections = finest - first[: finest.size]
    few = Scatter.of(corrections)
    value = _mean(first) + _mean(corrections)
    error, freedom = _combined(first, corrections, many, few)
    unit = (abs(value) or nan) if scale is None else scale
    discretisation = _left(grids[-1], grids[-2], name) / unit
    if _failed(first, corrections) > FAILED:
        discretisation = nan
    statistical = error / unit
    reach = half_width(statistical, freedom)
    ways = [
        *_plain(grids, name, unit, many, discretisation),
        *_corrected(grids, name, unit, many, discretisation),
        *(_line(each, name, unit, value, statistical, freedom, discretisation) for each in lines),
    ]
    truth = Known(value, unit * (reach + discretisation), unit)
    return Standing(quantity, truth, statistical, discretisation, freedom, tuple(ways))


def _combined(first, corrections, many, few):
    """Standard error of the sum of both means, which share surfaces, and its degrees of freedom."""
    shared = first[: corrections.size]
    both = np.isfinite(shared) & np.isfinite(corrections)
    if both.sum() < 2:
        return nan, 0.0
    covariance = float(np.cov(shared[both], corrections[both])[0, 1]) / (many.freedom + 1)
    parts = many.of_mean**2, few.of_mean**2
    whole = sum(parts)
    freedom = whole**2 / (parts[0] ** 2 / many.freedom + parts[1] ** 2 / few.freedom) if whole else inf
    return sqrt(max(whole + 2 * covariance, 0.0)), freedom


def _failed(first, corrections):
    """Share of the surfaces that lack an answer, or the correction that they were drawn for."""
    known = np.isfinite(first)
    known[: corrections.size] &= np.isfinite(corrections)
    return 1 - known.mean()


def _left(finest, less, name):
    """Error of the finest grid at first order, from what it changes on the same surfaces."""
    best = finest.values[name]
    return abs(_mean(best - less.values[name][: best.size])) / (finest.points / less.points - 1)


def _plain(grids, name, unit, many, discretisation):
    """A mean on one grid. Biases are those on the same surfaces: what they share does not count."""
    for sample in grids:
        bias = _grid_bias(sample, grids[-1], name, unit, discretisation)
        scatter = _scatter_on(sample.values[name], grids[0].values[name], many, unit)
        yield Way("BEM", bias, (Draw((sample.points,), scatter, sample.costs["processor"]),))


def _corrected(grids, name, unit, many, discretisation):
    """A mean on the first grid, with what finer ones change on surfaces of their own."""
    first = grids[0]
    coarse = Draw((first.points,), Scatter(many.value / unit, many.freedom), first.costs["processor"])
    for sample in grids[1:]:
        changes = sample.values[name] - first.values[name][: sample.values[name].size]
        scatter = Scatter.of(changes / unit)
        seconds = sample.costs["processor"] + first.costs["processor"]
        bias = _grid_bias(sample, grids[-1], name, unit, discretisation)
        yield Way("BEM", bias, (coarse, Draw((sample.points, first.points), scatter, seconds)))


def _grid_bias(sample, best, name, unit, discretisation):
    """Of the finest grid it is what the truth's own may be."""
    if sample is best:
        return Bias(discretisation, 0.0)
    finest = best.values[name]
    changes = (sample.values[name][: finest.size] - finest) / unit
    scatter = Scatter.of(changes)
    return Bias(_mean(changes), half_width(scatter.of_mean, scatter.freedom) + discretisation)


def _scatter_on(values, first, many, unit):
    """On any grid: that of the first, which many surfaces tell, times what it changes by on the same surfaces."""
    both = np.isfinite(values) & np.isfinite(first[: values.size])
    here, there = (Scatter.of(each[: values.size][both]) for each in (values, first))
    return Scatter(many.value * here.value / there.value / unit if there.value else nan, many.freedom)


def _line(sample, name, unit, value, statistical, freedom, discretisation):
    """Of the 1D model: its own mean less the truth, two independent numbers."""
    scatter = Scatter.of(sample.values[name] / unit)
    parts = scatter.of_mean, statistical
    error = hypot(*parts)
    known = scatter.freedom > 0 and error > 0
    both = error**4 / sum(p**4 / f for p, f in zip(parts, (scatter.freedom, freedom), strict=True)) if known else 0
    bias = Bias(_mean(sample.values[name]) / unit - value / unit, half_width(error, both) + discretisation)
    return Way("MDR", bias, (Draw((sample.points,), scatter, sample.costs["processor"]),))


def _mean(values):
    """Of the finite ones; NaN of none."""
    known = np.asarray(values, float)
    known = known[np.isfinite(known)]
    return float(known.mean()) if known.size else nan
