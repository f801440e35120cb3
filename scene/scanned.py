"""What a measured map may be given as, and how it is prepared: read, laid out, cropped, mended."""

from collections.abc import Mapping
from dataclasses import fields
from typing import Any, Literal

import numpy as np
from pydantic import ConfigDict, model_validator
from pydantic.dataclasses import dataclass

from .heading import named
from .heightmap import HeightMap, Heights, Pixel, unmasked
from .labelled import is_labelled, rows_along_y
from .missing import LEAST_DEVIATIONS, mended
from .plain import bare
from .printable import brief
from .quantities import BARE, CLOSED, METRE, Length, argument, by_name
from .scan import LEAST, UNITS, check_layout, metres, picked, sides

QUOTIENT = 1e-12  # rounding of a quotient of lengths
FILL = ("refuse", "fill")
# What is asked of a map before it is one; no fields: what comes of it is in the heights.
ASKED = ("file", "unit", "channel", "crop", "missing", "outliers")


def _or_file(schema: dict[str, Any]) -> None:
    """In JSON schema: a file in place of heights, and what is asked of either."""
    length = next(each for each in schema["properties"]["pixel"]["anyOf"] if each.get("type") != "array")
    schema["properties"] |= {
        "file": {"type": "string"},
        "unit": {"enum": [*UNITS, "µm"]},
        "channel": {"type": "string"},
        "crop": {"type": "array", "items": length, "minItems": 4, "maxItems": 4},
        "missing": {"enum": list(FILL), "default": FILL[0]},
        "outliers": {"type": "number", "minimum": LEAST_DEVIATIONS},
    }
    del schema["required"]
    schema["anyOf"] = [{"required": ["file"]}, {"required": ["heights", "pixel"]}]


MAPPED = ConfigDict(**CLOSED, json_schema_extra=_or_file)


@dataclass(frozen=True, config=MAPPED, kw_only=True)
class Scanned:
    """Measured map of heights.

    heights : rows along y of heights along x [m], both ascending; of xarray, with the dimensions y and x
    pixel : side of a pixel [m]; of pixels that are no squares, along x and along y
    peaks : "up", heights grow towards the elastomer, as instruments give them, and the highest point touches
        first; "down", they are those of an indenter above the elastomer, and the lowest touches first
    shortest_kept : waves shorter than this are left out [m]; absent, every wave of the map is kept

    In place of heights `file` is the path of a file, read once and kept as numbers; a relative path starts at the
    working directory. `pixel`, and `unit` of the heights ("m", "mm", "um", "nm"), are needed where the file
    does not state them, and `channel` where it has several, see `read_heights`.

    Before heights are a map, in this order:

    crop : x from, x to, y from, y to [m], from the corner of the first pixel: pixels whose middles lie between are
        kept
    outliers : heights farther off the median of the 5 x 5 pixels around them than so many robust standard
        deviations, from 3 on, are filled in; absent, none is
    missing : "fill", heights that are missing, NaN, masked or a number far off that stands for none, are filled in
        harmonically, a twentieth of the pixels at most; "refuse", the default, they are an error

    `notes` tell what was done. Raises ValueError for what is none of these.
    """

    heights: Heights
    pixel: Pixel
    peaks: Literal["up", "down"] = "up"
    shortest_kept: Length | None = None

    @model_validator(mode="before")
    @classmethod
    def _prepared(cls, given: Any) -> Any:
        stated = by_name(given)
        if stated is None or not ("file" in stated or "heights" in stated):
            return given
        if "file" in stated and "heights" in stated:
            raise ValueError(f"file = {stated['file']!r} beside heights: give one of them")
        if {*stated} - {*ASKED, *(each.name for each in fields(cls))}:
            # First what is misspelt: another map may be meant.
            left = {name: each for name, each in stated.items() if name not in ASKED}
            return {"pixel": 1.0} | left | {"heights": HeightMap(np.eye(LEAST))}
        return _of_file(dict(stated)) if "file" in stated else _of_array(dict(stated))

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
        """What was done to the heights before they were a map, and what of a file was not used, a line each."""
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


def _of_file(stated):
    # Only files need it.
    from .heightfile import read_heights

    path, unit, channel = (stated.pop(name, None) for name in ("file", "unit", "channel"))
    heights, stated["pixel"], notes = read_heights(path, stated.pop("pixel", None), unit, channel)
    try:
        stated = _mapped(stated, heights, notes)
        heights = stated["heights"]
        return stated if isinstance(heights, HeightMap) else stated | {"heights": HeightMap(heights)}
    except ValueError as error:
        raise ValueError(f"file = {str(path)!r}: {error}") from None


