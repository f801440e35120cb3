"""Tasks of which the answer is arrays, in place of rows for single scenes."""

from abc import abstractmethod
from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from ...solving.outcome import Outcome, Row
from ...solving.task import Task
from . import parameters


class ArrayTask(Task):
    """A task whose answer is some arrays of one shape; NaN where there is none.

    names : of the arrays
    """

    names: ClassVar[tuple[str, ...]]
    keeps_fields = True

    @property
    def packages(self) -> tuple[str, ...]:
        """Packages of the contacts, and the modules that state and solve them."""
        return "scene", "mdr1d", parameters.__name__, __name__, type(self).__module__

    @property
    @abstractmethod
    def shape(self) -> tuple[int, ...]:
        """Shape of every array."""

    @abstractmethod
    def arrays(self) -> Mapping[str, np.ndarray]:
        """Solve, and return the arrays by name."""

    def solve(self) -> Outcome:
        """Outcome without rows, whose fields are the arrays."""
        return Outcome((), dict(self.arrays()))

    def failed(self, reason: str) -> Outcome:
        """Outcome of NaN everywhere, with a row for the reason."""
        return Outcome((Row(reason=reason),), {name: np.full(self.shape, np.nan) for name in self.names})

    def fits(self, outcome: Outcome) -> bool:
        """Whether every array is there and has its shape."""
        return all(np.shape(outcome.fields.get(name, 0.0)) == self.shape for name in self.names)
