"""What was stored is read back for analysis, by this package and by xarray alone."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray

import compare
from bem3d import BEM
from compare import archive, netcdf
from compare.archive import RESULTS, SOLVED, load, record
from compare.casefile import toml
from compare.cases import Case, Study
from compare.outcome import Outcome, Row
from compare.store import Store
from compare.study import points, tasks
from compare.sweep import Swept
from compare.verdict import judge
from compare.written import as_json
from mdr1d import MDR
from scene import Kelvin, SelfAffine, Slide, Sphere
from scene.reading import InvalidInput, read

CASE = Case(
    title='rough µ-sphere, "small" \\ [1]',
    notes=("no\nfigures", "≤ 1"),
    indenter=Sphere(radius=1e-2),
    elastomer=Kelvin(modulus=1e6, relaxation_time=1e-3),
    motion=Slide(speed=0.1, load=1.0),
    roughness=SelfAffine(hurst=0.5, rms_height=1e-6, longest=1e-2, shortest=1e-3, seed=1),
    study=Study(
        speeds=(0.05, 0.1),
        pressing=(0.3, 0.5, 1.0, 2.0),
        load_speeds=(0.03, 0.1, 0.3),
        depths=(0.5, 1.0),
        surfaces=2,
        profiles=3,
    ),
    bem=BEM(points=32),
    mdr=MDR(points=200),
)
SHIPPED = sorted((Path(compare.__file__).parent / "scenes").glob("*.toml"))


@pytest.fixture(scope="module")
def judgement():
    asked = points(CASE)
    outcomes = {task: task.solve() for task in tasks(asked)}
    # One surface failed.
    failed = next(task for task in outcomes if task.solver.name == "BEM" and not task.keeps_fields)
    outcomes[failed] = failed.failed("did not converge: 5 % µ")
    return judge(CASE, asked, Swept(outcomes, len(outcomes), 0, 1.0))


@pytest.fixture(scope="module")
def folder(judgement, tmp_path_factory):
    """As `crosscheck run` leaves one, with a case in its folder and two tasks in the store."""
    folder = tmp_path_factory.mktemp("report")
    (folder / "sphere").mkdir()
    record(folder / "sphere" / RESULTS, judgement)
    first, second = tasks(points(CASE))[:2]
    store = Store(folder / SOLVED)
    store.put(first, first.solve())
    store.put(second, second.failed("it broke"))
    return folder


def test_the_file_of_a_case_has_every_number_of_its_judgement(judgement, folder):
    tree = load(folder / "sphere" / RESULTS)
    table = tree["points"].to_dataset()
    for name in judgement.table[0].columns:
        stored, known = table[name].values, [record.columns[name] for record in judgement.table]
        assert np.array_equal(stored, known, equal_nan=stored.dtype.kind == "f")
    for place, numbers in (("numbers", judgement.numbers), ("checks", judgement.checks)):
        found = tree[place].to_dataset()
        assert found.number.values.tolist() == [number.name for number in numbers]
        assert found.definition.values.tolist() == [number.text for number in numbers]
        assert found.written.values.tolist() == [number.written for number in numbers]
        for name in ("value", "error"):
            known = [getattr(number, name) for number in numbers]
            assert np.array_equal(found[name].values, known, equal_nan=True)
    assert set(tree["collapses"].children) == set(judgement.collapses) != set()
    for solver, collapse in judgement.collapses.items():
        found = tree["collapses"][solver]
        assert found["exponent"].item() == collapse.exponent
        assert np.array_equal(found["shift"].values, collapse.shifts)
        assert found.attrs["verdict"] == collapse.verdict
    for solver, fields in judgement.fields.items():
        assert all(np.array_equal(tree["fields"][solver][name].values, each) for name, each in fields.items())
    failures = zip(tree["failures"]["task"].values, tree["failures"]["reason"].values, strict=True)
    assert tuple(failures) == judgement.failures != ()
    assert dict(zip(tree["costs/solver"].values, tree["costs/seconds"].values, strict=True)) == judgement.seconds


def test_every_number_in_the_file_of_a_case_says_what_it_is(folder):
    tree = load(folder / "sphere" / RESULTS)
    for place in ("points", "collapses/MDR", "fields/BEM"):
        for name, variable in tree[place].variables.items():
            if variable.dtype.kind == "f":
                assert variable.attrs["units"], name
                assert variable.attrs["comment"], name
    assert tree["points/friction_force"].units == "N"
    assert tree["points/depth_reached_error"].comment.startswith("standard error of the mean: Depth")
    assert tree["fields/BEM/pressure"].dims == ("y", "x")


def test_a_case_comes_back_from_its_file(folder, tmp_path):
    tree = load(folder / "sphere" / RESULTS)
    (tmp_path / "again.toml").write_text(tree["case_toml"].item(), encoding="utf-8")
    assert read(tmp_path / "again.toml", Case) == CASE
    assert tree.attrs["title"] == CASE.title


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_every_ready_scene_comes_back_from_the_text_that_is_kept_of_it(path, tmp_path):
    case = read(path, Case)
    (tmp_path / "again.toml").write_text(toml(as_json(Case, case)), encoding="utf-8")
    assert read(tmp_path / "again.toml", Case) == case


def test_a_folder_is_an_index_of_its_tasks_and_the_cases_in_it(folder, judgement):
    tree = load(folder)
    index = tree["solved"].to_dataset()
    first, second = tasks(points(CASE))[:2]
    assert sorted(index.label.values) == sorted([first.label, second.label])
    rows = {label: k for k, label in enumerate(index.label.values)}
    assert index.failures.values[rows[second.label]] == len(second.scenes)
    assert index.solver.values[rows[first.label]] == first.solver.name
    assert len(tree["sphere/numbers/value"]) == len(judgement.numbers)
    task = load(folder / SOLVED / str(index.file.values[rows[first.label]]))
    assert task["normal_force"].values[0] == Store(folder / SOLVED).get(first).rows[0].normal_force
    assert load(folder / SOLVED)["solved"].sizes["task"] == 2


def test_a_file_without_parts_is_a_dataset_and_one_with_fields_a_tree(tmp_path):
    task = tasks(points(CASE))[0]
    store, plain = Store(tmp_path), replace(task, keeps_fields=False)
    store.put(plain, Outcome((Row(reason="none"),) * len(task.scenes)))
    (path,) = tmp_path.glob("*.nc")
    found = load(path)
    assert isinstance(found, xarray.Dataset)
    assert found.reason.values.tolist() == ["none"] * len(task.scenes)
    assert found.seed.values.tolist() == [scene.roughness.seed for scene in task.scenes]
    store.put(replace(task, keeps_fields=True), task.solve())
    assert load(path)["fields/profile"].dims == ("x",)


def test_nothing_stays_open(folder):
    """Numbers are there once the file is gone."""
    copy = folder.parent / "copy.nc"
    copy.write_bytes((folder / "sphere" / RESULTS).read_bytes())
    before = _open()
    found = load(copy)
    copy.unlink()
    assert math.isfinite(found["points/speed"].values.sum())
    assert _open() == before


def _open():
    """Descriptors of this process, where the system tells."""
    own = Path("/proc/self/fd")
    return len(list(own.iterdir())) if own.exists() else 0


def test_what_is_no_result_is_said_clearly(tmp_path, folder):
    other = tmp_path / "other.nc"
    xarray.Dataset({"x": 1.0}).to_netcdf(other, engine="h5netcdf")
    damaged = tmp_path / "damaged.nc"
    damaged.write_bytes((folder / "sphere" / RESULTS).read_bytes()[:-200])
    for path in (other, damaged):
        with pytest.raises(InvalidInput, match=f"{path}: no file of results: the file is damaged, or"):
            load(path)
    with pytest.raises(FileNotFoundError):
        load(tmp_path / "absent.nc")
    (tmp_path / "empty").mkdir()
    with pytest.raises(InvalidInput, match="empty: no command has left results here"):
        load(tmp_path / "empty")


def test_what_is_damaged_in_a_store_is_left_out_of_its_index(tmp_path):
    first, second = tasks(points(CASE))[:2]
    for task in (first, second):
        Store(tmp_path).put(task, task.failed("none"))
    damaged = next(tmp_path.glob("*.nc"))
    damaged.write_bytes(b"")
    assert archive.index(tmp_path).sizes["task"] == 1


def test_lengths_that_disagree_along_a_dimension_are_refused():
    variables = {name: netcdf.Variable(("x",), np.zeros(n)) for n, name in enumerate("abc", 2)}
    with pytest.raises(ValueError, match="b has 3 along x, where others have 2"):
        netcdf.encoded(netcdf.Group(variables))


def test_many_attributes_in_any_letters_come_back(tmp_path):
    """More than eight, from which on HDF5 keeps them otherwise."""
    attributes = {f"name {k}": f"µ {k} " * (k * 100 + 1) for k in range(20)}
    path = tmp_path / "file.nc"
    path.write_bytes(
        netcdf.encoded(netcdf.Group({"x": netcdf.Variable((), np.array(1.0), attributes)}, attributes))
    )
    found = load(path)
    assert found.attrs == found.x.attrs == attributes
