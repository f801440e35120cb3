"""What figures of curves share: which panels there are, points with intervals, ratios, and ends of axes."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import EngFormatter
from pandas import DataFrame

from . import style
from .shades import few

# Factor and label of an axis.
AXES = {"load": (1.0, "normal force [N]"), "depth": (1e6, "depth [µm]"), "speed": (1.0, "speed [m/s]")}
UNITS = {"load": "N", "depth": "m", "rate": "m/s"}
PANELS = 3  # most of them side by side
# Below a number, a bar reaches at most to this part of it on a logarithmic axis: more of it is cut off.
LONGEST = 1 / 3


def panels_of(points: DataFrame, others: Sequence[DataFrame | None], *columns: str) -> list[tuple[str, list[Any]]]:
    """Title of each panel, and its rows of some tables, by the first of some columns that the first table has.

    Every scene has a panel; of loads, depths and rates the least, a middle and the greatest have one.
    """
    column = next((each for each in columns if each in points), None)
    if column is None:
        return [("", [points, *others])]
    titles = {place: style.literal(str(place)) for place in points[column].unique()}
    if column in UNITS:
        unit = EngFormatter(UNITS[column])
        titles = {place: unit(float(f"{place:.3g}")) if place else "at rest" for place in few([*titles], PANELS)}
    return [
        (title, [None if each is None else each[each[column] == place] for each in (points, *others)])
        for place, title in titles.items()
    ]


def tables_of(tables: Mapping[str, DataFrame | None]) -> dict[str, DataFrame]:
    """Tables that have rows."""
    return {name: each for name, each in tables.items() if each is not None and len(each)}


def intervals(axes: Axes, x: Any, points: DataFrame, name: str, times: float = 1.0, **look: Any) -> None:
    """Points with intervals of 95 %, of the columns `name` or `name`_mean, `name`_low and `name`_high.

    times : factor on all three; look : of `errorbar`
    """
    middle = "" if name in points else "_mean"
    value, low, high = (times * points[f"{name}{end}"].to_numpy(float) for end in (middle, "_low", "_high"))
    axes.errorbar(x, value, yerr=style.bars(value, low, high), **look)


def curve(axes: Axes, points: DataFrame, across: str, name: str, times: float = 1.0, **look: Any) -> None:
    """Points along an axis with intervals, and crosses on it without an answer. look : with colour and label"""
    points = points.sort_values(across)
    x, value = AXES.get(across, (1.0, ""))[0] * points[across], points[name if name in points else f"{name}_mean"]
    intervals(axes, x, points, name, times, **look)
    if (missing := x[~np.isfinite(value)]).size:
        crosses = {"color": look["color"], "label": f"{look['label']}: no answer", "clip_on": False}
        axes.plot(missing, 0 * missing, "x", transform=axes.get_xaxis_transform(), **crosses)


def compared(
    axes: Axes, table: DataFrame, across: str, name: str, level: float | None, times: float = 1.0
) -> None:
    """Every model on each body, hollow on the smooth one, about a level if there is one."""
    if level is not None:
        axes.axhline(level, **style.line(0.6, 0.55))
    for (model, body), own in table.groupby(["model", "body"], sort=False):
        smooth = {"label": f"{style.label(str(model))}, smooth", "markerfacecolor": style.paper()}
        curve(axes, own, across, name, times, **style.look(str(model), **smooth if body == "smooth" else {}))


def over(table: DataFrame) -> str:
    """What stands over what in ratios."""
    return "1D / 3D" if set(table["model"]) <= {"MDR", "BEM", "exact"} else "over reference"


def limit(axes: Axes, points: DataFrame, name: str) -> None:
    """Ends of a logarithmic vertical axis around numbers and their intervals, whatever else is drawn."""
    value = points[name if name in points else f"{name}_mean"]
    value = value.where(value > 0)
    low = points[f"{name}_low"].fillna(value).clip(lower=LONGEST * value)
    high = points[f"{name}_high"].fillna(value)
    if value.notna().any():
        axes.set_ylim(low.min() / 1.2, high.max() * 1.2)
