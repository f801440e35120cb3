"""Tables of moduli as people have them: found by the names and units of their columns, or refused by name."""

from dataclasses import replace

import numpy as np
import pandas
import pint
import pytest
import xarray
from hypothesis import given
from hypothesis import strategies as st
from pydantic import TypeAdapter
from strategies import decades, examples

from scene import (
    WLF,
    Arrhenius,
    CreepTable,
    Indent,
    InvalidInput,
    Prony,
    RelaxationTable,
    Scene,
    Sphere,
    Table,
    Tabulated,
)
from scene.moduli import read_table
from scene.modulinames import COLUMNS, KINDS, MODULI, OPEN, PHASE, TAN, modulus

SOLID = Prony(1e6, (1e6, 3e6, 1e7), (1.0, 1.37e-2, 1e-4))
OMEGA = np.geomspace(1e-2, 1e6, 50)
TIME = np.geomspace(1e-6, 1e2, 60)
FITTED = 3e-3  # of exact rows, whose best fit is off by 1e-3 rms at most
DRAWN = 0.03  # of any solid that is drawn: between rows and at the ends a fit is less good than at the rows
LAW = WLF(temperature=300.0, reference=300.0, c1=8.86, c2=101.6)
SHEAR, TENSILE = 1.0, 3.0  # E = 3 G at a Poisson ratio of 1/2


def deviation(solid, expected=SOLID, omega=OMEGA):
    return np.max(np.abs(solid.complex_modulus(omega) / expected.complex_modulus(omega) - 1))


def columns_of(solid, omega, stiffer=1.0, name="G"):
    """Numbers by heading: frequencies in rad/s, both moduli, magnitude, phase and tan delta."""
    law = stiffer * solid.complex_modulus(omega)
    return {
        "omega [rad/s]": omega,
        f"{name}' [Pa]": law.real,
        f"{name}'' [Pa]": law.imag,
        f"|{name}*| [Pa]": np.abs(law),
        "phase [rad]": np.angle(law),
        "tan delta": law.imag / law.real,
    }


def some(table, *beginnings):
    return {name: values for name, values in table.items() if name.startswith(beginnings)}


@st.composite
def series(draw):
    """Prony series of one to four branches of 1e-4 to 1 s, glassy modulus 2 to 1e4 times the one at rest."""
    count = draw(st.integers(1, 4))
    rest = draw(decades(3, 8))
    moduli = tuple(rest * draw(decades(0, 3.5)) for _ in range(count))
    return Prony(rest, moduli, tuple(draw(decades(-4, 0)) for _ in range(count)))


FREQUENCY_UNITS = {"rad/s": 1.0, "Hz": 2 * np.pi, "krad/s": 1e3, "kHz": 2e3 * np.pi, "rpm": np.pi / 30}
MODULUS_UNITS = {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "N/mm^2": 1e6, "bar": 1e5}
PHASE_UNITS = {"rad": 1.0, "deg": np.pi / 180, "°": np.pi / 180}


