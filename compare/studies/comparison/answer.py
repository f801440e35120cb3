"""Answer of a comparison as tables: what each model finds of a scene, and what becomes of each claim."""

from collections.abc import Iterable, Mapping, Sequence
from math import isfinite
from typing import Any

import numpy as np
from pandas import DataFrame

from ...figures.prefixes import prefixed
from ...library.describe import conditions
from ...models.table import Model
from ...report.page import Table
from ...solving import words
from ...statistics.finding import REPORTED, UNDECIDED, Finding
from ...statistics.multilevel import MEANS, WORDS
from ...trustmap.verdict import CALLED, MULTIPLY, NONE, USE, Correction
from .answers import Answers
from .around import OWN, OWN_RATIOS, Around
from .claims import SHORT

APART = "map and means disagree"
UNITS = {"depth_reached": ("depth", "m"), "normal_force": ("force", "N"), "friction_coefficient": ("friction", "")}
ALL = "all"
MOST_NOTES = 4  # reasons of undecided claims that stand below a table


def scene_table(series: Around, answers: Answers, findings: Sequence[Finding]) -> Table:
    """What each model finds of the scene as it stands, their ratio, and what to do with 1D."""
    advice = series.advice
    rows: list[dict[str, Any]] = []
    drawn: dict[str, int] = {}
    for name in series.own_means:
        factor, unit, found = _numbers(series, answers, name)
        row: dict[str, Any] = {"": words.with_brackets(UNITS[name][0], unit)}
        for model, (value, low, high) in found.items():
            column = f"{model.label} ({model.name})" if model.label != model.name else model.label
            row[column] = words.interval(value * factor, low * factor, high * factor, 3)
        cheap = getattr(advice, WORDS[name]) if {"MDR", "BEM"} <= set(series.models.labels) else None
        for each in findings:
            if each.curve == series.place(OWN) and each.claim.id == OWN_RATIOS[name]:
                row[each.dimension] = words.found(each, 3)
                drawn |= each.drawn
                if cheap and each.dimension == "1D/3D" and _contradicts(each, cheap):
                    row["advice"] = f"{_advised(cheap, None)}; {APART}"
        if cheap:
            row.setdefault("advice", _advised(cheap, advice.law if cheap is advice.friction else None))
        rows.append(row)
    surfaces = ", ".join(f"{count} {words.DRAWS.get(name, 'surfaces')}" for name, count in drawn.items())
    title = ", ".join(filter(None, [series.title, conditions(series.case.motion), surfaces]))
    return Table(f"{series.folder}/answer", DataFrame(rows).fillna(""), title)


def _numbers(series, answers, name) -> tuple[float, str, Mapping[Model, tuple]]:
    """Means of a quantity by model with their intervals; the factor and the unit in which they read well.

    Of a history they are those where the reference has most of it.
    """
    models = answers.claiming(OWN, WORDS[name])
    every = {model: answers.interval(OWN, model.name, *MEANS[name]) for model in models}
    known = {model.name: np.abs(each.value) for model, each in every.items()}
    size = known.get(series.models.reference, next(iter(known.values())))
    at = np.unravel_index(np.argmax(np.nan_to_num(size)), size.shape)
    found = {model: tuple(map(float, each.at(at).ends)) for model, each in every.items()}
    unit = UNITS[name][1]
    factor, unit = prefixed([value for value, _, _ in found.values()], unit) if unit else (1.0, "")
    return factor, unit, found


def _advised(cheap: Correction, law: Correction | None) -> str:
    """What the trust map says of the answer of 1D."""
    if cheap.advice == NONE:
        return "none: " + cheap.reason
    if cheap.advice == USE:
        return "use 1D"
    if cheap.advice == MULTIPLY:
        other = f", or {CALLED[law.model]}" if law is not None and law.advice == USE else ""
        return f"multiply 1D by {cheap.times}{other}"
    return "solve in 3D"


