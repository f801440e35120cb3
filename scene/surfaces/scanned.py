"""What a measured map may be given as, and how it is prepared: read, laid out, cleaned."""

from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any, Literal

import numpy as np
from pydantic import model_validator
from pydantic.dataclasses import dataclass

from ..files.heightfile import LINE, MAP, read_heights
from ..files.stated import FORM, TableFormat, alternatives, restated, split_format
from ..printable import brief
from ..quantities import Length
from .heightmap import LEAST, HeightMap, MapHeights, Pixel, sides
from .missing import cleaned_heights

QUOTIENT = 1e-12  # rounding of a quotient of lengths
FILL = ("refuse", "fill")
# What is asked of heights before they are a map or a line; no fields: what comes of it is in the heights.
ASKED = "file", "unit", "channel", "missing"


_TEXT = {"type": "string"}
OF_A_FILE: dict[str, Any] = FORM | {"file": _TEXT, "unit": _TEXT, "channel": _TEXT, "missing": {"enum": [*FILL]}}
MAPPED = alternatives("heights", "pixel", **OF_A_FILE)


@dataclass(frozen=True, config=MAPPED, kw_only=True)
class Scanned:
    """Measured map of heights.

    heights : rows along y of heights along x [m], both ascending; of xarray, with the dimensions y and x; or
        points as columns x, y and z of a table
    pixel : side of a pixel [m]; of pixels that are no squares, along x and along y
    peaks : "up", heights grow towards the elastomer, as instruments give them, and the highest point touches
        first; "down", they are those of an indenter above the elastomer, and the lowest touches first
    shortest_kept : waves shorter than this are left out [m]; absent, every wave of the map is kept

    In place of heights `file` is the path of a file, read once and kept as numbers, see `heightfile`. `pixel`, and
    `unit` of the heights, are needed where the file does not state them, and `channel` where it has several maps.
    `skip`, `rows`, `separator`, `decimal`, `encoding`, `columns`, `units` and `where` state what differs of a
    text, see `stated.TableFormat`.

    Before heights are a map:

    missing : "fill", heights that are missing, NaN, masked or a number far off that stands for none, are filled in
        harmonically, a twentieth of the pixels at most; "refuse", the default, they are an error

    `notes` say what was done. Raises ValueError for what is none of these.
    """

    heights: MapHeights
    pixel: Pixel
    peaks: Literal["up", "down"] = "up"
    shortest_kept: Length | None = None

    _prepared = restated(lambda cls, stated: prepared(cls, stated, HeightMap, "pixel"))

    @model_validator(mode="after")
    def _waves_kept(self):
        if self.shortest_kept is not None:
            least, most = self.keepable
            if not least * (1 - QUOTIENT) <= self.shortest_kept <= most:
                raise ValueError(
                    f"shortest_kept = {self.shortest_kept:g} m: from two pixels, {least:g} m, to half of what "
                    f"repeats, {most:g} m"
                )
        return self

    @property
    def keepable(self) -> tuple[float, float]:
        """Least and greatest `shortest_kept` [m]: two pixels, and half of what repeats."""
        return 2 * max(self.pixel), min(self.sides) / 2

    @property
    def notes(self) -> tuple[str, ...]:
        """Lines on what was done to the heights before they were a map, and on what of a file was not used."""
        return self.heights.notes

    @property
    def size(self) -> tuple[float, float]:
        """Sides of the map, along x and along y [m]."""
        rows, columns = self.heights.shape
        return columns * self.pixel[0], rows * self.pixel[1]

    @property
    def sides(self) -> tuple[float, float]:
        """Sides of the rectangle that repeats, the map with its mirror images, along x and along y [m]."""
        return 2 * self.size[0], 2 * self.size[1]

    def _turned(self) -> np.ndarray:
        """Heights above the elastomer, from whatever level (rows, columns) [m]."""
        return -self.heights.heights if self.peaks == "up" else self.heights.heights


def prepared(cls: Any, stated: dict[str, Any], kind: type[HeightMap], spacing: str) -> dict[str, Any]:
    """Fields of a part whose heights are a map or a line: read and cleaned as stated.

    kind : HeightMap or HeightLine; spacing : field with the pixel or the spacing

    What are no heights is left to its field to refuse, and so is a spacing that is none. Raises ValueError.
    """
    if not ("file" in stated or "heights" in stated):
        return stated
    written, stated = split_format(stated)
    asked = {name: stated[name] for name in ASKED if stated.get(name) is not None}
    left = {name: each for name, each in stated.items() if name not in ASKED}
    path, heights = asked.pop("file", None), left.get("heights")
    if path is not None and heights is not None:
        raise ValueError(f"file = {brief(repr(path))} and heights are both stated: give one of them")
    if left.keys() - {each.name for each in fields(cls)}:
        # First what is misspelt: another map may be meant.
        return {spacing: 1.0} | left | {"heights": kind(np.eye(LEAST) if kind is HeightMap else np.zeros(1))}
    plain = not (isinstance(heights, Mapping) or hasattr(heights, "columns") or hasattr(heights, "dims"))
    if isinstance(heights, str) or (path is None and plain and not asked and written == TableFormat()):
        return left
    if isinstance(heights, HeightMap):
        if {"unit", "channel"} & asked.keys() or written != TableFormat():
            raise ValueError("heights are in metres: unit, channel and what is stated of a text are for a file")
        numbers, notes = heights.heights, heights.notes
    else:
        if not isinstance(path, str | Path | None):
            raise ValueError(f"file = {brief(repr(path))}: a path is needed")
        source, units = heights if path is None else Path(path), written.units or {}
        if "unit" in asked and "z" in units:
            raise ValueError(f"unit = {asked['unit']!r} and units = {{z = {units['z']!r}}}: state one of them")
        unit, dims = asked.get("unit", units.get("z")), MAP if kind is HeightMap else LINE
        numbers, left[spacing], notes = read_heights(
            source, dims, left.get(spacing), unit, asked.get("channel"), written
        )
    try:
        kind.check_layout(numbers.shape, numbers.dtype)
        numbers, more = _cleaned(numbers.astype(float), left.get(spacing), asked)
        return left | {"heights": kind(numbers, (*notes, *more))}
    except ValueError as error:
        raise error if path is None else ValueError(f"file = {brief(repr(str(path)))}: {error}") from None


def _cleaned(heights, pixel, asked):
    """Heights filled in as stated, and what was done, in lines."""
    if (missing := asked.get("missing")) not in (None, *FILL):
        raise ValueError(f"missing = {brief(repr(missing))}: 'refuse' or 'fill'")
    if missing != "fill":
        return heights, ()
    try:
        pixel = sides(pixel)
    except ValueError:
        return heights, ()
    return cleaned_heights(heights, pixel)
