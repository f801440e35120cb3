"""Memory on a grid of pixels: a kernel convolved downstream with exp(-s/l)/l, for many lengths l at once.

Over one pixel w(x) = exp(-1/l) w(x - 1) + what was added on the way, and that is a quadrature of the kernel with
nodes that all lengths share. Lengths and columns are in pixels; a kernel is a function (x, s, ny) -> values at
x - s in rows 0..ny-1, with kinks no further from the pixel's centre than a pixel.
"""

from functools import cache, lru_cache
from itertools import pairwise

import numpy as np

NEAR = 100  # kernels are exact up to here, and beyond as for a distant load, without loss of digits
FINEST, BANDS = 2, ((8, 16), (64, 8), (np.inf, 5))  # |column|, and nodes a pixel that give 1e-11 up to there
FINE_ROWS = 3  # further aside the pixel's edges are far enough for the nodes of a band
CHUNK = 32  # columns at a time
EDGE_PANELS, LEAST_MEMORY = 14, -24  # to a kink, of a memory of a pixel or more; a power of 4 [pixel]
UPSTREAM_NODES, MEMORY_NODES, PANEL_NODES = 64, 64, 12
SMALL, KEPT = 256, 128  # rows up to which sampled runs of columns are kept, and runs kept: a grid has a dozen
MANY_LENGTHS = 40.0  # exp(-40) = 4e-18: nothing is remembered from further upstream


def chunks(start, stop):
    """Integer columns start..stop-1 in runs that share a number of nodes, and that number."""
    inner = [e for bound, _ in BANDS[:-1] for e in (-bound, bound + 1) if start < e < stop]
    for low, high in pairwise(sorted([start, stop, *inner])):
        reach = max(abs(low), abs(high - 1))
        nodes = next(n for bound, n in BANDS if reach <= bound)
        for i in range(low - low % CHUNK, high, CHUNK):  # runs of wider and of narrower grids are the same
            yield np.arange(max(low, i), min(i + CHUNK, high)), nodes


gauss = cache(np.polynomial.legendre.leggauss)  # each takes about as long as the transforms of a small grid


def remembered(kernel, columns, ny, shares, lengths, shift):
    """The kernel as modes of these shares remember it, `shift` behind columns: runs of them, values (count, ny).

    shares : (K,), or several sums over the same modes (..., K), each with values of its own: (..., count, ny)

    The memory is carried downstream from column to column. The kernel is sampled between whole columns, at places
    that shift and lengths do not move.
    """
    decay, sums = np.exp(-1 / lengths), np.atleast_2d(shares)
    left_at_shift = sums * np.exp(-shift / lengths)
    rules, beyond = (_memory_rules(lengths, begin) for begin in (0.0, 1 - shift))
    # From each column to the next, of each mode; and to the shift behind it, of each sum.
    weights = {nodes: np.concatenate([rule, sums @ beyond[nodes]]) for nodes, rule in rules.items()}
    _, graded = _graded_rule(lengths, 0.0)
    if shift:
        places_beyond, graded_beyond = _graded_rule(lengths, 1 - shift)
    run = np.arange(CHUNK)
    since = np.subtract.outer(run, run)
    faded = np.where(since >= 0, decay[:, None, None] ** np.maximum(since, 0), 0.0)
    kept = decay[:, None, None] ** np.arange(1, CHUNK + 1)[:, None]
    start, stop = columns
    state = _upstream(kernel, start - 1, ny, lengths)
    for i, nodes in chunks(start, stop + 1):
        count, close = len(i), np.flatnonzero((i >= -FINEST) & (i <= FINEST + 1))
        values = _samples(kernel, i[0], count, nodes, ny)
        passed = (weights[nodes] @ values.reshape(nodes, -1)).reshape(-1, count, ny)
        gained, behind = passed[: len(lengths)], passed[len(lengths) :]
        if len(close):
            rows = min(ny, FINE_ROWS)
            at = i[close]
            gained[:, close, :rows] = np.tensordot(graded, _near(kernel, int(at[0]), len(at), rows), 1)
            if shift:
                beyond_near = kernel(at, places_beyond[:, None], rows)
                behind[:, close, :rows] = np.tensordot(sums @ graded_beyond, beyond_near, 1)
        states = faded[:, :count, :count] @ gained
        states += kept[:, :count] * state[:, None]
        left = (left_at_shift @ states.reshape(len(lengths), -1)).reshape(behind.shape)
        behind[:, 0] += left_at_shift @ state
        behind[:, 1:] += left[:, :-1]
        state = states[:, -1]
        first = int(i[0] == start)
        yield i[first:] - 1, behind[:, first:].reshape(*np.shape(shares)[:-1], count - first, ny)


