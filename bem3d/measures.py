"""What a solved contact measures of itself, on a grid and under a rough surface."""

from math import pi, sin

import numpy as np

from scene import Plane

from .grid import Grid
from .problem import Problem


def measured(problem: Problem, grid: Grid, pressure: np.ndarray, gap: np.ndarray) -> dict[str, float]:
    """Measures of a result from its pressure [Pa] and gap [m]; of a plane and of roughness where there is one."""
    touched = pressure > 0
    contact_points = int(np.count_nonzero(touched))
    measures = {
        "pixel": grid.pixel,
        "contact_area": float(contact_points * grid.patch),
        "contact_points": float(contact_points),
        "points_across_contact": float(grid.box(touched).side / grid.pixel) if contact_points else 0.0,
    }
    if (surface := problem.surface(grid)) is not None:
        measures |= {
            "rms_height": surface.rms_height,
            "rms_slope": surface.rms_slope,
            "points_per_shortest_wave": float(2 * np.pi / problem.scene.roughness.q_max(grid.pixel) / grid.pixel),
        }
    if isinstance(problem.scene.indenter, Plane):
        measures |= {
            "mean_pressure": float(pressure.mean()),
            "mean_gap": float(gap.mean()),
            "contact_fraction": float(contact_points / pressure.size),
        }
    return measures


def differenced(waves: float) -> float:
    """Share of the curvature of a wave of so many points that differences of slopes show: 0 of two points."""
    q = 2 * pi / waves
    return (8 * sin(q) - sin(2 * q)) / (6 * q)


def curvature_by_pressure(problem: Problem, grid: Grid, pressure: np.ndarray, slopes: np.ndarray) -> float:
    """Mean of d2z/dx2 [1/m], of indenter and roughness, weighted with the pressure.

    pressure : not zero everywhere [Pa] (rows, points)
    slopes : dz/dx at the pixels' centres [1] (rows, points)

    Slopes are differenced in fourth order: what is left is the error of the pressure, of second order in the
    pixel, of first order around the tip of a cone, where pressure and d2z/dx2 are infinite, and of waves of a few
    points what `differenced` leaves of them.
    """
    two = (0, 0), (2, 2)
    if isinstance(problem.scene.indenter, Plane):
        slopes = np.pad(slopes, two, "wrap")
    else:
        slopes = np.pad(slopes, two, "reflect", reflect_type="odd")
    next_to, next_but_one = slopes[:, 3:-1] - slopes[:, 1:-3], slopes[:, 4:] - slopes[:, :-4]
    gained = np.sum(pressure * (8 * next_to - next_but_one)) / 12
    return float(gained / pressure.sum() / grid.pixel)
