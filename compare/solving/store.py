"""Store: what has been solved, in one file of SQLite, named by everything that an answer depends on."""

import errno
import io
import json
import os
import sqlite3
from collections.abc import Container, Iterable, Iterator
from contextlib import ExitStack, closing, contextmanager, suppress
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import TypeAdapter

from scene import files
from scene.printable import brief
from scene.reading import InvalidInput

from .digest import DIGEST, digest, key
from .folders import clear, code_of, connect, held_by_another, make, touch, write
from .outcome import Outcome, Row
from .task import Task

FILE = "answers.sqlite"
TRACE = ".fault.txt"  # of how a task broke, behind its key
HEAD = b"SQLite format 3\0"
OURS = 0x6D647262  # the application that a file of SQLite states at byte 68
MOST_BYTES, MOST_FIELD = 2**36, 10**9  # of the file, of one field
KINDS = "iufb"  # of the numbers of fields
ROWS = TypeAdapter(tuple[Row, ...])
# An answer has the digest of its key and content, which has the places and digests of its fields. All is read in
# the order in which it was added: a damaged key misleads no search.
TABLES = (
    b"CREATE TABLE answers (id INTEGER PRIMARY KEY, key TEXT, content TEXT, digest TEXT)",
    b"CREATE TABLE fields (id INTEGER PRIMARY KEY, content BLOB)",
)
DAMAGED = (0, sqlite3.SQLITE_ERROR, sqlite3.SQLITE_CORRUPT, sqlite3.SQLITE_NOTADB)
ERRORS = {sqlite3.SQLITE_FULL: errno.ENOSPC, sqlite3.SQLITE_READONLY: errno.EACCES}


class Store:
    """A folder with a file of outcomes, which one process at a time opens.

    An outcome that is damaged counts as absent and touches no other. A kill costs at most the outcome that was
    being written. A file that is no such store is refused and left as it is.
    """

    def __init__(self, folder: Path):
        self.folder = folder
        self.path = folder / FILE
        self._open: sqlite3.Connection | None = None

    def get(self, task: Task) -> Outcome | None:
        """The stored outcome of a task, see `stored`; None where there is none."""
        return self.stored([task]).get(task)

    def stored(self, tasks: Iterable[Task]) -> dict[Task, Outcome]:
        """The stored outcomes by this code, by task; without those that lack the fields which a task keeps.

        Raises InvalidInput of a file that another run writes or that is no store, OSError.
        """
        with self._reading() as connection:
            keys = {task: key(task) for task in tasks}
            whole = _whole(connection, {*keys.values()})
            found = {task: _outcome(task, whole.get(name), connection) for task, name in keys.items()}
        return {task: outcome for task, outcome in found.items() if outcome is not None}

    def put(self, task: Task, outcome: Outcome) -> None:
        """Add an outcome, which then stands for any before it.

        Raises OSError, which names the file; TypeError, ValueError for what no file can hold.
        """
        fields = {name: _packed(name, values) for name, values in outcome.fields.items()}
        rows = [vars(row) | {"measures": {**row.measures}, "settings": {**row.settings}} for row in outcome.rows]
        content: dict[str, Any] = {"label": task.label, "rows": rows}
        with self.writing(), self._named(), self._open:
            self._open.execute("BEGIN")
            if task.keeps_fields:
                insert = "INSERT INTO fields (content) VALUES (?)"
                content["fields"] = [
                    (self._open.execute(insert, (packed,)).lastrowid, digest(packed), name)
                    for name, packed in fields.items()
                ]
            name, text = key(task).encode(), json.dumps(content).encode()
            row = name, text, _covering(name, text)
            self._open.execute("INSERT INTO answers (key, content, digest) VALUES (?, ?, ?)", row)

    def __len__(self) -> int:
        """Number of outcomes, whatever code they are of."""
        return len(self._keys())

    def by_other_code(self, tasks: Iterable[Task]) -> int:
        """Number of the tasks whose question other code has answered, and this code has not."""
        keys = self._keys()
        questions = {name[:DIGEST] for name in keys}
        return sum((name := key(task)) not in keys and name[:DIGEST] in questions for task in tasks)

    def trace(self, task: Task) -> Path:
        """File with the traceback of a task that broke."""
        return self.folder / f"{key(task)}{TRACE}"

    @contextmanager
    def writing(self) -> Iterator[None]:
        """The file, open for this process alone; what a killed run left half written is cleared.

        Raises InvalidInput as `stored`; OSError, which names the file.
        """
        if self._open is not None:
            yield
            return
        make(self.folder)
        with self._named():
            self._there()
            touch(self.path)
            self._open = self._connected()
        try:
            clear(self.folder)
            yield
        finally:
            with suppress(sqlite3.Error):  # of a full disk: what the other file has is read the next time
                self._open.execute("PRAGMA journal_mode = DELETE")
            self._open.close()
            self._open = None

    def _connected(self) -> sqlite3.Connection:
        """Connection that nobody else has; where the file is damaged, to a copy of what can be read."""
        connection = connect(self.path, "rw")
        try:
            connection.execute("PRAGMA locking_mode = EXCLUSIVE")  # else WAL needs memory that drives do not share
            connection.execute("PRAGMA journal_mode = DELETE")
            if not _has_tables(connection):
                _make_tables(connection)
            whole = connection.execute("PRAGMA quick_check(1)").fetchone() == (b"ok",)
            if whole:
                connection.execute("PRAGMA journal_mode = WAL")
                connection.execute("PRAGMA synchronous = NORMAL")
                return connection
            write(self.path, lambda file: _copy(connection, file.name))
        except BaseException:
            connection.close()
            raise
        return self._connected()

    @contextmanager
    def _reading(self) -> Iterator[sqlite3.Connection | None]:
        """Connection for reading, None where there is no file yet."""
        if self._open is not None or not self._there():
            yield self._open
            return
        with self._named(), ExitStack() as opened:
            try:
                connection = opened.enter_context(closing(connect(self.path, "rw")))
                connection.execute("PRAGMA locking_mode = EXCLUSIVE")
                there = _has_tables(connection)
            except sqlite3.OperationalError as error:
                if code_of(error) == sqlite3.SQLITE_BUSY:
                    raise
                # Nobody may write the folder, in which a killed run has left the second file.
                connection = opened.enter_context(closing(connect(self.path, "ro&immutable=1")))
                there = _has_tables(connection)
            yield connection if there else None

    def _keys(self) -> set[str]:
        with self._reading() as connection:
            return {*_whole(connection, ())}

    def _there(self) -> bool:
        """Whether there is a file that is not empty. Raises InvalidInput of one that is no store."""
        if not os.path.lexists(self.path):
            return False
        try:
            with files.checked(self.path, MOST_BYTES).open("rb") as file:
                head = file.read(72)
        except files.Unreadable as error:
            raise InvalidInput(str(error)) from error
        if head and not (head.startswith(HEAD) and head[68:] == OURS.to_bytes(4, "big")):
            raise self._refused("is no file of solved contacts")
        return bool(head)

    def _refused(self, why: str) -> InvalidInput:
        return InvalidInput(f"{brief(str(self.path))}: {why}: move it away, or name another folder")

    @contextmanager
    def _named(self):
        """Errors of SQLite as those of the system, which name the file, and as refusals."""
        try:
            yield
        except (sqlite3.Error, UnicodeDecodeError) as error:
            code = code_of(error)
            if code == sqlite3.SQLITE_BUSY:
                raise held_by_another(self.folder) from error
            if code in DAMAGED:
                raise self._refused("is damaged so that nothing can be read") from error
            number = ERRORS.get(code, errno.EIO)
            reason = os.strerror(number) if code in ERRORS else str(error)
            raise OSError(number, reason, str(self.path)) from error


