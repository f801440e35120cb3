"""Page of a comparison: the answer as tables, figures and tables of each series, and how it was solved."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import fields
from math import isfinite, nan
from typing import Any

import numpy as np
import xarray
from pandas import DataFrame

from scene import Scene
from scene.scene import described

from ...figures.style import prefixed
from ...report.page import Block, Findings, Section, Table, Text
from ...solving import words
from ...solving.task import conditions
from ...statistics.finding import BOTH, REPORTED, UNDECIDED, Finding
from ...statistics.means import ENDS
from ...statistics.multilevel import WORDS
from ...trustmap.verdict import Correction
from . import plots
from .around import OWN, OWN_RATIOS, Around
from .claims import SHORT
from .rough import RoughSeries
from .series import Judged, Series

UNITS = {"depth_reached": "m", "normal_force": "N"}
MOST_NOTES = 4  # reasons of undecided claims that stand below a table


def scene_table(judged: Judged) -> Table:
    """Table of the answer: each model's numbers of the scene, their ratio, and what to do with 1D.

    Of a history it is the point where the reference, else the first model, has most.
    """
    series, answers = judged.series, judged.answers
    points, rows, names = answers.points, list[dict[str, Any]](), series.models.labels
    own = points[points["curve"] == OWN].set_index("model")
    for name in series.own_means:
        models = [each.name for each in answers.claiming(OWN, WORDS[name])]
        ends = own[[f"{name}{end}" for end in ENDS]]
        first = series.models.reference if series.models.reference in models else models[0]
        at = int(np.argmax(np.nan_to_num(ends.loc[[first], f"{name}_mean"].abs())))
        numbers = {each: ends.loc[[each]].iloc[at].to_numpy() for each in models}
        values = [each[0] for each in numbers.values()]
        factor, unit = prefixed(values, UNITS[name]) if name in UNITS else (1.0, "")
        place = series.place(OWN), OWN_RATIOS[name]
        ratios = {each.dimension: each for each in judged.findings if (each.curve, each.claim.id) == place}
        row = {"": WORDS[name] + (f" [{unit}]" if unit else "")}
        for model, found in numbers.items():
            column = model if names[model] == model else f"{names[model]} ({model})"
            value, low, high = (factor * found).tolist()
            row[column] = words.interval(value, low, high, 3)
        row |= {pair: words.found(each, 3) for pair, each in ratios.items()}
        if {"MDR", "BEM"} <= {*names} and (cheap := getattr(series.advice, WORDS[name])):
            row["advice"] = _advised(cheap, ratios.get(BOTH))
        rows.append(row)
    drawn = series.drawn["sliding"].counts if series.curves[OWN].random else {}
    surfaces = (f"{sum(counts)} {series.models[name].draws}" for name, counts in drawn.items())
    title = ", ".join(filter(None, [series.title, conditions(series.case.motion), *surfaces]))
    return Table(series.path("answer"), DataFrame(rows).fillna(""), title)


def scene_line(judged: Judged) -> str:
    """First row of the table of the answer in a line."""
    row = scene_table(judged).frame.iloc[0]
    return f"{judged.series.name}: " + ", ".join(f"{name} {text}".strip() for name, text in row.items())


def _advised(cheap: Correction, solved: Finding | None) -> str:
    """Advice of the trust map on the answer of 1D, and whether means over surfaces contradict it."""
    low, high = solved.interval if solved is not None and solved.draws else (nan, nan)
    apart = low > cheap.high or high < cheap.low
    return str(cheap).partition(". ")[0] + ("; map and means disagree" if apart else "")


def claims_table(findings: Iterable[Finding], scenes: Iterable[str]) -> Table:
    """A line a claim and scene: what it is tested against, what each model gives, and the verdict.

    scenes : by the beginning of the place of a finding
    """
    caption = [each for each in findings if each.verdict != REPORTED and each.claim.id not in OWN_RATIOS.values()]
    places = [[one for one in scenes if f"{each.where}, ".startswith(f"{one}, ")] for each in caption]
    frame = DataFrame(
        {"claim": map(_short, caption), "scene": [(*own, "")[0] for own in places], "finding": caption}
    )
    frame["model"] = [each.dimension.partition("/")[0] for each in caption]
    order = {short: place for place, short in reversed([*enumerate(SHORT.values())])}
    frame = frame.sort_values("claim", kind="stable", key=lambda own: own.map(order).fillna(len(order)))
    lines = [_line(short, scene, own) for (short, scene), own in frame.groupby(["claim", "scene"], sort=False)]
    table = DataFrame(lines).fillna("")
    if lines:
        table["verdict"] = table.pop("verdict")  # behind all models
        table = table if table["scene"].nunique() > 1 else table.drop(columns="scene")
    return Table("claims", table)


def _line(short: str, scene: str, own: DataFrame) -> dict[str, str]:
    """One line of the table of claims."""
    models = own.groupby("model", sort=False)["finding"].agg(list)
    tested = dict.fromkeys(filter(None, (words.tested(each.claim) for each in own["finding"])))
    verdicts = [*map(words.counted, models)]
    line = {"claim": short, "scene": scene, "tested": " | ".join(tested), **models.map(_cell)}
    return line | {"verdict": " | ".join(verdicts if len(set(verdicts)) > 1 else verdicts[:1])}


def _cell(findings: Sequence[Finding]) -> str:
    """A number with its interval, or the range of several."""
    claim, values = findings[0].claim, [each.value for each in findings if isfinite(each.value)]
    if len(findings) == 1 or not values:
        return words.found(findings[0], 3)
    ends = [words.number(claim.scale * end(values), 3) for end in (min, max)]
    return words.amount(claim, " to ".join(dict.fromkeys(ends)))


def notes(findings: Iterable[Finding]) -> list[str]:
    """Why claims are undecided and what would decide them, a sentence a claim; of many those that stand first."""
    reasons: dict[str, list[Finding]] = {}
    for each in findings:
        if each.verdict == UNDECIDED:
            reasons.setdefault(_short(each), []).append(each)
    notes = [f"Undecided: {short} ({_places(own)}): {own[0].why}." for short, own in reasons.items()]
    others = len(notes) - MOST_NOTES
    return notes[:MOST_NOTES] + [f"Others undecided: {others}, see findings.csv."] * (others > 0)


def _short(finding):
    """A claim in a few words; its sentence where it has none."""
    return SHORT.get(finding.claim.id, finding.claim.sentence)


def _places(findings):
    """The first place in words, and the number of others."""
    first, *others = findings
    place = f"{first.where}, {first.dimension}".replace(", 1D/3D", "")
    return f"{place}, and {len(others)} more" if others else place


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
            caption = f"{len(failed)} solves without an answer."
            data.append(Table(series.path("failures"), failed, caption, long=True))
        if isinstance(series, Around):
            caption = "Advice of the trust map on cheap models, predicted."
            data.append(Table(series.path("trust"), series.advice.table(), caption, long=True))
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
    yield from (described(part) for part in parts if part is not None)
    for name, drawn in series.drawn.items() if series.scene.roughness else ():
        for model, counts in drawn.counts.items():
            drawn_counts = " and ".join(f"{count:,}" for count in counts)
            yield f"{name}, {series.models.labels[model]}: {drawn_counts} {series.models[model].draws}"
    for each in series.models:
        if each.has_grid:
            yield f"{each.label}: {getattr(each.solver, 'points', 0)} points, and coarser grids"
    yield from (each.claim for each in getattr(series, "every_model", series.models) if each.claim)
    yield from (f"{series.models.labels[name]}: {each.words()}" for name, each in judged.laws.items())
    yield from series.remarks
