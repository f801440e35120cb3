"""Figures of a study show the numbers they are given, each dimensionality in its place, whatever is missing."""

import warnings
from dataclasses import replace

import matplotlib.colors
import numpy as np
import pytest
from matplotlib.figure import Figure

from bem3d import BEM
from compare.figures import (
    study_collapse,
    study_depth,
    study_effects,
    study_family,
    study_levels,
    study_pressed_in,
    study_shifts,
    study_verdicts,
    style,
)
from compare.finding import Finding
from compare.statistics.jackknife import Estimated
from compare.shifting import Samples, shift
from compare.studies import points, tableau
from compare.studies.catalogue import SIZES, Study
from compare.studies.judgement import JudgedSeries, JudgedStudy
from compare.studies.laws import laws
from compare.studies.series import (
    CONTACT,
    FINE,
    REST,
    ROUGH,
    SMOOTH,
    SMOOTH_REST,
    Answers,
    Key,
    Series,
    Solved,
)
from mdr1d import MDR
from mdr1d.equations import interpolation
from scene import Indent, Kelvin, Program, Scene, SelfAffine, Slide, Sphere, Stage, StandardLinearSolid
from scene.scales import elastic_contact

ROUNDING = 1e-12
# A jackknife and an error to first order differ by the square of the scatter, here some 1e-2.
FIRST_ORDER = 0.02
SPEEDS, LOADS = (0.01, 0.03, 0.1, 0.3, 1.0), (0.5, 1.0, 2.0, 4.0, 8.0, 16.0)
SURFACES = {"MDR": 8, "BEM": 4}
SCATTER, SLOPE = 0.03, 0.3
SCENE = Scene(
    indenter=Sphere(radius=1e-2),
    elastomer=Kelvin(modulus=1e6, relaxation_time=1e-3),
    motion=Slide(speed=1.0, load=1.0),
    roughness=SelfAffine(hurst=0.8, rms_height=1e-5, longest=1e-2, shortest=1e-3, seed=1),
)
SERIES = Series("sphere", "Rough sphere", SCENE, SPEEDS, LOADS, 4, 8, BEM(points=64), MDR(points=5000))
RATIO = 0.7  # of friction in 3D to that in 1D
STIFFER = 1.1  # force of the rough body over the closed form


def answers(solver, body, load, depth, friction=0.0, surfaces=1):
    """Answers (speeds, presses, surfaces) of a body; each rough surface has a factor of friction of its own."""
    rng = np.random.default_rng(7)
    shape = (*np.shape(load)[:2], surfaces)
    each = 1 + (SCATTER * rng.standard_normal(surfaces) if surfaces > 1 else 0)
    load, depth, friction = (np.broadcast_to(np.asarray(x)[..., None], shape) for x in (load, depth, friction))
    measures = {
        "rms_slope": SLOPE,
        "pixel": 1e-5,
        "rms_slope_contact": SLOPE if body in (ROUGH, REST) else SLOPE / 3,
        "contact_length": 1e-3,
        "contact_area": 1e-6,
        "curvature_by_pressure": 50.0 if body in (ROUGH, REST) else 20.0,
    }
    measures = {name: np.full(shape, value) for name, value in measures.items() if name != CONTACT[_other(solver)]}
    return Answers(
        points=64,
        normal_force=load * np.ones(shape),
        friction_force=friction * each,
        depth=depth * np.ones(shape),
        contact=measures[CONTACT[solver]],
        measures=measures,
        reasons=(),
        seconds=1.0,
    )


def _other(solver):
    return "MDR" if solver == "BEM" else "BEM"


def sliding(series=SERIES, surfaces=SURFACES):
    """mu is one function of v F^(-2/3), in 3D by a factor less; that of smooth bodies is half in 3D."""
    speeds, loads = np.array(series.speeds)[:, None], np.array(series.presses)
    contacts = [elastic_contact(series.at(press)) for press in series.presses]
    depth = np.array([contact.depth for contact in contacts])
    found = {}
    for solver, level, smooth in (("MDR", 1.0, 1.0), ("BEM", RATIO, 0.5)):
        mu = level * 0.3 * interpolation(10 * speeds * loads ** (-2 / 3))
        still, moving = np.ones((1, 1)), np.ones_like(speeds)
        count = surfaces[solver]
        bodies = {
            ROUGH: (moving * loads, moving * depth, mu * loads, count),
            SMOOTH: (moving * loads, moving * depth, 0.1 * smooth * mu * loads, 1),
            REST: (still * loads, still * depth * 0.9, still * 0.0, count),
            SMOOTH_REST: (still * loads, still * depth, still * 0.0, 1),
        }
        for body, numbers in bodies.items():
            found[Key(solver, body, FINE)] = answers(solver, body, *numbers)
    return Solved(series, found)


