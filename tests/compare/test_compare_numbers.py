"""One number is computed once and shown everywhere from there: findings, figures and printed tables agree."""

import re
from itertools import product
from math import isnan, nan

import numpy as np
import pytest
from invented_answers import FEW, eq_19, obeying, spoiled
from matplotlib.text import Text
from pandas import DataFrame
from small_cases import TINY

from compare.figures import collapse as figure
from compare.figures import style
from compare.report import terminal
from compare.report.page import Page, Table
from compare.solving.continuation import Continuation
from compare.solving.cost import MOST_DRAWS
from compare.solving.task import Outcome, Row
from compare.solving.words import found as worded
from compare.statistics import eq23
from compare.statistics.collapse import collapse
from compare.statistics.frictioncurves import SimulatedCurves
from compare.studies.comparison import asked
from compare.studies.comparison.together import together

NUMBER = re.compile(r"[\u2212-]?\d+(?:\.\d+)?")


def numbers(text):
    return set(NUMBER.findall(text.replace("-", "\u2212")))


def invented(task, random):
    """Rows of a contact whose friction scatters; on coarse grids the first surfaces have estimates far apart."""
    rows, coarse = [], task.solver.name == "BEM" and task.solver.points < TINY.bem.points
    for scene in task.scenes:
        seed = scene.roughness.seed - TINY.roughness.seed if scene.roughness else 0
        apart = 0.5 if coarse and seed < MOST_DRAWS else 0.05
        motion, scatter = scene.motion, 0.1 * random.normal() if scene.roughness else 0.0
        load = motion.load if motion.load is not None else motion.depth * 1e4
        friction = 0.1 * (motion.speed or 1.0) ** 0.3 * load**0.8 * np.exp(scatter)
        traction = friction * (1 + apart * random.lognormal())
        parted = {"friction_by_traction": traction, "friction_by_loss": friction}
        rows.append(Row(load, 1e-4 * (1 + scatter), friction, 0.0, 1.0, 2.0, parted))
    return Outcome(tuple(rows))


def outside(findings):
    """Findings whose number is not in its interval."""
    return [
        each
        for each in findings
        for low, high in [each.interval]
        if not (isnan(each.value + low + high) or low <= each.value <= high)
    ]


@pytest.mark.parametrize("interval", [None, 0.05], ids=["fixed draws", "draws in strata"])
def test_a_number_of_a_run_lies_in_its_interval(interval):
    """Over draws in strata a mean is a sum of differences, and that of a size may be negative by chance."""
    random, run = np.random.default_rng(0), asked.run({"a case": TINY}, interval=interval)
    tasks = [each for batch in run.batches() for each in batch.tasks]
    contacts = (each for task in tasks for each in (task.contacts if isinstance(task, Continuation) else [task]))
    findings = run.judge(run.answers({each: invented(each, random) for each in contacts})).findings
    assert not outside(findings)
    assert min(each.value for each in findings if each.claim.id == "friction.spread") >= 0


@pytest.mark.parametrize(("scatter", "grid"), [(0.02, 0.0), (0.02, 0.05), (0.3, 0.0)])
def test_a_number_of_a_study_lies_in_its_interval(scatter, grid):
    for seed in range(3):
        whole = obeying(eq_19, FEW, scatter=scatter, grid=grid, seed=seed)
        both = [whole, spoiled(whole, (0, 0, slice(5)))]
        judged = [each.judge() for each in both]
        assert not outside([*(one for each in judged for one in each.findings), *together(judged)])


@pytest.mark.parametrize(
    ("law", "expected", "horizontal", "how"),
    [
        (eq_19, 0.5, True, figure.FITTED),
        (eq_19, 0.5, False, figure.BOTH),
        (lambda load, speed: load**-0.3 * speed**3, 0.5, False, figure.UNSHIFTED),
        (lambda load, speed: load**-0.3 * speed**3, nan, False, figure.UNSHIFTED),
    ],
    ids=["along the load", "along both", "not at all", "not at all, nothing expected"],
)
def test_every_misfit_and_exponent_in_the_figure_of_shifts_is_that_of_a_finding(law, expected, horizontal, how):
    def off(load, speed):  # half the points miss by more at high speed
        return law(load, speed) * (1 + 0.02 * np.log(1 + load * speed))

    fine, coarse = (
        collapse(SimulatedCurves.of(obeying(each, FEW)("BEM").isel(speed=slice(1, None)))) for each in (law, off)
    )
    shifts = None if isnan(expected) else expected * np.log(fine.speeds / fine.speeds[fine.speeds.size // 2])
    found = list(eq23.findings(fine, coarse, "3D", shifts, expected, horizontal=horizontal))
    row = figure.ShiftedCurves(
        "rough", fine, {each.claim.id: each for each in found}, expected, lead=eq23.leading(fine, found)
    )
    plot = figure.plot([row])
    assert plot.tables[figure.NAME + figure.FITS]["shifted_as"].tolist() == [how]
    with style.applied():
        drawing = plot.figure()
    texts = [each.get_text() for each in drawing.findobj(Text)]
    told = [each for each in texts if "%" in each.replace("[%]", "") or "v^" in each] + [plot.alternative]
    known = {number for each in found for number in numbers(worded(each, 3))} | numbers(f"{expected:g}")
    assert set().union(*map(numbers, told)) - {"95"} <= known
    assert len(set().union(*map(numbers, told))) > 2


def test_a_table_that_is_too_wide_for_a_terminal_is_broken_into_lines_with_every_digit():
    frame = DataFrame({"speed": [0.1, 1.0]})
    for k, end in product(range(12), ("", "_low", "_high")):
        frame[f"friction_coefficient (model {k}){end}"] = [1 + 0.01 * k, 2 + 0.01 * k]
    frame = frame.assign(**{name: frame[name] * 0.9 for name in frame if name.endswith("_low")})
    text = terminal.text(Page("Models", (), (Table("means", frame, "Means."),)))
    assert max(map(len, text.splitlines())) <= terminal.WIDEST
    assert text.count("…") == 0
    assert text.count("(model") == 12
