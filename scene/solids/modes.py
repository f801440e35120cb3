"""The two forms of a linear viscoelastic solid as a list of modes, each converted exactly into the other.

Both directions need the zeros x of the function c - sum_j w_j / (x - p_j), with weights w_j > 0, poles
p_j >= 0 and c >= 0. It rises from -inf to +inf between two poles: one zero lies in each gap, and one above the
last pole if c > 0. Each is found by its distance from the nearer pole, in the logarithm of it: no difference of
close numbers is taken, so that every mode keeps its digits whatever the spread of times and moduli.
"""

from dataclasses import dataclass
from math import frexp

import numpy as np

_ROUNDING = 2 * np.finfo(float).eps
_MARGIN = 1e-9  # beyond the ends of a bracket, for ends that are roots but for rounding


def zeros(poles, weights, constant):
    """Zeros (R,) of F(x) = c - sum_j w_j / (x - p_j), ascending, and the steepness x F'(x) > 0 at each.

    Arguments as in `distances`. The steepness, in units of the constant, is the steepness of the rational
    function with these poles and zeros, a product of distances: where single zeros are known badly because poles
    lie close or terms cancel, together they still are this very function.
    """
    apart = distances(poles, weights, constant)
    if not len(apart):
        return np.empty(0), np.empty(0)
    gap = np.arange(len(apart))
    nearest = np.abs(apart).argmin(axis=1)
    x = poles[nearest] + apart[gap, nearest]
    leading = constant or weights.sum() / -apart[:, -1]
    return x, leading * (x / apart[gap, gap]) * _ratios(apart)


def distances(poles, weights, constant):
    """Distances (R, K) of the zeros x_i of F from every pole, x_i - p_j, each to rounding.

    poles : (K,) >= 0, ascending and distinct
    weights : (K,) > 0
    constant : c >= 0, in units of weight / pole; R = K if c > 0, else K - 1

    Raises ArithmeticError where the constant vanishes against the weights, and where a distance does.
    """
    count = len(poles) - (constant == 0)
    if count <= 0:
        return np.empty((0, len(poles)))
    # Powers of two scale without rounding.
    unit, heaviest = 2.0 ** frexp(poles[-1])[1], 2.0 ** frexp(weights.max())[1]
    p, w, c = poles / unit, weights / heaviest, constant * (unit / heaviest)
    if constant and c < np.finfo(float).tiny:
        raise ArithmeticError("modes not found: moduli further apart than the range of numbers")
    gap = np.arange(count)
    below = np.arange(len(p)) <= gap[:, None]
    half = np.append(np.diff(p) / 2, w.sum() / c if c else [])

    def terms(apart, row):
        """Sums of the terms of the poles below, and of those above with the constant, >= 0."""
        each = w / apart
        return np.where(below[row], each, 0.0).sum(axis=1), np.where(below[row], 0.0, -each).sum(axis=1) + c

    falling, rising = terms(p[gap, None] - p + half[:, None], gap)
    last = gap == len(p) - 1
    left = last | (rising >= falling)
    nearer, sign = np.where(left, gap, gap + 1), np.where(left, 1.0, -1.0)
    offsets = p[nearer, None] - p
    # The term of the nearer pole alone outweighs the other side below this distance.
    least = w[nearer] / np.where(last, c, np.where(left, rising, falling))
    with np.errstate(divide="raise", invalid="raise"):
        return unit * _balanced(terms, offsets, sign, least, half)


def _ratios(apart):
    """prod_{j != i} |x_i - x_j| / |x_i - p_j| from the distances x_i - p_j, p_i the nearest pole below x_i."""
    count = len(apart)
    here, there = np.indices((count, count))
    # Between two zeros lies the pole below the upper one: the distance is a sum.
    upper, lower = np.maximum(here, there), np.minimum(here, there)
    distances = apart[upper, upper] - apart[lower, upper]
    return np.prod(np.where(here == there, 1.0, distances / np.abs(apart[:, :count])), axis=1)


def _balanced(terms, offsets, sign, low, high):
    """offsets + sign d with low <= d <= high at which both terms, falling and rising, are equal."""
    # Only solids with modes need it.
    from scipy.optimize.elementwise import find_root

    def excess(log_distance, row):
        falling, rising = terms(offsets[row] + (sign[row] * np.exp(log_distance))[:, None], row)
        return sign[row] * np.log(rising / falling)

    bracket = np.log(low) - _MARGIN, np.log(high) + _MARGIN
    found = find_root(excess, bracket, args=(np.arange(len(low)),), tolerances={"xrtol": _ROUNDING})
    if not found.success.all():
        raise ArithmeticError("modes not found: times or moduli beyond the range of numbers")
    return offsets + (sign * np.clip(np.exp(found.x), low, high))[:, None]


