"""One row of measured heights, held, compared and stored as a map of heights is, with its holes filled in."""

from typing import Annotated

import numpy as np
from pydantic import BeforeValidator, InstanceOf, PlainSerializer

from .heightmap import HeightMap
from .missing import MOST_FILLED, sentinels
from .printable import brief
from .quantities import METRE


class HeightLine(HeightMap):
    """One row of heights [m], which cannot be changed, known by a digest. Raises as `HeightMap` does."""

    @staticmethod
    def _check_layout(shape: tuple[int, ...], dtype: np.dtype) -> None:
        if len(shape) != 1 or dtype.kind not in "fiu":
            raise ValueError(f"an array of shape {brief(str(shape))}: a line is one row of heights")

    @staticmethod
    def _refuse_missing(heights: np.ndarray) -> None:
        missing = ~np.isfinite(heights) | np.isin(heights, sentinels(heights))
        if count := int(np.count_nonzero(missing)):
            first = int(missing.argmax())
            raise ValueError(
                f"{shared(count, missing.size)} have no height or one that stands for none, the first is point "
                f'{first + 1}, {heights[first]:g} m: missing = "fill" fills them in'
            )


def filled(heights: np.ndarray) -> tuple[np.ndarray, tuple[str, ...]]:
    """Heights (N,) with missing ones, and those that stand for none, filled in on straight lines; what was done.

    Raises ValueError where they are more than a twentieth.
    """
    holes = ~np.isfinite(heights) | np.isin(heights, sentinels(heights))
    count = int(np.count_nonzero(holes))
    if not count:
        return heights, ()
    if count > MOST_FILLED * len(heights):
        raise ValueError(
            f"{shared(count, holes.size)} have no height: at most {100 * MOST_FILLED:g} % are filled in"
        )
    places = np.arange(len(heights))
    whole = np.interp(places, places[~holes], heights[~holes])
    return whole, (f"{shared(count, holes.size)} had no height and were filled in on straight lines",)


def shared(count: int, size: int) -> str:
    """Some of the points of a line in words."""
    return f"{count} of {size} points, {100 * count / size:.3g} %,"


def _as_line(value):
    if isinstance(value, HeightLine):
        return value
    if isinstance(value, str):
        raise ValueError("Input should be a row of heights [m], or give file instead")
    return HeightLine(value)


Heights = Annotated[
    InstanceOf[HeightLine],
    BeforeValidator(_as_line, json_schema_input_type=list[Annotated[float, METRE]]),
    PlainSerializer(lambda given: {"shape": list(given.shape), "digest": given.digest}),
]
