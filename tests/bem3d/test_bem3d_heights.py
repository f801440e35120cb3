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


def test_what_touches_has_the_heights_of_the_deformed_surface():
    # At the pixels' centres, where a contact at rest has its gap: all in touch lies at the depth less the height.
    wide = BEM(points=64, tolerance=1e-9).solve(replace(BODY, roughness=None))
    touched, height = wide.fields["pressure"] > 0, wide.fields["height"]
    x, y = wide.fields["x"], wide.fields["y"]
    np.testing.assert_allclose(height, (x[None, :] ** 2 + y[:, None] ** 2) / 2e-2, rtol=1e-14)
    assert height[touched].max() < wide.depth


def test_a_window_is_fitted_where_none_is_stated():
    found = heights(BODY, 64)
    assert found.pixel * 64 == pytest.approx(BEM(points=64).solve(BODY).settings["extent"], rel=0.1)


def test_a_grid_that_cannot_carry_the_waves_is_refused():
    with pytest.raises(SolveError, match="less than two pixels"):
        heights(BODY, 64, extent=1.0)
