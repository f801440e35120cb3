"""Heights in, fields out: a rough surface pressed into an elastic half-space, in one call."""

from typing import Any

from scene import Elastic, Indent, InvalidInput, Plane, Result, Scene, Topography
from scene.quantities import PASCAL, takes

from .solver import BEM


@takes(modulus=PASCAL)
def press(
    heights: Any,
    pixel: Any,
    modulus: float,
    body: Any = None,
    *,
    load: Any = None,
    depth: Any = None,
    pressure: Any = None,
    gap: Any = None,
    unit: str | None = None,
    **settings: Any,
) -> Result:
    """Press a rigid rough surface into an elastic half-space.

    heights : of the surface (M, N) [m], rows along y; the highest point touches first
    pixel : side of a pixel [m]
    unit : of the heights, "um" for example; absent, metres
    modulus : contact modulus E* = E / (1 - nu^2) [Pa]
    body : the roughness is on this Sphere, Cone or PowerLaw, with the middle of the map at its tip; beyond its sides
        the map is mirrored. Absent, the surface is a plane that repeats, of a square map, and its grid is the map
    load, depth : of a body [N], [m], one of them
    pressure, gap : of a plane, means [Pa], [m], one of them
    settings : of `BEM`

    Returns a Result: fields pressure [Pa], gap and height [m] on (M, N) pixels, measures contact_area [m^2], of a
    plane contact_fraction, mean_pressure and mean_gap. Raises InvalidInput, and Refused and SolveError as `BEM`.

    >>> import numpy as np
    >>> from bem3d import press
    >>> wave = 1e-6 * np.cos(2 * np.pi * np.arange(32) / 32) * np.ones((32, 1))
    >>> answer = press(wave, pixel="1 um", modulus="1 MPa", pressure="0.15 MPa")
    >>> print(f"{answer.measures['contact_fraction']:.0%}, {answer.fields['pressure'].max():.4g} Pa")
    100%, 2.482e+05 Pa
    """
    read: dict[str, Any] = {} if unit is None else {"unit": unit}
    repeat: Any = "periodic" if body is None else "mirror"
    rough = Topography(heights=heights, pixel=pixel, repeat=repeat, level="mean", **read)
    given: dict[str, Any] = {"load": load, "depth": depth, "pressure": pressure, "gap": gap}
    motion = Indent(**{name: value for name, value in given.items() if value is not None})
    if body is None:
        rows, columns = rough.heights.shape
        if rough.size[0] != rough.size[1] or rows != columns:
            sides = " x ".join(f"{side:g} m" for side in rough.size)
            raise InvalidInput(
                f"heights of {rows} x {columns} pixels, {sides}: a plane repeats as a square, state as many rows as "
                "columns of square pixels, or a body"
            )
        settings = {"points": rows} | settings
    return BEM(**settings).solve(Scene(Plane() if body is None else body, Elastic(modulus / 4), motion, rough))
