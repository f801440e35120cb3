"""Friction against load at several speeds, brought onto one curve by horizontal shifts (Eq. 23)."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.typing import HashableList

from ..mastercurve import misfit_at, shifted
from ..verdict import DIMENSIONS, Judgement, predicted_exponent
from ..wording import explain
from ..plots import style
from ..plots.lettering import clear

NAME = "collapse"
COLUMNS = {"solved": "as solved", "predicted": "by Eq. 23", "fitted": "best shifts"}


def figure(judgement: Judgement) -> Figure | None:
    """Rows: 1D, 3D. Columns: as solved, as Eq. 23 predicts, best shifts; those at right. None without a fit."""
    if not judgement.collapses:
        return None
    drawing = style.canvas("double", 4.2)
    rows: list[HashableList[str]] = [
        [*(f"{solver} {column}" for column in COLUMNS), "shift"] for solver in DIMENSIONS
    ]
    axes = drawing.subplot_mosaic(rows, width_ratios=(1, 1, 1, 1.15))
    slope = predicted_exponent(judgement.case)
    for solver, dimension in DIMENSIONS.items():
        result = judgement.collapses.get(solver)
        for column, title in COLUMNS.items():
            panel = axes[f"{solver} {column}"]
            if column != "solved":
                panel.sharey(axes[f"{solver} solved"])
            panel.set(title=f"{dimension}, {title}", xscale="log", yscale="log", xlabel="shifted force [N]")
            if result:
                _curves(panel, solver, result, *_shifted(result, column, slope))
                panel.set_ylim(_range(judgement))
        first = axes[f"{solver} solved"]
        first.set(xlabel="normal force [N]", ylabel="friction coefficient [1]")
        if result:
            first.legend(fontsize=style.tiny(), loc="lower left", handlelength=2)
    _shifts(axes["shift"], judgement, slope)
    for panel in axes.values():
        style.decades(panel)
    clear(drawing, list(axes.values()))
    return drawing


def sheets(judgement: Judgement):
    """Points with their shifts, and the shifts of both dimensionalities."""
    points, shifts = [], []
    for solver, result in judgement.collapses.items():
        for index, (curve, x) in enumerate(zip(result.curves, shifted(result), strict=True)):
            shifts.append({
                "solver": solver,
                "speed": curve.speed,
                "log_shift": result.shifts[index],
                "log_shift_error": result.shift_errors[index],
            })  # fmt: skip
            for log_load, log_shifted, log_friction, error in zip(
                curve.log_load, x, curve.log_friction, curve.error, strict=True
            ):
                points.append({
                    "solver": solver,
                    "speed": curve.speed,
                    "normal_force": np.exp(log_load),
                    "shifted_force": np.exp(log_shifted),
                    "friction_coefficient": np.exp(log_friction),
                    "friction_coefficient_error": np.exp(log_friction) * error,
                })  # fmt: skip
    return {NAME: points, f"{NAME}-shifts": shifts} if points else {}


def caption(judgement: Judgement) -> str:
    """What the figure shows."""
    said = " ".join(
        f"{DIMENSIONS[solver]}: misfit {result.before.rms:.0%} as solved, {result.after.rms:.1%} at best; "
        f"{explain(result)}"
        for solver, result in judgement.collapses.items()
    )
    return (
        "Curves of friction against load at several speeds: as solved, shifted along ln F as Eq. 23 predicts for "
        "a Kelvin body, and with the shifts that bring them closest to one curve while neighbours overlap; at "
        "right these shifts with their standard errors, hollow and without error where only the demand for "
        "overlap stops them. "
        f"Bars are standard errors of the mean. {said}"
    )


def _shifted(result, column, slope):
    """ln F of each curve in a column of the figure, and the misfit there."""
    loads = [curve.log_load for curve in result.curves]
    if column == "solved":
        return loads, result.before
    if column == "fitted":
        return shifted(result), result.after
    shifts = slope * np.log(result.speeds / result.speeds[result.reference])
    return [load + shift for load, shift in zip(loads, shifts, strict=True)], misfit_at(result, slope)


def _curves(axes, solver, result, abscissae, misfit):
    shades = style.shades(solver, len(result.curves))
    for index, (curve, x) in enumerate(zip(result.curves, abscissae, strict=True)):
        mu = np.exp(curve.log_friction)
        axes.errorbar(
            np.exp(x),
            mu,
            yerr=np.nan_to_num(mu * curve.error),
            color=shades[index],
            marker=style.SERIES_MARKERS[index % len(style.SERIES_MARKERS)],
            markersize=style.mark(0.8),
            linestyle=style.SERIES_LINES[index % len(style.SERIES_LINES)],
            linewidth=style.width(0.7),
            label=f"{curve.speed:.3g} m/s",
        )
    text = f"misfit {misfit.rms:.1%}" if np.isfinite(misfit.rms) else "no overlap"
    axes.text(0.97, 0.93, text, transform=axes.transAxes, fontsize=style.small(), ha="right")


def _range(judgement):
    """Of friction in all panels: it falls with load, so room above is for the misfit, below for the legend."""
    friction = [curve.log_friction for result in judgement.collapses.values() for curve in result.curves]
    lowest, highest = np.min(np.concatenate(friction)), np.max(np.concatenate(friction))
    return np.exp(lowest - 0.45 * (highest - lowest)), np.exp(highest + 0.22 * (highest - lowest))


def _shifts(axes, judgement, slope):
    """Filled where the fit decides, hollow where it leaves no overlap."""
    for index, (solver, result) in enumerate(judgement.collapses.items()):
        axes.errorbar(
            result.speeds * 1.05 ** (2 * index - 1),
            result.shifts,
            yerr=result.shift_errors if np.isfinite(result.shift_errors).all() else None,
            color=style.COLOUR[solver],
            marker=style.MARKER[solver],
            markerfacecolor=style.COLOUR[solver] if result.overlaps else style.paper(),
            linestyle="none",
            label=DIMENSIONS[solver] + (f": {result.exponent:.2f}" if result.overlaps else ": undecided"),
        )
    speeds, reference = result.speeds, result.speeds[result.reference]
    line = slope * np.log(speeds / reference)
    axes.plot(speeds, line, "-", color=style.grey(0.45), linewidth=style.width(0.8), label=f"Eq. 23: {slope:.4g}")
    axes.set(xscale="log", xlabel="speed [m/s]", ylabel="ln p(v) / p(reference) [1]", title="best shifts")
    axes.legend(
        title="exponent of v",
        title_fontsize=style.small(),
        loc="upper right",
        fontsize=style.small(),
        handlelength=1.6,
    )
