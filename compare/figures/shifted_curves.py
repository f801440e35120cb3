"""Friction against load at many speeds, its master curve, and the shifts that make it (paper, Figs. 5 to 7)."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..mastercurve import shifted
from ..paper.shifts import Shifted
from ..wording import explain, explain_vertical, plus_minus
from . import shades, style

NAME = "shifted-curves"
LOG10 = np.log(10)


def figure(found: Sequence[Shifted]) -> Figure | None:
    """A row for each set of curves: as they are, shifted, and the shifts. None without any."""
    if not found:
        return None
    drawing = style.canvas(style.DOUBLE, 0.55 + 2.0 * len(found))
    panels = drawing.subplots(len(found), 3, squeeze=False)
    every = np.concatenate([each.collapse.speeds for each in found])
    between = shades.between(every)
    for row, each in zip(panels, found, strict=True):
        result = each.collapse
        colours = shades.SPEED(between(result.speeds))
        _curves(row[0], result, [curve.log_load for curve in result.curves], colours)
        _curves(row[1], result, shifted(result), colours)
        _shifts(row[2], each, colours)
        row[0].set(title=each.title, xlabel="normal force [N]", ylabel="friction coefficient [1]")
        row[1].set(xlabel="shifted normal force [N]", ylim=row[0].get_ylim())
        row[2].set(xlabel="speed [m/s]", ylabel=r"log$_{10}$ of the shift [1]")
        row[1].set_title(f"misfit {result.after.rms:.2%}", loc="right", fontsize=7, fontweight="normal")
        for axes in row:
            style.decades(axes)
    place = {"location": "bottom", "aspect": 60, "shrink": 0.7, "fraction": 0.03, "pad": 0.04 / len(found)}
    shades.bar(drawing, panels, shades.SPEED, between, "speed [m/s]", **place)
    return drawing


def sheets(found: Sequence[Shifted]) -> dict[str, list[dict]]:
    """Points with their shifts, and the shifts of each set."""
    points, shifts = [], []
    for each in found:
        result = each.collapse
        for index, (curve, moved) in enumerate(zip(result.curves, shifted(result), strict=True)):
            shifts.append(
                {
                    "curves": each.title,
                    "speed": curve.speed,
                    "log_shift": result.shifts[index],
                    "log_shift_error": result.shift_errors[index],
                }
            )
            friction = np.exp(curve.log_friction)
            points.extend(
                {
                    "curves": each.title,
                    "speed": curve.speed,
                    "normal_force": load,
                    "shifted_force": force,
                    "friction_coefficient": mu,
                    "friction_coefficient_error": error,
                }
                for load, force, mu, error in zip(
                    np.exp(curve.log_load), np.exp(moved), friction, friction * curve.error, strict=True
                )
            )
    return {NAME: points, f"{NAME}-shifts": shifts} if points else {}


def caption(found: Sequence[Shifted]) -> str:
    """What the figure shows."""
    return (
        "Friction against normal force, a curve for each speed, by colour; the curves shifted along the force "
        "so as to come closest to one curve while neighbours overlap (Eq. 23); and the common logarithm of the "
        "shift, p(v) over that of the reference speed, with standard errors, hollow and without errors where "
        "only the demand for overlap stops it. Misfits are rms of ln μ, the scatter is the rms standard error "
        "of ln μ. " + " ".join(map(_said, found))
    )


def _said(each):
    result = each.collapse
    reference = f"{result.speeds[result.reference]:.3g} m/s"
    scatter = f"{result.scatter:.2%}" if np.isfinite(result.scatter) else "unknown"
    expected = ""
    if each.expected is not None:
        rms = each.predicted.rms
        left = f"misfit {rms:.2%}, {each.predicted.verdict}" if np.isfinite(rms) else "curves that do not overlap"
        expected = f"; expected {each.expected:.3g}, which leaves {left}"
    fitted = plus_minus(result.exponent, each.exponent_error) if result.overlaps else "undecided"
    # Of a user's own table; simulated points share their profiles, and an expectation says what they are.
    vertical = f" {explain_vertical(each.vertical)}" if each.expected is None else ""
    return (
        f"{each.title} ({len(result.curves)} speeds, {_points(result)} points, reference {reference}): "
        f"{result.verdict}; misfit {result.before.rms:.2%} as they are, {result.after.rms:.2%} shifted, scatter "
        f"{scatter}; exponent of the speed {fitted}{expected}; {explain(result)}{vertical}"
    )


def _points(result):
    return sum(curve.log_load.size for curve in result.curves)


def _curves(axes: Axes, result, abscissae, colours):
    for curve, x, colour in zip(result.curves, abscissae, colours, strict=True):
        mu = np.exp(curve.log_friction)
        error = np.nan_to_num(mu * curve.error)
        axes.errorbar(
            np.exp(x),
            mu,
            yerr=error,
            color=colour,
            marker=".",
            markersize=2.5,
            linewidth=0.6,
            elinewidth=0.6,
            capsize=0,
        )
    axes.set(xscale="log", yscale="log")


def _shifts(axes, each, colours):
    """Filled where the fit decides, hollow where it leaves no overlap."""
    result = each.collapse
    shifts, errors = result.shifts / LOG10, result.shift_errors / LOG10
    if result.overlaps:
        axes.errorbar(result.speeds, shifts, yerr=np.nan_to_num(errors), fmt="none", ecolor=colours, capsize=0)
    inside = colours if result.overlaps else "white"
    axes.scatter(result.speeds, shifts, s=10, facecolors=inside, edgecolors=colours, linewidths=0.9, zorder=2)
    decades = np.log10(result.speeds / result.speeds[result.reference])
    if result.overlaps:
        fitted = plus_minus(result.exponent, each.exponent_error)
        axes.plot(
            result.speeds,
            result.exponent * decades,
            "-",
            color="0.6",
            linewidth=0.9,
            zorder=1,
            label=f"slope {fitted}",
        )
    if each.expected is not None:
        axes.plot(
            result.speeds,
            each.expected * decades,
            "--",
            color="black",
            linewidth=0.9,
            zorder=3,
            label=f"expected {each.expected:.3g}",
        )
    axes.set(xscale="log")
    if axes.get_legend_handles_labels()[0]:
        low, high = axes.get_ylim()
        axes.set_ylim(low, high + 0.35 * (high - low))
        axes.legend(loc="upper right", fontsize=6.5)
