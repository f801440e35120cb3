"""Quantities with units: the number in SI that they are, to the last digit, or a mistake that says why not."""

import re
import subprocess
import sys
from dataclasses import replace
from decimal import Decimal
from math import nextafter, pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import TypeAdapter

from scene import (
    WLF,
    Fractional,
    Heating,
    InvalidInput,
    Kelvin,
    KelvinChain,
    Prony,
    Scene,
    SelfAffine,
    Slide,
    Sphere,
    Stage,
    Topography,
)
from scene import quantities as q
from scene.quantities import Unit
from scene.units import KNOWN, Unreadable, in_si

PREFIXES = {
    "f": -15,
    "p": -12,
    "n": -9,
    "u": -6,
    "µ": -6,
    "μ": -6,
    "m": -3,
    "c": -2,
    "": 0,
    "k": 3,
    "M": 6,
    "G": 9,
}
UNITS = [each for each in vars(q).values() if isinstance(each, Unit)]


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
    # A float before the unit is itself rounded once: that is one unit in the last place.
    rounded = f"{float(Decimal(repr(value)).scaleb(-PREFIXES[prefix])):.17g} {prefix}{unit}"
    assert nextafter(value, 0) <= in_si(rounded, unit) <= nextafter(value, float("inf"))


@pytest.mark.parametrize(
    ("text", "unit", "expected"),
    [
        ("  5   mm ", "m", 5e-3),
        ("−5 mm", "m", -5e-3),
        ("4e308 mm", "m", 4e305),
        ("0e999999999 m", "m", 0.0),
        ("1 N mm⁻²", "Pa", 1e6),
        ("1 kg/(m s^2)", "Pa", 1.0),
        ("10 mN·m/m^2", "N/m", 0.01),
        ("30°", "rad", pi / 6),
        ("20 W/m/K", "W/(m K)", 20.0),
        ("10 kcal/mol", "J/mol", 41840.0),
        ("5 delta_degC", "K", 5.0),
    ],
)
def test_quantities_are_read_as_they_are_written(text, unit, expected):
    assert in_si(text, unit) == pytest.approx(expected, rel=2.3e-16, abs=0)  # one unit in the last place


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("25 degC", 298.15),
        ("25 °C", 298.15),
    ],
)
def test_absolute_temperatures_have_degrees(text, expected):
    assert in_si(text, "K", difference=False) == expected


def test_a_difference_of_temperatures_has_none_and_a_temperature_is_no_difference():
    with pytest.raises(Unreadable, match="zero of their own"):
        in_si("5 degC", "K")
    with pytest.raises(Unreadable, match="difference of temperatures"):
        in_si("5 delta_degC", "K", difference=False)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("5 mmm", "did you mean 'mm'"),
        ("5 N", ""),
        ("   ", ""),
        ("5", "no unit"),
        ("inf m", "no number"),
        ("1e999 m", "range"),
        ("5 m/", "no unit"),
        ("1e9999999999999999999999999 m", "range"),
        ("1,5 mm", "decimal points"),
        ("5 __import__('os')", "no unit"),
        ("5 m**10**10", "powers"),
        ("5 " + "m" * 1000, "letters"),
        ("1 000 mm", "nothing parts the digits"),
        ("1 ± 0.1 mm", "without its uncertainty"),
        ("1*10^3 mm", "powers of ten are written as 1e6"),
        ("5 mm10", "no unit"),
    ],
)
def test_what_is_no_length_is_refused_with_a_reason(text, said):
    with pytest.raises(Unreadable) as raised:
        in_si(text, "m")
    assert said in str(raised.value)


@pytest.mark.parametrize(
    ("written", "plain", "unit"),
    [
        ("3 N/mm2", "3 MPa", "Pa"),
        ("2 kgf/cm2", "2*98066.5 Pa", "Pa"),
        ("2 Pa-1", "2 1/Pa", "1/Pa"),
        ("2 mil", "50.8 um", "m"),
        ("5 mm/sec", "5 mm/s", "m/s"),
        ("36 kmh", "36 km/h", "m/s"),
    ],
)
def test_units_of_workshops_and_spreadsheets_are_what_they_say(written, plain, unit):
    number, _, rest = plain.partition(" ")
    expected = float(np.prod([float(each) for each in number.split("*")])) * in_si(f"1 {rest}", unit)
    assert in_si(written, unit) == pytest.approx(expected, rel=1e-15, abs=0)


@pytest.mark.parametrize("degrees", ["25 C", "25 ºC", "25 ° C", "25 deg C", "25 deg. C", "77 F", "77 deg F"])
def test_degrees_are_read_as_people_write_them(degrees):
    assert in_si(degrees, "K", difference=False) == 298.15


@pytest.mark.parametrize(
    ("text", "unit", "said"),
    [
        ("1 mpa", "Pa", "did you mean 'MPa' (1e+06 Pa) or 'mPa' (0.001 Pa)?"),
        ("10 MM", "m", "did you mean 'mm' (0.001 m)?"),
        ("5 lb/in2", "Pa", "did you mean 'lbf/in2' (6894.76 Pa)?"),
        ("5 NEWTON", "N", "did you mean 'newton'?"),
        ("25 degc", "K", "did you mean 'degC'?"),
    ],
)
def test_a_hint_shows_every_unit_that_letters_leave_open_and_its_magnitude(text, unit, said):
    with pytest.raises(Unreadable) as raised:
        in_si(text, unit, difference=unit != "K")
    assert str(raised.value).endswith(said)


