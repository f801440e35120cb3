"""Prony series that follow measurements: nonnegative least squares over times a fraction of a decade apart.

Beyond the ends of a table the power law that the loss follows at an end goes on.
"""

from dataclasses import dataclass
from functools import cached_property
from math import atan2, inf, log, pi, sqrt, tan

import numpy as np

from .modes import Relaxation, Retardation

# Times further than this beyond the ends of the measurement have the same effect as times at its ends.
_MARGIN = 10**0.5
_TIMES_A_DECADE = (1, 1.5, 2, 3, 5, 10, 30)
# No measurement is worth modes for a smaller misfit.
NEGLIGIBLE = 1e-3
# Largest relative contribution of a mode that is left out.
_INVISIBLE = 1e-7
# Weight of known values relative to measured rows.
_KNOWN = 1e6

Modes = Relaxation | Retardation


class Measured:
    """Measured numbers (M,) that a series has to follow, each to the same share of itself.

    measured : the numbers
    """

    measured: np.ndarray

    def ends(self, rest: float | None) -> tuple[float, float]:
        """Shortest and longest time of a mode [s], long enough to come to rest as slowly as the table ends.

        rest : modulus at rest [Pa] if it is known
        """
        raise NotImplementedError

    def of(self, modes: Modes) -> np.ndarray:
        """The numbers (M,) that a solid of such modes would show where these were measured."""
        raise NotImplementedError

    def parts(self, times: np.ndarray) -> np.ndarray:
        """The numbers (M, 1 + K) that a spring of size one shows, and a mode of size one at each of K times."""
        raise NotImplementedError

    def series(self, times: np.ndarray, rest: float | None) -> Modes:
        """The modes of given times, amounts >= 0, and given or fitted modulus at rest, with the least misfit."""
        matrix, target = self.parts(times) / self.measured[:, None], np.ones(len(self.measured))
        if rest is not None:
            target -= rest * matrix[:, 0]
            matrix[:, 0] = 0.0
        amounts = _nonnegative(matrix, target)
        kept = amounts[1:] * matrix[:, 1:].max(axis=0) > _INVISIBLE
        return Relaxation.of(float(amounts[0]) if rest is None else rest, amounts[1:][kept], times[kept])

    def misfit(self, modes: Modes) -> np.ndarray:
        """Relative misfits (M,)."""
        return self.of(modes) / self.measured - 1

    def liquid(self, times: np.ndarray) -> float:
        """Root mean square of the misfits of the best liquid of such times."""
        return rms(self.misfit(self.series(times, 0.0)))


class Oscillation(Measured):
    """Complex moduli (N,) [Pa] at angular frequencies (N,) [rad/s], ascending."""

    def __init__(self, omega, modulus):
        self.omega, self.measured = omega, np.append(modulus.real, modulus.imag)

    def ends(self, rest):
        rows = len(self.omega)
        storage, loss = self.measured[0], self.measured[rows]
        further = 1.0 if rest is None else max(1.0, (storage - rest) / loss)
        return 1 / (self.omega[-1] * _MARGIN), _MARGIN / self.omega[0] * further

    def of(self, modes):
        found = modes.complex_modulus(self.omega)
        return np.append(found.real, found.imag)

    def parts(self, times):
        phase = 1j * self.omega[:, None] * times
        parts = np.hstack([np.ones((len(self.omega), 1)), phase / (1 + phase)])
        return np.vstack([parts.real, parts.imag])


def _around(time, further):
    return time[0] / _MARGIN, time[-1] * _MARGIN * further


class Stress(Measured):
    """Relaxation moduli (N,) [Pa] at times (N,) [s], ascending."""

    def __init__(self, time, modulus):
        self.time, self.measured = time, modulus

    def ends(self, rest):
        early = np.searchsorted(self.time, self.time[-1] / 10)
        modulus, decades = self.measured[-1], np.log10(self.time[-1] / self.time[early])
        fall = max((self.measured[early] - modulus) / decades, NEGLIGIBLE * modulus)
        further = 1.0 if rest is None else max(1.0, (modulus - rest) / fall)
        return _around(self.time, further)

    def of(self, modes):
        return modes.modulus(self.time)

    def parts(self, times):
        return np.hstack([np.ones((len(self.time), 1)), np.exp(-self.time[:, None] / times)])


