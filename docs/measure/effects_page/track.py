"""Friction on its way through a program: where it comes to, and what it does."""

from dataclasses import dataclass
from math import inf, nan

import numpy as np

from compare.solving.outcome import Outcome

NEAR = 0.05  # of the friction that is tended to


@dataclass(frozen=True)
class Track:
    """Friction through one program in one dimensionality; arrays (steps,) of SI units, empty where it failed."""

    time: np.ndarray
    path: np.ndarray
    friction: np.ndarray

    @classmethod
    def of(cls, outcome: Outcome) -> "Track":
        names = "time", "path", "friction_force"
        return cls(*(np.asarray(outcome.fields.get(name, ()), float) for name in names))

    def within(self, start: float, end: float = inf) -> "Track":
        """From one moment to another [s]."""
        there = (self.time >= start * (1 - 1e-9)) & (self.time <= end * (1 + 1e-9))
        return Track(self.time[there], self.path[there], self.friction[there])

    @property
    def mean(self) -> float:
        """Friction in time [N]; NaN where there is none."""
        if len(self.time) < 2:
            return nan
        return float(np.trapezoid(self.friction, self.time) / np.ptp(self.time))

    @property
    def work(self) -> float:
        """Done against friction [J]."""
        return float(np.trapezoid(self.friction, self.path)) if len(self.path) else nan

    def until(self, target: float) -> float:
        """Way on which friction comes to within NEAR of a target for good [m]; NaN where it does not."""
        off = np.flatnonzero(np.abs(self.friction / target - 1) > NEAR)
        if not len(off) or off[-1] == len(self.path) - 1:
            return nan
        return float(abs(self.path[off[-1] + 1] - self.path[0]))

    @property
    def until_zero(self) -> float:
        """Way on which friction comes to zero [m]; NaN where it does not."""
        past = np.flatnonzero(self.friction <= 0)
        return float(abs(self.path[past[0]] - self.path[0])) if len(past) else nan
