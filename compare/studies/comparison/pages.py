"""Page of a comparison below its answer: figures and tables of each series, and how it was solved."""

from collections.abc import Iterator, Sequence
from dataclasses import fields
from functools import partial
from math import nan

import xarray
from pandas import DataFrame, concat

from scene import Scene

from ...library.describe import described
from ...report.page import Block, Findings, Section, Table, Text
from ...statistics import means
from ...statistics.finding import Finding
from . import plots
from .answers import Answers
from .around import Around
from .laws import regimes
from .measures import CONTACT
from .rough import ROUGH, RoughSeries
from .series import Judged, Series
from .together import Member

Every = Sequence[tuple[Series, Answers, Judged, DataFrame]]  # the points of each series last
# Ratios of a rough point, see `regime.ratios`.
GROUPS = (
    "depth_over_height",
    "shortest_in_contact",
    "pressure_over_slope",
    "memory_over_contact",
    "memory_over_shortest",
    "contact_fraction",
    "contact_over_period",
    "macro_over_rough",
)
UNMATCHED = (
    "The roughness is a line in 1D and a surface in 3D. The rule of the method, "
    "C_1D = π q C_2D, ties their spectra; it keeps the rms height and the rms of the full "
    "gradient. Real contact is a length in 1D and an area in 3D, and no claim compares them."
)


def blocks(
    every: Every, members: Sequence[Member], several: Sequence[Finding], tree: xarray.DataTree
) -> Iterator[Block]:
    """Figures of several series, then a section of each, then its tables."""
    points = {series.name: (answers, each) for series, answers, _, each in every}
    together: list[Block] = list(plots.of_several([row[0] for row in every], members, points, several))
    if several or together:
        yield Section("Several together", [*together, *([Findings(several)] if several else [])])
    data: list[Block] = []
    for series, answers, judged, own in every:
        shown: list[Block] = list(plots.of_series(series, answers, judged, own, tree))
        if isinstance(series, RoughSeries):
            none = Text("No claim can be judged on this series.")
            shown.append(Findings(judged.findings) if judged.findings else none)
        if shown:
            yield Section(series.title, shown)
        data.append(Table(series.path("points"), own, "Every point of every curve.", long=True))
        if len(failed := failures(answers)):
            told = f"{len(failed)} solves without an answer."
            data.append(Table(series.path("failures"), failed, told, long=True))
        if isinstance(series, Around):
            told = "Advice of the trust map on cheap models, predicted."
            data.append(Table(series.path("trust"), series.advice.table(), told, long=True))
    yield Section("Data", data)


def setting(about: str, every: Every) -> list[Block]:
    """What was asked, and the contacts of each series."""
    rough = any(isinstance(row[0], RoughSeries) for row in every)
    found: list[Block] = [Text(text) for text in (about, UNMATCHED if rough else "") if text]
    for series, _, judged, _ in every:
        lines = (f"- {line}" for line in _contacts(series, judged))
        found.append(Section(f"Contacts: {series.title}", [Text("\n".join(lines))]))
    return found


def _contacts(series: Series, judged: Judged) -> Iterator[str]:
    """Scene in words, draws and grids of each model, regime, and notes."""
    parts = (getattr(series.scene, each.name) for each in fields(Scene) if each.name != "motion")
    yield from (described(part) for part in parts if part is not None)
    for name, drawn in series.drawn.items() if series.scene.roughness else ():
        for model, counts in drawn.counts.items():
            told = " and ".join(f"{count:,}" for count in counts)
            yield f"{name}, {series.models.labels[model]}: {told} {series.models[model].draws}"
    for each in series.models:
        if each.has_grid:
            yield f"{each.label}: {getattr(each.solver, 'points', 0)} points, and coarser grids"
    yield from (each.claim for each in series.every_model if each.claim)
    yield from (f"{series.models.labels[name]}: {each.words()}" for name, each in judged.laws.items())
    yield from series.remarks


def points(series: Series, answers: Answers) -> DataFrame:
    """A row for each curve, model, speed, and load or depth: means, intervals of 95 %, dimensionless groups."""
    every = _stacked(answers, partial(_points, series, answers))
    first = [name for name in ("curve", "model", "points", "speed", "load", "depth") if name in every]
    return every[[*first, *every.columns.difference(first, sort=False)]]


def _points(series, answers, curve, model):
    dataset = answers.all_levels(curve, model)
    known = {each.name: each.draws for each in series.models}
    touching = CONTACT[known.get(model, "none")]
    found = means.means(dataset.assign(contact=dataset[touching]) if touching in dataset else dataset)
    if isinstance(series, RoughSeries):
        rough = curve == ROUGH and {"rms_slope", "pixel"} <= {*dataset.data_vars}
        groups = regimes(series, answers(curve, model)) if rough else {}
        found = found.assign(**{name: groups[name].ravel() if groups else nan for name in GROUPS})
    return found


def failures(answers: Answers) -> DataFrame:
    """Every solve that failed, with its reason."""
    return _stacked(answers, lambda *place: means.failures(answers.all_levels(*place)))


def _stacked(answers, table):
    """Tables of every model on every curve, one below the other, with both names in the first columns."""
    every = ((name, model) for name, each in answers.curves.items() for model in each["model"].values.tolist())
    frames = [DataFrame({"curve": place[0], "model": place[1]} | dict(table(*place))) for place in every]
    return concat([each for each in frames if len(each)] or frames[:1], ignore_index=True)
