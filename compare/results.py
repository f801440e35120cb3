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
            with xarray.open_datatree(BytesIO(_unsealed(path.read_bytes())), engine="h5netcdf") as tree:
                for node in tree.subtree:
                    parts[f"{place}{node.path}".rstrip("/") or "/"] = node.to_dataset(inherit=False).load()
        except (ValueError, KeyError, TypeError, RuntimeError) as error:
            raise InvalidInput(f"{path}: is no file of results, or is damaged: {error}") from error
    return xarray.DataTree.from_dict(parts)


def _unsealed(content):
    covered, seal = content[:-SEALED], content[-SEALED:]
    if seal != SEAL + hashlib.sha256(covered).hexdigest().encode():
        raise ValueError("the file is damaged, or was not written by this program")
    return covered


def _fill(place, node):
    """A node as a group, directly: the writer of xarray takes ten times as long for many small Datasets."""
    dataset = node.to_dataset(inherit=False)
    for name, length in dataset.sizes.items():
        if name not in dataset.variables:
            scale = place.create_dataset(name, (length,), ">f4")
            scale.make_scale(f"This is a netCDF dimension but not a netCDF variable.{length:10d}")
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
        place.attrs["coordinates"] = " ".join(beside)  # as CF has it
    for name, child in node.children.items():
        _fill(place.create_group(name, track_order=True), child)
