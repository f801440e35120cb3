"""The paper's figures show their tables, digit for digit, and are drawn again from the files alone."""

import matplotlib.colors
import numpy as np
import pytest
from drawn_again import from_files
from matplotlib.collections import PathCollection
from pandas import DataFrame

from compare.studies.paper import figures, parameters
from compare.studies.paper.claims import lines
from compare.studies.paper.conditions import with_conditions
from compare.studies.paper.contacts import contact_grid, contact_tables, with_nodes
from compare.studies.paper.parameter_studies import ParameterStudies, SlowFriction, contacts
from mdr1d.equations import interpolation
from scene import Regime

ROUNDING = 1e-12
# A free surface that returns over the length v tau, over the rounding of its last micrometres.
RETURN = 1e-6
# Exponent of the points that stand for Fig. 3.
SLOPE = 0.97


def labelled(axes):
    """Artists of the legend by their label."""
    return dict(zip(*reversed(axes.get_legend_handles_labels()), strict=True))


def hollow(collection):
    faces = collection.get_facecolors()
    return faces.size == 0 or all(matplotlib.colors.same_color(each, "white") for each in faces)


def points(axes, empty=None):
    """Markers that scatter plots drew, sorted: all, hollow, or filled ones."""
    parts = [
        part.get_offsets().data
        for part in axes.collections
        if isinstance(part, PathCollection) and (empty is None or hollow(part) == empty)
    ]
    return ordered(*np.concatenate([part for part in parts if len(part)]).T)


def ordered(x, y):
    found = np.column_stack([x, y])
    return found[np.lexsort(found.T)]


@pytest.fixture(scope="module")
def touching():
    found = {}
    for shape in parameters.SHAPES:
        rectangle = contact_grid(shape)
        outcomes = {task: task.solve() for task in rectangle.tasks()}
        found[shape] = with_nodes(rectangle.datasets(outcomes)["MDR"], rectangle.fields(outcomes))
    return found