@settings(deadline=None)
@given(
    st.sampled_from(UNITS), st.sampled_from(KNOWN), st.sampled_from(["{}", "{}s", "{}2", "1/{}", "{}/s", "N/{}"])
)
def test_no_unit_is_suggested_that_would_be_refused(unit, name, written):
    for misspelt in (name.upper(), name.lower(), name.swapcase(), name + "x"):
        try:
            in_si(f"2 {written.format(misspelt)}", unit.symbol, unit.difference)
        except Unreadable as refused:
            for meant in re.findall(r"'([^']*)'", str(refused).partition("did you mean")[2]):
                in_si(f"2 {meant}", unit.symbol, unit.difference)


@pytest.mark.parametrize(
    ("text", "unit", "said"),
    [
        ("10 1/s", "rad/s", "2 pi f"),
        ("10 rad/s", "Hz", "omega / (2 pi)"),
        ("10 1/mm", "rad/m", "2 pi / wavelength"),
        ("10 kg", "N", "the weight of 1 kg is 1 kgf"),
        ("10 kPa s", "s", "viscosity / shear modulus"),
        ("0.2 W/mK", "W/(m K)", "W/(m K)"),
    ],
)
def test_a_quantity_that_is_often_taken_for_another_is_refused_with_the_way_to_it(text, unit, said):
    with pytest.raises(Unreadable) as raised:
        in_si(text, unit)
    assert said in str(raised.value)


def test_what_is_suggested_is_known():
    for unit in KNOWN:
        assert in_si(f"2 {unit} m/{unit}", "m") == 2.0, unit


def test_a_frequency_is_no_angular_frequency():
    law = {"modulus": 1.0, "relaxation_time": 1.0, "exponent": 0.5, "lowest_frequency": 1.0}
    assert Fractional(**law, highest_frequency="1e3 rad/s").highest_frequency == 1e3
    with pytest.raises(InvalidInput, match="1 Hz is 2 pi rad/s"):
        Fractional(**law, highest_frequency="1e3 Hz")
    with pytest.raises(InvalidInput, match="a frequency"):
        Stage(duration=1, load=1, amplitude=0.1, frequency="10 rad/s")


@pytest.mark.parametrize("unit", UNITS, ids=lambda unit: unit.kind)
def test_each_kind_of_number_shows_an_example_that_it_takes(unit):
    assert unit.value(unit.example) == pytest.approx(unit.number, rel=1e-5)  # six digits are shown
    for wrong in (None, True, [1.0], "wide", 1j):
        with pytest.raises(ValueError, match="Input should be"):
            unit.value(wrong)


def test_python_takes_what_a_file_takes_and_holds_numbers():
    scene = Scene(
        Sphere("5 mm"),
        Prony("1 MPa", ["2 MPa", 3e6], ("1 ms", 1e-4)),
        Slide(speed="20 mm/s", depth="10 um"),
        SelfAffine(hurst=0.5, rms_height="1 um", longest="1 mm"),
        temperature=WLF(temperature="25 degC", reference="-50 degC", c1=17.44, c2="51.6 K"),
        heating=Heating(conductivity="20 W/(m K)"),
    )
    assert scene.indenter.radius == 5e-3
    assert scene.elastomer == Prony(1e6, (2e6, 3e6), (1e-3, 1e-4))
    assert hash(Kelvin("1 MPa", "1 ms")) == hash(Kelvin(1e6, 1e-3))
    assert scene.motion == Slide(speed=0.02, depth=1e-5)
    assert (scene.temperature.temperature, scene.temperature.c2) == (298.15, 51.6)
    adapter = TypeAdapter(Scene)
    assert adapter.validate_json(adapter.dump_json(scene)) == scene
    assert replace(scene.indenter, radius="1 cm") == Sphere(0.01)
    assert KelvinChain("0/Pa", ("1/MPa",), ("1 s",)).compliances == (1e-6,)
    assert Topography(heights=np.eye(4), pixel=["10 um", 2e-5]).pixel == (1e-5, 2e-5)


def test_numbers_alone_load_no_units():
    code = (
        "import sys\n"
        "from scene import Kelvin, Sphere\n"
        "Sphere(1e-2), Kelvin(1e6, 1e-3)\n"
        "assert not {'pint', 'xarray'} & set(sys.modules)\n"
        "Sphere('1 cm')\n"
        "assert 'pint' in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize("given", [b"1", bytearray(b"1"), memoryview(b"1"), {1.0: 2.0}], ids=type)
def test_bytes_and_mappings_are_no_numbers(given):
    for read in (q.METRE.value, q.METRE.values, q.METRE.row):
        with pytest.raises(ValueError, match=r"bytes are no numbers|mapping|real numbers|a length"):
            read(given)
