"""The table of laws, and the task that asks one of them of a model."""

import time
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

from scene import Refused, Scene, SolveError
from scene.protocol import why_not

from ...models.table import SURFACES, Model
from ...solving.outcome import Outcome, Row
from ...solving.task import REFUSED, SceneTask
from . import closed_forms, hard_bodies, hard_histories, hard_motion, invariances, stored
from .law import Answer, Law, Laws, Missing

WORK = 1e6  # of a contact
MODULES = closed_forms, invariances, hard_motion, hard_bodies, hard_histories


@cache
def table() -> Mapping[str, Law]:
    """Every law by its id."""
    families = [each for module in MODULES for each in vars(module).values() if isinstance(each, Laws)]
    every = [*(law for each in families for law in each.make()), *stored.laws()]
    found = {law.id: law for law in every}
    assert len(found) == len(every), "two laws have one id"
    return found


@dataclass(frozen=True)
class Examination:
    """A task, see `solving.task.Task`: a model that answers the scenes of a law of the table.

    Its outcome has one row: `misfit` and `bound` in its measures, or the reason why there is none, which begins
    with REFUSED where the law does not ask this of the model.
    """

    law_id: str
    solver: Any
    keeps_fields = False

    @property
    def law(self) -> Law:
        """The law."""
        return table()[self.law_id]

    @property
    def scenes(self) -> tuple[Scene, ...]:
        """Scenes of the law."""
        return self.law.scenes

    @property
    def _asked(self) -> SceneTask:
        return SceneTask(self.solver, self.scenes)

    @property
    def label(self) -> str:
        """Model and name of the law."""
        return f"{self.solver.name}: {self.law_id}"

    @property
    def work(self) -> float:
        """Rough cost."""
        return WORK * len(self.scenes)

    @property
    def portable(self) -> bool:
        """Whether another process can import the class of the model."""
        return self._asked.portable

    @property
    def question(self) -> Mapping[str, Any]:
        """The law, and its scenes and the model."""
        return {"law": self.law_id} | self._asked.question

    @property
    def packages(self) -> tuple[str, ...]:
        """Packages of the scenes, of laws, of both solvers, and those that the model names."""
        ours = "mdr1d", "bem3d", "compare.studies.checks", "compare.models.exact"
        return tuple(dict.fromkeys((*self._asked.packages, *ours)))

    def solve(self) -> Outcome:
        """Solve every scene, and hold the answers against the law."""
        start, measures, reason = time.process_time(), {}, None
        try:
            measures = self._measures()
        except (Refused, NotImplementedError, Missing) as error:
            reason = REFUSED + (" ".join(str(error).split()) or type(error).__name__)
        except SolveError as error:
            reason = str(error) or type(error).__name__
        return Outcome((Row(seconds=time.process_time() - start, measures=measures, reason=reason),))

    def _measures(self):
        law, model = self.law, Model.of(self.solver)
        if model.draws != SURFACES and any(scene.indenter.type == "plane" for scene in law.scenes):
            raise Missing("the model draws no surfaces")
        asked = list(zip(law.models(self.solver), law.scenes, strict=False))
        for reason in (why for each in asked for why in why_not(*each)):
            raise Refused(reason)
        answers = [Answer(each.solve(scene), model.dimension) for each, scene in asked]
        return {"misfit": float(law.misfit(answers)), "bound": float(law.bound.of(answers))}

    def failed(self, reason: str) -> Outcome:
        """Outcome of a law that could not be asked."""
        return Outcome((Row(reason=reason),))

    def fits(self, outcome: Outcome) -> bool:
        """Whether there is one row."""
        return len(outcome.rows) == 1
