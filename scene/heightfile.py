"""Reading measured heights from files: arrays and plain text here, what instruments write by SurfaceTopography."""

import re
import signal
import warnings
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from io import BytesIO, StringIO, TextIOWrapper
from itertools import chain
from math import prod
from pathlib import Path
from reprlib import repr as briefly
from threading import current_thread, main_thread

import numpy as np

from .arrayfile import array_in, arrays_in
from .files import Unreadable, checked, content, once
from .printable import brief

UNITS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9}
UNIT = f'the unit of its heights: give unit = "um", or --unit um on the command line, out of {", ".join(UNITS)}'
PIXEL = 'the side of a pixel: give pixel = "1 um", or --pixel "1 um" on the command line'
LEAST = 4  # pixels a side: what a cubic between pixels takes
SIDE = 5120
MOST_PIXELS = SIDE**2  # that are read of a file
MOST_BYTES = 2**28  # of a file, as it is and unpacked: of so many pixels with eight bytes each, and more
MOST_TEXT, LINES, LINE = 2**27, 2**20, 2**20  # bytes of a text, its lines, and letters in one of them
ARRAYS, TEXTS = {".npy", ".npz"}, {".csv", ".txt"}
SECONDS = 10.0  # of a processor, for SurfaceTopography: some of its readers take minutes for what they do not know
_SEPARATOR = re.compile(r"[,;\t]")


def read_heights(path: str | Path, pixel=None, unit: str | None = None):
    """Heights (rows, columns) [m], rows along y, and the pixel [m], a number or those along x and y.

    path : of an array (.npy), an archive with the arrays `heights` and, if it has one, `pixel` (.npz), a text of
        numbers alone, a row a line, separated by commas, semicolons, tabs or blanks (.csv, .txt; what follows a #
        is skipped), or anything else that the package SurfaceTopography reads (extra `topography`)
    pixel : [m], where the file states none
    unit : of all numbers in a file that states none, as arrays and texts do not: "m", "mm", "um" or "nm"

    Raises ValueError naming the file and what is allowed.
    """
    if unit is not None:
        _metre(unit)
    if not isinstance(path, str | Path):
        raise ValueError(f"file = {briefly(path)}: a path is needed")
    path = checked(path, MOST_BYTES)
    kind = path.suffix.lower()
    heights, stated, own = once(_array if kind in ARRAYS else _text if kind in TEXTS else _scan, path)
    name = brief(str(path))
    if own is not None and unit is not None:
        raise ValueError(f"unit = {unit!r}: {name} states its own, {brief(str(own))}, leave unit out")
    if pixel is not None and stated is not None:
        raise ValueError(f"pixel = {briefly(pixel)}: {name} states its own, {stated}, leave pixel out")
    needed = {UNIT: own is None and unit is None, PIXEL: pixel is None and stated is None}
    if lacking := [each for each, lacks in needed.items() if lacks]:
        raise ValueError(f"{name} does not state {'; nor '.join(lacking)}")
    metre = 1.0 if unit is None else _metre(unit)  # a file that states its unit is read in metres
    # First the numbers in full: those of half precision end where nanometres begin.
    with np.errstate(over="ignore"):
        heights = heights.astype(float, copy=False)
    return heights * metre, tuple(side * metre for side in stated) if pixel is None else pixel


def _metre(unit):
    """A unit of heights [m]."""
    plain = unit.replace("µ", "u").replace("μ", "u") if isinstance(unit, str) else unit
    if not (isinstance(plain, str) and plain in UNITS):
        raise ValueError(f"unit = {briefly(unit)}: one of {', '.join(UNITS)}")
    return UNITS[plain]


def check_layout(shape: tuple[int, ...], dtype: np.dtype) -> None:
    """Raise ValueError for the shape and type of an array that is no map of heights."""
    if len(shape) != 2 or min(shape) < LEAST:
        line = (
            '; a line of heights is roughness of type = "profile"' if sum(side > 1 for side in shape) == 1 else ""
        )
        raise ValueError(
            f"an array of shape {brief(str(shape))}: a map has at least {LEAST} rows and columns{line}"
        )
    if dtype.kind not in "fiu":
        raise ValueError(f"an array of type {brief(str(dtype))}: heights are real numbers [m]")


def _array(path):
    """Heights of a file of numpy, its pixel if it has one, and no unit."""
    held = content(path, MOST_BYTES)

    def heights(shape, dtype):
        try:
            check_layout(shape, dtype)
            _check_count(shape)
        except ValueError as error:
            raise Unreadable(f"file = {brief(repr(str(path)))}: {error}") from None

    def pixel(shape, dtype):
        if prod(shape) not in (1, 2) or dtype.kind not in "fiu":
            raise Unreadable(
                f"{brief(str(path))} has a pixel of shape {brief(str(shape))} and type {brief(str(dtype))}: one "
                "number, or two of them, along x and y"
            )

    try:
        if not held.startswith(b"PK"):
            return array_in(held, heights), None, None
        arrays = arrays_in(held, {"heights": heights, "pixel": pixel})
        if "heights" not in arrays:
            raise ValueError("it has no array heights")
    except Unreadable:
        raise
    # Damaged archives raise nearly anything.
    except Exception as error:
        raise ValueError(f"{brief(str(path))} cannot be read as arrays: {_first_line(error)}") from error
    return arrays["heights"], _sides(path, arrays["pixel"]) if "pixel" in arrays else None, None


