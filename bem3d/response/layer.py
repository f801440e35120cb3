"""The elastomer is a layer on a rigid base: kernels and waves of its surface, and the term of a scene.

Lengths are in pixels and pressures in units of the relaxed E*, as in `influence`. The kernel is the one of a
half-space less what the base takes off, smooth on the scale of the thickness; beyond REACH thicknesses it is
zero.

A grid does not show how the pressure varies within a layer thinner than a pixel. On it such a layer is a bed of
springs, coupled by the next order in q h: its kernel is the scaled kernel of a layer a pixel thick, and springs
for the rest.
"""

from dataclasses import dataclass, replace
from math import prod

import numpy as np

from scene import Layer, Plan, Plane, Scene
from scene.plan import Kernel

from ..grid import Grid
from ..term import Term
from . import influence
from .layerwaves import PIECES, REACH, Base, Bonded, Frictionless, taking

MEAN = 1e13  # over the thickness: one over the error of the mean over a pixel of what the base takes off
FALSIFIED = 1e-2  # of the force: what a grid may falsify beyond what it does on a half-space
UNSHOWN = 50.0, 3.0  # of what spreads between pixels thicker than the layer, see `Layered.falsified`
ADDED = 0.024, 6.0  # of what the waves of a pixel and less add to the spreading
MARGIN = 1.15  # window over contact, before the contact is known
SPARE = 1.25  # points over what a contact needs: on a finer grid it has another radius
ALLOWED = np.arange(16, 16385)  # points a side


@dataclass(frozen=True)
class Layered:
    """The elastomer is a layer: thickness [m], base. Far from a load the surface stays: lines need no datum."""

    thickness: float
    base: Base

    @classmethod
    def of(cls, layer: Layer, poisson_ratio: float) -> "Layered":
        """Layer as a scene states it."""
        return cls(layer.thickness, Bonded(poisson_ratio) if layer.base == "bonded" else Frictionless())

    def elastic(self, grid):
        return influence.elastic(*grid.shape[::-1], displacement=self.by_pixel(grid.pixel))

    def flowing(self, grid, instantaneous, shares, lengths, shift):
        kernel = self.by_pixel(grid.pixel)
        return influence.flowing(*grid.shape[::-1], instantaneous, shares, lengths, shift, kernel)

    def line(self, grid):
        return influence.elastic(grid.points, 1, displacement=self.by_strip(grid.pixel))

    def line_flowing(self, grid, instantaneous, shares, lengths, shift):
        kernel = self.by_strip(grid.pixel)
        return influence.flowing(grid.points, 1, instantaneous, shares, lengths, shift, kernel)

    def compliance(self, q, pixel):
        return 2 / q * self.base.yields(q * (self.thickness / pixel))

    def stiffness(self, q, pixel):
        return q / 2 / self.base.yields(q * (self.thickness / pixel))

    def by_pixel(self, pixel: float) -> influence.Displacement:
        """Displacement by a loaded pixel [m], as `influence.by_pixel`."""
        return _shown(ByPixel, self.base, self.thickness / pixel)

    def by_strip(self, pixel: float) -> influence.Displacement:
        """Displacement by a loaded strip as wide as a pixel [m], in the first and only row."""
        return _shown(ByStrip, self.base, self.thickness / pixel)

    def falsified(self, pixel, radius: float):
        """Relative error of the force of a contact of this radius [m] by the pixels [m] of a free surface.

        With l the length over which a layer spreads the pressure and x = (l/a)^2, of pixels D (any shape)

            50 x/(1 + 3x) (D/a)^2 [1 - (h/D)^2] + 0.024 min(D/h, 1)^3 6x/(1 + 6x),

        the first for D > h only: pixels thicker than the layer do not show how it spreads, measured against round
        contacts that are known without a grid. The second: a pressure that is constant on pixels has waves of a
        pixel and less, which at the pixels' centres look like long ones. Neither falls with D.
        """
        spread = min(self.base.spread * self.thickness / radius, 1e6) ** 2
        (most, over), (added, below) = UNSHOWN, ADDED
        unshown = most * spread / (1 + over * spread) * (pixel / radius) ** 2
        hidden = 1 - (np.minimum(self.thickness, pixel) / pixel) ** 2
        alike = added * (np.minimum(self.thickness, pixel) / self.thickness) ** 3
        return unshown * hidden + alike * below * spread / (1 + below * spread)


def unresolved(scene: Scene, grid: Grid, radius: float | None = None) -> list[str]:
    """Reason why a grid on the free surface of a layer falsifies a contact, if it does.

    radius : of the contact [m]; by default the contact fills the grid
    """
    layer, poisson_ratio = scene.layer, scene.solid.poisson_ratio
    if layer is None or falsified(scene, grid, radius) <= FALSIFIED:
        return []
    radius = _radius(grid, radius)
    return [
        f"layer.thickness = {layer.thickness:g} m of nu = {poisson_ratio:.15g} is too thin for "
        f"pixels of {grid.pixel:g} m: a layer that hardly yields to an even pressure has to be resolved; "
        + _remedy(layer, poisson_ratio, grid, radius)
    ]


