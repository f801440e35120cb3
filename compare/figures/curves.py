"""Points with intervals along an axis, a curve for each model or other value of a column."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import EngFormatter
from pandas import DataFrame

from . import style
from .shades import few

# Factor and label of an axis.
AXES = {"load": (1.0, "normal force [N]"), "depth": (1e6, "depth [µm]"), "speed": (1.0, "speed [m/s]")}
AXES |= {"shortest": (1e6, "shortest wave [µm]")}
UNITS = {"load": "N", "depth": "m", "rate": "m/s", "speed": "m/s"}
PANELS = 3  # most of them side by side
# Below a number, a bar reaches at most to this part of it on a logarithmic axis: more of it is cut off.
LONGEST = 1 / 3


def panels_of(points: DataFrame, others: Sequence[DataFrame | None], *columns: str) -> list[tuple[str, list[Any]]]:
    """Title of each panel, and its rows of some tables, by the first of some columns that the first table has.

    The least load, depth, rate or speed, a middle one and the greatest have a panel.
    """
    column = next((each for each in columns if each in points), None)
    if column is None:
        return [("", [points, *others])]
    return [
        (
            _title(column, place),
            [None if each is None else each[each[column] == place] for each in (points, *others)],
        )
        for place in few(points[column], PANELS)
    ]


def _title(column: str, place: Any) -> str:
    return EngFormatter(UNITS[column])(float(f"{place:.3g}")) if place else "at rest"


def tables_of(tables: Mapping[str, DataFrame | None]) -> dict[str, DataFrame]:
    """Tables that have rows."""
    return {name: each for name, each in tables.items() if each is not None and len(each)}


def intervals(axes: Axes, x: Any, points: DataFrame, name: str, times: float = 1.0, **look: Any) -> None:
    """Points with intervals of 95 %, of the columns `name` or `name`_mean, `name`_low and `name`_high.

    times : factor on all three; look : of `errorbar`. A number with an unknown end has no bar.
    """
    value, low, high = (
        times * points[f"{name}{end}"].to_numpy(float) for end in (_middle(points, name), "_low", "_high")
    )
    axes.errorbar(x, value, yerr=np.maximum([value - low, high - value], 0.0), **look)


def curves(
    axes: Axes,
    points: DataFrame,
    across: str,
    name: str,
    times: float = 1.0,
    by: Sequence[str] = ("model",),
    look: Callable[..., dict[str, Any]] = style.look,
) -> None:
    """Points with intervals, as a curve for each value of some columns, and crosses on the axis without an answer.

    by, look : columns that tell curves apart, and the settings of `errorbar` as a function of their values
    """
    for values, own in points.sort_values(across).groupby([*by], sort=False):
        x, settings = AXES.get(across, (1.0,))[0] * own[across], look(*values)
        intervals(axes, x, own, name, times, **settings)
        missing = x[own[f"{name}{_middle(own, name)}"].isna()]
        if len(missing) and "label" in settings:
            crosses = {"color": settings["color"], "label": f"{settings['label']}: no answer", "clip_on": False}
            axes.plot(missing, 0 * missing, "x", transform=axes.get_xaxis_transform(), **crosses)


def of_body(model: str, body: str) -> dict[str, Any]:
    """Look of a model on a body, hollow on the smooth one."""
    hollow = {"label": f"{style.label(model)}, smooth", "markerfacecolor": style.paper()}
    return style.look(model, **hollow if body == "smooth" else {})


def about(axes: Axes, level: float, table: DataFrame, across: str, name: str, times: float = 1.0) -> None:
    """Every model on each body about a level."""
    axes.axhline(level, **style.line(0.6, 0.55))
    curves(axes, table, across, name, times, ("model", "body"), of_body)


def over(table: DataFrame) -> str:
    """What stands over what in ratios."""
    return "1D / 3D" if set(table["model"]) <= {"MDR", "BEM", "exact"} else "over reference"


def limit(axes: Axes, points: DataFrame, name: str) -> None:
    """Ends of a logarithmic vertical axis around numbers and their intervals, whatever else is drawn."""
    value = points[f"{name}{_middle(points, name)}"]
    value = value.where(value > 0)
    if value.notna().any():
        low, high = (points[f"{name}{end}"].fillna(value) for end in ("_low", "_high"))
        axes.set_ylim(low.clip(lower=LONGEST * value).min() / 1.2, high.max() * 1.2)


def _middle(points: DataFrame, name: str) -> str:
    """Ending of the column with the numbers themselves."""
    return "" if name in points else "_mean"
