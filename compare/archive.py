"""Results on disk, read back for analysis: a file as xarray.Dataset, what a command left as xarray.DataTree."""

from __future__ import annotations

import json
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from scene.reading import InvalidInput

from .netcdf import opened, unsealed
from .store import write

if TYPE_CHECKING:
    import xarray

    from .verdict import Judgement

RESULTS, SOLVED = "results.nc", "solved"
INDEX = ("label", "solver", "created", "failures", "file")


def record(path: Path, judgement: Judgement) -> None:
    """Write the file of a judged case. Raises OSError, which names the file."""
    from .casefile import written

    content = written(judgement)
    write(path, lambda file: file.write(content))


def load(path: str | Path) -> xarray.Dataset | xarray.DataTree:
    """What a file of results holds, or a folder that a command left; nothing stays open.

    A file without parts is a Dataset, one with parts (the fields of a task, the tables of a case) a DataTree. A
    folder is a DataTree: below "solved" an index of the tasks, a row each with label, solver and the file to load,
    and below the name of a case the content of its results.nc.

    Raises InvalidInput for what is damaged or holds no results, OSError for what cannot be read.
    """
    path = Path(path)
    return _folder(path) if path.is_dir() else _file(path)


def index(folder: Path) -> xarray.Dataset:
    """The tasks in a store, a row each, by label: who solved it, when, how many solves failed, and its file."""
    import xarray

    rows = sorted(_indexed(folder))
    columns = zip(*rows, strict=True) if rows else ((),) * len(INDEX)
    return xarray.Dataset(
        {name: ("task", np.array(values, object)) for name, values in zip(INDEX, columns, strict=True)},
        attrs={"folder": str(folder)},
    ).assign(failures=lambda found: found.failures.astype(int))


def _file(path):
    import xarray

    try:
        content = BytesIO(unsealed(path.read_bytes()))
    except ValueError as error:
        raise InvalidInput(f"{path}: no file of results: {error}") from error
    with xarray.open_datatree(content, engine="h5netcdf") as tree:
        parts = {node.path: node.to_dataset(inherit=False).load() for node in tree.subtree}
    return xarray.DataTree.from_dict(parts) if len(parts) > 1 else parts["/"]


def _folder(path):
    import xarray

    parts = {}
    for found in sorted(path.rglob(RESULTS)):
        below = found.parent.relative_to(path).as_posix()
        parts["/" if below == "." else f"/{below}"] = _file(found)
    for store in (path, path / SOLVED):
        found = index(store)
        if found.sizes["task"]:
            parts[f"/{SOLVED}"] = found
    if not parts:
        raise InvalidInput(f"{path}: no command has left results here")
    return xarray.DataTree.from_dict(parts)


def _indexed(folder: Path) -> Iterator[tuple[str, ...]]:
    """What is damaged is left out: it counts as absent."""
    for path in folder.glob("*-*.nc"):
        try:
            with opened(path.read_bytes()) as file:
                question = json.loads(file.values("question").item())
                asked = question.get("timed", question)
                told = (file.text(name) for name in ("title", "created", "failures"))
                label, created, failures = told
                yield label, str(asked.get("solver", "")), created, failures, path.name
        except (ValueError, KeyError):
            continue
