"""The named hard cases, each with its law: `crosscheck stability`."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from scene import markup

from ..stability import report
from ..stability.collection import CASES
from ..stability.examination import Examination
from ..stability.report import BROKEN, VERDICTS, Record, records
from ..sweep import SweepResult
from .job import Panel, Round


@dataclass(frozen=True)
class HardCases:
    """A job, see `job.Job`. size : small or large"""

    size: str

    command, doing, place, folders = "stability", "Writing the table", "", ()
    files = (report.PAGE, report.MARKDOWN, report.TABLE)

    @classmethod
    def of(cls, arguments: Mapping) -> "HardCases":
        """The job of these arguments again."""
        return cls(arguments["size"])

    @property
    def arguments(self) -> dict:
        """How hard."""
        return {"size": self.size}

    @property
    def rounds(self) -> Sequence[Round]:
        """All of them."""
        return (Round([Examination(name, self.size) for name in CASES]),)

    def judged(self, swept: SweepResult) -> list[Record]:
        """One a case."""
        return records(swept.outcomes)

    def write(self, folder: Path, judged: Sequence[Record], swept: SweepResult) -> Path:
        """Table and page."""
        return report.write_stability(folder, judged, self.size, swept)

    def panels(self, judged: Sequence[Record]) -> Iterator[Panel]:
        """None: a table says it."""
        return iter(())

    def lines(self, judged: Sequence[Record]) -> Iterator[str]:
        """How many of each verdict, and what is broken."""
        verdicts = [record.verdict for record in judged]
        yield ", ".join(f"{verdict} {verdicts.count(verdict)}" for verdict in VERDICTS)
        for record in broken(judged):
            yield f"  {record.name}: {record.what} {record.found:.2g}, allowed {record.allowed:.2g}"
            yield f"    {record.law} {record.message}"

    def tables(self, judged: Sequence[Record]) -> Iterator[str]:
        """The same."""
        verdicts = [record.verdict for record in judged]
        counted = [(verdict, verdicts.count(verdict)) for verdict in VERDICTS]
        yield markup.table(counted, ("verdict", "cases"), "Named hard cases")
        if wrong := broken(judged):
            rows = [(each.name, each.what, each.found, each.allowed, each.message) for each in wrong]
            yield markup.table(rows, ("broken", "what", "found", "allowed", "message"))


def broken(judged: Sequence[Record]) -> list[Record]:
    """Those that do not keep their law."""
    return [record for record in judged if record.verdict == BROKEN]
