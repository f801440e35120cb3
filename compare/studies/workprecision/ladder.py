"""Ladder: settings of a model on a scene, from fine to coarse, its contacts, and timed solves."""

import platform
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import nan
from typing import Any

import xarray

from scene import Refused, Scene, SolveError, Solver
from scene.protocol import why_not

from ...models.table import Model
from ...solving.cost import work_of
from ...solving.curve import LEAST, LEVELS, Curve, scaled
from ...solving.task import Outcome, Row, SceneTask, Task, reason_of, row
from ...statistics.means import pressed
from ..comparison.series import pilot

# A solve is repeated until REPEATED seconds have gone, at least FEWEST and at most MOST times; twice if it takes
# LONG seconds.
REPEATED, FEWEST, MOST, LONG = 0.5, 3, 50, 6.0


@dataclass(frozen=True)
class TimedSolve(SceneTask):
    """One scene, solved on each setting until its least time is known. It wants a process of its own.

    solver, finer : settings, from coarse to fine, so that the first loads compiled code

    The outcome has a row for each setting. Row.measures has, besides those of the result, processor and wall [s],
    each the least of the repeats, from the scene to the result, and repeats.
    """

    @property
    def question(self) -> dict:
        """The scene, the settings, and the machine."""
        return super().question | {"timed": [platform.machine(), platform.node()]}

    @property
    def packages(self) -> tuple[str, ...]:
        """Packages of the scene, of the solver and of this measurement."""
        return *super().packages, __name__

    @property
    def count(self) -> int:
        """A row for each setting."""
        return 1 + len(self.finer)

    def solve(self) -> Outcome:
        """Numbers of the last repeat on each setting, with its times; NaN with its reason where a solve fails."""
        return Outcome(tuple(_timed(each, self.scenes[0]) for each in (self.solver, *self.finer)))


def _timed(solver, scene) -> Row:
    spent: list[tuple[float, float]] = []
    started = time.perf_counter()
    while True:
        processor, wall = time.process_time(), time.perf_counter()
        try:
            found = row(solver.solve(scene))
        except (Refused, NotImplementedError, SolveError) as error:
            return Row(reason=reason_of(error))
        spent.append((time.process_time() - processor, time.perf_counter() - wall))
        passed = time.perf_counter() - started
        enough = 2 if passed > LONG else FEWEST
        if len(spent) >= MOST or (passed > REPEATED and len(spent) >= enough):
            least = dict(zip(("processor", "wall"), map(min, zip(*spent, strict=True)), strict=True))
            return replace(found, measures={**found.measures, **least, "repeats": float(len(spent))})


STEPS = 4  # grids that are timed, each with half the points of the one before
FINER = 4, 2  # times the points of the finest of them that the reference has
LONGEST = 5e9  # work of a solve of the reference, some minutes; a grid that needs more is left out
PROFILES, SURFACES = 1000, 8  # of models other than the reference
COARSEST = 128  # surfaces of the reference on its coarsest grid
NAMES = (*LEVELS, "fifth", "sixth")  # of grids, from fine to coarse


class AsItStands(Curve):
    """The scene itself, also where its motion has no speed or load that can vary."""

    def at(self, value: float, speed: float = 0.0) -> Scene:
        """The scene."""
        return self.scene


@dataclass(frozen=True)
class Ladder:
    """Settings of a model on a scene, from fine to coarse.

    solvers : that can solve the scene, those of the reference first
    reference : number of those, which are not timed
    refused : other settings, each with its reason
    """

    model: Model
    scene: Scene
    solvers: tuple[Solver, ...]
    reference: int
    refused: tuple[tuple[Solver, str], ...]

    @classmethod
    def of(cls, model: Model, scene: Scene, refers: bool = False) -> "Ladder":
        """Settings of a model. refers : whether far finer grids, or what has none, are the reference"""
        grids, least = [model.solver], LEAST.get(model.name, 1)
        while len(grids) < STEPS and (half := scaled(grids[-1], 0.5)) is not None and half.points >= least:
            grids.append(half)
        finer = [scaled(model.solver, times) for times in FINER] if refers and model.has_grid else []
        finer = [each for each in finer if each and work_of(each, scene) < LONGEST]
        reasons = [(each, "; ".join(why_not(each, scene))) for each in (*finer, *grids)]
        able = tuple(each for each, reason in reasons if not reason)
        refused = tuple(pair for pair in reasons[len(finer) :] if pair[1])
        untimed = finer if model.has_grid else able if refers else ()
        return cls(model, scene, able, sum(each in untimed for each in able), refused)

    @property
    def timed(self) -> list[TimedSolve]:
        """The solves that are timed, of the first surface, as one task; none where every grid is refused."""
        coarsest_first = self.solvers[self.reference :][::-1]
        work = 10 * sum(work_of(each, self.scene) for each in coarsest_first)
        return [TimedSolve(each, (self.scene,), coarsest_first[1:], work=work) for each in coarsest_first[:1]]

    def with_times(self, dataset: xarray.Dataset, outcomes: Mapping[Task, Outcome]) -> xarray.Dataset:
        """Answers of the scene (level, surface), with the processor times (level,) [s]."""
        times = [row.measures.get("processor", nan) for task in self.timed for row in outcomes[task].rows[::-1]]
        found = dataset.isel(dict.fromkeys(("speed", pressed(dataset)), 0))
        found = found if "surface" in found.dims else found.expand_dims("surface", -1)
        return found.assign(processor=("level", [nan] * self.reference + times))


def grid_of(ladders: Sequence[Ladder]) -> Curve:
    """Contacts of all models of a scene; the first model is the reference, its surfaces in strata."""
    (first, *_), scene = ladders, ladders[0].scene
    draws: dict[str, Any] = {each.model.name: each.model.count(PROFILES, SURFACES) for each in ladders}
    if len(first.solvers) > 1:
        draws[first.model.name] = (*pilot(len(first.solvers))[:-1], COARSEST)
    return AsItStands(
        scene=scene,
        speeds=(getattr(scene.motion, "speed", 0.0),),
        values=(scene.motion.greatest,),
        levels={each.model.name: dict(zip(NAMES, each.solvers, strict=False)) for each in ladders if each.solvers},
        draws=draws,
    )
