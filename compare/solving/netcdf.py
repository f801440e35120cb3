"""File of results: everything that a command solved, as one netCDF-4 file under a seal."""

import hashlib
import re
from collections.abc import Iterator
from io import BytesIO
from math import prod
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import xarray

from scene.files import Unreadable, content
from scene.printable import brief
from scene.reading import InvalidInput
from scene.result import source

from .folders import FORMAT, MANIFEST, UNSTATED, Stated, read, refuse_other

NAME = "results.nc"
# Behind the last byte that HDF5 knows of, which readers pass over: the format of the folder, and a seal, by which
# any change of any byte shows.
LABEL, LABELLED = f"crosscheck format {FORMAT} ".encode(), re.compile(rb"crosscheck format (\d{1,9}) \Z")
SEAL = b"sha256:"
SEALED = len(SEAL) + 64
# Arrays from so many bytes on are compressed.
LARGE = 2**12
# How netCDF-4 writes a dimension without a variable, its own attributes, and what CF calls other coordinates.
NAMELESS = b"This is a netCDF dimension but not a netCDF variable."
LISTED, SCALE = "DIMENSION_LIST", b"DIMENSION_SCALE"
OF_FORMAT = {"CLASS", "NAME", LISTED, "REFERENCE_LIST"}
BESIDE = "coordinates"
# Most bytes of a file, and the factor by which it may unpack: gzip, the only packing of ours, packs no more.
MOST_BYTES, PACKED = 2**31, 1032
LEAST_READ = 16  # texts at once
FILTERS = {h5py.h5z.FILTER_DEFLATE, h5py.h5z.FILTER_SHUFFLE}


def packed(answers: xarray.DataTree) -> bytes:
    """Everything that was solved as one netCDF-4 file."""
    made = BytesIO()
    with h5py.File(made, "w", track_order=True) as file:
        _fill(file, answers)
        file.attrs["source"] = source()
    image = made.getvalue() + LABEL
    return image + SEAL + hashlib.sha256(image).hexdigest().encode()


def digest(file: bytes) -> str:
    """Digest of a file of results, which stands at its end."""
    return file[len(SEAL) - SEALED :].decode()


def load(folder: str | Path) -> xarray.DataTree:
    """Everything that a command solved, as it left it in a folder: a Dataset for each parameter grid and solver.

    Each single draw is there, with `status` and `reason`; units and definitions are attributes. A folder of
    several studies has each below its name.

    Raises InvalidInput where there are no results, or they are damaged, too large, no such file, of another
    version or of another run than the manifest beside them, or where a run has not come to its end.
    """
    folder = Path(folder)
    if not folder.exists():
        raise InvalidInput(f"{brief(str(folder))}: no such file or folder")
    paths, stated = [folder], {}
    if folder.is_dir():
        paths = sorted(folder.rglob(NAME))
        places = [place for place in {folder, *(path.parent for path in paths)} if (place / MANIFEST).exists()]
        stated = {place: read(place / MANIFEST, Stated).results for place in places}
    if not paths:
        raise InvalidInput(f"{brief(str(folder))}: no command has left results here")
    parts: dict[str, xarray.Dataset] = {}
    for path in paths:
        place = "" if path == folder or path.parent == folder else f"/{path.parent.relative_to(folder).as_posix()}"
        try:
            sealed = content(path, MOST_BYTES)
            image = _unsealed(sealed)
            if stated.get(path.parent, "") not in ("", digest(sealed)):
                raise InvalidInput(
                    f"{brief(str(path))}: is of another run than {MANIFEST} beside it: run the command again"
                )
            label = LABELLED.search(image[-2 * len(LABEL) :])
            refuse_other(path, int(label[1]) if label else UNSTATED)
            with h5py.File(BytesIO(image)) as file:
                reader = _Reader(file, len(image))
                parts |= {f"{place}{at}".rstrip("/") or "/": dataset for at, dataset in reader.datasets(file)}
        except Unreadable as error:
            raise InvalidInput(str(error)) from error
        except InvalidInput:
            raise
        # A file that was made to look like one of ours raises nearly anything.
        except Exception as error:
            raise InvalidInput(
                f"{brief(str(path))}: is not a file of results, or is damaged: {brief(str(error))}"
            ) from error
    try:
        return xarray.DataTree.from_dict(parts)
    except Exception as error:
        names = brief(", ".join(map(str, paths)))
        raise InvalidInput(f"{names}: its results do not go together: {brief(str(error))}") from error


def _unsealed(image):
    covered, seal = image[:-SEALED], image[-SEALED:]
    if seal != SEAL + hashlib.sha256(covered).hexdigest().encode():
        raise ValueError("the file is damaged, or was not written by this program")
    return covered


