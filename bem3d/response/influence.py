"""Influence kernels of a free surface, in pixels: displacement of the surface by one loaded pixel.

Of a half-space, and of whatever else says what a pixel displaces by a `Displacement`.

Lengths are in pixels and pressure in units of the relaxed modulus E*, so a kernel is a pure number and depends on
the scene only through the relaxation lengths (speed times retardation time) in pixels. Arrays are [y, x]: column
nx + i is i pixels downstream of the load, row j is j pixels aside, and the other side mirrors it.

A mode with the relaxation length l remembers: w(x) = int_0^inf k(x - s) exp(-s/l) ds / l for the elastic kernel k,
that is w + l dw/dx = k.
"""

from collections.abc import Callable

import numpy as np
from scipy.special import exp1, expi

from .memory import NEAR, chunks, gauss, remembered

Displacement = Callable[..., np.ndarray]  # of (x, s, ny), see `by_pixel`

TINY = np.finfo(float).tiny
ALIKE = 1e-12  # relative, of steps from pixel to pixel
LINE_SHORT = 10.0  # memory [pixel] below which differences of primitives keep their digits
KINK_REACH, KINK_NODES, SMOOTH_NODES = 16, 24, 6  # to 1e-13
LAG_TERMS = 40  # of the asymptotic series of `_lag`, for z beyond as many: to exp(-40)


def by_pixel(x, s, ny):
    """Displacement of a half-space by a loaded pixel at x - s, rows 0..ny-1: shape of x - s, then (ny,)."""

    def near(y):
        across = np.append(y, y[-1] + 1) - 0.5
        shared = np.ndim(x) == 1 and np.shape(s)[-1:] in ((), (1,))
        if shared and np.all(np.abs(np.diff(x) - 1) < ALIKE):  # neighbours have an edge in common
            along = np.append(x - 0.5, x[-1] + 0.5)
            return np.diff(np.diff(_corner(along - s, across)), axis=-2) / np.pi
        return np.diff(_corner((x + 0.5) - s, across) - _corner((x - 0.5) - s, across)) / np.pi

    def far(y):
        # Mean of 1/r over the pixel: its Laplacian in the plane is 1/r^3.
        square = 1 / (np.square(x - s)[..., None] + y * y)
        return np.sqrt(square) * (1 + square / 24) / np.pi

    return _joined(near, far, x - s, ny)


def elastic(nx, ny, shift=0.0, displacement: Displacement = by_pixel):
    """Elastic kernel, (ny, 2 nx): column nx + i is i + shift pixels downstream, row j is j pixels aside."""
    start = -nx if shift else 0
    kernel = np.empty((nx + 1 - start, ny))
    for i, _ in chunks(start, nx + 1):
        kernel[i - start] = displacement(i + shift, 0.0, ny)
    if not shift:
        kernel = np.concatenate([kernel[:0:-1], kernel])  # even to the last digit
    return kernel[:-1].T


def retarded(nx, ny, length, shift):
    """Kernel of a retardation mode in flow along +x, (ny, 2 nx) as `elastic`.

    shift : how far behind the pixel's centre it is sampled, 0 to 1/2 [pixel]
    """
    return flowing(nx, ny, 0.0, [1.0], [length], shift)


def flowing(nx, ny, instantaneous, shares, lengths, shift, displacement: Displacement = by_pixel):
    """Kernel of a solid in flow along +x, (ny, 2 nx) as `elastic`: its elastic share and those of its modes.

    shares, lengths : of the retardation modes (K,), lengths > 0 [pixel]; with shares (..., K) of several solids,
        and as many elastic shares, as many kernels (..., ny, 2 nx)
    shift : how far behind the pixel's centre it is sampled, 0 to 1/2 [pixel]
    """
    shares, lengths = np.asarray(shares, float), np.asarray(lengths, float)
    kernel = np.zeros((*np.shape(instantaneous), 2 * nx, ny))
    if np.any(instantaneous):
        kernel += np.multiply.outer(instantaneous, elastic(nx, ny, shift, displacement).T)
    if len(lengths):
        for i, values in remembered(displacement, (-nx, nx), ny, shares, lengths, shift):
            kernel[..., i + nx, :] += values
    return np.swapaxes(kernel, -1, -2)


def line(nx, datum, shift=0.0):
    """Elastic kernel of a strip of unit width, unending in y: (1, 2 nx), columns as in `elastic`.

    w(x) = -(2/pi) int ln(|x - s| / datum) ds over the pixel, in plane strain: zero at the distance `datum` [pixel]
    from a line load, as the surface sinks without bound. Flamant's line load spread over the pixel; its transform
    is the half-space's 2/|q|.
    """
    x = np.arange(-nx, nx) + shift
    return (-2 / np.pi * (mean_log(x) - np.log(datum)))[None, :]


