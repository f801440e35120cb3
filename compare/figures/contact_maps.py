"""One contact: pressure, gap and real contact with the wake from above, and sections in both dimensionalities."""

from collections.abc import Mapping, Sequence
from math import ceil
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from pandas import DataFrame

from scene import Cylinder, Plane, Program

from ..report.page import Plot, Tables
from ..report.views import Section, View
from . import shades, style, touching
from .lettering import lettered
from .prefixes import prefixed

NAME = "contact-maps"
SECTIONS = {"BEM": f"{NAME}-section-3d", "MDR": f"{NAME}-section-1d"}
PRESSURE, SURFACE = f"{NAME}-pressure", f"{NAME}-surface"
TITLES = {"BEM": "3D: section y = 0", "MDR": "1D: profile and elements"}
MOST_PIXELS = 10_000  # of the maps of the surface: of a finer grid every second one, or third, is shown
HEIGHT = 1.9  # of the panels below [inch]
LETTERED, TALLEST = (0.5, 1.15), 1.2  # what is written beside and around a map [inch]; of a map, height over width
CLOSED = 1e-6  # of the relief of the indenter: a gap of less is none
# Depths of the lowest point, from which gaps have one colour: beside a blunt body they are without end.
OPEN = 30.0


def plot(view: View | None, folder: str = "") -> Plot | None:
    """Plot of a view, of whichever of the two dimensionalities it has; None without a view."""
    if view is None:
        return None
    options: dict[str, Any] = {
        "span": list(view.span),
        "aside": view.aside,
        "radius": view.radius,
        "flow": _flow(view),
    }
    tables = {}
    if view.space is not None:
        around, pressure, alike = view.space.around, view.space.pressure, len(view.space.around.y) == 1
        y, x = np.meshgrid(around.y, around.x, indexing="ij")
        pressed = (pressure > 0) | alike
        tables[SECTIONS["BEM"]] = _section(view.space.section, view.span)
        tables[PRESSURE] = DataFrame({"x": x[pressed], "y": y[pressed], "pressure": pressure[pressed]})
        options |= {"pixel": float(around.x[1] - around.x[0]), "alike": alike}
        options |= {"line_contact": isinstance(view.scene.indenter, Cylinder)}
        options |= {"deepest": _deepest(view)}
        if not alike:
            tables[SURFACE] = surface = _surface(view, x, y)
            greatest, relief = surface["gap"].max(), float(np.ptp(around.indenter))
            shown = min(greatest, OPEN * float(around.depth - around.indenter.min()))
            options |= {"highest_gap": float(shown if greatest > CLOSED * relief else relief)}
    if view.line is not None:
        tables[SECTIONS["MDR"]] = _section(view.line, view.span)
    alternative = "Maps of pressure, gap and real contact above; below, sections through indenter and elastomer."
    return Plot(f"{folder}{NAME}", figure, tables, _caption(view), alternative, options)


def figure(
    tables: Tables,
    span: Sequence[float],
    aside: float,
    radius: float | None,
    flow: str,
    pixel: float = 0.0,
    alike: bool = False,
    line_contact: bool = False,
    deepest: float = 1.0,
    highest_gap: float = 1.0,
) -> Figure:
    """Above: pressure, gap and real contact in three dimensions. Below: the section y = 0, and the 1D contact.

    span, aside : first and last x, farthest y [m]; radius : of the smooth relaxed contact [m]; flow : in words
    pixel : of the maps [m]
    alike : whether the contact is alike along y, and the pressure stands in place of the maps
    deepest, highest_gap : displacement and gap at which colours end [m]
    """
    sections = {solver: touching.section_of(tables[name]) for solver, name in SECTIONS.items() if name in tables}
    maps = SURFACE in tables
    tall = 2 * aside / (span[1] - span[0])
    height = (style.across("double") / 3 - LETTERED[0]) * min(tall, TALLEST) + LETTERED[1] if maps else 0.0
    drawing = style.canvas("double", height + HEIGHT)
    below = drawing
    if maps:
        above, below = drawing.subfigures(2, 1, squeeze=False, height_ratios=(height, HEIGHT))[:, 0]
        _maps(above, tables, span, aside, radius, flow, pixel, deepest, highest_gap)
    panels = below.subplots(1, len(sections) + alike, sharex=alike, squeeze=False)[0]
    if alike:
        _pressure(panels[0], tables[PRESSURE], span, radius if line_contact else None)
    limits = touching.heights(list(sections.values()), (span[0], span[1]))
    for axes, (solver, each) in zip(panels[alike:], sections.items(), strict=True):
        touching.section(axes, each, solver, (span[0], span[1]), limits, 0.0 if solver == "MDR" else None)
        axes.set_title(TITLES[solver])
        touching.remark(axes, flow)
    lettered([axes for axes in drawing.axes if axes.get_title(loc="left")])
    style.lay_out(drawing, passes=2)  # places for maps of equal scales are found in a second pass alone
    for axes in panels[alike:]:
        touching.exaggeration(axes, (span[0], span[1]), limits)
    return drawing


