"""Heights of a map or a line out of a file or an object of Python, in metres: one form each, nothing is guessed.

A file is
    an array (.npy), or an archive of arrays (.npz), from which `channel` picks one
    a file of NetCDF (.nc), whose variables are arrays along y and x, or x, with their units in attributes
    a text (.txt, .csv, .tsv, .xyz; for a line any other too) of numbers and nothing else, a row of the map a line,
        the first at the lowest y; of a line one number a row, with comments above. Empty cells and nan are missing
    a table of points, columns x, y and z, of a line x and z, with their units in the heading, see `tablefile`
    for a map, whatever the package SurfaceTopography reads (extra `topography`)

In Python arrays, tables and objects of xarray have the same form. Options of `TableFormat` state what differs of a
text or a table. A unit, a pixel or a spacing that a file lacks has to be stated; one that it has must agree.
"""

import warnings
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from dataclasses import dataclass, replace
from io import StringIO
from math import prod
from pathlib import Path
from reprlib import repr as briefly
from typing import Any

import numpy as np

from .files import checked
from .heightmap import LEAST, HeightLine, HeightMap, sides, unmasked
from .lattice import along, mapped, ordered, refuse_places
from .plain import bare, in_unit
from .printable import brief
from .quantities import METRE, argument
from .tablefile import Column, read_columns
from .tabletext import TableFormat, read_rows

MAP, LINE = ("y", "x"), ("x",)
EVEN = 1e-3  # relative, of sides and spacings: a file rounds them, and so do coordinates in single precision
MOST_PIXELS = 5120**2  # that are read of a file
MOST_BYTES, MOST_TEXT = 2**28, 2**27  # of a file, as it is and unpacked; and of a text
ARRAYS, NETCDF, TEXTS = {".npy", ".npz"}, {".nc"}, {".txt", ".csv", ".tsv", ".xyz"}
# Endings of what holds no heights, and what it is.
FOREIGN = {
    "a picture": ".png .tif .tiff .jpg .jpeg .bmp .gif .webp .svg .pdf",
    "a workbook": ".xlsx .xls .xlsm .ods",
    "a mesh": ".stl .obj .ply .3mf .vtk .vtp .vtu",
}
X = Column("x", ("x", "X", "distance", "position", "length"), (METRE,), unit_needed=True)
Y = Column("y", ("y", "Y"), (METRE,), needed=True, unit_needed=True)
Z = Column("z", ("z", "Z", "height", "heights"), (METRE,), needed=True, unit_needed=True, gaps=True)
COLUMNS = {MAP: (replace(X, needed=True), Y, Z), LINE: (X, Z)}


@dataclass(frozen=True, eq=False)
class Heights:
    """Heights as a file or an object has them.

    name : of the file, for messages
    numbers : of a map (rows, columns), rows along y, or of a line (N,), ascending; NaN where none was measured
    unit : of these numbers; None where none is stated
    spacings : along x, or x and y [m]; None where they are not stated
    notes : what was read and is not used, a line each
    """

    name: str
    numbers: Any
    unit: str | None = None
    spacings: tuple[float, ...] | None = None
    notes: tuple[str, ...] = ()

    def settled(self, spacing: Any, unit: str | None = None) -> "Settled":
        """Heights [m], their pixel or spacing, and notes: what is stated and what was read put together.

        Raises ValueError where one of them is stated twice and differs, and where it is stated nowhere.
        """
        step, what = ("spacing", "spacing") if np.ndim(self.numbers) == 1 else ("pixel", "side of a pixel")
        lacking = {"the unit of its heights": 'unit = "um"'} if self.unit is None and unit is None else {}
        lacking |= {f"the {what}": f'{step} = "1 um"'} if self.spacings is None and spacing is None else {}
        if lacking:
            raise ValueError(
                f"{self.name} does not state {' nor '.join(lacking)}: state {' and '.join(lacking.values())}"
            )
        metre = None if unit is None else _metres("unit", unit)
        own = None if self.unit is None else _metres(f"{self.name}: unit of heights", self.unit)
        if metre and own and abs(metre - own) > 1e-9 * own:
            raise ValueError(f"unit = {unit!r}: {self.name} states its own, {self.unit}: leave unit out")
        # First the numbers in full: those of half precision end where nanometres begin.
        heights = np.asarray(self.numbers, float)
        with np.errstate(over="ignore"):  # beyond the range of numbers is not finite, and refused
            heights = heights * metre if self.unit is None else in_unit(heights, self.unit, "m")
        if spacing is not None:
            self._check(step, spacing)
            return heights, spacing, self.notes
        return heights, self.spacings if step == "pixel" else self.spacings[0], self.notes  # type: ignore[index]

    def _check(self, step, spacing):
        """Raise ValueError for a spacing other than that of the file; one that is none is left to its field."""
        try:
            given = sides(spacing)
        except ValueError:
            return
        if any(abs(one - own) > EVEN * own for one, own in zip(given, self.spacings or (), strict=False)):
            own = " x ".join(f"{side:.6g}" for side in dict.fromkeys(self.spacings))
            raise ValueError(f"{step} = {briefly(spacing)}: {self.name} states its own, {own} m: leave {step} out")


