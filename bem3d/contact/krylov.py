"""Solvers for one set of contact, started from zero: two by Krylov, one direct.

`on_set` gives the operator and its approximate inverse on vectors (m,) of values on the set, and sums over them.
"""

from math import sqrt

import numpy as np

from . import sums


def conjugate_gradients(on_set, b, reduction, tolerance, iterations):
    """Preconditioned conjugate gradients for a symmetric positive definite operator.

    Stops when the residual's 2-norm has fallen by `reduction`, or its largest entry below half of `tolerance`.
    Fletcher-Reeves replaced by Polak-Ribiere, so that a preconditioner only roughly symmetric does no harm.
    """
    x, r = np.zeros_like(b), b.copy()
    aim = reduction * sqrt(float((b * b).sum()))
    if aim == 0:
        return x
    image, z = np.empty_like(b), np.empty_like(b)
    mean, descent, _ = on_set.precondition(r, z, r, r)
    direction = z - mean
    for _ in range(iterations):
        mean, along, _ = on_set.operator(direction, image, direction, direction)
        step = descent / along
        square, largest = sums.update_solution(x, r, direction, image, step, mean)
        if sqrt(square) <= aim or largest <= tolerance / 2:
            break
        if mean:
            image -= mean
        before = descent
        mean, descent, gained = on_set.precondition(r, z, r, image)
        # z * (r - r_before) without keeping r_before: that difference is -step * image.
        sums.update_direction(direction, z, mean, -step * gained / before)
    return x


def gmres(on_set, b, reduction, tolerance, iterations):
    """GMRES, preconditioned, for an operator that is positive definite but not symmetric.

    It minimizes the error of the displacement of the foundation under the flow. Short waves of pressure hardly
    show in the gap under a fast flow, and the pressure itself has spikes at leading edges. Stops when the 2-norm
    of the preconditioned residual has fallen by `reduction`. Saad and Schultz, SIAM J. Sci. Stat. Comput. 7, 856
    (1986).
    """
    on_set.prepare_load_constraint()
    z = on_set.foundation_displacement(b)
    norm = sqrt(float((z * z).sum()))
    if norm == 0:
        return z
    basis, hessenberg, across = [z / norm], np.zeros((iterations + 1, iterations)), np.zeros(iterations + 1)
    across[0] = 1.0
    for k in range(iterations):
        v = on_set.foundation_displacement(on_set.displaced(basis[k]))
        for i, q in enumerate(basis):
            hessenberg[i, k] = float((q * v).sum())
            v -= hessenberg[i, k] * q
        hessenberg[k + 1, k] = sqrt(float((v * v).sum()))
        if hessenberg[k + 1, k] == 0:
            break
        # The residual is what of the right side is along the one direction across all columns.
        across[k + 1] = -(across[: k + 1] @ hessenberg[: k + 1, k]) / hessenberg[k + 1, k]
        if reduction * sqrt(across @ across) >= 1:
            break
        basis.append(v / hessenberg[k + 1, k])
    square, rhs = hessenberg[: k + 2, : k + 1], np.zeros(k + 2)
    rhs[0] = norm
    shares = np.linalg.lstsq(square, rhs, rcond=None)[0]
    return on_set.pressed(sum(float(share) * q for share, q in zip(shares, basis, strict=False)))


def direct(on_set, b, reduction, tolerance, iterations):
    """Gaussian elimination for a single row, accurate where a fast flow makes the matrix ill-conditioned.

    The operator is the same everywhere, so its columns are those of a load on the first and on the last pixel.
    """
    where, row = on_set.where, on_set.row()
    steps = where[:, None] - where[None, :]
    matrix = np.where(steps >= 0, row[0][steps], row[1][steps - 1])
    if on_set.mean_free:  # the level is unknown as well, the sum is not to change
        bordered = np.zeros((len(b) + 1, len(b) + 1))
        bordered[:-1, :-1], bordered[:-1, -1], bordered[-1, :-1] = matrix, -1.0, 1.0
        matrix, b = bordered, np.concatenate([b, np.zeros(1)])
    return np.linalg.solve(matrix, b)[: len(where)]