def _section(section: Section, span) -> DataFrame:
    inside = (span[0] <= section.x) & (section.x <= span[1])
    columns = {name: getattr(section, name)[inside] for name in ("x", "indenter", "surface", "touching")}
    return DataFrame(columns)


def _surface(view, x, y) -> DataFrame:
    """Gap and displacement that are shown, on no more points than are told apart."""
    around = view.space.around
    rows, columns = (
        np.flatnonzero((low <= values) & (values <= high))
        for values, (low, high) in ((around.y, (-view.aside, view.aside)), (around.x, view.span))
    )
    step = max(1, ceil((len(rows) * len(columns) / MOST_PIXELS) ** 0.5))
    shown = slice(rows[0], rows[-1] + 1, step), slice(columns[0], columns[-1] + 1, step)
    found = {"x": x + around.lag, "y": y, "gap": view.space.gap, "displacement": around.displacement}
    return DataFrame({name: values[shown].ravel() for name, values in found.items()})


def _maps(
    drawing, tables: Mapping[str, DataFrame], span, aside, radius, flow, pixel, deepest, highest_gap
) -> None:
    """Three panels to one scale, each with its bar below."""
    scale, unit = prefixed([*span, aside], "m")
    panels = drawing.subplots(1, 3, sharex=True, sharey=True)
    x, y, pressure = touching.gridded(tables[PRESSURE], "pressure", pixel)
    gap, lowered = (touching.unstacked(tables[SURFACE], "y", "x", name) for name in ("gap", "displacement"))
    x, y, at = scale * x, scale * y, (scale * gap.columns.to_numpy(), scale * gap.index.to_numpy())
    highest = touching.highest_pressure(pressure)
    (up, pascal), (high, of_gap), (deep, of_depth) = (
        prefixed(highest, "Pa"),
        prefixed(highest_gap, "m"),
        prefixed(deepest, "m"),
    )
    pairs, lowered = ((x, at[0]), (y, at[1])), deep * lowered.to_numpy()
    colour = style.COLOUR["BEM"]
    images = (
        touching.pressure_map(panels[0], x, y, up * pressure, up * highest),
        touching.gap_map(panels[1], *at, high * np.maximum(gap, 0.0), high * highest_gap),
        touching.contact_map(panels[2], *pairs, pressure > 0, lowered, deep * deepest, colour),
    )
    for axes, image, title, label, ink, extend in zip(
        panels,
        images,
        ("3D: pressure", "3D: gap", "3D: real contact"),
        (f"pressure [{pascal}]", f"gap [{of_gap}]", f"displacement [{of_depth}]"),
        (style.ink(), style.paper(), style.ink()),
        ("max", "max" if gap.max(axis=None) > highest_gap else "neither", "neither"),
        strict=True,
    ):
        shades.colours(drawing, image, label, ax=axes, location="bottom", extend=extend, shrink=0.9, aspect=28)
        touching.edge(axes, radius and scale * radius, ink)
        axes.set(title=title, xlabel=f"x [{unit}]")
        axes.set(xlim=[scale * end for end in span], ylim=(-scale * aside, scale * aside))
        if tables[PRESSURE].empty:
            axes.text(0.5, 0.5, "nothing touches", transform=axes.transAxes, ha="center", fontsize=style.small())
    panels[0].set_ylabel(f"y [{unit}]")
    touching.remark(panels[0], flow)


def _pressure(axes, pressed: DataFrame, span, half_width) -> None:
    """Pressure of a contact that is alike along y, which has no map."""
    (along, unit), (up, name) = prefixed(span, "m"), prefixed(pressed["pressure"], "Pa")
    axes.plot(along * pressed["x"], up * pressed["pressure"], color=style.COLOUR["BEM"])
    touching.sides(axes, half_width and along * half_width)
    axes.set(xlim=[along * end for end in span], xlabel=f"x [{unit}]", ylabel=f"pressure [{name}]")
    axes.set_ylim(bottom=0)
    axes.set_title("3D: pressure")


def _deepest(view) -> float:
    """The greatest displacement that is not hidden by the contact [m]; of all where nothing is free."""
    displacement, touched = view.space.around.displacement, view.space.touching
    free = displacement if touched.all() else displacement[~touched]
    return float(np.nanmax(free, initial=0.0)) or 1.0


def _flow(view) -> str:
    motion = view.scene.motion
    return touching.flow(motion.stages[-1].speed if isinstance(motion, Program) else motion.speed)


def _caption(view) -> str:
    plane, maps = isinstance(view.scene.indenter, Plane), view.space is not None and len(view.space.around.y) > 1
    told = {
        "(a) Pressure, colours cut at the 99th percentile; (b) gap, colours by its root; (c) real contact, the "
        "surface darker where deeper.": maps,
        "(a) Contact pressure.": view.space is not None and not maps,
        "Sections: rigid indenter and elastomer, real contact in bold, heights exaggerated as stated.": True,
        "Dashed: the smooth relaxed contact.": view.radius is not None,
        "In 1D some of the independent elements are drawn.": view.line is not None,
        "Behind the contact is the wake.": _flow(view) != "at rest" and view.space is not None and not plane,
        "One cell, which repeats.": plane,
    }
    return " ".join(sentence for sentence, holds in told.items() if holds)
