"""Tables of moduli in the forms that are measured: by the names and units of their columns, or refused by name."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from maps import noise, refused
from pydantic import TypeAdapter
from strategies import decades, examples

from scene import (
    WLF,
    Indent,
    Prony,
    Scene,
    ShiftFactors,
    Sphere,
    Table,
    Tabulated,
)
from scene.solids.moduli import (
    COLUMNS,
    DYNAMIC,
    LOSS,
    MAGNITUDE,
    OUT_OF_PHASE,
    PHASE,
    STORAGE,
    TANGENT,
    VISCOSITY,
)

SOLID = Prony(1e6, (1e6, 3e6, 1e7), (1.0, 1.37e-2, 1e-4))
OMEGA = np.geomspace(1e-2, 1e6, 50)
TIME = np.geomspace(1e-6, 1e2, 60)
FITTED = 3e-3  # of exact rows, whose best fit is off by 1e-3 rms at most
DRAWN = 0.03  # of any solid that is drawn: between rows and at the ends a fit is less good than at the rows
LAW = WLF(temperature=300.0, reference=300.0, c1=8.86, c2=101.6)
SHEAR, TENSILE = 1.0, 3.0  # E = 3 G at a Poisson ratio of 1/2


def deviation(solid, expected=SOLID, omega=OMEGA):
    return np.max(np.abs(solid.complex_modulus(omega) / expected.complex_modulus(omega) - 1))


@st.composite
def series(draw):
    """Prony series with up to four branches of 1e-4 to 1 s, glassy modulus 2 to 1e4 times the modulus at rest."""
    count = draw(st.integers(1, 4))
    rest = draw(decades(3, 8))
    moduli = tuple(rest * draw(decades(0, 3.5)) for _ in range(count))
    return Prony(rest, moduli, tuple(draw(decades(-4, 0)) for _ in range(count)))


FREQUENCY_UNITS = {"rad/s": 1.0, "Hz": 2 * np.pi, "krad/s": 1e3, "kHz": 2e3 * np.pi, "rpm": np.pi / 30}
MODULUS_UNITS = {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "N/mm^2": 1e6, "bar": 1e5}
PHASE_UNITS = {"rad": 1.0, "deg": np.pi / 180, "°": np.pi / 180}


WAYS = [
    *((STORAGE, LOSS), (MAGNITUDE, PHASE), (MAGNITUDE, TANGENT), (STORAGE, TANGENT), (LOSS, PHASE)),
    *((VISCOSITY, TANGENT), (VISCOSITY, PHASE), (DYNAMIC, OUT_OF_PHASE), (DYNAMIC, TANGENT), (STORAGE, DYNAMIC)),
]


@given(series(), st.sampled_from(WAYS), st.sampled_from("GE"), st.data())
@examples(30)
def test_a_series_is_found_in_its_table_whatever_form_names_and_units_its_columns_have(solid, way, symbol, data):
    frequency, unit, angle = (
        data.draw(st.sampled_from([*each])) for each in (FREQUENCY_UNITS, MODULUS_UNITS, PHASE_UNITS)
    )
    symbol = "G" if {*way} & {VISCOSITY, DYNAMIC} else symbol
    law = (TENSILE if symbol == "E" else SHEAR) * solid.complex_modulus(OMEGA)
    scale, radian = MODULUS_UNITS[unit], PHASE_UNITS[angle]
    parts = {
        STORAGE: (f" [{unit}]", law.real / scale),
        LOSS: (f" [{unit}]", law.imag / scale),
        MAGNITUDE: (f" [{unit}]", np.abs(law) / scale),
        TANGENT: ("", law.imag / law.real),
        PHASE: (f" ({angle})", np.angle(law) / radian),
        VISCOSITY: (f" [{unit} s]", np.abs(law) / OMEGA / scale),
        DYNAMIC: (f" ({unit}*s)", law.imag / OMEGA / scale),
        OUT_OF_PHASE: (f" ({unit}*s)", law.real / OMEGA / scale),
    }
    table = {f"frequency ({frequency})": OMEGA / FREQUENCY_UNITS[frequency], "Gap [mm]": np.arange(len(OMEGA))}
    for each in way:
        names = [name for name in each.names if symbol in name] or each.names
        table[data.draw(st.sampled_from(names)) + parts[each][0]] = parts[each][1]
    found = Tabulated(table=table)
    assert (found.kind, found.rms_error < FITTED) == ("shear" if symbol == "G" else "tensile", True)
    assert deviation(found, solid) < DRAWN
    assert found.table.notes == ("dict: column 'Gap' is not used",)


@given(series(), st.sampled_from(["G(t)", "E(t)", "J(t)", "D(t)"]), st.sampled_from([("ms", 1e-3), ("min", 60.0)]))
@examples(30)
def test_a_series_is_found_in_its_relaxation_and_in_its_creep(solid, name, time):
    (unit, second), stiffer = time, TENSILE if name[0] in "ED" else SHEAR
    if name[0] in "GE":
        times, of = TIME, "MPa"
        numbers = solid.relaxation_modulus(times) * stiffer / 1e6
    else:
        times, of = np.geomspace(1e-6, 10 * solid.retardation()[2].max(), 80), "1/MPa"
        numbers = solid.creep_compliance(times) * 1e6 / stiffer
    found = Tabulated(table={f"t [{unit}]": times / second, f"{name} [{of}]": numbers})
    assert found.rms_error < FITTED
    assert found.kind == ("tensile" if name[0] in "ED" else "shear")
    assert found.frequency_unit is None
    assert deviation(found, solid, np.geomspace(1e-1, 1e5, 30)) < DRAWN
    assert found.static_modulus == pytest.approx(solid.static_modulus, rel=DRAWN)


@given(series(), st.floats(-0.8, 2.0), st.sampled_from(["frequency", "G(t)", "J(t)"]))
@examples(20)
def test_rows_at_several_temperatures_are_one_curve_by_the_law_of_the_scene(solid, further, over):
    law = WLF(temperature=300.0 + 10 * further, reference=300.0, c1=8.86, c2=101.6)
    temperatures = np.repeat([290.0, 295.0, 300.0, 310.0, 320.0], 12)
    factors = np.array([replace(law, temperature=each).shift for each in temperatures])
    if over == "frequency":
        seen = np.geomspace(1e0, 1e3, 30)
        omega = np.tile(np.geomspace(1e0, 1e3, 12), 5)
        at = solid.complex_modulus(omega * factors)
        numbers = {"f [Hz]": omega / (2 * np.pi), "E' [MPa]": at.real * 3e-6, "E'' [MPa]": at.imag * 3e-6}
    else:
        time = np.tile(np.geomspace(1e-4, 1e0, 12), 5)
        seen = np.geomspace(3e0, 1e3, 30)
        at = solid.relaxation_modulus(time / factors) if over == "G(t)" else solid.creep_compliance(time / factors)
        numbers = {"t": time, over: at}
    stated = Tabulated(
        table=numbers | {"T [degC]": temperatures - 273.15}, equilibrium_modulus=solid.static_modulus
    )
    scene = Scene(Sphere(1e-2), stated, Indent(load=1.0), temperature=law)
    assert deviation(stated.at_reference(law), solid, seen) < DRAWN
    assert np.allclose(
        scene.solid.complex_modulus(seen / law.shift), stated.at_reference(law).complex_modulus(seen), rtol=1e-12
    )
    assert scene.elastomer is stated


def tables(*temperatures, omega=OMEGA[10:40]):
    """Rows at temperatures by the law, with a column of these, and their shift factors."""
    warm, each = np.repeat(temperatures, len(omega)), np.tile(omega, len(temperatures))
    factors = np.array([replace(LAW, temperature=kelvin).shift for kelvin in warm])
    moduli = SOLID.complex_modulus(each * factors)
    return {"omega": each, "T [K]": warm, "G'": moduli.real, "G''": moduli.imag}, factors


STATED, FACTORS = tables(290.0, 300.0, 320.0)
LIFT = STATED["T [K]"] / 300
LIFTED = {name: STATED[name] * LIFT for name in ("G'", "G''")}


@pytest.mark.parametrize("heading", ["aT", "a_T", "Shift factor", "log10 a_T"])
@pytest.mark.parametrize("vertical", [False, True])
def test_columns_of_shift_factors_shift_the_rows_to_where_they_are_one(heading, vertical):
    stated = STATED | {heading: np.log10(FACTORS) if heading[0] == "l" else FACTORS}
    if vertical:
        stated |= LIFTED | {"b_T": LIFT}
    table = Tabulated(table=stated)
    assert deviation(table, omega=OMEGA[8:42]) < FITTED
    scene = Scene(Sphere(1e-2), table, Indent(load=1.0), temperature=replace(LAW, temperature=310.0))
    assert scene.solid.static_modulus == table.static_modulus


def test_a_table_of_shift_factors_is_the_law_of_the_scene_and_vertical_ones_change_moduli():
    kelvin = np.array([280.0, 290.0, 300.0, 320.0])
    factors = {
        "T [K]": kelvin,
        "a_T": [replace(LAW, temperature=each).shift for each in kelvin],
        "b_T": kelvin / 300,
    }
    law = ShiftFactors(temperature=290.0, reference=300.0, table=factors)
    scene = Scene(Sphere(1e-2), Tabulated(table=STATED | LIFTED), Indent(load=1.0), temperature=law)
    expected = 29 / 30 * SOLID.complex_modulus(OMEGA[12:36] * replace(LAW, temperature=290.0).shift)
    np.testing.assert_allclose(scene.solid.complex_modulus(OMEGA[12:36]), expected, rtol=FITTED)
    adapter = TypeAdapter(Scene)
    assert adapter.validate_json(adapter.dump_json(scene)) == scene
    for name, value, message in (
        ("temperature", 330.0, "temperature = 330 K: shift factors are known from 280 to 320 K"),
        ("a_T", factors["a_T"][::-1], "a_T has to fall"),
        ("b_T", (1.0, 2.0), "at each of the 4 temperatures"),
        ("skip", 3, "table is missing"),
    ):
        refused(message, replace, law, **{name: value})


def test_a_table_of_modes_is_a_prony_series(tmp_path):
    path = tmp_path / "modes.txt"
    path.write_text("#number of modes\n3\n\n# tau_i G_i\n1 1 1\n2 1.37e-2 3\n3 1e-4 10\n\nend\n")
    stated = {"columns": {"relaxation_times": 2, "moduli": 3}, "units": {"relaxation_times": "s", "moduli": "MPa"}}
    assert Prony(equilibrium_modulus=1e6, table=path, skip=4, rows=3, **stated) == SOLID
    times = SOLID.relaxation_times
    assert Prony(equilibrium_modulus=1e6, table={"tau [s]": times, "E [MPa]": [3.0, 9.0, 30.0]}) == SOLID
    normalised = Prony(instantaneous_modulus="10 MPa", g=[0.2, 0.3, 0.4], tau=times)
    assert Prony(instantaneous_modulus="10 MPa", table={"tau": times, "g": [0.2, 0.3, 0.4]}) == normalised
    for more, message in (
        ({}, "line 2: '3' is no heading"),
        ({"moduli": (1e6,), "skip": 4, **stated}, "line 8: '' has not the 3 cells"),
    ):
        refused(message, Prony, equilibrium_modulus=1e6, table=path, **more)
    refused(
        "moduli is stated, and a column",
        Prony,
        equilibrium_modulus=1e6,
        moduli=(1e6,),
        table={"tau": (1.0,), "G": (1e6,)},
    )


def test_reduced_frequencies_need_no_shift():
    reduced = STATED | {"reduced frequency [rad/s]": STATED["omega"] * FACTORS}
    del reduced["omega"]
    units = {"storage": "Pa", "loss": "Pa"}
    assert deviation(Tabulated(table=reduced, units=units), omega=OMEGA[8:42]) < FITTED
    refused("b_T with reduced frequencies", Tabulated, table=reduced | {"b_T": np.ones(90)}, units=units)


def test_one_temperature_is_that_of_the_table_and_the_law_has_to_begin_there():
    stated, _ = tables(300.0)
    table = Tabulated(table=stated, equilibrium_modulus=1e6)
    assert set(table.table.temperature) == {300.0}
    scene = Scene(Sphere(1e-2), table, Indent(load=1.0))
    assert scene.solid is table
    assert replace(scene, temperature=replace(LAW, temperature=310.0)).solid.solid is table
    refused(
        r"measured at 300 K, and temperature\.reference = 280 K",
        replace,
        scene,
        temperature=replace(LAW, reference=280.0),
    )


def test_a_law_that_ends_among_the_rows_is_refused_and_without_one_there_is_no_modulus():
    table = Tabulated(table=STATED)
    refused(
        r"a row at temperature = 290 K: the law ends at",
        Scene,
        Sphere(1e-2),
        table,
        Indent(load=1.0),
        temperature=replace(LAW, c2=5.0),
    )
    refused("several temperatures", table.complex_modulus, 1.0, error=ValueError)


def test_tables_of_every_kind_are_stored_and_read_back():
    several = Scene(Sphere(1e-2), Tabulated(table=STATED), Indent(load=1.0), temperature=LAW)
    relaxed = Table(time=TIME, modulus=SOLID.relaxation_modulus(TIME))
    crept = Table(time=TIME, compliance=SOLID.creep_compliance(TIME))
    for stored in (several, Tabulated(table=relaxed, kind="shear"), Tabulated(table=crept, kind="shear")):
        adapter = TypeAdapter(type(stored))
        again = adapter.validate_json(adapter.dump_json(stored))
        assert (again, hash(again)) == (stored, hash(stored))


@pytest.mark.parametrize(
    ("heading", "stated", "message"),
    [
        ("f [Hz],G' [Pa],G'' [Pa]", {"frequency_unit": "rad/s"}, "'f' is in Hz, and frequency_unit = 'rad/s'"),
        ("omega [Hz],G' [Pa],G'' [Pa]", {}, "'omega' is in 'Hz', and is an angular frequency"),
        ("f [rad/s],E' [Pa],E'' [Pa]", {"kind": "shear"}, "of kind 'tensile', and kind = 'shear'"),
        ("f,G',G''", {}, "frequency_unit.*missing"),
        ("omega,G',E''", {}, "of kind 'shear' and 'tensile'"),
        ("omega,G*,delta [deg]", {}, r"line 2: phase = 5\.23\d* must be below pi/2"),
        ("f,|eta*|,tan_delta", {"kind": "shear"}, "times the angular frequency: state its unit"),
        ("G',G'',strain", {}, 'no column of "G\'", "G\'\'" is a frequency'),
        ("omega,G',strain", {}, "no complete modulus is in the columns 'omega', \"G'\""),
        ("T [C],G',G''", {}, "a sweep of temperature is no table of moduli"),
        ("x,G(t),y", {}, "there is no table of moduli in the columns 'G"),
        ("t,G(t),J(t)", {}, "there is no table of moduli in the columns 't'"),
        ("t [s],G(t) [Pa],y", {"frequency_unit": "Hz"}, "table over time: leave frequency_unit = 'Hz' out"),
    ],
)
def test_a_table_that_says_too_little_or_contradicts_is_refused(tmp_path, heading, stated, message):
    numbers = (np.geomspace(1, 10, 5), np.geomspace(100, 200, 5), np.full(5, 300.0))
    path = tmp_path / "rubber.csv"
    path.write_text("\n".join([heading, *(",".join(map(str, row)) for row in zip(*numbers, strict=True))]))
    refused(message, Tabulated, table=path, **stated)


LAW_OF_SOLID = SOLID.complex_modulus(OMEGA)
IN_SHEAR = {"omega [rad/s]": OMEGA, "G' [Pa]": LAW_OF_SOLID.real, "G'' [Pa]": LAW_OF_SOLID.imag}


def test_two_columns_of_the_frequency_have_to_agree():
    assert Tabulated(table=IN_SHEAR | {"f [Hz]": OMEGA / (2 * np.pi)}) == Tabulated(table=IN_SHEAR)
    refused(
        "'omega' is in rad/s, and frequency_unit = 'Hz' is stated",
        Tabulated,
        table=IN_SHEAR | {"f [Hz]": OMEGA / (2 * np.pi)},
        frequency_unit="Hz",
    )
    refused(
        r"row 1: omega = .* contradicts frequency: 1 Hz is 2 pi rad/s",
        Tabulated,
        table=IN_SHEAR | {"f [Hz]": OMEGA},
    )


def test_a_tangent_that_contradicts_the_moduli_beside_it_is_refused():
    table = IN_SHEAR | {"tan delta": LAW_OF_SOLID.imag / LAW_OF_SOLID.real}
    assert deviation(Tabulated(table=table)) < FITTED
    refused(r"1e\+03 times off tan delta", Tabulated, table=table | {"G'' [Pa]": 1e3 * LAW_OF_SOLID.imag})


LIQUID_TIME = np.geomspace(1e-4, 1e-1, 30)
LIQUIDS = {
    "relaxation": {"t": np.geomspace(1e-4, 3e-2, 30), "G(t)": 1e6 * np.exp(-np.geomspace(1e-4, 3e-2, 30) / 1e-2)},
    "creep": {"t": LIQUID_TIME, "J(t)": 1e-6 * (1 + LIQUID_TIME / 1e-2)},
    "creep with retardation": {
        "t": LIQUID_TIME,
        "J(t)": 1e-6 * (1 + 2 * -np.expm1(-LIQUID_TIME / 1e-3) + LIQUID_TIME / 1e-1),
    },
}


@pytest.mark.parametrize("scatter", [0.0, 0.03])
@pytest.mark.parametrize("form", LIQUIDS)
def test_a_liquid_is_refused_in_each_form(form, scatter):
    for seed in range(5):
        first, (name, values) = LIQUIDS[form].items()
        scattered = {name: values * np.exp(scatter * noise(30, seed))}
        refused("leaves the modulus at rest open", Tabulated, table=dict([first]) | scattered, tolerance=0.3)


@pytest.mark.parametrize("name", ["G(t)", "J(t)"])
def test_a_solid_stays_one_under_noise(name):
    law = SOLID.relaxation_modulus if name == "G(t)" else SOLID.creep_compliance
    for seed in range(5):
        scatter = np.exp(0.03 * noise(60, seed))
        found = Tabulated(table={"t": TIME, name: law(TIME) * scatter})
        assert abs(found.static_modulus - 1e6) < 4 * found.equilibrium_error < 0.5e6


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"modulus": (1.0,) * 5}, "have \\[4, 5\\] values"),
        ({"temperature": (300.0,) * 3}, r"time, modulus, temperature have \[4, 4, 3\] values"),
        ({"time": (1.0, 1.0, 2.0, 3.0)}, "3 times: at least 4"),
        (
            {"loss": (1.0,) * 4},
            "a table of loss, time, modulus: give frequency, storage, loss; or",
        ),
    ],
)
def test_a_wrong_table_over_time_is_refused_with_its_place(change, message):
    refused(message, Table, **{"time": (1.0, 2.0, 3.0, 4.0), "modulus": (4.0, 3.0, 2.0, 1.0)} | change)


def test_every_name_is_that_of_one_column():
    names = [name for column in COLUMNS for name in (column.field, *column.names)]
    assert len(names) == len(set(names))


def test_the_step_itself_is_left_out_of_relaxation_and_that_is_said():
    modulus = np.append(7.7e6, SOLID.relaxation_modulus(TIME))
    found = Tabulated(table={"t": np.append(0.0, TIME), "G(t)": modulus})
    assert found == Tabulated(table={"t": TIME, "G(t)": modulus[1:]})
    assert "1 rows at time 0 are left out" in found.table.notes[0]


def test_few_frequencies_at_many_temperatures_are_enough():
    stated, _ = tables(*np.linspace(285.0, 330.0, 16), omega=np.array([1e1, 1e2, 1e3]))
    scene = Scene(Sphere(1e-2), Tabulated(table=stated), Indent(load=1.0), temperature=LAW)
    assert deviation(scene.solid, omega=np.geomspace(1e0, 1e5, 30)) < DRAWN


def test_shift_factors_the_other_way_round_are_refused():
    refused("a_T grows with the temperature", Tabulated, table=STATED | {"aT": 1 / FACTORS})
