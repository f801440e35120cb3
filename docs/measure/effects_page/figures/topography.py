"""Force and friction of a rough sphere: by the map of its roughness, and by lines drawn from it in two ways."""

import numpy as np
from matplotlib.figure import Figure

from compare.report.plots import style
from compare.report.plots.lettering import clear

NAME = "effect-topography"
WAYS = ("smooth, 3D", "map, 3D", "line by π q C2D", "rows of the map")
# Factor by which points are drawn aside, so that bars do not cover one another.
ASIDE = {"map, 3D": 1.0, "line by π q C2D": 1.025, "rows of the map": 0.975}


def figure(data) -> Figure:
    """Left: force over that of the smooth sphere against depth. Right: friction against speed.

    data : rows of quantity ("force", "friction"), x, way, mean, low, high, and unit, what means are drawn over;
        those with an interval are drawn up to 2.5 % aside of their x
    """
    drawing = style.canvas("double", 2.7)
    left, right = drawing.subplots(1, 2)
    for axes, quantity, scale in ((left, "force", 1e6), (right, "friction", 1.0)):
        for way, look in zip(WAYS, _looks(), strict=True):
            rows = [row for row in data if row["quantity"] == quantity and row["way"] == way]
            x, mean, low, high, unit = (
                np.array([row[name] for row in rows], float) for name in ("x", "mean", "low", "high", "unit")
            )
            if np.isfinite(low).any():
                sides = np.array([mean - low, high - mean]) / unit
                axes.errorbar(ASIDE[way] * scale * x, mean / unit, yerr=sides, label=way, **look)
            else:
                axes.plot(scale * x, mean / unit, label=way, **look)
    left.set(xscale="log", xlabel="depth [µm]", ylabel="force over Hertz [1]", title="(a)")
    right.set(xscale="log", yscale="log", xlabel="speed [m/s]", ylabel=r"$\mu$ [1]", title="(b)")
    left.legend()
    for axes in (left, right):
        style.decades(axes)
    clear(drawing, (left,))
    return drawing


def _looks():
    """Of the ways, in their order."""
    return (
        {"color": style.grey(0.5), "linestyle": "-"},
        {"color": style.COLOUR["BEM"], "marker": style.MARKER["BEM"], "linestyle": "--"},
        {"color": style.COLOUR["MDR"], "marker": style.MARKER["MDR"], "linestyle": "-"},
        {"color": "#009E73", "marker": "^", "linestyle": ":"},
    )
