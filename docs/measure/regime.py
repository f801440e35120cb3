"""The regime of the paper, from low speed to the plateau, in both models: numbers and figures of results/law.md.

python docs/measure/regime.py

They are those of the studies STUDIES at size standard, in whose folders they are solved. From nothing it takes two
and a half hours on two cores.
"""

import shutil
from collections.abc import Iterator
from math import hypot
from pathlib import Path

import numpy as np
import pandas
from pandas import DataFrame, Series
from tables import fill, finding, stored, table, with_interval

import compare
from compare.solving.curve import COARSE, FINE, of_model
from compare.statistics import eq23
from compare.statistics.collapse import collapse
from compare.statistics.finding import verdict
from compare.statistics.frictioncurves import SimulatedCurves
from compare.statistics.jackknife import mean_ratio
from compare.studies.comparison import asked, study_file
from compare.studies.comparison.claims import ENDS

PAGE = Path(__file__).parents[1] / "results" / "law.md"
SLOW, FAST = (PAGE.with_suffix("") / f"{name}.csv" for name in ("slow", "fast"))
STUDIES = "steep-and-slow", "steep-all-speeds", "steep-on-fine-grids"
SOLVERS = {"1D": "MDR", "3D": "BEM"}
EXPONENT = {"sphere": 1.5, "cone": 2.0}  # (n + 1)/n: p(v) of a Kelvin solid is v to the power of minus that
BODIES = tuple(EXPONENT)
COLUMNS = ["claim", "where", "model", "value", "low", "high", "surfaces", "verdict"]
LEVELS, PLATEAUS = ([f"{name}-{end}" for end in ENDS] for name in ("eq17.level", "eq14.plateau"))
# Claims of the table of the page in words, and whether they are in percent.
OF_SLOW = {
    "eq17.load-exponent": "slow: exponent of the load, friction",
    "eq17.contact": "slow: exponent of the load, real contact",
    LEVELS[0]: "slow: friction over Eq. 17, least load",
    LEVELS[1]: "slow: the same, greatest load",
}
KNEE, BEYOND = 2.5, ", from the knee on"  # speeds alone whose v tau q_s is so much or more
SHIFTED = {
    "eq23.predicted": "misfit, shifted by p(v) of Eq. 22",
    "eq23.vertical-alone": "misfit, shifted along friction alone",
    f"eq23.predicted{BEYOND}": "from the knee on: misfit, shifted by p(v)",
}
OF_PLATEAU = {PLATEAUS[0]: "plateau over Eq. 14, least load", PLATEAUS[1]: "the same, greatest load"}
MASTER = {
    "law3d.collapse": "off S(x), median; tested against 0 ± 5 %",
    "law3d.collapse-most": "off S(x), nine in ten within; tested against 15 %",
}
SLOW_ANSWER = (
    "Inside the regime of the paper, slow friction in 3D goes with the load to the power {} for the sphere and {} "
    "for the cone, where Eq. 17 has −0.667 and −0.5. It is {} times as high as Eq. 17 under {} N and {} times "
    "under {} N (sphere, where p/(E* h') is 0.051 and 0.087), {} times under {} N and {} times under {} N (cone, "
    "0.062 under any load)."
)
FAST_ANSWER = (
    "From low speed to the plateau (v τ q_s = 0.3 to 200, loads over a factor of five) curves shifted as Eq. 23 "
    "predicts miss one another by {} % (sphere) and {} % (cone) in 1D, by {} % and {} % in 3D; from the knee on "
    "alone by {} % and {} % in 3D. The plateau in 3D is {} (sphere) and {} (cone) times the one of Eq. 14 under "
    "the least load, {} and {} times under the greatest."
)


def main() -> None:
    """Solve what is not solved yet, and write the numbers, the figures and the parts of the page."""
    slow, whole, fine = reports = [compare.study(name, "standard", progress="lines") for name in STUDIES]
    trees = [compare.load(report.path.parent) for report in reports]
    stored(SLOW, slow.findings[slow.findings["claim"].isin(OF_SLOW)].drop(columns=["meaning"]))
    rows = []
    for body in BODIES:
        for model in SOLVERS:
            rows += [finding(whole.findings, claim, body, model)[COLUMNS].to_dict() for claim in _PLAIN]
            rows += _from_the_knee(trees[1], model, body)
            plateau = (finding(whole.findings, claim, body, model)[COLUMNS].to_dict() for claim in PLATEAUS)
            corrected = (_corrected(whole.findings, fine.findings, trees[1:], each, body) for each in PLATEAUS)
            rows += plateau if model == "1D" else corrected
        rows += [finding(whole.findings, claim, body, "3D")[COLUMNS].to_dict() for claim in MASTER]
    stored(FAST, rows)
    shutil.copy(slow.path.parent / "sphere" / "behind.png", PAGE.with_name("law-partial.png"))
    shutil.copy(whole.path.parent / "sphere" / "law.png", PAGE.with_name("law-sphere.png"))
    fill(PAGE, parts())


_PLAIN = "eq23.collapse", "eq23.predicted", "eq23.vertical-alone"