def resting(speeds=()):
    """At rest at prescribed depths, and pressed in at rates where there are any."""
    depths = (5e-5, 1e-4, 2e-4, 4e-4)
    motion = Indent(depth=depths[0])
    scene = replace(SCENE, motion=motion)
    if speeds:
        solid = StandardLinearSolid(rubbery_modulus=1e6, glassy_modulus=1e7, relaxation_time=1e-3)
        scene = replace(scene, elastomer=solid, motion=Program(stages=(Stage(duration=1.0, depth=depths[0]),)))
    series = replace(SERIES, name="rest", title="Rough sphere at rest", scene=scene, speeds=speeds, presses=depths)
    force = np.array([elastic_contact(series.at(press)).load for press in depths])
    found = {}
    for solver, count in SURFACES.items():
        stiffer = 1.0 if solver == "MDR" else STIFFER
        depth = np.array([depths])
        found[Key(solver, REST, FINE)] = answers(solver, REST, [stiffer * force], depth, surfaces=count)
        found[Key(solver, SMOOTH_REST, FINE)] = answers(solver, SMOOTH_REST, [force], depth)
        if speeds:
            moving = np.ones((len(speeds), 1))
            found[Key(solver, ROUGH, FINE)] = answers(
                solver, ROUGH, stiffer * 2 * force * moving, depth * moving, surfaces=count
            )
            found[Key(solver, SMOOTH, FINE)] = answers(solver, SMOOTH, 2 * force * moving, depth * moving)
    return JudgedSeries(Solved(series, found), {}, {}, findings())


def spoiled(solved, key, where):
    """The same with answers missing somewhere."""
    old = solved.answers[key]
    numbers = {name: getattr(old, name).copy() for name in ("normal_force", "friction_force", "depth", "contact")}
    measures = {name: values.copy() for name, values in old.measures.items()}
    for values in (*numbers.values(), *measures.values()):
        values[where] = np.nan
    new = replace(old, measures=measures, reasons=(("BEM sphere", "it would not <converge>"),), **numbers)
    return replace(solved, answers={**solved.answers, key: new})


