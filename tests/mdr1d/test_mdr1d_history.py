"""Programs in one dimension against Lee, Radok and Ting, a plain march, the steady sweep, and their own energy."""

from math import atan

import numpy as np
import pytest
from solids import BALL, CYCLES, ELASTIC, KELVIN, ROUGH, ROUNDING, SERIES, SOLID, SOLIDS

from compare.models.exact import indentation
from mdr1d import MDR
from mdr1d.timeline import timeline
from scene import Cone, Elastic, Indent, PowerLaw, Program, Scene, Slide, SolveError, Stage

CONE = Cone(atan(1.0))
# Between two times at which it just touches, the chord of a convex recovery presses in. Measured: 1.3e-4.
CHORD = 1e-3
# Orders fitted over two octaves, of errors that jump with the place of the contact's edge in its pixel.
ORDER, SPREAD = 2.0, 0.3


def program(*stages):
    """Of (duration, what is prescribed at its end)."""
    return Program(stages=tuple(Stage(duration=duration, **given) for duration, given in stages))


def solved(motion, elastomer=SOLID, shape=BALL, roughness=None, **settings):
    return MDR(**settings).solve(Scene(shape, elastomer, motion, roughness))


def order(sizes, errors):
    return np.polyfit(np.log(sizes), np.log(errors), 1)[0]


INDENTED = ((2.0, {"depth": 0.2}), (0.2, {"depth": 0.18}), (0.3, {"depth": 0.15}))
CYCLE = program(*((duration, {"depth": depth}) for duration, depth in CYCLES["depth"]))


@pytest.mark.parametrize(
    ("shape", "printed"), [(BALL, (0.3625433, 0.2381208, 0.0989532)), (CONE, (0.0832869, 0.0505988, 0.0170847))]
)
def test_loading_and_unloading_are_those_of_ting_to_the_printed_digits(shape, printed):
    result = solved(program(*INDENTED), shape=shape, points=10000)
    force = np.interp([2.0, 2.2, 2.5], result.fields["time"], result.fields["normal_force"])
    np.testing.assert_allclose(force, printed, atol=0.6e-7)  # half of the last digit, and the grid


def test_the_error_of_unloading_is_of_second_order_in_the_pixel():
    exact, _ = indentation.force_of_depth(BALL, SOLID, [0, 2, 3], [0, 0.2, 0.1], 2.5)
    points, motion = np.array([100, 200, 400]), program(*INDENTED)
    errors = []
    for n in points:  # over several places of the edge in its pixel
        found = [solved(motion, points=n, extent=e, steps=1).normal_force for e in np.linspace(0.95, 1.05, 12)]
        errors.append(np.sqrt(np.mean((np.array(found) / exact - 1) ** 2)))
    assert order(1 / points, errors) == pytest.approx(ORDER, abs=SPREAD)


@pytest.mark.parametrize(("solid", "shape"), [(SOLID, CONE), (SERIES, PowerLaw(coefficient=1.0, exponent=4.0))])
def test_a_depth_that_rises_and_is_held_gives_the_force_of_lee_and_radok(solid, shape):
    result = solved(program((1.0, {"depth": 0.1}), (3.0, {})), solid, shape, points=4000)
    times, force = result.fields["time"], result.fields["normal_force"]
    exact = indentation.loading_force(shape, solid, [0, 1, 4], [0, 0.1, 0.1], times)
    late = times > 0.2  # a fifth of the depth
    np.testing.assert_allclose(force[late], exact[late], rtol=1e-5)  # the grid, at some 1000 points in contact


@pytest.mark.parametrize("solid", ["kelvin", "series"])
def test_a_prescribed_depth_has_no_error_in_time(solid):
    few, many = (solved(CYCLE, SOLIDS[solid], points=200, steps=steps) for steps in (1, 500))
    for name in ("work", "dissipated", "stored"):
        assert few.fields[name][-1] == pytest.approx(many.fields[name][-1], rel=ROUNDING)
    assert few.normal_force == pytest.approx(many.normal_force, rel=ROUNDING)
    np.testing.assert_allclose(few.fields["displacement"], many.fields["displacement"], atol=ROUNDING * 0.2)


