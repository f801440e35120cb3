"""Points of curves: intervals of 95 %, crosses without an answer, and markers hollow where a condition breaks."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from pandas import DataFrame

from . import style


def intervals(
    axes: Axes, x: Any, points: DataFrame, name: str, times: float = 1.0, less: Any = 0.0, **look: Any
) -> None:
    """Points with intervals of 95 %, of the columns `name` or `name`_mean, `name`_low and `name`_high.

    times, less : factor on all three, after `less` is taken from them; look : of `errorbar`
    """
    middle = "" if name in points else "_mean"
    value, low, high = (
        times * (points[name + end].to_numpy(float) - np.asarray(less)) for end in (middle, "_low", "_high")
    )
    axes.errorbar(x, value, yerr=style.bars(value, low, high), **look)


def unanswered(axes: Axes, x: Any, values: Any, colour: Any, label: str = "") -> None:
    """Crosses on the axis below, where a value is not known. label : whose answer is missing, for the legend"""
    x = np.asarray(x, float)[~np.isfinite(np.asarray(values, float))]
    if x.size:
        look: dict[str, Any] = {"color": colour, "markersize": style.mark(), "clip_on": False, "zorder": 4}
        look |= {"label": f"{label}: no answer"} if label else {}
        axes.plot(x, np.zeros(x.size), "x", transform=axes.get_xaxis_transform(), **look)


def scatter(
    axes: Axes, x: Any, y: Any, filled: Any, colours: Any, size: float, edge: float, empty: Any = None, **look: Any
) -> None:
    """Markers, hollow where they are not `filled`.

    colours : one, or one of each point; size, edge : in multiples of the marker and the line of curves
    empty : colour inside of hollow ones, that of the paper by default
    """
    x, y, filled = (np.asarray(each) for each in (x, y, filled))
    look |= {"s": style.mark(size) ** 2, "linewidths": style.width(edge)}
    for where, inside in ((filled, None), (~filled, empty or style.paper())):
        if where.any():
            own = colours if isinstance(colours, str | tuple) else colours[where]
            axes.scatter(x[where], y[where], facecolors=own if inside is None else inside, edgecolors=own, **look)


def of_curves(points: DataFrame, chosen: Any) -> DataFrame:
    """Some of the points, with load or depth as it is prescribed to them."""
    own = points[chosen]
    absent = [name for name in ("load", "depth") if name in own and own[name].isna().all()]
    return own.drop(columns=absent)


def averaged(points: DataFrame) -> str:
    """Number of surfaces behind means, and what bars are: a sentence of a caption."""
    rough = points[points["body"] == "rough"]
    if rough.empty:
        return "The body is smooth: bars are the change on halving the grid."
    count = {model: int(rows["surfaces"].max()) for model, rows in rough.groupby("model")}
    means = [f"{count.get('MDR', 0)} profiles (1D)", f"{count.get('BEM', 0)} surfaces (3D)"]
    # What answers for all surfaces at once has one.
    others = {name: number for name, number in count.items() if name not in ("MDR", "BEM") and number > 1}
    means += [f"{number} draws ({name})" for name, number in others.items()]
    return f"Means over {', '.join(means[:-1])} and {means[-1]}; bars are intervals of 95 %."
