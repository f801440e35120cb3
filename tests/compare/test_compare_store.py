"""What is stored comes back as it was, under a name that changes with everything the answer depends on."""

import io
import json
import multiprocessing
import os
import re
import signal
import sqlite3
import tempfile
import time
import zlib
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays
from small_cases import SLIDING
from stand_in_solver import every_bit
from strategies import examples

from compare.models.exact import Exact
from compare.solving import folders
from compare.solving.digest import canonical, key
from compare.solving.folders import LOCK, lock, make, write
from compare.solving.store import FILE, Store
from compare.solving.task import NUMBERS, Outcome, Row
from compare.solving.task import SceneTask as Task
from mdr1d import MDR
from scene import Slide, Sphere
from scene.files.reading import InvalidInput
from scene.vocabulary import MEASURES

TASK = Task(MDR(points=100), (SLIDING,))
PICTURE = replace(TASK, keeps_fields=True)
ROW = Row(1.0, 1e-4, 0.1, 1e-9, 12.0, 0.5, {"pixel": 1e-6, "odd": np.nan}, {"points": 100, "cutoff": None})


def drawn(count):
    """A task of `count` scenes."""
    return replace(TASK, scenes=(SLIDING,) * count)


FIELD = {"x": np.arange(3.0)}


def keep(store, fields=FIELD):
    """Store a row with fields."""
    store.put(PICTURE, Outcome((ROW,), fields))


def bits(outcome):
    """All of an outcome, bit for bit."""
    fields = {name: np.asarray(each) for name, each in outcome.fields.items()}
    arrays = {name: (each.dtype, each.shape, each.tobytes()) for name, each in fields.items()}
    return list(map(every_bit, outcome.rows)), arrays


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
    assert bits(store.get(task)) == bits(outcome)


def test_fields_come_back_and_are_missed_where_they_are_wanted(tmp_path):
    store = Store(tmp_path)
    store.put(TASK, Outcome((ROW,)))
    assert store.get(TASK) is not None
    assert store.get(PICTURE) is None
    keep(store)
    assert np.array_equal(store.get(PICTURE).fields["x"], np.arange(3.0))
    assert store.get(TASK).fields == {}
    keep(store, {})
    assert store.get(PICTURE).fields == {}


def test_what_no_file_can_hold_is_refused_and_leaves_nothing(tmp_path):
    store = Store(tmp_path)
    with pytest.raises(TypeError, match="x is of type complex128"):
        keep(store, {"x": np.ones(3, complex)})
    with pytest.raises(ValueError, match=r"the fields take 8e\+09 bytes, and at most"):
        keep(store, {"x": np.broadcast_to(1.0, 10**9)})
    assert list(tmp_path.iterdir()) == []


def three(folder):
    """A store of three tasks with fields, and what its file holds."""
    store = Store(folder)
    tasks = [replace(PICTURE, solver=MDR(points=100 + k)) for k in range(3)]
    for k, task in enumerate(tasks):
        store.put(task, numbered(k))
    return tasks, store.path, store.path.read_bytes()


def numbered(k):
    return Outcome((replace(ROW, depth=float(k)),), {"x": np.full(100, float(k))})


def found(folder, tasks):
    """Which of the tasks a fresh look finds, each with its own answer."""
    store = Store(folder)
    outcomes = [store.get(task) for task in tasks]
    assert all(bits(outcome) == bits(numbered(k)) for k, outcome in enumerate(outcomes) if outcome is not None)
    return [k for k, outcome in enumerate(outcomes) if outcome is not None]


def test_damage_costs_the_outcome_that_it_hits_and_a_file_that_cannot_be_read_is_left_as_it_is(tmp_path):
    tasks, path, whole = three(tmp_path)
    used = np.flatnonzero(np.frombuffer(whole, np.uint8))
    places, costs = np.random.default_rng(0).choice(used, size=100), []
    for place, bit in zip(places, 1 << np.arange(100) % 8, strict=True):
        damaged = whole[:place] + bytes([whole[place] ^ int(bit)]) + whole[place + 1 :]
        path.write_bytes(damaged)
        message = ""
        try:
            kept = found(tmp_path, tasks)
            for lost in {0, 1, 2} - {*kept}:
                Store(tmp_path).put(tasks[lost], numbered(lost))
        except InvalidInput as error:
            message, kept = str(error), []
        refused = message.startswith(f"{path}: is ") and path.read_bytes() == damaged
        assert refused or found(tmp_path, tasks) == [0, 1, 2], place
        costs.append(3 - len(kept))
    assert np.bincount(costs, minlength=4)[:2].sum() > 75  # the others are in the tables of so small a file


