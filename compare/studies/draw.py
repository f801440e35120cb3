"""A contact as a picture: `crosscheck draw`."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import xarray
from pandas import concat

from bem3d import BEM
from mdr1d import MDR
from scene import Program, Refused, SolveError, notes
from scene.protocol import foresee

from ..figures import contact, history
from ..figures.contact import ROW, SURFACE, view
from ..figures.plot import Plot
from ..library.case import Case, doubted
from ..library.lookup import SceneLike, case_of
from ..report.page import Text
from ..solving.cost import work_of
from ..solving.task import Batch, Outcome, SceneTask, Task
from ..solving.vocabulary import attributes
from ..statistics import griderror
from .study import Judgement, Study

PROGRAM = "program"
NUMBERS = ("normal_force", "depth", "friction_force")


@dataclass(frozen=True)
class Drawing(Study):
    """One contact in three dimensions, with the row of springs where one dimension can solve it.

    case : scene, and settings of the solvers
    tasks : of BEM, and of MDR unless it refuses
    refused : why there is no row of springs; empty where there is one
    """

    case: Case
    tasks: tuple[SceneTask, ...]
    refused: str = ""
    command, title = "draw", "One contact"

    @classmethod
    def of(cls, scene: SceneLike) -> "Drawing":
        """Drawing of a scene. Raises InvalidInput, and Refused of what no picture shows."""
        case = case_of(scene)
        if case.heating is not None and case.heating.feedback is not None:
            raise Refused(
                "heating.feedback: the surface is drawn at a temperature that is given, leave feedback out"
            )
        tasks, refused = [_task(case.bem, case)], ""
        try:
            tasks.append(_task(case.mdr, case))
        except Refused as error:
            refused = str(error)
        return cls(case, tuple(tasks), refused)

    @property
    def inputs(self) -> Mapping[str, Any]:
        return {"case": self.case.inputs}

    @property
    def notes(self) -> tuple[str, ...]:
        return notes(self.case.scene)

    @property
    def doubts(self) -> tuple[str, ...]:
        return doubted(self.case)

    def batches(self) -> Sequence[Batch]:
        return (Batch(self.tasks),)

    def answers(self, outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
        """The surface around the contact, wake included, the row of springs, and of a program the forces in time.

        A program that ends out of contact has these forces alone. Raises SolveError where a solve failed, and
        where nothing touches in three dimensions.
        """
        found = {task.solver.name: outcomes[task] for task in self.tasks}
        for name, outcome in found.items():
            if outcome.rows[0].reason:
                raise SolveError(f"{name}: {outcome.rows[0].reason}")
        fields = {name: each.fields for name, each in found.items() if each.fields}
        program = isinstance(self.case.motion, Program)
        parts = view(self.case.scene, self.case.bem, fields)
        if SURFACE not in parts or not (parts[SURFACE]["pressure"] > 0).any():
            if not program or "BEM" not in fields:
                raise SolveError("nothing touches in 3D, so there is nothing to draw: press deeper")
            parts = {}
        for dataset, outcome in zip(parts.values(), found.values(), strict=False):
            numbers = {name: getattr(outcome.rows[0], name) for name in NUMBERS}
            error = outcome.rows[0].measures.get(griderror.MEASURE)
            numbers |= {} if error is None else {griderror.MEASURE: error}
            for name, value in numbers.items():
                dataset[name] = (), value, attributes(name, self.case.scene)
        if program:
            for name, kept in fields.items():
                histories = {each: ("time", kept[each], attributes(each)) for each in (*NUMBERS, "time")}
                parts[f"{PROGRAM}/{name}"] = xarray.Dataset(histories).set_coords("time")
        return xarray.DataTree.from_dict({f"/{name}": each for name, each in parts.items()})

    def judge(self, answers: xarray.DataTree) -> Judgement:
        refusals = [Text(f"No row of springs: {self.refused}.")] if self.refused else []
        seen = {name: answers[name].to_dataset() for name in (SURFACE, ROW) if name in answers}
        shown: list[Plot | Text] = [contact.plot(self.case.scene, seen)] if seen else []
        if PROGRAM in answers:
            marched = {name: each.to_dataset().to_dataframe() for name, each in answers[PROGRAM].children.items()}
            points = concat(marched, names=["model"]).reset_index().rename(columns={"depth": "depth_reached"})
            shown.append(history.plot(points, "time", self.case.scene))
        return Judgement((), (), [*shown, *refusals], self.setting)


def _task(solver: BEM | MDR, case: Case) -> SceneTask:
    foresee(solver, case.scene)
    return SceneTask(solver, (case.scene,), keeps_fields=True, work=work_of(solver, case.scene))
