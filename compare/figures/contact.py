"""One contact, 3D beside 1D: pressure from above, force per length, sections of both bodies; a program in time."""

from collections.abc import Mapping, Sequence
from itertools import product
from math import ceil
from typing import Any

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from pandas import DataFrame, concat

from scene import Cylinder, Program, Scene

from . import shades, style, touching
from .lettering import lettered
from .plot import Plot, Tables
from .prefixes import prefixed
from .views import ROW, SURFACE, smooth_radius

NAME = "contact"
PRESSURE, LINES, PROGRAM = f"{NAME}-pressure", f"{NAME}-line-force", f"{NAME}-program"
SECTIONS = {"BEM": f"{NAME}-section-3d", "MDR": f"{NAME}-section-1d"}
SECTION_TITLES = {"BEM": "3D: section y = 0", "MDR": "1D: row of elements"}
HEIGHTS = "indenter", "surface", "touching"
HISTORIES = "normal_force", "friction_force", "depth"
STRIPS = 112  # along x, over each of which the force per length is averaged
ELEMENTS = 56  # of the row that are drawn
ABOVE, BELOW = 0.45, 0.35  # heights above and below what is shown of the surfaces, of their range
HIGHEST = 99  # percentile of the pressures in contact at which colours end
MOST_PIXELS = 4096  # of a side of the map
PANEL, AROUND, LEGEND = 1.75, 1.2, 0.5  # heights of a panel, around a map, and of the legend [inch]
BESIDE = 0.75  # what stands beside a map [inch]


def plot(
    scene: Scene,
    seen: Mapping[str, xarray.Dataset],
    program: Mapping[str, xarray.Dataset] | None = None,
    folder: str = "",
) -> Plot:
    """Plot of a contact, of which something is known.

    seen : "surface" (y, x) and "row" (x), as `views.view` returns them
    program : normal_force, friction_force and depth (time) by the name of the solver
    """
    tables: dict[str, DataFrame] = {}
    options: dict[str, Any] = {"radius": smooth_radius(scene)}
    sections = {"MDR": seen[ROW]} if ROW in seen else {}
    if SURFACE in seen:
        surface, alike = seen[SURFACE], seen[SURFACE].sizes["y"] == 1
        pressed, lines = surface["pressure"].to_dataframe().reset_index(), line_forces(surface, seen.get(ROW))
        pressed = pressed[pressed["pressure"] > 0]
        if len(pressed) and not alike:
            tables[PRESSURE] = pressed
            y = surface["y"].values
            options["aside"] = float(y[-1] + (y[1] - y[0]) / 2)
        if alike or "line_force_1d" in lines:
            tables[LINES] = lines
        middle = surface.sel(y=0.0, method="nearest")
        height, touched = -middle["displacement"], middle["pressure"] > 0
        sections["BEM"] = middle.assign(indenter=height + middle["gap"], surface=height, touching=touched)
    for solver in SECTIONS.keys() & sections.keys():
        tables[SECTIONS[solver]] = sections[solver].to_dataframe().reset_index()[["x", *HEIGHTS]]
    if program:
        histories = [each.to_dataframe().reset_index().assign(solver=name) for name, each in program.items()]
        tables[PROGRAM] = concat(histories, ignore_index=True)
        options["unit"] = "N/m" if isinstance(scene.indenter, Cylinder) else "N"
    motion = scene.motion
    options["flow"] = touching.flow(motion.stages[-1].speed if isinstance(motion, Program) else motion.speed)
    caption = (
        "Pressure in 3D, colours cut at the 99th percentile; force per length, in 3D the pressure integrated over "
        "y; sections, heights exaggerated as stated, the rigid indenter grey."
    )
    caption += " Each model has a rough surface of its own." if scene.roughness is not None and ROW in seen else ""
    caption += " All but force and depth is at the end of the program." if program else ""
    alternative = "Map of pressure, force per length, and sections through indenter and elastomer in 3D and 1D."
    return Plot(f"{folder}{NAME}", figure, tables, caption, alternative, options)


def figure(
    tables: Tables, aside: float = 1.0, radius: float | None = None, flow: str = "", unit: str = "N"
) -> Figure:
    """A panel for each table, two a row; of a program two panels, forces and depth.

    aside : farthest y of the map [m]; radius : of the smooth relaxed contact [m]
    flow : which way the indenter slides, in words; unit : of forces in time
    """
    sections = {solver: tables[name] for solver, name in SECTIONS.items() if name in tables}
    limits = heights_of([*sections.values()])
    span: list[float] = next((table["x"].iloc[[0, -1]].tolist() for table in sections.values()), [])
    count = len(tables) + (PROGRAM in tables)
    heights = [PANEL] * ceil(count / 2)
    if PRESSURE in tables:
        tall = min(1.0, 2 * aside / (span[1] - span[0]))
        heights[0] = max(PANEL, (style.across("double") / 2 - BESIDE) * tall + AROUND)
    drawing = style.canvas("double", sum(heights) + LEGEND)
    panels = drawing.subplots(len(heights), min(2, count), squeeze=False, height_ratios=heights).ravel()
    free = iter(panels)
    if PRESSURE in tables:
        pressure_map(next(free), tables[PRESSURE], sections["BEM"]["x"], aside, radius)
    if LINES in tables:
        _line_forces(next(free), tables[LINES], span)
    below = dict(zip(sections, free, strict=False))
    for solver, axes in below.items():
        seen, elements = touching.section_of(sections[solver]), ELEMENTS * (solver == "MDR")
        touching.section(axes, seen, solver, span, limits, elements)
        axes.set_title(SECTION_TITLES[solver])
    if PROGRAM in tables:
        _in_time(next(free), tables[PROGRAM], "force", unit, normal_force="", friction_force=": friction")
        _in_time(next(free), tables[PROGRAM], "depth", "m", depth="")
    for axes in free:
        axes.remove()
    lettered(panels[:count])
    handles = {handle.get_label(): handle for axes in panels for handle in axes.get_legend_handles_labels()[0]}
    style.legend(drawing, [*handles.values()], "outside lower center", 4)
    style.lay_out(drawing, passes=2)  # a map of equal scales finds its place in the second pass
    for axes in below.values():
        touching.exaggeration(axes, span, limits)
    if sections:
        touching.beside(panels[0], flow)
    return drawing


