"""Claims of the paper judged on series of contacts: `crosscheck study`."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import inf
from os.path import lexists
from pathlib import Path
from typing import Any

import numpy as np
import xarray
from pandas import DataFrame

from scene.printable import printable
from scene.reading import InvalidInput, text_of

from ...library.case import share_of
from ...library.describe import described, slug
from ...library.lookup import located
from ...library.ready import ready, studies
from ...models.table import ModelLike, listed
from ...report.page import Block, Findings, Section, Table, Text
from ...solving.outcome import Outcome
from ...solving.parameter_grid import ParameterGrid, refuse
from ...solving.suggest import known
from ...solving.task import Task
from ...solving.words import VERDICTS, sentences
from ...statistics import eq23
from ...statistics.finding import REPORTED, Finding, claimed
from ...statistics.multilevel import GROWTH
from ..study import Judgement, Study
from .catalogue import SIZES, STUDIES, ReadyStudy
from .families import alike, every, family_findings
from .judgement import JudgedSeries, judge_series
from .plots import plots_of_series, plots_of_study
from .points import failures, points
from .series import ROUGH, Contacts, Series
from .study_file import study_of

ALL = "all"
UNMATCHED = (
    "The roughness is a line in 1D and a surface in 3D. The rule of the method, "
    "C_1D = π q C_2D, ties their spectra; it keeps the rms height and the rms of the full "
    "gradient. Real contact is a length in 1D and an area in 3D, and no claim compares them."
)


@dataclass(frozen=True)
class JudgedStudy:
    """A study, judged: its series one after the other, and findings on several of them together."""

    series: tuple[JudgedSeries, ...]
    together: tuple[Finding, ...]

    @property
    def findings(self) -> list[Finding]:
        """Findings on every series, then on all together."""
        return [*(each for judged in self.series for each in judged.findings), *self.together]


@dataclass(frozen=True)
class ClaimStudy(Study):
    """A study of the catalogue, or of a file, at a size.

    name : of its folder
    study : the question
    size : a name of SIZES
    source : text of the file of a study that does not come with the package
    models, reference : in place of those that its file names, see `Models.of`
    interval : in place of that of the study, see `Series`
    strata : numbers of draws on each grid by model, of each series where they are not fixed
    """

    name: str
    study: ReadyStudy
    size: str
    source: str | None = None
    models: tuple[ModelLike, ...] = ()
    reference: str = ""
    interval: float | None = None
    strata: Mapping[str, Mapping[str, tuple[int, ...]]] = field(default_factory=dict)

    command = "study"

    @classmethod
    def of(
        cls,
        name: str | Path,
        size: str = "quick",
        models: Sequence[ModelLike] | None = None,
        reference: str | None = None,
        interval: float | str | None = None,
    ) -> "ClaimStudy | AllStudies":
        """The study of a name that comes with the package, all of them, or that of a file.

        Raises InvalidInput, Refused.
        """
        known("size", size, SIZES)
        found: ClaimStudy | AllStudies
        chosen = listed(models), reference or "", None if interval is None else share_of("interval", interval)
        if name == ALL:
            found = AllStudies(tuple(cls(each, study, size, None, *chosen) for each, study in STUDIES.items()))
        elif name in STUDIES:
            found = cls(str(name), STUDIES[str(name)], size, None, *chosen)
        else:
            path = _located(name)
            text = text_of(path)
            found = cls(printable(path.stem), study_of(text, str(path)), size, text, *chosen)
        refuse(found.grids().values())
        return found

    @property
    def title(self) -> str:  # type: ignore[override]
        return self.study.title

    @property
    def about(self) -> str:  # type: ignore[override]
        return self.study.about

    @property
    def place(self) -> str:  # type: ignore[override]
        return slug(f"{self.name}-{self.size}")

    @property
    def inputs(self) -> Mapping[str, Any]:
        own = {} if self.source is None else {"source": self.source}
        wanted = {} if self.interval is None else {"interval": self.interval}
        return {"name": self.name, "size": self.size} | wanted | own

    @cached_property
    def series(self) -> tuple[Series, ...]:
        """Series that are solved at this size."""
        return tuple(
            replace(
                each,
                asked=self.models or each.asked,
                reference=self.reference or each.reference,
                interval=self.interval or each.interval,
                strata=self.strata.get(each.name),
            )
            for each in self.study.series(SIZES[self.size])
        )

    def grids(self) -> Mapping[str, ParameterGrid]:
        """Parameter grids of the rough and of the smooth body of every series, by "series/body"."""
        return {name: each for series in self.series for name, each in series.grids.items()}

    def answers(self, outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
        """Everything that was solved, at /series/body/solver; a series has title and note as attributes."""
        tree = super().answers(outcomes)
        for each in self.series:
            tree[each.name].attrs = {"title": each.title, "note": each.note, "prescribed": each.prescribed}
        return tree

    def judged(self, answers: xarray.DataTree) -> JudgedStudy:
        """Every series, and all together."""
        series = tuple(judge_series(Contacts(each, answers)) for each in self.series)
        places = {every(each): each for each in self.series}
        together = tuple(
            _told(places[each.where], each) if each.where in places else each for each in family_findings(series)
        )
        own = ((each, tuple(_told(each.series, one) for one in each.findings)) for each in series)
        return JudgedStudy(tuple(replace(each, findings=found) for each, found in own), together)

    def more(
        self, answers: xarray.DataTree, findings: Sequence[Finding], growth: float = GROWTH
    ) -> "ClaimStudy | None":
        """The study with the draws that undecided claims ask for; None where none does."""
        sampled = {each.name: each for each in self.series if each.interval is not None}
        asked, had = {}, {}
        for name, each in sampled.items():
            own = [found for found in findings if found.where in (name, every(each))]
            drawn = {model.name for model in each.models.drawn}
            counts = each.drawn.more(own, each.interval or inf, growth)
            asked[name] = {model: counts[model] for model in drawn}
            had[name] = {model: each.drawn.counts[model] for model in drawn}
        for names in alike(list(sampled.values())):
            asked |= dict.fromkeys(names, _most([asked[name] for name in names]))
        return None if asked == had else replace(self, strata=asked)

    def judge(self, answers: xarray.DataTree) -> Judgement:
        """An overview of the verdicts, and findings on several series; then each series.

        The answer is a statement for each claim; numbers without a claim stand in tables alone.
        """
        judged = self.judged(answers)
        findings = judged.findings
        whole = list(plots_of_study(judged.series, judged.together))
        blocks: list[Block] = []
        if overview := list(_overview(findings)):
            blocks.append(
                Table("overview", DataFrame(overview), "Findings of each verdict, by claim and dimensionality.")
            )
        if judged.together:
            blocks.append(Section("Several series together", [*whole, Findings(judged.together)]))
        blocks += [
            Section(_numbered(number, each), list(_section(each))) for number, each in enumerate(judged.series, 1)
        ]
        contacts = [
            Section(
                f"Contacts of {_numbered(number, each)}", [Text("\n".join(f"- {line}" for line in _asked(each)))]
            )
            for number, each in enumerate(judged.series, 1)
        ]
        # First come the places where friction itself is shifted.
        answer = [*eq23.answers(findings), *sentences(claimed(findings))]
        return Judgement(findings, answer, blocks, [Text(self.about), Text(UNMATCHED), *contacts])


@dataclass(frozen=True)
class AllStudies(Study):
    """All studies of the catalogue on one page: the answer, and verdicts; their own pages show every series."""

    studies: tuple[ClaimStudy, ...]

    command, title = "study", "The laws of the paper in one and in three dimensions"
    about = (
        "The claims are those of Popov, Voll, Li, Chai and Popov, Sci. Rep. 4, 3750 (2014). Each is judged in one "
        "dimension and in three, on the same scenes. A claim holds if its whole interval of 95 % lies within the "
        "tolerance and fails if none of it does; otherwise, or where an error is unknown, it is undecided. The "
        "scatter is found by leaving out each surface in turn, at all points at once, and the interval is wider "
        "at both ends by the change on halving the grid. The page of each study, crosscheck study NAME, shows "
        "every series with its figures and points."
    )

    @property
    def place(self) -> str:  # type: ignore[override]
        return slug(f"{ALL}-{self.studies[0].size}")

    @property
    def inputs(self) -> Mapping[str, Any]:
        return {"name": ALL, "size": self.studies[0].size}

    def grids(self) -> Mapping[str, ParameterGrid]:
        """Parameter grids of every study, by "study/series/body"."""
        return {f"{each.name}/{name}": found for each in self.studies for name, found in each.grids().items()}

    def more(
        self, answers: xarray.DataTree, findings: Sequence[Finding], growth: float = GROWTH
    ) -> "AllStudies | None":
        """The studies with the draws that undecided claims of each ask for; None where none does."""
        found = []
        for each in self.studies:
            place = f"{each.name}, "
            own = [one for one in findings if one.where.startswith(place)]
            own = [replace(one, where=one.where.removeprefix(place)) for one in own]
            found.append(each.more(answers.children[each.name], own, growth))
        if not any(found):
            return None
        return replace(self, studies=tuple(more or each for more, each in zip(found, self.studies, strict=True)))

    def judge(self, answers: xarray.DataTree) -> Judgement:
        """A section for each study: its figures and findings."""
        findings: list[Finding] = []
        sections = []
        for each in self.studies:
            judged = each.judged(answers.children[each.name])
            plots = plots_of_study(judged.series, judged.together)
            shown = [replace(plot, name=f"{each.name}/{plot.name}") for plot in plots]
            own = [_named(one, each.name) for one in judged.findings]
            findings += own
            sections.append(Section(each.title, [*shown, Findings(claimed(own))]))
        return Judgement(findings, sentences(claimed(findings)), sections, self.setting)

    @property
    def setting(self) -> Sequence[Block]:
        """Rule of the verdict, what differs between the dimensionalities, and each question with its command."""
        questions = (
            f"- {each.title} {each.about} crosscheck study {each.name} --size {each.size}" for each in self.studies
        )
        return [Text(self.about), Text(UNMATCHED), Text("\n".join(questions))]


def _told(series: Series, found: Finding) -> Finding:
    """A finding with what would decide it."""
    return series.drawn.told(found, {each.name: each.draws for each in series.models})


def _most(counts: Sequence[Mapping[str, tuple[int, ...]]]) -> dict[str, tuple[int, ...]]:
    """Numbers of draws that are enough for all of some series, on the grids that all of them have."""
    return {
        model: tuple(max(grid) for grid in zip(*(each[model] for each in counts), strict=False))
        for model in counts[0]
    }


def _named(one: Finding, study: str) -> Finding:
    """A finding with the study in front of its place and its plot."""
    return replace(one, where=f"{study}, {one.where}", plot=f"{study}/{one.plot}")


def _located(name: str | Path) -> Path:
    """File of a study of one's own. Raises InvalidInput that says what there is."""
    try:
        return located(name, "study")
    except InvalidInput as error:
        if not lexists(name) and str(name) not in ready():
            known("NAME", str(name), [*studies(), ALL], str(error))
        raise