class _Reader:
    """Reads what `_fill` has written, and refuses all else that HDF5 can hold.

    size : bytes of the file
    """

    def __init__(self, file: h5py.File, size: int):
        room = min(MOST_BYTES, PACKED * size)
        self.room = room
        self._seen: set[Any] = {file["/"]}
        self._some = max(LEAST_READ, room // size)  # texts that fit, were each as long as the file

    def datasets(self, place: h5py.Group) -> Iterator[tuple[str, xarray.Dataset]]:
        """Every group as its path and a Dataset, directly: to open many, xarray takes ten times as long."""
        for name in place:
            if not isinstance(place.get(name, getlink=True), h5py.HardLink):
                raise ValueError(f"{name} is a link to elsewhere")
        inside = dict(place.items())
        for name, each in inside.items():
            if each in self._seen or not isinstance(each, h5py.Dataset | h5py.Group):
                raise ValueError(f"{name} stands in several places, or is a mere type")
            self._seen.add(each)
        stored = {name: each for name, each in inside.items() if isinstance(each, h5py.Dataset)}
        scales = {each: name for name, each in stored.items() if _mark(each, "CLASS") == SCALE}
        nameless = {each for each in scales if _mark(each, "NAME").startswith(NAMELESS)}
        variables = {name: self._variable(each, scales) for name, each in stored.items() if each not in nameless}
        said = _said(place)
        beside = said.pop(BESIDE, "").split()
        yield place.name, xarray.Dataset(variables, attrs=said).set_coords(beside)
        for child in inside.values():
            if isinstance(child, h5py.Group):
                yield from self.datasets(child)

    def _variable(self, stored, scales):
        said = _said(stored)
        # The name of a scale takes HDF5 long to find, so it is looked up.
        dims = [scales[stored]] if stored in scales else [scales[each] for each in _attached(stored)]
        if len({*dims}) < len(dims):
            raise ValueError(f"{stored.name} has a dimension twice")
        values = self._values(stored)
        if said.get("dtype") == "bool" and values.dtype == np.int8:
            values, said = values.astype(bool), {key: value for key, value in said.items() if key != "dtype"}
        return xarray.Variable(dims, values, said)

    def _values(self, stored):
        plist = stored.id.get_create_plist()
        filters = {plist.get_filter(k)[0] for k in range(plist.get_nfilters())}
        if stored.is_virtual or stored.external or not filters <= FILTERS or stored.shape is None:
            raise ValueError(f"{stored.name} is not stored as this program stores numbers")
        text = h5py.check_string_dtype(stored.dtype)
        if not text and (stored.dtype.kind not in "iuf" or stored.dtype.metadata):  # an enumeration has some
            raise ValueError(f"{stored.name} is of type {stored.dtype}, which holds no results")
        self._take(stored, stored.dtype.itemsize * max(stored.size, prod(stored.chunks or ())))
        return self._words(stored) if text else stored[()]

    def _words(self, stored):
        """Texts, some at a time: all of them may be one and the same in the file, and very long."""
        words = np.empty(stored.shape, object)
        for some in _pieces(stored.shape, self._some):
            words[some] = stored.asstr()[some]
            self._take(stored, sum(map(len, np.ravel(words[some]))))
        self._take(stored, 4 * words.size * max(map(len, words.ravel()), default=0))
        return words.astype(str)

    def _take(self, stored, size):
        self.room -= size
        if self.room < 0:
            raise ValueError(f"{stored.name} unpacks to more than such a file can hold")


def _pieces(shape, most):
    """Parts of an array, each of so many numbers at most, that together are the whole, as indices."""
    below = prod(shape[1:])
    if below > most:
        yield from ((k, *inside) for k in range(shape[0]) for inside in _pieces(shape[1:], most))
    elif shape:
        rows = most // max(below, 1)
        yield from ((slice(k, k + rows),) for k in range(0, shape[0], rows))
    else:
        yield ()


def _attached(stored):
    """The scale of each dimension. HDF5 itself ends the process over a list that is none of references."""
    if not stored.shape:
        return
    of = LISTED in stored.attrs and h5py.check_vlen_dtype(stored.attrs.get_id(LISTED).dtype)
    listed = stored.attrs[LISTED] if of and h5py.check_ref_dtype(of) is h5py.Reference else np.empty(())
    if listed.shape != (stored.ndim,) or any(len(scales) != 1 for scales in listed):
        raise ValueError(f"{stored.name} has dimensions without a name each")
    for (scale,) in listed:
        yield stored.file[scale]


def _said(place):
    """Attributes that are not of the format: texts, one each."""
    names = [name for name in place.attrs if name not in OF_FORMAT]
    for name, found in zip(names, map(place.attrs.get_id, names), strict=True):
        of = h5py.check_string_dtype(found.dtype)
        if found.shape != () or not of or of.length is not None:
            raise ValueError(f"{place.name} has an attribute {name}, which is no text")
    said = {name: place.attrs[name] for name in names}
    "".join(said.values()).encode()  # raises ValueError of bytes that were no UTF-8
    return said


def _mark(stored, name):
    """A text of the format, empty without one. HDF5's own `is_scale` ends the process over a damaged one."""
    found = stored.attrs.get_id(name) if name in stored.attrs else None
    return bytes(stored.attrs[name]) if found and found.shape == () and found.dtype.kind == "S" else b""


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
