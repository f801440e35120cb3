"""A quantity: one number that says how far two answers to one question are from each other."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import inf, isfinite

from .outcome import Outcome, Row
from .store import Task

# Of a tolerance: stored values have ten digits.
LEAST = 1e-9


class Unmeasured(ValueError):
    """A quantity has no value; the message says why."""


@dataclass(frozen=True, kw_only=True)
class Quantity:
    """A ratio of two answers to one question.

    name : one line, unique in a collection
    of : what is compared, a number of compare.outcome.Row or one of its measures; its mean over the rows of a task
    numerator, denominator : tasks, as of store; or the denominator is a number, in the SI unit of what is compared
    tolerance : by how much it may move, relative to the stored value; LEAST to 1
    reason : why by that much
    meaning : what the ratio says

    Raises ValueError for a name of more lines or a tolerance out of its range.
    """

    name: str
    of: str
    numerator: Task
    denominator: Task | float
    tolerance: float
    reason: str
    meaning: str

    def __post_init__(self):
        if not self.name or not self.name.isprintable():
            raise ValueError(f"name = {self.name!r}: one printable line")
        if not LEAST <= self.tolerance <= 1:
            raise ValueError(f"{self.name}: tolerance = {self.tolerance:g} must lie between {LEAST:g} and 1")

    @property
    def tasks(self) -> list[Task]:
        """What has to be solved."""
        return [side for side in (self.numerator, self.denominator) if not isinstance(side, int | float)]

    def value(self, outcomes: Mapping[Task, Outcome]) -> float:
        """The ratio. Raises Unmeasured where a solve failed, or nothing finite comes out."""
        over, under = (
            side if isinstance(side, int | float) else _mean(side, outcomes[side].rows, self.of)
            for side in (self.numerator, self.denominator)
        )
        ratio = over / under if under else inf
        if not isfinite(ratio):
            raise Unmeasured(f"{self.of} of {over:g} over {under:g} is no finite number")
        return ratio


def _mean(task: Task, rows: Sequence[Row], of: str) -> float:
    for row in rows:
        if row.reason is not None:
            raise Unmeasured(f"{task.label}: {row.reason}")
        if of not in row.measures and not isinstance(getattr(row, of, None), float):
            raise Unmeasured(
                f"{task.label}: {of!r} is no number of compare.outcome.Row, and not among its measures"
            )
    return sum(row.measures[of] if of in row.measures else getattr(row, of) for row in rows) / len(rows)
