"""Krylov solvers for one set of contact. Both start from zero and stop at the looser of two aims.

`on_set` gives the operator and its approximate inverse on vectors (m,) of values on the set, and sums over them.
"""

from math import sqrt

import numpy as np


def conjugate_gradients(on_set, b, reduction, tolerance, iterations):
    """Preconditioned conjugate gradients for a symmetric positive definite operator.

    Stops when the residual's 2-norm has fallen by `reduction`, or its largest entry below half of `tolerance`.
    Fletcher-Reeves replaced by Polak-Ribiere, so that a preconditioner only roughly symmetric does no harm.
    """
    sums, xp = on_set.sums, on_set.sums.xp
    x, r = xp.zeros_like(b), b.copy()
    aim = reduction * sqrt(float((b * b).sum()))
    if aim == 0:
        return x
    image, z = xp.empty_like(b), xp.empty_like(b)
    mean, descent, _ = on_set.precondition(r, z, r, r)
    direction = z - mean
    for _ in range(iterations):
        mean, along, _ = on_set.operator(direction, image, direction, direction)
        step = descent / along
        square, largest = sums.advance(x, r, direction, image, step, mean)
        if sqrt(square) <= aim or largest <= tolerance / 2:
            break
        if mean:
            image -= mean
        before = descent
        mean, descent, gained = on_set.precondition(r, z, r, image)
        # z * (r - r_before) without keeping r_before: that difference is -step * image.
        sums.turn(direction, z, mean, -step * gained / before)
    return x


def gmres(on_set, b, reduction, tolerance, iterations):
    """Flexible GMRES, right-preconditioned, for an operator that is positive definite but not symmetric.

    Stops when the residual's 2-norm has fallen by `reduction` or below half of `tolerance`.
    Saad, SIAM J. Sci. Comput. 14, 461 (1993).
    """
    norm = sqrt(float((b * b).sum()))
    if norm == 0:
        return on_set.sums.xp.zeros_like(b)
    aim = max(reduction * norm, tolerance / 2)
    basis, directions = [b / norm], []
    hessenberg = np.zeros((iterations + 1, iterations))
    for k in range(iterations):
        directions.append(on_set.preconditioned(basis[k]))
        v = on_set.applied(directions[k])
        for i, q in enumerate(basis):
            hessenberg[i, k] = float((q * v).sum())
            v -= hessenberg[i, k] * q
        hessenberg[k + 1, k] = sqrt(float((v * v).sum()))
        rhs = np.zeros(k + 2)
        rhs[0] = norm
        square = hessenberg[: k + 2, : k + 1]
        y = np.linalg.lstsq(square, rhs, rcond=None)[0]
        if np.linalg.norm(square @ y - rhs) <= aim or hessenberg[k + 1, k] == 0:
            break
        basis.append(v / hessenberg[k + 1, k])
    return sum(float(share) * direction for share, direction in zip(y, directions, strict=True))