def plainly(elastomer, approaches, step):
    """Backward Euler for the retardation modes of one element: its displacement, no events and no algebra."""
    instantaneous, compliances, times = elastomer.retardation()
    gain = step / (step + times)
    kept, pushed = 1 - gain, gain * compliances
    softness, w = instantaneous + pushed.sum(), np.zeros(times.size)
    for approach in approaches:
        w *= kept
        force = max(approach - w.sum(), 0.0) / softness
        w += pushed * force
    return instantaneous * force + w.sum()


@pytest.mark.parametrize("solid", ["series", "chain with a dashpot"])
def test_a_plain_march_of_each_element_converges_to_the_history_at_its_order(solid):
    depths = np.array([0.2, 0.05, 0.12, 0.01, 0.15, 0.1])
    result = solved(program(*((0.5, {"depth": d}) for d in depths)), SOLIDS[solid], points=96, extent=1.2, steps=1)
    some = {name: result.fields[name][::6] for name in ("profile", "displacement", "contact")}
    parts, errors = (200, 400, 800), []
    for n in parts:
        depth = np.interp(np.arange(1, 6 * n + 1) / n, np.arange(7), [0.0, *depths])
        found = [plainly(SOLIDS[solid], depth - g, 0.5 / n) for g in some["profile"]]
        errors.append(np.linalg.norm(found - some["displacement"]))
    touched = some["displacement"] > 0
    assert np.count_nonzero(touched & ~some["contact"]) >= 2
    assert order(1 / np.array(parts), errors) == pytest.approx(1.0, abs=0.1)
    assert errors[-1] < 1e-2 * np.linalg.norm(some["displacement"])


def test_an_elastic_foundation_follows_its_closed_form_and_has_no_history():
    result = solved(CYCLE, ELASTIC)
    depth, force = result.fields["depth"], result.fields["normal_force"]
    np.testing.assert_allclose(force, 4 / 3 * depth**1.5, atol=1e-6 * force.max())
    at_rest = solved(Indent(depth=0.16), ELASTIC)
    # Whole elements: an edge is known to half a pixel on either side.
    assert result.measures["stiffness"] == pytest.approx(at_rest.measures["stiffness"], rel=1 / 1000)
    under_load = solved(program((1.0, {"load": 0.1})), ELASTIC)
    assert under_load.depth == pytest.approx((0.75 * 0.1) ** (2 / 3), rel=1e-6)


def test_a_sudden_step_meets_the_glass():
    result = solved(program((1e-9, {"depth": 0.1})))
    glass = solved(Indent(depth=0.1), Elastic(1.25))
    assert result.normal_force == pytest.approx(glass.normal_force, rel=1e-6)
    assert result.measures["stiffness"] == pytest.approx(glass.measures["stiffness"], rel=1 / 1000)
    suddenly = solved(program((1.0, {"depth": 0.1}), (1e-9, {"depth": 0.1 + 1e-5})), points=4000)
    before, after = suddenly.fields["normal_force"][[-21, -1]]
    assert suddenly.fields["time"][-21] == 1.0
    assert (after - before) / 1e-5 == pytest.approx(suddenly.measures["stiffness"], rel=1 / 1000)


@pytest.mark.parametrize("solid", ["standard", "chain with a dashpot"])
def test_a_load_held_creeps_as_lee_and_radok_say_at_second_order_in_the_step(solid):
    # Where a time is resolved: the shortest of the series is a fiftieth of the ramp.
    motion, steps = program((1.0, {"load": 0.1}), (3.0, {})), np.array([100, 200, 400])
    exact = indentation.loading_depth(BALL, SOLIDS[solid], [0, 1, 4], [0, 0.1, 0.1], 4.0)[0]
    errors = [abs(solved(motion, SOLIDS[solid], points=4000, steps=n).depth / exact - 1) for n in steps]
    assert order(1 / steps, errors) == pytest.approx(ORDER, abs=SPREAD)
    assert errors[1] < 1e-4


