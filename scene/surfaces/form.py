"""Form of a map or a line of heights: its mean, plane, and polynomials of second and third degree that fit it."""

from functools import lru_cache

import numpy as np

DEGREES = {"mean": 0, "tilt": 1, "curvature": 2, "cubic": 3}
# Rest of a form once it is taken off, relative to the largest height.
ROUNDING = 1e-13


def levelled(heights: np.ndarray, level: str) -> np.ndarray:
    """Heights less their mean, or the plane ("tilt"), paraboloid ("curvature") or cubic that fits them best.

    Of a line (N,) the polynomial of that degree. What is left of no more than rounding is zero.
    """
    most = np.abs(heights).max() or 1.0
    left = taken_off(taken_off(heights / most, DEGREES[level]), DEGREES[level])
    return most * left if np.abs(left).max() > ROUNDING else np.zeros(heights.shape)


def taken_off(heights: np.ndarray, degree: int) -> np.ndarray:
    """Heights of a map or a line less the polynomial of a degree that fits them best."""
    if heights.ndim == 1:
        return taken_off(heights[None], degree)[0]
    # Products of orthonormal polynomials along the sides are orthonormal on any lattice of rows and columns.
    along_y, along_x = (polynomials(count, degree) for count in heights.shape)
    parts = along_y.T @ heights @ along_x
    orders = np.add.outer(*map(np.arange, parts.shape))
    return heights - along_y @ np.where(orders <= degree, parts, 0.0) @ along_x.T


@lru_cache(maxsize=8)
def polynomials(count: int, degree: int) -> np.ndarray:
    """Orthonormal polynomials of increasing degree on so many even places (count, up to degree + 1)."""
    return np.linalg.qr(np.polynomial.legendre.legvander(np.linspace(-1, 1, count), min(degree, count - 1)))[0]