def _has_tables(connection: sqlite3.Connection) -> bool:
    """Whether a file has tables; else it is empty. Raises sqlite3.DatabaseError of other tables."""
    found = tuple(sql for (sql,) in connection.execute("SELECT sql FROM sqlite_master"))
    if found not in ((), TABLES):
        raise sqlite3.DatabaseError("its tables are others")
    return bool(found)


def _make_tables(connection: sqlite3.Connection) -> None:
    with connection:
        connection.execute("BEGIN EXCLUSIVE")
        connection.execute(f"PRAGMA application_id = {OURS}")
        for table in TABLES:
            connection.execute(table.decode())


def _copy(damaged: sqlite3.Connection, path: str) -> None:
    """Copy what can be read of a damaged file, from either end of its tables, and close it."""
    with closing(damaged), closing(sqlite3.connect(path, isolation_level=None)) as copy:
        _make_tables(copy)
        for table, columns in (("answers", "?, ?, ?, ?"), ("fields", "?, ?")):
            for order in ("ASC", "DESC"):
                with suppress(sqlite3.Error):
                    rows = damaged.execute(f"SELECT * FROM {table} ORDER BY id {order}")
                    copy.executemany(f"INSERT OR IGNORE INTO {table} VALUES ({columns})", rows)


def _whole(connection: sqlite3.Connection | None, asked: Container[str]) -> dict[str, bytes]:
    """Each answer in a file that is not damaged, by its key: its content where it is asked for."""
    found = {}
    rows = connection.execute("SELECT key, content, digest FROM answers") if connection else ()
    with suppress(sqlite3.Error):  # of a damaged place, behind which nothing is read
        for name, text, stated in rows:
            if isinstance(name, bytes) and isinstance(text, bytes) and stated == _covering(name, text):
                found[name.decode()] = text if name.decode() in asked else b""
    return found


def _covering(name: bytes, text: bytes) -> bytes:
    """Digest of an answer."""
    return digest(b"%b %b" % (name, text)).encode()


def _outcome(task: Task, text: bytes | None, connection: sqlite3.Connection | None) -> Outcome | None:
    """The outcome of a task from its content and its fields; None where these are absent, damaged or forged."""
    if text is None or connection is None:
        return None
    try:
        content, fields = json.loads(text), {}
        for place, stated, name in content["fields"] if task.keeps_fields else ():
            (packed,) = connection.execute("SELECT content FROM fields WHERE id = ?", (place,)).fetchone()
            if digest(packed) != stated:
                return None
            fields[name] = _unpacked(packed)
        outcome = Outcome(ROWS.validate_python(content["rows"]), fields)
        return outcome if task.fits(outcome) else None
    # What something else has written here raises nearly anything, and so does what is not there.
    except Exception:
        return None


def _packed(name, values) -> bytes:
    """An array as the bytes of a file of NumPy. Raises TypeError, ValueError of one that is not stored."""
    values = np.asarray(values)
    if values.dtype.kind not in KINDS:
        raise TypeError(f"{name} is of type {values.dtype}, which no file of results can hold")
    if values.nbytes > MOST_FIELD - 1000:
        raise ValueError(f"{name} takes {values.nbytes:.3g} bytes, of which {MOST_FIELD:.3g} can be stored")
    packed = io.BytesIO()
    np.save(packed, values, allow_pickle=False)
    return packed.getvalue()


def _unpacked(packed: bytes) -> np.ndarray:
    values = np.load(io.BytesIO(packed), allow_pickle=False)
    if values.dtype.kind not in KINDS:
        raise ValueError("fields are numbers")
    return values
