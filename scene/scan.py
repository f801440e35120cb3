"""A map of heights as a file has it, and what the file says of its unit and its pixel beside what is stated."""

from collections.abc import Mapping
from dataclasses import dataclass
from reprlib import repr as briefly
from sys import float_info
from typing import Any

import numpy as np

from .plain import in_unit
from .printable import brief
from .quantities import METRE

UNITS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9}
_LINE = "on the command line of crosscheck topography"
UNIT = f'the unit of its heights: give unit = "um", or --unit um {_LINE}, out of {", ".join(UNITS)}'
PIXEL = f'the side of a pixel: give pixel = "1 um", or --pixel "1 um" {_LINE}'
LEAST = 4  # pixels a side: what a cubic between pixels takes
EVEN = 1e-3  # relative, of sides and spacings: a header rounds them, and so do coordinates in single precision


@dataclass(frozen=True, eq=False)
class Scan:
    """A map of heights as a file has it.

    name : of the file, for messages
    heights : (rows, columns), rows along y, NaN where none was measured; [m] if the file states a unit
    unit : of the heights as the file writes it; empty where it states none
    pixel : sides along x and along y [m], None where the file does not state one
    steps : both as numbers without a unit
    counted : whether these may merely number the pixels, as coordinates that are 1 apart do
    notes : what was read and is not used, a line each
    spoken : units of length that stand above the heights, where nothing says of what
    """

    name: str
    heights: np.ndarray
    unit: str = ""
    pixel: tuple[float | None, float | None] = (None, None)
    steps: tuple[float, float] | None = None
    counted: bool = False
    notes: tuple[str, ...] = ()
    spoken: frozenset[str] = frozenset()

    def settled(self, pixel: Any = None, unit: str | None = None) -> tuple[np.ndarray, Any]:
        """Heights [m] and the pixel, what is stated and what the file says put together.

        Sides without a unit are in that which is stated for the heights, unless they count and a pixel is stated.
        Raises ValueError where one is stated twice and differs, and where one is stated nowhere.
        """
        metre, own = None if unit is None else metres(unit), self.pixel
        if self.unit and metre is not None and not _is_metres(self.unit, metre):
            raise ValueError(f"unit = {unit!r}: {self.name} states its own, {brief(self.unit)}, leave unit out")
        if self.steps is not None and metre is not None and not (self.counted and pixel is not None):
            own = self.steps[0] * metre, self.steps[1] * metre
        others = [each for each in self.spoken if metre is not None and not _is_metres(each, metre)]
        if others and (self.steps is not None or len(others) == len(self.spoken)):
            raise ValueError(
                f"unit = {unit!r}: {self.name} speaks of {', '.join(sorted(others))} above its heights, and does "
                'not say of what: write a line as "Z unit: um", or leave the text out'
            )
        needed = {UNIT: not self.unit and unit is None, PIXEL: None in own and pixel is None}
        if lacking := [each for each, lacks in needed.items() if lacks]:
            raise ValueError(f"{self.name} does not state {'; nor '.join(lacking)}")
        self._check(pixel, own)
        # First the numbers in full: those of half precision end where nanometres begin.
        with np.errstate(over="ignore"):
            heights = self.heights.astype(float, copy=False) * (1.0 if self.unit else metre)
        return heights, own if pixel is None else pixel

    def _check(self, pixel, own):
        """Raise ValueError for a pixel that differs from that of the file; one that is none, its field refuses."""
        try:
            given = sides(pixel) if pixel is not None else None
        except ValueError:
            return
        if given is None:
            return
        if not all(
            found is None or abs(side - found) <= EVEN * found for side, found in zip(given, own, strict=True)
        ):
            said = " x ".join(f"{side:.6g}" for side in dict.fromkeys(own) if side is not None)
            raise ValueError(f"pixel = {briefly(pixel)}: {self.name} states its own, {said} m, leave pixel out")
        if (
            self.steps is not None
            and not self.counted
            and abs(given[0] / given[1] - self.steps[0] / self.steps[1]) > EVEN
        ):
            raise ValueError(
                f"pixel = {briefly(pixel)}: coordinates in {self.name} lie {self.steps[0]:g} apart along x and "
                f"{self.steps[1]:g} along y, which is another ratio"
            )


def _is_metres(unit, metre):
    try:
        return abs(float(METRE.scale(unit)[0]) - metre) <= 1e-9 * metre
    except ValueError:
        return False


def measured_in(name: str, lengths: Any, unit: str) -> Any:
    """Numbers in a unit that a file of this name writes [m]. Raises ValueError for a unit of anything else."""
    try:
        return in_unit(lengths, unit, "m")
    except ValueError:
        raise ValueError(f"{name} has values in {brief(repr(unit))}: a unit of length is needed") from None


def metres(unit: Any) -> float:
    """A unit of heights [m]. Raises ValueError."""
    plain = unit.replace("µ", "u").replace("μ", "u") if isinstance(unit, str) else unit
    if not (isinstance(plain, str) and plain in UNITS):
        raise ValueError(f"unit = {briefly(unit)}: one of {', '.join(UNITS)}")
    return UNITS[plain]


def sides(pixel: Any) -> tuple[float, float]:
    """Sides of a pixel along x and along y [m], of one number or two. Raises ValueError."""
    try:
        found = METRE.values(pixel)
    except ValueError as error:
        raise ValueError(f"{error}; or two of them, along x and y") from None
    numbers = np.ravel(found).tolist() if np.ndim(found) < 2 else []
    if len(numbers) not in (1, 2) or not all(0 < side <= float_info.max for side in numbers):
        raise ValueError("Input should be the side of a pixel, greater than 0 [m], or two of them, along x and y")
    return numbers[0], numbers[-1]


def check_layout(shape: tuple[int, ...], dtype: np.dtype) -> None:
    """Raise ValueError for the shape and type of an array that is no map of heights."""
    if len(shape) != 2 or min(shape) < LEAST:
        line = (
            '; a line of heights is roughness of type = "profile"' if sum(side > 1 for side in shape) == 1 else ""
        )
        raise ValueError(
            f"an array of shape {brief(str(shape))}: a map has at least {LEAST} rows and columns{line}"
        )
    if dtype.kind not in "fiu":
        raise ValueError(f"an array of type {brief(str(dtype))}: heights are real numbers [m]")


def picked(name: str, channels: Mapping[str, Any], channel: str | None, default: str | None = None) -> str:
    """Name of the channel that is chosen, as the file writes it, or of the only one.

    default : name of one that is taken where none is chosen

    Raises ValueError with the names where there are several and none is chosen, and where none has that name.
    """
    if channel is None and (default is not None or len(channels) == 1):
        return next(iter(channels)) if default is None else default
    names = brief(", ".join(map(repr, channels)))
    if channel is None:
        raise ValueError(
            f"{name} has {len(channels)} channels, {names}: choose one, channel = {next(iter(channels))!r}, or "
            "--channel on the command line"
        )
    alike = [each for each in channels if each == channel] or [
        each for each in channels if isinstance(channel, str) and each.casefold() == channel.casefold()
    ]
    if len(alike) != 1:
        raise ValueError(f"channel = {briefly(channel)}: {name} has {names}")
    return alike[0]
