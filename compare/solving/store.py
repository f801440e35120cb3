"""Store: what has been solved, as lines of one file, named by everything that an answer depends on."""

import errno
import hashlib
import io
import json
import math
import os
import platform
import re
import sys
import time
from base64 import b64decode, b64encode
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from fnmatch import fnmatchcase
from functools import cache
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from secrets import token_hex
from stat import S_ISREG
from typing import IO, Any

import numpy as np

from scene import files

from .outcome import NUMBERS, Outcome, Row
from .task import Task

FILE = "answers.txt"
TRACE = ".fault.txt"  # of how a task broke, behind its key
PACKAGES = ("mdr-bem-crosscheck", "numpy", "scipy", "ducc0", "pyfftw", "numba")
# Name of a file that is being written: whose it is, where, by which process, since when [s], and some letters.
TEMPORARY = re.compile(r"\.crosscheck-([0-9a-f]{8})-([0-9]{1,10})-([0-9]{1,11})-[0-9a-f]{16}")
LEFT = 7 * 86400  # age from which one of another machine counts as left behind [s]
DIGEST = 32  # letters of a digest
# Names of files and folders in a package that no wheel has: left by Python, by editors, by merges.
UNSHIPPED = ("__pycache__", ".*", "*~", "#*#", "*.bak", "*.orig", "*.rej")
HEAD = 3 * DIGEST + 2  # letters of a line before its content: its digest, and the key of two digests
# Most bytes of the file, of a line in it (a longer one is passed over), and of the fields of a task.
MOST_BYTES, MOST_LINE, MOST_FIELDS = 2**34, 2**26, 2**32
KINDS = "iufb"  # of the numbers of fields


class Unwritable(OSError):
    """A folder or a file cannot be written into; said before anything is solved."""


class Store:
    """A folder of outcomes, a line of its file each; fields, which are large, are files beside it.

    Each line carries a digest: one that is damaged or cut off counts as absent and touches no other. Nothing is
    ever changed in place, so that a kill costs at most the line that was being written.
    """

    def __init__(self, folder: Path):
        self.folder = folder
        self.path = folder / FILE
        self._places: dict[str, tuple[int, int]] = {}
        self._end = 0
        self._file: int | None = None

    def get(self, task: Task) -> Outcome | None:
        """The stored outcome of a task by this code, or None: also for a task that keeps fields not there."""
        name = key(task)
        self._read_on()
        if name not in self._places:
            return None
        try:
            outcome = self._outcome(name, task.keeps_fields)
            return outcome if task.fits(outcome) else None
        # What something else has written here raises nearly anything.
        except Exception:
            return None

    def put(self, task: Task, outcome: Outcome) -> None:
        """Add an outcome. The folder must be open for `writing`.

        Raises OSError, which names the file; TypeError, ValueError for what no file can hold.
        """
        name = key(task)
        fields = _packed(outcome.fields) if outcome.fields or task.keeps_fields else None
        line = _line(name, _text(task, outcome, fields))
        if self._file is None:
            with self.writing():
                self._add(name, line, fields)
        else:
            self._add(name, line, fields)

    def __len__(self) -> int:
        """Number of outcomes, whatever code they are of."""
        self._read_on()
        return len(self._places)

    def by_other_code(self, tasks: Iterable[Task]) -> int:
        """Number of the tasks whose question other code has answered, and this code has not."""
        self._read_on()
        questions = {name[:DIGEST] for name in self._places}
        return sum((name := key(task)) not in self._places and name[:DIGEST] in questions for task in tasks)

    def trace(self, task: Task) -> Path:
        """File with the traceback of a task that broke."""
        return self.folder / f"{key(task)}{TRACE}"

    @contextmanager
    def writing(self) -> Iterator[None]:
        """The file, open; what a killed run left half written is cut off. Raises OSError, which names the file."""
        self.folder.mkdir(parents=True, exist_ok=True)
        with _named(self.path):
            file = os.open(self.path, os.O_RDWR | os.O_CREAT | os.O_APPEND | getattr(os, "O_CLOEXEC", 0), 0o666)
        try:
            status = os.fstat(file)
            if not S_ISREG(status.st_mode) or status.st_size > MOST_BYTES:
                reason = f"is no regular file of at most {MOST_BYTES / 1e9:.3g} GB"
                raise OSError(errno.EINVAL, reason, str(self.path))
            self._file = file
            self._mend()
            yield
        finally:
            self._file = None
            os.close(file)

    def _mend(self):
        """Clear what was being written as its run was killed: files, and a line without an end."""
        clear(self.folder)
        self._read_on()
        if os.fstat(self._file).st_size > self._end:
            with _named(self.path):
                os.ftruncate(self._file, self._end)

    def _add(self, name, line, fields):
        if fields is not None:
            write(self.folder / f"{name}.npz", lambda file: file.write(fields))
        start = os.fstat(self._file).st_size
        # Two ends of a line: where one is damaged, the other still keeps this line and the next apart.
        written = line + b"\n\n"
        with _named(self.path):
            try:
                if os.write(self._file, written) < len(written):
                    raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
            except OSError:
                with suppress(OSError):
                    os.ftruncate(self._file, start)
                raise

    def _read_on(self):
        """Find the lines that came since the last look; a line still being written is left for the next."""
        try:
            if self.path.stat().st_size == self._end:
                return
            with files.checked(self.path, MOST_BYTES).open("rb") as file:
                file.seek(self._end)
                while first := file.readline(MOST_LINE):
                    last, end = first, self._end + len(first)
                    while last and not last.endswith(b"\n"):
                        last = file.readline(MOST_LINE)
                        end += len(last)
                    if not last:
                        break
                    if last is first and len(first) > HEAD:
                        name = first[DIGEST + 1 : HEAD].decode(errors="replace")
                        self._places[name] = self._end, len(first) - 1
                    self._end = end
        except (OSError, files.Unreadable):
            return

    def _outcome(self, name, keeps):
        start, length = self._places[name]
        with self.path.open("rb") as file:
            file.seek(start)
            line = file.read(length)
        text = line[HEAD + 1 :]
        if line != _line(name, text):
            raise ValueError("the line is damaged")
        content = json.loads(text, object_hook=_unnamed)
        fields = {}
        if keeps:
            packed = files.content(self.folder / f"{name}.npz", MOST_FIELDS)
            if _digest(packed) != content["fields"]:
                raise ValueError("the fields are damaged")
            fields = dict(zip(content["names"], _unpacked(packed), strict=True))
        return Outcome(_rows(content), fields)