Settled = tuple[np.ndarray, Any, tuple[str, ...]]


def read_heights(
    path: Any,
    dims: tuple[str, ...],
    spacing: Any = None,
    unit: str | None = None,
    channel: str | None = None,
    written: TableFormat | None = None,
) -> Settled:
    """Heights [m] out of a file, their pixel or spacing, and notes.

    dims : MAP or LINE
    spacing, unit : as stated, where the file has none; channel : which of several arrays or maps is read
    written : what is stated of a text or a table

    Raises ValueError naming the file, with what is allowed.
    """
    if not isinstance(path, str | Path):
        raise ValueError(f"file = {briefly(path)}: a path is needed")
    kind, name, written, found = Path(path).suffix.lower(), brief(str(path)), written or TableFormat(), None
    if foreign := [what for what, endings in FOREIGN.items() if kind in endings.split()]:
        raise ValueError(
            f"{name} is {foreign[0]} ({kind}): export the heights as numbers, to .txt, .npy, .nc or the format of "
            "an instrument"
        )
    place = checked(path, MOST_BYTES)
    if kind in ARRAYS:
        found = _of_arrays(name, place, dims, channel)
    elif kind in NETCDF:
        found = _of_netcdf(name, place, dims, channel, written.units or {})
    elif kind not in TEXTS and dims == MAP:
        found = _of_instrument(name, place, channel)
    if found is not None:
        if (replace(written, units=None) if kind in NETCDF else written) != TableFormat():
            raise ValueError(f"{name} is no text: leave out columns, units, separators and lines")
        return found.settled(spacing, unit)
    if channel is not None:
        raise ValueError(f"channel = {brief(repr(channel))}: {name} is a text; skip and rows choose a part of it")
    if rows := _of_rows(name, path, dims, written):
        return rows.settled(spacing, unit)
    return _of_table(path, dims, spacing, unit, written).settled(spacing)


def given_heights(
    heights: Any,
    dims: tuple[str, ...],
    spacing: Any = None,
    unit: str | None = None,
    channel: str | None = None,
    written: TableFormat | None = None,
) -> Settled:
    """The same out of an array, a table or an object of xarray; arrays without a unit are in metres."""
    if hasattr(heights, "data_vars") and dims == MAP:
        arrays = {str(name): each for name, each in heights.data_vars.items() if each.ndim == len(dims)}
        if arrays:
            heights, channel = arrays[picked("the Dataset", arrays, channel)], None
    if channel is not None:
        raise ValueError(f"channel = {brief(repr(channel))}: one array has no channels, leave channel out")
    # A DataFrame whose columns are only counted is an array.
    columns = list(getattr(heights, "columns", ()))
    if isinstance(heights, Mapping) or hasattr(heights, "data_vars") or columns != list(range(len(columns))):
        return _of_table(heights, dims, spacing, unit, written or TableFormat()).settled(spacing)
    if written not in (None, TableFormat()):
        raise ValueError("heights are an array and no table: leave out columns, units, separators and lines")
    if hasattr(heights, "dims") and hasattr(heights, "isel"):
        found = _of_labelled("the array", heights, dims)
        of_places = {bare(heights.coords[dim])[1] for dim in dims if dim in heights.coords}
        if found.unit is not None and None in of_places and spacing is None:
            raise ValueError(
                f"heights are in {found.unit}, and places have no unit: give them the attribute units"
            )
    else:
        of_places = {None}
        heights = unmasked(heights)
        found = Heights(
            "the array", argument("heights", heights, METRE.values), None if bare(heights)[1] is None else "m"
        )
    return found.settled(spacing, unit or (None if found.unit or of_places - {None} else "m"))


