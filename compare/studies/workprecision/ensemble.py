"""A rough scene whose answer is the mean over its surfaces: draws of the solvers, and plans to the mean."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import inf, nan, sqrt
from typing import Any

import numpy as np
import xarray

from bem3d import BEM
from mdr1d import MDR
from scene import Scene

from ...comparison.curve import FAILED, NOT_ASKED, SOLVED
from ...solving.task import SceneTask, Task, draws_of
from ...statistics.intervals import Estimated, skewness
from ...statistics.jackknife import mean_ratio
from ...statistics.sampling import Bias, Level, Mean, SamplingPlan, Scatter
from ...trustmap.corrected import CorrectedMDR
from .convergence import costs_of, described
from .reference import Known, Outcomes, Quantity
from .timed_solve import COSTS, TimedSolve, work

# Share of failed surfaces above which a mean over the others is not that over all.
MOST_FAILED = 0.02
# Variables of the Datasets by the quantity's name.
VARIABLES = {"friction": "friction_coefficient", "depth": "depth_reached", "force": "normal_force"}


@dataclass(frozen=True)
class Ensemble:
    """A rough scene with the grids on which the models answer it; the counterpart of a Convergence.

    The corrected 1D model answers with the profiles of the 1D model on its finest grid.

    name, title : see Convergence
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
    def timed(self) -> list[Task]:
        """Solves that have to be measured alone."""
        return [*(task for solver in self._solvers for task in self._timed_of(solver)), self._corrected]

    @property
    def untimed(self) -> list[Task]:
        """Tasks solved besides: one a surface in 3D, one for all profiles in 1D."""
        return [task for solver in self._solvers for task in self._tasks_of(solver)]

    def datasets(self, outcomes: Outcomes) -> dict[str, xarray.Dataset]:
        """Answers (points, draw) of each solver, with the costs (points,) of one draw, at name/solver.

        Of the corrected model the ratios, with the costs of one profile (step,).
        """
        ratios = costs_of([self._corrected], outcomes, *(f"{each.name}_ratio" for each in self.quantities))
        found = {
            name: self._dataset(name, [each for each in self._solvers if each.name == name], outcomes)
            for name in ("BEM", "MDR")
        }
        found[self._corrected.solver.name] = described(xarray.Dataset(ratios), self.scene)
        return {f"{self.name}/{name}": each for name, each in found.items()}

    @property
    def _solvers(self):
        return (*(BEM(points=points) for points in self.grids), *(MDR(points=points) for points in self.lines))

    @property
    def _corrected(self):
        return corrected_solve(self.scene, self.lines[-1])

    def _timed_of(self, solver):
        count = self.timed_surfaces if isinstance(solver, BEM) else 1
        return [TimedSolve.of(solver, scene) for scene in draws_of(self.scene, count)]

    def _tasks_of(self, solver):
        if isinstance(solver, MDR):
            return [SceneTask(solver, draws_of(self.scene, self.profiles), work=work(solver) * self.profiles)]
        count = self.surfaces if solver.points == self.grids[0] else self.paired
        return [SceneTask(solver, (scene,), work=work(solver)) for scene in draws_of(self.scene, count)]

    def _dataset(self, name, solvers, outcomes):
        grids = [[row for task in self._tasks_of(each) for row in outcomes[task].rows] for each in solvers]
        draws = max(map(len, grids))

        def filled(of, empty, kind=float):
            rows = [[of(row) for row in grid] + [empty] * (draws - len(grid)) for grid in grids]
            return ("points", "seed"), np.array(rows, kind)

        found = {
            VARIABLES[each.name]: filled(lambda row, each=each: each.measured(row), nan)
            for each in self.quantities
        }
        found["status"] = filled(lambda row: SOLVED if row.reason is None else FAILED, NOT_ASKED, object)
        found["reason"] = filled(lambda row: row.reason or "", "", object)
        costs = [costs_of(self._timed_of(each), outcomes) for each in solvers]
        for cost in (*COSTS, "operator_applications"):
            found[cost] = "points", [np.mean(each[cost][1]) for each in costs]
        first = self.scene.roughness.seed
        coordinates = {"points": [each.points for each in solvers], "seed": list(range(first, first + draws))}
        about = {"contact": self.name, "title": self.title, "solver": name}
        dataset = described(xarray.Dataset(found, coordinates, about), self.scene)
        for each in self.quantities:
            dataset[VARIABLES[each.name]].attrs |= {"quantity": each.name, "label": each.label}
            if each.name in self.scales:
                dataset[VARIABLES[each.name]].attrs["scale"] = self.scales[each.name]
        return dataset


