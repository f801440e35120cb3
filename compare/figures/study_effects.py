"""How far each claim on one series is from what was measured, in tolerances, with both errors."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..finding import Finding
from ..studies.judgement import JudgedSeries
from ..studies.question import BOTH
from ..studies.tableau import DIMENSIONS, claims
from ..plots import style

NAME = "study-effects"
SOLVER = {"1D": "MDR", "3D": "BEM", BOTH: "exact"}
MARKER = {"1D": "o", "3D": "s", BOTH: "D"}
# Of a row: how far above and below its middle both dimensionalities are drawn.
ABOVE = {"1D": -0.17, "3D": 0.17, BOTH: 0.0}
# In tolerances, where the axis ends; what lies beyond is an arrow there.
END = 100.0
# Height of a row for text of 8 points [inch], and of the width, for the claims.
ROW, CLAIMS = 0.4, 0.38


def figure(judged: JudgedSeries) -> Figure | None:
    """A row a claim, with verdicts at right. None without findings."""
    alone, both = claims(judged.findings)
    asked = [*alone, *both]
    if not asked:
        return None
    drawing = style.canvas("double", 0.9 + ROW * len(asked))
    axes = drawing.subplots()
    axes.axvspan(-1, 1, color=style.grey(0.9), linewidth=0, zorder=0)
    axes.axvline(0, color=style.grey(0.45), linewidth=style.width(0.8), zorder=1)
    if alone and both:
        axes.axhline(len(alone) - 0.5, color=style.ink(), linewidth=style.width(0.45))
    for row, claim in enumerate(asked):
        for found in (each for each in judged.findings if each.claim == claim):
            _row(axes, row + ABOVE[found.dimension], found)
    axes.set_xscale("symlog", linthresh=1, linscale=0.7)
    axes.set(xlim=(-END, END), ylim=(len(asked) - 0.5, -0.5), xlabel="measured less claimed, in tolerances [1]")
    ticks = [sign * 10**power for power in (2, 1, 0) for sign in (-1, 1)]
    axes.set_xticks([0, *ticks], [f"{tick:g}" for tick in (0, *ticks)])
    axes.set_xticks([], minor=True)
    axes.set_yticks(
        range(len(asked)),
        [style.fill(claim, CLAIMS * drawing.get_figwidth(), style.small()) for claim in asked],
        fontsize=style.small(),
    )
    axes.tick_params(axis="y", length=0)
    for dimension in (*DIMENSIONS, BOTH):
        if any(found.dimension == dimension for found in judged.findings):
            axes.plot([], [], label=dimension, **_look(dimension))
    style.legend(drawing, axes.get_legend_handles_labels()[0], "outside upper right", 3, handletextpad=0.2)
    return drawing


def sheets(judged: JudgedSeries) -> dict[str, list[dict]]:
    """Every finding."""
    return {NAME: [found.row for found in judged.findings]} if judged.findings else {}


def caption(judged: JudgedSeries) -> str:
    """What the figure shows."""
    return (
        "What was measured less what is claimed, over the tolerance, whose band is grey; beyond one the axis is "
        "logarithmic. Thick: intervals of 95 % from the scatter of surfaces; thin: wider by the change from "
        "half the points to all. Hollow: undecided. Without a thick line the scatter is not known, without a "
        f"thin one the error of discretisation. An arrow stands for what lies beyond {END:g} tolerances."
    )


def _look(dimension):
    return {"color": style.COLOUR[SOLVER[dimension]], "marker": MARKER[dimension], "linestyle": "none"}


def _row(axes: Axes, y, found: Finding):
    look = _look(found.dimension)
    for ends, width in ((found.interval, 0.65), (found.statistical, 2.0)):
        low, high = ((end - found.expected) / found.tolerance for end in ends)
        if np.isfinite(low) and np.isfinite(high):
            axes.plot(
                np.clip([low, high], -END, END),
                [y, y],
                color=look["color"],
                linewidth=style.width(width),
                zorder=2,
            )
    inside = style.paper() if found.verdict == "undecided" else look["color"]
    if abs(found.effect) <= END:
        axes.plot(found.effect, y, markersize=style.mark(), markerfacecolor=inside, zorder=3, **look)
    elif np.isfinite(found.effect):
        beyond = look | {"marker": ">" if found.effect > 0 else "<"}
        axes.plot(
            np.sign(found.effect) * END,
            y,
            markerfacecolor=inside,
            markersize=style.mark(1.25),
            clip_on=False,
            zorder=3,
            **beyond,
        )
    axes.annotate(
        found.verdict,
        (1.02, y),
        xycoords=("axes fraction", "data"),
        fontsize=style.tiny(),
        va="center",
        color=look["color"],
    )
