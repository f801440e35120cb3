"""Slow friction on a rough cone in six studies against Eq. 17, and what parts them from it (paper, Fig. 3)."""

from math import isfinite

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from mdr1d.equations import interpolation
from scene.regime import MUCH_LESS_HEIGHT

from ..paper.campaign import SLOW, Collapse, Line, line
from ..paper.parameters import STUDIES
from ..plots import style
from ..plots.lettering import clear

NAME = "paper-studies"
# Of the Hurst exponent; without the yellow end, which is lost on white.
SHADES = LinearSegmentedColormap.from_list("hurst", colormaps["viridis"](np.linspace(0, 0.88, 256)))
BETWEEN = Normalize(0, 1)
MARKERS = ("o", "s", "^", "D", "v", "P")
# What may break in the last panel, where the macroscopic slope is divided out: name, colour, marker, filled. What
# breaks both is drawn in ink.
BROKEN = (
    ("none of these", "#56B4E9", "o", True),
    ("h₀ > d/10 alone", "#56B4E9", "o", False),
    ("2a > L", "#CC79A7", "^", False),
    (f"ξ > {SLOW:g}", "#009E73", "s", False),
    ("both", None, "D", False),
)


def figure(collapse: Collapse) -> Figure | None:
    """Left: mu-tilde. Right: over xi, against the macroscopic slope; and without its part. None without points."""
    if not np.isfinite(collapse.friction).any():
        return None
    drawing = style.canvas("double", 4.3)
    axes = drawing.subplot_mosaic([["law", "slope"], ["law", "rest"]], width_ratios=(1.1, 1))
    _law(axes["law"], collapse)
    _slope(axes["slope"], collapse)
    _rest(axes["rest"], collapse)
    for panel in axes.values():
        style.decades(panel)
    inside = axes["law"].inset_axes((0.53, 0.14, 0.43, 0.022))
    bar = drawing.colorbar(ScalarMappable(BETWEEN, SHADES), cax=inside, orientation="horizontal")
    bar.set_label("Hurst exponent [1], also of (b)", labelpad=1, fontsize=style.small())
    bar.ax.tick_params(labelsize=style.tiny(), length=2, pad=1)
    bar.outline.set_linewidth(style.width(0.45))
    _legend(drawing)
    clear(drawing, list(axes.values()))
    return drawing


def sheets(collapse: Collapse) -> dict:
    """Every point with its regime and what holds there, and the fitted lines."""
    points = {
        "study": [STUDIES[study].name for study in collapse.study],
        "value": collapse.value,
        "hurst": collapse.hurst,
        "xi": collapse.xi,
        "normalised_friction": collapse.friction,
        "normalised_friction_error": collapse.error,
        **collapse.conditions.columns,
    }
    lines = [
        {
            "points": name,
            "count": fit.points,
            "slope": fit.slope,
            "slope_low": fit.slope_interval[0],
            "slope_high": fit.slope_interval[1],
            "factor": fit.factor,
            "factor_low": fit.factor_interval[0],
            "factor_high": fit.factor_interval[1],
            "worst": fit.worst,
        }
        for name, fit in _lines(collapse).items()
    ]
    return {NAME: points, f"{NAME}-lines": lines}


def caption(collapse: Collapse) -> str:
    """What the figure shows."""
    known = np.isfinite(collapse.friction)
    scatter = np.nanmedian(collapse.error[known] / collapse.friction[known])
    fits = " ".join(f"{name[0].upper()}{name[1:]}: {_said(fit)}." for name, fit in _lines(collapse).items())
    failed = (
        f" {collapse.failed} solves failed; means are over the others, and {int(np.sum(~known))} points without "
        "any are left out."
        if collapse.failed
        else ""
    )
    flags = collapse.conditions.flags
    both = "both do, " if np.any(known & ~(flags["2a < L"] | flags["xi << 1"])) else ""
    return (
        f"Slow friction on a rough cone in six studies, one parameter varied in each, {known.sum()} points of "
        f"{collapse.samples.shape[1]} profiles each (median standard error {scatter:.1%}, not drawn). (a) "
        "Friction over that of the plateau, μ̃ = μ/(√2 s) with the rms slope s of the roughness, against ξ of "
        "Eq. 18; lines: Eq. 17, μ̃ = ξ, and Eq. 19 with α = 1.5. Filled where the conditions of Eq. 17 hold, "
        "hollow where one breaks. (b) μ̃/ξ against the rms slope of the macroscopic profile over that of the "
        "roughness, r. Eq. 17 leaves the macroscopic slope out; with it, Eq. 10 gives 1 + r² (line). (c) What "
        "is left once divided by it, against the rms height over the depth of the smooth contact; by which of the "
        f"other conditions break: the width 2a of that contact exceeds the longest wave L, ξ exceeds {SLOW:g}, "
        f"{both}or neither does and the rms height alone is not much less than the depth (right of the dotted "
        f"line). {collapse.conditions.words} Large slopes leave a point filled: with heights, the slope of the "
        "cone and the load times any number, friction is times that number exactly, so that the same points "
        f"collapse at any slope. {fits}{failed}"
    )


