"""Comparison: scenes on their curves by several models, what is claimed of them, and what becomes of it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import xarray

from scene import notes
from scene.result import labelled, provenance

from ...report.page import Page, Table
from ...solving.continuation import by_contact
from ...solving.curve import Curve
from ...solving.task import Outcome, SceneTask, Task
from ...statistics.finding import Finding
from ..study import Judgement, Study
from . import pages
from .around import OWN, Around
from .pages import claims_table, scene_line, scene_table
from .pages import notes as open_claims
from .rough import RoughSeries
from .series import Counts, Judged, Series
from .sweep import SweepSeries
from .together import alike, together

FIELDS = "fields"


@dataclass(frozen=True)
class Comparison(Study):
    """Series of scenes, each on its curves, by the models that are compared.

    series : scenes with their curves
    command, title, about, place, reason : of the command that asks, see `Study`; stated : its inputs
    alone : whether scenes are solved as they stand, and no curves around them yet
    """

    series: tuple[Series, ...]
    command: str = "run"  # type: ignore[misc]
    title: str = "One dimension against three"
    about: str = ""
    place: str = ""
    stated: Mapping[str, Any] = field(default_factory=dict)
    reason: str = Study.reason
    alone: bool = False

    @property
    def inputs(self) -> Mapping[str, Any]:
        return self.stated

    def grids(self) -> Mapping[str, Curve]:
        """Curves of every series, by "series/curve"."""
        return {
            each.path(name): curve
            for each in self.series
            for name, curve in each.curves.items()
            if name == OWN or not self.alone
        }

    @cached_property
    def doubts(self) -> tuple[str, ...]:
        """Doubts about every scene and the corners of its curves, with its name where there are several."""
        found = {each.name: each.doubts for each in self.series}
        named = len(self.series) > 1
        return tuple(f"{name}: {each}" if named else each for name, doubts in found.items() for each in doubts)

    @cached_property
    def notes(self) -> tuple[str, ...]:
        """Notes on what was read for the scenes."""
        return tuple(dict.fromkeys(note for each in self.series for note in notes(each.scene)))

    @property
    def own(self) -> Sequence[SceneTask]:
        return [contact for each in self.series for contact in each.own]

    @property
    def first(self) -> "Comparison":
        """The comparison of scenes as they stand, which are solved before the curves around them."""
        return replace(self, alone=bool(self.own) and len(self.grids()) > len(self.series))

    @property
    def rest(self) -> "Comparison | None":
        return replace(self, alone=False) if self.alone else None

    def answers(self, outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
        """A Dataset for each curve, and the fields of each scene's own contact."""
        tree, outcomes = super().answers(outcomes), by_contact(outcomes)
        for each in self.series:
            below = tree[each.folder] if each.folder else tree
            below.attrs |= {"title": each.title, "prescribed": each.scene.motion.pressed_by}
            if isinstance(each, Around):
                for model, kept in each.curves[OWN].fields(outcomes).items():
                    fields = labelled(kept, each.scene.indenter.type).assign_attrs(provenance(each.scene))
                    below[f"{FIELDS}/{model}"] = xarray.DataTree(fields)
        return tree

    def more(self, answers: xarray.DataTree, findings: Sequence[Finding]) -> "Comparison | None":
        """The comparison with the surfaces that open claims and wide intervals ask for; None where none does.

        Where no curve was solved yet it is the one with curves, and its reason has the answers of the scenes.
        """
        sampled = [each for each in self.series if each.sampled]
        asked = {each.name: each.more(each.answers(answers), findings) for each in sampled}
        for names in alike([each for each in self.series if each.name in asked]):
            asked |= dict.fromkeys(names, _most([asked[name] for name in names]))
        if all(asked.get(each.name, each.counts) == each.counts for each in self.series):
            own = [scene_line(Judged(each, each.answers(answers), findings)) for each in self.series if self.alone]
            return self.rest and replace(self.rest, reason="\n".join([*own, "the curves around"]))
        series = tuple(replace(s, strata=asked.get(s.name, s.strata)) for s in self.series)  # type: ignore[type-var]
        return replace(self, series=series, reason=Study.reason)

    def judge(self, answers: xarray.DataTree) -> Judgement:
        every = []
        for series in self.series:
            judged = series.judge(series.answers(answers))
            every.append(replace(judged, findings=[*map(series.with_remedy, judged.findings)]))
        members = [each for each in every if each.laws and isinstance(each.series, RoughSeries)]
        by_family = {each.series.family: each.series for each in members}
        several = [by_family[each.curve].with_remedy(each) if each.curve else each for each in together(members)]
        findings = [*(found for each in every for found in each.findings), *several]
        wide = (why for each in every if each.series.sampled for why in each.series.unreached(each.answers))
        setting = pages.setting(self.about, every)
        return Compared(findings, [*open_claims(findings), *wide], None, setting, (), every, several, answers)


@dataclass(frozen=True)
class Compared(Judgement):
    """What a comparison comes to; its tables and figures are made with the page, and not for each round.

    every : each series as judged; several : findings on several of them; tree : their answers
    """

    every: Sequence[Judged] = ()
    several: Sequence[Finding] = ()
    tree: xarray.DataTree = field(default_factory=xarray.DataTree)

    def page(self, title: str, answers: xarray.DataTree) -> Page:
        opening = [table for each in self.every for table in opening_of(each)]
        scenes = [each.series.name for each in self.every if isinstance(each.series, Around)]
        claims = claims_table(self.findings, scenes)
        opening += [claims] if len(claims.frame) else []
        blocks = list(pages.blocks(self.every, self.several, self.tree))
        return Judgement(self.findings, self.answer, blocks, self.setting, opening).page(title, answers)


def opening_of(judged: Judged) -> Sequence[Table]:
    """Tables that answer what was asked of a scene; none of a series of a study."""
    if isinstance(judged.series, Around):
        return [scene_table(judged)]
    return [*judged.series.tables(judged)] if isinstance(judged.series, SweepSeries) else []


def _most(counts: Sequence[Mapping[str, Counts]]) -> dict[str, Counts]:
    """Numbers of surfaces that are enough for all of some series, on the levels that all of them have."""
    return {
        shared: {
            model: tuple(max(level) for level in zip(*(each[shared][model] for each in counts), strict=False))
            for model in counts[0][shared]
        }
        for shared in counts[0]
    }
