"""What is stored comes back as it was, under a name that changes with everything the answer depends on."""

import errno
import io
import json
import multiprocessing
import os
import re
import signal
import subprocess
import sys
import time
import zipfile
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays
from strategies import examples

from compare.models.exact import Exact
from compare.solving import store as module
from compare.solving.hold import LOCK, hold
from compare.solving.outcome import NUMBERS, Outcome, Row
from compare.solving.store import FILE, Store, canonical, key, write
from compare.solving.task import SceneTask as Task
from mdr1d import MDR
from scene import Kelvin, Scene, SelfAffine, Slide, Sphere
from scene.vocabulary import MEASURES

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


def told(row):
    """All of a row to the last bit but the payload of NaN, -0.0 apart from 0.0."""
    return repr(replace(row, measures=sorted(row.measures.items()), settings=sorted(row.settings.items())))


def same(first, second):
    """Whether two outcomes are the same, bit for bit."""
    return (
        list(map(told, first.rows)) == list(map(told, second.rows))
        and first.fields.keys() == second.fields.keys()
        and all(same_array(first.fields[name], second.fields[name]) for name in first.fields)
    )


def same_array(first, second):
    first, second = np.asarray(first), np.asarray(second)
    return (first.dtype, first.shape, first.tobytes()) == (second.dtype, second.shape, second.tobytes())


FLOATS = st.floats(width=64)  # NaN with any payload that NumPy keeps, infinities, subnormals, both zeros
NAMES = st.sampled_from(sorted(MEASURES)) | st.text("abcxyz_2µ", min_size=1, max_size=12)
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


@examples(30)
@given(rows=st.lists(ROWS, min_size=1, max_size=4), fields=FIELDS)
def test_whatever_an_outcome_holds_comes_back_bit_for_bit(tmp_path_factory, rows, fields):
    task, store = replace(drawn(len(rows)), keeps_fields=True), Store(tmp_path_factory.mktemp("store"))
    outcome = Outcome(tuple(rows), fields)
    store.put(task, outcome)
    assert same(store.get(task), outcome)


def test_fields_come_back_and_are_missed_where_they_are_wanted(tmp_path):
    store = Store(tmp_path)
    store.put(TASK, Outcome((ROW,)))
    assert store.get(TASK) is not None
    assert store.get(PICTURE) is None
    store.put(PICTURE, Outcome((ROW,), {"x": np.arange(3.0)}))
    assert np.array_equal(store.get(PICTURE).fields["x"], np.arange(3.0))
    assert store.get(TASK).fields == {}
    store.put(PICTURE, Outcome((ROW,)))
    assert store.get(PICTURE).fields == {}


def test_what_no_file_can_hold_is_refused_and_leaves_nothing(tmp_path):
    store = Store(tmp_path)
    with pytest.raises(TypeError, match="x is of type complex128"):
        store.put(PICTURE, Outcome((ROW,), {"x": np.ones(3, complex)}))
    assert list(tmp_path.iterdir()) == []


def three(folder):
    """A store of three tasks, and what its file holds."""
    store = Store(folder)
    tasks = [replace(TASK, solver=MDR(points=100 + k)) for k in range(3)]
    for k, task in enumerate(tasks):
        store.put(task, Outcome((replace(ROW, depth=float(k)),)))
    return tasks, store.path, store.path.read_bytes()


def found(folder, tasks):
    """Which of the tasks a fresh look finds, each with its own answer."""
    store = Store(folder)
    outcomes = [store.get(task) for task in tasks]
    assert all(outcome.rows[0].depth == k for k, outcome in enumerate(outcomes) if outcome is not None)
    return [k for k, outcome in enumerate(outcomes) if outcome is not None]


def test_damage_costs_the_outcome_that_it_hits_whichever_bit_it_is(tmp_path):
    tasks, path, whole = three(tmp_path)
    places = np.random.default_rng(0).integers(len(whole), size=200)
    for place, bit in zip(places, 1 << np.arange(200) % 8, strict=True):
        path.write_bytes(whole[:place] + bytes([whole[place] ^ int(bit)]) + whole[place + 1 :])
        hit = whole[:place].count(b"\n\n")
        assert set(found(tmp_path, tasks)) >= {0, 1, 2} - {hit, hit + (whole[place : place + 1] == b"\n")}
        assert len(found(tmp_path, tasks)) >= 2
    path.write_bytes(whole)
    assert found(tmp_path, tasks) == [0, 1, 2]


