"""Study file: series of contacts that a user states in TOML, solved and judged as those of the package."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass as plain
from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, Tag, ValidationError, model_validator
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
    files,
)
from scene.mistakes import CHOICE, Mistake, examined
from scene.printable import brief
from scene.quantities import CLOSED, Force, Length, Speed, Whole
from scene.reading import InvalidInput, invalid, parsed, validator
from scene.rheology import Elastomer
from scene.temperature import Temperature

from ...library.case import Draws, ModelNames, Share
from ...library.describe import folders
from ...library.ready import NotReady, find
from ...solving.cost import MOST_VALUES
from .catalogue import SIZES, ReadyStudy
from ...comparison.curve import refuse
from ...comparison.rough import KINDS
from ...comparison.rough import RoughSeries as Series
from .sizes import Size, between

Several = Annotated[Whole, Field(ge=2, le=MOST_VALUES)]
Body = Annotated[Sphere | Cone | PowerLaw, Field(discriminator="type")]
_RANGE, _LIST = f"{CHOICE}range", f"{CHOICE}list"
MOST_SERIES = 100  # of a file
_TABLES = ("indenter", "elastomer", "roughness", "temperature")


class _Range:
    """Numbers in equal ratios.

    least, greatest : the ends
    count : how many, at most 1000; absent, it follows from the size of the study
    """

    least: float
    greatest: float
    count: int | None

    @model_validator(mode="after")
    def _in_order(self):
        if not self.least < self.greatest:
            raise ValueError(f"greatest = {self.greatest:g} must exceed least = {self.least:g}")
        return self

    def values(self, count: int) -> tuple[float, ...]:
        """Number that is stated, else the given one."""
        return between(self.least, self.greatest, self.count or count)


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class SpeedRange(_Range):
    __doc__ = _Range.__doc__
    least: Speed
    greatest: Speed
    count: Several | None = None


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class LoadRange(_Range):
    __doc__ = _Range.__doc__
    least: Force
    greatest: Force
    count: Several | None = None


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class DepthRange(_Range):
    __doc__ = _Range.__doc__
    least: Length
    greatest: Length
    count: Several | None = None


def _choice(given: Any) -> str:
    return _RANGE if isinstance(given, dict | _Range) else _LIST


_SOME = Field(min_length=1, max_length=MOST_VALUES)
SpeedList = Annotated[tuple[Speed, ...], _SOME, Tag(_LIST)]
LoadList = Annotated[tuple[Force, ...], _SOME, Tag(_LIST)]
DepthList = Annotated[tuple[Length, ...], _SOME, Tag(_LIST)]
Speeds = Annotated[Annotated[SpeedRange, Tag(_RANGE)] | SpeedList, Discriminator(_choice)]
Loads = Annotated[Annotated[LoadRange, Tag(_RANGE)] | LoadList, Discriminator(_choice)]
Depths = Annotated[Annotated[DepthRange, Tag(_RANGE)] | DepthList, Discriminator(_choice)]
Claim = Literal["collapse", "friction", "depth", "dimensions", "families"]
Claims = Annotated[tuple[Claim, ...], Field(min_length=1)]


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class _Shared:
    """Fields that a study states for all of its series, or each of them for itself.

    scene : name of a ready scene, from which every table is taken that is not stated
    indenter, elastomer, roughness, temperature : as in a scene; what a series states takes the place of what is
        stated for all, name by name, unless it states another type. Bodies are spheres, cones and power laws, and
        roughness is self-affine
    speeds : of sliding [m/s], two at least; with rates absent too, the bodies are at rest
    rates : of pressing in [m/s], to the depths
    loads, depths : what presses [N], [m]: one of them
    surfaces, profiles : drawn in three and in one dimension, at most 10,000; absent, as many as the size of the
        study has
    interval : in place of both, the half-width of intervals of 95 % that is wanted of claims, relative, as "5%"
    claims : which are judged: "collapse" (Eq. 23), "friction" (Eqs. 14 to 19), "depth" (at rest, and pressed in),
        "dimensions" (1D against 3D), "families" (several series together); absent, all of them
    bem, mdr : settings of the solvers on the finer grid; the coarser has half the points
    """

    scene: str | None = None
    indenter: Body | dict[str, Any] | None = None
    elastomer: Elastomer | dict[str, Any] | None = None
    roughness: SelfAffine | dict[str, Any] | None = None
    temperature: Temperature | dict[str, Any] | None = None
    speeds: Speeds | None = None
    rates: Speeds | None = None
    loads: Loads | None = None
    depths: Depths | None = None
    surfaces: Draws | None = None
    profiles: Draws | None = None
    interval: Share | None = None
    claims: Claims | None = None
    bem: BEM | dict[str, Any] | None = None
    mdr: MDR | dict[str, Any] | None = None


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class OwnSeries(_Shared):
    """One series of a study.

    name : of its folder
    title : for people; the name if absent
    note : what is to be said of it on the page
    """

    name: Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_.-]*$")]
    title: str = ""
    note: str = ""


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class StudyFile(_Shared):
    """A study of one's own: what all series share, and the series.

    title, about : for people
    models, reference : names of the models that are compared, and of the one against which the others are judged;
        mdr and bem, and bem, if absent
    series : 1 to 100
    """

    title: str
    about: str = ""
    models: ModelNames = ()
    reference: str = ""
    series: Annotated[tuple[OwnSeries, ...], Field(min_length=1, max_length=MOST_SERIES)]


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class _Contact:
    """Contact of a series once everything is put together."""

    indenter: Body
    elastomer: Elastomer
    roughness: SelfAffine
    temperature: Temperature | None = None
    bem: BEM | None = None
    mdr: MDR | None = None

    @model_validator(mode="after")
    def _is_rough(self):
        if self.roughness.flat:
            raise ValueError("roughness.rms_height = 0: a study asks what roughness does")
        return self


@plain(frozen=True)
class _Stated:
    """A series with what it shares, and its contact put together."""

    own: OwnSeries
    shared: StudyFile
    contact: Mapping[str, Any]

    def __getitem__(self, name: str) -> Any:
        own = getattr(self.own, name)
        return getattr(self.shared, name) if own is None else own

    def of(self, *names: str) -> dict[str, Any]:
        """Values that are stated of names of which one excludes the others, by the series if it states any."""
        for part in (self.own, self.shared):
            if given := {name: value for name in names if (value := getattr(part, name)) is not None}:
                return given
        return {}

    def series(self, size: Size) -> Series:
        """Series at a size."""
        made = validator(_Contact).validate_python(dict(self.contact) | {"bem": None, "mdr": None})
        prescribed, given = next(iter(self.of("loads", "depths").items()))
        values = _numbers(given, size.values)
        moved = self.of("speeds", "rates")
        speeds: tuple[float, ...] = next((_numbers(value, size.speeds) for value in moved.values()), ())
        press = {prescribed.removesuffix("s"): values[0]}
        settings: dict[str, Any] = {"points": size.points} | dict(self.contact.get("bem", {}))
        motion: Indent | Slide | Program = Indent(**press)
        if "speeds" in moved:
            motion = Slide(speed=speeds[0], **press)
        elif moved:
            motion = Program(stages=(Stage(duration=1.0, **press),))
        return Series(
            name=self.own.name,
            title=self.own.title or self.own.name,
            scene=Scene(made.indenter, made.elastomer, motion, made.roughness, temperature=made.temperature),
            speeds=speeds,
            values=values,
            surfaces=self["surfaces"] or size.surfaces,
            profiles=self["profiles"] or size.profiles,
            bem=BEM(**settings),
            mdr=MDR(**self.contact.get("mdr", {})),
            note=self.own.note,
            interval=self["interval"],
            claims=self["claims"] or KINDS,
            asked=self.shared.models,
            reference=self.shared.reference,
        )

    def misfits(self) -> Iterator[str]:
        """Contradictions between the fields."""
        pressing, moved = self.of("loads", "depths"), self.of("speeds", "rates")
        for given, names, least in ((pressing, "loads, depths", 1), (moved, "speeds, rates", 0)):
            if not least <= len(given) <= 1:
                stated = "both given" if given else "none given"
                yield f"{names}: {stated}, give {'exactly' if least else 'at most'} one of them"
        if self["interval"] is not None and (self["surfaces"] or self["profiles"]):
            yield f"interval = {self['interval']:g}: it takes the place of surfaces and profiles, leave them out"
        for name, values in (pressing | moved).items():
            if isinstance(values, tuple) and list(values) != sorted(set(values)):
                yield f"{name} = {brief(repr(list(values)))}: from the least to the greatest, each once"
        if "rates" in moved and "depths" not in pressing:
            yield "rates: a body pressed in at a rate is pressed to depths, give depths"
        if "rates" in moved and "temperature" in self.contact:
            yield "rates: a pressed-in solid is stated at its own temperature, leave temperature out"
        if "speeds" in moved and isinstance(moved["speeds"], tuple) and len(moved["speeds"]) < 2:
            yield "speeds: at least two, or none for bodies at rest"
        for solver, least in (("bem", 32), ("mdr", 16)):
            if (points := self.contact.get(solver, {}).get("points", least)) < least:
                yield f"{solver}.points = {points}: at least {least}, as the coarser grid has half of them"
        if moved and self.contact["elastomer"].get("type") == "elastic":
            yield f"{next(iter(moved))}: an elastic solid loses nothing, whatever the speed, leave them out"


@files.reading_once()
def study_of(text: str, name: str) -> ReadyStudy:
    """A study by the text of its file. Raises InvalidInput naming every mistake.

    name : of the file, for mistakes
    """
    content = parsed(text, name)
    file, said, content = _checked(StudyFile, content)
    contacts = []
    for number, own in _series_in(content):
        contact, wrong = _contact(content, own, number)
        contacts.append(contact)
        said += wrong
    lines = list(dict.fromkeys(each.line for each in said))
    if file is not None and not lines:
        stated = [_Stated(own, file, contact) for own, contact in zip(file.series, contacts, strict=True)]
        lines = [f"series.{number}: {why}" for number, each in enumerate(stated) for why in each.misfits()]
        try:
            folders([own.name for own in file.series], "series")
        except InvalidInput as error:
            lines.append(str(error))
        lines = lines or [line for number, each in enumerate(stated) for line in _refused(each, number)]
    if lines:
        raise invalid(name, lines)
    return ReadyStudy(file.title, file.about, lambda size: [each.series(size) for each in stated])


def _checked(what: Any, content: dict) -> tuple[Any, list[Mistake], dict]:
    """The content as what it should be, or None; its mistakes; and the content without wrong names."""
    adapter = validator(what)
    try:
        return adapter.validate_python(content), [], content
    except ValidationError as error:
        return None, *examined(error, content, adapter)


def _series_in(content):
    """The series that are tables, by their numbers; of more than there may be, the first."""
    series = content.get("series")
    numbered = enumerate(series[:MOST_SERIES]) if isinstance(series, list) else ()
    return [(number, each) for number, each in numbered if isinstance(each, dict)]


def _contact(content, own, number):
    """The tables of a series put together, and what is wrong with them, where it stands in the file."""
    merged, said = {}, []
    for part in (content, own):
        if isinstance(part.get("scene"), str):
            try:
                base = parsed(find(part["scene"]).text, part["scene"])
            except NotReady as error:
                where = ("series", number, "scene") if part is own else ("scene",)
                said.append(Mistake(where, f"{'.'.join(map(str, where))}: {error}"))
                continue
            merged = {name: base[name] for name in _TABLES if name in base}
        for name in (*_TABLES, "bem", "mdr"):
            if isinstance(table := part.get(name), dict):
                merged[name] = _over(merged.get(name, {}), table)
    if said:
        return merged, said
    _, wrong, _ = _checked(_Contact, merged)
    return merged, [_in_file(mistake, own, number) for mistake in wrong]


def _over(below, table):
    """A table over another, name by name, unless it is of another type."""
    return table if table.get("type", below.get("type")) != below.get("type") else below | table


def _in_file(mistake, own, number):
    """A mistake of a contact put together: of the series if what is wrong, or lacks something, is its own."""
    part = own
    for name in mistake.where[:2]:
        if not (isinstance(part, dict) and name in part):
            break
        part = part[name]
    else:
        where = ("series", number, *mistake.where)
        return Mistake(where, f"series.{number}.{mistake.line}")
    table = mistake.where[:1]
    if ": missing, " in mistake.line and (not table or table[0] in own):
        return Mistake(("series", number, *mistake.where), f"series.{number}.{mistake.line}")
    return mistake


def _refused(stated: _Stated, number: int) -> Iterator[str]:
    """Refusals of the solvers at the least size."""
    try:
        for grid in stated.series(SIZES["quick"]).curves.values():
            refuse([grid])
    except ValidationError as error:
        yield from (f"series.{number}: {each['msg']}" for each in error.errors())
    except (Refused, SolveError, ArithmeticError) as error:
        yield f"series.{number}: {error}"


def _numbers(given, count):
    return given if isinstance(given, tuple) else given.values(count)
