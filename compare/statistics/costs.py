"""Power laws of cost, fitted to what was measured, and how far they may be trusted beyond it."""

import warnings
from dataclasses import dataclass
from math import exp, inf, log, nan, sqrt

import numpy as np
from scipy import special
from scipy.optimize import OptimizeWarning, curve_fit
from scipy.special import expit

from .intervals import student

FEWEST = 3  # points that a power is fitted to
WITH_OVERHEAD = 5  # points from which on a fixed cost can be told from a power
# The least time of some repeats comes out again to so much, and so does a count of iterations: less is no misfit.
REPEATABLE = 0.1
CHANCE = 0.01  # of refusing a law that is one
NEEDED = 0.05  # chance of a fixed cost found where there is none
LEVEL = 0.95  # of intervals
STARTS = (1.0, 2.5)  # exponents from which a fit begins
EXACT = 1e-9  # a scatter of less is rounding


@dataclass(frozen=True)
class Law:
    """cost = overhead + factor (x / centre)^exponent, with a scatter that is relative.

    lowest, highest : x that it was fitted to; count : how many
    scatter : standard deviation of ln cost about it
    covariance : of ln factor, exponent and, where there is an overhead, its logarithm
    """

    overhead: float
    factor: float
    exponent: float
    centre: float
    lowest: float
    highest: float
    count: int
    scatter: float
    covariance: np.ndarray

    @property
    def dof(self) -> int:
        """Degrees of freedom of the scatter."""
        return self.count - len(self.covariance)

    @property
    def exponent_interval(self) -> tuple[float, float]:
        """Interval of 95 % of the exponent, by Student."""
        half = student(LEVEL, self.dof) * sqrt(self.covariance[1, 1])
        return float(self.exponent - half), float(self.exponent + half)

    def at(self, x):
        """Cost expected at one x or at many."""
        return self.overhead + self.factor * (x / self.centre) ** self.exponent

    def interval(self, x: float) -> tuple[float, float]:
        """Interval of 95 % of one more measurement at x, if the law goes on; by Student, to first order."""
        low, high = self._ends(np.array([x]))
        return float(low[0]), float(high[0])

    def reach(self, cost: float) -> tuple[float, float, float]:
        """The x at which a cost is reached, and the ends of its interval; infinite where it never is."""
        x = self.centre * np.logspace(-3, 6, 2000)
        low, high = self._ends(x)
        return tuple(_crossing(x, costs, cost) for costs in (self.at(x), high, low))

    def _ends(self, x):
        power, whole = self.at(x) - self.overhead, self.at(x)
        parts = np.array([power, power * np.log(x / self.centre), np.full(len(x), self.overhead)])
        slopes = parts[: len(self.covariance)] / whole
        width = np.sqrt(self.scatter**2 + np.einsum("ik,ij,jk->k", slopes, self.covariance, slopes))
        factor = np.exp(np.minimum(student(LEVEL, self.dof) * width, 700.0))
        return whole / factor, whole * factor


@dataclass(frozen=True)
class NoLaw:
    """A cost that follows no power.

    reason : why not
    least, most : of the cost, NaN without any; at_most : x of the most
    """

    reason: str
    least: float
    most: float
    at_most: float


