"""What accuracy costs in time: `crosscheck workprecision`."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from scene import markup

from ..figures import workprecision
from ..sweep import SweepResult
from ..workprecision import answers, report
from ..workprecision.catalogue import INQUIRIES
from ..workprecision.diagram import Inquiry
from .job import Heading, Panel, Round


@dataclass(frozen=True)
class Costs:
    """A job, see `job.Job`. names : of INQUIRIES; size : quick or full"""

    names: tuple[str, ...]
    size: str

    command, doing, place, folders = "workprecision", "Drawing the figures", "", ()
    files = (report.PAGE,)

    @classmethod
    def of(cls, arguments: Mapping) -> "Costs":
        """The job of these arguments again."""
        return cls(tuple(arguments["names"]), arguments["size"])

    @property
    def arguments(self) -> dict:
        """What is measured, and how much of it."""
        return {"names": list(self.names), "size": self.size}

    @property
    def inquiries(self) -> list[Inquiry]:
        """In the order they were asked for."""
        return [INQUIRIES[name] for name in self.names]

    @property
    def rounds(self) -> Sequence[Round]:
        """First all that is not timed."""
        return (
            Round([task for each in self.inquiries for task in each.untimed(self.size)]),
            Round([task for each in self.inquiries for task in each.timed(self.size)], alone=True),
        )

    def judged(self, swept: SweepResult) -> dict[str, Any]:
        """What each inquiry found, by its name."""
        return {each.name: each.judge(self.size, swept.outcomes) for each in self.inquiries}

    def write(self, folder: Path, judged: Mapping[str, Any], swept: SweepResult) -> Path:
        """The page, a chapter an inquiry."""
        chapters = [report.chapter(folder, each, judged[each.name]) for each in self.inquiries]
        return report.write_workprecision(folder, chapters, self.size, swept)

    def panels(self, judged: Mapping[str, Any]) -> Iterator[Panel]:
        """Those of the models apart by what is asked of them."""
        for name, found in judged.items():
            module = report.FIGURES.get(name, workprecision)
            if name == "models":
                for what, names in report.ASKED.items():
                    if some := answers.restricted(found, names):
                        yield Panel("", module, some, f"-{what.split()[0]}")
            else:
                yield Panel("", module, found, f"-{name}" if module is workprecision else "")

    def lines(self, judged: Mapping[str, Any]) -> Iterator[str]:
        """What to do."""
        for each in self.inquiries:
            yield Heading(each.title)
            yield f"  {each.advice(judged[each.name])}"

    def tables(self, judged: Mapping[str, Any]) -> Iterator[str]:
        """The same."""
        rows = [(each.title, each.advice(judged[each.name])) for each in self.inquiries]
        yield markup.table(rows, title="What accuracy costs")