@pytest.mark.parametrize("cut", [1, 2, 3, 40, 300])
def test_what_a_kill_left_half_written_is_cut_off_and_costs_nothing_else(tmp_path, cut):
    tasks, path, whole = three(tmp_path)
    path.write_bytes(whole[:-cut])
    kept = found(tmp_path, tasks)
    assert kept == ([0, 1, 2] if cut == 1 else [0, 1])  # a line ends twice
    Store(tmp_path).put(tasks[2], Outcome((replace(ROW, depth=2.0),)))
    assert found(tmp_path, tasks) == [0, 1, 2]
    assert len(Store(tmp_path)) == 3
    assert path.read_bytes().endswith(b"\n\n")


def test_fields_that_are_damaged_count_as_absent(tmp_path):
    store = Store(tmp_path)
    store.put(PICTURE, Outcome((ROW,), {"x": np.arange(300.0)}))
    (path,) = tmp_path.glob("*.npz")
    whole = path.read_bytes()
    for place in range(0, len(whole), 50):
        path.write_bytes(whole[:place] + bytes([whole[place] ^ 4]) + whole[place + 1 :])
        assert store.get(PICTURE) is None
    path.unlink()
    assert store.get(PICTURE) is None
    assert store.get(TASK) is not None


def archive(compression, **members):
    """The bytes of an archive of numpy, packed as anyone can."""
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", compression) as file:
        for name, values in members.items():
            with file.open(name, "w") as member:
                np.lib.format.write_array(member, values)
    return packed.getvalue()


ZEROS, OBJECTS = np.zeros(10**6), np.array([print], object)
FORGED_FIELDS = {
    "unpacks to more": archive(zipfile.ZIP_DEFLATED, **{"0.npy": ZEROS}),
    "pickled": archive(zipfile.ZIP_STORED, **{"0.npy": OBJECTS}),
}


@pytest.mark.parametrize("kind", FORGED_FIELDS)
def test_fields_that_are_forged_under_a_digest_that_fits_count_as_absent(tmp_path, monkeypatch, kind):
    with monkeypatch.context() as forging:
        forging.setattr(module, "_packed", lambda _: FORGED_FIELDS[kind])
        Store(tmp_path).put(PICTURE, Outcome((ROW,), {"x": np.arange(3.0)}))
    assert Store(tmp_path).get(TASK) is not None
    assert Store(tmp_path).get(PICTURE) is None


FORGED_LINES = [{"rows": 10**9}, {"numbers": "AA=="}, {"absent": None}]


@pytest.mark.parametrize("change", [*FORGED_LINES, b"[" * 10**5, b"[]"], ids=str)
def test_a_line_that_is_forged_under_a_digest_that_fits_counts_as_absent(tmp_path, change):
    store = Store(tmp_path)
    store.put(PICTURE, Outcome((ROW,), {"x": np.arange(3.0)}))
    name, text = key(PICTURE), store.path.read_bytes().strip()[module.HEAD + 1 :]
    forged = change if isinstance(change, bytes) else json.dumps(json.loads(text) | change).encode()
    store.path.write_bytes(module._line(name, forged) + b"\n\n")
    assert Store(tmp_path).get(PICTURE) is None


def device(path):
    path.symlink_to("/dev/zero")


@pytest.mark.skipif(os.name != "posix", reason="pipes and links")
@pytest.mark.parametrize("placed", [os.mkdir, device])
def test_what_stands_in_the_place_of_the_file_holds_nothing_and_is_named_before_it_is_written(tmp_path, placed):
    path = tmp_path / FILE
    placed(path)
    assert Store(tmp_path).get(TASK) is None
    with pytest.raises(OSError, match=re.escape(str(path))):
        Store(tmp_path).put(TASK, Outcome((ROW,)))


