"""Krylov solvers for one set of contact. Both start from zero and stop at the looser of two aims."""

import numpy as np


def conjugate_gradients(operator, b, precondition, reduction, tolerance, iterations):
    """Preconditioned conjugate gradients for a symmetric positive definite operator.

    Stops when the residual's 2-norm has fallen by `reduction`, or its largest entry below half of `tolerance`.
    Fletcher-Reeves replaced by Polak-Ribiere, so that a preconditioner only roughly symmetric does no harm.
    """
    x, r = np.zeros_like(b), b.copy()
    if not b.any():
        return x
    aim = reduction * np.linalg.norm(b)
    z = precondition(r)
    direction, descent = z, r @ z
    for _ in range(iterations):
        image = operator(direction)
        step = descent / (direction @ image)
        x += step * direction
        before, r = r, r - step * image
        if np.linalg.norm(r) <= aim or np.abs(r).max() <= tolerance / 2:
            break
        z = precondition(r)
        previous, descent = descent, r @ z
        direction = z + (descent - before @ z) / previous * direction
    return x


def gmres(operator, b, precondition, reduction, tolerance, iterations):
    """Flexible GMRES, right-preconditioned, for an operator that is positive definite but not symmetric.

    Stops when the residual's 2-norm has fallen by `reduction` or below half of `tolerance`.
    Saad, SIAM J. Sci. Comput. 14, 461 (1993).
    """
    norm = np.linalg.norm(b)
    if norm == 0:
        return np.zeros_like(b)
    aim = max(reduction * norm, tolerance / 2)
    basis, directions = [b / norm], []
    hessenberg = np.zeros((iterations + 1, iterations))
    for k in range(iterations):
        directions.append(precondition(basis[k]))
        v = operator(directions[k])
        for i, q in enumerate(basis):
            hessenberg[i, k] = q @ v
            v = v - hessenberg[i, k] * q
        hessenberg[k + 1, k] = np.linalg.norm(v)
        rhs = np.zeros(k + 2)
        rhs[0] = norm
        square = hessenberg[: k + 2, : k + 1]
        y = np.linalg.lstsq(square, rhs, rcond=None)[0]
        if np.linalg.norm(square @ y - rhs) <= aim or hessenberg[k + 1, k] == 0:
            break
        basis.append(v / hessenberg[k + 1, k])
    return np.tensordot(y, np.array(directions), 1)
