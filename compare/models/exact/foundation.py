"""A smooth sphere or cone in steady sliding on a one-dimensional foundation, Kelvin or standard linear.

With u = d - g in contact, in units of the relaxed E* and along the flow,

    Kelvin:           f = u + l u',                      l = v tau
    standard linear:  f = u + K y,  y' = u' - y/m,       m = v tau, K = E_g/E_r - 1, y = 0 where contact begins.

It begins at -a with g(a) = d, and ends where f has fallen to zero; on a cone that may be at the tip. The elastomer
behind is free and does not meet the body again.
"""

from collections.abc import Callable

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq

from scene import Cone, Kelvin, Sphere, StandardLinearSolid


def sliding_forces(shape: Sphere | Cone, solid: Kelvin | StandardLinearSolid, speed, depth) -> tuple[float, float]:
    """Normal force and friction [N] at a speed [m/s] > 0 and a depth [m] > 0 of the mapped profile.

    Raises ValueError for another shape or solid.
    """
    if not isinstance(shape, Sphere | Cone) or not isinstance(solid, Kelvin | StandardLinearSolid):
        raise ValueError(
            f"{type(shape).__name__} on {type(solid).__name__}: a Sphere or Cone on a Kelvin or "
            "StandardLinearSolid has a closed form"
        )
    c, n = shape.mdr_coefficient, shape.exponent
    a = (depth / c) ** (1 / n)
    force = _force(c, n, solid, speed * solid.relaxation_time, a)

    def slope(x):
        return n * c * np.sign(x) * abs(x) ** (n - 1)

    # Just behind the tip, where the slope of a cone has changed its sign.
    tip = 1e-13 * a
    if force(a) > 0:
        raise ArithmeticError("contact does not end before the profile leaves the undeformed surface")
    end = brentq(force, tip, a, xtol=1e-16 * a, rtol=1e-15) if force(tip) > 0 else 0.0
    pieces = [(-a, 0.0), (0.0, end)] if end else [(-a, 0.0)]

    def integral(weight):
        def weighted(x):
            return weight(x) * force(x)

        parts = (quad(weighted, *piece, epsabs=0, epsrel=1e-13, limit=500)[0] for piece in pieces)
        return solid.indentation_modulus * sum(parts)

    return integral(lambda x: 1.0), -integral(slope)


def _force(c, n, solid, memory, a) -> Callable[[float], float]:
    """f over the relaxed E* [m] at x [m], in contact from -a on."""
    if isinstance(solid, Kelvin):
        return lambda x: c * (a**n - abs(x) ** n) - memory * n * c * np.sign(x) * abs(x) ** (n - 1)
    stretch = _on_sphere if n == 2 else _on_cone
    stiffness = solid.glassy_modulus / solid.rubbery_modulus - 1
    return lambda x: c * (a**n - abs(x) ** n) + stiffness * c * stretch(x, memory, a)


def _on_sphere(x, m, a):
    """y of g = x^2: what solves y' = -2x - y/m, and as much of exp(-x/m) as makes it zero at -a."""
    return -2 * m * (x - m + (a + m) * np.exp(-(x + a) / m))


def _on_cone(x, m, a):
    """y of g = |x|: y' = 1 - y/m up to the tip, -1 - y/m behind it."""
    if x <= 0:
        return -m * np.expm1(-(x + a) / m)
    return m * (np.expm1(-x / m) - np.exp(-x / m) * np.expm1(-a / m))
