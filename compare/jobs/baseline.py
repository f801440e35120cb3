"""Quantities solved again and held against stored ones: `crosscheck regress`."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from ..quantity import Quantity
from ..regression import Changes, changes
from ..sweep import SweepResult
from .job import Panel, Round


@dataclass(frozen=True)
class Baseline:
    """A job, see `job.Job`.

    path : of the stored values, for people; stored : the values
    quantities : that are measured
    """

    path: Path
    stored: Mapping[str, float]
    quantities: tuple[Quantity, ...]

    command, doing, place, folders, files = "regress", "Comparing", "", (), ()

    @property
    def arguments(self) -> dict:
        """The file."""
        return {"baseline": self.path.name}

    @property
    def rounds(self) -> Sequence[Round]:
        """Of all quantities."""
        return (Round([task for quantity in self.quantities for task in quantity.tasks]),)

    def judged(self, swept: SweepResult) -> Changes:
        """Every quantity today and as it was."""
        return changes(self.quantities, self.stored, swept.outcomes)

    def write(self, folder: Path, judged: Changes, swept: SweepResult) -> None:
        """Nothing: what is stored is rewritten on demand."""

    def panels(self, judged: Changes) -> Iterator[Panel]:
        """None."""
        return iter(())

    def lines(self, judged: Changes) -> Iterator[str]:
        """What has moved."""
        yield str(judged)

    def tables(self, judged: Changes) -> Iterator[str]:
        """The same."""
        yield judged._repr_html_()