def _check_count(shape):
    """Raise ValueError for more pixels than are read."""
    if prod(shape) > MOST_PIXELS:
        raise ValueError(
            f"{brief(' x '.join(map(str, reversed(shape))))} pixels: at most {MOST_PIXELS}, as {SIDE} x {SIDE}, "
            "are read; crop the map, or take means of its pixels"
        )


def _sides(path, pixel):
    """Along x and along y, from the array of an archive."""
    sides = pixel.ravel().astype(float)
    if not ((sides > 0) & np.isfinite(sides)).all():
        raise ValueError(f"{brief(str(path))} has pixel = {pixel.tolist()}: numbers greater than 0")
    return float(sides[0]), float(sides[-1])


def _first_line(error):
    return brief(next(iter(str(error).strip().splitlines()), "") or type(error).__name__)


def _text(path):
    lines = TextIOWrapper(BytesIO(content(path, MOST_TEXT)), encoding="utf-8-sig")
    try:
        rows = _rows(lines)
        first = next(rows, None)
        if first is None:
            raise ValueError("there is nothing in it")
        return np.loadtxt(chain([first], rows), ndmin=2), None, None
    except ValueError as error:
        why = _first_line(error).partition("; use `usecols`")[0]
        raise ValueError(f"{brief(str(path))} cannot be read as rows of numbers: {why}") from error


def _rows(lines):
    """Lines of numbers with blanks between them. Raises ValueError where there are more than are read."""
    rows, columns = 0, 0
    for number, line in enumerate(iter(lambda: lines.readline(LINE + 1), ""), 1):
        if number > LINES:
            raise ValueError(f"more than {LINES} lines")
        if len(line) > LINE:
            raise ValueError(f"line {number} has more than {LINE} letters")
        row = _SEPARATOR.sub(" ", line.partition("#")[0])
        if row.strip():
            rows, columns = rows + 1, columns or len(row.split())
            _check_count((rows, columns))
            yield row


class _TooLong(BaseException):
    """No Exception: a reader that fails is followed by the next."""


@contextmanager
def _at_most(seconds):
    """Raise _TooLong after so much processor time, where there are such clocks and they can be heard."""
    if not hasattr(signal, "setitimer") or current_thread() is not main_thread():
        yield
        return

    def stop(*_):
        raise _TooLong

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)


@contextmanager
def _silent():
    """Keep a reader from warning and printing."""
    with warnings.catch_warnings(), redirect_stdout(StringIO()), redirect_stderr(StringIO()):
        warnings.simplefilter("ignore")
        yield


def _scan(path):
    """Default channel of a file by SurfaceTopography; in metres where the file states a unit."""
    name = brief(str(path))
    try:
        with _silent():
            from SurfaceTopography import open_topography
            from SurfaceTopography.Exceptions import CannotDetectFileFormat
    except ImportError as missing:
        raise ValueError(
            f"{name}: files other than {', '.join(sorted(ARRAYS | TEXTS))} are read by SurfaceTopography, "
            'which is not installed: pip install "mdr-bem-crosscheck[topography]"'
        ) from missing
    try:
        # What it warns of and prints tells of itself, and a line is kept of what it raises.
        with _at_most(SECONDS), _silent(), open_topography(str(path)) as reader:
            channel = reader.default_channel
            _check_count(channel.nb_grid_pts)
            stated = channel.physical_sizes is not None
            # A reader asks for the size that a file lacks; this one is taken off again.
            size = None if stated else tuple(map(float, channel.nb_grid_pts))
            found = reader.topography(physical_sizes=size)
            own = found.unit
            if own is not None:
                found = found.to_unit("m")
            if found.dim != 2 or 0 in found.nb_grid_pts:
                raise ValueError("it holds a line or nothing, and no map of heights")
            if found.has_undefined_data:
                raise ValueError("it has pixels without a height: fill them in, or crop the map")
            sizes = zip(found.physical_sizes, found.nb_grid_pts, strict=True)
            pixel = tuple(float(side) / count for side, count in sizes)
            # There the first index is along x.
            return np.array(found.heights(), float).T, pixel if stated else None, own
    except CannotDetectFileFormat as error:  # which tells of every reader at length
        raise ValueError(
            f"{name} cannot be read by SurfaceTopography: it is of no format that it knows, or damaged"
        ) from error
    except _TooLong:
        raise ValueError(
            f"{name} takes SurfaceTopography more than {SECONDS:g} s to read: write its heights to a .npy file"
        ) from None
    # Readers of some forty formats raise nearly anything at a damaged file.
    except Exception as error:
        raise ValueError(f"{name} cannot be read by SurfaceTopography: {_first_line(error)}") from error
