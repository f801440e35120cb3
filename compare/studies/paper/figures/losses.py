"""Forms of Eq. 22, with the loss of one wave or of every wave at its own frequency, against the simulation."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from pandas import DataFrame, concat

from ....report.page import Plot, Tables
from ....report.plots import style
from ....report.plots.curves import scatter
from ....report.plots.lettering import lettered

NAME = "paper-losses"
# Markers of the forms of Eq. 22.
FORMS = {"shortest_wave": "s", "every_wave": "o", "every_wave_and_smooth_body": "^"}
LINES = ("-", "--", ":")


def plot(rubbers: Sequence[DataFrame]) -> Plot | None:
    """The plot of the points of some rubbers; None without any."""
    if not rubbers:
        return None
    told = []
    for points in rubbers:
        ranges = ", ".join(
            f"{_words(form)} {low:+.1%} to {high:+.1%}"
            for form in FORMS
            for low, high in [(points[form] / points["simulated"] - 1).agg(["min", "max"])]
        )
        told.append(f"{_title(points)}: {ranges}")
    return Plot(
        NAME,
        figure,
        {NAME: concat(rubbers, ignore_index=True)},
        "How far Eq. 22 is off the simulated friction at three speeds: with the loss of the shortest wave for "
        "all waves, as published; of every wave at its own frequency; and with the friction of the smooth "
        "sphere added, as Eq. 22 leaves the macroscopic slope out. Hollow: a condition breaks, as a constant "
        "modulus |G(v/a)|.",
        f"Deviations of the forms of Eq. 22. {'; '.join(told)}.",
    )


def figure(tables: Tables) -> Figure:
    """A panel for each rubber: each form over the simulation, at three speeds."""
    every = tables[NAME]
    rubbers = [points for _, points in every.groupby(["loss_exponent", "relaxation_time"], sort=False)]
    speeds = np.unique(every["speed"])
    shown = speeds[[0, speeds.size // 2, -1]]
    rows = -(-len(rubbers) // 2)
    drawing = style.canvas("double", 0.7 + 2.3 * rows)
    panels = drawing.subplots(rows, 2, sharex=True, sharey="row", squeeze=False)
    for axes, points in zip(panels.flat, rubbers, strict=False):
        for name, colour, marker in _forms():
            for speed, line in zip(shown, LINES, strict=True):
                own = points[points["speed"] == speed]
                load, off = own["normal_force"], 100 * (own[name] / own["simulated"] - 1)
                axes.plot(load, off, line, color=colour, linewidth=style.width(0.8))
                scatter(axes, load, off, own["holds"] == 1, colour, 0.8, 0.7, marker=marker, zorder=2.5)
        axes.axhline(0, **style.line(0.3, 0.65, zorder=0))
        axes.set(xscale="log", title=_title(points))
        style.span(axes, points["normal_force"])
        style.decades(axes)
    for axes in panels.flat[len(rubbers) :]:
        axes.set_axis_off()
    for axes in panels[:, 0]:
        axes.set_ylabel("Eq. 22 / simulation - 1 [%]")
    for axes in panels[-1]:
        axes.set_xlabel("normal force [N]")
    forms = [
        Line2D([], [], color=colour, marker=marker, markersize=style.mark(0.75), label=_words(name))
        for name, colour, marker in _forms()
    ]
    lines = [
        Line2D([], [], color=style.grey(0.2), linestyle=line, label=f"{speed:.2g} m/s")  # type: ignore[arg-type]
        for speed, line in zip(shown, LINES, strict=True)
    ]
    lettered(panels.flat[: len(rubbers)])
    pairs = [handle for pair in zip(forms, lines, strict=True) for handle in pair]
    style.legend(drawing, pairs, "outside lower center", 3)
    return drawing


def _title(points):
    first = points.iloc[0]
    return f"β = {first['loss_exponent']:g}, τ = {first['relaxation_time']:g} s"


def _words(form):
    return form.replace("_", " ")


def _forms():
    """Name, colour and marker of each form."""
    return zip(FORMS, (style.ink(), "#CC79A7", "#009E73"), FORMS.values(), strict=True)
