"""Surfaces, points and processor time that an accuracy takes, foretold from a pilot of coarse surfaces.

Scatter is that of surfaces on the coarsest grid, and of differences between grids that are cheap; finer
differences are taken to scatter like the finest of these, which is more than they do. From scatter and planned
cost follow numbers of surfaces, as for `compare.sweep(interval=...)`.
"""

import warnings
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, replace
from itertools import pairwise
from math import ceil, isfinite
from typing import Any

import numpy as np
import xarray

from bem3d import BEM, Unconfirmed
from bem3d.accuracy import Choice
from scene import Refused, SolveError

from ..library.case import Case
from ..models.table import KNOWN, SURFACES
from ..solving.amounts import duration, seconds, share
from ..solving.cost import MOST_DRAWS, SECONDS
from ..solving.parameter_grid import DIFFERENCES, FINE, LEAST, LEVELS, PILOT, ParameterGrid, on_levels, work_of
from ..statistics.allocation import enough, rounded
from ..statistics.intervals import student
from ..statistics.jackknife import mean_ratio
from ..statistics.levels import MOMENTS
from .run.curves import models_of
from .sampling import in_strata

# Means over draws: of a variable, or of one over another.
MEANS = {
    "friction_coefficient": ("friction_force", "normal_force"),
    "normal_force": ("normal_force", None),
    "depth_reached": ("depth_reached", None),
}
WORDS = {"friction_coefficient": "friction", "normal_force": "force", "depth_reached": "depth"}
NUMBERS = "friction_force", "normal_force", "depth_reached"
MINUTE = 60.0  # [s]
LONGEST = 1.0  # planned processor time [s] of the pilot of one model, where so little is enough
UNKNOWN = "nothing is known of the scatter: coarse surfaces have no answer"


def wanted(prescribed: str, speeds: tuple[float, ...], slides: bool) -> Iterator[tuple[str, tuple[float, ...]]]:
    """Names of the means that an interval is asked for, with their speeds: what is not prescribed, and friction.

    slides : whether there is friction to speak of
    """
    yield "normal_force" if prescribed == "depth" else "depth_reached", speeds
    if slides:
        yield "friction_coefficient", tuple(speed for speed in speeds if speed > 0)


@dataclass(frozen=True)
class Forecast:
    """What intervals of 95 % of a half-width take, of the means over the surfaces of one contact.

    interval : half-width, relative
    means : what is averaged, in words
    grid : the contact, with as many surfaces as are foretold in each stratum
    halved : share of the mean that half the points change, by the name of the solver
    """

    interval: float
    means: tuple[str, ...]
    grid: ParameterGrid
    halved: Mapping[str, float]

    @property
    def seconds(self) -> float:
        """Planned processor time [s]."""
        return self.grid.cost.seconds

    @property
    def surfaces(self) -> dict[str, dict[int, int]]:
        """Surfaces, or profiles, by the points of the finest of their grids, by the name of the solver."""
        return {
            name: dict(zip([getattr(each, "points", 0) for each in grids.values()], counts, strict=True))
            for name, grids in self.grid.grids.items()
            if isinstance(counts := self.grid.draws.get(name), tuple)
        }

    def __str__(self) -> str:
        told = "; ".join(self._counted(name, counts) for name, counts in self.surfaces.items())
        what = f"{share(self.interval)} of the mean {' and '.join(self.means)}"
        return f"{what} takes {told}; {_time(self.seconds)}"

    def _counted(self, name, counts):
        """Numbers of one solver in words, and why they are not enough, if so."""
        label, drawn = KNOWN.get(name, (name, SURFACES))
        (points, first), *others = counts.items()
        finest = f"in {label} {first:,} {drawn} on {points} points"
        said = ", ".join([finest, *(f"{count:,} on {points}" for points, count in others)])
        if self.halved[name] >= self.interval:
            return f"{said}, and more points: half of them change {share(self.halved[name])}"
        return f"{said}, which are too few and the most there are" if MOST_DRAWS in counts.values() else said


@dataclass(frozen=True)
class Settings:
    """Points, tolerance and number of surfaces that keep an error in three dimensions.

    accuracy : the error, and half-width of the interval of 95 % of the mean over surfaces, relative
    quantity : friction, depth or load
    choice : of `BEM.for_accuracy`
    surfaces : that are averaged; 0 of a body without random surfaces
    """

    accuracy: float
    quantity: str
    choice: Choice
    surfaces: int

    @property
    def seconds(self) -> float:
        """Processor time of all surfaces [s], by that of the first."""
        return max(self.surfaces, 1) * self.choice.result.seconds

    def __str__(self) -> str:
        solver, left = self.choice.solver, share(self.choice.error[self.quantity])
        kept = f"leaves {left}" if self.choice.confirmed else f"does not confirm it: it leaves {left}"
        many = f"{self.surfaces:,} surfaces, " if self.surfaces else ""
        return (
            f"{share(self.accuracy)} of {self.quantity} in 3D: {solver.points} points and a tolerance of "
            f"{solver.tolerance:.2g}, which {kept}; {many}{_time(self.seconds)}"
        )


