"""Influence kernels of the free half-space, in pixels: displacement of the surface by one loaded pixel.

Lengths are in pixels and pressure in units of the relaxed modulus E*, so a kernel is a pure number and depends on
the scene only through the relaxation lengths (speed times retardation time) in pixels. Arrays are [y, x]: column
nx + i is i pixels downstream of the load, row j is j pixels aside, and the other side mirrors it.

A mode with the relaxation length l remembers: w(x) = int_0^inf k(x - s) exp(-s/l) ds / l for the elastic kernel k,
that is w + l dw/dx = k.
"""

import numpy as np
from scipy.special import exp1, expi

from .memory import NEAR, chunks, march

TINY = np.finfo(float).tiny
LINE_SHORT = 10.0  # memory [pixel] below which differences of primitives keep their digits
KINK_REACH, KINK_NODES, SMOOTH_NODES = 16, 24, 6  # to 1e-13
LAG_TERMS = 40  # of the asymptotic series of `_lag`, for z beyond as many: to exp(-40)
SHORT = 0.1  # memory [pixel] below which a gain across a pixel is taken from the curvature of the kernel


def elastic(nx, ny, shift=0.0):
    """Elastic kernel, (ny, 2 nx): column nx + i is i + shift pixels downstream, row j is j pixels aside."""
    start = -nx if shift else 0
    kernel = np.empty((nx + 1 - start, ny))
    for i, _ in chunks(start, nx + 1):
        kernel[i - start] = _displacement(i + shift, 0.0, ny)
    if not shift:
        kernel = np.concatenate([kernel[:0:-1], kernel])  # even to the last digit
    return kernel[:-1].T


def retarded(nx, ny, length, shift):
    """Kernel of one retardation mode in flow along +x, (ny, 2 nx) as `elastic`.

    shift : how far behind the pixel's centre it is sampled, 0 to 1/2 [pixel]
    """
    return flowing(nx, ny, 0.0, [1.0], [length], shift)


def flowing(nx, ny, instantaneous, shares, lengths, shift):
    """Kernel of a solid in flow along +x, (ny, 2 nx) as `elastic`: its elastic share and those of its modes.

    shares, lengths : of the retardation modes (K,), lengths > 0 [pixel]
    shift : how far behind the pixel's centre it is sampled, 0 to 1/2 [pixel]
    """
    shares, lengths = np.asarray(shares, float), np.asarray(lengths, float)
    kernel = np.zeros((2 * nx, ny)) if instantaneous == 0 else instantaneous * elastic(nx, ny, shift).T
    if len(lengths):
        for i, _, _, after in march(_displacement, (-nx, nx), ny, lengths, shift):
            kernel[i + nx] += shares @ after
    return kernel.T


def across(nx, ny, shares, lengths):
    """Displacement gained across a pixel, w(x + 1/2) - w(x - 1/2), of the modes; (ny, 2 nx) as `elastic`.

    Only the part even in x, which alone does work: sum_i p_i (gain * p)_i is the friction of a pressure constant
    on the pixels, in E* pixel^2. The elastic share has none. Along a pixel the memory gains what was added and
    loses what was forgotten, (1 - exp(-1/l)) w: no cancellation where it is long. Where it is short the even part
    is -l times the remembered second derivative of the kernel averaged over a pixel of x.
    """
    shares, lengths = np.asarray(shares, float), np.asarray(lengths, float)
    gain = np.zeros((2 * nx + 1, ny))
    long = lengths >= SHORT
    if long.any():
        kept = shares[long]
        forgotten = kept * np.expm1(-1 / lengths[long])
        for i, before, added, _ in march(_displacement, (-nx, nx + 1), ny, lengths[long], 0.5):
            gain[i + nx] += kept @ added + forgotten @ before
    if not long.all():
        bent = -(shares * lengths)[~long]
        for i, _, _, after in march(_curvature, (-nx, nx + 1), ny, lengths[~long], 0.0):
            gain[i + nx] += bent @ after
    return ((gain + gain[::-1]) / 2)[:-1].T


def line(nx, datum, shift=0.0):
    """Elastic kernel of a strip of unit width, unending in y: (1, 2 nx), columns as in `elastic`.

    w(x) = -(2/pi) int ln(|x - s| / datum) ds over the pixel, in plane strain: zero at the distance `datum` [pixel]
    from a line load, as the surface sinks without bound. Flamant's line load spread over the pixel; its transform
    is the half-space's 2/|q|.
    """
    x = np.arange(-nx, nx) + shift
    return (-2 / np.pi * (_mean_log(x) - np.log(datum)))[None, :]


def line_flowing(nx, instantaneous, shares, lengths, shift, datum):
    """Line kernel of a solid in flow, (1, 2 nx): as `flowing`, with the datum of `line`.

    ln|x| remembered is ln|x| - D(x/l), with D of `_lag`; its mean over a pixel is a difference of primitives where
    the memory is short, a quadrature where it is long.
    """
    x = np.arange(-nx, nx) + shift
    mean = instantaneous * (_mean_log(x) - np.log(datum))
    for share, length in zip(shares, lengths, strict=True):
        if length < LINE_SHORT:
            gain = _remembered_log(x + 0.5, length) - _remembered_log(x - 0.5, length)
            remembered = _mean_log(x) - length * gain
        else:
            remembered = _over_pixel(lambda u, length=length: _remembered_log(u, length), x - 0.5)
        mean += share * (remembered - np.log(datum))
    return (-2 / np.pi * mean)[None, :]


