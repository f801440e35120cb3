"""Lines of heights, as a stylus writes them: out of a text, a table or an array, in metres and evenly spaced."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from reprlib import repr as briefly
from typing import Any

import numpy as np

from .arrayfile import array_in
from .columns import Chosen, Column, chosen, sheet_of
from .files import checked, content
from .heightmap import unmasked
from .labelled import is_labelled
from .lattice import OFF
from .linescan import MOST
from .printable import brief
from .quantities import METRE, argument
from .scan import EVEN, UNITS, measured_in, metres
from .scanheader import Header
from .sheet import Sheet, read_sheets

X_NAMES = (
    "x distance position length lateral travel traverse path displacement horiz horizontal weg,x axis,"
    "x achse,x position,x distance,x coordinate,lateral position,lateral distance,scan length,scan position,"
    "scan distance,traverse length,profile length"
)
Z_NAMES = (
    "z height heights profile depth elevation topography amplitude vertical raw höhe profil hauteur,"
    "z position,z height,z axis,z achse,profile height,surface height,raw profile,raw height,primary profile,"
    "total profile,measured profile,roughness profile,r profile,p profile,z profile,profile depth"
)
X = Column("x", (*X_NAMES.partition(",")[0].split(), *X_NAMES.split(",")[1:]), (METRE,), optional=True)
Z = Column("heights", (*Z_NAMES.partition(",")[0].split(), *Z_NAMES.split(",")[1:]), (METRE,))
MOST_BYTES = 2**26
NEEDED = 'the unit of its heights: write it into the heading, as "z [um]", or give unit, one of ' + ", ".join(
    UNITS
)

Line = tuple[np.ndarray, Any, tuple[str, ...]]
"""Heights [m], NaN where none was measured; their spacing as stated or found [m], None if neither; and notes."""


def read_line(path: Any, spacing: Any = None, unit: str | None = None) -> Line:
    """A line out of a file: a text with a column of heights and maybe one of places, or one array (.npy).

    spacing : of the points [m], where the file has no places, or none with a unit
    unit : of the heights, where the file states none: "m", "mm", "um" or "nm"

    Raises ValueError naming the file and what is allowed.
    """
    if not isinstance(path, str | Path):
        raise ValueError(f"file = {briefly(path)}: a path is needed")
    path = checked(path, MOST_BYTES)
    name = brief(str(path))
    if path.suffix.lower() == ".npy":
        return _in_metres(name, _array(path, name), unit), spacing, ()
    sheets = read_sheets(path, MOST, MOST_BYTES)
    if len(sheets) > 1:
        lines = " and ".join(str(each.lines[0]) for each in sheets[:2])
        raise ValueError(f"{name}: blocks of numbers from line {lines} on: one line of heights is needed")
    return _of_sheet(sheets[0], spacing, unit)


def line_of(heights: Any, spacing: Any = None, unit: str | None = None) -> Line:
    """A line out of a table of another library, arrays by their names, or an array with or without labels.

    Raises ValueError.
    """
    if isinstance(heights, Mapping) or hasattr(heights, "columns") or hasattr(heights, "data_vars"):
        return _of_sheet(sheet_of(heights), spacing, unit)
    if unit is not None:
        raise ValueError(
            f"unit = {briefly(unit)}: of a file, or of a table; give heights with their unit, or in metres"
        )
    heights = unmasked(heights)
    places = _coordinates(heights) if is_labelled(heights) else None
    if places is not None:
        step, rising = _even("heights", places)
        spacing = _agreeing("heights", spacing, step)
        heights = heights if rising else heights[::-1]
    return np.asarray(METRE.values(heights)), spacing, ()


def _of_sheet(sheet: Sheet, spacing, unit) -> Line:
    if not sheet.names and len(sheet.numbers) == 1 and sheet.numbers.size > 1:
        sheet = replace(sheet, numbers=sheet.numbers.T, lines=())  # a row of heights
    positional = ("heights",) if sheet.numbers.shape[1] == 1 else ("x", "heights")
    # A graph has its heights along y.
    graph = [each.casefold() for each in sheet.names] == ["x", "y"]
    told = Header.of(sheet)
    sheet = replace(sheet, heading=replace(sheet.heading, before=told.rest))
    found, notes = chosen(sheet, (X, replace(Z, called=("y",)) if graph else Z), positional)
    heights, x = found["heights"], found.get("x")
    if heights.name.casefold().endswith("depth"):
        notes += (f'{sheet.name}: {brief(repr(heights.name))} is read as heights; peaks = "down" turns them over',)
    written = sheet.units[heights.index] if sheet.units else ""
    if heights.unit is None and told.unit:
        written, heights = (
            told.unit,
            replace(heights, numbers=measured_in(sheet.name, heights.numbers, told.unit), unit=METRE),
        )
    numbers = _in_metres(sheet.name, heights.numbers, unit, heights, written)
    if told.step is not None:
        spacing = _agreeing(sheet.name, spacing, told.step)
    if x is None:
        return numbers, spacing, notes + told.notes
    step, rising = _even(f"{sheet.name}, {x.name or 'x'}", x.numbers, sheet)
    if x.unit is not None:
        spacing = _agreeing(sheet.name, spacing, step)
    elif spacing is None:
        raise ValueError(
            f"{sheet.name} does not state the unit of its places {brief(x.name)}: write it into the heading, as "
            '"x [mm]", or give their spacing, as spacing = "0.5 um"'
        )
    return numbers if rising else numbers[::-1], spacing, notes


def _in_metres(name, numbers, unit, column: Chosen | None = None, written: str = ""):
    metre = None if unit is None else metres(unit)
    if column is not None and column.unit is not None:
        if metre is not None and abs(float(METRE.scale(written)[0]) - metre) > 1e-9 * metre:
            raise ValueError(f"unit = {unit!r}: {name} states its own, {brief(written)}, leave unit out")
        return numbers
    if metre is None:
        raise ValueError(f"{name} does not state {NEEDED}")
    return numbers * metre


def _even(name, places, sheet: Sheet | None = None):
    """Spacing of evenly spaced places, and whether they rise. Raises ValueError, with the line, for any others."""
    if len(places) < 2:
        raise ValueError(f"{name}: one place is no line")
    count = np.arange(len(places))
    mean, middle = (len(places) - 1) / 2, float(np.mean(places))
    step = float(np.sum((count - mean) * (places - middle)) / np.sum((count - mean) ** 2))
    off = np.abs(places - middle - step * (count - mean))
    if not np.isfinite(off).all() or not off.max() <= OFF * abs(step):
        worst = int(np.argmax(np.where(np.isfinite(off), off, np.inf)))
        line = f", line {sheet.lines[worst]}" if sheet is not None and len(sheet.lines) else f", point {worst + 1}"
        raise ValueError(
            f"{name}{line}: {places[worst]:g} is off by more than {100 * OFF:g} % of a step: places of a line are "
            "evenly spaced, interpolate it"
        )
    return abs(step), step > 0


def _agreeing(name, spacing, step):
    """The spacing of places, with which one that is stated has to agree."""
    if spacing is None:
        return step
    given = argument("spacing", spacing, METRE.value)
    if abs(given - step) > EVEN * step:
        raise ValueError(f"spacing = {briefly(spacing)}: places of {name} lie {step:g} m apart, leave spacing out")
    return step


def _coordinates(heights):
    """Places of an array with one dimension that has a name [m]; None where it has none."""
    dims = tuple(map(str, heights.dims))
    if len(dims) != 1:
        raise ValueError(f"heights have the dimensions ({brief(', '.join(dims))}): a line has one")
    if dims[0] not in getattr(heights, "coords", {}):
        return None
    try:
        return np.asarray(METRE.values(heights.coords[dims[0]]), float)
    except ValueError as error:
        raise ValueError(f"heights, coordinates of {brief(dims[0])}: {error}") from None


def _array(path, name):
    def check(shape, dtype):
        if sum(side > 1 for side in shape) != 1 or dtype.kind not in "fiu":
            raise ValueError(f"an array of shape {shape} and type {dtype}: a line has one row of real numbers")

    try:
        return array_in(content(path, MOST_BYTES), check).ravel().astype(float)
    # Damaged files raise nearly anything.
    except Exception as error:
        raise ValueError(f"{name} cannot be read as an array: {brief(str(error))}") from error
