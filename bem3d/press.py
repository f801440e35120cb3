"""Heights in, fields out: a rough surface pressed into an elastic half-space, in one call."""

from typing import Any

from scene import Elastic, Indent, Measured, Plane, Result, Scene, Topography
from scene.quantities import PASCAL, takes

from .solver import BEM


@takes(modulus=PASCAL)
def press(
    heights: Any,
    pixel: Any,
    modulus: float,
    *,
    pressure: Any = None,
    gap: Any = None,
    load: Any = None,
    depth: Any = None,
    unit: str | None = None,
    **settings: Any,
) -> Result:
    """Press a rigid surface, given by its heights, into an elastic half-space.

    heights : of the surface (M, N) [m], rows along y; the highest point touches first
    pixel : side of a pixel [m]
    modulus : contact modulus E* = E / (1 - nu^2) [Pa]
    pressure, gap : mean pressure [Pa] or mean gap [m] of a plane, which repeats beyond the map
    load, depth : load [N] or depth [m] of a body that ends where the map does, free of images
    unit : of the heights, "um" for example; absent, metres
    settings : of `BEM`; absent, the pixels of a square map are those of the grid

    One of pressure, gap, load and depth is given. Returns a Result with the fields pressure [Pa], gap and
    height [m] on the grid, and the measure contact_area [m^2]; a plane also has contact_fraction,
    mean_pressure and mean_gap. Raises InvalidInput; Refused, also of a plane that is no square; and SolveError.

    >>> import numpy as np
    >>> from bem3d import press
    >>> wave = np.cos(2 * np.pi * np.arange(32) / 32) * np.ones((32, 1))
    >>> answer = press(wave, unit="um", pixel="1 um", modulus="1 MPa", pressure="0.15 MPa")
    >>> print(f"{answer.measures['contact_fraction']:.0%}, {answer.fields['pressure'].max():.4g} Pa")
    100%, 2.482e+05 Pa
    """
    motion, free = Indent(pressure=pressure, gap=gap, load=load, depth=depth), pressure is gap is None
    read: dict[str, Any] = {"heights": heights, "pixel": pixel, "unit": unit}
    surface = Measured(**read) if free else Topography(**read, repeat="periodic", level="mean")
    grid = {"points": max(surface.heights.shape), "extent": max(surface.size) if free else None}
    placed: Any = (surface, None) if free else (Plane(), surface)
    return BEM(**(grid | settings)).solve(Scene(placed[0], Elastic(modulus / 4), motion, placed[1]))
