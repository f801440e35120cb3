"""Curves of a figure as numbers, where its tables do not have them: lines of theory, ratios, shifted points."""

from collections.abc import Iterator, Mapping, Sequence
from math import nan
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PathCollection
from matplotlib.container import ErrorbarContainer
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedFormatter

# Two numbers are one up to rounding.
SAME = 1e-9
COLORBAR = "<colorbar>"
COLUMNS = ("x", "y", "low", "high")
Table = Mapping[str, Any] | Sequence[Mapping[str, Any]]


def unlisted(drawing: Figure, tables: Mapping[str, Table]) -> list[dict[str, Any]]:
    """A row a point of each curve, error bar and marker that no table has, in the order in which they are drawn.

    tables : by name; columns of numbers, or rows
    Rows have panel (from 1), title, x_axis, y_axis, curve (from 1 in its panel), label, x and y in the units of
    the axes, and low and high, the ends of the bar, NaN where there is none; x or y is NaN of a line that goes all
    across the panel. A table has a curve if it has every x and every y of it, and its bars, up to a power of ten;
    zero it need not have. Panels with words on both axes have no curves.
    """
    known = [_digits(_numbers(table)) for table in tables.values()]
    return [
        _heading(axes, place) | {"curve": number, "label": _name(curve)} | dict(zip(COLUMNS, point, strict=True))
        for place, axes in enumerate(panels(drawing), 1)
        for number, (curve, points) in enumerate(curves(axes), 1)
        if not any(_has(table, points) for table in known)
        for point in points.tolist()
    ]


def panels(drawing: Figure) -> list[Axes]:
    """Those with numbers along an axis at least, without bars of colours."""
    return [axes for axes in drawing.axes if axes.axison and axes.get_label() != COLORBAR and not _in_words(axes)]


def _in_words(axes):
    """Whether both axes have words, which are no measure of anything, for numbers."""
    both = (axes.xaxis, axes.yaxis)
    return all(
        isinstance(axis.get_major_formatter(), FixedFormatter) and not axis.get_label_text() for axis in both
    )


def curves(axes: Axes) -> Iterator[tuple[Any, np.ndarray]]:
    """Every line and every set of points between the ends of x, with x, y, low and high (points, 4)."""
    bars = [each for each in axes.containers if isinstance(each, ErrorbarContainer)]
    caps = {id(cap) for each in bars for cap in each.lines[1]}
    ends = {id(each.lines[0]): each for each in bars if each.lines[0] is not None}
    for artist in axes.get_children():
        if isinstance(artist, Line2D) and id(artist) not in caps:
            points = _line(axes, artist, ends.get(id(artist)))
        elif isinstance(artist, PathCollection) and artist.get_offset_transform() == axes.transData:
            offsets: np.ndarray = np.ma.filled(np.ma.asarray(artist.get_offsets(), float), nan)
            points = np.column_stack([offsets, np.full_like(offsets, nan)])
        else:
            continue
        points = points[np.isfinite(points[:, :2]).any(axis=1) & ~np.isinf(points).any(axis=1)]
        low, high = sorted(axes.get_xlim())
        points = points[~((points[:, 0] < low) | (points[:, 0] > high))]
        if len(points):
            yield ends.get(id(artist), artist), points


def _line(axes, line, bars):
    """Of a line across the panel one point, without what is not on an axis of numbers."""
    x, y = (np.ma.filled(np.ma.asarray(values, float), nan) for values in line.get_data(orig=False))
    across = line.get_transform().contains_branch_seperately(axes.transData)
    if not any(across):
        return np.empty((0, 4))
    if not all(across):
        return np.array([[x[0] if across[0] else nan, y[0] if across[1] else nan, nan, nan]])
    points = np.column_stack([x, y, np.full((len(x), 2), nan)])
    points[~np.isfinite(points[:, :2]).all(axis=1)] = nan
    if bars is not None and bars.has_yerr:
        for point, ends in zip(points, bars.lines[2][-1].get_segments(), strict=True):
            if len(ends) == 2:  # none where the error is NaN
                point[2:] = np.asarray(ends, float)[:, 1]
    return points


def _heading(axes, place):
    title = " ".join(filter(None, (axes.get_title(loc=side) for side in ("left", "center", "right"))))
    x, y = (_label(axes, name) for name in ("x", "y"))
    return {"panel": place, "title": " ".join(title.split()), "x_axis": x, "y_axis": y}


def _label(axes, name):
    """Of an axis, or of one that shares its numbers."""
    sharing = getattr(axes, f"get_shared_{name}_axes")().get_siblings(axes)
    labels = [getattr(each, f"get_{name}label")() for each in (axes, *sharing)]
    return next((" ".join(label.split()) for label in labels if label), "")


def _name(curve):
    label = str(curve.get_label() or "")
    return "" if label.startswith("_") else " ".join(label.split())


def _has(known, points):
    """Whether the digits of all points are known; of bars, those of their ends or of their lengths."""
    x, y, low, high = points.T
    bars = [(values, np.abs(values - y)) for values in (low, high)]
    return _all(known, x) and _all(known, y) and all(_all(known, ends) or _all(known, of) for ends, of in bars)


def _all(known, values):
    sought = _digits(values)
    if not sought.size:
        return True
    if not known.size:
        return False
    place = np.searchsorted(known, sought)
    beside = np.stack([known[(place - 1) % len(known)], known[place % len(known)]])
    # Of 9.99... and 1.0... the logarithms lie at either end.
    apart = np.abs(beside - sought)
    return bool((np.minimum(apart, 1 - apart).min(axis=0) < SAME).all())


def _digits(values):
    """Of numbers but zero and NaN, the logarithms without their integers, sorted."""
    size = np.abs(np.asarray(values, float))
    return np.unique(np.log10(size[np.isfinite(size) & (size > 0)]) % 1.0)


def _numbers(table):
    """All numbers of a table."""
    columns = table.values() if isinstance(table, Mapping) else (row.values() for row in table)
    flat = (np.asarray(values).ravel() if isinstance(values, np.ndarray) else values for values in columns)
    return [float(value) for values in flat for value in values if _is_number(value)]


def _is_number(value):
    return isinstance(value, int | float | np.integer | np.floating) and not isinstance(value, bool)
