"""Contacts of one scene at speeds and loads or depths of one's own: `compare.sweep`."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import product
from typing import Any, ClassVar

import numpy as np
import xarray
from pandas import DataFrame

from scene import Indent, Scene, Slide
from scene.motion import UNITS
from scene.reading import InvalidInput, whole

from ...library.case import Case, doubted, share_of
from ...library.lookup import SceneLike, case_of
from ...models.table import ModelLike, Models
from ...report.page import Table
from ...solving.control_variates import VARIATES
from ...solving.cost import MOST_DRAWS
from ...solving.curve import Curve, on_two_levels, refuse
from ...solving.vocabulary import attributes
from ...statistics.multilevel import MEANS, WORDS, wanted
from .answers import Answers
from .around import OWN_RATIOS, models_of
from .claims import CLAIMS
from .series import Counts, Judged, Series, on_levels_alike
from .values import Values, values_of

FEW = 8  # draws where nothing is asked
CONTACTS = "contacts"


@dataclass(frozen=True)
class SweepSeries(Series):
    """Contacts of one scene at every speed and every load or depth.

    case : the scene with the settings of both solvers; its motion says whether a load or a depth is prescribed
    speeds, values : [m/s]; [N] or [m]
    draws : rough surfaces, and as many profiles
    models : of which each but the reference is compared with that
    """

    case: Case
    speeds: tuple[float, ...]
    values: tuple[float, ...]
    draws: int
    models: Models
    interval: float | None = None
    strata: Mapping[str, Counts] = field(default_factory=dict)
    name = title = CONTACTS
    shared: ClassVar[Mapping[str, tuple[str, ...]]] = {CONTACTS: (CONTACTS,)}

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
        if not isinstance(case.motion, Indent | Slide):
            raise InvalidInput(f"motion = {case.motion.type}: a sweep takes indent or slide, `run` any other")
        if load is not None and depth is not None:
            raise InvalidInput("load, depth: both given, give one of them")
        name, values = ("load", load) if depth is None else ("depth", depth)
        if values is None:
            name, values = case.motion.pressed_by, [case.motion.greatest]
        speeds = values_of("speed", case.motion.speed if speed is None else speed, least=0.0)
        prescribed = values_of(name, values)
        if draws is not None and interval is not None:
            raise InvalidInput("draws, interval: both given, give one of them")
        drawn = whole("draws", FEW if draws is None else draws, MOST_DRAWS)
        pressed: dict[str, Any] = {name: prescribed[0]}
        motion = Slide(speed=max(speeds), **pressed) if max(speeds) else Indent(**pressed)
        half = None if interval is None else share_of("interval", interval)
        compared = models_of(case, models, reference)
        asked = cls(replace(case, motion=motion), speeds, prescribed, drawn, compared, half)
        refuse(asked.curves.values())
        return asked

    @property
    def scene(self) -> Scene:  # type: ignore[override]
        return self.case.scene

    @property
    def folder(self) -> str:
        return ""

    def path(self, curve: str) -> str:
        return curve

    @property
    def doubts(self) -> Sequence[str]:
        corners = self.curves[CONTACTS].corners
        return doubted(*(replace(self.case, motion=each.motion) for each in corners))

    @property
    def prescribed(self) -> str:
        """Name of what is prescribed: "load" or "depth"."""
        return self.case.motion.pressed_by

    @cached_property
    def curves(self) -> Mapping[str, Curve]:
        fixed = Curve(
            scene=self.scene,
            speeds=self.speeds,
            values=self.values,
            levels=on_two_levels(*(each.solver for each in self.models)),
            draws={each.name: each.count(self.draws, self.draws) for each in self.models},
        )
        if self.interval is None or not fixed.random:
            return {CONTACTS: fixed}
        return on_levels_alike({CONTACTS: fixed}, self.models, self.strata.get(CONTACTS, {}))

    @property
    def wanted(self) -> Iterator[tuple[str, str, tuple[float, ...]]]:
        for name, speeds in wanted(self.prescribed, self.speeds, self.case.slides):
            yield CONTACTS, name, speeds

    def judge(self, answers: Answers) -> Judged:
        """Friction, else force or depth, of each model over the reference at every contact, without a claim."""
        name = "friction_coefficient" if max(self.speeds) > 0 else next(self.wanted)[1]
        claim = CLAIMS["friction.ratio.speed" if WORDS[name] == "friction" else OWN_RATIOS[name]]
        places = {
            (i, j): f"{speed:g} m/s, {value:g} {UNITS[self.prescribed]}"
            for (i, speed), (j, value) in product(enumerate(self.speeds), enumerate(self.values))
        }
        found = [each for _, _, each in self.ratios(claim, answers, CONTACTS, name, places)]
        return Judged([replace(each, where=each.where.removeprefix(f"{self.name}, ")) for each in found])

    def tables(self, answers: Answers, findings) -> Iterator[Table]:
        """Friction, and depth or force, a row a contact and a column a model; what is judged also as a ratio."""
        places = DataFrame(list(product(self.speeds, self.values)), columns=["speed", self.prescribed])
        for name, speeds in reversed([*wanted(self.prescribed, self.speeds, max(self.speeds) > 0)]):
            frame = places.copy()
            for model in answers.claiming(CONTACTS, WORDS[name]):
                found = answers.interval(CONTACTS, model.name, *MEANS[name])
                for end, values in zip(("", "_low", "_high"), found.ends, strict=True):
                    frame[f"{name} ({model.label}){end}"] = np.ravel(values)
            own = [each for each in findings if _judges(each, name)]
            for beside in dict.fromkeys(each.dimension for each in own):
                rows = [(each.value, *each.interval) for each in own if each.dimension == beside]
                frame[[beside, f"{beside}_low", f"{beside}_high"]] = rows
            told = f"Mean {WORDS[name]} at every contact, with intervals of 95 %."
            yield Table(f"means-{WORDS[name]}", frame[frame["speed"].isin(speeds)], told)

    def dataset(self, tree: xarray.DataTree) -> xarray.Dataset:
        """Everything solved as one Dataset, with means over surfaces and their intervals of 95 %."""
        answers = self.answers(tree)
        dataset = answers.curves[CONTACTS].drop_vars([VARIATES, "draws"], errors="ignore").reset_coords("points")
        for name, (above, below) in MEANS.items():
            found = [answers.interval(CONTACTS, model, above, below) for model in dataset["model"].values.tolist()]
            for place, end in enumerate(("mean", "low", "high")):
                label, values = f"{name}_{end}", np.array([each.ends[place] for each in found])
                dataset[label] = ("model", "speed", self.prescribed), values, attributes(label)
        return dataset


def _judges(finding, name):
    own = "friction.ratio.speed" if WORDS[name] == "friction" else OWN_RATIOS[name]
    return finding.claim.id == own


def means(dataset: xarray.Dataset) -> DataFrame:
    """Means of a sweep with their intervals of 95 %: a row for each model, speed, and load or depth."""
    names = [f"{name}{end}" for name in MEANS for end in ("_mean", "_low", "_high")]
    return dataset[names].to_dataframe().reset_index()
