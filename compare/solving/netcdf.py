"""File of results: everything that a command solved, as one netCDF-4 file with a checksum at its end."""

import hashlib
import re
from io import BytesIO
from pathlib import Path
from typing import Any

import xarray

from scene.files.files import Unreadable, content
from scene.files.reading import InvalidInput
from scene.printable import brief
from scene.result import source

from .folders import FORMAT, MANIFEST, Stated, read, refuse_other

NAME, MOST_BYTES = "results.nc", 2**31
LARGE = 2**12  # bytes from which on compression saves more than it adds
# Behind the last byte that HDF5 knows of, which its readers pass over: the format of the folder, and the checksum.
ENDING, LONGEST = re.compile(rb"crosscheck format (\d{1,9}) (sha256:[0-9a-f]{64})\Z"), 120


def packed(answers: xarray.DataTree) -> bytes:
    """Everything that was solved as the bytes of its file; equal answers give equal bytes."""
    tree = answers.copy()
    tree.attrs = {**answers.attrs, "source": source()}
    parts = {node.path: node.to_dataset(inherit=False).variables for node in tree.subtree}
    encoding = {path: {name: _encoding(each) for name, each in part.items()} for path, part in parts.items()}
    image = bytes(tree.to_netcdf(engine="h5netcdf", encoding=encoding)) + f"crosscheck format {FORMAT} ".encode()
    return image + checksum(image)


def _encoding(variable: xarray.Variable) -> dict[str, Any]:
    """Encoding of a variable: texts are stored as characters, as HDF5 cannot compress its own texts."""
    return {"zlib": variable.nbytes >= LARGE} | ({"dtype": "S1"} if variable.dtype.kind in "UO" else {})


def checksum(image: bytes) -> bytes:
    """Digest of a file without its end, where it stands."""
    return b"sha256:" + hashlib.sha256(image).hexdigest().encode()


def load(folder: str | Path) -> xarray.DataTree:
    """Everything that a command solved, as it left it in a folder; of several studies, each below its name.

    Raises InvalidInput where there are no results, or they are damaged, too large, no such file or of another
    version, or where a run has not come to its end.
    """
    folder, trees = Path(folder), {}
    paths = sorted(folder.rglob(NAME)) if folder.is_dir() else [folder]
    for path in folder.rglob(MANIFEST):
        read(path, Stated)
    if not paths:
        raise InvalidInput(f"{brief(str(folder))}: no command has left results here")
    for path in paths:
        place = (path.parent if folder.is_dir() else folder).relative_to(folder).as_posix()
        trees["/" if place == "." else place] = xarray.load_datatree(BytesIO(_checked(path)), engine="h5netcdf")
    return xarray.DataTree.from_dict(trees)


def _checked(path: Path) -> bytes:
    """Bytes of a file. Raises InvalidInput, before HDF5 reads it, without its checksum or for another version."""
    try:
        file = content(path, MOST_BYTES)
    except Unreadable as error:
        raise InvalidInput(str(error)) from error
    ending = ENDING.search(file[-LONGEST:])
    if ending is None or ending[2] != checksum(file[: -len(ending[2])]):
        why = "has no checksum at its end" if ending is None else "does not have the checksum at its end"
        raise InvalidInput(f"{brief(str(path))}: is not a file of results, or is damaged: it {why}")
    refuse_other(path, int(ending[1]))
    return file
