"""Measures of a solved contact, of its grid and of its rough surface."""

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
        "spot_radius": grid.spot_radius(touched) if contact_points else 0.0,
    }
    if (surface := problem.surface(grid)) is not None:
        measures |= {
            "rms_height": surface.rms_height,
            "rms_slope": surface.rms_slope,
            "rms_slope_contact": float(np.sqrt(np.mean(np.square(problem.slopes(grid, surface)[touched]))))
            if contact_points
            else 0.0,
            "points_per_shortest_wave": problem.points_per_wave(grid),
        }
    elif problem.shortest(grid) is not None:
        measures["points_per_shortest_wave"] = problem.points_per_wave(grid)
    if isinstance(problem.scene.indenter, Plane):
        measures |= {
            "mean_pressure": float(pressure.mean()),
            "mean_gap": float(gap.mean()),
            "contact_fraction": float(contact_points / pressure.size),
        }
    return measures
