"""What a solver answers: the same fields from either dimension."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .scene import Scene


@dataclass(frozen=True)
class Result:
    """One solved scene.

    scene : what was asked
    solver, settings : name of the solver and every setting it solved with, the derived ones included
    normal_force, friction_force : F_N, F_x [N]; F_x > 0 opposes the motion of the indenter. Per length of a
        Cylinder [N/m], of one cell of a Plane
    depth : of the macroscopic tip below the undeformed surface [m], > 0 into the elastomer; see Cylinder and Plane
        for what theirs is counted from
    residual : left in the discrete contact conditions, relative; the solver's docstring defines it
    applications : operator applications, in equivalents of the finest grid
    seconds : processor time of the solve [s]
    measures : what else the solver measured, name -> number in SI units
    fields : arrays on the solver's grid, name -> array, SI units
    """

    scene: Scene
    solver: str
    settings: Mapping[str, Any]
    normal_force: float
    depth: float
    friction_force: float
    residual: float
    applications: float
    seconds: float
    measures: Mapping[str, float] = field(default_factory=dict)
    fields: Mapping[str, np.ndarray] = field(default_factory=dict, repr=False)

    @property
    def friction_coefficient(self) -> float:
        """mu = F_x / F_N; NaN where nothing is pressed."""
        return self.friction_force / self.normal_force if self.normal_force else float("nan")
