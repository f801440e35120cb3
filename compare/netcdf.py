"""Bytes of a netCDF-4 file: variables with dimensions and attributes, in groups, under a seal."""

import hashlib
from collections.abc import Iterator, Mapping
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from functools import lru_cache
from math import prod
from typing import Any

import h5py
import numpy as np
from h5py import h5a, h5d, h5f, h5o, h5p, h5s, h5t

# Arrays from so many bytes on are compressed, in pieces of at most so many.
LARGE, PIECE = 2**12, 2**20
# Behind the last byte that the format knows of: it reads past nothing, and any change of any byte shows.
SEAL = b"sha256:"
SEALED = len(SEAL) + 64
# What netCDF-4 writes into a dimension that has no variable of its own.
NO_VARIABLE = "This is a netCDF dimension but not a netCDF variable."


@dataclass(frozen=True)
class Variable:
    """Values along named dimensions, with what they are.

    dimensions : a name an axis; of the same length wherever the group uses it
    values : numbers, truth values, or strings in an array of objects
    """

    dimensions: tuple[str, ...]
    values: np.ndarray
    attributes: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Group:
    """Variables, attributes and groups below, each by name."""

    variables: Mapping[str, Variable] = field(default_factory=dict)
    attributes: Mapping[str, str] = field(default_factory=dict)
    groups: Mapping[str, "Group"] = field(default_factory=dict)


def encoded(group: Group) -> bytes:
    """A file of it, sealed. Raises ValueError where lengths disagree, TypeError for values that it cannot hold."""
    stored = _storable(group)
    with h5py.File.in_memory(_form(_outline(stored))) as file:
        _fill(file.id, stored)
        file.flush()
        content = file.id.get_file_image()
    return content + SEAL + hashlib.sha256(content).hexdigest().encode()


def unsealed(content: bytes) -> bytes:
    """What the seal of a file covers. Raises ValueError if a byte of it was changed or is missing."""
    covered, seal = content[:-SEALED], content[-SEALED:]
    if seal != SEAL + hashlib.sha256(covered).hexdigest().encode():
        raise ValueError("the file is damaged, or was not written by this program")
    return covered


@contextmanager
def opened(content: bytes) -> Iterator["Reader"]:
    """A sealed file to read from. Raises ValueError as `unsealed`."""
    access = h5p.create(h5p.FILE_ACCESS)
    access.set_fapl_core(backing_store=False)
    access.set_file_image(unsealed(content))
    with closing(h5f.open(b"sealed", h5f.ACC_RDONLY, access)) as file:
        yield Reader(file)


@dataclass(frozen=True)
class Reader:
    """A group of an open file."""

    group: Any

    def __contains__(self, name: str) -> bool:
        return name.encode() in self.group

    def below(self, name: str) -> "Reader":
        """A group of this group. Raises KeyError."""
        return Reader(h5o.open(self.group, name.encode()))

    def values(self, name: str) -> np.ndarray:
        """Values of a variable, bit for bit as they were stored. Raises KeyError."""
        found = h5d.open(self.group, name.encode())
        if found.get_type().get_class() == h5t.STRING:
            return np.array(h5py.Dataset(found).asstr()[()], object)
        values = np.empty(found.shape, found.dtype)
        if values.size:
            found.read(h5s.ALL, h5s.ALL, values)
        return values.astype(bool) if h5a.exists(found, b"dtype") else values

    def floats(self, name: str, count: int) -> list[float]:
        """Numbers of a variable that has so many. Raises KeyError."""
        values = np.empty(count)
        if count:
            h5d.open(self.group, name.encode()).read(h5s.ALL, h5s.ALL, values)
        return values.tolist()

    def text(self, name: str) -> str:
        """An attribute that is text. Raises KeyError."""
        found = h5a.open(self.group, name.encode())
        value = np.empty((), found.dtype)
        found.read(value)
        return value.item().decode()


def _storable(group):
    """The group, with values as the format has them: truth values are small numbers that say so."""
    variables = {name: _stored(name, variable) for name, variable in group.variables.items()}
    groups = {name: _storable(below) for name, below in group.groups.items()}
    return Group(variables, group.attributes, groups)


