"""Force and friction of a rough sphere: by the map of its roughness, and by lines drawn from it in two ways."""

import numpy as np
from matplotlib.figure import Figure

from . import style

NAME = "effect-topography"
LOOKS = {
    "smooth, 3D": {"color": "0.5", "marker": "", "linestyle": "-"},
    "map, 3D": {"color": style.COLOUR["BEM"], "marker": style.MARKER["BEM"], "linestyle": "--"},
    "line by π q C2D": {"color": style.COLOUR["MDR"], "marker": style.MARKER["MDR"], "linestyle": "-"},
    "rows of the map": {"color": "#009E73", "marker": "^", "linestyle": ":"},
}


def figure(data) -> Figure:
    """Left: force over that of the smooth sphere against depth. Right: friction against speed.

    data : rows of quantity ("force", "friction"), x, way, mean, half_interval, and unit, what means are drawn over
    """
    drawing = style.canvas(style.DOUBLE, 2.7)
    left, right = drawing.subplots(1, 2)
    for axes, quantity, scale in ((left, "force", 1e6), (right, "friction", 1.0)):
        for way, look in LOOKS.items():
            rows = [row for row in data if row["quantity"] == quantity and row["way"] == way]
            x, mean, half, unit = (
                np.array([row[name] for row in rows], float) for name in ("x", "mean", "half_interval", "unit")
            )
            axes.errorbar(scale * x, mean / unit, yerr=np.nan_to_num(half / unit), label=way, **look)
    left.set(xscale="log", xlabel="depth [µm]", ylabel="force over Hertz [1]", title="(a)")
    right.set(xscale="log", yscale="log", xlabel="speed [m/s]", ylabel=r"$\mu$ [1]", title="(b)")
    left.legend()
    for axes in (left, right):
        style.decades(axes)
    return drawing
