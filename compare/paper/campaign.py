"""Fig. 3: six parameter studies of slow friction on a rough cone, and their collapse on mu-tilde = xi, Eq. 17."""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from functools import lru_cache
from math import nan

import numpy as np

from mdr1d import equations
from mdr1d.ensemble import Answers, solve_profiles
from scene import Regime, Scene, SolveError
from scene.scales import elastic_contact

from ..outcome import Outcome, Row
from ..statistics.jackknife import interval, left_out, standard_error
from ..store import Task
from ..study import SCENES
from . import parameters
from .conditions import Conditions

# Profiles of one task: some seconds of work are lost at most in an interruption, and to prepare the scenes takes
# little of them.
BLOCK = 20
# Eq. 17 is the limit of Eq. 19: at this xi that lies 0.7 % lower.
SLOW = 0.05


@dataclass(frozen=True)
class Campaign:
    """How much of Fig. 3: values of each study, Hurst exponents, profiles. As published: all 20, all 11, 200."""

    values: int = 20
    hurst: tuple[float, ...] = parameters.HURST
    profiles: int = parameters.PROFILES


@dataclass(frozen=True)
class Place:
    """Where in the campaign a scene stands: which study, the value there, and the Hurst exponent."""

    study: int
    value: float
    hurst: float
    scene: Scene
    points: int


@lru_cache(maxsize=4)
def places(campaign: Campaign) -> tuple[Place, ...]:
    """Every scene, each study from its first value to its last, as neighbours help one another."""
    found = []
    for hurst in campaign.hurst:
        for number, study in enumerate(parameters.STUDIES):
            chosen = np.linspace(0, len(study.values) - 1, campaign.values).round().astype(int)
            for value in (study.values[i] for i in chosen):
                found.append(Place(number, value, hurst, *parameters.varied(study, value, hurst)))
    return tuple(found)


@dataclass(frozen=True)
class Block:
    """A task: every scene of the campaign on the profiles of some seeds."""

    campaign: Campaign
    seeds: tuple[int, ...]
    keeps_fields = True
    packages = ("scene", "mdr1d")

    @property
    def label(self) -> str:
        """Which profiles."""
        return f"Fig. 3, {len(places(self.campaign))} contacts on profiles {self.seeds[0]} to {self.seeds[-1]}"

    @property
    def work(self) -> float:
        """As of store, in passes over a node: beside a contact that is solved alone one of these is cheap."""
        return 1.5 * len(self.seeds) * sum(place.points for place in places(self.campaign))

    @property
    def question(self) -> Mapping:
        """The scenes themselves, their points, the seeds."""
        found = places(self.campaign)
        scenes = SCENES.dump_python(tuple(place.scene for place in found), mode="json")
        return {"scenes": scenes, "points": [place.points for place in found], "seeds": self.seeds}

    def solve(self) -> Outcome:
        """All of it; Outcome.fields has the arrays of Answers."""
        found = places(self.campaign)
        scenes, points = [place.scene for place in found], [place.points for place in found]
        return Outcome((), vars(solve_profiles(scenes, points, self.seeds)))

    def failed(self, reason: str) -> Outcome:
        """NaN everywhere, and a row for the reason."""
        missing = np.full((len(places(self.campaign)), len(self.seeds)), np.nan)
        return Outcome((Row(reason=reason),), {field.name: missing for field in fields(Answers)})

    def fits(self, outcome: Outcome) -> bool:
        """Every array, of the whole shape."""
        shape = len(places(self.campaign)), len(self.seeds)
        return all(np.shape(outcome.fields.get(field.name, ())) == shape for field in fields(Answers))


def blocks(campaign: Campaign) -> list[Block]:
    """The tasks of a campaign."""
    seeds = range(campaign.profiles)
    return [Block(campaign, tuple(seeds[first : first + BLOCK])) for first in seeds[::BLOCK]]


@dataclass(frozen=True)
class Collapse:
    """The campaign in the coordinates of Eqs. 17 and 18, arrays (scenes,) or (scenes, profiles).

    study, value, hurst : where each scene stands
    xi : the variable of Eq. 18
    friction, error : mu-tilde, mean over the profiles and its standard error
    samples : mu-tilde of each profile (scenes, profiles)
    regime : against what Eq. 17 presupposes
    failed : solves without an answer
    sweeps : mean number of sweeps of a solve
    """

    study: np.ndarray
    value: np.ndarray
    hurst: np.ndarray
    xi: np.ndarray
    friction: np.ndarray
    error: np.ndarray
    samples: np.ndarray
    regime: Regime
    failed: int
    sweeps: float

    @property
    def conditions(self) -> Conditions:
        """Of Eq. 17."""
        return Conditions.of(self.regime, self.xi.shape).joined("xi", self.xi, "xi << 1", self.xi <= SLOW)

    @property
    def holds(self) -> np.ndarray:
        """Where the conditions do, but for small slopes."""
        return self.conditions.holds

    @property
    def with_macro_slope(self) -> np.ndarray:
        """What mu-tilde is where Eq. 10 keeps the slope of the macroscopic profile, over xi."""
        return np.asarray(1 + self.regime.macro_over_rough**2)


