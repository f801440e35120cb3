"""The model: a cone that moves over an elastomer, and the row of elements that stands for it (paper, Fig. 2)."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from . import style

NAME = "paper-sketch"
# The cone g = SLOPE |x| at the depth 1 in units of the depth, and the memory of the elastomer, l = v tau.
SLOPE, MEMORY = 0.5, 1.0
LEADING, TRAILING = -1 / SLOPE, 1 / SLOPE - MEMORY
ELEMENTS = np.arange(-2.5, 4.5, 0.5)
FLOOR, TOP = -2.6, 0.9
RUBBER, BODY, LINE = "#E8DFC8", "#B5B5B5", "#6B5B2E"


def figure(_: None = None) -> Figure:
    """Left: depth, ends of contact, speed. Right: springs and dashpots. Needs no data."""
    drawing = style.canvas(style.DOUBLE, 2.6)
    left, right = drawing.subplots(1, 2)
    for axes, title in ((left, "(a) contact on the large scale"), (right, "(b) model of the elastomer")):
        axes.set(xlim=(-3.6, 5.1), ylim=(FLOOR - 0.25, TOP + 0.15), title=title)
        axes.set_axis_off()
        _indenter(axes)
    _large_scale(left)
    _elements(right)
    return drawing


def sheets(_: None = None) -> dict:
    """None: nothing was measured."""
    return {}


def caption(_: None = None) -> str:
    """What the figure shows."""
    return (
        "(a) A rigid cone, pressed into the elastomer to the depth d below its undisturbed level (dashed), moves "
        "to the left at the speed v. In its frame the elastomer flows to the right: it meets the cone at −a₁ and "
        "leaves it at a₂, where elastic and viscous force cancel, and returns exponentially over the length v τ. "
        f"The surface is that of a Kelvin solid, g = c |x|, with v τ/d = {MEMORY:g} and c = {SLOPE:g}. "
        "(b) The elastomer is a row of independent elements a spacing Δx apart on a rigid base, each a spring of "
        "stiffness 4 G Δx in parallel with a dashpot of damping constant 4 η Δx, with the shear modulus G and the "
        "viscosity η = G τ. Those in dark are pressed by the profile."
    )


def displacement(x):
    """u/d into the elastomer at x/d: d - g from -a1 to a2, where d = g + l g', and exponential behind it."""
    left_behind = (1 - SLOPE * TRAILING) * np.exp(-(np.maximum(x, TRAILING) - TRAILING) / MEMORY)
    return np.where(x <= TRAILING, np.maximum(0, 1 - SLOPE * np.abs(x)), left_behind)


def _indenter(axes: Axes):
    x = np.array([-(1 + TOP), 0, 1 + TOP]) / SLOPE
    axes.fill_between(x, SLOPE * np.abs(x) - 1, TOP, color=BODY, linewidth=0)
    axes.plot(x, SLOPE * np.abs(x) - 1, color="0.25", linewidth=1.1)
    axes.text(0, 0.55, "rigid indenter", ha="center", fontsize=7)
    _arrow(axes, (0.5, 0.33), (-0.5, 0.33), "->")
    axes.text(0, 0.05, "$v$", ha="center", fontsize=8)


def _large_scale(axes):
    x = np.linspace(-3.6, 5.1, 871)
    axes.fill_between(x, -displacement(x), FLOOR, color=RUBBER, linewidth=0)
    axes.plot(x, -displacement(x), color=LINE, linewidth=1.1)
    touched = np.linspace(LEADING, TRAILING, 101)
    axes.plot(touched, -displacement(touched), color=style.COLOUR["MDR"], linewidth=2.4, solid_capstyle="butt")
    axes.axhline(0, color="0.3", linewidth=0.7, linestyle=(0, (5, 3)), zorder=1)
    for end, name in ((LEADING, r"$-a_{\mathrm{1}}$"), (TRAILING, r"$a_{\mathrm{2}}$")):
        axes.plot([end, end], [-displacement(end), -1.55], color="0.3", linewidth=0.6, linestyle=":")
        axes.text(end, -1.62, name, ha="center", va="top", fontsize=8)
    axes.text(0, -1.62, "0", ha="center", va="top", fontsize=8)
    axes.plot([0, 0], [-1, -1.55], color="0.3", linewidth=0.6, linestyle=":")
    _arrow(axes, (LEADING, -1.5), (TRAILING, -1.5), "<->")
    axes.text(LEADING / 2, -1.47, "contact", ha="center", va="bottom", fontsize=7)
    axes.plot([0, 4.1], [-1, -1], color="0.3", linewidth=0.6, linestyle=":")
    _arrow(axes, (3.9, 0), (3.9, -1), "<->")
    axes.text(4.05, -0.5, "$d$", va="center", fontsize=8)
    axes.text(-3.2, -2.25, "elastomer flows →", fontsize=7)


def _elements(axes):
    touched = (LEADING < ELEMENTS) & (ELEMENTS <= TRAILING)
    for x, held in zip(ELEMENTS, touched, strict=True):
        _element(axes, x, -float(displacement(x)), "black" if held else "0.62")
    axes.fill_between(
        [ELEMENTS[0] - 0.3, ELEMENTS[-1] + 0.3],
        FLOOR,
        FLOOR - 0.18,
        facecolor="white",
        edgecolor="0.3",
        hatch="/////",
        linewidth=0.6,
    )
    for x, name, side in (
        (ELEMENTS[0] - 0.25, r"$4G\Delta x$", "right"),
        (ELEMENTS[-1] + 0.25, r"$4\eta\Delta x$", "left"),
    ):
        axes.text(x, FLOOR + 0.45 * -FLOOR, name, ha=side, va="center", fontsize=8)
    first, second = ELEMENTS[-3], ELEMENTS[-2]
    for x in (first, second):
        axes.plot([x, x], [0.05, 0.34], color="0.3", linewidth=0.6)
    _arrow(axes, (first - 0.35, 0.24), (first, 0.24), "->")
    _arrow(axes, (second + 0.35, 0.24), (second, 0.24), "->")
    axes.text((first + second) / 2, 0.4, r"$\Delta x$", ha="center", fontsize=8)


def _element(axes, x, top, colour):
    """Spring and dashpot side by side from the base to a plate at the top."""
    look = {"color": colour, "linewidth": 0.8, "solid_capstyle": "round"}
    spring, dashpot, low = x - 0.1, x + 0.1, FLOOR + 0.25
    axes.plot([x - 0.14, x + 0.14], [top, top], **(look | {"linewidth": 1.8}))
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
    axes.annotate("", end, start, arrowprops={"arrowstyle": kind, "linewidth": 0.8, "shrinkA": 0, "shrinkB": 0})
