"""Fig. 4: mu-tilde against xi up to the plateau, for a cone and a sphere, and the best alpha of Eq. 19."""

from dataclasses import dataclass

import numpy as np
import xarray
from pandas import DataFrame
from scipy.optimize import minimize_scalar

from mdr1d import equations
from scene import SolveError

from ...solving.curve import FINE, Curve
from ...statistics.intervals import Estimated
from ...statistics.jackknife import Replicates, left_out, mean_ratio
from . import parameters
from .parameter_studies import with_ends

VARIABLES = np.geomspace(1e-2, 1e2, 25)
# Exponents among which the best is sought.
LEAST, MOST = 0.5, 5.0


def curve(shape: str, profiles: int) -> Curve:
    """Contacts of one shape at the speeds at which xi is each of VARIABLES."""
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
    plateau : mu-tilde at the greatest xi over that of Eq. 19 there
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
    columns = {"shape": shape, "xi": xi, **with_ends("normalised_friction", found), "holds": holds}
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
