"""The paper's figures show what they are given, digit for digit, say its numbers, and tell what is missing."""

from dataclasses import replace
from math import sqrt

import matplotlib.colors
import numpy as np
import pytest
from matplotlib.collections import PathCollection

from compare.commoncurve import Curve, Misfit
from compare.figures import (
    paper_contacts,
    paper_law,
    paper_losses,
    paper_sketch,
    paper_studies,
    shifted_curves,
    style,
)
from compare.mastercurve import Collapse as Curves
from compare.outcome import Row
from compare.paper import campaign, contacts, law, parameters, shifts
from compare.paper.campaign import Campaign, Collapse
from compare.paper.conditions import Conditions
from compare.paper.parameters import Loss
from compare.paper.predicted import CONSTANT, EVERY, STIFFNESS, Predicted
from mdr1d.equations import interpolation
from scene import Regime

ROUNDING = 1e-12
# A free surface that returns over the length v tau, over the rounding of its last micrometres.
RETURN = 1e-6
# Of the points that stand for the campaign of Fig. 3.
SLOPE = 0.97


def drawn(module, data):
    with style.applied():
        drawing = module.figure(data)
        drawing.draw_without_rendering()
    return drawing


def labelled(axes):
    """Artists of the legend by their label."""
    return dict(zip(*reversed(axes.get_legend_handles_labels()), strict=True))


def hollow(collection):
    return collection.get_facecolors().size == 0


def white(collection):
    return all(matplotlib.colors.same_color(colour, "white") for colour in collection.get_facecolors())


def points(axes, empty=None):
    """What scatter plots drew, sorted: all, hollow, or filled markers."""
    parts = [c.get_offsets().data for c in axes.collections if empty is None or hollow(c) == empty]
    found = np.concatenate([part for part in parts if len(part)] or [np.empty((0, 2))])
    return found[np.lexsort(found.T)]


def ordered(x, y):
    found = np.column_stack([x, y])
    return found[np.lexsort(found.T)]


@pytest.fixture(scope="module")
def configurations():
    return {
        shape: contacts.collect(shape, {contacts.task(shape): contacts.task(shape).solve()})
        for shape in parameters.SHAPES
    }


def studies(profiles=4):
    """The whole campaign, mu-tilde = xi^SLOPE (1 + r^2), and of each profile a factor of its own."""
    found = campaign.places(Campaign())
    xi = np.geomspace(1e-5, 0.4, len(found))
    spread = np.geomspace(1e-3, 3.0, len(found))
    regime = Regime(
        height_over_depth=spread[::-1] / 5,
        contact_over_period=np.where(np.arange(len(found)) % 10 == 0, 1.2, 0.5),
        macro_over_rough=np.roll(spread, 400),
        rms_slope=np.full(len(found), 2.4),
    )
    factors = np.linspace(0.98, 1.02, profiles)
    samples = np.outer(xi**SLOPE * (1 + regime.macro_over_rough**2), factors)
    return Collapse(
        study=np.array([place.study for place in found]),
        value=np.array([place.value for place in found]),
        hurst=np.array([place.hurst for place in found]),
        xi=xi,
        friction=samples.mean(axis=1),
        error=samples.std(axis=1, ddof=1) / sqrt(profiles),
        samples=samples,
        regime=regime,
        failed=0,
        sweeps=4.0,
    )


@pytest.fixture(scope="module")
def campaigned():
    return studies()


@pytest.fixture(scope="module")
def campaigned_panels(campaigned):
    return drawn(paper_studies, campaigned).axes


def rule(shape="cone", alpha=1.4, slope=2.4, height=0.06):
    xi = np.geomspace(1e-2, 1e2, 25)
    samples = np.outer(interpolation(xi, alpha), np.linspace(0.99, 1.01, 5))
    return law.Law(
        shape=shape,
        xi=xi,
        friction=samples.mean(axis=1),
        error=samples.std(axis=1, ddof=1) / sqrt(5),
        samples=samples,
        conditions=Conditions.of(Regime(height, 0.6, 0.11, slope), xi.shape),
        alpha=alpha,
        alpha_interval=(alpha - 0.04, alpha + 0.05),
        alphas=np.full(10, alpha),
        by_criterion={name: alpha + 0.01 * number for number, name in enumerate(law.CRITERIA)},
        chi_square=12.3,
        planes=0.98 * samples.mean(axis=1),
        planes_alpha=1.31,
        plateau=1.01,
        plateau_error=0.02,
        failed=0,
    )


