"""One contact: the deformed surface in 3D under its pressure, the row of springs in 1D, and the forces of both."""

from collections.abc import Sequence
from math import ceil
from typing import Any

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from pandas import DataFrame

from scene import Cylinder, Plane, Program, Scene

from ...figures import shades, style, touching
from ...figures.lettering import clear, letter
from ...figures.prefixes import prefixed
from ...report.page import Plot, Tables
from . import relief

NAME = "draw"
SURFACE, ROW, LINES = f"{NAME}-surface", f"{NAME}-row", f"{NAME}-line-force"
MOST_POINTS = 30_000  # of the surface: finer grids are averaged over squares of pixels
STRIPS, SPRINGS = 112, 2  # along the picture; strips for each spring that is drawn
STRIP_DEPTH = 0.4  # of the length of a contact that is alike along y, the piece of it that is drawn
LEAST, AROUND, SHARE = 2.9, 1.35, 0.5  # height of the figure, around the block [inch]; of its width, the block's
COILS, COIL = 4, 0.32  # of a spring, and half their width over the distance of springs


def plot(scene: Scene, surface: xarray.Dataset, row: xarray.Dataset | None) -> Plot:
    """Plot of a contact.

    surface : displacement, gap, pressure (y, x); y of one place where the contact is alike along it
    row : indenter, surface, touching and, but of a program, line_force (x) of the springs; None without them
    """
    shown, lines = _shown(surface), line_forces(surface, row)
    tables = {SURFACE: shown, LINES: lines}
    if row is not None:
        tables[ROW] = row[["indenter", "surface", "touching"]].to_dataframe().reset_index()
    wide, deep, relieved = (float(np.ptp(shown[name])) for name in ("x", "y", "displacement"))
    motion = scene.motion
    speed = motion.stages[-1].speed if isinstance(motion, Program) else motion.speed
    options = {
        "enlarged": relief.exaggeration(wide, deep, relieved),
        "highest": touching.highest_pressure(shown["pressure"].to_numpy()),
        "unit": "N/m²" if isinstance(scene.indenter, Cylinder) else "N/m",
        "sliding": int(np.sign(speed)),
    }
    told = {
        "(a) Surface of the elastomer, the rigid indenter left out; dashed: the undeformed level.": True,
        "A piece of a contact that is alike along y.": surface.sizes["y"] == 1,
        "One cell, which repeats.": isinstance(scene.indenter, Plane),
        "At the end of the program.": isinstance(motion, Program),
        "(b) Some of the springs, in colour where they press.": row is not None,
        f"({letter(1 + (row is not None))}) Force per length, means over strips.": True,
        "Each model has a rough surface of its own.": row is not None and scene.roughness is not None,
    }
    caption = " ".join(sentence for sentence, holds in told.items() if holds)
    alternative = "Left a block of elastomer with a dent coloured by pressure, right springs and their forces."
    return Plot(NAME, figure, tables, caption, alternative, options)


def figure(tables: Tables, enlarged: float, highest: float, unit: str = "N/m", sliding: int = 0) -> Figure:
    """(a) The deformed surface under its pressure. (b) The row of springs. (c) Force per length of both models.

    enlarged : how often heights of (a) are; highest : pressure at which its colours end [Pa]
    unit : of a line force
    sliding : 1 where what presses slides forwards, along -x, -1 backwards, 0 at rest
    """
    springs, x = ROW in tables, tables[LINES]["x"].to_numpy()
    span = _edges(x)[[0, -1]]
    aspect = relief.Camera().aspect(*(float(np.ptp(tables[SURFACE][name])) for name in ("x", "y")))
    drawing = style.canvas("double", max(LEAST, AROUND + SHARE * style.across("double") * aspect))
    left, right = drawing.subfigures(1, 2, squeeze=False, width_ratios=(1.45, 1))[0]
    surface(left, left.subplots(), tables[SURFACE], enlarged, highest, sliding, _title(0, "3D"))
    panels = right.subplots(1 + springs, 1, sharex=True, squeeze=False)[:, 0]
    if springs:
        row(panels[0], tables[ROW], tables[LINES], span)
    compared(panels[-1], tables[LINES], span, unit)
    panels[-1].set_title(_title(1 + springs, "force per length"))
    if springs:
        panels[0].set_title(_title(1, "1D"))
    clear(drawing, panels[-1:])
    if springs:
        panels[0].set_title(_title(1, f"1D, heights × {enlarged_in(panels[0], tables[ROW], span):.2g}"))
    return drawing


def surface(
    drawing, axes: Axes, table: DataFrame, enlarged: float, highest: float, sliding: int, title: str
) -> None:
    """Panel of the deformed surface, coloured by pressure, with scales along its edges."""
    lowered, pressure = (touching.unstacked(table, "y", "x", name) for name in ("displacement", "pressure"))
    x, y, height = lowered.columns.to_numpy(), lowered.index.to_numpy(), -lowered.to_numpy()
    camera, (up, pascal) = relief.Camera(exaggeration=enlarged), prefixed(highest, "Pa")
    image = relief.block(axes, x, y, height, up * pressure.to_numpy(), up * highest, camera)
    relief.ruled(axes, x, y, height, camera)
    if sliding:
        relief.arrow(axes, x, y, height, camera, "indenter slides", sliding > 0)
    axes.set_title(f"{title}, heights × {enlarged:g}")
    bar = axes.inset_axes((0.14, -0.09, 0.62, 0.035))
    shades.colours(drawing, image, f"pressure [{pascal}]", cax=bar, orientation="horizontal", extend="max")


