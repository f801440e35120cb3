"""The complementarity solver against dense problems whose conditions are checked by plain matrix products."""

from itertools import cycle

import numpy as np
import pytest
from scipy.optimize import nnls

from bem3d import contact, influence
from bem3d.krylov import conjugate_gradients

TOLERANCE = 1e-8
N = 12


def dense(kernel):
    """The convolution as a matrix, point by point."""
    ny, nx = kernel.shape[0], kernel.shape[1] // 2
    y, x = (a.ravel() for a in np.mgrid[:ny, :nx])
    return kernel[np.abs(y[:, None] - y[None, :]), nx + x[:, None] - x[None, :]]


class Matrix:
    """A matrix as an operator on planes."""

    def __init__(self, matrix):
        self.matrix = matrix

    def __call__(self, plane, out=None):
        image = (self.matrix @ plane.ravel()).reshape(plane.shape)
        if out is None:
            return image
        out[:] = image
        return out


def rough_heights(seed):
    y, x = np.mgrid[:N, :N] - (N - 1) / 2
    return (x**2 + y**2) / 60 + 0.1 * np.random.default_rng(seed).standard_normal((N, N))


def problem(length, seed=0):
    kernel = influence.elastic(N, N) if length == 0 else influence.retarded(N, N, length, 0.5 * np.tanh(length))
    matrix, z = dense(kernel), rough_heights(seed)
    return matrix, z, Matrix(matrix)


def test_symmetric_problem_agrees_with_nonnegative_least_squares():
    # min p'Ap/2 - t'p over p >= 0 is least squares with A = L L', b = L^-1 t: another algorithm, not ours
    matrix, z, operator = problem(0)
    root = np.linalg.cholesky(matrix)
    expected, _ = nnls(root.T, np.linalg.solve(root, (0.3 - z).ravel()), maxiter=10_000)
    found = contact.solve(operator, z, np.where(z < 0.3, 1.0, 0.0), 1e-10, depth=0.3, symmetric=True)
    np.testing.assert_allclose(found.pressure.ravel(), expected, atol=1e-7 * expected.max())


def test_conjugate_gradients_take_as_many_steps_as_the_square_root_of_the_condition_says():
    matrix, _, operator = problem(0)
    on_set = contact._OnSet(operator, None, None, False, (N, N))
    on_set.turn_to(np.ones((N, N), bool))
    b, root = np.random.default_rng(0).standard_normal(N * N), np.sqrt(np.linalg.cond(matrix))
    steps = int(np.ceil(np.log(2 * root / 1e-8) / np.log((root + 1) / (root - 1))))
    found = conjugate_gradients(on_set, b, 1e-12, 0.0, steps)
    assert np.linalg.norm(matrix @ found - b) < 1e-8 * np.linalg.norm(b)


@pytest.mark.parametrize("length", [0, 30.0])
def test_the_start_does_not_matter(length):
    _, z, operator = problem(length, seed=3)
    starts = (np.ones((N, N)), np.where(z == z.min(), 1.0, 0.0), np.random.default_rng(0).random((N, N)))
    answers = [
        contact.solve(operator, z, start, TOLERANCE, depth=0.3, symmetric=length == 0).pressure for start in starts
    ]
    for other in answers[1:]:
        np.testing.assert_allclose(other, answers[0], atol=1e-5 * answers[0].max())


@pytest.mark.parametrize("shape", [(1, 40), (5, 300)])
def test_the_sets_tried_before_giving_up_grow_with_the_grid_and_the_error_carries_what_is_left(shape):
    def noise(plane, out):
        out[:] = plane + next(sign) * 1e-3
        return out

    sign = cycle([-1, 1])
    given_up = rf"after {contact.ROUNDS + shape[1]} sets of contact the violation is \d"
    with pytest.raises(contact.NotConverged, match=given_up) as error:
        contact.solve(noise, np.zeros(shape), np.ones(shape), TOLERANCE, depth=1.0, symmetric=True)
    assert f"wanted {TOLERANCE:.2e}" in str(error.value)
