"""Friction of a steady contact: estimates from a pressure, and the answer that combines them."""

from collections.abc import Callable
from dataclasses import dataclass
from math import inf
from typing import Self

import numpy as np

from scene.indenter import Axisymmetric

from ..grid import Grid
from ..problem import Problem
from ..surface import RoughSurface

# Grid and pressure [Pa] of its shape to the energy lost per length slid [J/m], as `Problem.lost` has it.
Lost = Callable[[Grid, np.ndarray], tuple[float, float]]


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
    def of(
        cls, problem: Problem, grid: Grid, pressure: np.ndarray, surface: RoughSurface | None, lost: Lost
    ) -> Self:
        """Friction by the pressure [Pa], of the shape of the grid, with this roughness."""
        slopes = problem.slopes(grid, surface)
        loss, work = lost(grid, pressure)
        curvature = curvature_by_pressure(problem.scene.indenter, grid, pressure, surface)
        return cls(
            by_traction=float(-np.sum(pressure * slopes) * grid.patch),
            by_loss=loss,
            by_work=work,
            by_curvature=problem.flow.lag_length * curvature * float(pressure.sum() * grid.patch),
            mean_curvature=curvature,
            lag=problem.flow.lag(grid),
            # Without an edge nothing is lost of the loss.
            slowness=0.0 if np.count_nonzero(pressure) == grid.points * grid.rows else problem.flow.slowness(grid),
        )

    @property
    def force(self) -> float:
        """The combined estimates [N]."""
        return self.joined(self)

    def joined(self, other: Self) -> float:
        """Estimates of another pressure, combined with the weights of this one [N]."""
        fast = self.lag * other.by_traction + (1 - self.lag) * other.by_loss
        return self.slowness * other.by_curvature + (1 - self.slowness) * fast

    @property
    def contradiction(self) -> float:
        """Largest weighted difference of traction or curvature from the loss, over the combined estimates."""
        most = max(
            self.lag * abs(self.by_traction - self.by_loss), self.slowness * abs(self.by_curvature - self.by_loss)
        )
        return most / abs(self.force) if self.force else 0.0 if most == 0 else inf

    @property
    def disagreement(self) -> float:
        """Largest weighted difference of another estimate from the loss [N]."""
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


def curvature_by_pressure(indenter, grid: Grid, pressure: np.ndarray, surface: RoughSurface | None) -> float:
    """Mean of d2z/dx2 [1/m], of indenter and roughness, weighted with the pressure.

    pressure : not zero everywhere [Pa], of the shape of the grid
    """
    curvatures = indenter_curvature(indenter, *grid.places, grid.pixel)
    if surface is not None:
        curvatures = curvatures + grid.sampled(surface.curvatures)
    return float(np.sum(pressure * curvatures) / pressure.sum())


def indenter_curvature(indenter, x, y, pixel: float) -> np.ndarray:
    """d2z/dx2 [1/m] of an indenter on pixels around x, y [m], of any broadcastable shapes.

    At their centres where it is known and finite: the pressure of a blunt body ends within a pixel, and a mean
    over that pixel counts what grows beyond the end. Else its mean along x over the pixel, from the slopes at
    both sides, as at the tip of a cone, where it is infinite.
    """
    if isinstance(indenter, Axisymmetric) and indenter.exponent >= 2:
        return indenter.curvature(x, y)
    return (indenter.slope(x + pixel / 2, y) - indenter.slope(x - pixel / 2, y)) / pixel
