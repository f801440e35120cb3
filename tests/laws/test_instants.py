"""Instants that a solver keeps of a program cost nothing unasked, and are the contact then."""

from dataclasses import replace

import numpy as np
import pytest
from changing_motion import program
from drawn_scenes import DIP, KELVIN, LIFT, LOAD, ROUGH, TAU, R

from bem3d import BEM
from mdr1d import MDR
from scene import Scene, Sphere

RUN = program({"duration": 2 * TAU, "load": LOAD}, {"duration": 4 * TAU, "speed": 0.2})
LINE, SPACE = MDR(points=200, steps=20), BEM(points=32, steps=20)
RUNNING = Scene(Sphere(R), KELVIN, RUN, ROUGH)


@pytest.mark.parametrize("solver", [LINE, SPACE])
@pytest.mark.parametrize("motion", [RUN, DIP, pytest.param(LIFT, marks=pytest.mark.slow)])
def test_instants_are_kept_of_the_same_march_to_the_last_digit(solver, motion):
    scene = replace(RUNNING, motion=motion)
    plain, kept = (each.solve(scene) for each in (solver, replace(solver, frames=5)))
    assert not [name for name in plain.fields if name.startswith("frame")]
    for name, values in plain.fields.items():
        np.testing.assert_array_equal(kept.fields[name], values)
    times = kept.fields["frame_time"]
    assert len(times) == 5
    steps = plain.fields["time"]
    # as near as the steps are to each other, where the longest is a twentieth of a stage
    wanted = motion.duration * np.arange(1, 6) / 5
    assert np.abs(times - wanted).max() <= np.diff(steps, prepend=0).max()


def test_instants_in_three_dimensions_are_the_contact_then():
    kept = replace(SPACE, frames=6).solve(RUNNING).fields
    patch = (kept["x"][1] - kept["x"][0]) ** 2
    for k, time in enumerate(kept["frame_time"]):
        step = int(np.argmin(np.abs(kept["time"] - time)))
        force = kept["frame_pressure"][k].sum() * patch
        assert force == pytest.approx(kept["normal_force"][step], rel=1e-9)
    np.testing.assert_array_equal(kept["frame_pressure"][-1], kept["pressure"])
    assert np.abs(kept["frame_shift"]).max() <= 1.01 * (kept["x"][1] - kept["x"][0])
