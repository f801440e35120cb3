"""Timed solves: one scene on the settings of one model, one after the other, alone in a process."""

import platform
import time
from dataclasses import dataclass, replace

from scene import Refused, SolveError

from ...solving.outcome import Outcome, Row, reason_of, row
from ...solving.task import SceneTask

# A solve is repeated until so many seconds have gone, at least and at most as often as said; twice, if it is long.
SECONDS, LEAST, MOST, LONG = 0.5, 3, 50, 6.0


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
        enough = 2 if passed > LONG else LEAST
        if len(spent) >= MOST or (passed > SECONDS and len(spent) >= enough):
            least = dict(zip(("processor", "wall"), map(min, zip(*spent, strict=True)), strict=True))
            return replace(found, measures={**found.measures, **least, "repeats": float(len(spent))})
