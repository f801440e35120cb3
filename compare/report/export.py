"""Results of a folder for others: CSV with units in its heads, surfaces for ParaView."""

from collections.abc import Iterator
from operator import methodcaller
from pathlib import Path

import xarray
from pandas import DataFrame

from scene.printable import brief
from scene.reading import InvalidInput

from ..solving import folders, netcdf, parameter_grid
from ..solving.folders import hold
from ..solving.suggest import known
from ..solving.vocabulary import entry
from . import csvfiles, manifest, vtk

FORMS = "csv", "vtk"
TABLES = "tables"


def export(folder: str | Path, to: str = "csv", output: str | Path | None = None) -> list[Path]:
    """Write results into files; returns them.

    folder : that a command left, or that has such folders, or a file of results
    to : "csv", every digit and a unit behind each name; or "vtk", the surfaces for ParaView
    output : where to; `tables` in the folder, or beside the file, if absent

    Raises InvalidInput where there is nothing of the kind, a file is damaged or a run holds the folder, Refused of
    vtk without its extra, OSError for what cannot be written.
    """
    known("to", to, FORMS)
    if to == "vtk":
        vtk.refuse()
    folder = Path(folder)
    if output is None:
        output = manifest.inside(folder.parent if folder.is_file() else folder, TABLES)
    if to == "vtk":
        return _surfaces(folder, Path(output))
    written = []
    for name, frame in dict(_tables(folder)).items():
        if not frame.empty:
            written.append(manifest.inside(Path(output), f"{name}.csv"))
            headed = frame.rename(columns=lambda column: _head(str(column)))
            csvfiles.write_text(written[-1], csvfiles.text(headed))
    if not written:
        raise InvalidInput(f"{brief(str(folder))}: holds no table")
    return written


def _surfaces(folder: Path, output: Path) -> list[Path]:
    """Write a file for each Dataset with fields over y and x."""
    written = []
    with hold([folder]):
        solved = netcdf.load(folder)
    for node in solved.subtree:
        if content := vtk.content(node.to_dataset(inherit=False)):
            written.append(manifest.inside(output, f"{node.path.strip('/') or folder.stem}{vtk.ENDING}"))
            folders.make(written[-1].parent)
            folders.write(written[-1], methodcaller("write", content))
    if not written:
        raise InvalidInput(f"{folder}: holds no surface that vtk could show: draw has one, and run its fields")
    return written


def _tables(folder: Path) -> Iterator[tuple[str, DataFrame]]:
    """Tables beside the pages of a folder, and everything that was solved, by the names of their files."""
    if not folder.is_file():
        for each in manifest.folders(folder):
            place = each.path.relative_to(folder)
            with hold([each.path]):
                for name in each.manifest.tables:
                    yield (place / name).as_posix(), csvfiles.read(manifest.inside(each.path, f"{name}.csv"))
        if not any(folder.rglob(netcdf.NAME)):
            return
    for node in netcdf.load(folder).subtree:
        yield from _flat(node.path.strip("/") or Path(folder).stem, node.to_dataset(inherit=False))


def _flat(name: str, dataset: xarray.Dataset) -> Iterator[tuple[str, DataFrame]]:
    """A Dataset as one table for each set of dimensions, a row a point; what was not asked for is left out."""
    families: dict[tuple, list] = {}
    for variable, values in dataset.data_vars.items():
        families.setdefault(values.dims, []).append(variable)
    for dims, variables in families.items():
        if not dims:
            continue
        frame = dataset[variables].to_dataframe().reset_index()
        if "status" in frame:
            frame = frame[frame["status"] != parameter_grid.NOT_ASKED]
        most = len(variables) == max(map(len, families.values()))
        yield name if most else f"{name}-{'-'.join(map(str, dims))}", frame


def _head(name: str) -> str:
    """Name of a column with its unit."""
    found = entry(name)
    return name if found is None or found.unit in ("", "1") else f"{name} [{found.unit}]"
