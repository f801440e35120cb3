"""Arrays in numpy's files: each is read only if its header allows it, and no object is ever made of one."""

import warnings
from collections.abc import Callable, Mapping
from io import BytesIO
from math import prod
from zipfile import ZIP_DEFLATED, ZIP_STORED, ZipFile

import numpy as np

_HEADER = 2**14  # bytes with which an array begins, its header among them
_MEMBERS = 1000  # of an archive; each is listed by _LISTED
_LISTED = b"PK\1\2"
_HEADERS = {
    (1, 0): np.lib.format.read_array_header_1_0,
    (2, 0): np.lib.format.read_array_header_2_0,
}

# Raises ValueError for a shape and a type that are not to be read.
Check = Callable[[tuple[int, ...], np.dtype], None]


def array_in(content: bytes, check: Check) -> np.ndarray:
    """The array of a .npy file. Raises ValueError, and whatever a damaged header raises."""
    return _array(BytesIO(content), len(content), check)


def names_in(content: bytes) -> list[str]:
    """Names of the arrays of an .npz archive. Raises ValueError, and whatever a damaged archive raises."""
    with _opened(content) as archive:
        return [_name(member) for member in archive.infolist()]


def arrays_in(content: bytes, checks: Mapping[str, Check]) -> dict[str, np.ndarray]:
    """Arrays of an .npz archive by their names, of those that have a check.

    Raises ValueError, and whatever a damaged archive raises.
    """
    with _opened(content) as archive:
        members = archive.infolist()
        held = [_name(member) for member in members]
        if doubled := [name for name in checks if held.count(name) > 1]:
            raise ValueError(f"it has {held.count(doubled[0])} arrays {doubled[0]}")
        found = {}
        for name, member in zip(held, members, strict=True):
            if name not in checks:
                continue
            # Others unpack all they have at once.
            if member.compress_type not in (ZIP_STORED, ZIP_DEFLATED):
                raise ValueError(f"{member.filename} is compressed otherwise than by deflate, as numpy does")
            with archive.open(member) as file:
                found[name] = _array(file, member.file_size, checks[name])
    return found


def _opened(content):
    if content.count(_LISTED) > _MEMBERS:
        raise ValueError(f"an archive of more than {_MEMBERS} files")
    return ZipFile(BytesIO(content))


def _name(member):
    return member.filename.removesuffix(".npy")


def _array(file, size, check):
    """The array of an open file of so many bytes, unpacked."""
    begun = BytesIO(file.read(_HEADER))
    version = np.lib.format.read_magic(begun)
    if version not in _HEADERS:
        raise ValueError(f"an array in version {version} of the format: 1.0 or 2.0 have the numbers of a map")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of headers by other hands
        try:
            shape, by_columns, dtype = _HEADERS[version](begun)
        except Exception as error:
            raise ValueError("its header is damaged, or none that numpy writes") from error
    check(shape, dtype)
    stated, there = prod(shape) * dtype.itemsize, size - begun.tell()
    if stated != there:
        raise ValueError(f"{there} bytes beside its header, and shape {shape} of {dtype} takes {stated}")
    numbers = begun.read() + file.read(there)
    return np.frombuffer(numbers, dtype).reshape(shape, order="F" if by_columns else "C")
