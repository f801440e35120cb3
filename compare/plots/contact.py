"""The contact of a scene: profile in one dimension, map of pressure in three (paper, Fig. 1)."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from pandas import DataFrame

from ..page import Plot, Tables
from . import shades, style, touching
from .touching import Fields

NAME = "contact"
LINE, PLANE = f"{NAME}-1d", f"{NAME}-3d"
SHOWN = 2.2  # of the profile, in radii of the smooth contact to either side


def plot(fields: Mapping[str, Fields], radius: float, flow: str, about: str, folder: str = "") -> Plot | None:
    """Plot of the fields that answers kept, by the name of their solver; None without those of both.

    radius : of the smooth relaxed contact [m]; flow : which way the elastomer passes
    about : what presses, in words
    """
    if not {"MDR", "BEM"} <= fields.keys():
        return None
    line, plane = fields["MDR"], fields["BEM"]
    inside = line["contact"].astype(bool)
    depth = np.mean((line["displacement"] + line["profile"])[inside]) if inside.any() else 0.0
    section = {"x": line["x"], "indenter": line["profile"] - depth, "surface": -line["displacement"]}
    y, x = np.meshgrid(plane["y"], plane["x"], indexing="ij")
    touched = plane["pressure"] > 0
    tables = {
        LINE: DataFrame({**section, "touching": inside}),
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
    line = touching.section_of(tables[LINE])
    x = line.x[np.abs(line.x) < SHOWN * radius]
    span = (x.min(), x.max())
    touching.section(left, line, "MDR", span, touching.heights([line], span))
    left.set_title("1D: profile")
    left.lines[-1].set_label("real contact")
    left.legend(loc="lower right", handlelength=1.4)
    left.text(0.5, 0.9, "rigid indenter", transform=left.transAxes, fontsize=style.small(), ha="center")
    _map(drawing, right, tables[PLANE], radius * 1e3, pixel)
    for axes in (left, right):
        axes.text(0.03, 0.03, flow, transform=axes.transAxes, fontsize=style.small())
    return drawing


def _map(drawing: Figure, axes: Axes, plane: DataFrame, radius: float, pixel: float) -> None:
    side = 1.08 * max(radius, 1e3 * plane[["x", "y"]].abs().max().max()) if len(plane) else 1.08 * radius
    x, y, pressure = touching.gridded(plane, "pressure", pixel)
    highest = touching.highest_pressure(pressure) / 1e6
    image = touching.pressure_map(axes, 1e3 * x, 1e3 * y, pressure / 1e6, highest)
    touching.edge(axes, radius, style.grey(0.3))
    axes.set(xlim=(-side, side), ylim=(-1.12 * side, side), xlabel="x [mm]", ylabel="y [mm]", aspect="equal")
    shades.colours(drawing, image, "pressure [MPa]", ax=axes, extend="max", shrink=0.9)
    axes.set_title("3D: pressure")
