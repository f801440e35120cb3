"""Heights on even places: points x, y, z in any order, and points along a line."""

from collections.abc import Callable

import numpy as np

from ..printable import brief

OFF = 0.05  # of a spacing: how far a point may lie off its place
_NOISE = 1e-7  # of the range of all places: closer ones are one
_LEAST_FULL = 0.5  # of the places of a map; fewer points are scattered ones

FEW = 6  # evenly spaced numbers that are not taken for an axis; columns that points may have

Place = Callable[[int], str]
"""Where a point stands, for messages."""


def mapped(x: np.ndarray, y: np.ndarray, z: np.ndarray, place: Place) -> tuple[np.ndarray, tuple[float, float]]:
    """Heights (rows along y, columns along x), both ascending, NaN where there is no point; and the spacings.

    x, y, z : (points,)

    Raises ValueError, with the reason, where they lie on no lattice.
    """
    (columns, dx), (rows, dy) = _placed("x", x, place), _placed("y", y, place)
    shape = int(rows.max()) + 1, int(columns.max()) + 1
    if len(z) < _LEAST_FULL * shape[0] * shape[1]:
        raise ValueError(f"{len(z):,} points on {shape[1]:,} x {shape[0]:,} places of x and y are no map")
    _, first, count = np.unique(rows * shape[1] + columns, return_index=True, return_counts=True)
    if (count > 1).any():
        twice = int(np.setdiff1d(np.arange(len(z)), first)[0])
        raise ValueError(f"{place(twice)}: a second height at x = {x[twice]:g}, y = {y[twice]:g}")
    heights = np.full(shape, np.nan)
    heights[rows, columns] = z
    return heights, (dx, dy)


def ordered(name: str, values: np.ndarray, place: Place) -> tuple[np.ndarray, float]:
    """Order in which evenly spaced, distinct places ascend, and their spacing.

    Raises ValueError.
    """
    numbers, step = _placed(name, values, place)
    order = np.argsort(numbers, kind="stable")
    if len(wrong := order[1:][np.diff(numbers[order]) != 1]):
        raise ValueError(
            f"{place(wrong[0])}: {name} = {values[wrong[0]]:g} is not one step from the one before it, and "
            "places of heights are evenly spaced: interpolate"
        )
    return order, step


def refuse_places(where: str, numbers: np.ndarray) -> None:
    """Raise ValueError where numbers of a map are places: its first row or column, or two columns of points."""
    for called, rows in (("row", numbers), ("column", numbers.T)):
        # Their common cell may hold anything; a few places are an axis only if it holds nothing.
        even, next_even = (_even(np.diff(row[1:])) for row in rows[:2])
        if even and next_even is False and (rows.shape[1] > FEW or np.isnan(rows[0, 0])):
            raise ValueError(
                f"{where}: the first {called}, {brief(str(rows[0, :4].tolist()))} and so on, is evenly spaced as "
                "places are, and the next is not: leave axes out, state skip"
            )
    for k in range(2 if numbers.shape[1] <= FEW < len(numbers) else 0):
        try:
            shape = mapped(numbers[:, k], numbers[:, k + 1], numbers[:, k], str)[0].shape
        except ValueError:
            continue
        if min(shape) > 3:
            raise ValueError(
                f"{where}: columns {k + 1} and {k + 2} are places on a lattice: of points state columns = {{x = "
                f"{k + 1}, y = {k + 2}, z = {k + 3}}} and units"
            )


def _even(steps):
    """Whether steps are equal and not zero; None where one is not known, or there is none."""
    return (
        bool(steps[0] and np.ptp(steps) <= _NOISE * abs(steps.mean()) * steps.size)
        if steps.size and np.isfinite(steps).all()
        else None
    )


def _placed(name: str, values: np.ndarray, place: Place) -> tuple[np.ndarray, float]:
    """Numbers of evenly spaced places, from 0, and their spacing; places may be empty.

    Values lie within a twentieth of the spacing of their places. Raises ValueError.
    """
    if not np.isfinite(values).all():
        raise ValueError(f"{place(int(np.argmin(np.isfinite(values))))}: {name} is no finite number")
    places = np.unique(values)
    places = places[np.diff(places, prepend=-np.inf) > _NOISE * np.ptp(values)]
    if len(places) < 2:
        raise ValueError(
            f'all {name} are {places[0]:g}: a line of heights along x is roughness of type = "profile"'
        )
    apart = np.diff(places)
    numbers = np.append(0.0, np.cumsum(np.maximum(np.rint(apart / np.median(apart)), 1)))
    step, first = np.polyfit(numbers, places, 1)
    found = np.rint((values - first) / step)
    off = np.abs(values - first - found * step) / step
    if off.max() > OFF:
        worst = int(off.argmax())
        raise ValueError(
            f"{place(worst)}: {name} = {values[worst]:g} is off by more than {100 * OFF:g} % of a step, "
            f"{step:g}: places of heights are evenly spaced"
        )
    return found.astype(int), float(step)
