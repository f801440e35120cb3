"""Measured heights of a map or a line: compared, stored and named by a digest; and their form."""

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass as plain
from dataclasses import field
from functools import lru_cache
from sys import float_info
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from pydantic import AfterValidator, BeforeValidator, InstanceOf, PlainSerializer

from ..printable import brief
from ..quantities import METRE, Length
from .missing import refuse_missing

SHORTEST, LONGEST = 1e-50, 1e50  # lengths [m] whose fourth powers, as of spectra, are numbers
LEAST = 4  # pixels a side of a map: what a cubic between pixels takes


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

    shape: tuple[int, ...]
    digest: str = field(repr=False)

    if TYPE_CHECKING:

        @property
        def heights(self) -> np.ndarray: ...

        @property
        def notes(self) -> tuple[str, ...]: ...

    @staticmethod
    def check_layout(shape: tuple[int, ...], dtype: np.dtype) -> None:
        """Raise ValueError for the shape and type of an array that is none of such heights."""
        if len(shape) != 2 or min(shape) < LEAST:
            line = (
                '; a line of heights is roughness of type = "profile"'
                if sum(side > 1 for side in shape) == 1
                else ""
            )
            raise ValueError(
                f"an array of shape {brief(str(shape))}: a map has at least {LEAST} rows and columns{line}"
            )
        _check_real(dtype)

    def __init__(self, heights, notes: Sequence[str] = ()):
        values = np.asarray(METRE.values(unmasked(heights)))
        self.check_layout(values.shape, values.dtype)
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
        return type(self), (self.heights, self.notes)


class HeightLine(HeightMap):
    """One row of heights (N,) [m], along x. Raises as `HeightMap` does."""

    @staticmethod
    def check_layout(shape: tuple[int, ...], dtype: np.dtype) -> None:
        if len(shape) != 1 or not shape[0]:
            raise ValueError(f"an array of shape {brief(str(shape))}: a line is one row of heights")
        _check_real(dtype)


def _check_real(dtype):
    if dtype.kind not in "fiu":
        raise ValueError(f"an array of type {brief(str(dtype))}: heights are real numbers [m]")


def unmasked(heights: Any) -> Any:
    """Heights with NaN where an array of numpy masks them; anything else as it is."""
    if np.ma.isMaskedArray(heights) and heights.dtype.kind in "fiu":
        return np.ma.filled(heights.astype(float), np.nan)
    return heights


def sides(pixel: Any) -> tuple[float, float]:
    """Sides of a pixel along x and along y [m], from one number or two. Raises ValueError."""
    try:
        found = METRE.values(pixel)
    except ValueError as error:
        raise ValueError(f"{error}; or two of them, along x and y") from None
    numbers = np.ravel(found).tolist() if np.ndim(found) < 2 else []
    if len(numbers) not in (1, 2) or not all(0 < side <= float_info.max for side in numbers):
        raise ValueError("Input should be the side of a pixel, greater than 0 [m], or two of them, along x and y")
    return numbers[0], numbers[-1]


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


def _as(kind, form):
    """Validator of heights as a map or as a line."""

    def held(value):
        if isinstance(value, str):
            raise ValueError(f"Input should be {form} of heights [m], or give file instead")
        return value if isinstance(value, kind) else kind(value)

    return held


_DIGEST = PlainSerializer(lambda given: {"shape": list(given.shape), "digest": given.digest})
_Row = list[Annotated[float, METRE]]
MapHeights = Annotated[
    InstanceOf[HeightMap], BeforeValidator(_as(HeightMap, "rows"), json_schema_input_type=list[_Row]), _DIGEST
]
LineHeights = Annotated[
    InstanceOf[HeightLine], BeforeValidator(_as(HeightLine, "a row"), json_schema_input_type=_Row), _DIGEST
]
Pixel = Annotated[
    tuple[Length, Length],
    BeforeValidator(sides, json_schema_input_type=Length | tuple[Length, Length]),
    AfterValidator(_alike),
]


DEGREES = {"mean": 0, "tilt": 1, "curvature": 2, "cubic": 3}
# Rest of a form once it is taken off, relative to the largest height.
ROUNDING = 1e-13


def levelled(heights: np.ndarray, level: str) -> np.ndarray:
    """Heights less their mean, or the plane ("tilt"), paraboloid ("curvature") or cubic that fits them best.

    Of a line (N,) the polynomial of that degree. What is left of no more than rounding is zero.
    """
    most = np.abs(heights).max() or 1.0
    left = taken_off(taken_off(heights / most, DEGREES[level]), DEGREES[level])
    return most * left if np.abs(left).max() > ROUNDING else np.zeros(heights.shape)


def taken_off(heights: np.ndarray, degree: int) -> np.ndarray:
    """Heights of a map or a line less the polynomial of a degree that fits them best."""
    if heights.ndim == 1:
        return taken_off(heights[None], degree)[0]
    # Products of orthonormal polynomials along the sides are orthonormal on any lattice of rows and columns.
    along_y, along_x = (polynomials(count, degree) for count in heights.shape)
    parts = along_y.T @ heights @ along_x
    orders = np.add.outer(*map(np.arange, parts.shape))
    return heights - along_y @ np.where(orders <= degree, parts, 0.0) @ along_x.T


@lru_cache(maxsize=8)
def polynomials(count: int, degree: int) -> np.ndarray:
    """Orthonormal polynomials of increasing degree on evenly spaced places (count, up to degree + 1)."""
    return np.linalg.qr(np.polynomial.legendre.legvander(np.linspace(-1, 1, count), min(degree, count - 1)))[0]