def picked(name: str, channels: Iterable[str], channel: str | None) -> str:
    """The channel that is chosen, or the only one. Raises ValueError with the names of all."""
    names = list(channels)
    if not names:
        raise ValueError(f"{name} holds no array of heights")
    if channel is None and len(names) == 1:
        return names[0]
    held = f"{name} holds {brief(', '.join(map(repr, names)))}"
    if channel in names:
        return str(channel)
    raise ValueError(
        f"{held}: state which, as channel = {names[0]!r}"
        if channel is None
        else f"channel = {brief(repr(channel))}: {held}"
    )


def _of_arrays(name, path, dims, channel):
    """The array of a .npy file, or one of an .npz archive; no object is made of what is pickled."""
    try:
        with path.open("rb") as file, _silent():
            held = np.load(file)
            if isinstance(held, np.ndarray) and channel is not None:
                raise ValueError(f"channel = {brief(repr(channel))}: it holds one array, leave channel out")
            if not isinstance(held, np.ndarray):
                if sum(each.file_size for each in held.zip.infolist()) > MOST_BYTES:
                    raise ValueError(f"unpacked it has more than {MOST_BYTES / 1e6:g} MB")
                held = np.asarray(held[picked("it", held.files, channel)])
        (HeightMap if dims == MAP else HeightLine).check_layout(held.shape, held.dtype)
        _check_count(held.shape)
        return Heights(name, held)
    # Damaged files raise nearly anything.
    except Exception as error:
        why = "objects are not read" if "bject" in str(error) else _first_line(error)
        raise ValueError(f"{name} cannot be read as heights: {why}") from error


def _of_netcdf(name, path, dims, channel, units):
    import xarray

    try:
        with _silent(), xarray.open_dataset(path) as held:
            arrays = {str(key): each for key, each in held.data_vars.items() if each.ndim == len(dims)}
            heights = arrays[picked("it", arrays, channel)]
            _check_count(heights.shape)
            heights = heights.load()
    # As above.
    except Exception as error:
        raise ValueError(f"{name} cannot be read as NetCDF: {_first_line(error)}") from error
    for dim, places in heights.coords.items():
        if bare(places)[1] is None and dim in dims:
            if dim not in units:
                raise ValueError(
                    f'{name}: {dim} has no attribute units: write it, or state units = {{{dim} = "um"}}'
                )
            heights = heights.assign_coords({dim: places.assign_attrs(units=units[dim])})
    return _of_labelled(name, heights, dims)


def _of_labelled(name, heights, dims):
    heights, spacings = along(heights, dims)
    numbers, unit = bare(heights)
    own = tuple(spacings[each] for each in reversed(dims)) if len(spacings) == len(dims) else None
    return Heights(name, numbers, unit, own)


def _of_table(table, dims, spacing, unit, written):
    if unit is not None:
        _metres("unit", unit)
        written = replace(written, units={**(written.units or {}), "z": unit})
    columns = read_columns(table, COLUMNS[dims], written, MOST_TEXT)
    if dims == MAP:
        heights, spacings = mapped(columns["x"], columns["y"], columns["z"], columns.place)
        return Heights(columns.name, heights, "m", spacings, columns.notes)
    if "x" not in columns:
        if spacing is None:
            raise ValueError(f'{columns.name} has no column x: state columns = {{x = "..."}}, or spacing = "1 um"')
        return Heights(columns.name, columns["z"], "m", None, columns.notes)
    order, step = ordered("x", columns["x"], columns.place)
    return Heights(columns.name, columns["z"][order], "m", (step,), columns.notes)


