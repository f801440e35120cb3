"""Rough series of a study: one scene at every speed and load or depth, rough and smooth, on the same surfaces."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import ClassVar

import xarray

from bem3d import BEM
from mdr1d import MDR
from scene import Program, Scene
from scene.files.reading import InvalidInput

from ...models.table import ModelLike, Models
from ...solving.curve import Curve, on_two_levels
from ...solving.folders import slug
from .answers import THEORIES, Answers, with_theory
from .claims_law import law_findings
from .measures import ROUGH, ROWS, SMOOTH
from .series import Counts, Judged, Series


@dataclass(frozen=True)
class RoughSeries(Series):
    """One rough scene at every speed and every load or depth, and the same body without its roughness.

    scene : its motion says whether load or depth is prescribed; the body of a Program is pressed in from first
        touch at a constant rate, and all other scenes slide. Every scene is also solved at rest
    speeds : of sliding, or the rates of pressing in [m/s]; none where only rest is asked for
    values : loads [N] or depths [m]
    surfaces, profiles : numbers of draws in 3D and in 1D, with the seeds from the seed of the scene on; where an
        interval is wanted, the least number of a pilot on its coarsest level
    bem, mdr : the finer settings; the coarser have half the points, and half the steps in time
    asked, reference : models and the reference among them, see `Models.of`; MDR and BEM if none is asked for
    """

    name: str
    title: str
    scene: Scene
    speeds: tuple[float, ...]
    values: tuple[float, ...]
    surfaces: int
    profiles: int
    bem: BEM
    mdr: MDR
    asked: tuple[ModelLike, ...] = ()
    reference: str = ""
    interval: float | None = None
    strata: Mapping[str, Counts] = field(default_factory=dict, hash=False)
    shared: ClassVar[Mapping[str, tuple[str, ...]]] = {ROUGH: (ROUGH,)}
    rows = ROWS
    by_speed = by_load = ROUGH
    bodies: ClassVar[Mapping[str, str]] = {ROUGH: "rough", SMOOTH: "smooth"}

    @property
    def folder(self) -> str:
        return "/".join(map(slug, self.name.split("/")))

    @property
    def draws(self) -> dict[str, int]:
        """Number of profiles or surfaces by the name of the model."""
        return {each.name: sum(map(len, self.curves[ROUGH].strata(each.name))) for each in self.models}

    @cached_property
    def every_model(self) -> Models:
        return Models.of(self.asked or None, self.reference or None, {"mdr": self.mdr, "bem": self.bem})

    @cached_property
    def models(self) -> Models:  # type: ignore[override]
        """Models with a claim on its contacts, which are compared. Raises InvalidInput."""
        return self.every_model.claiming(self.prescribed, self.slides)

    @property
    def pressed_in(self) -> bool:
        """Whether speeds are rates of pressing in."""
        return isinstance(self.scene.motion, Program)

    @property
    def slides(self) -> bool:
        """Whether speeds are those of sliding."""
        return bool(self.speeds) and not self.pressed_in

    @property
    def family(self) -> str:
        study, slash, _ = self.name.rpartition("/")
        return f"{study}{slash}every {type(self.scene.indenter).__name__.lower()}"

    @cached_property
    def curves(self) -> Mapping[str, Curve]:
        """Curves of the rough and of the smooth body; the first speed is rest. Raises InvalidInput."""
        if self.scene.roughness is None:
            raise InvalidInput(f"{self.title}: a series asks what roughness does, and this scene has none")
        counts = {each.name: each.count(self.profiles, self.surfaces) for each in self.models}
        rough = Curve(
            scene=self.scene,
            speeds=(0.0, *self.speeds),
            values=self.values,
            levels=on_two_levels(*(each.solver for each in self.models)),
            draws=counts,
        )
        smooth = replace(rough, scene=replace(self.scene, roughness=None))
        found = self.with_strata({ROUGH: rough, SMOOTH: smooth}, least=counts)
        return found | ({ROUGH: with_theory(found[ROUGH], THEORIES)} if self.slides else {})

    def judge(self, answers: Answers) -> Judged:
        found = super().judge(answers)
        if not self.slides:
            return found
        if self.models.reference not in found.laws:
            return Judged(self, answers)
        return replace(found, findings=[*found.findings, *law_findings(self, answers, found.laws)])


def sliding(dataset: xarray.Dataset) -> xarray.Dataset:
    """Dataset without the bodies at rest."""
    return dataset.isel(speed=slice(1, None))