def forecast(case: Case, interval: float) -> Forecast | str:
    """What an interval takes at the contact of a case, by a pilot of coarse surfaces; the reason where none."""
    models = models_of(case)
    try:
        case.refuse()
        one = _contact(case, {each.name: {FINE: each.solver} for each in models})
        if not one.random:
            return "nothing is averaged: the body has no random surfaces"
        one.refuse()
    except (Refused, SolveError) as reason:
        return str(reason)
    asked = in_strata([one], models, {})[0]
    draws, halved = dict(asked.draws), dict.fromkeys(asked.grids, 0.0)
    means: list[str] = []
    for name, counts in asked.draws.items():
        assert isinstance(counts, tuple)
        seen = _seen(one, name, list(asked.grids[name].values()))
        for label, _ in wanted(one.prescribed, one.speeds, case.slides):
            needs, _, grid = enough(seen, *MEANS[label], asked.costs[name], interval)
            if np.isfinite(needs).all():
                means.append(WORDS[label])
                counts = tuple(map(max, zip(counts, map(rounded, needs.ravel().tolist()), strict=True)))
                halved[name] = max(halved[name], grid.item())
        draws[name] = tuple(min(each, MOST_DRAWS) for each in counts)
    return (
        Forecast(interval, tuple(dict.fromkeys(means)), replace(asked, draws=draws), halved) if means else UNKNOWN
    )


def settings(case: Case, accuracy: float) -> Settings | str:
    """What an error in three dimensions takes, surfaces included; the reason where none is promised."""
    quantity = "friction" if case.slides else "load" if getattr(case.motion, "depth", None) else "depth"
    others = {name: each for name, each in asdict(case.bem).items() if name not in ("points", "tolerance")}
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", Unconfirmed)  # the answer says so
            choice = BEM.for_accuracy(case.scene, **{quantity: accuracy}, **others)
    except (Refused, SolveError, ValueError) as reason:
        return str(reason)
    one = _contact(case, {choice.solver.name: {FINE: choice.solver}})
    if not one.random:
        return Settings(accuracy, quantity, choice, 0)
    coarsest = _ladder([choice.solver], case.scene)[-1]
    few = _affordable([SECONDS * work_of(coarsest, case.scene)])
    answers = _answers(one, choice.solver.name, [coarsest], few)
    label, _ = list(wanted(one.prescribed, one.speeds, case.slides))[-1]
    above, below = MEANS[label]
    found = mean_ratio(answers[above].values, answers[below].values if below else 1.0)
    scatter = (found.error / np.abs(found.value)).item() * answers.sizes["seed"] ** 0.5
    return Settings(accuracy, quantity, choice, sufficient(scatter, accuracy)) if isfinite(scatter) else UNKNOWN


def sufficient(scatter: float, half: float) -> int:
    """Fewest surfaces of a scatter whose mean has an interval of 95 % of a half-width, both relative."""
    count = max(2, ceil((student(0.95, np.inf) * scatter / half) ** 2))
    while student(0.95, count - 1) * scatter > half * count**0.5:
        count += 1
    return count


def _time(value):
    return f"about {seconds(value) if value < MINUTE else duration(value)} of processor time"


def _contact(case, grids):
    """The contact of a case by some solvers."""
    motion = case.motion
    speeds, values = (getattr(motion, "speed", 0.0),), (motion.greatest,)
    return ParameterGrid(scene=case.scene, speeds=speeds, values=values, grids=grids, draws={})


def _seen(one, name, grids):
    """Answers on some grids as a pilot would have them, of which it solves what is cheap.

    grids : settings of the solver from fine to coarse
    """
    ladder = _ladder(grids, one.scene)
    few = _affordable([SECONDS * work_of(each, one.scene) for each in ladder])
    finer = len(ladder) - len(few)
    answers = _answers(one, name, ladder[finer:], few)
    last = len(few) - 1
    # Finer differences are that of the finest that was solved, the coarsest surfaces those of the coarsest.
    taken = [*(min(max(k - finer, 0), max(last - 1, 0)) for k in range(len(grids) - 1)), last]
    return _strata(answers, taken)


def _ladder(grids, scene):
    """Settings from fine to coarse, and coarser ones than these: of great grids all of them are costly."""
    last = grids[-1]
    small = getattr(last, "points", 0) < 2 * LEAST.get(last.name, 1)
    return grids if small else [*grids, *list(on_levels(last, [scene]).values())[1:]]


def _affordable(costs):
    """Surfaces of a pilot by stratum, to the coarsest: as many differences as LONGEST allows, and one at least.

    costs : of a surface on each grid [s]
    """
    draws = [min(PILOT, max(DIFFERENCES, int(LONGEST / costs[-1])))]
    spent = draws[0] * costs[-1]
    for coarse, fine in pairwise(costs[::-1]):
        spent += DIFFERENCES * (fine + coarse)
        if len(draws) == len(LEVELS) or (len(draws) > 1 and spent > LONGEST):
            break
        draws.insert(0, DIFFERENCES)
    return tuple(draws)


def _answers(one, name, grids, draws):
    """Answers of one solver on some grids, as a Dataset; draws : surfaces of each stratum."""
    solved = replace(one, grids={name: dict(zip(LEVELS, grids, strict=False))}, draws={name: draws})
    return solved.datasets({task: task.solve() for task in solved.tasks()})[name]


def _strata(answers, taken):
    """Answers on as many grids as strata are taken from a Dataset, by their numbers, each for one grid."""
    strata = answers["stratum"].values
    columns = [np.flatnonzero(strata == each) for each in taken]
    stratum = np.repeat(range(len(taken)), [each.size for each in columns])
    made: dict[str, Any] = {}
    for name in NUMBERS:
        values = answers[name].transpose("grid", ..., "seed").values
        rows = np.full((len(taken), *values.shape[1:-1], stratum.size), np.nan)
        for k, (each, those) in enumerate(zip(taken, columns, strict=True)):
            for below in (0, 1) if k + 1 < len(taken) else (0,):
                rows[k + below][..., stratum == k] = values[each + below][..., those]
        made[name] = ("grid", "speed", "value", "seed"), rows
    if MOMENTS in answers:
        moments = answers[MOMENTS].transpose(..., "seed", "moment").values
        made[MOMENTS] = ("speed", "value", "seed", "moment"), moments[..., np.concatenate(columns), :]
    return xarray.Dataset(made, {"stratum": ("seed", stratum)})
