"""Error of friction that an answer states, against finer grids: fitted to many, and tested on many others."""

from collections import namedtuple
from dataclasses import dataclass, replace
from math import isfinite, nan

import numpy as np
import pandas
from pandas import DataFrame
from random_contacts import KINDS, RADIUS, drawn
from scipy.optimize import linprog
from scipy.sparse import csr_matrix, hstack, identity
from tables import of_count, task

from bem3d import BEM
from bem3d.costs import band
from bem3d.friction import bound as frictionerror
from bem3d.grid import Grid
from bem3d.problem import Problem
from mdr1d import MDR

EVERY = {"smooth": 1, "rough": 1, "plane": 2, "line": 6}  # seeds a scene of a kind
POINTS = (20, 120)  # of the grids that are judged, as is REFERENCE[0]
REFERENCE = 128, 256, 512  # points, the last ones tell the truth
ORDERS = 0.7, 2.0  # between which the order is taken at which the last error falls
WAVES = 2.2, 40.0  # nodes on the shortest wave of judged lines
EXTENT = 8 * RADIUS  # of lines [m]
FINER_LINES = 8, 16  # times the nodes of a judged line
LEARNED_POINTS = 16, 20, 24, 27, 32, 40, 48, 64, 80, 96, 112, 128  # of grids that are learned from
KNOWN = 1 / 3, 3e-5  # of the error, or at all: what the truth is known to where it judges
SHARE, WIDENED = 0.95, 0.96  # of the answers that a bound is to hold: wanted, and of those it was not fitted to
FOLDS = 5
LEAST = 1e-6  # error that is distinguished from none
KINDS_OF_ERROR = tuple(f"{body}, {speed}" for body in ("smooth", "rough") for speed in ("slow", "fast"))
FEWEST = 40  # answers of a region
SIGN = "sign: "  # before the names of signs among measures, which are names of other numbers too


class Judged(namedtuple("Judged", "name task finer")):
    """A scene on a grid to be judged, and the same on finer grids.

    name : of its kind, or of the scene
    """

    @property
    def tasks(self):
        """The judged answer and those on finer grids."""
        return (self.task, *self.finer)

    def error(self, outcomes, number="friction_coefficient", unit=None):
        """Relative error of a number, and how well its truth is known; unit : see `settled`."""
        answer, *finer = (outcomes[task].rows[0] for task in self.tasks)
        truth, unsure = settled([getattr(row, number) for row in finer if row.reason is None], unit)
        return abs(getattr(answer, number) - truth) / (abs(truth) if unit is None else unit), unsure


def contacts(seeds):
    """Contacts in three dimensions of some seeds, each with its kind and seed."""
    for kind in KINDS:
        for seed in seeds[:: EVERY[kind]]:
            yield kind, seed, drawn(kind, seed)


