"""What is stored comes back as it was, under a name that changes with everything the answer depends on."""

import errno
import json
import multiprocessing
import os
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np
import pytest
import xarray
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays
from strategies import examples

from compare import netcdf
from compare import store as module
from compare.exact import Exact
from compare.outcome import Outcome, Row
from compare.store import Store, canonical, code_digest, key, write
from compare.studies.paper.parameter_studies import ParameterStudies
from compare.task import SceneTask as Task
from compare.taskfile import OTHERS
from mdr1d import MDR
from scene import Indent, Kelvin, Prony, Scene, SelfAffine, Slide, Sphere
from scene.vocabulary import MEASURES, NUMBERS

SCENE = Scene(
    Sphere(radius=1e-2),
    Kelvin(modulus=1e6, relaxation_time=1e-3),
    Slide(speed=0.1, load=1.0),
    SelfAffine(hurst=0.5, rms_height=1e-6, longest=1e-2, seed=3),
)
TASK = Task(MDR(points=100), (SCENE,))
PICTURE = replace(TASK, keeps_fields=True)
ROW = Row(1.0, 1e-4, 0.1, 1e-9, 12.0, 0.5, {"pixel": 1e-6, "odd": np.nan}, {"points": 100, "cutoff": None})


def drawn(count):
    """A task of so many scenes."""
    return replace(TASK, scenes=(SCENE,) * count)


def bits(value):
    """What two floats share only if they are the same, NaN with NaN, -0.0 apart from 0.0."""
    return np.float64(value).tobytes()


def same(first, second):
    """Whether two outcomes are the same, bit for bit."""
    return (
        len(first.rows) == len(second.rows)
        and all(map(same_row, first.rows, second.rows))
        and first.fields.keys() == second.fields.keys()
        and all(same_array(first.fields[name], second.fields[name]) for name in first.fields)
    )


def same_row(first, second):
    return (
        all(bits(getattr(first, name)) == bits(getattr(second, name)) for name in NUMBERS)
        and {name: bits(value) for name, value in first.measures.items()}
        == {name: bits(value) for name, value in second.measures.items()}
        and (repr(dict(sorted(first.settings.items()))), first.reason)
        == (repr(dict(sorted(second.settings.items()))), second.reason)
    )


def same_array(first, second):
    first, second = np.asarray(first), np.asarray(second)
    return (first.dtype, first.shape, first.tobytes()) == (second.dtype, second.shape, second.tobytes())


FLOATS = st.floats(width=64)  # NaN with any payload that NumPy keeps, infinities, subnormals, both zeros
NAMES = st.sampled_from(sorted(MEASURES)) | st.text("abcxyz_2µ", min_size=1, max_size=12).filter(
    lambda name: name not in {*NUMBERS, *OTHERS}
)
SETTINGS = st.dictionaries(
    st.text(max_size=8), st.none() | st.booleans() | st.integers() | FLOATS | st.text(max_size=20), max_size=4
)
ROWS = st.builds(
    Row,
    *[FLOATS] * len(NUMBERS),
    measures=st.dictionaries(NAMES, FLOATS, max_size=5),
    settings=SETTINGS,
    reason=st.none() | st.text(st.characters(exclude_characters="\0", exclude_categories=["Cs"]), max_size=80),
)
TYPES = st.sampled_from(["f8", "f4", "i8", "i4", "u1", "?", ">f8"])
FIELDS = st.dictionaries(
    st.sampled_from(["x", "y", "pressure", "profile", "time", "depth", "friction", "own word"]),
    TYPES.flatmap(lambda kind: arrays(kind, array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=4))),
    max_size=4,
)


@examples(60)
@given(rows=st.lists(ROWS, min_size=1, max_size=4), fields=FIELDS)
def test_whatever_an_outcome_holds_comes_back_bit_for_bit(tmp_path_factory, rows, fields):
    task, store = replace(drawn(len(rows)), keeps_fields=True), Store(tmp_path_factory.mktemp("store"))
    outcome = Outcome(tuple(rows), fields)
    store.put(task, outcome)
    assert same(store.get(task), outcome)


def test_what_is_compared_bit_for_bit_tells_a_bit():
    other = replace(ROW, normal_force=np.nextafter(1.0, 2.0))
    assert not same(Outcome((ROW,)), Outcome((other,)))
    assert not same(Outcome((replace(ROW, depth=0.0),)), Outcome((replace(ROW, depth=-0.0),)))


