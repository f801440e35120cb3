"""The paper's figures show their tables, digit for digit, and are drawn again from the files alone."""

import matplotlib.colors
import numpy as np
import pytest
from drawn_again import from_files
from matplotlib.collections import PathCollection
from pandas import DataFrame

from compare.solving import curve
from compare.studies.paper import figures, parameters
from compare.studies.paper.study import Paper, contact_grid, sections
from mdr1d.equations import interpolation

ROUNDING = 1e-12
# A free surface that returns over the length v tau, over the rounding of its last micrometres.
RETURN = 1e-6


def labelled(axes):
    """Artists of the legend by their label."""
    return dict(zip(*reversed(axes.get_legend_handles_labels()), strict=True))


def points(axes, empty):
    """Markers that scatter plots drew, sorted: hollow or filled ones."""
    parts = [part for part in axes.collections if isinstance(part, PathCollection)]
    inside = [part.get_offsets().data[(part.get_facecolors()[:, 3] == 0) == empty] for part in parts]
    return ordered(*np.concatenate(inside).T)


def ordered(x, y):
    found = np.column_stack([x, y])
    return found[np.lexsort(found.T)]


@pytest.fixture(scope="module")
def touching():
    grids = {f"contact-{shape}": contact_grid(shape) for shape in parameters.SHAPES}
    outcomes = {task: task.solve() for task in curve.tasks_of(grids)}
    study = Paper(3, 2)
    study.__dict__["_grids"] = grids
    for task in study._slow:
        outcomes[task] = task.failed("left out")
    return study.answers(outcomes)


def test_the_surface_of_the_contact_does_not_enter_the_indenter_and_returns_over_the_distance_slid(touching):
    found = sections(touching)
    assert list(found) == ["cone", "sphere"]
    for table in found.values():
        touched, gap = table["touching"], table["indenter"] - table["surface"]
        scale = np.ptp(table["surface"])
        assert gap[touched].abs().max() <= ROUNDING * scale
        assert gap.min() > -ROUNDING * scale
        assert 0 < touched.sum() < touched.size
        last = np.flatnonzero(touched)[-1]
        wake = table.iloc[last + 1 : last + 100]
        memory = parameters.CONTACT.speed * parameters.SOLID.relaxation_time
        expected = wake["surface"].iloc[0] * np.exp(-(wake["x"] - wake["x"].iloc[0]) / memory)
        np.testing.assert_allclose(wake["surface"], expected, rtol=RETURN)


def test_the_close_up_shows_the_solution_and_a_contact_without_an_answer_is_left_out(touching):
    table = sections(touching)["sphere"]
    whole, close = from_files(figures.plot_contacts({"sphere": table})).axes
    low, high = close.get_xlim()
    assert high - low == pytest.approx(200, rel=ROUNDING)
    seen = (low <= table["x"] * 1e6) & (table["x"] * 1e6 <= high)
    assert np.abs(np.diff(table["touching"][seen].astype(int))).sum() > 10
    bold = np.where(table["touching"], table["surface"] * 1e6, np.nan)
    for axes in (whole, close):
        np.testing.assert_allclose(axes.lines[-1].get_ydata(), bold, rtol=ROUNDING)
    assert figures.plot_contacts({}) is None


def test_every_point_of_the_studies_is_drawn_once_and_hollow_where_a_condition_breaks():
    count = 60
    xi = np.geomspace(1e-5, 0.4, count)
    ratio = np.geomspace(1e-3, 3.0, count)
    table = DataFrame(
        {
            "study": np.repeat([*parameters.STUDIES], 10),
            "parameter": xi,
            "hurst": np.linspace(0, 1, count),
            "xi": xi,
            "macro_over_rough": ratio[::-1],
            "holds": np.arange(count) % 3 > 0,
            "slow": True,
            "normalised_friction": xi**0.97 * (1 + ratio[::-1] ** 2),
        }
    )
    table.loc[[3, 40], "normalised_friction"] = np.nan
    plot, known = figures.plot_studies(table), table.dropna()
    assert len(plot.caption.split()) <= 60
    left, right = from_files(plot).axes[:2]
    for empty, own in ((True, known[~known["holds"]]), (False, known[known["holds"]])):
        np.testing.assert_array_equal(points(left, empty), ordered(own["xi"], own["normalised_friction"]))
        expected = ordered(own["macro_over_rough"], own["normalised_friction"] / own["xi"])
        np.testing.assert_array_equal(points(right, empty), expected)


def rule(shape, alpha, holds=True):
    """Table of points that follow Eq. 19 with an exponent, and the row of its fit."""
    xi = np.geomspace(1e-2, 1e2, 25)
    ends = {"": 1.0, "_low": 0.98, "_high": 1.01}
    friction = {f"normalised_friction{end}": factor * interpolation(xi, alpha) for end, factor in ends.items()}
    fit = {"shape": shape, "alpha": alpha, "alpha_low": alpha - 0.04, "alpha_high": alpha + 0.05}
    return DataFrame({"shape": shape, "xi": xi, **friction, "holds": holds}), fit


def law_panels(*rules):
    return from_files(figures.plot_law([table for table, _ in rules], DataFrame([fit for _, fit in rules]))).axes


def test_the_law_shows_means_intervals_and_their_deviation_from_eq_19():
    rules = rule("cone", 1.4), rule("sphere", 1.5)
    above, below = law_panels(*rules)
    for number, (table, fit) in enumerate(rules):
        bars, friction = above.containers[number], table["normalised_friction"].to_numpy()
        np.testing.assert_array_equal(bars[0].get_ydata(), friction)
        (segments,) = (part.get_segments() for part in bars[2])
        np.testing.assert_allclose([np.ptp(each[:, 1]) for each in segments], 0.03 * friction, rtol=1e-9)
        off = below.containers[number][0].get_ydata()
        np.testing.assert_allclose(off, 100 * (friction / interpolation(table["xi"].to_numpy()) - 1), atol=1e-12)
        best = next(line for line in below.lines if line.get_linestyle() == ("--", "-.")[number])
        expected = interpolation(best.get_xdata(), fit["alpha"]) / interpolation(best.get_xdata()) - 1
        np.testing.assert_allclose(best.get_ydata(), 100 * expected, atol=1e-12)
    assert "cone: best α = 1.40 (1.36 to 1.45)" in labelled(above)


@pytest.mark.parametrize("holds", [True, False])
def test_the_law_is_hollow_where_a_condition_breaks(holds):
    bars = law_panels(rule("cone", 1.4, holds))[0].containers[0]
    assert matplotlib.colors.same_color(bars[0].get_markerfacecolor(), "white") != holds