def _contradicts(solved: Finding, foretold: Correction) -> bool:
    """Whether means over surfaces and what the trust map foretells of 1D have no ratio in common."""
    low, high = solved.interval
    return solved.draws > 0 and (low > foretold.high or high < foretold.low)


def claims_table(findings: Iterable[Finding], scenes: Mapping[str, str], name: str = "claims") -> Table:
    """A line a claim and scene: what it is tested against, what each model gives, and the verdict.

    scenes : places of a line by the beginning of the place of a finding; what holds in all of them is one line
    """
    lines: dict[tuple[str, str], list[Finding]] = {}
    for each in findings:
        if each.verdict != REPORTED and each.claim.id not in OWN_RATIOS.values():
            scene = next(
                (told for start, told in scenes.items() if f"{each.where}, ".startswith(f"{start}, ")), ""
            )
            lines.setdefault((_short(each), scene), []).append(each)
    for short in dict.fromkeys(short for short, _ in lines):
        own = {key: each for key, each in lines.items() if key[0] == short}
        if len(own) > 1 and all(each.verdict == words.HOLDS for found in own.values() for each in found):
            lines = {key: each for key, each in lines.items() if key not in own} | {
                (short, ALL): [each for found in own.values() for each in found]
            }
    order = {short: place for place, short in reversed([*enumerate(SHORT.values())])}
    ordered = sorted(lines.items(), key=lambda line: order.get(line[0][0], len(order)))
    frame = DataFrame([_line(*key, found) for key, found in ordered]).fillna("")
    columns = [each for each in ("claim", "scene", "tested", "verdict") if each in frame]
    models = [each for each in frame if each not in columns]
    frame = frame[[*columns[:-1], *models, *columns[-1:]]]
    if "scene" in frame and frame["scene"].nunique() == 1:
        frame = frame.drop(columns="scene")
    return Table(name, frame)


def _line(short: str, scene: str, findings: Sequence[Finding]) -> dict[str, str]:
    """One line of the table of claims."""
    by_model: dict[str, list[Finding]] = {}
    for each in findings:
        by_model.setdefault(each.dimension.partition("/")[0], []).append(each)
    tested = dict.fromkeys(filter(None, (words.tested(each.claim) for each in findings)))
    line = {"claim": short, "scene": scene, "tested": " | ".join(tested)}
    line |= {model: _cell(found) for model, found in by_model.items()}
    verdicts = [words.counted(found) for found in by_model.values()]
    return line | {"verdict": " | ".join(verdicts if len(set(verdicts)) > 1 else verdicts[:1])}


def _cell(findings: Sequence[Finding]) -> str:
    """A number with its interval, or the range of several."""
    known = [each for each in findings if isfinite(each.value)]
    if len(findings) == 1 or not known:
        return words.found(findings[0], 3) if known else "not known"
    claim, values = known[0].claim, [each.value for each in known]
    ends = [words.number(claim.scale * end(values), 3) for end in (min, max)]
    return words.amount(claim, " to ".join(dict.fromkeys(ends)))


def notes(findings: Iterable[Finding]) -> list[str]:
    """Why claims are undecided and what would decide them, a sentence a claim; of many those that stand first."""
    reasons: dict[str, list[Finding]] = {}
    for each in findings:
        if each.verdict == UNDECIDED:
            reasons.setdefault(_short(each), []).append(each)
    told = [f"Undecided: {short} ({_places(own)}): {own[0].why}." for short, own in reasons.items()]
    return told[:MOST_NOTES] + [f"Others undecided: {len(told) - MOST_NOTES}, see findings.csv."] * (
        len(told) > MOST_NOTES
    )


def _short(finding):
    """A claim in a few words; its sentence where it has none."""
    return SHORT.get(finding.claim.id, finding.claim.sentence)


def _places(findings):
    """The first place in words, and the number of others."""
    first, *others = findings
    place = f"{first.where}, {first.dimension}".replace(", 1D/3D", "")
    return f"{place}, and {len(others)} more" if others else place
