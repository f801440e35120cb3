"""Scales of a scene: the relaxed, smooth contact that surrounds every answer. Not of planes."""

from dataclasses import dataclass
from math import isfinite, log, pi, sqrt

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
