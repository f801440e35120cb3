"""The sweep along a profile: its sums on any nodes, contact within one interval, and the depth under a load."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq
from sliding import ORDINARY

from mdr1d import lay_out, map_profile, sweep
from scene import SelfAffine

ROUGH = SelfAffine(hurst=0.6, rms_height=1e-5, longest=5e-4, shortest=5e-5, seed=4)
SCENE = replace(ORDINARY, roughness=ROUGH)
ROUNDING = 1e-11


@pytest.mark.parametrize(("lift", "lands"), [(-1e-9, True), (1e-9, False)])
def test_contact_that_begins_and_ends_within_one_interval_is_found(lift, lands):
    # Lengths in pixels, l = 1, d = 1. The surface leaves a flank of slope 0.7 where f = 1 - g - l g' vanishes,
    # and meets the next, flatter flank although both nodes of that stay clear of it.
    steep = 0.7
    u = steep * np.exp(-(1 - (1 / steep - 1)))
    node = 1 - steep

    def least_clearance(slope):
        return slope * (1 + np.log(u / slope)) - node

    slope = brentq(least_clearance, 0.05, u) + lift
    assert 0 < np.log(u / slope) < 1
    assert u * np.exp(-1) > node - slope
    heights = np.array([2.0, 0.0, steep, steep + slope, 5.0])
    assert (sweep(heights, 1.0, 1.0, 1.0).last > 2) is lands


@pytest.mark.parametrize("nodes", [2, 3, 64, 65, 66, 129, 200])
@pytest.mark.parametrize("memory", [0.0, 1e-5, 1e-3])
def test_a_line_that_touches_throughout_has_the_sums_over_its_nodes_however_many(nodes, memory):
    """Rounding of as many terms. It pulls on every flank: slopes are small compared with depth over memory."""
    pixel, depth = 1e-5, 1e-4
    heights = 1e-6 * np.random.default_rng(nodes).random(nodes) * min(1.0, pixel / max(memory, pixel))
    found = sweep(heights, pixel, memory, depth)
    slopes, means = np.diff(heights) / pixel, depth - (heights[1:] + heights[:-1]) / 2
    forces = pixel * (means - memory * slopes)
    # It comes undisturbed to the first node.
    assert found.touching[1:].all()
    assert (forces > 0).all()
    assert (found.length, found.force) == pytest.approx(((nodes - 1) * pixel, forces.sum()), rel=ROUNDING)
    assert found.traction == pytest.approx(-slopes @ forces, rel=ROUNDING, abs=ROUNDING * found.force)
    np.testing.assert_allclose(found.pushed[:, 1], forces, rtol=ROUNDING)


def test_nodes_between_those_of_a_line_change_nothing():
    """The flow past a line of straight pieces is exact on any nodes: tolerance rounding."""
    body = map_profile(SCENE, lay_out(SCENE, 160, 1.6e-3))
    heights, pixel = body.heights, body.pixel
    finer = np.interp(np.arange(3 * heights.size - 2) / 3, np.arange(heights.size), heights)
    for memory in (0.0, 1e-7, 1e-5, 1e-3):
        depth = heights.min() + 3e-5
        coarse, fine = sweep(heights, pixel, memory, depth), sweep(finer, pixel / 3, memory, depth)
        assert np.count_nonzero(np.diff(coarse.touching.astype(int)) == 1) >= 2
        for name in ("force", "dissipation", "stiffness", "length", "first", "last"):
            assert getattr(fine, name) == pytest.approx(getattr(coarse, name), rel=1e-9, abs=0.0), name
