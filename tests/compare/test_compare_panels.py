"""Figures of curves: axes end where the data do, a depth is one place for all models, and few curves are drawn."""

import numpy as np
import pytest
from drawn_again import from_files
from pandas import DataFrame

from compare.figures import force_depth, friction_speed, shades
from compare.figures.style import LABEL


def points(name, across, places):
    """Both models, 1D twice as high as 3D."""
    rows = DataFrame([(solver, at, k * at) for solver, k in (("MDR", 2.0), ("BEM", 1.0)) for at in places])
    rows.columns = ["model", across, f"{name}_mean"]
    return rows.assign(**{f"{name}_{end}": k * rows[f"{name}_mean"] for end, k in (("low", 0.9), ("high", 1.1))})


def test_a_line_decades_below_does_not_press_the_curves_together():
    curves = points("friction_coefficient", "speed", (0.1, 1.0))
    lines = DataFrame({"model": ["MDR"] * 2, "kind": "Eq. 19", "speed": [0.1, 1.0], "friction_coefficient": 1e-6})
    axes = from_files(friction_speed.plot(curves, lines=lines)).axes[0]
    assert axes.get_ylim() == pytest.approx((0.09 / 1.2, 2.2 * 1.2))
    assert LABEL["MDR"] + ", Eq. 19" in axes.get_legend_handles_labels()[1]


def test_both_models_stand_at_the_depth_that_was_prescribed():
    depths = (1e-5, 2e-5)
    forces = points("normal_force", "depth", depths).assign(body="rough", closed_form=1.0)
    for axes in from_files(force_depth.plot(forces, DataFrame())).axes[:2]:
        places = [bars[0].get_xdata().astype(float) for bars in axes.containers]
        np.testing.assert_allclose(places, 2 * [1e6 * np.array(depths)], rtol=1e-12)


@pytest.mark.parametrize("count", [1, 3, 8, 30])
def test_few_values_keep_the_least_and_the_greatest(count):
    values = np.geomspace(1, 10, count)
    chosen = shades.few(values[::-1], 8)
    assert len(chosen) == min(count, 8)
    assert (chosen[0], chosen[-1]) == (values[0], values[-1])
