"""Manifest of a folder: what wrote it, with which versions, and what lies in it."""

import json
import os
import platform
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationError
from pydantic_core import to_json

from scene.files import Unreadable, content
from scene.printable import brief
from scene.reading import InvalidInput

from ..solving.folder_format import FORMAT, UNSTATED, refuse_other
from ..solving.store import PACKAGES
from .csvfiles import write_text
from .page import Page, Plot

if TYPE_CHECKING:
    from ..solving.runner import SweepResult
    from ..studies.study import Study

NAME = "manifest.json"
FINDINGS = "findings"
VERSIONS = (*PACKAGES, "matplotlib", "pandas", "xarray", "pydantic")


# Most bytes of a file, which has the heights of measured maps in it; most items of a list, letters of a name.
MOST_BYTES, MOST_LISTED, MOST_LETTERS = 2**30, 10_000, 1000


def _of_folder(name: str) -> str:
    """The name of a file below a folder, with slashes between folders. Raises ValueError of any other."""
    if (
        not name.isprintable()
        or not 0 < len(name) <= MOST_LETTERS
        or set(name) & set("\\:")
        or {"", ".", ".."} & set(name.split("/"))
    ):
        raise ValueError(f"{brief(name)} names no file of the folder")
    return name


Name = Annotated[str, AfterValidator(_of_folder)]
Names = Annotated[tuple[Name, ...], Field(max_length=MOST_LISTED)]


class Format(BaseModel):
    """Part of the manifest that all versions have: the format of the folder."""

    format: int = UNSTATED


class PlotEntry(BaseModel):
    """A figure in a manifest: its name, the function that draws it from its tables, and the options of that."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    name: Name
    module: str
    function: str
    tables: Names
    options: dict[str, Any]


class Manifest(BaseModel):
    """Part of the manifest of a folder that is read; the file has more.

    plots : figures that can be drawn again
    tables : names of the CSV files, without ending
    """

    model_config = ConfigDict(extra="ignore", frozen=True)

    command: str
    plots: Annotated[tuple[PlotEntry, ...], Field(max_length=MOST_LISTED)]
    tables: Names


@dataclass(frozen=True)
class Folder:
    """A folder that a command left, and its manifest."""

    path: Path
    manifest: Manifest


def stamp(folder: Path, study: "Study", page: Page, swept: "SweepResult", solved: str) -> None:
    """Write the manifest of a folder, last of all: what it lists is there. Raises OSError."""
    left = {
        "format": FORMAT,
        "command": study.command,
        "title": page.title,
        "inputs": study.inputs,
        "versions": versions(),
        "platform": machine(),
        "solved": Path(solved).as_posix(),
        "tasks": {"solved": swept.solved, "reused": swept.reused},
        "seconds": swept.seconds,
        "plots": [_entry(plot) for plot in page.every(Plot)],
        "tables": list(dict.fromkeys([FINDINGS, *(name for name, _ in page.tables())])),
    }
    write_text(folder / NAME, json.dumps(_storable(left), indent=1, allow_nan=False, ensure_ascii=False))


def remove(folder: Path) -> None:
    """Take the manifest away, while what it lists is written anew. Raises OSError."""
    (folder / NAME).unlink(missing_ok=True)


def folders(folder: str | Path) -> Iterator[Folder]:
    """A folder with a manifest, or those just below it. Raises InvalidInput of none or a damaged one."""
    folder = Path(folder)
    if not folder.is_dir():
        raise InvalidInput(f"{brief(str(folder))}: no such folder")
    own = folder / NAME
    paths = [own] if own.exists() else sorted(folder.glob(f"*/{NAME}"))
    if not paths:
        raise InvalidInput(
            f"{brief(str(folder))}: no {NAME} here or one level below: no command has written this folder"
        )
    return (Folder(path.parent, _read(path)) for path in paths)


def inside(folder: Path, name: str) -> Path:
    """The path of a file below a folder by its name there. Raises InvalidInput of one that leads out of it."""
    path = folder / name
    try:
        _of_folder(name)
        if path.resolve().is_relative_to(folder.resolve()):
            return path
    except (OSError, RuntimeError, ValueError):  # of links in a circle, and of names that no file can have
        pass
    raise InvalidInput(f"{brief(str(path))}: leads out of {brief(str(folder))}")


def versions() -> dict[str, str]:
    """Versions of Python and of the packages that numbers and figures depend on."""
    return {"python": platform.python_version()} | {package: version(package) for package in VERSIONS}


def machine() -> dict[str, Any]:
    """Machine on which the numbers were computed."""
    return {"system": platform.system(), "machine": platform.machine(), "processors": os.cpu_count()}


def made() -> dict[str, str]:
    """Versions and machine that made a page, in words."""
    where = machine()
    return {
        "versions": ", ".join(f"{package} {number}" for package, number in versions().items()),
        "machine": f"{where['system']}, {where['machine']}, {where['processors']} processors",
    }


def _entry(plot):
    return PlotEntry(
        name=plot.name,
        module=plot.draw.__module__,
        function=plot.draw.__name__,
        tables=tuple(plot.tables),
        options=dict(plot.options),
    ).model_dump()


def _read(path):
    try:
        text = content(path, MOST_BYTES)
        refuse_other(path, Format.model_validate_json(text).format)
        return Manifest.model_validate_json(text)
    except Unreadable as error:
        raise InvalidInput(str(error)) from error
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(map(str, first["loc"]))
        reason = f"{brief(where)}: {first['msg']}" if where else first["msg"]
    raise InvalidInput(f"{brief(str(path))}: was not written by this version of the command: {reason}")


def _storable(value):
    """Value that JSON can hold: null for NaN, and a value unknown to JSON as its fields or as text."""
    return json.loads(to_json(value, inf_nan_mode="null", fallback=_plain))


def _plain(value):
    return value.tolist() if isinstance(value, np.ndarray | np.generic) else str(value)
