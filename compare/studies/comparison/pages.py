"""Page of a comparison below its answer: figures and tables of each series, and how it was solved."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields
from typing import Any

import numpy as np
import xarray
from pandas import DataFrame

from scene import Scene

from ...library.describe import described
from ...models.table import Models
from ...report.page import Block, Findings, Section, Table, Text
from ...solving.curve import Curve
from ...statistics.finding import Finding
from . import plots, tables
from .answers import Answers
from .around import SHARED, Around
from .rough import ROUGH, RoughSeries
from .series import Judged, Series
from .together import Member

Every = Sequence[tuple[Series, Answers, Judged]]
UNMATCHED = (
    "The roughness is a line in 1D and a surface in 3D. The rule of the method, "
    "C_1D = π q C_2D, ties their spectra; it keeps the rms height and the rms of the full "
    "gradient. Real contact is a length in 1D and an area in 3D, and no claim compares them."
)


def blocks(
    every: Every, members: Sequence[Member], several: Sequence[Finding], tree: xarray.DataTree
) -> Iterator[Block]:
    """Figures of several series, then a section of each, then its tables."""
    points = {series.name: (answers, tables.points(series, answers)) for series, answers, _ in every}
    together = list(plots.of_several([each for each, _, _ in every], members, points, several))
    if several or together:
        yield Section("Several together", [*together, *([Findings(several)] if several else [])])
    for series, answers, judged in every:
        own = points[series.name][1]
        shown: list[Block] = list(plots.of_series(series, answers, judged, own, tree))
        if isinstance(series, RoughSeries):
            none = Text("No claim can be judged on this series.")
            shown.append(Findings(judged.findings) if judged.findings else none)
        if shown:
            yield Section(series.title, shown)
    data = (each for series, answers, _ in every for each in _data(series, answers, points[series.name][1], tree))
    yield Section("Data", list(data))


def _data(series: Series, answers: Answers, points: DataFrame, tree: xarray.DataTree) -> Iterator[Block]:
    """Tables of a series that lie beside the page."""
    folder = f"{series.folder}/" if series.folder else ""
    if isinstance(series, Around):
        told = "Advice of the trust map on cheap models, predicted."
        yield Table(f"{folder}trust", series.advice.table(), told, long=True)
        spent = tree.children[series.folder].children["times"].to_dataset(inherit=False)
        yield Table(
            f"{folder}times",
            spent.to_dataframe().reset_index(),
            "Processor time of all solves, those of earlier runs included.",
        )
    yield Table(f"{folder}points", points, "Every point of every curve.", long=True)
    if len(failed := tables.failures(answers)):
        yield Table(f"{folder}failures", failed, f"{len(failed)} solves without an answer.", long=True)


def setting(about: str, every: Every) -> list[Block]:
    """What was asked, and the contacts of each series."""
    found: list[Block] = [Text(about)] if about else []
    rough = [each for each, _, _ in every if isinstance(each, RoughSeries)]
    found += [Text(UNMATCHED)] if rough else []
    for series, answers, judged in every:
        lines = list(_rough_lines(series, answers, judged) if isinstance(series, RoughSeries) else _lines(series))
        found.append(Section(f"Contacts: {series.title}", [_list(lines)]))
        if isinstance(series, Around) and series.case.departures:
            found.append(Section(f"Departures from the paper: {series.title}", [_list(series.case.departures)]))
    return found


def _lines(series: Any) -> Iterator[str]:
    """Scene in words, averages, grids and notes of a case."""
    parts = [(each.name, getattr(series.scene, each.name)) for each in fields(Scene)]
    yield from (f"{name}: {described(part)}" for name, part in parts if part is not None)
    averaged = _averaged(series.curves, series.models) if series.scene.roughness else "one smooth body"
    yield f"averaged: {averaged}"
    yield f"grids: {_grids_of(series.models)}"
    yield from (each.claim for each in series.models if each.claim)
    yield from series.case.notes


def _averaged(curves: Mapping[str, Curve], models: Models) -> str:
    """Numbers of draws of each model in words, by the grids that they are solved on."""
    shared = SHARED if set(curves) > {"own"} else {"": tuple(curves)}
    found = {}
    for name, names in shared.items():
        for own in [curves[each] for each in names if each in curves][:1]:
            told = [f"{in_words(own, each.name, each.draws)} in {each.label}" for each in models.drawn]
            found[name] = ", ".join(told)
    if len(set(found.values())) == 1:
        return found.popitem()[1]
    return "; ".join(f"{name}: {told}" for name, told in found.items())


def in_words(curve: Curve, model: str, word: str) -> str:
    """Numbers of a model's draws, with the points of their grids where these differ. word : in the plural"""
    counts = [len(each) for each in curve.strata(model)]
    if not curve.stratified(model):
        return f"{counts[0]} {word}"
    points = [str(getattr(solver, "points", "")) for solver in curve.levels[model].values()]
    on = [" and ".join(points[k : k + 2]) for k in range(len(counts))]
    return ", ".join(f"{count:,} {word} on {grids} points" for count, grids in zip(counts, on, strict=True))


def _grids_of(models: Models) -> str:
    """Points of each model in words."""
    own = {"MDR": "points in 1D", "BEM": "a side in 3D"}
    told = [
        f"{each.solver.points} {own.get(each.name, f'points of {each.label}')}"
        for each in models
        if hasattr(each.solver, "points")
    ]
    return f"{', '.join(told)}, and half as many" if told else "none"


def _rough_lines(series: RoughSeries, answers: Answers, judged: Judged) -> Iterator[str]:
    """Lines on a series: scene, points, draws and grids; slopes and regime, which were measured."""
    scene, laws = series.scene, judged.laws
    if series.note:
        yield series.note
    yield f"contact: {described(scene.indenter)}; {described(scene.elastomer)}; {described(scene.roughness)}"
    moved = "at rest"
    if series.speeds:
        kind = "rates of pressing in" if series.pressed_in else "speeds"
        moved = f"{len(series.speeds)} {kind}, {series.speeds[0]:.3g} to {series.speeds[-1]:.3g} m/s, and at rest"
    unit = {"load": "N", "depth": "m"}[series.prescribed]
    least, *_, greatest = series.values[0], series.values[-1]
    yield f"{moved}; {len(series.values)} {series.prescribed}s, {least:.3g} to {greatest:.3g} {unit}"
    for model in series.models:
        points = f" of {getattr(model.solver, 'points', 0)} points, also on half of them" if model.has_grid else ""
        told = in_words(series.curves[ROUGH], model.name, model.draws)
        yield f"{model.label}: {told}{points if series.interval is None else ''}"
    yield from (each.claim for each in series.every_model if each.claim)
    for model in series.models:
        own = answers(ROUGH, model.name)
        known = own["rms_slope"].values if "rms_slope" in own else np.array(np.nan)
        if np.isfinite(known).any():
            words = f"; {laws[model.name].words()}" if model.name in laws else ""
            yield f"{model.label}: rms slope {np.nanmean(known):.3g}{words}"


def _list(lines: Sequence[str]) -> Text:
    return Text("\n".join(f"- {line}" for line in lines))
