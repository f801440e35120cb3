"""The judge's studies at standard size: writes docs/study.md, with figures and tables in docs/study/.

The same is `crosscheck study NAME --size standard`, which writes a page to read with every figure of every series.
What has been solved once is in docs/study/solved; from nothing it takes some hours on two cores.
"""

from collections.abc import Iterator
from dataclasses import replace
from math import isfinite, isnan, nan, pi
from pathlib import Path

from rich.console import Console
from study_answer import answer
from tables import table

from bem3d import BEM
from compare.figures import (
    study_collapse,
    study_depth,
    study_family,
    study_levels,
    study_pressed_in,
    study_verdicts,
)
from compare.finding import Finding
from compare.paper import parameters
from compare.progress import watch
from compare.publish import draw, write_csv, write_text
from compare.store import Store
from compare.studies import tableau
from compare.studies.catalogue import SIZES, STUDIES
from compare.studies.claims import BOTH
from compare.studies.judgement import JudgedStudy, judge_study
from compare.studies.series import tasks
from compare.studies.wording import number
from compare.study import Task
from compare.sweep import sweep
from mdr1d import MDR
from scene.scales import elastic_contact

FOLDER = Path(__file__).with_suffix("")
SIZE = "standard"
# Series whose curves are shown; the pages of `crosscheck study` show all.
SHOWN = {
    "collapse": (("sphere", "cone"), (study_collapse, study_levels)),
    "regime": (("sphere", "cone"), (study_collapse, study_levels)),
    "depth": (("sphere-rest", "cone-pressed-in"), (study_depth, study_pressed_in)),
}
MARKS = {"holds": "holds", "fails": "**fails**", "undecided": "undecided"}
# Points a side for the spectrum of the paper; two pixels a wave at least.
FINER = (2100, 4096, 8192)
ONE = 11000
FEW = 4
INTRODUCTION = """# Does Eq. 23 hold in both dimensionalities?

Claims of Popov, Voll, Li, Chai, Popov, Sci. Rep. 4, 3750 (2014), asked of one dimension and of three on the same
scenes. Measured by `python docs/study.py`, which writes this page; `crosscheck study NAME --size standard` writes
the same for one study as a page of its own, with every figure and table.

A claim **holds** if the whole interval lies within the tolerance around the number claimed, **fails** if none of
it does, and is **undecided** otherwise, or where an error is unknown. The interval is that of 95 % over surfaces,
wider at both ends by the change from half the points a side to all on the same surfaces. Surfaces are left out one
at a time, always at all points at once: points on the same surfaces are not independent. How often such intervals
hold the truth is measured in [rates.md](rates.md).

What cannot be matched: the roughness is a line in 1D and a surface in 3D. The spectra are tied by the rule of the
method, C_1D = π q C_2D, which keeps the rms height and the rms of the full gradient; real contact is a length in
one and an area in the other, and no claim compares them.

In the tables a cell is the verdict, the number and its interval, series after series; of more than four series,
how many, and from which number to which.
"""
SPECTRUM = """The sphere of Fig. 1 with all waves of the paper's own spectrum, down to two of its pixels, 4 µm:
1 N, 0.1 m/s, one surface. Its rms slope is far beyond any linear theory; the numbers say what the model makes of
it. In 1D, means of 20 profiles.

"""


def main() -> None:
    """Solve what is not solved yet, and write the page."""
    FOLDER.mkdir(exist_ok=True)
    parts, judged = [], {}
    for name, study in STUDIES.items():
        series = study.series(SIZES[SIZE])
        with watch(Console()) as progress:
            swept = sweep(
                [task for each in series for task in tasks(each)], Store(FOLDER / "solved"), progress=progress
            )
        judged[name] = judge_study(name, study, SIZES[SIZE], series, swept.outcomes)
        parts += _study(judged[name])
    parts += ["## The spectrum of the paper, once\n", _spectrum()]
    write_text(FOLDER.with_suffix(".md"), "\n".join([INTRODUCTION, answer(judged), *parts]))


def _study(judged: JudgedStudy) -> Iterator[str]:
    write_csv(FOLDER / f"findings-{judged.name}.csv", list(tableau.rows(judged)))
    yield f"## {judged.study.title}\n"
    yield f"{judged.study.about} `crosscheck study {judged.name} --size {SIZE}`.\n"
    for place, each in enumerate(judged.series, 1):
        series = each.solved.series
        points = f"{len(series.speeds)} speeds × {len(series.presses)} presses" if series.speeds else "at rest"
        yield (
            f"{place}. {series.title}: {points}, {series.surfaces} surfaces of {series.bem.points}², "
            f"{series.profiles} profiles"
        )
    verdicts = [finding.verdict for finding in tableau.every(judged)]
    counts = ", ".join(f"{verdict} {verdicts.count(verdict)}" for verdict in tableau.VERDICTS)
    yield "\n" + table("claim|claimed|1D|3D", _claims(judged))
    yield f"\n{len(verdicts)} verdicts: {counts}. With all errors: [table](study/findings-{judged.name}.csv).\n"
    for module, data, suffix in _figures(judged):
        if figure := draw(FOLDER, module, data, suffix):
            yield f"![{figure.name}](study/{figure.name}.png)\n\n{figure.caption}\n"


