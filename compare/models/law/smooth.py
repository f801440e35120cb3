"""The smooth contact that a rough body of revolution slides on: what all of its roughness is added to."""

from dataclasses import dataclass, replace
from math import nan, pi, sqrt
from typing import Any

import numpy as np

from bem3d import BEM
from scene import Scene

# A hundredth of a second. Friction of spheres and cones is within 1 % of that on 512 points a side; the contact is
# up to 5 % too wide at high speed.
SPACE = BEM(points=64)
NOT_KEPT = np.empty(0)


@dataclass(frozen=True)
class SmoothContact:
    """A body of revolution without its roughness, at rest or sliding.

    load : [N]; depth : [m]
    friction_coefficient : [1]
    radius : of a disc with the area of the contact [m]
    pressure : of each pixel of the contact [Pa], (N,); pixel_area : [m^2]
    residual, operator_applications : of the solve, like those of a `Result`
    """

    load: float
    depth: float
    friction_coefficient: float
    radius: float
    pressure: np.ndarray
    pixel_area: float
    residual: float
    operator_applications: float

    @classmethod
    def of(cls, scene: Scene) -> "SmoothContact":
        """Smooth contact of a scene without its roughness. Raises Refused, SolveError."""
        found = SPACE.solve(replace(scene, roughness=None))
        return cls.of_answer(found, found.fields["pressure"])

    @classmethod
    def of_answer(cls, found: Any, pressure: np.ndarray = NOT_KEPT) -> "SmoothContact":
        """Smooth contact of a Result or a row of an outcome, and of the pressure of each pixel if it was kept."""
        return cls(
            load=found.normal_force,
            depth=found.depth,
            friction_coefficient=found.friction_coefficient,
            radius=sqrt(found.measures["contact_area"] / pi),
            pressure=pressure[pressure > 0],
            pixel_area=found.measures["pixel"] ** 2,
            residual=found.residual,
            operator_applications=found.operator_applications,
        )

    @classmethod
    def of_plane(cls, pressure: float, area: float) -> "SmoothContact":
        """A plane without its roughness, which touches everywhere."""
        return cls(pressure * area, nan, 0.0, sqrt(area / pi), np.array([pressure]), area, nan, nan)

    @property
    def area(self) -> float:
        """Area of the contact [m^2]."""
        return pi * self.radius**2

    @property
    def mean_pressure(self) -> float:
        """Load over area [Pa]."""
        return self.load / self.area
