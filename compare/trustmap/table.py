"""Measurements behind the trust map, as tables: a row for each rough scene, its groups and its ratios."""

from __future__ import annotations

import gzip
import io
from collections.abc import Mapping
from dataclasses import fields
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .model import NAMES, Measurements
from .ratio import RATIOS, Ratio

if TYPE_CHECKING:
    import xarray

HERE = Path(__file__).parent
LEARNED, HELD_OUT = HERE / "learned.csv.gz", HERE / "held-out.csv.gz"
NUMBERS = tuple(each.name for each in fields(Ratio))
# Significant digits, far below the noise of a ratio.
DIGITS = 5


def column(quantity: str, number: str) -> str:
    """Name of the column of a number of a ratio."""
    return f"{quantity}_{number}"


COLUMNS = ("point", *NAMES, *(column(quantity, number) for quantity in RATIOS for number in NUMBERS))


def written(table: Mapping[str, np.ndarray]) -> bytes:
    """Table as compressed CSV; equal tables are equal bytes."""
    text = io.StringIO()
    text.write(",".join(COLUMNS) + "\n")
    for row in zip(*(table[name] for name in COLUMNS), strict=True):
        text.write(",".join("" if np.isnan(each) else f"{each:.{DIGITS}g}" for each in row) + "\n")
    return gzip.compress(text.getvalue().encode(), mtime=0)


@cache
def read(path: Path) -> dict[str, np.ndarray]:
    """Columns of a table by name; the same arrays each time."""
    with gzip.open(path, "rt") as file:
        names = file.readline().strip().split(",")
        rows = np.array([[float(each or "nan") for each in line.rstrip("\n").split(",")] for line in file])
    return dict(zip(names, rows.T, strict=True))


def columns(dataset: xarray.Dataset) -> dict[str, np.ndarray]:
    """Columns of a Dataset of scenes, as the tables have them, of the rough ones alone."""
    rough = dataset.isel(scene=np.isfinite(dataset["groups"].values).all(axis=1))
    found = {"point": rough["point"].values}
    found |= {name: rough["groups"].sel(group=name).values for name in NAMES}
    return found | {
        column(quantity, number): rough[number].sel(quantity=quantity).values
        for quantity in RATIOS
        for number in NUMBERS
    }


def groups(table: Mapping[str, np.ndarray]) -> np.ndarray:
    """Groups of all scenes (N, D), in the order of NAMES."""
    return np.stack([table[name] for name in NAMES], axis=1)


def measurements(table: Mapping[str, np.ndarray], quantity: str) -> tuple[np.ndarray, Measurements]:
    """Scenes that have the quantity, as numbers of rows, and what was measured of them."""
    rows = np.flatnonzero(table[column(quantity, "surfaces")] > 0)
    numbers = (table[column(quantity, number)][rows] for number in NUMBERS)
    return rows, Measurements(groups(table)[rows], *numbers)