class Creep(Measured):
    """Creep compliances (N,) [1/Pa] at times (N,) [s], ascending."""

    def __init__(self, time, compliance):
        self.time, self.measured = time, compliance

    def ends(self, rest):
        # A compliance that is known and not reached yet grows at most as the time.
        further = 1.0 if rest is None else max(1.0, 1 / (rest * self.measured[-1]))
        return _around(self.time, further)

    def of(self, modes):
        return modes.compliance(self.time)

    def parts(self, times):
        return np.hstack([np.ones((len(self.time), 1)), -np.expm1(-self.time[:, None] / times)])

    def series(self, times, rest):
        matrix, target = self.parts(times) / self.measured[:, None], np.ones(len(self.measured))
        scale = 1.0 if rest is None else 1 / rest
        if rest is not None:  # the sum of all compliances is known
            matrix = np.vstack([matrix, np.full(len(times) + 1, _KNOWN / scale)])
            target = np.append(target, _KNOWN)
        amounts = _nonnegative(matrix, target)
        kept = amounts[1:] * matrix[: len(self.time), 1:].max(axis=0) > _INVISIBLE
        amounts[1:] *= kept
        if rest is not None:
            amounts *= scale / amounts.sum()
        return Retardation.of(float(amounts[0]), amounts[1:][kept], times[kept])

    def liquid(self, times):
        # Its slowest relaxation, about recoverable compliance times viscosity, is no slower than a solid's.
        flow = self.time[:, None] / times.max()
        matrix = np.hstack([self.parts(times) + flow, flow]) / self.measured[:, None]
        return rms(matrix @ _nonnegative(matrix, np.ones(len(matrix))) - 1)


def fitted(rows: Measured, rest: float | None) -> tuple[Modes, float]:
    """Modes at as few times a decade as follow the rows about as well as many do, and the error at rest [Pa].

    rest : modulus at rest [Pa] if it is known
    """

    def times(density):
        fast, slow = rows.ends(rest)
        return np.geomspace(fast, slow, int(np.ceil(np.log10(slow / fast) * density)) + 1)

    def misfit(modes):
        return rms(rows.misfit(modes))

    *coarser, finest = _TIMES_A_DECADE
    best = rows.series(times(finest), rest)
    enough = max(1.1 * misfit(best), NEGLIGIBLE)
    tried = (rows.series(times(density), rest) for density in coarser)
    found = next((series for series in tried if misfit(series) <= enough), best)
    if rest is not None:
        return found, 0.0
    # With the most times, as slow modes else leave room for a modulus at rest.
    error = _standard_errors(len(rows.measured), len(best.times) + 1, misfit(best), rows.liquid(times(finest)))
    return found, found.equilibrium / error if error and found.equilibrium else inf


def rms(values: np.ndarray) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(values**2)))


def _standard_errors(count, fitted, misfit, without):
    """Standard errors by which a fitted modulus at rest differs from zero.

    count, fitted : numbers of misfits, and of amounts that were fitted
    misfit, without : root mean square of the misfits with that modulus, and without it
    """
    noise = max(count * misfit**2 / max(count - fitted, 1), NEGLIGIBLE**2)
    # The sum of squares is least at the fitted amount, and grows as the square of the distance from it.
    return sqrt(max(count * (without**2 - misfit**2), 0.0) / noise)


def _nonnegative(matrix, target):
    """Amounts >= 0 of the columns of a matrix that come closest to a target."""
    # Only tables need it.
    from scipy.optimize import nnls

    size = np.linalg.norm(matrix, axis=0)
    size += size == 0
    return nnls(matrix / size, target, maxiter=100 * len(size))[0] / size


