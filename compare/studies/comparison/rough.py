"""Rough series of a study: one scene at every speed and load or depth, rough and smooth, on the same surfaces."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, ClassVar

import xarray

from bem3d import BEM
from mdr1d import MDR
from scene import Program, Scene
from scene.reading import InvalidInput

from ...library.describe import slug
from ...models import exact
from ...models.table import FRICTION as OF_FRICTION
from ...models.table import PROFILES, ModelLike, Models
from ...solving.curve import COARSE, FINE, Curve, of_model, on_two_levels
from ...statistics import eq23
from ...statistics.collapse import Collapse, collapse
from ...statistics.finding import Finding, said_of
from ...statistics.frictioncurves import SimulatedCurves
from ...statistics.jackknife import measured
from .answers import Answers
from .claims import claim
from .claims_law import law_findings
from .laws import Laws, laws
from .measures import BOTH, DEPTHS, FRICTIONS, MARCHES, REST, SLOW_DRAG, Here, Row
from .series import Counts, Judged, Series, on_levels_alike
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
    strata: Mapping[str, Counts] = field(default_factory=dict)
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

    @cached_property
    def every_model(self) -> Models:
        """Models that are asked for. Raises InvalidInput."""
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
    def shape(self) -> str:
        """Kind of its body, in words."""
        return type(self.scene.indenter).__name__.lower()

    @property
    def family(self) -> str:
        study, slash, _ = self.name.rpartition("/")
        return f"{study}{slash}every {self.shape}"

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
        if self.interval is not None:
            strata = self.strata.get(ROUGH, {})
            rough = on_levels_alike({ROUGH: rough}, self.models, strata, least=counts)[ROUGH]
        return {ROUGH: with_theory(rough, THEORIES) if self.slides else rough, SMOOTH: smooth}

    def at(self, value: float, speed: float = 0.0) -> Scene:
        """The rough scene under one load or depth, at rest or at a speed."""
        return self.curves[ROUGH].at(value, speed)

    def answers(self, tree: xarray.DataTree) -> Answers:
        found = super().answers(tree)
        return replace(found, curves={name: self._with_drag(each) for name, each in found.curves.items()})

    def _with_drag(self, dataset):
        """Friction force over speed and mean lag, as the speed tends to zero, from the contact at rest [N/m]."""
        force, drag = dataset["normal_force"], []
        for model in self.models:
            own = dataset.sel(model=model.name)
            if model.draws != PROFILES and "curvature_by_pressure" in own:
                curvature = own["curvature_by_pressure"]
                drag.append(exact.slow_friction_by_curvature(1.0, 1.0, force.sel(model=model.name), curvature))
            elif {"rms_slope_contact", "contact_length"} <= {*own.data_vars}:
                slope, length = own["rms_slope_contact"], own["contact_length"]
                modulus = self.scene.elastomer.indentation_modulus
                drag.append(exact.slow_friction_by_slope(1.0, 1.0, modulus, slope, length))
        if not drag:
            return dataset
        return dataset.assign(
            {SLOW_DRAG: xarray.concat(drag, "model", join="outer", coords="minimal", compat="override")}
        )

    def theories(self, answers: Answers) -> Mapping[str, xarray.Dataset]:
        """Rough points that slide of theories beside the models, or of the models that they are, by name."""
        names = [each.name for each in THEORIES if answers.has(ROUGH, each.name)]
        return {name: sliding(of_model(answers.curves[ROUGH], name).sel(level=FINE)) for name in names}

    def judge(self, answers: Answers) -> Judged:
        """Findings for the claims that it asks for."""
        if not self.slides:
            places = [Here(self, None, each) for each in self.models]
            return Judged(self._asked(DEPTH, self._found(answers, (*DEPTHS, *REST, *MARCHES), places)))
        found = {each.name: laws(self, answers, each.name) for each in self.models if OF_FRICTION in each.answers}
        ruled = {model: each for model, each in found.items() if each is not None}
        if self.models.reference not in ruled or not set(found) & set(SOLVERS) <= set(ruled):
            return Judged(())
        shifted = {name: both for name in ruled if (both := collapses(answers, name)) is not None}
        shifts = [each for name in ruled for each in self._shifts(name, shifted.get(name), ruled[name])]
        shifts += law_findings(self, answers, ruled)
        places = [Here(self, ruled[name], self.models[name]) for name in ruled]
        friction = self._found(answers, (*FRICTIONS, *BOTH, *REST), places)
        findings = [*self._asked(COLLAPSE, shifts), *self._asked(FRICTION, friction)]
        collapsed = {name: fine for name, (fine, _) in shifted.items()}
        return Judged(findings, collapsed, ruled)

    def _asked(self, kind: str, found: Iterable[Finding]) -> list[Finding]:
        """Findings of a kind that is asked; what compares the dimensionalities is a kind of its own."""
        return [each for each in found if (PAIRS if "/" in each.dimension else kind) in self.claims]

    def _found(self, answers: Answers, rows: Iterable[Row], places: list[Here]) -> Iterator[Finding]:
        """Findings of rows of claims where they can be stated, on each model or on each against the reference."""
        (reference,) = (each for each in places if each.model.name == self.models.reference)
        rows = list(rows)
        for here in places:
            for row in rows:
                if not row.pair:
                    yield from self._row(answers, row, here, here.model.name)
        for row in rows:
            if row.pair:
                for model in self.models.judged:
                    quantity = row.quantity or reference.pressed
                    if quantity in model.answers and quantity in reference.model.answers:
                        yield from self._row(answers, row, reference, model.name, reference.model.name)

    def _row(self, answers, row: Row, here: Here, *models: str) -> Iterator[Finding]:
        beside = self.models.beside(models[0]) if row.pair else here.model.label
        for suffix, place, expected in row.where(here):
            there = replace(here, place=place)

            def measure(sample, there=there):
                return row.measure(there, *(sample[each] for each in models))

            name = row.id.format(quantity=here.pressed) + suffix
            asked = claim(name, measure, beside, expected)
            asked = said_of(asked, beside) if row.pair else asked
            fine, coarse = (answers.sample(level, row.body, *models) for level in (FINE, COARSE))
            yield replace(measured(asked, fine, coarse, self.name, there.regime), curve=self.place(row.body))

    def _shifts(self, model: str, both: tuple[Collapse, Collapse] | None, own: Laws) -> Iterator[Finding]:
        """Whether curves fall onto one, with the shifts that are best and with those predicted."""
        label = self.models.labels[model]
        place: dict[str, Any] = {"where": self.name, "draws": self.draws[model], "regime": own.words()}
        if both is not None:
            shifts = dict(zip(self.speeds, own.shifts.tolist(), strict=True))
            yield from eq23.findings(*both, label, shifts, own.exponent, curve=self.place(ROUGH), **place)
        elif eq23.shiftable(len(self.speeds), len(self.values)):
            yield eq23.too_few(label, **place)


def collapses(answers: Answers, model: str) -> tuple[Collapse, Collapse] | None:
    """Collapse of the curves of the rough body on both levels; None where points are too few."""
    both = (SimulatedCurves.of(sliding(answers(ROUGH, model, level))) for level in (FINE, COARSE))
    try:
        fine, coarse = map(collapse, both)
    except ValueError:
        return None
    return fine, coarse


def sliding(dataset: xarray.Dataset) -> xarray.Dataset:
    """Dataset without the bodies at rest."""
    return dataset.isel(speed=slice(1, None))
