"""What figures of curves share: which panels and curves there are, ends of axes, ratios, and the legend below."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import EngFormatter
from pandas import DataFrame

from . import shades, style
from .curves import intervals, unanswered
from .lettering import literal

# Factor and label of an axis.
AXES = {"load": (1.0, "normal force [N]"), "depth": (1e6, "depth [µm]"), "speed": (1.0, "speed [m/s]")}
UNITS = {"load": "N", "depth": "m", "rate": "m/s"}
# Most panels side by side, and most curves in a panel.
PANELS, CURVES = 3, 8
# Below a number, a bar reaches at most to this part of it on a logarithmic axis: more of it is cut off.
LONGEST = 1 / 3


def few(values: Any, most: int) -> np.ndarray:
    """As many values as are told apart, from the least to the greatest."""
    values = np.unique(values)
    return values[np.unique(np.linspace(0, len(values) - 1, min(most, len(values))).round().astype(int))]


def panels_of(points: DataFrame, *columns: str) -> dict[Any, tuple[str, DataFrame]]:
    """Title and rows of each panel, by the first of some columns that a table has; all rows without any.

    Every scene has a panel; of loads, depths and rates the least, a middle and the greatest have one.
    """
    column = next((each for each in columns if each in points), None)
    if column is None:
        return {None: ("", points)}
    told = EngFormatter(UNITS.get(column, ""))
    numbers = column in UNITS
    places = few(points[column], PANELS).tolist() if numbers else points[column].unique()
    return {
        place: ((told(float(f"{place:.3g}")) if place else "at rest") if numbers else literal(str(place)), own)
        for place in places
        for own in [points[points[column] == place]]
    }


def at(table: DataFrame, place: Any, *columns: str) -> DataFrame:
    """Rows of another table that belong to a panel."""
    column = next((each for each in columns if each in table), None)
    return table if column is None or place is None else table[table[column] == place]


def limit(axes: Axes, points: DataFrame, name: str) -> None:
    """Ends of a logarithmic vertical axis around numbers and their intervals, whatever else is drawn."""
    value = points[name if name in points else f"{name}_mean"]
    value = value.where(value > 0)
    low = points[f"{name}_low"].fillna(value).clip(lower=LONGEST * value)
    high = points[f"{name}_high"].fillna(value)
    if value.notna().any():
        axes.set_ylim(low.min() / 1.2, high.max() * 1.2)


def tables_of(tables: Mapping[str, DataFrame | None]) -> dict[str, DataFrame]:
    """Tables that have rows."""
    return {name: each for name, each in tables.items() if each is not None and len(each)}


def over(table: DataFrame) -> str:
    """What stands over what in ratios."""
    return "1D / 3D" if set(table["model"]) <= {"MDR", "BEM", "exact"} else "over reference"


def curve(axes: Axes, points: DataFrame, across: str, name: str, times: float = 1.0, **look: Any) -> None:
    """Points along an axis with intervals, and crosses without an answer. look : of `errorbar`, with a colour"""
    points = points.sort_values(across)
    x = AXES.get(across, (1.0, ""))[0] * points[across]
    intervals(axes, x, points, name, times, **look)
    unanswered(axes, x, points[name if name in points else f"{name}_mean"], look["color"], look["label"] or "")


def compared(axes: Axes, table: DataFrame, across: str, name: str, level: float, times: float = 1.0) -> None:
    """Models against the reference: filled of rough bodies, hollow and dotted of smooth ones, about a level."""
    axes.axhline(level, **style.line(0.6, 0.55))
    several = table["model"].nunique() > 1
    for (model, body), own in table.groupby(["model", "body"], sort=False):
        look: dict[str, Any] = {"color": style.COLOUR[str(model)] if several else style.ink(), "marker": "o"}
        look |= {"label": None if several else f"{over(table)}, {body}", "markersize": style.mark(0.9)}
        if body == "smooth":
            look |= {"marker": "D", "linestyle": ":", "markerfacecolor": style.paper()}
        curve(axes, own, across, name, times, **look)


def speed_key(drawing: Figure, panels: Any, speeds: Any, label: str) -> list[Line2D]:
    """Entries of a legend for the shades of up to CURVES speeds; more have a bar below the panels."""
    scale = shades.between(speeds)
    if len(speeds) > CURVES:
        shades.bar(drawing, panels, shades.SPEED, scale, label, location="bottom", aspect=60, shrink=0.7, pad=0.02)
        return []
    return [entry(f"{each:.3g} m/s", color=shades.SPEED(scale(each))) for each in speeds]


def entry(label: str, **look: Any) -> Line2D:
    """Entry of a legend: a marker."""
    return Line2D(
        [], [], **({"marker": "o", "linestyle": "none", "color": style.grey(0.3), "label": label} | look)
    )


def legend(drawing: Figure, panels: Iterable[Axes], most: int, *more: Any, **other: Any) -> None:
    """Below all panels, each label once. more : artists that are named first"""
    handles = [*more, *(each for axes in panels for each in axes.get_legend_handles_labels()[0])]
    entries = {each.get_label(): each for each in reversed(handles)}
    style.legend(drawing, list(reversed(entries.values())), "outside lower center", most, **other)
