"""The knee and the plateau in the paper's own regime: numbers and figure of results/fast.md, the curve of law.md.

They are those of `crosscheck study steep-all-speeds` and `steep-on-fine-grids`, both with `--size standard`, in
whose folder they are solved. From nothing it takes two hours on two cores.
"""

import shutil
from math import hypot
from pathlib import Path

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.figure import Figure
from pandas import DataFrame
from tables import finding, replaced, said, stored, table

import compare
from compare.figures import style
from compare.figures.shades import SPEED, between
from compare.solving.curve import COARSE, FINE, of_model
from compare.statistics import eq23
from compare.statistics.collapse import collapse
from compare.statistics.finding import verdict
from compare.statistics.frictioncurves import SimulatedCurves
from compare.statistics.jackknife import mean_ratio
from compare.studies.comparison import study_file
from compare.studies.comparison.claims import ENDS

PAGE = Path(__file__).parents[1] / "results" / "fast.md"
LAW = PAGE.with_name("law.md")
SOLVERS = {"1D": "MDR", "3D": "BEM"}
STUDIES = "steep-all-speeds", "steep-on-fine-grids"
EXPONENT = {"sphere": 1.5, "cone": 2.0}  # (n + 1)/n: p(v) of a Kelvin solid is v to the power of minus that
COLUMNS = "claim", "where", "model", "value", "low", "high", "surfaces", "verdict"
COLLAPSE = {
    "eq23.collapse": "misfit, shifted along the load at best",
    "eq23.predicted": "misfit, shifted by p(v) of Eq. 22",
    "eq23.vertical-alone": "misfit, shifted along friction alone",
}
MASTER = {
    "law3d.collapse": "off S(x), median; tested against 0 ± 5 %",
    "law3d.collapse-most": "off S(x), nine in ten within; tested against 15 %",
    "eq23.predicted": "Eq. 23 in 3D: misfit; paper: 0, tolerance 5 %",
}
# The same of those speeds alone that are at the knee and above: v tau q_s from so much on.
KNEE, BEYOND = 2.5, ", from the knee on"
FROM_KNEE = {f"{claim}{BEYOND}": f"from the knee on: {words}" for claim, words in COLLAPSE.items()}
# What is corrected by finer grids, and where: the place of the speed among those of the fine grids.
CORRECTED = {
    "eq19.level-least": ("at the knee: friction over Eq. 19, least load", 0),
    "eq19.level-greatest": ("at the knee: friction over Eq. 19, greatest load", 0),
    "eq19.load-exponent": ("at the knee: exponent of the load, less that of Eq. 19", 0),
    "eq14.plateau-least": ("on the plateau: friction over Eq. 14, least load", 1),
    "eq14.plateau-greatest": ("on the plateau: friction over Eq. 14, greatest load", 1),
    "eq14.load-exponent": ("on the plateau: exponent of the load, less that of Eq. 14", 1),
}
ANSWER = (
    "From low speed to the plateau (v τ q_s = 0.3 to 200, loads over a factor of five) curves shifted as Eq. 23 "
    "predicts miss one another by {} % (sphere) and {} % (cone) in 1D, by {} % and {} % in 3D; from the knee on "
    "alone by {} % and {} % in 3D. The plateau in 3D is {} (sphere) and {} (cone) times that of Eq. 14 under the "
    "least load, {} and {} times under the greatest."
)


def main() -> None:
    """Solve what is not solved yet, and write the numbers, the figure and the answers."""
    reports = [compare.study(name, "standard", progress="lines") for name in STUDIES]
    trees = [compare.load(report.path.parent) for report in reports]
    found, fine = (report.findings for report in reports)
    rows = []
    for body in EXPONENT:
        for model in ("1D", "3D"):
            rows += [_plain(found, claim, model, body) for claim in COLLAPSE]
            rows += _from_the_knee(trees[0], model, body)
            rows += [
                _plain(found, claim, model, body)
                if model == "1D"
                else _corrected(found, fine, trees, claim, place, body)
                for claim, (_, place) in CORRECTED.items()
            ]
    told = DataFrame(rows)
    stored(PAGE.with_suffix(".csv"), told)
    columns = [(model, body) for body in EXPONENT for model in ("1D", "3D")]
    words = COLLAPSE | FROM_KNEE | {claim: name for claim, (name, _) in CORRECTED.items()}
    header = "|".join(["", *(f"{body}, {model}" for model, body in columns)])
    cells = (
        (name, *(_said(told, claim, *place, claim.startswith("eq23")) for place in columns))
        for claim, name in words.items()
    )
    replaced(PAGE, "numbers", table(header, cells))
    replaced(PAGE, "fast", answer(told))
    replaced(LAW, "master", table("|sphere|cone", _master(found)))
    for body in EXPONENT:
        shutil.copy(reports[0].path.parent / body / "law.png", LAW.with_name(f"law-{body}.png"))
    with style.applied():
        _figure(trees[0]).savefig(PAGE.with_suffix(".png"), dpi=200)


def _master(found):
    """Rows of the table of the master curve in 3D: misfits from S(x), and from the curve of Eq. 23."""
    for claim, words in MASTER.items():
        rows = (_plain(found, claim, "3D", body) for body in EXPONENT)
        yield words, *(f"{row['verdict']}: {said(row, 1, percent=True)}" for row in rows)


