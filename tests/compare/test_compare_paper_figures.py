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


def test_the_surface_of_the_contact_does_not_enter_the_indenter(touching):
    found = sections(touching)
    assert list(found) == ["cone", "sphere"]
    for table in found.values():
        touched, gap = table["touching"], table["indenter"] - table["surface"]
        scale = np.ptp(table["surface"])
        assert gap[touched].abs().max() <= ROUNDING * scale
        assert gap.min() > -ROUNDING * scale
        assert 0 < touched.sum() < touched.size


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
    xi, ratio = np.geomspace(1e-5, 0.4, 60), np.geomspace(3.0, 1e-3, 60)
    table = DataFrame({"study": np.repeat([*parameters.STUDIES], 10), "xi": xi, "macro_over_rough": ratio})
    table = table.assign(parameter=xi, hurst=xi, slow=True, holds=table.index % 3 > 0)
    table["normalised_friction"] = xi.astype(float)
    table.loc[[3, 40], "normalised_friction"] = np.nan
    plot, known = figures.plot_studies(table), table.dropna()
    left, right = from_files(plot).axes[:2]
    for empty, own in ((True, known[~known["holds"]]), (False, known[known["holds"]])):
        np.testing.assert_array_equal(points(left, empty), ordered(own["xi"], own["normalised_friction"]))
        expected = ordered(own["macro_over_rough"], own["normalised_friction"] / own["xi"])
        np.testing.assert_array_equal(points(right, empty), expected)


@pytest.mark.parametrize("holds", [True, False])
def test_the_law_shows_means_intervals_and_their_deviation_from_eq_19_hollow_where_a_condition_breaks(holds):
    xi, alpha = np.geomspace(1e-2, 1e2, 25), 1.4
    friction, law = interpolation(xi, alpha), interpolation(xi)
    table = DataFrame({"shape": "cone", "xi": xi, "normalised_friction": friction, "holds": holds})
    table = table.assign(normalised_friction_low=0.98 * friction, normalised_friction_high=1.01 * friction)
    fit = DataFrame([{"shape": "cone", "alpha": alpha, "alpha_low": alpha - 0.04, "alpha_high": alpha + 0.05}])
    above, below = from_files(figures.plot_law([table], fit)).axes
    bars = above.containers[0]
    np.testing.assert_array_equal(bars[0].get_ydata(), friction)
    (segments,) = (part.get_segments() for part in bars[2])
    np.testing.assert_allclose([np.ptp(each[:, 1]) for each in segments], 0.03 * friction, rtol=1e-9)
    np.testing.assert_allclose(below.containers[0][0].get_ydata(), 100 * (friction / law - 1), atol=1e-12)
    best = next(line for line in below.lines if line.get_linestyle() == "--").get_data()
    np.testing.assert_allclose(best[1], 100 * (interpolation(best[0], alpha) / interpolation(best[0]) - 1))
    assert "cone: best α = 1.40 (1.36 to 1.45)" in above.get_legend_handles_labels()[1]
    assert matplotlib.colors.same_color(bars[0].get_markerfacecolor(), "white") != holds
