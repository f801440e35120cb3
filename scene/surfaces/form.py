"""Form of a map of heights: its mean, plane, and polynomials of second and third degree that fit it best."""

import numpy as np

DEGREES = {"mean": 0, "tilt": 1, "curvature": 2, "cubic": 3}
# Rest of a form once it is taken off, relative to the largest height.
ROUNDING = 1e-13


def levelled(heights: np.ndarray, level: str) -> np.ndarray:
    """Heights less their mean, or the plane ("tilt"), paraboloid ("curvature") or cubic that fits them best.

    What is left of no more than rounding is zero.
    """
    degree, most = DEGREES[level], np.abs(heights).max() or 1.0
    left = heights / most
    left = left - left.mean()
    if degree:
        # Products of orthonormal polynomials along the sides are orthonormal on any lattice of rows and columns.
        along_y, along_x = (_orthonormal(count, degree) for count in heights.shape)
        parts = along_y.T @ left @ along_x
        orders = np.add.outer(np.arange(degree + 1), np.arange(degree + 1))
        left = left - along_y @ np.where(orders <= degree, parts, 0.0) @ along_x.T
    if np.abs(left).max() <= ROUNDING:
        return np.zeros(heights.shape)
    return most * left


def _orthonormal(count, degree):
    """Polynomials of increasing degree on so many even places (count, degree + 1)."""
    return np.linalg.qr(np.vander(np.linspace(-1, 1, count), degree + 1, increasing=True))[0]
