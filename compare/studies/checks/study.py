"""Laws of the table asked of models: `crosscheck verify`, `crosscheck stability`, `crosscheck regress`."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import inf, isfinite, nan
from pathlib import Path
from textwrap import shorten
from typing import Any, Self

import xarray
from pandas import DataFrame

from scene.printable import printable
from scene.reading import InvalidInput

from ...models.table import model_of
from ...report.page import Block, Table, Text
from ...solving.outcome import Outcome
from ...solving.suggest import known
from ...solving.task import REFUSED, Batch, Task
from ...statistics.finding import FAILS, HOLDS, REPORTED, UNDECIDED, Claim, Finding
from ..study import Judgement, Study
from . import figure, stored
from .accuracy import Accuracy, named
from .hardcase import SIZES
from .law import GROUPS, STORED, Law
from .table import Examination, table

LEFT_OUT = "left out"
SHOWN = 40  # laws on the page
GONE = "no longer measured"
ABOUT = """Each law asks one or several scenes of a model and makes one number of the answers, a relative
misfit, that must not exceed its bound. Bounds say where they come from: the grid, whose points across the contact
the model measures (`points_across_contact`) or has as a setting, and what a result says is left in its conditions
(`residual`). No grid excuses more than 5 %. A law that any model may be asked, and that it refuses or for which it
gives no number, is left out with the reason; a solve that ends without an answer fails it.

A hard case is a contact in which a solver may fail, in both dimensionalities wherever both can be asked; N is the
number of points of its grid. Of several numbers the one nearest to its own bound counts, as a share of it. A
stored number is a ratio of 1D over 3D or over a closed form, which must not move."""


@dataclass(frozen=True)
class Checks(Study):
    """Laws, each asked of a model. Raises InvalidInput where there is no such model or size."""

    tasks: tuple[Examination, ...]
    command: str = "verify"  # type: ignore[misc]
    title: str = "Laws"
    given: Mapping[str, Any] = field(default_factory=dict)

    @classmethod
    def verify(cls, model: Any, laws: Sequence[str] | None = None) -> Self:
        """Scorecard of a model, by name or as an object: laws of its dimension, or some of them by their ids."""
        found = model_of(model)
        asked = [law for law in table().values() if law.group != STORED and not law.solvers]
        tasks = tuple(
            Examination(law.id, found.solver)
            for law in sorted(asked, key=lambda law: GROUPS.index(law.group))
            if found.dimension in law.kinds and (laws is None or law.id in laws)
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

    @cached_property
    def laws(self) -> Mapping[str, Law]:
        """Laws that are asked, by their ids."""
        return {task.law_id: task.law for task in self.tasks}

    def batches(self) -> Sequence[Batch]:
        return (Batch(self.tasks),)

    def answers(self, outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
        """A row for each law and model."""
        rows = DataFrame([self._judged(task, outcomes[task].rows[0]) for task in self.tasks])
        return xarray.DataTree.from_dict({"/laws": rows.to_xarray()})

    def _judged(self, task, row):
        law, misfit, bound = (
            self.laws[task.law_id],
            row.measures.get("misfit", nan),
            row.measures.get("bound", nan),
        )
        bound = law.bound.of(()) if law.group == STORED else bound
        distance, reason = abs(misfit - law.expected), row.reason or ""
        left_out = reason.startswith(REFUSED) and not law.solvers and law.group != STORED
        return {
            "group": law.group,
            "law": law.id,
            "model": f"{task.solver.name}, {getattr(task.solver, 'points', 'no')} points",
            "outcome": LEFT_OUT if left_out else HOLDS if distance <= bound else FAILS,
            "misfit": misfit,
            "bound": bound,
            "nearness": distance / max(bound, 1e-15) if isfinite(distance) else nan if left_out else inf,
            "reason": shorten(
                reason.removeprefix(REFUSED) if left_out else reason and f"no answer: {reason}", 200
            ),
            "sentence": law.sentence,
            "source": law.source,
            "seconds": row.seconds,
        }

    def judge(self, answers: xarray.DataTree) -> Judgement:
        """A finding a law; counts, the laws nearest to their bounds, and what is left out."""
        laws = answers["laws"].to_dataset().to_dataframe().reset_index(drop=True)
        findings = [self._finding(row) for row in laws.itertuples()]
        asked, left_out = laws[laws["outcome"] != LEFT_OUT], laws[laws["outcome"] == LEFT_OUT]
        counts = laws.groupby(["group", "outcome"], sort=False).size().unstack(fill_value=0)
        counts = counts.reindex(columns=[HOLDS, FAILS, LEFT_OUT], fill_value=0).reset_index()
        shown = asked.sort_values("nearness", ascending=False, kind="stable")[:SHOWN].sort_index()
        shown = shown[["group", "law", "model", "sentence", "misfit", "bound", "outcome"]]
        why = left_out.groupby("reason", sort=False)["law"].count().rename("laws").reset_index()
        blocks: list[Block] = [figure.plot(asked, self.title)] if len(asked) else []
        blocks += [
            Table("groups", counts, "Laws by group."),
            Table("nearest", shown, "Laws that fail, and those nearest to their bound."),
            Table("laws", laws, "Every law with its misfit, its bound and the source of it.", long=True),
        ]
        if len(why):
            blocks.append(Table("left-out", why, "Why laws are left out, and how many."))
        return Judgement(findings, self.answer(findings), blocks, [Text(ABOUT)])

    def _finding(self, row):
        law = self.laws[row.law]
        claim = Claim(f"{self.command}.{row.law}", row.sentence, law.expected, row.bound, row.source)
        stated = REPORTED if row.outcome == LEFT_OUT else row.outcome
        reason = f"{LEFT_OUT}: {row.reason}" if row.outcome == LEFT_OUT else row.reason
        where = row.model if law.solvers else "" if law.group == STORED else row.group
        return Finding(claim, row.misfit, where=where, stated=stated, reason=reason)

    def answer(self, findings: Sequence[Finding]) -> Sequence[str]:
        """How many laws hold, fail and are left out, and a sentence for each that fails."""
        count = {stated: sum(each.stated == stated for each in findings) for stated in (HOLDS, FAILS, REPORTED)}
        told = f"{self.title}: {count[HOLDS]} of {len(findings)} laws hold, {count[FAILS]} fail"
        return [f"{told}, {count[REPORTED]} are left out."] + [
            f"{each.claim.id} fails{f' ({each.where})' if each.where else ''}: misfit {each.value:.2g}, allowed "
            f"{each.claim.tolerance:.2g}. {each.claim.sentence}. {each.reason}".strip()
            for each in findings
            if each.stated == FAILS
        ]


@dataclass(frozen=True)
class Regress(Checks):
    """Stored laws held against the values of a file.

    path : of the file; values : those in it; update : whether what has moved is stored afterwards
    """

    path: Path = stored.SHIPPED
    values: Mapping[str, float] = field(default_factory=dict)
    update: bool = False

    @classmethod
    def of(cls, baseline: str | Path | None = None, update: bool = False) -> Self:
        """Study of a file, that of the package if absent; one to be updated need not be there yet."""
        path = stored.SHIPPED if baseline is None else Path(baseline)
        values = {} if update and not path.exists() else stored.read_values(path)
        ids = [law.id for law in table().values() if law.group == STORED]
        if values and not values.keys() & set(ids):
            raise InvalidInput(f"{path}: belongs to another collection: {min(values)!r} is no number of this one")
        tasks = tuple(Examination(id, stored.SPACE) for id in sorted(ids))
        given = {"baseline": printable(path.name)}
        return cls(tasks, "regress", "Has the accuracy moved?", given, path, values, update)

    @cached_property
    def laws(self) -> Mapping[str, Law]:
        return {law.id: law for law in stored.laws(self.values)}

    def judge(self, answers: xarray.DataTree) -> Judgement:
        """As of every law; values that are no longer measured too."""
        made = super().judge(answers)
        gone = sorted(self.values.keys() - self.laws.keys())
        lost = [
            Finding(Claim(f"regress.{id}", id, self.values[id]), nan, stated=UNDECIDED, reason=GONE) for id in gone
        ]
        found = [*made.findings, *lost]
        return replace(made, findings=found, answer=self.answer(found))

    def _finding(self, row):
        law = self.laws[row.law]
        share = law.bound.of(()) / abs(law.expected or 1.0)
        return stored.held(super()._finding(row), law.expected, share)

    def failed(self: Any, findings: Sequence[Finding]) -> bool:
        """Whether anything asks for somebody's attention; after an update, whether something is not stored."""
        wrong = [each for each in findings if each.stated != HOLDS]
        return any(not self.update or (not isfinite(each.value) and each.reason != GONE) for each in wrong)

    def store(self: Any, findings: Sequence[Finding]) -> None:
        """Store what has moved, is new or is gone, and nothing else; what has failed keeps its value.

        What moved within its tolerance stays as it is stored: many small steps do not pass unseen.
        """
        wrong = {each.claim.id.removeprefix("regress."): each for each in findings if each.stated != HOLDS}
        kept = {id: value for id, value in self.values.items() if id not in wrong or wrong[id].reason != GONE}
        values = kept | {id: each.value for id, each in wrong.items() if isfinite(each.value)}
        if values != self.values:
            stored.write_values(self.path, values, "Written by `crosscheck regress --update`: numbers as found.")


