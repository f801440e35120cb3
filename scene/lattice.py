"""A map of heights out of points x, y, z that lie on a lattice, in whatever order they stand."""

from collections.abc import Callable

import numpy as np

OFF = 0.05  # of a spacing: how far a point may lie off its place
_NOISE, _CLUSTERS = 1e-7, 5.0
_LEAST_FULL = 0.5  # of the places; fewer points are scattered ones


def mapped(
    x: np.ndarray, y: np.ndarray, z: np.ndarray, where: Callable[[int], str]
) -> tuple[np.ndarray, tuple[float, float]]:
    """Heights (rows along y, columns along x), both ascending, NaN where there is no point; and the spacings.

    x, y, z : (points,); where : of a point, for messages

    Raises ValueError, with the reason, where they lie on no lattice.
    """
    if not np.isfinite(x + y).all():
        raise ValueError(f"{where(int(np.argmin(np.isfinite(x + y))))}: a point needs x and y")
    (columns, dx), (rows, dy) = (placed(name, values, where) for name, values in (("x", x), ("y", y)))
    shape = int(rows.max()) + 1, int(columns.max()) + 1
    places = shape[0] * shape[1]
    if len(z) < _LEAST_FULL * places:
        raise ValueError(
            f"{len(z):,} points on {shape[1]:,} x {shape[0]:,} places of x and y are no map: a map has a height "
            "at nearly every place of a lattice"
        )
    flat = rows * shape[1] + columns
    if np.bincount(flat).max() > 1:
        order = np.argsort(flat, kind="stable")
        twice = int(order[1:][np.diff(flat[order]) == 0][0])
        raise ValueError(f"{where(twice)}: a second height at x = {x[twice]:g}, y = {y[twice]:g}")
    heights = np.full(places, np.nan)
    heights[flat] = z
    return heights.reshape(shape), (dx, dy)


def placed(name: str, values: np.ndarray, where: Callable[[int], str] = lambda _: "") -> tuple[np.ndarray, float]:
    """Numbers of the places of evenly spaced values, from 0, and their spacing; places may be empty.

    Values lie within a twentieth of the spacing of their places. Raises ValueError.
    """
    different = np.unique(values)
    gaps = np.diff(different)
    if not len(gaps):
        raise ValueError(
            f"all {name} are {different[0]:g}: that is a line and no map; a line of heights is roughness of the "
            'type = "profile"'
        )
    worst = 0
    # What lies closer together than this is one place: but for rounding, or where gaps are small or large.
    for closest in (_NOISE * (different[-1] - different[0]), _between(gaps)):
        if closest is None:
            continue
        cluster = np.concatenate([[0], np.cumsum(gaps > closest)])
        middles = np.bincount(cluster, different) / np.bincount(cluster)
        if len(middles) < 2:
            continue
        apart = np.diff(middles)
        numbers = np.concatenate([[0], np.cumsum(np.maximum(np.rint(apart / np.median(apart)), 1))])
        step = np.sum((numbers - numbers.mean()) * middles) / np.sum((numbers - numbers.mean()) ** 2)
        first = middles.mean() - step * numbers.mean()
        found = np.rint((values - first) / step).astype(int)
        off = np.abs(values - first - found * step) / step
        if off.max() <= OFF and found.min() >= 0:
            return found - found.min(), float(step)
        worst = int(off.argmax())
    place = where(worst)
    raise ValueError(
        f"{place}{': ' if place else ''}{name} = {values[worst]:g} is on no lattice: those of a map are even"
    )


def _between(gaps):
    """A number between small gaps and large ones; None where they are all alike."""
    ordered = np.sort(gaps)
    ratios = ordered[1:] / ordered[:-1]
    if not len(ratios) or ratios.max() < _CLUSTERS:
        return None
    k = int(ratios.argmax())
    return float(np.sqrt(ordered[k] * ordered[k + 1]))
