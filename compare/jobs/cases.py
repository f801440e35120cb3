"""Scenes in one and in three dimensions, judged: `crosscheck run`."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from scene import markup

from .. import report
from ..archive import RESULTS, record
from ..cases import Case
from ..study import Point, points, tasks
from ..sweep import SweepResult
from ..verdict import Judgement, judge
from ..written import as_json, from_json
from .job import Heading, Panel, Round


@dataclass(frozen=True)
class Cases:
    """A job, see `job.Job`. cases : by name"""

    cases: Mapping[str, Case]

    command, doing, place = "run", "Writing the report", ""
    files = (report.PAGE, report.MANIFEST)

    @classmethod
    def of(cls, arguments: Mapping) -> "Cases":
        """The job of these arguments again."""
        return cls({name: from_json(Case, content) for name, content in arguments["cases"].items()})

    @property
    def arguments(self) -> dict:
        """Every case."""
        return {"cases": {name: as_json(Case, case) for name, case in self.cases.items()}}

    @property
    def folders(self) -> Sequence[str]:
        """One a case."""
        return [report.slug(name) for name in self.cases]

    @cached_property
    def points(self) -> Mapping[str, Sequence[Point]]:
        """Of every curve, by the name of the case."""
        return {name: points(case) for name, case in self.cases.items()}

    @property
    def rounds(self) -> Sequence[Round]:
        """All cases together."""
        return (Round(tasks([point for those in self.points.values() for point in those])),)

    def judged(self, swept: SweepResult) -> dict[str, Judgement]:
        """By the name of the case."""
        return {name: judge(case, self.points[name], swept) for name, case in self.cases.items()}

    def write(self, folder: Path, judged: Mapping[str, Judgement], swept: SweepResult) -> Path:
        """The report, and a file of results a case."""
        page = report.write_report(folder, judged, swept)
        for name, judgement in judged.items():
            record(folder / report.slug(name) / RESULTS, judgement)
        return page

    def panels(self, judged: Mapping[str, Judgement]) -> Iterator[Panel]:
        """Of every case in its folder."""
        for name, judgement in judged.items():
            yield from (Panel(report.slug(name), module, judgement) for module in report.FIGURES)

    def lines(self, judged: Mapping[str, Judgement]) -> Iterator[str]:
        """The numbers that matter."""
        for name, judgement in judged.items():
            yield Heading(judgement.case.title or name)
            yield from (f"  {number.name}: {number.written}" for number in judgement.numbers)
            if judgement.failures:
                yield f"  {len(judgement.failures)} solves failed; the report says why"

    def tables(self, judged: Mapping[str, Judgement]) -> Iterator[str]:
        """The same, each with what it means."""
        for name, judgement in judged.items():
            yield report.fragment(judgement)
            if judgement.failures:
                yield markup.table(judgement.failures, ("failed", "reason"), f"{name}: what failed")