def row(axes: Axes, section: DataFrame, lines: DataFrame, span: Sequence[float]) -> None:
    """Panel of the row of springs under the rigid profile: those that press in colour."""
    seen, ends = touching.section_of(section), (span[0], span[1])
    limits = touching.heights([seen], ends)
    (along, x_unit), (up, y_unit) = prefixed(ends, "m"), prefixed(limits, "m")
    low, high = (up * limit for limit in limits)
    indenter = np.minimum(up * seen.indenter, high)
    axes.fill_between(along * seen.x, indenter, high, color=touching.rigid(), linewidth=0)
    touching.level(axes)
    places = _edges(lines["x"].to_numpy())[SPRINGS // 2 :: SPRINGS]
    places = places[(seen.x[0] <= places) & (places <= seen.x[-1])]
    pressing = np.histogram(seen.x[seen.touching], _edges(places))[0] > 0
    tops = up * np.interp(places, seen.x, seen.surface)
    wide = along * COIL * (places[1] - places[0])
    for chosen, colour, times in ((~pressing, touching.skin(), 0.45), (pressing, style.COLOUR["MDR"], 0.75)):
        springs = [
            _spring(along * at, low, top, wide) for at, top in zip(places[chosen], tops[chosen], strict=True)
        ]
        axes.add_collection(LineCollection(springs, colors=[colour], linewidths=style.width(times)))
    axes.plot(along * seen.x, up * seen.surface, color=touching.skin(), linewidth=style.width(0.5))
    axes.axhline(low, color=style.ink(), linewidth=style.width(2.0))
    axes.set(xlim=[along * end for end in ends], ylim=(low, high), ylabel=f"height [{y_unit}]")
    axes.set_xlabel(f"x [{x_unit}]")
    axes.label_outer()


def compared(axes: Axes, lines: DataFrame, span: Sequence[float], unit: str) -> None:
    """Panel of the force per length: a bar for each spring, and the pressure integrated over y as steps."""
    (along, x_unit), three = prefixed(span, "m"), lines["line_force_3d"]
    both = [lines[name] for name in ("line_force_1d", "line_force_3d") if name in lines]
    up, name = prefixed([each.max() for each in both], unit)
    x = lines["x"].to_numpy()
    if "line_force_1d" in lines:
        look: dict[str, Any] = {"color": style.COLOUR["MDR"], "alpha": 0.45, "fill": True}
        axes.stairs(up * lines["line_force_1d"], along * _edges(x), label="1D: force of the springs", **look)
    look = style.look("BEM", marker="", linestyle="-", label="3D: pressure integrated over y")
    axes.plot(along * x, up * three, drawstyle="steps-mid", **look)
    axes.set(xlim=[along * end for end in span], xlabel=f"x [{x_unit}]", ylabel=f"line force [{name}]")
    axes.set_ylim(0, 1.4 * up * max(each.max() for each in both))
    axes.legend(loc="upper right", handlelength=1.4, borderaxespad=0.1)


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


def _edges(places):
    """Ends of strips by their middles."""
    half = (places[1] - places[0]) / 2
    return np.append(places - half, places[-1] + half)


def _means(ends, values, edges):
    """Means between edges of what is constant between ends, and zero beyond."""
    sums = np.concatenate([[0.0], np.cumsum(values * np.diff(ends))])
    return np.diff(np.interp(edges, ends, sums)) / np.diff(edges)


def _shown(surface: xarray.Dataset) -> DataFrame:
    """Means over squares of pixels, of which no more are left than a picture tells apart."""
    if surface.sizes["y"] == 1:
        deep = STRIP_DEPTH * float(np.ptp(surface["x"].values))
        surface = surface.reindex(y=[-deep / 2, deep / 2], method="nearest")
    step = max(1, ceil((surface.sizes["x"] * surface.sizes["y"] / MOST_POINTS) ** 0.5))
    squares = {"x": step, "y": min(step, surface.sizes["y"] // 2)}
    return surface.coarsen(squares, boundary="trim").mean().to_dataframe().reset_index()


def _spring(x, bottom, top, wide):
    """Zigzag (n, 2) from the bottom to the top."""
    turns = np.tile([wide, -wide], COILS)
    across = np.concatenate([[0.0, 0.0], turns, [0.0, 0.0]])
    up = np.concatenate([[0.0], np.linspace(0.12, 0.88, len(turns) + 2), [1.0]])
    return np.column_stack([x + across, bottom + up * (top - bottom)])


def enlarged_in(axes: Axes, section: DataFrame, span) -> float:
    """How often heights are enlarged in the panel of the springs, once it has its place."""
    box, limits = axes.get_window_extent(), touching.heights([touching.section_of(section)], (span[0], span[1]))
    return (box.height / np.ptp(limits)) / (box.width / np.ptp(span))


def _title(k, text):
    return f"({letter(k)}) {text}"