def judged(seeds):
    """Contacts of some seeds: on a random grid, and on the coarsest of the reference."""
    for kind, seed, scene in contacts(seeds):
        finer = reference(scene)
        points = 2 * int(np.random.default_rng([seed, 7]).integers(*POINTS) // 2)
        for each in (task(BEM(points=points), scene), finer[0]):
            if not each.solver.refusals(scene):
                yield Judged(kind, each, finer)


def judged_lines(seeds):
    """Contacts in one dimension: a third smooth, and a fifth of the rough ones cut off by their grid."""
    for seed in seeds:
        kind, draw = ("smooth", "rough", "rough")[seed % 3], np.random.default_rng([seed, 8])
        scene = same = drawn(kind, seed)
        rough, points = scene.roughness, int(10 ** draw.uniform(1.5, 4))
        if rough is not None:
            points = int(10 ** draw.uniform(*np.log10(WAVES)) * EXTENT / rough.shortest)
            if draw.random() < 0.2:
                points = int(10 ** draw.uniform(1.5, 3.5))
                shortest = 2 * rough.longest / int(np.ceil(rough.longest * points / EXTENT * (1 - 1e-12)))
                scene, same = (
                    replace(scene, roughness=replace(rough, shortest=each)) for each in (None, shortest)
                )
        finer = tuple(task(MDR(points=times * points, extent=EXTENT), same) for times in FINER_LINES)
        yield Judged(kind, task(MDR(points=points, extent=EXTENT), scene), finer)


def rows(every, outcomes):
    """A row for each contact that slides with friction, is answered, and whose truth is known well enough."""
    found = []
    for each in every:
        answer, error = _known(each, outcomes)
        if isfinite(error):
            (scene,), solver = each.finer[0].scenes, each.task.solver
            numbers = {"error": error, "bound": answer.measures.get("friction_error", nan)}
            row = {"model": solver.name, "body": each.name, "solid": type(scene.elastomer).__name__}
            row |= {"speed": band(scene)} | {name: float(f"{value:.4g}") for name, value in numbers.items()}
            found.append(row)
    return found


def _known(judged, outcomes):
    """Answer and relative error of its friction, NaN without friction or where the truth is not known enough."""
    answer = outcomes[judged.task].rows[0]
    if not answer.friction_force:
        return answer, nan
    (error, unsure), (share, least) = judged.error(outcomes), KNOWN
    return answer, error if unsure <= max(share * error, least) else nan


def regions(found):
    """Coverage by model and region: of all, by solid, speed and body."""
    kinds = ["all", "solid", "speed", "body"]
    regions = found.assign(all="all").melt(["model", "error", "bound"], kinds, value_name="region")
    for (model, region), own in regions.groupby(["model", "region"], sort=False):
        if region == "all" or len(own) >= FEWEST:
            held = int((own["error"] <= own["bound"]).sum())
            row = {"model": model, "region": region, "answers": len(own), "held": held}
            row |= zip(("lower", "upper"), of_count(held, len(own)), strict=True)
            yield row | own[["error", "bound"]].median().to_dict()


@dataclass(frozen=True)
class WithSigns:
    """The solver on a number of points, whose measures are the signs of the error of its friction."""

    points: int
    name = "BEM"
    packages = ("scene", "bem3d", __name__)

    def solve(self, scene):
        """Answer and signs, where it has friction."""
        solver = BEM(points=self.points)
        result, problem = solver.solve(scene), Problem(scene, solver.engine)
        grid = Grid(self.points, *map(result.settings.get, ("extent", "centre")), width=problem.width)
        _, seen = frictionerror.estimated(problem, grid, result.fields["pressure"], problem.lost)
        signs = {} if seen is None else seen.numbers
        return replace(result, measures={f"{SIGN}{name}": value for name, value in signs.items()})


def to_learn(seeds):
    """Scenes by name, each on several grids, with the finer ones that are the truth."""
    for kind, seed, scene in contacts(seeds):
        for points in LEARNED_POINTS:
            yield Judged(f"{kind}{seed}", task(WithSigns(points), scene), reference(scene))


def learn(every, outcomes):
    """A row of signs and errors of every answer that has friction and whose truth is known."""
    for each in every:
        answer, error = _known(each, outcomes)
        signs = {sign.removeprefix(SIGN): value for sign, value in answer.measures.items()}
        if signs and isfinite(error):
            body, speed = "rough" if signs["wave"] else "smooth", "slow" if signs["slowness"] > 1 / 2 else "fast"
            row = {"scene": each.name, "kind": f"{body}, {speed}", "error": f"{error:.4g}"}
            row["residual"] = f"{answer.residual:.2g}"
            yield row | {sign: f"{value:.4g}" for sign, value in signs.items() if sign != "one"}


def refitted(table):
    """Weights of the signs by kind of contact, from a table of signs and errors.

    The quantile SHARE of the error without the residual, widened by what holds WIDENED of the answers to
    scenes that were left out of a fit, a fold of them at a time.
    """
    names, weights = ["one", *table.columns.drop(["scene", "kind", "error", "residual"])], {}
    table = table.assign(one=1.0, fold=pandas.factorize(table["scene"])[0] % FOLDS)
    for kind in KINDS_OF_ERROR:
        own = table[table["kind"] == kind]
        signs, fold, error, residual = (own[name].to_numpy() for name in (names, "fold", "error", "residual"))
        left = frictionerror.OF_TOLERANCE * residual
        values, short = np.log(np.maximum(error - left, LEAST)), np.empty(len(own))
        for k in range(FOLDS):
            out = fold == k
            bound = np.exp(signs[out] @ _quantile(signs[~out], values[~out])) + left[out]
            short[out] = np.log(np.maximum(error[out], LEAST / 10) / bound)
        weights[kind] = _quantile(signs, values)
        weights[kind][0] += max(0.0, float(np.quantile(short, WIDENED)))
    return DataFrame(weights, index=names)


def _quantile(table, values):
    """Weights of the columns of a table (n, k) by quantile regression; it prefers small ones."""
    count, names = table.shape
    small = np.full(2 * names, 1e-4 * count)
    prices = np.concatenate([small, np.full(count, SHARE), np.full(count, 1 - SHARE)])
    slack = identity(count)
    system = hstack([csr_matrix(table), csr_matrix(-table), slack, -slack]).tocsc()
    solution = linprog(prices, A_eq=system, b_eq=values, method="highs").x
    return solution[:names] - solution[names : 2 * names]


def reference(scene):
    """Tasks from which the truth of a scene in three dimensions is taken."""
    return tuple(task(BEM(points=points), scene) for points in REFERENCE)


def settled(values, unit=None):
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
