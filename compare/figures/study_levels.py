"""Friction of one series against speed, and 1D over 3D, with what theory has for either."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import EngFormatter

from ..statistics.jackknife import Estimated
from ..studies.judgement import JudgedSeries
from ..studies.points import friction, quotient, ratio
from ..studies.series import ROUGH, SMOOTH
from ..verdict import DIMENSIONS
from ..plots import shades, style

NAME = "study-levels"
# Of what is prescribed: unit, and what the bar of shades is in.
UNITS = {"load": "N", "depth": "m"}
# What friction of the rough and of the smooth body is shown against.
MEMORIES = ("memory_over_shortest", "memory_over_contact")
BAR = {"load": (1.0, "normal force [N]"), "depth": (1e6, "depth [µm]")}


def figure(judged: JudgedSeries) -> Figure | None:
    """Above: friction at three loads or depths. Below: 1D over 3D, rough and smooth. None unless it slides."""
    if not judged.laws:
        return None
    drawing = style.canvas("double", 5.2)
    above, below = drawing.subfigures(2, 1, squeeze=False, height_ratios=(1.15, 1))[:, 0]
    presses = judged.solved.series.presses
    chosen = sorted({0, len(presses) // 2, len(presses) - 1})
    levels = above.subplots(1, len(chosen), sharey=True, sharex=True, squeeze=False)[0]
    levels[0].set(xscale="log", yscale="log", ylabel="friction coefficient [1]")
    for axes, place in zip(levels, chosen, strict=True):
        _level(axes, judged, place)
        axes.set(xlabel="speed [m/s]", title=_pressed(judged, presses[place]))
    _room(levels[0], judged, chosen)
    style.legend(above, levels[0].get_legend_handles_labels()[0], "outside lower center", 5)
    ratios = below.subplots(1, 2, sharey=True)
    _ratios(below, ratios, judged)
    for axes in (*levels, *ratios):
        style.decades(axes)
    return drawing


def sheets(judged: JudgedSeries) -> dict[str, list[dict]]:
    """Every point: friction of both bodies, what theory has, and 1D over 3D."""
    if not judged.laws:
        return {}
    series, rows = judged.solved.series, []
    over = {body: _ratio(judged, body) for body in (ROUGH, SMOOTH)}
    for solver, laws in judged.laws.items():
        mu, smooth = (friction(judged.solved, solver, body) for body in (ROUGH, SMOOTH))
        memory, contact = (ratio(judged.solved, solver, name) for name in MEMORIES)
        for i, speed in enumerate(series.speeds):
            for j, press in enumerate(series.presses):
                row = {
                    "dimension": DIMENSIONS[solver],
                    "speed": speed,
                    f"prescribed_{series.pressed_by}": press,
                    "memory_over_shortest": memory[i, j],
                    "memory_over_contact": contact[i, j],
                    "friction_coefficient": mu.value[i, j],
                    "friction_coefficient_error": mu.error[i, j],
                    "smooth": smooth.value[i, j],
                    "low_speed": laws.slow[i, j],
                    "smooth_low_speed": laws.smooth[i, j],
                    "plateau": laws.plateau,
                    "eq_19": laws.law[i, j],
                }
                for body, each in over.items():
                    row |= {f"{body}_1d_over_3d": each.value[i, j], f"{body}_1d_over_3d_error": each.error[i, j]}
                rows.append(row)
    return {NAME: rows}


def caption(judged: JudgedSeries) -> str:
    """What the figure shows."""
    plateaus = ", ".join(f"{DIMENSIONS[solver]} {laws.plateau:.3g}" for solver, laws in judged.laws.items())
    return (
        "Above: friction against speed at the least, a middle and the greatest "
        f"{judged.solved.series.pressed_by}. Markers: rough body, means over surfaces with standard errors; "
        "thin lines: the smooth body; dotted: the exact limit of low speed of each dimensionality, from its own "
        "contact at rest; pale: Eq. 19 and its plateau, Eq. 14, with the rms slope of each dimensionality "
        f"(plateaus: {plateaus}). Below: friction in one dimension over that in three at the same point, with "
        "standard errors, rough (left) against v τ q_s and smooth (right) against v τ / a, with the mean lag τ "
        "of the solid, the highest wave number q_s and the radius a of the smooth contact at rest. Lines at 1, "
        "and at 2, to which the ratio of smooth bodies tends at low speed."
    )


def _level(axes: Axes, judged, place):
    """Curves of both dimensionalities at one load or depth."""
    speeds = np.array(judged.solved.series.speeds)
    for index, (solver, laws) in enumerate(judged.laws.items()):
        mu, smooth = (friction(judged.solved, solver, body) for body in (ROUGH, SMOOTH))
        colour, dimension = style.COLOUR[solver], DIMENSIONS[solver]
        # Dashes of one lie in the gaps of the other: the laws of both may coincide.
        law: dict[str, Any] = {"color": colour, "alpha": 0.5, "linewidth": style.width(1.1)}
        axes.plot(
            speeds,
            laws.law[:, place],
            linestyle=(6 * index, (6, 6)),
            zorder=1,
            label=f"{dimension}, Eq. 19",
            **law,
        )
        axes.axhline(laws.plateau, linestyle=(2 * index, (2, 2)), zorder=0, label=f"{dimension}, Eq. 14", **law)
        axes.errorbar(
            speeds,
            mu.value[:, place],
            yerr=np.nan_to_num(mu.error[:, place]),
            color=colour,
            marker=style.MARKER[solver],
            linestyle=style.LINE[solver],
            markersize=style.mark(0.9),
            label=f"{dimension}, rough",
        )
        axes.plot(
            speeds, smooth.value[:, place], linestyle=style.LINE[solver], color=colour,
            linewidth=style.width(0.55), alpha=0.8, label=f"{dimension}, smooth",
        )  # fmt: skip
        axes.plot(
            speeds,
            laws.slow[:, place],
            linestyle=(0, (1, 1.6 + 1.6 * index)),
            color=colour,
            linewidth=style.width(1.1),
            label=f"{dimension}, low speed",
        )


def _room(axes, judged, chosen):
    """Limits of friction: the limit of low speed leaves the panel where it no longer holds."""
    drawn = [
        friction(judged.solved, solver, body).value[:, chosen].ravel()
        for solver in judged.laws
        for body in (ROUGH, SMOOTH)
    ] + [[laws.plateau] for laws in judged.laws.values()]
    values = np.concatenate(drawn)
    values = values[values > 0]
    if values.size:
        axes.set_ylim(values.min() / 1.5, values.max() * 1.5)


def _ratio(judged, body) -> Estimated:
    one, three = (friction(judged.solved, solver, body) for solver in DIMENSIONS)
    return quotient(one, three)


def _ratios(drawing, panels: Sequence[Axes], judged):
    """Rough at left, smooth at right, a shade for each load or depth."""
    series = judged.solved.series
    unit, label = BAR[series.pressed_by]
    scale = shades.between([unit * press for press in series.presses])
    names = ("v τ q$_s$ [1]", "v τ / a [1]")
    for axes, body, memory, name in zip(panels, (ROUGH, SMOOTH), MEMORIES, names, strict=True):
        over, x = _ratio(judged, body), ratio(judged.solved, "BEM", memory)
        for level in (1, 2):
            axes.axhline(
                level,
                color=style.grey(0.6),
                linewidth=style.width(0.65),
                linestyle="-" if level == 1 else ":",
                zorder=0,
            )
        for j, press in enumerate(series.presses):
            axes.errorbar(
                x[:, j],
                over.value[:, j],
                yerr=np.nan_to_num(over.error[:, j]),
                color=shades.PRESS(scale(unit * press)),
                marker=style.SERIES_MARKERS[j % len(style.SERIES_MARKERS)],
                markersize=style.mark(0.75),
                linewidth=style.width(0.65),
                elinewidth=style.width(0.65),
            )
        axes.set(xscale="log", xlabel=name, title=body)
        axes.set_ylim(bottom=0)
    panels[0].set_ylabel("friction 1D / 3D [1]")
    shades.bar(drawing, panels, shades.PRESS, scale, label, location="right", fraction=0.04, pad=0.02)


def _pressed(judged, press):
    return EngFormatter(UNITS[judged.solved.series.pressed_by])(float(f"{press:.3g}"))
