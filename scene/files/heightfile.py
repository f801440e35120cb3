"""Heights of a map or a line out of a file or an object of Python, in metres: one form each, nothing is guessed.

A file is
    an array (.npy), or an archive of arrays (.npz), from which `channel` picks one
    a file of NetCDF (.nc), whose variables are arrays along y and x, or x, with units in attributes
    a text (.txt, .csv, .tsv, .xyz, .asc, .dat; for a line any other too) of numbers and nothing else, a row of the
        map a line, the first at the lowest y; of a line one number a row, with comments above. Empty cells and nan
        are missing
    a table of points, columns x, y and z, of a line x and z, with their units in the heading, see `tablefile`
    for a map, whatever the package SurfaceTopography reads (extra `topography`)

In Python arrays, tables and arrays of xarray have the same form. Options of `TableFormat` state what differs of a
text or a table. A unit, a pixel or a spacing that a file lacks has to be stated; one that it has must agree.
"""

import warnings
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from math import prod
from pathlib import Path
from typing import Any

import numpy as np

from ..numeric_input import bare, in_unit
from ..printable import brief, shown
from ..quantities import METRE, argument
from ..surfaces.heightmap import LEAST, sides, unmasked
from .files import checked
from .lattice import mapped, ordered, refuse_places
from .stated import TableFormat
from .tablefile import Column, read_columns
from .tabletext import read_text

MAP, LINE = ("y", "x"), ("x",)
EVEN = 1e-3  # relative, of units and spacings that are stated twice: a file rounds them
MOST_PIXELS = 5120**2  # that are read of a file
MOST_BYTES, MOST_TEXT = 2**28, 2**27  # of a file, and of a text
ARRAYS, NETCDF, TEXTS = {".npy", ".npz"}, {".nc"}, {".txt", ".csv", ".tsv", ".xyz", ".asc", ".dat"}
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

    def settled(self, dims: tuple[str, ...], spacing: Any, unit: str | None = None) -> "Settled":
        """Heights [m], their pixel or spacing, and notes: what is stated and what was read put together.

        Raises ValueError where one of them is stated twice and differs, and where it is stated nowhere.
        """
        step = "pixel" if dims == MAP else "spacing"
        metre, own = _metres("unit", unit), _metres("unit of heights", self.unit)
        size = None if spacing is None else argument(step, spacing, sides)
        for name, given, stated, read in (("unit", unit, metre, own), (step, spacing, size, self.spacings)):
            if stated is None and read is None:
                example = "um" if name == "unit" else "1 um"
                raise ValueError(f'{self.name} does not state its {name}: state it, as {name} = "{example}"')
            if stated is not None and read is not None and not np.allclose(stated, read, rtol=EVEN, atol=0):
                there = " x ".join(f"{each:.6g}" for each in np.ravel(read))
                raise ValueError(
                    f"{name} = {shown(given)}: {self.name} states its own, {there} m: leave {name} out"
                )
        # First the numbers in full: those of half precision end where nanometres begin.
        heights = np.asarray(argument(self.name, self.numbers, METRE.values), float)
        with np.errstate(over="ignore"):  # beyond the range of numbers is not finite, and refused
            heights = heights * (metre if own is None else own)
        if spacing is None:
            spacing = self.spacings if dims == MAP else self.spacings[0]  # type: ignore[index]
        return heights, spacing, self.notes


Settled = tuple[np.ndarray, Any, tuple[str, ...]]


def read_heights(
    source: Any, dims: tuple[str, ...], spacing: Any, unit: str | None, channel: str | None, written: TableFormat
) -> Settled:
    """Heights [m], their pixel or spacing, and notes.

    source : the path of a file; or an array, a table or an object of xarray, arrays without a unit in metres
    dims : MAP or LINE
    spacing, unit : as stated, where the source has none; channel : which of several arrays or maps is read
    written : what is stated of a text or a table

    Raises ValueError naming the file, with what is allowed.
    """
    file, columns = isinstance(source, Path), list(getattr(source, "columns", ()))
    name, kind = (brief(str(source)), source.suffix.lower()) if file else ("heights", "")
    place = checked(source, MOST_BYTES) if file else source
    text = file and (kind in TEXTS or (dims == LINE and kind not in ARRAYS | NETCDF))
    # A DataFrame whose columns are only counted is an array.
    mapping = isinstance(source, Mapping) or hasattr(source, "data_vars") or columns != list(range(len(columns)))
    if channel is not None and (text or not file):
        raise ValueError(f"channel = {shown(channel)}: {name} is one map; skip and rows choose a part of a text")
    if written != TableFormat() and not (text or mapping):
        raise ValueError(f"{name} is no text and no table: leave out columns, units, separators and lines")
    found = _of_rows(name, source, dims, written) if text else None
    if found is None and (text or mapping):
        return _of_table(source, dims, spacing, unit, written)
    if found is None and file:
        read = _of_arrays if kind in ARRAYS else _of_netcdf if kind in NETCDF else _of_instrument
        found = read(name, place, dims, channel)
    elif found is None and hasattr(source, "dims"):
        found = _of_labelled(name, source, dims)
    elif found is None:
        numbers, own = argument(name, source, lambda each: bare(unmasked(each)))
        found = Heights(name, numbers, "m" if own is None and unit is None else own)
    return found.settled(dims, spacing, unit)


def picked(channels: Iterable[str], channel: str | None) -> str:
    """The channel that is chosen, or the only one. Raises ValueError with the names of all."""
    names = list(channels)
    if channel is None and len(names) == 1:
        return names[0]
    if channel is None or names.count(channel) != 1:
        raise ValueError(f"channel = {shown(channel)}: state one of {brief(', '.join(map(repr, names)))}")
    return channel