@dataclass(frozen=True, eq=False)
class Relaxation:
    """G(t) = equilibrium + sum_k moduli[k] exp(-t / times[k]) + viscosity delta(t): Maxwell branches.

    equilibrium : modulus at rest [Pa], > 0
    moduli, times : of the branches (K,) [Pa], [s], times ascending and distinct
    viscosity : of a dashpot parallel to them [Pa s]; 0 where the solid has a glassy modulus
    """

    equilibrium: float
    moduli: np.ndarray
    times: np.ndarray
    viscosity: float = 0.0

    @classmethod
    def of(cls, equilibrium, moduli=(), times=()) -> "Relaxation":
        """Modes from branches in any order; those of equal times are one."""
        return cls(equilibrium, *_distinct(moduli, times))

    @property
    def glassy(self) -> float:
        """G(t = 0) [Pa]; infinite with a dashpot."""
        return np.inf if self.viscosity else self.equilibrium + float(self.moduli.sum())

    def modulus(self, t):
        """G(t) [Pa] for t >= 0 [s]; the dashpot is felt at t = 0 alone."""
        t = np.asarray(t, float)
        relaxed = self.equilibrium + _decay(t, self.times) @ self.moduli
        return np.where(t > 0, relaxed, np.inf)[()] if self.viscosity else relaxed

    def complex_modulus(self, omega):
        """G(omega) [Pa]; sums of terms >= 0 in both parts."""
        i_omega = 1j * np.asarray(omega, float)
        phase = i_omega[..., None] * self.times
        return self.equilibrium + self.viscosity * i_omega + (phase / (1 + phase)) @ self.moduli

    def retardation(self) -> "Retardation":
        """Creep of the same solid. Retardation times are the zeros of G(s) at s = -1/time,

        equilibrium = viscosity / x + sum_k moduli[k] times[k] / (x - times[k]), and compliances its residues.
        """
        poles, weights = self.times, self.moduli * self.times
        if self.viscosity:
            poles, weights = np.append(0.0, poles), np.append(self.viscosity, weights)
        times, stiffness = zeros(poles, weights, self.equilibrium)
        return Retardation(1 / self.glassy, *_fixed(1 / stiffness, times))


@dataclass(frozen=True, eq=False)
class Retardation:
    """J(t) = instantaneous + sum_k compliances[k] (1 - exp(-t / times[k])): a chain of Kelvin elements.

    instantaneous : [1/Pa], >= 0
    compliances, times : of the elements (K,) [1/Pa], [s], times ascending and distinct
    """

    instantaneous: float
    compliances: np.ndarray
    times: np.ndarray

    @classmethod
    def of(cls, instantaneous, compliances=(), times=()) -> "Retardation":
        """Modes from elements in any order; those of equal times are one."""
        return cls(instantaneous, *_distinct(compliances, times))

    @property
    def equilibrium(self) -> float:
        """Modulus at rest [Pa]."""
        return 1 / (self.instantaneous + float(self.compliances.sum()))

    def compliance(self, t):
        """J(t) [1/Pa] for t >= 0 [s]."""
        return self.instantaneous + _decay(np.asarray(t, float), self.times, rise=True) @ self.compliances

    def relaxation(self) -> Relaxation:
        """Relaxation of the same solid. Relaxation times are the zeros of J(s) at s = -1/time,

        0 = instantaneous / x + sum_k compliances[k] / (x - times[k]), and moduli its residues.
        """
        poles, weights = self.times, self.compliances
        if self.instantaneous:
            poles, weights = np.append(0.0, poles), np.append(self.instantaneous, weights)
        times, fluidity = zeros(poles, weights, 0.0)
        viscosity = 0.0 if self.instantaneous else 1 / float((self.compliances / self.times).sum())
        moduli, times = _fixed(1 / (times * fluidity), times)
        return Relaxation(self.equilibrium, moduli, times, viscosity)


def _decay(t, times, rise=False):
    """exp(-t/times), or 1 less that, of shape t.shape + (K,)."""
    if np.any(t < 0):
        raise ValueError(f"t = {t.min():g} must not be negative")
    with np.errstate(over="ignore"):
        ages = t[..., None] / times
    return -np.expm1(-ages) if rise else np.exp(-ages)


def _distinct(amounts, times):
    times, which = np.unique(np.array(times, float), return_inverse=True)
    return _fixed(np.bincount(which, amounts, len(times)).astype(float), times)


def _fixed(*arrays):
    """Shared between callers, hence read-only."""
    for array in arrays:
        array.setflags(write=False)
    return arrays
