"""The contact at the scene's own point: pressure, gap and real contact with the wake from above, and sections."""

from collections.abc import Mapping
from math import ceil

import numpy as np
from matplotlib.figure import Figure

from scene import Cylinder, Plane, Program

from ..verdict import Judgement
from ..views import Section, View, of_judgement
from ..plots import style, touching
from ..plots.prefixes import prefixed

NAME = "contact-maps"
MOST_PIXELS = 10_000  # of the maps of the surface: of a finer grid every second one, or third, is shown
SECTIONS = 1.9  # height of the panels below [inch]
LETTERED, TALLEST = (0.5, 1.15), 1.2  # what is written beside and around a map [inch]; of a map, height over width
CLOSED = 1e-6  # of the relief of the indenter: a gap of less is none


def figure(judgement: Judgement) -> Figure | None:
    """Above: pressure, gap and real contact in three dimensions. Below: the section y = 0, and the 1D contact.

    Of contacts that are alike along y the pressure stands in place of the maps. None without either's fields.
    """
    seen = of_judgement(judgement)
    return None if seen is None else drawn(seen)


def sheets(judgement: Judgement) -> Mapping[str, Mapping[str, np.ndarray]]:
    """What is shown, as of `shown`."""
    seen = of_judgement(judgement)
    return {} if seen is None else shown(seen)


def caption(judgement: Judgement) -> str:
    """What the figure shows."""
    seen = of_judgement(judgement)
    return "" if seen is None else told(seen)


def drawn(seen: View) -> Figure:
    """The figure of a view, of whichever of the two dimensionalities it has."""
    alike = seen.space is not None and len(seen.space.around.y) == 1
    maps = seen.space is not None and not alike
    sections = _sections(seen)
    height = _height(seen) if maps else 0.0
    drawing = style.canvas("double", height + SECTIONS)
    below = drawing
    if maps:
        above, below = drawing.subfigures(2, 1, squeeze=False, height_ratios=(height, SECTIONS))[:, 0]
        _maps(above, seen)
    panels = below.subplots(1, len(sections) + alike, sharex=alike, squeeze=False)[0]
    if alike:
        _pressure(panels[0], seen)
    limits = touching.heights(list(sections.values()), seen.span)
    for axes, (solver, each) in zip(panels[alike:], sections.items(), strict=True):
        touching.section(axes, each, solver, seen.span, limits, 0.0 if solver == "MDR" else None)
        axes.set_title({"BEM": "3D: section y = 0", "MDR": "1D: profile and elements"}[solver])
        touching.remark(axes, _flow(seen))
    drawing.draw_without_rendering()  # the layout finds places for maps of equal scales in a second pass alone
    return drawing


def shown(seen: View) -> dict[str, dict[str, np.ndarray]]:
    """Columns in SI units, heights above the undeformed surface: sections, pressed pixels, and surface."""
    names = {"BEM": "contact-maps-section-3d", "MDR": "contact-maps-section-1d"}
    found = {names[solver]: _columns(each, seen.span) for solver, each in _sections(seen).items()}
    if seen.space is None:
        return found
    around, pressure = seen.space.around, seen.space.pressure
    y, x = np.meshgrid(around.y, around.x, indexing="ij")
    pressed = pressure > 0
    found["contact-maps-pressure"] = {"x": x[pressed], "y": y[pressed], "pressure": pressure[pressed]}
    if len(around.y) > 1:
        rows, columns = _windowed(seen)
        gap = around.gap[rows, columns]
        found["contact-maps-surface"] = {
            "x": (x + around.lag)[rows, columns].ravel(),
            "y": y[rows, columns].ravel(),
            "gap": gap.ravel(),
            "displacement": around.displacement[rows, columns].ravel(),
        }
    return found


def told(seen: View) -> str:
    """What the figure of a view shows."""
    said, moving = [], _moving(seen)
    if seen.space is not None and len(seen.space.around.y) > 1:
        said.append(
            "Above, to one scale: contact pressure, colours cut at the 99th percentile; gap, cut at the greatest "
            "displacement; and real contact, on the surface of the elastomer, the darker the deeper it lies."
        )
        if seen.radius is not None:
            said.append("Dashed circle: the smooth relaxed contact.")
    elif seen.space is not None:
        said.append("Left: contact pressure; between the dashed lines, the smooth relaxed contact.")
    said.append(
        "Sections: rigid indenter and surface of the elastomer, real contact in bold, the undeformed level "
        "dashed; heights are exaggerated."
    )
    if seen.line is not None:
        said.append("In one dimension the profile is pressed into independent elements, of which some are drawn.")
    if moving and seen.space is not None and not isinstance(seen.scene.indenter, Plane):
        said.append("Behind the contact is the wake, which has not recovered.")
    if isinstance(seen.scene.indenter, Plane):
        said.append("One cell, which repeats.")
    return " ".join(said)


def _sections(seen) -> dict[str, Section]:
    """By solver; three dimensions first."""
    found = {} if seen.space is None else {"BEM": seen.space.section}
    return found if seen.line is None else {**found, "MDR": seen.line}


def _columns(section, span):
    inside = (span[0] <= section.x) & (section.x <= span[1])
    return {
        "x": section.x[inside],
        "indenter": section.indenter[inside],
        "surface": section.surface[inside],
        "contact": section.touching[inside].astype(int),
    }