OBJECTS = io.BytesIO()
np.savez(OBJECTS, x=np.array([print], object))
FORGED = {
    "rows": [b"", b"[]", *(zlib.compress(each) for each in (b"[]", b"{}", b'[{"depth": "deep"}]', b"[" * 10**5))],
    "fields": [None, b"", b"x", OBJECTS.getvalue()],
}


@pytest.mark.parametrize(("column", "value"), [(name, each) for name, every in FORGED.items() for each in every])
def test_an_answer_that_holds_something_else_counts_as_absent(tmp_path, column, value):
    store = Store(tmp_path)
    keep(store)
    with closing(sqlite3.connect(store.path)) as connection, connection:
        connection.execute(f"UPDATE answers SET {column} = ?", (value,))
    assert store.get(PICTURE) is None
    assert (store.get(TASK) is None) == (column == "rows")


def text(path):
    path.write_text("some notes of mine")


def other(path):
    with closing(sqlite3.connect(path)) as connection:
        connection.execute("CREATE TABLE answers (key)")


def device(path):
    path.symlink_to("/dev/zero")


def circle(path):
    path.symlink_to(path)


def sparse(path):
    """A file that is too large, of nothing."""
    path.touch()
    os.truncate(path, 10**12)


PLACED = [text, other, getattr(os, "mkfifo", os.mkdir), os.mkdir, device, circle, sparse]


@pytest.mark.skipif(os.name != "posix", reason="pipes and links")
@pytest.mark.parametrize("placed", PLACED)
def test_a_file_of_something_else_is_refused_by_name_and_left_as_it_is(tmp_path, placed):
    path = tmp_path / FILE
    placed(path)
    before = path.lstat()
    for use in (lambda: Store(tmp_path).get(TASK), lambda: Store(tmp_path).put(TASK, Outcome((ROW,)))):
        with pytest.raises(InvalidInput, match=re.escape(str(path))):
            use()
    assert (path.lstat().st_mtime_ns, path.lstat().st_size) == (before.st_mtime_ns, before.st_size)
    assert os.listdir(tmp_path) == [FILE]


@pytest.fixture
def unprivileged():
    """A folder of root's that another user reads, who may write nothing."""
    folder = Path(tempfile.mkdtemp())
    folder.chmod(0o755)
    yield folder
    os.seteuid(0)
    for path in folder.iterdir():
        path.unlink()
    folder.rmdir()


@pytest.mark.skipif(os.name != "posix" or os.getuid() != 0, reason="another user")
def test_a_folder_that_nobody_may_write_can_be_read(unprivileged):
    tasks, _, _ = three(unprivileged)
    os.seteuid(65534)
    assert bits(Store(unprivileged).get(tasks[2])) == bits(numbered(2))
    with pytest.raises(PermissionError) as caught:
        Store(unprivileged).put(TASK, Outcome((ROW,)))
    assert caught.value.filename == str(unprivileged)


def test_a_folder_that_cannot_be_locked_is_said_and_used(tmp_path, monkeypatch):
    """A drive without locks refuses them for every file, unless SQLite is asked to take none."""

    class Lockless(sqlite3.Connection):
        def execute(self, asked, *given):
            if not self.unlocked and asked.startswith(("BEGIN EX", "SELECT", "PRAGMA journal")):
                error = sqlite3.OperationalError("database is locked")
                error.sqlite_errorcode = sqlite3.SQLITE_BUSY
                raise error
            return super().execute(asked, *given)

    def connect(address, **options):
        connection = Lockless(address, **options)
        connection.unlocked = "unix-none" in str(address)
        return connection

    monkeypatch.setattr(folders.sqlite3, "connect", connect)
    lines = []
    with lock([tmp_path], lines.append):
        assert os.listdir(tmp_path) == [LOCK]
        tasks, *_ = three(tmp_path)
        assert found(tmp_path, tasks) == [0, 1, 2]
    assert lines == ["this folder cannot be locked, as on some network drives: run one at a time"]


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
    """No file may be longer than 64 kB, as on a disk that fills up while one is written."""
    resource = pytest.importorskip("resource")
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (65536, before[1]))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, before)
    signal.signal(signal.SIGXFSZ, handler)


