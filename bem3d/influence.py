"""Influence kernels of the free half-space, in pixels: displacement of the surface by one loaded pixel.

Lengths are in pixels and pressure in units of the relaxed modulus E*, so a kernel is a pure number and depends on
the scene only through the relaxation lengths (speed times retardation time) in pixels. Arrays are [y, x].
"""

import numpy as np

LOCAL_NODES = 8  # Gauss nodes in one pixel of flow: kernel to 1e-5 of its peak, see the tests
UPSTREAM_NODES = 64
MANY_LENGTHS = 40.0  # exp(-40) = 4e-18: nothing is remembered from further upstream


def _corner(x, y):
    """Double primitive of 1/r, odd in x and in y; x (nx,), y (ny,) -> (ny, nx).

    Love, Phil. Trans. R. Soc. A 228, 377 (1929).
    """
    ax, ay = np.abs(x)[None, :], np.abs(y)[:, None]
    r = np.hypot(ax, ay)
    # The logarithms vanish with their factors; the guard only keeps them finite.
    tiny = np.finfo(float).tiny
    along_x = ax * (np.log(ay + r + tiny) - np.log(ax + tiny))
    along_y = ay * (np.log(ax + r + tiny) - np.log(ay + tiny))
    return np.sign(x)[None, :] * np.sign(y)[:, None] * (along_x + along_y)


def _love(offset, nx, ny):
    """Displacement by unit pressure on the unit pixel at the origin, (ny, 2 nx).

    At x = offset + i, i = -nx..nx-1, and y = j, j = 0..ny-1.
    """
    corners = _corner(np.arange(-nx, nx + 1) + offset - 0.5, np.arange(ny + 1) - 0.5)
    return np.diff(np.diff(corners, axis=0), axis=1) / np.pi


def elastic(nx, ny, shift=0.0):
    """Elastic kernel, (ny, 2 nx): column nx + i is i + shift pixels downstream, row j is j pixels aside."""
    return _love(shift, nx, ny)


def retarded(nx, ny, length, shift):
    """Kernel of one retardation mode in flow along +x, (ny, 2 nx) as `elastic`.

    The elastic kernel convolved downstream with exp(-s/length)/length, sampled `shift` pixels behind the pixel's
    centre: w(x) = int_0^inf k(x - s) exp(-s/length) ds / length. It obeys a recursion along x,
    w(x + 1) = exp(-1/length) w(x) + the last pixel's share, started upstream by quadrature.
    """
    # The pixel's edges are kinks of the kernel: met where the pixel of flow is cut in two.
    edge = shift + 0.5
    parts = [(0.0, edge), (edge, 1.0)] if edge < 1 else [(0.0, 1.0)]
    share = np.zeros((ny, 2 * nx))
    for s, weight in (node for part in parts for node in _memory_rule(length, *part)):
        share += weight * _love(shift - s, nx, ny)
    kernel = np.empty((ny, 2 * nx))
    kernel[:, 0] = _upstream(shift - nx, ny, length)
    decay = np.exp(-1 / length)
    for i in range(1, 2 * nx):
        kernel[:, i] = decay * kernel[:, i - 1] + share[:, i]
    return kernel


def _memory_rule(length, start, end):
    """Gauss nodes and weights on start <= s <= end for the measure exp(-s/length) ds / length.

    Lanczos on a fine discretization of the measure, then Golub and Welsch, Math. Comp. 23, 221 (1969).
    """
    reach = min(end - start, MANY_LENGTHS * length)
    s, fine = np.polynomial.legendre.leggauss(100)
    s = reach * (s + 1) / 2
    measure = fine * np.exp(-s / length)
    basis = [np.sqrt(measure / measure.sum())]
    diagonal, beside = [], []
    for _ in range(LOCAL_NODES):
        v = s * basis[-1]
        diagonal.append(v @ basis[-1])
        for _ in range(2):  # twice is enough for orthogonality to rounding
            for b in basis:
                v = v - (v @ b) * b
        beside.append(np.linalg.norm(v))
        basis.append(v / beside[-1])
    nodes, vectors = np.linalg.eigh(np.diag(diagonal) + np.diag(beside[:-1], 1) + np.diag(beside[:-1], -1))
    total = -np.expm1((start - end) / length) * np.exp(-start / length)
    return zip(start + nodes, total * vectors[0] ** 2, strict=True)


def _upstream(x, ny, length):
    """Retarded kernel at x < 0 far upstream, y = 0..ny-1: pixel as a point source with its first correction."""
    scale = min(-x, length)
    u, weights = np.polynomial.legendre.leggauss(UPSTREAM_NODES)
    top = np.log1p(MANY_LENGTHS * length / scale)
    u, weights = top * (u + 1) / 2, top / 2 * weights
    s = scale * np.expm1(u)
    r = np.hypot(x - s[None, :], np.arange(ny)[:, None])
    return (1 / r + 1 / (24 * r**3)) @ (weights * scale * np.exp(u) * np.exp(-s / length) / length) / np.pi
