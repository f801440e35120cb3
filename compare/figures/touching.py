"""Panels of a contact: sections through both bodies, and maps of it seen from above."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap, ListedColormap, PowerNorm, to_rgb
from matplotlib.image import AxesImage
from matplotlib.lines import Line2D
from matplotlib.typing import ColorType
from pandas import DataFrame

from ..report.views import Section
from . import style
from .prefixes import prefixed

# Elements that are drawn of a row; heights above and below what is shown of the surfaces, of their range.
ELEMENTS, ABOVE, BELOW = 48, 0.45, 0.35
HIGHEST = 99  # percentile of the pressures in contact at which colours end
# Sand, of which the elastomer is a tint.
SAND = "#8A7A45"

MOST_PIXELS = 2**26  # of a map: a contact of half the side of the finest grid


def elastomer() -> tuple[float, float, float]:
    """Colour of the inside of the elastomer, light on paper that is light and dark on dark."""
    return _tint(0.25, style.paper())


def skin() -> tuple[float, float, float]:
    """Colour of the line where the elastomer ends."""
    return _tint(0.75, style.ink())


def rigid() -> tuple[float, float, float]:
    """Colour of the inside of what is rigid."""
    return style.grey(0.7)


def _tint(share, ground):
    return tuple((share * np.array(to_rgb(SAND)) + (1 - share) * np.array(to_rgb(ground))).tolist())


def section_of(table: DataFrame) -> Section:
    """Section that a table holds."""
    x, indenter, surface = (table[name].to_numpy(float) for name in ("x", "indenter", "surface"))
    return Section(x, indenter, surface, table["touching"].to_numpy(bool))


def gridded(table: DataFrame, name: str, pixel: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """x (N,), y (M,) and values (M, N) of pixels of which a table has some; zero of those it has not.

    Raises ValueError of a map of more than MOST_PIXELS, such as one of
    places that are not on a grid of such pixels.
    """
    if table.empty:
        ends = np.array([-pixel, pixel]) / 2
        return ends, ends, np.zeros((2, 2))
    wide, high = (float(np.ptp(table[along])) for along in ("x", "y"))
    if not (pixel > 0 and (wide / pixel + 1) * (high / pixel + 1) <= MOST_PIXELS):
        raise ValueError(f"a map of {wide:g} x {high:g} m in pixels of {pixel:g} m")
    places = []
    for along in ("x", "y"):
        values = table[along].to_numpy()
        index = np.rint((values - values.min()) / pixel).astype(int)
        # At least two, as an image needs the side of a pixel.
        places.append((values.min() + pixel * np.arange(max(index.max(), 1) + 1), index))
    (x, column), (y, row) = places
    found = np.zeros((len(y), len(x)))
    found[row, column] = table[name]
    return x, y, found


def unstacked(table: DataFrame, index: str, columns: str, values: str) -> DataFrame:
    """A column of a table by two others. Raises ValueError of a table that lacks more of it than it has."""
    if table[index].nunique() * table[columns].nunique() > 2 * len(table):
        raise ValueError(f"{values} is not known at every {index} and {columns}")
    return table.pivot(index=index, columns=columns, values=values)


def heights(sections: Sequence[Section], span: tuple[float, float]) -> tuple[float, float]:
    """(lowest, highest) [m] of panels that show these sections over a span of x [m]."""
    seen = [
        values[(span[0] <= each.x) & (each.x <= span[1])]
        for each in sections
        for values in (each.surface, each.indenter[each.touching], each.surface[each.touching])
        if len(values) == len(each.x)
    ]
    values = np.concatenate([*seen, [0.0]])
    low, high = np.nanmin(values), np.nanmax(values)
    room = (high - low) or 1e-3 * (span[1] - span[0])
    return float(low - BELOW * room), float(high + ABOVE * room)


def bodies(axes: Axes, x, indenter, surface, touching, ends: Sequence[float], **look: Any) -> list[Line2D]:
    """Elastomer and rigid indenter between two heights, in the units of the axes.

    Returns the lines of the surface and of real contact, which is in bold; look : of that.
    """
    bottom, top = ends
    axes.fill_between(x, np.maximum(surface, bottom), bottom, color=elastomer(), linewidth=0)
    axes.fill_between(x, np.minimum(indenter, top), top, color=rigid(), linewidth=0)
    look = {"color": style.COLOUR["MDR"], "linewidth": style.width(2.2), "solid_capstyle": "butt", **look}
    thin = axes.plot(x, surface, color=skin(), linewidth=style.width(0.65))
    return [*thin, *axes.plot(x, np.where(touching, surface, np.nan), **look)]


def section(
    axes: Axes,
    seen: Section,
    solver: str,
    span: tuple[float, float],
    limits: tuple[float, float],
    row: float | None = None,
) -> None:
    """Both bodies over a span of x between two heights [m], real contact in bold.

    row : by how much the elastomer has passed [m], where it is drawn as the row of elements that stands for it
    """
    (along, x_unit), (up, unit) = prefixed(span, "m"), prefixed(limits, "m")
    x, surface, ends = along * seen.x, up * seen.surface, [up * limit for limit in limits]
    colour = style.COLOUR[solver]
    if row is not None:
        _elements(axes, along * _places(span, row), x, surface, seen.touching, ends[0], colour)
    level(axes)
    marker = "." if _single(seen.touching) else ""
    bodies(axes, x, up * seen.indenter, surface, seen.touching, ends, color=colour, marker=marker)
    axes.set(xlim=[along * end for end in span], ylim=ends)
    axes.set(xlabel=f"x [{x_unit}]", ylabel=f"height [{unit}]")


def level(axes: Axes) -> None:
    """The undeformed surface, dashed."""
    axes.axhline(0.0, **style.line(0.35, 0.5, linestyle=(0, (5, 3)), zorder=1.5))


def flow(speed: float) -> str:
    """Which way the indenter slides, against the flow of the elastomer along x."""
    return "at rest" if speed == 0 else "← indenter slides" if speed > 0 else "indenter slides →"


def exaggeration(axes: Axes, span: tuple[float, float], limits: tuple[float, float]) -> None:
    """Times by which heights are drawn larger than lengths, above a section that has its place in the figure."""
    box = axes.get_window_extent()
    times = box.height / (limits[1] - limits[0]) / (box.width / (span[1] - span[0]))
    axes.set_title(f"heights × {times:.2g}", loc="right", fontsize=style.small(), fontweight="normal")


def pressure_map(axes: Axes, x, y, pressure, highest: float) -> AxesImage:
    """Pressure in units that `highest` reads well in, where there is any; x, y in the units of the axes."""
    touched = np.ma.masked_less_equal(pressure, 0)
    return _image(axes, x, y, touched, cmap="viridis_r", vmin=0, vmax=highest)


def gap_map(axes: Axes, x, y, gap, highest: float) -> AxesImage:
    """Gap up to the highest, dark where it is small; shades go with its root, which tells small gaps apart."""
    return _image(axes, x, y, gap, cmap="cividis", norm=PowerNorm(0.5, 0, highest))


def contact_map(axes: Axes, x, y, touching, displacement, deepest: float, colour) -> AxesImage:
    """Real contact in one colour, on the surface of the elastomer, which is the darker the deeper it lies.

    x, y : pairs, of what touches and of the displacement
    """
    ends: list[ColorType] = [style.paper(), skin()]
    whole = LinearSegmentedColormap.from_list("surface", ends)
    shades = ListedColormap(whole(np.linspace(0.0, 0.6, 256)))
    (x, x_surface), (y, y_surface) = x, y
    image = _image(axes, x_surface, y_surface, displacement, cmap=shades, vmin=0, vmax=deepest)
    _image(axes, x, y, np.ma.masked_equal(np.asarray(touching, float), 0), cmap=ListedColormap([colour]))
    return image


def remark(axes: Axes, text: str) -> None:
    """Write into the lower left corner, readable on whatever is drawn there."""
    ground = {"facecolor": style.paper(), "edgecolor": "none", "alpha": 0.75, "pad": 1.0}
    axes.text(0.03, 0.04, text, transform=axes.transAxes, fontsize=style.small(), bbox=ground)


def edge(axes: Axes, radius: float | None, colour) -> None:
    """A dashed circle, the edge of a smooth relaxed contact in the units of the axes, if there is one."""
    if radius is not None:
        angle = np.linspace(0, 2 * np.pi, 181)
        axes.plot(radius * np.cos(angle), radius * np.sin(angle), "--", color=colour, linewidth=style.width(0.65))


def sides(axes: Axes, half_width: float | None) -> None:
    """Dashed, the sides of a smooth relaxed line contact."""
    if half_width is not None:
        for side in (-half_width, half_width):
            axes.axvline(side, color=style.ink(), linewidth=style.width(0.65), linestyle="--")


def highest_pressure(pressure) -> float:
    """The greatest that is told apart: of all in contact but the highest of a hundred; 1 of nothing."""
    touched = pressure[pressure > 0]
    return float(np.percentile(touched, HIGHEST)) if touched.size else 1.0


def _image(axes, x, y, values, **look):
    half = (x[1] - x[0]) / 2
    extent = (x[0] - half, x[-1] + half, y[0] - half, y[-1] + half)
    return axes.imshow(values, origin="lower", extent=extent, interpolation="nearest", aspect="equal", **look)


def _places(span, passed):
    """Places of some of the row of elements, equally spaced, after it has passed by a length [m]."""
    pitch = (span[1] - span[0]) / ELEMENTS
    return span[0] + (passed - span[0]) % pitch + pitch * np.arange(ELEMENTS)


def _elements(axes, places, x, surface, touching, bottom, colour):
    """Elements that touch in the colour of the solver, the others in that of the surface."""
    places = places[(x[0] <= places) & (places <= x[-1])]
    nearest = np.unique(np.clip(np.searchsorted(x, places), 0, len(x) - 1))
    for chosen, shade, times in ((~touching, skin(), 0.5), (touching, colour, 0.8)):
        drawn = nearest[chosen[nearest]]
        axes.vlines(x[drawn], bottom, surface[drawn], color=shade, linewidth=style.width(times))


def _single(touching):
    """Whether any contact is of one point alone, of which no line is drawn."""
    alone = touching & ~np.roll(touching, 1) & ~np.roll(touching, -1)
    return bool(alone.any())