@pytest.mark.usefixtures("little_room")
def test_a_full_disk_is_an_error_that_names_the_file_and_what_is_stored_stays(tmp_path):
    store, tasks = Store(tmp_path), [replace(TASK, solver=MDR(points=100 + k)) for k in range(400)]

    def fill():
        with store.writing():
            for task in tasks:
                store.put(task, Outcome((ROW,)))

    with pytest.raises(OSError, match=r"disk I/O error|No space left") as caught:
        fill()
    assert caught.value.filename == str(store.path)
    stored = [*Store(tmp_path).stored(tasks)]
    assert stored == tasks[: len(stored)] != []
    with pytest.raises(OSError, match="disk I/O error"):
        keep(store, {"x": np.arange(30000.0)})
    assert [*Store(tmp_path).stored(tasks)] == stored


def writer(folder, times):
    """A process that writes one task again and again: a copy of this one, with the code that this one has."""
    process = multiprocessing.get_context("fork").Process(target=_write, args=(folder, times))
    process.start()
    return process


def _write(folder, times):
    store = Store(folder)
    for start in range(0, times, 20):
        with store.writing():
            for k in range(start, start + min(times, 20)):
                store.put(PICTURE, Outcome((replace(ROW, depth=float(k)),), {"x": np.full(20000, float(k))}))


@pytest.mark.filterwarnings("ignore:This process:DeprecationWarning")
def test_a_writer_killed_at_any_moment_leaves_whole_answers_and_nothing_else(tmp_path):
    last, halves = -1.0, 0
    for moment in np.random.default_rng(5).uniform(0.0, 0.3, 8):
        process = writer(tmp_path, 10**6)
        time.sleep(moment)
        process.kill()
        process.join()
        halves += (tmp_path / f"{FILE}-wal").exists()
        outcome = Store(tmp_path).get(PICTURE)
        assert outcome is None or (outcome.fields["x"] == outcome.rows[0].depth).all()
        assert outcome is not None or last == -1.0
        last = -1.0 if outcome is None else outcome.rows[0].depth
    process = writer(tmp_path, 1)
    process.join()
    assert process.exitcode == 0
    assert Store(tmp_path).get(PICTURE).rows[0].depth == 0.0
    assert os.listdir(tmp_path) == [FILE]
    assert halves


@pytest.mark.skipif(os.name != "posix", reason="permissions")
@pytest.mark.parametrize("mask", [0o077, 0o022, 0o002], ids=oct)
def test_files_and_folders_have_the_permissions_of_the_user_s_others(tmp_path, mask):
    before, page = os.umask(mask), tmp_path / "page"
    try:
        make(page)
        write(page / "results.nc", lambda file: file.write(b"1"))
        with lock([page], str):
            Store(page / "solved").put(PICTURE, numbered(0))
    finally:
        os.umask(before)
    modes = {path.name: path.stat().st_mode & 0o777 for path in (page, *page.rglob("*"))}
    files = dict.fromkeys(["results.nc", LOCK, FILE], 0o666 & ~mask)
    assert modes == dict.fromkeys(["page", "solved"], 0o777 & ~mask) | files


def test_the_name_changes_with_everything_that_the_answer_depends_on():
    others = [
        replace(TASK, scenes=(replace(SLIDING, indenter=Sphere(radius=1.0000000000000002e-2)),)),
        replace(TASK, scenes=(replace(SLIDING, motion=Slide(speed=0.1, depth=1.0)),)),
        drawn(2),
        replace(TASK, solver=MDR(points=101)),
        replace(TASK, solver=Exact()),
    ]
    assert len({key(task) for task in [TASK, *others]}) == 1 + len(others)
    assert key(replace(TASK, work=7.0)) == key(Task(MDR(points=100), (replace(SLIDING),)))


@given(value=st.recursive(FLOATS | st.integers() | st.text() | st.booleans() | st.none(), st.lists))
@examples(50)
def test_canonical_text_is_json_that_tells_apart_what_differs(value):
    """Tuples and lists are one, and so are all ways to sort a table."""
    text = canonical({"b": value, "a": 1})
    assert text.isascii()
    assert canonical(json.loads(text)) == text
    assert canonical({"a": 1, "b": value}) == text
    assert canonical([value, -0.0]) != canonical([value, 0.0])
