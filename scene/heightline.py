"""One row of measured heights, held, compared and stored as a map of heights is."""

from typing import Annotated

import numpy as np
from pydantic import BeforeValidator, InstanceOf, PlainSerializer

from .heightmap import HeightMap
from .printable import brief
from .quantities import METRE


class HeightLine(HeightMap):
    """One row of heights [m], which cannot be changed, known by a digest. Raises as `HeightMap` does."""

    notes: tuple[str, ...] = ()

    @staticmethod
    def _check(shape: tuple[int, ...], dtype: np.dtype) -> None:
        if len(shape) != 1 or dtype.kind not in "fiu":
            raise ValueError(f"an array of shape {brief(str(shape))}: a line is one row of heights")


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
