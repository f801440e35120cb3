"""The estimates that one sliding answer gives of its friction, and of the error of it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from math import nan

from ...outcome import Outcome
from ...store import Task
from ..contest import FRICTION, Known, Quantity, Truth

LABEL = FRICTION.label


def _over_load(row, _, name):
    return row.measures.get(name, nan) / row.normal_force if row.normal_force else nan


def _indicated(row, _):
    return row.measures.get("friction_disagreement", nan) / row.friction_coefficient


# What the answer joins of traction, loss and curvature; work stands beside. They are those of BEM; of them MDR has
# traction alone.
JOINED = Quantity("friction", LABEL, FRICTION.of, "joined")
TRACTION, LOSS, CURVATURE, WORK = (
    Quantity(f"friction_by_{by}", LABEL, partial(_over_load, name=f"friction_by_{by}"), f"by {by}")
    for by in ("traction", "loss", "curvature", "work")
)
# What a solver says itself of the error of its friction, relative: no error, but drawn as one.
INDICATOR = Quantity("friction_disagreement", LABEL, _indicated, "indicator")
OTHERS = TRACTION, LOSS, CURVATURE, WORK
ALL = (JOINED, *OTHERS, INDICATOR)


@dataclass(frozen=True)
class OfFriction:
    """What is known of friction, said of all of its estimates; the indicator counts from zero."""

    truth: Truth

    @property
    def source(self) -> str:
        """As of Truth."""
        return self.truth.source

    @property
    def tasks(self) -> Sequence[Task]:
        """As of Truth."""
        return self.truth.tasks

    def known(self, quantities: Sequence[Quantity], outcomes: Mapping[Task, Outcome]) -> Mapping[str, Known]:
        """As of Truth."""
        asked = [each for each in quantities if each not in (*OTHERS, INDICATOR)]
        found = dict(self.truth.known(asked, outcomes))
        if JOINED.name in found:
            found |= {each.name: found[JOINED.name] for each in OTHERS}
        return found | {INDICATOR.name: Known(0.0, scale=1.0)}
