"""All parts of pages that stored findings fill: those of the scripts of this folder, README.md, the JOSS paper.

python docs/measure/answers.py           writes them again
python docs/measure/answers.py again     does `crosscheck run` and the example of README.md first, and stores both
python docs/measure/answers.py studies   does the six studies at size standard first, and stores their findings
"""

import sys
from contextlib import redirect_stdout
from io import StringIO

import accuracy
import benchmark
import effects
import equations
import law
import pandas
import promises
import rates
import regime
import spectrum
import trust
from tables import RESULTS, example, fill, finding, stored, table

import compare
from compare.solving.words import interval, number
from compare.studies.comparison.study_file import STUDIES

PAGE, RUN, STANDARD = (RESULTS / name for name in ("answers.md", "answers/run.csv", "study/standard"))
README, PAPER = RESULTS.parents[1] / "README.md", RESULTS.parent / "joss/paper.md"
EXAMPLE = "scene, "  # first words of the table
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
OF_STUDY = {
    "eq23.collapse": "misfit, shifted at best",
    "eq23.predicted": "misfit, shifted as Eq. 22 predicts",
    "eq17.load-exponent": "exponent of the load at low speed; paper: −2/3 (sphere), −1/2 (cone)",
}
IN_REGIME = {
    "eq17.load-exponent": "regime of the paper: the same exponent",
    "eq23.collapse": "regime of the paper: misfit, shifted at best",
    "eq23.predicted": "regime of the paper: misfit, shifted as Eq. 22 predicts",
}
MISFITS, FORCES = "eq23", "force.ratio.rough"
FILLED = accuracy, benchmark, effects, equations, law, promises, rates, regime, trust  # with parts of pages


def parts():
    """Text between two comments, by the page and the name of the comment."""
    run, slow, fast = map(pandas.read_csv, (RUN, regime.SLOW, regime.FAST))
    answer, printed = _answer(run, fast), RUN.with_name("example.txt").read_text(encoding="utf-8")
    found = {
        (PAGE, "run"): table("|rough sphere|rough cone", _of_run(run)),
        (PAGE, "study"): table("|sphere, 1D|cone, 1D|sphere, 3D|cone, 3D", _of_study(pandas.concat([slow, fast]))),
        (PAGE, "spectrum"): spectrum.sentences(),
        (README, "answer"): answer,
        (README, "prints"): f"```text\n{printed.strip()}\n```",
        (PAPER, "answer"): answer.replace("(docs/", "(../"),
        (PAPER, "slow"): regime.slow_answer(slow),
    }
    return found | {(script.PAGE, name): text for script in FILLED for name, text in script.parts().items()}


def _of_run(found):
    for (claim, model), words in OF_RUN.items():
        yield words, *(_cell(finding(found, claim, scene, model)) for scene in SCENES)
    forces = found[found["claim"] == FORCES]
    for depth, place in (("shallow", 0), ("deep", -1)):
        own = (forces[forces["where"].str.startswith(scene)].iloc[place] for scene in SCENES)
        yield f"error of the 1D force at the same depth, rough body, {depth}", *map(_cell, own)


def _of_study(in_regime):
    for claims, judged in ((OF_STUDY, pandas.read_csv(STANDARD / "collapse.csv")), (IN_REGIME, in_regime)):
        for claim, words in claims.items():
            yield words, *(_cell(finding(judged, claim, body, model)) for model in ALONE for body in BODIES)


def _answer(run, fast):
    """Three points: on the smooth body at rest, on friction by 1D and its correction, and on the law in 3D."""
    smooth = run[run["claim"] == "force.ratio.smooth"]["value"].abs().max()
    slow, rough = (finding(run, claim, SCENES[0], model)["value"] for claim, model in [*OF_RUN][:2])
    one, three = (100 * finding(fast, "eq23.predicted", "sphere", name)["value"] for name in ALONE)
    half, most, count = law.unseen()
    return "\n".join(
        [
            f"- **Smooth body at rest: trust 1D.** Force and depth agree with 3D to {number(smooth, 1)}.",
            f"- **Friction: correct 1D.** 1D has {slow:.2f} times the friction of a slow, smooth sphere in 3D, "
            f"and {rough:.2f} times the friction of the paper's rough one. {trust.corrected()}",
            "- **Master curve of the paper: 1D alone.** Shifted as the paper prescribes, the curves agree to "
            f"{one:.1f} % in 1D but only to {three:.0f} % in 3D. In 3D, friction is the friction "
            "of the smooth body plus a share of what the roughness would add in full contact. This "
            f"[law](docs/results/law.md), corrected by the trust map, is within {half:.1f} % of 3D for half of "
            f"{count} unseen contacts, and within {most:.1f} % for nine in ten.",
        ]
    )


def _cell(row):
    """Verdict and number; a misfit in percent, and never below zero."""
    misfit = row["claim"].startswith(MISFITS)
    scale, unit = (100, " %") if misfit or row["claim"] == FORCES else (1, "")
    ends = row["value"], max(row["low"], 0) if misfit else row["low"], row["high"]
    return f"{row['verdict']}: {interval(*(scale * each for each in ends))}{unit}"


def run_again():
    """Store the findings of the main job, and the first table that the example of README.md prints."""
    stored(RUN, compare.run(progress=True).findings)
    with redirect_stdout(StringIO()) as printed:
        exec(example(README), {"__name__": "__main__"})
    shown = next(part for part in printed.getvalue().split("\n\n") if part.startswith(EXAMPLE))
    RUN.with_name("example.txt").write_text(f"{shown}\n", encoding="utf-8")


def studies_again():
    """Do the six studies at size standard, as far as they are not solved, and store their findings."""
    for name in STUDIES:
        found = compare.study(name, "standard", progress=True).findings
        stored(STANDARD / f"{name}.csv", found.drop(columns=["regime", "meaning", "sentence"]))


def main(first=""):
    """Write all of them."""
    {"again": run_again, "studies": studies_again}.get(first, lambda: None)()
    for (page, name), text in parts().items():
        fill(page, {name: text})


if __name__ == "__main__":
    main(*sys.argv[1:])
