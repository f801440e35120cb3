"""Heights measured on a lattice of pixels: compared, stored and named by a digest, never by the whole array."""

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass as plain
from dataclasses import field
from typing import TYPE_CHECKING, Annotated

import numpy as np
from pydantic import AfterValidator, BeforeValidator, InstanceOf, PlainSerializer

from .missing import refuse_missing
from .quantities import METRE, Length
from .scan import check_layout, sides

SHORTEST, LONGEST = 1e-50, 1e50  # lengths [m] whose fourth powers, as of spectra, are numbers


@plain(frozen=True, init=False)
class HeightMap:
    """Rows and columns of heights [m], which cannot be changed. The heights themselves are no field.

    shape : (rows, columns), rows along y and columns along x, both ascending
    digest : of shape and heights, as hexadecimal digits: maps of equal digests have equal heights
    heights : the array, read-only; no field
    notes : what was done to the heights before, and what of a file was not used, a line each; no field

    Raises ValueError for what is no map of finite numbers, has less than four pixels a side, heights beyond 1e-50
    to 1e50 m, or some that stand for none, see `missing.sentinels`.
    """

    shape: tuple[int, int]
    digest: str = field(repr=False)

    if TYPE_CHECKING:

        @property
        def heights(self) -> np.ndarray: ...

        @property
        def notes(self) -> tuple[str, ...]: ...

    def __init__(self, heights, notes: Sequence[str] = ()):
        values = np.asarray(METRE.values(unmasked(heights)))
        check_layout(values.shape, values.dtype)
        with np.errstate(over="ignore"):  # beyond the range of numbers is not finite
            # A copy of our own, with one zero.
            values = np.asarray(values, float) + 0.0
        refuse_missing(values)
        most = max(values.max(), -values.min())
        if most and not SHORTEST <= most <= LONGEST:
            raise ValueError(
                f"heights of up to {most:g} m: the largest is from {SHORTEST:g} to {LONGEST:g} m, or all are 0; "
                "check their unit"
            )
        content = values.tobytes()
        # Bytes cannot be changed, nor be made so that they can.
        values = np.frombuffer(content).reshape(values.shape)
        digest = hashlib.sha256(f"{values.shape}".encode())
        digest.update(content)
        stated = {"shape": values.shape, "digest": digest.hexdigest(), "heights": values, "notes": tuple(notes)}
        for name, value in stated.items():
            object.__setattr__(self, name, value)

    def __reduce__(self):
        return HeightMap, (self.heights, self.notes)


def unmasked(heights):
    """Heights with NaN where an array of numpy masks them; anything else as it is."""
    if np.ma.isMaskedArray(heights) and heights.dtype.kind in "fiu":
        return np.ma.filled(heights.astype(float), np.nan)
    return heights


def _as_map(value):
    if isinstance(value, HeightMap):
        return value
    if isinstance(value, str):
        raise ValueError("Input should be rows of heights [m], or give file instead")
    return HeightMap(value)


def _alike(pixel):
    """Sides beyond reason, or that differ by a factor beyond it, are a mistake of units."""
    if not SHORTEST <= min(pixel) <= max(pixel) <= LONGEST:
        raise ValueError(
            f"sides of {pixel[0]:g} m along x and {pixel[1]:g} m along y: from {SHORTEST:g} to {LONGEST:g} m"
        )
    if not 1e-3 <= pixel[0] / pixel[1] <= 1e3:
        raise ValueError(
            f"sides of {pixel[0]:g} m along x and {pixel[1]:g} m along y differ beyond a factor of 1000"
        )
    return pixel


Heights = Annotated[
    InstanceOf[HeightMap],
    BeforeValidator(_as_map, json_schema_input_type=list[list[Annotated[float, METRE]]]),
    PlainSerializer(lambda given: {"shape": list(given.shape), "digest": given.digest}),
]
Pixel = Annotated[
    tuple[Length, Length],
    BeforeValidator(sides, json_schema_input_type=Length | tuple[Length, Length]),
    AfterValidator(_alike),
]
