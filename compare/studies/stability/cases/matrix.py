"""The complementarity problem as a matrix, and the rule of dropping and adding at once, which can cycle."""

import numpy as np

from bem3d import contact

from .conditions import collocation, influence, retarded
from .hardcase import Check

FINE = 1e-9  # tolerance of problems given as a matrix


class Matrix:
    """The influence of ny x nx square pixels on one another as a matrix; an operator on planes.

    memory : of a Kelvin body [pixel], 0 at rest
    """

    def __init__(self, ny, nx, memory=0.0):
        share, lengths = np.ones(int(memory > 0)), np.full(int(memory > 0), memory)
        instantaneous = float(memory == 0)
        self.shift = collocation(instantaneous, share, lengths)
        x = np.arange(1 - nx, nx) + self.shift
        kernel = instantaneous * influence(x, ny) + retarded(x, ny, share, lengths)
        row, column = (index.ravel() for index in np.indices((ny, nx)))
        self.values = kernel[nx - 1 + column[:, None] - column, np.abs(row[:, None] - row)]
        self.shape, self.memory, self.symmetric = (ny, nx), memory, memory == 0

    def __call__(self, plane, out=None):
        image = (self.values @ plane.ravel()).reshape(self.shape)
        if out is None:
            return image
        out[:] = image
        return out


def solved(matrix: Matrix, heights, start=None, **given) -> contact.Contact:
    """The contact at a depth or a load [pixel], to FINE; start by default where the surfaces overlap."""
    if start is None:
        start = contact.first_guess(heights, heights.size // 4)
    return contact.solve(matrix, heights, start, FINE, symmetric=matrix.symmetric, **given)


def conditions(matrix: Matrix, heights, found: contact.Contact, where: str) -> tuple[Check, ...]:
    """Conditions of a solved problem, by a plain product, to FINE: p >= 0, gap >= 0, p gap = 0."""
    gap = matrix(found.pressure) + heights - found.depth
    touched = found.pressure > 0
    scale = max(found.depth, heights[touched].max()) - heights.min() or np.ptp(heights) or 1.0
    return (
        Check(f"{where}: suction", max(-found.pressure.min(), 0.0), 0.0),
        Check(f"{where}: penetration", max(-gap.min() / scale, 0.0), FINE),
        Check(f"{where}: gap under pressure", np.abs(gap[touched]).max() / scale, FINE),
    )


def rounds_at_once(matrix: Matrix, heights, depth: float, most: int, touched) -> int:
    """Rounds of dropping and adding at once until the set of contact stays, each exact; most for a cycle."""
    for count in range(most):
        pressure = np.zeros(heights.size)
        where = np.flatnonzero(touched)
        pressure[where] = np.linalg.solve(matrix.values[np.ix_(where, where)], (depth - heights).ravel()[where])
        gap = (matrix.values @ pressure).reshape(heights.shape) + heights - depth
        after = np.where(touched, pressure.reshape(heights.shape) > 0, gap < 0)
        if np.array_equal(after, touched):
            return count
        touched = after
    return most


class Ring(Matrix):
    """Points in rings of three, each pushed by the next: positive definite for a coupling below 2.

    From 1 on, dropping and adding at once passes round each ring for ever.
    """

    def __init__(self, copies, coupling):
        ring = np.eye(3) + coupling * np.roll(np.eye(3), 1, axis=1)
        self.values = np.kron(np.eye(copies), ring)
        self.shape, self.symmetric = (copies, 3), False