def fit(x: np.ndarray, cost: np.ndarray) -> Law | NoLaw:
    """Power law of a cost on the longest upper part of the range where there is one.

    As long as a law misfits, the smallest x is dropped, while half of the points are left and FEWEST.
    """
    x, cost = _usable(x, cost)
    found: Law | NoLaw = fit_whole(x, cost)
    for first in range(1, len(x) - max(FEWEST, (len(x) + 1) // 2) + 1):
        if isinstance(found, Law):
            return found
        found = fit_whole(x[first:], cost[first:])
    return found if isinstance(found, Law) else _no_law(found.reason, x, cost)


def fit_whole(x: np.ndarray, cost: np.ndarray) -> Law | NoLaw:
    """Power law of a cost over the whole range.

    Points that are not finite and above zero are left out. A fixed cost is added where an F test asks for it. With
    a misfit beyond REPEATABLE (chi square, 1 in 100) there is no law.
    """
    x, cost = _usable(x, cost)
    if len(np.unique(x)) < FEWEST:
        return _no_law(f"{len(x)} points are too few", x, cost)
    law = _fitted(x, cost)
    squares = law.scatter**2 * law.dof / REPEATABLE**2
    if special.chdtrc(law.dof, squares) < CHANCE:
        return _no_law("the misfit of a power is beyond the scatter", x, cost)
    return law


def held_out(x: np.ndarray, cost: np.ndarray) -> tuple[float, Law | NoLaw, float]:
    """The largest x that was measured, the law without it, and its cost as found; NaN without any."""
    x, cost = _usable(x, cost)
    if not len(x):
        return nan, fit(x, cost), nan
    return float(x[-1]), fit(x[:-1], cost[:-1]), float(cost[-1])


def _usable(x, cost):
    """Points above zero, by x."""
    x, cost = (np.asarray(each, float) for each in (x, cost))
    good = np.flatnonzero(np.isfinite(cost) & (cost > 0) & np.isfinite(x) & (x > 0))
    good = good[np.argsort(x[good], kind="stable")]
    return x[good], cost[good]


def _fitted(x, cost):
    centre = exp(np.log(x).mean())
    seen = np.log(cost)
    plain = _law(x, centre, seen, _power, _power_slopes, (seen.mean(), STARTS[0]))
    if len(x) < WITH_OVERHEAD or plain.scatter < EXACT:
        return plain
    beside = seen.min() + log(0.5)
    fitted = [_beside(x, centre, seen, (log(plain.factor), exponent, beside)) for exponent in STARTS]
    more = min((law for law in fitted if law), key=lambda law: law.scatter, default=plain)
    without, with_it = (law.scatter**2 * law.dof for law in (plain, more))
    if with_it >= without or more.exponent <= 0:  # what falls to a level is no cost that grows beside another
        return plain
    gain = (without - with_it) / max(with_it / more.dof, np.finfo(float).tiny)
    return more if special.fdtrc(1, more.dof, gain) < NEEDED else plain


def _beside(x, centre, seen, start):
    """Law with a fixed cost; None where the fit does not converge."""
    try:
        return _law(x, centre, seen, _with_fixed, _fixed_slopes, start)
    except RuntimeError:
        return None


def _power(along, start, exponent):
    return start + exponent * along


def _power_slopes(along, start, exponent):
    return np.column_stack([np.ones_like(along), along])


def _with_fixed(along, start, exponent, fixed):
    return np.logaddexp(start + exponent * along, fixed)


def _fixed_slopes(along, start, exponent, fixed):
    share = expit(start + exponent * along - fixed)
    return np.column_stack([share, share * along, 1 - share])


def _law(x, centre, seen, model, slopes, start):
    """Least squares in logarithms."""
    along, dof = np.log(x / centre), len(x) - len(start)
    with warnings.catch_warnings():
        # Without a fixed cost its logarithm has no error: the F test drops it.
        warnings.simplefilter("ignore", OptimizeWarning)
        found, covariance = curve_fit(model, along, seen, start, jac=slopes, method="trf", x_scale="jac")
    left = model(along, *found) - seen
    overhead = exp(found[2]) if len(found) > 2 else 0.0
    scatter = sqrt(float(left @ left) / dof)
    ends = float(x.min()), float(x.max())
    return Law(overhead, exp(found[0]), float(found[1]), centre, *ends, len(x), scatter, covariance)


def _no_law(reason, x, cost):
    if not len(cost):
        return NoLaw(reason, nan, nan, nan)
    return NoLaw(reason, float(cost.min()), float(cost.max()), float(x[np.argmax(cost)]))


def _crossing(x, costs, cost):
    """Size at which costs that rise in the end pass one; between points by logarithms."""
    above = np.flatnonzero(costs > cost)
    if not len(above):
        return inf
    k = above[0]
    if k == 0:
        return 0.0
    share = log(cost / costs[k - 1]) / log(costs[k] / costs[k - 1])
    return float(x[k - 1] * (x[k] / x[k - 1]) ** share)
