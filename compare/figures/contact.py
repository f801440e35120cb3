"""One contact in 3D and 1D: pressure from above, force per length, and sections of both bodies."""

from collections.abc import Mapping, Sequence
from math import ceil
from typing import Any

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from pandas import DataFrame

from bem3d import BEM
from bem3d.motion.wake import surroundings
from scene import Program, Scene

from ..solving.vocabulary import attributes
from . import style
from .plot import Plot, Tables

SURFACE, ROW = "surface", "row"
NAME = "contact"
PRESSURE, LINES = f"{NAME}-pressure", f"{NAME}-line-force"
SECTIONS = {"BEM": f"{NAME}-section-3d", "MDR": f"{NAME}-section-1d"}
SECTION_TITLES = {"BEM": "3D: section y = 0", "MDR": "1D: row of elements"}
ELASTOMER, SKIN = ("#8A7A45", 0.25), "#6E6237"  # inside of the elastomer, and the line where it ends
HEIGHTS = "indenter", "surface", "touching"
ELEMENTS = 56  # of the row that are drawn
ABOVE, BELOW = 0.45, 0.35  # heights above and below what is shown of the surfaces, of their range
HIGHEST = 99  # percentile of the pressures in contact at which colours end
PANEL, AROUND, LEGEND = 1.75, 1.2, 0.5  # heights of a panel, around a map, and of the legend [inch]
LABELS = 0.75  # width of the labels and the colour bar next to a map [inch]


def view(scene: Scene, bem: BEM, fields: Mapping[str, Mapping[str, np.ndarray]]) -> dict[str, xarray.Dataset]:
    """Both bodies in 3D and 1D on the grids of their answers, x from the axis of the indenter downstream.

    bem : the settings that the three-dimensional answer was solved with
    fields : of answers by the name of their solver, of a program at its end

    Returns "surface" (y, x) in three dimensions: displacement and gap [m], pressure [Pa]; and "row" (x) in one:
    heights of indenter and surface above the undeformed one [m], whether they touch and, but of a program,
    line_force [N/m]. None of them where friction has heated the contact, since the fields do not say how warm it
    is.
    """
    found: dict[str, xarray.Dataset] = {}
    if scene.heating is not None and scene.heating.feedback is not None:
        return found
    if "BEM" in fields:
        around, pressure = surroundings(bem, scene, fields["BEM"]), fields["BEM"]["pressure"]
        # What is left of the gap in contact is the residual of the solver.
        gap = np.where(pressure > 0, 0.0, around.gap)
        columns = {"displacement": around.displacement, "gap": gap, "pressure": pressure}
        found[SURFACE] = _dataset(columns, y=around.y, x=around.x + around.lag)
    if "MDR" in fields:
        row = fields["MDR"]
        touching, surface = row["contact"].astype(bool), -row["displacement"]
        depth = (row["profile"] - surface)[touching].mean() if touching.any() else np.nan
        columns = {"indenter": row["profile"] - row.get("depth", [depth])[-1], "surface": surface}
        columns |= {"touching": touching} | {name: row[name] for name in ("line_force",) if name in row}
        found[ROW] = _dataset(columns, x=row["x"])
    return found


def _dataset(fields, **places):
    """Fields over their places, with units and definitions."""
    found = xarray.Dataset({name: ([*places], values) for name, values in fields.items()}, places)
    for name in found.variables:
        found[name].attrs = attributes(name)
    return found