@dataclass(frozen=True)
class OwnScene(Accuracy):
    """Ratios of 1D over 3D of a scene of one's own held against the values of a file, as `Regress`.

    tolerance : relative, of each ratio
    """

    name: str = ""
    path: Path = stored.SHIPPED
    values: Mapping[str, float] = field(default_factory=dict)
    update: bool = False
    tolerance: float = 1e-3

    command, title = "regress", "Has the accuracy of the scene moved?"
    failed, store = Regress.failed, Regress.store

    @classmethod
    def stored(cls, scene: Any, baseline: str | Path | None, update: bool = False) -> Self:
        """Study of a scene and a file; one to be updated need not be there yet. Raises InvalidInput."""
        found = cls.of(scene, {})
        if baseline is None:
            raise InvalidInput("baseline = None: the numbers of a scene of your own need a file, name one")
        path = Path(baseline)
        values = {} if update and not path.exists() else stored.read_values(path)
        return replace(found, name=named(scene), path=path, values=values, update=update)

    def judge(self, answers: xarray.DataTree) -> Judgement:
        """A finding a ratio, held against its stored value."""
        found = []
        for each in super().judge(answers).findings:
            id = f"{self.name}.{each.claim.id}"
            one = replace(each, claim=replace(each.claim, id=f"regress.{id}"))
            found.append(stored.held(one, self.values.get(id, nan), self.tolerance))
        return Judgement(found)
