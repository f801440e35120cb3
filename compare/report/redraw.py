"""Figures drawn again from their tables, for a journal or in a style of one's own; nothing is solved or judged."""

import inspect
import warnings
from collections.abc import Callable, Mapping
from dataclasses import replace
from importlib import import_module
from os import PathLike
from pathlib import Path
from pkgutil import walk_packages
from typing import Any, get_type_hints

from matplotlib.figure import Figure
from pydantic import ConfigDict, ValidationError, create_model

from scene.printable import brief
from scene.quantities import METRE, argument
from scene.reading import InvalidInput

from ..solving.folders import hold
from . import csvfiles, manifest, render
from .page import Plot
from .plots import style as looks
from .plots.journals import MILLIMETRE, Journal
from .plots.journals import journal as find_journal
from .plots.rendering import FORMS, picture

PACKAGE = __name__.partition(".")[0]
FIGURES = "figures"
# Of columns [mm], from that of the narrowest journal on: narrower ones cut titles.
WIDTHS = 80, 200
TABLES = "tables"  # of a function that draws: its first argument; all others are options


def redraw(
    folder: str | Path,
    journal: str = "default",
    style: str | PathLike | Mapping[str, Any] | None = None,
    output: str | Path | None = None,
    told: Callable[[str], Any] = lambda name: None,
    width: str | float | None = None,
) -> list[Path]:
    """Draw every figure of a folder again as PDF, SVG and PNG; returns the files.

    folder : that a command left, or that has such folders
    journal : a name of compare.report.plots.journals.JOURNALS
    style : a style of matplotlib on top: a file, a name, or settings
    output : where to; `figures` in the folder if absent
    told : called with the name of each figure that is drawn
    width : of a column, see `in_columns`; that of the journal if absent

    Raises InvalidInput where there is nothing to draw, a file is damaged or a run holds the folder, or for no such
    journal, width or style.
    """
    target = manifest.inside(Path(folder), FIGURES) if output is None else Path(output)
    drawn = []
    try:
        found = find_journal(journal)
        chosen = looks.chosen(looks.Look(found if width is None else in_columns(found, width), style))
        with chosen:
            for each in manifest.folders(folder):
                place = each.path.relative_to(folder).as_posix()
                with hold([each.path]):
                    for entry in each.manifest.plots:
                        told(entry.name)
                        name = entry.name if place == "." else f"{place}/{entry.name}"
                        drawn += _draw(each.path, entry, manifest.inside(target, name))
    except InvalidInput:
        raise
    except ValueError as error:
        raise InvalidInput(str(error)) from error
    if not drawn:
        raise InvalidInput(f"{brief(str(folder))}: no command has written figures here")
    return drawn


def in_columns(journal: Journal, width: str | float) -> Journal:
    """A journal with columns of a width, as "84 mm" or in metres, and its page as much wider or narrower.

    Raises ValueError of one that is no length or out of WIDTHS.
    """
    metres = float(argument("width", width, METRE.value))
    if not WIDTHS[0] <= 1e3 * metres <= WIDTHS[1]:
        raise ValueError(f"width = {brief(repr(width))}: {WIDTHS[0]} mm to {WIDTHS[1]} mm are allowed")
    column = 1e3 * metres * MILLIMETRE
    return replace(journal, single=column, double=column / journal.single * journal.double)


def _draw(folder: Path, entry: manifest.PlotEntry, target: Path) -> list[Path]:
    """The files of one figure; target : their path without ending."""
    draw = function(entry, folder / manifest.NAME)
    chosen = options(draw, entry, folder / manifest.NAME)
    below = entry.name.rpartition("/")[0]
    tables = {
        name: csvfiles.read(manifest.inside(folder, f"{below}/{name}.csv".lstrip("/"))) for name in entry.tables
    }
    plot = Plot(entry.name, draw, tables, "", options=chosen)
    try:
        with looks.DRAWING, warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of numbers that no command has left
            drawn = picture(plot, FORMS)
    except InvalidInput:
        raise
    # A function of a table that was changed raises nearly anything.
    except Exception as error:
        raise InvalidInput(
            f"{folder}: figure {entry.name} cannot be drawn from its tables: {brief(repr(error))}"
        ) from error
    return render.write(drawn.named(target.name), target.parent)


def function(entry: manifest.PlotEntry, path: Path) -> Callable[..., Figure]:
    """The function that draws a figure. InvalidInput of any but those of this package that make one of tables."""
    if entry.module in {found.name for found in walk_packages(import_module(PACKAGE).__path__, f"{PACKAGE}.")}:
        draw = getattr(import_module(entry.module), entry.function, None)
        if (
            inspect.isfunction(draw)
            and draw.__module__ == entry.module
            and draw.__annotations__.get("return") in (Figure, "Figure")
            and next(iter(inspect.signature(draw).parameters), None) == TABLES
            and not entry.function.startswith("_")
        ):
            return draw
    raise InvalidInput(
        f"{path}: figure {entry.name} is drawn by {brief(f'{entry.module}.{entry.function}')}, which is no "
        f"figure of {PACKAGE}: it cannot be drawn again"
    )


def options(draw: Callable[..., Figure], entry: manifest.PlotEntry, path: Path) -> dict[str, Any]:
    """The options of a figure, as its function states their names, types and defaults. InvalidInput of others."""
    kinds = get_type_hints(draw)
    fields: dict[str, Any] = {
        name: (kinds[name], ... if each.default is each.empty else each.default)
        for name, each in inspect.signature(draw).parameters.items()
        if name != TABLES
    }
    config = ConfigDict(extra="forbid", allow_inf_nan=False)
    try:
        return dict(create_model(draw.__name__, __config__=config, **fields).model_validate(entry.options))
    except ValidationError as error:
        first = error.errors()[0]
        where = brief(".".join(map(str, first["loc"])))
        raise InvalidInput(f"{brief(str(path))}: figure {entry.name}: option {where}: {first['msg']}") from error