def judged(solved, shifted=True, found=None):
    """With laws, and shifts where they can be found."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # laws average what may be missing
        ruled = {solver: laws(solved, solver) for solver in SURFACES}
    shiftings = {}
    if shifted:
        for solver in SURFACES:
            one = solved(solver)
            shiftings[solver] = shift(Samples(np.array(SPEEDS), one.normal_force, one.friction_force))
    return JudgedSeries(solved, ruled, shiftings, findings() if found is None else found)


def finding(claim, dimension, value, half=0.01, grid=0.01, **other):
    """Of a claim that expects 1 within 0.05."""
    numbers = {"value": value, "statistical": (value - half, value + half), "grid": grid, "surfaces": 4}
    said = {"regime": "d/h0 5", "figure": "study-levels", "text": f"how {claim} was measured"}
    return Finding(claim=claim, dimension=dimension, expected=1.0, tolerance=0.05, **numbers | said | other)


def findings():
    """One of each verdict, far and near, with and without errors."""
    return (
        finding("holds in one", "1D", 1.01),
        finding("holds in one", "3D", 1.5),
        finding("nothing known <b>", "1D", 1.02, grid=np.nan),
        finding("nothing known <b>", "3D", np.nan, undecidable="no <overlap>", figure="study-collapse"),
        finding("far away", "1D", 1e3, surfaces=0, half=0.0),
        finding("the same in both", "1D/3D", 0.8, figure="study-depth"),
    )


def study(*series, whole=()):
    """Some series together."""
    return JudgedStudy(
        "try", Study("A <question> & more?", "About.", lambda size: []), SIZES["quick"], series, whole
    )


@pytest.fixture(scope="module")
def whole():
    return judged(sliding())


def drawn(module, data):
    with style.applied():
        drawing = module.figure(data)
        drawing.draw_without_rendering()
    return drawing


def bars(axes):
    """Of every error bar: x, y and the ends of its bars, colour."""
    found = []
    for container in axes.containers:
        line, _, (stem,) = container.lines
        ends = np.array([path for path in stem.get_segments()])[:, :, 1]
        found.append((*line.get_data(), ends.T, matplotlib.colors.to_hex(line.get_color())))
    return found


def of_solver(axes, solver):
    return next(bar for bar in bars(axes) if bar[3] == style.COLOUR[solver].lower())


def labelled(axes):
    return dict(zip(*reversed(axes.get_legend_handles_labels()), strict=True))


def test_the_collapse_shows_means_and_their_errors_at_every_speed(whole):
    axes = drawn(study_collapse, whole).axes
    for column, solver in enumerate(SURFACES):
        one = whole.solved(solver)
        mu = one.friction_force / one.normal_force
        assert len(bars(axes[column])) == len(SPEEDS)
        for i, (x, y, ends, _) in enumerate(bars(axes[column])):
            np.testing.assert_allclose(x, LOADS, rtol=ROUNDING)
            np.testing.assert_allclose(y, mu[i].mean(axis=1), rtol=ROUNDING)
            error = mu[i].std(axis=1, ddof=1) / np.sqrt(mu.shape[2])
            np.testing.assert_allclose(ends[1] - ends[0], 2 * error, rtol=1e-9)


def test_what_is_left_is_the_shifted_curves_less_the_common_one(whole):
    axes = drawn(study_collapse, whole).axes
    for column, solver in enumerate(SURFACES):
        found = whole.shiftings[solver]
        fit = found.horizontal
        common = labelled(axes[2 + column])["common curve"]
        x, y = common.get_data()
        np.testing.assert_allclose(np.log(y), fit.curve(np.log(x)), rtol=1e-9)
        for (x, y, _, _), curve, b in zip(bars(axes[4 + column]), found.curves, fit.horizontal.value, strict=True):
            np.testing.assert_allclose(np.log(x), curve.log_load + b, atol=1e-9)
            np.testing.assert_allclose(y, 100 * (curve.log_friction - fit.curve(np.log(x))), atol=1e-9)
        said = axes[4 + column].get_title(loc="right")
        assert (
            said
            == f"δ = {fit.misfit.value:.1%} ({fit.misfit.interval()[0]:.1%} to {fit.misfit.interval()[1]:.1%})"
        )


def test_the_law_in_the_collapse_is_one_curve_through_the_middle_speed(whole):
    axes = drawn(study_collapse, whole).axes
    x, y = labelled(axes[2])["Eq. 19 with p(v)"].get_data()
    middle = len(SPEEDS) // 2
    law = whole.laws["MDR"].law[middle]
    np.testing.assert_allclose(np.interp(np.log(LOADS), np.log(x), y), law, rtol=1e-9)
    assert np.all(np.diff(y) < 0)


def test_curves_that_cannot_be_shifted_are_shown_with_the_shifts_of_theory(whole):
    for data, reason in (
        (replace(whole, shiftings={}), "too few points"),
        (_parted(whole), "the fit asks for less overlap"),
    ):
        drawing = drawn(study_collapse, data)
        assert len(drawing.axes) == 5  # two rows and the bar of colours
        for column, solver in enumerate(SURFACES):
            axes, ruled = drawing.axes[2 + column], whole.laws[solver]
            moved = ruled.shifts - ruled.shifts[len(SPEEDS) // 2]
            for (x, *_), shifted in zip(bars(axes), moved, strict=True):
                np.testing.assert_allclose(np.log(x), np.log(LOADS) + shifted, atol=1e-9)
            assert reason in axes.get_legend().get_title().get_text().replace("\n", " ")
        if data.shiftings:
            assert reason in study_collapse.caption(data)


def _parted(whole):
    """The same with fits that leave no overlap."""

    def part(found):
        lost = {"horizontal": Estimated(np.full(len(SPEEDS), np.nan), np.full(len(SPEEDS), np.nan), 0)}
        gone = replace(found.horizontal, curve=None, reason="the fit asks for less overlap", **lost)
        return replace(found, horizontal=gone)

    return replace(whole, shiftings={solver: part(found) for solver, found in whole.shiftings.items()})


def test_shifts_are_drawn_with_intervals_of_95_per_cent(whole):
    left, middle, right = drawn(study_shifts, whole).axes
    for solver, found in whole.shiftings.items():
        for axes, numbers in ((left, found.horizontal.horizontal), (right, found.both.vertical)):
            _, y, ends, _ = of_solver(axes, solver)
            np.testing.assert_allclose(y, numbers.value, atol=1e-12)
            np.testing.assert_allclose(ends, numbers.interval(), atol=1e-9)
        theory = study_shifts.predicted(whole, solver)
        np.testing.assert_allclose(
            of_solver(middle, solver)[1], found.horizontal.horizontal.value - theory, atol=1e-12
        )
    assert theory[len(SPEEDS) // 2] == 0


def test_levels_show_the_slow_limit_of_each_dimensionality_and_ratios(whole):
    axes = drawn(study_levels, whole).axes
    ratios = points.quotient(*(points.friction(whole.solved, solver) for solver in SURFACES))
    for panel, place in zip(axes[:3], (0, len(LOADS) // 2, len(LOADS) - 1), strict=True):
        for solver, dimension in (("MDR", "1D"), ("BEM", "3D")):
            slow = labelled(panel)[f"{dimension}, low speed"]
            np.testing.assert_allclose(slow.get_ydata(), whole.laws[solver].slow[:, place], rtol=ROUNDING)
            _, y, _, _ = of_solver(panel, solver)
            np.testing.assert_allclose(y, whole.solved(solver).friction[:, place], rtol=ROUNDING)
    rough, smooth = bars(axes[3]), bars(axes[4])
    assert len(rough) == len(smooth) == len(LOADS)
    for j, ((_, y, _, _), (_, even, _, _)) in enumerate(zip(rough, smooth, strict=True)):
        np.testing.assert_allclose(y, ratios.value[:, j], rtol=ROUNDING)
        np.testing.assert_allclose(even, 2 / RATIO, rtol=1e-9)


def test_depth_shows_the_stiffer_body_and_its_secants():
    data = resting()
    whole, deviation, difference, stiff = drawn(study_depth, data).axes
    series = data.solved.series
    force = np.array([elastic_contact(series.at(press)).load for press in series.presses])
    line = labelled(whole)["smooth, closed form"]
    np.testing.assert_allclose(line.get_ydata(), force, rtol=ROUNDING)
    rough = labelled(deviation)["3D, rough"].lines[0]
    np.testing.assert_allclose(rough.get_ydata(), 100 * (STIFFER - 1), rtol=1e-9)
    np.testing.assert_allclose(
        labelled(difference)["rough"].lines[0].get_ydata(), 100 * (1 / STIFFER - 1), rtol=1e-9
    )
    np.testing.assert_allclose(labelled(difference)["smooth"].lines[0].get_ydata(), 0, atol=1e-9)
    secants = labelled(stiff)["3D, rough"].lines[0].get_ydata()
    np.testing.assert_allclose(secants, 1e-3 * STIFFER * np.diff(force) / np.diff(series.presses), rtol=1e-9)


def test_depth_under_loads_is_given_in_rms_heights_off_the_smooth_one(whole):
    deviation, difference = drawn(study_depth, whole).axes[1:3]
    depth = np.array([elastic_contact(SERIES.at(press)).depth for press in LOADS])
    rough = labelled(deviation)["1D, rough"].lines[0].get_ydata()
    np.testing.assert_allclose(rough, -0.1 * depth / SCENE.roughness.rms_height, rtol=1e-9)
    np.testing.assert_allclose(labelled(difference)["rough"].lines[0].get_ydata(), 0, atol=1e-9)


def test_force_of_what_is_pressed_in_is_compared_at_equal_rate_and_depth():
    one, three, ratio = drawn(study_pressed_in, resting(speeds=(0.01, 0.1))).axes[:3]
    assert len(bars(one)) == len(bars(three)) == len(bars(ratio)) == 2
    for _, y, _, _ in bars(ratio):
        np.testing.assert_allclose(y, 100 * (1 / STIFFER - 1), rtol=1e-9)


def marks(axes):
    """Position, colour, marker and filling of what stands for verdicts."""
    return [
        (*(float(v[0]) for v in line.get_data()), line.get_color(), line.get_marker(), line.get_markerfacecolor())
        for line in axes.lines
        if line.get_linestyle() == "None" and len(line.get_xdata()) == 1
    ]


def test_each_verdict_has_its_mark_in_the_column_of_its_series_and_dimension(whole):
    asked = study(whole, resting(), whole=(finding("of all", "3D", 1.0),))
    (axes,) = drawn(study_verdicts, asked).axes
    found = marks(axes)
    assert len(found) == len(tableau.every(asked)) == 2 * len(findings()) + 1
    claims = [text.get_text().replace("\n", " ") for text in axes.get_yticklabels()]
    assert claims == ["holds in one", "nothing known <b>", "far away", "of all", "the same in both"]
    looks = {"holds": ("o", True), "fails": ("x", True), "undecided": ("o", False)}
    seen = {(round(x, 2), round(y)): (marker, face != "white") for x, y, _, marker, face in found}
    for column, each in enumerate(tableau.columns(asked)):
        for one in each.findings:
            x = column + {"1D": -0.25, "3D": 0.25, "1D/3D": 0.0}[one.dimension]
            assert seen[(x, claims.index(one.claim))] == looks[one.verdict]
    written = [text.get_text() for text in axes.texts]
    assert "nan" not in written
    assert "1e+03" in written


def test_many_series_go_by_their_numbers(whole):
    many = [
        replace(whole, solved=replace(whole.solved, series=replace(SERIES, name=f"s{k}", title=f"T{k}")))
        for k in range(14)
    ]
    asked = study(*many)
    (axes,) = drawn(study_verdicts, asked).axes
    assert [text.get_text() for text in axes.get_xticklabels()] == [str(k) for k in range(1, 15)]
    assert "14: T13." in study_verdicts.caption(asked)
    assert not axes.texts


def test_effects_stand_at_their_tolerances_and_beyond_the_end_as_arrows(whole):
    (axes,) = drawn(study_effects, whole).axes
    found = marks(axes)
    inside = [one for one in findings() if abs(one.effect) <= study_effects.END]
    for one in inside:
        with style.applied():
            colour = style.COLOUR[study_effects.SOLVER[one.dimension]]
        assert any(abs(x - one.effect) < 1e-9 and c == colour for x, _, c, _, _ in found)
    assert [x for x, _, _, marker, _ in found if marker == ">"] == [study_effects.END]
    with style.applied():
        widths = [style.width(times) for times in (2.0, 0.65)]
    thick, thin = ([line for line in axes.lines if line.get_linewidth() == width] for width in widths)
    known = [one for one in findings() if np.isfinite(one.value)]
    assert len(thick) == len(known)
    assert len(thin) == len(known) - 1  # one has no error of discretisation
    words = [text.get_text() for text in axes.texts]
    assert sorted(words) == sorted(one.verdict for one in findings())


def test_one_variable_puts_all_series_on_the_curve_they_were_made_of(whole):
    scene = replace(SCENE, roughness=replace(SCENE.roughness, hurst=0.2))
    series = replace(SERIES, name="again", title="Again", scene=scene)
    other = replace(whole, solved=replace(whole.solved, series=series))
    asked = study(whole, other)
    left, right = drawn(study_family, asked).axes
    for axes, solver in ((left, "MDR"), (right, "BEM")):
        expected = (whole.solved(solver).friction / whole.laws[solver].plateau).ravel()
        assert len(bars(axes)) == 2
        for x, y, _, _ in bars(axes):
            np.testing.assert_allclose(np.sort(x), np.sort(whole.laws[solver].xi.ravel()), rtol=1e-9)
            np.testing.assert_allclose(np.sort(y), np.sort(expected), rtol=1e-9)


SERIES_FIGURES = (study_collapse, study_shifts, study_levels, study_depth, study_effects, study_pressed_in)


def a_point_failed():
    """In three dimensions, on every surface: no law has a load there."""
    data, place = judged(sliding(), shifted=False), np.s_[0, 0]
    ruled = data.laws["BEM"]
    load = ruled.load.copy()
    load[place] = np.nan
    solved = spoiled(data.solved, Key("BEM", ROUGH, FINE), place)
    return replace(data, solved=solved, laws={**data.laws, "BEM": replace(ruled, load=load)})


def nothing_at_rest():
    lost = resting(speeds=(0.01, 0.1))
    return replace(lost, solved=spoiled(lost.solved, Key("BEM", REST, FINE), np.s_[:]))


HARD = {
    "a surface failed": lambda: judged(spoiled(sliding(), Key("BEM", ROUGH, FINE), np.s_[1, 2, 3])),
    "a point failed": a_point_failed,
    "one surface": lambda: judged(sliding(surfaces={"MDR": 1, "BEM": 1})),
    "no shifts and nothing asked": lambda: judged(sliding(), shifted=False, found=()),
    "at rest": resting,
    "pressed in": lambda: resting(speeds=(0.01, 0.1)),
    "nothing at rest": nothing_at_rest,
    "a single load": lambda: judged(sliding(replace(SERIES, presses=(1.0,))), shifted=False),
}


@pytest.mark.parametrize("case", HARD)
def test_hard_cases_are_drawn_or_left_out_never_made_up(case):
    data = HARD[case]()
    for module in SERIES_FIGURES:
        with style.applied():
            drawing = module.figure(data)
            assert drawing is None or isinstance(drawing, Figure)
            if drawing:
                drawing.draw_without_rendering()
                assert module.caption(data)
                assert "nan" not in module.caption(data)
        sheets = module.sheets(data)
        if drawing is None:
            assert not sheets
        for rows in sheets.values():
            assert rows
            assert len({tuple(row) for row in rows}) == 1


def test_what_does_not_apply_is_not_drawn(whole):
    for module, data in (
        (study_collapse, resting()),
        (study_shifts, resting()),
        (study_levels, resting()),
        (study_pressed_in, whole),
        (study_pressed_in, resting()),
        (study_effects, replace(whole, findings=())),
        (study_verdicts, study(replace(whole, findings=()))),
        (study_family, study(whole)),
    ):
        assert module.figure(data) is None
        assert not module.sheets(data)


def test_tables_hold_what_is_drawn(whole):
    rows = study_collapse.sheets(whole)["study-collapse"]
    assert len(rows) == 2 * len(SPEEDS) * len(LOADS)
    mu = np.concatenate([whole.solved(solver).friction.ravel() for solver in SURFACES])
    np.testing.assert_allclose([row["friction_coefficient"] for row in rows], mu, rtol=1e-9)
    rows = study_levels.sheets(whole)["study-levels"]
    np.testing.assert_allclose([row["friction_coefficient"] for row in rows], mu, rtol=ROUNDING)
    assert {row["dimension"] for row in rows} == {"1D", "3D"}
    rows = study_shifts.sheets(whole)["study-shifts"]
    assert [row["horizontal"] for row in rows[: len(SPEEDS)]] == whole.shiftings[
        "MDR"
    ].horizontal.horizontal.value.tolist()
    assert len(study_effects.sheets(whole)["study-effects"]) == len(findings())


def test_the_ratio_of_means_has_the_error_that_leaving_surfaces_out_gives():
    rng = np.random.default_rng(3)
    below = 1 + 0.05 * rng.standard_normal((2, 3, 12))
    above = 0.4 * below * (1 + 0.05 * rng.standard_normal(below.shape))
    found = points.mean_ratio(above, below)
    left = np.array([np.delete(above, k, 2).mean(2) / np.delete(below, k, 2).mean(2) for k in range(12)])
    np.testing.assert_allclose(found.value, above.mean(2) / below.mean(2), rtol=ROUNDING)
    np.testing.assert_allclose(found.error, left.std(axis=0) * np.sqrt(11), rtol=FIRST_ORDER)
    assert np.all(found.freedom == 11)


def test_a_missing_surface_leaves_the_mean_of_the_others():
    values = np.array([[1.0, 2.0, np.nan, 4.0], [np.nan, np.nan, np.nan, 5.0], [np.nan] * 4])
    found = points.mean_ratio(values)
    np.testing.assert_allclose(found.value[:2], [7 / 3, 5], rtol=ROUNDING)
    assert found.error[0] == pytest.approx(np.std([1, 2, 4], ddof=1) / np.sqrt(3), rel=ROUNDING)
    assert np.isnan(found.error[1:]).all()
    assert np.isnan(found.value[2])


def test_a_quotient_has_the_freedom_of_the_number_whose_error_rules():
    exact, rough = Estimated(2.0, 0.0, np.inf), Estimated(3.0, 0.3, 4)
    assert points.quotient(rough, exact).freedom == pytest.approx(4)
    assert points.quotient(rough, exact).error == pytest.approx(0.15)
    both = points.quotient(rough, Estimated(3.0, 0.3, 4))
    assert both.freedom == pytest.approx(8)
    assert both.error == pytest.approx(0.1 * np.sqrt(2))
    assert points.quotient(exact, exact).error == 0
