"""The two forms of a linear viscoelastic solid as a list of modes, each converted exactly into the other."""

from dataclasses import dataclass

import numpy as np

from .interconversion import zeros


@dataclass(frozen=True, eq=False)
class Relaxation:
    """G(t) = equilibrium + sum_k moduli[k] exp(-t / times[k]) + viscosity delta(t): Maxwell branches.

    equilibrium : modulus at rest [Pa], > 0
    moduli, times : of the branches (K,) [Pa], [s], times ascending and distinct
    viscosity : of a dashpot beside them [Pa s]; 0 where the solid has a glassy modulus
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
