"""The page of a study: verdicts, figures, tables, and what cannot be matched between the dimensionalities."""

from collections.abc import Mapping
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
from ..pointregime import PointRegime
from ..publish import Drawn, draw, machine, render, versions, write_csv, write_json, write_text
from ..report import described, slug
from ..sweep import Swept
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

    name : of its folder and its anchor; empty of the study
    number : of the series, from 1
    findings : its claims
    figures : by name
    tables : names of the CSV files in its folder
    """

    name: str
    number: int
    findings: tuple[Finding, ...]
    figures: Mapping[str, Drawn]
    tables: frozenset[str]

    @property
    def folder(self) -> str:
        """Before the name of a file."""
        return f"{self.name}/" if self.name else ""

    def anchor(self, figure: str) -> str:
        """Of a figure on the page."""
        return f"{self.name}-{figure}" if self.name else figure

    def shown(self, finding: Finding) -> str:
        """Link to the figure of a finding, or to the table of all findings where there is none."""
        return f"#{self.anchor(finding.figure)}" if finding.figure in self.figures else FINDINGS

    def table(self, finding: Finding) -> str:
        """Link to the numbers of that figure, or to the table of all findings."""
        name = f"{finding.figure}.csv"
        return self.folder + name if name in self.tables else FINDINGS

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


def write_study(folder: Path, judged: JudgedStudy, swept: Swept) -> Path:
    """Write page, figures and tables below a folder, a subfolder a series, and return the path of the page."""
    folder.mkdir(parents=True, exist_ok=True)
    whole = Part("", 0, judged.findings, *_drawn(folder, OF_THE_STUDY, judged))
    parts = [_part(folder, number, each) for number, each in enumerate(judged.series, 1)]
    write_csv(folder / FINDINGS, list(tableau.rows(judged)))
    write_json(folder / MANIFEST, manifest(judged, swept))
    write_text(folder / PAGE, page(judged, whole, parts, swept))
    return folder / PAGE


def page(judged: JudgedStudy, whole: Part, parts: list[Part], swept: Swept) -> str:
    """The page as HTML; figures are inside, tables are linked beside it."""
    verdicts = [finding.verdict for finding in tableau.every(judged)]
    return render(
        "study.html",
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
        findings=FINDINGS,
        swept=swept,
    )


def slopes(each: JudgedSeries) -> dict[str, float]:
    """rms slope by dimension, as each solver measures it, mean over the surfaces; those that are known."""
    found = {}
    for solver, dimension in DIMENSIONS.items():
        answers = each.solved(solver, ROUGH) or each.solved(solver, REST)
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


def manifest(judged: JudgedStudy, swept: Swept) -> dict:
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


def _part(folder, number, each: JudgedSeries):
    """Write what belongs to one series into its subfolder."""
    name = slug(each.solved.series.name)
    below = folder / name
    below.mkdir(parents=True, exist_ok=True)
    write_csv(below / POINTS, points.table(each.solved))
    # Of an earlier run in which more failed.
    (below / FAILED).unlink(missing_ok=True)
    if failed := failures(each):
        write_csv(below / FAILED, failed)
    return Part(name, number, each.findings, *_drawn(below, OF_A_SERIES, each))


def _drawn(folder, modules, data):
    """Figures by name, and the names of the tables beside them."""
    found = {module: figure for module in modules if (figure := draw(folder, module, data))}
    tables = frozenset(f"{sheet}.csv" for module in found for sheet in module.sheets(data))
    return {figure.name: figure for figure in found.values()}, tables


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
    first = series.scene.roughness.seed if series.scene.roughness else None
    drawn = {} if first is None else {"MDR": series.profiles, "BEM": series.surfaces}
    return {
        "name": series.name,
        "title": series.title,
        "scene": asdict(series.scene),
        "speeds": series.speeds,
        "presses": series.presses,
        "settings": {"MDR": asdict(series.mdr), "BEM": asdict(series.bem)},
        "seeds": {solver: list(range(first, first + count)) for solver, count in drawn.items()},
        "grids": {"/".join(key): answers.points for key, answers in each.solved.answers.items()},
        "processor_seconds": seconds(each),
        "failures": failures(each),
    }