def _height(seen):
    """Of three maps side by side with what is written around them [inch]."""
    tall = 2 * seen.aside / (seen.span[1] - seen.span[0])
    return (style.current().journal.double / 3 - LETTERED[0]) * min(tall, TALLEST) + LETTERED[1]


def _maps(drawing, seen):
    """Three panels to one scale, each with its bar below."""
    scale, unit = prefixed([*seen.span, seen.aside], "m")
    around, panels = seen.space.around, drawing.subplots(1, 3, sharex=True, sharey=True)
    x, y, lag = scale * around.x, scale * around.y, scale * around.lag
    rows, columns = _windowed(seen)
    highest = touching.highest_pressure(seen.space.pressure)
    up, name = prefixed(highest, "Pa")
    image = touching.pressure_map(panels[0], x, y, up * seen.space.pressure, up * highest)
    _bar(drawing, image, panels[0], f"pressure [{name}]")
    gap, highest = np.maximum(around.gap[rows, columns], 0.0), _highest_gap(seen)
    up, name = prefixed(highest, "m")
    image = touching.gap_map(panels[1], x[columns] + lag, y[rows], up * gap, up * highest)
    _bar(drawing, image, panels[1], f"gap [{name}]")
    lowered, deepest = around.displacement[rows, columns], _deepest(seen)
    up, name = prefixed(deepest, "m")
    image = touching.contact_map(
        panels[2],
        (x, x[columns] + lag),
        (y, y[rows]),
        seen.space.touching,
        up * lowered,
        up * deepest,
        style.COLOUR["BEM"],
    )
    _bar(drawing, image, panels[2], f"displacement [{name}]", extend="neither")
    titles, inks = ("3D: pressure", "3D: gap", "3D: real contact"), (style.ink(), style.paper(), style.ink())
    for axes, title, ink in zip(panels, titles, inks, strict=True):
        touching.edge(axes, seen.radius and scale * seen.radius, ink)
        axes.set(title=title, xlabel=f"x [{unit}]")
        axes.set(xlim=[scale * end for end in seen.span], ylim=(-scale * seen.aside, scale * seen.aside))
        if not seen.space.touching.any():
            axes.text(0.5, 0.5, "nothing touches", transform=axes.transAxes, ha="center", fontsize=style.small())
    panels[0].set_ylabel(f"y [{unit}]")
    touching.remark(panels[0], _flow(seen))


def _deepest(seen):
    """The greatest displacement that is not hidden by the contact [m]; of all where nothing is free."""
    displacement, touched = seen.space.around.displacement, seen.space.touching
    free = displacement if touched.all() else displacement[~touched]
    return float(np.nanmax(free, initial=0.0)) or 1.0


def _highest_gap(seen):
    """At which colours end [m]: the greatest displacement, of a plane the greatest gap."""
    gap, relief = seen.space.around.gap, float(np.ptp(seen.space.around.indenter))
    greatest = float(np.nanmax(gap, initial=0.0))
    if not isinstance(seen.scene.indenter, Plane):
        greatest = min(greatest, float(np.nanmax(seen.space.around.displacement, initial=0.0)))
    return greatest if greatest > CLOSED * relief else relief


def _bar(drawing, image, axes, label, extend="max", **ticks):
    bar = drawing.colorbar(image, ax=axes, location="bottom", extend=extend, shrink=0.9, aspect=28, **ticks)
    bar.set_label(label)
    bar.outline.set_linewidth(style.width(0.45))
    return bar


def _pressure(axes, seen):
    """Of a contact that is alike along y, which has no map."""
    around, pressure = seen.space.around, seen.space.pressure[0]
    (along, unit), (up, name) = prefixed(seen.span, "m"), prefixed(pressure, "Pa")
    axes.plot(along * around.x, up * pressure, color=style.COLOUR["BEM"])
    if isinstance(seen.scene.indenter, Cylinder):
        touching.sides(axes, seen.radius and along * seen.radius)
    axes.set(xlim=[along * end for end in seen.span], xlabel=f"x [{unit}]", ylabel=f"pressure [{name}]")
    axes.set_ylim(bottom=0)
    axes.set_title("3D: pressure")


def _windowed(seen):
    """Rows and columns that are shown of the gap, as slices."""
    around = seen.space.around
    rows, columns = (
        np.flatnonzero((low <= values) & (values <= high))
        for values, (low, high) in ((around.y, (-seen.aside, seen.aside)), (around.x, seen.span))
    )
    step = max(1, ceil((len(rows) * len(columns) / MOST_PIXELS) ** 0.5))
    return slice(rows[0], rows[-1] + 1, step), slice(columns[0], columns[-1] + 1, step)


def _moving(seen):
    motion = seen.scene.motion
    return motion.stages[-1].speed != 0 if isinstance(motion, Program) else motion.speed > 0


def _flow(seen):
    """Which way the elastomer passes, seen from the indenter."""
    if not _moving(seen):
        return "at rest"
    back = isinstance(seen.scene.motion, Program) and seen.scene.motion.stages[-1].speed < 0
    return "← elastomer flows" if back else "elastomer flows →"
