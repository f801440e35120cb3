"""Depth or force of the bodies of one series at rest, in one dimension against three and against closed forms."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..statistics.jackknife import Estimated
from ..studies.depthclaims import closed_forms
from ..studies.judgement import JudgedSeries
from ..studies.points import mean_of, mean_ratio, quotient
from ..studies.series import REST, SMOOTH_REST, Series, Solved
from ..verdict import DIMENSIONS
from ..plots import style
from ..plots.lettering import clear

NAME = "study-depth"
# Neighbouring markers are drawn apart by this factor of the load or depth, either way.
APART = 1.02


def figure(judged: JudgedSeries) -> Figure | None:
    """All, less the smooth closed form, 1D less 3D, and stiffness. None without rough bodies at rest."""
    solved = judged.solved
    if any(solved.get(solver, REST) is None for solver in DIMENSIONS):
        return None
    drawing = style.canvas("double", 4.9)
    panels = drawing.subplots(2, 2)
    whole, deviation, difference, stiff = panels.flat
    _whole(whole, solved)
    _deviation(deviation, solved)
    _difference(difference, solved)
    _stiffness(stiff, solved)
    for axes, letter in zip(panels.flat, "abcd", strict=True):
        axes.set_title(f"({letter})")
        style.decades(axes)
    clear(drawing, panels.flat)
    return drawing


def sheets(judged: JudgedSeries) -> dict[str, list[dict]]:
    """Every press of both dimensionalities, and stiffness between neighbours."""
    solved, points, secants = judged.solved, [], []
    if any(solved.get(solver, REST) is None for solver in DIMENSIONS):
        return {}
    load, depth = closed_forms(solved.series)
    differences = difference(solved, REST)
    for solver, dimension in DIMENSIONS.items():
        rough, smooth, k = (
            measured(solved, solver, REST),
            measured(solved, solver, SMOOTH_REST),
            stiffness(solved, solver),
        )
        for j, press in enumerate(solved.series.presses):
            points.append(
                {
                    "dimension": dimension,
                    f"prescribed_{solved.series.pressed_by}": press,
                    "rough": rough.value[j],
                    "rough_error": rough.error[j],
                    "smooth": smooth.value[j],
                    "closed_form_force": load[j],
                    "closed_form_depth": depth[j],
                    "rough_1d_less_3d": differences.value[j],
                    "rough_1d_less_3d_error": differences.error[j],
                }
            )
        for force, stiff, error in zip(between_presses(solved, solver), k.value, k.error, strict=True):
            secants.append({"dimension": dimension, "force": force, "stiffness": stiff, "stiffness_error": error})
    return {NAME: points} | ({f"{NAME}-stiffness": secants} if secants else {})


def caption(judged: JudgedSeries) -> str:
    """What the figure shows."""
    if judged.solved.series.pressed_by == "load":
        what, over = "Depth under prescribed loads", "the rms height of the roughness"
        differ = "the depth in one dimension less that in three, over that of the closed form"
    else:
        what, over = "Force at prescribed depths", "the closed form"
        differ = "the force in one dimension over that in three, less one"
    return (
        f"(a) {what} at rest: means over surfaces, and the closed form of the smooth body (line; Galin and "
        f"Sneddon). (b) The same less the closed form, over {over}; hollow, smooth bodies as solved. (c) For "
        f"the rough body, {differ}; grey, smooth bodies. (d) Stiffness against force: secants between "
        "neighbouring presses, and those of the closed form (line). Bars are intervals of 95 % over the "
        "surfaces; points are drawn apart along the axis. Depth is that of the macroscopic tip, below zero "
        "where only the highest asperities touch."
    )


def measured(solved: Solved, solver: str, body: str) -> Estimated:
    """Depth [m] under the loads, or force [N] at the depths, (presses,)."""
    name = "depth" if solved.series.pressed_by == "load" else "normal_force"
    found = mean_of(solved(solver, body), body, name)
    return Estimated(
        *(np.broadcast_to(each, found.value.shape)[0] for each in (found.value, found.error, found.freedom))
    )


def difference(solved: Solved, body: str) -> Estimated:
    """1D less 3D: of depths over those of the closed form; of forces over those of 3D; (presses,)."""
    one, three = (measured(solved, solver, body) for solver in DIMENSIONS)
    if solved.series.pressed_by == "depth":
        ratio = quotient(one, three)
        return Estimated(ratio.value - 1, ratio.error, ratio.freedom)
    _, depth = closed_forms(solved.series)
    error, freedom = np.hypot(one.error, three.error), np.minimum(one.freedom, three.freedom)
    return Estimated((one.value - three.value) / depth, error / depth, freedom)


def stiffness(solved: Solved, solver: str) -> Estimated:
    """dF/dd [N/m] between neighbouring presses, (presses - 1,), on the same surfaces."""
    answers = solved(solver, REST)
    return mean_ratio(np.diff(answers.normal_force[0], axis=0), np.diff(answers.depth[0], axis=0))


def between_presses(solved: Solved, solver: str) -> np.ndarray:
    """Geometric mean of the forces at neighbouring presses [N]."""
    force = mean_of(solved(solver, REST), REST, "normal_force").value[0]
    return np.sqrt(force[1:] * force[:-1])


def _whole(axes: Axes, solved):
    series = solved.series
    load, depth = closed_forms(series)
    x, known, scale = (load, depth, 1e6) if series.pressed_by == "load" else (depth, load, 1.0)
    axes.plot(
        _scaled(series, x),
        scale * known,
        color=style.grey(0.45),
        linewidth=style.width(0.8),
        zorder=1,
        label="smooth, closed form",
    )
    for index, solver in enumerate(DIMENSIONS):
        numbers = measured(solved, solver, REST)
        x = _presses(series, index)
        _bars(axes, x, _times(numbers, scale), solver, label=f"{DIMENSIONS[solver]}, rough")
    _along(axes, series)
    axes.set(ylabel="depth [µm]" if series.pressed_by == "load" else "normal force [N]")
    if series.pressed_by == "depth":
        axes.set_yscale("log")
    axes.legend()


def _deviation(axes, solved):
    """Of depths in rms heights, since a rough body may not sink in at all; of forces in per cent."""
    series = solved.series
    load, depth = closed_forms(series)
    height = series.scene.roughness.rms_height
    known, unit, label = (
        (depth, height, "depth less the smooth one [$h_0$]")
        if series.pressed_by == "load"
        else (load, load / 100, "force less the smooth one [%]")
    )
    axes.axhline(0, color=style.grey(0.45), linewidth=style.width(0.8), zorder=1)
    for index, solver in enumerate(DIMENSIONS):
        for body, look in ((SMOOTH_REST, {"markerfacecolor": style.paper(), "linestyle": "none"}), (REST, {})):
            numbers = measured(solved, solver, body)
            left = Estimated((numbers.value - known) / unit, numbers.error / unit, numbers.freedom)
            name = "rough" if body == REST else "smooth"
            _bars(axes, _presses(series, index), left, solver, label=f"{DIMENSIONS[solver]}, {name}", **look)
    _along(axes, series)
    axes.set(ylabel=label)
    axes.legend(ncols=2)


def _difference(axes, solved):
    series = solved.series
    axes.axhline(0, color=style.grey(0.45), linewidth=style.width(0.8), zorder=1)
    for body, look in (
        (
            SMOOTH_REST,
            {"color": style.grey(0.5), "marker": "D", "linestyle": ":", "markerfacecolor": style.paper()},
        ),
        (REST, {"color": style.ink(), "marker": "o", "linestyle": "-"}),
    ):
        numbers = _times(difference(solved, body), 100)
        _bars(axes, _presses(series, 0.5), numbers, "exact", label="rough" if body == REST else "smooth", **look)
    _along(axes, series)
    what = "depth 1D - 3D [% of smooth]" if series.pressed_by == "load" else "force 1D / 3D - 1 [%]"
    axes.set(ylabel=what)
    axes.legend()


def _stiffness(axes, solved):
    load, depth = closed_forms(solved.series)
    if load.size > 1:
        x, k = np.sqrt(load[1:] * load[:-1]), np.diff(load) / np.diff(depth)
        axes.plot(
            x, 1e-3 * k, color=style.grey(0.45), linewidth=style.width(0.8), zorder=1, label="smooth, closed form"
        )
        for solver in DIMENSIONS:
            x, k = between_presses(solved, solver), stiffness(solved, solver)
            _bars(axes, x, _times(k, 1e-3), solver, label=f"{DIMENSIONS[solver]}, rough")
        axes.legend()
    axes.set(xscale="log", yscale="log", xlabel="normal force [N]", ylabel="stiffness [kN/m]")


def _bars(axes, x, numbers: Estimated, solver, **look):
    """Points with intervals of 95 %; a bar that would cross zero on a logarithmic axis ends at it."""
    low, high = numbers.interval()
    bars = np.nan_to_num(np.abs([numbers.value - low, high - numbers.value]))
    kept = {"color": style.COLOUR[solver], "marker": style.MARKER[solver], "linestyle": style.LINE[solver]}
    axes.errorbar(
        x, numbers.value, yerr=bars, **kept | {"linewidth": style.width(0.7), "markersize": style.mark(0.9)} | look
    )


def _times(numbers, factor):
    return Estimated(numbers.value * factor, numbers.error * factor, numbers.freedom)


def _presses(series: Series, index):
    """Where the points of the first or second dimensionality are drawn."""
    return _scaled(series, np.array(series.presses)) * APART ** (2 * index - 1)


def _scaled(series, presses):
    return presses * (1.0 if series.pressed_by == "load" else 1e6)


def _along(axes, series):
    axes.set(xscale="log", xlabel="normal force [N]" if series.pressed_by == "load" else "depth [µm]")
    style.span(axes, _scaled(series, np.array(series.presses)))
