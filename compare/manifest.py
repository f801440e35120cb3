"""What a command leaves beside its page: how it was called, with which versions, and where what it solved lies."""

import json
import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from scene.reading import InvalidInput

from .publish import machine, versions, write_json

NAME = "manifest.json"


@dataclass(frozen=True)
class Manifest:
    """Of one folder.

    folder : that holds it
    command, arguments : what wrote it, and of what
    solved : folder of what was solved
    versions : of the packages then
    """

    folder: Path
    command: str
    arguments: Mapping[str, Any]
    solved: Path
    versions: Mapping[str, str]


def stamp(folder: Path, command: str, arguments: Mapping[str, Any], solved: Path) -> None:
    """Say in the manifest of a folder, which may hold more, what wrote it."""
    path = folder / NAME
    written = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
    how = {
        "command": command,
        "arguments": arguments,
        # The folder may be moved as a whole.
        "solved": Path(os.path.relpath(solved, folder)).as_posix(),
        "versions": versions(),
        "platform": machine(),
    }
    write_json(path, how | written)


def manifests(folder: str | Path) -> Iterator[Manifest]:
    """Of a folder, or of those just below it, as a folder of studies has. Raises InvalidInput if there is none."""
    folder = Path(folder)
    if not folder.is_dir():
        raise InvalidInput(f"{folder}: no such folder")
    own = folder / NAME
    paths = [own] if own.exists() else sorted(folder.glob(f"*/{NAME}"))
    if not paths:
        raise InvalidInput(f"{folder}: no {NAME} here or just below: no command left anything in it")
    for path in paths:
        yield _read(path)


def _read(path):
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        return Manifest(
            path.parent,
            content["command"],
            content["arguments"],
            path.parent / content["solved"],
            content["versions"],
        )
    except (OSError, ValueError, LookupError, TypeError) as error:
        raise InvalidInput(
            f"{path}: is none that a command of this version wrote, run the command again"
        ) from error