@pytest.mark.parametrize("count", [1, 2, 50, 264])
def test_every_row_comes_back_with_its_own_measures_settings_and_reason(tmp_path, count):
    rows = tuple(
        Row(reason=f"surface {k}: µ, ≤, \n and more " * 9)
        if k % 7 == 3
        else replace(ROW, measures={"pixel": k, str(k % 5): 1.0})
        for k in range(count)
    )
    store = Store(tmp_path)
    store.put(drawn(count), Outcome(rows))
    assert same(store.get(drawn(count)), Outcome(rows))


def test_a_block_of_the_campaign_comes_back(tmp_path):
    """1320 contacts on 20 profiles, a question of half a megabyte."""
    (block,) = ParameterStudies(profiles=20).tasks()
    assert len(canonical(block.question)) > 2**17
    found = np.random.default_rng(1).random((6, *block.shape))
    found[2, 7, 5] = np.nan
    names = ("friction", "depth", "length", "span", "rms_slope", "sweeps")
    outcome = Outcome((), dict(zip(names, found, strict=True)))
    store = Store(tmp_path)
    store.put(block, outcome)
    assert same(store.get(block), outcome)


def test_failures_come_back_as_nan_with_their_reason(tmp_path):
    Store(tmp_path).put(TASK, Outcome((Row(reason="did not converge"),)))
    (found,) = Store(tmp_path).get(TASK).rows
    assert np.isnan(found.normal_force)
    assert found.reason == "did not converge"


def test_fields_come_back_and_are_missed_where_they_are_wanted(tmp_path):
    store = Store(tmp_path)
    store.put(TASK, Outcome((ROW,)))
    assert store.get(TASK) is not None
    assert store.get(PICTURE) is None
    store.put(PICTURE, Outcome((ROW,), {"x": np.arange(3.0)}))
    assert np.array_equal(store.get(PICTURE).fields["x"], np.arange(3.0))
    assert store.get(TASK).fields == {}


def test_a_task_whose_fields_are_empty_is_done(tmp_path):
    store = Store(tmp_path)
    store.put(PICTURE, Outcome((ROW,)))
    assert store.get(PICTURE).fields == {}


def test_what_no_file_can_hold_is_refused_and_leaves_nothing(tmp_path):
    store = Store(tmp_path)
    with pytest.raises(TypeError, match="x is of type complex128"):
        store.put(PICTURE, Outcome((ROW,), {"x": np.ones(3, complex)}))
    with pytest.raises(ValueError, match="no measure may be called depth"):
        store.put(TASK, Outcome((replace(ROW, measures={"depth": 1.0}),)))
    assert list(tmp_path.iterdir()) == []


def test_a_file_says_what_it_holds_to_whoever_opens_it(tmp_path):
    """The netCDF-4 of others: units, meanings and axes by xarray alone."""
    store = Store(tmp_path)
    store.put(PICTURE, PICTURE.solve())
    (path,) = tmp_path.glob("*.nc")
    with xarray.open_dataset(path) as rows, xarray.open_dataset(path, group="fields") as fields:
        outcome = store.get(PICTURE)
        assert rows.depth.item() == outcome.rows[0].depth
        assert rows.depth.units == fields.x.units == "m"
        assert rows.normal_force.units == "N"
        assert rows.seed.item() == 3
        assert fields.displacement.dims == ("x",)
        assert fields.contact.dtype == bool
        assert np.array_equal(fields.line_force, outcome.fields["line_force"])
        asked = json.loads(rows.question.item())
        assert asked["solver"] == "MDR"
        assert asked["scenes"][0]["indenter"]["radius"] == 1e-2
        assert set(json.loads(rows.code)) == {"scene", "mdr1d"}
        assert "numpy" in json.loads(rows.versions)
        assert rows.title == TASK.label
        assert all(each.attrs.get("comment") for each in fields.variables.values())
    with h5py.File(path) as file:
        assert file["depth"].dims[0][0].name == "/scene"


@pytest.mark.parametrize("cut", [0, 1, 40, -3])
def test_a_half_written_file_counts_as_absent(tmp_path, cut):
    store = Store(tmp_path)
    store.put(TASK, Outcome((ROW,)))
    (path,) = tmp_path.glob("*.nc")
    path.write_bytes(path.read_bytes()[:cut])
    assert store.get(TASK) is None
    assert store.recall(TASK) is None


