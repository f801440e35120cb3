"""Rough series of a study: one scene at every speed and load or depth, rough and smooth, on the same surfaces."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from itertools import product
from typing import ClassVar

import xarray

from bem3d import BEM
from mdr1d import MDR
from scene import Program, Scene
from scene.files.reading import InvalidInput

from ...library.describe import slug
from ...models.table import FRICTION as OF_FRICTION
from ...models.table import Model, ModelLike, Models
from ...solving.curve import Curve, on_two_levels
from ...statistics.collapse import Collapse
from ...statistics.finding import Finding
from .answers import Answers
from .claims_law import law_findings
from .laws import Laws, laws
from .measures import BOTH, DEPTHS, FRICTIONS, MARCHES, REST, Here, Row
from .series import Counts, Judged, Series
from .theory import THEORIES, with_theory

ROUGH, SMOOTH = BODIES = "rough", "smooth"
# Kinds of claims: shifts of curves (Eq. 23), friction in each dimensionality (Eqs. 14 to 19), depth and force in
# each, all that compares the dimensionalities, and what compares several series.
COLLAPSE, FRICTION, DEPTH, PAIRS, FAMILIES = KINDS = "collapse", "friction", "depth", "dimensions", "families"
SOLVERS = {"MDR": "1D", "BEM": "3D"}


@dataclass(frozen=True)
class RoughSeries(Series):
    """One rough scene at every speed and every load or depth, and the same body without its roughness.

    scene : its motion says whether load or depth is prescribed; that of a Program is pressed in from nothing at a
        constant rate, and all other scenes slide. Every scene is also solved at rest
    speeds : of sliding, or the rates of pressing in [m/s]; none where only rest is asked for
    values : loads [N] or depths [m]
    surfaces, profiles : drawn in three and in one dimension, with the seeds from that of the scene on; where an
        interval is wanted, of a pilot at least so many on its coarsest level
    bem, mdr : the finer settings; the coarser have half the points, and half the steps in time
    note : what is to be said of it on the page
    claims : which kinds of claims are judged, out of KINDS
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
    note: str = ""
    claims: tuple[str, ...] = KINDS
    asked: tuple[ModelLike, ...] = ()
    reference: str = ""
    interval: float | None = None
    strata: Mapping[str, Counts] = field(default_factory=dict, hash=False)
    shared: ClassVar[Mapping[str, tuple[str, ...]]] = {ROUGH: (ROUGH,)}

    @property
    def folder(self) -> str:
        return "/".join(map(slug, self.name.split("/")))

    @property
    def prescribed(self) -> str:
        """Name of what is prescribed: "load" or "depth"."""
        return self.scene.motion.pressed_by

    @property
    def draws(self) -> dict[str, int]:
        """Number of profiles or surfaces by the name of the model."""
        return {each.name: sum(map(len, self.curves[ROUGH].strata(each.name))) for each in self.models}

    @property
    def remarks(self) -> Sequence[str]:
        return (self.note,) if self.note else ()

    @cached_property
    def every_model(self) -> Models:
        return Models.of(self.asked or None, self.reference or None, {"mdr": self.mdr, "bem": self.bem})

    @cached_property
    def models(self) -> Models:  # type: ignore[override]
        """Models with a claim on its contacts, which are compared. Raises InvalidInput."""
        return self.every_model.telling(self.prescribed, self.slides)

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

    def at(self, value: float, speed: float = 0.0) -> Scene:
        """The rough scene under one load or depth, at rest or at a speed."""
        return self.curves[ROUGH].at(value, speed)

    def judge(self, answers: Answers) -> Judged:
        """Findings for the claims that it asks for."""
        if not self.slides:
            places = [Here(self, None, each) for each in self.models]
            return Judged([*self._found(answers, DEPTH, (*DEPTHS, *REST, *MARCHES), places)])
        rubbing = [each.name for each in self.models if OF_FRICTION in each.answers]
        ruled = {name: found for name in rubbing if (found := laws(self, answers, name)) is not None}
        if not {self.models.reference} | (set(SOLVERS) & set(rubbing)) <= set(ruled):
            return Judged(())
        places = [Here(self, found, self.models[name]) for name, found in ruled.items()]
        friction = self._found(answers, FRICTION, (*FRICTIONS, *BOTH, *REST), places)
        asked = ruled if COLLAPSE in self.claims else {}
        shifted = {name: self._shifts(answers, self.models[name], own) for name, own in asked.items()}
        findings = [each for _, found in shifted.values() for each in found]
        findings += [*(law_findings(self, answers, asked) if asked else ()), *friction]
        return Judged(findings, {name: fine for name, (fine, _) in shifted.items() if fine is not None}, ruled)

    def _shifts(self, answers: Answers, model: Model, own: Laws) -> tuple[Collapse | None, list[Finding]]:
        """Whether curves fall onto one, with the shifts that are best and with those predicted."""
        shifts = dict(zip(self.speeds, own.shifts.tolist(), strict=True))
        return self.shifted(answers, ROUGH, model, shifts, own.exponent, own.words())

    def _found(
        self, answers: Answers, kind: str, rows: Iterable[Row], places: Sequence[Here]
    ) -> Iterator[Finding]:
        """Findings of rows of claims that are asked for, on each model or on each against the reference.

        kind : of claims on one model; those that compare two are a kind of their own
        """
        rows = [row for row in rows if (PAIRS if row.pair else kind) in self.claims]
        (reference,) = (each for each in places if each.model.name == self.models.reference)
        for here, row in product(places, rows):
            if not row.pair:
                yield from self._row(answers, row, here, here.model.name)
        for row, model in product(rows, self.models.judged):
            quantity = row.quantity or reference.pressed
            if row.pair and quantity in model.answers and quantity in reference.model.answers:
                yield from self._row(answers, row, reference, model.name, reference.model.name)

    def _row(self, answers, row: Row, here: Here, *models: str) -> Iterator[Finding]:
        for suffix, place, expected in row.where(here):
            there = replace(here, place=place)
            name = row.id.format(quantity=here.pressed) + suffix
            measure = partial(row.measure, there)
            yield self.measured(answers, name, row.body, models, measure, expected, there.regime)


def sliding(dataset: xarray.Dataset) -> xarray.Dataset:
    """Dataset without the bodies at rest."""
    return dataset.isel(speed=slice(1, None))