def _of_array(stated):
    heights = stated["heights"]
    if isinstance(heights, HeightMap):
        return _mapped(stated, heights.heights, heights.notes, given=heights)
    channel, unit = stated.pop("channel", None), stated.pop("unit", None)
    if channel is not None and hasattr(heights, "data_vars") and not _is_table(heights):  # of xarray
        maps = {str(name): each for name, each in heights.data_vars.items() if each.ndim == 2}
        heights, channel = maps[picked("a Dataset", maps, channel)], None
    heights = _of_pivot(heights)
    if _is_table(heights):
        # Only tables of points need them.
        from .columns import sheet_of
        from .heighttext import of_points

        scan = of_points([sheet_of(heights)], channel)
        heights, stated["pixel"] = scan.settled(stated.get("pixel"), unit if unit or scan.unit else "m")
        return _mapped(stated, heights, scan.notes)
    if channel is not None:
        raise ValueError(f"channel = {brief(repr(channel))}: one array has no channels, leave channel out")
    if is_labelled(heights):
        heights, pixel = rows_along_y(heights, stated.get("pixel"))
        if pixel is not None and stated.get("pixel") is None:
            stated["pixel"] = pixel
    heights = unmasked(heights)
    if unit is not None:
        metre = metres(unit)
        if bare(heights)[1] is not None:
            raise ValueError(f"unit = {unit!r}: heights carry their own, leave unit out")
        heights = np.asarray(METRE.values(heights)) * metre
    return _mapped(stated, heights)


def _is_table(heights):
    """Whether something has columns called x and y."""
    names = getattr(
        heights, "data_vars", getattr(heights, "columns", heights if isinstance(heights, Mapping) else ())
    )
    return {"x", "y"} <= set(map(_axis, names))


def _axis(name):
    """Name of a column or an axis without its unit."""
    return named(str(name))[0].casefold()


def _of_pivot(heights):
    """A DataFrame whose index and columns are called x and y, as points; anything else as it is."""
    axes = getattr(heights, "index", None), getattr(heights, "columns", None)
    names = [getattr(each, "name", None) for each in axes]
    if {*map(_axis, names)} != {"x", "y"}:
        return heights
    down, across = (np.ravel(each) for each in np.meshgrid(*axes, indexing="ij"))
    return {str(names[0]): down, str(names[1]): across, "z": np.ravel(heights)}


def _mapped(stated, heights, notes=(), given=None):
    """Fields of a map, its heights cropped and mended as stated. What is no map is left to its field to refuse."""
    asked = {name: stated.pop(name, None) for name in ("crop", "missing", "outliers")}
    crop, missing, deviations = asked.values()
    if missing not in (None, *FILL):
        raise ValueError(f"missing = {brief(repr(missing))}: 'refuse' or 'fill'")
    if deviations is not None:
        deviations = argument("outliers", deviations, _deviations)
    unchanged = stated | {"heights": heights if given is None else given}
    if crop is None and missing != "fill" and deviations is None:
        return unchanged if not notes or given is not None else stated | {"heights": HeightMap(heights, notes)}
    try:
        values = np.asarray(METRE.values(heights))
        check_layout(values.shape, values.dtype)
        pixel = sides(stated.get("pixel"))
    except ValueError:
        return unchanged
    values = values.astype(float)
    if crop is not None:
        values, said = _cropped(values, pixel, crop)
        notes = (*notes, said)
    values, said = mended(values, pixel, missing == "fill", deviations)
    return stated | {"heights": HeightMap(values, (*notes, *said))}


def _deviations(given):
    found = BARE.value(given)
    if not LEAST_DEVIATIONS <= found < np.inf:
        raise ValueError(f"a number of standard deviations, from {LEAST_DEVIATIONS:g} on")
    return float(found)


def _cropped(heights, pixel, crop):
    """The part of a map whose middles of pixels lie in a rectangle, and what was left out, in words."""
    rows, columns = heights.shape
    size = columns * pixel[0], rows * pixel[1]
    allowed = (
        f"x from, x to, y from, y to as lengths, 0 to {size[0]:g} m along x and 0 to {size[1]:g} m along y, with "
        f"at least {LEAST} pixels on either side"
    )
    ends = argument("crop", crop, METRE.row)
    if len(ends) != 4 or not np.isfinite(ends).all():
        raise ValueError(f"crop = {brief(repr(crop))}: {allowed}")
    kept = []
    for side, count, whole, (low, high) in zip(pixel, (columns, rows), size, (ends[:2], ends[2:]), strict=True):
        close = QUOTIENT * whole
        middles = (np.arange(count) + 0.5) * side
        inside = np.flatnonzero((low - close <= middles) & (middles <= high + close))
        if low < -close or high > whole + close or len(inside) < LEAST:
            raise ValueError(f"crop = {brief(repr(crop))}: {allowed}")
        kept.append(slice(inside[0], inside[-1] + 1))
    along_x, along_y = kept
    left = heights[along_y, along_x]
    return left, f"cropped to {left.shape[1]} x {left.shape[0]} of {columns} x {rows} pixels"
