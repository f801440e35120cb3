"""Friction from slow to the plateau for a rough cone and a rough sphere against Eq. 19 (paper, Fig. 4)."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from mdr1d.equations import interpolation
from scene.regime import SMALL_SLOPE

from ..paper.law import Law
from . import style

NAME = "paper-law"
# Colour, marker and line of the shapes, in the order in which they come.
LOOKS = (("#0072B2", "o", "--"), ("#D55E00", "s", "-."))


def figure(laws: Sequence[Law]) -> Figure | None:
    """Above: mu-tilde with Eq. 19. Below: its deviation from Eq. 19 with alpha = 1.5. None without any."""
    if not laws:
        return None
    drawing = style.canvas(style.SINGLE, 4.4)
    above, below = drawing.subplots(2, 1, sharex=True, height_ratios=(2, 1.3))
    xi = np.geomspace(min(law.xi.min() for law in laws), max(law.xi.max() for law in laws), 201)
    above.plot(xi, interpolation(xi), color="0.3", linewidth=0.9, label="Eq. 19, α = 1.5", zorder=1)
    below.axhline(0, color="0.3", linewidth=0.9, zorder=1)
    for law, (colour, marker, line) in zip(laws, LOOKS, strict=False):
        known, unit = np.isfinite(law.friction), interpolation(law.xi)
        points = {"color": colour, "marker": marker, "linestyle": "none", "markersize": 3.5, "elinewidth": 0.8}
        points |= {"markerfacecolor": "white", "markeredgewidth": 0.8}
        above.errorbar(law.xi[known], law.friction[known], yerr=law.error[known], label=_best(law), **points)
        below.errorbar(law.xi[known], 100 * law.deviation[known], yerr=100 * (law.error / unit)[known], **points)
        best = 100 * (interpolation(xi, law.alpha) / interpolation(xi) - 1)
        below.plot(xi, best, line, color=colour, linewidth=0.9, zorder=1, label=f"{law.shape}, best α")
    style.span(above, xi)
    above.set(xscale="log", yscale="log", ylabel=r"$\tilde{\mu}$ [1]")
    above.legend(loc="lower right")
    slopes = ", ".join(f"{slope:.2g}" for slope in _slopes(laws))
    above.text(0.03, 0.95, f"rms slope {slopes}", transform=above.transAxes, va="top", fontsize=7)
    below.set(xlabel=r"$\xi$ [1]", ylabel="deviation from Eq. 19,\nα = 1.5 [%]")
    below.legend(ncols=2, loc="lower right", bbox_to_anchor=(1, 1), borderaxespad=0.1)
    for axes in (above, below):
        style.decades(axes)
    return drawing


def sheets(laws: Sequence[Law]) -> dict[str, list[dict]]:
    """Every point of the figure, and the fitted exponents."""
    points = [
        {
            "shape": law.shape,
            "xi": xi,
            "normalised_friction": friction,
            "normalised_friction_error": error,
            "deviation_from_eq_19": deviation,
        }
        for law in laws
        for xi, friction, error, deviation in zip(law.xi, law.friction, law.error, law.deviation, strict=True)
    ]
    fits = [
        {
            "shape": law.shape,
            "alpha": law.alpha,
            "alpha_low": law.alpha_interval[0],
            "alpha_high": law.alpha_interval[1],
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
        f"α of each shape (broken lines), differ from it. {' '.join(map(_said, laws))}{outside}"
    )


def _slopes(laws):
    return sorted({float(law.regime.rms_slope) for law in laws})


def _best(law):
    low, high = law.alpha_interval
    return f"{law.shape}: best α = {law.alpha:.3g} ({low:.3g} to {high:.3g})"


def _said(law):
    low, high = law.alpha_interval
    worst = np.nanargmax(np.abs(law.deviation))
    regime = law.regime
    failed = f" {law.failed} solves failed; the profiles with a failed solve are left out." if law.failed else ""
    return (
        f"Rough {law.shape}, {law.samples.shape[1]} profiles: best α {law.alpha:.3g}, 95 % between {low:.3g} and "
        f"{high:.3g}; off Eq. 19 by {law.deviation[worst]:+.1%} at most (ξ = {law.xi[worst]:.3g}); plateau "
        f"{law.plateau:.3g} ± {law.plateau_error:.2g} of that of Eq. 19 at the greatest ξ; rms height over depth "
        f"{regime.height_over_depth:.2g}, width of the contact over the longest wave "
        f"{regime.contact_over_period:.2g}, macroscopic slope over that of the roughness "
        f"{regime.macro_over_rough:.2g}, rms slope {regime.rms_slope:.3g}.{failed}"
    )