def _stored(name, variable):
    values, attributes = np.ascontiguousarray(variable.values), variable.attributes
    values = values.reshape(np.shape(variable.values))
    if values.dtype == bool:
        values, attributes = values.astype(np.int8), {**attributes, "dtype": "bool"}
    if values.dtype.kind not in "iufO":
        raise TypeError(f"{name} is of type {values.dtype}, which no file of results can hold")
    return Variable(variable.dimensions, values, attributes)


@dataclass(frozen=True)
class _Outline:
    """All of a group but its values and attributes.

    variables : name, dimensions, shape, type and attributes of each ; groups : name and outline of each
    """

    variables: tuple[tuple[str, tuple[str, ...], tuple[int, ...], np.dtype, tuple[tuple[str, str], ...]], ...]
    groups: tuple[tuple[str, "_Outline"], ...]


def _outline(group):
    return _Outline(
        tuple(
            (name, each.dimensions, each.values.shape, each.values.dtype, tuple(each.attributes.items()))
            for name, each in group.variables.items()
        ),
        tuple((name, _outline(below)) for name, below in group.groups.items()),
    )


@lru_cache(maxsize=64)
def _form(outline: _Outline) -> bytes:
    """A file without values, to be filled in: to make one takes ten times as long as to fill it."""
    with h5py.File.in_memory(track_order=True) as file:
        _lay_out(file, outline)
        file.flush()
        return file.id.get_file_image()


def _lay_out(place, outline):
    """Dimensions first, a variable of the same name being the dimension itself."""
    own = {name for name, dimensions, *_ in outline.variables if dimensions == (name,)}
    for name, length in _lengths(outline).items():
        if name not in own:
            place.create_dataset(name, (length,), ">f4").make_scale(f"{NO_VARIABLE}{length:10d}")
    for name, _, shape, kind, attributes in outline.variables:
        made = place.create_dataset(name, shape, **_layout(shape, kind))
        for key, text in attributes:
            _describe(made.id, key, text)
        if name in own:
            made.make_scale(name)
    for name, dimensions, *_ in outline.variables:
        for axis, dimension in enumerate(() if name in own else dimensions):
            place[name].dims[axis].attach_scale(place[dimension])
    for name, below in outline.groups:
        _lay_out(place.create_group(name, track_order=True), below)


def _lengths(outline):
    found: dict[str, int] = {}
    for name, dimensions, shape, *_ in outline.variables:
        for dimension, length in zip(dimensions, shape, strict=True):
            if found.setdefault(dimension, length) != length:
                raise ValueError(f"{name} has {length} along {dimension}, where others have {found[dimension]}")
    return found


def _layout(shape, kind):
    if kind.hasobject:
        return {"dtype": h5py.string_dtype()}
    size = kind.itemsize * prod(shape)
    if size < LARGE or not shape:
        return {"dtype": kind}
    rows = max(1, PIECE * shape[0] // size)
    chunks = (min(rows, shape[0]), *shape[1:])
    return {"dtype": kind, "chunks": chunks, "compression": 1, "shuffle": True}


def _fill(place, group):
    for name, variable in group.variables.items():
        found = h5d.open(place, name.encode())
        if variable.values.dtype == object:
            h5py.Dataset(found)[...] = variable.values
        elif variable.values.size:
            found.write(h5s.ALL, h5s.ALL, variable.values)
    for name, text in group.attributes.items():
        _describe(place, name, text)
    for name, below in group.groups.items():
        _fill(h5o.open(place, name.encode()), below)


def _describe(owner, name, text):
    """An attribute, in a tenth of the time that the general way takes."""
    content = text.encode() or b" "
    kind = h5t.C_S1.copy()
    kind.set_size(len(content))
    kind.set_cset(h5t.CSET_UTF8)
    made = h5a.create(owner, name.encode(), kind, h5s.create(h5s.SCALAR))
    made.write(np.array(content, f"S{len(content)}"), kind)
