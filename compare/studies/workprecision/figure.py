"""Error against processor time: a panel for each scene and quantity, the points of grids written at the curves."""

from collections.abc import Iterator, Sequence
from itertools import groupby
from math import ceil, isfinite
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ...figures import style
from ...figures.plot import Tables
from .errors import INTERVAL, Way

COLUMNS, HEIGHT, AROUND = 2, 2.5, 0.7  # columns of panels; height of each panel and around all [inch]
LEAST, WHOLE = 1e-6, 1.0  # errors beyond which they are drawn there
MARKED = 10.0 ** np.arange(4)  # numbers of surfaces
BAND = 0.88  # between ink and paper


def figure(tables: Tables) -> Figure:
    """Panels on the same axes, and one legend below."""
    (table,) = tables.values()
    texts = table[["settings", "reason"]].astype(object).fillna("").replace("nan", "")
    every = [Way(**row) for row in table.assign(**texts).to_dict("records")]
    drawn = [list(own) for _, own in groupby(every, lambda way: (way.case, way.quantity))]
    columns, rows = min(COLUMNS, len(drawn)), ceil(len(drawn) / COLUMNS)
    drawing = style.canvas("double", rows * HEIGHT + AROUND)
    panels = drawing.subplots(rows, columns, sharex=True, sharey=True, squeeze=False).ravel()
    for axes in panels[len(drawn) :]:
        axes.remove()
    panels = panels[: len(drawn)]
    for k, (axes, ways) in enumerate(zip(panels, drawn, strict=True)):
        title = f"{style.literal(ways[0].case)}: {ways[0].quantity}"
        axes.set(xscale="log", yscale="log", title=title, ylabel="relative error [1]" if k % columns == 0 else "")
        if k + columns >= len(drawn):
            axes.set_xlabel("processor time [s]")
            axes.tick_params(labelbottom=True)
        _draw(axes, ways)
    style.lettered(panels)
    at = np.concatenate([line.get_xydata() for axes in panels for line in axes.lines])
    (left, low), (right, high) = np.nanmin(at, axis=0), np.nanmax(at, axis=0)
    panels[0].set(xlim=(left / 1.6, right * 1.6), ylim=(low / 2.5, high * 2))
    style.decades(*panels)
    labels = {way.model: way.label for way in every if isfinite(way.bias)}
    handles: list[Any] = [Line2D([], [], **_look(*each)) for each in labels.items()]
    if any(way.settings == INTERVAL for way in every):
        handles.append(Line2D([], [], **_thick(), label="3D on several grids, as by --interval"))
    handles.append(Patch(color=style.grey(BAND), linewidth=0, label="error of the reference"))
    style.legend(drawing, (), 4, *handles)
    return drawing


def _look(model: str, label: str = "") -> dict[str, Any]:
    return style.look(model, label=style.LABEL.get(model, label))


def _thick() -> dict[str, Any]:
    return {"color": style.ink(), "linewidth": style.width(1.6)}


def _curves(ways: Sequence[Way]) -> Iterator[tuple[Way, Any]]:
    """Ways that are drawn, with their colours: each grid of 3D or of a smooth scene, the finest of others."""
    known = [way for way in ways if isfinite(way.bias) and way.settings != INTERVAL]
    for model, group in groupby(known, lambda way: way.model):
        own = list(group)
        if own[0].scatter and model == "BEM" and len(own) > 1:
            yield from zip(own, style.shades(model, len(own))[::-1], strict=True)
        else:
            yield from ((way, style.colour(model)) for way in (own[:1] if own[0].scatter else own))


def _draw(axes: Axes, ways: Sequence[Way]) -> None:
    """Curves, and the error of the reference."""
    curves = list(_curves(ways))
    grids = [way for way, _ in curves if way.model == "BEM"]
    for way, colour in curves:
        look = _look(way.model) | {"color": colour}
        x, y = _at(way, MARKED if way.scatter else MARKED[:1])
        axes.plot(x, y, **look)
        if way in grids[:: len(grids) - 1 or 1]:
            axes.annotate(
                way.settings.partition(" ")[0], (x[0], y[0]), (0, 4), textcoords="offset points", color=colour,
                fontsize=style.small(), ha="left" if way is grids[0] else "right",
            )  # fmt: skip
    for model, group in groupby((way for way, _ in curves if not way.scatter), lambda way: way.model):
        at = [_at(way, MARKED[:1]) for way in group]
        axes.plot(*np.concatenate(at, axis=1), **_look(model) | {"marker": ""})
    for way in (way for way in ways if way.settings == INTERVAL):
        axes.plot(*_at(way, MARKED), **_thick(), zorder=4)
    error = max((way.reference_error for way in ways if isfinite(way.reference_error)), default=0.0)
    axes.axhspan(LEAST / 100, max(error, LEAST / 100), color=style.grey(BAND), zorder=0, linewidth=0)


def _at(way: Way, counts: np.ndarray) -> np.ndarray:
    """Times and errors (2, N) of numbers of surfaces."""
    return np.array([way.seconds(counts), np.clip(way.error(counts), LEAST, WHOLE)])
