"""The table of laws, and what asks them of models: `crosscheck verify`, `stability`, `regress`."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from math import nan
from operator import attrgetter
from pathlib import Path
from textwrap import shorten
from time import process_time
from typing import Any, Self

import xarray
from pandas import DataFrame

from scene import Refused, SolveError
from scene.printable import printable
from scene.protocol import why_not

from ...models.table import SURFACES, Model, model_of
from ...report.page import Findings, Text
from ...solving.suggest import known
from ...solving.task import REFUSED, Batch, Outcome, Row, SceneTask, Task, reason_of
from ...statistics.finding import FAILS, HOLDS, REPORTED, Claim, Finding
from ..study import Judgement, Study
from . import closed_forms, hard_bodies, hard_motion, invariances, stored
from .hardcase import SIZES
from .law import STORED, Answer, Law, Laws, Missing
from .stored import Stored

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
class Examination(SceneTask):
    """A task, see `solving.task.Task`: a model that answers the scenes of a law of the table.

    Its outcome has one row: `misfit` and `bound` in its measures, or the reason why there is none, which begins
    with REFUSED where the law does not ask this of the model.
    """

    law_id: str = ""

    @classmethod
    def of(cls, law: Law, solver: Any) -> Self:
        """Task of a law and a model."""
        return cls(solver, law.scenes, work=WORK * len(law.scenes), law_id=law.id)

    @property
    def law(self) -> Law:
        """The law."""
        return table()[self.law_id]

    @property
    def label(self) -> str:
        """Model and name of the law."""
        return f"{self.solver.name}: {self.law_id}"

    @property
    def count(self) -> int:
        """One row."""
        return 1

    @property
    def question(self) -> dict:
        """The law, and its scenes and the model."""
        return {"law": self.law_id} | super().question

    @property
    def packages(self) -> tuple[str, ...]:
        """Packages of the scenes, of laws, of both solvers, and those that the model names."""
        ours = "mdr1d", "bem3d", "compare.studies.checks", "compare.models.exact"
        return tuple(dict.fromkeys((*super().packages, *ours)))

    def solve(self, *_: Any) -> Outcome:
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


LEFT_OUT = "left out"
SHOWN = 40  # laws on the page
ABOUT = """Each law asks one or several scenes of a model and makes one number of the answers, a relative
misfit, that must not exceed its bound. Bounds say where they come from: the grid, whose points across the contact
the model measures (`points_across_contact`) or has as a setting, and what a result says is left in its conditions
(`residual`). No grid excuses more than 5 %. A law that any model may be asked, and that it refuses or for which it
gives no number, is left out with the reason; a solve that ends without an answer fails it.

A hard case is a contact in which a solver may fail, in both dimensionalities wherever both can be asked; N is the
number of points of its grid. Of its numbers the one nearest to its own bound counts, as a share of it. A stored
number is a ratio of 1D over 3D or over a closed form, which must not move."""


@dataclass(frozen=True)
class Checks(Study):
    """Laws, each asked of a model. Raises InvalidInput where there is no such model or size."""

    tasks: tuple[Examination, ...]
    command: str = "verify"  # type: ignore[misc]
    title: str = "Laws"
    given: Mapping[str, Any] = field(default_factory=dict)

    @classmethod
    def verify(cls, model: Any) -> Self:
        """Scorecard of a model, by name or as an object: laws of its dimension."""
        found = model_of(model)
        tasks = tuple(
            Examination.of(law, found.solver)
            for law in table().values()
            if found.dimension in law.kinds and law.group != STORED and not law.solvers
        )
        title = f"Scorecard of {found.name} as a model in {found.dimension}"
        return cls(tasks, "verify", title, {"model": f"{found.solver}"})

    @classmethod
    def stability(cls, size: str) -> Self:
        """Hard cases by both solvers, at a size: "quick", "standard" or "full"."""
        known("size", size, SIZES)
        laws = table().values()
        tasks = tuple(Examination.of(law, build(SIZES[size])) for law in laws for build in law.solvers)
        return cls(tasks, "stability", "Hard cases", {"size": size})

    @property
    def inputs(self) -> Mapping[str, Any]:
        return self.given

    def batches(self) -> Sequence[Batch]:
        return (Batch(self.tasks),)

    def answers(self, outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
        """A row for each law and model."""
        rows = []
        for task in self.tasks:
            (row,), solver = outcomes[task].rows, task.solver
            model = f"{solver.name}, {getattr(solver, 'points', 'no')} points"
            numbers = {name: row.measures.get(name, nan) for name in ("misfit", "bound")}
            asked = {"law": task.law_id, "model": model, "reason": row.reason or "", "seconds": row.seconds}
            rows.append(asked | numbers)
        return xarray.DataTree.from_dict({"/laws": DataFrame(rows).to_xarray()})

    def judge(self, answers: xarray.DataTree) -> Judgement:
        """A finding a law; on the page first those that fail or are left out."""
        laws = answers["laws"].to_dataset().to_dataframe()
        findings = list(map(self._finding, laws.itertuples()))
        first = sorted(findings, key=lambda each: (each.verdict == HOLDS, each.verdict != FAILS))
        return Judgement(findings, self.answer(findings), [Findings(first[:SHOWN])], [Text(ABOUT)])

    def _finding(self, row):
        law = table()[row.law]
        claim = Claim(f"{self.command}.{row.law}", law.sentence, law.expected, row.bound, law.bound.source)
        if row.reason.startswith(REFUSED) and not law.solvers:
            verdict, reason = REPORTED, f"{LEFT_OUT}: {row.reason.removeprefix(REFUSED)}"
        else:
            verdict = HOLDS if abs(row.misfit - law.expected) <= row.bound else FAILS
            reason = row.reason and f"no answer: {row.reason}"
        where = row.model if law.solvers else law.group
        return Finding(claim, row.misfit, where=where, stated=verdict, reason=shorten(reason, 200))

    def answer(self, findings: Sequence[Finding]) -> Sequence[str]:
        """Numbers of laws that hold, fail and are left out, and a sentence for each that fails."""
        count = Counter(each.verdict for each in findings)
        counts = f"{self.title}: {count[HOLDS]} of {len(findings)} laws hold, {count[FAILS]} fail"
        return [f"{counts}, {count[REPORTED]} are left out."] + [
            f"{each.claim.id} fails ({each.where}): misfit {each.value:.2g}, allowed {each.claim.tolerance:.2g}. "
            f"{each.claim.sentence}. {each.reason}"
            for each in findings
            if each.verdict == FAILS
        ]


@dataclass(frozen=True)
class Regress(Stored, Checks):
    """Stored laws held against the values of a file."""

    @classmethod
    def of(cls, baseline: str | Path | None = None, update: bool = False) -> Self:
        """Study of the numbers in a file, by default the package's; with `update` the file need not exist yet."""
        path = stored.SHIPPED if baseline is None else Path(baseline)
        values = stored.read_values(path, begin=update)
        laws = sorted((law for law in table().values() if law.group == STORED), key=attrgetter("id"))
        tasks, given = tuple(Examination.of(law, stored.SPACE) for law in laws), {"baseline": printable(path.name)}
        return cls(tasks, "regress", "Has the accuracy moved?", given, path=path, values=values, update=update)

    def _finding(self, row):
        found = replace(super()._finding(row), where="")
        return stored.held(found, self.values.get(row.law, nan), stored.tolerance(row.law)[0])
