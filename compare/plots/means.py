"""Curves of means over rough surfaces, with their intervals of 95 % and the scatter of one surface."""

import numpy as np
from matplotlib.axes import Axes
from pandas import DataFrame

from . import style


def line(axes: Axes, points: DataFrame, across: str, name: str, solver: str, times: float = 1.0, **look) -> None:
    """One curve: bars are intervals of 95 %, the band is the standard deviation of one surface.

    points : rows of the curve, with the columns `name`, `name`_low, `name`_high and perhaps `name`_deviation
    times : factor on the abscissa
    """
    look = {
        "color": style.COLOUR[solver],
        "marker": style.MARKER[solver],
        "linestyle": style.LINE[solver],
        "label": style.LABEL[solver],
    } | look
    x, value = times * points[across].to_numpy(float), points[name].to_numpy(float)
    axes.errorbar(x, value, yerr=style.bars(value, points[f"{name}_low"], points[f"{name}_high"]), **look)
    deviation = np.nan_to_num(points[f"{name}_deviation"]) if f"{name}_deviation" in points else np.zeros(0)
    if deviation.any():
        below = value - deviation
        if axes.get_yscale() == "log":
            below = np.maximum(below, 1e-2 * value)
        axes.fill_between(x, below, value + deviation, color=look["color"], alpha=0.13, linewidth=0)


def of_curves(points: DataFrame, chosen) -> DataFrame:
    """Some of the points, with load or depth as it is prescribed to them."""
    own = points[chosen]
    absent = [name for name in ("load", "depth") if name in own and own[name].isna().all()]
    return own.drop(columns=absent)


def averaged(points: DataFrame) -> str:
    """Number of surfaces behind means, and what bars and bands are: sentences of a caption."""
    rough = points[points["body"] == "rough"]
    if rough.empty:
        return "The body is smooth: bars are the change on halving the grid."
    count = {solver: int(rows["surfaces"].max()) for solver, rows in rough.groupby("solver")}
    return (
        f"Means over {count.get('MDR', 0)} profiles (1D) and {count.get('BEM', 0)} surfaces (3D); bars are "
        "intervals of 95 %, bands the standard deviation of one surface."
    )
