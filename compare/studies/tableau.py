"""Findings of a study side by side: which claims there are, and where each was asked."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from .. import verdict
from ..finding import Finding
from .judgement import JudgedStudy
from .question import BOTH

DIMENSIONS = tuple(verdict.DIMENSIONS.values())
VERDICTS = ("holds", "fails", "undecided")
ALL_SERIES = "all series"


@dataclass(frozen=True)
class Column:
    """One series, or all together: its name, empty of all, its title, and what was found there."""

    name: str
    title: str
    findings: tuple[Finding, ...]

    def find(self, claim: str, dimension: str) -> Finding | None:
        """The finding of a claim, if it was asked here."""
        asked = (each for each in self.findings if (each.claim, each.dimension) == (claim, dimension))
        return next(asked, None)


def columns(judged: JudgedStudy) -> list[Column]:
    """Of every series, then of all together where claims were asked of them."""
    found = [Column(each.solved.series.name, each.solved.series.title, each.findings) for each in judged.series]
    return found + ([Column("", ALL_SERIES, judged.findings)] if judged.findings else [])


def claims(findings: Sequence[Finding]) -> tuple[list[str], list[str]]:
    """Claims asked of one dimensionality, and claims on both, each once, in their order."""
    alone = dict.fromkeys(each.claim for each in findings if each.dimension != BOTH)
    return list(alone), list(dict.fromkeys(each.claim for each in findings if each.dimension == BOTH))


def every(judged: JudgedStudy) -> list[Finding]:
    """Of all series and of the study."""
    return [finding for column in columns(judged) for finding in column.findings]


def rows(judged: JudgedStudy) -> Iterator[dict]:
    """Every finding, flat, with its series, for a table."""
    for column in columns(judged):
        for finding in column.findings:
            yield {"series": column.name or ALL_SERIES} | finding.row
