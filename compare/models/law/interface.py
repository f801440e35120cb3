"""A body of revolution on an elastic half-space whose roughness is a compliant layer between them."""

from dataclasses import dataclass
from functools import cache
from math import pi

import numpy as np
from scipy.special import ellipkm1, j0

from scene import SolveError
from scene.indenter import Axisymmetric
from scene.rheology import Elastomer

from ..exact.full_contact import complex_stiffness

# Mean gap over the rms height against the pressure over the rms pressure of full contact, of slow planes; straight
# in the logarithm below and above.
GAPS = ((0.005, 2.23), (0.02, 1.69), (0.05, 1.29), (0.1, 0.955), (0.2, 0.625), (0.5, 0.24), (1.0, 0.065), (2.0, 0.004))
STEEPEST = -0.38  # of the gap per logarithm of a pressure below these
STIFF = 500.0  # of the pressure per gap, above these
# Rings: of one width up to a radius over that of the smooth contact, then wider and wider.
EVEN, INNER, OUTER, WIDER = 48, 1.5, 8.0, 24
NODES = 24  # of a quadrature over a ring, on either side of its middle
WAVES = np.geomspace(0.05, 60.0, 120)  # wave numbers of a pressure, times the radius of the smooth contact
ROUNDS, CLOSE = 60, 1e-9


@dataclass(frozen=True)
class Rings:
    """Rings around the axis, in units of the smooth contact's radius: middles (N,), areas (N,)."""

    middle: np.ndarray
    area: np.ndarray
    compliance: np.ndarray  # displacement (N, N) at each by unit pressure on each, times E*
    waves: np.ndarray  # pressure of each wave number by that of each ring


@cache
def rings() -> Rings:
    """The rings, which are the same for all contacts."""
    edges = np.concatenate([np.linspace(0, INNER, EVEN + 1), np.geomspace(INNER, OUTER, WIDER + 1)[1:]])
    middle, area = (edges[1:] + edges[:-1]) / 2, pi * np.diff(edges**2)
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    # Quadrature on both sides of the middle, where the displacement of a line of pressure is infinite.
    ends = np.sort(np.concatenate([edges, middle]))
    half = np.diff(ends)[:, None] / 2
    s, w = (ends[:-1, None] + half * (1 + nodes)).ravel(), (half * weights).ravel()
    near = np.square((middle[:, None] - s) / (middle[:, None] + s))
    line = 4 * s * ellipkm1(near) / (pi * (middle[:, None] + s)) * w
    compliance = line.reshape(middle.size, middle.size, -1).sum(axis=2)
    spectrum = j0(WAVES[:, None] * s) * 2 * pi * s * w
    return Rings(middle, area, compliance, spectrum.reshape(WAVES.size, middle.size, -1).sum(axis=2))


