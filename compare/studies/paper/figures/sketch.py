"""The model: a cone that moves over an elastomer, and the row of elements that stands for it (paper, Fig. 2)."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ....figures import style, touching
from ....report.page import Plot, Tables

NAME = "paper-sketch"
# The cone g = SLOPE |x| at the depth 1 in units of the depth, and the memory of the elastomer, l = v tau.
SLOPE, MEMORY = 0.5, 1.0
LEADING, TRAILING = -1 / SLOPE, 1 / SLOPE - MEMORY
ELEMENTS = np.arange(-2.5, 4.5, 0.5)
FLOOR, TOP = -2.6, 0.9


def plot() -> Plot:
    """The plot, which needs no data."""
    return Plot(
        NAME,
        figure,
        {},
        "(a) A rigid cone at the depth d moves to the left at the speed v. The Kelvin solid meets it at −a₁, "
        f"leaves it at a₂, and returns over v τ, here {MEMORY:g} d. (b) Elements of the model, each a spring "
        "4 G Δx beside a dashpot 4 η Δx, η = G τ; those pressed are dark.",
        "Left, a cone in an elastomer with depth, ends of contact and speed. Right, a row of springs and "
        "dashpots.",
    )


def figure(tables: Tables) -> Figure:
    """Left: depth, ends of contact, speed. Right: springs and dashpots. Needs no table."""
    drawing = style.canvas("double", 2.6)
    left, right = drawing.subplots(1, 2)
    for axes, title in ((left, "(a) contact on the large scale"), (right, "(b) model of the elastomer")):
        axes.set(xlim=(-3.6, 5.1), ylim=(FLOOR - 0.25, TOP + 0.15), title=title)
        axes.set_axis_off()
        _indenter(axes)
    _large_scale(left)
    _elements(right)
    return drawing


def displacement(x):
    """Displacement u/d into the elastomer at x/d: d - g in contact, exponential behind it."""
    left_behind = (1 - SLOPE * TRAILING) * np.exp(-(np.maximum(x, TRAILING) - TRAILING) / MEMORY)
    return np.where(x <= TRAILING, np.maximum(0, 1 - SLOPE * np.abs(x)), left_behind)


def _indenter(axes: Axes):
    x = np.array([-(1 + TOP), 0, 1 + TOP]) / SLOPE
    axes.fill_between(x, SLOPE * np.abs(x) - 1, TOP, color=touching.rigid(), linewidth=0)
    axes.plot(x, SLOPE * np.abs(x) - 1, **style.line(0.25))
    axes.text(0, 0.55, "rigid indenter", ha="center", fontsize=style.small())
    _arrow(axes, (0.5, 0.33), (-0.5, 0.33), "->")
    axes.text(0, 0.05, "$v$", ha="center", fontsize=style.size())


def _large_scale(axes):
    x, thin = np.linspace(-3.6, 5.1, 871), style.line(0.3, 0.55, linestyle=":")
    inside = (x >= LEADING) & (x <= TRAILING)
    touching.bodies(axes, x, np.full(x.size, TOP), -displacement(x), inside, (FLOOR, TOP))
    axes.axhline(0, **style.line(0.3, 0.65, linestyle=(0, (5, 3)), zorder=1))
    for end, name in ((LEADING, r"$-a_{\mathrm{1}}$"), (TRAILING, r"$a_{\mathrm{2}}$"), (0, "0")):
        axes.plot([end, end], [-displacement(end), -1.55], **thin)
        axes.text(end, -1.62, name, ha="center", va="top", fontsize=style.size())
    _arrow(axes, (LEADING, -1.5), (TRAILING, -1.5), "<->")
    axes.text(LEADING / 2, -1.47, "contact", ha="center", va="bottom", fontsize=style.small())
    axes.plot([0, 4.1], [-1, -1], **thin)
    _arrow(axes, (3.9, 0), (3.9, -1), "<->")
    axes.text(4.05, -0.5, "$d$", va="center", fontsize=style.size())


def _elements(axes):
    touched = (LEADING < ELEMENTS) & (ELEMENTS <= TRAILING)
    for x, held in zip(ELEMENTS, touched, strict=True):
        _element(axes, x, -float(displacement(x)), style.ink() if held else style.grey(0.62))
    ground = {"facecolor": style.paper(), "edgecolor": style.grey(0.3), "linewidth": style.width(0.55)}
    ends = [ELEMENTS[0] - 0.3, ELEMENTS[-1] + 0.3]
    axes.fill_between(ends, FLOOR, FLOOR - 0.18, hatch="/////", **ground)
    look = {"va": "center", "fontsize": style.size()}
    axes.text(ELEMENTS[0] - 0.25, 0.55 * FLOOR, r"$4G\Delta x$", ha="right", **look)
    axes.text(ELEMENTS[-1] + 0.25, 0.55 * FLOOR, r"$4\eta\Delta x$", ha="left", **look)
    first, second = ELEMENTS[-3], ELEMENTS[-2]
    for x, side in ((first, -1), (second, 1)):
        axes.plot([x, x], [0.05, 0.34], **style.line(0.3, 0.55))
        _arrow(axes, (x + side * 0.35, 0.24), (x, 0.24), "->")
    axes.text((first + second) / 2, 0.4, r"$\Delta x$", ha="center", fontsize=style.size())


def _element(axes, x, top, colour):
    """Spring and dashpot side by side from the base to a plate at the top."""
    look = {"color": colour, "linewidth": style.width(0.7), "solid_capstyle": "round"}
    spring, dashpot, low = x - 0.1, x + 0.1, FLOOR + 0.25
    axes.plot([x - 0.14, x + 0.14], [top, top], **(look | {"linewidth": style.width(1.6)}))
    coils = np.linspace(low, top - 0.25, 13)
    zigzag = np.concatenate([[0], np.tile([-0.07, 0.07], 5), [-0.07], [0]])
    axes.plot([spring, *(spring + zigzag), spring], [FLOOR, *coils, top], **look)
    middle = FLOOR + 0.45 * (top - FLOOR)
    axes.plot([dashpot, dashpot], [FLOOR, middle - 0.2], **look)
    axes.plot(dashpot + 0.07 * np.array([-1, -1, 1, 1]), middle + np.array([0.2, -0.2, -0.2, 0.2]), **look)
    axes.plot([dashpot - 0.05, dashpot + 0.05], [middle, middle], **look)
    axes.plot([dashpot, dashpot], [middle, top], **look)


def _arrow(axes, start, end, kind):
    """An arrow with its tip at the end; <-> has two."""
    look = {"arrowstyle": kind, "linewidth": style.width(0.7), "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", end, start, arrowprops=look)
