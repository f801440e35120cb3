"""Scorecard of a code of contact: what it must hold, and whether it does. `crosscheck verify`."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import inf, isfinite, nan
from textwrap import shorten
from typing import Any

import xarray
from pandas import DataFrame

from scene import Program
from scene.protocol import why_not

from ...models.table import SURFACES, Model, model_of
from ...report.page import Block, Section, Table, Text
from ...solving.outcome import Outcome
from ...solving.task import REFUSED, Batch, SceneTask, Task
from ...statistics.finding import FAILS, HOLDS, REPORTED, Claim, Finding
from ..study import Judgement, Study
from . import figure, forms, friction, hard, invariances
from .law import SECTIONS, Answer, Law, Missing, apart, slug

LEFT_OUT = "left out"
SHOWN = 40  # laws on the page
LONGEST = 200  # letters of a reason
COLUMNS = ("section", "law", "outcome", "misfit", "bound", "nearness", "reason", "sentence", "source")
STEPS = 50.0  # times the work of a contact, of a history
CAPTION = "Laws that fail, and those nearest to their bound."
ABOUT = """Each law asks one or several scenes of the model and makes one number of the answers, a relative
misfit, that must not exceed its bound. Bounds say where they come from: the grid, whose points across the contact
the model measures (`points_across_contact`) or has as a setting, and what a result says is left in its conditions
(`residual`). No grid excuses more than 5 %. A law that the model refuses, or for which it gives no number, is left
out with the reason; a solve that ends without an answer fails it."""


def every_law() -> tuple[Law, ...]:
    """All laws, in the order of the sections."""
    every = [*forms.laws(), *friction.laws(), *invariances.laws(), *hard.laws()]
    return tuple(sorted(every, key=lambda law: SECTIONS.index(law.section)))


@dataclass(frozen=True)
class Verify(Study):
    """Scorecard of a model: laws of its kind, each with a number and its bound."""

    model: Any
    laws: tuple[Law, ...] = ()

    command = "verify"

    @classmethod
    def of(cls, model: Any, laws: Sequence[Law] | None = None) -> "Verify":
        """Scorecard of a model, by name or as an object; of some laws alone where they are given."""
        found = model_of(model)
        asked = every_law() if laws is None else laws
        return cls(found.solver, tuple(law for law in asked if found.dimension in law.kinds))

    @property
    def title(self) -> str:  # type: ignore[override]
        return f"Scorecard of {self.model.name}"

    @property
    def inputs(self) -> Mapping[str, Any]:
        return {"model": f"{self.model}"}

    @cached_property
    def _asked(self) -> Mapping[int, tuple[SceneTask, ...] | str]:
        """Tasks of each law by its place, or the reason why it is left out."""
        return {place: self._tasks(law) for place, law in enumerate(self.laws)}

    def _tasks(self, law):
        if law.drawn and Model.of(self.model).draws != SURFACES:
            return "the model draws no surfaces"
        if law.shares and not hasattr(self.model, "points"):
            return "the model has no field points to refine"
        try:
            models = law.models(self.model)
        except (TypeError, ValueError):
            return f"the model refuses a part of its {self.model.points} points"
        if hasattr(self.model, "refusals"):
            reasons = [reason for each in zip(models, law.scenes, strict=True) for reason in why_not(*each)]
            if reasons:
                return reasons[0]
        if law.twice:
            return (SceneTask(self.model, law.scenes),)
        pairs = zip(models, law.scenes, strict=True)
        return tuple(SceneTask(model, (scene,), work=_work(scene)) for model, scene in pairs)

    def batches(self) -> Sequence[Batch]:
        tasks = [task for tasks in self._asked.values() if not isinstance(tasks, str) for task in tasks]
        return (Batch(list(dict.fromkeys(tasks))),)

    def answers(self, outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
        """A row a law, and one a step of the ladders of points."""
        laws = [self._judged(law, self._asked[place], outcomes) for place, law in enumerate(self.laws)]
        tables = {"laws": DataFrame(laws, columns=list(COLUMNS)), "steps": DataFrame(self._steps(outcomes))}
        return xarray.DataTree.from_dict(
            {f"/{name}": table.to_xarray() for name, table in tables.items() if len(table)}
        )

    def _judged(self, law, tasks, outcomes):
        known = law.section, f"verify.{law.id}"
        told = law.sentence, law.bound.source
        if isinstance(tasks, str):
            return *known, LEFT_OUT, nan, nan, nan, shorten(tasks, LONGEST), *told
        rows = [row for task in tasks for row in outcomes[task].rows]
        reasons = [row.reason for row in rows if row.reason is not None]
        for reason in reasons:
            if reason.startswith(REFUSED):
                return *known, LEFT_OUT, nan, nan, nan, shorten(reason.removeprefix(REFUSED), LONGEST), *told
        if reasons:
            return *known, FAILS, nan, nan, inf, f"no answer: {shorten(reasons[0], LONGEST)}", *told
        answers = [Answer.of(row, self.model, Model.of(self.model).dimension) for row in rows]
        try:
            misfit, bound = float(law.misfit(answers)), law.bound(answers)
        except Missing as reason:
            return *known, LEFT_OUT, nan, nan, nan, str(reason.args[0]), *told
        holds = misfit <= bound
        nearness = misfit / bound if bound > 0 else misfit / 1e-15
        return *known, HOLDS if holds else FAILS, misfit, bound, nearness if isfinite(misfit) else inf, "", *told

    def _steps(self, outcomes):
        """Work and precision: error and time by size."""
        for place, law in enumerate(self.laws):
            tasks, contact = self._asked[place], law.id.partition(".")[2]
            if law.shares and not isinstance(tasks, str):
                _, load = hard.ladders()[contact]
                for task in tasks:
                    (row,) = outcomes[task].rows
                    error, points = apart(row.normal_force, load), task.solver.points
                    yield {"contact": contact, "points": points, "relative_error": error, "seconds": row.seconds}

    def judge(self, answers: xarray.DataTree) -> Judgement:
        """One finding a law; a law that is left out is reported with the reason."""
        laws = _laws(answers)
        findings = [self._finding(row) for row in laws.itertuples()]
        asked = laws[laws["outcome"] != LEFT_OUT]
        plots = [figure.plot(asked, self.model.name)] if len(asked) else []
        return Judgement(findings, self._answer(findings), [*plots, *_blocks(laws, answers)], self.setting)

    def _finding(self, row):
        claim = Claim(row.law, row.sentence, 0.0, row.bound, row.source, dimension=Model.of(self.model).dimension)
        stated = REPORTED if row.outcome == LEFT_OUT else row.outcome
        reason = f"{LEFT_OUT}: {row.reason}" if row.outcome == LEFT_OUT else row.reason
        return Finding(claim, row.misfit, where=row.section, stated=stated, reason=reason, size=True)

    def _answer(self, findings):
        """How many laws hold, fail and are left out, and a sentence for each that fails."""
        count = {stated: sum(each.stated == stated for each in findings) for stated in (HOLDS, FAILS, REPORTED)}
        told = f"{self.model.name} as a model in {Model.of(self.model).dimension}: {count[HOLDS]}"
        told += f" of {len(findings)} laws hold, {count[FAILS]} fail, {count[REPORTED]} are left out."
        return [told] + [
            f"{each.claim.id} fails: misfit {each.value:.2g}, allowed {each.claim.tolerance:.2g}. "
            f"{each.claim.sentence}. {each.reason}".strip()
            for each in findings
            if each.stated == FAILS
        ]

    @property
    def setting(self) -> Sequence[Block]:
        """The model, and how it is judged."""
        return [Text(f"{self.model}"), Text(ABOUT)]


OUTCOMES = (HOLDS, FAILS, LEFT_OUT)


def _laws(answers):
    return answers["laws"].to_dataset().to_dataframe().reset_index(drop=True)


def _blocks(laws: DataFrame, answers: xarray.DataTree) -> list[Block]:
    """Counts of the sections, the laws nearest to their bounds by section, what is left out, work."""
    sections = [section for section in SECTIONS if (laws["section"] == section).any()]
    counts = [
        {"section": section}
        | {each: int(((laws["section"] == section) & (laws["outcome"] == each)).sum()) for each in OUTCOMES}
        for section in sections
    ]
    nearest = laws[laws["outcome"] != LEFT_OUT].sort_values("nearness", ascending=False, kind="stable")
    shown = set(nearest["law"][: SHOWN - len(sections)])
    blocks: list[Block] = [Table("sections", DataFrame(counts), "Laws by section.")]
    blocks.append(Table("laws", laws, "Every law with its misfit, its bound and the source of it.", long=True))
    for section in sections:
        own = laws[(laws["section"] == section) & laws["law"].isin(shown)]
        if len(own):
            table = Table(slug(section), own[["law", "sentence", "misfit", "bound", "outcome"]], CAPTION)
            blocks.append(Section(section.capitalize(), [table]))
    reasons = laws[laws["outcome"] == LEFT_OUT].groupby("reason", sort=False)["law"].count()
    if len(reasons):
        frame = DataFrame({"reason": list(reasons.index), "laws": list(reasons)})
        blocks.append(Section("Left out", [Table("left-out", frame, "Why laws are left out, and how many.")]))
    if "steps" in answers:
        steps = answers["steps"].to_dataset().to_dataframe().reset_index(drop=True)
        caption = "Error of the force against the closed form, and processor time, by size."
        blocks.append(Section("Work and precision", [Table("work-precision", steps, caption)]))
    return blocks


def _work(scene):
    return STEPS if isinstance(scene.motion, Program) else 1.0