def falsified(scene: Scene, grid: Grid, radius: float | None = None) -> float:
    """Relative error of the force that the pixels of a grid make on a layer; radius : see `unresolved`."""
    layer = scene.layer
    if layer is None:
        return 0.0
    return Layered.of(layer, scene.solid.poisson_ratio).falsified(grid.pixel, _radius(grid, radius))


def _radius(grid, radius):
    return grid.extent / 2 / MARGIN if radius is None else radius


def _remedy(layer, poisson_ratio, grid, radius):
    """Advice on a grid that would not falsify the contact."""
    good = Layered.of(layer, poisson_ratio).falsified(grid.extent / ALLOWED, radius) <= FALSIFIED
    if good.any():
        enough = ALLOWED[good.argmax()]
        return f"points = {min(int(np.ceil(SPARE * enough)), ALLOWED[-1])} would do"
    margins = (digit * 10.0**-power for power in range(14, 0, -1) for digit in range(1, 10))
    below = next(0.5 - m for m in margins if Layered.of(layer, 0.5 - m).falsified(grid.pixel, radius) <= FALSIFIED)
    return (
        f"no allowed number of points would do: take a thicker layer, a smaller extent, or a Poisson ratio of at "
        f"most {below:.15g}"
    )


def _shown(kind, base, thickness):
    if thickness >= 1:
        return kind(base, thickness)
    return Thin(kind(base, 1.0), thickness)


@dataclass(frozen=True)
class ByPixel:
    """Displacement by a loaded pixel, of a layer no thinner than it; thickness [pixel]."""

    base: Base
    thickness: float

    def __call__(self, x, s, ny):
        """Displacement at x - s, rows 0..ny-1: shape of x - s, then (ny,)."""
        reach, (x, s) = _reach(self.thickness), np.broadcast_arrays(x, s)
        out, seen = np.zeros((*x.shape, ny)), np.abs(x - s) < reach
        rows = int(min(ny, reach + 1))
        if seen.any():
            x, s, y = x[seen], s[seen], np.arange(rows)
            values = influence.by_pixel(x, s, rows) - self._taken((x - s)[:, None], y) / np.pi / self.thickness
            out[seen, :rows] = np.where(np.hypot((x - s)[:, None], y) < reach, values, 0.0)
        return out

    def _taken(self, x, y):
        """Mean over the pixel, in thicknesses."""
        nodes, table = list(zip(*_over_pixel(self.thickness), strict=True)), taking(self.base).from_point
        squares = [((y + v) / self.thickness) ** 2 for v, _ in nodes]
        total = np.zeros((len(x), len(y)))
        for u, along in nodes:
            square = ((x + u) / self.thickness) ** 2
            for aside, (_, across) in zip(squares, nodes, strict=True):
                distance = square + aside
                total += along * across * table(np.sqrt(distance, out=distance))
        return total


@dataclass(frozen=True)
class ByStrip:
    """Displacement by a loaded strip, of a layer no thinner than it is wide; thickness [pixel]."""

    base: Base
    thickness: float

    def __call__(self, x, s, ny):
        """Displacement at x - s: its shape, then (1,)."""
        x = x - s
        return np.where(np.abs(x) < _reach(self.thickness), 2 / np.pi * self._left(x), 0.0)[..., None]

    def _left(self, x):
        table = taking(self.base).from_line
        nodes = zip(*_over_pixel(self.thickness), strict=True)
        taken = sum(w * table(np.minimum(np.abs(x + u) / self.thickness, REACH)) for u, w in nodes)
        return np.log(self.thickness) - influence.mean_log(x) - taken


@dataclass(frozen=True)
class Thin:
    """A layer thinner than a pixel: thickness [pixel] below one. shown : displacement on one a pixel thick.

    Waves much longer than a pixel displace it as they should, to the order of (q h)^3.
    """

    shown: ByPixel | ByStrip
    thickness: float

    def __call__(self, x, s, ny):
        """Displacement at x - s, as for a thicker layer."""
        out = self.thickness**3 * self.shown(x, s, ny)
        springs = 2 * self.shown.base.springs * (self.thickness - self.thickness**3)
        out[..., 0] += springs * (np.sign(0.5 - np.abs(x - s)) + 1) / 2
        return out


def _reach(thickness):
    """Distance [pixel] up to which every part of a pixel is within REACH."""
    return REACH * thickness - 1


def _over_pixel(thickness):
    """Gauss nodes (n,) on a pixel and weights: what the base takes off is singular two thicknesses aside."""
    count = int(np.ceil(np.log(max(MEAN / thickness, 1.0)) / (2 * np.arcsinh(4 * thickness))))
    x, w = np.polynomial.legendre.leggauss(max(count, 1))
    return x / 2, w / 2


class LayerTerm(Term):
    """The thickness enters the response, and nothing else."""

    def medium(self, medium, scene: Scene):
        """Medium with the same surface on a layer."""
        return replace(medium, kernel=Layered.of(self.part, scene.solid.poisson_ratio))

    def planned(self, plan: Plan, scene: Scene) -> Plan:
        """Plan with the table of what the base takes off; a surface that repeats needs none."""
        if isinstance(scene.indenter, Plane):
            return plan
        table = Kernel("what the base takes off", "table", PIECES)
        return replace(plan, kernels=(*plan.kernels, table), memory=plan.memory + 8 * prod(PIECES))
