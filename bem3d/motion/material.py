"""The elastomer in the window as it creeps in time: each mode has a displacement of its own.

The displacement of a mode of time lambda obeys dw/dt = (A p - w)/lambda at every point of the material, A p being
what the pressure does once all has relaxed: held constant, it draws w there exponentially. Displacements are in m,
pressures in units of the relaxed E*.
"""

from dataclasses import dataclass

import numpy as np

from .upstream import Endless, Repeating

LEAST_STEP = 1e-3  # over the time of a mode: shorter steps are collocated alike, but lose digits


@dataclass(frozen=True)
class Creep:
    """Retardation modes over the relaxed compliance: share that follows at once, shares and times [s] (K,)."""

    instantaneous: float
    shares: np.ndarray
    times: np.ndarray

    @classmethod
    def of(cls, elastomer) -> "Creep":
        instantaneous, compliances, times = elastomer.retardation()
        relaxed = instantaneous + compliances.sum()
        return cls(instantaneous / relaxed, compliances / relaxed, times)

    def collocation(self, step: float) -> float:
        """Time [s] into a step, from its middle on, at which a pressure held in steps displaces as it should.

        Where a pressure that rises evenly displaces the surface as far as one that rises in steps through the same
        values in their middles: the delay of what lasts many steps is then exact, and with it the loss. Near the
        middle for a glassy solid or a short memory, at 1/2 + 1/sqrt(12) of short steps of a Kelvin body.
        """
        from scipy.optimize import brentq  # slow, and only contacts in time need it

        if len(self.times) == 0:
            return step / 2
        short = step / self.times
        seen = np.maximum(short, LEAST_STEP)
        shares = self.shares * short / seen

        def excess(at):
            delayed = 1 / seen - np.exp(-at * seen) / -np.expm1(-seen)
            return self.instantaneous * (0.5 - at) + shares @ (0.5 - at + delayed)

        return brentq(excess, 0.5, 1.0) * step

    def kept(self, time: float) -> np.ndarray:
        """Part of the displacement of each mode that is kept after a time (K,)."""
        return np.exp(-time / self.times)

    def gained(self, time: float) -> np.ndarray:
        """Part of the relaxed displacement that each mode gains in a time, 1 - kept (K,)."""
        return -np.expm1(-time / self.times)

    def compliance(self, time: float) -> float:
        """Creep compliance J(t), over the relaxed compliance."""
        return self.instantaneous + float(self.shares @ self.gained(time))

    def loss_in_steps(self, step: float) -> np.ndarray:
        """Loss of each mode to a slow pressure over that to the same pressure held in steps (K,)."""
        half = step / self.times / 2
        return np.tanh(half) / half


class Material:
    """Memory of the elastomer in a window of (ny, nx) points that is kept around a moving indenter.

    creep : the modes
    """

    def __init__(self, creep: Creep, around: Endless | Repeating):
        self.creep, self._around, self._window = creep, around, around.window

    def offset(self, path: float) -> float:
        """Distance of the points downstream from their place on the grid, on a path [m]."""
        return path - self._window.shifts * self._window.grid.pixel

    def follow(self, path: float, time: float) -> int:
        """Shift the window until it is around the indenter, on a path [m] at a time [s].

        Returns by how many pixels, less than zero backwards.
        """
        before = self._window.shifts
        self._around.follow(path, time)
        return self._window.shifts - before

    def remembered(self, time: float) -> np.ndarray:
        """Displacement [m] (ny, nx) that will be left, without pressure, a time [s] from now."""
        return np.einsum("k,kyx->yx", self.creep.shares * self.creep.kept(time), self._window.fields)

    def crept(self, time: float, pressure: np.ndarray, relaxed: np.ndarray) -> float:
        """Carry the modes over a time [s] under a pressure; they tend to the displacement `relaxed` [m] (ny, nx).

        Returns the work of the pressure on the modes, per pixel's area.
        """
        kept, gained, work = self.creep.kept(time), self.creep.gained(time), 0.0
        factors = zip(kept, gained, self.creep.shares * self.creep.loss_in_steps(time), strict=True)
        for field, (stays, comes, share) in zip(self._window.fields, factors, strict=True):
            work += share * comes * float(np.sum(pressure * (relaxed - field)))
            field *= stays
            field += comes * relaxed
        self._around.creep(pressure, kept, gained)
        return work
