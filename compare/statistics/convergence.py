"""Errors and times along a ladder of settings: the order at which errors fall, and what a wanted error takes."""

from dataclasses import dataclass
from functools import cached_property
from math import exp, nan

import numpy as np
from pandas import DataFrame

from .sampling import Effort

# Steps that a line is fitted through at least, and how far above the error of the reference they have to lie.
FEWEST, ABOVE = 3, 3.0
# Relative error below which rounding is all there is.
ROUNDING = 1e-12


@dataclass(frozen=True)
class Order:
    """error = constant * setting**(-order), fitted to the logarithms.

    order, constant : NaN where too few steps show an error of their own
    """

    order: float
    constant: float

    def at(self, settings):
        """Error at settings of any shape."""
        return self.constant * np.asarray(settings, float) ** -self.order


def observed(settings, errors, reference_error: float = 0.0) -> Order:
    """Order of relative errors (steps,) in a setting (steps,), from those well above the error of the reference.

    Failed steps are left out.
    """
    settings, errors = np.asarray(settings, float), np.asarray(errors, float)
    shown = np.isfinite(errors) & (errors > max(ABOVE * reference_error, ROUNDING))
    if np.count_nonzero(shown) < FEWEST:
        return Order(nan, nan)
    x, y = np.log(settings[shown]), np.log(errors[shown])
    centred = x - x.mean()
    slope = float(centred @ y / (centred @ centred))
    return Order(-slope, exp(y.mean() - slope * x.mean()))


@dataclass(frozen=True)
class MeasuredLadder:
    """One ladder of a contact, by one quantity; arrays (steps,) are NaN where a solve failed.

    contact : name of the contact; title : for people
    quantity : name; label : for people
    ladder : label of the ladder; setting : what changes from step to step; solver : by name
    values : of the setting; errors : relative; processor : time [s]
    reasons : why a solve failed, empty where it did not
    """

    contact: str
    title: str
    quantity: str
    label: str
    ladder: str
    setting: str
    solver: str
    reference_error: float
    values: np.ndarray
    errors: np.ndarray
    processor: np.ndarray
    reasons: np.ndarray

    @property
    def failures(self) -> list[tuple[float, str]]:
        """Setting and reason of each solve that failed."""
        return [(float(value), str(why)) for value, why in zip(self.values, self.reasons, strict=True) if why]

    @cached_property
    def order(self) -> Order:
        """Order at which the error falls with the setting."""
        return observed(self.values, self.errors, self.reference_error)

    def reaching(self, level: float) -> int | None:
        """Cheapest step from which on the error stays at or below a level; None if none does.

        A step that is right by chance does not count: those of finer settings have to be so too. The finest has
        none that could confirm it, and counts alone.
        """
        within = self.errors <= level
        good = [k for k in range(len(within)) if within[k:].all()]
        return min(good, key=lambda k: self.processor[k]) if good else None

    @property
    def certain(self) -> float:
        """Error that the last step is known to reach, with that of the reference."""
        return self.errors[-1] + self.reference_error

    def effort(self, level: float) -> Effort | None:
        """Effort for a wanted error, with the error of the reference; None where it is not reached."""
        k = self.reaching(level - self.reference_error)
        if k is None:
            return None
        return Effort(self.solver, f"{self.values[k]:g} {self.setting}", float(self.processor[k]))


def ladders(steps: DataFrame) -> list[MeasuredLadder]:
    """Every ladder of every contact by every quantity, from rows of one step each."""
    steps = steps.fillna({"reason": ""})
    found = []
    for _, rows in steps.groupby(["contact", "ladder", "quantity"], sort=False):
        first = rows.iloc[0]
        names = "contact", "title", "quantity", "label", "ladder", "setting", "solver"
        found.append(
            MeasuredLadder(
                **{name: str(first[name]) for name in names},
                reference_error=float(first["reference_error"]),
                values=rows["value"].to_numpy(float),
                errors=rows["relative_error"].to_numpy(float),
                processor=rows["processor"].to_numpy(float),
                reasons=rows["reason"].to_numpy(str),
            )
        )
    return found
