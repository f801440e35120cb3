"""Whether curves need vertical shifts beside the horizontal ones of Eq. 23, which has none."""

from dataclasses import dataclass
from math import nan

import numpy as np
from scipy.stats import f as f_distribution

from .commoncurve import STARTS, Fit, Misfit, bounds, from_increments, minimum, power_of_speed
from .mastercurve import Collapse

# Of a vertical shift that is not needed, taken for one that is.
CHANCE = 0.01


@dataclass(frozen=True)
class Vertical:
    """What vertical shifts beside the horizontal ones achieve, ln mu + c_v against ln F + b_v.

    shifts, shift_errors : c_v (K,), zero at the reference speed, and standard errors
    exponent, exponent_error : of exp(c_v) ~ v^exponent
    horizontal_exponent, horizontal_exponent_error : of p(v), now with vertical shifts beside it
    after : misfit with both
    alone : misfit with vertical shifts only
    chance : of a misfit that falls as much if no vertical shift is needed (F test); errors need not be known, but
        points must be independent
    separable : False where straight parallel lines fit: then one shift is the other
    """

    shifts: np.ndarray
    shift_errors: np.ndarray
    exponent: float
    exponent_error: float
    horizontal_exponent: float
    horizontal_exponent_error: float
    after: Misfit
    alone: Misfit
    chance: float
    separable: bool

    @property
    def needed(self) -> str:
        """yes, no or undecided, at 1 in 100."""
        if not self.separable or not np.isfinite(self.chance):
            return "undecided"
        return "yes" if self.chance < CHANCE else "no"


def vertical_shifts(result: Collapse) -> Vertical:
    """Shift curves vertically too, and ask whether that is needed.

    The polynomial has the degree of the collapse. Raises ValueError where there are too few points for as many
    shifts.
    """
    count = len(result.curves) - 1
    lower, upper = bounds(result.curves)
    logs = np.log(result.speeds / result.speeds[result.reference])
    start = np.diff(result.shifts)
    fit = Fit(result.curves, result.degree, lifted=True)
    freedom = fit.log_load.size - fit.degree - 1 - 2 * count
    if freedom < 1:
        raise ValueError(f"too few points for {2 * count} shifts and a curve: add loads")
    guesses = [start, *(power * np.diff(logs) for power in STARTS)]
    best = min((minimum(fit, guess, lower, upper) for guess in guesses), key=lambda found: found.cost)
    without = float(np.sum(np.square(Fit(result.curves, result.degree).residuals(start))))
    reduced = 2 * best.cost / freedom
    levels, covariance = fit.linearised(best.x)
    covariance = covariance * (max(1.0, reduced) if fit.known else reduced)
    horizontal, raised = (
        from_increments(values, covariance[part, part], result.reference)
        for values, part in ((best.x, slice(count)), (levels, slice(count, 2 * count)))
    )
    exponent, exponent_error = power_of_speed(logs, raised[0], raised[1], result.reference)
    horizontal_exponent, horizontal_error = power_of_speed(logs, horizontal[0], horizontal[1], result.reference)
    gain = (without - 2 * best.cost) / count / reduced if reduced else nan
    return Vertical(
        shifts=raised[0],
        shift_errors=np.sqrt(np.diag(raised[1])),
        exponent=exponent,
        exponent_error=exponent_error,
        horizontal_exponent=horizontal_exponent,
        horizontal_exponent_error=horizontal_error,
        after=fit.misfit(best.x, shifts=count),
        alone=fit.misfit(np.zeros(count), shifts=0),
        chance=float(f_distribution.sf(gain, count, freedom)),
        separable=result.separable,
    )
