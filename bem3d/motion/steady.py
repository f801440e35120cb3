"""Steady sliding over a linear viscoelastic half-space, with rest as the limit: physics put on a grid.

In the frame of the indenter the contact is steady. A retardation mode of time lambda turns the elastic kernel into
that kernel convolved downstream with exp(-s/l)/l, l = speed * lambda. Pressure is constant on a pixel, and the gap
is collocated behind the pixel's centre by the lag of the shortest wave that the grid carries: -arg(J(q))/q at
q = pi/pixel, J the compliance. Seen from there that wave follows without delay, so the operator stays definite
when the memory is many pixels long (half a pixel, the trailing edge) and accurate when it is short or the solid is
glassy (the centre).
"""

from dataclasses import dataclass

import numpy as np

from ..grid import Grid

SHORTEST = 1e-9  # memory [pixel]: what is shorter changes nothing that is solved


@dataclass(frozen=True, eq=False)
class Flow:
    """The elastomer as it flows past.

    modulus : relaxed E* [Pa]
    instantaneous : share of the relaxed compliance that follows at once
    shares, lengths : of the retardation modes (K,), and speed times retardation time (K,) [m]; none at rest
    """

    modulus: float
    instantaneous: float
    shares: np.ndarray
    lengths: np.ndarray

    @classmethod
    def of(cls, elastomer, speed: float) -> "Flow":
        """Flow at a speed [m/s]; at rest every mode has relaxed and the solid is elastic."""
        instantaneous, compliances, times = elastomer.retardation()
        if speed == 0 or len(times) == 0:
            return cls(elastomer.indentation_modulus, 1.0, np.empty(0), np.empty(0))
        relaxed = instantaneous + compliances.sum()
        return cls(elastomer.indentation_modulus, instantaneous / relaxed, compliances / relaxed, speed * times)

    def __eq__(self, other):
        return isinstance(other, Flow) and self._numbers == other._numbers

    def __hash__(self):
        return hash(self._numbers)

    @property
    def _numbers(self):
        return self.modulus, self.instantaneous, self.shares.tobytes(), self.lengths.tobytes()

    @property
    def at_rest(self) -> bool:
        return len(self.lengths) == 0

    def collocation(self, grid: Grid) -> float:
        """Distance [m] behind a pixel's centre at which the gap is measured: from 0 to half a pixel."""
        return float(-np.angle(self.compliance(np.pi, grid.pixel)) / np.pi * grid.pixel)

    def lag(self, grid: Grid) -> float:
        """Lag of the grid's shortest wave in quarters of its period: 0 of an elastic solid, 1 of a fluid."""
        return self.collocation(grid) / (grid.pixel / 2)

    @property
    def lag_length(self) -> float:
        """Length [m] by which a slow contact trails the relaxed one: speed times the mean lag of the elastomer."""
        return float(self.shares @ self.lengths)

    @property
    def memory(self) -> float:
        """Mean length of the modes [m], each weighted with its part of the lag length."""
        if self.lag_length == 0:
            return 0.0
        return float(self.shares * self.lengths / self.lag_length @ self.lengths)

    def slowness(self, grid: Grid) -> float:
        """Weight of friction to first order in the speed against friction by the pressure: 1 to 0.

        The next order is left out; relative to the first it is about the length of the modes that lose most, over
        the length of the shortest wave. Friction by loss has an error of about a pixel over that wave. Rough and
        smooth contacts are best joined where that length is a quarter of a pixel, on all grids.
        """
        if self.at_rest:
            return 0.0
        # The first order in the speed has no bound in a fast contact: nothing may be left of it.
        return 1 / (1 + min(4 * self.memory / grid.pixel, 1e75) ** 4)

    def in_pixels(self, grid: Grid) -> np.ndarray:
        """Memory lengths (K,) [pixel]; the shortest are kept from vanishing."""
        return np.maximum(self.lengths / grid.pixel, SHORTEST)

    def compliance(self, q, pixel: float):
        """J at wave numbers q along the flow [rad/pixel], over the relaxed one."""
        total = np.full(np.shape(q), complex(self.instantaneous))
        for share, length in zip(self.shares, self.lengths / pixel, strict=True):
            total += share / (1 + 1j * q * length)
        return total
