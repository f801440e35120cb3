"""Tangential force of a smooth and a rough sphere against its displacement, in both dimensionalities."""

import numpy as np
from matplotlib.figure import Figure

from compare.report.plots import style
from compare.report.plots.lettering import clear

NAME = "effect-shear"
WAYS = {"smooth, 1D": "MDR", "smooth, 3D": "BEM", "rough, 1D": "MDR", "rough, 3D": "BEM"}
EVERY, FIRST = 4, {"smooth, 1D": 1, "smooth, 3D": 3}  # of the points of smooth bodies those that are drawn


def figure(data) -> Figure:
    """Left: over the displacement at which the smooth sphere slips. Right: each over its own.

    data : rows of way, share (of that of the smooth sphere), force, low, high (of its mean), full_slip (a
        share), closed_form, and superposed, the force by two normal contacts of the body itself
    """
    drawing = style.canvas("double", 2.9)
    left, right = drawing.subplots(1, 2, sharey=True)
    for way in WAYS:
        look = _look(way)
        rows = [row for row in data if row["way"] == way]
        share, force, low, high, full = (
            np.array([row[name] for row in rows], float) for name in ("share", "force", "low", "high", "full_slip")
        )
        step = slice(FIRST.get(way, 0), None, EVERY if look["marker"] else 1)
        for axes, x in ((left, share), (right, share / full)):
            axes.plot(x[step], force[step], label=way, **look)
            if np.isfinite(low).any():
                axes.fill_between(x, low, high, color=look["color"], alpha=0.13, linewidth=0)
        if way.startswith("rough"):
            superposed = np.array([row["superposed"] for row in rows], float)
            label = "by two normal contacts" if way == "rough, 3D" else None
            left.plot(share, superposed, linestyle="none", marker="x", color=look["color"], label=label)
    closed = sorted({(row["share"], row["closed_form"]) for row in data})
    for axes, label in ((left, r"$u\,/\,(3/2)\,\mu d$ [1]"), (right, r"$u\,/\,u_{\max}$, each its own [1]")):
        axes.plot(
            *np.transpose([(0.0, 0.0), *closed]),
            color=style.ink(),
            linewidth=style.width(0.7),
            label="Cattaneo and Mindlin",
        )
        axes.set(xlabel=label, xlim=(0, None), ylim=(0, 1.03))
    left.set(ylabel=r"$F_x\,/\,\mu F_N$ [1]", title="(a)")
    right.set(title="(b)", xlim=(0, 1.25))
    left.legend(loc="lower right")
    clear(drawing, (left,))
    return drawing


def _look(way):
    """Hollow markers of smooth bodies, lines of rough ones."""
    solver = WAYS[way]
    smooth = {"marker": style.MARKER[solver], "linestyle": "none", "markerfacecolor": style.paper()}
    rough = {"marker": "", "linestyle": style.LINE[solver]}
    return {"color": style.COLOUR[solver]} | (smooth if way.startswith("smooth") else rough)