def test_a_file_of_something_else_counts_as_absent(tmp_path):
    store, path = Store(tmp_path), tmp_path / f"{key(TASK)}.nc"
    xarray.Dataset({"depth": 1.0}).to_netcdf(tmp_path / "other.nc", engine="h5netcdf")
    empty = netcdf.encoded(netcdf.Group())
    for content in (b"", b"{}", (tmp_path / "other.nc").read_bytes(), empty):
        path.write_bytes(content)
        assert store.get(TASK) is None
    path.unlink()
    path.mkdir()
    assert store.get(TASK) is None


def test_a_file_that_answers_another_question_counts_as_absent(tmp_path):
    """As where two questions had one digest, or a file was given another's name."""
    store, other = Store(tmp_path), replace(TASK, solver=MDR(points=102))
    store.put(other, Outcome((ROW,)))
    (tmp_path / f"{key(other)}.nc").rename(tmp_path / f"{key(TASK)}.nc")
    assert store.get(TASK) is None
    store.put(TASK, Outcome((ROW,)))
    assert store.get(TASK) is not None


def test_a_file_that_is_damaged_counts_as_absent_whichever_bit_it_is(tmp_path):
    store = Store(tmp_path)
    store.put(PICTURE, Outcome((ROW,), {"x": np.arange(300.0)}))
    (path,) = tmp_path.glob("*.nc")
    whole = path.read_bytes()
    places = np.random.default_rng(0).integers(len(whole), size=400)
    for place, bit in zip(places, 1 << np.arange(400) % 8, strict=True):
        path.write_bytes(whole[:place] + bytes([whole[place] ^ int(bit)]) + whole[place + 1 :])
        assert store.get(PICTURE) is None
    for content in (whole + b"\0", b"\0" + whole, whole[:-1], whole.replace(b"x", b"y")):
        path.write_bytes(content)
        assert store.get(PICTURE) is None
    path.write_bytes(whole)
    assert store.get(PICTURE) is not None


def test_what_is_not_there_is_missed_without_listing_or_loading(tmp_path, monkeypatch):
    """A study asks for thousands: each costs the attempt to open one file."""
    opened = []
    monkeypatch.setattr(Path, "read_bytes", lambda path: opened.append(path) or Path.open(path, "rb").read())
    monkeypatch.setattr(Path, "glob", lambda *_: pytest.fail("the folder was listed"))
    key(TASK)
    opened.clear()
    assert Store(tmp_path).get(TASK) is None
    assert opened == [tmp_path / f"{key(TASK)}.nc"]


def test_a_write_that_breaks_off_leaves_the_old_file_and_no_other(tmp_path):
    path = tmp_path / "numbers.json"
    path.write_text("old")

    def broken(file):
        file.write(b"ne")
        raise OSError("disk full")

    with pytest.raises(OSError, match="disk full"):
        write(path, broken)
    assert path.read_text() == "old"
    assert os.listdir(tmp_path) == ["numbers.json"]
    write(path, lambda file: file.write(b"new"))
    assert path.read_text() == "new"
    assert os.listdir(tmp_path) == ["numbers.json"]


@pytest.fixture
def little_room():
    """No file may be longer than 4 kB, as on a disk that fills up while one is written."""
    resource = pytest.importorskip("resource")
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, before[1]))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, before)
    signal.signal(signal.SIGXFSZ, handler)


@pytest.mark.usefixtures("little_room")
def test_a_full_disk_is_an_error_that_names_the_file_and_leaves_none(tmp_path):
    with pytest.raises(OSError, match="File too large") as caught:
        Store(tmp_path).put(TASK, Outcome((ROW,)))
    assert caught.value.errno == errno.EFBIG
    assert caught.value.filename == str(tmp_path / f"{key(TASK)}.nc")
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_takes_no_file_is_an_error_that_names_the_file(tmp_path):
    (tmp_path / "solved").touch()
    with pytest.raises(OSError, match="solved"):
        Store(tmp_path / "solved").put(TASK, Outcome((ROW,)))
    with pytest.raises(FileNotFoundError) as caught:
        write(tmp_path / "absent" / "numbers.csv", lambda file: file.write(b""))
    assert caught.value.filename == str(tmp_path / "absent" / "numbers.csv")


