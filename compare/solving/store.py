"""Store: what has been solved, in one file of SQLite, named by everything that an answer depends on."""

import errno
import io
import json
import os
import sqlite3
import zlib
from collections.abc import Iterable, Iterator, Mapping
from contextlib import ExitStack, closing, contextmanager, suppress
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import TypeAdapter

from scene.files import files
from scene.files.reading import InvalidInput
from scene.printable import brief

from .digest import DIGEST, key
from .folders import clear, code_of, connect, held_by_another, make, touch
from .task import Outcome, Row, Task

FILE = "answers.sqlite"
TRACE = ".fault.txt"  # of how a task broke, behind its key
MOST_BYTES, MOST_FIELDS = 2**36, 10**9 - 10**6  # of the file, of the fields of an answer
KINDS = "iufb"  # of the numbers of fields
ROWS = TypeAdapter(tuple[Row, ...])
# Rows are compressed JSON, and fields, where they are kept, a file of NumPy: both formats have checksums.
TABLE = b"CREATE TABLE answers (key TEXT PRIMARY KEY, rows BLOB, fields BLOB)"
DAMAGED = (0, sqlite3.SQLITE_ERROR, sqlite3.SQLITE_CORRUPT, sqlite3.SQLITE_NOTADB)
ERRORS = {sqlite3.SQLITE_FULL: errno.ENOSPC, sqlite3.SQLITE_READONLY: errno.EACCES}


class Store:
    """A folder with a file of outcomes, which one process at a time opens.

    An outcome that is damaged counts as absent and touches no other. A kill costs at most the outcome that was
    being written. A file that is no such store, or damaged as a whole, is refused.
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
            found = {task: _outcome(task, connection) for task in tasks} if connection else {}
        return {task: outcome for task, outcome in found.items() if outcome is not None}

    def put(self, task: Task, outcome: Outcome) -> None:
        """Add an outcome, which then stands for any before it.

        Raises OSError, which names the file; TypeError, ValueError for what no file can hold.
        """
        rows = [vars(row) | {"measures": {**row.measures}, "settings": {**row.settings}} for row in outcome.rows]
        fields = _packed(outcome.fields) if task.keeps_fields else None
        answer = key(task), zlib.compress(json.dumps(rows).encode()), fields
        with self.writing(), self._named():
            self._open.execute("REPLACE INTO answers VALUES (?, ?, ?)", answer)

    def __len__(self) -> int:
        """Number of outcomes, whatever code they are of."""
        return len(self._keys())

    def by_other_code(self, tasks: Iterable[Task]) -> int:
        """Number of the tasks whose question other code has answered, and this code has not."""
        keys = self._keys()
        questions = {name[:DIGEST] for name in keys}
        return sum((name := key(task).encode()) not in keys and name[:DIGEST] in questions for task in tasks)

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
        with self._named(), ExitStack() as opened:
            self._there()
            touch(self.path)
            connection = opened.enter_context(closing(connect(self.path)))
            connection.execute("PRAGMA locking_mode = EXCLUSIVE")  # else WAL needs memory that drives do not share
            if not _has_table(connection):
                connection.execute(TABLE.decode())
            connection.execute("PRAGMA journal_mode = DELETE")
            if connection.execute("PRAGMA quick_check(1)").fetchone() != (b"ok",):
                raise sqlite3.DatabaseError("damaged")
            connection.execute("PRAGMA journal_mode = WAL")
            connection.execute("PRAGMA synchronous = NORMAL")
            self._open, closes = connection, opened.pop_all()
        try:
            clear(self.folder)
            yield
        finally:
            with closes, suppress(sqlite3.Error):  # of a full disk: what the other file has is read the next time
                self._open.execute("PRAGMA journal_mode = DELETE")
            self._open = None

    @contextmanager
    def _reading(self) -> Iterator[sqlite3.Connection | None]:
        """Connection for reading, None where there is no file yet."""
        if self._open is not None or not self._there():
            yield self._open
            return
        with self._named(), ExitStack() as opened:
            connection = opened.enter_context(closing(connect(self.path)))
            connection.execute("PRAGMA locking_mode = EXCLUSIVE")
            yield connection if _has_table(connection) else None

    def _keys(self) -> set[bytes]:
        with self._reading() as connection:
            return {name for (name,) in connection.execute("SELECT key FROM answers")} if connection else set()

    def _there(self) -> bool:
        """Whether there is a file that is not empty. Raises InvalidInput of what is none, or too large."""
        try:
            return os.path.lexists(self.path) and files.checked(self.path, MOST_BYTES).stat().st_size > 0
        except files.Unreadable as error:
            raise InvalidInput(str(error)) from error

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
                why = "is no file of solved contacts of this version, or is damaged: move it away"
                raise InvalidInput(f"{brief(str(self.path))}: {why}") from error
            number = ERRORS.get(code, errno.EIO)
            reason = os.strerror(number) if code in ERRORS else str(error)
            raise OSError(number, reason, str(self.path)) from error


def _has_table(connection: sqlite3.Connection) -> bool:
    """Whether a file has the table; else it is empty. Raises sqlite3.DatabaseError of another."""
    found = connection.execute("SELECT sql FROM sqlite_master WHERE sql NOT NULL").fetchall()
    if found not in ([], [(TABLE,)]):
        raise sqlite3.DatabaseError("its tables are others")
    return bool(found)


def _outcome(task: Task, connection: sqlite3.Connection) -> Outcome | None:
    """The stored outcome of a task; None where it is absent or damaged, or lacks fields that are kept."""
    columns = "rows, fields" if task.keeps_fields else "rows"
    try:
        asked = connection.execute(f"SELECT {columns} FROM answers WHERE key = ?", (key(task),))
        rows, *kept = asked.fetchone()
        fields = {name: values for packed in kept for name, values in np.load(io.BytesIO(packed)).items()}
        outcome = Outcome(ROWS.validate_python(json.loads(zlib.decompress(rows))), fields)
        return outcome if task.fits(outcome) else None
    # What is damaged raises nearly anything, and so does what is not there.
    except Exception:
        return None


def _packed(fields: Mapping[str, np.ndarray]) -> bytes:
    """Arrays as a file of NumPy. Raises TypeError, ValueError for arrays that cannot be stored."""
    arrays: dict[str, Any] = {name: np.asarray(values) for name, values in fields.items()}
    packed = io.BytesIO()
    for name, values in arrays.items():
        if values.dtype.kind not in KINDS:
            raise TypeError(f"{name} is of type {values.dtype}, which no file of results can hold")
    if (size := sum(values.nbytes for values in arrays.values())) > MOST_FIELDS:
        raise ValueError(f"the fields take {size:.3g} bytes, and at most {MOST_FIELDS:.3g} can be stored")
    np.savez(packed, **arrays)
    return packed.getvalue()
