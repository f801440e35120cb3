"""An indenter that turns back, changes its speed, comes in at an angle and oscillates over a foundation."""

from decimal import Decimal

import changing_motion as motions
import numpy as np
import pytest
from changing_motion import program
from solids import BALL, CYCLES, KELVIN, ROUGH, ROUNDING, SOLID, SOLIDS

import mdr1d.timeline
from mdr1d import MDR, marching
from scene import Scene, Slide

DEPTH, SPEED = 0.1, 0.3


def slid(path, speed=SPEED, **given):
    return motions.slid(path, speed, **given)


def pressed(by="depth"):
    return {"duration": 1.0, by: DEPTH}


def solved(motion, elastomer=SOLID, roughness=None, **settings):
    settings = {"points": 200, "extent": 1.0, "steps": 50} | settings
    return MDR(**settings).solve(Scene(BALL, elastomer, motion, roughness))


# Out of the grid and back into it, past where it began, and on again; turned within pixels, which are 0.005.
THERE_AND_BACK = program(pressed(), slid(1.3017), slid(-1.9003), {"duration": 0.3}, slid(0.7771))


@pytest.mark.parametrize(("solid", "roughness"), [("kelvin", None), ("series", ROUGH)])
def test_what_leaves_the_grid_is_found_again_as_if_the_grid_had_held_it(solid, roughness):
    near, far = (solved(THERE_AND_BACK, SOLIDS[solid], roughness, points=200 * n, extent=1.0 * n) for n in (1, 5))
    for name in ("normal_force", "friction_force", "depth", "contact_length", "work", "dissipated", "stored"):
        expected = far.fields[name]
        np.testing.assert_allclose(near.fields[name], expected, atol=ROUNDING * max(1e-3, np.abs(expected).max()))
    inside = np.abs(far.fields["x"] - near.fields["x"].mean()) < 0.5
    np.testing.assert_allclose(near.fields["displacement"], far.fields["displacement"][inside], atol=ROUNDING)


@pytest.mark.parametrize(
    ("solid", "stages"),
    [
        # the last 3 m are new to it, and the grid is 1 m long
        ("kelvin", (slid(2.0), slid(-5.0))),
        ("series", (slid(2.0), slid(-5.0))),
        ("standard", (slid(2.0, 0.03), slid(2.0))),
        ("standard", (slid(2.0), {"duration": 3.0}, slid(2.0))),
    ],
)
def test_after_a_change_of_the_speed_friction_comes_to_that_of_steady_sliding(solid, stages):
    steady = solved(Slide(speed=SPEED, depth=DEPTH), SOLIDS[solid])
    result = solved(program(pressed(), *stages), SOLIDS[solid])
    assert result.friction_force == pytest.approx(np.sign(stages[-1]["speed"]) * steady.friction_force, rel=1e-9)
    assert result.normal_force == pytest.approx(steady.normal_force, rel=0.02)  # edges are known to an element


def approached(speed, approach, **settings):
    motion = program({"duration": DEPTH / approach, "depth": DEPTH, "speed": speed})
    return solved(motion, KELVIN, steps=200, **settings)


# Places of the edges in their pixels.
EXTENTS = np.linspace(1.0, 1.1, 5)


@pytest.mark.parametrize(("speed", "approach"), [(0.0, 0.02), (0.02, 0.02), (3.0, 0.2)])
def test_an_oblique_approach_on_a_kelvin_solid_is_the_closed_form_friction_that_of_a_moment_ago(speed, approach):
    now = DEPTH / approach
    force, latest = motions.oblique(1.0, KELVIN, speed, approach, now)
    for extent in EXTENTS[::2]:
        result = approached(speed, approach, points=600, extent=extent)
        # at the front of a dashpot an element carries its whole force at once: an edge is known to 1/190
        assert result.normal_force == pytest.approx(force, rel=3 / 380)
        if speed == 0:
            assert abs(result.friction_force) < ROUNDING * result.normal_force
            continue
        # the mean over the last pixel slid is half a pixel late, and each of two edges is met up to one later
        pixel = result.settings["pixel"]
        _, earlier = motions.oblique(1.0, KELVIN, speed, approach, now - 2.5 * pixel / speed)
        assert earlier < result.friction_force < latest


