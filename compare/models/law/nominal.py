"""The nominal contact: a body of revolution on an elastic half-space, its roughness a soft layer between them."""

from dataclasses import dataclass
from functools import cache
from math import log, pi, sqrt

import numpy as np
from scipy.special import ellipkm1, j0, wrightomega

from scene import PowerLaw, SolveError
from scene.solids.viscoelastic import Linear

from ..exact.solver import smooth_pressure
from .bands import around

# Mean gap over the rms height against the pressure over the rms pressure of full contact: of rough planes.
GAPS = {0.005: 2.23, 0.02: 1.69, 0.05: 1.29, 0.1: 0.955, 0.2: 0.625, 0.5: 0.24, 1.0: 0.065, 2.0: 0.004}
THINNER = -0.38  # change of that gap per logarithm of a pressure below these
CLOSED = 500.0  # of the pressure, over the greatest there is, per gap that is missing above these: nearly rigid
# Rings: EVEN ones out to INNER radii of the smooth contact, then WIDER ones that grow, out to OUTER radii; NODES
# of the quadrature over either half of a ring.
EVEN, INNER, WIDER, OUTER, NODES = 48, 1.5, 24, 8.0, 24
WAVES = np.geomspace(0.05, 60.0, 120)  # wave numbers of a pressure, times the radius of the smooth contact
ROUNDS, CLOSE, SHORTEST_STEP = 60, 1e-12, 1e-6
THINNEST = 1e-9  # of a layer over the depth, below which there is none
_LOGS, _GAPS = np.log(list(GAPS)), np.array(list(GAPS.values()))
# Fall of the logarithm of a pressure per gap: below the first of these, and between each two.
_RATES = -np.append(1 / THINNER, np.diff(_LOGS) / np.diff(_GAPS))


def mean_gap(x: float) -> float:
    """Mean gap of a rough plane over its rms height; x : pressure over the rms pressure of full contact."""
    return float(np.interp(log(x), _LOGS, _GAPS)) + THINNER * min(log(x) - _LOGS[0], 0.0)


@dataclass(frozen=True)
class Rings:
    """Rings around the axis, in units of the radius of the smooth contact.

    middle, area : of each (N,)
    compliance : displacement at each by unit pressure on each (N, N), times E*
    transform : Hankel transform of unit pressure on each (WAVES, N)
    """

    middle: np.ndarray
    area: np.ndarray
    compliance: np.ndarray
    transform: np.ndarray

    @classmethod
    @cache
    def all(cls) -> "Rings":
        """The rings, which are the same for all contacts."""
        edges = np.concatenate([np.linspace(0, INNER, EVEN + 1), np.geomspace(INNER, OUTER, WIDER + 1)[1:]])
        middle = (edges[1:] + edges[:-1]) / 2
        nodes, weights = np.polynomial.legendre.leggauss(NODES)
        # On either side of the middle, where a line of pressure around the axis displaces without bound.
        ends = np.sort(np.concatenate([edges, middle]))
        half = np.diff(ends)[:, None] / 2
        s, w = (ends[:-1, None] + half * (1 + nodes)).ravel(), (half * weights).ravel()
        near = np.square((middle[:, None] - s) / (middle[:, None] + s))
        displaced = 4 * s * ellipkm1(near) / (pi * (middle[:, None] + s)) * w
        transformed = j0(WAVES[:, None] * s) * 2 * pi * s * w
        compliance, transform = (
            each.reshape(len(each), middle.size, -1).sum(axis=2) for each in (displaced, transformed)
        )
        return cls(middle, pi * np.diff(edges**2), compliance, transform)


