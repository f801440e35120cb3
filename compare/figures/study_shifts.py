"""Shifts of the curves of one series against speed: horizontal against theory, and vertical ones beside them."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..statistics.jackknife import Estimated
from ..studies.judgement import JudgedSeries
from ..studies.question import TOLERANCE
from ..studies.shiftclaims import inseparable
from ..verdict import DIMENSIONS
from ..plots import style
from ..plots.lettering import clear

NAME = "study-shifts"
# Neighbouring markers are drawn apart by this factor of the speed, either way.
APART = 1.05


def figure(judged: JudgedSeries) -> Figure | None:
    """Left: b_v. Middle: b_v less what theory has. Right: c_v. None without curves that could be shifted."""
    if not judged.shiftings:
        return None
    drawing = style.canvas("double", 2.7)
    left, middle, right = drawing.subplots(1, 3)
    for index, (solver, found) in enumerate(judged.shiftings.items()):
        expected, apart = predicted(judged, solver), APART ** (2 * index - 1)
        shifts, vertical = found.horizontal.horizontal, found.both.vertical
        over = Estimated(shifts.value - expected, shifts.error, shifts.freedom)
        for axes, numbers in ((left, shifts), (middle, over), (right, vertical)):
            _draw(axes, found.speeds * apart, numbers, solver)
        look = {"color": style.COLOUR[solver], "marker": style.MARKER[solver], "linestyle": "none"}
        left.plot([], [], label=f"{DIMENSIONS[solver]}, {_power(found)}", **look)
    left.plot(
        found.speeds,
        expected,
        "-",
        color=style.grey(0.45),
        linewidth=style.width(0.8),
        zorder=1,
        label="theory, ln p(v)",
    )
    middle.axhline(0, color=style.grey(0.45), linewidth=style.width(0.8), zorder=1)
    right.axhspan(-TOLERANCE, TOLERANCE, color=style.grey(0.9), linewidth=0, zorder=0)
    right.axhline(0, color=style.grey(0.45), linewidth=style.width(0.8), zorder=1)
    left.set(ylabel="horizontal shift $b_v$ [1]", title="(a)")
    middle.set(ylabel="$b_v$ less ln p(v) [1]", title="(b)")
    right.set(ylabel="vertical shift $c_v$, both fitted [1]", title="(c)")
    left.legend(loc="best", handlelength=1.4)
    for axes in (left, middle, right):
        axes.set(xscale="log", xlabel="speed [m/s]")
        style.span(axes, judged.solved.series.speeds)
        style.decades(axes)
    clear(drawing, (left,))
    return drawing


def sheets(judged: JudgedSeries) -> dict[str, list[dict]]:
    """Shifts with standard errors, alone and side by side."""
    rows = []
    for solver, found in judged.shiftings.items():
        columns = {
            "horizontal": found.horizontal.horizontal,
            "horizontal_beside_vertical": found.both.horizontal,
            "vertical_beside_horizontal": found.both.vertical,
            "vertical": found.vertical.vertical,
        }
        for index, (speed, theory) in enumerate(zip(found.speeds, predicted(judged, solver), strict=True)):
            row = {"dimension": DIMENSIONS[solver], "speed": speed, "theory": theory}
            for name, numbers in columns.items():
                row |= {
                    name: numbers.value[index],
                    f"{name}_error": np.broadcast_to(numbers.error, found.speeds.shape)[index],
                }
            rows.append(row)
    return {NAME: rows} if rows else {}


def caption(judged: JudgedSeries) -> str:
    """What the figure shows."""
    said = " ".join(f"{DIMENSIONS[solver]}: {_said(found)}" for solver, found in judged.shiftings.items())
    return (
        "Shifts that bring the curves of friction onto one, against speed, zero at the middle speed, with "
        "intervals of 95 % over the surfaces. (a) Along ln F_N alone, b_v, and ln p(v) of Eq. 22 (line). (b) "
        "Their difference. (c) Along ln μ, c_v, where both are fitted together; the band is the tolerance, "
        f"{TOLERANCE:g}. Points are drawn apart along the speed. {said}"
    )


def predicted(judged: JudgedSeries, solver: str) -> np.ndarray:
    """ln p(v) of the speeds that were shifted, zero at their middle one."""
    found = judged.shiftings[solver]
    places = [judged.solved.series.speeds.index(speed) for speed in found.speeds.tolist()]
    shifts = judged.laws[solver].shifts[places]
    return shifts - shifts[len(shifts) // 2]


def _draw(axes: Axes, x, numbers: Estimated, solver):
    low, high = (np.broadcast_to(end, x.shape) for end in numbers.interval())
    bars = np.nan_to_num(np.abs([numbers.value - low, high - numbers.value]))
    axes.errorbar(
        x, numbers.value, yerr=bars, color=style.COLOUR[solver], marker=style.MARKER[solver], linestyle="none"
    )


def _power(found):
    """Of the speed, that the horizontal shifts go as."""
    return "undecided" if found.horizontal.reason else f"$v^{{{found.horizontal.exponent.value:.2f}}}$"


def _said(found):
    if found.horizontal.reason:
        return f"undecided, {found.horizontal.reason}."
    if why := inseparable(found):
        return f"{why}."
    low, high = found.both.raised.interval()
    return f"rms of c_v {found.both.raised.value:.3f} ({low:.3f} to {high:.3f})."
