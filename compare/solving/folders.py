"""Folders: their names and format, the run that holds them, and files that are written whole or not at all."""

import multiprocessing
import os
import re
import sqlite3
import unicodedata
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, closing, contextmanager, suppress
from functools import cache
from pathlib import Path
from secrets import token_hex
from typing import IO, Any, TypeVar

from pydantic import BaseModel, ValidationError

from scene.files.files import Unreadable, content
from scene.files.reading import InvalidInput
from scene.printable import brief

LOCK = ".crosscheck-lock"  # an empty file, which stays: one that is removed could be locked twice
PART = ".crosscheck-*.part"  # names of files that are being written
FORMAT = 4  # of folders: it changes with the names of figures, columns and studies
MANIFEST = "manifest.json"
TAKEN = {"solved", "figures", "tables"}  # folders that commands write into themselves
MOST_BYTES = 2**30  # of a manifest, which has the heights of measured maps in it


class Unwritable(OSError):
    """A folder or a file cannot be written; raised before anything is solved."""


def connect(path: Path) -> sqlite3.Connection:
    """Connect to a file of SQLite that is there."""
    address = f"{path.absolute().as_uri()}?mode=rw{'' if locks(path.parent) else '&vfs=unix-none'}"
    connection = sqlite3.connect(address, timeout=0.0, isolation_level=None, uri=True)
    connection.text_factory = bytes
    return connection


def code_of(error: Exception) -> int:
    """Code of an error of SQLite, without the details; 0 of any other."""
    return getattr(error, "sqlite_errorcode", 0) & 0xFF


@cache
def locks(folder: Path) -> bool:
    """Whether files of a folder can be locked, as they cannot on some network drives."""
    try:
        with _part(folder) as path, closing(sqlite3.connect(path, timeout=0.0)) as connection:
            _lock(connection)
    except sqlite3.OperationalError:
        return False
    except OSError:  # nothing can be written there
        pass
    return True


@contextmanager
def lock(folders: Iterable[Path], say: Callable[[str], Any]) -> Iterator[None]:
    """Folders for this run alone; they are made.

    say : called with a message where nothing keeps other runs out

    SQLite locks an empty file in each; the system takes the lock back, however the process ends. Raises
    InvalidInput, which names the folder, where another run holds it.
    """
    # A worker that still imports a script without a guard, which runs again: its parent has the folder.
    if getattr(multiprocessing.current_process(), "_inheriting", False):
        raise SystemExit(1)
    with ExitStack() as held:
        for folder in dict.fromkeys(folders):
            try:
                folder.mkdir(parents=True, exist_ok=True)
                touch(folder / LOCK)
                if locks(folder):
                    _lock(held.enter_context(closing(connect(folder / LOCK))))
                else:
                    say("this folder cannot be locked, as on some network drives: run one at a time")
            except (OSError, sqlite3.Error) as error:
                if code_of(error) == sqlite3.SQLITE_BUSY:
                    raise held_by_another(folder) from None
                say(f"this folder cannot be locked ({error}): run one at a time")
        yield


def _lock(connection):
    connection.execute("PRAGMA journal_mode = MEMORY")  # no second file
    connection.execute("BEGIN EXCLUSIVE")


def held_by_another(folder: Path) -> InvalidInput:
    """Refusal of a folder that another run holds."""
    return InvalidInput(
        f"{brief(str(folder))}: another run holds this folder until its page is written: wait for it, or name "
        "another folder"
    )


def write(path: Path, fill: Callable[[IO[bytes]], Any]) -> None:
    """Write a file whole or not at all: `fill` gets a temporary file in the same folder, which is then renamed.

    Raises OSError, which names the file.
    """
    with _named(path), _part(path.parent) as part:
        with part.open("wb") as file:
            fill(file)
        os.replace(part, path)


def make(folder: Path) -> None:
    """Make a folder, and see whether files can be written into it. Raises OSError, which names it."""
    folder.mkdir(parents=True, exist_ok=True)
    with _named(folder), _part(folder):
        pass


def clear(folder: Path) -> None:
    """Clear a folder, which this run holds, of what killed runs left half written."""
    for path in folder.glob(PART):
        with suppress(OSError):
            path.unlink()


def touch(path: Path) -> None:
    """Make an empty file, with the permissions that the user's files have, where there is none."""
    with suppress(FileExistsError):
        path.touch(exist_ok=False)


@contextmanager
def _part(folder):
    """Path of a new, empty file in a folder; it is gone afterwards."""
    path = folder / PART.replace("*", token_hex(8))
    path.touch(exist_ok=False)
    try:
        yield path
    finally:
        with suppress(OSError):
            path.unlink()


@contextmanager
def _named(path):
    """Errors of the system name the file that a person knows."""
    try:
        yield
    except OSError as error:
        if error.errno is None:
            raise
        raise OSError(error.errno, error.strerror, str(path)) from error


class Stated(BaseModel):
    """Part of a manifest that all versions have.

    format : of the folder
    finished : whether the run that writes the folder has come to its end
    """

    format: int
    finished: bool = True


Kind = TypeVar("Kind", bound=Stated)


def read(path: Path, kind: type[Kind], finished: bool = True) -> Kind:
    """Read a manifest. Raises InvalidInput if it is damaged, of another version, or of an unfinished run.

    finished : whether the run has to have come to its end
    """
    try:
        text = content(path, MOST_BYTES)
        refuse_other(path, Stated.model_validate_json(text).format)
        found = kind.model_validate_json(text)
    except Unreadable as error:
        raise InvalidInput(str(error)) from error
    except ValidationError as error:
        first = error.errors()[0]
        mistake = ": ".join(filter(None, [brief(".".join(map(str, first["loc"]))), first["msg"]]))
        why = f"{brief(str(path))}: was not written by this version of the command: {mistake}"
        raise InvalidInput(why) from None
    if finished and not found.finished:
        raise InvalidInput(
            f"{brief(str(path.parent))}: a run that writes this folder has not come to its end, or was killed: "
            "run the command again, which solves nothing twice"
        )
    return found


def refuse_other(path: Path, found: int) -> None:
    """Raise InvalidInput of a file in another format than this version writes."""
    if found != FORMAT:
        raise InvalidInput(
            f"{brief(str(path))}: was written by another version of this program, which has other names: run the "
            "command again, which solves its contacts again"
        )


def slug(name: str) -> str:
    """Name as it may stand in a path."""
    plain = unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode()
    return re.sub(r"[^a-z0-9]+", "-", plain.lower()).strip("-") or "case"


def folders(names: Iterable[str], what: str) -> dict[str, str]:
    """Folders of what has these names, by name.

    what : that has the names, for mistakes

    Raises InvalidInput of a name whose folder has another use, and of two that share one.
    """
    found: dict[str, str] = {}  # names by folder
    for name in names:
        folder, why = slug(name), ""
        if folder in TAKEN:
            why = f"its folder, {folder}, has another use"
        elif folder in found:
            why = f"has the folder of {brief(found[folder])!r}, {folder}"
        if why:
            raise InvalidInput(f"{what} {brief(name)!r}: {why}: choose another name")
        found[folder] = name
    return {name: folder for folder, name in found.items()}
