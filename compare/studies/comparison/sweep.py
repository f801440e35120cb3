"""Contacts of a scene at given speeds and loads or depths: `compare.sweep`."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import islice, product
from math import isfinite, log10
from typing import Any, ClassVar, TypeAlias

import numpy as np
import xarray
from pandas import DataFrame

from scene import Indent, Scene, Slide
from scene.files.reading import InvalidInput, whole
from scene.motion import PRESSES, UNITS
from scene.numeric_input import one_by_one
from scene.printable import brief
from scene.quantities import SPEED, Unit

from ...library.case import Case, doubted, share_of
from ...library.lookup import SceneLike, case_of
from ...models.table import ModelLike, Models
from ...report.page import Table
from ...solving.control_variates import VARIATES
from ...solving.cost import MOST_DRAWS, MOST_VALUES
from ...solving.curve import Curve, on_two_levels, refuse
from ...solving.vocabulary import attributes
from ...statistics import intervals
from ...statistics.means import ENDS
from ...statistics.multilevel import MEANS, WORDS, wanted
from .around import MU, OWN_RATIOS, for_interval, models_of, over
from .measures import Here, Place, Row, Where
from .series import Counts, Judged, Series, Wanted

# Speeds, loads or depths as they are given: numbers in SI, or texts, see `values_of`.
Values: TypeAlias = Sequence[str | float] | str | float
# Points of a range over a factor of ten where no number of them is stated.
TO_A_DECADE = 3


def values_of(name: str, given: Any, least: float | None = None) -> tuple[float, ...]:
    """Distinct finite numbers in SI, in rising order, of a speed, load or depth. Raises InvalidInput.

    given : numbers, or texts as "1 mm/s", "1mm/s,10mm/s", "1mm/s..1m/s" or, of seven points, "1mm/s..1m/s:7"
    least : 0 where zero is allowed too
    """
    single = isinstance(given, str) or getattr(given, "ndim", None) == 0 or not isinstance(given, Iterable)
    unit, found = SPEED if name == "speed" else PRESSES[name], list[float]()
    try:
        for part in [given] if single else islice(one_by_one(given), MOST_VALUES + 1):
            found += _numbers(unit, part)
            if len(found) > MOST_VALUES:
                raise ValueError(f"at most {MOST_VALUES:,} values")
        if not all(isfinite(each) and (each > 0 or each == least) for each in found):
            raise ValueError(f"finite numbers {'of zero or more' if least == 0 else 'above zero'}")
        if not found or len(set(found)) < len(found):
            raise ValueError("at least one, and each once")
    except (ValueError, OverflowError) as error:
        reason = str(error).removeprefix("Input should be ")
        raise InvalidInput(f"{name} = {brief(repr(given))}: {reason}") from None
    return tuple(sorted(found))


def _numbers(unit: Unit, given: Any) -> Iterator[float]:
    """Numbers of an item; a text may state several."""
    for part in given.split(",") if isinstance(given, str) else [given]:
        ends, colon, count = part.partition(":") if isinstance(part, str) else (part, "", "")
        if not (isinstance(ends, str) and ".." in ends):
            yield float(unit.value(part))
            continue
        first, last = (float(unit.value(end)) for end in ends.split("..", 1))
        if not (first > 0 and last > 0 and isfinite(first + last)):
            raise ValueError("a range has finite ends above zero")
        points = int(count) if colon else 1 + round(TO_A_DECADE * abs(log10(last / first)))
        yield from np.geomspace(first, last, min(max(2, points), MOST_VALUES + 1)).tolist()


FEW = 8  # draws where nothing is asked
CONTACTS = "contacts"


def contacts(name: str) -> Where:
    """Every contact, where this mean tells what is compared: friction, else what is not prescribed."""

    def where(here: Here) -> Iterator[Place]:
        series = here.series
        if name == (MU if max(series.speeds) > 0 else next(series.wanted)[1]):
            for i, speed in enumerate(series.speeds):
                for j, value in enumerate(series.values):
                    yield f"{speed:g} m/s, {value:g} {UNITS[series.prescribed]}", (i, j)

    return where


CLAIMED = {**OWN_RATIOS, MU: "friction.ratio.speed"}  # by the name of the mean; reported, and not claimed


@dataclass(frozen=True)
class SweepSeries(Series):
    """Contacts of a scene at every speed and every load or depth.

    case : the scene with the settings of both solvers; its motion says whether a load or a depth is prescribed
    speeds, values : [m/s]; [N] or [m]
    draws, profiles : rough surfaces, and profiles; as many if absent
    models : models, each compared with the reference among them
    """

    case: Case
    speeds: tuple[float, ...]
    values: tuple[float, ...]
    draws: int
    models: Models
    interval: float | None = None
    strata: Mapping[str, Counts] = field(default_factory=dict, hash=False)
    profiles: int | None = None
    name = title = CONTACTS
    shared: ClassVar[Mapping[str, tuple[str, ...]]] = {CONTACTS: (CONTACTS,)}
    rows = tuple(
        Row(id, contacts(name), over(name), pair=True, quantity=WORDS[name], curve=CONTACTS, each=True)
        for name, id in CLAIMED.items()
    )
    by_speed = CONTACTS
    label = ""

    @classmethod
    def of(
        cls,
        scene: SceneLike,
        speed: Values | None = None,
        load: Values | None = None,
        depth: Values | None = None,
        draws: int | None = None,
        models: Sequence[ModelLike] | None = None,
        reference: str | None = None,
        interval: float | str | None = None,
    ) -> "SweepSeries":
        """The sweep of a scene, a case, a file or a ready scene. Raises InvalidInput, Refused."""
        case = case_of(scene)
        case.refuse()
        motion = case.motion
        if not isinstance(motion, Indent | Slide):
            raise InvalidInput(f"motion = {motion.type}: a sweep takes indent or slide, `run` any other")
        for names, one, other in (("load, depth", load, depth), ("draws, interval", draws, interval)):
            if one is not None and other is not None:
                raise InvalidInput(f"{names}: both given, give one of them")
        name = motion.pressed_by if load is depth is None else "load" if depth is None else "depth"
        given = [each for each in (load, depth, [motion.greatest]) if each is not None]
        values = values_of(name, given[0])
        speeds = values_of("speed", motion.speed if speed is None else speed, least=0.0)
        drawn = whole("draws", FEW if draws is None else draws, MOST_DRAWS)
        pressed: dict[str, Any] = {name: values[0]}
        motion = Slide(speed=max(speeds), **pressed) if max(speeds) else Indent(**pressed)
        half = share_of("interval", interval)
        case = for_interval(replace(case, motion=motion), half)
        asked = cls(case, speeds, values, drawn, models_of(case, models, reference), half)
        refuse(asked.curves.values())
        return asked

    @property
    def scene(self) -> Scene:  # type: ignore[override]
        return self.case.scene

    @property
    def folder(self) -> str:
        return ""

    @property
    def remarks(self) -> Sequence[str]:
        return self.case.notes

    @property
    def doubts(self) -> Sequence[str]:
        corners = self.curves[CONTACTS].corners
        return doubted(*(replace(self.case, motion=each.motion) for each in corners))

    @cached_property
    def curves(self) -> Mapping[str, Curve]:
        fixed = Curve(
            scene=self.scene,
            speeds=self.speeds,
            values=self.values,
            levels=on_two_levels(*(each.solver for each in self.models)),
            draws={each.name: each.count(self.profiles or self.draws, self.draws) for each in self.models},
        )
        return self.with_strata({CONTACTS: fixed})

    @property
    def wanted(self) -> Wanted:
        for name, speeds in wanted(self.prescribed, self.speeds, self.case.slides):
            yield CONTACTS, name, speeds

    def tables(self, judged: Judged) -> Iterator[Table]:
        """Friction, and depth or force, a row a contact and a column a model; what is judged also as a ratio."""
        places = DataFrame(list(product(self.speeds, self.values)), columns=["speed", self.prescribed])
        for name, speeds in reversed([*wanted(self.prescribed, self.speeds, max(self.speeds) > 0)]):
            numbers: dict[str, Any] = {}
            for model in judged.answers.claiming(CONTACTS, WORDS[name]):
                found = judged.answers.interval(CONTACTS, model.name, *MEANS[name])
                numbers |= {each: np.ravel(of) for each, of in found.columns(f"{name} ({model.label})").items()}
            own = [each for each in judged.findings if each.claim.id == CLAIMED[name]]
            for pair in dict.fromkeys(each.dimension for each in own):
                rows = [(each.value, *each.interval) for each in own if each.dimension == pair]
                names = (f"{pair}{end}" for end in intervals.ENDS)
                numbers |= dict(zip(names, np.transpose(rows), strict=True))
            frame = places.assign(**numbers)
            caption = f"Mean {WORDS[name]} at every contact, with intervals of 95 %."
            yield Table(f"means-{WORDS[name]}", frame[frame["speed"].isin(speeds)], caption)

    def dataset(self, tree: xarray.DataTree) -> xarray.Dataset:
        """Everything solved as one Dataset, with means over surfaces and their intervals of 95 %."""
        answers = self.answers(tree)
        dataset = answers.curves[CONTACTS].drop_vars([VARIATES, "draws"], errors="ignore").reset_coords("points")
        for name, both in MEANS.items():
            found = [answers.interval(CONTACTS, model, *both).ends for model in dataset["model"].values.tolist()]
            for end, values in zip(ENDS, zip(*found, strict=True), strict=True):
                dims = "model", "speed", self.prescribed
                dataset[f"{name}{end}"] = dims, np.array(values), attributes(f"{name}{end}")
        return dataset


def means(dataset: xarray.Dataset) -> DataFrame:
    """Means of a sweep with their intervals of 95 %: a row for each model, speed, and load or depth."""
    names = [f"{name}{end}" for name in MEANS for end in ENDS]
    return dataset[names].to_dataframe().reset_index()
