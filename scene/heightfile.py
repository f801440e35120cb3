"""Reading measured heights from files: arrays and plain text here, what instruments write by SurfaceTopography."""

import re
import warnings
from io import StringIO
from pathlib import Path
from reprlib import repr as briefly
from stat import S_ISDIR, S_ISREG

import numpy as np

UNITS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9}
LONGEST = 200  # letters of a path that are shown
ARRAYS, TEXTS = {".npy", ".npz"}, {".csv", ".txt"}
_SEPARATOR = re.compile(r"[,;\t]")


def read_heights(path: str | Path, pixel=None, unit: str | None = None):
    """Heights (rows, columns) [m], rows along y, and the pixel [m], a number or those along x and y.

    path : of an array (.npy), an archive with the arrays `heights` and, if it has one, `pixel` (.npz), a text of
        numbers alone, a row a line, separated by commas, semicolons, tabs or blanks (.csv, .txt; what follows a #
        is skipped), or anything else that the package SurfaceTopography reads (extra `topography`)
    pixel : [m], where the file states none
    unit : of all numbers in a file that states none; those of arrays and texts are metres without it

    Raises ValueError naming the file and what is allowed.
    """
    if unit is not None and not (isinstance(unit, str) and unit in UNITS):
        raise ValueError(f"unit = {briefly(unit)}: one of {', '.join(UNITS)}")
    if not isinstance(path, str | Path):
        raise ValueError(f"file = {briefly(path)}: a path is needed")
    path = Path(path)
    _check_there(path)
    kind = path.suffix.lower()
    plain = kind in ARRAYS | TEXTS
    heights, stated, own = (_array if kind in ARRAYS else _text if plain else _scan)(path)
    if own is None and unit is None and not plain:
        raise ValueError(f"{path} does not state the unit of its heights: give unit, one of {', '.join(UNITS)}")
    if own is not None and unit is not None:
        raise ValueError(f"unit = {unit!r}: {path} states its own, {own}, leave unit out")
    if pixel is not None and stated is not None:
        raise ValueError(f"pixel = {briefly(pixel)}: {path} states its own, {stated}, leave pixel out")
    if pixel is None and stated is None:
        raise ValueError(f"{path} does not state the size of a pixel: give pixel [m]")
    if heights.dtype.kind not in "fiu":
        raise ValueError(f"file = {str(path)!r}: an array of type {heights.dtype}: heights are real numbers [m]")
    metre = 1.0 if unit is None else UNITS[unit]
    # First the numbers in full: those of half precision end where nanometres begin.
    with np.errstate(over="ignore"):
        heights = heights.astype(float)
    return heights * metre, tuple(side * metre for side in stated) if pixel is None else pixel


def _check_there(path):
    try:
        mode = path.stat().st_mode
        if S_ISREG(mode):
            return
        why = "it is a folder, and a file is needed" if S_ISDIR(mode) else "it is no file to read from"
    except FileNotFoundError:
        why = "there is no such file"
    except (OSError, ValueError) as error:  # ValueError of names that no file can have
        why = getattr(error, "strerror", None) or error
    raise ValueError(f"file = {briefly(str(path)) if len(str(path)) > LONGEST else repr(str(path))}: {why}")


def _array(path):
    """Of numpy: its heights, the pixel if it has one, and no unit."""
    try:
        with path.open("rb") as file:  # numpy leaves a damaged archive open
            loaded = np.load(file, allow_pickle=False)
            if isinstance(loaded, np.ndarray):
                return loaded, None, None
            arrays = {name: loaded[name] for name in ("heights", "pixel") if name in loaded}
    # Damaged archives raise nearly anything.
    except Exception as error:
        raise ValueError(f"{path} cannot be read as arrays: {_first_line(error)}") from error
    if "heights" not in arrays:
        raise ValueError(f"{path} holds {', '.join(loaded.files) or 'nothing'}, and no array heights")
    return arrays["heights"], _sides(path, arrays["pixel"]) if "pixel" in arrays else None, None


def _sides(path, pixel):
    """Along x and along y, from the array of an archive."""
    if pixel.size not in (1, 2) or pixel.dtype.kind not in "fiu":
        raise ValueError(
            f"{path} has a pixel of shape {pixel.shape} and type {pixel.dtype}: one number, or two of them, along "
            "x and y"
        )
    sides = pixel.ravel().astype(float)
    if not ((sides > 0) & np.isfinite(sides)).all():
        raise ValueError(f"{path} has pixel = {pixel.tolist()}: numbers greater than 0")
    return float(sides[0]), float(sides[-1])


def _first_line(error):
    return next(iter(str(error).strip().splitlines()), "") or type(error).__name__


def _text(path):
    try:
        lines = path.read_text(encoding="utf-8-sig").splitlines()
        rows = [_SEPARATOR.sub(" ", line.partition("#")[0]) for line in lines]
        if not any(row.strip() for row in rows):
            raise ValueError("there is nothing in it")
        return np.loadtxt(StringIO("\n".join(rows)), ndmin=2), None, None
    except (OSError, ValueError) as error:
        raise ValueError(f"{path} cannot be read as rows of numbers: {_first_line(error)}") from error


def _scan(path):
    """By SurfaceTopography, the file's default channel; in metres where the file states a unit."""
    try:
        with warnings.catch_warnings():
            # Of what it imports: that it runs on one process.
            warnings.simplefilter("ignore", ImportWarning)
            from SurfaceTopography import open_topography
            from SurfaceTopography.Exceptions import CannotDetectFileFormat
    except ImportError as missing:
        raise ValueError(
            f"{path}: files other than {', '.join(sorted(ARRAYS | TEXTS))} are read by SurfaceTopography, "
            'which is not installed: pip install "mdr-bem-crosscheck[topography]"'
        ) from missing
    try:
        with open_topography(str(path)) as reader:
            channel = reader.default_channel
            stated = channel.physical_sizes is not None
            # A reader asks for the size that a file lacks; this one is taken off again.
            size = None if stated else tuple(map(float, channel.nb_grid_pts))
            found = reader.topography(physical_sizes=size)
            own = found.unit
            if own is not None:
                found = found.to_unit("m")
            # There the first index is along x.
            heights = np.array(found.heights(), float).T
    except CannotDetectFileFormat as error:  # which tells of every reader at length
        raise ValueError(
            f"{path} cannot be read by SurfaceTopography: it is of no format that it knows, or damaged"
        ) from error
    # Readers of some forty formats raise nearly anything at a damaged file.
    except Exception as error:
        raise ValueError(f"{path} cannot be read by SurfaceTopography: {_first_line(error)}") from error
    if found.dim != 2:
        raise ValueError(f"{path} holds a line, and no map of heights")
    if found.has_undefined_data:
        raise ValueError(f"{path} has pixels without a height: fill them in, or crop the map")
    pixel = tuple(float(side) / count for side, count in zip(found.physical_sizes, found.nb_grid_pts, strict=True))
    return heights, pixel if stated else None, own
