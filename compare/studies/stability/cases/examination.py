"""One hard case examined, as a task: what was found is kept, and is not computed again."""

import time
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from ....solving.outcome import Outcome, Row
from .collection import CASES
from .hardcase import SIZES, HardCase


@dataclass(frozen=True)
class Examination:
    """A task, see `task.Task`: one case of the collection at one size, by their names.

    Its outcome has a row a check: found and allowed in its measures, what was checked and the message of a refusal
    in its settings, and the seconds of the whole case. A case that raises has one row with the reason.
    """

    case: str
    size: str
    keeps_fields = False
    packages = ("scene", "mdr1d", "bem3d", "compare.studies.stability.cases", "compare.models.exact")

    @property
    def label(self) -> str:
        """Group and name of the case."""
        return f"{self.hard_case.group}: {self.case}"

    @property
    def hard_case(self) -> HardCase:
        """The case."""
        return CASES[self.case]

    @property
    def work(self) -> float:
        """Rough cost; marches take longest."""
        return 2e7 if self.hard_case.group == "histories" else 2e6

    @property
    def question(self) -> Mapping[str, Any]:
        """The case, its law, and the size."""
        return {"hard case": self.case, "law": self.hard_case.law, "size": asdict(SIZES[self.size])}

    def solve(self) -> Outcome:
        """Outcome of every check of the case; whatever a case raises has broken it."""
        start = time.process_time()
        try:
            found = tuple(self.hard_case.examine(SIZES[self.size]))
        except Exception as error:
            reason = f"{type(error).__name__}: {error}"
            return Outcome((Row(seconds=time.process_time() - start, reason=reason),))
        seconds = time.process_time() - start
        return Outcome(tuple(_row(check, seconds) for check in found))

    def failed(self, reason: str) -> Outcome:
        """Outcome of a case that raises."""
        return Outcome((Row(reason=reason),))

    def fits(self, outcome: Outcome) -> bool:
        """Whether there is a check, or the reason why there is none."""
        return len(outcome.rows) > 0


def _row(check, seconds):
    with np.errstate(all="ignore"):
        numbers = {"found": float(check.found), "allowed": float(check.allowed)}
    return Row(seconds=seconds, measures=numbers, settings={"what": check.what, "message": check.message})
