"""What has been solved, on disk: one file a task, named by everything that its answer depends on."""

import hashlib
import json
import os
import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import cache
from importlib.metadata import version
from importlib.util import find_spec
from math import nan
from pathlib import Path
from typing import IO, Any, Protocol

import numpy as np

from .outcome import NUMBERS, Outcome, Row

PACKAGES = ("mdr-bem-crosscheck", "numpy", "scipy", "ducc0", "pyfftw", "numba")


class Task(Protocol):
    """What one worker solves in one go; equal tasks have equal answers.

    label : short description for people
    work : rough cost, in units that are the same for all tasks; orders them and tells how far they are
    question : everything that the answer depends on but for code, as JSON can hold it
    packages : whose code the answer depends on
    keeps_fields : whether the outcome has fields
    """

    label: str
    work: float
    question: Mapping[str, Any]
    packages: Sequence[str]
    keeps_fields: bool

    def solve(self) -> Outcome:
        """The answer."""

    def fits(self, outcome: Outcome) -> bool:
        """Whether a stored outcome is whole."""


def code_digest(folder: Path) -> str:
    """Digest of every Python source below a folder, or of one file: names and content."""
    paths = sorted(folder.rglob("*.py")) if folder.is_dir() else [folder]
    whole = hashlib.sha256()
    for path in paths:
        name = str(path.relative_to(folder)) if folder.is_dir() else path.name
        whole.update(f"{name}\0{path.stat().st_size}\0".encode())
        whole.update(path.read_bytes())
    return whole.hexdigest()


def key(task: Task) -> str:
    """Name of a task's file: digest of its question, of the code that answers it, and of versions."""
    everything = {
        "question": task.question,
        "code": [_package_digest(package) for package in task.packages],
        "versions": _versions(),
    }
    canonical = json.dumps(everything, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(canonical.encode()).hexdigest()


@dataclass(frozen=True)
class Store:
    """A folder of outcomes. A file appears whole or not at all; one that cannot be read counts as absent."""

    folder: Path

    def get(self, task: Task) -> Outcome | None:
        """The stored outcome of a task, or None: also for a task that keeps fields that are not there."""
        numbers, fields = self._path(task, "json"), self._path(task, "npz")
        try:
            content = json.loads(numbers.read_text(encoding="utf-8"))
            rows = tuple(_row_from_json(entry) for entry in content["rows"])
            outcome = Outcome(rows, _read_fields(fields) if task.keeps_fields else {})
            return outcome if task.fits(outcome) else None
        # A damaged archive raises nearly anything, from zlib.error to RuntimeError.
        except Exception:
            return None

    def put(self, task: Task, outcome: Outcome) -> None:
        """Write an outcome, fields first: the numbers alone say that a task is done."""
        self.folder.mkdir(parents=True, exist_ok=True)
        if outcome.fields or task.keeps_fields:
            write(self._path(task, "npz"), lambda file: np.savez_compressed(file, **outcome.fields))
        content = {"task": task.label, "rows": [_row_to_json(entry) for entry in outcome.rows]}
        text = json.dumps(content, indent=1, allow_nan=False)
        write(self._path(task, "json"), lambda file: file.write(text.encode()))

    def _path(self, task, suffix):
        return self.folder / f"{key(task)}.{suffix}"


def write(path: Path, fill: Callable[[IO[bytes]], Any]) -> None:
    """Write a file whole or not at all: `fill` gets a temporary file beside it, which then takes the name."""
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with os.fdopen(handle, "wb") as file:
            fill(file)
        os.chmod(name, 0o644)
        os.replace(name, path)
    except BaseException:
        os.unlink(name)
        raise


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


def _row_to_json(entry):
    """NaN and infinities are no JSON: they are stored as null, and come back as NaN."""
    content = asdict(entry)
    content["measures"] = {name: finite(value) for name, value in entry.measures.items()}
    content["settings"] = {name: finite(value) for name, value in entry.settings.items()}
    return content | {name: finite(content[name]) for name in NUMBERS}


def finite(value):
    """A value as JSON can hold it: None for NaN and infinities."""
    return None if isinstance(value, float) and not np.isfinite(value) else value


def _row_from_json(content):
    numbers = {name: _number(content[name]) for name in NUMBERS}
    measures = {name: _number(value) for name, value in content["measures"].items()}
    return Row(**numbers, measures=measures, settings=dict(content["settings"]), reason=content["reason"])


def _number(value):
    if value is None:
        return nan
    if not isinstance(value, int | float) or not np.isfinite(value):
        raise ValueError(f"{value!r} is no number that was stored")
    return float(value)


def _read_fields(path):
    with path.open("rb") as file, np.load(file, allow_pickle=False) as archive:
        return {name: archive[name] for name in archive.files}