@dataclass(frozen=True)
class SoftContact:
    """Nominal pressure of a rough body of revolution.

    radius : of the smooth contact [m]
    pressure : of each ring (N,) [Pa]
    load : [N]; depth : of the mean plane of the roughness below the undeformed surface [m]
    """

    radius: float
    pressure: np.ndarray
    load: float
    depth: float

    @classmethod
    def smooth(cls, shape: Axisymmetric, modulus: float, radius: float) -> "SoftContact":
        """The body without its roughness, of an E* [Pa]: Galin and Sneddon."""
        n, g = shape.exponent, shape.mdr_coefficient
        found, area = rings(), rings().area * radius**2
        r = found.middle[found.middle < 1]
        nodes, weights = np.polynomial.legendre.leggauss(40)
        top = np.arccosh(1 / r)[:, None]
        inner = np.sum(weights * top / 2 * np.cosh(top * (nodes + 1) / 2) ** (n - 1), axis=1) * r ** (n - 1)
        pressure = np.zeros_like(found.middle)
        pressure[: r.size] = inner
        load = 2 * n / (n + 1) * modulus * g * radius ** (n + 1)
        return cls(radius, pressure * load / np.sum(pressure * area), load, g * radius**n)

    @classmethod
    def of(
        cls,
        shape: Axisymmetric,
        modulus: float,
        smooth: "SoftContact",
        height: float,
        full: float,
        depth: float | None = None,
    ) -> "SoftContact":
        """The body with a layer of roughness of an rms height [m] and an rms pressure in full contact [Pa].

        depth : that is prescribed in place of the load of the smooth contact [m]

        Newton's method for the gap of each ring, shortened until the misfit falls.
        """
        found, radius = rings(), smooth.radius
        compliance, area = found.compliance * radius / modulus * full / height, found.area * radius**2 * full
        z, size = shape.height(found.middle * radius, 0.0) / height, found.middle.size
        sunk = (smooth.depth if depth is None else depth) / height

        scale = 1 + np.append(z + sunk, sunk)

        def misfit(unknown):
            x, slope = _pressure(unknown[:size])
            off = np.append(compliance @ x - unknown[:size] + z - unknown[size], unknown[size] - sunk)
            if depth is None:
                off[size] = (area @ x / smooth.load - 1) * sunk
            return x, slope, off, np.abs(off / scale).max()

        gaps = np.interp(np.log(np.maximum(smooth.pressure, 1e-3 * smooth.pressure.max()) / full), _LOGS, _GAPS)
        unknown = np.append(np.maximum(gaps, z - sunk), sunk)
        x, slope, off, worst = misfit(unknown)
        for _ in range(ROUNDS):
            matrix = np.zeros((size + 1, size + 1))
            matrix[:size, :size] = compliance * slope
            matrix[range(size), range(size)] -= 1.0
            matrix[:size, size] = -1.0
            if depth is None:
                matrix[size, :size] = area * slope / smooth.load * sunk
            else:
                matrix[size, size] = 1.0
            step, share = np.linalg.solve(matrix, -off), 1.0
            while share > 1e-6:
                tried = misfit(unknown + share * step)
                if tried[3] < worst:
                    break
                share /= 2
            unknown = unknown + share * step
            x, slope, off, worst = tried
            if worst < CLOSE:
                load = float(area @ x)
                return cls(radius, x * full, load, float(unknown[size]) * height)
        raise SolveError(f"the nominal pressure is not found in {ROUNDS} rounds")

    @property
    def area(self) -> np.ndarray:
        """Of each ring [m^2]."""
        return rings().area * self.radius**2

    @property
    def gyration(self) -> float:
        """Radius of gyration of the pressure [m]."""
        squares = np.sum(self.pressure * rings().area * np.square(rings().middle))
        return self.radius * float(np.sqrt(squares / np.sum(self.pressure * rings().area)))

    def friction(self, elastomer: Elastomer, speed: float) -> float:
        """Friction force [N] of this pressure, as it flows past: by the loss of each of its waves."""
        q = WAVES / self.radius
        waves = rings().waves @ self.pressure * self.radius**2
        nodes, weights = np.polynomial.legendre.leggauss(24)
        cosine = np.cos(pi / 4 * (1 + nodes))
        compliance = 1 / complex_stiffness(elastomer, speed * q[:, None] * cosine)
        lost = np.sum(weights / 2 * cosine * -compliance.imag, axis=1)
        return float(np.trapezoid(q**2 * waves**2 * lost / pi, np.log(q)))


_LOGS, _GAPS = np.log([x for x, _ in GAPS]), np.array([gap for _, gap in GAPS])


def _pressure(gaps):
    """Pressure over that of full contact, and its slope, at gaps over the rms height: straight where it is great."""
    place = np.clip(_GAPS.size - np.searchsorted(_GAPS[::-1], gaps) - 1, 0, _GAPS.size - 2)
    rate = (np.diff(_LOGS) / np.diff(_GAPS))[place]
    rate = np.where(gaps > _GAPS[0], 1 / STEEPEST, rate)
    start = np.where(gaps > _GAPS[0], 0, place)
    x = np.exp(_LOGS[start] + rate * (np.maximum(gaps, _GAPS[-1]) - _GAPS[start]))
    flat = gaps < _GAPS[-1]
    return np.where(flat, x - STIFF * (gaps - _GAPS[-1]), x), np.where(flat, -STIFF, rate * x)
