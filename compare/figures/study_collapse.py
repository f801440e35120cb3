"""Friction of one series against load, its curves shifted onto one, and what they then still miss."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..alignment import Alignment
from ..shifting import Shifting
from ..studies.judgement import JudgedSeries
from ..studies.points import friction, mean_of
from ..studies.question import TOLERANCE
from ..studies.series import ROUGH
from ..verdict import DIMENSIONS
from ..plots import shades, style
from ..plots.lettering import clear

NAME = "study-collapse"
# Of a rough body in one dimension and in three; the marker tells them apart where colour is speed.
LOOK = {
    solver: {"marker": style.MARKER[solver], "linestyle": style.LINE[solver]} for solver in DIMENSIONS
}  # fmt: skip


def figure(judged: JudgedSeries) -> Figure | None:
    """Columns: 1D, 3D. Rows: as solved, shifted along the load, what is left. None unless the series slides."""
    if not judged.laws:
        return None
    fitted = {solver for solver, found in judged.shiftings.items() if found.horizontal.curve}
    rows = (1, 1, 0.7) if fitted else (1, 1)
    drawing = style.canvas("double", 1.1 + 2.15 * sum(rows))
    panels = drawing.subplots(len(rows), 2, sharey="row", height_ratios=rows)
    scale = shades.between(judged.solved.series.speeds)
    for column, solver in zip(panels.T, DIMENSIONS, strict=True):
        _solved(column[0], judged, solver, scale)
        column[0].set(title=style.LABEL[solver], xlabel="normal force [N]")
        column[1].set(xlabel="shifted normal force [N]", xscale="log", yscale="log")
        if solver in fitted:
            _shifted(column[1:], judged, solver, scale)
        else:
            _as_predicted(column[1], judged, solver, scale)
            for axes in column[2:]:
                axes.set_axis_off()
    labels = ("friction coefficient [1]", "friction coefficient [1]", "off the curve [%]")
    for axes, label in zip(panels[:, 0], labels, strict=False):
        axes.set_ylabel(label)
    for axes in panels.flat:
        style.decades(axes)
    place = {"location": "bottom", "aspect": 60, "shrink": 0.7, "fraction": 0.03, "pad": 0.02}
    shades.bar(drawing, panels, shades.SPEED, scale, "speed [m/s]", **place)
    clear(drawing, panels[1])
    return drawing


def sheets(judged: JudgedSeries) -> dict[str, list[dict]]:
    """Every point that was shifted, and how far it is off the common curve."""
    points: list[dict] = []
    for solver, found in judged.shiftings.items():
        for index, curve in enumerate(found.curves):
            shifted = curve.log_load + found.horizontal.horizontal.value[index]
            points.extend(
                {
                    "dimension": DIMENSIONS[solver],
                    "speed": curve.speed,
                    "normal_force": np.exp(log_load),
                    "shifted_force": np.exp(log_shifted),
                    "friction_coefficient": np.exp(log_friction),
                    "friction_coefficient_error": np.exp(log_friction) * error,
                    "off_the_curve": off,
                }
                for log_load, log_shifted, log_friction, error, off in zip(
                    curve.log_load,
                    shifted,
                    curve.log_friction,
                    curve.error,
                    _off(found.horizontal, shifted, curve.log_friction),
                    strict=True,
                )
            )
    return {NAME: points} if points else {}


def caption(judged: JudgedSeries) -> str:
    """What the figure shows."""
    said = " ".join(
        f"{DIMENSIONS[solver]}: {_left_out(found)}{_said(found)}; {found.none.rms:.1%} before shifting."
        for solver, found in judged.shiftings.items()
    )
    return (
        "Friction against normal force, a curve for each speed, by colour, in one dimension (left) and in three "
        "(right): means over surfaces with standard errors. Middle: shifted along the force (Eq. 23), all speeds "
        "at once, so as to come closest to one curve (black); dashed grey, Eq. 19 with the shifts p(v) of "
        "Eq. 22, of the same slope and cut-off; where no shifts can be fitted, the curves have those too. "
        "Below: what the means then miss the curve by, with their standard errors; the band is the tolerance, "
        f"{TOLERANCE:.0%}. δ is the rms of that in ln μ without what the scatter of surfaces adds, and its "
        f"interval of 95 %. {said}"
    )


def _solved(axes: Axes, judged, solver, scale):
    load, mu = mean_of(judged.solved(solver), ROUGH, "normal_force").value, friction(judged.solved, solver)
    for speed, x, y, error in zip(judged.solved.series.speeds, load, mu.value, mu.error, strict=True):
        _curve(axes, x, y, error, solver, shades.SPEED(scale(speed)))
    axes.set(xscale="log", yscale="log")


def _shifted(panels, judged, solver, scale):
    above, below = panels
    below.set(xlabel="shifted normal force [N]", xscale="log")
    below.sharex(above)
    found: Shifting = judged.shiftings[solver]
    fit = found.horizontal
    below.axhspan(-100 * TOLERANCE, 100 * TOLERANCE, color=style.grey(0.9), linewidth=0)
    below.axhline(0, color=style.ink(), linewidth=style.width(0.65))
    for index, curve in enumerate(found.curves):
        x, colour = curve.log_load + fit.horizontal.value[index], shades.SPEED(scale(curve.speed))
        mu = np.exp(curve.log_friction)
        _curve(above, np.exp(x), mu, mu * curve.error, solver, colour, linestyle="none")
        off = 100 * _off(fit, x, curve.log_friction)
        _curve(below, np.exp(x), off, 100 * curve.error, solver, colour, linewidth=style.width(0.55))
    x = np.linspace(*fit.curve.domain, 201)
    above.plot(
        np.exp(x),
        np.exp(fit.curve(x)),
        color=style.ink(),
        linewidth=style.width(0.8),
        zorder=1,
        label="common curve",
    )
    _law(above, judged, solver, found.speeds[len(found.speeds) // 2])
    above.legend(loc="lower left")
    below.set_title(f"δ = {_within(fit)}", loc="right", fontsize=style.small(), fontweight="normal")


def _as_predicted(axes, judged, solver, scale):
    """Where no shifts can be fitted, curves with those of theory."""
    series, found = judged.solved.series, judged.shiftings.get(solver)
    load, mu = mean_of(judged.solved(solver), ROUGH, "normal_force").value, friction(judged.solved, solver)
    middle = series.speeds[len(series.speeds) // 2]
    shifts = np.exp(_predicted(judged, solver, middle))
    for speed, x, y, error in zip(series.speeds, load * shifts[:, None], mu.value, mu.error, strict=True):
        _curve(axes, x, y, error, solver, shades.SPEED(scale(speed)))
    _law(axes, judged, solver, middle)
    reason = found.horizontal.reason if found else "too few points"
    said = style.fill(
        f"Shifted by p(v), as no shifts are fitted: {reason}.", 0.38 * style.across("double"), style.small()
    )
    axes.legend(loc="lower left", title=said, title_fontsize=style.small(), alignment="left")


def _predicted(judged, solver, reference):
    """ln p(v) of all speeds over that of the reference."""
    shifts = judged.laws[solver].shifts
    return shifts - shifts[judged.solved.series.speeds.index(reference)]


def _law(axes, judged, solver, reference):
    """Eq. 19 at all points, shifted as theory has it: one curve against the load at the reference speed."""
    laws = judged.laws[solver]
    load = (np.exp(_predicted(judged, solver, reference))[:, None] * laws.load).ravel()
    law = laws.law.ravel()
    known = np.isfinite(load) & np.isfinite(law)
    order = np.argsort(load[known])
    x, mu = load[known][order], law[known][order]
    axes.plot(x, mu, "--", color=style.grey(0.5), linewidth=style.width(), zorder=1, label="Eq. 19 with p(v)")


def _off(fit: Alignment, log_shifted, log_friction):
    """ln mu less that of the common curve; NaN without one."""
    return log_friction - fit.curve(log_shifted) if fit.curve else np.full(log_friction.shape, np.nan)


def _said(found):
    if found.horizontal.reason:
        return f"no fitted shifts, {found.horizontal.reason}"
    return f"polynomial of degree {found.degree}, δ = {_within(found.horizontal)}"


def _within(fit: Alignment):
    """The misfit and its interval; with the scatter of surfaces unknown, what the means miss."""
    size = fit.misfit
    if not np.isfinite(size.value):
        return f"unknown, the means miss the curve by {fit.rms:.1%}"
    low, high = size.interval()
    return f"{size.value:.1%} ({low:.1%} to {high:.1%})"


def _left_out(found):
    parts = [
        f"{count} {name}{'s' if count > 1 else ''}"
        for count, name in ((found.points_left_out, "point"), (found.surfaces_left_out, "surface"))
        if count
    ]
    return f"{' and '.join(parts)} left out, " if parts else ""


def _curve(axes, x, y, error, solver, colour, **other):
    look = (
        LOOK[solver]
        | {
            "linewidth": style.width(0.7),
            "markersize": style.mark(0.75),
            "elinewidth": style.width(0.65),
            "capsize": 0,
        }
        | other
    )
    axes.errorbar(x, y, yerr=np.nan_to_num(error), color=colour, **look)
