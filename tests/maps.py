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


def says(error):
    """The message of a raised error, on one line."""
    return " ".join(str(error.value).split())


def refused(message, part=Topography, **stated):
    """A part of a scene is refused, in words that can be printed and read."""
    with pytest.raises(InvalidInput, match=message) as error:
        part(**stated)
    assert says(error).isprintable()
    assert len(says(error)) < 1000
