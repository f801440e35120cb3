"""Force against depth of bodies pressed in at constant rates, in one dimension and in three."""

from math import nan

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from scene import Program

from ..statistics.jackknife import Estimated
from ..studies.judgement import JudgedSeries
from ..studies.points import mean_of, quotient
from ..studies.series import ROUGH, SMOOTH
from ..verdict import DIMENSIONS
from ..plots import shades, style
from ..plots.lettering import clear

NAME = "study-pressed-in"
# Markers of neighbouring rates are drawn apart by this factor of the depth.
APART = 1.03


def figure(judged: JudgedSeries) -> Figure | None:
    """Left 1D, middle 3D, right 1D over 3D. None unless the series is pressed in at rates."""
    series = judged.solved.series
    if not isinstance(series.scene.motion, Program) or not series.speeds:
        return None
    drawing = style.canvas("double", 3.2)
    one, three, ratio = drawing.subplots(1, 3)
    three.sharey(one)
    scale = shades.between(series.speeds)
    for axes, solver in zip((one, three), DIMENSIONS, strict=True):
        _forces(axes, judged, solver, scale)
    _ratios(ratio, judged, scale)
    for axes in (one, three, ratio):
        axes.set(xscale="log", xlabel="depth [µm]")
        style.span(axes, 1e6 * np.array(series.presses))
        style.decades(axes)
    one.set_ylabel("normal force [N]")
    one.legend()
    place = {"location": "bottom", "aspect": 60, "shrink": 0.7, "fraction": 0.05, "pad": 0.02}
    shades.bar(drawing, (one, three, ratio), shades.SPEED, scale, "rate of indentation [m/s]", **place)
    clear(drawing, (one,))
    return drawing


def sheets(judged: JudgedSeries) -> dict[str, list[dict]]:
    """Every point, rough and smooth, and the ratio of rough ones."""
    series, rows = judged.solved.series, []
    if not isinstance(series.scene.motion, Program):
        return {}
    ratios = ratio_of(judged, ROUGH)
    for solver, dimension in DIMENSIONS.items():
        rough, smooth = (_force(judged, solver, body) for body in (ROUGH, SMOOTH))
        for i, rate in enumerate(series.speeds):
            for j, depth in enumerate(series.presses):
                rows.append(
                    {
                        "dimension": dimension,
                        "rate": rate,
                        "depth": depth,
                        "normal_force": rough.value[i, j],
                        "normal_force_error": rough.error[i, j],
                        "smooth_normal_force": smooth.value[i, j],
                        "smooth_closed_form": nan if judged.closed is None else judged.closed[i, j],
                        "rough_1d_over_3d": ratios.value[i, j],
                        "rough_1d_over_3d_error": ratios.error[i, j],
                    }
                )
    return {NAME: rows}


def caption(judged: JudgedSeries) -> str:
    """What the figure shows."""
    return (
        "Normal force at the end of an indentation from nothing at a constant rate, by colour, against the "
        "depth reached: rough bodies, means over surfaces (markers), and smooth ones (thin lines; crosses: Lee "
        "and Radok). Right: the force in one dimension over that in three at the same depth and rate, less one, "
        "rough (markers) and smooth (thin lines); in 3D the last half step is still to come, which the claims "
        "allow for and the figure does not. Bars are intervals of 95 % over the surfaces; points are drawn "
        "apart along the depth."
    )


def ratio_of(judged: JudgedSeries, body: str) -> Estimated:
    """Force in 1D over that in 3D, (rates, depths)."""
    return quotient(*(_force(judged, solver, body) for solver in DIMENSIONS))


def _force(judged, solver, body):
    return mean_of(judged.solved(solver, body), body, "normal_force")


def _forces(axes: Axes, judged, solver, scale):
    series, rough, smooth = judged.solved.series, *(_force(judged, solver, body) for body in (ROUGH, SMOOTH))
    depths = 1e6 * np.array(series.presses)
    for i, rate in enumerate(series.speeds):
        colour = shades.SPEED(scale(rate))
        _bars(axes, depths, rough, i, color=colour, marker=style.MARKER[solver], linestyle=style.LINE[solver],
              label="rough" if i == 0 else None)  # fmt: skip
        axes.plot(
            depths, smooth.value[i], color=colour, linewidth=style.width(0.55), label="smooth" if i == 0 else None
        )
        if judged.closed is not None:
            known = "smooth, closed form" if i == 0 else None
            axes.plot(
                depths,
                judged.closed[i],
                "+",
                color=style.COLOUR["exact"],
                markersize=style.mark(1.25),
                label=known,
            )
    axes.set(yscale="log", title=style.LABEL[solver])


def _ratios(axes, judged, scale):
    depths = 1e6 * np.array(judged.solved.series.presses)
    rough, smooth = (ratio_of(judged, body) for body in (ROUGH, SMOOTH))
    axes.axhline(0, color=style.grey(0.45), linewidth=style.width(0.8), zorder=1)
    for i, rate in enumerate(judged.solved.series.speeds):
        colour = shades.SPEED(scale(rate))
        over = Estimated(100 * (rough.value - 1), 100 * rough.error, rough.freedom)
        _bars(axes, depths, over, i, color=colour, marker="D", linestyle="-")
        axes.plot(depths, 100 * (smooth.value[i] - 1), color=colour, linewidth=style.width(0.55))
    axes.set(ylabel="force 1D / 3D - 1 [%]", title="1D over 3D")


def _bars(axes, x, numbers: Estimated, i, **look):
    low, high = numbers.interval()
    bars = np.nan_to_num(np.abs([numbers.value - low, high - numbers.value]))[:, i]
    x = x * APART ** (i - (len(numbers.value) - 1) / 2)
    axes.errorbar(x, numbers.value[i], yerr=bars, linewidth=style.width(0.7), markersize=style.mark(0.9), **look)
