"""Isotropic roughness as bands of waves, and what they do in full contact with a solid that flows past them."""

from dataclasses import dataclass, replace
from math import hypot, log, pi, prod, sqrt, tanh
from typing import Any

import numpy as np
from scipy.special import j1, jv

from scene import Profile, Spectrum, Topography
from scene.solids.viscoelastic import Linear
from scene.surfaces.isotropic import Isotropic
from scene.surfaces.topography import Waves

from ..exact.full_contact import complex_stiffness

# Nodes of the spectrum, and of directions over a quarter of a circle.
_WAVES, _DIRECTIONS = 48, 24
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(_DIRECTIONS)
_COSINE, _SHARES = np.cos(pi / 4 * (1 + _NODES)), _WEIGHTS / 2
FASTER = 4.0  # times the speed of waves: spots of contact are smaller than waves, and are passed that much faster
ROUNDING = 1e-16  # of the share of a wave that a disc leaves


def directed(rough: Isotropic | Topography | Profile) -> float:
    """Rms slope of a map in the direction in which it is greatest, over that across; 1 of what has none."""
    if not isinstance(rough, Topography):
        return 1.0
    waves = rough.waves
    q_x, q_y = waves.along_x[None, :], waves.along_y[:, None]
    x, y, both = (float(np.sum(waves.power * each)) for each in (q_x**2 + 0 * q_y, q_y**2 + 0 * q_x, q_x * q_y))
    half, apart = (x + y) / 2, hypot((x - y) / 2, both)
    return sqrt((half + apart) / max(half - apart, ROUNDING * half))


def cell_area(rough: Any) -> float:
    """Area of one period of a rough plane [m^2]."""
    return prod(rough.sides) if isinstance(rough, Topography) else rough.period**2


