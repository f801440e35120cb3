"""A case: one scene, how it departs from the paper, what is varied around it, and the settings of both solvers."""

from collections.abc import Iterable
from dataclasses import fields
from math import nan, sqrt
from typing import Annotated, Any

import numpy as np
from pydantic import AfterValidator, BeforeValidator, Field, TypeAdapter, WithJsonSchema, model_validator
from pydantic.dataclasses import dataclass

from bem3d import BEM
from mdr1d import MDR
from scene import Coulomb, Doubt, Heating, Layer, Program, Refused, Scene, Slide
from scene.doubt import unseen
from scene.effects.temperature import Temperature
from scene.files.reading import InvalidInput
from scene.indenter import Indenter
from scene.motion import Motion
from scene.printable import brief
from scene.protocol import numeric_guard
from scene.quantities import BARE, CLOSED, ROW, Positive, Speed, Whole
from scene.scales import elastic_contact
from scene.scene import fit_together
from scene.signatures import readable
from scene.solids.rheology import Elastomer
from scene.surfaces.roughness import Roughness
from scene.terms import refused_parts

from ..solving.cost import MOST_DRAWS, MOST_VALUES


def _share(given: Any) -> float:
    """Share above 0 and below 1, of a number or a text as 2%. Raises ValueError."""
    found, why = nan, ""
    try:
        if isinstance(given, str):
            text = given.strip()
            found = float(text.removesuffix("%")) / (100 if text.endswith("%") else 1)
        else:
            found = BARE.value(given)
    except ValueError as error:
        why = f"; {error}"
    if not 0 < found < 1:
        raise ValueError(f"a share above 0 and below 1, as 2% or 0.02{why}")
    return found


def share_of(name: str, given: Any) -> float | None:
    """Share of an argument of that name; None where none is given. Raises InvalidInput."""
    try:
        return None if given is None else _share(given)
    except ValueError as error:
        raise InvalidInput(f"{name} = {brief(repr(given))}: {error}") from None


def _no_module(name: str) -> str:
    """Name of a model that a file may state: MODULE:NAME would run code of a stranger."""
    if ":" in name:
        raise ValueError(
            "a file may name models of this and of installed packages; MODULE:NAME is for --models on the command "
            "line, and for Python"
        )
    return name


Draws = Annotated[Whole, Field(ge=1, le=MOST_DRAWS)]
_WRITTEN = {"type": "string", "pattern": r"^\s*[0-9.]+\s*%\s*$", "examples": ["5%"]}
_NUMBER = {"type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": 1}
Share = Annotated[float, BeforeValidator(_share), WithJsonSchema({"anyOf": [_NUMBER, _WRITTEN]})]
Factors = Annotated[tuple[Positive, ...], ROW, Field(min_length=1, max_length=MOST_VALUES)]
MOST_MODELS = 8  # compared at once
INTERVAL = 0.05  # half-width that is wanted where a case states neither it nor numbers of surfaces
ModelNames = Annotated[tuple[Annotated[str, AfterValidator(_no_module)], ...], Field(max_length=MOST_MODELS)]
Speeds = Annotated[tuple[Speed, ...], ROW, Field(min_length=1, max_length=MOST_VALUES)]


class NotCompared(Refused):
    """The scene is of a kind that nothing compares, whatever its numbers; a solver may solve it from Python."""


def _rough(roughness):
    """Roughness of no height is none."""
    return None if roughness is None or roughness.flat else roughness


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Variations:
    """Variations around the scene. Whatever is absent follows from the scene; see `Case.plan`.

    speeds : of the curve of friction against speed [m/s]
    pressing : factors on the scene's load (or depth) for the curves of friction against load
    load_speeds : speeds of those curves [m/s]
    depths : of the force-depth curve, factors on the smooth elastic depth of the scene
    surfaces : rough surfaces averaged in three dimensions, 1 to 10,000; 3 if absent
    profiles : rough profiles averaged in one dimension, 1 to 10,000; 50 if absent
    interval : in place of both, the half-width of intervals of 95 % that is wanted, relative, as "3%"; 5 % if
        all three are absent; see `compare.run`
    """

    speeds: Speeds | None = None
    pressing: Factors | None = None
    load_speeds: Speeds | None = None
    depths: Factors | None = None
    surfaces: Draws | None = None
    profiles: Draws | None = None
    interval: Share | None = None

    @model_validator(mode="after")
    def _once_and_one_way_to_draw(self):
        for name in ("speeds", "pressing", "load_speeds", "depths"):
            values = getattr(self, name) or ()
            if len(set(values)) < len(values):
                raise ValueError(
                    f"{name} = {brief(repr(list(values)))}: a value stands there twice, once is allowed"
                )
        if self.interval is not None and (self.surfaces or self.profiles):
            raise ValueError(
                f"interval = {self.interval:g}: it takes the place of surfaces and profiles, leave them out"
            )
        return self


@dataclass(frozen=True)
class SamplePoints:
    """Values that are solved at: those of Variations, and smooth_speeds [m/s] of the smooth body."""

    speeds: tuple[float, ...]
    pressing: tuple[float, ...]
    load_speeds: tuple[float, ...]
    depths: tuple[float, ...]
    smooth_speeds: tuple[float, ...]
    surfaces: int
    profiles: int


