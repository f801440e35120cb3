"""Reading of files: regular ones up to a size, and nothing else that a path leads to."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import partial
from itertools import islice, takewhile
from math import ceil
from pathlib import Path
from stat import S_ISDIR, S_ISREG

from ..printable import brief

# What a name of a file has if "C:\\new" stood in double quotes.
_ESCAPED = "\n\t\r\b\f"
PIECE = 2**20  # bytes read at a time: memory is taken for what is there, not for what may be


_folder: ContextVar[Path] = ContextVar("folder", default=Path())  # in which a relative path begins


class Unreadable(ValueError):
    """A path to nothing that is read; the message names it and the reason."""


def checked(path: str | Path, most: int) -> Path:
    """The path of a regular file of at most `most` bytes; nothing is opened. Raises Unreadable.

    Within `paths_from` a file, a relative path begins in its folder.
    """
    found = _folder.get() / path
    _refuse(path, _asked(path, os.stat, found), most)
    return found


def content(path: str | Path, most: int) -> bytes:
    """Bytes of a regular file of at most `most` bytes; waits for no other process. Raises Unreadable."""
    found = checked(path, most)
    flags = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
    handle = _asked(path, os.open, found, flags)
    try:
        # What is open may be another file than the one that was checked, and may grow.
        _refuse(path, os.fstat(handle), most)
    except Unreadable:
        os.close(handle)
        raise
    with open(handle, "rb") as file:
        # None is what has nothing to give now, as some files of the system.
        pieces = islice(takewhile(bool, iter(partial(file.read, PIECE), b"")), most // PIECE + 1)
        held = _asked(path, b"".join, pieces)
    if len(held) > most:
        raise _unreadable(path, _too_large(len(held), most))
    return held


@contextmanager
def paths_from(path: str | Path) -> Iterator[None]:
    """Within it relative paths begin in the folder of this file; within another file, in the folder of that."""
    outer, own = _folder.get(), Path(path).parent
    token = _folder.set(own.absolute() if outer == Path() != own else outer)
    try:
        yield
    finally:
        _folder.reset(token)


def text(path: str | Path, most: int) -> str:
    """Text of such a file in UTF-8, line ends as \\n and no byte-order mark. Raises Unreadable."""
    held = content(path, most)
    try:
        decoded = held.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        why = f"is no text in {error.encoding.upper()}: byte {error.start + 1} is {held[error.start]:#04x}"
        raise _unreadable(path, why) from error
    return decoded.replace("\r\r\n", "\n").replace("\r\n", "\n").replace("\r", "\n")


def _refuse(path, status, most):
    if S_ISDIR(status.st_mode):
        raise _unreadable(path, "is a folder, and a file is needed")
    if not S_ISREG(status.st_mode):
        raise _unreadable(path, "is no regular file: pipes, sockets and devices are not read")
    if status.st_size > most:
        raise _unreadable(path, _too_large(status.st_size, most))


def _asked(path, system, *arguments):
    """Answer of the operating system about a path. Raises Unreadable."""
    try:
        return system(*arguments)
    except FileNotFoundError as error:
        raise _unreadable(path, _not_found(path)) from error
    except OSError as error:
        raise _unreadable(path, error.strerror or str(error)) from error
    except ValueError as error:  # of zero bytes, and of letters that no file system has
        raise _unreadable(path, "is a name that no file can have") from error


def _not_found(path):
    """Where a path that leads nowhere was sought, and what became of a backslash that was none."""
    if any(mark in str(path) for mark in _ESCAPED):
        return (
            "no such file: a backslash in double quotes was read as the beginning of a sign; write the path in "
            "single quotes, or with forward slashes"
        )
    if Path(path).is_absolute():
        return "no such file"
    if _folder.get() != Path():
        return f"no such file in {brief(str(_folder.get()))}, the folder of the file that names it"
    try:
        return f"no such file in {brief(os.getcwd())}, the working directory"
    except OSError:  # which may be gone
        return "no such file"


def _too_large(size, most):
    return f"has {ceil(size / 1e5) / 10:g} MB, and at most {most / 1e6:g} MB are read"


def _unreadable(path, why):
    return Unreadable(f"{brief(str(path))}: {why}")
