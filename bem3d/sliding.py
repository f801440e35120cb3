"""Steady sliding over a linear viscoelastic half-space, of which rest is the limit: physics put on a grid.

In the frame of the indenter the contact is steady. A retardation mode of time lambda turns the elastic kernel into
that kernel convolved downstream with exp(-s/l)/l, l = speed * lambda. Pressure is constant on a pixel, and the gap
is collocated behind the pixel's centre by the lag of the shortest wave that the grid carries: -arg(J(q))/q at
q = pi/pixel, J the compliance. Seen from there that wave follows without delay, so the operator stays definite
when the memory is many pixels long (half a pixel, the trailing edge) and accurate when it is short or the solid is
glassy (the centre).
"""

from dataclasses import dataclass

import numpy as np

from . import influence
from .convolution import FreeConvolution, PeriodicFilter
from .grid import Grid

SHORTEST = 1e-9  # memory [pixel]: what is shorter changes nothing that is solved
LEAST_DIFFERENCE = 1e-4  # memory [pixel] down to which the loss is taken from a difference of kernels


@dataclass(frozen=True)
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
        """At a speed [m/s]; at rest every mode has relaxed and the solid is elastic."""
        instantaneous, compliances, times = elastomer.retardation()
        if speed == 0 or len(times) == 0:
            return cls(elastomer.indentation_modulus, 1.0, np.empty(0), np.empty(0))
        relaxed = instantaneous + compliances.sum()
        return cls(elastomer.indentation_modulus, instantaneous / relaxed, compliances / relaxed, speed * times)

    @property
    def at_rest(self) -> bool:
        return len(self.lengths) == 0

    def collocation(self, grid: Grid) -> float:
        """How far [m] behind a pixel's centre the gap is measured: from 0 to half a pixel."""
        q = np.pi / grid.pixel
        compliance = self.instantaneous + np.sum(self.shares / (1 + 1j * q * self.lengths))
        return float(-np.angle(compliance) / q)

    def lag(self, grid: Grid) -> float:
        """That of the grid's shortest wave in quarters of its period: 0 of an elastic solid, 1 of a fluid."""
        return self.collocation(grid) / (grid.pixel / 2)

    def operator(self, grid: Grid, threads: int) -> FreeConvolution:
        """Pressure / E* on the pixels -> displacement / pixel at the points of collocation."""
        n = grid.points
        if self.at_rest:
            return FreeConvolution(influence.elastic(n, n), threads)
        shift = self.collocation(grid) / grid.pixel
        kernel = np.zeros((n, 2 * n))
        if self.instantaneous:
            kernel += self.instantaneous * influence.elastic(n, n, shift)
        for share, length in zip(self.shares, self.lengths, strict=True):
            kernel += share * influence.retarded(n, n, max(length / grid.pixel, SHORTEST), shift)
        return FreeConvolution(kernel, threads)

    def loss(self, grid: Grid, threads: int) -> FreeConvolution | None:
        """Pressure / E* -> slope of the displacement along the flow, as far as it dissipates; None at rest.

        A mode's displacement obeys w + l dw/dx = w_elastic, so its slope is (w_elastic - w)/l without any
        difference quotient. Of its kernel only the part even in x does work on the pressure: int p dw/dx dA is the
        energy lost per length slid, the sum of the loss compliance over the spectrum of the pressure.
        """
        if self.at_rest:
            return None
        n = grid.points
        elastic = influence.elastic(n, n)
        kernel = np.zeros((n, 2 * n))
        for share, length in zip(self.shares, self.lengths / grid.pixel, strict=True):
            # Of shorter memory the difference has no digits, but what counts of it is in proportion to the length.
            seen = max(length, LEAST_DIFFERENCE)
            kernel += share * (elastic - influence.retarded(n, n, seen, 0.0)) / seen * (length / seen)
        return FreeConvolution(kernel, threads)

    def preconditioner(self, grid: Grid, threads: int) -> PeriodicFilter:
        """Approximate inverse of the operator: |q|/2 over the discrete compliance of the modes."""

        def symbol(q_y, q_x):
            q = np.hypot(q_y, q_x)
            q[0, 0] = np.pi / grid.points  # half the lowest: a mean pressure on a free surface does push it in
            compliance = np.full(np.broadcast_shapes(q_y.shape, q_x.shape), complex(self.instantaneous))
            for share, length in zip(self.shares, self.lengths * grid.points / grid.extent, strict=True):
                gone = -np.expm1(-1 / max(length, SHORTEST))
                # 1 - exp(-1/length - i q_x), with its digits where both are small.
                compliance += share * gone / (gone - (1 - gone) * np.expm1(-1j * q_x))
            return q / 2 / compliance

        return PeriodicFilter((grid.points, grid.points), symbol, threads)
