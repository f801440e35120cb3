"""Errors and times along a ladder of settings: the order at which errors fall, and what a wanted error takes."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import exp, nan

import numpy as np
from pandas import DataFrame

from ..solving.amounts import seconds, setting, share
from .intervals import student
from .sampling import Effort

# Steps that a line is fitted through at least, and how far above the error of the reference they have to lie.
FEWEST, ABOVE = 3, 3.0
# Relative error below which rounding is all there is.
ROUNDING = 1e-12
# Errors alike: what is gained by less than this factor is not worth having.
ALIKE = 1.5


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


@dataclass(frozen=True)
class MeasuredLadder:
    """One ladder of a contact, by one estimate of a quantity; arrays (steps,) are NaN where a solve failed.

    contact : name of the contact; title : for people
    quantity : name of the estimate; label : of the quantity, for people; estimate : empty of the only one
    ladder : label of the ladder; setting : what changes from step to step; solver : by name
    values : of the setting; errors : relative; processor : time [s]; memory [bytes]
    reasons : why a solve failed, empty where it did not
    """

    contact: str
    title: str
    quantity: str
    label: str
    estimate: str
    ladder: str
    setting: str
    solver: str
    reference_error: float
    values: np.ndarray
    errors: np.ndarray
    processor: np.ndarray
    memory: np.ndarray
    reasons: np.ndarray

    @property
    def where(self) -> str:
        """Contact and quantity in words."""
        return f"{self.title}: {self.label}"

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

    @property
    def enough(self) -> int | None:
        """Cheapest step from which on errors are as small as on the last; None where that one failed."""
        return self.reaching(ALIKE * self.errors[-1])

    @property
    def best(self) -> float:
        """Least error of all steps; NaN where none was solved."""
        return float(np.nanmin(self.errors)) if np.isfinite(self.errors).any() else nan

    @property
    def unsolved(self) -> str:
        """Reason why there is no error at all; empty where there is one."""
        if np.isfinite(self.errors).any():
            return ""
        failed = self.failures
        return f"no step was solved ({failed[0][1]})" if failed else "the reference was not solved"

    def cell(self, level: float) -> str:
        """Effort for a wanted error in words, or the reason why it is not known."""
        if self.unsolved:
            return self.unsolved
        if level < self.reference_error:
            return f"reference known to {share(self.reference_error)}"
        k = self.reaching(level)
        if k is None:
            return f"not reached; best {share(self.best)}"
        return f"{setting(self.setting, self.values[k])}: {seconds(self.processor[k])}"


def ladders(steps: DataFrame) -> list[MeasuredLadder]:
    """Every ladder of every contact by every estimate, from rows of one step each."""
    steps = steps.fillna({"estimate": "", "reason": ""})
    found = []
    for _, rows in steps.groupby(["contact", "ladder", "quantity"], sort=False):
        first = rows.iloc[0]
        names = "contact", "title", "quantity", "label", "estimate", "ladder", "setting", "solver"
        found.append(
            MeasuredLadder(
                **{name: str(first[name]) for name in names},
                reference_error=float(first["reference_error"]),
                values=rows["value"].to_numpy(float),
                errors=rows["relative_error"].to_numpy(float),
                processor=rows["processor"].to_numpy(float),
                memory=rows["memory"].to_numpy(float),
                reasons=rows["reason"].to_numpy(str),
            )
        )
    return found


def answers(found: Sequence[MeasuredLadder]) -> list[MeasuredLadder]:
    """Ladders by the first estimate of each quantity: what the solver answers."""
    first: dict[tuple[str, str], str] = {}
    for each in found:
        first.setdefault((each.contact, each.label), each.quantity)
    return [each for each in found if each.quantity == first[each.contact, each.label]]
