"""The answers in numbers: those of docs/results/answers.md, README.md and docs/joss/paper.md, of stored findings.

python docs/measure/answers.py           writes them again
python docs/measure/answers.py again     does `crosscheck run` first, and stores its findings and first paragraph
python docs/measure/answers.py studies   does the six studies at size standard first, and stores their findings
"""

import sys
from collections.abc import Iterator, Mapping
from pathlib import Path

import fast
import law
import pandas
import slow
import spectrum
import trust
from pandas import DataFrame
from tables import finding, replaced, stored, table

import compare
from compare.solving.words import interval, number
from compare.studies.comparison.claims import ENDS
from compare.studies.comparison.study_file import STUDIES

PAGE = Path(__file__).parents[1] / "results" / "answers.md"
DOCS, README = PAGE.parent, PAGE.parents[2] / "README.md"
PAPER = DOCS.parent / "joss" / "paper.md"
STANDARD = DOCS / "study" / "standard"
RUN = DOCS / "answers" / "run.csv"
# The paragraph of what the command prints that README.md shows, by its first words.
SHOWN = "Rough sphere of the paper"
ALONE = "1D", "3D"
BODIES, SCENES = ("sphere", "cone"), ("paper-sphere", "paper-cone")
# Claims of the tables in words, by their names.
OF_RUN = {
    ("friction.ratio.smooth-slow", "1D/3D"): "friction 1D/3D, smooth body at low speed; theory: 2",
    ("friction.ratio.own", "1D/3D"): "friction 1D/3D, rough body, 0.1 m/s, 1 N; tested against 1",
    ("eq23.predicted", "1D"): "misfit of the curves shifted as Eq. 22 predicts, in 1D",
    ("eq23.predicted", "3D"): "misfit of the curves shifted as Eq. 22 predicts, in 3D",
    ("eq23.collapse", "1D"): "misfit of the curves shifted at best, in 1D",
    ("eq23.collapse", "3D"): "misfit of the curves shifted at best, in 3D",
}
OF_PAPER = {
    "paper.eq17.exponent": "exponent of ξ at low speed, where the conditions of Eq. 17 hold; paper: 1",
    "paper.eq17.exponent.any-slope": "exponent of ξ at low speed, whatever the slope of the body",
    "paper.eq17.exponent.slope-kept": "exponent of ξ at low speed, with the slope of the body kept",
    "paper.eq19.alpha": "α of Eq. 19; paper: 1.5",
    "paper.eq14.plateau": "plateau over √2 times the rms slope, Eq. 14; paper: 1",
}
OF_STUDY = {
    "eq23.collapse": "misfit, shifted at best",
    "eq23.predicted": "misfit, shifted as Eq. 22 predicts",
    "eq17.load-exponent": "exponent of the load at low speed; paper: −2/3 (sphere), −1/2 (cone)",
}
IN_REGIME = {
    "eq17.load-exponent": "the same exponent, in the regime of the paper",
    "eq17.level-least": "regime: friction at low speed over Eq. 17, least load; paper: 1",
    "eq17.level-greatest": "regime: the same, greatest load",
}
AT_SPEED = {
    "eq14.plateau-least": "regime: plateau over Eq. 14, least load; paper: 1",
    "eq14.plateau-greatest": "regime: the same, greatest load",
    "eq23.collapse": "regime: misfit, shifted at best",
    "eq23.predicted": "regime: misfit, shifted as Eq. 22 predicts",
}
MISFITS = ("eq23",)


def parts() -> Mapping[tuple[Path, str], str]:
    """Text between two comments, by the page and the name of the comment."""
    run = pandas.read_csv(RUN)
    slow_found, fast_found, waves = (
        pandas.read_csv(each.PAGE.with_suffix(".csv")) for each in (slow, fast, spectrum)
    )
    behind = slow.answer(slow_found)
    return {
        (PAGE, "run"): table("|rough sphere|rough cone", _of_run(run)),
        (PAGE, "paper"): table("|sphere|cone", _of_paper(pandas.read_csv(DOCS / "paper" / "findings.csv"))),
        (PAGE, "study"): table("|sphere, 1D|cone, 1D|sphere, 3D|cone, 3D", _of_study(slow_found, fast_found)),
        (PAGE, "spectrum"): " ".join(spectrum.sentence(body, waves[waves["shape"] == body]) for body in BODIES),
        (README, "answer"): _answer(run, slow_found, fast_found),
        (PAPER, "answer"): _answer(run, slow_found, fast_found).replace("(docs/", "(../"),
        (PAPER, "slow"): behind,
        (README, "prints"): f"```text\n{(RUN.parent / 'run.txt').read_text(encoding='utf-8').strip()}\n```",
        (slow.PAGE, "slow"): behind,
        (fast.PAGE, "fast"): fast.answer(fast_found),
        **trust.parts(),
    }


