"""Heights to measure: noise, and one period of a rough surface as an instrument might give it."""

import numpy as np
import pytest

from bem3d.grid import Grid
from bem3d.surface import RoughSurface
from scene import InvalidInput, Topography


def noise(shape, seed=0):
    return np.random.default_rng(seed).normal(size=shape)


def sampled(rough, points=128, piece=None, **other):
    """One period of a surface as a map, or a piece of it: heights at the pixels of a grid."""
    grid = Grid(points, rough.longest)
    heights = RoughSurface.of(rough, rough.q_max(0.0)).heights(grid.x, grid.y)[:piece, :piece]
    stated = {"pixel": grid.pixel, "peaks": "down", "level": "mean", "repeat": "periodic"}
    return Topography(heights=heights, **(stated | other))


def squares_of_gaussians(squares):
    """Squares of moduli of complex Gaussian numbers are exponential: their mean and their distribution."""
    count, expected = len(squares), 1 - np.exp(-np.sort(squares))
    assert squares.mean() == pytest.approx(1.0, abs=4 / np.sqrt(count))  # standard errors
    assert np.abs(np.arange(count) / count - expected).max() < 1.95 / np.sqrt(count)  # but once in a thousand


def says(error):
    """The message of a raised error, on one line."""
    return " ".join(str(error.value).split())


def refused(message, part=Topography, *given, error=InvalidInput, **stated):
    """A part of a scene, a file of it, or its solve is refused, in words that can be printed and read."""
    with pytest.raises(error, match=message) as raised:
        part(*given, **stated)
    assert says(raised).isprintable()
    assert len(says(raised)) < 1000
