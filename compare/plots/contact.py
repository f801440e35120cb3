"""The contact of a scene: profile in one dimension, map of pressure in three (paper, Fig. 1)."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from pandas import DataFrame

from ..page import Plot, Tables
from . import materials, style
from .touching import Fields, edge, gridded, highest_pressure, pressure_map

NAME = "contact"
LINE, PLANE = f"{NAME}-1d", f"{NAME}-3d"


def plot(fields: Mapping[str, Fields], radius: float, flow: str, about: str, folder: str = "") -> Plot | None:
    """Plot of the fields that answers kept, by the name of their solver; None without those of both.

    radius : of the smooth relaxed contact [m]; flow : which way the elastomer passes
    about : what presses, in words
    """
    if not {"MDR", "BEM"} <= fields.keys():
        return None
    line, plane = fields["MDR"], fields["BEM"]
    touching = line["contact"].astype(bool)
    depth = np.mean((line["displacement"] + line["profile"])[touching]) if touching.any() else 0.0
    y, x = np.meshgrid(plane["y"], plane["x"], indexing="ij")
    touched = plane["pressure"] > 0
    tables = {
        LINE: DataFrame(
            {
                "x": line["x"],
                "indenter": line["profile"] - depth,
                "surface": -line["displacement"],
                "touching": touching,
            }
        ),
        PLANE: DataFrame({"x": x[touched], "y": y[touched], "pressure": plane["pressure"][touched]}),
    }
    caption = (
        f"The contact {about}. Left: rigid indenter and surface of the elastomer in one dimension, real contact "
        "in bold; heights are exaggerated. Right: contact pressure in three dimensions, seen from above, colours "
        "cut at the 99th percentile. Dashed circle: the smooth relaxed contact."
    )
    alternative = "Left a rigid profile above the elastomer's surface, right a patchy disc of pressure."
    options = {"radius": radius, "pixel": float(plane["x"][1] - plane["x"][0]), "flow": flow}
    return Plot(f"{folder}{NAME}", figure, tables, caption, alternative, options)


def figure(tables: Tables, radius: float, pixel: float, flow: str) -> Figure:
    """Left: rigid profile and surface of the elastomer. Right: contact pressure."""
    drawing = style.canvas("double", 2.9)
    left, right = drawing.subplots(1, 2, width_ratios=(1.25, 1))
    _profile(left, tables[LINE], radius * 1e3)
    for axes in (left, right):
        axes.text(0.03, 0.03, flow, transform=axes.transAxes, fontsize=style.small())
    left.text(0.5, 0.9, "rigid indenter", transform=left.transAxes, fontsize=style.small(), ha="center")
    _map(drawing, right, tables[PLANE], radius * 1e3, pixel)
    return drawing


def _profile(axes: Axes, line: DataFrame, radius: float) -> None:
    x, touching = line["x"].to_numpy() * 1e3, line["touching"].to_numpy(bool)
    body, surface = line["indenter"].to_numpy() * 1e6, line["surface"].to_numpy() * 1e6
    shown = np.abs(x) < 2.2 * radius
    top = 1.15 * np.abs(surface[shown]).max() * 0.6
    bottom = 1.25 * min(surface[shown].min(), body[shown].min())
    axes.fill_between(x, surface, bottom, color=materials.elastomer(), linewidth=0)
    axes.fill_between(x, body, top, color=materials.indenter(), linewidth=0)
    axes.plot(x, surface, color=materials.surface(), linewidth=style.width(0.65))
    look: dict[str, Any] = {"color": style.COLOUR["MDR"], "linewidth": style.width(2), "solid_capstyle": "butt"}
    axes.plot(x, np.where(touching, surface, np.nan), label="real contact", **look)
    axes.set(xlim=(x[shown].min(), x[shown].max()), ylim=(bottom, top), xlabel="x [mm]", ylabel="height [µm]")
    axes.legend(loc="lower right", handlelength=1.4)
    axes.set_title("1D: profile")


def _map(drawing: Figure, axes: Axes, plane: DataFrame, radius: float, pixel: float) -> None:
    side = 1.08 * max(radius, 1e3 * plane[["x", "y"]].abs().max().max()) if len(plane) else 1.08 * radius
    x, y, pressure = gridded(plane, "pressure", pixel)
    image = pressure_map(axes, 1e3 * x, 1e3 * y, pressure / 1e6, highest_pressure(pressure) / 1e6)
    edge(axes, radius, style.grey(0.3))
    axes.set(xlim=(-side, side), ylim=(-1.12 * side, side), xlabel="x [mm]", ylabel="y [mm]", aspect="equal")
    bar = drawing.colorbar(image, ax=axes, extend="max", shrink=0.9)
    bar.set_label("pressure [MPa]")
    bar.outline.set_linewidth(style.width(0.45))
    axes.set_title("3D: pressure")