def answer(told: DataFrame) -> str:
    """The answer in one sentence."""
    in_1d = [_said(told, "eq23.predicted", "1D", body, True).split(" ")[0] for body in EXPONENT]
    in_3d = [
        _said(told, f"eq23.predicted{which}", "3D", body, True).replace(" %", "")
        for which in ("", BEYOND)
        for body in EXPONENT
    ]
    plateaus = (f"eq14.plateau-{end}" for end in ENDS)
    levels = (_said(told, claim, "3D", body, False) for claim in plateaus for body in EXPONENT)
    return ANSWER.format(*in_1d, *in_3d, *levels)


def _plain(found, claim, model, body):
    """A finding as it stands."""
    return finding(found, claim, body, model)[[*COLUMNS]].to_dict()


def _from_the_knee(tree, model, body):
    """What shifts come to at the speeds from the knee on."""
    answers = _sliding(tree, body, SOLVERS[model])
    scene = next(each.scene for each in study_file.STUDIES["regime"].series("full") if each.name == body)
    slowest = KNEE * scene.roughness.shortest / (2 * np.pi * scene.elastomer.relaxation_time)
    answers = answers.isel(speed=np.flatnonzero(answers["speed"] >= 0.999 * slowest))
    fine, coarse = (collapse(SimulatedCurves.of(answers.sel(level=grid))) for grid in (FINE, COARSE))
    shifts = -EXPONENT[body] * np.log(fine.speeds)
    for each in eq23.findings(fine, coarse, model, shifts, where=body):
        if each.claim.id in COLLAPSE:
            row = each.row
            yield {name: row[name] for name in COLUMNS} | {"claim": f"{each.claim.id}{BEYOND}"}


def _corrected(found, fine, trees, claim, place, body):
    """A number of many surfaces on the coarse grid, brought to the finest by the few that were solved on both.

    The interval holds the scatter of the many, that of the change, and the last change of the grid.
    """
    many, few = (finding(each, claim, body, "3D") for each in (found, fine))
    coarse, finest = (_friction(tree, body) for tree in trees)
    places = [int(np.argmin(abs(np.log(coarse[0] / speed)))) for speed in finest[0]]
    load, change = finest[1], np.log(finest[2][place] / coarse[2][places[place]][[0, -1], : finest[2].shape[-1]])
    lever = np.log(load) - np.log(load).mean()
    each = lever @ change / (lever @ lever) if claim.endswith("exponent") else change[_end(claim)]
    moved = mean_ratio(each)
    changed = np.array([moved.value, *moved.interval()])
    value, *ends = many["value"] + changed if claim.endswith("exponent") else many["value"] * np.exp(changed)
    # Ends without the share of the grid, from the value.
    scatter = many["low"] + many["grid"] - many["value"], many["high"] - many["grid"] - many["value"]
    below, above = (hypot(one, end - value) + few["grid"] for one, end in zip(scatter, ends, strict=True))
    return {
        "claim": claim,
        "where": body,
        "model": "3D",
        "value": value,
        "low": value - below,
        "high": value + above,
        "surfaces": many["surfaces"],
        "verdict": verdict(many["expected"], many["tolerance"], value - below, value + above),
    }


def _end(claim):
    """Place of the load of a level."""
    return -1 if claim.endswith(ENDS[-1]) else 0


def _sliding(tree, body, solver):
    """Answers of a solver to the rough body, without the slowest speed, which holds the limit of low speed."""
    return of_model(tree[f"{body}/rough"].to_dataset(inherit=False), solver).isel(speed=slice(1, None))


def _friction(tree, body):
    """Speeds, loads, and friction of each surface (speeds, loads, surfaces) on the finer grid of a study."""
    sliding = _sliding(tree, body, "BEM").sel(level=FINE)
    coefficient = (sliding["friction_force"] / sliding["normal_force"]).transpose("speed", "load", "surface")
    return sliding["speed"].values, sliding["load"].values, coefficient.values


def _said(told: DataFrame, claim: str, model: str, body: str, percent: bool) -> str:
    """Value with its interval."""
    return said(finding(told, claim, body, model), 1 if percent else 3, percent)


def _figure(tree) -> Figure:
    """Mean friction, 95 %, against the load shifted by p(v), a colour a speed; in 1D above, in 3D below."""
    drawing = style.canvas("double", 4.0)
    panels = drawing.subplots(2, len(EXPONENT), sharex="col", sharey=True)
    small = {"markersize": style.mark(0.6), "linewidth": style.width(0.8)}
    for column, (body, exponent) in enumerate(EXPONENT.items()):
        for axes, (name, solver) in zip(panels[:, column], SOLVERS.items(), strict=True):
            drawn = _sliding(tree, body, solver).sel(level=FINE).transpose("speed", "load", "surface", ...)
            speeds, load = drawn["speed"].values, drawn["normal_force"].values
            scale, friction = between(speeds), mean_ratio(drawn["friction_force"].values, load)
            shifted = load.mean(axis=-1) * (speeds[:, None] / speeds[0]) ** -exponent
            for place, speed in enumerate(speeds):
                value, *ends = (each[place] for each in (friction.value, *friction.interval()))
                look = {"fmt": "o-", "color": SPEED(scale(speed)), "capsize": 0, **small}
                axes.errorbar(shifted[place], value, yerr=np.abs(ends - value), **look)
            letter = "abcd"[2 * (solver == "BEM") + column]
            axes.set(xscale="log", yscale="log", title=f"({letter}) {body}, {name}")
        panels[1, column].set_xlabel("load times p(v) over that of the slowest [N]")
    for axes in panels[:, 0]:
        axes.set_ylabel("friction coefficient μ [1]")
    style.decades(drawing.colorbar(ScalarMappable(scale, SPEED), ax=panels, label="speed [m/s]").ax)
    return drawing


if __name__ == "__main__":
    main()
