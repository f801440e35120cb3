"""The regime of the paper, from low speed to the plateau, in both models: numbers and figures of results/law.md.

python docs/measure/regime.py

They are those of the studies STUDIES at size standard, in whose folders they are solved. From nothing it takes two
and a half hours on two cores.
"""

import shutil
from itertools import product
from math import hypot

import numpy as np
import pandas
from pandas import DataFrame
from tables import RESULTS, fill, finding, stored, table

import compare
from compare.solving.curve import COARSE, FINE, of_model
from compare.statistics import eq23
from compare.statistics.collapse import collapse
from compare.statistics.finding import verdict
from compare.statistics.frictioncurves import SimulatedCurves
from compare.statistics.jackknife import mean_ratio
from compare.studies.comparison import asked, study_file
from compare.studies.comparison.claims import ENDS

PAGE, SLOW, FAST = (RESULTS / name for name in ("law.md", "law/slow.csv", "law/fast.csv"))
STUDIES = "steep-and-slow", "steep-all-speeds", "steep-on-fine-grids"
SOLVERS = {"1D": "MDR", "3D": "BEM"}
PLAIN = "eq23.collapse", "eq23.predicted", "eq23.vertical-alone"
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
OF_FAST = {
    "eq23.predicted": "misfit, shifted by p(v) of Eq. 22",
    "eq23.vertical-alone": "misfit, shifted along friction alone",
    f"eq23.predicted{BEYOND}": "from the knee on: misfit, shifted by p(v)",
    PLATEAUS[0]: "plateau over Eq. 14, least load",
    PLATEAUS[1]: "the same, greatest load",
}
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


def main():
    """Solve what is not solved yet, and write the numbers, the figures and the parts of the page."""
    slow, whole, fine = (compare.study(name, "standard", progress=True) for name in STUDIES)
    trees = [compare.load(report.path.parent) for report in (whole, fine)]
    stored(SLOW, slow.findings[slow.findings["claim"].isin(OF_SLOW)].drop(columns=["meaning"]))
    rows = _fast(whole.findings, fine.findings, trees)
    stored(FAST, DataFrame(map(dict, rows), columns=COLUMNS))
    shutil.copy(slow.path.parent / "sphere" / "behind.png", PAGE.with_name("law-partial.png"))
    shutil.copy(whole.path.parent / "sphere" / "law.png", PAGE.with_name("law-sphere.png"))
    fill(PAGE, parts())


def _fast(whole, fine, trees):
    """Rows of FAST, of all findings of two studies and their answers."""
    for body in BODIES:
        for model in SOLVERS:
            yield from (finding(whole, claim, body, model) for claim in PLAIN)
            yield from _from_the_knee(trees[0], model, body)
            for claim in PLATEAUS:
                many = finding(whole, claim, body, model)
                yield many if model == "1D" else _corrected(many, finding(fine, claim, body, model), trees)
        yield from (finding(whole, claim, body, "3D") for claim in MASTER)


def parts():
    """Text between two comments of the page, by the name of the comment."""
    found = pandas.concat(map(pandas.read_csv, (SLOW, FAST)))
    places, claims = [*product(BODIES, SOLVERS)], OF_SLOW | OF_FAST
    regime = ((words, *(_shown(found, claim, *place) for place in places)) for claim, words in claims.items())
    master = (
        (
            words,
            *(f"{finding(found, claim, body, '3D')['verdict']}: {_shown(found, claim, body)}" for body in BODIES),
        )
        for claim, words in MASTER.items()
    )
    return {
        "regime": table("|".join(["", *map(", ".join, places)]), regime),
        "master": table("|sphere|cone", master),
    }


def _shown(found, claim, body, model="3D"):
    """Value of a finding with its interval: a misfit in percent."""
    row = finding(found, claim, body, model)
    scale, unit = (100, " %") if claim.startswith(("eq23", "law3d")) else (1, "")
    digits = 1 if unit or row["value"] > 2 else 3
    value, low, high = (f"{scale * row[name]:.{digits}f}".replace("-", "−") for name in ("value", "low", "high"))
    return f"{value}{unit} ({low} to {high})"


def slow_answer(found):
    """What slow friction does, in two sentences."""
    numbers = [_shown(found, "eq17.load-exponent", body) for body in BODIES]
    for series in asked.study(STUDIES[0], "standard").series:
        for claim, load in zip(LEVELS, (series.values[0], series.values[-1]), strict=True):
            numbers += [_shown(found, claim, series.name), f"{load:.3g}"]
    return SLOW_ANSWER.format(*numbers)


def _from_the_knee(tree, model, body):
    """Misfits of shifted curves at the speeds from the knee on."""
    scene = next(each.scene for each in study_file.STUDIES["regime"].series("full") if each.name == body)
    slowest = KNEE * scene.roughness.shortest / (2 * np.pi * scene.elastomer.relaxation_time)
    answers = _sliding(tree, body, SOLVERS[model]).sel(speed=slice(0.999 * slowest, None))
    fine, coarse = (collapse(SimulatedCurves.of(answers.sel(level=grid))) for grid in (FINE, COARSE))
    for each in eq23.findings(fine, coarse, model, -EXPONENT[body] * np.log(fine.speeds), where=body):
        if each.claim.id in PLAIN:
            yield each.row | {"claim": f"{each.claim.id}{BEYOND}"}


def _corrected(many, few, trees):
    """A plateau of many surfaces on the coarse grid, brought to the finest by the few that were solved on both.

    The interval holds the scatter of the many, the scatter of the change, and the last change of the grid.
    """
    coarse, finest = (_friction(tree, many["where"]) for tree in trees)
    load = -1 if many["claim"].endswith(ENDS[-1]) else 0
    fine = finest.isel(speed=-1, load=load)
    before = coarse.sel(speed=float(fine["speed"]), method="nearest").isel(load=load, surface=slice(fine.size))
    moved = mean_ratio(np.log(fine.values / before.values))
    value, *ends = many["value"] * np.exp([moved.value, *moved.interval()])
    # Ends without the share of the grid, from the value.
    scatter = many["low"] + many["grid"] - many["value"], many["high"] - many["grid"] - many["value"]
    below, above = (hypot(one, end - value) + few["grid"] for one, end in zip(scatter, ends, strict=True))
    judged = verdict(many["expected"], many["tolerance"], value - below, value + above)
    return dict(many) | {"value": value, "low": value - below, "high": value + above, "verdict": judged}


def _sliding(tree, body, solver):
    """Answers of a solver to the rough body, without the slowest speed, which holds the limit of low speed."""
    return of_model(tree[f"{body}/rough"].to_dataset(inherit=False), solver).isel(speed=slice(1, None))


def _friction(tree, body):
    """Friction of each surface at each speed and load on the finer grid of a study."""
    sliding = _sliding(tree, body, "BEM").sel(level=FINE)
    return sliding["friction_force"] / sliding["normal_force"]


if __name__ == "__main__":
    main()
