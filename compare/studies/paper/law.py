"""Fig. 4: mu-tilde against xi up to the plateau, for a cone and a sphere, and the best alpha of Eq. 19."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import nan

import numpy as np
import xarray
from pandas import DataFrame
from scipy.optimize import minimize_scalar

from mdr1d import MDR, draw, equations
from scene import Regime, Slide, SolveError
from scene.scales import elastic_contact

from ...outcome import Outcome
from ...rectangle import FINE, Rectangle
from ...statistics.jackknife import Estimated, left_out, standard_error
from ...task import Task
from ...vocabulary import attributes
from . import parameters
from .conditions import with_conditions
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


def rectangle(shape: str, profiles: int = parameters.PROFILES) -> Rectangle:
    """Contacts of one shape at every speed."""
    return Rectangle(
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
        (alpha_low, alpha_high), (low, high) = self.alpha.interval(), self.plateau.interval()
        return {
            "shape": self.shape,
            "profiles": self.profiles,
            "alpha": self.alpha.value,
            "alpha_low": alpha_low,
            "alpha_high": alpha_high,
            **{f"alpha_by_{name.replace(' ', '_')}": alpha for name, alpha in self.by_criterion.items()},
            "farthest_from_best_fit": self.left,
            "alpha_of_planes": self.planes_alpha,
            "plateau": self.plateau.value,
            "plateau_low": low,
            "plateau_high": high,
        }


def law(shape: str, solved: xarray.Dataset, of_planes: xarray.Dataset) -> Law:
    """One shape from what was solved, but for speeds without an answer. Raises SolveError where none has one."""
    slope, fine = _slope(), solved.sel(grid=FINE).isel(load=0)
    friction = (fine["friction_force"] / fine["normal_force"]).transpose("speed", "draw").values
    known = np.isfinite(friction).any(axis=1)
    if not known.any():
        raise SolveError(f"Fig. 4, {shape}: nothing was solved: {fine['reason'].values.flat[0]}")
    samples = equations.normalised_friction(friction[known], slope)
    kept = samples[:, np.isfinite(samples).all(axis=0)]
    count = kept.shape[1]
    scene = parameters.base(shape)
    xi = np.array([parameters.variable(parameters.base(shape, v), slope) for v in fine["speed"].values[known]])
    mean, error = kept.mean(axis=1), kept.std(axis=1, ddof=1) / np.sqrt(count)
    low, high = Estimated(mean, error, count - 1).interval()
    alpha, alphas = best(xi, mean), np.array([best(xi, without) for without in left_out(kept).T])
    by_planes = equations.normalised_friction(of_planes["friction_coefficient"].values[known], slope)
    top = equations.interpolation(xi[-1])
    relaxed = elastic_contact(replace(scene, motion=Slide(speed=0.0, load=scene.motion.load)))
    regime = Regime.of(
        profile=(scene.indenter.mdr_coefficient, scene.indenter.exponent),
        contact=(relaxed.radius, relaxed.depth),
        rms_height=scene.roughness.rms_height,
        longest=parameters.LENGTH,
        rms_slope=slope,
    )
    points = DataFrame(
        {
            "shape": shape,
            "xi": xi,
            "normalised_friction": mean,
            "normalised_friction_low": low,
            "normalised_friction_high": high,
            "deviation_from_eq_19": mean / equations.interpolation(xi) - 1,
            "normalised_friction_of_planes": by_planes,
        }
    )
    return Law(
        shape=shape,
        points=with_conditions(points, regime),
        alpha=Estimated(alpha, float(standard_error(alphas)), count - 1),
        alphas=alphas,
        by_criterion={name: best(xi, mean, error, criterion) for name, criterion in CRITERIA.items()},
        left=float(np.max(np.abs(mean / equations.interpolation(xi, alpha) - 1))),
        planes_alpha=best(xi, by_planes),
        plateau=Estimated(float(mean[-1] / top), float(error[-1] / top), count - 1),
    )


def difference(one: Law, other: Law) -> Estimated:
    """Difference of alpha between two shapes on the same profiles."""
    count = min(one.profiles, other.profiles)
    error = float(standard_error(one.alphas[:count] - other.alphas[:count]))
    return Estimated(one.alpha.value - other.alpha.value, error, count - 1)


def _logarithms(friction, law, error):
    return np.sum(np.square(np.log(friction / law)))


def _differences(friction, law, error):
    return np.sum(np.square(friction - law))


def _errors(friction, law, error):
    return np.sum(np.square((friction - law) / error))


def _worst(friction, law, error):
    return np.max(np.abs(friction / law - 1))


# What is least at the best alpha, by name.
CRITERIA = {"logarithms": _logarithms, "differences": _differences, "chi square": _errors, "worst point": _worst}


def best(xi, friction, error=None, criterion=_logarithms) -> float:
    """The alpha of Eq. 19 with which a criterion of friction, law and standard errors is least; NaN of NaN."""
    if not np.isfinite(friction).all():
        return nan

    def misfit(alpha):
        return criterion(friction, equations.interpolation(xi, alpha), error)

    return float(minimize_scalar(misfit, bounds=(LEAST, MOST), method="bounded", options={"xatol": 1e-6}).x)
