"""Laws of the table asked of models: `crosscheck verify`, `crosscheck stability`, `crosscheck regress`."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import nan
from pathlib import Path
from textwrap import shorten
from typing import Any, Self

import xarray
from pandas import DataFrame

from scene.printable import printable

from ...models.table import model_of
from ...report.page import Findings, Text
from ...solving.outcome import Outcome
from ...solving.suggest import known
from ...solving.task import REFUSED, Batch, Task
from ...statistics.finding import FAILS, HOLDS, REPORTED, Claim, Finding
from ..study import Judgement, Study
from . import stored
from .hardcase import SIZES
from .law import STORED
from .stored import Stored
from .table import Examination, table

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
            Examination(law.id, found.solver)
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
        tasks = tuple(Examination(law.id, build(SIZES[size])) for law in laws for build in law.solvers)
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
        told = f"{self.title}: {count[HOLDS]} of {len(findings)} laws hold, {count[FAILS]} fail"
        return [f"{told}, {count[REPORTED]} are left out."] + [
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
        """Study of a file, that of the package if absent; one to be updated need not be there yet."""
        path = stored.SHIPPED if baseline is None else Path(baseline)
        values = stored.read_values(path, begin=update)
        ids = sorted(law.id for law in table().values() if law.group == STORED)
        tasks, given = tuple(Examination(id, stored.SPACE) for id in ids), {"baseline": printable(path.name)}
        return cls(tasks, "regress", "Has the accuracy moved?", given, path=path, values=values, update=update)

    def _finding(self, row):
        found = replace(super()._finding(row), where="")
        return stored.held(found, self.values.get(row.law, nan), stored.tolerance(row.law)[0])
