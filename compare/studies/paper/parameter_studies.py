"""Fig. 3: six parameter studies of slow friction on a rough cone, and their collapse on mu-tilde = xi, Eq. 17."""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from functools import lru_cache
from math import nan
from typing import Any

import numpy as np
import xarray
from pandas import DataFrame

from mdr1d import equations
from mdr1d.ensemble import Answers, solve_profiles
from scene import Scene, SolveError

from ...comparison.curve import FAILED, SOLVED
from ...solving.outcome import Outcome
from ...solving.task import SCENES, Task
from ...solving.vocabulary import attributes
from ...statistics.intervals import Estimated
from ...statistics.jackknife import Replicates, left_out, mean_ratio
from . import parameters
from .arrays import ArrayTask
from .conditions import regime_of, with_conditions, with_ends

NODE = "parameter-studies/MDR"
# Profiles of one task: some seconds of work are lost at most in an interruption, and to prepare the scenes takes
# little of them.
TOGETHER = 25
# Eq. 17 is the limit of Eq. 19: at this xi that lies 0.7 % lower.
SLOW = 0.05
# Arrays of mdr1d.ensemble.Answers by the names of a Dataset.
NAMES = {
    "friction": "friction_coefficient",
    "depth": "depth_reached",
    "length": "contact_length",
    "span": "contact_span",
    "rms_slope": "rms_slope",
    "sweeps": "sweeps",
}
DIMS = ("hurst", "study", "step", "seed")


@dataclass(frozen=True)
class ParameterStudies:
    """Extent of Fig. 3: values of each study, Hurst exponents, profiles. As published: all 20, all 11, 200."""

    values: int = 20
    hurst: tuple[float, ...] = parameters.HURST
    profiles: int = parameters.PROFILES

    def tasks(self) -> list["Profiles"]:
        """Tasks, each of every contact on some of the profiles."""
        seeds = range(self.profiles)
        return [Profiles(self, tuple(seeds[first : first + TOGETHER])) for first in seeds[::TOGETHER]]

    def dataset(self, outcomes: Mapping[Task, Outcome]) -> xarray.Dataset:
        """Dataset with the dimensions hurst, study, step and draw; `parameter` is what a study varies."""
        places, tasks = contacts(self), self.tasks()
        shape = len(self.hurst), len(parameters.STUDIES), self.values
        parts = [outcomes[task].fields for task in tasks]
        arrays = {
            name: np.hstack([part[own] for part in parts]).reshape(*shape, -1) for own, name in NAMES.items()
        }
        rows = [outcomes[task].rows for task in tasks for _ in task.seeds]
        reasons = np.array([row[0].reason if row else "" for row in rows], object)
        status = np.where(np.isfinite(arrays["friction_coefficient"]), SOLVED, FAILED)
        numbers: dict[str, Any] = {name: (DIMS, values) for name, values in arrays.items()}
        numbers |= {"status": (DIMS, status), "reason": ("seed", reasons)}
        made = {name: (*found, attributes(name)) for name, found in numbers.items()}
        coordinates = {
            "hurst": list(self.hurst),
            "study": [study.name for study in parameters.STUDIES],
            "parameter": (DIMS[1:3], np.array([place.value for place in places]).reshape(shape)[0]),
            "points": (DIMS[1:3], np.array([place.points for place in places]).reshape(shape)[0]),
            "seed": list(range(self.profiles)),
        }
        return xarray.Dataset(made, coordinates, {"solver": "MDR"})


@dataclass(frozen=True)
class Place:
    """One contact of Fig. 3: number of the study, value there, Hurst exponent, scene, and points of its grid."""

    study: int
    value: float
    hurst: float
    scene: Scene
    points: int


@lru_cache(maxsize=4)
def contacts(studies: ParameterStudies) -> tuple[Place, ...]:
    """Every contact, each study from its first value to its last, as neighbours help one another."""
    found = []
    for hurst in studies.hurst:
        for number, study in enumerate(parameters.STUDIES):
            chosen = np.linspace(0, len(study.values) - 1, studies.values).round().astype(int)
            for value in (study.values[i] for i in chosen):
                found.append(Place(number, value, hurst, *parameters.varied(study, value, hurst)))
    return tuple(found)