@readable
@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Case:
    """The content of a case file. A file that holds a scene and nothing else is a case.

    title, notes : for the report, notes in a sentence each
    departures : of a case of the paper: sentences that say how the case departs from it
    indenter, elastomer, motion, roughness, layer, temperature, heating, interface : of the scene
    study : what is varied around it
    models : names of the models that are compared: mdr, bem, persson, law, extended, those of installed
        packages; mdr and bem if none is named
    reference : name of the one against which the others are judged; bem, or the last, if absent
    bem, mdr : settings of the solvers in three dimensions and in one
    """

    title: str = ""
    notes: tuple[str, ...] = ()
    departures: tuple[str, ...] = ()
    indenter: Indenter
    elastomer: Elastomer
    motion: Motion
    roughness: Annotated[Roughness | None, AfterValidator(_rough)] = None
    layer: Layer | None = None
    temperature: Temperature | None = None
    heating: Heating | None = None
    interface: Coulomb | None = None
    study: Variations = Variations()
    models: ModelNames = ()
    reference: str = ""
    bem: BEM = BEM(points=128)
    mdr: MDR = MDR(points=5000)

    _fits = model_validator(mode="after")(fit_together)

    @property
    def scene(self) -> Scene:
        return Scene(**{field.name: getattr(self, field.name) for field in fields(Scene)})

    @property
    def inputs(self) -> dict[str, Any]:
        """The case as JSON can hold it; a map of heights that was measured is held whole."""
        content = TypeAdapter(Case).dump_python(self, mode="json")
        for name, part in vars(self).items():
            if hasattr(part, "heights"):
                content[name] |= {"heights": np.asarray(part.heights.heights).tolist()}
        return content

    @property
    def doubts(self) -> tuple[Doubt, ...]:
        """Doubts about the scene, and about how well the grids of both solvers show it."""
        return tuple(dict.fromkeys([*self.mdr.doubts(self.scene), *self.bem.doubts(self.scene)]))

    @property
    def slides(self) -> bool:
        """Whether there is friction to speak of: sliding, on a solid that relaxes."""
        return isinstance(self.motion, Slide) and len(self.scene.solid.retardation()[2]) > 0

    @property
    def interval(self) -> float | None:
        """Half-width that is wanted of intervals of 95 %, relative; None where numbers of surfaces are stated.

        It is None of a body without draws, and of contacts in time, whose numbers are fixed.
        """
        given = self.study
        drawn = hasattr(self.roughness, "seed") and not isinstance(self.motion, Program)
        return given.interval or (INTERVAL if drawn and not (given.surfaces or given.profiles) else None)

    def refuse(self) -> None:
        """Raise NotCompared, with the reasons, if a solver lacks a part of the scene."""
        for solver in (self.mdr, self.bem):
            with numeric_guard():
                reasons = refused_parts(solver.terms, self.scene)
            if reasons:
                raise NotCompared(f"{solver.name} cannot solve this scene: {'; '.join(reasons)}")

    def plan(self) -> SamplePoints:
        """Plan of what is given in [study], the rest derived from the scene.

        Speeds are multiples of the scene's own (at rest: of a tenth of a/tau); the curves of friction against load
        span two decades of load; only what slides has speeds. Raises Refused.
        """
        self.refuse()
        given = self.study
        depths = given.depths or (0.25, 0.5, 1.0, 1.5, 2.0)
        surfaces, profiles = (given.surfaces or 3, given.profiles or 50) if self.roughness else (1, 1)
        if not self.slides or self.interface is not None:
            return SamplePoints((), (), (), depths, (), surfaces, profiles)
        contact = elastic_contact(self.scene)
        times = self.scene.solid.retardation()[2]
        natural = contact.radius / float(max(times))
        own = self.motion.speed or natural / 10
        return SamplePoints(
            speeds=given.speeds or tuple(own * f for f in (0.03, 0.1, 0.3, 1.0, 3.0, 10.0)),
            pressing=given.pressing or self._pressing(),
            load_speeds=given.load_speeds or (own / 3, own, own * 3),
            depths=depths,
            smooth_speeds=tuple(natural * f for f in (0.01, 0.1, 1.0, 10.0, 100.0)) if len(times) == 1 else (),
            surfaces=surfaces,
            profiles=profiles,
        )

    def _pressing(self):
        loads = (0.1, 1 / sqrt(10), 1.0, sqrt(10), 10.0)
        if self.motion.load is not None:
            return loads
        n = self.indenter.exponent
        return tuple(load ** (n / (n + 1)) for load in loads)


def doubted(*cases: Case, curves: Iterable[Scene] = ()) -> tuple[str, ...]:
    """Doubts about cases as sentences: the first one for each number and limit.

    curves : further contacts, searched only for frequencies that a table of moduli does not show
    """
    sentences: dict[tuple[str, float], str] = {}
    beyond = sorted((doubt for scene in curves for doubt in unseen(scene)), key=lambda each: -each.number)
    for each in (*(doubt for case in cases for doubt in case.doubts), *beyond):
        sentences.setdefault((each.name, each.limit), str(each))
    return tuple(sentences.values())
