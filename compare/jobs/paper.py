"""The paper simulated again: `crosscheck paper`."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from scene import markup

from ..figures import paper_contacts, paper_law, paper_losses, paper_sketch, paper_studies, shifted_curves
from ..paper import report, reproduction
from ..paper.claims import Claim, claims
from ..paper.reproduction import Reproduction
from ..sweep import SweepResult
from .job import Panel, Round


@dataclass(frozen=True)
class Reproduced:
    """The data of every figure, and what becomes of the claims."""

    data: Reproduction
    claims: tuple[Claim, ...]


@dataclass(frozen=True)
class Paper:
    """A job, see `job.Job`. profiles : averaged at most"""

    profiles: int

    command, doing, place, folders = "paper", "Drawing the figures", "", ()
    files = (report.PAGE, report.MANIFEST)

    @classmethod
    def of(cls, arguments: Mapping) -> "Paper":
        """The job of these arguments again."""
        return cls(arguments["profiles"])

    @property
    def arguments(self) -> dict:
        """How much is simulated."""
        return {"profiles": self.profiles}

    @cached_property
    def size(self) -> reproduction.Size:
        """How much of each figure."""
        return reproduction.Size.of(self.profiles)

    @property
    def rounds(self) -> Sequence[Round]:
        """All figures together."""
        return (Round(reproduction.tasks(self.size)),)

    def judged(self, swept: SweepResult) -> Reproduced:
        """Figures and claims."""
        found = reproduction.collect(self.size, swept.outcomes)
        return Reproduced(found, tuple(claims(found)))

    def write(self, folder: Path, judged: Reproduced, swept: SweepResult) -> Path:
        """The page."""
        return report.write_paper(folder, judged.data, judged.claims, swept)

    def panels(self, judged: Reproduced) -> Iterator[Panel]:
        """In the order of the page."""
        found = judged.data
        yield Panel("", paper_contacts, found.contacts)
        yield Panel("", paper_sketch, None)
        yield Panel("", paper_studies, found.collapse)
        yield Panel("", paper_law, found.laws)
        for lossy in found.losses:
            yield Panel("", shifted_curves, [lossy.whole, lossy.rough], lossy.loss.suffix)
        yield Panel("", paper_losses, found.losses)

    def lines(self, judged: Reproduced) -> Iterator[str]:
        """Every claim."""
        yield from (f"  {claim.verdict:9s}  {claim.name}: {claim.written}" for claim in judged.claims)
        if judged.data.failed:
            yield f"  {judged.data.failed} solves failed and are left out"

    def tables(self, judged: Reproduced) -> Iterator[str]:
        """The same."""
        rows = [(claim.name, claim.verdict, claim.written) for claim in judged.claims]
        yield markup.table(rows, ("claim", "verdict", "found"), "The paper in one dimension")
        if judged.data.failed:
            yield markup.paragraph(f"{judged.data.failed} solves failed and are left out.")