@given(st.data())
@examples(30)
def test_a_series_is_found_in_its_table_whatever_names_and_units_its_columns_have(data):
    draw, solid = data.draw, data.draw(series())
    kind, (symbol, _, _) = draw(st.sampled_from([*KINDS.items()]))
    ratio = draw(st.sampled_from([0.5, 0.4, 0.0]))
    stiffer = 2 * (1 + ratio) if kind == "tensile" else 1.0
    law, frequency = stiffer * solid.complex_modulus(OMEGA), draw(st.sampled_from([*FREQUENCY_UNITS]))
    unit = draw(st.sampled_from([*MODULUS_UNITS]))
    angle = draw(st.sampled_from([*PHASE_UNITS]))
    named = lambda quantity: f"{draw(st.sampled_from(modulus(quantity, kind).called))} [{unit}]"  # noqa: E731
    scale = MODULUS_UNITS[unit]
    parts = {
        "storage": lambda: (named("storage"), law.real / scale),
        "loss": lambda: (named("loss"), law.imag / scale),
        "magnitude": lambda: (named("magnitude"), np.abs(law) / scale),
        "tan": lambda: (draw(st.sampled_from(TAN.called)), law.imag / law.real),
        "phase": lambda: (f"{draw(st.sampled_from(PHASE.called))} [{angle}]", np.angle(law) / PHASE_UNITS[angle]),
    }
    ways = [
        ("storage", "loss"),
        ("magnitude", "phase"),
        ("magnitude", "tan"),
        ("storage", "tan"),
        ("loss", "phase"),
    ]
    way = draw(st.sampled_from(ways))
    table = [(f"frequency ({frequency})", OMEGA / FREQUENCY_UNITS[frequency]), *(parts[each]() for each in way)]
    table.append(("sample", np.arange(len(OMEGA))))
    found = Tabulated(table=dict(draw(st.permutations(table))), poisson_ratio=ratio)
    assert (found.kind, found.rms_error < FITTED) == (kind, True)
    assert deviation(found, solid) < DRAWN
    assert any("sample" in note for note in found.table.notes)
    assert symbol in modulus("storage", kind).called[0]


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
        numbers = {"t [s]": time, over: at}
    stated = Tabulated(
        table=numbers | {"T [degC]": temperatures - 273.15}, equilibrium_modulus=solid.static_modulus
    )
    scene = Scene(Sphere(1e-2), stated, Indent(load=1.0), temperature=law)
    assert deviation(stated.at_reference(law), solid, seen) < DRAWN
    assert np.allclose(
        scene.solid.complex_modulus(seen / law.shift), stated.at_reference(law).complex_modulus(seen), rtol=1e-12
    )
    assert scene.elastomer is stated


def tables(*temperatures, law=LAW, solid=SOLID, **more):
    """Rows of a few decades at temperatures, with a column of these."""
    rows = [OMEGA[10:40] for _ in temperatures]
    factors = [replace(law, temperature=each).shift for each in temperatures]
    moduli = np.concatenate([solid.complex_modulus(each * a) for each, a in zip(rows, factors, strict=True)])
    warm = np.repeat(temperatures, 30)
    told = {"omega": np.concatenate(rows), "T [K]": warm, "G'": moduli.real, "G''": moduli.imag}
    return told | {name: np.repeat(values, 30) for name, values in more.items()}, np.repeat(factors, 30)


@pytest.mark.parametrize("heading", ["aT", "a_T", "shift factor", "log aT", "log10(a_T)", "lg(aT)", "ln aT"])
def test_a_column_of_shift_factors_shifts_the_rows_to_where_it_is_one(heading):
    stated, factors = tables(290.0, 300.0, 320.0)
    logs = np.log(factors) if "ln" in heading else np.log10(factors)
    table = Tabulated(table=stated | {heading: logs if heading[0] == "l" else factors})
    assert deviation(table, omega=OMEGA[8:42]) < FITTED
    scene = Scene(Sphere(1e-2), table, Indent(load=1.0), temperature=replace(LAW, temperature=310.0))
    assert scene.solid.static_modulus == table.static_modulus
    with pytest.raises(InvalidInput, match=r"measured at 300 K, and temperature\.reference = 310 K"):
        replace(scene, temperature=replace(LAW, reference=310.0))


def test_reduced_frequencies_need_no_shift():
    stated, factors = tables(290.0, 300.0, 320.0)
    reduced = stated | {"aT*omega [rad/s]": stated["omega"] * factors}
    assert deviation(Tabulated(table=reduced), omega=OMEGA[8:42]) < FITTED


def test_one_temperature_is_that_of_the_table_and_the_law_has_to_begin_there():
    stated, _ = tables(300.0, law=LAW)
    table = Tabulated(table=stated, equilibrium_modulus=1e6)
    assert set(table.table.temperature) == {300.0}
    scene = Scene(Sphere(1e-2), table, Indent(load=1.0))
    assert scene.solid is table
    assert replace(scene, temperature=replace(LAW, temperature=310.0)).solid.solid is table
    with pytest.raises(InvalidInput, match=r"measured at 300 K, and temperature\.reference = 280 K"):
        replace(scene, temperature=replace(LAW, reference=280.0))


