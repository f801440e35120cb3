"""Study files: series of contacts stated in TOML, those of the package and a user's own, at each size."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass as plain
from dataclasses import fields, replace
from functools import partial
from typing import Annotated, Any, Generic, Literal, TypeVar

import numpy as np
from pydantic import AfterValidator, Discriminator, Field, Tag, ValidationError, model_validator
from pydantic.dataclasses import dataclass

from bem3d import BEM
from mdr1d import MDR
from scene import Cone, Indent, PowerLaw, Program, Refused, Scene, SelfAffine, Slide, SolveError, Sphere, Stage, files
from scene.mistakes import CHOICE, Mistake, examined
from scene.quantities import CLOSED, Force, Length, Speed, Whole
from scene.reading import InvalidInput, invalid, parsed, validator
from scene.rheology import Elastomer
from scene.scales import elastic_contact
from scene.temperature import Temperature

from ...library.case import Draws, ModelNames, Share
from ...library.describe import folders
from ...library.ready import CLAIMS, find, ready
from ...solving.cost import MOST_VALUES
from ...solving.suggest import suggestion
from .series import KINDS, Series

SIZES = "quick", "standard", "full"
MOST_SERIES = 100  # of a file
# Of each pair one is stated: where a series does, it takes the place of the other stated for all.
INSTEAD = {"loads": "depths", "depths": "loads", "speeds": "rates", "rates": "speeds"}
TABLES = ("indenter", "elastomer", "roughness", "temperature")  # of a ready scene
SOLVERS = "bem", "mdr"

Quantity = TypeVar("Quantity")
Body = Annotated[Sphere | Cone | PowerLaw, Field(discriminator="type")]
Size = Literal["quick", "standard", "full"]


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

    @model_validator(mode="after")
    def _in_order(self):
        if None not in (self.least, self.greatest) and not self.least < self.greatest:
            raise ValueError(f"greatest = {self.greatest:g} must exceed least = {self.least:g}")
        return self


def _in_order(values):
    if list(values) != sorted(set(values)):
        raise ValueError("from the least to the greatest, each once")
    return values


def _of_a_scene(name):
    scenes = [each.name for each in ready().values() if each.kind == "scene"]
    if name not in scenes:
        raise ValueError(f"no ready scene{suggestion(name, scenes)}")
    return name


_RANGE, _LIST = f"{CHOICE}range", f"{CHOICE}list"
_List = Annotated[
    tuple[Quantity, ...],
    Field(min_length=1, max_length=MOST_VALUES),
    AfterValidator(_in_order),
    Tag(_LIST),
]
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
    surfaces: Draws | None = None
    profiles: Draws | None = None
    interval: Share | None = None
    claims: (
        Annotated[
            tuple[Literal["collapse", "friction", "depth", "dimensions", "families"], ...], Field(min_length=1)
        ]
        | None
    ) = None


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Stated(_Asked):
    """Fields that a study states for all of its series, or each of them for itself, at all sizes or at one.

    scene : name of a ready scene, from which every table is taken that is not stated
    indenter, elastomer, roughness, temperature : as in a scene; what a series states takes the place of what is
        stated for all, name by name, unless it states another type. Bodies are spheres, cones and power laws, and
        roughness is self-affine
    speeds : of sliding [m/s], two at least; with rates absent too, the bodies are at rest
    rates : of pressing in [m/s], to the depths
    loads, depths : what presses [N], [m]: one of them
    prescribed : "depth": in place of the loads, the depths that the smooth relaxed body has under them
    surfaces, profiles : drawn in three and in one dimension, at most 10,000; with an interval, at least, on the
        coarsest grid; absent, as many as the size of the study has
    interval : the half-width of intervals of 95 % that is wanted of claims, relative, as "5%"
    claims : which are judged: "collapse" (Eq. 23), "friction" (Eqs. 14 to 19), "depth" (at rest, and pressed in),
        "dimensions" (1D against 3D), "families" (several series together); absent, all of them
    bem, mdr : settings of the solvers on the finer grid; the coarser has half the points
    """

    scene: Annotated[str, AfterValidator(_of_a_scene)] | None = None
    indenter: Body | dict[str, Any] | None = None
    elastomer: Elastomer | dict[str, Any] | None = None
    roughness: SelfAffine | dict[str, Any] | None = None
    temperature: Temperature | dict[str, Any] | None = None
    bem: BEM | dict[str, Any] | None = None
    mdr: MDR | dict[str, Any] | None = None


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Sizes:
    """What is stated at one size alone, over what is stated at all.

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
    note : what is to be said of it on the page
    only : sizes at which it is solved; absent, all of them
    sizes : what it states at one size alone
    """

    name: Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_.-]*$")]
    title: str = ""
    note: str = ""
    only: tuple[Size, ...] = SIZES
    sizes: Sizes = Sizes()


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class StudyFile(Stated):
    """A study of one's own: what all series share, and the series.

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
    series: Annotated[tuple[OwnSeries, ...], Field(min_length=1, max_length=MOST_SERIES)]


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class _Complete(_Asked):
    """A series at one size, once everything is put together."""

    indenter: Body
    elastomer: Elastomer
    roughness: SelfAffine
    temperature: Temperature | None = None
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
            if isinstance(given, Range) and None in (given.least, given.greatest):
                yield f"{name}: a range has both least and greatest"
        if self.rates and self.loads and not self.prescribed:
            yield "rates: a body pressed in at a rate is pressed to depths, give depths"
        if self.rates and self.temperature:
            yield "rates: a pressed-in solid is stated at its own temperature, leave temperature out"
        if isinstance(self.speeds, tuple) and len(self.speeds) < 2:
            yield "speeds: at least two, or none for bodies at rest"
        for solver, least in ((self.bem, 32), (self.mdr, 16)):
            if solver.points < least:
                name = solver.name.lower()
                yield f"{name}.points = {solver.points}: at least {least}, as the coarser grid has half of them"
        if (self.speeds or self.rates) and self.elastomer.type == "elastic":
            yield "speeds, rates: an elastic solid loses nothing, whatever the speed, leave them out"

    def series(self, own: OwnSeries, shared: StudyFile) -> Series:
        """The series, as it is solved and judged."""
        speeds, values = _numbers(self.speeds or self.rates), _numbers(self.loads or self.depths)
        scene = Scene(
            self.indenter,
            self.elastomer,
            Indent(**{"load" if self.loads else "depth": values[0]}),
            self.roughness,
            temperature=self.temperature,
        )
        if self.loads and self.prescribed:
            contacts = [elastic_contact(replace(scene, motion=Indent(load=load))) for load in values]
            values = tuple(each.depth for each in contacts)
            scene = replace(scene, motion=Indent(depth=values[0]))
        pressed: dict[str, float] = {scene.motion.pressed_by: values[0]}
        if self.speeds:
            scene = replace(scene, motion=Slide(speed=speeds[0], **pressed))
        elif self.rates:
            scene = replace(scene, motion=Program(stages=(Stage(duration=1.0, **pressed),)))
        return Series(
            name=own.name,
            title=own.title or own.name,
            scene=scene,
            speeds=speeds,
            values=values,
            surfaces=self.surfaces,
            profiles=self.profiles,
            bem=self.bem,
            mdr=self.mdr,
            note=own.note,
            interval=self.interval,
            claims=self.claims or KINDS,
            asked=shared.models,
            reference=shared.reference,
        )


