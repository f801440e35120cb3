"""Quantities with units: the number in SI that they are, to the last digit, or a mistake that says why not."""

from decimal import Decimal
from math import pi

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from maps import refused

from scene import (
    Fractional,
    Stage,
)
from scene import quantities as q
from scene.numeric_input import NotPlain, in_si
from scene.quantities import Unit

PREFIXES = {"f": -15, "p": -12, "n": -9, "u": -6, "µ": -6, "m": -3, "c": -2, "": 0, "k": 3, "M": 6, "G": 9}
UNITS = [each for each in vars(q).values() if isinstance(each, Unit) and each.number is not None]


@settings(deadline=None)  # the first takes the time in which units are loaded
@given(
    st.floats(min_value=1e-200, max_value=1e200),
    st.sampled_from(sorted(PREFIXES)),
    st.sampled_from(["m", "s", "Pa", "N", "Hz"]),
    st.sampled_from(["", " ", "  "]),
)
def test_a_value_written_with_any_prefix_is_the_same_float(value, prefix, unit, space):
    exact = f"{Decimal(repr(value)).scaleb(-PREFIXES[prefix])}{space}{prefix}{unit}"
    assert in_si(exact, unit) == value


@pytest.mark.parametrize(
    ("text", "unit", "expected"),
    [
        ("  5   mm ", "m", 5e-3),
        ("−5 mm", "m", -5e-3),
        ("4e308 mm", "m", 4e305),
        ("0e999999999 m", "m", 0.0),
        ("1 N mm⁻²", "Pa", 1e6),
        ("3 N/mm2", "Pa", 3e6),
        ("2 kgf/cm2", "Pa", 196133.0),
        ("2 Pa-1", "1/Pa", 2.0),
        ("1/MPa", "1/Pa", 1e-6),
        ("1 kg/(m s^2)", "Pa", 1.0),
        ("10 mN·m/m^2", "N/m", 0.01),
        ("30°", "rad", pi / 6),
        ("60 rpm", "rad/s", 2 * pi),
        ("20 W/m/K", "W/(m K)", 20.0),
        ("10 kcal/mol", "J/mol", 41840.0),
        ("5 delta_degC", "K", 5.0),
        ("36 km/h", "m/s", 10.0),
    ],
)
def test_quantities_are_read_as_they_are_written(text, unit, expected):
    assert in_si(text, unit) == pytest.approx(expected, rel=2.3e-16, abs=0)  # one unit in the last place


@pytest.mark.parametrize("degrees", ["25 degC", "25 °C", "25 ℃", "25 C", "77 degF", "298.15 K"])
def test_an_absolute_temperature_has_degrees_of_any_scale(degrees):
    assert in_si(degrees, "K", difference=False) == 298.15


@pytest.mark.parametrize(
    ("text", "unit", "why"),
    [
        ("5 mmm", "m", "no unit is called 'mmm', did you mean 'mm'?"),
        ("1 mpa", "Pa", "did you mean 'MPa' or 'mPa'?"),
        ("5 NEWTON", "N", "did you mean 'newton'?"),
        ("5 Pas", "Pa", "no unit is called 'Pas'"),  # pascals, or pascal seconds
        ("5 N", "m", ""),
        ("10 MM", "m", ""),  # of pint a megamolar
        ("10 1/s", "rad/s", ""),
        ("10 rad/s", "Hz", ""),
        ("10 kPa s", "s", ""),
        ("0.2 W/mK", "W/(m K)", ""),
        ("5 degC", "K", "zero of their own"),
        ("   ", "m", ""),
        ("5", "m", "there is no unit"),
        ("inf m", "m", "no number"),
        ("1e999 m", "m", "range"),
        ("1e-999 m", "m", "range"),
        ("1e9999999999999999999999999 m", "m", "range"),
        ("5 m/", "m", "no unit"),
        ("5 __import__('os')", "m", "no unit"),
        ("5 m**10**10", "m", "no unit"),
        ("5 mm10", "m", "no unit"),
        ("10⁶ m", "m", "no unit"),
        ("(2+3) mm", "m", "no number"),
        ("1,5 mm", "m", "decimal point"),
        ("1 ± 0.1 mm", "m", "decimal point"),
        ("1*10^3 mm", "m", "decimal point"),
        ("5 " + "m" * 10**6, "m", "letters"),
        ("5 " + "m" * 97 + "!", "m", "no unit"),
        ("5" * 10**6 + " m", "m", ""),
    ],
)
def test_what_is_no_such_quantity_is_refused_with_a_reason(text, unit, why):
    with pytest.raises(NotPlain) as raised:
        in_si(text, unit)
    assert why in str(raised.value)
    assert len(str(raised.value)) < 300


def test_a_temperature_is_no_difference():
    with pytest.raises(NotPlain, match="difference of temperatures"):
        in_si("5 delta_degC", "K", difference=False)


def test_a_frequency_is_no_angular_frequency():
    law = {"modulus": 1.0, "relaxation_time": 1.0, "exponent": 0.5, "lowest_frequency": 1.0}
    assert Fractional(**law, highest_frequency="1e3 rad/s").highest_frequency == 1e3
    refused("1 Hz is 2 pi rad/s", Fractional, **law, highest_frequency="1e3 Hz")
    refused("a frequency", Stage, duration=1, load=1, amplitude=0.1, frequency="10 rad/s")


@pytest.mark.parametrize("unit", UNITS, ids=lambda unit: unit.kind)
def test_each_kind_of_number_shows_an_example_that_it_takes(unit):
    assert unit.value(unit.example) == pytest.approx(unit.number, rel=1e-5)  # six digits are shown


@pytest.mark.parametrize("given", [b"1", bytearray(b"1"), memoryview(b"1"), {1.0: 2.0}], ids=type)
def test_bytes_and_mappings_are_no_numbers(given):
    for read in (q.METRE.value, q.METRE.values, q.METRE.row):
        refused(r"bytes are no numbers|mapping|real numbers|a length", read, given, error=ValueError)