def _samples(kernel, first, count, nodes, ny):
    """Kernel at the nodes before `count` columns, (nodes, count, ny); kept where a grid is small."""
    return (_kept if ny <= SMALL else _sampled)(kernel, int(first), count, nodes, ny)


def _sampled(kernel, first, count, nodes, ny):
    return kernel(first + np.arange(count), (gauss(nodes)[0][:, None] + 1) / 2, ny)


_kept = lru_cache(KEPT)(_sampled)


@lru_cache(KEPT)
def _near(kernel, first, count, rows):
    """Kernel at the graded nodes before `count` columns, (nodes, count, rows): close to its kinks."""
    places, _ = _graded_rule(np.ones(1), 0.0)
    return kernel(first + np.arange(count), places[:, None], rows)


def _memory_rules(lengths, begin):
    """Weights (K, count) at as many Gauss nodes on 0 <= s <= 1 as each band has, for exp(-(s - begin)/l) ds / l.

    From `begin` on, and exact for a polynomial: the one through its values at the nodes, by its Legendre
    coefficients. Its products with the memory are integrated as far as that reaches.
    """
    reach = np.minimum(1 - begin, MANY_LENGTHS * lengths)[:, None]
    t, fine = gauss(MEMORY_NODES)
    back = reach * (t + 1) / 2
    measure = fine * reach / 2 * np.exp(-back / lengths[:, None]) / lengths[:, None]
    counts = [count for _, count in BANDS]
    polynomials = np.polynomial.legendre.legvander(2 * (begin + back) - 1, max(counts) - 1)
    moments = np.einsum("kt,ktm->km", measure, polynomials)
    return {count: moments[:, :count] @ _coefficients(count).T for count in counts}


@cache
def _coefficients(count):
    """Matrix from values at `count` Gauss nodes to coefficients of as many Legendre polynomials."""
    x, w = gauss(count)
    return np.polynomial.legendre.legvander(x, count - 1) * w[:, None] * (np.arange(count) + 0.5)


def _graded_rule(lengths, begin):
    """Nodes (M,) on begin <= s <= 1 and weights (K, M) for exp(-(s - begin)/l) ds / l, near the kernel's kinks.

    Panels shrink by four towards the beginning, where a short memory ends, and where the pixel's edge may be; of
    the whole also towards the middle, where it is, and as far as the shortest memory there is.
    """
    shortest = np.log2(min(lengths.min(), 1.0)) / 2 if begin else LEAST_MEMORY
    steps, side = 0.25 ** np.arange(1, EDGE_PANELS - np.floor(shortest)), 1 - begin
    cuts = np.unique([0.0, 1.0, *steps, *([] if begin else [0.5, *(0.5 - steps / 2), *(0.5 + steps / 2)])])
    x, w = gauss(PANEL_NODES)
    half = np.diff(cuts)[:, None] / 2
    back = side * (cuts[:-1, None] + half * (x + 1)).ravel()
    weights = side * (half * w).ravel() * np.exp(-back / lengths[:, None]) / lengths[:, None]
    return begin + back, weights


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
