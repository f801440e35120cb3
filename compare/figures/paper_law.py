"""Friction from slow to the plateau for a rough cone and a rough sphere against Eq. 19 (paper, Fig. 4)."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from mdr1d.equations import interpolation
from scene.regime import SMALL_SLOPE

from ..paper.law import Law
from ..wording import plus_minus
from ..plots import style
from ..plots.lettering import clear

NAME = "paper-law"
# Marker, its size and line of the shapes, in the order in which they come: the first, small and dark, is drawn
# over the second.
LOOKS = (("o", 0.65, "--"), ("s", 1.15, "-."))


def figure(laws: Sequence[Law]) -> Figure | None:
    """Above: mu-tilde with Eq. 19. Below: its deviation from Eq. 19 with alpha = 1.5. None without any."""
    if not laws:
        return None
    drawing = style.canvas("single", 5.0)
    above, below = drawing.subplots(2, 1, sharex=True, height_ratios=(2, 1.7))
    xi = np.geomspace(min(law.xi.min() for law in laws), max(law.xi.max() for law in laws), 201)
    above.plot(
        xi, interpolation(xi), color=style.grey(0.5), linewidth=style.width(0.8), label="Eq. 19, α = 1.5", zorder=1
    )
    below.axhline(0, color=style.grey(0.6), linewidth=style.width(0.45), zorder=0)
    for law, (colour, tint), (marker, size, line) in zip(laws, _colours(), LOOKS, strict=False):
        known, unit = np.isfinite(law.friction), interpolation(law.xi)
        inside = tint if law.conditions.holds.all() else style.paper()
        look = {
            "color": colour,
            "marker": marker,
            "linestyle": "none",
            "markersize": style.mark(size),
            "elinewidth": style.width(0.7),
        }
        look |= {"markerfacecolor": inside, "markeredgewidth": style.width(0.7), "zorder": 3 - size / 2}
        above.errorbar(law.xi[known], law.friction[known], yerr=law.error[known], label=_best(law), **look)
        below.errorbar(law.xi[known], 100 * law.deviation[known], yerr=100 * (law.error / unit)[known], **look)
        best, planes = interpolation(xi, law.alpha) / interpolation(xi) - 1, law.planes / unit - 1
        below.plot(
            xi, 100 * best, line, color=colour, linewidth=style.width(0.8), zorder=1, label=f"{law.shape}, best α"
        )
        below.plot(
            law.xi,
            100 * planes,
            ":",
            color=colour,
            linewidth=style.width(),
            zorder=1,
            label=f"{law.shape}, planes",
        )
    style.span(above, xi)
    above.set(xscale="log", yscale="log", ylabel=r"$\tilde{\mu}$ [1]")
    above.legend(loc="lower right")
    slopes = ", ".join(f"{slope:.2g}" for slope in _slopes(laws))
    above.text(0.03, 0.95, f"rms slope {slopes}", transform=above.transAxes, va="top", fontsize=style.small())
    below.set(xlabel=r"$\xi$ [1]", ylabel="deviation from Eq. 19,\nα = 1.5 [%]")
    labels = below.get_legend_handles_labels()[1]
    columns = style.columns(labels, 0.8 * drawing.get_figwidth(), 2)
    below.legend(ncols=columns, loc="lower right", bbox_to_anchor=(1, 1), borderaxespad=0.1)
    for axes in (above, below):
        style.decades(axes)
    clear(drawing, (above,))
    return drawing


def sheets(laws: Sequence[Law]) -> dict[str, list[dict]]:
    """Every point of the figure, and the fitted exponents."""
    points: list[dict] = []
    for law in laws:
        columns = {
            "xi": law.xi,
            "normalised_friction": law.friction,
            "normalised_friction_error": law.error,
            "deviation_from_eq_19": law.deviation,
            "normalised_friction_of_planes": law.planes,
            **law.conditions.columns,
        }
        rows = zip(*columns.values(), strict=True)
        points.extend({"shape": law.shape, **dict(zip(columns, row, strict=True))} for row in rows)
    fits = [
        {
            "shape": law.shape,
            "alpha": law.alpha,
            "alpha_low": law.alpha_interval[0],
            "alpha_high": law.alpha_interval[1],
            **{f"alpha by {name}": alpha for name, alpha in law.by_criterion.items()},
            "chi_square": law.chi_square,
            "alpha_of_planes": law.planes_alpha,
            "plateau": law.plateau,
            "plateau_error": law.plateau_error,
        }
        for law in laws
    ]
    return {NAME: points, f"{NAME}-alpha": fits} if points else {}


def caption(laws: Sequence[Law]) -> str:
    """What the figure shows."""
    slopes = _slopes(laws)
    outside = (
        f" These slopes are far above {SMALL_SLOPE:g}: the contacts lie outside the small slopes that a linear "
        "theory of contact presupposes."
        if min(slopes, default=0) > SMALL_SLOPE
        else ""
    )
    return (
        "Friction over that of the plateau, μ̃ = μ/(√2 s) with the rms slope s of the roughness by finite "
        "differences, against ξ, which is μ̃ in the limit of low speed (Eqs. 17 and 18): means over profiles with "
        "their standard errors, and Eq. 19 with α = 1.5. Below: by how much the points, and Eq. 19 with the best "
        "α of each shape (broken lines), differ from it. Dotted: every "
        "place of the contact taken for a rough plane pressed as deep as it is there, without the slope of the "
        f"shape; the places of a cone differ more in depth. {' '.join(map(_said, laws))}{outside}"
    )


def _colours():
    """Of the shapes: of lines and edges, and of the inside of markers."""
    return (style.ink(), style.ink()), ("#009E73", "#A6DCCB")


def _slopes(laws):
    return sorted({float(law.conditions.ratios["rms_slope"][0]) for law in laws})


def _best(law):
    low, high = law.alpha_interval
    return f"{law.shape}: best α = {law.alpha:.2f} ({low:.2f} to {high:.2f})"


def _said(law):
    low, high = law.alpha_interval
    worst = np.nanargmax(np.abs(law.deviation))
    ratios = {name: ratio[0] for name, ratio in law.conditions.ratios.items()}
    criteria = law.by_criterion.values()
    failed = f" {law.failed} solves failed; the profiles with a failed solve are left out." if law.failed else ""
    return (
        f"Rough {law.shape}, {law.samples.shape[1]} profiles: best α {law.alpha:.2f}, 95 % of the sampling "
        f"between {low:.2f} and {high:.2f}; {min(criteria):.2f} to {max(criteria):.2f} by what is made least "
        f"(logarithms, differences, chi square, the worst point), {law.left}; of planes {law.planes_alpha:.2f}; "
        f"off Eq. 19 by {law.deviation[worst]:+.1%} at most (ξ = {law.xi[worst]:.3g}); plateau "
        f"{plus_minus(law.plateau, law.plateau_error)} of that of Eq. 19 at the greatest ξ; rms height over depth "
        f"{ratios['height_over_depth']:.2g}, width of the contact over the longest wave "
        f"{ratios['contact_over_period']:.2g}, macroscopic slope over that of the roughness "
        f"{ratios['macro_over_rough']:.2g}, rms slope {ratios['rms_slope']:.3g}. {law.conditions.words}{failed}"
    )