def pressure_map(axes: Axes, table: DataFrame, places, aside: float, radius: float | None) -> None:
    """Map of the pressure on what touches, with its bar below. places : x of its columns [m]"""
    (along, unit), highest = prefixed([*places, aside], "m"), float(np.percentile(table["pressure"], HIGHEST))
    up, pascal = prefixed(highest, "Pa")
    half = (places.iloc[1] - places.iloc[0]) / 2
    ends = along * np.array([[places.iloc[0] - half, places.iloc[-1] + half], [-aside, aside]])
    look: dict[str, Any] = {"cmap": "viridis_r", "vmin": 0.0, "vmax": up * highest, "rasterized": True}
    look |= {"range": ends, "weights": up * table["pressure"], "cmin": np.finfo(float).tiny}
    bins = len(places), min(MOST_PIXELS, round(aside / half))
    *_, image = axes.hist2d(along * table["x"], along * table["y"], bins, **look)
    axes.set_facecolor(touching.elastomer())
    if radius is not None:
        angle = np.linspace(0, 2 * np.pi, 181)
        look = style.line(0.0, 0.65, linestyle="--", label="smooth, relaxed contact")
        axes.plot(along * radius * np.cos(angle), along * radius * np.sin(angle), **look)
    axes.set(xlim=ends[0], ylim=ends[1], aspect="equal", anchor="NW")
    axes.set(xlabel=f"x [{unit}]", ylabel=f"y [{unit}]", title="3D: real contact")
    shades.colours(axes.figure, image, f"pressure [{pascal}]", ax=axes, location="bottom", extend="max", aspect=32)


def _line_forces(axes: Axes, lines: DataFrame, span) -> None:
    """Panel of the force per length of both models, or of the pressure of a contact that is alike along y."""
    forces = lines.drop(columns="x")
    quantity, unit = ("force per length", "N/m") if len(forces.columns) > 1 else ("pressure", "Pa")
    (along, metres), (up, name) = prefixed(span, "m"), prefixed(forces, unit)
    x, three = along * lines["x"], style.look("BEM", marker="", linestyle="-")
    if len(forces.columns) > 1:
        one: dict[str, Any] = {
            "color": style.COLOUR["MDR"],
            "alpha": 0.45,
            "linewidth": 0,
            "label": style.label("MDR"),
        }
        axes.fill_between(x, up * lines["line_force_1d"], step="mid", **one)
    axes.plot(x, up * lines["line_force_3d"], drawstyle="steps-mid", **three)
    axes.set(xlim=[along * end for end in span], xlabel=f"x [{metres}]", ylabel=f"{quantity} [{name}]")
    axes.set_ylim(bottom=0)
    axes.set_title(quantity)


def heights_of(sections: Sequence[DataFrame]) -> tuple[float, float]:
    """(lowest, highest) [m] of panels that show these sections."""
    seen = np.concatenate([[0.0], *(each["surface"] for each in sections)])
    low, high = np.nanmin(seen), np.nanmax(seen)
    room = (high - low) or 1e-9
    return float(low - BELOW * room), float(high + ABOVE * room)


def _in_time(axes: Axes, table: DataFrame, quantity: str, unit: str, **columns: str) -> None:
    """Panel of a quantity in time, of each model. columns : labels, empty of the first"""
    (scale, seconds), (up, name) = prefixed(table["time"], "s"), prefixed(table[[*columns]], unit)
    dashes = iter(style.SERIES_LINES)
    for (column, label), solver in product(columns.items(), sorted(set(table["solver"]), reverse=True)):
        own = table[table["solver"] == solver]
        look = style.look(solver, marker="", linestyle=next(dashes), label=style.label(solver) + label)
        axes.plot(scale * own["time"], up * own[column], **look)
    axes.set(xlabel=f"time [{seconds}]", ylabel=f"{quantity} [{name}]", title=f"{quantity} in time")


def line_forces(surface: xarray.Dataset, row: xarray.Dataset | None) -> DataFrame:
    """Force per length of both models [N/m], means over strips along x; in 3D the pressure is integrated over y.

    Of a contact that is alike along y it is the force per length and width of the line [N/m²].
    """
    x, pressure = surface["x"].values, surface["pressure"].values
    half, width = (x[1] - x[0]) / 2, 1.0 if surface.sizes["y"] == 1 else float(np.diff(surface["y"].values[:2])[0])
    ends = np.append(x - half, x[-1] + half)
    edges = np.linspace(ends[0], ends[-1], STRIPS + 1)
    found = {"x": (edges[1:] + edges[:-1]) / 2}
    if row is not None and "line_force" in row:
        found["line_force_1d"] = _means(row["x"].values, row["line_force"].values[:-1], edges)
    found["line_force_3d"] = _means(ends, width * pressure.sum(axis=0), edges)
    return DataFrame(found)


def _means(ends, values, edges):
    """Means between edges of what is constant between ends, and zero beyond."""
    sums = np.concatenate([[0.0], np.cumsum(values * np.diff(ends))])
    return np.diff(np.interp(edges, ends, sums)) / np.diff(edges)
