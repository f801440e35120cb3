"""One number is computed once and shown everywhere from there: findings, figures and printed tables agree."""

import re
from math import isnan, nan

import numpy as np
import pytest
from invented_answers import FEW, eq_19, obeying, outside, spoiled
from matplotlib.text import Text
from pandas import DataFrame

from compare.figures import collapse as figure
from compare.figures import style
from compare.report import terminal
from compare.report.page import Page, Table
from compare.solving.words import found as worded
from compare.statistics import eq23
from compare.statistics.collapse import collapse
from compare.statistics.frictioncurves import SimulatedCurves
from compare.studies.comparison.together import together


def numbers(text):
    return set(re.findall(r"[\u2212-]?\d+(?:\.\d+)?", text.replace("-", "\u2212")))


@pytest.mark.parametrize(("scatter", "grid"), [(0.02, 0.0), (0.02, 0.05), (0.3, 0.0)])
def test_a_number_of_a_study_lies_in_its_interval(scatter, grid):
    whole = obeying(eq_19, FEW, scatter=scatter, grid=grid)
    judged = [each.judge() for each in (whole, spoiled(whole, (0, 0, slice(5))))]
    assert not outside([*(one for each in judged for one in each.findings), *together(judged)])


def straight(load, speed):
    """Friction of no common curve."""
    return load**-0.3 * speed**3


@pytest.mark.parametrize(
    ("law", "expected", "horizontal", "how"),
    [
        (eq_19, 0.5, True, figure.FITTED),
        (eq_19, 0.5, False, figure.BOTH),
        (straight, 0.5, False, figure.UNSHIFTED),
        (straight, nan, False, figure.UNSHIFTED),
    ],
)
def test_every_misfit_and_exponent_in_the_figure_of_shifts_is_that_of_a_finding(law, expected, horizontal, how):
    fine = collapse(SimulatedCurves.of(obeying(law, FEW)("BEM").isel(speed=slice(1, None))))
    shifts = None if isnan(expected) else expected * np.log(fine.speeds / fine.speeds[fine.speeds.size // 2])
    found = list(eq23.findings(fine, None, "3D", shifts, expected, horizontal=horizontal))
    row = figure.ShiftedCurves(
        "rough", fine, {each.claim.id: each for each in found}, expected, lead=eq23.leading(fine, found)
    )
    plot = figure.plot([row])
    assert plot.tables[figure.NAME + figure.FITS]["shifted_as"].tolist() == [how]
    with style.applied():
        texts = [each.get_text() for each in plot.figure().findobj(Text)]
    stated = [each for each in texts if "%" in each.replace("[%]", "") or "power " in each]
    shown = numbers(" ".join([*stated, plot.alternative]))
    assert shown - {"95"} <= numbers(" ".join([f"{expected:g}", *(worded(each, 3) for each in found)]))
    assert len(shown) > 2


def test_a_table_that_is_too_wide_for_a_terminal_is_broken_into_lines_with_every_digit():
    names = [f"friction_coefficient (model {k}){end}" for k in range(12) for end in ("", "_low", "_high")]
    frame = DataFrame({name: [1.01 + k, 2.34 + k] for k, name in enumerate(names)})
    text = terminal.text(Page("Models", (), (Table("means", frame, "Means."),)))
    assert max(map(len, text.splitlines())) <= terminal.WIDEST
    assert text.count("…") == 0
    assert text.count("(model") == 12