WORKED = {
    **{by: program(*({"duration": time, by: value} for time, value in cycle)) for by, cycle in CYCLES.items()},
    "reversal": THERE_AND_BACK,
    "fretting": program(pressed(), *(slid(0.0237 * (-1) ** k) for k in range(20))),
    "reversal without load": program(pressed("load"), slid(0.3, load=0.0), slid(-0.4), slid(-0.1, load=DEPTH)),
    "oscillation": program(
        pressed("load"), {"duration": 3.0, "speed": -SPEED, "load": DEPTH, "amplitude": 0.04, "frequency": 1.3}
    ),
    "oscillation of depth": program(
        pressed(), {"duration": 3.0, "speed": SPEED, "depth": 0.05, "amplitude": 0.02, "frequency": 0.7}, slid(-1)
    ),
}


@pytest.mark.parametrize(
    ("motion", "solid"),
    [*((motion, "series") for motion in WORKED), ("reversal", "elastic"), ("load", "kelvin"), ("depth", "kelvin")],
)
def test_work_of_the_indenter_is_what_is_stored_and_what_is_lost(solid, motion):
    result = solved(WORKED[motion], SOLIDS[solid])
    work, lost, stored = (result.fields[name] for name in ("work", "dissipated", "stored"))
    np.testing.assert_allclose(stored + lost, work, atol=1e-10 * work.max())
    assert np.all(np.diff(lost) >= -ROUNDING * work.max())
    assert np.all(stored >= -ROUNDING * work.max())
    assert result.fields["normal_force"].min() >= 0
    assert np.all(lost == 0) if solid == "elastic" else lost[-1] > 0.01 * work.max()


SWUNG = {"duration": 2.0, "depth": 0.08, "speed": 0.01, "amplitude": 0.03, "frequency": 0.9}


def test_an_oscillation_of_the_depth_is_followed_at_second_order_in_the_step(monkeypatch):
    counts, work = np.array([10, 20, 40]), []
    for count in (*counts, 640):
        monkeypatch.setattr(mdr1d.timeline, "PERIOD", count)
        work.append(solved(program(pressed(), SWUNG), steps=1).fields["work"][-1])
    errors = np.abs(np.array(work[:-1]) / work[-1] - 1)
    assert -np.polyfit(np.log(counts), np.log(errors), 1)[0] == pytest.approx(2.0, abs=0.3)
    assert errors[-1] < 5e-3


@pytest.mark.parametrize("by", ["depth", "load"])
def test_an_oscillation_has_two_hundred_steps_a_period_at_least_and_is_met_at_each_of_their_ends(by):
    swing = SWUNG | {"speed": 0.0, by: 0.08} if by == "depth" else {k: v for k, v in SWUNG.items() if k != "depth"}
    motion = program(pressed(by), swing)
    fields = solved(motion, steps=1).fields
    within = fields["time"] > 1.0
    assert np.diff(fields["time"][within]).max() <= (1 + 1e-9) / 200 / 0.9
    found = fields["depth" if by == "depth" else "normal_force"]
    np.testing.assert_allclose(found, motion.prescribed(fields["time"]), rtol=1e-12)


def test_a_load_is_met_at_the_place_of_a_step_at_which_a_dashpot_creeps_linearly():
    for z in (1e-6, 9.99e-4, 1.001e-3, 1.0, 50.0):
        place = 1 / (1 - (-Decimal(z)).exp()) - 1 / Decimal(z)
        assert marching._place(z) == pytest.approx(float(place), rel=1e-10)


@pytest.mark.parametrize(("path", "solid"), [(1e-3, "series"), (4.99999e-3, "kelvin"), (0.005, "series")])
def test_a_reversal_within_the_first_pixels_is_followed_as_by_far_smaller_ones(solid, path):
    motion = program(pressed(), slid(path), slid(-2 * path), slid(path))
    coarse, fine = (solved(motion, SOLIDS[solid], points=points) for points in (200, 800))
    assert coarse.normal_force == pytest.approx(fine.normal_force, rel=2 / 126)  # edges, known to an element
    assert coarse.fields["path"][-1] == pytest.approx(0.0, abs=1e-15)
