"""Spectra of a measured map: averaged over directions with the power law in it, and of lines."""

from math import pi

import numpy as np
from matplotlib.figure import Figure
from pandas import DataFrame

from ...figures import style
from ...figures.plot import Plot, Tables
from .spectra import NOTHING, Description, mapped

NAME = "topography"


def plot(found: Description) -> Plot:
    """The plot of the spectra of a map."""
    rings, rows, law = found.rings, found.rows, found.law
    tables = {
        NAME: DataFrame(
            {"q": rings.q, "density_2d": rings.density, "waves": rings.waves, "density_1d_mapped": mapped(rings)}
        ),
        f"{NAME}-rows": DataFrame({"q": rows.q, "density_1d": rows.density}),
        f"{NAME}-law": DataFrame({"q": [], "density_2d": [], "in_band": []}),
    }
    fitted = ""
    if law is not None:
        start, end = 2 * pi / law.longest, 2 * pi / law.shortest
        q = np.union1d(np.geomspace(rings.q[0], end, 101), [start])
        tables[f"{NAME}-law"] = DataFrame({"q": q, "density_2d": law.density(q), "in_band": q >= start})
        fitted = (
            f" Line, power law with a Hurst exponent of {law.hurst:.3f} ({law.low:.3f} to {law.high:.3f}, 95 %), "
            "fitted in the shaded band."
        )
    lines, columns = found.topography.heights.shape
    return Plot(
        NAME,
        figure,
        tables,
        f"Two-sided spectra of a map of {columns} x {lines} pixels. (a) Averaged over directions.{fitted} (b) Of "
        "lines: the mean over all rows, and by the rule of the MDR.",
        "Spectra of the map that fall with the wave number, in two and in one dimension.",
        {"hurst": None if law is None else law.hurst},
    )


def figure(tables: Tables, hurst: float | None = None) -> Figure:
    """Left: C_2D of the rings with the law and its band. Right: C_1D of the rows, and by the rule of the MDR."""
    rings, rows, law = (tables[name] for name in (NAME, f"{NAME}-rows", f"{NAME}-law"))
    drawing = style.canvas("double", 3.0)
    left, right = panels = drawing.subplots(1, 2)
    left.plot(rings["q"], rings["density_2d"], "o", color=style.ink(), label="map, mean over directions")
    if len(law):
        band = law["q"][law["in_band"].astype(bool)]
        left.plot(law["q"], law["density_2d"], color=style.colour("BEM"), label=f"power law, H = {hurst:.2f}")
        left.axvspan(band.min(), band.max(), color=style.grey(0.93), zorder=0)
    # Nothing is hundreds of decades below the axes.
    drawn = rows["density_1d"].clip(lower=NOTHING * rows["density_1d"].max())
    right.plot(rows["q"], drawn, "--", label="rows of the map", **style.line(0.5, 0.8))
    right.plot(rings["q"], rings["density_1d_mapped"], "o", color=style.colour("MDR"), label=r"$\pi q\, C_{2D}$")
    for axes, shown, label in (
        (left, "density_2d", r"$C_{2D}$ [m$^4$]"),
        (right, "density_1d_mapped", r"$C_{1D}$ [m$^3$]"),
    ):
        axes.set(xscale="log", yscale="log", xlabel="wave number q [rad/m]", ylabel=label)
        axes.set_ylim(bottom=rings[shown].min() / 3)
    style.decades(*panels)
    style.lettered(panels)
    style.legend(drawing, panels, 4)
    return drawing