def _claims(judged) -> Iterator[tuple[str, ...]]:
    alone, both = tableau.claims(tableau.every(judged))
    for claim in alone:
        cells = [_cell(judged, claim, dimension) for dimension in tableau.DIMENSIONS]
        yield claim, _claimed(judged, claim), *cells
    for claim in both:
        yield claim, _claimed(judged, claim), f"1D/3D: {_cell(judged, claim, BOTH)}", ""


def _claimed(judged, claim):
    """The number, one for each shape or solid."""
    asked = [finding for finding in tableau.every(judged) if finding.claim == claim]
    return " or ".join(dict.fromkeys(f"{each.expected:.3g} ± {each.tolerance:.2g}" for each in asked))


def _cell(judged, claim, dimension):
    """Verdicts with their numbers and intervals, series after series; alike ones together."""
    found = [
        (place, finding)
        for place, column in enumerate(tableau.columns(judged), 1)
        if (finding := column.find(claim, dimension))
    ]
    if len(found) > FEW:
        counts = {verdict: [f for _, f in found if f.verdict == verdict] for verdict in MARKS}
        return "; ".join(f"{MARKS[name]} {len(each)} ({_span(each)})" for name, each in counts.items() if each)
    return "; ".join(f"{place}: {MARKS[each.verdict]} {_written(each)}".strip() for place, each in found)


def _span(findings: list[Finding]):
    values = [finding.value for finding in findings if isfinite(finding.value)] or [nan]
    return number(min(values)) if len(values) == 1 else f"{number(min(values))} to {number(max(values))}"


def _written(finding: Finding):
    if not isfinite(finding.value):
        return ""
    low, high = finding.interval
    return f"{number(finding.value)} ({number(low)} to {number(high)})"


def _figures(judged):
    yield study_verdicts, judged, f"-{judged.name}"
    if judged.findings:
        yield study_family, judged, f"-{judged.name}"
    series, modules = SHOWN.get(judged.name, ((), ()))
    for each in judged.series:
        if each.solved.series.name in series:
            for module in modules:
                yield module, each, f"-{judged.name}-{each.solved.series.name}"


def _spectrum():
    """One surface, one point, on finer and finer grids, beside one dimension."""
    scene = parameters.contact("sphere")
    shortest = 2 * parameters.LENGTH / parameters.POINTS
    scene = replace(scene, roughness=replace(scene.roughness, shortest=shortest))
    profiles = tuple(replace(scene, roughness=replace(scene.roughness, seed=seed)) for seed in range(1, 21))
    asked = [Task(BEM(points=points), (scene,)) for points in FINER] + [Task(MDR(points=ONE), profiles)]
    with watch(Console()) as progress:
        # The finest takes 10 GB: one at a time.
        swept = sweep(asked, Store(FOLDER / "solved"), workers=1, progress=progress)
    *three, one = (swept.outcomes[task].rows for task in asked)
    rows = [_of_three(task, row) for task, (row,) in zip(asked, three, strict=False)]
    friction = [row.friction_coefficient for row in one]
    depth = [row.depth for row in one]
    lengths = [row.measures["contact_length"] for row in one]
    nominal = elastic_contact(scene).radius
    rows.append(
        {
            "dimension": "1D",
            "points": ONE,
            "friction": sum(friction) / len(one),
            "depth": sum(depth) / len(one),
            "contact": sum(lengths) / len(one) / (2 * nominal),
            "rms_slope": one[0].measures["rms_slope"],
            "by_traction": nan,
            "by_loss": nan,
            "seconds": sum(row.seconds for row in one),
        }
    )
    write_csv(FOLDER / "spectrum.csv", rows)
    header = (
        "|points|friction|by traction, by loss|depth [µm]|real over nominal contact|rms slope|processor time [s]"
    )
    return SPECTRUM + table(header, map(_line, rows)) + "\n"


def _of_three(task, row):
    measures, nominal = row.measures, elastic_contact(task.scenes[0]).radius
    return {
        "dimension": "3D",
        "points": task.solver.points,
        "friction": row.friction_coefficient,
        "depth": row.depth,
        "contact": measures["contact_area"] / (pi * nominal**2),
        "rms_slope": measures["rms_slope"],
        "by_traction": measures["friction_by_traction"] / row.normal_force,
        "by_loss": measures["friction_by_loss"] / row.normal_force,
        "seconds": row.seconds,
    }


def _line(row):
    ways = "" if isnan(row["by_traction"]) else f"{row['by_traction']:.2f}, {row['by_loss']:.2f}"
    numbers = (f"{row['points']}", f"{row['friction']:.2f}", ways, f"{1e6 * row['depth']:.1f}")
    return row["dimension"], *numbers, f"{row['contact']:.2%}", f"{row['rms_slope']:.2f}", f"{row['seconds']:.0f}"


if __name__ == "__main__":
    main()
