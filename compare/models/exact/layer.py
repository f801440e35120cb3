"""A body of revolution pressed into an elastic layer on a rigid base, without sliding and without any grid.

A round contact of radius a has the same pressure as a row of springs, one behind the other,

    p(r) = -(E*/2) int_r^a f'(x) / sqrt(x^2 - r^2) dx,    F = pi E* int_0^a f dx,    f(a) = 0,

which on a half-space yield each for itself, f = (2/pi) (d - g) with the mapped profile g. On a layer of thickness
h they are coupled by what its base takes off the compliance (after Lebedev and Ufliand, J. Appl. Math. Mech. 22,
442, 1958):

    f(x) - (1/pi) int_-a^a f(s) k(x - s) ds = (2/pi) (d - g(x)),    k(y) = int_0^inf [1 - M(q h)] cos(q y) dq.

A wave of pressure displaces a layer by M of what it does to a half-space; with k = 3 - 4 nu and t = |q| h

    bonded:        M = [2k sinh 2t - 4t] / [2k cosh 2t + 4t^2 + 1 + k^2],
    frictionless:  M = [cosh 2t - 1] / [sinh 2t + 2t].

The kernel is smooth, so Gauss rules solve the equation to rounding. Units are SI, moduli E* = E/(1 - nu^2).
"""

from dataclasses import dataclass
from math import ceil, exp, log, pi

import numpy as np
from scipy.optimize import brentq

from scene import Layer
from scene.indenter import Axisymmetric

SHORTEST = 24.0  # 1 - M is 1e-18 there
NODES = 16  # of a panel
TURN = 6.0  # by which cos(q a) turns in a panel of waves
PANEL = 2.5  # thicknesses, of a panel of the radius
MOST = 100.0  # thicknesses, of a radius


@dataclass(frozen=True)
class Contact:
    """Radius [m], depth [m], load [N] and stiffness dF/dd [N/m]."""

    radius: float
    depth: float
    load: float
    stiffness: float


def of_radius(shape: Axisymmetric, layer: Layer, modulus, poisson_ratio, radius) -> Contact:
    """The contact of a radius [m] > 0. modulus : E* [Pa]. Raises ValueError beyond MOST thicknesses."""
    slenderness = radius / layer.thickness
    if not 0 < slenderness <= MOST:
        raise ValueError(f"radius = {radius:g} m: above zero and at most {MOST:g} thicknesses are known")
    x, weights = _panels(1.0, ceil(slenderness / PANEL) + 1)
    t, waves = _panels(SHORTEST, ceil(SHORTEST * slenderness / TURN) + 8)
    waves *= 2 / pi * slenderness * remainder(t, layer.base, poisson_ratio)
    turns = np.cos(np.outer(np.append(x, 1.0), t * slenderness))
    coupling = (turns * waves) @ turns[:-1].T * weights
    even = np.stack([np.ones_like(x), x**shape.exponent], axis=1)
    springs = np.linalg.solve(np.eye(len(x)) - coupling[:-1], even)
    at_edge = 1 + coupling[-1] @ springs
    depth = shape.mdr_coefficient * radius**shape.exponent * at_edge[1] / at_edge[0]
    flat, shaped = 2 * modulus * radius * (weights @ springs)
    load = flat * depth - shaped * shape.mdr_coefficient * radius**shape.exponent
    return Contact(radius, float(depth), float(load), float(flat))


def of_depth(shape: Axisymmetric, layer: Layer, modulus, poisson_ratio, depth) -> Contact:
    """The contact at a depth [m] > 0. Raises ValueError as `of_radius`."""
    return _where(shape, layer, modulus, poisson_ratio, depth=depth)


def of_load(shape: Axisymmetric, layer: Layer, modulus, poisson_ratio, load) -> Contact:
    """The contact under a load [N] > 0. Raises ValueError as `of_radius`."""
    return _where(shape, layer, modulus, poisson_ratio, load=load)


def remainder(t, base, poisson_ratio):
    """1 - M(t) for t > 0 of any shape.

    The algebra of three dimensions, which waves are hindered, written again: no witness of it. That is what was
    published, by others, of contacts on layers, which `of_load` has to meet.
    """
    gone = np.exp(-2 * np.asarray(t, float))
    if base == "frictionless":
        return 2 * (1 + 2 * t - gone) * gone / (1 - gone**2 + 4 * t * gone)
    k = 3 - 4 * poisson_ratio
    return (2 * k * gone + (1 + 2 * t) ** 2 + k**2) * gone / (k * (1 + gone**2) + (4 * t**2 + 1 + k**2) * gone)


def long_waves(layer: Layer, modulus, poisson_ratio) -> float:
    """Displacement by a pressure that is even over many thicknesses, over it [m/Pa].

    Bonded h (1 - 2 nu) / [2 G (1 - nu)], frictionless h/E*.
    """
    if layer.base == "frictionless":
        return layer.thickness / modulus
    return layer.thickness / modulus * (1 - 2 * poisson_ratio) / (1 - poisson_ratio) ** 2


def _where(shape, layer, modulus, poisson_ratio, **wanted):
    """Radius that has a depth or a load: both grow with it."""
    ((name, value),) = wanted.items()
    if not value > 0:
        raise ValueError(f"{name} = {value:g}: above zero")

    def excess(logarithm):
        found = of_radius(shape, layer, modulus, poisson_ratio, exp(logarithm))
        return log(getattr(found, name) / value)

    n, g = shape.exponent, shape.mdr_coefficient
    power, scale = (n, g) if name == "depth" else (n + 1, 2 * n / (n + 1) * modulus * g)
    most = log(MOST * (1 - 1e-12) * layer.thickness)
    low = high = min(log(value / scale) / power, most)  # that on a half-space
    while excess(low) > 0:
        low -= 0.5
    while excess(high) < 0:
        if high == most:
            raise ValueError(f"{name} = {value:g}: its radius is more than {MOST:g} thicknesses")
        high = min(high + 0.5, most)
    radius = exp(brentq(excess, low, high, xtol=1e-14, rtol=1e-14)) if high > low else exp(low)
    return of_radius(shape, layer, modulus, poisson_ratio, radius)


def _panels(end, count):
    """Nodes and weights of a rule for 0 to `end`."""
    x, w = np.polynomial.legendre.leggauss(NODES)
    half = end / count / 2
    return (half * (2 * np.arange(count)[:, None] + 1 + x)).ravel(), np.tile(half * w, count)
