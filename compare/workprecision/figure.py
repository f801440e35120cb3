"""Error against processor time: a panel for each scene and quantity, the points of grids written at the curves."""

from collections.abc import Iterator
from itertools import groupby
from math import ceil, isfinite
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ..figures import style
from ..figures.curves import scatter
from ..figures.lettering import Letter, lettered, literal, write
from ..figures.prefixes import prefixed
from ..report.page import Tables
from .errors import INTERVAL, Way

COLUMNS, HEIGHT, AROUND = 2, 2.5, 0.7  # of panels; of one, and around all [inch]
LEAST, WHOLE = 1e-6, 1.0  # errors beyond which they are drawn there
MARKED = 10.0 ** np.arange(5)  # numbers of surfaces
FORECAST = (0, (3, 2))  # dashes beyond the surfaces that were solved
BAND = 0.88  # between ink and paper


def figure(tables: Tables) -> Figure:
    """Panels on the same axes, and one legend below."""
    (table,) = tables.values()
    every = [Way(**row) for row in table.fillna({"settings": "", "reason": ""}).to_dict("records")]
    drawn = [list(own) for _, own in groupby(every, lambda way: (way.case, way.quantity))]
    columns, rows = min(COLUMNS, len(drawn)), ceil(len(drawn) / COLUMNS)
    drawing = style.canvas("double", rows * HEIGHT + AROUND)
    grid = drawing.subplots(rows, columns, sharex=True, sharey=True, squeeze=False).ravel()
    for axes in grid[len(drawn) :]:
        axes.remove()
    panels = grid[: len(drawn)]
    panels[0].set(xscale="log", yscale="log")
    for axes, ways in zip(panels, drawn, strict=True):
        axes.set_title(f"{literal(ways[0].case)}: {ways[0].quantity}")
        _draw(axes, ways)
    lettered(panels)
    times, unit = _limits(panels, any(not isfinite(way.bias) for way in every))
    for axes in panels:
        axes.label_outer()
        axes.set(xlabel=f"processor time [{unit}]", ylabel="relative error [1]")
        axes.label_outer()
    for axes, ways in zip(panels, drawn, strict=True):
        _written(axes, ways, columns)
    style.decades(*panels)
    panels[0].xaxis.set_major_formatter(lambda value, _: f"{times * value:g}")
    labels = {way.model: way.label for way in every if isfinite(way.bias)}
    handles: list[Any] = [Line2D([], [], **_look(*each)) for each in labels.items()]
    if any(way.settings == INTERVAL for way in every):
        handles.append(Line2D([], [], **_thick(), label="3D on several grids, as by --interval"))
    handles.append(Patch(color=style.grey(BAND), linewidth=0, label="error of the reference"))
    style.legend(drawing, handles, "outside lower center", 4)
    style.lay_out(drawing)
    for axes, ways in zip(panels, drawn, strict=True):
        write(axes, list(_letters(ways)), style.tiny())
    return drawing


def _look(model: str, label: str = "") -> dict[str, Any]:
    return style.look(model, label=style.LABEL.get(model, label), markersize=style.mark())


def _thick() -> dict[str, Any]:
    return {"color": style.ink(), "linewidth": style.width(1.6)}


def _curves(ways: list[Way]) -> Iterator[tuple[str, list[Way]]]:
    """Ways of each model that are drawn: each grid of 3D or of a smooth scene, the finest of others."""
    known = [way for way in ways if isfinite(way.bias) and way.settings != INTERVAL]
    for model, group in groupby(known, lambda way: way.model):
        own = list(group)
        yield model, own if model == "BEM" or not own[0].scatter else own[:1]


def _draw(axes: Axes, ways: list[Way]) -> None:
    for model, own in _curves(ways):
        look, hidden = _look(model), 0.0 if model == "BEM" and own[0].scatter else own[0].reference_error
        counts = MARKED if own[0].scatter else np.ones(1)
        if not own[0].scatter:
            _line(axes, [way.seconds(1) for way in own], [way.error(1) for way in own], look)
        colours = (
            style.shades(model, len(own))[::-1] if own[0].scatter and len(own) > 1 else [look["color"]] * len(own)
        )
        for way, colour in zip(own, colours, strict=True):
            look["color"] = colour
            if way.scatter:
                solved, all_ = np.geomspace(1, way.surfaces, 60), np.geomspace(way.surfaces, MARKED[-1], 60)
                for count, line in ((solved, "-"), (all_, FORECAST)):
                    _line(axes, way.seconds(count), way.error(count), look | {"linestyle": line})
            errors = np.asarray(way.error(counts))
            marks = {"marker": look["marker"], "zorder": 3}
            scatter(axes, way.seconds(counts), _shown(errors), ~(errors <= hidden), colour, 1, 1, **marks)
    for way in ways:
        if way.settings == INTERVAL:
            count = np.geomspace(1, MARKED[-1], 100)
            axes.plot(way.seconds(count), _shown(way.error(count)), **_thick(), zorder=4)


def _line(axes, times, errors, look):
    axes.plot(times, _shown(errors), **look | {"marker": ""})


def _shown(errors):
    return np.clip(errors, LEAST, WHOLE)


def _limits(panels, failed):
    """Limits of all panels, with room for what is written; factor and unit of times. failed : whether any has"""
    at = np.concatenate([line.get_xydata() for axes in panels for line in axes.lines])
    (left, low), (right, high) = np.nanmin(at, axis=0), np.nanmax(at, axis=0)
    panels[0].set(xlim=(left / 1.6, right * 1.6), ylim=(low / (12 if failed else 2.5), high * 2))
    return prefixed([min(right, 1.0)], "s")


def _written(axes, ways, columns):
    """Band of the error of the reference, and settings without an answer."""
    error, least = (
        max((way.reference_error for way in ways if isfinite(way.reference_error)), default=0.0),
        LEAST / 100,
    )
    axes.axhspan(least, max(error, least), color=style.grey(BAND), zorder=0, linewidth=0)
    if failed := [f"{way.label} {way.settings}".strip() for way in ways if not isfinite(way.bias)]:
        text = style.fill(f"no answer: {', '.join(failed)}", style.across("double") / columns - 1, style.tiny())
        look: dict[str, Any] = {"fontsize": style.tiny(), "color": style.grey(0.3), "va": "bottom"}
        axes.text(0.02, 0.02, text, transform=axes.transAxes, **look)


def _letters(ways: list[Way]) -> Iterator[Letter]:
    """Points of grids at the ends of curves of smooth scenes, and at the last surfaces of rough ones."""
    for model, own in _curves(ways):
        for way in own if own[0].scatter else own[:: max(1, len(own) - 1)]:
            count, text = MARKED[-1] if way.scatter else 1.0, way.settings.partition(" ")[0]
            yield Letter(text, (way.seconds(count), float(_shown(way.error(count)))), style.COLOUR[model])