def key(task: Task) -> str:
    """Name of a task's outcome: digest of its question, then of the code that answers it and of versions."""
    return f"{_digest(canonical(task.question).encode())}-{_code_digest(tuple(task.packages))}"


def _line(name, text):
    covered = name.encode() + b" " + text
    return _digest(covered).encode() + b" " + covered


def _text(task, outcome, fields):
    """An outcome as JSON: numbers of all rows in columns, bit for bit."""
    rows = outcome.rows
    measures = list(dict.fromkeys(name for row in rows for name in row.measures))
    columns = [[getattr(row, name) for row in rows] for name in NUMBERS]
    columns += [[row.measures.get(name, math.nan) for row in rows] for name in measures]
    content = {
        "label": task.label,
        "rows": len(rows),
        "numbers": b64encode(np.array(columns, "<f8").tobytes()).decode(),
        "measures": measures,
        "absent": [[k for k, row in enumerate(rows) if name not in row.measures] for name in measures],
        "settings": [dict(row.settings) for row in rows],
        "reasons": {k: row.reason for k, row in enumerate(rows) if row.reason is not None},
        "finer": [row.finer for row in rows],
    }
    if fields is not None:
        content |= {"names": list(outcome.fields), "fields": _digest(fields)}
    return canonical(content).encode()


def _rows(content):
    count, measures = content["rows"], content["measures"]
    numbers = np.frombuffer(b64decode(content["numbers"]), "<f8").reshape(len(NUMBERS) + len(measures), count)
    columns = numbers.tolist()
    taken = list(zip(measures, columns[len(NUMBERS) :], map(set, content["absent"]), strict=True))
    if not all(isinstance(each, str) for each in (*measures, *content["reasons"].values())):
        raise ValueError("a name or a reason is no text")
    return tuple(
        Row(
            *(column[k] for column in columns[: len(NUMBERS)]),
            {name: column[k] for name, column, absent in taken if k not in absent},
            dict(content["settings"][k]),
            content["reasons"].get(str(k)),
            int(content["finer"][k]),
        )
        for k in range(count)
    )


def _packed(fields):
    """Fields as the bytes of a NumPy archive, named by their number. Raises TypeError for what it cannot hold."""
    arrays = {name: np.asarray(values) for name, values in fields.items()}
    for name, values in arrays.items():
        if values.dtype.kind not in KINDS:
            raise TypeError(f"{name} is of type {values.dtype}, which no file of results can hold")
    packed = io.BytesIO()
    np.savez(packed, **{f"{k}": values for k, values in enumerate(arrays.values())})
    return packed.getvalue()


def _unpacked(packed):
    """The arrays of an archive of `_packed`, in their order. Raises nearly anything of another archive."""
    with np.load(io.BytesIO(packed), allow_pickle=False) as kept:
        if sum(member.file_size for member in kept.zip.infolist()) > len(packed):
            raise ValueError("it unpacks to more than it takes")
        arrays = [kept[f"{k}"] for k in range(len(kept.files))]
    if any(values.dtype.kind not in KINDS for values in arrays):
        raise ValueError("fields are numbers")
    return arrays