def _overview(findings: Sequence[Finding]) -> Iterator[dict]:
    """Number of findings of each verdict, for each claim and dimensionality."""
    verdicts: dict[tuple[str, str], list[Finding]] = {}
    for each in claimed(findings):
        verdicts.setdefault((each.claim.id, each.row["dimension"]), []).append(each)
    for (_, dimension), own in verdicts.items():
        counts = {name: sum(each.verdict == name for each in own) for name in VERDICTS if name != REPORTED}
        yield {"sentence": own[0].claim.sentence, "dimension": dimension, **counts}


def _numbered(number: int, judged: JudgedSeries) -> str:
    return f"{number}. {judged.series.title}"


def _section(judged: JudgedSeries) -> Iterator[Block]:
    """Figures of a series, its findings, points, and solves that failed."""
    series = judged.series
    yield from plots_of_series(judged)
    if judged.findings:
        yield Findings(judged.findings)
    else:
        yield Text("No claim can be judged on this series, or none is made of it.")
    yield Table(
        f"{series.folder}/points",
        points(judged.contacts),
        "Means over surfaces with intervals of 95 %.",
        long=True,
    )
    failed = failures(judged.contacts)
    if len(failed):
        yield Table(f"{series.folder}/failed", failed, f"{len(failed)} solves failed and are left out.", long=True)