def test_a_kelvin_solid_creeps_to_a_pixel():
    result = solved(program((1.0, {"load": 0.1}), (3.0, {})), KELVIN)
    times = result.fields["time"]
    exact = indentation.loading_depth(BALL, KELVIN, [0, 1, 4], [0, 0.1, 0.1], times)
    late = times > 0.3
    np.testing.assert_allclose(result.fields["depth"][late], exact[late], rtol=1e-3)
    assert result.depth == pytest.approx(exact[-1], rel=1e-5)


def test_the_depths_found_under_a_load_give_the_load_back():
    found = solved(program((1.0, {"load": 0.1}), (0.2, {"load": 0.02}), (0.3, {})), SERIES, points=300, steps=30)
    times, depths, loads = (found.fields[name] for name in ("time", "depth", "normal_force"))
    durations = np.diff(times, prepend=0.0)
    motion = program(*((t, {"depth": d}) for t, d in zip(durations, depths, strict=True)))
    extent = found.settings["extent"]
    back = solved(motion, SERIES, points=300, extent=extent, steps=1)
    again = np.interp(times, back.fields["time"], back.fields["normal_force"])
    # Steps as short as some 1e-3 of a relaxation time turn rounding of the depth into 1e-12 of force.
    np.testing.assert_allclose(again, loads, atol=1e-10 * loads.max())


@pytest.mark.parametrize("solid", ["elastic", "kelvin", "series"])
def test_without_load_the_indenter_rests_on_the_surface_that_recovers(solid):
    motion = program((1.0, {"load": 0.1}), (0.2, {"load": 0.0}), (2.0, {}))
    result = solved(motion, SOLIDS[solid], points=500)
    free = result.fields["time"] > 1.2
    depth = result.fields["depth"][free]
    assert np.all(np.diff(depth) <= 0)
    if solid != "elastic":
        assert 0 < depth[-1] < 0.9 * depth[0]
    first = (result.fields["displacement"] + result.fields["profile"]).min()
    assert result.depth == pytest.approx(first, rel=CHORD, abs=ROUNDING)
    assert result.normal_force == 0
    assert result.friction_force == pytest.approx(0.0, abs=1e-6)


STARTED = {"points": 200, "extent": 2.0, "steps": 50}
SPEED = 0.3


@pytest.mark.parametrize("by", ["depth", pytest.param("load", marks=pytest.mark.slow)])
def test_force_and_depth_of_sliding_tend_to_the_steady_ones_at_second_order(by):
    motion = program((1.0, {by: 0.1}), (20.0, {"speed": SPEED}))
    points, errors = np.array([100, 200, 400]), []
    for n in points:
        missed = []
        for extent in np.linspace(1.9, 2.1, 6):
            settings = {"points": int(n), "extent": extent}
            found = solved(motion, steps=50, **settings)
            steady = solved(Slide(speed=SPEED, **{by: 0.1}), **settings)
            for name in ("normal_force", "depth", "friction_force"):
                missed.append(getattr(found, name) / getattr(steady, name) - 1)
        errors.append(np.linalg.norm(missed))
    assert order(1 / points, errors) == pytest.approx(ORDER, abs=SPREAD)
    assert errors[-1] < 2e-3


def test_friction_does_not_depend_on_where_in_a_pixel_the_program_ends():
    def friction(path):
        motion = program((1.0, {"depth": 0.1}), (path / SPEED, {"speed": SPEED}))
        return solved(motion, **STARTED).friction_force

    whole, part = friction(6.0), friction(6.0042)
    assert part == pytest.approx(whole, rel=1e-9)


