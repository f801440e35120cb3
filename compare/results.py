"""File of results: everything that a command solved, as one netCDF-4 file under a seal."""

import hashlib
from io import BytesIO
from pathlib import Path

import h5py
import numpy as np
import xarray

from scene.reading import InvalidInput

from . import store

NAME = "results.nc"
# Behind the last byte that the format knows of: readers pass over it, and any change of any byte shows.
SEAL = b"sha256:"
SEALED = len(SEAL) + 64
# Arrays from so many bytes on are compressed.
LARGE = 2**12
# How netCDF-4 writes a dimension without a variable, its own attributes, and what CF calls other coordinates.
NAMELESS = b"This is a netCDF dimension but not a netCDF variable."
OF_FORMAT = {"CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST"}
BESIDE = "coordinates"


def write(path: Path, answers: xarray.DataTree) -> None:
    """Write everything that was solved as one netCDF-4 file, whole or not at all. Raises OSError."""
    content = BytesIO()
    with h5py.File(content, "w", track_order=True) as file:
        _fill(file, answers)
    image = content.getvalue()
    seal = SEAL + hashlib.sha256(image).hexdigest().encode()
    store.write(path, lambda file: file.write(image + seal))


def load(folder: str | Path) -> xarray.DataTree:
    """Everything that a command solved, as it left it in a folder: a Dataset for each rectangle and solver.

    Each single draw is there, with `status` and `reason`; units and definitions are attributes. A folder of
    several studies has each below its name.

    Raises InvalidInput where there are no results or they are damaged, OSError for what cannot be read.
    """
    folder = Path(folder)
    paths = [folder] if folder.is_file() else sorted(folder.rglob(NAME))
    if not folder.exists():
        raise InvalidInput(f"{folder}: no such file or folder")
    if not paths:
        raise InvalidInput(f"{folder}: no command has left results here")
    parts: dict[str, xarray.Dataset] = {}
    for path in paths:
        place = "" if path == folder or path.parent == folder else f"/{path.parent.relative_to(folder).as_posix()}"
        try:
            with h5py.File(BytesIO(_unsealed(path.read_bytes()))) as file:
                parts |= {f"{place}{at}".rstrip("/") or "/": dataset for at, dataset in _datasets(file)}
        except (ValueError, KeyError, TypeError, RuntimeError) as error:
            raise InvalidInput(f"{path}: is no file of results, or is damaged: {error}") from error
    return xarray.DataTree.from_dict(parts)


def _unsealed(content):
    covered, seal = content[:-SEALED], content[-SEALED:]
    if seal != SEAL + hashlib.sha256(covered).hexdigest().encode():
        raise ValueError("the file is damaged, or was not written by this program")
    return covered


def _datasets(place):
    """Every group as its path and a Dataset, directly: xarray takes ten times as long to open many small ones."""
    stored = {name: each for name, each in place.items() if isinstance(each, h5py.Dataset)}
    scales = {each: name for name, each in stored.items() if each.is_scale}
    variables = {name: _variable(each, scales) for name, each in stored.items() if not _nameless(each)}
    said = {key: value for key, value in place.attrs.items() if key != BESIDE}
    yield place.name, xarray.Dataset(variables, attrs=said).set_coords(place.attrs.get(BESIDE, "").split())
    for child in place.values():
        if isinstance(child, h5py.Group):
            yield from _datasets(child)


def _variable(stored, scales):
    said = {key: value for key, value in stored.attrs.items() if key not in OF_FORMAT}
    # The name of a scale takes HDF5 long to find, so it is looked up.
    dims = [scales[stored]] if stored in scales else [scales[dim[0]] for dim in stored.dims]
    text = h5py.check_string_dtype(stored.dtype)
    values = np.asarray(stored.asstr()[()], object).astype(str) if text else stored[()]
    if said.get("dtype") == "bool":
        values, said = values.astype(bool), {key: value for key, value in said.items() if key != "dtype"}
    return xarray.Variable(dims, values, said)


def _nameless(stored):
    return stored.is_scale and stored.attrs["NAME"].startswith(NAMELESS)


def _fill(place, node):
    """A node as a group, directly: the writer of xarray takes ten times as long for many small Datasets."""
    dataset = node.to_dataset(inherit=False)
    for name, length in dataset.sizes.items():
        if name not in dataset.variables:
            scale = place.create_dataset(name, (length,), ">f4")
            scale.make_scale(NAMELESS + f"{length:10d}".encode())
    for name, each in dataset.variables.items():
        values, said = each.values, {key: str(text) for key, text in each.attrs.items() if str(text)}
        if values.dtype == bool:
            values, said = values.astype(np.int8), {**said, "dtype": "bool"}
        text = values.dtype.kind in "UO"
        packed = {} if text or not each.dims or values.nbytes < LARGE else {"compression": 1, "shuffle": True}
        stored = place.create_dataset(
            name,
            data=values.astype(object) if text else values,
            dtype=h5py.string_dtype() if text else None,
            **packed,
        )
        stored.attrs.update(said)
        if each.dims == (name,):
            stored.make_scale(name)
    for name, each in dataset.variables.items():
        for axis, dimension in enumerate(() if each.dims == (name,) else each.dims):
            place[name].dims[axis].attach_scale(place[dimension])
    place.attrs.update({key: str(text) for key, text in dataset.attrs.items()})
    if beside := [str(name) for name in dataset.coords if name not in dataset.dims]:
        place.attrs[BESIDE] = " ".join(beside)
    for name, child in node.children.items():
        _fill(place.create_group(name, track_order=True), child)