def test_a_folder_that_nobody_may_write_can_be_read(tmp_path):
    tasks, path, _ = three(tmp_path)
    path.chmod(0o444)
    tmp_path.chmod(0o555)
    try:
        assert found(tmp_path, tasks) == [0, 1, 2]
        if os.getuid():
            with pytest.raises(PermissionError) as caught:
                Store(tmp_path).put(TASK, Outcome((ROW,)))
            assert caught.value.filename == str(path)
    finally:
        tmp_path.chmod(0o755)


def test_a_folder_that_cannot_be_locked_is_said_and_used(tmp_path, monkeypatch):
    fcntl = pytest.importorskip("fcntl")

    def no_locks(*_):
        raise OSError(errno.ENOLCK, "No locks available")

    monkeypatch.setattr(fcntl, "flock", no_locks)
    said = []
    with hold([tmp_path, tmp_path / "below"], said.append):
        assert os.listdir(tmp_path / "below") == [LOCK]
    assert said == [
        "this folder cannot be locked (No locks available), as on some network drives: run one at a time"
    ]


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
def test_a_full_disk_is_an_error_that_names_the_file_and_what_is_stored_stays(tmp_path):
    store, tasks = Store(tmp_path), [replace(TASK, solver=MDR(points=100 + k)) for k in range(40)]

    def fill():
        for task in tasks:
            store.put(task, Outcome((ROW,)))

    with pytest.raises(OSError, match=r"File too large|No space left") as caught:
        fill()
    assert caught.value.filename == str(store.path)
    stored = [task for task in tasks if Store(tmp_path).get(task) is not None]
    assert stored == tasks[: len(stored)]
    assert stored
    assert store.path.read_bytes().endswith(b"\n\n")
    with pytest.raises(OSError, match="File too large") as caught:
        store.put(PICTURE, Outcome((ROW,), {"x": np.arange(3000.0)}))
    assert caught.value.filename.endswith(".npz")
    assert [path.name for path in tmp_path.iterdir()] == [FILE]


def test_other_code_does_not_answer(tmp_path, monkeypatch):
    store = Store(tmp_path)
    monkeypatch.setattr(module, "_code_digest", lambda _: "0" * 32)
    store.put(TASK, Outcome((ROW,)))
    monkeypatch.undo()
    assert store.get(TASK) is None
    assert store.by_other_code([TASK, drawn(2)]) == 1
    store.put(TASK, Outcome((ROW,)))
    assert (store.by_other_code([TASK]), len(store)) == (0, 2)


FORKS = pytest.mark.filterwarnings("ignore:This process:DeprecationWarning")


def writer(folder, times):
    """A process that writes one task again and again: a copy of this one, with the code that this one has."""
    process = multiprocessing.get_context("fork").Process(target=_write, args=(folder, times))
    process.start()
    return process


def _write(folder, times):
    replaced = os.replace  # half of its time there is a file that is written and has no name yet
    os.replace = lambda *paths: time.sleep(0.01) or replaced(*paths)
    module._cleared.cache_clear()
    for k in range(times):
        Store(folder).put(PICTURE, Outcome((replace(ROW, depth=float(k)),), {"x": np.full(20000, float(k))}))


@FORKS
def test_a_process_writes_one_task_while_others_read_it(tmp_path):
    store, process, read = Store(tmp_path), writer(tmp_path, 30), 0
    while process.is_alive():
        outcome = store.get(PICTURE)  # None between the fields of one write and their line
        read += outcome is not None
        assert outcome is None or (outcome.fields["x"] == outcome.rows[0].depth).all()
    assert process.exitcode == 0
    assert store.get(PICTURE).rows[0].depth == 29.0
    assert read > 3
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted([f"{key(PICTURE)}.npz", FILE])


@FORKS
@pytest.mark.parametrize("times", [5, pytest.param(50, marks=pytest.mark.slow)])
def test_a_writer_killed_at_any_moment_leaves_whole_lines_and_nothing_else(tmp_path, times):
    moments, halves = np.random.default_rng(times), 0
    for _ in range(times):
        process = writer(tmp_path, 10**6)
        time.sleep(moments.uniform(0.0, 0.1))
        process.kill()
        process.join()
        outcome = Store(tmp_path).get(PICTURE)
        assert outcome is None or (outcome.fields["x"] == outcome.rows[0].depth).all()
        left = [path for path in tmp_path.iterdir() if path.name not in (f"{key(PICTURE)}.npz", FILE)]
        assert len(left) <= 1  # each writer clears what the one before it left
        halves += len(left)
    process = writer(tmp_path, 1)
    process.join()
    assert process.exitcode == 0
    assert Store(tmp_path).get(PICTURE).rows[0].depth == 0.0
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted([f"{key(PICTURE)}.npz", FILE])
    assert halves


