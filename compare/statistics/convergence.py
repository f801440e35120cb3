"""Order at which an error falls with a setting, fitted to the steps that show an error of their own."""

from dataclasses import dataclass
from math import exp, nan

import numpy as np

from .jackknife import student

# Steps that a line is fitted through at least, and how far above the error of the reference they have to lie.
FEWEST, ABOVE = 3, 3.0
# Relative error below which rounding is all there is.
ROUNDING = 1e-12


@dataclass(frozen=True)
class Order:
    """error = constant * setting**(-order), fitted to the logarithms.

    order, constant : NaN where too few steps show an error of their own
    deviation : standard error of the order
    count : of the steps that it rests on
    """

    order: float
    constant: float
    deviation: float
    count: int

    @property
    def interval(self) -> tuple[float, float]:
        """Interval of 95 % of the order, by Student."""
        half = float(student(0.95, max(self.count - 2, 0))) * self.deviation
        return self.order - half, self.order + half

    def at(self, settings):
        """Error at settings of any shape."""
        return self.constant * np.asarray(settings, float) ** -self.order


def observed(settings, errors, reference_error: float = 0.0) -> Order:
    """Order of relative errors (steps,) in a setting (steps,), from those well above the error of the reference.

    Failed steps are left out.
    """
    settings, errors = np.asarray(settings, float), np.asarray(errors, float)
    shown = np.isfinite(errors) & (errors > max(ABOVE * reference_error, ROUNDING))
    count = int(np.count_nonzero(shown))
    if count < FEWEST:
        return Order(nan, nan, nan, count)
    x, y = np.log(settings[shown]), np.log(errors[shown])
    centred = x - x.mean()
    slope = float(centred @ y / (centred @ centred))
    left = y - y.mean() - slope * centred
    deviation = float(np.sqrt(left @ left / (count - 2) / (centred @ centred)))
    return Order(-slope, exp(y.mean() - slope * x.mean()), deviation, count)