def write(path: Path, fill: Callable[[IO[bytes]], Any]) -> None:
    """Write a file whole or not at all: `fill` gets a temporary file beside it, which then takes the name.

    Raises OSError, which names the file.
    """
    _cleared(path.parent)
    with _named(path):
        if path.exists() and not (path.is_file() or path.is_dir()):  # as a device, which a file would replace
            raise OSError(errno.EINVAL, "is no regular file, and is not written over")
        with _temporary(path.parent) as file:
            fill(file)
            file.close()
            os.replace(file.name, path)


def make(folder: Path) -> None:
    """Make a folder, and see whether files can be written into it. Raises OSError, which names it."""
    folder.mkdir(parents=True, exist_ok=True)
    with _named(folder), _temporary(folder):
        pass


def refuse_impossible(path: Path) -> None:
    """Raise OSError of a path that no file can have."""
    try:
        with suppress(OSError):
            path.lstat()
    except ValueError as error:  # of zero bytes, and of letters that no file system has
        raise OSError(errno.EINVAL, "is a name that no file can have", str(path)) from error


@contextmanager
def _temporary(folder):
    """A file whose name says whose it is, with the permissions that the user's files have; gone afterwards."""
    name = folder / f".crosscheck-{_here()}-{os.getpid()}-{int(time.time())}-{token_hex(8)}"
    try:
        with name.open("xb") as file:
            yield file
    finally:
        with suppress(OSError):
            name.unlink()


@contextmanager
def _named(path):
    """Errors of the system name the file that a person knows."""
    try:
        yield
    except OSError as error:
        if error.errno is None:
            raise
        raise OSError(error.errno, error.strerror, str(path)) from error


def clear(folder: Path) -> None:
    """Clear a folder of what processes left that ended while they wrote."""
    for path in folder.glob(".crosscheck-*"):
        if left := TEMPORARY.fullmatch(path.name):
            here, process, since = left[1] == _here(), int(left[2]), int(left[3])
            if (here and _ended(process)) or time.time() - since > LEFT:
                with suppress(OSError):
                    path.unlink()


_cleared = cache(clear)


@cache
def _here() -> str:
    """Digest of where numbers of processes mean something: this machine since it was started, this container."""
    where = [platform.node()]
    with suppress(OSError):  # of Linux alone
        where += [
            Path("/proc/sys/kernel/random/boot_id").read_text(encoding="ascii"),
            os.readlink("/proc/self/ns/pid"),
        ]
    return _digest(canonical(where).encode())[:8]


def _ended(process):
    """Whether a process of this machine has ended, as far as it knows."""
    if os.name != "posix":
        return False
    try:
        os.kill(process, 0)
    except (ProcessLookupError, OverflowError):
        return True
    except PermissionError:
        pass
    return False


def canonical(value: Any) -> str:
    """JSON that is the same for equal values on every platform; numbers that JSON lacks are named."""
    try:
        return _json(value)
    except ValueError:
        return _json(_finite(value))


def _json(value):
    return json.dumps(value, sort_keys=True, separators=(",", ":"), allow_nan=False)


def _finite(value):
    if isinstance(value, float) and not math.isfinite(value):
        return {"not finite": repr(value)}
    if isinstance(value, Mapping):
        return {name: _finite(entry) for name, entry in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(entry) for entry in value]
    return value


def _unnamed(value):
    return float(value["not finite"]) if value.keys() == {"not finite"} else value


def _digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()[:DIGEST]


def shipped(folder: Path) -> dict[str, Path]:
    """Every file of a package, code and data, by its name in the folder; without what `UNSHIPPED` names."""
    files = {path.relative_to(folder): path for path in folder.rglob("*") if path.is_file()}
    return {
        name.as_posix(): path
        for name, path in files.items()
        if not any(fnmatchcase(part, pattern) for part in name.parts for pattern in UNSHIPPED)
    }


def code_digest(*places: Path) -> str:
    """Digest of names and content of every file that a package ships, or of one file.

    places : folders of the package, of which it may have several, or the file

    A checkout has the digest of the wheel that is made of it.
    """
    found: dict[str, Path] = {}
    for place in places:
        found |= {place.name: place} if place.is_file() else shipped(place)
    whole = hashlib.sha256()
    for name, path in sorted(found.items()):
        content = path.read_bytes()
        whole.update(f"{name}\0{len(content)}\0".encode())
        whole.update(content)
    return whole.hexdigest()


def code_of(packages: Sequence[str]) -> dict[str, dict[str, str]]:
    """Digests of the code of packages, and versions."""
    return {"code": {name: _package_digest(name) for name in packages}, "versions": _versions()}


@cache
def _code_digest(packages):
    return _digest(canonical(code_of(packages)).encode())


@cache
def _versions():
    return {package: version(package) for package in PACKAGES}


@cache
def _package_digest(package):
    """Read once a process: the code that runs is the code that was imported."""
    script = sys.modules["__main__"]
    if package == "__main__" and script.__spec__ is None:  # a script has no other name
        return code_digest(Path(str(script.__file__)))
    spec = find_spec(package)
    return code_digest(*map(Path, spec.submodule_search_locations or [spec.origin]))
