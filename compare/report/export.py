"""Results of a folder for others: tables with units, surfaces for ParaView, figures for a journal."""

import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from os import PathLike
from pathlib import Path
from pkgutil import resolve_name
from typing import Any

import xarray
from matplotlib.figure import Figure
from pandas import DataFrame

from scene.files.reading import InvalidInput
from scene.printable import brief

from ..figures import style as looks
from ..figures.plot import FORMS, Picture, Plot, picture
from ..solving import curve, netcdf
from ..solving.suggest import known
from ..solving.vocabulary import entry as vocabulary
from . import csvfiles, manifest, render, vtk

FORMATS = ("csv", "vtk", *FORMS)
TABLES, FIGURES = "tables", "figures"  # folders that are written into
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

    Raises InvalidInput where there is nothing of the kind, a file is damaged, a run holds the folder, or a format,
    journal, style or width is not known; Refused of vtk without its extra; OSError for what cannot be written.
    """
    in_a_look = (journal, style, width) != (None, None, None)
    formats = [each.strip() for each in (format or (",".join(FORMS) if in_a_look else "csv")).split(",")]
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
    tables, figures = (Path(output) if output else manifest.inside(below, each) for each in (TABLES, FIGURES))
    found = {} if "csv" not in formats else _csv(folder)
    if "vtk" in formats:
        found |= _surfaces(folder)
    forms = [each for each in FORMS if each in formats]
    drawn = _drawn_again(folder, forms, look) if forms else {}
    return [*render.write(found, tables), *render.write(drawn, figures)]


def _csv(folder) -> dict[str, bytes]:
    """Tables beside the pages of a folder and of what was solved, with units in the heads, as files by name."""
    tables: dict[str, DataFrame] = {}
    if folder.is_dir():
        for place, left in manifest.folders(folder):
            paths = [manifest.inside(place, name) for name in left.files if name.endswith(".csv")]
            tables |= {path.relative_to(folder).as_posix(): csvfiles.read(path) for path in paths}
    if not folder.is_dir() or any(folder.rglob(netcdf.NAME)):
        for name, dataset in _solved(folder):
            tables |= {f"{each}.csv": frame for each, frame in _flat(name, dataset)}
    filled = {name: frame.rename(columns=_head) for name, frame in tables.items() if not frame.empty}
    if not filled:
        raise InvalidInput(f"{brief(str(folder))}: holds no table")
    return {name: csvfiles.text(frame).encode() for name, frame in filled.items()}


def _solved(folder: Path) -> Iterator[tuple[str, xarray.Dataset]]:
    """Everything that was solved, by name."""
    for node in netcdf.load(folder).subtree:
        yield node.path.strip("/") or folder.stem, node.to_dataset(inherit=False)


def _flat(name: str, dataset: xarray.Dataset) -> Iterator[tuple[str, DataFrame]]:
    """A Dataset as one table for each set of dimensions, a row a point; what was not asked for is left out."""
    families: dict[tuple, list] = {}
    for variable, values in dataset.data_vars.items():
        families.setdefault(values.dims, []).append(variable)
    largest = max(map(len, families.values()), default=0)
    for dims, variables in families.items():
        frame = dataset[variables].to_dataframe().reset_index() if dims else DataFrame()
        if "status" in frame:
            frame = frame[frame["status"] != curve.NOT_ASKED]
        yield name if len(variables) == largest else "-".join([name, *dims]), frame


def _head(name) -> str:
    """Name of a column with its unit."""
    found = vocabulary(name)
    return name if found is None or found.unit in ("", "1") else f"{name} [{found.unit}]"


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