def _usual(speeds: int, values: int, surfaces: int, profiles: int, points: int) -> dict[str, Any]:
    """What holds at a size where a file states nothing else."""
    counts = {"speeds": speeds, "rates": speeds, "loads": values, "depths": values}
    ranges = {name: {"count": count} for name, count in counts.items()}
    return ranges | {"surfaces": surfaces, "profiles": profiles, "bem": {"points": points}}


FIELDS = [field.name for field in fields(_Complete)]
USUAL = {
    "quick": _usual(speeds=6, values=4, surfaces=3, profiles=12, points=128),
    "standard": _usual(speeds=12, values=8, surfaces=10, profiles=60, points=256),
    "full": _usual(speeds=20, values=16, surfaces=40, profiles=200, points=512),
}


@files.reading_once()
def study_of(text: str, name: str) -> ReadyStudy:
    """A study by the text of its file. Raises InvalidInput naming every mistake.

    name : of the file, for mistakes
    """
    file, wrong, content = _checked(StudyFile, parsed(text, name))
    lines, found = [each.line for each in wrong], {size: list[Series]() for size in SIZES}
    for number, own in _series_in(content):
        for size in SIZES if file is None else file.series[number].only:
            complete, wrong, _ = _checked(_Complete, _put_together(content, own, size))
            # What else is wrong with a file has its line already.
            wrong = [each for each in wrong if file or each.where[:1] and each.where[0] in (*TABLES, *SOLVERS)]
            lines += [_in_file(each, own, number) for each in wrong]
            if file and complete:
                try:
                    series = complete.series(file.series[number], file)
                    series.grids  # noqa: B018 - refuses what cannot be solved on two grids
                    found[size].append(series)
                except (ValidationError, Refused, SolveError, ArithmeticError) as error:
                    lines.append(f"series.{number}: {error}")
    if file:
        try:
            folders([own.name for own in file.series], "series")
        except InvalidInput as error:
            lines.append(str(error))
    if file is None or lines:
        raise invalid(name, list(dict.fromkeys(lines)))
    return ReadyStudy(file.title, file.about, found.__getitem__)


