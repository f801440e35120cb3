"""A solid whose loss is a power of the frequency, as a Prony series of stated range and error."""

from functools import lru_cache
from math import ceil, exp, log, pi, sin
from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator
from pydantic.dataclasses import dataclass
from scipy.linalg import eigh_tridiagonal

from ..files.stated import alternatives, restated
from ..quantities import AngularFrequency, Finite, ShearModulus, Time
from .modes import Relaxation
from .viscoelastic import YOUNG, PoissonRatio, Solid, in_shear

_MOST_DECADES = 30
_REFINEMENTS = 40
# Frequencies a mode at which the error is sampled.
_SAMPLES = 32
# Sum of the half axes of the ellipse with foci -1, 1 through 2i - 1.
_ELLIPSE = 4.61


@dataclass(frozen=True, config=alternatives("modulus", youngs_modulus=YOUNG), kw_only=True)
class Fractional(Solid):
    """Fractional Kelvin-Voigt solid: a spring and a springpot in parallel.

    G(omega) = modulus (1 + (i omega tau)^exponent)

    modulus : static shear modulus [Pa]
    relaxation_time : tau [s]
    exponent : 0 to 1, both excluded; 1 would be Kelvin
    lowest_frequency, highest_frequency : ends of the range [rad/s] in which the law holds, at most 30 decades
    tolerance : allowed relative error of G' and of G'' each, anywhere in the range; `error` is the actual one

    The loss modulus is the power law G'' = G~ (omega/omega_0)^exponent, Eq. 24 of Popov et al., Sci. Rep. 4, 3750
    (2014), with G~ = modulus sin(pi exponent / 2) and omega_0 = 1/tau. About 2.5 modes a decade keep 1e-3. Below
    the range G'' soon falls as omega and G' tends to the static modulus; above it G' tends to a finite glassy one.
    """

    modulus: ShearModulus
    relaxation_time: Time
    exponent: Annotated[Finite, Field(gt=0, lt=1)]
    lowest_frequency: AngularFrequency
    highest_frequency: AngularFrequency
    tolerance: Annotated[Finite, Field(ge=1e-10, le=0.1)] = 1e-3
    poisson_ratio: PoissonRatio = 0.5
    type: Literal["fractional"] = Field(default="fractional", repr=False)

    _in_tension = restated(in_shear)

    @model_validator(mode="after")
    def _range_in_order(self):
        low, high = self.lowest_frequency, self.highest_frequency
        if not low < high or log(high) - log(low) > _MOST_DECADES * log(10) * (1 + 1e-12):
            raise ValueError(
                f"highest_frequency = {high:g} must exceed lowest_frequency = {low:g}, "
                f"by at most {_MOST_DECADES} decades"
            )
        return self

    def law(self, omega):
        """The power law itself, modulus (1 + (i omega tau)^exponent) [Pa], without the limits of the series."""
        return self.modulus * (1 + (1j * np.asarray(omega, float) * self.relaxation_time) ** self.exponent)

    @property
    def error(self) -> float:
        """Largest relative error of G' or G'' of the series against the law, in the stated range."""
        return _error(self, self.modes())

    def modes(self) -> Relaxation:
        return _shortest(self)


@lru_cache(maxsize=64)
def _shortest(solid: Fractional) -> Relaxation:
    """The shortest series that keeps the tolerance."""
    for refinement in range(_REFINEMENTS):
        series = _series(solid, 4 * solid.tolerance / 1.5**refinement)
        if _error(solid, series) <= solid.tolerance:
            return series
    raise ArithmeticError(f"tolerance = {solid.tolerance:g} is below what double precision allows here")


def _error(solid, series):
    omega = np.geomspace(solid.lowest_frequency, solid.highest_frequency, _SAMPLES * len(series.times) + 1)
    law, found = solid.law(omega), series.complex_modulus(omega)
    return float(max(np.abs(found.real / law.real - 1).max(), np.abs(found.imag / law.imag - 1).max()))


def _series(solid, error):
    """s^b = (sin(pi b)/pi) int_0^inf r^b s/(s + r) d(ln r) by the trapezoidal rule.

    The poles of the integrand pi/2 off the axis of ln r make the relative error 2 exp(-pi^2/step). Of the
    infinitely many rates r those beyond an end of the range are replaced by the few of a Gauss rule: s/(s + r) is
    analytic in r/r_end on [0, 1] within the ellipse through its poles +-i.
    """
    low, b, digits = solid.lowest_frequency, solid.exponent, log(4 / error)
    span = log(solid.highest_frequency) - log(low)
    count, ends = ceil(span * digits / pi**2), ceil(digits / (2 * log(_ELLIPSE)))
    step = span / count
    slow, slow_weights = _geometric_gauss(b, step, ends)
    fast, fast_weights = _geometric_gauss(1 - b, step, ends)
    inner = np.exp(step * np.arange(1, count))
    rates = low * np.concatenate([slow, inner, exp(span) / fast])
    weights = np.concatenate([slow_weights, inner**b, exp(b * span) * fast_weights / fast])
    scale = solid.modulus * sin(pi * b) / pi * step * (low * solid.relaxation_time) ** b
    return Relaxation.of(solid.modulus, scale * weights, 1 / rates)


def _geometric_gauss(power, step, count):
    """Gauss rule, nodes in (0, 1) and weights > 0, of the sum over k >= 0 of x^power f(x) at x = exp(-k step).

    From the three-term recurrence of the little q-Jacobi polynomials, q = exp(-step), a = q^(power - 1), b = 1:
    Koekoek, Lesky, Swarttouw, Hypergeometric Orthogonal Polynomials and Their q-Analogues, 14.12.
    """

    def one_less(exponent):
        """1 - q^exponent."""
        return -np.expm1(-step * exponent)

    n = np.arange(count)
    up = np.exp(-step * n) * one_less(power + n) ** 2 / (one_less(power + 2 * n) * one_less(power + 2 * n + 1))
    m = n[1:]
    down = np.exp(-step * (power + m - 1)) * one_less(m) ** 2
    down /= one_less(power + 2 * m - 1) * one_less(power + 2 * m)
    nodes, vectors = eigh_tridiagonal(up + np.append(0.0, down), np.sqrt(up[:-1] * down))
    return nodes, vectors[0] ** 2 / one_less(power)
