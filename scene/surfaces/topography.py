"""Measured roughness: the waves of a map of heights, which reproduce it at every pixel and repeat beyond it."""

from dataclasses import replace
from functools import lru_cache
from math import pi
from typing import Literal

import numpy as np
from pydantic import Field, model_validator
from pydantic.dataclasses import dataclass

from ..files.stated import restated
from ..quantities import Seed
from .form import levelled
from .scanned import MAPPED, QUOTIENT, Scanned
from .waves import MOST_WAVES, Waves

# Maps whose waves are kept for the next solve.
_KEPT = 4


@dataclass(frozen=True, config=MAPPED, kw_only=True)
class Topography(Scanned):
    """Roughness that was measured, of zero mean, around the indenter's axis.

    heights, pixel, peaks, shortest_kept : what was measured, and how much of it is kept, see `Scanned`
    level : what is taken off the heights first, their "mean", the plane ("tilt"), or the form of second degree
        ("curvature") or third ("cubic") that fits them best; absent, the plane of a map that is mirrored and the
        mean of one that repeats, which has no other: a plane taken off a period would leave a step at its sides
    repeat : how the map goes on beyond its sides: "mirror", mirrored at each, which leaves no step and has a
        period of twice the map, or "periodic", as it stands, for what was made to repeat
    seed : 0, the middle of the map lies under the indenter's axis; another, a pixel drawn at random. The row
        through that pixel is the line scan of the map, and a mapped line has the seed's phases

    Between pixels the heights are a sum of cosines that passes through all of them.
    """

    level: Literal["mean", "tilt", "curvature", "cubic"] = "tilt"
    repeat: Literal["mirror", "periodic"] = "mirror"
    seed: Seed = 0
    type: Literal["topography"] = Field(default="topography", repr=False)

    _level_of_what_repeats = restated(
        lambda cls, stated: {"level": "mean"} | stated if stated.get("repeat") == "periodic" else stated
    )

    @model_validator(mode="after")
    def _no_step(self):
        if self.repeat == "periodic" and self.level != "mean":
            raise ValueError(
                f'level = "{self.level}" with repeat = "periodic": taken off a period it would leave a step at '
                'its ends: take level = "mean", or repeat = "mirror"'
            )
        return self

    @property
    def sides(self) -> tuple[float, float]:
        return super().sides if self.repeat == "mirror" else self.size

    @property
    def period(self) -> float:
        """The longer side of the rectangle that repeats [m]."""
        return max(self.sides)

    @property
    def longest(self) -> float:
        """Longest wavelength along a side [m], which is the period."""
        return self.period

    @property
    def tops(self) -> tuple[int, int]:
        """Numbers of the shortest waves kept on the rectangle that repeats, along x and along y."""
        rows, columns = self.heights.shape
        counts = (columns - 1, rows - 1) if self.repeat == "mirror" else (columns // 2, rows // 2)
        if self.shortest_kept is None:
            return counts
        along_x, along_y = (int(side / self.shortest_kept * (1 + QUOTIENT)) for side in self.sides)
        return min(counts[0], along_x), min(counts[1], along_y)

    @property
    def shortest(self) -> float:
        """Shortest wavelength along a side [m]."""
        return min(side / top for side, top in zip(self.sides, self.tops, strict=True))

    def q_max(self, pixel: float) -> float:
        """Highest wave number along a side [rad/m]; the pixel of a grid does not matter."""
        return 2 * pi / self.shortest

    @property
    def flat(self) -> bool:
        """Whether nothing is left of the heights once `level` is taken off. Builds no waves."""
        return _flat(self if self.seed == 0 else replace(self, seed=0))

    @property
    def rms_height(self) -> float:
        """Rms height of the waves kept [m]. A wave of two pixels counts half of what it shows at the pixels."""
        return self.waves.rms_height

    @property
    def relief(self) -> np.ndarray:
        """Heights above the elastomer at the pixels, levelled (rows, columns) [m]."""
        return levelled(self._turned(), self.level)

    @property
    def crowded(self) -> str | None:
        """Reason why the waves do not fit in memory; None where they do."""
        if max(self.tops) <= MOST_WAVES:
            return None
        return f"{max(self.tops)} waves a side, {MOST_WAVES} fit in memory: crop the map, or state shortest_kept"

    @property
    def waves(self) -> Waves:
        """All that are kept; coordinates begin in the middle of the map, whatever the seed.

        Raises ValueError where they do not fit in memory.
        """
        return _waves(self if self.seed == 0 else replace(self, seed=0))

    @property
    def place(self) -> tuple[int, int]:
        """Place of the pixel under the axis, from the middle of the map: whole pixels along x, along y."""
        if self.seed == 0:
            return 0, 0
        draw = np.random.default_rng(self.seed)
        rows, columns = self.heights.shape
        return int(draw.integers(columns)) - columns // 2, int(draw.integers(rows)) - rows // 2

    @property
    def shift(self) -> tuple[float, float]:
        """Place in metres: heights at (x, y) of the indenter are those of the waves at (x, y) + shift."""
        (along_x, along_y), (dx, dy) = self.place, self.pixel
        return along_x * dx, along_y * dy


@lru_cache(maxsize=_KEPT)
def _flat(topography: Topography) -> bool:
    return not topography.relief.any()


@lru_cache(maxsize=_KEPT)
def _waves(topography: Topography) -> Waves:
    if topography.crowded is not None:
        raise ValueError(f"roughness = Topography has {topography.crowded}")
    build = _mirrored if topography.repeat == "mirror" else _periodic
    step_x, step_y = (2 * pi / side for side in topography.sides)
    waves = Waves(step_x, step_y, build(topography.relief, *topography.tops))
    if topography.shortest_kept is None:
        return waves
    return waves.below(2 * pi / topography.shortest_kept * (1 + QUOTIENT))


def _periodic(heights, top_x, top_y):
    """Amplitudes of the half plane of waves of a map that repeats, from its middle, up to so many along x and y.

    A wave of two pixels has no phase at them: half of it goes either way, so that nothing prefers one.
    """
    rows, columns = heights.shape
    k, j = np.arange(top_x + 1), np.arange(-top_y, top_y + 1)
    values = np.fft.rfft(heights, axis=1, norm="forward")[:, : top_x + 1]
    values = np.fft.fft(values, axis=0, norm="forward")[j % rows]
    half = 2 * _from_the_middle(j, rows)[:, None] * values * _from_the_middle(k, columns)
    half[: top_y + 1, 0] = 0.0  # twins of those above, and the mean
    return half


def _from_the_middle(waves, count):
    """Factors of the waves of so many pixels a side: to their middle, and half for a wave of two pixels."""
    return np.where(2 * np.abs(waves) == count, 0.5, 1.0) * np.exp(1j * pi * (count - 1) / count * waves)


def _mirrored(heights, top_x, top_y):
    """Waves of a map with its mirror images: a sum of products of cosines, each of them two or four waves."""
    # Only maps that are mirrored need it.
    from scipy.fft import dct

    products = dct(heights, type=2, axis=1, norm="forward")[:, : top_x + 1]
    products = dct(products, type=2, axis=0, norm="forward")[: top_y + 1]
    products[1:] *= 2
    products[:, 1:] *= 2
    k_y, k_x = np.arange(top_y + 1)[:, None], np.arange(top_x + 1)[None, :]
    upper = products * np.exp(0.5j * pi * (k_x + k_y))
    lower = products * np.exp(0.5j * pi * (k_x - k_y))
    upper[1:, 1:] /= 2
    half = np.concatenate([lower[:0:-1] / 2, upper])
    half[: top_y + 1, 0] = 0.0
    return half