def curves(power=-0.7, overlaps=True):
    """Straight curves at every speed, shifted by a power of it."""
    speeds, loads = np.array(parameters.SPEEDS), np.log(parameters.FORCES)
    reference = len(speeds) // 2
    by = power * np.log(speeds / speeds[reference])
    return Curves(
        speeds=speeds,
        shifts=by,
        shift_errors=np.full(by.size, 0.02 if overlaps else np.nan),
        reference=reference,
        before=Misfit(0.5, 90.0, 270),
        after=Misfit(0.0123, 0.9, 243),
        scatter=0.0145,
        exponent=power,
        exponent_error=0.003 if overlaps else np.nan,
        overlaps=overlaps,
        separable=True,
        curves=tuple(
            Curve(v, loads, -0.6 * (loads + b), np.full(loads.size, 0.01)) for v, b in zip(speeds, by, strict=True)
        ),
        degree=4,
    )


def conditions(speeds=28, loads=10):
    """The modulus is not constant at the upper half of the speeds."""
    ratio = np.repeat(np.where(np.arange(speeds) < speeds // 2, 1.05, 1.4)[:, None], loads, axis=1)
    known = Conditions.of(Regime(0.05, 0.6, 0.1, 2.8), ratio.shape)
    return known.joined(STIFFNESS, ratio, "constant macroscopic modulus", ratio <= CONSTANT)


def lossy():
    misfit = Misfit(0.05, 12.0, 270)
    each = conditions()
    found = shifts.Shifted(
        "whole",
        curves(),
        0.02,
        (-0.74, -0.66),
        expected=-0.75,
        predicted=misfit,
        conditions=tuple(each.at(i) for i in range(28)),
        laws={EVERY: -0.7654},
    )
    friction = np.exp([curve.log_friction for curve in found.collapse.curves])
    return shifts.Lossy(
        loss=Loss(0.5, 1e-3),
        whole=found,
        rough=found,
        smooth=0.2 * friction,
        predicted=Predicted(0.3 * friction, 0.9 * friction, each),
        failed=0,
    )


@pytest.mark.parametrize("module", [shifted_curves, paper_losses])
def test_several_sets_are_drawn_together_and_every_axis_has_a_unit(module):
    data = [lossy(), lossy()]
    for axes in drawn(module, [each.whole for each in data] if module is shifted_curves else data).axes:
        assert "[" in axes.get_xlabel() + axes.get_ylabel()


@pytest.mark.parametrize("module", [paper_contacts, paper_law, paper_losses, shifted_curves])
def test_without_data_there_is_no_figure_and_no_table(module):
    empty = {} if module is paper_contacts else []
    assert module.figure(empty) is None
    assert not module.sheets(empty)


def test_the_surface_of_the_contact_does_not_enter_the_indenter(configurations):
    for shape in parameters.SHAPES:
        sheet = paper_contacts.sheets(configurations)[f"paper-contacts-{shape}"]
        touched = sheet["contact"] == 1
        gap = sheet["indenter"] - sheet["surface"]
        scale = np.ptp(sheet["surface"])
        assert gap[touched] == pytest.approx(0, abs=ROUNDING * scale)
        assert gap.min() > -ROUNDING * scale
        assert 0 < touched.sum() < touched.size


def test_the_wake_of_the_contact_returns_over_the_distance_slid_in_one_relaxation_time(configurations):
    motion, solid = parameters.CONTACT, parameters.SOLID
    for shape in parameters.SHAPES:
        sheet = paper_contacts.sheets(configurations)[f"paper-contacts-{shape}"]
        last = np.flatnonzero(sheet["contact"])[-1]
        x, surface = sheet["x"][last + 1 : last + 100], sheet["surface"][last + 1 : last + 100]
        expected = surface[0] * np.exp(-(x - x[0]) / (motion.speed * solid.relaxation_time))
        assert surface == pytest.approx(expected, rel=RETURN)


def test_both_legs_of_a_scale_have_the_length_that_it_says(configurations):
    drawing = drawn(paper_contacts, configurations)
    for axes in drawing.axes:
        (scale,) = (line for line in axes.lines if line.get_gid() == "scale")
        (said,) = (text.get_text() for text in axes.texts if text.get_text().endswith("µm"))
        length = float(said.split()[0])
        assert np.ptp(scale.get_xdata()) * 1e3 == pytest.approx(length, rel=1e-9)
        assert np.ptp(scale.get_ydata()) == pytest.approx(length, rel=1e-9)


def test_the_contacts_name_the_conditions_that_they_break(configurations):
    # h0/d is 0.19 and 0.33, and the rms slope 11 and 7.
    assert paper_contacts.caption(configurations).count("it breaks h0 << d, small slopes.") == 2


def test_the_two_contacts_are_on_different_profiles(configurations):
    cone, sphere = (configurations[shape].scene.roughness.seed for shape in parameters.SHAPES)
    assert cone != sphere


def test_the_close_up_has_free_surface_between_contacts_and_draws_the_solution(configurations):
    drawing = drawn(paper_contacts, configurations)
    for shape, axes in zip(parameters.SHAPES, drawing.axes[2:], strict=True):
        sheet = paper_contacts.sheets(configurations)[f"paper-contacts-{shape}"]
        low, high = axes.get_xlim()
        assert high - low == pytest.approx(0.2, rel=ROUNDING)
        seen = (low <= sheet["x"] * 1e3) & (sheet["x"] * 1e3 <= high)
        assert np.abs(np.diff(sheet["contact"][seen])).sum() > 10
        found = labelled(axes)
        surface = sheet["surface"] * 1e6
        np.testing.assert_array_equal(found["surface of the elastomer"].get_ydata(), surface)
        bold = np.where(sheet["contact"] == 1, surface, np.nan)
        np.testing.assert_array_equal(found["real contact"].get_ydata(), bold)


def test_a_contact_without_an_answer_is_left_out_and_said(configurations):
    lost = {**configurations, "cone": replace(configurations["cone"], row=Row(reason="no depth"), fields={})}
    assert len(drawn(paper_contacts, lost).axes) == 2
    assert list(paper_contacts.sheets(lost)) == ["paper-contacts-sphere"]
    assert "it failed and is left out: no depth." in paper_contacts.caption(lost)
    assert "left out" not in paper_contacts.caption(configurations)
    nothing = {shape: replace(at, row=Row(reason="no depth"), fields={}) for shape, at in configurations.items()}
    assert paper_contacts.figure(nothing) is None


def test_the_sketch_is_the_closed_form_of_a_kelvin_solid():
    left, right = drawn(paper_sketch, None).axes
    surface = next(line for line in left.lines if line.get_xdata().size > 500)
    x, u = surface.get_xdata(), -surface.get_ydata()
    step, m, memory = x[1] - x[0], paper_sketch.SLOPE, paper_sketch.MEMORY
    slope = np.gradient(u, step)
    inside = (x > paper_sketch.LEADING + step) & (x < paper_sketch.TRAILING - step)
    behind = x > paper_sketch.TRAILING + step
    assert u[inside] == pytest.approx(1 - m * np.abs(x[inside]), rel=ROUNDING)
    # The element's force u + l u' vanishes behind the contact, and first at its end, up to second differences.
    assert (u + memory * slope)[behind][:-1] == pytest.approx(0, abs=step**2)
    assert (u + memory * slope)[inside].min() > 0
    assert m * paper_sketch.TRAILING + memory * m == pytest.approx(1, rel=ROUNDING)
    assert u[x < paper_sketch.LEADING] == pytest.approx(0, abs=0)
    plates = [
        line for line in right.lines if line.get_linewidth() == pytest.approx(1.6 * style.LINES["lines.linewidth"])
    ]
    tops = np.array([-line.get_ydata()[0] for line in plates])
    np.testing.assert_allclose(tops, paper_sketch.displacement(paper_sketch.ELEMENTS), rtol=ROUNDING)


def test_every_point_of_the_studies_is_drawn_once_and_hollow_where_a_condition_breaks(
    campaigned, campaigned_panels
):
    data, (law_of, slope, rest) = campaigned, campaigned_panels
    sheet = paper_studies.sheets(data)["paper-studies"]
    broken = sheet["holds"] == 0
    assert 100 < broken.sum() < 1220
    for empty, where in ((True, broken), (False, data.holds)):
        expected = ordered(sheet["xi"][where], sheet["normalised_friction"][where])
        np.testing.assert_array_equal(points(law_of, empty), expected)
    np.testing.assert_array_equal(points(slope), ordered(sheet["macro_over_rough"], data.friction / data.xi))
    left = data.friction / (data.xi * (1 + data.regime.macro_over_rough**2))
    np.testing.assert_array_equal(points(rest), ordered(data.regime.height_over_depth, left))
    for number in range(6):
        assert sum(len(c.get_offsets()) for c in law_of.collections[2 * number : 2 * number + 2]) == 220


def test_colours_of_the_studies_follow_the_hurst_exponent(campaigned, campaigned_panels):
    found = next(c for c in campaigned_panels[0].collections if not hollow(c))
    at = [int(np.flatnonzero(campaigned.xi == xi)[0]) for xi, _ in found.get_offsets()]
    assert found.get_facecolors() == pytest.approx(paper_studies.SHADES(campaigned.hurst[at]))


def test_the_last_panel_of_the_studies_counts_what_breaks(campaigned, campaigned_panels):
    data, found = campaigned, labelled(campaigned_panels[2])
    wide, fast = data.regime.contact_over_period >= 1, data.xi > campaign.SLOW
    high = data.regime.height_over_depth > 0.1
    expected = {
        "none of these": ~wide & ~fast & ~high,
        "h₀ > d/10 alone": ~wide & ~fast & high,
        "2a > L": wide & ~fast,
        f"ξ > {campaign.SLOW:g}": ~wide & fast,
        "both": wide & fast,
    }
    for name, where in expected.items():
        assert len(found[name].get_offsets()) == where.sum() > 0
        assert hollow(found[name]) == (name != "none of these")


def test_the_studies_say_slope_and_interval_of_the_points_where_the_conditions_hold(campaigned, campaigned_panels):
    data = campaigned
    fit = campaign.line(data, data.holds, data.with_macro_slope)
    assert fit.slope == pytest.approx(SLOPE, rel=1e-9)
    rows = {row["points"]: row for row in paper_studies.sheets(data)["paper-studies-lines"]}
    assert rows["where the conditions hold, over 1 + r²"]["slope"] == fit.slope
    assert f"over 1 + r²: slope {SLOPE:.3f}, 95 % between {fit.slope_interval[0]:.3f}" in paper_studies.caption(
        data
    )
    plain = campaign.line(data, data.holds)
    texts = [text.get_text() for text in campaigned_panels[0].texts]
    assert f"filled: slope {plain.slope:.3f}" in " ".join(texts)


def test_studies_none_of_which_keep_the_conditions_are_drawn_without_their_line(campaigned):
    data = campaigned
    steep = replace(data, regime=replace(data.regime, macro_over_rough=np.full(data.xi.size, 2.0)))
    assert not drawn(paper_studies, steep).axes[0].texts
    assert {row["points"] for row in paper_studies.sheets(steep)["paper-studies-lines"]} == {
        "all points",
        "all points, over 1 + r²",
    }


def test_a_point_of_the_studies_without_an_answer_is_left_out_and_said(campaigned):
    data = campaigned
    friction, samples = data.friction.copy(), data.samples.copy()
    friction[[3, 700]], samples[[3, 700]] = np.nan, np.nan
    lost = replace(data, friction=friction, samples=samples, failed=8)
    assert len(points(drawn(paper_studies, lost).axes[0])) == data.xi.size - 2
    said = paper_studies.caption(lost)
    assert "8 solves failed" in said
    assert "2 points without any are left out" in said
    assert "failed" not in paper_studies.caption(data)
    everything = np.full(data.xi.size, np.nan)
    assert paper_studies.figure(replace(data, friction=everything)) is None


def test_the_law_shows_means_errors_and_their_deviation_from_eq_19():
    data = [rule("cone", 1.4), rule("sphere", 1.5)]
    above, below = drawn(paper_law, data).axes
    sheet = paper_law.sheets(data)["paper-law"]
    for number, one in enumerate(data):
        rows = sheet[25 * number : 25 * number + 25]
        bars = above.containers[number]
        assert not matplotlib.colors.same_color(bars[0].get_markerfacecolor(), "white")
        np.testing.assert_array_equal(bars[0].get_ydata(), [row["normalised_friction"] for row in rows])
        (segments,) = (part.get_segments() for part in bars[2])
        halves = [row["normalised_friction_error"] for row in rows]
        assert [np.ptp(s[:, 1]) / 2 for s in segments] == pytest.approx(halves, rel=1e-9)
        off = below.containers[number][0].get_ydata()
        assert off == pytest.approx([100 * row["deviation_from_eq_19"] for row in rows], rel=ROUNDING)
        best = labelled(below)[f"{one.shape}, best α"]
        expected = interpolation(best.get_xdata(), one.alpha) / interpolation(best.get_xdata()) - 1
        assert best.get_ydata() == pytest.approx(100 * expected, abs=1e-12)
        planes = labelled(below)[f"{one.shape}, planes"]
        assert planes.get_ydata() == pytest.approx([100 * (0.98 * (1 + y / 100) - 1) for y in off], abs=1e-9)
        assert [row["holds"] for row in rows] == [1] * 25
        assert [row["holds: small slopes"] for row in rows] == [0] * 25
    assert "cone: best α = 1.40 (1.36 to 1.45)" in labelled(above)
    # Eq. 19 with its own exponent is off itself nowhere.
    assert below.containers[1][0].get_ydata() == pytest.approx(0, abs=1e-10)


def test_the_law_says_which_conditions_break_and_is_hollow_where_one_does():
    steep, gentle = [rule(slope=2.4)], [rule(slope=0.1)]
    assert "rms slope 2.4: " not in paper_law.caption(gentle)
    assert "outside the small slopes" in paper_law.caption(steep)
    assert "outside the small slopes" not in paper_law.caption(gentle)
    assert "Conditions that break, of 25 points: small slopes (everywhere)." in paper_law.caption(steep)
    assert "All conditions hold." in paper_law.caption(gentle)
    shallow = [rule(height=0.2)]
    assert "h0 << d (everywhere)" in paper_law.caption(shallow)
    bars = drawn(paper_law, shallow).axes[0].containers[0]
    assert matplotlib.colors.same_color(bars[0].get_markerfacecolor(), "white")


def test_the_law_says_that_what_it_leaves_is_systematic_and_how_alpha_depends_on_the_criterion():
    said = paper_law.caption([rule()])
    assert "1.40 to 1.43 by what is made least" in said
    assert "more than scatter: systematic, chi square 12 per degree of freedom" in said
    assert "of planes 1.31" in said
    assert "leaves scatter" in replace(rule(), chi_square=1.1).left
    (fit,) = paper_law.sheets([rule()])["paper-law-alpha"]
    assert (fit["alpha by worst point"], fit["chi_square"]) == (pytest.approx(1.43), 12.3)


def test_the_law_says_what_is_missing():
    one = rule()
    friction = one.friction.copy()
    friction[7] = np.nan
    lost = replace(one, friction=friction, failed=5)
    above, _ = drawn(paper_law, [lost]).axes
    assert len(above.containers[0][0].get_xdata()) == 24
    assert "5 solves failed" in paper_law.caption([lost])
    assert "failed" not in paper_law.caption([one])


def test_shifted_curves_fall_onto_one_line_and_their_shifts_onto_the_power_of_the_speed():
    data = [lossy().whole]
    before, after, by, _ = drawn(shifted_curves, data).axes
    sheet = shifted_curves.sheets(data)["shifted-curves"]
    for axes, name in ((before, "normal_force"), (after, "shifted_force")):
        x = np.concatenate([bars[0].get_xdata() for bars in axes.containers])
        np.testing.assert_array_equal(x, [row[name] for row in sheet])
        mu = np.concatenate([bars[0].get_ydata() for bars in axes.containers])
        np.testing.assert_array_equal(mu, [row["friction_coefficient"] for row in sheet])
    line = np.array([(row["shifted_force"], row["friction_coefficient"]) for row in sheet])
    assert line[:, 1] == pytest.approx(line[:, 0] ** -0.6, rel=1e-9)
    assert len(before.containers) == 28
    shifts_of = next(c for c in by.collections if len(c.get_offsets()) == 28).get_offsets().data
    rows = shifted_curves.sheets(data)["shifted-curves-shifts"]
    assert shifts_of[:, 1] == pytest.approx([row["log_shift"] / np.log(10) for row in rows], rel=ROUNDING)
    (segments,) = (part.get_segments() for part in by.containers[0][2])
    halves = [row["log_shift_error"] / np.log(10) for row in rows]
    assert [np.ptp(s[:, 1]) / 2 for s in segments] == pytest.approx(halves, rel=1e-9)
    for label, slope in (
        ("exponent -0.700 ± 0.020", -0.7),
        ("expected -0.75", -0.75),
        ("every wave -0.7654", -0.7654),
    ):
        found = labelled(by)[label]
        rise = np.polyfit(np.log10(found.get_xdata()), found.get_ydata(), 1)[0]
        assert rise == pytest.approx(slope, rel=1e-9)


def parted(expected=-0.75):
    return replace(lossy().whole, collapse=curves(overlaps=False), expected=expected)


def test_where_only_the_overlap_stops_the_shifts_the_curves_are_shifted_as_expected_and_called_undecided():
    _, after, by, _ = drawn(shifted_curves, [parted()]).axes
    assert by.get_title(loc="right") == "collapse undecided, shifted as expected: 5.00%"
    assert "exponent undecided" in [text.get_text() for text in by.texts]
    assert not [c for c in by.collections if len(c.get_offsets()) == 28]
    assert not by.containers
    speeds = np.array(parameters.SPEEDS)
    factors = (speeds / speeds[14]) ** -0.75
    sheet = shifted_curves.sheets([parted()])["shifted-curves"]
    found = np.array([row["shifted_force"] / row["normal_force"] for row in sheet]).reshape(28, 10)
    assert found == pytest.approx(np.repeat(factors[:, None], 10, axis=1), rel=1e-9)
    drawn_at = np.concatenate([bars[0].get_xdata() for bars in after.containers])
    np.testing.assert_array_equal(drawn_at, [row["shifted_force"] for row in sheet])
    assert "exponent of the speed undecided" in shifted_curves.caption([parted()])


def test_shifts_that_only_the_overlap_stops_are_hollow_and_have_no_error():
    for overlaps in (True, False):
        data = [replace(lossy().whole, collapse=curves(overlaps=overlaps), expected=None, predicted=None)]
        by = drawn(shifted_curves, data).axes[2]
        markers = next(c for c in by.collections if len(c.get_offsets()) == 28)
        assert white(markers) == (not overlaps)
        assert bool(by.containers) == overlaps


def test_points_of_the_shifted_curves_are_hollow_where_a_condition_breaks():
    data = [lossy().whole]
    before = drawn(shifted_curves, data).axes[0]
    markers = [c for c in before.collections if isinstance(c, PathCollection)]
    for empty in (True, False):
        assert sum(len(c.get_offsets()) for c in markers if white(c) == empty and len(c.get_offsets())) == 140
    sheet = shifted_curves.sheets(data)["shifted-curves"]
    assert [row["holds"] for row in sheet] == [1] * 140 + [0] * 140
    assert sheet[-1][STIFFNESS] == 1.4
    said = shifted_curves.caption(data)
    assert "|G(v/a)|/G₀ is 1.05 to 1.40" in said
    assert "constant macroscopic modulus (140), small slopes (everywhere). Points are hollow" in said


def test_the_caption_of_the_shifts_has_verdict_misfits_scatter_and_exponents():
    said = shifted_curves.caption([replace(lossy().whole, title="β = 0.5, whole friction")])
    for part in (
        "β = 0.5, whole friction (28 speeds, 280 points",
        "collapse holds; misfit 50.00%",
        "1.23% shifted",
        "scatter 1.45%",
        "-0.700 ± 0.020",
        "shifted by the -0.75 that is expected, misfit 5.00%, beyond scatter",
    ):
        assert part in said


def test_a_table_of_ones_own_is_shifted_without_an_expectation():
    loads = np.log(np.geomspace(1, 100, 8))
    measured = [
        Curve(v, loads, -0.4 * np.logaddexp(0, loads - 0.5 * np.log(v / 0.01)), np.full(8, np.nan))
        for v in (3e-3, 1e-2, 2e-2)
    ]
    data = [shifts.Shifted.measured("measured", measured)]
    by = drawn(shifted_curves, data).axes[2]
    assert not [label for label in labelled(by) if "expected" in label]
    said = shifted_curves.caption(data)
    assert "expected" not in said
    assert "scatter unknown" in said


def test_forms_of_eq_22_are_shown_by_their_deviation_from_the_simulation():
    data = [lossy()]
    axes, _ = drawn(paper_losses, data).axes
    curved = [line for line in axes.lines if len(line.get_xdata()) == len(parameters.FORCES)]
    found = [line.get_ydata() for line in curved]
    assert found == [
        pytest.approx(np.full(10, off), rel=1e-9) for off in (-70, -70, -70, -10, -10, -10, 10, 10, 10)
    ]
    np.testing.assert_array_equal(curved[0].get_xdata(), parameters.FORCES)
    rows = paper_losses.sheets(data)["paper-losses"]
    assert len(rows) == 280
    for row in rows:
        assert row["every_wave"] / row["simulated"] == pytest.approx(0.9, rel=1e-9)
    assert (rows[0]["holds"], rows[-1]["holds"]) == (1, 0)
    markers = {
        name: sum(len(c.get_offsets()) for c in axes.collections if white(c) == (name == "hollow"))
        for name in ("filled", "hollow")
    }
    assert markers == {"filled": 3 * 10, "hollow": 3 * 2 * 10}
    said = paper_losses.caption(data)
    assert "every wave and smooth body +10.0% to +10.0%; |G(v/a)|/G₀ 1.05 to 1.40" in said
    (exponents,) = paper_losses.sheets(data)["paper-losses-shifts"]
    assert (exponents["expected"], exponents[EVERY], exponents["simulated"]) == (-0.75, -0.7654, -0.7)


def test_a_point_of_the_losses_without_an_answer_is_left_out_and_said():
    whole = lossy()
    first, *others = whole.whole.collapse.curves
    cut = Curve(first.speed, first.log_load[1:], first.log_friction[1:], first.error[1:])
    collapsed = replace(whole.whole.collapse, curves=(cut, *others))
    lost = replace(whole, whole=replace(whole.whole, collapse=collapsed), failed=24)
    expected = paper_losses.simulation(whole)
    expected[0, 0] = np.nan
    np.testing.assert_allclose(paper_losses.simulation(lost), expected, rtol=ROUNDING)
    line = drawn(paper_losses, [lost]).axes[0].lines[0]
    assert np.isnan(line.get_ydata()).tolist() == [True] + [False] * 9
    assert "24 solves failed; 1 points without any answer are left out" in paper_losses.caption([lost])
