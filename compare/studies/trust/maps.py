"""Surfaces as people measure them, made up: maps of many spectra and heights, cut from larger ones and tilted."""

from math import ceil, exp, log, pi, sqrt
from typing import NamedTuple

import numpy as np

from scene import SelfAffine, Topography

# Share of the surfaces that are no maps, but drawn with Gaussian amplitudes.
GAUSSIAN = 0.2
# Longest waves of these over the radius of the contact.
LONGEST = 1.0, 25.0
# Side of a map over the radius of the contact, pixels to its shortest wave, and pixels along a side.
SIDES, PIXELS, PIXELS_A_SIDE = (3.0, 12.0), (2.5, 6.0), (32, 256)
# Side of the map that it is cut from, over its own.
WHOLE = 1.6
# Waves in a band, from the longest to the shortest, and widths of a peak in ln q.
BANDS, PEAKS = (1.2, 6.0), (0.12, 0.6)
# Shares of the maps with noise of the instrument, heights that are no Gaussian process, and a direction.
NOISY, BENT, DIRECTED = 0.3, 0.5, 0.3
NOISES, STRETCHES = (3e-3, 3e-2), (1.0, 1.35)
# Of z -> sinh((asinh z + skew) / tail): how far heights are skewed, either way, and how long their tails are.
SKEWS, TAILS = 0.5, (0.75, 1.4)
TILT = 0.5  # of the rms height over the map, at most


class Numbers(NamedTuple):
    """Numbers of a surface, each from 0 to 1."""

    kind: float
    spectrum: float
    side: float
    pixels: float
    first: float
    second: float
    place: float
    noise: float
    noisy: float
    bent: float
    skew: float
    tail: float
    directed: float
    stretch: float


def surface(numbers: Numbers, height: float, wave: float, radius: float, seed: int) -> SelfAffine | Topography:
    """Surface as it is measured.

    height : rms [m]; wave : the shortest, radius : of the contact [m]; seed : of its first place or surface
    """
    if numbers.kind >= GAUSSIAN:
        return _map(numbers, height, wave, radius, seed)
    longest = between((max(LONGEST[0] * radius, 2 * wave), LONGEST[1] * radius), numbers.side)
    return SelfAffine(
        hurst=numbers.first,
        rms_height=height,
        longest=longest,
        rolloff=between((wave, longest), max(numbers.second, 1e-3)) if numbers.place < 0.5 else None,
        shortest=wave,
        seed=seed,
        amplitudes="gaussian",
    )


def between(ends: tuple[float, float], place: float) -> float:
    """Number at a place, 0 to 1, between two ends, in equal ratios."""
    low, high = ends
    return exp(log(low) + place * log(high / low))


def _map(numbers: Numbers, height: float, wave: float, radius: float, seed: int) -> Topography:
    """Map with waves down to about the shortest one, which the pixels show."""
    least, most = PIXELS_A_SIDE
    pixel = wave / between(PIXELS, numbers.pixels)
    count = min(max(round(between(SIDES, numbers.side) * radius / pixel), least), most)
    draw = np.random.default_rng(seed)
    found = _parent(numbers, ceil(WHOLE * count), pixel, wave, draw)[:count, :count]
    found = _heights((found - found.mean()) / found.std(), numbers, draw)
    found *= height / found.std()
    tilt = TILT * found.std() * draw.uniform(-1, 1, 2)
    across = np.linspace(-1, 1, count)
    return Topography(
        heights=found + tilt[0] * across + tilt[1] * across[:, None], pixel=(pixel, pixel), seed=seed + 1
    )


def _parent(numbers, count, pixel, wave, draw):
    """Map (count, count) that repeats, of a spectrum and random phases."""
    angle = pi * draw.random()
    stretch = between(STRETCHES, numbers.stretch) if numbers.directed < DIRECTED else 1.0
    q_x, q_y = 2 * pi * np.fft.rfftfreq(count, pixel), 2 * pi * np.fft.fftfreq(count, pixel)[:, None]
    along, across = np.cos(angle) * q_x + np.sin(angle) * q_y, np.cos(angle) * q_y - np.sin(angle) * q_x
    q = np.hypot(along * sqrt(stretch), across / sqrt(stretch))
    with np.errstate(divide="ignore", invalid="ignore"):
        density = _density(numbers, q, 2 * pi / wave, 2 * pi / (count * pixel))
    density[0, 0] = 0.0
    noise = draw.standard_normal((count, count))
    return np.fft.irfft2(np.fft.rfft2(noise) * np.sqrt(np.where(density > 0, density, 0.0)), s=(count, count))


def _density(numbers, q, shortest, longest):
    """Density in wave numbers of any size: two straight pieces, a peak, a band, or a roll-off."""
    inside = q <= shortest * 1.0001
    middle = between((longest * 1.5, shortest), numbers.place)
    if numbers.spectrum < 0.3:
        powers = -2 * numbers.first - 2, -2 * numbers.second - 2
        return np.where(inside, np.where(q < middle, (q / middle) ** powers[0], (q / middle) ** powers[1]), 0.0)
    if numbers.spectrum < 0.5:
        middle = between((max(longest * 4, shortest / 16), shortest / 1.3), numbers.place)
        return np.exp(-np.square(np.log(q / middle) / between(PEAKS, numbers.first)) / 2)
    if numbers.spectrum < 0.7:
        low = max(shortest / between(BANDS, numbers.second), 2 * longest)
        return np.where(inside & (q >= min(low, 0.8 * shortest)), q ** (-2 * numbers.first - 2), 0.0)
    return np.where(inside, np.maximum(q / middle, 1.0) ** (-2 * numbers.first - 2), 0.0)


def _heights(z, numbers, draw):
    """Heights of unit rms with the noise of an instrument, or no Gaussian process."""
    if numbers.bent < BENT:
        z = np.sinh((np.arcsinh(z) + SKEWS * (2 * numbers.skew - 1)) / between(TAILS, numbers.tail))
    if numbers.noisy < NOISY:
        z = z + z.std() * between(NOISES, numbers.noise) * draw.standard_normal(z.shape)
    return z
