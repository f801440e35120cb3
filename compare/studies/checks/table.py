"""The table of laws, and the task that asks one of them of a model."""

import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any

from scene import Program, Refused, SolveError
from scene.protocol import why_not

from ...models.table import SURFACES, Model
from ...solving.outcome import Outcome, Row
from ...solving.task import REFUSED, SceneTask
from . import closed_forms, friction, hard_bodies, hard_histories, hard_motion, invariances, stored
from .hardcase import HardCase
from .law import Answer, Law, Missing

WORK = 1e6  # of a contact; STEPS times, of a history
STEPS = 20


@cache
def table() -> Mapping[str, Law]:
    """Every law by its id."""
    every = list(_every_law())
    found = {law.id: law for law in every}
    assert len(found) == len(every), "two laws have one id"
    return found


def _every_law() -> Iterator[Law]:
    for module in (closed_forms, friction, invariances):
        yield from module.laws()
    for hard in (hard_motion, hard_bodies, hard_histories):
        for case in vars(hard).values():
            if isinstance(case, HardCase):
                yield from case.laws()
    yield from stored.laws()


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
    def scenes(self) -> tuple:
        """Scenes of the law."""
        return self.law.scenes

    @cached_property
    def _asked(self) -> SceneTask:
        return SceneTask(self.solver, self.scenes)

    @property
    def label(self) -> str:
        """Model, group and name of the law."""
        return f"{self.solver.name}, {self.law.group}: {self.law_id}"

    @property
    def work(self) -> float:
        """Rough cost; histories take longest."""
        return sum(WORK * (STEPS if isinstance(scene.motion, Program) else 1) for scene in self.scenes)

    @property
    def portable(self) -> bool:
        """Whether another process can import the class of the model."""
        return self._asked.portable

    @property
    def question(self) -> Mapping[str, Any]:
        """The law, and its scenes and the model."""
        return {"law": self.law_id, "sentence": self.law.sentence} | self._asked.question

    @property
    def packages(self) -> tuple[str, ...]:
        """Packages of the scenes, of laws, of both solvers, and those that the model names."""
        ours = "mdr1d", "bem3d", "compare.studies.checks", "compare.models.exact"
        return tuple(dict.fromkeys((*self._asked.packages, *ours)))

    def solve(self) -> Outcome:
        """Solve every scene, and hold the answers against the law."""
        start, law, measures, reason = time.process_time(), self.law, {}, None
        model = Model.of(self.solver)
        try:
            if law.drawn and model.draws != SURFACES:
                raise Missing("the model draws no surfaces")
            models = law.models(self.solver) if law.models else (self.solver,) * len(law.scenes)
            asked = list(zip(models, law.scenes, strict=True))
            if reasons := [why for each in asked for why in why_not(*each)]:
                raise Refused(reasons[0])
            answers = [Answer(each.solve(scene), model.dimension) for each, scene in asked]
            measures = {"misfit": float(law.misfit(answers)), "bound": float(law.bound.of(answers))}
        except (Refused, NotImplementedError, Missing) as error:
            reason = f"{REFUSED}{' '.join(str(error.args[0] if error.args else type(error).__name__).split())}"
        except SolveError as error:
            reason = str(error) or type(error).__name__
        return Outcome((Row(seconds=time.process_time() - start, measures=measures, reason=reason),))

    def failed(self, reason: str) -> Outcome:
        """Outcome of a law that could not be asked."""
        return Outcome((Row(reason=reason),))

    def fits(self, outcome: Outcome) -> bool:
        """Whether there is one row."""
        return len(outcome.rows) == 1
