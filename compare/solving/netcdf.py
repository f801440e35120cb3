"""File of results: everything that a command solved, as one netCDF-4 file with a checksum at its end."""

import hashlib
import re
from io import BytesIO
from pathlib import Path
from typing import Any

import xarray

from scene.files import Unreadable, content
from scene.printable import brief
from scene.reading import InvalidInput
from scene.result import source

from .folders import FORMAT, MANIFEST, Stated, read, refuse_other

NAME = "results.nc"
MOST_BYTES = 2**31
# Behind the last byte that HDF5 knows of, which its readers pass over: the format of the folder, and the checksum.
ENDING = re.compile(rb"crosscheck format (\d{1,9}) (sha256:[0-9a-f]{64})\Z")
LONGEST_ENDING = 120
LARGE = 2**12  # bytes from which on compression saves more than it adds


def packed(answers: xarray.DataTree) -> bytes:
    """Everything that was solved as the bytes of its file; equal answers give equal bytes."""
    tree = answers.copy()
    tree.attrs = {**answers.attrs, "source": source()}
    encoding = {
        node.path: {name: _encoding(each) for name, each in node.to_dataset(inherit=False).variables.items()}
        for node in tree.subtree
    }
    image = bytes(tree.to_netcdf(engine="h5netcdf", encoding=encoding)) + f"crosscheck format {FORMAT} ".encode()
    return image + checksum(image)


def _encoding(variable: xarray.Variable) -> dict[str, Any]:
    """How a variable is stored: texts as characters, as the texts of HDF5 cannot be compressed."""
    characters = {"dtype": "S1"} if variable.dtype.kind in "UO" else {}
    return {**characters, "zlib": variable.nbytes >= LARGE}


def checksum(image: bytes) -> bytes:
    """What stands at the end of a file: the digest of all before it."""
    return b"sha256:" + hashlib.sha256(image).hexdigest().encode()


def digest(file: bytes) -> str:
    """Digest of a file of results, which stands at its end."""
    return file[-64:].decode()


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
    trees = {}
    for path in paths:
        file = _checked(path)
        if stated.get(path.parent, "") not in ("", digest(file)):
            raise InvalidInput(
                f"{brief(str(path))}: is of another run than {MANIFEST} beside it: run the command again"
            )
        place = path.parent.relative_to(folder).as_posix() if folder.is_dir() else "."
        trees["/" if place == "." else place] = xarray.load_datatree(BytesIO(file), engine="h5netcdf")
    return xarray.DataTree.from_dict(trees)


def _checked(path: Path) -> bytes:
    """Bytes of a file of results, with its ending. Raises InvalidInput of one that is damaged before HDF5 sees it."""
    try:
        file = content(path, MOST_BYTES)
    except Unreadable as error:
        raise InvalidInput(str(error)) from error
    ending = ENDING.search(file, max(0, len(file) - LONGEST_ENDING))
    if ending is None or ending[2] != checksum(file[: ending.start(2)]):
        why = "has no checksum at its end" if ending is None else "does not have the checksum at its end"
        raise InvalidInput(f"{brief(str(path))}: is not a file of results, or is damaged: it {why}")
    refuse_other(path, int(ending[1]))
    return file
