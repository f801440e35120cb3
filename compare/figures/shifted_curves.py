"""Friction against load at many speeds, its master curve, and the shifts that make it (paper, Figs. 5 to 7)."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..mastercurve import shifted
from ..paper.conditions import gathered
from ..paper.predicted import STIFFNESS
from ..paper.shifts import Shifted
from ..wording import explain, explain_vertical, plus_minus
from ..plots import shades, style
from ..plots.lettering import clear

NAME = "shifted-curves"
LOG10 = np.log(10)
# What a misfit is beside the scatter, by its verdict.
SCATTER = {"holds": "within scatter", "fails": "beyond scatter", "undecided": "of unknown scatter"}
# Lines of what forms of Eq. 22 have for a shift, in the order in which they come.
LAWS = (("#009E73", ":"), ("#CC79A7", "-."))


def figure(found: Sequence[Shifted]) -> Figure | None:
    """A row for each set of curves: as they are, shifted, and the shifts. None without any."""
    if not found:
        return None
    drawing = style.canvas("double", 0.55 + 2.1 * len(found))
    panels = drawing.subplots(len(found), 3, squeeze=False)
    every = np.concatenate([each.collapse.speeds for each in found])
    between = shades.between(every)
    for row, each in zip(panels, found, strict=True):
        result = each.collapse
        colours = shades.SPEED(between(result.speeds))
        row[1].sharey(row[0])
        _curves(row[0], each, [curve.log_load for curve in result.curves], colours)
        _curves(row[1], each, _abscissae(each), colours)
        _shifts(row[2], each, colours)
        row[0].set_title(each.title)
        row[2].set_title(_verdict(each), loc="right", fontsize=style.small(), fontweight="normal")
        row[0].set(xlabel="normal force [N]", ylabel="friction coefficient [1]")
        row[1].set(xlabel="shifted normal force [N]")
        row[2].set(xlabel="speed [m/s]", ylabel="decades of the shift [1]")
        for axes in row:
            style.decades(axes)
        for axis in (row[0].yaxis, row[1].yaxis, row[1].xaxis):
            axis.set_major_formatter(lambda value, _: f"{value:g}")
    place = {"location": "bottom", "aspect": 60, "shrink": 0.7, "fraction": 0.03, "pad": 0.04 / len(found)}
    shades.bar(drawing, panels, shades.SPEED, between, "speed [m/s]", **place)
    clear(drawing, panels[:, 2])
    return drawing


def sheets(found: Sequence[Shifted]) -> dict[str, list[dict]]:
    """Points with their shifts, and the shifts of each set."""
    points: list[dict] = []
    shifts: list[dict] = []
    for each in found:
        result = each.collapse
        conditions = [at.columns for at in each.conditions] or [{}] * len(result.curves)
        for index, (curve, moved) in enumerate(zip(result.curves, _abscissae(each), strict=True)):
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
                    **{name: column[point] for name, column in conditions[index].items()},
                }
                for point, (load, force, mu, error) in enumerate(
                    zip(np.exp(curve.log_load), np.exp(moved), friction, friction * curve.error, strict=True)
                )
            )
    return {NAME: points, f"{NAME}-shifts": shifts} if points else {}


def caption(found: Sequence[Shifted]) -> str:
    """What the figure shows."""
    parted = (
        "curves as expected and no shift where only that demand stops them"
        if any(each.expected is not None for each in found)
        else "hollow and without errors where only that demand stops it"
    )
    return (
        "Friction against normal force, a curve for each speed, by colour; the curves shifted along the force "
        "so as to come closest to one curve while neighbours overlap (Eq. 23); and the common logarithm of the "
        f"shift, p(v) over that of the reference speed, with standard errors, {parted}. Shifts of curves that do "
        "not collapse are hollow and have no exponent; straight parallel lines cannot tell horizontal from "
        "vertical shifts, and theirs are taken for horizontal. Misfits are rms of ln μ, the scatter is the rms "
        f"standard error of ln μ. {' '.join(map(_said, found))}"
    )


def _abscissae(each):
    """ln F of each curve, shifted: as expected where the fit only pulls the curves apart."""
    if not _parted(each):
        return shifted(each.collapse)
    by = each.expected * np.log(each.collapse.speeds / each.collapse.speeds[each.collapse.reference])
    return [curve.log_load + shift for curve, shift in zip(each.collapse.curves, by, strict=True)]


def _parted(each):
    """Whether the fit says nothing of shifts of which something is expected."""
    return each.expected is not None and not each.collapse.overlaps


def _verdict(each):
    result = each.collapse
    if not _parted(each):
        why = ", straight lines" if result.overlaps and not result.separable else ""
        return f"collapse {result.verdict}{why}: misfit {result.after.rms:.2%}"
    misfit = f": {each.predicted.rms:.2%}" if np.isfinite(each.predicted.rms) else ""
    return f"collapse undecided, shifted as expected{misfit}"


def _said(each):
    result = each.collapse
    reference = f"{result.speeds[result.reference]:.3g} m/s"
    scatter = f"{result.scatter:.2%}" if np.isfinite(result.scatter) else "unknown"
    expected = ""
    if each.expected is not None:
        rms = each.predicted.rms
        left = f"misfit {rms:.2%}, {SCATTER[each.predicted.verdict]}" if np.isfinite(rms) else "no overlap"
        expected = f"; shifted by the {each.expected:.3g} that is expected, {left}"
    fitted = plus_minus(each.exponent, each.exponent_error)
    # Of a user's own table; simulated points share their profiles, and an expectation says what they are.
    vertical = f" {explain_vertical(each.vertical)}" if each.expected is None else ""
    laws = "".join(f"; of Eq. 22, {name}, {_power(power)}" for name, power in each.laws.items())
    return (
        f"{each.title} ({len(result.curves)} speeds, {_points(result)} points, reference {reference}): "
        f"collapse {result.verdict}; misfit {result.before.rms:.2%} as they are, {result.after.rms:.2%} shifted, "
        f"scatter {scatter}; exponent of the speed {fitted}{laws}{expected}; {explain(result)}{vertical}"
        f"{_broken(each)}"
    )


def _power(value):
    return f"{value:.4f}" if np.isfinite(value) else "undecided"


def _broken(each):
    """Which conditions of the laws break."""
    if not each.conditions:
        return ""
    together = gathered(each.conditions)
    low, high = together.ratios[STIFFNESS].min(), together.ratios[STIFFNESS].max()
    hollow = "" if together.holds.all() else " Points are hollow where one other than small slopes does."
    return f" |G(v/a)|/G₀ is {low:.2f} to {high:.2f}. {together.words}{hollow}"


def _points(result):
    return sum(curve.log_load.size for curve in result.curves)


def _curves(axes: Axes, each, abscissae, colours):
    """Lines with error bars; points filled where the conditions of the laws hold, or none are known."""
    for index, (curve, x, colour) in enumerate(zip(each.collapse.curves, abscissae, colours, strict=True)):
        mu = np.exp(curve.log_friction)
        error = np.nan_to_num(mu * curve.error)
        axes.errorbar(
            np.exp(x),
            mu,
            yerr=error,
            color=colour,
            linewidth=style.width(0.45),
            elinewidth=style.width(0.45),
            capsize=0,
        )
        holds = each.conditions[index].holds if each.conditions else np.ones(mu.size, bool)
        for at, inside in ((holds, colour), (~holds, style.paper())):
            axes.scatter(
                np.exp(x)[at],
                mu[at],
                s=style.mark(0.5) ** 2,
                c=[inside],
                edgecolors=[colour],
                linewidths=style.width(0.35),
                zorder=2.5,
            )
    axes.set(xscale="log", yscale="log")


def _shifts(axes, each, colours):
    """Filled where curves collapse, hollow where they do not or part; none where something else is expected."""
    result = each.collapse
    shifts, errors = result.shifts / LOG10, result.shift_errors / LOG10
    if result.overlaps:
        axes.errorbar(result.speeds, shifts, yerr=np.nan_to_num(errors), fmt="none", ecolor=colours, capsize=0)
    if not _parted(each):
        inside = colours if each.decided else style.paper()
        axes.scatter(
            result.speeds,
            shifts,
            s=style.mark(0.8) ** 2,
            facecolors=inside,
            edgecolors=colours,
            linewidths=style.width(0.8),
            zorder=2,
        )
    decades = np.log10(result.speeds / result.speeds[result.reference])
    if each.decided:
        fitted = plus_minus(each.exponent, each.exponent_error)
        axes.plot(
            result.speeds,
            each.exponent * decades,
            "-",
            color=style.grey(0.6),
            linewidth=style.width(0.8),
            zorder=1,
            label=f"exponent {fitted}",
        )
    if each.expected is not None:
        axes.plot(
            result.speeds,
            each.expected * decades,
            "--",
            color=style.ink(),
            linewidth=style.width(0.8),
            zorder=3,
            label=f"expected {each.expected:.3g}",
        )
    for (name, power), (colour, line) in zip(each.laws.items(), LAWS, strict=False):
        if np.isfinite(power):
            label = f"{name} {power:.4f}"
            axes.plot(
                result.speeds,
                power * decades,
                line,
                color=colour,
                linewidth=style.width(0.8),
                zorder=4,
                label=label,
            )
    axes.set(xscale="log")
    if axes.get_legend_handles_labels()[0]:
        low, high = axes.get_ylim()
        axes.set_ylim(low, high + 0.5 * (high - low))
        axes.legend(loc="upper right", fontsize=style.tiny(), borderaxespad=0.1, handlelength=1.5)
    if not each.decided:
        axes.text(0.03, 0.05, "exponent undecided", transform=axes.transAxes, fontsize=style.small())
