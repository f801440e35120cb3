"""Study files: series of contacts stated in TOML, those of the package and a user's own, at each size."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass as plain
from dataclasses import fields, replace
from functools import partial
from typing import Annotated, Any, Generic, Literal, TypeAlias, TypeVar, get_args

import numpy as np
from pydantic import AfterValidator, Discriminator, Field, Tag, model_validator
from pydantic.dataclasses import dataclass

from bem3d import BEM
from mdr1d import MDR
from scene import (
    Cone,
    Indent,
    PowerLaw,
    Program,
    Refused,
    Scene,
    SelfAffine,
    Slide,
    SolveError,
    Sphere,
    Stage,
)
from scene.files import files
from scene.files.reading import CHOICE, InvalidInput, invalid, made, parsed
from scene.quantities import CLOSED, Force, Length, Speed, Whole
from scene.scales import elastic_contact
from scene.solids.rheology import Elastomer

from ...library.case import Draws, ModelNames, Share
from ...library.ready import CLAIMS, find, ready
from ...solving.cost import MOST_VALUES
from ...solving.folders import folders
from .rough import RoughSeries as Series

Size = Literal["quick", "standard", "full"]
SIZES: tuple[Size, ...] = get_args(Size)
MOST_SERIES = 100  # of a file
# Of each pair one is stated: where a series does, it takes the place of the other stated for all.
INSTEAD = {"loads": "depths", "depths": "loads", "speeds": "rates", "rates": "speeds"}
TABLES = "indenter", "elastomer", "roughness"  # of a ready scene

Quantity = TypeVar("Quantity")
Partly: TypeAlias = Quantity | dict[str, Any] | None  # a table that others complete
Body = Annotated[Sphere | Cone | PowerLaw, Field(discriminator="type")]
ReadyScene: Any = Literal[tuple(name for name, each in ready().items() if each.kind == "scene")]


@plain(frozen=True)
class ReadyStudy:
    """A question, and the series that are solved for it.

    title, about : for people
    series : by the name of a size
    """

    title: str
    about: str
    series: Callable[[str], Sequence[Series]]


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Range(Generic[Quantity]):
    """Numbers in equal ratios.

    least, greatest : the ends
    count : how many, at most 1000; absent, it follows from the size of the study
    """

    least: Quantity | None = None
    greatest: Quantity | None = None
    count: Annotated[Whole, Field(ge=2, le=MOST_VALUES)] | None = None


_RANGE, _LIST = f"{CHOICE}range", f"{CHOICE}list"
_List = Annotated[tuple[Quantity, ...], Field(min_length=1, max_length=MOST_VALUES), Tag(_LIST)]
Numbers = Annotated[
    Annotated[Range[Quantity], Tag(_RANGE)] | _List[Quantity],
    Discriminator(lambda given: _RANGE if isinstance(given, dict | Range) else _LIST),
]


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class _Asked:
    """Fields that are no tables of a scene, and no settings."""

    speeds: Numbers[Speed] | None = None
    rates: Numbers[Speed] | None = None
    loads: Numbers[Force] | None = None
    depths: Numbers[Length] | None = None
    prescribed: Literal["depth"] | None = None
    interval: Share | None = None


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Stated(_Asked):
    """Fields that a study states for all of its series, or each of them for itself, at all sizes or at one.

    scene : name of a ready scene, from which every table is taken that is not stated
    indenter, elastomer, roughness : as in a scene; what a series states takes the place of what is
        stated for all, name by name, unless it states another type. Bodies are spheres, cones and power laws, and
        roughness is self-affine
    speeds : of sliding [m/s], two at least; with rates absent too, the bodies are at rest
    rates : of pressing in [m/s], to the depths
    loads, depths : what presses [N], [m]: one of them
    prescribed : "depth": in place of the loads, the depths that the smooth relaxed body has under them
    surfaces, profiles : drawn in three and in one dimension, at most 10,000; with an interval, at least, on the
        coarsest grid; absent, as many as the size of the study has
    interval : the half-width of intervals of 95 % that is wanted of claims, relative, as "5%"
    bem, mdr : settings of the solvers on the finer grid; the coarser has half the points
    """

    scene: ReadyScene = None
    surfaces: Draws | None = None
    profiles: Draws | None = None
    indenter: Partly[Body] = None
    elastomer: Partly[Elastomer] = None
    roughness: Partly[SelfAffine] = None
    bem: Partly[BEM] = None
    mdr: Partly[MDR] = None


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Sizes:
    """Settings of a study at one size, which replace those of all sizes.

    quick, standard, full : of the option --size
    """

    quick: Stated | None = None
    standard: Stated | None = None
    full: Stated | None = None


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class OwnSeries(Stated):
    """One series of a study.

    name : of its folder
    title : for people; the name if absent
    only : sizes at which it is solved; absent, all of them
    sizes : what it states at one size alone
    """

    name: Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_.-]*$")]
    title: str = ""
    only: tuple[Size, ...] = SIZES
    sizes: Sizes = Sizes()


def _in_own_folders(series):
    folders([own.name for own in series], "series")
    return series


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class StudyFile(Stated):
    """A study of the user's own: what all series share, and the series.

    title, about : for people
    models, reference : names of the models that are compared, and of the one against which the others are judged;
        mdr and bem, and bem, if absent
    sizes : what all series share at one size alone
    series : 1 to 100
    """

    title: str
    about: str = ""
    models: ModelNames = ()
    reference: str = ""
    sizes: Sizes = Sizes()
    series: Annotated[
        tuple[OwnSeries, ...], Field(min_length=1, max_length=MOST_SERIES), AfterValidator(_in_own_folders)
    ]


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class _Complete(_Asked):
    """A series at one size, once everything is put together."""

    indenter: Body
    elastomer: Elastomer
    roughness: SelfAffine
    surfaces: Draws
    profiles: Draws
    bem: BEM
    mdr: MDR = MDR()

    @model_validator(mode="after")
    def _fits_together(self):
        if why := next(self._misfits(), None):
            raise ValueError(why)
        return self

    def _misfits(self) -> Iterator[str]:
        """Contradictions between the fields."""
        if self.roughness.flat:
            yield "roughness.rms_height = 0: a study asks what roughness does"
        if (self.loads is None) == (self.depths is None):
            yield f"loads, depths: {'none' if self.loads is None else 'both'} given, give exactly one of them"
        if self.speeds and self.rates:
            yield "speeds, rates: both given, give at most one of them"
        for name in INSTEAD:
            given = getattr(self, name)
            values = _numbers(given)
            if given and (not values or list(values) != sorted(set(values))):
                yield f"{name}: both ends of a range, or a list, from the least to the greatest, each once"
        if self.rates and self.loads and not self.prescribed:
            yield "rates: a body pressed in at a rate is pressed to depths, give depths"
        if self.speeds and len(_numbers(self.speeds)) < 2:
            yield "speeds: at least two, or none for bodies at rest"
        for name, points, least in (("bem", self.bem.points, 32), ("mdr", self.mdr.points, 16)):
            if points < least:
                yield f"{name}.points = {points}: at least {least}, as the coarser grid has half of them"
        if (self.speeds or self.rates) and self.elastomer.type == "elastic":
            yield "speeds, rates: an elastic solid loses nothing, whatever the speed, leave them out"

    def series(self, own: OwnSeries, shared: StudyFile, size: str) -> Series:
        """The series, as it is solved and judged."""
        many, several, *_ = USUAL[size]
        speeds, values = _numbers(self.speeds or self.rates, many), _numbers(self.loads or self.depths, several)
        prescribed = "load" if self.loads else "depth"
        scene = Scene(self.indenter, self.elastomer, Indent(depth=1.0), self.roughness)
        if self.loads and self.prescribed:
            pressed = (replace(scene, motion=Indent(load=load)) for load in values)
            values, prescribed = tuple(elastic_contact(each).depth for each in pressed), self.prescribed
        press: dict[str, Any] = {prescribed: values[0]}
        motion: Indent | Slide | Program = Indent(**press)
        if self.speeds:
            motion = Slide(speed=speeds[0], **press)
        elif self.rates:
            motion = Program(stages=(Stage(duration=1.0, **press),))
        return Series(
            own.name,
            own.title or own.name,
            replace(scene, motion=motion),
            speeds,
            values,
            surfaces=self.surfaces,
            profiles=self.profiles,
            bem=self.bem,
            mdr=self.mdr,
            asked=shared.models,
            reference=shared.reference,
            interval=self.interval,
        )


FIELDS = [field.name for field in fields(_Complete)]
# What holds at a size where a file states nothing else: speeds or rates, loads or depths, surfaces, profiles, and
# points of a side in three dimensions.
USUAL = {"quick": (6, 4, 3, 12, 128), "standard": (12, 8, 10, 60, 256), "full": (20, 16, 40, 200, 512)}


def study_of(text: str, name: str) -> ReadyStudy:
    """A study by the text of its file. Raises InvalidInput; its series at a size do so of what is stated there.

    name : of the file, for mistakes
    """
    file: StudyFile = made(parsed(text, name), StudyFile, name)
    return ReadyStudy(file.title, file.about, partial(_series, text, name))


def _series(text: str, name: str, size: str) -> Sequence[Series]:
    """Series of a file at a size. Raises InvalidInput naming every mistake."""
    content, found, lines = parsed(text, name), list[Series](), list[str]()
    with files.paths_from(name):
        file: StudyFile = made(content, StudyFile, name)
        for number, (own, stated) in enumerate(zip(file.series, content["series"], strict=True)):
            if size not in own.only:
                continue
            place = f"series.{number}"
            try:
                series = made(_put_together(content, stated, size), _Complete, place).series(own, file, size)
                series.curves  # noqa: B018 - refuses what cannot be solved on two grids
                found.append(series)
            except InvalidInput as error:
                lines += [f"{place}: {each.removeprefix(f'{place}: ')}" for each in str(error).splitlines()]
            except (Refused, SolveError, ArithmeticError) as error:
                lines.append(f"{place}: {error}")
    if lines:
        raise invalid(name, lines)
    return found


def _put_together(content: dict, own: dict, size: str) -> dict:
    """Fields of a series at a size: what is usual, what all share, what it states; at all sizes, then at this."""
    *_, surfaces, profiles, points = USUAL[size]
    whole: dict[str, Any] = {"surfaces": surfaces, "profiles": profiles, "bem": {"points": points}}
    for part in (content, own):
        whole = _over(_over(whole, part), part.get("sizes", {}).get(size, {}))
    # A range that states nothing but its number of points counts as absent.
    none = [name for name in INSTEAD if [*whole.get(name, ())] == ["count"]]
    return {name: whole[name] for name in FIELDS if name in whole and name not in none}


def _over(below: dict, above: dict) -> dict:
    """Fields over others: tables name by name, unless they state another type."""
    found = {name: value for name, value in below.items() if INSTEAD.get(name) not in above}
    if "scene" in above:
        base = parsed(find(above["scene"]).text, above["scene"])
        found |= {name: base.get(name) for name in TABLES}
    for name, value in above.items():
        under = found.get(name)
        same = (
            isinstance(under, dict) and isinstance(value, dict) and value.get("type") in (None, under.get("type"))
        )
        found[name] = under | value if same else value
    return found


def _numbers(given: Any, usual: int = 2) -> tuple[float, ...]:
    """Numbers of a list, of a range that has both ends, or none. usual : how many, where a range states none"""
    if isinstance(given, Range):
        ends: Any = given.least, given.greatest, given.count or usual
        return () if None in ends else tuple(np.geomspace(*ends).tolist())
    return given or ()


STUDIES = {
    each.name: ReadyStudy(each.title, each.about, partial(_series, each.text, each.name))
    for each in map(find, CLAIMS)
}