def corrected_solve(scene: Scene, points: int) -> TimedSolve:
    """Solve of the corrected 1D model: the map, and one profile of so many points."""
    return TimedSolve(CorrectedMDR(MDR(points=points), profiles=1), (scene,), work=work(BEM()))


@dataclass(frozen=True)
class Sample:
    """Answers of one solver on one grid.

    values : by the quantity's name, (surfaces,), NaN where a solve failed or nothing touched
    costs : of one surface, the mean of those measured: processor, wall [s], memory [bytes] and
        operator_applications, NaN where one failed; and setup [s], the processor time before the first surface
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

    @classmethod
    def of(cls, dataset: xarray.Dataset, points: int) -> "Sample":
        """Sample of one grid of a solver."""
        grid = dataset.sel(points=points)
        grid = grid.isel(seed=np.flatnonzero(grid["status"].values != NOT_ASKED))
        values = {each.attrs["quantity"]: each.values for each in grid.values() if "quantity" in each.attrs}
        costs = {name: grid[name].item() for name in (*COSTS, "operator_applications")}
        reasons = tuple(str(reason) for reason in grid["reason"].values if reason)
        return cls(dataset.attrs["solver"], points, values, costs, reasons)

    def over(self, ratios: xarray.Dataset) -> "Sample":
        """Sample of the corrected 1D model from one of the 1D model; solves that failed are told of that one."""
        (reason,), (spent,) = ratios["reason"].values, ratios["processor"].values
        values = {name: each / ratios[f"{name}_ratio"].item() for name, each in self.values.items()}
        costs = {**self.costs, "setup": spent - self.costs["processor"]}
        return Sample("CorrectedMDR", self.points, values, costs, (str(reason),) if reason else ())


@dataclass(frozen=True)
class MeasuredMean(Mean):
    """A mean with its truth, and the samples that tell both.

    truth : mean with its whole error: half of the interval of 95 % and that of the grid; NaN where more than
        MOST_FAILED of the surfaces have no answer
    standard_error : statistical part of that error, relative; dof : its degrees of freedom
    samples : of all grids of all solvers
    """

    truth: Known
    standard_error: float
    dof: float
    samples: tuple[Sample, ...]


def means(bem: xarray.Dataset, mdr: xarray.Dataset, ratios: xarray.Dataset) -> list[MeasuredMean]:
    """Means of every quantity of a regime. ratios : of the corrected 1D model"""
    grids, lines = ([Sample.of(each, int(points)) for points in each["points"].values] for each in (bem, mdr))
    lines.append(lines[-1].over(ratios))
    return [_mean_of(each, bem.attrs, grids, lines) for each in bem.values() if "quantity" in each.attrs]


def plans_table(found: Sequence[MeasuredMean]) -> list[dict[str, Any]]:
    """A row for each level of each plan, relative to the scale of the truth, with the failures and costs."""
    rows = []
    for mean in found:
        samples = {(sample.solver, sample.points): sample for sample in mean.samples}
        for plan, level in ((way, level) for way in mean.plans for level in way.levels):
            own = samples[plan.solver, level.points[0]]
            low, high = level.scatter.interval()
            row = {name: getattr(mean, name) for name in ("contact", "title", "quantity", "label")} | {
                "truth": mean.truth.value,
                "scale": mean.truth.scale,
                "truth_standard_error": mean.standard_error,
                "truth_dof": mean.dof,
                "truth_grid_error": mean.grid_error,
                "solver": plan.solver,
                "plan": plan.label,
                "points": level.points[0],
                "coarser_points": level.points[1] if len(level.points) > 1 else 0,
                "setup": plan.setup,
                "bias": plan.bias.value,
                "bias_least": plan.bias.least,
                "bias_most": plan.bias.most,
                "scatter": level.scatter.value,
                "scatter_low": low,
                "scatter_high": high,
                "scatter_dof": level.scatter.dof,
                "surfaces": own.count,
                "failed": len(own.reasons),
                "reason": own.reasons[0] if own.reasons else "",
                "processor": level.seconds,
            }
            rows.append(row | {name: own.costs[name] for name in ("wall", "memory", "operator_applications")})
    return rows


def _mean_of(variable, about, grids, lines):
    """Two levels for the truth: the scatter is averaged out on the first grid, corrected on the same surfaces."""
    name = variable.attrs["quantity"]
    coarsest, finest = grids[0], grids[-1]
    first, best = coarsest.values[name], finest.values[name]
    many, corrections = Scatter.of(first), best - first[: best.size]
    found = _corrected_mean(first, corrections)
    unit = variable.attrs.get("scale", abs(found.value) or nan)
    known_mean = Estimated(found.value / unit, found.error / unit, found.dof, found.skewness)
    known = np.isfinite(first)
    known[: corrections.size] &= np.isfinite(corrections)
    # Error of the finest grid at first order, from what it changes on the same surfaces.
    changed = abs(float(mean_ratio(best - grids[-2].values[name][: best.size]).value))
    left = changed / (finest.points / grids[-2].points - 1) / unit
    if 1 - known.mean() > MOST_FAILED:
        left = nan

    def bias(sample):
        """Bias on the same surfaces: what they share does not count. Of the finest grid, the truth's own."""
        if sample is finest:
            return Bias(left, left, left)
        return Bias.of(mean_ratio(sample.values[name][: best.size] - best, unit), left)

    def plain(sample):
        """A mean on one grid. Its scatter is that of the first, times the change of it on the same surfaces."""
        values = sample.values[name]
        both = np.isfinite(values) & np.isfinite(first[: values.size])
        here, there = (Scatter.of(each[: values.size][both]) for each in (values, first))
        scatter = Scatter(many.value * here.value / there.value / unit if there.value else nan, many.dof)
        return SamplingPlan("BEM", bias(sample), (Level((sample.points,), scatter, sample.costs["processor"]),))

    def corrected(sample):
        """A mean on the first grid, with what a finer one changes on surfaces of their own."""
        scatter = Scatter(many.value / unit, many.dof)
        coarse = Level((coarsest.points,), scatter, coarsest.costs["processor"])
        changes = sample.values[name] - first[: sample.values[name].size]
        spent = sample.costs["processor"] + coarsest.costs["processor"]
        fine = Level((sample.points, coarsest.points), Scatter.of(changes / unit), spent)
        return SamplingPlan("BEM", bias(sample), (coarse, fine))

    def line(sample):
        """Plan of a 1D model, its bias its own mean less the truth: two independent numbers."""
        off = Bias.of(mean_ratio(sample.values[name], unit).less(known_mean), left)
        level = Level((sample.points,), Scatter.of(sample.values[name] / unit), sample.costs["processor"])
        return SamplingPlan(sample.solver, off, (level,), sample.costs.get("setup", 0.0))

    plans = (*map(plain, grids), *map(corrected, grids[1:]), *map(line, lines))
    low, high = known_mean.interval()
    truth = Known(found.value, float(unit * ((high - low) / 2 + left)), unit)
    told = about["contact"], about["title"], name, variable.attrs["label"]
    samples = (*grids, *lines)
    failed = sum(len(sample.reasons) for sample in samples)
    return MeasuredMean(*told, plans, left, failed, truth, known_mean.error, found.dof, samples)


def _corrected_mean(first, corrections) -> Estimated:
    """Sum of the means of many answers and of corrections of the first of them, which share surfaces."""
    shared = first[: corrections.size]
    both = np.isfinite(shared) & np.isfinite(corrections)
    many, few = mean_ratio(first), mean_ratio(corrections)
    value = float(many.value + few.value)
    if both.sum() < 2:
        return Estimated(value, nan, 0.0)
    covariance = float(np.cov(shared[both], corrections[both])[0, 1]) / (many.dof + 1)
    parts = float(many.error) ** 2, float(few.error) ** 2
    whole = sum(parts)
    dof = whole**2 / (parts[0] ** 2 / many.dof + parts[1] ** 2 / few.dof) if whole else inf
    # What each surface adds to the sum of both.
    added = np.nan_to_num(first - many.value) / (many.dof + 1)
    added[: corrections.size] += np.nan_to_num(corrections - few.value) / (few.dof + 1)
    return Estimated(value, sqrt(max(whole + 2 * covariance, 0.0)), dof, float(skewness(added)))
