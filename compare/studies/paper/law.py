"""Fig. 4: mu-tilde against xi up to the plateau, for a cone and a sphere, and the best alpha of Eq. 19."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import nan

import numpy as np
import xarray
from pandas import DataFrame
from scipy.optimize import minimize_scalar

from mdr1d import MDR, draw, equations
from scene import SolveError

from ...solving.outcome import Outcome
from ...comparison.curve import FINE, Curve
from ...solving.task import Task
from ...solving.vocabulary import attributes
from ...statistics.intervals import Estimated
from ...statistics.jackknife import Replicates, left_out, mean_ratio
from . import parameters
from .conditions import regime_of, with_conditions, with_ends
from .planes import Planes

VARIABLES = tuple(float(xi) for xi in np.geomspace(1e-2, 1e2, 25))
# Exponents among which the best is sought.
LEAST, MOST = 0.5, 5.0


def _slope():
    """Rms slope by finite differences; waves of fixed amplitude have the same on every profile."""
    return draw(parameters.ROUGH, parameters.POINTS).rms_slope


def speeds() -> dict[str, tuple[float, ...]]:
    """Speeds [m/s] at which xi is each of VARIABLES, by the name of the shape."""
    slope, found = _slope(), {}
    for shape in parameters.SHAPES:
        unit = parameters.variable(parameters.base(shape, speed=1.0), slope)
        found[shape] = tuple(xi / unit for xi in VARIABLES)
    return found


def parameter_grid(shape: str, profiles: int = parameters.PROFILES) -> Curve:
    """Contacts of one shape at every speed."""
    return Curve(
        scene=parameters.base(shape),
        speeds=speeds()[shape],
        values=(parameters.LOAD,),
        grids={"MDR": {FINE: MDR(points=parameters.POINTS)}},
        draws={"MDR": profiles},
    )


def planes(shape: str) -> Planes:
    """Task of one shape as rough planes at the same speeds."""
    return Planes(shape, speeds()[shape])


def planes_dataset(shape: str, outcomes: Mapping[Task, Outcome]) -> xarray.Dataset:
    """Friction of one shape as rough planes, with the dimension speed."""
    friction, asked = "friction_coefficient", planes(shape)
    values = {friction: ("speed", outcomes[asked].fields["friction"], attributes(friction))}
    return xarray.Dataset(values, {"speed": list(asked.speeds)}, {"solver": "planes"})


@dataclass(frozen=True)
class Law:
    """One shape in Fig. 4.

    shape : name
    points : xi, normalised_friction with its interval of 95 % over profiles, deviation_from_eq_19 (alpha = 1.5),
        normalised_friction_of_planes, and conditions
    alpha : least squares of ln mu-tilde over all points, with its error over profiles
    alphas : each without one profile (profiles,)
    by_criterion : the best alpha by each of CRITERIA
    left : farthest point from Eq. 19 with the best alpha, relative
    planes_alpha : best alpha where every place of the contact is a rough plane
    plateau : mu-tilde at the greatest xi over that of Eq. 19 there
    """

    shape: str
    points: DataFrame
    alpha: Estimated
    alphas: np.ndarray
    by_criterion: Mapping[str, float]
    left: float
    planes_alpha: float
    plateau: Estimated

    @property
    def profiles(self) -> int:
        """Number of profiles that are averaged."""
        return self.alphas.size

    @property
    def row(self) -> dict[str, float | str]:
        """Fitted exponents as a row of a table."""
        return {
            "shape": self.shape,
            "profiles": self.profiles,
            **with_ends("alpha", self.alpha),
            **{f"alpha_by_{name.replace(' ', '_')}": alpha for name, alpha in self.by_criterion.items()},
            "farthest_from_best_fit": self.left,
            "alpha_of_planes": self.planes_alpha,
            **with_ends("plateau", self.plateau),
        }


def law(shape: str, solved: xarray.Dataset, of_planes: xarray.Dataset) -> Law:
    """One shape from what was solved, except speeds without an answer. Raises SolveError where none has one."""
    slope, fine = _slope(), solved.sel(level=FINE).isel(load=0)
    friction = (fine["friction_force"] / fine["normal_force"]).transpose("speed", "surface").values
    known = np.isfinite(friction).any(axis=1)
    if not known.any():
        raise SolveError(f"Fig. 4, {shape}: nothing was solved: {fine['reason'].values.flat[0]}")
    samples = equations.normalised_friction(friction[known], slope)
    kept = samples[:, np.isfinite(samples).all(axis=0)]
    found, scene = mean_ratio(kept), parameters.base(shape)
    mean, error = found.value, found.error
    xi = np.array([parameters.variable(parameters.base(shape, v), slope) for v in fine["speed"].values[known]])
    alpha, alphas = best(xi, mean), np.array([best(xi, without) for without in left_out(kept).T])
    by_planes = equations.normalised_friction(of_planes["friction_coefficient"].values[known], slope)
    top = equations.interpolation(xi[-1])
    columns = {
        "shape": shape,
        "xi": xi,
        **with_ends("normalised_friction", found),
        "deviation_from_eq_19": mean / equations.interpolation(xi) - 1,
        "normalised_friction_of_planes": by_planes,
    }
    return Law(
        shape=shape,
        points=with_conditions(DataFrame(columns), regime_of([scene], slope)),
        alpha=Replicates.without_one(alpha, alphas).estimated,
        alphas=alphas,
        by_criterion={name: best(xi, mean, error, criterion) for name, criterion in CRITERIA.items()},
        left=float(np.max(np.abs(mean / equations.interpolation(xi, alpha) - 1))),
        planes_alpha=best(xi, by_planes),
        plateau=mean_ratio(kept[-1], top),
    )


def difference(one: Law, other: Law) -> Estimated:
    """Difference of alpha between two shapes on the same profiles."""
    count = min(one.profiles, other.profiles)
    apart = one.alphas[:count] - other.alphas[:count]
    return Replicates.without_one(one.alpha.value - other.alpha.value, apart).estimated


# What is least at the best alpha, of friction, law and standard errors, by name.
CRITERIA: dict[str, Callable] = {
    "logarithms": lambda friction, law, error: np.sum(np.square(np.log(friction / law))),
    "differences": lambda friction, law, error: np.sum(np.square(friction - law)),
    "chi square": lambda friction, law, error: np.sum(np.square((friction - law) / error)),
    "worst point": lambda friction, law, error: np.max(np.abs(friction / law - 1)),
}


def best(xi, friction, error=None, criterion=CRITERIA["logarithms"]) -> float:
    """The alpha of Eq. 19 with which one of CRITERIA is least; NaN of NaN."""
    if not np.isfinite(friction).all():
        return nan

    def misfit(alpha):
        return criterion(friction, equations.interpolation(xi, alpha), error)

    return float(minimize_scalar(misfit, bounds=(LEAST, MOST), method="bounded", options={"xatol": 1e-6}).x)
