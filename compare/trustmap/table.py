"""Measurements behind the trust map as tables, a row for each rough scene, and the models fitted to them."""

from __future__ import annotations

import gzip
import json
from collections.abc import Mapping
from dataclasses import fields
from functools import cache
from pathlib import Path

import numpy as np

from .model import NAMES, Fitted, Measurements, Model
from .regression import Scales

HERE = Path(__file__).parent
LEARNED, HELD_OUT = HERE / "learned.csv.gz", HERE / "held-out.csv.gz"
NUMBERS = tuple(each.name for each in fields(Measurements))[1:]


def column(quantity: str, number: str) -> str:
    """Name of the column of a number of a ratio."""
    return f"{quantity}_{number}"


@cache
def read(path: Path) -> dict[str, np.ndarray]:
    """Columns of a table by name; the same arrays each time."""
    with gzip.open(path, "rt") as file:
        names = file.readline().strip().split(",")
        rows = np.array([[float(each or "nan") for each in line.rstrip("\n").split(",")] for line in file])
    return dict(zip(names, rows.T, strict=True))


def groups(table: Mapping[str, np.ndarray]) -> np.ndarray:
    """Groups of all scenes (N, D), in the order of NAMES."""
    return np.stack([table[name] for name in NAMES], axis=1)


def measurements(table: Mapping[str, np.ndarray], quantity: str) -> tuple[np.ndarray, Measurements]:
    """Scenes that have the quantity, as numbers of rows, and what was measured of them."""
    rows = np.flatnonzero(table[column(quantity, "surfaces")] > 0)
    numbers = (table[column(quantity, number)][rows] for number in NUMBERS)
    return rows, Measurements(groups(table)[rows], *numbers)


FITTED = Path(__file__).with_name("fitted.json")


@cache
def model(quantity: str) -> Model:
    """Model of friction, depth or force; the same object each time."""
    stored = json.loads(FITTED.read_text(encoding="utf-8"))[quantity]
    process, scatter = (_scales(**stored[each]) for each in ("process", "scatter"))
    errors, widening, parts = (np.array(stored[each]) for each in ("errors", "widening", "parts"))
    fitted = Fitted(process, np.array(stored["taken"]), scatter, errors, widening, parts)
    return Model.of(quantity, measurements(read(LEARNED), quantity)[1], fitted)


def _scales(middle, spread, lengths, **numbers) -> Scales:
    return Scales(np.array(middle), np.array(spread), np.array(lengths), **numbers)
