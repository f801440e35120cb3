"""Results of a folder for others: surfaces for ParaView, figures for a journal."""

import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from os import PathLike
from pathlib import Path
from pkgutil import resolve_name
from typing import Any

import xarray
from matplotlib.figure import Figure

from scene.files.reading import InvalidInput
from scene.printable import brief

from ..figures import style as looks
from ..figures.plot import FORMS, Picture, Plot, picture
from ..solving import netcdf
from ..solving.suggest import known
from . import csvfiles, manifest, render, vtk

FORMATS = ("vtk", *FORMS)
FIGURES = "figures"  # folder that is written into
PACKAGE = __name__.partition(".")[0]


def export(
    folder: str | Path,
    format: str | None = None,
    journal: str | None = None,
    style: str | PathLike | Mapping[str, Any] | None = None,
    width: str | float | None = None,
    output: str | Path | None = None,
) -> list[Path]:
    """Write results of a folder into files; returns them. The arguments are those of `compare.export`.

    Raises InvalidInput where there is nothing of the kind, a file is damaged, or a format, journal, style or width
    is not known; Refused of vtk without its extra; OSError for what cannot be written.
    """
    formats = [each.strip() for each in (format or ",".join(FORMS)).split(",")]
    for each in formats:
        known("format", each, FORMATS)
    if "vtk" in formats:
        vtk.refuse()
    if not isinstance(style, str | PathLike | Mapping | None):
        raise InvalidInput(f"style = {style!r}: a file .mplstyle, the name of a style of matplotlib, or settings")
    look = looks.Look(journal or "default", style, width)
    known("journal", look.journal, looks.COLUMNS)
    try:
        with looks.applied(look):
            pass
    except (ValueError, KeyError, OSError) as error:
        raise InvalidInput(f"{error.args[0]}" if isinstance(error, KeyError) else str(error)) from error
    folder = Path(folder)
    below = folder.parent if folder.is_file() else folder
    place = Path(output) if output else manifest.inside(below, FIGURES)
    found = _surfaces(folder) if "vtk" in formats else {}
    if forms := [each for each in FORMS if each in formats]:
        found |= _drawn_again(folder, forms, look)
    return render.write(found, place)


def _solved(folder: Path) -> Iterator[tuple[str, xarray.Dataset]]:
    """Everything that was solved, by name."""
    for node in netcdf.load(folder).subtree:
        yield node.path.strip("/") or folder.stem, node.to_dataset(inherit=False)


def _surfaces(folder) -> dict[str, bytes]:
    """A file for each Dataset with fields over y and x, by name."""
    contents = {f"{name}{vtk.ENDING}": vtk.content(each) for name, each in _solved(folder)}
    if found := {name: content for name, content in contents.items() if content}:
        return found
    raise InvalidInput(f"{folder}: has no surface for vtk: crosscheck draw and crosscheck run write them")


def _drawn_again(folder, forms, look) -> dict[str, bytes]:
    """Every figure of a folder, drawn from its tables in a look, as files by name."""
    found: dict[str, bytes] = {}
    for place, left in manifest.folders(folder):
        for entry in left.plots:
            found |= _drawn(place, entry, forms, look).named((place.relative_to(folder) / entry.name).as_posix())
    if not found:
        raise InvalidInput(f"{brief(str(folder))}: no command has written figures here")
    return found


def _drawn(folder, entry, forms, look) -> Picture:
    """One figure, drawn from its tables."""
    path = folder / manifest.NAME
    draw = function(entry, path)
    tables = {
        name: csvfiles.read(manifest.inside(folder, str(Path(entry.name).with_name(f"{name}.csv"))))
        for name in entry.tables
    }
    try:
        with looks.DRAWING, warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of numbers that no command has left
            return picture(Plot(entry.name, draw, tables, "", options=entry.options), forms, look)
    except InvalidInput:
        raise
    except Exception as error:  # options or tables that were changed raise nearly anything
        why = f"cannot be drawn from its tables: {brief(repr(error))}"
        raise InvalidInput(f"{brief(str(path))}: figure {entry.name}: {why}") from error


def function(entry: manifest.PlotEntry, path: Path) -> Callable[..., Figure]:
    """The function that draws a figure. Raises InvalidInput of all that draws none here."""
    draw: Any = None
    if entry.module.startswith(f"{PACKAGE}."):
        with suppress(ImportError, AttributeError, ValueError):
            draw = resolve_name(f"{entry.module}:{entry.function}")
    if getattr(draw, "__annotations__", {}).get("return") not in (Figure, "Figure"):
        why = f"is drawn by {brief(entry.module)}:{brief(entry.function)}, which is no figure of {PACKAGE}"
        raise InvalidInput(f"{path}: figure {entry.name} {why}: it cannot be drawn again")
    return draw
