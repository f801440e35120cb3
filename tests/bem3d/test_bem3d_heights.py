"""Heights that another code is given are those on which this one has solved."""

from dataclasses import replace

import numpy as np
import pytest

from bem3d import BEM, heights
from scene import Cylinder, Elastic, Indent, Plane, Program, Scene, SelfAffine, SolveError, Sphere, Stage

ROUGH = SelfAffine(hurst=0.8, rms_height=1e-6, longest=1e-3, shortest=1.25e-4, seed=3)
ELASTIC = Elastic(1e6)
BODY = Scene(Sphere(1e-2), ELASTIC, Indent(depth=1e-4), ROUGH)
SCENES = {
    "body": BODY,
    "plane": Scene(Plane(), ELASTIC, Indent(pressure=1e4), ROUGH),
    "line": Scene(Cylinder(1e-2), ELASTIC, Indent(line_load=100.0)),
    "program": replace(BODY, motion=Program(stages=(Stage(duration=1.0, depth=1e-4),))),
}


@pytest.mark.parametrize("name", SCENES)
def test_heights_are_those_of_a_result(name):
    answer = BEM(points=64, steps=3).solve(SCENES[name])
    extent = None if name == "plane" else answer.settings["extent"]
    found = heights(SCENES[name], 64, extent)
    if answer.settings["centre"] == (0.0, 0.0):
        np.testing.assert_array_equal(found.x, answer.fields["x"])
        np.testing.assert_array_equal(found.height, answer.fields["height"])
    assert found.height.shape == answer.fields["pressure"].shape == (len(found.y), len(found.x))
    assert found.height.dtype == float
    assert found.pixel == answer.measures["pixel"]


def test_a_grid_that_cannot_carry_the_waves_is_refused():
    with pytest.raises(SolveError, match="less than two pixels"):
        heights(BODY, 64, extent=1.0)
