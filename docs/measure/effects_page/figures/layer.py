"""A sphere on layers: stiffness against load, its local exponent, and friction of the smooth sphere in sliding."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from compare.report.plots import style
from compare.report.plots.lettering import clear

NAME = "effect-layer"
# Marker and line of each rubber.
LOOKS = {
    "half-space": ("o", (0, (8, 2))),
    "bonded, ν = 0.5": ("s", "-"),
    "bonded, ν = 0.45": ("D", "--"),
    "bonded, ν = 0.3": ("^", "-."),
    "frictionless, ν = 0.5": ("v", ":"),
}
LIMITS = {"1/3": 1 / 3, "1/2": 1 / 2, "2/3": 2 / 3}


def figure(data) -> Figure:
    """Above, lines: integral equation; points: three dimensions. Below: friction, and over that of the half-space.

    data : rows of quantity ("stiffness", "exponent", "friction M" with memories M), rubber, x, found, known
    """
    drawing = style.canvas("double", 5.0)
    (a, b), (c, d) = drawing.subplots(2, 2)
    for axes, quantity in ((a, "stiffness"), (b, "exponent")):
        for rubber, rows in _curves(data, quantity):
            look = _look(rubber)
            x, found, known = (np.array([row[name] for row in rows]) for name in ("x", "found", "known"))
            axes.plot(x, known, color=look["color"], linestyle=look["linestyle"])
            axes.plot(x, found, color=look["color"], marker=look["marker"], linestyle="none")
    a.set(xscale="log", yscale="log", ylabel="$k$ / $E^*D$ [1]", title="(a)")
    b.set(xscale="log", ylabel="d ln $k$ / d ln $F$ [1]", title="(b)", ylim=(0.25, 0.75))
    for name, value in LIMITS.items():
        b.axhline(value, color=style.grey(0.6), linewidth=style.width(0.45), zorder=0)
        place = {"xycoords": b.get_yaxis_transform(), "textcoords": "offset points", "fontsize": style.small()}
        b.annotate(name, (1, value), xytext=(3, -2), **place)
    for quantity in sorted({row["quantity"] for row in data if row["quantity"].startswith("friction")}):
        memory, curves = quantity.split()[1], dict(_curves(data, quantity))
        for rubber, rows in curves.items():
            x, friction = (np.array([row[name] for row in rows]) for name in ("x", "found"))
            plain = np.array([row["found"] for row in curves["half-space"]])
            c.plot(x, friction, **_look(rubber))
            if rubber != "half-space":
                d.plot(x, friction / plain, **_look(rubber))
        beside = (-2, 6) if friction[0] > 0.5 else (8, -10)  # below a curve that rises, above a level one
        c.annotate(rf"$v\tau_c$ = {memory} $D$", (x[1], friction[1]), xytext=beside, textcoords="offset points",
                   fontsize=style.small())  # fmt: skip
        d.annotate(f"{memory} $D$", (x[-1], friction[-1] / plain[-1]), xytext=(4, -2), textcoords="offset points",
                   fontsize=style.small())  # fmt: skip
    c.set(xscale="log", yscale="log", ylim=(None, 2), ylabel=r"$\mu R/v\bar\tau$ [1]", title="(c)")
    d.set(xscale="log", ylabel=r"$\mu$ / $\mu$ of the half-space [1]", title="(d)")
    a.legend(handles=[Line2D([], [], label=name, **_look(name)) for name, _ in _curves(data, "stiffness")])
    for axes in (a, b, c, d):
        axes.axvline(1, color=style.grey(0.8), linewidth=style.width(0.55), zorder=0)
        axes.set_xlabel("$F/F^*$ [1]")
        style.decades(axes)
    clear(drawing, (a,))
    return drawing


def _look(rubber):
    """Neither the colour of one dimension nor that of three: all is three-dimensional here."""
    colours = (style.grey(0.35), style.ink(), "#CC79A7", "#009E73", "#E69F00")
    marker, line = LOOKS[rubber]
    return {"color": colours[list(LOOKS).index(rubber)], "marker": marker, "linestyle": line}


def _curves(data, quantity):
    """Rows of each rubber that there is, in the order of LOOKS."""
    for rubber in LOOKS:
        rows = [row for row in data if row["quantity"] == quantity and row["rubber"] == rubber]
        if rows:
            yield rubber, rows