def around(elastomer: Linear, speed: float, q: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Waves in all directions (M,): |cosine| with the flow of each, its share of the circle; E* (N, M) [Pa]."""
    return _COSINE, _SHARES, complex_stiffness(elastomer, speed * q[:, None] * _COSINE)


@dataclass(frozen=True)
class Bands:
    """Waves in all directions, each for those of a band of lengths.

    q : wave numbers (N,) [rad/m], from the longest wave to the shortest
    power : mean square height of each band (N,), in units of unit**2; they are summed at a height near one, as the
        square of a tiny one would vanish
    unit : [m]
    """

    q: np.ndarray
    power: np.ndarray
    unit: float

    @classmethod
    def of(cls, rough: Isotropic | Topography | Profile) -> "Bands":
        """Bands of a spectrum with a shortest wave, as nodes of a quadrature over ln q, or of a map, as rings.

        A measured line is the surface that is fitted to it.
        """
        if isinstance(rough, Topography):
            return cls.of_waves(rough.waves)
        if isinstance(rough, Profile):
            rough = rough.fitted
        q_s = rough.q_max(0.0)
        if isinstance(rough, Spectrum):  # nodes would see only some of its many power laws
            edges = np.geomspace(rough.q_min, q_s, _WAVES + 1)
            share = rough.share(edges[:-1], edges[1:], q_s)
            return cls(np.sqrt(edges[:-1] * edges[1:]), share, rough.rms_height)
        nodes, weights = np.polynomial.legendre.leggauss(_WAVES)
        half = log(q_s / rough.q_min) / 2
        q = rough.q_min * np.exp(half * (1 + nodes))
        density = rough.normalized.density_2d(q, q_s)
        return cls(q, weights * half * 2 * pi * q**2 * density, rough.rms_height)

    @classmethod
    def of_waves(cls, waves: Waves) -> "Bands":
        """Bands of the waves of a map: each is at the rms of the wave numbers in it, weighted by power."""
        q, power = waves.q, waves.power
        present = power > 0
        q, power = q[present], power[present]
        edges = np.geomspace(q.min(), q.max() * (1 + 1e-12), _WAVES + 1)
        height, square = (np.histogram(q, edges, weights=each)[0] for each in (power, power * np.square(q)))
        some = height > 0
        return cls(np.sqrt(square[some] / height[some]), height[some], waves.unit)

    def beneath(self, radius: float) -> "Bands":
        """Bands without the mean and the tilt of each wave over a disc of a radius [m].

        A body that presses rides on these: of a wave q the share (2 J_1(s)/s)^2 + 16 J_2(s)^2/s^2, s = q radius,
        is a height and a tilt of the disc.
        """
        s = self.q * radius
        rides = np.square(2 * j1(s) / s) + 16 * np.square(jv(2, s) / s)
        return replace(self, power=self.power * np.maximum(1 - rides, ROUNDING))

    @property
    def rms_height(self) -> float:
        """Rms height of all bands [m]."""
        return self.unit * sqrt(self.power.sum())


@dataclass(frozen=True)
class FullContact:
    """A rough plane that touches everywhere, from its longest waves to each of its bands (N,).

    Each wave for itself: sum_q (|q| |q_x| / 2) |h_q|^2 Im E*(|q_x| v) is friction an area, and
    sum_q (q / 2)^2 |E*(q_x v)|^2 |h_q|^2 the mean square pressure; Persson, J. Chem. Phys. 115, 3840 (2001).

    friction : friction of each band per area [Pa]; the bands add up to the total
    pressure : rms of that about its mean [Pa], of all bands up to each
    lossy : rms of the part of the pressure that is a quarter of a period off, over the rms pressure of all
    along : mean |cosine| of the waves with the flow, weighted by friction
    across : mean of the fourth power of their sine, weighted by mean square pressure
    shorter : mean ln q weighted by friction, less that weighted by mean square pressure
    harder : the latter, less that weighted by mean square slope
    rising : tanh of half the logarithm of the ratio of the stiffness of the shortest and the longest waves
    faster : ln of the friction over the rms pressure at FASTER times the speed, less that at the speed
    """

    friction: np.ndarray
    pressure: np.ndarray
    lossy: float
    along: float
    across: float
    shorter: float
    harder: float
    rising: float
    faster: float

    @classmethod
    def of(cls, bands: Bands, elastomer: Linear, speed: float) -> "FullContact":
        """Full contact of waves that slide at a speed [m/s]."""
        cosine, shares, stiffness = around(elastomer, speed, bands.q)
        slopes, lengths = bands.power * np.square(bands.q), np.log(bands.q)
        losses, squares = shares * cosine * stiffness.imag, shares * np.square(abs(stiffness))
        friction, pressure = slopes / 2 * losses.sum(axis=1), slopes / 4 * squares.sum(axis=1)
        sum_of_friction, sum_of_squares, sum_of_slopes = friction.sum(), pressure.sum(), slopes.sum()
        lost = np.sum(slopes / 4 * (shares * np.square(stiffness.imag)).sum(axis=1))
        middle = float(lengths @ pressure / sum_of_squares)
        rubs = bool(sum_of_friction)
        _, _, stiffer = around(elastomer, FASTER * speed, bands.q)
        drag, press = (
            slopes @ (shares * each).sum(axis=1) for each in (cosine * stiffer.imag, np.square(abs(stiffer)))
        )
        return cls(
            friction=np.square(bands.unit) * friction,
            pressure=bands.unit * np.sqrt(np.cumsum(pressure)),
            lossy=sqrt(lost / sum_of_squares),
            along=float(slopes / 2 @ (losses @ cosine) / sum_of_friction) if rubs else 8 / (3 * pi),  # as slow
            across=float(slopes / 4 @ (squares @ np.square(1 - np.square(cosine))) / sum_of_squares),
            shorter=float(lengths @ friction / sum_of_friction) - middle if rubs else 0.0,
            harder=middle - float(lengths @ slopes / sum_of_slopes),
            rising=tanh(log(squares[-1].sum() / squares[0].sum()) / 4),
            faster=log(drag / 2 / sum_of_friction) - log(press / 4 / sum_of_squares) / 2 if rubs else log(FASTER),
        )