def _checked(what: Any, content: dict) -> tuple[Any, list[Mistake], dict]:
    """The content as what it should be, or None; its mistakes; and the content without wrong names."""
    adapter = validator(what)
    try:
        return adapter.validate_python(content), [], content
    except ValidationError as error:
        return None, *examined(error, content, adapter)


def _series_in(content: dict) -> list[tuple[int, dict]]:
    """The series that are tables, by their numbers; of more than there may be, the first."""
    series = content.get("series")
    numbered = enumerate(series[:MOST_SERIES] if isinstance(series, list) else [])
    return [(number, each) for number, each in numbered if isinstance(each, dict)]


def _put_together(content: dict, own: dict, size: str) -> dict:
    """Fields of a series at a size: what is usual, what all share, what it states; each at all sizes, then at one."""
    whole: dict[str, Any] = {}
    for part in (content, own):
        whole = _over(_over(whole, part), _table(_table(part, "sizes"), size))
    whole = _over(USUAL[size], whole)
    return {name: whole[name] for name in FIELDS if name in whole and set(_table(whole, name)) != {"count"}}


def _over(below: dict, above: dict) -> dict:
    """Fields over others: tables name by name, unless they state another type."""
    found = {name: value for name, value in below.items() if INSTEAD.get(name) not in above}
    if (scene := above.get("scene")) in [*ready()]:
        base = parsed(find(scene).text, scene)
        found = {name: value for name, value in found.items() if name not in TABLES}
        found |= {name: base[name] for name in TABLES if name in base}
    for name, value in above.items():
        under, over = _table(found, name), _table(above, name)
        same = over.get("type", under.get("type")) == under.get("type")
        found[name] = under | over if over and same else value
    return found


def _table(inside: dict, name: str) -> dict:
    """A table of a name; an empty one where there is none."""
    found = inside.get(name)
    return found if isinstance(found, dict) else {}


def _in_file(mistake: Mistake, own: dict, number: int) -> str:
    """A mistake of a series as one of the file: that of the series, or of what all share."""
    if not mistake.where:
        return f"series.{number}: {mistake.line}"
    return f"series.{number}.{mistake.line}" if mistake.where[0] in own else mistake.line


def _numbers(given: Any) -> tuple[float, ...]:
    """Numbers of a list or a range, none if absent."""
    if isinstance(given, Range):
        return tuple(np.geomspace(given.least, given.greatest, given.count).tolist())
    return given or ()


def _ready_series(name: str, size: str) -> Sequence[Series]:
    """Series of a study that comes with the package, which is read once it is asked for."""
    return study_of(find(name).text, name).series(size)


STUDIES = {
    name: ReadyStudy(find(name).title, find(name).about, partial(_ready_series, name)) for name in CLAIMS
}
