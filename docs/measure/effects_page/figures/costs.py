"""Processor time of each effect, over that of the contact that it comes on top of."""

import numpy as np
from matplotlib.figure import Figure

from compare.report.plots import style

NAME = "effect-costs"
# Distance from the middle of a row at which each dimensionality is drawn.
ASIDE = {"3D": -0.14, "1D": 0.14}
SOLVERS = {"3D": "BEM", "1D": "MDR"}
ROW = 0.26


def figure(data) -> Figure | None:
    """A row an effect, a mark a dimensionality; data: rows of the chapter on costs. None if nothing was solved."""
    shown = [row for row in data if row["over"]]
    if not any(np.isfinite(row["times"]) for row in shown):
        return None
    names = list(dict.fromkeys(row["effect"] for row in shown))
    drawing = style.canvas("double", 0.9 + ROW * len(names))
    axes = drawing.subplots()
    axes.axvline(1, color=style.grey(0.45), linewidth=style.width(0.8), zorder=1)
    for dimension, solver in SOLVERS.items():
        rows = [row for row in shown if row["dimension"] == dimension]
        axes.plot(
            [row["times"] for row in rows],
            [names.index(row["effect"]) + ASIDE[dimension] for row in rows],
            color=style.COLOUR[solver],
            marker=style.MARKER[solver],
            linestyle="none",
            label=style.LABEL[solver],
            zorder=3,
        )
        for row in rows:
            if row["reason"]:
                word = "refused" if row["reason"].startswith("refused") else "failed"
                place = names.index(row["effect"]) + ASIDE[dimension]
                axes.annotate(
                    word, (1, place), (6, 0), textcoords="offset points", va="center", fontsize=style.tiny()
                )
                axes.texts[-1].set_color(style.COLOUR[solver])
    axes.set_xscale("log")
    style.span(axes, [0.8, *(row["times"] for row in shown)])
    style.decades(axes)
    axes.set(ylim=(len(names) - 0.5, -0.5), xlabel="processor time over that without the effect [1]")
    on_top = {row["effect"]: row["over"] for row in shown}
    axes.set_yticks(range(len(names)), [f"{name}  (on {on_top[name]})" for name in names], fontsize=style.small())
    axes.tick_params(axis="y", length=0)
    axes.grid(axis="y", color=style.grey(0.92), linewidth=style.width(0.45))
    style.legend(drawing, axes.get_legend_handles_labels()[0], "outside upper right", 2, handletextpad=0.2)
    return drawing
