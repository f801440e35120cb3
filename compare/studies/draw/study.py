"""A contact as a picture: `crosscheck draw`."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import xarray

from bem3d import BEM
from mdr1d import MDR
from scene import Program, Refused, SolveError, notes
from scene.protocol import foresee

from ...library.case import Case, doubted
from ...library.lookup import SceneLike, case_of
from ...report.page import Text
from ...report.views import View, view
from ...solving import words
from ...solving.outcome import Outcome
from ...comparison.curve import work_of
from ...solving.task import Batch, SceneTask, Task
from ...solving.vocabulary import attributes
from ...statistics import griderror
from ...statistics.finding import Claim, Finding
from ..study import Judgement, Study
from . import figure as plots
from . import program

SURFACE, ROW, PROGRAM = "surface", "row", "program"
NUMBERS = ("normal_force", "depth", "friction_force")
APART = Claim(
    "draw.apart",
    "The part of the normal force that 1D puts at another x than 3D",
    meaning="Half of the sum of differences of force between strips along x, each model over its own force.",
)


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
        seen, parts = view(self.case.scene, self.case.bem, fields), {}
        if seen is not None and seen.space is not None and seen.space.touching.any():
            surface, row = datasets(seen, fields.get("MDR", {}))
            parts = {f"/{SURFACE}": surface} | ({} if row is None else {f"/{ROW}": row})
        elif not (isinstance(self.case.motion, Program) and "BEM" in fields):
            raise SolveError("nothing touches in 3D, so there is nothing to draw: press deeper")
        for dataset, outcome in zip(parts.values(), found.values(), strict=False):
            for name in NUMBERS:
                value = getattr(outcome.rows[0], name)
                dataset[name] = (), value, attributes(name, self.case.scene)
            if griderror.MEASURE in outcome.rows[0].measures:
                error = outcome.rows[0].measures[griderror.MEASURE]
                dataset[griderror.MEASURE] = (), error, attributes(griderror.MEASURE, self.case.scene)
        if isinstance(self.case.motion, Program):
            for name, kept in fields.items():
                parts[f"/{PROGRAM}/{name}"] = program.dataset(self.case.scene, self.case.bem, name, kept)
        return xarray.DataTree.from_dict(parts)

    def _findings(self, answers):
        """What 1D gives over what 3D gives, and how far apart the forces of both stand; nothing is claimed."""
        surface, row = _parts(answers)
        if row is None:
            return []
        ratios = {}
        if surface["normal_force"] > 0 and row["normal_force"] > 0:
            pressed = "normal_force" if self.case.motion.pressed_by == "depth" else "depth"
            ratios = {pressed: float(row[pressed] / surface[pressed])}
            if self.case.slides:
                one, three = (float(each["friction_force"] / each["normal_force"]) for each in (row, surface))
                ratios["friction coefficient"] = one / three
        claims = [
            Claim(f"draw.{name.split('_')[-1].split()[0]}", f"The {name.replace('_', ' ')} in 1D over that in 3D")
            for name in ratios
        ]
        values = [*ratios.values()]
        if row.get("line_force", np.zeros(1)).any():
            lines = plots.line_forces(surface, row).drop(columns="x")
            claims.append(APART)
            values.append(float((lines / lines.sum()).diff(axis=1).iloc[:, 1].abs().sum() / 2))
        return [Finding(claim, value, plot=plots.NAME) for claim, value in zip(claims, values, strict=True)]

    def judge(self, answers: xarray.DataTree) -> Judgement:
        findings = self._findings(answers)
        said = [Text(f"No row of springs: {self.refused}.")] if self.refused else []
        answer = [f"{each.claim.sentence}: {words.found(each)}." for each in findings]
        surface, row = _parts(answers)
        shown = [] if surface is None else [plots.plot(self.case.scene, surface, row)]
        if PROGRAM in answers:
            marched = {name: each.to_dataset() for name, each in answers[PROGRAM].children.items()}
            shown.append(program.plot(self.case.scene, marched))
        return Judgement(findings, answer, [*shown, *said], self.setting)


def _task(solver: BEM | MDR, case: Case) -> SceneTask:
    if isinstance(case.motion, Program):
        solver = replace(solver, frames=program.INSTANTS)
    foresee(solver, case.scene)
    return SceneTask(solver, (case.scene,), keeps_fields=True, work=work_of(solver, case.scene))


def _parts(answers):
    """Datasets of the surface, and of the row of springs or None."""
    return tuple(answers[name].to_dataset() if name in answers else None for name in (SURFACE, ROW))


def datasets(seen: View, line: Mapping[str, np.ndarray]) -> tuple[xarray.Dataset, xarray.Dataset | None]:
    """The part of a contact worth seeing: the surface around it, and the row of springs where there is one.

    line : fields of the answer of MDR
    """
    return _surface(seen), None if seen.line is None else _row(seen, line)


def _surface(seen: View) -> xarray.Dataset:
    """The part of the surface worth seeing (y, x), x where indenter and surface are seen."""
    around = seen.space.around
    fields = {"displacement": around.displacement, "gap": seen.space.gap, "pressure": seen.space.pressure}
    whole = xarray.Dataset(
        {name: (("y", "x"), values, attributes(name)) for name, values in fields.items()},
        {"x": ("x", around.x + around.lag, attributes("x")), "y": ("y", around.y, attributes("y"))},
    )
    aside = whole if whole.sizes["y"] == 1 else whole.sel(y=slice(-seen.aside, seen.aside))
    return aside.sel(x=slice(*seen.span))


def _row(seen: View, fields: Mapping[str, np.ndarray]) -> xarray.Dataset:
    """The row of springs (x): what is known of it beyond its own grid carries no force."""
    line = seen.line
    columns = {"indenter": line.indenter, "surface": line.surface, "touching": line.touching}
    if "line_force" in fields:
        first = int(np.searchsorted(line.x, fields["x"][0]))
        after = len(line.x) - first - len(fields["x"])
        columns["line_force"] = np.pad(fields["line_force"], (first, after))
    whole = xarray.Dataset(
        {name: ("x", values, attributes(name)) for name, values in columns.items()},
        {"x": ("x", line.x, attributes("x"))},
    )
    return whole.sel(x=slice(*seen.span))