def collect(campaign: Campaign, outcomes: Mapping[Task, Outcome]) -> Collapse:
    """Put the blocks of a campaign together, but for those that broke. Raises SolveError where all did."""
    found, asked = places(campaign), [outcomes[block] for block in blocks(campaign)]
    broken = [row.reason for outcome in asked for row in outcome.rows]
    if len(broken) == len(asked):
        raise SolveError(f"Fig. 3: no profile was solved: {broken[0]}")
    parts = [outcome.fields for outcome in asked if not outcome.rows]
    whole = Answers(*(np.hstack([part[field.name] for part in parts]) for field in fields(Answers)))
    slope = np.nanmean(whole.rms_slope, axis=1)
    samples = equations.normalised_friction(whole.friction, whole.rms_slope)
    count = np.isfinite(samples).sum(axis=1)
    contacts = [elastic_contact(place.scene) for place in found]
    coefficient = np.array([place.scene.indenter.mdr_coefficient for place in found])
    return Collapse(
        study=np.array([place.study for place in found]),
        value=np.array([place.value for place in found]),
        hurst=np.array([place.hurst for place in found]),
        xi=np.array([variable(place.scene, s) for place, s in zip(found, slope, strict=True)]),
        friction=np.nanmean(samples, axis=1),
        error=np.nanstd(samples, axis=1, ddof=1) / np.sqrt(count),
        samples=samples,
        regime=Regime.of(
            profile=(coefficient, 1.0),
            contact=(np.array([c.radius for c in contacts]), np.array([c.depth for c in contacts])),
            rms_height=np.array([place.scene.roughness.rms_height for place in found]),
            longest=parameters.LENGTH,
            rms_slope=slope,
        ),
        failed=int(np.isnan(samples).sum()) + len(found) * (campaign.profiles - samples.shape[1]),
        sweeps=float(np.nanmean(whole.sweeps)),
    )


def variable(scene: Scene, rms_slope: float) -> float:
    """xi of a scene on a Kelvin solid, Eq. 18."""
    body, solid, motion = scene.indenter, scene.elastomer, scene.motion
    return equations.similarity_variable(
        motion.load,
        solid.modulus,
        solid.relaxation_time,
        motion.speed,
        rms_slope,
        body.mdr_coefficient,
        body.exponent,
    )


@dataclass(frozen=True)
class Line:
    """ln mu-tilde = ln factor + slope ln xi, least squares over points, with intervals of 95 %.

    worst : largest |mu-tilde / xi - 1| of the points ; points : how many; with fewer than two all else is NaN
    """

    slope: float
    slope_interval: tuple[float, float]
    factor: float
    factor_interval: tuple[float, float]
    worst: float
    points: int


def line(collapse: Collapse, where: np.ndarray, over: np.ndarray | float = 1.0) -> Line:
    """Fit a straight line through some points, their friction first divided by what is given."""
    where = where & np.isfinite(collapse.samples).all(axis=1)
    if np.unique(collapse.xi[where]).size < 2:
        return Line(nan, (nan, nan), nan, (nan, nan), nan, int(where.sum()))
    x = np.log(collapse.xi[where])
    samples = (collapse.samples / np.reshape(over, (-1, 1)) if np.ndim(over) else collapse.samples)[where]
    fit = _fit(x, samples.mean(axis=1))
    errors = standard_error(np.array([_fit(x, mean) for mean in left_out(samples).T]))
    freedom = samples.shape[1] - 1
    slopes, factors = (interval(value, error, freedom) for value, error in zip(fit, errors, strict=True))
    worst = np.abs(samples.mean(axis=1) / collapse.xi[where] - 1).max()
    return Line(float(fit[0]), slopes, float(fit[1]), factors, float(worst), len(x))


def _fit(x, friction):
    slope, offset = np.polyfit(x, np.log(friction), 1)
    return slope, np.exp(offset)