def _asked(judged: JudgedSeries) -> Iterator[str]:
    """Lines on a series: scene, points, draws and grids; slopes and regime, which were measured."""
    series, scene = judged.series, judged.series.scene
    if series.note:
        yield series.note
    yield f"contact: {described(scene.indenter)}; {described(scene.elastomer)}; {described(scene.roughness)}"
    moved = "at rest"
    if series.speeds:
        kind = "rates of pressing in" if series.pressed_in else "speeds"
        moved = f"{len(series.speeds)} {kind}, {series.speeds[0]:.3g} to {series.speeds[-1]:.3g} m/s, and at rest"
    unit = {"load": "N", "depth": "m"}[series.prescribed]
    least, greatest = series.values[0], series.values[-1]
    yield f"{moved}; {len(series.values)} {series.prescribed}s, {least:.3g} to {greatest:.3g} {unit}"
    rough = series.grids[f"{series.name}/{ROUGH}"]
    for model in series.models:
        points = f" of {getattr(model.solver, 'points', 0)} points, also on half of them" if model.has_grid else ""
        yield f"{model.label}: {rough.told(model.name, model.draws)}{points if series.interval is None else ''}"
    yield from (each.claim for each in series.every_model if each.claim)
    for solver, dimension in judged.contacts.labels.items():
        answers = judged.contacts(solver)
        known = answers["rms_slope"].values if "rms_slope" in answers else np.array(np.nan)
        if np.isfinite(known).any():
            words = f"; {judged.laws[solver].words()}" if solver in judged.laws else ""
            yield f"{dimension}: rms slope {np.nanmean(known):.3g}{words}"
