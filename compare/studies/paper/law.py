"""Fig. 4: mu-tilde against xi up to the plateau, for a cone and a sphere, and the claims of the paper."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import xarray
from pandas import DataFrame
from scipy.optimize import minimize_scalar

from mdr1d import equations
from scene import SolveError

from ...solving.curve import FINE, Curve
from ...statistics.finding import Claim, Finding
from ...statistics.intervals import Estimated
from ...statistics.jackknife import Replicates, left_out, mean_ratio
from . import parameters
from .parameter_studies import SlowFriction

VARIABLES = np.geomspace(1e-2, 1e2, 25)
# Exponents among which the best is sought.
LEAST, MOST = 0.5, 5.0


def curve(shape: str, profiles: int) -> Curve:
    """Contacts of a shape at the speeds at which xi is each of VARIABLES."""
    speeds = VARIABLES / _variable(shape)
    return parameters.grid(parameters.base(shape), speeds.tolist(), [parameters.LOAD], profiles)


def _variable(shape):
    """The variable xi of a shape at 1 m/s."""
    return parameters.variable(parameters.base(shape, speed=1.0), parameters.rms_slope())


@dataclass(frozen=True)
class Law:
    """One shape in Fig. 4.

    shape : name
    points : xi, normalised_friction with its interval of 95 % over profiles, whether the conditions hold
    alpha : least squares of ln mu-tilde over all points, with its error over profiles
    alphas : each without one profile (profiles,)
    plateau : mu-tilde at the greatest xi, divided by the value of Eq. 19 there
    """

    shape: str
    points: DataFrame
    alpha: Estimated
    alphas: np.ndarray
    plateau: Estimated

    @property
    def profiles(self) -> int:
        """Number of profiles that are averaged."""
        return self.alphas.size

    def less(self, other: "Law") -> Estimated:
        """Difference of alpha from another shape on the same profiles."""
        apart = [one - two for one, two in zip(self.alphas, other.alphas, strict=False)]
        return Replicates.without_one(self.alpha.value - other.alpha.value, np.array(apart)).estimated


def law(shape: str, solved: xarray.Dataset) -> Law:
    """One shape from what was solved, except speeds without an answer. Raises SolveError where none has one."""
    fine = solved.sel(level=FINE).isel(load=0)
    friction = (fine["friction_force"] / fine["normal_force"]).transpose("speed", "surface")
    friction = friction.dropna("speed", how="all").dropna("surface")
    if not friction.size:
        raise SolveError(f"Fig. 4, {shape}: nothing was solved")
    slope, xi = parameters.rms_slope(), _variable(shape) * friction["speed"].values
    samples = equations.normalised_friction(friction.values, slope)
    found = mean_ratio(samples)
    alpha, alphas = best(xi, found.value), np.array([best(xi, without) for without in left_out(samples).T])
    holds = parameters.holds(parameters.regime(parameters.base(shape), slope))
    columns = {"shape": shape, "xi": xi, **found.columns("normalised_friction"), "holds": holds}
    return Law(
        shape=shape,
        points=DataFrame(columns),
        alpha=Replicates.without_one(alpha, alphas).estimated,
        alphas=alphas,
        plateau=mean_ratio(samples[-1], equations.interpolation(xi[-1])),
    )


def best(xi: np.ndarray, friction: np.ndarray) -> float:
    """The alpha of Eq. 19 that is nearest to friction, least squares of logarithms."""

    def misfit(alpha):
        return np.sum(np.square(np.log(friction / equations.interpolation(xi, alpha))))

    return float(minimize_scalar(misfit, bounds=(LEAST, MOST), method="bounded", options={"xatol": 1e-6}).x)


EXPONENT = Claim(
    id="paper.eq17.exponent",
    sentence="Eq. 17: friction at low speed grows as ξ¹ where its conditions hold",
    expected=1.0,
    tolerance=0.02,
    meaning="Exponent of a power law through points with ξ at most 0.05, h₀ at most d/10, 2a below L, and a "
    "macroscopic slope of at most a fifth of the slope of the roughness. Small slopes are not among the "
    "conditions: "
    "with heights, the slope of the cone and the load times any number, friction is times that number exactly.",
    dimension="1D",
)
ANY_SLOPE = replace(
    EXPONENT,
    id="paper.eq17.exponent.any-slope",
    sentence="Eq. 17: friction at low speed grows as ξ¹ whatever the macroscopic slope",
    meaning="Exponent without the condition on the macroscopic slope: Eq. 11 drops it, which on a nearly smooth "
    "profile makes all the friction.",
)
SLOPE_KEPT = replace(
    EXPONENT,
    id="paper.eq17.exponent.slope-kept",
    sentence="Eq. 17: friction at low speed grows as ξ¹ with the macroscopic slope kept as in Eq. 10",
    meaning="Exponent without the condition on the macroscopic slope, with the mean square of both slopes in "
    "place of the mean square slope of the roughness.",
)
ALPHA = Claim(
    id="paper.eq19.alpha",
    sentence="Eq. 19: the exponent α that joins low speed and plateau is 1.5",
    expected=1.5,
    tolerance=0.1,
    meaning="Least squares of ln μ over all ξ.",
    dimension="1D",
)
SAME_ALPHA = Claim(
    id="paper.eq19.alpha.difference",
    sentence="Eq. 19: α does not depend on the shape",
    expected=0.0,
    tolerance=0.1,
    meaning="Difference of α between the shapes, on the same profiles. Places of a cone differ more in depth, "
    "and lose contact over a wider range of speeds.",
    dimension="1D",
)
PLATEAU = Claim(
    id="paper.eq14.plateau",
    sentence="Eq. 14: the plateau of friction is √2 times the rms slope",
    expected=1.0,
    tolerance=0.03,
    meaning="μ̃ at the greatest ξ over Eq. 19 there, with the rms slope by finite differences.",
    dimension="1D",
)


def of_low_speed(slow: SlowFriction) -> Iterator[Finding]:
    """Eq. 17: where its conditions hold, with any macroscopic slope, and with that slope kept."""
    for claim, condition, over in (
        (EXPONENT, "holds", 1.0),
        (ANY_SLOPE, "slow", 1.0),
        (SLOPE_KEPT, "slow", slow.with_macro_slope),
    ):
        slope, count = slow.power(slow.points[condition].to_numpy(), over)
        yield Finding.of(claim, slope, draws=slow.samples.shape[1], regime=f"{count} points")


def of_law(one: Law, other: Law) -> Iterator[Finding]:
    """Eq. 19 and Eq. 14, of each shape and between both."""
    for law in (one, other):
        yield Finding.of(ALPHA, law.alpha, where=law.shape, draws=law.profiles)
        yield Finding.of(PLATEAU, law.plateau, where=law.shape, draws=law.profiles)
    between, draws = f"{one.shape} minus {other.shape}", min(one.profiles, other.profiles)
    yield Finding.of(SAME_ALPHA, one.less(other), where=between, draws=draws)
