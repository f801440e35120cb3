"""The named hard cases, each held against its law: `crosscheck stability`."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Self

import xarray
from pandas import DataFrame

from ...report.page import Block, Section, Table, Text
from ...solving.outcome import Outcome
from ...solving.suggest import known
from ...solving.task import Batch, Task
from ...solving.vocabulary import attributes
from ...statistics.finding import FAILS, HOLDS, Claim, Finding
from ..study import Judgement, Study
from .cases.collection import CASES
from .cases.examination import Examination
from .cases.hardcase import SIZES, Check

SOLVED, REFUSED, BROKEN = "solved", "refused as it should", "broken"
CHECKS = ("case", "group", "check", "found", "allowed", "message", "reason", "seconds")
# Where a file lay when a case was examined: all before its name, of a path from the root.
FOLDERS = re.compile(r"(?<![\w.])/(?:[^\s/]+/)+")
LONGEST = 120  # characters of a message in a table
ABOUT = """Each case is a contact in which a solver may fail, with what must hold: a closed form, a limit,
exact scaling, a balance, or the conditions of contact computed anew by plain sums, in both dimensionalities
wherever both can be asked. Tolerances are part of the law and say where they come from; N is the number of points
of the grid. A question without an answer must be refused by an error that names the mistake.

A row shows the check that came nearest to its bound, or the message of a refusal; found and allowed are
relative numbers unless the law says otherwise. Refused, and not answered: lines far beyond v τ/a = 10⁴, depths
whose squares are no numbers, memories beyond 1e150 pixels, contacts of less than nine pixels in 3D or five in
1D."""


@dataclass(frozen=True)
class Stability(Study):
    """Every hard case at a size: "quick", "standard" or "full"."""

    size: str = "quick"

    command = "stability"
    title = "Hard cases"
    about = "Contacts in which a solver may fail, each with the law that its answer must keep."

    @classmethod
    def of(cls, size: str) -> Self:
        """Hard cases at a size. Raises InvalidInput where there is no such size."""
        known("size", size, SIZES)
        return cls(size)

    @property
    def inputs(self) -> Mapping[str, Any]:
        return {"size": self.size}

    def batches(self) -> Sequence[Batch]:
        return (Batch([Examination(name, self.size) for name in CASES]),)

    def answers(self, outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
        """Every check of every case, in the order of the collection."""
        of = {task.case: outcome for task, outcome in outcomes.items() if isinstance(task, Examination)}
        rows = [each for name in CASES if name in of for each in _checks(name, of[name])]
        columns = {
            name: ("row", list(column)) for name, column in zip(CHECKS, zip(*rows, strict=True), strict=True)
        }
        dataset = xarray.Dataset(columns, attrs={"size": self.size})
        for name in CHECKS:
            dataset[name].attrs = attributes(name)
        return xarray.DataTree.from_dict({"/checks": dataset})

    def judge(self, answers: xarray.DataTree) -> Judgement:
        """A finding a case: the check that came nearest to its bound, or a broken one; a table for each group."""
        judged = list(self._judged(answers))
        groups = list(dict.fromkeys(finding.where for finding, _ in judged))
        frames = {group: DataFrame([row for found, row in judged if found.where == group]) for group in groups}
        counts = [
            {"group": group, "cases": len(frame), "checks": int(frame["checks"].sum())}
            | {outcome: int((frame["outcome"] == outcome).sum()) for outcome in (SOLVED, REFUSED, BROKEN)}
            for group, frame in frames.items()
        ]
        sections = [Section(group.capitalize(), [Table(group, frame)]) for group, frame in frames.items()]
        shown: list[Block] = [Table("groups", DataFrame(counts), f"Hard cases, size {self.size}."), *sections]
        findings = [finding for finding, _ in judged]
        return Judgement(findings, _answer(findings), shown, [Text(ABOUT)])

    def _judged(self, answers) -> Iterator[tuple[Finding, Mapping]]:
        """Finding of each case, and its row of the table."""
        every = answers["checks"].to_dataset().to_dataframe()
        for name, rows in every.groupby("case", sort=False):
            case, first = CASES[str(name)], rows.iloc[0]
            known = (row for row in rows.itertuples() if not row.reason)
            checks = [Check(row.check, row.found, row.allowed, row.message or None) for row in known]
            none = Check("the case itself", first.found, 0.0)
            nearest = max(checks, key=lambda each: each.nearness, default=none)
            told = nearest.message or first.reason
            broken = not checks or not all(check.holds for check in checks)
            refused = all(check.message for check in checks)
            claim = Claim(
                id=f"stability.{name}",
                sentence=case.law.removesuffix("."),
                expected=0.0,
                tolerance=nearest.allowed,
                meaning=f"{case.about} Shown is the check nearest to its bound: {nearest.what}.",
            )
            stated = FAILS if broken else HOLDS
            yield (
                Finding(claim, nearest.found, where=case.group, stated=stated, reason=told),
                {
                    "case": name,
                    "outcome": BROKEN if broken else REFUSED if refused else SOLVED,
                    "found": nearest.found,
                    "allowed": nearest.allowed,
                    "hard because": case.about,
                    "must hold": case.law,
                    "check": nearest.what,
                    "message": told if len(told) <= LONGEST else f"{told[: LONGEST - 1]}…",
                    "checks": len(rows),
                    "seconds": first.seconds,
                },
            )


def _answer(findings: Sequence[Finding]) -> Sequence[str]:
    """Number of cases that keep their law, and a sentence for each that does not."""
    broken = [each for each in findings if each.stated == FAILS]
    kept = f"{len(findings) - len(broken)} of" if broken else "All"
    told = f"{kept} {len(findings)} hard cases keep their law, solved or refused as they should."
    return [told] + [
        f"{each.claim.id.partition('.')[2]} is broken: found {each.value:.2g}, allowed "
        f"{each.claim.tolerance:.2g}. {each.claim.sentence}. {each.reason}".strip()
        for each in broken
    ]


def _checks(name: str, outcome: Outcome) -> Iterator[tuple]:
    """Values of CHECKS of one case."""
    for row in outcome.rows:
        found, allowed = (row.measures.get(number, float("nan")) for number in ("found", "allowed"))
        message, reason = (FOLDERS.sub("", text or "") for text in (row.settings.get("message"), row.reason))
        yield name, CASES[name].group, row.settings.get("what", ""), found, allowed, message, reason, row.seconds
