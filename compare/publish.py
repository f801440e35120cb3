"""What a person gets into hands: figures as files, tables as CSV, and pages that need nothing else."""

import base64
import csv
import io
import json
import os
import platform
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.metadata import version
from operator import methodcaller
from pathlib import Path
from types import ModuleType
from typing import Any

import jinja2
import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

from .plots import style
from .figures.curves import unlisted
from .plots.journals import journal as find_journal
from .store import finite, write

PACKAGES = ("mdr-bem-crosscheck", "numpy", "scipy", "ducc0", "pyfftw", "numba", "matplotlib", "pydantic")
DOTS_PER_INCH = 300
# What is said of a file, without the date: the same numbers give the same file.
FORMS: Mapping[str, Mapping[str, None]] = {"pdf": {"CreationDate": None}, "svg": {"Date": None}, "png": {}}


@dataclass(frozen=True)
class Drawn:
    """One figure on a page.

    name, caption : of the figure
    image : its PNG as base64; inches : its width
    sheets : names of its tables, as they lie beside it without .csv
    """

    name: str
    caption: str
    image: str
    inches: float
    sheets: tuple[str, ...] = ()


@contextmanager
def look(
    journal: str = "default",
    sheet: str | os.PathLike | Mapping[str, Any] | None = None,
    colours: Mapping[str, str] | None = None,
) -> Iterator[None]:
    """All figures drawn inside are made for a journal, in a style of one's own.

    journal : a name of plots.journals.JOURNALS
    sheet, colours : as of plots.style.Look
    ValueError where there is no such journal, style, solver or colour.
    """
    with style.chosen(style.Look(find_journal(journal), sheet, colours or {})):
        yield


def draw(
    folder: Path, module: ModuleType, data: Any, suffix: str = "", forms: Sequence[str] = tuple(FORMS)
) -> Drawn | None:
    """Write the figure of a module as PDF, SVG and PNG, its tables as CSV; None if there is nothing to show.

    Curves that no table has are those of NAME-drawn.csv, as they stand on the axes. Raises InvalidInput where the
    look has text too large for the figure.

    suffix : of all names, where one module draws several figures into the folder
    forms : of the files to write, of those three
    """
    name = module.NAME + suffix
    with style.applied(), style.fitting(name):
        drawing = module.figure(data)
        if drawing is None:
            return None
        image = save(folder, name, drawing, forms)
    tables = dict(module.sheets(data))
    if drawn := unlisted(drawing, tables):
        tables[f"{module.NAME}-drawn"] = drawn
    for sheet, content in tables.items():
        write_csv(folder / f"{sheet}{suffix}.csv", content)
    encoded = base64.b64encode(image).decode()
    names = tuple(f"{sheet}{suffix}" for sheet in tables)
    return Drawn(name, module.caption(data), encoded, float(drawing.get_figwidth()), names)


def save(folder: Path, name: str, drawing: Figure, forms: Sequence[str] = tuple(FORMS)) -> bytes:
    """Write a figure in some forms, the style applied; returns the PNG."""
    image = _rendered(drawing, "png")
    # All files in one layout, which takes as long to find as to draw.
    drawing.set_layout_engine("none")
    for form in forms:
        content = image if form == "png" else _rendered(drawing, form)
        write(folder / f"{name}.{form}", methodcaller("write", content))
    return image


def _rendered(drawing, form):
    """The bytes of a file. Vector files hold images, if any, at the resolution of the PNG."""
    file = io.BytesIO()
    with rc_context({"savefig.bbox": None}):  # of the width of the journal, whatever a style of one's own says
        drawing.savefig(file, format=form, dpi=DOTS_PER_INCH, metadata=dict(FORMS[form]))
    return file.getvalue()


def write_csv(path: Path, content: Mapping[str, Any] | Sequence[Mapping[str, Any]]) -> None:
    """Write rows as dictionaries, or columns of equal length; every digit is written."""
    if isinstance(content, Mapping):
        names = list(content)
        rows: Iterable[Sequence[Any]] = zip(*(np.asarray(c).tolist() for c in content.values()), strict=True)
    else:
        names = list(content[0]) if content else []
        rows = ([_number(row[name]) for name in names] for row in content)
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(names)
    writer.writerows(rows)
    write_text(path, text.getvalue())


def write_json(path: Path, content: Mapping[str, Any]) -> None:
    """Write what JSON can hold once null stands for NaN."""
    write_text(path, json.dumps(_storable(content), indent=1, allow_nan=False))


def write_text(path: Path, text: str) -> None:
    """Write a text whole or not at all."""
    write(path, lambda file: file.write(text.encode()))


def render(template: str, **content: Any) -> str:
    """A template of the folder `pages` as HTML: images are inside, what is linked lies beside it."""
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("compare", "pages"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
    )
    return environment.get_template(template).render(versions=versions(), platform=machine(), **content)


def versions() -> dict[str, str]:
    """Of Python and of the packages that numbers depend on."""
    return {"python": platform.python_version()} | {package: version(package) for package in PACKAGES}


def machine() -> dict[str, Any]:
    """What the numbers were computed on."""
    return {"system": platform.system(), "machine": platform.machine(), "processors": os.cpu_count()}


def _number(value):
    return value.item() if isinstance(value, np.generic) else value


def _storable(value):
    if isinstance(value, Mapping):
        return {name: _storable(entry) for name, entry in value.items()}
    if isinstance(value, list | tuple):
        return [_storable(entry) for entry in value]
    return finite(_number(value))