def test_other_code_has_a_file_of_its_own_and_is_recalled_until_this_code_has_answered(tmp_path, monkeypatch):
    store, later = Store(tmp_path), replace(ROW, depth=3.0)
    for number in (1.0, 2.0):
        with monkeypatch.context() as other:
            other.setattr(module, "_code_digest", lambda _, number=number: f"other{number:g}")
            store.put(TASK, Outcome((replace(ROW, depth=number),)))
    assert store.get(TASK) is None
    assert store.recall(TASK).rows[0].depth == 2.0  # the newer of the two
    assert not store.holds(TASK)
    store.put(TASK, Outcome((later,)))
    assert len(list(tmp_path.glob("*.nc"))) == 3
    assert store.recall(TASK).rows[0].depth == store.get(TASK).rows[0].depth == 3.0
    assert store.holds(TASK)


def test_what_is_recalled_by_other_code_fits_what_is_asked(tmp_path, monkeypatch):
    """Newer without the fields that are wanted, older with them: the older one answers."""
    store = Store(tmp_path)
    monkeypatch.setattr(module, "_code_digest", lambda _: "older")
    store.put(PICTURE, Outcome((ROW,), {"x": np.arange(3.0)}))
    monkeypatch.setattr(module, "_code_digest", lambda _: "newer")
    store.put(TASK, Outcome((ROW,)))
    monkeypatch.undo()
    assert store.recall(PICTURE).fields["x"].size == 3


FORKS = pytest.mark.filterwarnings("ignore:This process:DeprecationWarning")


def writer(folder, times):
    """A process that writes one task again and again: a copy of this one, with the code that this one has."""
    process = multiprocessing.get_context("fork").Process(target=_write, args=(folder, times))
    process.start()
    return process


def _write(folder, times):
    _slow_disk()
    for k in range(times):
        outcome = Outcome((replace(ROW, depth=float(k)),), {"x": np.full(20000, float(k))})
        Store(folder).put(PICTURE, outcome)


def _slow_disk():
    """In a process of its own: half of its time it has a file that is written and has no name yet."""
    replaced = os.replace
    os.replace = lambda *paths: time.sleep(0.01) or replaced(*paths)


def consistent(outcome):
    """Whether numbers and fields are of one write."""
    return bool((outcome.fields["x"] == outcome.rows[0].depth).all())


@FORKS
def test_two_processes_write_one_task_while_others_read_it(tmp_path):
    store, both, read = Store(tmp_path), [writer(tmp_path, 40) for _ in range(2)], 0
    while any(process.is_alive() for process in both):
        outcome = store.get(PICTURE)
        assert outcome is not None or read == 0
        read += outcome is not None
        assert outcome is None or consistent(outcome)
    assert [process.exitcode for process in both] == [0, 0]
    assert store.get(PICTURE).rows[0].depth == 39.0
    assert read > 10
    assert [path.name for path in tmp_path.iterdir()] == [f"{key(PICTURE)}.nc"]


def killed_at_random(folder, times, seed):
    """A writer killed so often: how many files it left half written. What is in sight is whole each time."""
    store, moments, halves = Store(folder), np.random.default_rng(seed), 0
    for _ in range(times):
        process = writer(folder, 10**6)
        time.sleep(moments.uniform(0.0, 0.1))
        process.kill()
        process.join()
        seen = list(folder.glob("*.nc"))
        assert all(consistent(store.get(PICTURE)) for _ in seen)
        left = len(list(folder.iterdir())) - len(seen)
        assert left <= 1  # each writer clears what the one before it left
        halves += left
    process = writer(folder, 1)
    process.join()
    assert process.exitcode == 0
    assert [path.name for path in folder.iterdir()] == [f"{key(PICTURE)}.nc"]
    return halves


@FORKS
def test_a_writer_killed_at_any_moment_leaves_whole_files_and_nothing_else(tmp_path):
    assert killed_at_random(tmp_path, 10, seed=0) > 0


@FORKS
@pytest.mark.slow
def test_a_writer_killed_at_fifty_moments_leaves_whole_files_and_nothing_else(tmp_path):
    assert killed_at_random(tmp_path, 50, seed=1) > 0


