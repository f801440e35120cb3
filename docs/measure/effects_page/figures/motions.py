"""Friction of a sphere that starts, changes its speed, swings, comes down at an angle and turns back."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MultipleLocator

from compare.report.plots import style
from compare.report.plots.lettering import clear

NAME = "effect-motions"
THIN = 0.45  # of the width of curves
STILL = 1e-9  # step of the path that is none [1]
SOLVERS = {"1D": "MDR", "3D": "BEM"}
PANELS = {
    "start": ("start from rest", "path / a [1]"),
    "steps": ("steps of the speed", "path / a [1]"),
    "oscillation": ("oscillating load", "path / a [1]"),
    "oblique": ("oblique approach", "path / a [1]"),
    "reversal": ("reversal, first cycle", "path / a [1]"),
    "mean": ("mean friction", "amplitude over load [1]"),
}


def figure(data) -> Figure:
    """Five motions, and by how much an oscillation lowers the mean friction.

    data : rows of panel, dimension ("1D", "3D"), x, y; the panel "steady" has the friction of speeds x
    """
    drawing = style.canvas("double", 4.4)
    for letter, axes, (panel, (title, label)) in zip(
        "abcdef", drawing.subplots(2, 3).flat, PANELS.items(), strict=True
    ):
        axes.set(title=f"({letter}) {title}", xlabel=label, ylabel="$F_x$ / $F$ [1]")
        for dimension, solver in SOLVERS.items():
            x, y = _values(data, panel, dimension)
            look = {"color": style.COLOUR[solver], "label": style.LABEL[solver]}
            if panel == "mean":
                axes.plot(x, y, marker=style.MARKER[solver], linestyle="none", **look)
            else:
                chosen = _once(x) if panel == "reversal" else slice(None)
                axes.plot(x[chosen], y[chosen], style.LINE[solver], **look)
                _steady(axes, data, panel, dimension)
        if panel == "oscillation":
            axes.xaxis.set_major_locator(MultipleLocator(2))
        if panel == "mean":
            _second_order(axes, data)
    first = drawing.axes[0]
    thin = Line2D([], [], color=style.grey(0.5), linewidth=style.width(THIN), label="steady sliding")
    first.legend(handles=[*first.get_legend_handles_labels()[0], thin])
    clear(drawing, drawing.axes)
    return drawing


def _once(x):
    """From the start through one cycle, until it comes back to its own way, where one fills gaps of the other."""
    steps = np.diff(x)
    moving = np.flatnonzero(np.abs(steps) > STILL)
    turned = moving[1:][np.diff(np.sign(steps[moving])) != 0]
    if len(turned) < 2:
        return slice(None)
    back = np.flatnonzero(x[turned[1] :] >= x[turned[0]] / 2)
    return slice(0, turned[1] + back[0] + 1 if len(back) else None)


def _values(data, panel, dimension):
    rows = [row for row in data if (row["panel"], row["dimension"]) == (panel, dimension)]
    return np.array([row["x"] for row in rows], float), np.array([row["y"] for row in rows], float)


def _steady(axes, data, panel, dimension):
    """Thin lines at the steady friction, of both directions where it turns back."""
    for speed, friction in zip(*_values(data, "steady", dimension), strict=True):
        if speed > 1 and panel != "steps":
            continue
        for sign in (1, -1) if panel == "reversal" else (1,):
            axes.axhline(
                sign * friction, color=style.COLOUR[SOLVERS[dimension]], linewidth=style.width(THIN), alpha=0.6
            )


def _second_order(axes, data):
    """In logarithms, with a line of slope two through the second amplitude of one dimension."""
    x, y = _values(data, "mean", "1D")
    if not np.isfinite(y).any():
        return  # no logarithms of nothing
    axes.set(xscale="log", yscale="log", ylabel="share of friction missing [1]")
    axes.plot(x, y[1] * (x / x[1]) ** 2, color=style.grey(0.45), linewidth=style.width(0.7), label="square")
    axes.legend()
    style.decades(axes)
