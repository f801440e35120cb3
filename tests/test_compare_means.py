"""How means are written on the page of effects."""

import numpy as np
import pytest
from effects_page.means import half, mean, written

from compare.metrics import estimate


def test_half_of_the_interval_of_three_is_by_student():
    # 4.30265 standard errors at two degrees of freedom, from a table of Student's distribution
    assert half(estimate([1.0, 2.0, 3.0])) == pytest.approx(4.30265 / np.sqrt(3), rel=1e-5)


def test_as_many_intervals_as_stated_hold_what_they_are_of():
    drawn = np.random.default_rng(1).normal(5.0, 2.0, (4000, 3))
    inside = np.mean([abs(value.mean - 5.0) < half(value) for value in map(estimate, drawn)])
    assert inside == pytest.approx(0.95, abs=3 * np.sqrt(0.95 * 0.05 / 4000))  # three standard errors of a count


def test_a_small_scatter_keeps_its_two_digits():
    text = mean([0.01030, 0.01031, 0.01032])
    assert text == "0.010310 ± 0.000025"


@pytest.mark.parametrize("values", [[0.25], [0.25, 0.25, 0.25], [0.25, 0.25 * (1 + 1e-9)]])
def test_of_one_body_and_of_bodies_that_are_alike_the_mean_stands_alone(values):
    assert mean(values) == "0.25"
    assert written(estimate(values), "N") == "0.25 N"


def test_of_no_body_there_is_no_number():
    assert mean([]) == "undecided"
    assert mean([np.nan]) == "undecided"
