"""The card: the law of friction without any solve, for spheres and cones under a load; a spreadsheet can have it.

Its numbers were fitted: the smooth sliding body to solves in three dimensions, the widening to nominal contacts.
"""

from dataclasses import dataclass
from math import exp, log, log1p, pi
from typing import Any

import numpy as np

from scene import Cone, Scene, Sphere
from scene.scales import elastic_contact
from scene.viscoelastic import Linear

from ..exact.full_contact import complex_stiffness
from .bands import Bands, FullContact
from .nominal import NominalContact
from .share import Share


@dataclass(frozen=True)
class Body:
    """Numbers of one shape.

    stiff, lossy, later : frequencies over v / a at which E* says how stiff the contact is, how much it loses, and
        how that changes
    radius, friction : ln of the radius and of the friction of the smooth body over what these frequencies and its
        pressure at rest make them: of 1, s, s^2, l, l^2 and s l
    wider, slow, fast : c, alpha, k, beta of c eta^alpha ln(1 + k / x)^beta: how much wider the contact is, and how
        much less the smooth part, where losses grow with frequency and where they fall
    """

    stiff: float
    lossy: float
    later: float
    radius: tuple[float, ...]
    friction: tuple[float, ...]
    wider: tuple[float, float, float, float]
    slow: tuple[float, float, float, float]
    fast: tuple[float, float, float, float]

    def losses(self, solid: Linear, speed: float, radius: float) -> tuple[float, ...]:
        """1, s, s^2, l, l^2, s l: s the sine of the phase of E* for a contact, l d ln s / d ln omega."""
        s, later = (
            float(np.sin(np.angle(complex_stiffness(solid, k * speed / radius)))) for k in (self.lossy, self.later)
        )
        rate = log(later / s) / log(self.later / self.lossy) if s else 1.0  # as slow
        return 1.0, s, s**2, rate, rate**2, s * rate

    def as_stiff(self, n: float, rest: float, solid: Linear, speed: float) -> float:
        """Radius [m] of the smooth sliding contact of r^n with a radius at rest [m]: as stiff as E* is there."""
        low, high = -30.0, 0.0
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            stiff = abs(complex_stiffness(solid, self.stiff * speed / (rest * exp(middle))))
            low, high = (
                (low, middle) if (n + 1) * middle + log(stiff / solid.indentation_modulus) > 0 else (middle, high)
            )
        return rest * exp((low + high) / 2)


BODIES = {
    Sphere: Body(
        stiff=2.387,
        lossy=2.538,
        later=1.907,
        radius=(0.0022, 0.1358, -0.0315, -0.0005, 0.0027, -0.213),
        friction=(0.0035, -0.173, 0.0438, -0.0004, 0.0195, 0.2823),
        wider=(0.361, 0.986, 5.07, 0.367),
        slow=(1.376, 0.964, 4.34, 0.549),
        fast=(0.324, 0.971, 4.39, 0.410),
    ),
    Cone: Body(
        stiff=0.7263,
        lossy=0.9547,
        later=0.5489,
        radius=(0.0009, -0.0852, -0.2799, 0.0044, 0.0048, -0.4110),
        friction=(0.0052, 0.6046, -0.4226, -0.0121, 0.0073, 0.8221),
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
    smooth, a, rate = (*known, body.losses(solid, speed, known[1])[3]) if known else smooth_body(scene)
    bands = Bands.of(rough).beneath(a)
    full = FullContact.of(bands, solid, speed)
    x = rest.load / (pi * a**2 * float(full.pressure[-1]))
    eta = bands.rms_height / (shape.mdr_coefficient * a**n)
    wider, slow, fast = (_grown(eta, x, *numbers) for numbers in (body.wider, body.slow, body.fast))
    # Loss goes with the frequency to a power of 1 where it is slow, and -1 where it is fast.
    rising = min(max((1 + rate) / 2, 0.0), 1.0)
    radius = a * (1 + wider)
    share = float(Share.of(full)(np.array(x / (1 + wider) ** 2)))
    own = smooth / (1 + rising * slow + (1 - rising) * fast)
    return own + float(full.friction.sum()) * share * pi * radius**2 / rest.load


def smooth_body(scene: Scene) -> tuple[float, float, float]:
    """Smooth sphere or cone that slides under a load, without a solve.

    Friction coefficient, contact radius [m], and d ln s / d ln omega, see `Body.losses`.
    """
    shape, solid, speed, rest = scene.indenter, scene.solid, scene.motion.speed, elastic_contact(scene)
    body = BODIES[type(shape)]
    a = body.as_stiff(shape.exponent, rest.radius, solid, speed)
    losses = body.losses(solid, speed, a)
    lost = NominalContact.smooth(shape.exponent, a, rest.load).lost(solid, speed)
    radius, friction = (exp(np.dot(numbers, losses)) for numbers in (body.radius, body.friction))
    return lost / rest.load * friction, a * radius, losses[3]


def _grown(eta, x, c, alpha, k, beta):
    return c * eta**alpha * log1p(k / x) ** beta