def _of_rows(name, path, dims, stated):
    """Rows of numbers and nothing else, of a line also comments above; None of a table."""
    found = None if stated.columns else read_rows(path, stated, MOST_TEXT)
    if found is None:
        return None
    (numbers, line), skipped = found, stated.skip or 0
    width = numbers.shape[1]
    if dims == MAP and line > skipped + 1:
        raise ValueError(
            f"{name}, line {skipped + 1}, is no row of heights: state skip = {line - 1} for the lines above "
            'these, and what they may say, as unit = "um" and pixel = "1 um"'
        )
    unfit = width < LEAST if dims == MAP else width > 1
    if unfit:
        wanted, points = (f"a map has {LEAST} or more", "xyz") if dims == MAP else ("a line has one", "xz")
        raise ValueError(
            f"{name}, line {line}: {width} columns of numbers, and {wanted}; of points state columns = "
            f"{{{', '.join(f'{each} = {k}' for k, each in enumerate(points, 1))}}} and units"
        )
    if dims == MAP:
        refuse_places(f"{name}, line {line}", numbers)
    return Heights(name, numbers if dims == MAP else numbers[:, 0])


def _of_instrument(name, path, channel):
    """A channel of a file by SurfaceTopography, its own choice where none is stated; None of a text."""
    try:
        with _silent():
            from SurfaceTopography import open_topography
            from SurfaceTopography.Exceptions import CannotDetectFileFormat
    except ImportError as missing:
        raise ValueError(
            f"{name}: files other than {', '.join(sorted(ARRAYS | NETCDF | TEXTS))} are read by SurfaceTopography,"
            ' which is not installed: pip install "mdr-bem-crosscheck[topography]"'
        ) from missing
    try:
        with _silent(), open_topography(str(path)) as reader:
            # Those of texts guess separators and units.
            if type(reader).__module__.rpartition(".")[2] in ("Text", "XYZ"):
                return None
            return _of_channel(name, reader, channel)
    except CannotDetectFileFormat as error:  # which lists every reader
        raise ValueError(
            f"{name} is of no format that SurfaceTopography knows, or damaged; a text is called .txt or .csv"
        ) from error
    # Readers of some forty formats raise nearly anything at a damaged file.
    except Exception as error:
        raise ValueError(f"{name} cannot be read by SurfaceTopography: {_first_line(error)}") from error


def _of_channel(name, reader, channel):
    channels, wanted, notes = {}, reader.default_channel, ()
    for number, each in enumerate(reader.channels, 1):
        channels[each.name if each.name not in channels else f"{each.name} ({number})"] = each
    if channel is not None:
        wanted = channels[picked("it", channels, channel)]
    elif len(channels) > 1:
        notes = (f"{name}: its channel {wanted.name!r} is taken, of {brief(', '.join(map(repr, channels)))}",)
    _check_count(wanted.nb_grid_pts)
    stated = wanted.physical_sizes is not None
    # A reader asks for the size that a file lacks; this one is taken off again.
    found = wanted.topography(physical_sizes=None if stated else tuple(map(float, wanted.nb_grid_pts)))
    own = found.unit
    found = found if own is None else found.to_unit("m")
    if found.dim != 2 or 0 in found.nb_grid_pts:
        raise ValueError("it holds a line or nothing, and no map of heights")
    # There the first index is along x, but of matrices, whose rows are along y as those of arrays.
    heights = np.ma.filled(np.ma.array(found.heights(), float), np.nan)
    heights = heights if type(reader).__module__.rpartition(".")[2] in ("Matlab", "H5") else heights.T
    if own is None or not stated:
        return Heights(name, heights, own and "m", None, notes)
    pixel = tuple(float(side) / count for side, count in zip(found.physical_sizes, found.nb_grid_pts, strict=True))
    return Heights(name, heights, "m", pixel, notes)


def _check_count(shape):
    """Raise ValueError for more pixels than are read."""
    if prod(shape) > MOST_PIXELS:
        raise ValueError(
            f"{brief(' x '.join(map(str, reversed(shape))))} pixels: at most {MOST_PIXELS} are read; take a part "
            "of them"
        )


def _metres(name, unit):
    """A unit of length [m]. Raises ValueError."""
    try:
        return float(in_unit(1.0, unit, "m"))
    except (ValueError, AttributeError, TypeError) as error:
        raise ValueError(f'{name} = {brief(repr(unit))}: a unit of length is needed, as "um"; {error}') from None


@contextmanager
def _silent() -> Iterator[None]:
    """Keep a reader from warning and printing."""
    with warnings.catch_warnings(), redirect_stdout(StringIO()), redirect_stderr(StringIO()):
        warnings.simplefilter("ignore")
        yield


def _first_line(error):
    return brief(next(iter(str(error).strip().splitlines()), "") or type(error).__name__)