def test_temporary_files_of_a_process_that_lives_are_left_alone(tmp_path):
    alive = subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE)
    ended = subprocess.Popen([sys.executable, "-c", ""])
    ended.wait()
    names = {
        "alive": f".{key(TASK)}.nc.{module._machine()}-{alive.pid}.abcdefgh",
        "ended": f".{key(TASK)}.nc.{module._machine()}-{ended.pid}.abcdefgh",
        "elsewhere": f".{key(TASK)}.nc.00000000-{ended.pid}.abcdefgh",
        "elsewhere, days ago": f".{key(TASK)}.nc.00000000-{ended.pid}.ijklmnop",
        "something else": ".hidden",
    }
    for name in names.values():
        (tmp_path / name).touch()
    os.utime(tmp_path / names["elsewhere, days ago"], (0, 0))
    os.utime(tmp_path / names["something else"], (0, 0))
    Store(tmp_path).put(TASK, Outcome((ROW,)))
    alive.communicate(b"\n")
    left = {what for what, name in names.items() if (tmp_path / name).exists()}
    assert left == {"alive", "elsewhere", "something else"}


def test_a_file_stays_readable_while_it_is_replaced_and_locks_nothing(tmp_path):
    """Two hold it open in the manner of HDF5, a third replaces it."""
    store = Store(tmp_path)
    store.put(TASK, Outcome((ROW,)))
    (path,) = tmp_path.glob("*.nc")
    with h5py.File(path) as one, h5py.File(path) as two:
        store.put(TASK, Outcome((replace(ROW, depth=2.0),)))
        assert one["depth"][0] == two["depth"][0] == ROW.depth
        assert store.get(TASK).rows[0].depth == 2.0


def test_the_name_changes_with_everything_that_the_answer_depends_on():
    prony = Prony(equilibrium_modulus=1e6, moduli=(1e6,), relaxation_times=(1e-3,))
    rough = SCENE.roughness
    others = [
        replace(TASK, scenes=(replace(SCENE, indenter=Sphere(radius=1.0000000000000002e-2)),)),
        replace(TASK, scenes=(replace(SCENE, elastomer=prony),)),
        replace(TASK, scenes=(replace(SCENE, motion=Slide(speed=0.1, depth=1.0)),)),
        replace(TASK, scenes=(replace(SCENE, motion=Indent(load=1.0)),)),
        replace(TASK, scenes=(replace(SCENE, roughness=None),)),
        replace(TASK, scenes=(replace(SCENE, roughness=replace(rough, seed=4)),)),
        replace(TASK, scenes=(SCENE, SCENE)),
        replace(TASK, solver=MDR(points=101)),
        replace(TASK, solver=MDR(points=100, extent=1e-2)),
        replace(TASK, solver=Exact()),
    ]
    assert len({key(task) for task in [TASK, *others]}) == 1 + len(others)
    assert key(replace(TASK, work=7.0)) == key(Task(MDR(points=100), (replace(SCENE),)))


def test_the_question_and_the_code_name_a_file_apart(monkeypatch):
    before = key(TASK)
    monkeypatch.setattr(module, "_code_digest", lambda _: "other")
    assert key(TASK) == f"{before.partition('-')[0]}-other"


@given(value=st.recursive(FLOATS | st.integers() | st.text() | st.booleans() | st.none(), st.lists))
@examples(50)
def test_canonical_text_is_json_and_tells_apart_what_differs(value):
    """Read back it is the same value; tuples and lists are one, and so are all ways to sort a table."""
    text = canonical({"b": value, "a": 1})
    assert text.isascii()
    assert "NaN" not in json.dumps(json.loads(text, parse_constant=pytest.fail))
    assert canonical({"a": 1, "b": value}) == text
    assert canonical([value, -0.0]) != canonical([value, 0.0])


def test_the_digest_of_code_changes_with_content_and_name(tmp_path):
    (tmp_path / "a.py").write_text("x = 1\n")
    first = code_digest(tmp_path)
    (tmp_path / "notes.txt").write_text("no code")
    assert code_digest(tmp_path) == first
    (tmp_path / "a.py").write_text("x = 2\n")
    second = code_digest(tmp_path)
    (tmp_path / "a.py").rename(tmp_path / "b.py")
    assert len({first, second, code_digest(tmp_path)}) == 3
