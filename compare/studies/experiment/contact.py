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
    packages = ("scene", "bem3d", "compare.models.exact", "compare.models.law", __name__)

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
            found = BEM(points=self.points).solve(self.scene)
        except SolveError as error:
            return self.failed(str(error) or type(error).__name__)
        return Outcome(tuple(self._rough(found, each) for each in self.spectra))

    def _rough(self, found: Result, roughness: SelfAffine) -> Row:
        """Row of the solved smooth contact with a roughness."""
        smooth, pressure, area = row(found), found.fields["pressure"], found.measures["contact_area"]
        pressure = pressure[pressure > 0]
        waves = bands_of(roughness).beneath(sqrt(area / pi))
        full = FullContact.of(waves, self.scene.solid, self.scene.motion.speed)
        rms = float(full.pressure[-1])
        share = float(Share.of(full)(pressure / rms).sum())
        rough = float(full.friction.sum()) * share * found.measures["pixel"] ** 2
        told = {
            "friction_of_shape": smooth.friction_force,
            "friction_of_roughness": rough,
            "pressure_ratio": float(pressure.mean()) / rms,
            "contact_area": area,
        }
        return replace(smooth, friction_force=smooth.friction_force + rough, measures=told)

    def failed(self, reason: str) -> Outcome:
        """Outcome with the reason in each row."""
        return Outcome((Row(reason=reason),) * len(self.spectra))

    def fits(self, outcome: Outcome) -> bool:
        """Whether there is a row for each roughness."""
        return len(outcome.rows) == len(self.spectra)
