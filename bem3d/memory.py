"""Memory on a grid of pixels: a kernel convolved downstream with exp(-s/l)/l, for many lengths l at once.

Over one pixel w(x) = exp(-1/l) w(x - 1) + what was added on the way, and that is a quadrature of the kernel with
nodes that all lengths share. Lengths and columns are in pixels; a kernel is a function (x, s, ny) -> values at
x - s in rows 0..ny-1, with kinks no further from the pixel's centre than a pixel.
"""

from functools import cache
from itertools import pairwise

import numpy as np

NEAR = 100  # kernels take their exact form up to here and that of a distant load beyond, without loss of digits
FINEST, BANDS = 2, ((8, 16), (64, 8), (np.inf, 5))  # |column| up to which so many nodes a pixel of flow give 1e-11
FINE_ROWS = 3  # further aside the pixel's edges are far enough for the nodes of a band
CHUNK = 32  # columns at a time
UPSTREAM_NODES, MEMORY_NODES, PANEL_NODES = 64, 64, 12
MANY_LENGTHS = 40.0  # exp(-40) = 4e-18: nothing is remembered from further upstream


def chunks(start, stop):
    """Integer columns start..stop-1 in runs that share a number of nodes, and that number."""
    inner = [e for bound, _ in BANDS[:-1] for e in (-bound, bound + 1) if start < e < stop]
    for low, high in pairwise(sorted([start, stop, *inner])):
        reach = max(abs(low), abs(high - 1))
        nodes = next(n for bound, n in BANDS if reach <= bound)
        for i in range(low, high, CHUNK):
            yield np.arange(i, min(i + CHUNK, high)), nodes


gauss = cache(np.polynomial.legendre.leggauss)  # each takes about as long as the transforms of a small grid


def march(kernel, columns, ny, lengths, shift):
    """Carry the memory downstream: each column and the state at it, (K, ny)."""
    rules = {nodes: _memory_rule(nodes, lengths) for _, nodes in BANDS}
    fine, fine_weights = _graded_rule(shift + 0.5, lengths)
    decay = np.exp(-1 / lengths)[:, None]
    state = _upstream(kernel, columns[0] - 1 + shift, ny, lengths)
    for i, nodes in chunks(*columns):
        s, weights = rules[nodes]
        values = kernel(i + shift, s[:, None], ny)
        added = (weights @ values.reshape(len(s), -1)).reshape(-1, len(i), ny)
        close = np.flatnonzero((i >= -FINEST) & (i <= FINEST + 1))
        if len(close):
            rows = min(ny, FINE_ROWS)
            values = kernel(i[close] + shift, fine[:, None], rows)
            added[:, close, :rows] = np.tensordot(fine_weights, values, 1)
        for column, step in zip(i, added.transpose(1, 0, 2), strict=True):
            state = decay * state + step
            yield column, state


def _memory_rule(count, lengths):
    """Nodes (count,) on 0 <= s <= 1, weights (K, count): exact for a polynomial times exp(-s/l) ds / l.

    The polynomial through its values at the Gauss nodes, by its Legendre coefficients; its products with the
    memory are integrated as far as that reaches.
    """
    x, w = gauss(count)
    reach = np.minimum(1.0, MANY_LENGTHS * lengths)[:, None]
    t, fine = gauss(MEMORY_NODES)
    s = reach * (t + 1) / 2
    measure = fine * reach / 2 * np.exp(-s / lengths[:, None]) / lengths[:, None]
    moments = np.einsum("kt,ktm->km", measure, np.polynomial.legendre.legvander(2 * s - 1, count - 1))
    coefficients = np.polynomial.legendre.legvander(x, count - 1) * w[:, None] * (np.arange(count) + 0.5)
    return (x + 1) / 2, moments @ coefficients.T


def _graded_rule(edge, lengths):
    """Nodes (M,) on 0 <= s <= 1 and weights (K, M) for exp(-s/l) ds / l, where the kernel has its kinks.

    Panels shrink by four towards 0, where a short memory ends as well, towards the pixel's edge and towards 1.
    """
    steps = 0.25 ** np.arange(1, 38)
    cuts = [0.0, 1.0, edge, *(edge * steps), *(edge - edge * steps), *(edge + (1 - edge) * steps)]
    cuts = np.unique([*cuts, *(1 - (1 - edge) * steps)])
    x, w = gauss(PANEL_NODES)
    half = np.diff(cuts)[:, None] / 2
    s = (cuts[:-1, None] + half * (x + 1)).ravel()
    return s, (half * w).ravel() * np.exp(-s / lengths[:, None]) / lengths[:, None]


def _upstream(kernel, x, ny, lengths):
    """Remembered kernel far upstream, at x < 0: (K, ny)."""
    u, weights = gauss(UPSTREAM_NODES)
    start = np.empty((len(lengths), ny))
    for k, length in enumerate(lengths):
        scale = min(-x, length)
        top = np.log1p(MANY_LENGTHS * length / scale)
        stretched = top * (u + 1) / 2
        s = scale * np.expm1(stretched)
        measure = top / 2 * weights * scale * np.exp(stretched) * np.exp(-s / length) / length
        start[k] = 0.0
        for reached in (s < NEAR, s >= NEAR):  # at great distance the exact form has no digits left
            if reached.any():
                start[k] += measure[reached] @ kernel(np.array([x]), s[reached, None], ny)[:, 0]
    return start