REACH = 6.0  # decades beyond either end to which a table is continued
_A_DECADE = 5  # moduli that the continued series is fitted to
_SPAN = 10**0.5  # from an end inwards, over which the exponent there is found
_SURE = 1.96  # standard errors in half an interval of 95 %
_ROUNDING = 1e-12
_LEAST = 1e-9  # exponent of a loss that is constant


@dataclass(frozen=True)
class End:
    """Power law at an end of a table: G'' goes on as frequency^exponent, and G' as causality then asks for.

    omega : angular frequency of the end [rad/s]
    modulus : complex modulus there [Pa]
    exponent : -1 to 1

    The law is a spring in parallel with a springpot, G = G_0 + S (i omega)^exponent, through the modulus of the
    end: G' = G'_end + G''_end (r^exponent - 1) / tan(pi exponent / 2), where r = omega / omega_end.
    """

    omega: float
    modulus: complex
    exponent: float

    def complex_modulus(self, omega: np.ndarray) -> np.ndarray:
        """G(omega) [Pa]."""
        exponent = self.exponent or _LEAST
        further = exponent * np.log(omega / self.omega)
        storage = self.modulus.real + self.modulus.imag * np.expm1(further) / tan(pi * exponent / 2)
        return storage + 1j * self.modulus.imag * np.exp(further)

    @property
    def at_rest(self) -> float:
        """Modulus at which a law of positive exponent comes to rest [Pa]."""
        left = 1 - self.modulus.imag / self.modulus.real / tan(pi * self.exponent / 2)
        return self.modulus.real * left if left > _ROUNDING else 0.0


@dataclass(frozen=True, eq=False)
class Continued:
    """A series of modes, and how it goes on beyond the frequencies at which it was measured.

    modes : that follow what was measured
    frequencies : lowest and highest angular frequency that was measured [rad/s]
    rest : modulus at rest [Pa] if it is known
    scatter : of the logarithm of the loss at the lower end
    """

    modes: Relaxation
    frequencies: tuple[float, float]
    rest: float | None
    scatter: float

    @cached_property
    def lower(self) -> End:
        """Law below the table: a plateau where the loss tells one, else a power law without one."""
        return self._lower(0.0)

    @cached_property
    def upper(self) -> End:
        """Law above the table."""
        omega = self.frequencies[1]
        inner, modulus = self.modes.complex_modulus(np.array([omega / _SPAN, omega]))
        exponent = log(modulus.imag / inner.imag) / log(_SPAN) if modulus.imag else -1.0
        return End(omega, complex(modulus), exponent)

    @property
    def at_rest(self) -> float:
        """Modulus at rest [Pa] if the law below the table goes on, its exponent as small as the scatter allows."""
        return self._lower(_SURE * sqrt(2) * self.scatter / log(_SPAN)).at_rest

    @cached_property
    def series(self) -> Modes:
        """Modes of the table and of both laws, over REACH decades beyond either end."""
        if not len(self.modes.times):
            return self.modes
        (low, high), further = self.frequencies, 10**REACH
        count = int(np.log10(high / low * further**2) * _A_DECADE)
        omega = np.geomspace(low / further, high * further, count)
        within = self.modes.complex_modulus(omega)
        below, above = self.lower.complex_modulus(omega), self.upper.complex_modulus(omega)
        modulus = np.where(omega < low, below, np.where(omega > high, above, within))
        return fitted(Oscillation(omega, modulus), self.rest)[0]

    def _lower(self, doubt):
        omega = self.frequencies[0]
        modulus, inner = self.modes.complex_modulus(np.array([omega, omega * _SPAN]))
        # A law of a smaller exponent would relax below zero, or below the known modulus.
        exponent = 2 / pi * atan2(modulus.imag, modulus.real - (self.rest or 0.0))
        if self.rest is None and modulus.imag:
            exponent = max(exponent, log(inner.imag / modulus.imag) / log(_SPAN) - doubt)
        return End(omega, complex(modulus), min(exponent, 1.0) if modulus.imag else 1.0)
