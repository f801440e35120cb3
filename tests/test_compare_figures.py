"""What each figure draws, line by line, against closed forms and the numbers that were put in."""

from dataclasses import replace
from math import sqrt

import matplotlib.colors
import numpy as np
import pytest
from test_compare_verdict import CASE, DEVIATION, RMS_SLOPE, ROUGH, SMOOTH, judged, law, scatter

from compare import exact
from compare.cases import Study
from compare.figures import collapse, force_depth, friction_load, friction_speed, smooth_limit, style
from compare.verdict import load_curves
from scene.scales import elastic_contact

RADIUS, STIFFNESS, TIME = 1e-2, 4e6, 1e-3
ROUNDING = 1e-9


@pytest.fixture(scope="module")
def judgement():
    return judged()


def drawn(module, judgement):
    with style.applied():
        drawing = module.figure(judgement)
        drawing.draw_without_rendering()
    return drawing


def labelled(axes):
    """Artists of the legend by their label."""
    return dict(zip(*reversed(axes.get_legend_handles_labels()), strict=True))


def dotted(axes):
    return [line for line in axes.lines if line.get_linestyle() == ":" and line.get_xdata().size]


def eq_19(load, speed):
    """For a sphere, c = 1/R, n = 2: sqrt 2 s (1 + xi^-1.5)^(-1/1.5) with xi = v tau s E* 2a / (sqrt 2 F)."""
    a = (3 * load * RADIUS / (4 * STIFFNESS)) ** (1 / 3)
    xi = speed * TIME * RMS_SLOPE / sqrt(2) * 2 * STIFFNESS * a / load
    return sqrt(2) * RMS_SLOPE * (1 + xi**-1.5) ** (-1 / 1.5)


def test_friction_over_speed_shows_means_their_ratio_and_eq_19(judgement):
    above, below = drawn(friction_speed, judgement).axes
    for solver in ("MDR", "BEM"):
        line, *_ = labelled(above)[style.LABEL[solver]]
        assert line.get_xdata() == pytest.approx([0.1, 1.0])
        assert line.get_ydata() == pytest.approx([ROUGH[solver] * law(1.0, v) for v in (0.1, 1.0)], rel=ROUNDING)
    (line,) = dotted(above)
    assert line.get_ydata() == pytest.approx(eq_19(1.0, line.get_xdata()), rel=ROUNDING)
    assert below.containers[0][0].get_ydata() == pytest.approx([0.6, 0.6], rel=ROUNDING)


def test_friction_over_load_shows_eq_19_at_every_speed_and_says_so_once(judgement):
    left, right = drawn(friction_load, judgement).axes
    lines = dotted(left)
    assert len(lines) == 3
    for line, speed in zip(lines, (0.1, 0.2, 0.3), strict=True):
        assert line.get_ydata() == pytest.approx(eq_19(line.get_xdata(), speed), rel=ROUNDING)
    assert [label for label in labelled(left) if "Eq. 19" in label] == ["Eq. 19 at each speed"]
    assert not dotted(right)
    assert "Eq. 19" in friction_load.caption(judgement)
    line, *_ = labelled(right)["0.2 m/s"]
    expected = [ROUGH["BEM"] * law(load, 0.2) for load in CASE.study.pressing]
    assert line.get_ydata() == pytest.approx(expected, rel=ROUNDING)


def test_the_limits_of_the_smooth_body_are_the_closed_forms(judgement):
    """For a sphere mu = v tau / R in 3D, and the slope at the edge is a / R: the lines are x and 2 x."""
    above, below = drawn(smooth_limit, judgement).axes
    found = labelled(above)
    for dimension, factor, friction in (
        ("1D", 2, exact.slow_friction_1d),
        ("3D", 1, exact.slow_friction_3d),
    ):
        line = found[f"{dimension} limit"]
        assert line.get_ydata() == pytest.approx(factor * line.get_xdata(), rel=ROUNDING)
        contact = elastic_contact(CASE.scene)
        speed = line.get_xdata() * contact.radius / TIME
        force = friction(speed, contact.radius, TIME, STIFFNESS, 1 / RADIUS, 2)
        slope = exact.edge_slope(CASE.indenter, contact.radius)
        assert line.get_ydata() == pytest.approx(force / contact.load / slope, rel=ROUNDING)
    slope = elastic_contact(CASE.scene).radius / RADIUS
    for solver in ("MDR", "BEM"):
        points = found[style.LABEL[solver]]
        assert points.get_xdata() == pytest.approx([0.01, 0.1, 1.0, 10.0, 100.0])
        assert points.get_ydata() == pytest.approx(np.full(5, SMOOTH[solver] / slope), rel=ROUNDING)
    assert below.lines[-1].get_ydata() == pytest.approx(np.full(5, 1.99), rel=ROUNDING)


