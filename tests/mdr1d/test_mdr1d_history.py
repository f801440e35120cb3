"""Programs in one dimension: forces of Lee and Radok, jumps that meet the glass, steps in time, and errors."""

import numpy as np
import pytest
from changing_motion import program
from maps import refused
from solids import BALL, CHAIN, CYCLES, KELVIN, ROUGH, ROUNDING, SERIES, SOLID, SOLIDS

from compare.models.exact import indentation
from mdr1d import MDR
from mdr1d.timeline import timeline
from scene import Elastic, Indent, Scene, SolveError

# Between two times at which it just touches, the chord of a convex recovery presses in. Measured: 1.3e-4.
CHORD = 1e-3
# Orders fitted over two octaves, of errors that jump with the place of the contact's edge in its pixel.
ORDER, SPREAD = 2.0, 0.3


def solved(motion, elastomer=SOLID, shape=BALL, roughness=None, **settings):
    return MDR(**settings).solve(Scene(shape, elastomer, motion, roughness))


def order(sizes, errors):
    return np.polyfit(np.log(sizes), np.log(errors), 1)[0]


CYCLE = program(*({"duration": duration, "depth": depth} for duration, depth in CYCLES["depth"]))


@pytest.mark.parametrize("solid", ["kelvin", "series"])
def test_a_prescribed_depth_has_no_error_in_time(solid):
    few, many = (solved(CYCLE, SOLIDS[solid], points=200, steps=steps) for steps in (1, 500))
    for name in ("work", "dissipated", "stored"):
        assert few.fields[name][-1] == pytest.approx(many.fields[name][-1], rel=ROUNDING)
    assert few.normal_force == pytest.approx(many.normal_force, rel=ROUNDING)
    np.testing.assert_allclose(few.fields["displacement"], many.fields["displacement"], atol=ROUNDING * 0.2)


def test_a_sudden_step_meets_the_glass():
    """Its force is that of a hard case, stages without end."""
    result = solved(program({"duration": 1e-9, "depth": 0.1}))
    glass = solved(Indent(depth=0.1), Elastic(1.25))
    assert result.measures["stiffness"] == pytest.approx(glass.measures["stiffness"], rel=1 / 1000)
    assert result.measures["contact_fraction"] == 1.0
    suddenly = solved(
        program({"duration": 1.0, "depth": 0.1}, {"duration": 1e-9, "depth": 0.1 + 1e-5}), points=4000
    )
    before, after = suddenly.fields["normal_force"][[-21, -1]]
    assert suddenly.fields["time"][-21] == 1.0
    assert (after - before) / 1e-5 == pytest.approx(suddenly.measures["stiffness"], rel=1 / 1000)


def test_a_load_held_creeps_as_lee_and_radok_say_at_second_order_in_the_step():
    motion, steps = program({"duration": 1.0, "load": 0.1}, {"duration": 3.0}), np.array([100, 200, 400])
    exact = indentation.loading_depth(BALL, CHAIN, [0, 1, 4], [0, 0.1, 0.1], 4.0)[0]
    errors = [abs(solved(motion, CHAIN, points=4000, steps=n).depth / exact - 1) for n in steps]
    assert order(1 / steps, errors) == pytest.approx(ORDER, abs=SPREAD)
    assert errors[1] < 1e-4


def test_the_depths_found_under_a_load_give_the_load_back():
    found = solved(
        program({"duration": 1.0, "load": 0.1}, {"duration": 0.2, "load": 0.02}, {"duration": 0.3}),
        SERIES,
        points=300,
        steps=30,
    )
    times, depths, loads = (found.fields[name] for name in ("time", "depth", "normal_force"))
    durations = np.diff(times, prepend=0.0)
    motion = program(*({"duration": t, "depth": d} for t, d in zip(durations, depths, strict=True)))
    extent = found.settings["extent"]
    back = solved(motion, SERIES, points=300, extent=extent, steps=1)
    again = np.interp(times, back.fields["time"], back.fields["normal_force"])
    # Steps as short as some 1e-3 of a relaxation time turn rounding of the depth into 1e-12 of force.
    np.testing.assert_allclose(again, loads, atol=1e-10 * loads.max())


@pytest.mark.parametrize("solid", ["elastic", "kelvin", "series"])
def test_without_load_the_indenter_rests_on_the_surface_that_recovers(solid):
    motion = program({"duration": 1.0, "load": 0.1}, {"duration": 0.2, "load": 0.0}, {"duration": 2.0})
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


def test_friction_does_not_depend_on_where_in_a_pixel_the_program_ends():
    def friction(path):
        motion = program({"duration": 1.0, "depth": 0.1}, {"duration": path / SPEED, "speed": SPEED})
        return solved(motion, **STARTED).friction_force

    whole, part = friction(6.0), friction(6.0042)
    assert part == pytest.approx(whole, rel=1e-9)


def test_steps_end_where_the_indenter_passes_a_whole_pixel():
    motion = program(
        {"duration": 1.0, "depth": 0.1},
        {"duration": 1.0, "speed": 0.35},
        {"duration": 0.5},
        {"duration": 1.0, "speed": 1.0},
    )
    line = timeline(motion, 0.1, 40)
    slid = line.passed + line.end
    np.testing.assert_allclose(slid, motion.path(line.times[1:]) / 0.1, atol=1e-8)
    assert np.all((line.begin >= 0) & (line.end <= 1) & (line.end >= line.begin))
    assert {0.0, 1.0, 2.0, 2.5, 3.5} <= set(line.times.round(12))
    whole = np.arange(1, 14)
    assert np.abs(slid[:, None] - whole).min(axis=0).max() < 1e-8


def test_steps_lengthen_from_the_start_of_each_stage():
    motion = program({"duration": 1.0, "depth": 0.1}, {"duration": 3.0})
    times = timeline(motion, 0.1, 200).times
    k = np.arange(1, 51)
    np.testing.assert_allclose(times[1:51], (k / 50) ** 2, rtol=ROUNDING)
    np.testing.assert_allclose(times[51:] - 1.0, 3.0 * (np.arange(1, 151) / 150) ** 2, rtol=ROUNDING)


def test_a_dashpot_that_slides_on_its_last_pixels_is_an_error_and_no_friction():
    """Under a load the contact of a fast Kelvin solid shrinks below a pixel; its friction would be anything."""
    slow, fast = (
        program({"duration": 1.0, "load": 0.1}, {"duration": 0.3 / speed, "speed": speed}) for speed in (1.0, 1e6)
    )
    assert 0 < solved(slow, KELVIN, points=400).friction_coefficient < 1
    refused("the contact spans 1 pixels", solved, fast, KELVIN, error=SolveError, points=400)


def test_a_load_lost_in_the_rounding_of_the_heights_is_no_answer():
    light = program({"duration": 1.0, "load": 1e-25}, {"duration": 1.0, "speed": 0.01})
    refused("differ by more than rounding allows", solved, light, error=SolveError, roughness=ROUGH, points=50)


@pytest.mark.parametrize("solid", ["elastic", "kelvin"])
def test_rough_contact_of_a_few_elements_is_no_answer(solid):
    # The steady sweep knows it on less than a pixel; elements a pixel apart miss the force between them.
    light = program({"duration": 1.0, "load": 1e-6}, {"duration": 1.0, "speed": 0.3})
    with pytest.raises(SolveError, match=r"spans [1-4] pixels of 0\.01 m, 5 are needed"):
        solved(light, SOLIDS[solid], roughness=ROUGH, points=200, extent=2.0)
