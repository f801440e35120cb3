"""A ball that slides on a layer, solved smooth; friction of its roughness follows from the pressure by the law."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from math import pi, sqrt
from typing import Any

from bem3d import BEM
from scene import Result, Scene, SelfAffine, SolveError

from ...models.law.bands import Bands, FullContact
from ...models.law.share import Share
from ...solving.outcome import Outcome, Row, row
from ...solving.task import SCENES, SceneTask

bands_of = lru_cache(maxsize=64)(Bands.of)


@dataclass(frozen=True)
class RoughBall:
    """A task, see `task.Task`: one smooth contact, a row for each roughness.

    scene : of the smooth ball; spectra : of its roughness; points : a side

    mu = mu_smooth + (1/F_N) int F_full S(p/p_rms) dA over the pressure of each pixel, see `FrictionLaw`, without
    the waves on which the contact rides. Unlike there, roughness does not widen the contact: the nominal pressure
    is the smooth one, to about the rms height over the depth.
    """

    scene: Scene
    spectra: tuple[SelfAffine, ...]
    points: int
    keeps_fields = False
    packages = ("scene", "bem3d", "compare.models.exact", "compare.models.law", "compare.studies.experiment.contact")

    @property
    def label(self) -> str:
        """Short description for people."""
        return SceneTask(BEM(), (self.scene,)).label

    @property
    def work(self) -> float:
        """Rough cost, in passes over a point of a grid."""
        return 2e6 + 60.0 * self.points**2

    @property
    def question(self) -> Mapping[str, Any]:
        """Scenes, rough each, and points."""
        scenes = tuple(replace(self.scene, roughness=each) for each in self.spectra)
        return {"ball": SCENES.dump_python(scenes, mode="json"), "points": self.points}

    def solve(self) -> Outcome:
        """Solve the smooth contact, and add each roughness."""
        try:
            return self._of(BEM(points=self.points).solve(self.scene))
        except SolveError as error:
            return self.failed(str(error) or type(error).__name__)

    def _of(self, found: Result) -> Outcome:
        """Rows of the solved smooth contact."""
        scene = self.scene
        pressure, area = found.fields["pressure"], found.measures["pixel"] ** 2
        pressure = pressure[pressure > 0]
        radius, smooth, rows = sqrt(found.measures["contact_area"] / pi), row(found), []
        for each in self.spectra:
            full = FullContact.of(bands_of(each).beneath(radius), scene.solid, scene.motion.speed)
            rms = float(full.pressure[-1])
            rough = float(full.friction.sum() * Share.of(full)(pressure / rms).sum() * area)
            told = {
                "friction_of_shape": smooth.friction_force,
                "friction_of_roughness": rough,
                "pressure_ratio": float(pressure.mean()) / rms,
                "contact_area": found.measures["contact_area"],
            }
            rows.append(replace(smooth, friction_force=smooth.friction_force + rough, measures=told))
        return Outcome(tuple(rows))

    def failed(self, reason: str) -> Outcome:
        """Outcome with the reason in each row."""
        return Outcome((Row(reason=reason),) * len(self.spectra))

    def fits(self, outcome: Outcome) -> bool:
        """Whether there is a row for each roughness."""
        return len(outcome.rows) == len(self.spectra)