def test_force_over_depth_shows_the_closed_form_and_the_deviation(judgement):
    above, below = drawn(force_depth, judgement).axes
    line = labelled(above)["smooth, closed form"]
    depth = line.get_xdata() * 1e-6
    assert line.get_ydata() == pytest.approx(4 / 3 * STIFFNESS * sqrt(RADIUS) * depth**1.5, rel=ROUNDING)
    rough = labelled(below)["rough"]
    assert rough[0].get_ydata() == pytest.approx([100 * d for d, _ in DEVIATION.values()], rel=ROUNDING)
    bars = [100 * (1 + d) * other / sqrt(3) for d, other in DEVIATION.values()]
    halves = [np.ptp(segment[:, 1]) / 2 for segment in rough[2][0].get_segments()]
    assert halves == pytest.approx(bars, rel=ROUNDING)


def test_the_worst_bar_does_not_set_the_scale_and_is_marked_where_it_is_cut(judgement):
    _, below = drawn(force_depth, judgement).axes
    low, high = below.get_ylim()
    # The largest value is -30 %, its bar 24 %; the others end at -5.6 % and -3.7 %.
    assert -40 < low < -30
    assert 0 < high < 10
    arrows = {line.get_marker(): line.get_xdata() for line in below.lines if line.get_marker() in ("v", "^")}
    least = 0.5 * elastic_contact(CASE.scene).depth * 1e6
    assert arrows["v"] == pytest.approx([least])
    assert arrows["^"].size == 0


def test_collapse_shifts_as_eq_23_predicts_on_axes_that_can_be_compared(judgement):
    drawing = drawn(collapse, judgement)
    panels = {axes.get_title(loc="left"): axes for axes in drawing.axes}
    limits = {axes.get_ylim() for title, axes in panels.items() if title != "best shifts"}
    assert len(limits) == 1
    for solver, dimension in (("MDR", "1D"), ("BEM", "3D")):
        for title, power in (("as solved", 0.0), ("by Eq. 23", -1.5), ("best shifts", -1.5)):
            for bars, curve in zip(
                panels[f"{dimension}, {title}"].containers, load_curves(judgement.table, solver), strict=True
            ):
                x = np.exp(curve.log_load) * (curve.speed / 0.2) ** power
                # The fit finds the shifts to the root of what rounding leaves of the misfit.
                assert bars[0].get_xdata() == pytest.approx(x, rel=1e-5)
                (segments,) = (part.get_segments() for part in bars[2])
                mu = np.exp(curve.log_friction)
                assert [np.ptp(s[:, 1]) / 2 for s in segments] == pytest.approx(mu * scatter(solver), rel=ROUNDING)
    (line,) = [line for line in panels["best shifts"].lines if line.get_label().startswith("Eq. 23")]
    assert line.get_ydata() == pytest.approx(-1.5 * np.log(line.get_xdata() / 0.2), rel=ROUNDING)


@pytest.mark.slow
def test_a_shift_at_its_bound_is_hollow_and_has_no_error(judgement):
    stopped = replace(judgement.collapses["BEM"], overlaps=False, shift_errors=np.full(3, np.nan))
    for given, barred in ((replace(judgement, collapses={"BEM": stopped}), False), (judgement, True)):
        panel = next(a for a in drawn(collapse, given).axes if a.get_title(loc="left") == "best shifts")
        found = panel.containers[-1]
        assert found.has_yerr == barred
        hollow = matplotlib.colors.same_color(found[0].get_markerfacecolor(), "white")
        assert hollow != barred


def test_one_value_of_everything_is_drawn_without_a_warning():
    study = Study(
        speeds=(0.1,), pressing=(1.0,), load_speeds=(0.1,), depths=(1.0,), surfaces=3, profiles=3
    )  # fmt: skip
    single = judged(replace(CASE, study=study))
    for module in (force_depth, friction_speed, friction_load, smooth_limit):
        for axes in drawn(module, single).axes:
            low, high = axes.get_xlim()
            assert high > 1.1 * low
