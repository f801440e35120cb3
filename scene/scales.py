"""Scales of a scene: the relaxed, smooth contact that surrounds every answer. Bodies of revolution only."""

from dataclasses import dataclass

from .scene import Scene


@dataclass(frozen=True)
class ElasticContact:
    """Relaxed frictionless contact of a smooth body of revolution: radius [m], depth [m], load [N]."""

    radius: float
    depth: float
    load: float


def elastic_contact(scene: Scene) -> ElasticContact:
    """Galin-Sneddon solution for z = c r^n with the scene's load or depth, roughness left out.

    d = kappa_n c a^n and F = [2n/(n+1)] E* kappa_n c a^(n+1); Sneddon, Int. J. Eng. Sci. 3, 47 (1965).
    """
    shape, motion = scene.indenter, scene.motion
    n, g = shape.exponent, shape.mdr_coefficient
    stiffness = 2 * n / (n + 1) * scene.elastomer.indentation_modulus * g
    radius = (motion.depth / g) ** (1 / n) if motion.load is None else (motion.load / stiffness) ** (1 / (n + 1))
    return ElasticContact(radius, g * radius**n, stiffness * radius ** (n + 1))