def line_across(nx, shares, lengths):
    """Displacement gained across a pixel under a strip, (1, 2 nx): as `across`."""
    x = np.abs(np.arange(-nx, nx, dtype=float))
    gain = np.zeros(2 * nx)
    for share, length in zip(shares, lengths, strict=True):
        if length < LINE_SHORT:
            middle, ahead, behind = (_remembered_log(x + step, length, even=True) for step in (0, 1, -1))
            gain += share * length * (ahead - 2 * middle + behind)
        else:
            # Mean over two neighbouring pixels of x, weighted with a tent.
            rising = _over_pixel(lambda u, length=length: _lag(u / length, even=True), x - 1, tent=1)
            falling = _over_pixel(lambda u, length=length: _lag(u / length, even=True), x, tent=-1)
            gain -= share / length * (rising + falling)
    return (2 / np.pi * gain)[None, :]


def _displacement(x, s, ny):
    """Elastic displacement at x - s, rows 0..ny-1: shape of x - s, then (ny,)."""

    def near(y):
        y = np.append(y, y[-1] + 1) - 0.5
        return np.diff(_corner((x + 0.5) - s, y) - _corner((x - 0.5) - s, y)) / np.pi

    def far(y):
        # Mean of 1/r over the pixel: its Laplacian in the plane is 1/r^3.
        square = 1 / (np.square(x - s)[..., None] + y * y)
        return np.sqrt(square) * (1 + square / 24) / np.pi

    return _joined(near, far, x - s, ny)


def _curvature(x, s, ny):
    """Second derivative along x of `_displacement` averaged over a pixel of x; same shapes."""

    def near(y):
        y = np.append(y, y[-1] + 1) - 0.5
        bend = _edge((x + 1) - s, y) - 2 * _edge(x - s, y) + _edge((x - 1) - s, y)
        return np.diff(bend) / np.pi

    def far(y):
        # Of 1/r + x^2/(8 r^5), the mean of 1/r over the pixel and over the pixel of x.
        along = np.square(x - s)[..., None]
        square = 1 / (along + y * y)
        cosine = along * square
        return (3 * cosine - 1 + (2 - 25 * cosine + 35 * cosine**2) * square / 8) * square**1.5 / np.pi

    return _joined(near, far, x - s, ny)


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


def _edge(x, y):
    """Derivative of `_corner` along x, arsinh(y/|x|); logarithmic at x = 0."""
    ax, ay = np.abs(x)[..., None] + TINY, np.abs(y)
    return np.sign(y) * (np.log(ay + np.hypot(ax, ay)) - np.log(ax))


def _mean_log(x):
    """Mean of ln|u| over |u - x| <= 1/2."""
    ax = np.abs(x)
    safe = np.maximum(ax, 0.75)
    outside = 2 * safe * np.arctanh(0.5 / safe) + np.log(safe**2 - 0.25) / 2
    sides = np.abs(ax - 0.5)
    inside = (ax + 0.5) * np.log(ax + 0.5) - (ax - 0.5) * np.log(sides + TINY)
    return np.where(ax >= 0.75, outside, inside) - 1


def _remembered_log(u, length, even=False):
    """ln|u| convolved downstream with exp(-s/length)/length, or its even part; finite at u = 0."""
    z = u / length
    return np.log(np.maximum(np.abs(z), TINY)) + np.log(length) - _lag(z, even)


def _lag(z, even=False):
    """D(z) = PV int_0^inf exp(-t)/(z - t) dt, or its even part: exp(-z) Ei(z), for z < 0 -exp(|z|) E1(|z|).

    Beyond LAG_TERMS the asymptotic series sum_n n!/z^(n+1); Abramowitz and Stegun, 5.1.51.
    """
    size = np.maximum(np.abs(z), TINY)
    inner, outer = np.minimum(size, LAG_TERMS), np.maximum(size, LAG_TERMS)
    ahead, behind = np.exp(-inner) * expi(inner), -np.exp(inner) * exp1(inner)
    if even:
        return np.where(size < LAG_TERMS, (ahead + behind) / 2, _asymptotic(outer, 1))
    near = np.where(z > 0, ahead, behind)
    return np.where(size < LAG_TERMS, near, _asymptotic(np.copysign(outer, z), 0))


def _asymptotic(z, first):
    """Terms n!/z^(n+1): all of them, first = 0, or those of odd n alone, first = 1, even in z."""
    total, term = np.zeros_like(z), 1 / z
    for n in range(LAG_TERMS):
        if n % 2 or not first:
            total += term
        term *= (n + 1) / z
    return total


def _over_pixel(f, left, tent=0):
    """int f(u) du over left <= u <= left + 1, f smooth or logarithmic at u = 0 alone; left (n,) -> (n,).

    tent : 1 or -1 to weight with a line that rises from or falls to zero across the pixel
    """
    total = np.empty_like(left)
    close = np.abs(left) < KINK_REACH
    for columns, count, power in ((close, KINK_NODES, 5), (~close, SMOOTH_NODES, 1)):
        v, w = np.polynomial.legendre.leggauss(count)
        v, w = (v + 1) / 2, w / 2
        start = left[columns, None]
        middle = np.clip(0.0, start, start + 1)
        total[columns] = 0.0
        for end in (start, start + 1):
            along = (middle - start) + (end - middle) * v**power
            weights = np.abs(end - middle) * w * power * v ** (power - 1)
            weights = weights * {0: 1.0, 1: along, -1: 1 - along}[tent]
            total[columns] += np.sum(weights * f(start + along), axis=-1)
    return total