def plot(scene: Scene, seen: Mapping[str, xarray.Dataset], folder: str = "") -> Plot:
    """Plot of the parts of a contact that are known: "surface" (y, x) or "row" (x), as `view` has them."""
    motion = scene.motion
    speed = motion.stages[-1].speed if isinstance(motion, Program) else motion.speed
    flow = "at rest" if speed == 0 else "← indenter slides" if speed > 0 else "indenter slides →"
    options: dict[str, Any] = {"flow": flow}
    tables: dict[str, DataFrame] = {}
    sections = {}
    if SURFACE in seen:
        surface, alike = seen[SURFACE], seen[SURFACE].sizes["y"] == 1
        pressed, lines = surface["pressure"].to_dataframe().reset_index(), line_forces(surface, seen.get(ROW))
        pressed = pressed[pressed["pressure"] > 0]
        if len(pressed) and not alike:
            tables[PRESSURE] = pressed
            options["aside"] = 1.1 * max(pressed["y"].abs())
        if alike or "line_force_1d" in lines:
            tables[LINES] = lines
        middle = surface.sel(y=0.0, method="nearest")
        height, touched = -middle["displacement"], middle["pressure"] > 0
        sections["BEM"] = middle.assign(indenter=height + middle["gap"], surface=height, touching=touched)
    if ROW in seen:
        sections["MDR"] = seen[ROW]
    for solver, each in sections.items():
        tables[SECTIONS[solver]] = each[[*HEIGHTS]].reset_coords(drop=True).to_dataframe().reset_index()
    caption = (
        "Pressure in 3D, colours cut at the 99th percentile; force per length, in 3D the pressure integrated over "
        "y; sections, the rigid indenter grey."
    )
    caption += " Each model has a rough surface of its own." if scene.roughness is not None and ROW in seen else ""
    caption += " All is at the end of the program." if isinstance(motion, Program) else ""
    alternative = "Map of pressure, force per length, and sections through indenter and elastomer in 3D and 1D."
    return Plot(f"{folder}{NAME}", figure, tables, caption, alternative, options)


def figure(tables: Tables, aside: float = 1.0, flow: str = "") -> Figure:
    """A panel for each table, two a row.

    aside : farthest y of the map [m]; flow : which way the indenter slides, in words
    """
    sections = [tables[name] for name in SECTIONS.values() if name in tables]
    limits, x = heights_of(sections), sections[0]["x"]
    # All that touches, and what every panel has: the row may end nearer to the contact than the surface.
    shown = np.concatenate([sections[-1]["x"], tables.get(PRESSURE, sections[0])["x"]])
    x = x[x.between(shown.min(), shown.max())]
    span: list[float] = x.iloc[[0, -1]].tolist()
    heights = [PANEL] * ceil(len(tables) / 2)
    if PRESSURE in tables:
        tall = min(1.0, 2 * aside / (span[1] - span[0]))
        heights[0] = max(PANEL, (style.across("double") / 2 - LABELS) * tall + AROUND)
    drawing = style.canvas("double", sum(heights) + LEGEND)
    grid = drawing.subplots(len(heights), min(2, len(tables)), squeeze=False, height_ratios=heights).ravel()
    for axes, (name, table) in zip(grid, tables.items(), strict=False):
        if name == PRESSURE:
            pressure_map(axes, table, x, aside)
        elif name == LINES:
            _line_forces(axes, table, span)
        else:
            solver = "BEM" if name == SECTIONS["BEM"] else "MDR"
            section(axes, table, solver, span, limits, ELEMENTS * (solver == "MDR"))
            axes.set_title(SECTION_TITLES[solver])
    for axes in grid[len(tables) :]:
        axes.remove()
    style.finish(drawing, 4)
    grid[0].set_title(flow, loc="right", fontsize=style.small(), fontweight="normal")
    drawing.get_layout_engine().execute(drawing)  # a map of equal scales finds its place in the second pass
    return drawing


def section(
    axes: Axes, table: DataFrame, solver: str, span: Sequence[float], limits: Sequence[float], elements: int = 0
) -> None:
    """Both bodies over a span of x between two heights [m], real contact in bold.

    table : x, heights of indenter and surface above the undeformed surface [m], and where they are touching
    elements : how many are drawn of the row that stands for the elastomer in 1D
    """
    (along, metres), (up, unit) = style.prefixed(span, "m"), style.prefixed(limits, "m")
    x, indenter, surface = along * table["x"], up * table["indenter"], up * table["surface"]
    bottom, top = (up * limit for limit in limits)
    colour, touching = style.colour(solver), table["touching"].astype(bool)
    axes.fill_between(x, np.maximum(surface, bottom), bottom, color=ELASTOMER, linewidth=0)
    axes.fill_between(x, np.minimum(indenter, top), top, color=style.grey(0.7), linewidth=0)
    if elements:
        some = slice(None, None, max(1, round(len(x) / elements)))
        colours = np.where(touching[some], colour, SKIN)
        axes.vlines(x[some], bottom, surface[some], color=colours, linewidth=style.width(0.6))
    axes.axhline(0.0, **style.line(0.35, 0.5, linestyle=(0, (5, 3)), label="undeformed surface"))
    axes.plot(x, surface, color=SKIN, linewidth=style.width(0.65), label="surface")
    # A marker, too, since contact may be at one point.
    bold: dict[str, Any] = {
        "color": colour, "linewidth": style.width(2.2), "solid_capstyle": "butt", "marker": ".",
        "markersize": style.width(2.2), "markeredgewidth": 0,
    }  # fmt: skip
    axes.plot(x, surface.where(touching), label="real contact, in the colour of the model", **bold)
    axes.set(xlim=[along * end for end in span], ylim=(bottom, top))
    axes.set(xlabel=f"x [{metres}]", ylabel=f"height [{unit}]")


