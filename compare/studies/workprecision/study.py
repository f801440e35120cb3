"""What accuracy costs, for any scene: `crosscheck workprecision`."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import cached_property
from itertools import groupby
from math import isfinite, nan
from typing import Any

import xarray
from pandas import DataFrame

from scene import Refused, Slide, notes
from scene.indenter import Axisymmetric
from scene.motion import Indent
from scene.scales import elastic_contact

from ...figures.plot import Plot
from ...library.case import Case, doubted
from ...library.lookup import SeveralScenes, named_cases
from ...models.exact import Exact
from ...models.law.persson import Persson
from ...models.table import Model, ModelLike, listed, named
from ...report.page import Block, Table
from ...solving.curve import Curve, of_model
from ...solving.folders import folders
from ...solving.task import Batch, Outcome, Task
from ...solving.words import seconds, share
from ...statistics.finding import Claim, Finding
from ...trustmap.corrected import CorrectedMDR
from ...trustmap.friction_law import FrictionLaw
from ..comparison.around import extended_of, finer_than_its_grid
from ..study import Judgement, Study
from . import errors, figure
from .errors import INTERVAL, Way
from .ladder import Ladder, grid_of

LEVELS = (0.1, 0.05, 0.02, 0.01)  # wanted errors
ABOUT = """Errors are relative, of rough scenes those expected (rms) of a mean over surfaces. The reference is a
closed form where there is one, else 3D, or 3D extended where its grid cannot hold the waves, on four times the
points of the finest grid that is timed, or on the finest that solves; its error is half of its interval of 95 %.
It is compared with its coarser grids on the same surfaces, so that their errors are known far better than its own.
Times are processor seconds of a single thread from scene to the result, the least of several repeats. A setting
counts with the largest error of its interval, and as no better than all finer ones of its model. The rms error is
half of the half-width that --interval states."""
CLAIMS = {
    level: Claim(f"workprecision.time-{100 * level:g}-percent", f"Processor time to {share(level)}", unit="s")
    for level in LEVELS
}


@dataclass(frozen=True)
class WorkPrecision(Study):
    """Error against processor time of models on scenes.

    cases : scenes by name, with the settings of the solvers
    asked : models compared with 3D, in place of 1D, 1D corrected, the law and Persson's theory
    """

    cases: Mapping[str, Case]
    asked: tuple[ModelLike, ...] = ()

    command, title, about = "workprecision", "What accuracy costs in time", ABOUT

    @classmethod
    def of(
        cls,
        scene: SeveralScenes | None = None,
        models: Sequence[ModelLike] | None = None,
    ) -> "WorkPrecision":
        """Study of a scene, of several files or by name, or of the paper's two.

        Raises InvalidInput, and Refused of a scene that nothing can be measured against.
        """
        study = cls(named_cases(scene), listed(models))
        for name, (first, *_) in study.ladders.items():
            if not first.solvers:
                raise Refused(f"{name}: 3D, which others are measured against, refuses it: {first.refused[0][1]}")
        return study

    @property
    def inputs(self) -> Mapping[str, Any]:
        names = sorted({each.model.name for own in self.ladders.values() for each in own})
        return {"cases": {name: case.inputs for name, case in self.cases.items()}, "models": names}

    @property
    def doubts(self) -> tuple[str, ...]:
        return doubted(*self.cases.values())

    @property
    def notes(self) -> tuple[str, ...]:
        return tuple(dict.fromkeys(note for case in self.cases.values() for note in notes(case.scene)))

    @cached_property
    def folders(self) -> Mapping[str, str]:
        """Folders of the cases, by name. Raises InvalidInput where two share one."""
        return folders(self.cases, "case")

    @cached_property
    def ladders(self) -> Mapping[str, Sequence[Ladder]]:
        """Ladders of each case, that first which others are measured against: a closed form, else 3D."""
        return {name: list(self._ladders(case)) for name, case in self.cases.items()}

    def _ladders(self, case) -> Iterator[Ladder]:
        exact, own, finest = Exact(), {"mdr": case.mdr, "bem": case.bem}, case.bem
        if finer_than_its_grid(case):
            own["extended"] = finest = extended_of(case)
        usual = (case.mdr, CorrectedMDR(case.mdr), FrictionLaw(), Persson(), finest)
        asked = [Model.of(named(each, own) if isinstance(each, str) else each) for each in self.asked or usual]
        first = Model.of(finest if exact.refusals(case.scene) else exact)
        yield Ladder.of(first, case.scene, refers=True)
        yield from (Ladder.of(each, case.scene) for each in asked if each.name != first.name)

    @cached_property
    def _grids(self):
        return {folder: grid_of(self.ladders[name]) for name, folder in self.folders.items()}

    def grids(self) -> Mapping[str, Curve]:
        """Contacts of each case."""
        return self._grids

    def batches(self) -> Sequence[Batch]:
        """First everything that is not timed."""
        timed = dict.fromkeys(task for own in self.ladders.values() for each in own for task in each.timed)
        return *super().batches(), Batch(tuple(timed), timed=True)

    def answers(self, outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
        """Answers and times of every model, at /case/model."""
        solved = super().answers(outcomes)
        return xarray.DataTree.from_dict(
            {
                f"/{folder}/{each.model.name}": each.with_times(of_model(found, each.model.name), outcomes)
                for name, folder in self.folders.items()
                for found in [solved.children[folder].to_dataset(inherit=False)]
                for each in self.ladders[name]
                if each.solvers
            }
        )

    def ways(self, answers: xarray.DataTree) -> Iterator[tuple[str, str, list[Way]]]:
        """Scene and quantity, what they are measured against, and every way to them."""
        for name, case in self.cases.items():
            first, *others = self.ladders[name]
            below = answers.children[self.folders[name]].children
            node = {model: each.to_dataset(inherit=False) for model, each in below.items()}
            for quantity in _quantities(case):
                at, own = (name, quantity), node[first.model.name]
                found: list[Way] = []
                of = errors.reference(first, own, quantity, _scale(case, quantity))
                for ladder in self.ladders[name]:
                    found += _refused(*at, ladder)
                for ladder in others:
                    if ladder.solvers and quantity in ladder.model.answers:
                        found += _of_model(*at, ladder, node, of)
                grids = list(errors.ways(*at, first, own, of, of.biases))
                found += grids
                if "stratum" in own.coords and len(grids) > 1:
                    found.append(errors.sampled(grids[0], quantity, first, own, of))
                known = f", which leaves {share(of.error)} open" if of.error else ""
                yield f"{name}, {quantity}", f"measured against {of.source}{known}", found

    def judge(self, answers: xarray.DataTree) -> Judgement:
        """Times to wanted errors: a figure, a table, and what each quantity of each scene is measured against."""
        lines, findings = [], []
        rows: list[dict[str, Any]] = []
        every: list[Way] = []
        for where, sentence, ways in self.ways(answers):
            lines.append(f"{where}: {sentence}.")
            for level, claim in CLAIMS.items():
                best = _cheapest(ways, level)
                known = (best.effort(level), best.label, "") if best else (nan, "", _missed(ways))
                findings.append(Finding(claim, known[0], where=where, dimension=known[1], reason=known[2]))
            rows += _rows(ways)
            every += ways
        table = DataFrame(map(asdict, every))
        failed = table.loc[table["reason"] != "", ["case", "label", "settings", "reason"]].drop_duplicates()
        blocks: list[Block] = [_plot(table)] if table["bias"].notna().any() else []
        caption = "Least processor time of each model to an error, with its settings; the least error known."
        if rows:
            blocks.append(Table("workprecision-times", DataFrame(rows), caption))
        if len(failed):
            failed = failed.rename(columns={"label": "model"})
            blocks.append(Table("workprecision-failures", failed, "Settings without an answer."))
        return Judgement(findings, lines, blocks, self.setting)


def _quantities(case: Case) -> tuple[str, ...]:
    """Quantities that are not prescribed, friction first."""
    pressed = "force" if case.motion.pressed_by in ("depth", "gap") else "depth"
    return ("friction", pressed) if case.slides else (pressed,)


def _scale(case: Case, quantity: str) -> float:
    """Depth of the smooth relaxed contact, as a rough one may be zero; NaN for the size of the answer."""
    known = isinstance(case.indenter, Axisymmetric) and isinstance(case.motion, Indent | Slide)
    return elastic_contact(case.scene).depth if quantity == "depth" and known else nan


def _refused(case, quantity, ladder) -> Iterator[Way]:
    """Settings that a model refuses, with its reasons; one where it refuses all."""
    for solver, reason in ladder.refused[: None if ladder.solvers else 1]:
        points = f"{solver.points} points" if ladder.solvers else ""
        yield Way(case, quantity, ladder.model.name, ladder.model.label, points, reason=reason)


def _of_model(case, quantity, ladder, node, of) -> Iterator[Way]:
    """Ways of another model; one that corrects 1D has any number of profiles once it knows the ratio."""
    dataset, line, setup = node[ladder.model.name], node.get("MDR"), 0.0
    if f"{quantity}_ratio" in dataset and line is not None and line.sizes["surface"] > 1:
        profiles = getattr(ladder.model.solver, "profiles", 1)
        setup = max(float(dataset["processor"][0]) - profiles * float(line["processor"][0]), 0.0)
        dataset = errors.corrected(dataset, line, quantity)
    for way in errors.ways(case, quantity, ladder, dataset, of, errors.against(dataset, quantity, of)):
        yield replace(way, setup=setup)


def _cheapest(ways: Sequence[Way], level: float) -> Way | None:
    """The way of least effort to an error; None where none reaches it."""
    best = min(ways, key=lambda way: way.effort(level), default=None)
    return best if best and isfinite(best.effort(level)) else None


def _missed(ways):
    best = min((way.most for way in ways if isfinite(way.most)), default=nan)
    return f"not reached, {share(best)} at best" if isfinite(best) else "not known"


def _taken(way: Way | None, level: float) -> str:
    """Time and settings of a way to an error in words."""
    if way is None:
        return "–"
    count, settings = way.count(level), way.settings
    if settings == INTERVAL:
        settings = f"--interval {share(way.half_width(count)).replace(' ', '')}"
    elif way.scatter:
        draws = "profiles" if way.label.startswith("1D") else "surfaces"
        settings = f"{count:,.0f} {draws if count > 1 else draws[:-1]}, {settings}"
    return f"{seconds(way.effort(level))}{f' ({settings})' if settings else ''}"


def _rows(ways: Sequence[Way]) -> Iterator[dict[str, Any]]:
    """A row for each model, and for intervals: time and settings to each error."""
    for (label, sampled), group in groupby(ways, lambda way: (way.label, way.settings == INTERVAL)):
        own = list(group)
        known = [way.most for way in own if isfinite(way.most)]
        if known:
            row = {"case": own[0].case, "quantity": own[0].quantity, "model": f"{label}{', interval' * sampled}"}
            row |= {f"within {share(level)}": _taken(_cheapest(own, level), level) for level in LEVELS}
            yield row | {"best_known": share(min(known))}


def _plot(ways: DataFrame) -> Plot:
    return Plot(
        "workprecision", figure.figure, {"workprecision-ways": ways},
        "Relative error over processor time. Smooth: a point a grid. Rough: expected error of means of 1, 10, "
        "100, 1000 surfaces, a curve a grid; thick, on several grids as intervals take them. Grey: below the "
        "error of the reference; 3D of rough scenes shares its surfaces.",
        "Panels of error over time: 1D is quick and level, 3D slower and falling.",
    )  # fmt: skip
