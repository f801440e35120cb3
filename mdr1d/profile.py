"""Profile in one dimension of a three-dimensional indenter, g(x) = c_n |x|^n + h(x), Eqs. 1 and 2."""

from dataclasses import dataclass, replace
from functools import lru_cache
from math import ceil

import numpy as np

from scene import PowerLaw, Scene, SolveError
from scene.quantities import METRE, WHOLE, takes
from scene.scales import elastic_contact

from .lines import draw
from .surface import Spectrum, Surface, band_of

# Room beyond the farthest point that contact can reach.
_MARGIN = 1.05
# Span of a smooth contact over its grid below which the grid is drawn closer, and the room then left around it.
_LEAST_SHARE, _ROOM = 0.2, 1.05
# Pixels across a contact below which its forces are those of the pixels.
_LEAST_PIXELS = 5
# Nodes of a profile up to which it is kept: 50 MB at most, with their surfaces.
_MOST_KEPT = 2**13
# Quotients of lengths that are whole numbers but for rounding.
_ROUNDING = 1e-12


@dataclass(frozen=True)
class Grid:
    """Nodes x = -half, ..., half times the pixel: one lies at the tip.

    pixel : spacing of the nodes [m]
    half : nodes on each side of the tip
    period : nodes in a period of the roughness, a whole number; None on a smooth indenter
    """

    pixel: float
    half: int
    period: int | None = None

    @property
    def extent(self) -> float:
        """Distance of the last node from the first [m]."""
        return 2 * self.half * self.pixel

    @property
    def x(self) -> np.ndarray:
        """Coordinates of the nodes (2 half + 1,) [m]."""
        return np.arange(-self.half, self.half + 1) * self.pixel


@dataclass(frozen=True)
class Profile:
    """Rigid profile on a grid, linear between its nodes.

    x, heights : nodes and g at them (N,) [m]
    pixel : spacing of the nodes [m]
    lowest : least height [m], of the point that touches first
    rim : least height at the ends of the grid and beyond them [m]; at a lesser depth contact fits the grid
    surface : the rough line; None on a smooth indenter
    """

    x: np.ndarray
    heights: np.ndarray
    pixel: float
    lowest: float
    rim: float
    surface: Surface | None


def unmapped(scene: Scene) -> Scene:
    """The scene of the body whose mapped profile is the meridian c |x|^n of the given one: it has c / kappa_n.

    It has the smooth relaxed contact of the meridian taken as the line, so all that holds for a mapped profile
    holds.
    """
    given = scene.indenter
    c, n = given.coefficient, given.exponent
    return replace(scene, indenter=PowerLaw(coefficient=c / (given.mdr_coefficient / c), exponent=n))


def greatest_depth(scene: Scene, surface: Surface | None) -> float:
    """The prescribed depth, or a depth [m] at which the prescribed load is surely met.

    Viscosity only stiffens the contact, and the profile lies nowhere above c_n |x|^n + max h: the load is met no
    deeper than max h below the smooth elastic depth.
    """
    return elastic_contact(scene).depth + (0.0 if scene.motion.load is None else _extremes(surface)[1])


def contact_extent(scene: Scene, surface: Surface | None) -> float:
    """An extent [m] around the tip that no contact leaves, with 5 % to spare.

    Contact lies where the profile is below the depth, c_n |x|^n < d - min h.
    """
    return 2 * _MARGIN * _radius(scene.indenter, greatest_depth(scene, surface) - _extremes(surface)[0])


@takes(points=WHOLE, extent=METRE)
def lay_out(scene: Scene, points: int, extent: float | None, spectrum: Spectrum = "mapped") -> Grid:
    """Lay out `points` spacings over an extent [m], refined until they divide the period of the roughness.

    Without an extent it is the period where the grid is the cut-off, as in the paper, and else the least that
    surely holds the contact.
    """
    rough = scene.roughness
    if extent is None and rough is not None and rough.shortest is None:
        extent = rough.longest
    if extent is None:
        extent = contact_extent(scene, None if rough is None else _well_resolved(rough, spectrum))
    if rough is None:
        half = ceil(points / 2)
        return Grid(extent / (2 * half), half)
    length = band_of(rough, spectrum).period
    period = ceil(length * points / extent * (1 - _ROUNDING))
    pixel = length / period
    return Grid(pixel, ceil(extent / (2 * pixel) * (1 - _ROUNDING)), period)


def drawn_closer(layout: Grid, span: float, reach: float) -> float | None:
    """Extent [m] of a grid closer around a smooth contact that viscosity keeps small; None if this one is close.

    span : of the contact [m]; reach : its farthest point from the tip [m]
    """
    if span >= _LEAST_SHARE * layout.extent:
        return None
    # A contact of a few pixels is known to a pixel at best.
    return 2 * _ROOM * (reach + _LEAST_PIXELS * layout.pixel)


def check_resolved(body: Profile, span: float) -> None:
    """Raise SolveError where a contact, of a span [m] at its widest, has too few pixels."""
    if span < _LEAST_PIXELS * body.pixel:
        raise SolveError(
            f"the contact spans {span / body.pixel:.2g} pixels of {body.pixel:g} m, {_LEAST_PIXELS} are needed: "
            "take more points or a smaller extent"
        )


def map_profile(scene: Scene, grid: Grid, spectrum: Spectrum = "mapped") -> Profile:
    """Map the indenter to its one-dimensional profile and add the rough line, repeated as far as the grid goes.

    Scenes in a row often share it: the last ones are kept, and their arrays are read-only.
    """
    make = _kept if 2 * grid.half < _MOST_KEPT else _mapped
    return make(scene.indenter, scene.roughness, grid, spectrum)


def _mapped(indenter, roughness, grid, spectrum):
    x = grid.x
    heights, surface = _macroscopic(indenter, x), None
    rim = min(heights[0], heights[-1])
    if roughness is not None and grid.period is not None:
        surface = draw(roughness, grid.period, spectrum)
        heights += surface.heights[np.arange(-grid.half, grid.half + 1) % grid.period]
        # The shape only rises outwards and the roughness repeats: the first period beyond has the lowest point.
        beyond = np.arange(grid.half, grid.half + grid.period)
        rise = _macroscopic(indenter, beyond * grid.pixel)
        rim = min((rise + surface.heights[side % grid.period]).min() for side in (beyond, -beyond))
    for array in (x, heights):
        array.setflags(write=False)
    return Profile(x, heights, grid.pixel, float(heights.min()), float(rim), surface)


_kept = lru_cache(maxsize=256)(_mapped)


def _macroscopic(shape, x):
    return shape.mdr_coefficient * np.abs(x) ** shape.exponent


def _radius(shape, height):
    return (height / shape.mdr_coefficient) ** (1 / shape.exponent)


def _extremes(surface: Surface | None):
    return (float(surface.heights.min()), float(surface.heights.max())) if surface else (0.0, 0.0)


def _well_resolved(rough, spectrum) -> Surface:
    """The surface on 16 nodes a shortest wave: its extremes are those of any grid, to within the margin."""
    band = band_of(rough, spectrum)
    return draw(rough, ceil(16 * band.waves), spectrum)
