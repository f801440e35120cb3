"""Laws of shifts with the temperature: the constants of WLF, and whether Arrhenius would do.

With T_r as reference the law of Arrhenius is the law of WLF with c2 = T_r, as 1/T - 1/T_r = -(T - T_r)/(T T_r). So
the interval of c2 decides whether Arrhenius would do.
"""

from dataclasses import dataclass
from math import inf, log, nan

import numpy as np
from scipy import special

from scene.effects.temperature import GAS_CONSTANT

from ...statistics.intervals import KNOWN, student
from .temperatureshifts import TemperatureShifts

WLF, ARRHENIUS = "WLF", "Arrhenius"
LEVEL, UNLIKELY = 0.95, 0.01  # of intervals; chance of the scatter about a law, below which it is none
# Values of c2 over the distance of the pole from the lowest temperature, in which its interval is sought.
REACH = np.concatenate([[0.0], np.geomspace(1e-3, 1e4, 1001)])
FINER = 6  # times at most that they are tried closer together, until a tenth of them lies in the interval
TWO = "two temperatures: c1 and c2 need three at least"
OPEN = "the shifts leave it open: temperatures farther apart, or a smaller scatter, would tell"
WRONG = "no law of WLF goes through the shifts"
RISING = "the shifts grow with the temperature, as those of no elastomer do"
UNSCATTERED = "no point was measured more than once: the scatter is not known"


@dataclass(frozen=True)
class Number:
    """A constant with the ends of its interval of 95 %; infinite where it is open, NaN where there is none."""

    value: float
    low: float
    high: float

    @property
    def known(self) -> bool:
        """Whether both ends are known."""
        return bool(np.isfinite([self.value, self.low, self.high]).all())


NONE = Number(nan, nan, nan)


@dataclass(frozen=True)
class ShiftLaw:
    """Law of the temperature that fits shifts, with its reasons.

    reference : T_r of the constants [K]
    c1, c2 : of WLF [1], [K]
    activation_energy : of the law of Arrhenius closest to the shifts [J/mol]
    reason : why c1 and c2 are not known; empty where they are
    against : why the law of Arrhenius is none of these shifts; empty where it is
    """

    reference: float
    c1: Number
    c2: Number
    activation_energy: Number
    reason: str
    against: str

    @property
    def allowed(self) -> tuple[str, ...]:
        """Names of the laws whose constants are known."""
        return (WLF,) * (not self.reason) + (ARRHENIUS,) * (not self.against)

    def log_shift(self, temperature: np.ndarray, law: str) -> np.ndarray:
        """ln a_T by either law at temperatures [K]."""
        above = temperature - self.reference
        if law == ARRHENIUS:
            return -self.activation_energy.value / GAS_CONSTANT / self.reference * above / temperature
        return -log(10) * self.c1.value * above / (self.c2.value + above)


def law_of(found: TemperatureShifts) -> ShiftLaw:
    """Constants of WLF and of Arrhenius of shifts that were found."""
    reference, others = found.reference, found.temperatures != found.reference
    above, shifts = (found.temperatures - reference)[others], found.shifts.value[others]
    # The misfit of the polynomial counts in addition to scatter.
    spread = found.covariance[np.ix_(others, others)] + np.diag(
        np.square(np.broadcast_to(found.shifts.bias, others.shape)[others])
    )
    known = bool(np.isfinite(spread).all())
    white = (
        np.linalg.pinv(np.linalg.cholesky(spread + 1e-20 * np.eye(len(above)))) if known else np.eye(len(above))
    )
    seen = white @ shifts

    def fitted(c2):
        """Chi square, the best c1 and its standard error."""
        law = white @ (-log(10) * above / (c2 + above))
        c1 = law @ seen / (law @ law)
        return float(np.sum(np.square(seen - c1 * law))), float(c1), float((law @ law) ** -0.5)

    dof = found.shifts.dof
    quantile = student(LEVEL, dof) if known else nan
    square, c1, error = fitted(reference)
    scale = log(10) * GAS_CONSTANT * reference
    energy = Number(*(scale * each for each in (c1, c1 - quantile * error, c1 + quantile * error)))
    wrong = _unlikely(square, len(above) - 1, dof)
    if not known:
        return ShiftLaw(reference, NONE, NONE, energy, UNSCATTERED, UNSCATTERED)
    if energy.high < 0:
        return ShiftLaw(reference, NONE, NONE, NONE, RISING, RISING)
    if len(above) < 2:
        return ShiftLaw(reference, NONE, NONE, energy, TWO, "")
    pole = max(float(-above.min()), 1.0)
    tried = max(float(-above.min()), 0.0) + 1e-6 * pole + pole * REACH
    for _ in range(FINER):
        squares, firsts, errors = (np.array(each) for each in zip(*map(fitted, tried), strict=True))
        best = int(np.argmin(squares))
        allowed = squares - squares[best] <= quantile**2
        if allowed[-1] or allowed.sum() > len(allowed) / 10:
            break
        first, last = np.flatnonzero(allowed)[[0, -1]]
        tried = np.linspace(tried[max(first - 1, 0)], tried[last + 1], len(tried))
    margin = errors * np.sqrt(np.where(allowed, quantile**2 - (squares - squares[best]), 0.0))
    high = inf if allowed[-1] else tried[allowed].max()
    c2 = Number(tried[best], tried[allowed].min(), high)
    c1s = Number(
        firsts[best], (firsts - margin)[allowed].min(), inf if allowed[-1] else (firsts + margin)[allowed].max()
    )
    out = wrong or not c2.low <= reference <= c2.high
    against = f"it is the case c2 = {reference:.4g} K of WLF, which the shifts leave out" if out else ""
    wrong = _unlikely(squares[best], len(above) - 2, dof)
    reason = WRONG if wrong else "" if c2.known else OPEN
    return ShiftLaw(reference, c1s, c2, energy, reason, against)


def _unlikely(square, left, dof):
    """Whether scatter would hardly make such a chi square with `left` degrees of freedom."""
    return left > 0 and square / left > special.fdtri(left, min(dof, KNOWN), 1 - UNLIKELY)
