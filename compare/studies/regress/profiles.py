"""One contact on many rough profiles at once, as a task."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import isnan
from typing import Any

from mdr1d.ensemble import solve_profiles
from scene import Scene

from ...solving.outcome import Outcome, Row
from ...solving.task import SCENES


@dataclass(frozen=True)
class Profiles:
    """A task, see `task.Task`: one scene on the profiles of the seeds 0, 1, ..., by mdr1d.ensemble.

    points : on the longest wavelength; profiles : how many
    """

    scene: Scene
    points: int
    profiles: int
    keeps_fields = False
    packages = ("scene", "mdr1d", "compare.studies.regress.profiles")

    @property
    def label(self) -> str:
        """Short description for people."""
        shape, motion = type(self.scene.indenter).__name__.lower(), self.scene.motion
        return f"{shape} {motion.load:.3g} N, {motion.speed:.3g} m/s, {self.profiles} profiles at once"

    @property
    def work(self) -> float:
        """Rough cost, in passes over a node."""
        return 4.0 * self.profiles * self.points

    @property
    def question(self) -> Mapping[str, Any]:
        """Scene, its points, and number of profiles."""
        (scene,) = SCENES.dump_python((self.scene,), mode="json")
        return {"ensemble": scene, "points": self.points, "profiles": self.profiles}

    def solve(self) -> Outcome:
        """Solve all profiles at once: a row a profile."""
        found = solve_profiles([self.scene], [self.points], range(self.profiles))
        columns = found.friction[0].tolist(), found.depth[0].tolist(), found.sweeps[0].tolist()
        return Outcome(tuple(self._row(*numbers) for numbers in zip(*columns, strict=True)))

    def _row(self, friction, depth, sweeps):
        if isnan(friction):
            return Row(reason="no depth carries the load")
        load = self.scene.motion.load
        return Row(load, depth, load * friction, operator_applications=sweeps)

    def failed(self, reason: str) -> Outcome:
        """Outcome with a row for each profile, each with the reason."""
        return Outcome((Row(reason=reason),) * self.profiles)

    def fits(self, outcome: Outcome) -> bool:
        """Whether the outcome has a row for each profile."""
        return len(outcome.rows) == self.profiles