@dataclass(frozen=True)
class NominalContact:
    """Pressure of a body of revolution, its spots of contact smeared out.

    radius : of the smooth contact [m]
    pressure : of each ring (N,) [Pa]
    """

    radius: float
    pressure: np.ndarray

    @classmethod
    def smooth(cls, exponent: float, radius: float, load: float) -> "NominalContact":
        """Body r^n without roughness, of an elastic half-space."""
        rings = Rings.all()
        r = rings.middle[rings.middle < 1]
        pressure = np.zeros_like(rings.middle)
        pressure[: r.size] = smooth_pressure(PowerLaw(1.0, exponent), 1.0, 1.0, r)
        return cls(radius, pressure * load / np.sum(pressure * rings.area * radius**2))

    def on_layer(self, exponent: float, depth: float, height: float, full: float) -> "NominalContact":
        """Contact under the same load, with a layer as soft as roughness is.

        depth : of the smooth contact [m]
        height, full : rms height [m], and rms pressure in full contact [Pa]

        Newton's method for the push on each ring, its displacement by its own pressure less its gap: where the
        layer is far stiffer than the elastomer the displacement follows the push, where it is far softer the gap
        does, so that kinks in the law of the layer hardly matter. A step is shortened until the misfit falls.
        Raises SolveError.
        """
        if height < THINNEST * depth:
            return self
        rings, load = Rings.all(), self.load
        modulus = load * (exponent + 1) / (2 * exponent * depth * self.radius)
        softness = rings.compliance * self.radius / modulus * full / height
        weight = rings.area * self.radius**2 * full / load
        own = softness.diagonal()
        others = softness - np.diag(own)
        z = depth / height / PowerLaw(1.0, exponent).mdr_coefficient * rings.middle**exponent
        size, sunk, stiff = z.size, depth / height, CLOSED * max(1.0, self.pressure.max() / full)
        scale = 1 + np.append(z + sunk, sunk)

        def misfit(unknown):
            x, slope = _pressed(unknown[:size], own, stiff)
            off = np.append(others @ x + unknown[:size] + z - unknown[size], (weight @ x - 1) * sunk)
            return x, slope, off, np.abs(off / scale).max()

        unknown = np.append(sunk - z - others @ (self.pressure / full), sunk)
        x, slope, off, worst = misfit(unknown)
        for _ in range(ROUNDS):
            if worst < CLOSE:
                return NominalContact(self.radius, x * full)
            matrix = np.zeros((size + 1, size + 1))
            matrix[:size, :size] = others * slope + np.eye(size)
            matrix[:size, size], matrix[size, :size] = -1.0, weight * slope * sunk
            step, share = np.linalg.solve(matrix, -off), 1.0
            while (tried := misfit(unknown + share * step))[3] >= worst and share > SHORTEST_STEP:
                share /= 2
            unknown = unknown + share * step
            x, slope, off, worst = tried
        raise SolveError(f"the nominal pressure was not found in {ROUNDS} rounds, a misfit of {worst:.1g} is left")

    @property
    def area(self) -> np.ndarray:
        """Area of each ring [m^2], (N,)."""
        return Rings.all().area * self.radius**2

    @property
    def load(self) -> float:
        """Load [N]."""
        return float(np.sum(self.pressure * self.area))

    @property
    def spread(self) -> float:
        """Radius of gyration of the pressure [m]."""
        return self.radius * sqrt(np.sum(self.pressure * self.area * Rings.all().middle ** 2) / self.load)

    def lost(self, elastomer: Linear, speed: float) -> float:
        """Friction force [N] that this pressure has as it flows past at a speed [m/s]: the loss of its waves."""
        q = WAVES / self.radius
        waves = Rings.all().transform @ self.pressure * self.radius**2
        cosine, shares, stiffness = around(elastomer, speed, q)
        loss = np.sum(shares * cosine * -(1 / stiffness).imag, axis=1)
        return float(np.trapezoid(np.square(q * waves) * loss / pi, np.log(q)))


def _pressed(push, own, stiff):
    """Pressure over the pressure in full contact, and its slope, where rings and the layer on them share a push.

    push : displacement of each ring by its own pressure, less its gap, over the rms height (N,)
    own : displacement of each ring by unit pressure on it, likewise (N,)
    stiff : slope of the pressure where the layer is closed
    """
    ends = own * np.exp(_LOGS)[:, None] - _GAPS[:, None]
    passed = np.sum(push >= ends, axis=0)
    place = np.minimum(passed, _GAPS.size - 1)
    start, rate = np.maximum(place - 1, 0), _RATES[place]
    # x = exp(L + rate (push + gap) - rate own x) is y = rate own x with y + ln y = ln(rate own) + L + ...
    y = wrightomega(np.log(rate * own) + _LOGS[start] + rate * (push + _GAPS[start]))
    closed, share = passed == _GAPS.size, stiff / (1 + own * stiff)
    x = np.where(closed, np.exp(_LOGS[-1]) + share * (push - ends[-1]), y / (rate * own))
    return x, np.where(closed, share, y / (1 + y) / own)
