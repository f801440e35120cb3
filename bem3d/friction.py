"""Friction of a steady contact: estimates from one pressure, and the answer that joins their strengths."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from .grid import Grid
from .problem import Problem


@dataclass(frozen=True)
class Friction:
    """Friction of the surface on the indenter, found in four ways.

    by_traction, by_loss, by_work, by_curvature : [N]; see theory, Eqs. 2, 5d, 5e
    mean_curvature : of d2z/dx2 weighted with the pressure [1/m]
    lag, slowness : how far traction and curvature count, 0 to 1
    """

    by_traction: float
    by_loss: float
    by_work: float
    by_curvature: float
    mean_curvature: float
    lag: float
    slowness: float

    @classmethod
    def of(cls, problem: Problem, grid: Grid, pressure: np.ndarray) -> Self:
        """Friction from the pressure [Pa] (rows, points)."""
        slopes = problem.slopes(grid, problem.surface(grid))
        loss, work = problem.lost(grid, pressure)
        curvature = curvature_by_pressure(problem, grid, pressure)
        return cls(
            by_traction=float(-np.sum(pressure * slopes) * grid.patch),
            by_loss=loss,
            by_work=work,
            by_curvature=problem.flow.trail * curvature * float(pressure.sum() * grid.patch),
            mean_curvature=curvature,
            lag=problem.flow.lag(grid),
            # Without an edge nothing is lost of the loss.
            slowness=0.0 if pressure.all() else problem.flow.slowness(grid),
        )

    @property
    def force(self) -> float:
        """The answer [N]."""
        fast = self.lag * self.by_traction + (1 - self.lag) * self.by_loss
        return self.slowness * self.by_curvature + (1 - self.slowness) * fast

    @property
    def disagreement(self) -> float:
        """The most that the loss differs from another, as far as that counts [N]."""
        return max(
            (1 - self.slowness) * abs(self.by_work - self.by_loss),
            self.lag * abs(self.by_traction - self.by_loss),
            self.slowness * abs(self.by_curvature - self.by_loss),
        )

    def measures(self, normal_force: float) -> dict[str, float]:
        """Measures of a result by name."""
        return {
            "curvature_by_pressure": self.mean_curvature,
            "friction_by_traction": self.by_traction,
            "friction_by_loss": self.by_loss,
            "friction_by_work": self.by_work,
            "friction_by_curvature": self.by_curvature,
            "friction_disagreement": self.disagreement / normal_force,
        }


def curvature_by_pressure(problem: Problem, grid: Grid, pressure: np.ndarray) -> float:
    """Mean of d2z/dx2 [1/m], of indenter and roughness, weighted with the pressure.

    pressure : not zero everywhere [Pa] (rows, points)

    That of the roughness is exact at the pixels' centres, that of the indenter a difference of slopes in fourth
    order. What is left is the error of the pressure, of second order in the pixel, and of first order around the
    tip of a cone, where pressure and d2z/dx2 are infinite.
    """
    slopes = np.pad(problem.slopes(grid, None), ((0, 0), (2, 2)), "reflect", reflect_type="odd")
    next_to, next_but_one = slopes[:, 3:-1] - slopes[:, 1:-3], slopes[:, 4:] - slopes[:, :-4]
    gained = np.sum(pressure * (8 * next_to - next_but_one)) / (12 * grid.pixel)
    if (surface := problem.surface(grid)) is not None:
        gained += np.sum(pressure * surface.curvatures(grid.x, grid.y))
    return float(gained / pressure.sum())
