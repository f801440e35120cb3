"""The page of a study: verdicts, figures, tables, and what cannot be matched between the dimensionalities."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from ..figures import (
    study_collapse,
    study_depth,
    study_effects,
    study_family,
    study_levels,
    study_pressed_in,
    study_shifts,
    study_verdicts,
)
from ..finding import Finding
from ..glossary import Definitions
from ..illustration import Illustration, illustrate, sheets_of
from ..pointregime import PointRegime
from ..publish import machine, render, versions, write_csv, write_json, write_text
from ..report import described, slug
from ..sheets import Sheet, reading
from ..sweep import SweepResult
from ..verdict import DIMENSIONS
from . import points, tableau
from .judgement import JudgedSeries, JudgedStudy
from .question import BOTH
from .series import REST, ROUGH
from .wording import claimed, errors, number, written

PAGE, MANIFEST, FINDINGS, POINTS, FAILED = (
    "study.html",
    "manifest.json",
    "findings.csv",
    "points.csv",
    "failed.csv",
)
OF_THE_STUDY = (study_verdicts, study_family)
OF_A_SERIES = (study_effects, study_collapse, study_shifts, study_levels, study_depth, study_pressed_in)


@dataclass(frozen=True)
class Part:
    """One series on the page, or what belongs to all of them.

    name : of its folder; empty of the study
    number : of the series, from 1
    findings : its claims
    figures : by name
    points : every point and what failed, of a series
    rows : of its findings, in the table of all, from 1
    """

    name: str
    number: int
    findings: tuple[Finding, ...]
    figures: Mapping[str, Illustration]
    points: tuple[Sheet, ...]
    rows: range

    @property
    def anchor(self) -> str:
        """On the page."""
        return f"series-{self.name}" if self.name else "all-series"

    def row(self, finding: Finding) -> int:
        """Of a finding in the table of all."""
        return self.rows[self.findings.index(finding)]

    def shown(self, finding: Finding) -> str | None:
        """Anchor of the figure of a finding; None where there is none."""
        figure = self.figures.get(finding.figure)
        return figure.anchor if figure else None

    def behind(self, finding: Finding) -> Sequence[Sheet]:
        """The data of that figure, or every point where it has none."""
        figure = self.figures.get(finding.figure)
        return (figure.sheets[:1] if figure else ()) or self.points[:1]

    @property
    def claims(self) -> list[tuple[str, dict[str, Finding]]]:
        """Each claim with its findings by dimension."""
        alone, both = tableau.claims(self.findings)
        kinds = [(claim, tableau.DIMENSIONS) for claim in alone] + [(claim, (BOTH,)) for claim in both]
        return [
            (
                claim,
                {
                    each.dimension: each
                    for each in self.findings
                    if each.claim == claim and each.dimension in dimensions
                },
            )
            for claim, dimensions in kinds
        ]


def write_study(folder: Path, judged: JudgedStudy, swept: SweepResult) -> Path:
    """Write page, figures and tables below a folder, a subfolder a series, and return the path of the page."""
    folder.mkdir(parents=True, exist_ok=True)
    write_csv(folder / FINDINGS, list(tableau.rows(judged)))
    parts, first = [], 1
    for place, each in enumerate(judged.series, 1):
        parts.append(_part(folder, place, each, first))
        first += len(each.findings)
    rows = range(first, first + len(judged.findings))
    whole = Part("", 0, judged.findings, _drawn(folder, folder, OF_THE_STUDY, judged, ""), (), rows)
    findings = Sheet.read(folder, folder / FINDINGS, "Findings")
    write_json(folder / MANIFEST, manifest(judged, swept))
    write_text(folder / PAGE, page(judged, whole, parts, findings, swept))
    return folder / PAGE


def page(judged: JudgedStudy, whole: Part, parts: list[Part], findings: Sheet, swept: SweepResult) -> str:
    """The page as HTML that needs nothing else."""
    verdicts = [finding.verdict for finding in tableau.every(judged)]
    drawn = [figure for part in (whole, *parts) for figure in part.figures.values()]
    return render(
        "study.html",
        title=judged.study.title,
        contents=_contents(whole, parts, judged),
        judged=judged,
        whole=whole,
        parts=list(zip(parts, judged.series, strict=True)),
        overview=_overview(judged, whole, parts),
        verdicts={verdict: verdicts.count(verdict) for verdict in tableau.VERDICTS},
        dimensions=DIMENSIONS,
        described=described,
        alone=len(parts) == 1 and not whole.findings,
        written=written,
        errors=errors,
        claimed=claimed,
        number=number,
        slopes=slopes,
        regime=regime,
        failures=failures,
        seconds=seconds,
        findings=findings,
        sheets=[findings, *(sheet for part in parts for sheet in part.points), *sheets_of(drawn)],
        definitions=Definitions(),
        **reading(),
        swept=swept,
    )


def slopes(each: JudgedSeries) -> dict[str, float]:
    """rms slope by dimension, as each solver measures it, mean over the surfaces; those that are known."""
    found = {}
    for solver, dimension in DIMENSIONS.items():
        answers = each.solved.get(solver, ROUGH) or each.solved.get(solver, REST)
        known = answers.measures.get("rms_slope", np.array(np.nan)) if answers else np.array(np.nan)
        if np.isfinite(known).any():
            found[dimension] = float(np.nanmean(known))
    return found


def regime(each: JudgedSeries, solver: str) -> PointRegime | None:
    """Where the rough points of a solver lie; None of none."""
    return each.laws[solver].regime if each.laws else points.regime(each.solved, solver)


def failures(each: JudgedSeries) -> list[dict]:
    """Every solve that failed, with its reason."""
    return [
        {"body": key.body, "grid": key.grid, "points": answers.points, "solve": what, "reason": reason}
        for key, answers in each.solved.answers.items()
        for what, reason in answers.reasons
    ]


def seconds(each: JudgedSeries) -> dict[str, float]:
    """Processor time by dimension [s]."""
    return {
        dimension: sum(answers.seconds for key, answers in each.solved.answers.items() if key.solver == solver)
        for solver, dimension in DIMENSIONS.items()
    }


def manifest(judged: JudgedStudy, swept: SweepResult) -> dict:
    """What was solved with what, and every finding."""
    return {
        "versions": versions(),
        "platform": machine(),
        "tasks": {"solved": swept.solved, "reused": swept.reused},
        "wall_seconds": swept.seconds,
        "study": {"name": judged.name, "title": judged.study.title, "size": asdict(judged.size)},
        "series": [_account(each) for each in judged.series],
        "findings": list(tableau.rows(judged)),
    }


def _part(folder, number, each: JudgedSeries, first):
    """Write what belongs to one series into its subfolder; first is the row of its first finding."""
    series = each.solved.series
    name = slug(series.name)
    below = folder / name
    below.mkdir(parents=True, exist_ok=True)
    write_csv(below / POINTS, points.table(each.solved))
    # Of an earlier run in which more failed.
    (below / FAILED).unlink(missing_ok=True)
    data = [Sheet.read(folder, below / POINTS, f"Points, {series.title}")]
    if failed := failures(each):
        write_csv(below / FAILED, failed)
        data.append(Sheet.read(folder, below / FAILED, f"Failed solves, {series.title}"))
    figures = _drawn(folder, below, OF_A_SERIES, each, series.title)
    return Part(name, number, each.findings, figures, tuple(data), range(first, first + len(each.findings)))


def _drawn(root, below, modules, data, title):
    """Figures by name."""
    drawn = (illustrate(root, below, module, data, of=title) for module in modules)
    return {figure.name: figure for figure in drawn if figure}


def _contents(whole, parts, judged):
    """Anchors and titles of the page, in its order."""
    found = [("summary", "What is claimed and what is found"), ("asked", "What was asked")]
    found.append(("unmatched", "What cannot be matched between the dimensionalities"))
    if whole.findings or whole.figures:
        found.append((whole.anchor, "All series together"))
    titles = (
        f"{part.number}. {each.solved.series.title}" for part, each in zip(parts, judged.series, strict=True)
    )
    return found + [(part.anchor, title) for part, title in zip(parts, titles, strict=True)]


def _overview(judged, whole, parts):
    """Each claim with, by dimension, the parts of each verdict."""
    every = [*parts, whole]
    alone, both = tableau.claims(tableau.every(judged))
    rows = []
    for claim in (*alone, *both):
        cells = {}
        for dimension in (*tableau.DIMENSIONS, BOTH):
            met = [
                (part, found)
                for part in every
                for found in part.findings
                if (found.claim, found.dimension) == (claim, dimension)
            ]
            verdicts = {
                verdict: [part for part, found in met if found.verdict == verdict] for verdict in tableau.VERDICTS
            }
            cells[dimension] = {verdict: where for verdict, where in verdicts.items() if where}
        rows.append((claim, cells))
    return rows


def _account(each: JudgedSeries):
    series = each.solved.series
    rough = series.scene.roughness
    drawn = {"MDR": series.profiles, "BEM": series.surfaces} if rough else {}
    return {
        "name": series.name,
        "title": series.title,
        "scene": asdict(series.scene),
        "speeds": series.speeds,
        "presses": series.presses,
        "settings": {"MDR": asdict(series.mdr), "BEM": asdict(series.bem)},
        "seeds": {solver: list(range(rough.seed, rough.seed + count)) for solver, count in drawn.items()},
        "grids": {"/".join(key): answers.points for key, answers in each.solved.answers.items()},
        "processor_seconds": seconds(each),
        "failures": failures(each),
    }
