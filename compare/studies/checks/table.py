"""The table of laws, and the task that asks one of them of a model."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from time import process_time
from typing import Any

from scene import Refused, Scene, SolveError
from scene.protocol import why_not

from ...models.table import SURFACES, Model
from ...solving.outcome import Outcome, Row, reason_of
from ...solving.task import REFUSED, SceneTask, Task
from . import closed_forms, hard_bodies, hard_motion, invariances, stored
from .law import Answer, Law, Laws, Missing

WORK = 1e6  # of a contact
MODULES = closed_forms, invariances, hard_motion, hard_bodies


@cache
def table() -> Mapping[str, Law]:
    """Every law by its id."""
    families = [each for module in MODULES for each in vars(module).values() if isinstance(each, Laws)]
    every = [*(law for each in families for law in each.make()), *stored.laws()]
    found = {law.id: law for law in every}
    assert len(found) == len(every), "two laws have one id"
    return found


@dataclass(frozen=True)
class Examination(Task):
    """A task, see `solving.task.Task`: a model that answers the scenes of a law of the table.

    Its outcome has one row: `misfit` and `bound` in its measures, or the reason why there is none, which begins
    with REFUSED where the law does not ask this of the model.
    """

    law_id: str
    solver: Any

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
        start = process_time()
        try:
            found = Row(measures=self._measures())
        except (Refused, NotImplementedError, Missing) as error:
            found = Row(reason=REFUSED + reason_of(error))
        except SolveError as error:
            found = Row(reason=reason_of(error))
        return Outcome((replace(found, seconds=process_time() - start),))

    def _measures(self):
        law, model = self.law, Model.of(self.solver)
        if model.draws != SURFACES and any(scene.indenter.type == "plane" for scene in law.scenes):
            raise Missing("the model draws no surfaces")
        asked = list(zip(law.models(self.solver), law.scenes, strict=False))
        for each in asked:
            if reasons := why_not(*each):
                raise Refused(reasons[0])
        answers = [Answer(each.solve(scene), model.dimension) for each, scene in asked]
        return {"misfit": float(law.misfit(answers)), "bound": float(law.bound.of(answers))}