def _lines(collapse) -> dict[str, Line]:
    """Straight lines through the logarithms, by points; without those that have fewer than two."""
    everywhere, over = np.ones_like(collapse.holds), collapse.with_macro_slope
    asked = {
        "where the conditions hold": (collapse.holds, 1.0),
        "where the conditions hold, over 1 + r²": (collapse.holds, over),
        "all points": (everywhere, 1.0),
        "all points, over 1 + r²": (everywhere, over),
    }
    found = {name: line(collapse, where, by) for name, (where, by) in asked.items()}
    return {name: fit for name, fit in found.items() if isfinite(fit.slope)}


def _said(fit):
    (low, high), (least, most) = fit.slope_interval, fit.factor_interval
    return (
        f"slope {fit.slope:.3f}, 95 % between {low:.3f} and {high:.3f}, factor {fit.factor:.3f} ({least:.3f} to "
        f"{most:.3f}), μ̃ off ξ by {fit.worst:.2g} of it at most, {fit.points} points"
    )


def _points(axes: Axes, collapse, x, y):
    """One set of markers a study, coloured by the Hurst exponent, filled where all conditions hold."""
    for number, marker in enumerate(MARKERS):
        for filled in (False, True):
            at = (collapse.study == number) & (collapse.holds == filled) & np.isfinite(y)
            colours = SHADES(BETWEEN(collapse.hurst[at]))
            inside = colours if filled else "none"
            axes.scatter(
                x[at],
                y[at],
                s=style.mark(0.75) ** 2,
                marker=marker,
                facecolors=inside,
                edgecolors=colours,
                linewidths=style.width(0.3),
                rasterized=True,
                zorder=3 if filled else 2,
            )


def _law(axes, collapse):
    _points(axes, collapse, collapse.xi, collapse.friction)
    xi = np.geomspace(collapse.xi.min(), collapse.xi.max(), 101)
    axes.plot(
        xi, xi, color=style.ink(), linewidth=style.width(0.55), zorder=1, label=r"Eq. 17, $\tilde{\mu} = \xi$"
    )
    axes.plot(
        xi,
        interpolation(xi),
        "--",
        color=style.grey(0.35),
        linewidth=style.width(0.55),
        zorder=1,
        label="Eq. 19, α = 1.5",
    )
    axes.set(xscale="log", yscale="log", xlabel=r"$\xi$ [1]", ylabel=r"$\tilde{\mu}$ [1]", title="(a)")
    style.span(axes, collapse.xi)
    axes.legend(loc="upper left", bbox_to_anchor=(0, 0.99))
    fit = line(collapse, collapse.holds)
    if isfinite(fit.slope):
        low, high = fit.slope_interval
        text = f"filled: slope {fit.slope:.3f} ({low:.3f} to {high:.3f})"
        axes.text(0.98, 0.23, text, transform=axes.transAxes, ha="right", fontsize=style.small())


def _slope(axes, collapse):
    ratio, measured = collapse.regime.macro_over_rough, collapse.friction / collapse.xi
    _points(axes, collapse, ratio, measured)
    r = np.geomspace(ratio.min(), ratio.max(), 201)
    axes.plot(r, 1 + r**2, color=style.ink(), linewidth=style.width(0.7), zorder=4, label="1 + r²")
    axes.set(xscale="log", yscale="log", ylabel=r"$\tilde{\mu}/\xi$ [1]", title="(b)")
    axes.set_xlabel("rms slope, smooth over rough, r [1]")
    style.span(axes, ratio)
    axes.legend(loc="upper left")


def _rest(axes, collapse):
    rest = collapse.friction / (collapse.xi * collapse.with_macro_slope)
    ratio, flags = collapse.regime.height_over_depth, collapse.conditions.flags
    kind = np.where(flags["h0 << d"], 0, 1)
    for broken, number in (
        (~flags["2a < L"], 2),
        (~flags["xi << 1"], 3),
        (~(flags["2a < L"] | flags["xi << 1"]), 4),
    ):
        kind[broken] = number
    for number, (name, colour, marker, filled) in enumerate(BROKEN):
        at = (kind == number) & np.isfinite(rest)
        if at.any():
            colour = colour or style.ink()
            look = {
                "facecolors": colour if filled else "none",
                "edgecolors": colour,
                "linewidths": style.width(0.45),
            }
            axes.scatter(
                ratio[at], rest[at], s=style.mark(0.75) ** 2, marker=marker, label=name, rasterized=True, **look
            )
    axes.axhline(1, color=style.ink(), linewidth=style.width(0.7), zorder=0)
    axes.axvline(MUCH_LESS_HEIGHT, color=style.grey(0.4), linewidth=style.width(0.7), linestyle=":", zorder=0)
    axes.set(
        xscale="log", xlabel="rms height / depth [1]", ylabel=r"$\tilde{\mu}/(\xi\,(1 + r^2))$ [1]", title="(c)"
    )
    style.span(axes, ratio)
    axes.legend(
        loc="lower left", handletextpad=0.2, title="broken", title_fontsize=style.small(), alignment="left"
    )


def _legend(drawing):
    handles = [
        Line2D(
            [],
            [],
            linestyle="none",
            marker=marker,
            color=style.grey(0.3),
            markersize=style.mark(),
            label=study.name,
        )
        for marker, study in zip(MARKERS, STUDIES, strict=True)
    ]
    handles.append(
        Line2D(
            [],
            [],
            linestyle="none",
            marker="o",
            color=style.grey(0.3),
            markerfacecolor="none",
            label="a condition breaks",
        )
    )
    style.legend(drawing, handles, "outside lower center", 7, handletextpad=0.1, columnspacing=1.0)
