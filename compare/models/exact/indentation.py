"""A body of revolution z = c r^n pressed into a viscoelastic half-space and withdrawn, without sliding.

Elastic: d = kappa_n c a^n, F = E* B d^m with m = (n + 1)/n, B = [2n/(n + 1)] (kappa_n c)^(-1/n). While the contact
grows E* d^m becomes a convolution (Lee and Radok, J. Appl. Mech. 27, 438, 1960); while it shrinks the contact at t
has the radius of an earlier t_1 and only what was done until then counts (Ting, J. Appl. Mech. 33, 845, 1966).

Histories are piecewise linear: values at rising times, zero at the first and before. E*(t) = 2 G(t) / (1 - nu).
"""

import numpy as np
from scipy.optimize import brentq

NODES = np.polynomial.legendre.leggauss(64)
MANY = 40.0  # relaxation times after which a mode has forgotten: exp(-40)
BEND = 4  # depth ~ v^4 along a quadrature: d^m starts smoothly in v


def loading_depth(shape, elastomer, times, forces, at):
    """Depth d [m] at some times [s] of a history of forces [N]: d^m = (1/B) int_0^t J(t - s) dF.

    Holds while the depth does not fall. Raises ValueError where it does from one of `at` to the next.
    """
    times, forces = _history(times, forces, "force")
    at = _within(times, at)
    n, b = _law(shape)
    grown = np.array([_crept(elastomer, times, forces, t) for t in at]) / b
    if np.any(np.diff(grown[np.argsort(at)]) < -1e-12 * np.max(np.abs(grown))) or np.any(grown < 0):
        raise ValueError("the depth falls: the contact shrinks, for which the force does not give the depth")
    return grown ** (n / (n + 1))


def force_of_depth(shape, elastomer, times, depths, at):
    """F [N] and contact radius a [m] at some times [s] of depths [m] that rise to one top and fall from it.

    On the way up F = B int_0^t E*(t - s) d(d^m). On the way down int_{t_1}^t E*(t - s) d'(s) ds = 0 gives t_1, and
    a(t) = a(t_1), F = B int_0^{t_1} E*(t - s) d(d^m). Both are zero once nothing is left in touch.

    shape : a Sphere, Cone or PowerLaw; elastomer : any solid of a scene
    Raises ValueError where depths rise again or `at` lies outside the history.
    """
    times, depths = _history(times, depths, "depth")
    top = int(np.argmax(depths))
    if np.any(np.diff(depths[: top + 1]) < 0) or np.any(np.diff(depths[top:]) > 0):
        raise ValueError("depths must rise to one top and fall from it")
    answers = []
    for t in _within(times, at):
        until = _matching(elastomer, times, depths, times[top], t)
        force = _force(shape, elastomer, times, depths, t, until)
        depth = np.interp(until, times, depths)
        answers.append((force, (depth / shape.mdr_coefficient) ** (1 / shape.exponent)))
    force, radius = np.array(answers).reshape(-1, 2).T
    return force, radius


def _matching(elastomer, times, depths, top, t):
    """t_1 at which the contact had the radius it has at t."""
    last = np.interp(t, times, depths)
    if t <= top or last == depths.max():
        return t
    equilibrium, viscosity, moduli, relaxation = _stiffness(elastomer)
    i = int(np.searchsorted(times, t))
    rate = (depths[i] - depths[i - 1]) / (times[i] - times[i - 1])

    def lifted(start):
        """int_start^t E*(t - s) d'(s) ds."""
        total = equilibrium * (last - np.interp(start, times, depths)) + viscosity * rate
        for low, high, slope in _pieces(times, depths, start, t):
            total += slope * np.sum(moduli * _decayed(relaxation, t - high, high - low))
        return total

    if lifted(times[0]) <= 0:
        return times[0]
    return brentq(lifted, times[0], top, xtol=1e-15 * top, rtol=1e-14) if lifted(top) < 0 else top


def _force(shape, elastomer, times, depths, t, until):
    """B int_0^until E*(t - s) d(d^m), until <= t."""
    n, b = _law(shape)
    equilibrium, viscosity, moduli, relaxation = _stiffness(elastomer)
    depth = np.interp(until, times, depths)
    total = equilibrium * depth ** ((n + 1) / n)
    for low, high, slope in _pieces(times, depths, times[0], until):
        ends = np.interp(low, times, depths), np.interp(high, times, depths)
        for modulus, time in zip(moduli, relaxation, strict=True):
            total += modulus * np.exp(-(t - high) / time) * _grown(*ends, slope * time, n)
        if high == until == t:
            total += viscosity * (n + 1) / n * ends[1] ** (1 / n) * slope
    return b * total


def _grown(start, end, memory, n):
    """int exp(-(end - d)/memory) d(d^m) over start <= d <= end; memory [m]: rate times relaxation time."""
    if end <= start:
        return 0.0
    nodes, weights = NODES
    v_end, v_start = end ** (1 / BEND), max(start, end - MANY * memory) ** (1 / BEND)
    v = v_start + (v_end - v_start) * (nodes + 1) / 2
    weights = weights * (v_end - v_start) / 2 * BEND * v ** (BEND - 1)
    return float(np.sum(weights * np.exp(-(end - v**BEND) / memory) * (n + 1) / n * v ** (BEND / n)))


def _crept(elastomer, times, forces, t):
    """int_0^t J*(t - s) F'(s) ds, J* = J (1 - nu)/2."""
    instantaneous, compliances, retardation = elastomer.retardation()
    total = instantaneous * np.interp(t, times, forces)
    for low, high, slope in _pieces(times, forces, times[0], t):
        total += slope * np.sum(compliances * (high - low - _decayed(retardation, t - high, high - low)))
    return total * (1 - elastomer.poisson_ratio) / 2


def _decayed(times, age, span):
    """int exp(-s/time) ds over age <= s <= age + span, for each time."""
    return -times * np.exp(-age / times) * np.expm1(-span / times)


def _pieces(times, values, start, end):
    """Straight pieces of a history between two times: from, to, slope."""
    for low, high, a, b in zip(times[:-1], times[1:], values[:-1], values[1:], strict=True):
        if high > start and low < end:
            yield max(low, start), min(high, end), (b - a) / (high - low)


def _stiffness(elastomer):
    equilibrium, moduli, times = elastomer.relaxation()
    scale = 2 / (1 - elastomer.poisson_ratio)
    return scale * equilibrium, scale * elastomer.viscosity, scale * moduli, times


def _law(shape):
    """Exponent n and B [m^(1 - 1/n)] of F = E* B d^m."""
    n = shape.exponent
    return n, 2 * n / (n + 1) * shape.mdr_coefficient ** (-1 / n)


def _history(times, values, name):
    times, values = np.asarray(times, float), np.asarray(values, float)
    if times.ndim != 1 or times.shape != values.shape or len(times) < 2:
        raise ValueError(f"a history needs as many times as {name}s, two at least")
    if not (np.all(np.diff(times) > 0) and np.all(np.isfinite(values)) and np.all(values >= 0) and values[0] == 0):
        raise ValueError(f"times must rise; every {name} must be finite and not negative, the first zero")
    return times, values


def _within(times, at):
    at = np.atleast_1d(np.asarray(at, float))
    if not np.all((at >= times[0]) & (at <= times[-1])):
        raise ValueError(f"times from {times[0]:g} to {times[-1]:g} s are known, {at} is asked for")
    return at
