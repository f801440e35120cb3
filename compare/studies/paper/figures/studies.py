"""Slow friction on a rough cone in six studies against Eq. 17, and what parts them from it (paper, Fig. 3)."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from pandas import DataFrame

from mdr1d.equations import interpolation
from scene.regime import MUCH_LESS_HEIGHT

from ....figures import shades, style
from ....figures.curves import scatter
from ....figures.lettering import clear
from ....report.page import Plot, Tables

NAME = "paper-studies"
LINES = f"{NAME}-lines"
BETWEEN = Normalize(0, 1)  # of the Hurst exponent
MARKERS = ("o", "s", "^", "D", "v", "P")
# What may break in the last panel, where the macroscopic slope is divided out: name, colour, marker, filled. What
# breaks both is drawn in ink.
BROKEN = (
    ("none of these", "#56B4E9", "o", True),
    ("h₀ > d/10 alone", "#56B4E9", "o", False),
    ("2a > L", "#CC79A7", "^", False),
    ("ξ > 0.05", "#009E73", "s", False),
    ("both", None, "D", False),
)


def plot(points: DataFrame, lines: DataFrame) -> Plot | None:
    """The plot of all studies; None where no point has an answer.

    lines : straight lines through the logarithms, a row for each choice of points
    """
    if not np.isfinite(points["normalised_friction"]).any():
        return None
    told = [
        f"{fit.points_fitted}: slope {fit.slope:.3f} ({fit.slope_low:.3f} to {fit.slope_high:.3f}), {fit.count} "
        "points"
        for fit in lines.itertuples()
    ]
    return Plot(
        NAME,
        figure,
        {NAME: points, LINES: lines},
        "Slow friction on a rough cone in six studies of one parameter each. (a) μ̃ against ξ with Eqs. 17 and "
        "19; hollow where a condition of Eq. 17 breaks. (b) μ̃/ξ against the rms slope of the macroscopic "
        "profile over that of the roughness, r; Eq. 10 gives 1 + r². (c) What is left, by what else breaks.",
        f"Friction collapses on a line of slope one. {'; '.join(told)}.",
    )


def figure(tables: Tables) -> Figure:
    """Left: mu-tilde. Right: over xi, against the macroscopic slope; and without its part."""
    points, lines = tables[NAME], tables[LINES]
    points = points[np.isfinite(points["normalised_friction"])]
    drawing = style.canvas("double", 4.3)
    axes = drawing.subplot_mosaic([["law", "slope"], ["law", "rest"]], width_ratios=(1.1, 1))
    _law(axes["law"], points, lines)
    _slope(axes["slope"], points)
    _rest(axes["rest"], points)
    style.decades(*axes.values())
    inside = axes["law"].inset_axes((0.53, 0.14, 0.43, 0.022))
    bar = shades.colours(drawing, ScalarMappable(BETWEEN, shades.PRESS), "", cax=inside, orientation="horizontal")
    bar.set_label("Hurst exponent [1], also of (b)", labelpad=1, fontsize=style.small())
    bar.ax.tick_params(labelsize=style.tiny(), length=2, pad=1)
    _legend(drawing, points["study"].unique())
    clear(drawing, list(axes.values()))
    return drawing


def _scatter(axes: Axes, points: DataFrame, x, y):
    """One set of markers a study, coloured by the Hurst exponent, filled where all conditions hold."""
    for study, marker in zip(points["study"].unique(), MARKERS, strict=False):
        for holds, above in ((True, 3), (False, 2)):
            at = ((points["study"] == study) & (points["holds"] == holds)).to_numpy()
            colours = shades.PRESS(BETWEEN(points["hurst"][at]))
            look = {"marker": marker, "empty": "none", "rasterized": True, "zorder": above}
            scatter(axes, x[at], y[at], np.full(at.sum(), holds), colours, 0.75, 0.3, **look)


def _law(axes, points, lines):
    _scatter(axes, points, points["xi"], points["normalised_friction"])
    xi = np.geomspace(points["xi"].min(), points["xi"].max(), 101)
    for law, name, line, shade in (
        (xi, r"Eq. 17, $\tilde{\mu} = \xi$", "-", 0.0),
        (interpolation(xi), "Eq. 19, α = 1.5", "--", 0.35),
    ):
        axes.plot(xi, law, line, zorder=1, label=name, **style.line(shade, 0.55))
    axes.set(xscale="log", yscale="log", xlabel=r"$\xi$ [1]", ylabel=r"$\tilde{\mu}$ [1]", title="(a)")
    style.span(axes, points["xi"])
    axes.legend(loc="upper left", bbox_to_anchor=(0, 0.99))
    for fit in lines[lines["points_fitted"] == "conditions hold"].itertuples():
        text = f"filled: slope {fit.slope:.3f} ({fit.slope_low:.3f} to {fit.slope_high:.3f})"
        axes.text(0.98, 0.23, text, transform=axes.transAxes, ha="right", fontsize=style.small())


def _slope(axes, points):
    ratio = points["macro_over_rough"]
    _scatter(axes, points, ratio, points["normalised_friction"] / points["xi"])
    r = np.geomspace(ratio.min(), ratio.max(), 201)
    axes.plot(r, 1 + r**2, **style.line(0, 0.7, zorder=4, label="1 + r²"))
    axes.set(xscale="log", yscale="log", ylabel=r"$\tilde{\mu}/\xi$ [1]", title="(b)")
    axes.set_xlabel("rms slope, smooth over rough, r [1]")
    style.span(axes, ratio)
    axes.legend(loc="upper left")


def _rest(axes, points):
    rest = points["normalised_friction"] / (points["xi"] * (1 + points["macro_over_rough"] ** 2))
    ratio = points["height_over_depth"]
    low, narrow, slow = (points[f"holds: {name}"].astype(bool) for name in ("h0 << d", "2a < L", "xi << 1"))
    kind = np.select([~narrow & ~slow, ~slow, ~narrow, ~low], [4, 3, 2, 1], 0)
    for number, (name, colour, marker, filled) in enumerate(BROKEN):
        at = kind == number
        look = {"marker": marker, "label": name, "empty": "none", "rasterized": True}
        scatter(axes, ratio[at], rest[at], np.full(at.sum(), filled), colour or style.ink(), 0.75, 0.45, **look)
    axes.axhline(1, **style.line(0, 0.7, zorder=0))
    axes.axvline(MUCH_LESS_HEIGHT, **style.line(0.4, 0.7, linestyle=":", zorder=0))
    axes.set(xscale="log", xlabel="rms height / depth [1]", title="(c)")
    axes.set_ylabel(r"$\tilde{\mu}/(\xi\,(1 + r^2))$ [1]")
    style.span(axes, ratio)
    axes.legend(
        loc="lower left", handletextpad=0.2, title="broken", title_fontsize=style.small(), alignment="left"
    )


def _legend(drawing, studies):
    look = {"linestyle": "none", "color": style.grey(0.3)}
    handles = [
        Line2D([], [], marker=marker, markersize=style.mark(), label=study, **look)
        for marker, study in zip(MARKERS, studies, strict=False)
    ]
    handles.append(Line2D([], [], marker="o", markerfacecolor="none", label="a condition breaks", **look))
    style.legend(drawing, handles, "outside lower center", 7, handletextpad=0.1, columnspacing=1.0)
