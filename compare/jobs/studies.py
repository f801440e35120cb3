"""Claims of the paper asked of many contacts: `crosscheck study`."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from scene import markup

from ..report import slug
from ..studies import report, tableau
from ..studies.catalogue import SIZES, STUDIES, Study
from ..studies.judgement import JudgedStudy, judge_study
from ..studies.series import Series, tasks
from ..studies.wording import line, written
from ..sweep import SweepResult
from .job import Heading, Panel, Round


@dataclass(frozen=True)
class Conducted:
    """A job, see `job.Job`.

    name : of its folder; study : the question; size : a name of SIZES
    source : of a study that does not come with the package, the text of its file
    """

    name: str
    study: Study
    size: str
    source: str | None = None

    command, doing = "study", "Judging, drawing the figures"
    files = (report.PAGE, report.MANIFEST)

    @classmethod
    def of(cls, arguments: Mapping) -> "Conducted":
        """The job of these arguments again."""
        name, size, source = arguments["name"], arguments["size"], arguments.get("source")
        if source is None:
            return cls(name, STUDIES[name], size)
        return cls.stated(name, source, size)

    @classmethod
    def stated(cls, name: str, source: str, size: str, file: str = "study") -> "Conducted":
        """By the text of a file, whose name stands before its mistakes. Raises InvalidInput."""
        from ..studies.asked import study_of

        return cls(name, study_of(source, file), size, source)

    @property
    def arguments(self) -> dict:
        """Name, size and, if it is a user's own, the whole text."""
        own = {} if self.source is None else {"source": self.source}
        return {"name": self.name, "size": self.size} | own

    @property
    def place(self) -> str:
        """One folder a study and size."""
        return slug(f"{self.name}-{self.size}")

    @property
    def folders(self) -> Sequence[str]:
        """That of the page."""
        return [self.place]

    @cached_property
    def series(self) -> list[Series]:
        """What is asked, at this size."""
        return self.study.series(SIZES[self.size])

    @property
    def rounds(self) -> Sequence[Round]:
        """All series together."""
        return (Round([task for each in self.series for task in tasks(each)]),)

    def judged(self, swept: SweepResult) -> JudgedStudy:
        """All series, and what is asked of them together."""
        return judge_study(self.name, self.study, SIZES[self.size], self.series, swept.outcomes)

    def write(self, folder: Path, judged: JudgedStudy, swept: SweepResult) -> Path:
        """The page."""
        return report.write_study(folder, judged, swept)

    def panels(self, judged: JudgedStudy) -> Iterator[Panel]:
        """Of the study, and of each series in its folder."""
        yield from (Panel("", module, judged) for module in report.OF_THE_STUDY)
        for each in judged.series:
            name = slug(each.solved.series.name)
            yield from (Panel(name, module, each) for module in report.OF_A_SERIES)

    def lines(self, judged: JudgedStudy) -> Iterator[str]:
        """Every finding."""
        for column in tableau.columns(judged):
            yield Heading(column.title)
            yield from (f"  {line(finding)}" for finding in column.findings)
        if failed := sum(len(report.failures(each)) for each in judged.series):
            yield f"\n{failed} solves failed; the page says why"

    def tables(self, judged: JudgedStudy) -> Iterator[str]:
        """The same."""
        for column in tableau.columns(judged):
            rows = [(each.claim, each.dimension, each.verdict, written(each)) for each in column.findings]
            yield markup.table(rows, ("claim", "in", "verdict", "found, within 95 %"), column.title)
        if failed := sum(len(report.failures(each)) for each in judged.series):
            yield markup.paragraph(f"{failed} solves failed; the page says why.")
