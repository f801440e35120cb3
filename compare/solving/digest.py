"""Digests that name stored answers: of the question, and of the code, tables and versions that answer it."""

import hashlib
import json
import sys
from collections.abc import Sequence
from fnmatch import fnmatchcase
from functools import cache
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from .task import Task

PACKAGES = ("mdr-bem-crosscheck", "numpy", "scipy", "ducc0", "pyfftw", "numba")
DIGEST = 32  # letters of a digest
# Names of files and folders in a package that no wheel has: left by Python, by editors, by merges.
UNSHIPPED = ("__pycache__", ".*", "*~", "#*#", "*.bak", "*.orig", "*.rej")


def key(task: Task) -> str:
    """Name of the answer to a task: digest of its question, then of the code that answers it and of versions."""
    return f"{digest(canonical(task.question).encode())}-{_code_digest(tuple(task.packages))}"


def canonical(value: Any) -> str:
    """Text as JSON, which is the same for equal values on every platform; NaN and infinities are named."""
    return json.dumps(value, sort_keys=True, separators=(",", ":"))


def digest(content: bytes) -> str:
    """Digest of some bytes."""
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
    """Digest of the names and contents of all files that a package ships, or of a single file.

    places : one or more folders of the package, or the file

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
    return digest(canonical(code_of(packages)).encode())


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
