"""Surfaces of results as files that ParaView opens: by meshio, an extra."""

import tempfile
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import xarray
from numpy.lib.stride_tricks import sliding_window_view

from scene import Refused

EXTRA = 'pip install "mdr-bem-crosscheck[vtk]"'
ENDING = ".vtu"
PLANE = ("y", "x")


def refuse() -> None:
    """Raise Refused where meshio is not installed."""
    if find_spec("meshio") is None:
        raise Refused(f"format = vtk: these files are written by meshio, which is not installed: {EXTRA}")


def content(dataset: xarray.Dataset) -> bytes:
    """A file of the fields of a Dataset over y and x, on a flat grid of quadrilaterals; empty without fields.

    A displacement is the vector (0, 0, -displacement), by which ParaView's filter Warp By Vector deforms the grid.
    """
    fields = {str(name): each for name, each in dataset.data_vars.items() if each.dims == PLANE}
    if not fields:
        return b""
    import meshio

    y, x = np.meshgrid(dataset["y"], dataset["x"], indexing="ij")
    nodes = np.arange(x.size).reshape(x.shape)
    corners = sliding_window_view(nodes, (2, 2)).reshape(-1, 4)[:, [0, 1, 3, 2]]  # around each quadrilateral
    data = {}
    for name, each in fields.items():
        values, unit = each.values.astype(float).ravel(), each.attrs.get("units", "1")
        if name == "displacement":
            values = np.outer(-values, (0.0, 0.0, 1.0))
        data[name if unit == "1" else f"{name} [{unit}]"] = values
    mesh = meshio.Mesh(np.column_stack([x.ravel(), y.ravel(), 0 * x.ravel()]), [("quad", corners)], data)
    with tempfile.TemporaryDirectory() as folder:  # meshio writes to paths alone
        path = Path(folder) / f"surface{ENDING}"
        mesh.write(path)
        return path.read_bytes()
