"""Reading measured heights from files: arrays here, texts beside, what instruments write by SurfaceTopography."""

import signal
import warnings
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from io import StringIO
from math import prod
from pathlib import Path
from reprlib import repr as briefly
from threading import current_thread, main_thread
from typing import Any

import numpy as np

from .arrayfile import array_in, arrays_in, names_in
from .files import Unreadable, checked, content, once
from .printable import brief
from .scan import UNITS, Scan, check_layout, metres, picked

__all__ = ["UNITS", "read_heights"]

SIDE = 5120
MOST_PIXELS = SIDE**2  # that are read of a file
MOST_BYTES = 2**28  # of a file, as it is and unpacked: of so many pixels with eight bytes each, and more
MOST_TEXT, ROWS = 2**27, 2**21  # bytes of a text, and rows of numbers in it
ARRAYS, TEXTS = {".npy", ".npz"}, {".csv", ".txt", ".tsv", ".xyz"}
# Its readers of texts guess separators, and those of nameless matrices take rows along x.
_TEXTS_THERE, _MATRICES = {"Text", "XYZ"}, {"Matlab", "H5"}
SECONDS = 10.0  # of a processor, for SurfaceTopography: some of its readers take minutes for what they do not know


def read_heights(
    path: str | Path, pixel: Any = None, unit: str | None = None, channel: str | None = None
) -> tuple[np.ndarray, Any, tuple[str, ...]]:
    """Heights (rows, columns) [m], rows along y, NaN where none was measured; the pixel [m], and notes.

    path : of an array (.npy), an archive with the arrays `heights` and, if it has one, `pixel` (.npz), a text
        (.csv, .txt, .tsv, .xyz, see `heighttext.read_text`), or anything else that the package SurfaceTopography
        reads (extra `topography`)
    pixel : [m], where the file states none; one number, or two along x and along y
    unit : of all numbers in a file that states none, as arrays do not: "m", "mm", "um" or "nm"
    channel : which map of a file with several is read, by its name

    Notes say what was read and is not used. Raises ValueError naming the file and what is allowed.
    """
    if unit is not None:
        metres(unit)
    if not isinstance(path, str | Path):
        raise ValueError(f"file = {briefly(path)}: a path is needed")
    if not isinstance(channel, str | None):
        raise ValueError(f"channel = {briefly(channel)}: the name of a channel is needed")
    path = checked(path, MOST_BYTES)
    kind = path.suffix.lower()
    scan = once(_array if kind in ARRAYS else _text if kind in TEXTS else _scan, path, channel)
    return *scan.settled(pixel, unit), scan.notes


def _text(path, channel):
    # Only texts need it.
    from .heighttext import read_text

    return read_text(path, channel, ROWS, MOST_TEXT, MOST_PIXELS)


def _array(path, channel):
    """The array of a file of numpy, or the one that is chosen of an archive, which may have a pixel."""
    held, name = content(path, MOST_BYTES), brief(str(path))

    def heights(shape, dtype):
        try:
            check_layout(shape, dtype)
            _check_count(shape)
        except ValueError as error:
            raise Unreadable(f"file = {brief(repr(str(path)))}: {error}") from None

    def pixel(shape, dtype):
        if prod(shape) not in (1, 2) or dtype.kind not in "fiu":
            raise Unreadable(
                f"{name} has a pixel of shape {brief(str(shape))} and type {brief(str(dtype))}: one "
                "number, or two of them, along x and y"
            )

    try:
        if not held.startswith(b"PK"):
            if channel is not None:
                raise Unreadable(f"channel = {brief(repr(channel))}: {name} holds one array, leave channel out")
            return Scan(name, array_in(held, heights))
        held_names = [each for each in names_in(held) if each != "pixel"]
        if channel is None and "heights" not in held_names:
            hint = f'; choose one of them, channel = "{held_names[0]}"' if held_names else ""
            raise ValueError(f"it holds {', '.join(names_in(held)) or 'nothing'}, and no array heights{hint}")
        wanted = picked(name, dict.fromkeys(held_names), channel, "heights")
        arrays = arrays_in(held, {wanted: heights, "pixel": pixel})
    except Unreadable:
        raise
    # Damaged archives raise nearly anything.
    except Exception as error:
        raise ValueError(f"{name} cannot be read as arrays: {_first_line(error)}") from error
    steps = _sides(path, arrays["pixel"]) if "pixel" in arrays else None
    return Scan(name, arrays[wanted], steps=steps)


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


def _scan(path, channel):
    """A channel of a file by SurfaceTopography, its own choice where none is chosen."""
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
            if type(reader).__module__.rpartition(".")[2] not in _TEXTS_THERE:
                return _of_channel(name, reader, channel)
    except CannotDetectFileFormat as error:  # which tells of every reader at length
        if b"\0" not in content(path, MOST_BYTES):
            return _text(path, channel)
        raise ValueError(
            f"{name} cannot be read by SurfaceTopography: it is of no format that it knows, or damaged"
        ) from error
    except _TooLong:
        raise ValueError(
            f"{name} takes SurfaceTopography more than {SECONDS:g} s to read: write its heights to a .npy file"
        ) from None
    except _NotChosen as error:
        raise ValueError(str(error)) from None
    # Readers of some forty formats raise nearly anything at a damaged file.
    except Exception as error:
        raise ValueError(f"{name} cannot be read by SurfaceTopography: {_first_line(error)}") from error
    return _text(path, channel)


class _NotChosen(Exception):
    """A channel that is asked for is not there."""


def _of_channel(name, reader, asked):
    """The map of a channel. Raises whatever the reader of the file raises."""
    channels, wanted = {}, reader.default_channel
    for number, each in enumerate(reader.channels, 1):
        channels[each.name if each.name not in channels else f"{each.name} ({number})"] = each
    if asked is not None:
        try:
            wanted = channels[picked(name, channels, asked)]
        except ValueError as error:
            raise _NotChosen(str(error)) from None
    _check_count(wanted.nb_grid_pts)
    stated = wanted.physical_sizes is not None
    # A reader asks for the size that a file lacks; this one is taken off again.
    size = None if stated else tuple(map(float, wanted.nb_grid_pts))
    found = wanted.topography(physical_sizes=size)
    own = found.unit
    if own is not None:
        found = found.to_unit("m")
    if found.dim != 2 or 0 in found.nb_grid_pts:
        raise ValueError("it holds a line or nothing, and no map of heights")
    # There the first index is along x, but of matrices, whose rows are along y as those of arrays.
    heights = np.ma.filled(np.ma.array(found.heights(), float), np.nan)
    heights = heights if type(reader).__module__.rpartition(".")[2] in _MATRICES else heights.T
    pixel = tuple(float(side) / count for side, count in zip(found.physical_sizes, found.nb_grid_pts, strict=True))
    notes = ()
    if asked is None and len(channels) > 1:
        said = brief(", ".join(map(repr, channels)))
        notes = (f"{name}: its channel {brief(repr(wanted.name))} is taken, of {said}",)
    if not stated:
        return Scan(name, heights, own or "", notes=notes)
    if own is None:
        return Scan(name, heights, steps=pixel, notes=notes)
    return Scan(name, heights, own, pixel, notes=notes)
