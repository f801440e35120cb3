"""The files to begin with: each is read, planned, copied, valid by its schema, and solved where it is compared."""

import tomllib

import numpy as np
import pytest
from damage import places
from imports import ROOT
from small_cases import seldom

from compare import run
from compare.library.case import Case
from compare.library.lookup import located
from compare.library.ready import find, ready, write
from compare.solving.cost import MOST_VALUES
from compare.studies.comparison.study_file import StudyFile, study_of
from compare.studies.plan import plans
from compare.studies.schema import DIALECT, schema
from scene import Prony, Refused
from scene.files.reading import InvalidInput, made, read

SCENES = [name for name, each in ready().items() if each.kind == "scene"]
ONE_SOLVER = {"line-contact", "rough-plane", "thin-layer"}


def written(name, tmp_path):
    return write(name, tmp_path / f"{name}.toml")


@pytest.mark.parametrize("name", SCENES)
def test_every_scene_is_read_and_planned(name, tmp_path):
    path = written(name, tmp_path)
    case = read(path, Case)
    if name in ONE_SOLVER:
        with pytest.raises(Refused):
            case.refuse()
    else:
        case.refuse()
        assert case.title == find(name).title
    found = plans(path)
    assert found.feasible
    assert {solver for solver, plan in found.items() if isinstance(plan, str)} == (
        {"MDR"} if name in ONE_SOLVER else set()
    )


COMPARED = sorted(set(SCENES) - ONE_SOLVER - {"paper-sphere", "paper-cone"})


# One that is smooth and slides stands for the others.
@pytest.mark.parametrize("name", seldom(COMPARED, ("standard-solid",)))
def test_every_scene_that_can_be_compared_is(name, tmp_path):
    report = run(written(name, tmp_path), tmp_path / "out", workers=1, report=False)
    assert not report.faults
    assert len(report.findings)


# Schemas for editors


@pytest.fixture(scope="module")
def validators():
    jsonschema = pytest.importorskip("jsonschema")
    return {kind: jsonschema.Draft202012Validator(schema(kind)) for kind in ("scene", "study")}


@pytest.mark.parametrize("kind", ["scene", "study"])
def test_a_schema_is_one(kind, validators):
    validators[kind].check_schema(schema(kind))
    assert schema(kind)["$schema"] == DIALECT
    with pytest.raises(InvalidInput, match="allowed are scene, study"):
        schema("nothing")


@pytest.mark.parametrize("name", ready())
def test_every_file_is_valid_by_its_schema(name, validators):
    each = ready()[name]
    errors = list(validators[each.kind].iter_errors(tomllib.loads(each.text)))
    assert not errors


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('radius = "10 mm"', 'radus = "10 mm"'),
        ('"sphere"', '"spher"'),
        ("hurst = 0.8", "hurst = 2"),
        ("[mdr]", "[mrd]"),
        ("seed = 1", 'amplitudes = "any"'),
    ],
)
def test_what_a_file_may_not_say_is_no_valid_file_by_the_schema_either(old, new, validators, tmp_path):
    text = find("quick-start").text
    assert old in text
    path = tmp_path / "wrong.toml"
    path.write_text(text.replace(old, new), encoding="utf-8")
    with pytest.raises(InvalidInput):
        read(path, Case)
    assert not validators["scene"].is_valid(tomllib.loads(path.read_text(encoding="utf-8")))


TABLES = {"indenter", "elastomer", "roughness", "temperature", "mdr", "bem"}


@pytest.mark.parametrize("name", ready())
def test_a_truth_is_no_number_to_the_reader_nor_to_the_schema(name, validators):
    kind, content = ready()[name].kind, tomllib.loads(ready()[name].text)
    found = list(places(content))
    # Both leave tables of a study open that a series may complete.
    partial = [id(inside[key]) for inside, key in found if kind == "study" and key in TABLES]
    for inside, key in found:
        value = inside[key]
        if isinstance(value, dict) or id(inside) in partial or (isinstance(key, int) and key):
            continue
        inside[key] = [True]
        assert not validators[kind].is_valid(content), key
        with pytest.raises(InvalidInput):
            made(content, {"scene": Case, "study": StudyFile}[kind], name)
        inside[key] = value


@pytest.mark.parametrize("name", ["kind", "frequency_unit"])
def test_a_table_where_a_word_belongs_is_named_beside_a_file_of_moduli(name, tmp_path):
    rows = ["f [Hz];E' [MPa];E'' [MPa]", "1;3;0.3", "10;3.3;0.4", "100;4;0.3", "1000;4.5;0.2"]
    (tmp_path / "rubber.csv").write_text("\n".join(rows))
    elastomer = {"type": "tabulated", "table": str(tmp_path / "rubber.csv"), name: {"a": 1}}
    with pytest.raises(InvalidInput, match=rf"elastomer\.{name}: Input should be "):
        made(tomllib.loads(find("hertz").text) | {"elastomer": elastomer}, Case, "mine.toml")


def test_a_list_is_as_long_for_the_schema_as_for_the_reader(validators):
    content = tomllib.loads(find("quick-start").text)
    for speeds, valid in (([], False), ([0.1], True), ([0.1] * (MOST_VALUES + 1), False)):
        content["study"]["speeds"] = speeds
        assert validators["scene"].is_valid(content) is valid


# The page about them


def blocks_of(page):
    """What stands in TOML on a page of the docs, from its blocks."""
    text = (ROOT / "docs" / page).read_text(encoding="utf-8")
    return [part.partition("```")[0] for part in text.split("```toml\n")[1:]]


@pytest.mark.parametrize("text", blocks_of("reference/scenes.md"), ids=lambda text: text.strip().splitlines()[0])
def test_every_file_of_the_page_about_scenes_is_read(text, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    draws = np.random.default_rng(1)
    np.save("surface.npy", draws.normal(size=(32, 32)))
    np.savetxt("line.csv", draws.normal(size=400).cumsum())
    solid = Prony(1e6, (1e6, 1e6), (1e-2, 1.0))
    frequency = np.geomspace(1e-3, 1e3, 30)
    moduli = 1e-6 * 3 * solid.complex_modulus(2 * np.pi * frequency)
    moduli = np.column_stack([frequency, moduli.real, moduli.imag])
    densities = [(1e3, 1e-14), (1e4, 1e-15), (1e6, 1e-21)]
    for name, rows, head in (
        ("psd.csv", densities, "q [rad/m];C1D [m^3]"),
        ("rubber.csv", moduli, "f [Hz];E' [MPa];E'' [MPa]"),
    ):
        np.savetxt(name, rows, delimiter=";", header=head, comments="")
    if "[[series]]" in text:
        assert study_of(text, "mine").series("quick")
        return
    # A file takes the parts that it leaves out from a ready scene.
    stated, whole = tomllib.loads(text), tomllib.loads(find("cold-rubber").text)
    content = {name: stated.get(name, whole.get(name)) for name in {**whole, **stated}}
    if "indenter" not in stated and "gap" in stated.get("motion", {}):
        content["indenter"] = {"type": "plane"}
    assert made(content, Case, "scenes.md").scene


def test_a_folder_of_an_earlier_run_does_not_hide_the_ready_scene_it_was_made_from(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "quick-start").mkdir()
    (tmp_path / "elsewhere").mkdir()
    assert located("quick-start").name == "quick-start.toml"
    with pytest.raises(InvalidInput, match="is no regular file"):
        located("elsewhere")
