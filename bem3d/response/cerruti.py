"""Tangential tractions on a half-space and the displacements that they cause along its surface.

Lengths are in pixels and tractions in units of the relaxed E*. A traction T on a point moves another one by

    u_x = [(1/r + c x^2/r^3) T_x + c x y/r^3 T_y] / pi,   u_y the same with x and y exchanged,   c = nu/(1 - nu):

Cerruti's solution; Johnson, Contact Mechanics (1985), Eqs. 3.75. Of a wave of traction the part along its crests
displaces by 2/|q| of it times 1 + c, the part across them by 2/|q| of it. On a row of pixels, alike all along y,
and at nu = 0, a traction along x displaces along x alone, and just as a pressure does along z.
"""

import numpy as np

from ..grid import Grid
from .convolution import FreePair, PeriodicPair
from .engine import Engine
from .memory import NEAR


def free(grid: Grid, poisson_ratio: float, engine: Engine) -> FreePair:
    """Tractions along x and y -> displacements, on a free surface."""
    return FreePair(paired(grid.points, poisson_ratio), engine)


def paired(points: int, poisson_ratio: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Kernels xx, xy, yy of a free surface (points, points), y and x = 0, 1, ... pixels away."""
    along, across = kernels(points)
    coupling = poisson_ratio / (1 - poisson_ratio)
    xx = along + along.T + coupling * along
    return xx, coupling * across, xx.T


def periodic(grid: Grid, poisson_ratio: float, engine: Engine) -> PeriodicPair:
    """Tractions along x and y -> displacements, on a cell that repeats; without the mean."""

    def symbols(q_y, q_x):
        q, coupling = _lengths(q_y, q_x), poisson_ratio / (1 - poisson_ratio)
        scale = 2 / q
        scale[0, 0] = 0.0
        mixed = coupling * scale / q**2
        return scale + mixed * q_y**2, -mixed * q_x * q_y, scale + mixed * q_x**2

    return PeriodicPair(grid.shape, symbols, engine)


def preconditioner(grid: Grid, poisson_ratio: float, engine: Engine) -> PeriodicPair:
    """Approximate inverse of both operators, wave by wave; a mean counts as half the lowest wave."""

    def symbols(q_y, q_x):
        q = _lengths(q_y, q_x)
        scale, mixed = (1 - poisson_ratio) * q / 2, poisson_ratio / (2 * q)
        scale[0, 0] = np.pi / grid.points / 2
        return scale + mixed * q_x**2, mixed * q_x * q_y, scale + mixed * q_y**2

    return PeriodicPair(grid.shape, symbols, engine)


def kernels(points: int) -> tuple[np.ndarray, np.ndarray]:
    """Means of x^2/r^3 and x y/r^3 over pixels, over pi; both (points, points), y and x = 0, 1, ... pixels away.

    The mean of y^2/r^3 is the first one transposed; the mean of 1/r (Love) is their sum.
    """
    at = np.arange(points, dtype=float)
    x, y = at[None, :], at[:, None]
    square = x * x + y * y
    square[0, 0] = 1.0
    # The mean over a distant pixel is the value and 1/24 of its Laplacian.
    along = (x * x + (2 * y * y - x * x) / (24 * square)) / square**1.5
    across = x * y * (1 - 1 / (8 * square)) / square**1.5
    near = min(points, NEAR)
    edge = np.arange(near + 1) - 0.5
    x, y = edge[None, :], edge[:, None]
    along[:near, :near] = _over_pixels(y * np.arcsinh(x / np.abs(y)))
    across[:near, :near] = _over_pixels(-np.hypot(x, y))
    return along / np.pi, across / np.pi


def _over_pixels(primitive):
    """Integral over each pixel, from the double primitive at the corners of pixels."""
    return np.diff(np.diff(primitive, axis=0), axis=1)


def _lengths(q_y, q_x):
    q = np.hypot(q_y, q_x)
    q[0, 0] = 1.0
    return q
