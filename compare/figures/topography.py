"""Spectra of a measured map: averaged over directions with the power law in it, and of lines."""

from math import pi

import numpy as np
from matplotlib.figure import Figure

from ..statistics.spectra import Description, mapped
from ..plots import style
from ..plots.lettering import clear

NAME = "topography"


def figure(found: Description) -> Figure:
    """Left: C_2D of the rings with the law and its band. Right: C_1D of the rows, and by the rule of the MDR."""
    drawing = style.canvas("double", 2.8)
    left, right = drawing.subplots(1, 2)
    rings, law = found.rings, found.law
    left.plot(
        rings.q,
        rings.density,
        "o",
        color=style.ink(),
        markersize=style.mark(0.9),
        label="map, mean over directions",
    )
    if law is not None:
        ends = 2 * pi / law.longest, 2 * pi / law.shortest
        q = np.geomspace(rings.q[0], ends[1], 101)
        left.plot(q, law.density(q), color=style.COLOUR["BEM"], label=f"H = {law.hurst:.2f}")
        left.axvspan(*ends, color=style.grey(0.93), zorder=0)
    left.set(ylabel=r"$C_{2D}$ [m$^4$]", title="(a)")
    right.plot(
        found.rows.q,
        found.rows.density,
        color=style.grey(0.5),
        linewidth=style.width(0.8),
        label="rows of the map",
    )
    right.plot(rings.q, mapped(rings), "o", color=style.COLOUR["MDR"], label=r"$\pi q\, C_{2D}$")
    right.set(ylabel=r"$C_{1D}$ [m$^3$]", title="(b)")
    for axes in (left, right):
        axes.set(xscale="log", yscale="log", xlabel="wave number q [rad/m]")
        axes.legend(loc="lower left")
        style.decades(axes)
    least = rings.density.min()
    left.set_ylim(bottom=least / 3)
    right.set_ylim(bottom=pi * (rings.q * rings.density).min() / 3)
    clear(drawing, (left, right))
    return drawing


def sheets(found: Description) -> dict[str, dict[str, np.ndarray]]:
    """The rings, and the rows."""
    rings, rows, law = found.rings, found.rows, found.law
    fitted = np.full(rings.q.shape, np.nan) if law is None else law.density(rings.q)
    return {
        NAME: {
            "q": rings.q,
            "density_2d": rings.density,
            "waves": rings.waves,
            "density_2d_law": fitted,
            "density_1d_mapped": mapped(rings),
        },
        f"{NAME}-rows": {"q": rows.q, "density_1d": rows.density},
    }


def caption(found: Description) -> str:
    """What the figure shows."""
    rows, columns = found.topography.heights.shape
    law = found.law
    fitted = (
        ""
        if law is None
        else f" Line, power law with a Hurst exponent of {law.hurst:.3f} ({law.low:.3f} to {law.high:.3f}, 95 %), "
        "fitted in the shaded band."
    )
    return (
        f"Two-sided spectra of a map of {columns} x {rows} pixels. (a) Averaged over directions.{fitted} "
        "(b) Of lines: the mean over all rows, and by the rule of the MDR."
    )