def test_several_temperatures_without_a_law_are_refused_by_name():
    table = Tabulated(table=tables(290.0, 300.0, 320.0)[0])
    with pytest.raises(InvalidInput, match=r"several temperatures, from 290 to 320 K: state \[temperature\]"):
        Scene(Sphere(1e-2), table, Indent(load=1.0))
    with pytest.raises(ValueError, match="several temperatures"):
        table.complex_modulus(1.0)
    scene = Scene(Sphere(1e-2), table, Indent(load=1.0), temperature=LAW)
    assert deviation(scene.solid, omega=OMEGA[8:42]) < FITTED


def test_a_law_that_does_not_bring_the_rows_onto_one_curve_is_refused():
    table = Tabulated(table=tables(290.0, 300.0, 320.0)[0])
    wrong = Arrhenius(temperature=300.0, reference=300.0, activation_energy=1e3)
    with pytest.raises(InvalidInput, match="the best passive solid is off by"):
        Scene(Sphere(1e-2), table, Indent(load=1.0), temperature=wrong)
    with pytest.raises(InvalidInput, match=r"a row at temperature = 290 K: the law ends at"):
        Scene(Sphere(1e-2), table, Indent(load=1.0), temperature=replace(LAW, c2=5.0))


def test_a_scene_of_several_temperatures_is_stored_and_read_back():
    scene = Scene(Sphere(1e-2), Tabulated(table=tables(290.0, 300.0, 320.0)[0]), Indent(load=1.0), temperature=LAW)
    adapter = TypeAdapter(Scene)
    again = adapter.validate_json(adapter.dump_json(scene))
    assert again == scene
    assert hash(again) == hash(scene)
    relaxed, crept = SOLID.relaxation_modulus(TIME), SOLID.creep_compliance(TIME)
    for table in (RelaxationTable(TIME, relaxed), CreepTable(TIME, crept)):
        whole = TypeAdapter(Tabulated)
        solid = Tabulated(table=table, kind="shear")
        assert whole.validate_json(whole.dump_json(solid)) == solid


def test_arrays_tables_and_datasets_are_read_by_the_same_names():
    stated = some(columns_of(SOLID, OMEGA), "omega", "G'")
    expected = Tabulated(table=Table(*stated.values()), frequency_unit="rad/s", kind="shear")
    frame, plain = pandas.DataFrame(stated), [name.partition(" ")[0] for name in stated]
    units = pint.UnitRegistry()
    bare = dict(zip(plain, stated.values(), strict=True))
    labelled = xarray.Dataset(
        {name: ("row", values, {"units": "rad/s" if name == "omega" else "Pa"}) for name, values in bare.items()}
    )
    held = {name: values * (units("rad/s") if name == "omega" else units("Pa")) for name, values in bare.items()}
    ours = dict(zip(("frequency", "storage", "loss"), held.values(), strict=True))
    for table in (stated, frame, labelled, held, bare):
        assert Tabulated(table=table) == expected
    assert Tabulated(table=ours, kind="shear") == expected
    with pytest.raises(InvalidInput, match=r"table.*the path of a text file"):
        Tabulated(table=3.0)


