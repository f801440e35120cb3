"""Heights measured on a lattice of pixels: compared, stored and named by a digest, never by the whole array."""

import hashlib
from dataclasses import dataclass as plain
from dataclasses import field
from sys import float_info
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
from pydantic import AfterValidator, BeforeValidator, ConfigDict, InstanceOf, PlainSerializer, model_validator
from pydantic.dataclasses import dataclass

from .heightfile import UNITS, check_layout, read_heights
from .labelled import is_labelled, rows_along_y
from .quantities import CLOSED, METRE, Length, by_name

SHORTEST, LONGEST = 1e-50, 1e50  # lengths [m] whose fourth powers, as of spectra, are numbers
# Of the largest height: what is left of a plane once the plane is taken off.
ROUNDING = 1e-13
QUOTIENT = 1e-12  # rounding of a quotient of lengths


@plain(frozen=True, init=False)
class HeightMap:
    """Rows and columns of heights [m], which cannot be changed. The heights themselves are no field.

    shape : (rows, columns), rows along y and columns along x, both ascending
    digest : of shape and heights, as hexadecimal digits: maps of equal digests have equal heights
    heights : the array, read-only; no field

    Raises ValueError for what is no map of finite numbers, has less than four pixels a side, or heights beyond
    1e-50 to 1e50 m.
    """

    shape: tuple[int, int]
    digest: str = field(repr=False)

    if TYPE_CHECKING:

        @property
        def heights(self) -> np.ndarray: ...

    _check = staticmethod(check_layout)

    def __init__(self, heights):
        if np.ma.is_masked(heights):
            raise ValueError(f"{np.ma.count_masked(heights)} pixels have no height: fill them in, or crop the map")
        values = np.asarray(METRE.values(heights))
        self._check(values.shape, values.dtype)
        with np.errstate(over="ignore"):  # beyond the range of numbers is not finite
            # A copy of our own, with one zero.
            values = np.asarray(values, float) + 0.0
        if not np.isfinite(values).all():
            place = tuple(np.argwhere(~np.isfinite(values))[0])
            where = "".join(f"[{k}]" for k in place)
            raise ValueError(
                f"heights{where} = {values[place]:g}: every pixel needs a finite height, fill in "
                "what was not measured, or crop the map"
            )
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
        stated = {"shape": values.shape, "digest": digest.hexdigest(), "heights": values}
        for name, value in stated.items():
            object.__setattr__(self, name, value)

    def __reduce__(self):
        return type(self), (self.heights,)


def _as_map(value):
    if isinstance(value, HeightMap):
        return value
    if isinstance(value, str):
        raise ValueError("Input should be rows of heights [m], or give file instead")
    return HeightMap(value)


def _both_ways(pixel):
    try:
        sides = METRE.values(pixel)
    except ValueError as error:
        raise ValueError(f"{error}; or two of them, along x and y") from None
    sides = np.ravel(sides).tolist() if np.ndim(sides) < 2 else []
    if len(sides) not in (1, 2) or not all(0 < side <= float_info.max for side in sides):
        raise ValueError("Input should be the side of a pixel, greater than 0 [m], or two of them, along x and y")
    return sides[0], sides[-1]


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
    BeforeValidator(_both_ways, json_schema_input_type=Length | tuple[Length, Length]),
    AfterValidator(_alike),
]


def _or_file(schema: dict[str, Any]) -> None:
    """In JSON schema: a file in place of heights."""
    schema["properties"] |= {"file": {"type": "string"}, "unit": {"enum": [*UNITS, "µm"]}}
    del schema["required"]
    schema["anyOf"] = [{"required": ["file"]}, {"required": ["heights", "pixel"]}]


MAPPED = ConfigDict(**CLOSED, json_schema_extra=_or_file)


@dataclass(frozen=True, config=MAPPED, kw_only=True)
class Scanned:
    """Measured map of heights.

    heights : rows along y of heights along x [m], both ascending; of xarray, with the dimensions y and x
    pixel : side of a pixel [m]; of pixels that are no squares, along x and along y
    peaks : "up", heights grow towards the elastomer, as instruments give them, and the highest point touches
        first; "down", they are those of an indenter above the elastomer, and the lowest touches first
    shortest_kept : waves shorter than this are left out [m]; absent, every wave of the map is kept

    In place of heights `file` is the path of a file, read once and kept as numbers; a relative path starts at the
    working directory. `pixel`, and `unit` of the heights ("m", "mm", "um", "nm"), are needed where the file
    does not state them, see `read_heights`.
    """

    heights: Heights
    pixel: Pixel
    peaks: Literal["up", "down"] = "up"
    shortest_kept: Length | None = None

    @model_validator(mode="before")
    @classmethod
    def _laid_out(cls, given: Any) -> Any:
        stated = by_name(given)
        if stated is None or not is_labelled(stated.get("heights")):
            return given
        return stated | {"heights": rows_along_y(stated["heights"], stated.get("pixel"))}

    @model_validator(mode="before")
    @classmethod
    def _from_file(cls, given: Any) -> Any:
        stated = by_name(given)
        if stated is None or "file" not in stated:
            return given
        stated = dict(stated)
        if "heights" in stated:
            raise ValueError(f"file = {stated['file']!r} beside heights: give one of them")
        path, unit = stated.pop("file"), stated.pop("unit", None)
        heights, pixel = read_heights(path, stated.pop("pixel", None), unit)
        try:
            return stated | {"heights": HeightMap(heights), "pixel": pixel}
        except ValueError as error:
            raise ValueError(f"file = {str(path)!r}: {error}") from None

    @model_validator(mode="after")
    def _waves_kept(self):
        if self.shortest_kept is not None:
            least, most = 2 * max(self.pixel), min(self.sides) / 2
            if not least * (1 - QUOTIENT) <= self.shortest_kept <= most:
                raise ValueError(
                    f"shortest_kept = {self.shortest_kept:g} m: from two pixels, {least:g} m, to half of what "
                    f"repeats, {most:g} m"
                )
        return self

    @property
    def size(self) -> tuple[float, float]:
        """Sides of the map, along x and along y [m]."""
        rows, columns = self.heights.shape
        return columns * self.pixel[0], rows * self.pixel[1]

    @property
    def sides(self) -> tuple[float, float]:
        """Sides of the rectangle that repeats, the map with its mirror images, along x and along y [m]."""
        return 2 * self.size[0], 2 * self.size[1]

    def _turned(self) -> np.ndarray:
        """Heights above the elastomer, from whatever level (rows, columns) [m]."""
        return -self.heights.heights if self.peaks == "up" else self.heights.heights


def levelled(heights: np.ndarray, level: str) -> np.ndarray:
    """Heights less their mean, or the plane ("tilt") or paraboloid ("curvature") that fits them best.

    What is left of no more than rounding is zero.
    """
    rows, columns = heights.shape
    y, x = np.linspace(-1, 1, rows)[:, None], np.linspace(-1, 1, columns)[None, :]
    terms = {"mean": [], "tilt": [x, y], "curvature": [x, y, x * y, x * x, y * y]}[level]
    most = np.abs(heights).max() or 1.0
    left = heights / most
    left = left - left.mean()
    # Less their means, these are orthogonal to one another on any lattice of rows and columns.
    for term in (term - term.mean() for term in terms):
        left = left - (np.mean(term * left) / np.mean(term * term)) * term
    if np.abs(left).max() <= ROUNDING:
        return np.zeros(heights.shape)
    return most * left
