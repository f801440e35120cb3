"""Page of a comparison below its answer: figures and tables of each series, and how it was solved."""

from collections.abc import Iterator, Sequence
from dataclasses import fields

import xarray

from scene import Scene
from scene.files.parts import said

from ...report.page import Block, Findings, Section, Table, Text
from ...statistics.finding import Finding
from . import plots
from .around import Around
from .rough import RoughSeries
from .series import Judged, Series

UNMATCHED = (
    "The roughness is a line in 1D and a surface in 3D. The rule of the method, "
    "C_1D = π q C_2D, ties their spectra; it keeps the rms height and the rms of the full "
    "gradient. Real contact is a length in 1D and an area in 3D, and no claim compares them."
)


def blocks(every: Sequence[Judged], several: Sequence[Finding], tree: xarray.DataTree) -> Iterator[Block]:
    """Findings on several series, then a section of each, then its tables."""
    if several:
        yield Section("Several together", [Findings(several)])
    data: list[Block] = []
    for judged in every:
        series, answers = judged.series, judged.answers
        shown: list[Block] = list(plots.of_series(judged, tree))
        if isinstance(series, RoughSeries):
            none = Text("No claim can be judged on this series.")
            shown.append(Findings(judged.findings) if judged.findings else none)
        if shown:
            yield Section(series.title, shown)
        data.append(Table(series.path("points"), answers.points, "Every point of every curve.", long=True))
        if len(failed := answers.failures):
            told = f"{len(failed)} solves without an answer."
            data.append(Table(series.path("failures"), failed, told, long=True))
        if isinstance(series, Around):
            told = "Advice of the trust map on cheap models, predicted."
            data.append(Table(series.path("trust"), series.advice.table(), told, long=True))
    yield Section("Data", data)


def setting(about: str, every: Sequence[Judged]) -> list[Block]:
    """What was asked, and the contacts of each series."""
    rough = any(isinstance(each.series, RoughSeries) for each in every)
    found: list[Block] = [Text(text) for text in (about, UNMATCHED if rough else "") if text]
    for each in every:
        lines = (f"- {line}" for line in _contacts(each.series, each))
        found.append(Section(f"Contacts: {each.series.title}", [Text("\n".join(lines))]))
    return found


def _contacts(series: Series, judged: Judged) -> Iterator[str]:
    """Scene in words, draws and grids of each model, regime, and notes."""
    parts = (getattr(series.scene, each.name) for each in fields(Scene) if each.name != "motion")
    yield from (said(part) for part in parts if part is not None)
    for name, drawn in series.drawn.items() if series.scene.roughness else ():
        for model, counts in drawn.counts.items():
            told = " and ".join(f"{count:,}" for count in counts)
            yield f"{name}, {series.models.labels[model]}: {told} {series.models[model].draws}"
    for each in series.models:
        if each.has_grid:
            yield f"{each.label}: {getattr(each.solver, 'points', 0)} points, and coarser grids"
    yield from (each.claim for each in getattr(series, "every_model", series.models) if each.claim)
    yield from (f"{series.models.labels[name]}: {each.words()}" for name, each in judged.laws.items())
    yield from series.remarks
