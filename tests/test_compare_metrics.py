"""Means, scatter and ratios against numbers worked out by hand, and the honesty of what is missing."""

from math import isnan, nan, sqrt

import numpy as np
import pytest

from compare import metrics
from compare.metrics import Estimate, estimate, pooled_scatter
from compare.outcome import Outcome, Row
from compare.study import Point, Task
from mdr1d import MDR
from scene import Kelvin, Scene, SelfAffine, Slide, Sphere

SCENE = Scene(
    Sphere(radius=1e-2),
    Kelvin(modulus=1e6, relaxation_time=1e-3),
    Slide(speed=0.1, load=1.0),
    SelfAffine(hurst=0.5, rms_height=1e-6, longest=1e-2),
)


def test_estimate_is_mean_deviation_and_standard_error():
    found = estimate([1.0, 2.0, 3.0, 6.0])
    assert found == Estimate(3.0, pytest.approx(sqrt(14 / 3)), pytest.approx(sqrt(14 / 3) / 2), 4)


def test_failed_surfaces_are_left_out_and_counted():
    assert estimate([1.0, nan, 3.0]) == estimate([1.0, 3.0])
    row = Row(normal_force=1.0, depth=1e-4, friction_force=0.2, residual=1e-9, seconds=2.0)
    task = Task(MDR(), (SCENE, SCENE))
    (record,) = metrics.records([Point("own", (task,))], {task: Outcome((row, Row(reason="no")))})
    assert record.failures == ("no",)
    assert record.friction_coefficient.count == 1
    assert record.friction_coefficient.mean == pytest.approx(0.2)
    assert record.seconds == 2.0
    assert record.columns["failures"] == 1


def test_one_surface_has_no_scatter_and_none_has_no_mean():
    assert isnan(estimate([1.0]).error)
    assert isnan(estimate([nan]).mean)
    assert estimate([]).count == 0


def test_error_of_a_ratio_is_that_of_repeated_draws():
    rng = np.random.default_rng(1)
    above, below = 2 + 0.02 * rng.normal(size=20000), 1 + 0.03 * rng.normal(size=20000)
    value, error = metrics.ratio(Estimate(2.0, nan, 0.02, 9), Estimate(1.0, nan, 0.03, 9))
    assert value == 2.0
    # To first order: 3 % squared is what it leaves out; 20000 draws know their deviation to 0.5 %.
    assert error == pytest.approx(np.std(above / below), rel=0.02)
    assert metrics.relative_deviation(Estimate(2.0, nan, 0.02, 9), Estimate(1.0, nan, 0.03, 9)) == (1.0, error)


def test_a_ratio_to_nothing_is_undecided():
    nothing = Estimate(0.0, 0.0, 0.0, 5)
    assert all(isnan(value) for value in metrics.ratio(Estimate(1.0, 0.1, 0.1, 5), nothing))
    assert isnan(metrics.ratio(Estimate(1.0, nan, nan, 1), Estimate(2.0, 0.1, 0.1, 5))[1])


def test_the_pooled_scatter_is_that_of_all_values_and_steadier_than_that_of_a_few():
    rng = np.random.default_rng(0)
    drawn = [estimate(scale * (1 + 0.03 * rng.normal(size=3))) for scale in np.geomspace(1e-3, 10, 200)]
    # 400 degrees of freedom: 3.5 %.
    assert pooled_scatter(drawn) == pytest.approx(0.03, rel=0.12)
    assert min(each.deviation / each.mean for each in drawn) < 0.005
    assert pooled_scatter([drawn[0], estimate([5.0])]) == pytest.approx(drawn[0].deviation / drawn[0].mean)
    assert np.isnan(pooled_scatter([estimate([5.0]), estimate([6.0])]))
