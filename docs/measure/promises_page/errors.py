"""Error of friction that an answer states, against finer grids: fitted to many, and tested on many others."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import isfinite, nan
from pathlib import Path
from typing import Any

import numpy as np
import pandas
from pandas import DataFrame
from scipy.optimize import linprog
from scipy.sparse import csr_matrix, hstack, identity
from tables import of_count

from bem3d import BEM
from bem3d.costs import band
from bem3d.friction import bound as frictionerror
from bem3d.grid import Grid
from bem3d.problem import Problem
from compare.solving.task import Outcome, SceneTask, Task
from mdr1d import MDR
from scene import Result, Scene

from . import scenes

EVERY = {"smooth": 1, "rough": 1, "plane": 2, "line": 6}  # seeds a scene of a kind
POINTS = (20, 120)  # of the grids that are judged, as is REFERENCE[0]
REFERENCE = 128, 256, 512  # points, the last ones tell the truth
ORDERS = 0.7, 2.0  # between which the order is taken at which the last error falls
WAVES = 2.2, 40.0  # nodes on the shortest wave of judged lines
EXTENT = 8 * scenes.RADIUS  # of lines [m]
FINER_LINES = 8, 16  # times the nodes of a judged line
LEARNED_POINTS = 16, 20, 24, 27, 32, 40, 48, 64, 80, 96, 112, 128  # of grids that are learned from
KNOWN = 1 / 3, 3e-5  # of the error, or at all: what the truth is known to where it judges
SHARE, WIDENED = 0.95, 0.96  # of the answers that a bound is to hold: wanted, and of those it was not fitted to
FOLDS = 5
LEAST = 1e-6  # error that is distinguished from none
KINDS = tuple(f"{body}, {speed}" for body in ("smooth", "rough") for speed in ("slow", "fast"))
FEWEST = 40  # answers of a region
WAVE_POINTS = "points_per_shortest_wave"
SIGN = "sign: "  # before the names of signs among measures, which are names of other numbers too


@dataclass(frozen=True)
class Judged:
    """A scene on a grid to be judged, and the same on finer grids."""

    kind: str
    task: SceneTask
    finer: tuple[SceneTask, ...]

    @property
    def scene(self) -> Scene:
        """The scene."""
        return self.task.scenes[0]

    @property
    def tasks(self) -> tuple[Task, ...]:
        """The judged answer and those on finer grids."""
        return (self.task, *self.finer)


def judged(seeds: range) -> Iterator[Judged]:
    """Contacts in three dimensions of some seeds: on a random grid, and on the coarsest of the reference."""
    for kind in scenes.KINDS:
        for seed in seeds[:: EVERY[kind]]:
            scene = scenes.drawn(kind, seed)
            finer = reference(scene)
            points = 2 * int(np.random.default_rng([seed, 7]).integers(*POINTS) // 2)
            for task in (_task(BEM(points=points), scene), finer[0]):
                if not task.solver.refusals(scene):
                    yield Judged(kind, task, finer)


def judged_lines(seeds: range) -> Iterator[Judged]:
    """Contacts in one dimension: a third smooth, and a fifth of the rough ones cut off by their grid."""
    for seed in seeds:
        kind, draw = ("smooth", "rough", "rough")[seed % 3], np.random.default_rng([seed, 8])
        scene = scenes.drawn(kind, seed)
        points, extent = int(10 ** draw.uniform(1.5, 4)), EXTENT
        if scene.roughness is not None:
            waves = 10 ** draw.uniform(*np.log10(WAVES))
            points = int(waves * extent / scene.roughness.shortest)
        same = scene
        if scene.roughness is not None and draw.random() < 0.2:
            points = int(10 ** draw.uniform(1.5, 3.5))
            scene = replace(scene, roughness=replace(scene.roughness, shortest=None))
            period = int(np.ceil(scene.roughness.longest * points / extent * (1 - 1e-12)))
            same = replace(
                scene, roughness=replace(scene.roughness, shortest=2 * scene.roughness.longest / period)
            )
        finer = tuple(_task(MDR(points=times * points, extent=extent), same) for times in FINER_LINES)
        yield Judged(kind, _task(MDR(points=points, extent=extent), scene), finer)


def rows(every: Sequence[Judged], outcomes: Mapping[Task, Outcome]) -> list[dict[str, Any]]:
    """A row for each contact that slides with friction, is answered, and whose truth is known well enough."""
    found = []
    for each in every:
        answer, error = outcomes[each.task].rows[0], _error(each, outcomes)
        if isfinite(error):
            waves, bound = (answer.measures.get(name, nan) for name in (WAVE_POINTS, "friction_error"))
            speed, solid = band(each.finer[0].scenes[0]), type(each.scene.elastomer).__name__
            row = {"model": each.task.solver.name, "body": each.kind, "solid": solid, "speed": speed}
            row |= {"waves": float(f"{waves:.4g}"), "points": each.task.solver.points}
            found.append(row | {"error": float(f"{error:.4g}"), "bound": float(f"{bound:.4g}")})
    return found


def _error(judged: Judged, outcomes: Mapping[Task, Outcome]) -> float:
    """Relative error of friction; NaN without friction, and where the truth is not known well enough."""
    answer, *finer = (outcomes[task].rows[0] for task in judged.tasks)
    if answer.reason is not None or not answer.friction_force:
        return nan
    truth, unsure = settled([row.friction_coefficient for row in finer if row.reason is None])
    error, (share, least) = abs(answer.friction_coefficient / truth - 1), KNOWN
    return error if unsure <= max(share * error, least) else nan


def regions(found: Sequence[Mapping[str, Any]]) -> Iterator[dict[str, Any]]:
    """Coverage by model and region: of all, by solid, speed and body."""
    for model, own in DataFrame(found).groupby("model", sort=False):
        yield _coverage(model, "all", own)
        for name in ("solid", "speed", "body"):
            for label, group in own.groupby(name):
                if len(group) >= FEWEST:
                    yield _coverage(model, label, group)


@dataclass(frozen=True)
class WithSigns:
    """The solver on a number of points, whose measures are the signs of the error of its friction."""

    points: int
    name = "BEM"
    packages = ("scene", "bem3d", __name__)

    def solve(self, scene: Scene) -> Result:
        """Answer and signs, where it has friction."""
        solver = BEM(points=self.points)
        result = solver.solve(scene)
        problem, settings = Problem(scene, solver.engine), result.settings
        grid = Grid(self.points, settings["extent"], settings["centre"], width=problem.width)
        _, seen = frictionerror.estimated(problem, grid, result.fields["pressure"], problem.lost)
        signs = {} if seen is None else seen.numbers
        return replace(result, measures={f"{SIGN}{name}": value for name, value in signs.items()})


def to_learn(seeds: Sequence[int]) -> Iterator[tuple[str, Judged]]:
    """Scenes by name, each on several grids, with the finer ones that are the truth."""
    for kind in scenes.KINDS:
        for seed in seeds[:: EVERY[kind]]:
            scene = scenes.drawn(kind, seed)
            for points in LEARNED_POINTS:
                yield f"{kind}{seed}", Judged(kind, _task(WithSigns(points), scene), reference(scene))


def learn(path: Path, every: Sequence[tuple[str, Judged]], outcomes: Mapping[Task, Outcome]) -> None:
    """Write the table of signs and errors of every answer that has friction and whose truth is known."""
    found = []
    for name, each in every:
        answer, error = outcomes[each.task].rows[0], _error(each, outcomes)
        signs = {sign.removeprefix(SIGN): value for sign, value in answer.measures.items()}
        if signs and isfinite(error):
            slow = "slow" if signs["slowness"] > 1 / 2 else "fast"
            row = {"scene": name, "kind": f"{'rough' if signs['wave'] else 'smooth'}, {slow}"}
            row |= {"error": f"{error:.4g}", "residual": f"{answer.residual:.2g}"}
            found.append(row | {sign: f"{value:.4g}" for sign, value in signs.items() if sign != "one"})
    DataFrame(found).to_csv(path, index=False, compression={"method": "gzip", "mtime": 0})


def refitted(path: Path) -> dict[str, dict[str, float]]:
    """Weights of the signs by kind of contact, from a table of signs and errors.

    The quantile SHARE of the error without the residual, widened by what holds WIDENED of the answers to
    scenes that were left out of a fit, a fold of them at a time.
    """
    table, weights = pandas.read_csv(path), {}
    names = list(table.columns.drop(["scene", "kind", "error", "residual"]))
    fold = pandas.factorize(table["scene"])[0] % FOLDS
    for kind in KINDS:
        here = table["kind"] == kind
        own, folds = table[here], fold[here]
        signs = np.column_stack([np.ones(len(own)), own[names]])
        error, left = own["error"].to_numpy(), frictionerror.OF_TOLERANCE * own["residual"].to_numpy()
        values, short = np.log(np.maximum(error - left, LEAST)), np.empty(len(own))
        for k in range(FOLDS):
            bound = np.exp(signs[folds == k] @ _quantile(signs[folds != k], values[folds != k], SHARE))
            short[folds == k] = np.log(np.maximum(error, LEAST / 10)[folds == k] / (bound + left[folds == k]))
        found = _quantile(signs, values, SHARE)
        found[0] += max(0.0, float(np.quantile(short, WIDENED)))
        weights[kind] = dict(zip(["one", *names], found.tolist(), strict=True))
    return weights


def write(weights: Mapping[str, Mapping[str, float]]) -> None:
    """Write the weights where three dimensions read them."""
    table = DataFrame(weights).map("{:.4g}".format)
    table.to_csv(frictionerror.FITTED, index_label="sign", lineterminator="\n")


def _quantile(table, values, share):
    """Weights of the columns of a table (n, k) by quantile regression; it prefers small ones."""
    count, names = table.shape
    small = np.full(2 * names, 1e-4 * count)
    prices = np.concatenate([small, np.full(count, share), np.full(count, 1 - share)])
    slack = identity(count)
    system = hstack([csr_matrix(table), csr_matrix(-table), slack, -slack]).tocsc()
    solution = linprog(prices, A_eq=system, b_eq=values, method="highs").x
    return solution[:names] - solution[names : 2 * names]


def _task(solver, scene: Scene) -> SceneTask:
    points = solver.points
    return SceneTask(solver, (scene,), work=100.0 * points if isinstance(solver, MDR) else points**2.2 * 50.0)


def reference(scene: Scene) -> tuple[SceneTask, ...]:
    """Tasks from which the truth of a scene in three dimensions is taken."""
    return tuple(_task(BEM(points=points), scene) for points in REFERENCE)


def settled(values: Sequence[float], unit: float | None = None) -> tuple[float, float]:
    """What values on ever finer grids tend to, by the order at which they change, and how well that is known.

    unit : over which it is known, if not itself
    """
    if len(values) < 2:
        return nan, np.inf
    change = values[-1] - values[-2]
    order = np.mean(ORDERS)
    if len(values) > 2 and change and (before := values[-2] - values[-3]) / change > 0:
        order = np.clip(np.log2(before / change), *ORDERS)
    left = change / (2**order - 1)
    truth = values[-1] + left
    return truth, abs(left) / (abs(truth) if unit is None else unit)


def _coverage(model, region, group):
    held, count = int((group["error"] <= group["bound"]).sum()), len(group)
    lower, upper = of_count(held, count)
    return {
        "model": model,
        "region": region,
        "answers": count,
        "held": held,
        "lower": lower,
        "upper": upper,
        "median_error": group["error"].median(),
        "median_bound": group["bound"].median(),
    }
