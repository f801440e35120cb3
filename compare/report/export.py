"""Results of a folder for others: tables with units, surfaces for ParaView, figures for a journal."""

import inspect
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
from pydantic import ConfigDict, ValidationError, validate_call

from scene.printable import brief
from scene.reading import InvalidInput

from ..figures import style as looks
from ..figures.journals import COLUMNS
from ..figures.rendering import FORMS, picture
from ..solving import netcdf, parameter_grid
from ..solving.folders import hold
from ..solving.suggest import known
from ..solving.vocabulary import entry as vocabulary
from . import csvfiles, manifest, render, vtk
from .page import Plot, Tables

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
    in_a_look = any(each is not None for each in (journal, style, width))
    formats = [each.strip() for each in (format or (",".join(FORMS) if in_a_look else "csv")).split(",")]
    for each in formats:
        known("format", each, FORMATS)
    if "vtk" in formats:
        vtk.refuse()
    look = looks.Look(journal or "default", style, width)
    known("journal", look.journal, COLUMNS)
    try:
        with looks.applied(look):
            pass
    except (ValueError, KeyError, OSError) as error:
        raise InvalidInput(f"{error.args[0]}" if isinstance(error, KeyError) else str(error)) from error
    folder = Path(folder)
    below = folder.parent if folder.is_file() else folder
    tables, figures = (Path(output) if output else manifest.inside(below, each) for each in (TABLES, FIGURES))
    forms = [each for each in FORMS if each in formats]
    written = []
    for form, read in (("csv", _csv), ("vtk", _surfaces)):
        if form in formats:
            written += render.write(read(folder), tables)
    if forms:
        written += render.write(_drawn_again(folder, forms, look), figures)
    return written


def _csv(folder) -> dict[str, bytes]:
    """Every table of a folder, with units in the heads, as files by name."""
    tables = dict(_tables(folder))
    if not tables:
        raise InvalidInput(f"{brief(str(folder))}: holds no table")
    heads = {name: frame.rename(columns=lambda column: _head(str(column))) for name, frame in tables.items()}
    return {f"{name}.csv": csvfiles.text(frame).encode() for name, frame in heads.items()}


def _tables(folder: Path) -> Iterator[tuple[str, DataFrame]]:
    """Tables beside the pages of a folder, and everything that was solved, by the names of their files."""
    if not folder.is_file():
        for place, left in manifest.folders(folder):
            for path in (manifest.inside(place, name) for name in left.files if name.endswith(".csv")):
                if not (frame := csvfiles.read(path)).empty:
                    yield path.relative_to(folder).with_suffix("").as_posix(), frame
        if not any(folder.rglob(netcdf.NAME)):
            return
    for name, dataset in _solved(folder):
        yield from _flat(name, dataset)


def _solved(folder: Path) -> Iterator[tuple[str, xarray.Dataset]]:
    """Everything that was solved, by name."""
    for node in netcdf.load(folder).subtree:
        yield node.path.strip("/") or folder.stem, node.to_dataset(inherit=False)


def _flat(name: str, dataset: xarray.Dataset) -> Iterator[tuple[str, DataFrame]]:
    """A Dataset as one table for each set of dimensions, a row a point; what was not asked for is left out."""
    families: dict[tuple, list] = {}
    for variable, values in dataset.data_vars.items():
        families.setdefault(values.dims, []).append(variable)
    for dims, variables in families.items():
        frame = dataset[variables].to_dataframe().reset_index() if dims else DataFrame()
        if "status" in frame:
            frame = frame[frame["status"] != parameter_grid.NOT_ASKED]
        most = len(variables) == max(map(len, families.values()))
        if not frame.empty:
            yield name if most else f"{name}-{'-'.join(map(str, dims))}", frame


def _head(name: str) -> str:
    """Name of a column with its unit."""
    found = vocabulary(name)
    return name if found is None or found.unit in ("", "1") else f"{name} [{found.unit}]"


def _surfaces(folder) -> dict[str, bytes]:
    """A file for each Dataset with fields over y and x, by name."""
    with hold([folder]):
        found = {f"{name}{vtk.ENDING}": vtk.content(each) for name, each in _solved(folder)}
    if not any(found.values()):
        raise InvalidInput(f"{folder}: has no surface for vtk: crosscheck draw and crosscheck run write them")
    return {name: content for name, content in found.items() if content}


def _drawn_again(folder, forms, look) -> dict[str, bytes]:
    """Every figure of a folder, drawn from its tables in a look, as files by name."""
    found: dict[str, bytes] = {}
    for place, left in manifest.folders(folder):
        for entry in left.plots:
            drawn, name = _drawn(place, entry, forms, look), (place.relative_to(folder) / entry.name).as_posix()
            found |= {f"{name}.{form}": drawn[form] for form in forms}
    if not found:
        raise InvalidInput(f"{brief(str(folder))}: no command has written figures here")
    return found


def _drawn(folder, entry, forms, look) -> Mapping[str, bytes]:
    """Content of the files of one figure by form."""
    path = folder / manifest.NAME
    draw, below = function(entry, path), Path(entry.name).parent
    files = {name: manifest.inside(folder, (below / f"{name}.csv").as_posix()) for name in entry.tables}
    tables = {name: csvfiles.read(file) for name, file in files.items()}
    try:
        with looks.DRAWING, warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of numbers that no command has left
            return picture(Plot(entry.name, draw, tables, "", options=entry.options), forms, look).files
    except InvalidInput:
        raise
    except Exception as error:  # options or tables that were changed raise nearly anything
        where, why = folder, f" cannot be drawn from its tables: {brief(repr(error))}"
        if isinstance(error, ValidationError):
            first = error.errors()[0]
            where, why = path, f": option {brief('.'.join(map(str, first['loc'])))}: {first['msg']}"
        raise InvalidInput(f"{brief(str(where))}: figure {entry.name}{why}") from error


def function(entry: manifest.PlotEntry, path: Path) -> Callable[..., Figure]:
    """The function that draws a figure, which checks its options; InvalidInput of all that draws none here."""
    name = f"{entry.module}:{entry.function}"
    draw: Any = None
    if entry.module.startswith(f"{PACKAGE}."):
        with suppress(ImportError, AttributeError, ValueError):
            draw = resolve_name(name)
    stated = draw.__annotations__ if inspect.isfunction(draw) and draw.__module__ == entry.module else {}
    if not (stated.get("tables") in (Tables, "Tables") and stated.get("return") in (Figure, "Figure")):
        why = f"is drawn by {brief(name)}, which is no figure of {PACKAGE}: it cannot be drawn again"
        raise InvalidInput(f"{path}: figure {entry.name} {why}")
    return validate_call(config=ConfigDict(arbitrary_types_allowed=True, allow_inf_nan=False))(draw)
