"""Reading of files: regular ones up to a size, and nothing else that a path leads to."""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from math import ceil
from pathlib import Path

from ..printable import brief

FOREIGN = {
    *(".png", ".tif", ".tiff", ".jpg", ".jpeg", ".bmp", ".gif", ".webp", ".svg", ".pdf"),
    *(".xlsx", ".xls", ".xlsm", ".ods"),
    *(".stl", ".obj", ".ply", ".3mf", ".vtk", ".vtp", ".vtu"),
}
_folder: ContextVar[Path] = ContextVar("folder", default=Path())  # in which a relative path begins


class Unreadable(ValueError):
    """A path to nothing that is read; the message names it and the reason."""


def checked(path: str | Path, most: int) -> Path:
    """The path of a regular file of at most `most` bytes; nothing is opened. Raises Unreadable.

    Within `paths_from` a file, a relative path begins in its folder.
    """
    found = _folder.get() / path
    if found.suffix.lower() in FOREIGN:
        raise Unreadable(f"{brief(str(path))} is a picture, a workbook or a mesh: export its numbers as text")
    try:
        size = found.stat().st_size
    except FileNotFoundError as error:
        raise _unreadable(path, _not_found(path)) from error
    except OSError as error:
        raise _unreadable(path, error.strerror or str(error)) from error
    except ValueError as error:  # of zero bytes, and of letters that no file system has
        raise _unreadable(path, "is a name that no file can have") from error
    if not found.is_file():
        raise _unreadable(path, "is no regular file: folders, pipes, sockets and devices are not read")
    if size > most:
        raise _unreadable(path, f"has {ceil(size / 1e5) / 10:g} MB, and at most {most / 1e6:g} MB are read")
    return found


def content(path: str | Path, most: int) -> bytes:
    """Bytes of a regular file of at most `most` bytes. Raises Unreadable."""
    try:
        return checked(path, most).read_bytes()
    except OSError as error:
        raise _unreadable(path, error.strerror or str(error)) from error


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
        return held.decode("utf-8-sig").replace("\r\n", "\n").replace("\r", "\n")
    except UnicodeDecodeError as error:
        why = f"is no text in {error.encoding.upper()}: byte {error.start + 1} is {held[error.start]:#04x}"
        raise _unreadable(path, why) from error


def _not_found(path):
    """Where a path that leads nowhere was sought."""
    if Path(path).is_absolute():
        return "no such file"
    if _folder.get() != Path():
        return f"no such file in {brief(str(_folder.get()))}, the folder of the file that names it"
    return f"no such file in {brief(str(Path.cwd()))}, the working directory"


def _unreadable(path, why):
    return Unreadable(f"{brief(str(path))}: {why}")
