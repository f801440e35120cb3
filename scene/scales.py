"""Scales of a scene: the relaxed, smooth contact that surrounds every answer, and the regime of a rough one.

Conditions of the regime are those of the laws of Popov et al., Sci. Rep. 4, 3750 (2014). Not of planes.
"""

from dataclasses import dataclass
from math import isfinite, log, pi, sqrt

import numpy as np

from .indenter import Cylinder
from .scene import Scene


@dataclass(frozen=True)
class ElasticContact:
    """Relaxed frictionless contact of a smooth body of revolution: radius [m], depth [m], load [N].

    Of a cylinder: half-width [m], depth [m] below the surface one cylinder radius away, load per length [N/m].
    """

    radius: float
    depth: float
    load: float


def elastic_contact(scene: Scene) -> ElasticContact:
    """Galin-Sneddon solution for z = c r^n with the scene's load or depth, roughness left out.

    d = kappa_n c a^n and F = [2n/(n+1)] E* kappa_n c a^(n+1); Sneddon, Int. J. Eng. Sci. 3, 47 (1965).
    Raises ArithmeticError where radius or depth are beyond the range of numbers.
    """
    shape, motion = scene.indenter, scene.motion
    if isinstance(shape, Cylinder):
        return _line_contact(shape.radius, motion.line_load, scene.solid.indentation_modulus)
    n, g = shape.exponent, shape.mdr_coefficient
    stiffness = 2 * n / (n + 1) * scene.solid.indentation_modulus * g
    given = motion.greatest
    radius = (given / g) ** (1 / n) if motion.load is None else (given / stiffness) ** (1 / (n + 1))
    depth = g * radius**n
    _check_finite(stiffness=stiffness, radius=radius, depth=depth)
    return ElasticContact(radius, depth, stiffness * radius ** (n + 1))


def _line_contact(radius, load, modulus):
    """Hertz: a^2 = 4 P R / (pi E*), d = (P / (pi E*)) (2 ln(2R/a) + 1); Johnson (1985), ch. 4."""
    half_width = sqrt(4 * load * radius / (pi * modulus))
    _check_finite(half_width=half_width)
    depth = load / (pi * modulus) * (2 * log(2 * radius / half_width) + 1)
    _check_finite(depth=depth)
    return ElasticContact(half_width, depth, load)


def _check_finite(**quantities):
    """Raise OverflowError for a quantity beyond the range of numbers."""
    for name, value in quantities.items():
        if not isfinite(value):
            raise OverflowError(f"the smooth relaxed contact would have {name} = {value:g}")


SMALL_SLOPE = 0.3  # up to which a linear theory of contact is taken at its word
# "Much less" in numbers: the term that a law drops is then at most about a tenth, a twenty-fifth of what it keeps.
MUCH_LESS_HEIGHT, MUCH_LESS_SLOPE = 0.1, 0.2


@dataclass(frozen=True)
class Regime:
    """Ratios of a rough contact, numbers or arrays of the same shape.

    height_over_depth : rms height over the depth of the smooth relaxed contact, h_0 / d
    contact_over_period : its width over the longest wavelength, 2a / L
    macro_over_rough : rms slope of the macroscopic profile over that contact, over the rms slope of the roughness
    rms_slope : of the roughness
    """

    height_over_depth: float
    contact_over_period: float
    macro_over_rough: float
    rms_slope: float

    @classmethod
    def of(cls, profile, contact, rms_height, longest, rms_slope) -> "Regime":
        """Regime of roughness of an rms height and a longest wavelength [m] on a one-dimensional profile.

        profile : coefficient c_n [m^(1-n)] and exponent n of g = c_n |x|^n
        contact : radius a and depth d [m] of the smooth relaxed contact
        """
        (c, n), (a, d) = profile, contact
        macro = c * n * a ** (n - 1) / np.sqrt(2 * n - 1)
        # Heights that are all zero have no slope.
        with np.errstate(divide="ignore"):
            over_rough = np.divide(macro, rms_slope)
        return cls(rms_height / d, 2 * a / longest, over_rough, rms_slope)

    @property
    def flags(self) -> dict[str, bool]:
        """Whether each condition holds, by name: h0 << d, 2a < L, macro slope << roughness slope, small slopes."""
        return {
            "h0 << d": self.height_over_depth <= MUCH_LESS_HEIGHT,
            "2a < L": self.contact_over_period < 1,
            "macro slope << roughness slope": self.macro_over_rough <= MUCH_LESS_SLOPE,
            "small slopes": self.rms_slope <= SMALL_SLOPE,
        }
