"""Fig. 4: mu-tilde against xi up to the plateau, for a cone and a sphere, and the best alpha of Eq. 19."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import minimize_scalar

from mdr1d import MDR, draw, equations
from scene import Regime, Slide
from scene.scales import elastic_contact

from ..outcome import Outcome
from ..resampling import interval, left_out, standard_error
from ..store import Task as AnyTask
from ..study import Task
from . import parameters
from .campaign import variable

VARIABLES = tuple(float(xi) for xi in np.geomspace(1e-2, 1e2, 25))
# Exponents among which the best is sought.
LEAST, MOST = 0.5, 5.0


def tasks(shape: str, profiles: int = parameters.PROFILES) -> list[Task]:
    """The tasks of one shape, one a xi; in each the profiles differ."""
    unit = variable(parameters.base(shape, speed=1.0), _slope())
    return [_task(shape, xi / unit, profiles) for xi in VARIABLES]


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
    regime : against what the law presupposes
    alpha, alpha_interval : least squares of ln mu-tilde over all points; 95 %
    alphas : each without one profile (profiles,)
    plateau, plateau_error : mu-tilde at the greatest xi over that of Eq. 19 there
    failed : solves without an answer
    """

    shape: str
    xi: np.ndarray
    friction: np.ndarray
    error: np.ndarray
    samples: np.ndarray
    regime: Regime
    alpha: float
    alpha_interval: tuple[float, float]
    alphas: np.ndarray
    plateau: float
    plateau_error: float
    failed: int

    @property
    def deviation(self) -> np.ndarray:
        """mu-tilde over Eq. 19 with alpha = 1.5, minus one."""
        return self.friction / equations.interpolation(self.xi) - 1


def collect(shape: str, found: list[Task], outcomes: Mapping[AnyTask, Outcome]) -> Law:
    """Put the tasks of one shape together."""
    slope = _slope()
    rows = [outcomes[task].rows for task in found]
    friction = np.array([[row.friction_coefficient for row in row_of] for row_of in rows])
    samples = equations.normalised_friction(friction, slope)
    xi = np.array([variable(task.scenes[0], slope) for task in found])
    kept = samples[:, np.isfinite(samples).all(axis=0)]
    count = kept.shape[1]
    mean, error = kept.mean(axis=1), kept.std(axis=1, ddof=1) / np.sqrt(count)
    alpha, alphas = _best(xi, mean), np.array([_best(xi, without) for without in left_out(kept).T])
    top = equations.interpolation(xi[-1])
    scene = found[0].scenes[0]
    relaxed = elastic_contact(replace(scene, motion=Slide(speed=0.0, load=scene.motion.load)))
    return Law(
        shape=shape,
        xi=xi,
        friction=mean,
        error=error,
        samples=samples,
        regime=Regime.of(
            profile=(scene.indenter.mdr_coefficient, scene.indenter.exponent),
            contact=(relaxed.radius, relaxed.depth),
            rms_height=scene.roughness.rms_height,
            longest=parameters.LENGTH,
            rms_slope=slope,
        ),
        alpha=alpha,
        alpha_interval=interval(alpha, standard_error(alphas), count - 1),
        alphas=alphas,
        plateau=float(mean[-1] / top),
        plateau_error=float(error[-1] / top),
        failed=int(np.isnan(samples).sum()),
    )


def _best(xi, friction):
    """The alpha of least squares in ln mu-tilde."""

    def misfit(alpha):
        return np.sum(np.square(np.log(friction / equations.interpolation(xi, alpha))))

    return float(minimize_scalar(misfit, bounds=(LEAST, MOST), method="bounded", options={"xatol": 1e-6}).x)