def parts() -> dict[str, str]:
    """Text between two comments of the page, by the name of the comment."""
    slow, fast = pandas.read_csv(SLOW), pandas.read_csv(FAST)
    master = ((words, *(_judged(fast, claim, body) for body in BODIES)) for claim, words in MASTER.items())
    header = "|".join(["", *(f"{body}, {model}" for body in BODIES for model in SOLVERS)])
    return {
        "slow": slow_answer(slow),
        "fast": fast_answer(fast),
        "regime": table(header, _cells(slow, fast)),
        "master": table("|sphere|cone", master),
    }


def _cells(slow: DataFrame, fast: DataFrame) -> Iterator[tuple[str, ...]]:
    for found, claims in ((slow, OF_SLOW), (fast, SHIFTED), (fast, OF_PLATEAU)):
        for claim, words in claims.items():
            places = (finding(found, claim, body, model) for body in BODIES for model in SOLVERS)
            yield words, *(_shown(row) for row in places)


def _shown(row: Series) -> str:
    """Value with its interval: a misfit in percent."""
    if row["claim"].startswith("eq23"):
        return with_interval(row, 1, percent=True)
    return with_interval(row, 1 if row["value"] > 2 else 3)


def _judged(found: DataFrame, claim: str, body: str) -> str:
    row = finding(found, claim, body, "3D")
    return f"{row['verdict']}: {with_interval(row, 1, percent=True)}"


def slow_answer(found: DataFrame) -> str:
    """What slow friction does, in two sentences."""
    numbers = [_shown(finding(found, "eq17.load-exponent", body, "3D")) for body in BODIES]
    for series in asked.study(STUDIES[0], "standard").series:
        for claim, load in zip(LEVELS, (series.values[0], series.values[-1]), strict=True):
            numbers += [_shown(finding(found, claim, series.name, "3D")), f"{load:.3g}"]
    return SLOW_ANSWER.format(*numbers)


def fast_answer(found: DataFrame) -> str:
    """Two sentences on the errors of Eq. 23 and of the plateau."""
    missed = [
        _shown(finding(found, f"eq23.predicted{which}", body, model)).replace(" %", "")
        for model, which in (("1D", ""), ("3D", ""), ("3D", BEYOND))
        for body in BODIES
    ]
    in_1d = [each.split(" ")[0] for each in missed[:2]]
    levels = (_shown(finding(found, claim, body, "3D")) for claim in PLATEAUS for body in BODIES)
    return FAST_ANSWER.format(*in_1d, *missed[2:], *levels)


def _from_the_knee(tree, model, body):
    """Misfits of shifted curves at the speeds from the knee on."""
    answers = _sliding(tree, body, SOLVERS[model])
    scene = next(each.scene for each in study_file.STUDIES["regime"].series("full") if each.name == body)
    slowest = KNEE * scene.roughness.shortest / (2 * np.pi * scene.elastomer.relaxation_time)
    answers = answers.isel(speed=np.flatnonzero(answers["speed"] >= 0.999 * slowest))
    fine, coarse = (collapse(SimulatedCurves.of(answers.sel(level=grid))) for grid in (FINE, COARSE))
    shifts = -EXPONENT[body] * np.log(fine.speeds)
    for each in eq23.findings(fine, coarse, model, shifts, where=body):
        if each.claim.id in _PLAIN:
            row = each.row
            yield {name: row[name] for name in COLUMNS} | {"claim": f"{each.claim.id}{BEYOND}"}


def _corrected(found, fine, trees, claim, body):
    """A plateau of many surfaces on the coarse grid, brought to the finest by the few that were solved on both.

    The interval holds the scatter of the many, the scatter of the change, and the last change of the grid.
    """
    many, few = (finding(each, claim, body, "3D") for each in (found, fine))
    coarse, finest = (_friction(tree, body) for tree in trees)
    load = -1 if claim.endswith(ENDS[-1]) else 0
    place = int(np.argmin(abs(np.log(coarse[0] / finest[0][-1]))))
    surfaces = finest[1].shape[-1]
    moved = mean_ratio(np.log(finest[1][-1, load] / coarse[1][place, load, :surfaces]))
    value, *ends = many["value"] * np.exp([moved.value, *moved.interval()])
    # Ends without the share of the grid, from the value.
    scatter = many["low"] + many["grid"] - many["value"], many["high"] - many["grid"] - many["value"]
    below, above = (hypot(one, end - value) + few["grid"] for one, end in zip(scatter, ends, strict=True))
    judged = verdict(many["expected"], many["tolerance"], value - below, value + above)
    corrected = {"value": value, "low": value - below, "high": value + above, "verdict": judged}
    return many[COLUMNS].to_dict() | corrected


def _sliding(tree, body, solver):
    """Answers of a solver to the rough body, without the slowest speed, which holds the limit of low speed."""
    return of_model(tree[f"{body}/rough"].to_dataset(inherit=False), solver).isel(speed=slice(1, None))


def _friction(tree, body):
    """Speeds, and friction of each surface (speeds, loads, surfaces) on the finer grid of a study."""
    sliding = _sliding(tree, body, "BEM").sel(level=FINE)
    coefficient = (sliding["friction_force"] / sliding["normal_force"]).transpose("speed", "load", "surface")
    return sliding["speed"].values, coefficient.values


if __name__ == "__main__":
    main()
