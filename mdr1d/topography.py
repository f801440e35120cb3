"""Rough lines of measured roughness: from the spectrum or a row of a map, or a measured line itself."""

from dataclasses import replace
from functools import lru_cache
from math import nan, pi, sqrt

import numpy as np

from scene import Profile, Scene, Topography
from scene.scene import described

from .surface import Band, LineFamily, Spectrum, Surface, band_of, through
from .term import Term


class MeasuredRoughness(Term):
    """The map repeats as it states; lines are drawn from its waves."""

    def refusals(self, scene: Scene) -> list[str]:
        """Reasons to refuse maps with more waves than fit in memory."""
        return [] if self.part.crowded is None else [f"roughness = Topography has {self.part.crowded}"]


class FittedRoughness(Term):
    """A measured line as the surface that is fitted to it; as a line scan, it is itself the rough line."""

    @property
    def says(self) -> str:
        """The line, and the surface from which lines are drawn."""
        return (
            f'{described(self.part)} by {described(self.part.fitted)}; with spectrum = "line-scan" the line itself'
        )


def amplitudes(topography: Topography) -> np.ndarray:
    """Amplitudes of the waves k = 1, 2, ... of a mapped line (K,) [m]: C_1D = pi q C_2D as a sum over waves.

    Wave k has the mean square of all waves of the map whose wave number, in any direction, lies within half a step
    of its own. Their sum is the mean square of the map.
    """
    band = band_of(topography, "mapped")
    count = round(band.waves)
    edges = np.append(0.0, np.arange(1, count + 1) + 0.5) * 2 * pi / band.period
    edges[-1] = np.inf
    return sqrt(2) * topography.waves.binned(edges)


def draw(topography: Topography, nodes: int, spectrum: Spectrum) -> Surface:
    """One period of a line on `nodes` nodes; the seed of the topography chooses its phases, or the row."""
    band = band_of(topography, spectrum)
    if spectrum == "line-scan":
        return _row(topography, nodes, band)
    return _mapped(replace(topography, seed=0), nodes).drawn(topography.seed)


@lru_cache(maxsize=16)
def _mapped(topography, nodes):
    """Mapped amplitudes, evaluated once for all seeds."""
    band, waves = band_of(topography, "mapped"), amplitudes(topography)
    waves.setflags(write=False)
    return LineFamily(waves, False, nodes, band.period / nodes, band.shortest or nan)


def _row(topography: Topography, nodes: int, band: Band) -> Surface:
    """The map along the row through the place of its seed, which lies at the tip; the mean of the row left out."""
    waves, (columns, rows) = topography.waves, topography.place
    count = topography.heights.shape[0]
    # The middle of an even number of rows lies between two: it is the upper one.
    y = (count // 2 + rows - (count - 1) / 2) * topography.pixel[1]
    found = waves.row(y) * np.exp(1j * waves.along_x[1:] * columns * topography.pixel[0])
    return through(found, nodes, band)


def draw_line(profile: Profile, nodes: int) -> Surface:
    """One period of the measured line on `nodes` nodes, the point of its seed at the tip."""
    return through(profile.waves, nodes, band_of(profile, "line-scan"))
