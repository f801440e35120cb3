"""The card: the law of friction without any solve, for spheres and cones under a load; a spreadsheet can have it.

Its numbers were fitted: the smooth sliding body to solves in three dimensions, the widening to nominal contacts.
"""

from dataclasses import dataclass
from math import exp, log, log1p, pi
from typing import Any

import numpy as np

from scene import Cone, Scene, Sphere
from scene.scales import elastic_contact

from ..exact.full_contact import complex_stiffness
from .bands import Bands, FullContact
from .share import Share


@dataclass(frozen=True)
class Body:
    """Numbers of one shape.

    stiff, lossy, later : frequencies over v / a at which E* says how stiff the contact is, how much it loses, and
        how that changes
    off : what friction is less than slope times loss, in ln: of 1, s, s^2, l, l^2, s l and s ln(a / a_0)
    wider, slow, fast : c, alpha, k, beta of c eta^alpha ln(1 + k / x)^beta: how much wider the contact is, and how
        much less the smooth part, where losses grow with frequency and where they fall
    """

    stiff: float
    lossy: float
    later: float
    off: tuple[float, ...]
    wider: tuple[float, float, float, float]
    slow: tuple[float, float, float, float]
    fast: tuple[float, float, float, float]


BODIES = {
    Sphere: Body(
        stiff=1.86,
        lossy=0.696,
        later=2.654,
        off=(0.459, 0.197, -0.743, -0.35, -0.187, -0.238, 0.099),
        wider=(0.361, 0.986, 5.07, 0.367),
        slow=(1.376, 0.964, 4.34, 0.549),
        fast=(0.324, 0.971, 4.39, 0.410),
    ),
    Cone: Body(
        stiff=1.073,
        lossy=0.719,
        later=1.653,
        off=(0.112, -0.172, 0.199, -0.653, -0.488, -0.113, 0.0),
        wider=(1.295, 1.204, 7.26, 0.292),
        slow=(3.38, 1.562, 3.27, 0.810),
        fast=(0.88, 1.187, 5.30, 0.438),
    ),
}
HALVINGS = 60  # of the logarithm of the radius


def card(scene: Scene, known: tuple[float, float] | None = None) -> float:
    """Friction coefficient of a rough sphere or cone that slides under a load.

    known : friction coefficient and contact radius [m] of the smooth body, where they are known
    """
    shape, solid, speed = scene.indenter, scene.solid, scene.motion.speed
    rough: Any = scene.roughness
    body, n, rest = BODIES[type(shape)], shape.exponent, elastic_contact(scene)
    a = known[1] if known else rest.radius * exp(_shrunk(body, n, rest.radius, solid, speed))
    s, later = (float(np.sin(np.angle(complex_stiffness(solid, k * speed / a)))) for k in (body.lossy, body.later))
    ratio = log(later / s)
    steps = 1.0, s, s**2, ratio, ratio**2, s * ratio, s * log(a / rest.radius)
    slope = n * shape.coefficient * a ** (n - 1)
    off = sum(c * step for c, step in zip(body.off, steps, strict=True))
    smooth = known[0] if known else slope * s * exp(-off)
    bands = Bands.of(rough).beneath(a)
    full = FullContact.of(bands, solid, speed)
    x = rest.load / (pi * a**2 * float(full.pressure[-1]))
    eta = bands.rms_height / (shape.mdr_coefficient * a**n)
    wider, slow, fast = (_grown(eta, x, *numbers) for numbers in (body.wider, body.slow, body.fast))
    # Loss goes with the frequency to a power of 1 where it is slow, and -1 where it is fast.
    rising = min(max((1 + ratio / log(body.later / body.lossy)) / 2, 0.0), 1.0)
    radius = a * (1 + wider)
    share = float(Share.of(full)(np.array(x / (1 + wider) ** 2)))
    own = smooth / (1 + rising * slow + (1 - rising) * fast)
    return own + float(full.friction.sum()) * share * pi * radius**2 / rest.load


def _shrunk(body, n, radius, solid, speed):
    """ln of the radius of the smooth sliding contact over that at rest: as stiff as E* is at that radius."""
    low, high = -30.0, 0.0
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        stiff = abs(complex_stiffness(solid, body.stiff * speed / (radius * exp(middle))))
        low, high = (
            (low, middle) if (n + 1) * middle + log(stiff / solid.indentation_modulus) > 0 else (middle, high)
        )
    return (low + high) / 2


def _grown(eta, x, c, alpha, k, beta):
    return c * eta**alpha * log1p(k / x) ** beta
