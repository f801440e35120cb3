"""Maps of heights in text files: rows of heights, with axes or without, one channel or several, or points."""

import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from .blocks import joined
from .columns import Column, chosen
from .lattice import mapped, placed
from .printable import brief
from .quantities import METRE
from .scan import EVEN, LEAST, Scan, measured_in, picked
from .scanheader import Header
from .sheet import Sheet, read_sheets

PLACES = "{} position", "position {}", "{} coordinate", "pos {}", "{} pos", "{} axis", "{} achse"
X, Y = (Column(k, (k, *(each.format(k) for each in PLACES)), (METRE,)) for k in ("x", "y"))
Z_NAMES = "z height heights h elevation topography höhe hauteur,z position,z height,z axis,height sensor,zsensor"
Z = Column("z", (*Z_NAMES.partition(",")[0].split(), *Z_NAMES.split(",")[1:]), (METRE,))
_NUMBERS = re.compile(r"(?<![\w.,])[+-]?\d[\d.,]*")
_TOLD = 6  # cells: so many evenly spaced ones in one row alone are no heights
_EXACT, _NEAR = 1e-6, 1e-2  # relative, of spacings


def read_text(path: str | Path, channel: str | None, rows: int, most_bytes: int, pixels: int) -> Scan:
    """The map in a text file, or the channel of it that is chosen.

    Three columns, or columns called x and y, are points: on a lattice, in any order, as many blocks as there are.
    Otherwise a block of numbers is a map, rows along y. A first row and a first column are its axes where their
    common cell is empty or a word. Lines above the numbers may state its name, its width, its pixel and its unit.

    rows, most_bytes, pixels : that are read

    Raises ValueError naming file and line.
    """
    sheets = read_sheets(path, rows, most_bytes, pixels)
    first = sheets[0]
    width = first.numbers.shape[1]
    if width < 3:
        raise ValueError(
            f"{first.name}, line {first.lines[0]}: {width} column{'s' * (width > 1)} of numbers, and a map has at "
            f'least {LEAST}: a line of heights is roughness of the type = "profile"'
        )
    if width == 3 or {"x", "y"} <= {_called(each) for each in first.names}:
        return of_points(sheets, channel)
    if len(sheets) > 1 and all(len(each.lines) == 1 and not each.before for each in sheets[1:]):
        sheets = (joined(sheets),)  # of an empty line after each row
    channels: dict[str, tuple[Sheet, Header]] = {}
    told = Header()
    for number, sheet in enumerate(sheets, 1):
        told = Header.of(sheet, told)
        name = told.channel or str(number)
        channels[name if name not in channels else f"{name} ({number})"] = sheet, told
    return _of_rows(*channels[picked(first.name, channels, channel)])


def _called(name):
    return next((each.field for each in (X, Y, Z) if name.replace("_", " ").strip().casefold() in each.called), "")


def of_points(sheets: Sequence[Sheet], channel: str | None) -> Scan:
    """The map of points x, y and z, or the column that is chosen, which lie on a lattice. Raises ValueError."""
    told = Header.of(sheets[0])
    # What is told above the points is taken out: the rest may be a heading that is none.
    bare = (replace(each.heading, before=(), unread="" if told.unit else each.unread) for each in sheets)
    sheet = joined([replace(each, heading=heading) for each, heading in zip(sheets, bare, strict=True)])
    wanted = [X, Y, Z if channel is None else Column("z", (channel,), (METRE,))]
    try:
        found, notes = chosen(sheet, wanted, ("x", "y", "z"))
    except ValueError as error:
        hint = ': channel = "NAME" takes a column of another name' if "no column for z" in str(error) else ""
        raise ValueError(f"{error}{hint}") from None

    def where(row):
        return f"{sheet.name}, line {sheet.lines[row]}" if len(sheet.lines) else sheet.name

    x, y, z = (found[name] for name in "xyz")
    if (x.unit is None) != (y.unit is None):
        raise ValueError(f"{sheet.name}: one of x and y has a unit and the other has none")
    try:
        heights, steps = mapped(x.numbers, y.numbers, z.numbers, where)
    except ValueError as error:
        text = str(error)
        raise ValueError(text if text.startswith(sheet.name) else f"{sheet.name}: {text}") from None
    unit = "m" if z.unit is not None else told.unit
    if z.unit is None and told.unit:
        heights = measured_in(sheet.name, heights, told.unit)
    if x.unit is not None:
        return Scan(sheet.name, heights, unit, steps, notes=notes, spoken=told.spoken)
    counted = _count(steps)
    return Scan(sheet.name, heights, unit, steps=steps, counted=counted, notes=notes, spoken=told.spoken)


def _count(steps):
    """Whether coordinates so far apart may merely number the pixels."""
    return max(abs(step - 1) for step in steps) < _EXACT


