"""A quantity: one number that says how far two answers to one question are from each other."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf, isfinite

from scene.quantities import BARE, argument

from ...solving.outcome import Outcome
from ...solving.task import Task

# Least tolerance: stored values have ten digits.
LEAST = 1e-9


class Unmeasured(ValueError):
    """A quantity has no value; the message says why."""


@dataclass(frozen=True)
class Quantity:
    """A ratio of two answers to one question.

    id : short name, unique in a collection, by which it is stored
    sentence : what it is, in words
    of : what is compared, a number of compare.solving.outcome.Row or one of its measures; its mean over the rows
        of a task
    numerator, denominator : tasks, see `task.Task`; or the denominator is a number, in the SI unit of what is
        compared
    tolerance : by how much it may move, relative to the stored value; LEAST to 1
    reason : why by that much
    meaning : what the ratio says

    Raises ValueError for an id of more lines or a tolerance out of its range.
    """

    id: str
    sentence: str
    of: str
    numerator: Task
    denominator: Task | float
    tolerance: float
    reason: str
    meaning: str

    def __post_init__(self):
        if not self.id or not self.id.isprintable():
            raise ValueError(f"id = {self.id!r}: one printable line")
        stated = ("tolerance",) if hasattr(self.denominator, "question") else ("tolerance", "denominator")
        for name in stated:
            object.__setattr__(self, name, argument(name, getattr(self, name), BARE.value))
        if not LEAST <= self.tolerance <= 1:
            raise ValueError(f"{self.id}: tolerance = {self.tolerance:g} must lie between {LEAST:g} and 1")

    @property
    def tasks(self) -> list[Task]:
        """Tasks to be solved for the quantity."""
        return [side for side in (self.numerator, self.denominator) if not isinstance(side, int | float)]

    def measured(self, outcomes: Mapping[Task, Outcome]) -> tuple[list[float], list[float]]:
        """Numbers of the numerator and of the denominator, one a row. Raises Unmeasured where a solve failed."""
        one, other = (
            [float(side)] if isinstance(side, int | float) else _numbers(side, outcomes[side], self.of)
            for side in (self.numerator, self.denominator)
        )
        return one, other

    def value(self, outcomes: Mapping[Task, Outcome]) -> float:
        """The ratio. Raises Unmeasured where a solve failed, or nothing finite comes out."""
        over, under = (sum(numbers) / len(numbers) for numbers in self.measured(outcomes))
        ratio = over / under if under else inf
        if not isfinite(ratio):
            raise Unmeasured(f"{self.of} of {over:g} over {under:g} is no finite number")
        return ratio


def _numbers(task: Task, outcome: Outcome, of: str) -> list[float]:
    for row in outcome.rows:
        if row.reason is not None:
            raise Unmeasured(f"{task.label}: {row.reason}")
        if of not in row.measures and not isinstance(getattr(row, of, None), float):
            raise Unmeasured(
                f"{task.label}: {of!r} is no number of compare.solving.outcome.Row, and not among its measures"
            )
    return [row.measures[of] if of in row.measures else getattr(row, of) for row in outcome.rows]