def pressure_map(axes: Axes, table: DataFrame, places, aside: float) -> None:
    """Map of the pressure on what touches, with its bar below. places : x of its columns [m]"""
    highest, pixel = np.percentile(table["pressure"], HIGHEST), places.iloc[1] - places.iloc[0]
    (along, unit), (up, pascal) = style.prefixed([*places, aside], "m"), style.prefixed(highest, "Pa")
    edges = [along * np.arange(each.min() - pixel / 2, each.max() + pixel, pixel) for each in (places, table["y"])]
    look: dict[str, Any] = {"cmap": "viridis_r", "vmin": 0.0, "vmax": up * highest, "rasterized": True}
    *_, image = axes.hist2d(
        along * table["x"], along * table["y"], edges, weights=up * table["pressure"],
        cmin=np.finfo(float).tiny, **look,
    )  # fmt: skip
    axes.set_facecolor(ELASTOMER)
    axes.set(ylim=(-along * aside, along * aside), aspect="equal", anchor="NW")
    axes.set(xlabel=f"x [{unit}]", ylabel=f"y [{unit}]", title="3D: real contact")
    axes.figure.colorbar(
        image, ax=axes, label=f"pressure [{pascal}]", location="bottom", panchor=False, extend="max", aspect=32
    )


def _line_forces(axes: Axes, lines: DataFrame, span) -> None:
    """Panel of the force per length of both models, or of the pressure of a contact that is alike along y."""
    both = "line_force_1d" in lines
    quantity, unit = ("force per length", "N/m") if both else ("pressure", "Pa")
    (along, metres), (up, name) = style.prefixed(span, "m"), style.prefixed(lines.drop(columns="x"), unit)
    x = along * lines["x"]
    if both:
        axes.fill_between(
            x, up * lines["line_force_1d"], step="mid", linewidth=0, color=style.colour("MDR"), alpha=0.45,
            label=style.label("MDR"),
        )  # fmt: skip
    three = style.look("BEM", marker="", linestyle="-", drawstyle="steps-mid")
    axes.plot(x, up * lines["line_force_3d"], **three)
    axes.set(xlim=[along * end for end in span], xlabel=f"x [{metres}]", ylabel=f"{quantity} [{name}]")
    axes.set(ylim=(0, None), title=quantity)


def heights_of(sections: Sequence[DataFrame]) -> tuple[float, float]:
    """(lowest, highest) [m] of panels that show these sections."""
    seen = np.concatenate([[0.0], *(each["surface"] for each in sections)])
    low, high = np.nanmin(seen), np.nanmax(seen)
    room = (high - low) or 1e-9
    return low - BELOW * room, high + ABOVE * room


def line_forces(surface: xarray.Dataset, row: xarray.Dataset | None) -> DataFrame:
    """Force per length of both models [N/m], over each pixel of the 3D grid along x, in 3D integrated over y.

    Of a contact that is alike along y it is the force per length and width of the line [N/m²].
    """
    x, pressure = surface["x"].values, surface["pressure"].sum("y").values
    pixel, found = x[1] - x[0], {"x": x}
    if row is not None and "line_force" in row:
        ends, force = row["x"].values, row["line_force"].values
        sums = np.append(0.0, np.cumsum(force[:-1] * np.diff(ends)))
        edges = np.append(x - pixel / 2, x[-1] + pixel / 2)
        found["line_force_1d"] = np.diff(np.interp(edges, ends, sums)) / pixel
    found["line_force_3d"] = pressure * (1.0 if surface.sizes["y"] == 1 else pixel)
    return DataFrame(found)