@dataclass(frozen=True)
class Profiles(ArrayTask):
    """Task of every contact of Fig. 3 on the profiles of some seeds; arrays (contacts, seeds)."""

    studies: ParameterStudies
    seeds: tuple[int, ...]
    names = tuple(field.name for field in fields(Answers))

    @property
    def label(self) -> str:
        """Number of contacts, and the profiles."""
        return f"Fig. 3, {len(contacts(self.studies))} contacts on profiles {self.seeds[0]} to {self.seeds[-1]}"

    @property
    def work(self) -> float:
        """Rough cost: beside a contact that is solved alone one of these is cheap."""
        return 1.5 * len(self.seeds) * sum(place.points for place in contacts(self.studies))

    @property
    def question(self) -> Mapping:
        """The scenes themselves, their points, the seeds."""
        found = contacts(self.studies)
        scenes = SCENES.dump_python(tuple(place.scene for place in found), mode="json")
        return {"scenes": scenes, "points": [place.points for place in found], "seeds": self.seeds}

    @property
    def shape(self) -> tuple[int, int]:
        """Contacts and seeds."""
        return len(contacts(self.studies)), len(self.seeds)

    def arrays(self) -> Mapping[str, np.ndarray]:
        """Arrays of mdr1d.ensemble.Answers."""
        found = contacts(self.studies)
        return vars(
            solve_profiles([place.scene for place in found], [place.points for place in found], self.seeds)
        )


@dataclass(frozen=True)
class SlowFriction:
    """Fig. 3 in the coordinates of Eqs. 17 and 18.

    points : study, parameter, hurst, xi, normalised_friction with its interval of 95 %, and conditions
    samples : mu-tilde of each profile (points, profiles)
    sweeps : mean number of sweeps of a solve
    """

    points: DataFrame
    samples: np.ndarray
    sweeps: float

    @property
    def with_macro_slope(self) -> np.ndarray:
        """mu-tilde where Eq. 10 keeps the slope of the macroscopic profile, over xi (points,)."""
        return (1 + self.points["macro_over_rough"] ** 2).to_numpy()


def slow_friction(studies: ParameterStudies, dataset: xarray.Dataset) -> SlowFriction:
    """Fig. 3 from what was solved, except profiles without a contact. Raises SolveError where all broke."""
    found = contacts(studies)
    solved = (dataset["status"] == SOLVED).any(DIMS[:3]).values
    if not solved.any():
        raise SolveError(f"Fig. 3: no profile was solved: {dataset['reason'].values[0]}")
    friction, slopes, sweeps = (
        dataset[name].values.reshape(len(found), -1)[:, solved]
        for name in ("friction_coefficient", "rms_slope", "sweeps")
    )
    slope = np.nanmean(slopes, axis=1)
    samples = equations.normalised_friction(friction, slopes)
    xi = np.array([parameters.variable(place.scene, s) for place, s in zip(found, slope, strict=True)])
    columns = {
        "study": [parameters.STUDIES[place.study].name for place in found],
        "parameter": [place.value for place in found],
        "hurst": [place.hurst for place in found],
        "xi": xi,
        **with_ends("normalised_friction", mean_ratio(samples)),
    }
    regime, slowly = regime_of([place.scene for place in found], slope), {"xi << 1": ("xi", xi, xi <= SLOW)}
    return SlowFriction(with_conditions(DataFrame(columns), regime, slowly), samples, float(np.nanmean(sweeps)))


@dataclass(frozen=True)
class Line:
    """ln mu-tilde = ln factor + slope ln xi, least squares over points, with errors over profiles.

    worst : largest |mu-tilde / xi - 1| of the points ; count : of points; with fewer than two all else is NaN
    """

    slope: Estimated[float]
    factor: Estimated[float]
    worst: float
    count: int

    @property
    def row(self) -> dict[str, float]:
        """Row of a table."""
        ends = with_ends("slope", self.slope) | with_ends("factor", self.factor)
        return {"count": self.count, **ends, "worst": self.worst}


def line(xi: np.ndarray, samples: np.ndarray, where: np.ndarray, over: np.ndarray | float = 1.0) -> Line:
    """Straight line through the logarithms of some points.

    xi : (points,); samples : mu-tilde (points, profiles), first divided by `over`; where : which points
    """
    where = where & np.isfinite(samples).all(axis=1)
    if np.unique(xi[where]).size < 2:
        unknown = Estimated(nan, nan, 0)
        return Line(unknown, unknown, nan, int(where.sum()))
    x, kept = np.log(xi[where]), (samples / np.reshape(over, (-1, 1)))[where]
    mean = kept.mean(axis=1)
    slope, factor = (
        Replicates.without_one(float(value), without).estimated
        for value, without in zip(_fit(x, mean), _fit(x, left_out(kept)), strict=True)
    )
    return Line(slope, factor, float(np.abs(mean / xi[where] - 1).max()), len(x))


def _fit(x, friction):
    slope, offset = np.polyfit(x, np.log(friction), 1)
    return slope, np.exp(offset)