@pytest.mark.parametrize(
    ("heading", "stated", "said"),
    [
        ("f [Hz],G' [Pa],G'' [Pa]", {"frequency_unit": "rad/s"}, "'f' in Hz, and frequency_unit = 'rad/s'"),
        ("omega [Hz],G',G''", {}, "angular frequency in 'Hz'"),
        ("f [rad/s],E',E''", {"kind": "shear"}, "kind 'tensile', and kind = 'shear'"),
        ("f,G',G''", {}, "frequency_unit.*missing"),
        ("omega,G',E''", {}, "moduli of both kinds"),
        ("omega,G*,delta", {}, "no unit of 'delta': write deg or rad"),
        ("omega,G*,delta [deg]", {}, r"column 3 \(delta\): phase = 300 must be below 90 deg"),
        ("G',G'',strain", {}, "no column of the frequency"),
        ("T [C],G',G''", {}, "a sweep of temperature is no table of frequencies"),
        ("x,G(t),y", {}, "no column of the time"),
        ("t,G(t),J(t)", {}, "both a relaxation modulus and a creep compliance"),
        ("t [s],G(t),y", {"frequency_unit": "Hz"}, "table over time: leave frequency_unit = 'Hz' out"),
    ],
)
def test_a_table_that_says_too_little_or_contradicts_is_refused(tmp_path, heading, stated, said):
    numbers = (np.geomspace(1, 10, 5), np.geomspace(100, 200, 5), np.full(5, 300.0))
    path = tmp_path / "rubber.csv"
    path.write_text("\n".join([heading, *(",".join(map(str, row)) for row in zip(*numbers, strict=True))]))
    with pytest.raises(InvalidInput, match=said):
        Tabulated(table=path, **stated)


def test_two_columns_of_the_frequency_have_to_agree():
    table = some(columns_of(SOLID, OMEGA), "omega", "G'")
    assert Tabulated(table=table | {"f [Hz]": OMEGA / (2 * np.pi)}) == Tabulated(table=table)
    with pytest.raises(InvalidInput, match="'omega' and 'f' contradict one another"):
        Tabulated(table=table | {"f [Hz]": OMEGA})


def test_a_sweep_of_temperature_at_one_frequency_is_no_table_of_frequencies():
    table = {"T [C]": np.linspace(0, 50, 9), "f [Hz]": np.full(9, 1.01), "E'": np.ones(9), "E''": np.ones(9)}
    with pytest.raises(InvalidInput, match=r"a sweep of temperature at one frequency, 1\.01, is no table"):
        Tabulated(table=table)


def test_a_temperature_needs_its_unit():
    table = some(columns_of(SOLID, OMEGA), "omega", "G'") | {"T": np.full(50, 25.0)}
    with pytest.raises(InvalidInput, match="no unit of 'T': write degC or K"):
        Tabulated(table=table)


def test_a_tangent_that_contradicts_the_moduli_beside_it_is_refused():
    table = some(columns_of(SOLID, OMEGA), "omega", "G'", "tan")
    assert deviation(Tabulated(table=table)) < FITTED
    table["G'' [Pa]"] = 1e3 * table["G'' [Pa]"]
    with pytest.raises(InvalidInput, match=r"1e\+03 times off tan delta"):
        Tabulated(table=table)


def test_rows_that_lack_a_number_are_left_out_and_that_is_said():
    table = some(columns_of(SOLID, OMEGA), "omega", "G'")
    table["G'' [Pa]"] = np.where(np.arange(50) % 7 == 3, np.nan, table["G'' [Pa]"])
    found = Tabulated(table=table)
    assert len(found.table.frequency) == 43
    assert "7 of 50 rows lack a number" in found.table.notes[0]
    assert deviation(found) < 2 * FITTED


def test_notes_are_no_part_of_what_is_compared_or_stored():
    table = some(columns_of(SOLID, OMEGA), "omega", "G'")
    with_one, without = Tabulated(table=table | {"strain [%]": np.ones(50)}), Tabulated(table=table)
    assert with_one.table.notes != without.table.notes == ()
    assert with_one == without
    assert hash(with_one) == hash(without)
    whole = TypeAdapter(Tabulated)
    assert whole.dump_json(with_one) == whole.dump_json(without)


def test_stated_fields_choose_between_columns_of_both_kinds_and_frequencies():
    both = columns_of(SOLID, OMEGA) | columns_of(SOLID, OMEGA, TENSILE, "E") | {"f [Hz]": OMEGA / (2 * np.pi)}
    both = some(both, "omega", "f ", "G'", "E'")
    for kind in KINDS:
        for unit in ("rad/s", "Hz"):
            found = Tabulated(table=both, kind=kind, frequency_unit=unit)
            assert (found.kind, found.frequency_unit) == (kind, unit)
            assert deviation(found) < FITTED