def _of_run(found: DataFrame) -> Iterator[tuple[str, ...]]:
    for (claim, model), words in OF_RUN.items():
        yield words, *(_cell(finding(found, claim, scene, model)) for scene in SCENES)
    for depth, place in (("shallow", 0), ("deep", -1)):
        forces = [found[found["claim"].eq("force.ratio.rough") & found["where"].str.startswith(s)] for s in SCENES]
        cells = (_cell(each.iloc[place], percent=True) for each in forces)
        yield f"error of the 1D force at the same depth, rough body, {depth}", *cells


def _of_paper(found: DataFrame) -> Iterator[tuple[str, ...]]:
    for claim, words in OF_PAPER.items():
        rows = found[found["claim"] == claim]
        if len(rows) == 1:
            yield words, _cell(rows.iloc[0]), "both bodies in one fit"
        else:
            yield words, *(_cell(finding(found, claim, body, "1D")) for body in BODIES)


def _of_study(slow_found: DataFrame, fast_found: DataFrame) -> Iterator[tuple[str, ...]]:
    found = pandas.read_csv(STANDARD / "collapse.csv")
    places = [(body, model) for model in ALONE for body in BODIES]
    for claims, judged in ((OF_STUDY, found), (IN_REGIME, slow_found), (AT_SPEED, fast_found)):
        for claim, words in claims.items():
            yield words, *(_cell(finding(judged, claim, body, model)) for body, model in places)


def _answer(run: DataFrame, slow_found: DataFrame, fast_found: DataFrame) -> str:
    """Three points: on the smooth body at rest, on friction by 1D and its correction, and on the law in 3D."""
    smooth = run[run["claim"] == "force.ratio.smooth"]["value"].abs().max()
    ratios = (f"friction.ratio.{name}" for name in ("smooth-slow", "own"))
    slow_body, rough = (finding(run, claim, SCENES[0], "1D/3D") for claim in ratios)
    missed = {name: _number(finding(fast_found, "eq23.predicted", "sphere", name), percent=True) for name in ALONE}
    too_high = _number(finding(slow_found, f"eq17.level-{ENDS[0]}", "sphere", "3D"))
    return "\n".join(
        [
            f"- **Force and depth of a smooth body at rest: trust 1D.** Both models agree to {number(smooth, 1)}.",
            f"- **Friction: do not trust 1D as it is; corrected, trust it.** 1D has {_number(slow_body)} times "
            f"the friction of a slow, smooth sphere, {_number(rough)} times that of the paper's rough one. "
            f"{trust.corrected()}",
            "- **The paper's law of friction, μ = Q(F_N p(v)), holds in 1D alone, in its regime of steep, small "
            f"roughness.** Curves shifted as it says miss one another by {missed['1D']} in 1D, by {missed['3D']} "
            f"in 3D, where slow friction of the sphere is at least {too_high} times too high for it "
            f"([why](docs/results/slow.md)). {law.answer()}",
        ]
    )


def _number(row, percent: bool = False) -> str:
    scale, unit = (100, " %") if percent else (1, "")
    return interval(*(scale * row[name] for name in ("value", "low", "high"))) + unit


def _cell(row, percent: bool = False) -> str:
    """Verdict and number; a misfit in percent, and never below zero."""
    misfit = row["claim"].startswith(MISFITS)
    return f"{row['verdict']}: {_number({**row, 'low': max(row['low'], 0)} if misfit else row, percent or misfit)}"


def run_again() -> None:
    """Store the findings of the main job, and sentences as a terminal shows them."""
    report = compare.run(progress="lines")
    stored(RUN, report.findings)
    (shown,) = (part for part in str(report).split("\n\n") if part.startswith(SHOWN))
    RUN.with_suffix(".txt").write_text(f"{shown}\n", encoding="utf-8")


def studies_again() -> None:
    """Do the six studies at size standard, as far as they are not solved, and store their findings."""
    for name in STUDIES:
        found = compare.study(name, "standard", progress="lines").findings
        stored(STANDARD / f"{name}.csv", found.drop(columns=["regime", "meaning", "sentence"]))


def main(first: str = "") -> None:
    """Write all of them."""
    {"again": run_again, "studies": studies_again}.get(first, lambda: None)()
    for (page, name), part in parts().items():
        replaced(page, name, part)


if __name__ == "__main__":
    main(*sys.argv[1:])
