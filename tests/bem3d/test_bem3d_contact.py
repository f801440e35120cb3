"""The complementarity solver on dense problems, checked by plain products: ties, plateaus, poor starts, cycles."""

from functools import partial

import numpy as np
import pytest
from maps import noise

from bem3d.contact import activeset as contact
from compare.studies.checks.conditions import collocation, influence, retarded

FINE = 1e-9  # tolerance of the contacts, and of their conditions by a plain product
OF_PEAK = 1e-6  # of a pressure whose contact is solved to FINE


class Matrix:
    """The influence of ny x nx square pixels on one another as a matrix; an operator on planes.

    memory : of a Kelvin body [pixel], 0 at rest
    """

    def __init__(self, ny, nx, memory=0.0):
        share, lengths = np.ones(int(memory > 0)), np.full(int(memory > 0), memory)
        instantaneous = float(memory == 0)
        x = np.arange(1 - nx, nx) + collocation(instantaneous, share, lengths)
        kernel = instantaneous * influence(x, ny) + retarded(x, ny, share, lengths)
        row, column = (index.ravel() for index in np.indices((ny, nx)))
        self.values = kernel[nx - 1 + column[:, None] - column, np.abs(row[:, None] - row)]
        self.shape, self.symmetric = (ny, nx), memory == 0

    def __call__(self, plane, out=None):
        image = (self.values @ plane.ravel()).reshape(self.shape)
        if out is None:
            return image
        out[:] = image
        return out


class Ring(Matrix):
    """Points in rings of three, each pushed by the next: positive definite for a coupling below 2.

    From 1 on, dropping and adding at once passes round each ring for ever.
    """

    def __init__(self, copies, coupling):
        self.values = np.kron(np.eye(copies), np.eye(3) + coupling * np.roll(np.eye(3), 1, axis=1))
        self.shape, self.symmetric = (copies, 3), False


def solved(matrix, heights, start=None, **given):
    """The contact at a depth or a load [pixel], from where the surfaces overlap; its conditions are checked."""
    if start is None:
        start = contact.first_guess(heights, heights.size // 4)
    found = contact.solve(matrix, heights, start, FINE, symmetric=matrix.symmetric, **given)
    gap = (matrix.values @ found.pressure.ravel()).reshape(matrix.shape) + heights - found.depth
    touched = found.pressure > 0
    scale = max(found.depth, heights[touched].max()) - heights.min() or np.ptp(heights) or 1.0
    assert found.pressure.min() >= 0
    assert gap.min() >= -FINE * scale
    assert np.abs(gap[touched]).max() <= FINE * scale
    return found


def from_the_middle(n):
    """Square of the distance from the middle of a square of n points a side."""
    y, x = np.mgrid[:n, :n] - (n - 1) / 2
    return x**2 + y**2


def alike(found, known):
    np.testing.assert_allclose(found.ravel(), known.ravel(), rtol=0, atol=OF_PEAK * known.max())


CHECKERBOARD = np.indices((14, 14)).sum(axis=0) % 2 * 1.0
CASES = {
    "a flat punch of ties in a flow": (Matrix(10, 13, 5.0), np.zeros((10, 13)), {"load": 1.0}),
    **{
        f"a checkerboard, memory {memory:g}, {load:g}": (Matrix(14, 14, memory), CHECKERBOARD, {"load": load})
        for memory in (0.0, 3.0)
        for load in (0.5, 50.0)
    },
    **{
        f"rough and fast, {memory:g} pixels, seed {seed}": (
            Matrix(24, 24, memory),
            from_the_middle(24) / 120 + 0.3 * noise((24, 24), seed),
            {"depth": 0.5},
        )
        for memory in (1.0, 100.0, 1e4)
        for seed in (0, 1)
    },
    **{
        f"{ny} x {nx}, memory {memory:g}": (
            Matrix(ny, nx, memory),
            noise((ny, nx), ny),
            {"load": 3.0},
        )
        for ny, nx in ((3, 40), (40, 3), (7, 13), (1, 60))
        for memory in (0.0, 4.0)
    },
}


@pytest.mark.parametrize("name", CASES)
def test_conditions_of_contact_hold_by_a_plain_product(name):
    matrix, heights, given = CASES[name]
    solved(matrix, heights, **given)


@pytest.mark.parametrize("memory", [0.0, 8.0])
def test_the_pressure_is_the_same_from_any_start(memory):
    heights, matrix = noise((16, 16), 7), Matrix(16, 16, memory)
    known = solved(matrix, heights, load=5.0).pressure
    starts = {
        "the highest point": heights == heights.max(),
        "all points": heights < np.inf,
        "what will not touch": heights > 0.5,
    }
    for start in (*starts.values(), 1e150 * (heights < 0), 1e-300 * (heights < 0)):
        alike(solved(matrix, heights, start=start * 1.0, load=5.0).pressure, known)


def test_sets_that_cycle_at_once_are_settled_only_as_they_are_joined(monkeypatch):
    ring = Ring(copies=8, coupling=1.5)
    heights, start = np.zeros(ring.shape) + 1e-3 * np.arange(3), np.zeros(ring.shape)
    start[:, 0] = 1.0
    solved(ring, heights, start=start, depth=1.0)
    monkeypatch.setattr(contact, "PATIENCE", 10**9)
    with pytest.raises(contact.NotConverged, match="violation"):
        solved(ring, heights, start=start, depth=1.0)


def _rounded(matrix, plane, out):
    out[:] = matrix(plane.astype(np.float32)).astype(np.float32)
    return out


def _attracting(matrix, plane, out):
    out[:] = -matrix(plane)
    return out


@pytest.mark.parametrize(
    ("operator", "tolerance", "symmetric"),
    [(_rounded, 1e-13, True), (_attracting, FINE, True), (_attracting, FINE, False)],
)
def test_what_does_not_settle_is_refused_with_the_violation_that_was_left(
    operator, tolerance, symmetric, monkeypatch
):
    monkeypatch.setattr(contact, "ROUNDS", 40)
    heights = noise((8, 8), 2)
    start, asked = np.maximum(1.0 - heights, 0.0), partial(operator, Matrix(8, 8))
    with pytest.raises(contact.NotConverged, match="violation") as caught:
        contact.solve(asked, heights, start, tolerance, depth=1.0, symmetric=symmetric)
    assert f"{tolerance:.2e}" in str(caught.value)