def test_of_temporary_files_only_those_that_are_ours_and_left_behind_are_cleared(tmp_path, monkeypatch):
    ended = subprocess.Popen([sys.executable, "-c", ""])
    ended.wait()
    here, there, now, letters = module._here(), "0" * 8, int(time.time()), "0123456789abcdef"
    kept = [
        f".crosscheck-{here}-{os.getppid()}-{now}-{letters}",
        f".crosscheck-{there}-{ended.pid}-{now - 6 * 86400}-{letters}",  # of another machine or container
        f".crosscheck-{here}-{ended.pid}-{now}-{letters}.csv",
        f".page.html.{ended.pid}.abcdefgh",
    ]
    left = [
        f".crosscheck-{here}-{ended.pid}-{now}-{letters}",
        f".crosscheck-{here}-{'9' * 10}-{now}-{letters}",  # no number of a process
        f".crosscheck-{there}-{os.getppid()}-{now - 8 * 86400}-{letters}",
    ]
    for name in (*kept, *left):
        (tmp_path / name).touch()
    write(tmp_path / "numbers.csv", lambda file: file.write(b"1"))
    assert sorted(os.listdir(tmp_path)) == sorted([*kept, "numbers.csv"])
    monkeypatch.setattr(module.platform, "node", lambda: "elsewhere")
    assert module._here.__wrapped__() != here


@pytest.mark.skipif(os.name != "posix", reason="permissions")
@pytest.mark.parametrize("mask", [0o077, 0o022, 0o002], ids=oct)
def test_files_and_folders_have_the_permissions_of_the_user_s_others(tmp_path, mask):
    before = os.umask(mask)
    try:
        module.make(tmp_path / "page")
        write(tmp_path / "page" / "results.nc", lambda file: file.write(b"1"))
        with hold([tmp_path / "page"], str):
            Store(tmp_path / "page" / "solved").put(PICTURE, Outcome((ROW,), {"x": np.arange(3.0)}))
    finally:
        os.umask(before)
    modes = {path.name: path.stat().st_mode & 0o777 for path in (tmp_path / "page").rglob("*")}
    assert modes.pop("solved") == 0o777 & ~mask == (tmp_path / "page").stat().st_mode & 0o777
    assert modes == dict.fromkeys(["results.nc", LOCK, FILE, f"{key(PICTURE)}.npz"], 0o666 & ~mask)


def test_the_name_changes_with_everything_that_the_answer_depends_on():
    rough = SCENE.roughness
    others = [
        replace(TASK, scenes=(replace(SCENE, indenter=Sphere(radius=1.0000000000000002e-2)),)),
        replace(TASK, scenes=(replace(SCENE, motion=Slide(speed=0.1, depth=1.0)),)),
        replace(TASK, scenes=(replace(SCENE, roughness=replace(rough, seed=4)),)),
        replace(TASK, scenes=(SCENE, SCENE)),
        replace(TASK, solver=MDR(points=101)),
        replace(TASK, solver=Exact()),
    ]
    assert len({key(task) for task in [TASK, *others]}) == 1 + len(others)
    assert key(replace(TASK, work=7.0)) == key(Task(MDR(points=100), (replace(SCENE),)))


@given(value=st.recursive(FLOATS | st.integers() | st.text() | st.booleans() | st.none(), st.lists))
@examples(50)
def test_canonical_text_is_json_and_tells_apart_what_differs(value):
    """Read back it is the same value; tuples and lists are one, and so are all ways to sort a table."""
    text = canonical({"b": value, "a": 1})
    assert text.isascii()
    assert "NaN" not in json.dumps(json.loads(text, parse_constant=pytest.fail))
    assert canonical({"a": 1, "b": value}) == text
    assert canonical([value, -0.0]) != canonical([value, 0.0])
