"""Moduli beyond the ends of a table: the power law that the loss follows at an end goes on."""

from dataclasses import dataclass
from functools import cached_property
from math import atan2, log, pi, sqrt, tan

import numpy as np

from .fit import Modes, Oscillation, fitted
from .modes import Relaxation

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

    The law is a spring beside a springpot, G = G_0 + S (i omega)^exponent, through the modulus of the end:
    G' = G'_end + G''_end (r^exponent - 1) / tan(pi exponent / 2), where r = omega / omega_end.
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
