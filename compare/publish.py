"""What a person gets into hands: figures as files, tables as CSV, and pages that need nothing else."""

import base64
import csv
import io
import json
import os
import platform
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from types import ModuleType
from typing import Any

import jinja2
import numpy as np
from matplotlib.figure import Figure

from .figures import style
from .store import finite, write

PACKAGES = ("mdr-bem-crosscheck", "numpy", "scipy", "ducc0", "pyfftw", "numba", "matplotlib", "pydantic")
DOTS_PER_INCH = 220


@dataclass(frozen=True)
class Drawn:
    """One figure on a page: name, caption, its PNG as base64, and its width [inch]."""

    name: str
    caption: str
    image: str
    inches: float


def draw(folder: Path, module: ModuleType, data: Any, suffix: str = "") -> Drawn | None:
    """Write the figure of a module as PDF and PNG, its tables as CSV; None if there is nothing to show.

    suffix : of all names, where one module draws several figures into the folder
    """
    name = module.NAME + suffix
    with style.applied():
        drawing = module.figure(data)
        if drawing is None:
            return None
        image = save(folder, name, drawing)
    for sheet, content in module.sheets(data).items():
        write_csv(folder / f"{sheet}{suffix}.csv", content)
    encoded = base64.b64encode(image).decode()
    return Drawn(name, module.caption(data), encoded, drawing.get_figwidth())


def save(folder: Path, name: str, drawing: Figure) -> bytes:
    """Write a figure as PDF and PNG, the style applied; returns the PNG."""
    image = io.BytesIO()
    drawing.savefig(image, format="png", dpi=DOTS_PER_INCH)
    # Both files in one layout, which takes as long to find as to draw.
    drawing.set_layout_engine("none")
    write(folder / f"{name}.png", lambda file: file.write(image.getvalue()))
    # Without the date the same numbers give the same file.
    write(
        folder / f"{name}.pdf",
        lambda f: drawing.savefig(f, format="pdf", metadata={"CreationDate": None}, dpi=DOTS_PER_INCH),
    )
    return image.getvalue()


def write_csv(path: Path, content: Mapping[str, Any] | Sequence[Mapping[str, Any]]) -> None:
    """Write rows as dictionaries, or columns of equal length; every digit is written."""
    if isinstance(content, Mapping):
        names, rows = list(content), zip(*(np.asarray(c).tolist() for c in content.values()), strict=True)
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