def line_flowing(nx, instantaneous, shares, lengths, shift, datum):
    """Line kernel of a solid in flow, (1, 2 nx): as `flowing`, with the datum of `line`.

    ln|x| remembered is ln|x| - D(x/l), with D of `_lag`; its mean over a pixel is a difference of primitives where
    the memory is short, a quadrature where it is long.
    """
    x = np.arange(-nx, nx) + shift
    mean = np.multiply.outer(instantaneous, mean_log(x) - np.log(datum))
    for share, length in zip(np.moveaxis(np.asarray(shares), -1, 0), lengths, strict=True):
        if length < LINE_SHORT:
            gain = _remembered_log(x + 0.5, length) - _remembered_log(x - 0.5, length)
            remembered = mean_log(x) - length * gain
        else:
            remembered = _over_pixel(lambda u, length=length: _remembered_log(u, length), x - 0.5)
        mean += np.multiply.outer(share, remembered - np.log(datum))
    return -2 / np.pi * mean[..., None, :]


def _joined(near, far, x, ny):
    n = min(ny, NEAR) if np.min(np.abs(x)) < NEAR else 0
    parts = [near(np.arange(n))] if n else []
    parts += [far(np.arange(n, ny))] if n < ny else []
    return parts[0] if len(parts) == 1 else np.concatenate(parts, axis=-1)


def _corner(x, y):
    """Double primitive of 1/r, odd in x and in y; x of any shape, y (n,) -> x.shape + (n,).

    Love, Phil. Trans. R. Soc. A 228, 377 (1929).
    """
    ax, ay = np.abs(x)[..., None], np.abs(y)
    r = np.hypot(ax, ay)
    # The logarithm vanishes with its factor; the guard only keeps it finite.
    along_x = ax * (np.log(ay + r) - np.log(ax + TINY))
    along_y = ay * (np.log(ax + r) - np.log(ay))
    return np.sign(x)[..., None] * np.sign(y) * (along_x + along_y)


def mean_log(x):
    """Mean of ln|u| over |u - x| <= 1/2."""
    ax = np.abs(x)
    safe = np.maximum(ax, 0.75)
    outside = 2 * safe * np.arctanh(0.5 / safe) + np.log(safe**2 - 0.25) / 2
    sides = np.abs(ax - 0.5)
    inside = (ax + 0.5) * np.log(ax + 0.5) - (ax - 0.5) * np.log(sides + TINY)
    return np.where(ax >= 0.75, outside, inside) - 1


def _remembered_log(u, length):
    """ln|u| convolved downstream with exp(-s/length)/length; finite at u = 0."""
    z = u / length
    return np.log(np.maximum(np.abs(z), TINY)) + np.log(length) - _lag(z)


def _lag(z):
    """D(z) = PV int_0^inf exp(-t)/(z - t) dt: exp(-z) Ei(z), for z < 0 -exp(|z|) E1(|z|).

    Beyond LAG_TERMS the asymptotic series sum_n n!/z^(n+1); Abramowitz and Stegun, 5.1.51.
    """
    size = np.maximum(np.abs(z), TINY)
    inner, outer = np.minimum(size, LAG_TERMS), np.copysign(np.maximum(size, LAG_TERMS), z)
    near = np.where(z > 0, np.exp(-inner) * expi(inner), -np.exp(inner) * exp1(inner))
    total, term = np.zeros_like(outer), 1 / outer
    for n in range(LAG_TERMS):
        total += term
        term *= (n + 1) / outer
    return np.where(size < LAG_TERMS, near, total)


def _over_pixel(f, left):
    """int f(u) du over left <= u <= left + 1, f smooth or logarithmic at u = 0 alone; left (n,) -> (n,)."""
    total = np.empty_like(left)
    close = np.abs(left) < KINK_REACH
    for columns, count, power in ((close, KINK_NODES, 5), (~close, SMOOTH_NODES, 1)):
        v, w = gauss(count)
        v, w = (v + 1) / 2, w / 2
        start = left[columns, None]
        middle = np.clip(0.0, start, start + 1)
        total[columns] = 0.0
        for end in (start, start + 1):
            along = (end - middle) * v**power
            weights = np.abs(end - middle) * w * power * v ** (power - 1)
            total[columns] += np.sum(weights * f(middle + along), axis=-1)
    return total
