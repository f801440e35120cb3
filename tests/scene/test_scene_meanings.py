"""Unknown names are answered by what they mean, and no hint leads to another number or to another mistake."""

from copy import deepcopy

import pytest
from pydantic import ValidationError

from compare.library.case import Case
from scene.meanings import _TYPES, meaning, rows, type_meant
from scene.mistakes import mistakes
from scene.names import Names
from scene.reading import validator

ADAPTER = validator(Case)
TABLES = [
    table["properties"] for table in Names.of(ADAPTER).schema["$defs"].values() if table.get("type") == "object"
]
SPHERE = {"type": "sphere", "radius": 1e-2}
KELVIN = {"type": "kelvin", "modulus": 1e6, "relaxation_time": 1e-3}
SLIDE = {"type": "slide", "speed": 0.1, "load": 1.0}
ROUGH = {"type": "self-affine", "hurst": 0.5, "rms_height": 1e-6, "longest": 1e-2}
WHOLE = {"indenter": SPHERE, "elastomer": KELVIN, "motion": SLIDE, "roughness": ROUGH, "bem": {}, "mdr": {}}
STANDARD = {
    "type": "standard-linear-solid",
    "rubbery_modulus": 1e6,
    "glassy_modulus": 1e7,
    "relaxation_time": 1e-3,
}
PRONY = {"type": "prony", "equilibrium_modulus": 1e6, "moduli": [1e6], "relaxation_times": [1e-3]}
SHARES = {"type": "prony", "equilibrium_modulus": 1e6, "g": [0.5], "tau": [1e-3]}
CONE = {"type": "cone", "angle": 0.1}
STEEP = {"type": "self-affine", "hurst": 0.5, "longest": 1e-2, "shortest": 1e-4}
MAP = {"type": "topography", "heights": [[0.0, 1e-6, 0.0, 1e-6]] * 4, "pixel": 1e-6}


def said_of(content):
    try:
        ADAPTER.validate_python(content)
    except ValidationError as error:
        return mistakes(error, content, ADAPTER)
    return []


def hint(table, name, value, without=None, **parts):
    """What is said of a name that is added to a table, without another one."""
    content = deepcopy(WHOLE | parts)
    content[table].pop(without, None)
    content[table][name] = value
    (line,) = [line for line in said_of(content) if line.startswith(f"{table}.{name} = ")]
    return line.partition("unknown here; ")[2].rpartition("nown are")[0][:-1].strip("; ")


def test_what_a_name_means_is_a_field_of_some_part():
    for each, names in rows():
        for field in each.fields:
            assert any(field in table for table in TABLES), (field, names)


def test_no_meaning_overrides_a_name_that_a_table_has():
    for table in TABLES:
        for name in table:
            assert meaning(name, table) is None, name


@pytest.mark.parametrize(
    ("table", "name", "value", "field", "parts"),
    [
        ("elastomer", "G", "1 MPa", "modulus", {}),
        ("elastomer", "E", "3 MPa", "youngs_modulus", {}),
        ("elastomer", "times", [1e-3], "relaxation_times", {"elastomer": PRONY}),
        ("elastomer", "alpha", [0.2], "g", {"elastomer": SHARES}),
        ("motion", "v", 0.1, "speed", {}),
        ("roughness", "H", 0.5, "hurst", {}),
        ("roughness", "Sdq", 0.1, "rms_slope", {"roughness": STEEP}),
        ("roughness", "dx", "1 um", "pixel", {"roughness": MAP}),
    ],
)
def test_another_name_of_a_field_is_said_as_the_field_and_its_value_is_checked_there(
    table, name, value, field, parts
):
    assert hint(table, name, value, without=field, **parts) == f"did you mean {field}?"
    content = deepcopy(WHOLE | parts)
    content[table].pop(field, None)
    content[table][name] = value
    assert not any(": missing" in line for line in said_of(content))


@pytest.mark.parametrize(
    ("table", "name", "value", "field", "said", "parts"),
    [
        ("elastomer", "E", "3 MPa", "rubbery_modulus", "a third of E", {"elastomer": STANDARD}),
        ("elastomer", "stiffness", "3 N/m", "modulus", "shear modulus [Pa]", {}),
        ("elastomer", "viscosity", "1 kPa s", "relaxation_time", "relaxation_time = viscosity / modulus", {}),
        ("elastomer", "retardation_time", 1e-2, "relaxation_time", "* rubbery_modulus /", {"elastomer": STANDARD}),
        ("elastomer", "beta", [10.0], "relaxation_times", "relaxation_times = 1 / beta", {"elastomer": PRONY}),
        ("elastomer", "T", "25 degC", None, "[temperature]", {}),
        ("elastomer", "mu", 1e6, "modulus", "that of [interface]", {}),
        ("indenter", "diameter", "5 mm", "radius", "half of the diameter", {}),
        ("motion", "mass", 1.0, "load", "9.81 N", {}),
        ("roughness", "Ra", 1e-6, "rms_height", "1.25 Ra", {}),
        ("bem", "dx", "1 um", "points", "points = extent / pixel", {}),
    ],
)
def test_another_quantity_is_never_said_as_a_field_and_the_way_to_the_field_is(
    table, name, value, field, said, parts
):
    found = hint(table, name, value, without=field, **parts)
    assert said in found
    assert "did you mean" not in found


def test_a_name_that_belongs_to_another_table_is_said_with_it():
    assert hint("motion", "mu", 0.5) == "did you mean interface.coefficient?"
    assert said_of({"nu": 0.3, **WHOLE})[0].startswith(
        "nu = 0.3: unknown here; did you mean elastomer.poisson_ratio?"
    )


def test_a_hint_says_where_a_name_has_a_value_already_or_takes_another_kind_of_it():
    assert hint("elastomer", "G", 1e6) == "did you mean modulus? It has a value already"
    assert hint("elastomer", "modlus", 1e6) == "did you mean modulus? It has a value already"
    assert hint("roughness", "hurts", "0.5", without="hurst") == "hurst takes a number"
    assert hint("motion", "my_speed", 0.1, without="speed") == "did you mean speed?"
    assert hint("bem", "resolution", "1 um") == "points takes a whole number"
    assert hint("elastomer", "times", 1e-3, without="relaxation_times", elastomer=PRONY) == (
        "relaxation_times takes a list"
    )


def test_another_name_of_a_type_is_said_as_the_type():
    known = ["elastic", "kelvin", "standard-linear-solid", "prony", "kelvin-chain"]
    assert type_meant("Kelvin-Voigt", known) == "kelvin"
    assert type_meant("generalized_Maxwell", known) == "prony"
    assert type_meant("maxwell", known) is None  # a liquid
    found = said_of(WHOLE | {"elastomer": {**STANDARD, "type": "Zener"}})
    assert found == [line for line in found if line.endswith("did you mean 'standard-linear-solid'?")]
    schema = str(Names.of(ADAPTER).schema)
    assert all(f"'{kind}'" in schema for kind in _TYPES)
