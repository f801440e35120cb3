"""Fig. 4: mu-tilde against xi up to the plateau, for a cone and a sphere, and the best alpha of Eq. 19."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import nan, sqrt

import numpy as np
from scipy.optimize import minimize_scalar

from mdr1d import MDR, draw, equations
from scene import Regime, Slide, SolveError
from scene.scales import elastic_contact

from ..outcome import Outcome
from ..statistics.jackknife import interval, left_out, standard_error
from ..store import Task as AnyTask
from ..study import Task
from . import parameters
from .campaign import variable
from .conditions import Conditions
from .planes import Planes

VARIABLES = tuple(float(xi) for xi in np.geomspace(1e-2, 1e2, 25))
# Exponents among which the best is sought.
LEAST, MOST = 0.5, 5.0


def tasks(shape: str, profiles: int = parameters.PROFILES) -> list[Task | Planes]:
    """The tasks of one shape, one a xi, in each of which the profiles differ; and that of its planes."""
    unit = variable(parameters.base(shape, speed=1.0), _slope())
    speeds = tuple(xi / unit for xi in VARIABLES)
    return [*(_task(shape, speed, profiles) for speed in speeds), Planes(shape, speeds)]


def _task(shape, speed, profiles):
    scene, solver = parameters.base(shape, speed), MDR(points=parameters.POINTS)
    scenes = tuple(replace(scene, roughness=replace(scene.roughness, seed=seed)) for seed in range(profiles))
    return Task(solver, scenes, work=len(scenes) * parameters.POINTS * 15.0)


def _slope():
    """By finite differences; waves of fixed amplitude have the same on every profile."""
    return draw(parameters.ROUGH, parameters.POINTS).rms_slope


@dataclass(frozen=True)
class Law:
    """One shape in Fig. 4, arrays (points,) or (points, profiles).

    shape : its name
    xi : Eq. 18
    friction, error, samples : mu-tilde, its standard error, and that of each profile
    conditions : of each point
    alpha, alpha_interval : least squares of ln mu-tilde over all points; 95 %, of the sampling of profiles alone
    alphas : each without one profile (profiles,)
    by_criterion : the best alpha by each of CRITERIA
    chi_square : per degree of freedom, of the best alpha by it
    planes : mu-tilde with every place of the contact a rough plane; planes_alpha : its best alpha
    plateau, plateau_error : mu-tilde at the greatest xi over that of Eq. 19 there
    failed : solves without an answer
    """

    shape: str
    xi: np.ndarray
    friction: np.ndarray
    error: np.ndarray
    samples: np.ndarray
    conditions: Conditions
    alpha: float
    alpha_interval: tuple[float, float]
    alphas: np.ndarray
    by_criterion: Mapping[str, float]
    chi_square: float
    planes: np.ndarray
    planes_alpha: float
    plateau: float
    plateau_error: float
    failed: int

    @property
    def deviation(self) -> np.ndarray:
        """mu-tilde over Eq. 19 with alpha = 1.5, minus one."""
        return self.friction / equations.interpolation(self.xi) - 1

    @property
    def left(self) -> str:
        """Whether the best alpha leaves more than scatter, in words."""
        more = (
            "more than scatter: systematic"
            if self.chi_square > 1 + 2 * sqrt(2 / (self.xi.size - 1))
            else "scatter"
        )
        return f"the best leaves {more}, chi square {self.chi_square:.2g} per degree of freedom"


def collect(shape: str, found: list[Task | Planes], outcomes: Mapping[AnyTask, Outcome]) -> Law:
    """Put the tasks of one shape together, but for those that broke. Raises SolveError where all did."""
    slope = _slope()
    *found, planes = found
    solved = np.array([any(row.reason is None for row in outcomes[task].rows) for task in found])
    if not solved.any():
        raise SolveError(f"Fig. 4, {shape}: nothing was solved: {outcomes[found[0]].rows[0].reason}")
    found = [task for task, known in zip(found, solved, strict=True) if known]
    rows = [outcomes[task].rows for task in found]
    friction = np.array([[row.friction_coefficient for row in row_of] for row_of in rows])
    samples = equations.normalised_friction(friction, slope)
    xi = np.array([variable(task.scenes[0], slope) for task in found])
    kept = samples[:, np.isfinite(samples).all(axis=0)]
    count = kept.shape[1]
    mean, error = kept.mean(axis=1), kept.std(axis=1, ddof=1) / np.sqrt(count)
    alpha, alphas = best(xi, mean), np.array([best(xi, without) for without in left_out(kept).T])
    by_criterion = {name: best(xi, mean, error, criterion) for name, criterion in CRITERIA.items()}
    off = (mean - equations.interpolation(xi, by_criterion["chi square"])) / error
    by_planes = equations.normalised_friction(outcomes[planes].fields["friction"][solved], slope)
    top = equations.interpolation(xi[-1])
    scene = found[0].scenes[0]
    relaxed = elastic_contact(replace(scene, motion=Slide(speed=0.0, load=scene.motion.load)))
    regime = Regime.of(
        profile=(scene.indenter.mdr_coefficient, scene.indenter.exponent),
        contact=(relaxed.radius, relaxed.depth),
        rms_height=scene.roughness.rms_height,
        longest=parameters.LENGTH,
        rms_slope=slope,
    )
    return Law(
        shape=shape,
        xi=xi,
        friction=mean,
        error=error,
        samples=samples,
        conditions=Conditions.of(regime, xi.shape),
        alpha=alpha,
        alpha_interval=interval(alpha, float(standard_error(alphas)), count - 1),
        alphas=alphas,
        by_criterion=by_criterion,
        chi_square=float(off @ off / (off.size - 1)),
        planes=by_planes,
        planes_alpha=best(xi, by_planes),
        plateau=float(mean[-1] / top),
        plateau_error=float(error[-1] / top),
        failed=int(np.isnan(samples).sum()) + samples.shape[1] * int(np.sum(~solved)),
    )


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
