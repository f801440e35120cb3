"""Ladder: one model on one scene, on grids from fine to coarse, with its answers and times as a Dataset."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain
from math import nan

import numpy as np
import xarray

from scene import Scene, Solver
from scene.protocol import why_not
from scene.result import provenance

from ..models.table import NONE, PROFILES, Model
from ..solving.control_variates import VARIATES, control_variates
from ..solving.cost import MOST_DRAWS, SECONDS
from ..solving.outcome import Outcome
from ..solving.parameter_grid import LEAST, NUMBERS, UNASKED, halved, work_of
from ..solving.task import SceneTask, Task, draws_of
from ..solving.vocabulary import attributes
from ..statistics.multilevel import pilot
from .timed import TimedSolve

STEPS = 4  # grids that are timed, each with half the points of the one before
FINER = 4, 2  # times the points of the finest of them that the reference has
LONGEST = 300.0  # planned processor time of one solve of the reference [s], beyond which its grid is left out
SURFACES, PROFILES_DRAWN = 8, 1000  # of models other than the reference


@dataclass(frozen=True)
class Ladder:
    """One model on one scene, on grids from fine to coarse.

    solvers : settings that can solve the scene, those of the reference first
    reference : number of those, which are not timed
    refused : other settings, each with its reason
    strata : numbers of surfaces of the reference, as `statistics.multilevel` has them; empty of other models,
        which solve the same draws on all grids
    """

    model: Model
    scene: Scene
    solvers: tuple[Solver, ...]
    reference: int = 0
    refused: tuple[tuple[Solver, str], ...] = ()
    strata: tuple[int, ...] = ()

    @classmethod
    def of(cls, model: Model, scene: Scene, refers: bool = False, strata: Sequence[int] = ()) -> "Ladder":
        """Settings of a model on a scene. refers : whether far finer grids than its own are the reference

        strata : numbers of surfaces of the reference, those of a pilot if absent
        """
        grids, least = [model.solver], LEAST.get(model.name, 1)
        while len(grids) < STEPS and (half := halved(grids[-1])) is not None and half.points >= least:
            grids.append(half)
        finer = (
            [_refined(model.solver, times) for times in FINER]
            if refers and hasattr(model.solver, "points")
            else []
        )
        finer = [each for each in finer if SECONDS * work_of(each, scene) < LONGEST and not why_not(each, scene)]
        why = [(each, "; ".join(why_not(each, scene))) for each in grids]
        able, refused = [each for each, reason in why if not reason], tuple(each for each in why if each[1])
        if refers and not finer and model.draws == NONE:
            return cls(model, scene, tuple(able), len(able), refused)
        drawn = refers and hasattr(scene.roughness, "seed")
        counts = tuple(strata or pilot(len(finer) + len(able))) if drawn else ()
        return cls(model, scene, (*finer, *able), len(finer), refused, counts)

    @property
    def drawn(self) -> bool:
        """Whether its answers differ by the seed of the roughness."""
        return hasattr(self.scene.roughness, "seed") and self.model.draws != NONE

    @cached_property
    def seeds(self) -> list[list[int]]:
        """Seeds on each grid, less that of the scene: of a stratum on its grid and on the next coarser one."""
        if not self.drawn:
            return [[0] for _ in self.solvers]
        if not self.strata:
            return [list(range(self.model.count(PROFILES_DRAWN, SURFACES)))] * len(self.solvers)
        own = [[*range(k * MOST_DRAWS, k * MOST_DRAWS + count)] for k, count in enumerate(self.strata)]
        return [[*chain(*own[max(k - 1, 0) : k + 1])] for k in range(len(own))]

    @property
    def costs(self) -> list[float]:
        """Planned work of a surface of each stratum on both of its grids."""
        each = [work_of(solver, self.scene) for solver in self.solvers]
        return [sum(each[k : k + 2]) for k in range(len(each))]

    def tasks(self) -> list[SceneTask]:
        """All profiles of a grid together, each surface alone."""
        return [task for tasks in self._tasks for task in tasks]

    @cached_property
    def _tasks(self):
        found = []
        for solver, seeds in zip(self.solvers, self.seeds, strict=True):
            scenes = draws_of(self.scene, seeds) if self.drawn else (self.scene,)
            together = [scenes] if self.model.draws == PROFILES else [(each,) for each in scenes]
            work = work_of(solver, self.scene)
            found.append([SceneTask(solver, each, work=work * len(each)) for each in together])
        return found

    def timed(self) -> list[TimedSolve]:
        """The solves that are timed, of the first surface, as one task; none where every grid is refused."""
        coarsest_first = self.solvers[self.reference :][::-1]
        work = 10 * sum(work_of(each, self.scene) for each in coarsest_first)
        return [TimedSolve(each, (self.scene,), coarsest_first[1:], work=work) for each in coarsest_first[:1]]

    def dataset(self, outcomes: Mapping[Task, Outcome]) -> xarray.Dataset:
        """Answers (level, surface), with the reason of each that failed, and processor times (level,) [s]."""
        seeds = list(dict.fromkeys(seed for each in self.seeds for seed in each))
        rows = []
        for own, tasks in zip(self.seeds, self._tasks, strict=True):
            answered = dict(zip(own, (row for task in tasks for row in outcomes[task].rows), strict=True))
            rows.append([answered.get(seed, UNASKED) for seed in seeds])
        columns = {name: [[getattr(row, of) for row in grid] for grid in rows] for name, of in NUMBERS.items()}
        for name in {name for row in rows[0] for name in row.measures if name.endswith("_ratio")}:
            columns[name] = [[row.measures.get(name, nan) for row in grid] for grid in rows]
        columns["reason"] = [[row.reason or "" for row in grid] for grid in rows]
        times = [
            row.measures.get("processor", nan) for task in self.timed() for row in reversed(outcomes[task].rows)
        ]
        first = getattr(self.scene.roughness, "seed", 0)
        found = xarray.Dataset(
            {name: (("level", "surface"), values) for name, values in columns.items()},
            {
                "points": ("level", [getattr(each, "points", 0) for each in self.solvers]),
                "surface": [first + seed for seed in seeds],
            },
        )
        found["processor"] = "level", [nan] * self.reference + times
        if self.strata:
            stratum = np.repeat(range(len(self.strata)), self.strata)
            found.coords["stratum"] = "surface", stratum
            coarsest = found["surface"].values[stratum == len(self.strata) - 1]
            variates = control_variates(self.solvers[-1], [self.scene], coarsest.tolist())[0]
            if variates.size:
                found[VARIATES] = xarray.DataArray(variates, {"surface": coarsest}, ["surface", "variate"])
        for label in found.variables:
            found[label].attrs = attributes(str(label), self.scene)
        return found.assign_attrs(provenance(self.scene, found["surface"].values) | {"solver": self.model.name})


def _refined(solver, times):
    steps = {"steps": times * solver.steps} if hasattr(solver, "steps") else {}
    return replace(solver, points=times * solver.points, **steps)
