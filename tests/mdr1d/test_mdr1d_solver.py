"""The solver as seen from outside: what it refuses, what it reports, and the cases that break others."""

import re
from dataclasses import replace

import pytest
from changing_motion import program
from sliding import PAPER, ROUGH, SMOOTH

from mdr1d import MDR
from scene import Indent, Scene, SolveError, Sphere


def test_smooth_and_resolved_scenes_say_so():
    smooth, resolved = MDR().solve(SMOOTH), MDR().solve(ROUGH)
    assert smooth.settings["cutoff"] is None
    assert "rms_height" not in smooth.measures
    assert resolved.settings["cutoff"] == "resolved"
    assert resolved.measures["points_per_shortest_wave"] == pytest.approx(1e-4 / resolved.settings["pixel"])
    assert resolved.settings["points"] >= 5000


def test_a_grid_too_coarse_for_the_spectrum_is_refused_with_the_points_it_takes():
    for scene in (ROUGH, PAPER):
        for extent in (None, 1.7e-3, 9.1e-3, 0.2):
            solver = MDR(points=8, extent=extent)
            reasons = solver.refusals(scene)
            if not reasons:
                assert scene is PAPER
                continue
            assert "longest = 0.004" in reasons[0]
            points = int(re.search(r"at least points = (\d+)", reasons[0])[1])
            assert replace(solver, points=points).refusals(scene) == []
            assert replace(solver, points=points // 2).refusals(scene) != []


def test_a_grid_beyond_memory_is_refused():
    assert "pixels, more than" in MDR(extent=1e-9).refusals(PAPER)[0]
    # of a number of three hundred digits the first are enough
    assert len(MDR(extent=1e-290).refusals(PAPER)[0]) < 250
    assert len(MDR(extent=1e290).refusals(PAPER)[0]) < 250


@pytest.mark.parametrize("seed", [4, 5])
def test_a_spot_on_either_side_of_the_grid_counts(seed):
    # A spot beyond the grid reaches down on one side alone: behind it with the one seed, ahead with the other.
    rough = replace(PAPER.roughness, seed=seed)
    for motion in (Indent(depth=1e-6), program({"duration": 1.0, "depth": 1e-6})):
        with pytest.raises(SolveError, match="leaves the grid"):
            MDR(points=100, extent=1e-3).solve(Scene(Sphere(radius=0.1), PAPER.elastomer, motion, rough))