@pytest.fixture(scope="module")
def slow():
    """Fig. 3 at some Hurst exponents, mu-tilde = xi^SLOPE (1 + r^2), and of each profile a factor of its own."""
    found = contacts(ParameterStudies(hurst=(0.0, 0.5, 1.0)))
    count = len(found)
    xi, spread, profiles = np.geomspace(1e-5, 0.4, count), np.geomspace(1e-3, 3.0, count), 4
    wide = np.where(np.arange(count) % 10 == 0, 1.2, 0.5)
    regime = Regime(spread[::-1] / 5, wide, np.roll(spread, count // 3), np.full(count, 2.4))
    samples = np.outer(xi**SLOPE * (1 + regime.macro_over_rough**2), np.linspace(0.98, 1.02, profiles))
    table = DataFrame(
        {
            "study": [parameters.STUDIES[place.study].name for place in found],
            "parameter": [place.value for place in found],
            "hurst": [place.hurst for place in found],
            "xi": xi,
            "normalised_friction": samples.mean(axis=1),
        }
    )
    return SlowFriction(with_conditions(table, regime, {"xi << 1": ("xi", xi, xi <= 0.05)}), samples, 4.0)


@pytest.fixture(scope="module")
def studies(slow):
    fits = DataFrame([{"points_fitted": name, **fit.row} for name, fit in lines(slow).items()])
    return figures.studies.plot(slow.points, fits)


@pytest.fixture(scope="module")
def studies_drawn(studies):
    return from_files(studies)


def rule(shape, alpha, slope=2.4, height=0.06):
    """Table of points that follow Eq. 19 with an exponent, and the row of its fit."""
    xi = np.geomspace(1e-2, 1e2, 25)
    friction = interpolation(xi, alpha)
    columns = {
        "shape": shape,
        "xi": xi,
        "normalised_friction": friction,
        "normalised_friction_low": 0.98 * friction,
        "normalised_friction_high": 1.01 * friction,
        "normalised_friction_of_planes": 0.98 * friction,
    }
    fit = {"shape": shape, "alpha": alpha, "alpha_low": alpha - 0.04, "alpha_high": alpha + 0.05}
    return with_conditions(DataFrame(columns), Regime(height, 0.6, 0.11, slope)), fit | {"alpha_of_planes": 1.31}


def law_plot(*rules):
    return figures.law.plot([table for table, _ in rules], DataFrame([fit for _, fit in rules]))


def test_every_plot_has_a_short_caption_an_alternative_and_units(touching, studies):
    plots = [figures.contacts.plot(*contact_tables(touching)), figures.sketch.plot(), studies]
    plots.append(law_plot(rule("cone", 1.4), rule("sphere", 1.5)))
    for plot in plots:
        assert len(plot.caption.split()) <= 60
        assert plot.alternative
    for axes in from_files(plots[-1]).axes:
        assert "[" in axes.get_xlabel() + axes.get_ylabel() + "[" * (not axes.get_xlabel())


def test_without_data_there_is_no_plot():
    assert figures.law.plot([], DataFrame()) is None
    assert figures.contacts.plot(DataFrame(), {}) is None


def test_the_surface_of_the_contact_does_not_enter_the_indenter_and_returns_over_the_distance_slid(touching):
    _, found = contact_tables(touching)
    for table in found.values():
        touched, gap = table["contact"] == 1, table["indenter"] - table["surface"]
        scale = np.ptp(table["surface"])
        assert gap[touched].abs().max() <= ROUNDING * scale
        assert gap.min() > -ROUNDING * scale
        assert 0 < touched.sum() < touched.size
        last = np.flatnonzero(touched)[-1]
        wake = table.iloc[last + 1 : last + 100]
        memory = parameters.CONTACT.speed * parameters.SOLID.relaxation_time
        expected = wake["surface"].iloc[0] * np.exp(-(wake["x"] - wake["x"].iloc[0]) / memory)
        np.testing.assert_allclose(wake["surface"], expected, rtol=RETURN)


def test_both_legs_of_a_scale_have_the_length_that_it_says_and_the_close_up_shows_the_solution(touching):
    table, found = contact_tables(touching)
    assert table["conditions_broken"].tolist() == ["h0 << d, small slopes"] * 2
    drawing = from_files(figures.contacts.plot(table, found))
    for axes in drawing.axes:
        (scale,) = (line for line in axes.lines if line.get_gid() == "scale")
        (said,) = (text.get_text() for text in axes.texts if text.get_text().endswith("µm"))
        length = float(said.split()[0])
        assert np.ptp(scale.get_xdata()) * 1e3 == pytest.approx(length, rel=1e-9)
        assert np.ptp(scale.get_ydata()) == pytest.approx(length, rel=1e-9)
    for line, axes in zip(found.values(), drawing.axes[2:], strict=True):
        low, high = axes.get_xlim()
        assert high - low == pytest.approx(0.2, rel=ROUNDING)
        seen = (low <= line["x"] * 1e3) & (line["x"] * 1e3 <= high)
        assert np.abs(np.diff(line["contact"][seen])).sum() > 10
        bold = np.where(line["contact"] == 1, line["surface"] * 1e6, np.nan)
        np.testing.assert_array_equal(labelled(axes)["real contact"].get_ydata(), bold)


def test_a_contact_without_an_answer_is_left_out(touching):
    lost = touching["cone"].assign(status=touching["cone"]["status"].copy(data=np.full((1,) * 4, "failed")))
    table, found = contact_tables({**touching, "cone": lost})
    assert list(found) == ["sphere"]
    assert len(from_files(figures.contacts.plot(table, found)).axes) == 2


def test_the_sketch_is_the_closed_form_of_a_kelvin_solid():
    left, right = from_files(figures.sketch.plot()).axes
    surface = next(line for line in left.lines if line.get_xdata().size > 500)
    x, u = surface.get_xdata(), -surface.get_ydata()
    step, m, memory = x[1] - x[0], figures.sketch.SLOPE, figures.sketch.MEMORY
    slope = np.gradient(u, step)
    inside = (x > figures.sketch.LEADING + step) & (x < figures.sketch.TRAILING - step)
    behind = x > figures.sketch.TRAILING + step
    np.testing.assert_allclose(u[inside], 1 - m * np.abs(x[inside]), rtol=ROUNDING)
    # The element's force u + l u' vanishes behind the contact, and first at its end, up to second differences.
    np.testing.assert_allclose((u + memory * slope)[behind][:-1], 0, atol=step**2)
    assert (u + memory * slope)[inside].min() > 0
    assert m * figures.sketch.TRAILING + memory * m == pytest.approx(1, rel=ROUNDING)
    assert not u[x < figures.sketch.LEADING].any()
    assert len(right.lines) > 6 * figures.sketch.ELEMENTS.size


def test_every_point_of_the_studies_is_drawn_once_and_hollow_where_a_condition_breaks(slow, studies_drawn):
    law_of, slope, rest = studies_drawn.axes[:3]
    table = slow.points
    for empty, where in ((True, ~table["holds"]), (False, table["holds"])):
        assert 20 < where.sum() < 340
        expected = ordered(table["xi"][where], table["normalised_friction"][where])
        np.testing.assert_array_equal(points(law_of, empty), expected)
    ratio = table["normalised_friction"] / table["xi"]
    np.testing.assert_array_equal(points(slope), ordered(table["macro_over_rough"], ratio))
    left = table["normalised_friction"] / (table["xi"] * (1 + table["macro_over_rough"] ** 2))
    np.testing.assert_array_equal(points(rest), ordered(table["height_over_depth"], left))
    wide, fast, high = (~table[f"holds: {name}"] for name in ("2a < L", "xi << 1", "h0 << d"))
    counts = [(~wide & ~fast & ~high), (~wide & ~fast & high), (wide & ~fast), (~wide & fast), (wide & fast)]
    for (name, *_), where in zip(figures.studies.BROKEN, counts, strict=True):
        assert len(labelled(rest)[name].get_offsets()) == where.sum() > 0


def test_the_studies_say_the_slope_of_the_points_where_the_conditions_hold(slow, studies, studies_drawn):
    fits = studies.tables["paper-studies-lines"].set_index("points_fitted")
    assert fits.loc["conditions hold, over 1 + r²", "slope"] == pytest.approx(SLOPE, rel=1e-9)
    said = " ".join(text.get_text() for text in studies_drawn.axes[0].texts)
    assert f"filled: slope {fits.loc['conditions hold', 'slope']:.3f}" in said


def test_a_point_of_the_studies_without_an_answer_is_left_out(slow, studies):
    lost = slow.points.copy()
    lost.loc[[3, 70], "normalised_friction"] = np.nan
    fits = studies.tables["paper-studies-lines"].iloc[1:]
    law_of = from_files(figures.studies.plot(lost, fits)).axes[0]
    assert len(points(law_of)) == len(lost) - 2
    assert not law_of.texts  # no line through points where the conditions hold, no slope
    assert figures.studies.plot(lost.assign(normalised_friction=np.nan), fits) is None


def test_the_law_shows_means_intervals_and_their_deviation_from_eq_19():
    rules = rule("cone", 1.4), rule("sphere", 1.5)
    above, below = from_files(law_plot(*rules)).axes
    for number, (table, fit) in enumerate(rules):
        bars, friction = above.containers[number], table["normalised_friction"].to_numpy()
        np.testing.assert_array_equal(bars[0].get_ydata(), friction)
        (segments,) = (part.get_segments() for part in bars[2])
        np.testing.assert_allclose([np.ptp(each[:, 1]) for each in segments], 0.03 * friction, rtol=1e-9)
        off = below.containers[number][0].get_ydata()
        np.testing.assert_allclose(off, 100 * (friction / interpolation(table["xi"].to_numpy()) - 1), atol=1e-12)
        best = labelled(below)[f"{fit['shape']}, best α"]
        expected = interpolation(best.get_xdata(), fit["alpha"]) / interpolation(best.get_xdata()) - 1
        np.testing.assert_allclose(best.get_ydata(), 100 * expected, atol=1e-12)
        planes = labelled(below)[f"{fit['shape']}, planes"].get_ydata()
        np.testing.assert_allclose(planes, 100 * (0.98 * (1 + off / 100) - 1), atol=1e-9)
    assert "cone: best α = 1.40 (1.36 to 1.45)" in labelled(above)
    # Eq. 19 with its own exponent is off itself nowhere.
    np.testing.assert_allclose(below.containers[1][0].get_ydata(), 0, atol=1e-10)


def test_the_law_is_hollow_where_a_condition_breaks_but_that_of_small_slopes():
    for height, empty in ((0.06, False), (0.2, True)):
        bars = from_files(law_plot(rule("cone", 1.4, height=height))).axes[0].containers[0]
        assert matplotlib.colors.same_color(bars[0].get_markerfacecolor(), "white") == empty
