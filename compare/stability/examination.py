"""One case examined, as a task: what was found is kept, and is not computed again."""

import time
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from math import nan

import numpy as np

from ..outcome import Outcome, Row
from .collection import CASES
from .hardcase import SIZES, Check, HardCase, Refusal


@dataclass(frozen=True)
class Examination:
    """A task, as of store: one case of the collection at one size, by their names.

    Its outcome has a row a check: found and allowed in its measures, what was checked and the message of a refusal
    in its settings, and the seconds of the whole case. A case that raises has one row with the reason.
    """

    case: str
    size: str
    keeps_fields = False
    packages = ("scene", "mdr1d", "bem3d", "compare.stability", "compare.exact")

    @property
    def label(self) -> str:
        """Short description for people."""
        return f"{self.asked.group}: {self.case}"

    @property
    def asked(self) -> HardCase:
        """The case."""
        return CASES[self.case]

    @property
    def work(self) -> float:
        """As of store; marches take longest."""
        return 10.0 if self.asked.group == "histories" else 1.0

    @property
    def question(self) -> Mapping:
        """The case, its law, and the size."""
        return {"hard case": self.case, "law": self.asked.law, "size": asdict(SIZES[self.size])}

    def solve(self) -> Outcome:
        """Every check; whatever a case raises has broken it."""
        start = time.process_time()
        try:
            checks = tuple(self.asked.examine(SIZES[self.size]))
        except Exception as error:
            reason = f"{type(error).__name__}: {error}"
            return Outcome((Row(seconds=time.process_time() - start, reason=reason),))
        seconds = time.process_time() - start
        return Outcome(tuple(_row(check, seconds) for check in checks))

    def failed(self, reason: str) -> Outcome:
        """As of a case that raises."""
        return Outcome((Row(reason=reason),))

    def fits(self, outcome: Outcome) -> bool:
        """At least one check, or the reason why there is none."""
        return len(outcome.rows) > 0


def checks(outcome: Outcome) -> list[Check | Refusal]:
    """What was checked, out of an outcome; none if the case raised."""
    return [_check(row) for row in outcome.rows if row.reason is None]


def _row(check, seconds):
    with np.errstate(all="ignore"):
        numbers = {"found": float(check.found), "allowed": float(check.allowed)}
    return Row(seconds=seconds, measures=numbers, settings={"what": check.what, "message": check.message})


def _check(row):
    what, message, found = row.settings["what"], row.settings["message"], row.measures.get("found", nan)
    return Check(what, found, row.measures["allowed"]) if message is None else Refusal(what, message, found)
