"""Programs that turn back and oscillate: what is prescribed when, how far it goes, and what is refused."""

import numpy as np
import pytest
from changing_motion import program
from hypothesis import given
from hypothesis import strategies as st
from maps import refused

from scene import Stage
from scene.motion import Oscillation

# Sums of a few terms in double precision.
ROUNDING = 1e-12


FRETTING = program(
    {"duration": 1.0, "load": 2.0},
    {"duration": 3.0, "speed": 0.5},
    {"duration": 8.0, "speed": -0.5, "load": 1.0},
    {"duration": 1.0},
    {"duration": 2.0, "speed": 1.0},
)


def test_the_path_is_signed_and_the_length_is_not():
    assert FRETTING.path([0.0, 4.0, 7.0, 12.0, 13.0, 15.0]) == pytest.approx([0.0, 1.5, 0.0, -2.5, -2.5, -0.5])
    assert (FRETTING.length, FRETTING.span) == pytest.approx((1.5 + 4.0 + 2.0, 4.0))
    assert FRETTING.reverses
    assert not program({"duration": 1.0, "load": 1.0, "speed": 1.0}, {"duration": 1.0}).reverses


SWUNG = (
    {"duration": 1.0, "depth": 3.0},
    {"duration": 2.0, "depth": 4.0, "amplitude": 0.5, "frequency": 1.3},
    {"duration": 1.0},
    {"duration": 1.0, "depth": 1.0},
)


def test_an_oscillation_is_added_to_the_ramp_and_the_next_stage_starts_from_what_is_reached():
    swung = program(*SWUNG)
    times = np.linspace(1.0, 3.0, 101)
    expected = 3 + (times - 1) / 2 + 0.5 * np.sin(2 * np.pi * 1.3 * (times - 1))
    np.testing.assert_allclose(swung.prescribed(times), expected, rtol=ROUNDING)
    reached = 4 + 0.5 * np.sin(2 * np.pi * 2.6)
    assert swung.prescribed([3.0, 3.7, 4.0]) == pytest.approx([reached] * 3, rel=ROUNDING)
    assert swung.prescribed(4.5) == pytest.approx((reached + 1) / 2, rel=ROUNDING)
    assert abs(reached - 4) > 0.1


@pytest.mark.parametrize("halves", [1, 40, 12345])
@pytest.mark.parametrize("frequency", [0.3, 1e9 / 3])
def test_whole_half_periods_leave_exactly_nothing(halves, frequency):
    assert Oscillation(2.0, frequency, halves / 2 / frequency).last == 0.0


def test_an_amplitude_of_zero_is_none():
    held = program({"duration": 1.0, "load": 1.0}, {"duration": 1.0, "amplitude": 0.0, "frequency": 7.0})
    assert held.stages[1].oscillation is None
    times = np.linspace(0, 2, 50)
    plain = program({"duration": 1.0, "load": 1.0}, {"duration": 1.0})
    assert np.array_equal(held.prescribed(times), plain.prescribed(times))


@given(
    start=st.floats(0, 5),
    end=st.floats(0, 5),
    periods=st.floats(0.01, 30),
    amplitude=st.floats(1e-3, 10),
    duration=st.floats(1e-3, 1e3),
)
def test_the_extremes_are_those_of_many_samples(start, end, periods, amplitude, duration):
    swing = Oscillation(amplitude, periods / duration, duration)
    t = np.linspace(0, 1, 20001)
    sampled = start + (end - start) * t + swing.at(t * duration)
    lowest, highest = swing.about(start, end)
    slack = amplitude * (2 * np.pi * periods / 20000) ** 2  # between two samples, twice what a parabola rises
    assert sampled.min() - slack <= lowest <= sampled.min() + ROUNDING * 20
    assert sampled.max() - ROUNDING * 20 <= highest <= sampled.max() + slack


def test_the_greatest_value_is_a_crest():
    swung = program({"duration": 1.0, "load": 3.0}, {"duration": 1.0, "amplitude": 1.0, "frequency": 2.0})
    assert swung.greatest == swung.held.load == pytest.approx(4.0)
    quarter = program({"duration": 1.0, "load": 3.0}, {"duration": 0.1, "amplitude": 1.0, "frequency": 1.0})
    assert quarter.greatest == pytest.approx(3 + np.sin(0.2 * np.pi))


def test_an_oscillation_may_touch_zero_but_not_pass_it():
    touching = program(
        {"duration": 1.0, "load": 0.3}, {"duration": 10.0, "amplitude": 0.3, "frequency": 1 / 3, "speed": 1.0}
    )
    assert touching.prescribed(np.linspace(0, 11, 1001)).min() >= 0.0
    assert touching.prescribed(1 + 0.75 * 3) == pytest.approx(0.0, abs=1e-15)
    refused(
        r"stages\[1\].amplitude = 0.4 N takes the load down to -0.1 N",
        program,
        {"duration": 1.0, "load": 0.3},
        {"duration": 3.0, "amplitude": 0.4, "frequency": 0.5},
    )
    rising = {"duration": 0.1, "depth": 1.0, "amplitude": 0.4, "frequency": 2.0}
    assert program(rising).greatest > 1.0  # the first fifth of a period only rises
    refused(r"stages\[0\].amplitude = 0.4 m takes the depth down to", program, rising | {"duration": 1.0})


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"amplitude": 1.0}, "amplitude alone"),
        ({"frequency": 5.0}, "frequency = 5 Hz alone"),
        ({"amplitude": 0.1, "frequency": 0.0}, "greater than 0"),
        ({"amplitude": 0.1, "frequency": 1e200, "duration": 1e200}, "more periods than can be counted"),
        ({"amplitude": 0.1, "frequency": 1.7e308, "duration": 1.0}, "more periods than can be counted"),
    ],
)
def test_half_an_oscillation_and_numbers_that_are_none_are_named(given, message):
    refused(message, Stage, **{"duration": 1.0, "load": 1.0} | given)
