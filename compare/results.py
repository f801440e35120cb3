"""File of results: everything that a command solved, as one netCDF-4 file."""

from io import BytesIO
from pathlib import Path

import xarray

from scene.reading import InvalidInput

from . import store
from .netcdf import Group, Variable, encoded, unsealed

NAME = "results.nc"


def write(path: Path, answers: xarray.DataTree) -> None:
    """Write everything that was solved as one netCDF-4 file, whole or not at all. Raises OSError."""
    content = encoded(_group(answers))
    store.write(path, lambda file: file.write(content))


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
            with xarray.open_datatree(BytesIO(unsealed(path.read_bytes())), engine="h5netcdf") as tree:
                for node in tree.subtree:
                    parts[f"{place}{node.path}".rstrip("/") or "/"] = node.to_dataset(inherit=False).load()
        except (ValueError, KeyError, TypeError, RuntimeError) as error:
            raise InvalidInput(f"{path}: is no file of results, or is damaged: {error}") from error
    return xarray.DataTree.from_dict(parts)


def _group(node: xarray.DataTree) -> Group:
    """A node with all below it, as the writer takes it, which is ten times as fast as that of xarray."""
    dataset = node.to_dataset(inherit=False)
    variables = {}
    for name, each in dataset.variables.items():
        values = each.values.astype(object) if each.dtype.kind == "U" else each.values
        attributes = {key: str(text) for key, text in each.attrs.items() if str(text)}
        variables[str(name)] = Variable(tuple(map(str, each.dims)), values, attributes)
    below = {name: _group(child) for name, child in node.children.items()}
    texts = {str(key): str(text) for key, text in dataset.attrs.items()}
    if beside := [str(name) for name in dataset.coords if name not in dataset.dims]:
        texts["coordinates"] = " ".join(beside)  # as CF has it
    return Group(variables, texts, below)
