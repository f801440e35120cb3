"""Maps of heights whose dimensions have names, as xarray has them: laid out by the names, never by their order."""

from typing import Any

import numpy as np

from .printable import brief
from .quantities import METRE
from .scan import EVEN
from .scan import sides as stated_sides

DIMENSIONS = "y", "x"  # of rows and of columns


def is_labelled(given: Any) -> bool:
    """Whether something is an array with names for its dimensions."""
    return hasattr(given, "dims") and hasattr(given, "transpose") and hasattr(given, "data")


def rows_along_y(heights: Any, pixel: Any = None) -> tuple[Any, tuple[float, float] | None]:
    """A labelled map with rows along y and columns along x, both ascending; and the pixel [m] of its coordinates.

    pixel : as stated for it, which its coordinates must not contradict; coordinates without a unit are in metres

    Raises ValueError for other dimensions, and for coordinates that are no lattice, or one of another pixel.
    """
    dims = tuple(map(str, heights.dims))
    if set(dims) != set(DIMENSIONS) or len(dims) != len(DIMENSIONS):
        raise ValueError(f"heights have the dimensions ({brief(', '.join(dims))}): a map has y and x, rename them")
    heights = heights.transpose(*DIMENSIONS)
    sides, found = _sides(pixel), {}
    for name in DIMENSIONS:
        if name not in getattr(heights, "coords", {}):
            continue
        spacing = _spacing(name, heights.coords[name])
        if sides is not None and abs(abs(spacing) - sides[name]) > EVEN * sides[name]:
            raise ValueError(
                f"pixel = {sides[name]:g} m along {name}, and the coordinates of heights lie {abs(spacing):g} m "
                "apart: state the unit of the coordinates, or their spacing as pixel"
            )
        if spacing < 0:
            heights = heights.isel({name: slice(None, None, -1)})
        found[name] = abs(spacing)
    return heights, (found["x"], found["y"]) if len(found) == len(DIMENSIONS) else None


def _sides(pixel):
    """Sides of a pixel by the name of the dimension; None where none can be told, which whoever takes it says."""
    try:
        return None if pixel is None else dict(zip("xy", stated_sides(pixel), strict=True))
    except ValueError:
        return None


def _spacing(name, coordinates):
    """Spacing of evenly spaced coordinates [m], below zero where they fall."""
    try:
        places = np.asarray(METRE.values(coordinates), float)
    except ValueError as error:
        raise ValueError(f"heights, coordinates of {name}: {error}") from None
    steps = np.diff(places)
    mean = float(steps.mean()) if steps.size else 0.0
    if not (mean and np.all(np.abs(steps - mean) <= EVEN * abs(mean))):
        raise ValueError(f"heights, coordinates of {name}: they are not evenly spaced, and pixels are alike")
    return mean