LIQUID_TIME = np.geomspace(1e-4, 1e-1, 30)
LIQUIDS = {
    "relaxation": {"t": np.geomspace(1e-4, 3e-2, 30), "G(t)": 1e6 * np.exp(-np.geomspace(1e-4, 3e-2, 30) / 1e-2)},
    "creep": {"t": LIQUID_TIME, "J(t)": 1e-6 * (1 + LIQUID_TIME / 1e-2)},
    "creep with retardation": {
        "t": LIQUID_TIME,
        "J(t)": 1e-6 * (1 + 2 * -np.expm1(-LIQUID_TIME / 1e-3) + LIQUID_TIME / 1e-1),
    },
}


@pytest.mark.parametrize("noise", [0.0, 0.03])
@pytest.mark.parametrize("form", LIQUIDS)
def test_a_liquid_is_refused_in_each_form(form, noise):
    for seed in range(5):
        rng = np.random.default_rng(seed)
        first, *others = LIQUIDS[form].items()
        scattered = {name: values * np.exp(noise * rng.standard_normal(30)) for name, values in others}
        with pytest.raises(InvalidInput, match="leaves the modulus at rest open"):
            Tabulated(table=dict([first]) | scattered, tolerance=0.3)


@pytest.mark.parametrize("name", ["G(t)", "J(t)"])
def test_a_solid_stays_one_under_noise_and_a_known_modulus_at_rest_is_kept(name):
    law = SOLID.relaxation_modulus if name == "G(t)" else SOLID.creep_compliance
    for seed in range(5):
        scatter = np.exp(0.03 * np.random.default_rng(seed).standard_normal(60))
        found = Tabulated(table={"t": TIME, name: law(TIME) * scatter})
        assert abs(found.static_modulus - 1e6) < 4 * found.equilibrium_error < 0.5e6
        known = Tabulated(table={"t": TIME, name: law(TIME) * scatter}, equilibrium_youngs_modulus=3e6)
        assert known.static_modulus == pytest.approx(1e6, rel=1e-6)
        assert known.equilibrium_error == 0.0


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"modulus": (1.0,) * 5}, "have \\[4, 5\\] values"),
        ({"temperature": (300.0,) * 3}, "temperature has 3 values, time has 4"),
        ({"time": (1.0, 1.0, 2.0, 3.0)}, "3 times: at least 4"),
    ],
)
def test_a_wrong_table_over_time_is_refused_with_its_place(change, said):
    with pytest.raises(InvalidInput, match=said):
        RelaxationTable(**({"time": (1.0, 2.0, 3.0, 4.0), "modulus": (4.0, 3.0, 2.0, 1.0)} | change))


def test_every_name_is_that_of_one_column():
    names = [name for column in COLUMNS for name in dict.fromkeys(column.called)]
    assert len(names) == len(set(names))
    for quantity in MODULI:
        for kind in (*KINDS, OPEN):
            assert modulus(quantity, kind) in COLUMNS


def test_the_step_itself_is_left_out_of_relaxation_and_that_is_said():
    modulus = np.append(7.7e6, SOLID.relaxation_modulus(TIME))
    found = Tabulated(table={"t [s]": np.append(0.0, TIME), "G(t)": modulus})
    assert found == Tabulated(table={"t [s]": TIME, "G(t)": modulus[1:]})
    assert "1 rows at time 0 are left out" in found.table.notes[0]


def test_few_frequencies_at_many_temperatures_are_enough():
    temperatures = np.repeat(np.linspace(285.0, 330.0, 16), 3)
    factors = np.array([replace(LAW, temperature=each).shift for each in temperatures])
    omega = np.tile([1e1, 1e2, 1e3], 16)
    law = SOLID.complex_modulus(omega * factors)
    table = Tabulated(table={"omega": omega, "T [K]": temperatures, "G'": law.real, "G''": law.imag})
    scene = Scene(Sphere(1e-2), table, Indent(load=1.0), temperature=LAW)
    assert deviation(scene.solid, omega=np.geomspace(1e0, 1e5, 30)) < DRAWN


