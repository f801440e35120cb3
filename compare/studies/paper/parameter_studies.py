"""Fig. 3: six parameter studies of slow friction on a rough cone, and their collapse on mu-tilde = xi, Eq. 17."""

from collections.abc import Mapping, Sequence
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

from ...solving.task import Outcome, Row, Task
from ...solving.vocabulary import attributes
from ...statistics.intervals import Estimated
from ...statistics.jackknife import Replicates, left_out, mean_ratio
from . import parameters

# Profiles in a task: few enough that an interruption loses some seconds of work at most, and enough that preparing
# the scenes takes little of them.
TOGETHER = 25
# Eq. 17 is the limit of Eq. 19: at this xi that lies 0.7 % lower.
SLOW = 0.05
# Arrays of mdr1d.ensemble.Answers by the names of a Dataset.
NAMES = {
    "friction": "friction_coefficient",
    "depth": "depth_reached",
    "length": "contact_length",
    "rms_slope": "rms_slope",
}


@dataclass(frozen=True)
class Contact:
    """One contact of Fig. 3: what is varied, its value, Hurst exponent, scene, and points of its grid."""

    study: str
    parameter: float
    hurst: float
    scene: Scene
    points: int


@lru_cache(maxsize=4)
def contacts(values: int) -> tuple[Contact, ...]:
    """Every contact with some of the values of each study, from the first to the last: neighbours help another."""
    found = []
    for hurst in parameters.HURST:
        for study, (*_, every) in parameters.STUDIES.items():
            for k in np.linspace(0, len(every) - 1, values).round().astype(int):
                found.append(Contact(study, every[k], hurst, *parameters.varied(study, every[k], hurst)))
    return tuple(found)


@dataclass(frozen=True)
class Profiles(Task):
    """A task, see `task.Task`: every contact of Fig. 3 on the profiles of some seeds; fields (contacts, seeds)."""

    values: int
    seeds: tuple[int, ...]
    keeps_fields = True
    packages = ("scene", "mdr1d", parameters.__name__, __name__)

    @property
    def label(self) -> str:
        """Which profiles."""
        return f"Fig. 3 on profiles {self.seeds[0]} to {self.seeds[-1]}"

    @property
    def work(self) -> float:
        """Rough cost: compared with a contact that is solved alone, each of these is cheap."""
        return 1.5 * len(self.seeds) * sum(each.points for each in contacts(self.values))

    @property
    def question(self) -> Mapping[str, Any]:
        """Number of values of each study, and the seeds."""
        return {"values": self.values, "seeds": self.seeds}

    def solve(self) -> Outcome:
        """Solve all of them at once."""
        scenes, points = zip(*((each.scene, each.points) for each in contacts(self.values)), strict=True)
        return Outcome((), vars(solve_profiles(scenes, points, self.seeds)))

    def failed(self, reason: str) -> Outcome:
        """Outcome of NaN everywhere, with a row for the reason."""
        unknown = np.full((len(contacts(self.values)), len(self.seeds)), nan)
        return Outcome((Row(reason=reason),), {field.name: unknown for field in fields(Answers)})

    def fits(self, outcome: Outcome) -> bool:
        """Whether every array is there and has its shape."""
        shape = len(contacts(self.values)), len(self.seeds)
        return all(np.shape(outcome.fields.get(name, 0.0)) == shape for name in NAMES)


def tasks(values: int, profiles: int) -> list[Profiles]:
    """Tasks, each of every contact on some of the profiles."""
    seeds = tuple(range(profiles))
    return [Profiles(values, seeds[first : first + TOGETHER]) for first in seeds[::TOGETHER]]


def dataset(asked: Sequence[Profiles], outcomes: Mapping[Task, Outcome]) -> xarray.Dataset:
    """Dataset with the dimensions contact and surface; `parameter` is what the study of a contact varies."""
    numbers = {
        name: (("contact", "surface"), np.hstack([outcomes[task].fields[own] for task in asked]), attributes(name))
        for own, name in NAMES.items()
    }
    coordinates = {
        name: ("contact", [getattr(each, name) for each in contacts(asked[0].values)], attributes(name))
        for name in ("study", "parameter", "hurst", "points")
    }
    seeds = [seed for task in asked for seed in task.seeds]
    return xarray.Dataset(numbers, {**coordinates, "surface": seeds}, {"solver": "MDR"})


@dataclass(frozen=True)
class SlowFriction:
    """Fig. 3 in the coordinates of Eqs. 17 and 18.

    points : study, parameter, hurst, xi, normalised_friction with its interval of 95 %, ratios of scene.Regime,
        whether all conditions of Eq. 17 hold, and whether all but that on the macroscopic slope do
    samples : mu-tilde of each profile (points, profiles)
    """

    points: DataFrame
    samples: np.ndarray

    @property
    def with_macro_slope(self) -> np.ndarray:
        """mu-tilde where Eq. 10 keeps the slope of the macroscopic profile, over xi (points,)."""
        return (1 + self.points["macro_over_rough"] ** 2).to_numpy()

    def power(self, where: np.ndarray, over: np.ndarray | float = 1.0) -> tuple[Estimated, int]:
        """Exponent of the power law of xi through some points, and their number; NaN of fewer than two.

        over : by which mu-tilde is divided first
        """
        where = where & np.isfinite(self.samples).all(axis=1)
        if where.sum() < 2:
            return Estimated(nan, nan, 0), int(where.sum())
        x = np.log(self.points["xi"][where])
        kept = (self.samples / np.reshape(over, (-1, 1)))[where]
        value, without = (np.polyfit(x, np.log(each), 1)[0] for each in (kept.mean(axis=1), left_out(kept)))
        return Replicates.without_one(float(value), without).estimated, len(x)


def slow_friction(values: int, solved: xarray.Dataset) -> SlowFriction:
    """Fig. 3 from what was solved, except profiles without a contact. Raises SolveError where all broke."""
    solved = solved.dropna("surface", how="all", subset=["friction_coefficient"])
    if not solved.sizes["surface"]:
        raise SolveError("Fig. 3: no profile was solved")
    slopes = solved["rms_slope"].mean("surface").values
    samples = equations.normalised_friction(solved["friction_coefficient"].values, slopes[:, None])
    rows = []
    for each, slope in zip(contacts(values), slopes.tolist(), strict=True):
        regime, xi = parameters.regime(each.scene, slope), parameters.variable(each.scene, slope)
        slow = xi <= SLOW and regime.flags["2a < L"] and regime.flags["h0 << d"]
        row = {name: getattr(each, name) for name in ("study", "parameter", "hurst")}
        rows.append(
            row | {"xi": xi, **vars(regime), "holds": xi <= SLOW and parameters.holds(regime), "slow": slow}
        )
    return SlowFriction(DataFrame(rows).assign(**mean_ratio(samples).columns("normalised_friction")), samples)
