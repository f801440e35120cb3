"""Measured roughness: the waves of a map of heights, which reproduce it at every pixel and repeat beyond it."""

from dataclasses import dataclass as plain
from dataclasses import replace
from functools import cached_property, lru_cache
from math import frexp, ldexp, pi, sqrt
from typing import Literal

import numpy as np
from pydantic import Field, model_validator
from pydantic.dataclasses import dataclass

from ..files.stated import restated
from ..quantities import Seed
from .heightmap import levelled
from .scanned import MAPPED, QUOTIENT, Scanned

MOST_WAVES = 2560  # along a side of what repeats: 210 MB of amplitudes


@plain(frozen=True, eq=False)
class Waves:
    """h(x, y) = Re sum amplitudes[j, k] exp(i (along_y[j] y + along_x[k] x)), without a mean.

    step_x, step_y : spacings of the lattice [rad/m], 2 pi over the sides of what repeats
    amplitudes : complex (2 J + 1, K + 1), rows from -J to J, columns from 0 to K: a half plane [m]
    """

    step_x: float
    step_y: float
    amplitudes: np.ndarray

    @property
    def along_x(self) -> np.ndarray:
        """Wave numbers along x (K + 1,) [rad/m]."""
        return self.step_x * np.arange(self.amplitudes.shape[1])

    @property
    def along_y(self) -> np.ndarray:
        """Wave numbers along y (2 J + 1,) [rad/m]."""
        top = self.amplitudes.shape[0] // 2
        return self.step_y * np.arange(-top, top + 1)

    @property
    def q(self) -> np.ndarray:
        """Wave numbers [rad/m], of the shape of the amplitudes."""
        return np.hypot(self.along_y[:, None], self.along_x[None, :])

    @cached_property
    def unit(self) -> float:
        """A power of two within the greatest amplitude [m]: over it squares stay numbers, and lose no digit."""
        return _unit(float(np.abs(self.amplitudes).max()))

    @property
    def power(self) -> np.ndarray:
        """Mean squares of the waves over the unit squared [1], of the shape of the amplitudes."""
        return np.square(np.abs(self.amplitudes) / self.unit) / 2

    @cached_property
    def rms_height(self) -> float:
        """Rms height over a period [m]."""
        return self.unit * sqrt(self.power.sum())

    @cached_property
    def rms_slope(self) -> float:
        """Spectral rms slope of the full gradient [1]."""
        return self._rms_slope(self.along_x, self.along_y)

    @cached_property
    def rms_slope_x(self) -> float:
        """Spectral, of dh/dx [1]."""
        return self._rms_slope(self.along_x, 0.0 * self.along_y)

    @cached_property
    def rms_slope_y(self) -> float:
        """Spectral, of dh/dy [1]."""
        return self._rms_slope(0.0 * self.along_x, self.along_y)

    def _rms_slope(self, along_x, along_y):
        unit = _unit(max(self.step_x, self.step_y))
        squares = (along_y[:, None] / unit) ** 2 + (along_x[None, :] / unit) ** 2
        return self.unit * unit * sqrt(np.sum(squares * self.power))

    def binned(self, edges: np.ndarray) -> np.ndarray:
        """rms heights [m] of the waves between wave numbers edges[k] <= q < edges[k + 1], (len(edges) - 1,)."""
        found, _ = np.histogram(self.q, edges, weights=self.power)
        return self.unit * np.sqrt(found)

    def row(self, y: float) -> np.ndarray:
        """Amplitudes (K,) [m] of the line at y [m]: Re sum_k a[k - 1] exp(i along_x[k] x), without mean."""
        return (np.exp(1j * self.along_y * y) @ self.amplitudes)[1:]

    def moved(self, x: float, y: float) -> "Waves":
        """Waves of h(x' + x, y' + y)."""
        turn = np.exp(1j * self.along_y * y)[:, None] * np.exp(1j * self.along_x * x)
        return Waves(self.step_x, self.step_y, self.amplitudes * turn)

    def below(self, highest: float) -> "Waves":
        """Waves up to a wave number [rad/m], on the same lattice."""
        return Waves(self.step_x, self.step_y, np.where(self.q <= highest, self.amplitudes, 0.0))


def _unit(value):
    """The greatest power of two that is no greater; 1 of zero."""
    return ldexp(0.5, frexp(value)[1]) if value else 1.0


# Maps whose waves are kept for the next solve.
_KEPT = 4


@dataclass(frozen=True, config=MAPPED, kw_only=True)
class Topography(Scanned):
    """Roughness that was measured, of zero mean, around the indenter's axis.

    heights, pixel, peaks, shortest_kept : what was measured, and how much of it is kept, see `Scanned`
    level : what is taken off the heights first, their "mean", the plane ("tilt"), or the form of second degree
        ("curvature") or third ("cubic") that fits them best; absent, the plane of a map that is mirrored and the
        mean of a map that repeats, as a plane taken off a period would leave a step at its sides
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
        remedy = "take a part of the map, or state shortest_kept"
        return f"{max(self.tops)} waves a side, {MOST_WAVES} fit in memory: {remedy}"

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
    """Amplitudes of the half plane of waves of a map that repeats, from its middle, up to `top_x` and `top_y`.

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
    """Factors of the waves of `count` pixels a side: to their middle, and half for a wave of two pixels."""
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
