"""What has been solved, on disk: one file a task, named by everything that its answer depends on."""

import hashlib
import os
import platform
import re
import tempfile
import time
from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from importlib.metadata import version
from importlib.util import find_spec
from math import isfinite
from pathlib import Path
from typing import IO, Any

from .outcome import Outcome
from .task import Task
from .taskfile import canonical, read, written

TRACE = ".fault.txt"  # of how a task broke, behind its key
DAY = 86400.0  # as long no write takes
# Of a file that is being written: that of the file, machine and process, and some letters.
TEMPORARY = re.compile(r"\..+\.([0-9a-f]{8})-([1-9][0-9]*)\.[a-z0-9_]{8}")
PACKAGES = ("mdr-bem-crosscheck", "numpy", "scipy", "ducc0", "pyfftw", "numba")


def code_digest(folder: Path) -> str:
    """Digest of every Python source below a folder, or of one file: names and content."""
    sources = {path.relative_to(folder).as_posix(): path for path in folder.rglob("*.py")}
    whole = hashlib.sha256()
    for name, path in sorted(sources.items() if folder.is_dir() else [(folder.name, folder)]):
        content = path.read_bytes()
        whole.update(f"{name}\0{len(content)}\0".encode())
        whole.update(content)
    return whole.hexdigest()


def key(task: Task) -> str:
    """Name of a task's file: digest of its question, then of the code that answers it and of versions."""
    return _named_by(canonical(task.question), task)


def _named_by(text, task):
    return f"{_digest(text)}-{_code_digest(tuple(task.packages))}"


@dataclass(frozen=True)
class Store:
    """A folder of outcomes. A file appears whole or not at all; one that cannot be read counts as absent."""

    folder: Path

    def get(self, task: Task) -> Outcome | None:
        """The stored outcome of a task by this code, or None: also for a task that keeps fields not there."""
        text = canonical(task.question)  # takes a third of the time that reading takes: once
        return self._own(task, text)

    def put(self, task: Task, outcome: Outcome) -> None:
        """Write an outcome.

        Raises OSError, which names the file; ValueError, TypeError for what no file can hold.
        """
        question = task.question
        text = canonical(question)
        content = _content(task, outcome, question, text)
        self.folder.mkdir(parents=True, exist_ok=True)
        _tidy(self.folder)
        write(self._path(task, text), lambda file: file.write(content))

    def recall(self, task: Task) -> Outcome | None:
        """The outcome of a question by whatever code answered it, this one first, then the newest; or None."""
        return self.recalled([task]).get(task)

    def recalled(self, tasks: Iterable[Task]) -> dict[Task, Outcome]:
        """As `recall`, of those that there is an outcome of; the folder is listed once."""
        known = defaultdict(list)
        for path in self.folder.glob("*-*.nc"):
            known[path.name.partition("-")[0]].append(path)
        found = {}
        for task in tasks:
            text = canonical(task.question)
            outcome = self._own(task, text)
            if outcome is None:
                others = [_read(path, task, text) for path in known[_digest(text)]]
                _, outcome = max(others, key=lambda other: other[0], default=NONE)
            if outcome is not None:
                found[task] = outcome
        return found

    def holds(self, task: Task) -> bool:
        """Whether there is a file of a task by this code, which is not read for it."""
        return self._path(task, canonical(task.question)).exists()

    def traces(self, task: Task) -> list[Path]:
        """Where it is told how a task broke, by whatever code, and was not solved since by the same."""
        return sorted(self.folder.glob(f"{_digest(canonical(task.question))}-*{TRACE}"))

    def trace(self, name: str) -> Path:
        """Where it is told how the task of a key broke."""
        return self.folder / f"{name}{TRACE}"

    def _own(self, task, text):
        _, outcome = _read(self._path(task, text), task, text)
        return outcome

    def _path(self, task, text):
        return self.folder / f"{_named_by(text, task)}.nc"


NONE = "", None


def _read(path, task, text):
    """When it was written, as text that sorts, and the outcome; "" and None where there is none that fits."""
    try:
        content = path.read_bytes()
    except OSError:
        return NONE
    try:
        created, outcome = read(content, text, task.keeps_fields)
        return (created, outcome) if task.fits(outcome) else NONE
    # What something else has written under this name raises nearly anything.
    except Exception:
        return NONE


def stored_size(task: Task, outcome: Outcome) -> int:
    """Bytes that an outcome takes in a store."""
    return len(_content(task, outcome, task.question, canonical(task.question)))


def _content(task, outcome, question, text):
    about = {"title": task.label, "source": "mdr-bem-crosscheck", **_code_texts(tuple(task.packages))}
    return written(outcome, question, text, about, task.keeps_fields)


def write(path: Path, fill: Callable[[IO[bytes]], Any]) -> None:
    """Write a file whole or not at all: `fill` gets a temporary file beside it, which then takes the name.

    Raises OSError, which names the file.
    """
    try:
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.{_machine()}-{os.getpid()}.")
        try:
            with os.fdopen(handle, "wb") as file:
                fill(file)
            os.chmod(name, 0o644)
            os.replace(name, path)
        except BaseException:
            with suppress(OSError):
                os.unlink(name)
            raise
    except OSError as error:
        if error.errno is None:
            raise
        raise OSError(error.errno, error.strerror, str(path)) from error


@cache
def _tidy(folder: Path) -> None:
    """Clear a folder of what processes left that ended while they wrote; once a process."""
    for path in folder.glob(".*"):
        if left := TEMPORARY.fullmatch(path.name):
            with suppress(OSError):
                if _ended(*left.groups()) or time.time() - path.stat().st_mtime > DAY:
                    path.unlink()


def _machine():
    """As the name of a temporary file tells it."""
    return _digest(platform.node())[:8]


def _ended(machine, process):
    """Whether it is a process of this machine and has ended; of others nothing is known."""
    if os.name != "posix" or machine != _machine():
        return False
    try:
        os.kill(int(process), 0)
    except ProcessLookupError:
        return True
    except PermissionError:
        pass
    return False


def _digest(text):
    return hashlib.sha256(text.encode()).hexdigest()[:32]


def code_of(packages: Sequence[str]) -> dict[str, dict[str, str]]:
    """Digests of the code of packages, and versions."""
    return {"code": {name: _package_digest(name) for name in packages}, "versions": _versions()}


@cache
def _code_digest(packages):
    return _digest(canonical(code_of(packages)))


@cache
def _code_texts(packages):
    return {name: canonical(value) for name, value in code_of(packages).items()}


@cache
def _versions():
    return {package: version(package) for package in PACKAGES}


@cache
def _package_digest(package):
    """Read once a process: the code that runs is the code that was imported."""
    spec = find_spec(package)
    return code_digest(
        Path(spec.submodule_search_locations[0] if spec.submodule_search_locations else spec.origin)
    )


def finite(value):
    """A value as JSON can hold it: None for NaN and infinities."""
    return None if isinstance(value, float) and not isfinite(value) else value