def _of_arrays(name, path, dims, channel):
    """The array of a .npy file, or one of an .npz archive; no object is made of what is pickled."""
    with _reading(name, "as an array"), path.open("rb") as file:
        held = np.load(file)
        if not isinstance(held, np.ndarray):
            held = np.asarray(held[picked(held.files, channel)])
        elif channel is not None:
            raise ValueError(f"channel = {shown(channel)}: it holds one array, leave channel out")
        _check_count(held.shape)
    return Heights(name, held)


def _of_netcdf(name, path, dims, channel):
    import xarray

    with _reading(name, "as NetCDF"), xarray.open_dataset(path) as held:
        arrays = {str(key): each for key, each in held.data_vars.items() if each.ndim == len(dims)}
        heights = arrays[picked(arrays, channel)]
        _check_count(heights.shape)
        return _of_labelled(name, heights.load(), dims)


def _of_labelled(name, heights, dims):
    """An array of xarray with the dimensions dims; those whose coordinates have no unit have no spacing."""
    heights, spacings = argument("dimensions of heights", heights.dims, lambda _: heights.transpose(*dims)), {}
    for dim in set(dims) & set(heights.coords):
        places = np.asarray(argument(f"coordinates of {dim}", heights.coords[dim], METRE.values), float)
        order, step = ordered(dim, places, f"{name}, coordinate {{}}".format)
        if bare(heights.coords[dim])[1] is not None:
            spacings[dim] = step
        heights = heights.isel({dim: order})
    own = tuple(spacings[each] for each in reversed(dims)) if len(spacings) == len(dims) else None
    return Heights(name, *bare(heights), own)


def _of_table(table, dims, spacing, unit, written):
    if unit is not None:
        _metres("unit", unit)
        written = replace(written, units={**(written.units or {}), "z": unit})
    columns = read_columns(table, COLUMNS[dims], written, MOST_TEXT)
    heights, spacings = columns["z"], None
    if dims == MAP:
        heights, spacings = mapped(columns["x"], columns["y"], heights, columns.place)
    elif "x" in columns:
        order, step = ordered("x", columns["x"], columns.place)
        heights, spacings = heights[order], (step,)
    return Heights(columns.name, heights, "m", spacings, columns.notes).settled(dims, spacing)


def _of_rows(name, path, dims, stated):
    """Rows of numbers and nothing else, of a line also comments above; None of a table."""
    cells = None if stated.columns else read_text(path, stated, MOST_TEXT, rectangle=True)
    if cells is None:
        return None
    line, skipped = cells.frame.index[0], stated.skip or 0
    # Where a separator ends each row, there is no cell behind it.
    width = len(cells.headings) - (not cells.frame.iloc[:, -1].any())
    numbers = np.stack([cells.finite(k, gaps=True) for k in range(width)], axis=1)
    if dims == MAP and line > skipped + 1:
        raise ValueError(
            f"{name}, line {skipped + 1}, is no row of heights: state skip = {line - 1} for the lines above "
            'these, and what they may say, as unit = "um" and pixel = "1 um"'
        )
    if width < LEAST if dims == MAP else width > 1:
        raise ValueError(
            f"{name}, line {line}: {width} columns of numbers alone: of points state columns = "
            "{x = 1, z = 2}, of a map also y, and units"
        )
    if dims == MAP:
        refuse_places(f"{name}, line {line}", numbers)
    return Heights(name, numbers if dims == MAP else numbers[:, 0])


def _of_instrument(name, path, dims, channel):
    """A channel of a file by SurfaceTopography."""
    with _reading(name, "by SurfaceTopography (mdr-bem-crosscheck[topography]); a text is called .txt or .csv"):
        from SurfaceTopography import open_topography

        with open_topography(str(path)) as reader:
            kind = type(reader).__module__.rpartition(".")[2]
            if kind in ("Text", "XYZ"):  # which guess separators and units
                raise ValueError("it is a text")
            names = [each.name for each in reader.channels]
            return _of_channel(
                name, reader.channels[names.index(picked(names, channel))], kind in ("Matlab", "H5")
            )


def _of_channel(name, channel, matrix):
    """matrix : whether rows are along y, as those of arrays; the first index of others is along x"""
    _check_count(channel.nb_grid_pts)
    stated = channel.physical_sizes is not None
    # A reader asks for the size that a file lacks; this one is taken off again.
    found = channel.topography(physical_sizes=None if stated else tuple(map(float, channel.nb_grid_pts)))
    own = found.unit
    found = found if own is None else found.to_unit("m")
    heights = np.ma.filled(np.ma.array(found.heights(), float), np.nan)
    heights = heights if matrix else heights.T
    if own is None or not stated:
        return Heights(name, heights, own and "m")
    pixel = tuple(float(side) / count for side, count in zip(found.physical_sizes, found.nb_grid_pts, strict=True))
    return Heights(name, heights, "m", pixel)


def _check_count(shape):
    """Raise ValueError for more pixels than are read."""
    if prod(shape) > MOST_PIXELS:
        raise ValueError(f"{brief(str(tuple(shape)))} pixels: at most {MOST_PIXELS} are read; take a part of them")


def _metres(name, unit):
    """A unit of length [m], None of none. Raises ValueError."""
    try:
        return None if unit is None else float(in_unit(1.0, unit, "m"))
    except (ValueError, AttributeError, TypeError) as error:
        raise ValueError(f'{name} = {brief(repr(unit))}: a unit of length is needed, as "um"; {error}') from None


@contextmanager
def _reading(name: str, how: str) -> Iterator[None]:
    """Keep a reader from warning. Raises ValueError for whatever it raises of a damaged file."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    except Exception as error:
        why = next(iter(str(error).strip().splitlines()), "") or type(error).__name__
        raise ValueError(f"{name} cannot be read {how}: {brief(why)}") from error
