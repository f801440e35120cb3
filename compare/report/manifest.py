"""Manifest of a folder: what wrote it, with which versions, and what lies in it."""

import os
import platform
from collections.abc import Iterable, Iterator
from contextlib import suppress
from importlib.metadata import version
from operator import methodcaller
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pydantic import ConfigDict
from pydantic.dataclasses import dataclass
from pydantic_core import to_json

from scene.files.reading import InvalidInput
from scene.printable import brief

from ..figures.plot import Plot
from ..solving.digest import PACKAGES
from ..solving.folders import FORMAT, Stated, clear, read, write
from ..solving.folders import MANIFEST as NAME
from .page import Page

if TYPE_CHECKING:
    from ..solving.runner import SweepResult
    from ..studies.study import Study

VERSIONS = (*PACKAGES, "matplotlib", "pandas", "xarray", "pydantic")
# Endings of files that a run writes together with its page, and that the next run in the folder may remove.
OURS = (".html", ".csv", ".nc", ".png", ".pdf", ".svg")


@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class PlotEntry:
    """A figure in a manifest: its name, the function that draws it from its tables, and the options of that."""

    name: str
    module: str
    function: str
    tables: tuple[str, ...]
    options: dict[str, Any]


class Manifest(Stated):
    """Part of the manifest of a folder that is read; the file has more.

    plots : figures that can be drawn again
    files : all other files that the run wrote; of an unfinished run, also those of the runs before it
    """

    model_config = ConfigDict(extra="ignore", frozen=True)

    command: str
    plots: tuple[PlotEntry, ...]
    files: tuple[str, ...] = ()


def begin(folder: Path, study: "Study", files: Iterable[str]) -> None:
    """Take away what earlier runs wrote into a folder; until its stamp, the manifest says that a run is under way.

    files : names of what this run will write. Killed at any instant, it leaves a folder that is refused, and whose
        files the next run knows. Raises OSError.
    """
    earlier: tuple[str, ...] = ()
    with suppress(InvalidInput):
        earlier = read(folder / NAME, Manifest, finished=False).files
    listed = list(dict.fromkeys([*earlier, *files]))
    _write(folder, {"finished": False, "command": study.command, "plots": [], "files": listed})
    for name in earlier:
        with suppress(InvalidInput):  # the name may lead out of the folder by now
            path = inside(folder, name)
            if path.suffix in OURS and path.is_file():
                path.unlink()
            clear(path.parent)
            with suppress(OSError):
                path.parent.rmdir()  # where nothing else is in it


def stamp(
    folder: Path,
    study: "Study",
    page: Page,
    swept: "SweepResult",
    solved: str,
    files: Iterable[str],
) -> None:
    """Write the manifest of a folder, last of all: what it lists is there. Raises OSError.

    solved : folder of what has been solved, from here; files : see `begin`
    """
    left = {
        "command": study.command,
        "title": page.title,
        "inputs": study.inputs,
        "versions": versions(),
        "platform": machine(),
        "solved": Path(solved).as_posix(),
        "tasks": {"solved": swept.solved, "reused": swept.reused},
        "seconds": swept.seconds,
        "plots": [
            PlotEntry(plot.name, plot.draw.__module__, plot.draw.__name__, tuple(plot.tables), plot.options)
            for plot in page.every(Plot)
        ],
        "files": list(files),
    }
    _write(folder, left)


def _write(folder, left):
    write(folder / NAME, methodcaller("write", json_of({"format": FORMAT} | left).encode()))


def json_of(found: Any) -> str:
    """JSON of anything: null for a number that is not known or not finite, and what JSON does not have as text."""
    return to_json(found, indent=1, inf_nan_mode="null", fallback=_plain).decode()


def _plain(value):
    return value.tolist() if hasattr(value, "tolist") else str(value)


def folders(folder: str | Path) -> Iterator[tuple[Path, Manifest]]:
    """A folder and its manifest, or those just below it.

    Raises InvalidInput where there is no manifest or a damaged one, and where the run has not come to its end.
    """
    folder = Path(folder)
    if not folder.is_dir():
        raise InvalidInput(f"{brief(str(folder))}: no such folder")
    own = folder / NAME
    paths = [own] if own.exists() else sorted(folder.glob(f"*/{NAME}"))
    if not paths:
        raise InvalidInput(
            f"{brief(str(folder))}: no {NAME} here or one level below: no command has written this folder"
        )
    for path in paths:
        yield path.parent, read(path, Manifest)


def inside(folder: Path, name: str) -> Path:
    """The path of a file below a folder by its name there. Raises InvalidInput if it leads out of the folder."""
    path, odd = folder / name, set(name) & set("\\:") or {"", ".", ".."} & set(name.split("/"))
    try:
        if name.isprintable() and not odd and path.resolve().is_relative_to(folder.resolve()):
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