def _of_rows(sheet, told):
    """The map of a block, without its axes."""
    numbers, steps = sheet.numbers, None
    if len(_NUMBERS.findall(sheet.unread)) > 2:
        where = f"{sheet.name}, line {sheet.lines[0] - 1}"
        raise ValueError(f"{where}: {brief(repr(sheet.unread))} is neither a row of heights nor a heading")
    x, y, unit = _axes(sheet)
    if x is not None:
        numbers = numbers[len(numbers) - len(y) :, 1:]
        numbers, dx = _ascending(sheet, "first row", x, numbers, 1)
        numbers, dy = _ascending(sheet, "first column", y, numbers, 0)
        # Numbers of rows and columns, as tables have them, say nothing of the pixel.
        steps = None if not unit and _count((dx, dy)) and {x.min(), y.min()} <= {0, 1} else (dx, dy)
    _check_axes(sheet, numbers)
    pixel = told.sides(sheet.name, numbers.shape[1], numbers.shape[0])
    if steps is not None and unit:
        lateral = tuple(measured_in(f"{sheet.name}, axes,", step, unit) for step in steps)
        if any(side and abs(step - side) > EVEN * side for step, side in zip(lateral, pixel, strict=True)):
            said = " x ".join(f"{side:g}" for side in pixel if side)
            raise ValueError(f"{sheet.name} states pixels of {said} m, and its axes lie {lateral[0]:g} m apart")
        pixel, steps = lateral, None
    # Headings of columns of heights may have a unit, one for all.
    own = {each for each in sheet.units[steps is not None or bool(unit) :] if each} | {told.unit} - {""}
    if len(own) > 1:
        raise ValueError(f"{sheet.name} states several units of its heights, {', '.join(sorted(own))}: state one")
    height = next(iter(own), "")
    if height:
        numbers = measured_in(sheet.name, numbers, height)
    stated = None if None not in pixel else steps
    counted = stated is not None and _count(stated)
    return Scan(sheet.name, numbers, height, pixel, stated, counted, told.notes, told.spoken)


def _axes(sheet):
    """Coordinates along x and along y of a map with axes, and their unit; None of one without."""
    numbers, names = sheet.numbers, sheet.names
    cells = [_as_number(each) for each in names[1:]]
    if cells and not np.isnan(cells).any():
        return np.array(cells), numbers[:, 0], _of_corner(names[0], sheet.units[0])
    if min(numbers.shape) < LEAST:
        return None, None, ""
    first, second = numbers[0, 1:], numbers[1, 1:]
    empty = np.isnan(numbers[0, 0])
    if not (empty and _even(first, _NEAR) and _even(numbers[1:, 0], _NEAR)):
        return None, None, ""
    # A slope whose corner is missing goes on in the next row.
    if _even(second, _NEAR) and np.abs(second - first).max() <= 3 * np.abs(numbers[2, 1:] - second).max():
        return None, None, ""
    return first, numbers[1:, 0], ""


def _of_corner(name, unit):
    """Unit of axes, after the word in their corner or in its place; "y / x" has none."""
    alone = name.strip("[]() ")
    try:
        METRE.scale(alone)
    except ValueError:
        return "" if unit.casefold() in ("x", "y") else unit
    return unit or alone


def _as_number(cell):
    try:
        return float(cell)
    except ValueError:
        return np.nan


def _even(values, tolerance):
    steps = np.diff(values)
    if not np.isfinite(steps).all() or not len(steps):
        return False
    mean = steps.mean()
    return bool(mean and np.abs(steps - mean).max() <= tolerance * abs(mean))


def _ascending(sheet, called, axis, numbers, along):
    """Heights with ascending coordinates, and the spacing. Raises ValueError where they are not evenly spaced."""
    try:
        if not np.isfinite(axis).all():
            raise ValueError("a coordinate is missing")
        places, step = placed("coordinates", axis)
        if not (np.abs(np.diff(places)) == 1).all():
            raise ValueError("coordinates are not evenly spaced")
    except ValueError as error:
        raise ValueError(f"{sheet.name}, {called} of the block at line {sheet.lines[0]}: {error}") from None
    return (np.flip(numbers, along) if places[0] > places[-1] else numbers), step


def _check_axes(sheet, numbers):
    """Raise ValueError where the first row or column of a map is evenly spaced, or two columns are points."""
    if len(numbers) >= LEAST**2 and numbers.shape[1] <= _TOLD:
        for k in range(2):
            try:
                shape = mapped(*numbers[:, k : k + 2].T, numbers[:, k], str)[0].shape
            except ValueError:
                continue
            if min(shape) >= LEAST:
                raise ValueError(
                    f"{sheet.name}, line {sheet.lines[0]}: columns {k + 1} and {k + 2} are places on a lattice: "
                    'write a heading with x, y and z and their units, as "x [um]"'
                )
    for called, rows in (("row", numbers), ("column", numbers.T)):
        # Their common cell may hold anything.
        if rows.shape[1] <= _TOLD or len(rows) < 2 or not _even(rows[0, 1:], _EXACT) or _even(rows[1, 1:], _EXACT):
            continue
        if np.isfinite(rows[1]).all():
            raise ValueError(
                f"{sheet.name}, line {sheet.lines[0]}: the first {called}, {rows[0, 0]:g}, {rows[0, 1]:g}, "
                f"{rows[0, 2]:g} and so on, is evenly spaced as coordinates are, and the next is not: leave it "
                "out, or write axes on both sides and nothing in their common cell"
            )