def test_shift_factors_the_other_way_round_are_refused():
    stated, factors = tables(290.0, 300.0, 320.0)
    with pytest.raises(InvalidInput, match="shift factor grows with the temperature"):
        Tabulated(table=stated | {"aT": 1 / factors})


@pytest.mark.parametrize(
    ("above", "kelvin"), [("T = 20 °C", 293.15), ("Temperatur: 25,5 °C", 298.65), ("T = hot", 0)]
)
def test_a_line_above_the_rows_states_their_temperature(tmp_path, above, kelvin):
    path = tmp_path / "rubber.csv"
    rows = "\n".join(f"{f:g};{1e6 + f:g};1e4" for f in (1, 2, 4, 8))
    path.write_text(f"{above}\nomega;G';G''\n{rows}\n", encoding="utf-8")
    expected = (pytest.approx(kelvin),) * 4 if kelvin else None
    assert read_table(path).temperature == expected
    path.write_text(f"{above}\nomega;G';G''\n{rows}\n\nInterval: 2\nT = 60 °C\n{rows}\n", encoding="utf-8")
    if kelvin:
        assert read_table(path).temperature == expected + (333.15,) * 4
    else:
        with pytest.raises(ValueError, match="'T = 60 °C' above line 10 tells one block from another"):
            read_table(path)


@pytest.mark.parametrize(
    "heading",
    [
        "ω [1/s];G′ [Pa];G′′(ω) [Pa]",
        'omega;G’;G"',
        "Kreisfrequenz in rad/s;Speichermodul in Pa;Verlustmodul in Pa",
        "omega*aT [rad.s-1];Re(G*) [Pa];Im(G*) [Pa]",
        "$\\omega$ (rad/s);$G'$ (Pa);$G''$ (Pa)",
        "angular frequency;storage modulus;loss modulus\nrad/s;Pa;Pa\nSample A;Sample A;Sample A",
        "omega [rad/s];G' [Pa];G''\n-------------------",
    ],
)
def test_headings_of_languages_formulas_and_programs_are_read(tmp_path, heading):
    law = SOLID.complex_modulus(OMEGA)
    rows = "\n".join(f"{w!r};{g.real!r};{g.imag!r}" for w, g in zip(OMEGA.tolist(), law.tolist(), strict=True))
    path = tmp_path / "rubber.csv"
    path.write_text(f"{heading}\n{rows}\n;;\n", encoding="utf-8")
    found = Tabulated(table=path, kind="shear")
    np.testing.assert_array_equal(found.measured()[1], law)
    np.testing.assert_array_equal(found.measured()[0], OMEGA)


@pytest.mark.parametrize(
    "names", ["log omega,log G',lg G''", "log10(omega),log10(G' [Pa]),LOG(G'')", "ln(ω/(rad/s)),G',G''"]
)
def test_logarithms_are_read_as_what_they_are_of(names):
    law, names = SOLID.complex_modulus(OMEGA), names.split(",")
    columns = [
        np.log(each) if name.startswith("ln") else np.log10(each) if name[0] in "lL" else each
        for name, each in zip(names, (OMEGA, law.real, law.imag), strict=True)
    ]
    assert deviation(Tabulated(table=dict(zip(names, columns, strict=True)))) < FITTED


def test_of_storage_and_loss_modulus_both_have_a_unit_or_none(tmp_path):
    path = tmp_path / "rubber.csv"
    path.write_text("omega,G' [MPa],G''\n" + "\n".join(f"{w},1,0.1" for w in range(1, 9)))
    with pytest.raises(ValueError, match='gives a unit of "G\'" and none of "G\'\'"'):
        read_table(path)