def test_steps_end_where_the_indenter_passes_a_whole_pixel():
    motion = program((1.0, {"depth": 0.1}), (1.0, {"speed": 0.35}), (0.5, {}), (1.0, {"speed": 1.0}))
    line = timeline(motion, 0.1, 40)
    slid = line.passed + line.end
    np.testing.assert_allclose(slid, motion.path(line.times[1:]) / 0.1, atol=1e-8)
    assert np.all((line.begin >= 0) & (line.end <= 1) & (line.end >= line.begin))
    assert {0.0, 1.0, 2.0, 2.5, 3.5} <= set(line.times.round(12))
    whole = np.arange(1, 14)
    assert np.abs(slid[:, None] - whole).min(axis=0).max() < 1e-8


def test_steps_lengthen_from_the_start_of_each_stage():
    motion = program((1.0, {"depth": 0.1}), (3.0, {}))
    times = timeline(motion, 0.1, 200).times
    k = np.arange(1, 51)
    np.testing.assert_allclose(times[1:51], (k / 50) ** 2, rtol=ROUNDING)
    np.testing.assert_allclose(times[51:] - 1.0, 3.0 * (np.arange(1, 151) / 150) ** 2, rtol=ROUNDING)


def test_short_steps_late_in_a_program_keep_to_the_pixels():
    # A step is 1e-6 s after 30 s: the time at its end is known to 1e-9 of it.
    motion = program((30.0, {"load": 0.1}), (1e-4, {"speed": 3e3}))
    result = solved(motion, ELASTIC, points=200, extent=1.2)
    work, kept = result.fields["work"], result.fields["stored"] + result.fields["dissipated"]
    np.testing.assert_allclose(kept, work, atol=ROUNDING * work.max())


def test_rough_indenters_begin_with_their_peaks_pressed_in():
    result = solved(program((1.0, {"depth": 0.0}), (1.0, {"depth": 0.05})), roughness=ROUGH, points=500)
    assert result.fields["normal_force"][0] > 0
    assert result.fields["work"][0] > 0
    smooth = solved(program((1.0, {"load": 1e-9}), (1.0, {"load": 0.05})), roughness=ROUGH, points=500)
    assert smooth.fields["depth"][0] < 0


def test_a_dashpot_that_slides_on_its_last_pixels_is_an_error_and_no_friction():
    """Under a load the contact of a fast Kelvin solid shrinks below a pixel; its friction would be anything."""
    for speed, fits in ((1.0, True), (1e6, False)):
        motion = program((1.0, {"load": 0.1}), (0.3 / speed, {"speed": speed}))
        if fits:
            assert 0 < solved(motion, KELVIN, points=400).friction_coefficient < 1
            continue
        with pytest.raises(SolveError, match="the contact spans 1 pixels"):
            solved(motion, KELVIN, points=400)


def test_what_cannot_be_followed_says_what_to_change():
    deep = program((1.0, {"depth": 0.1}))
    with pytest.raises(SolveError, match=r"leaves the grid, whose extent is 0\.1 m: take a larger extent"):
        solved(deep, extent=0.1)
    with pytest.raises(SolveError, match=r"spans 3 pixels of 0\.25 m, 5 are needed"):
        solved(deep, extent=2.0, points=8)
    endless = program((1.0, {"depth": 0.1}), (1e200, {"speed": 1e200}), (1e200, {"speed": 1e-200}))
    with pytest.raises(SolveError, match="slide a shorter path"):
        solved(endless, points=50)


def test_a_load_lost_in_the_rounding_of_the_heights_is_no_answer():
    light = program((1.0, {"load": 1e-25}), (1.0, {"speed": 0.01}))
    with pytest.raises(SolveError, match="differ by more than rounding allows"):
        solved(light, roughness=ROUGH, points=50)


@pytest.mark.parametrize("solid", ["elastic", "kelvin"])
def test_rough_contact_of_a_few_elements_is_no_answer(solid):
    # The steady sweep knows it on less than a pixel; elements a pixel apart miss the force between them.
    light = program((1.0, {"load": 1e-6}), (1.0, {"speed": 0.3}))
    with pytest.raises(SolveError, match=r"spans [1-4] pixels of 0\.01 m, 5 are needed"):
        solved(light, SOLIDS[solid], roughness=ROUGH, points=200, extent=2.0)
