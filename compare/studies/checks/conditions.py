"""The conditions of contact computed anew from an answer, by plain sums; of rough surfaces, on those it drew.

In three dimensions gap = A p + z - d with the influence of a pixel under constant pressure; Love, Phil. Trans. R.
Soc. A 228, 377 (1929). Retarded displacement is the displacement of a pixel left behind, integrated over the way
since with exp(-s/l)/l. Under a flow the gap is seen -arg(J(q))/q behind the pixels' centres, q = pi/pixel (docs,
theory).
"""

from itertools import product
from math import inf

import numpy as np
from numpy.polynomial.legendre import leggauss
from scipy.signal import convolve

from bem3d.surface import RoughSurface
from scene import Plane, Result

FAR = 1e4  # pixels from which 1/r has more digits than the exact form
T, W = ((each + shift) / 2 for each, shift in zip(leggauss(20), (1, 0), strict=True))
# Places and weights on a panel from 0 to 1, dense at both ends, where the kernel has its kinks.
PLACES, WEIGHTS = T**3 * (10 - 15 * T + 6 * T**2), W * 30 * T**2 * (1 - T) ** 2
PANELS = 60  # in addition to one panel a pixel; in each panel exp(-s/l) and 1/s hardly change


def violation(answer: Result) -> float:
    """What an answer in three dimensions leaves of gap >= 0 and p gap = 0, point by point, over their scale.

    The scale is the depth of the lowest height, or what the heights in contact span where that is more. Infinite
    where there is suction.
    """
    scene, fields, pixel = answer.scene, answer.fields, answer.measures["pixel"]
    response = flow(answer)
    shift = collocation(*response)
    x, y, pressure = fields["x"] + shift * pixel, fields["y"], fields["pressure"]
    heights = scene.indenter.height(x[None, :], y[:, None])
    if scene.roughness is not None:
        heights = heights + RoughSurface.of(scene.roughness, scene.roughness.q_max(pixel)).heights(x, y)
    displaced = _repeating if isinstance(scene.indenter, Plane) else _free
    moved = displaced(pressure / scene.solid.indentation_modulus, *response, shift) * pixel
    gap, touched = moved + heights - answer.depth, pressure > 0
    scale = max(answer.depth, heights[touched].max()) - heights.min()
    return inf if pressure.min() < 0 else float(max(-gap.min(), np.abs(gap[touched]).max()) / scale)


def flow(answer: Result) -> tuple[float, np.ndarray, np.ndarray]:
    """Modes of the elastomer: share of compliance that follows at once, shares (K,) and memories (K,) [pixel]."""
    scene = answer.scene
    instantaneous, compliances, times = scene.solid.retardation()
    relaxed = instantaneous + compliances.sum()
    if scene.motion.speed == 0:
        return 1.0, np.empty(0), np.empty(0)
    return instantaneous / relaxed, compliances / relaxed, scene.motion.speed * times / answer.measures["pixel"]


def collocation(instantaneous, shares, lengths) -> float:
    """Distance behind a pixel's centre at which the gap is seen [pixel]."""
    compliance = instantaneous + np.sum(shares / (1 + 1j * np.pi * lengths))
    return float(-np.angle(compliance) / np.pi)


def _repeating(pressure, instantaneous, shares, lengths, shift):
    """Displacement, free of mean, wave by wave [pixel]."""
    q_y, q_x = (2 * np.pi * np.fft.fftfreq(n) for n in pressure.shape)
    q = np.hypot(q_y[:, None], q_x)
    q[0, 0] = np.inf
    compliance = instantaneous + np.sum(shares / (1 + 1j * q_x[:, None] * lengths), axis=1)
    return np.fft.ifft2(2 / q * compliance * np.exp(1j * q_x * shift) * np.fft.fft2(pressure)).real


def _free(pressure, instantaneous, shares, lengths, shift):
    """Displacement of a free half-space [pixel], as a plain sum over pixels."""
    ny, nx = pressure.shape
    x = np.arange(1 - nx, nx) + shift
    kernel = instantaneous * influence(x, ny) + retarded(x, ny, shares, lengths)
    both_sides = np.concatenate([kernel[:, :0:-1], kernel], axis=1)
    return convolve(both_sides, pressure.T, mode="valid", method="direct").T


def influence(x, ny) -> np.ndarray:
    """Displacement over p/E* [pixel] by a square pixel at the origin: x of any shape, y = 0..ny-1 -> (..., ny)."""
    x, y = np.asarray(x)[..., None], np.arange(ny, dtype=float)
    r = np.hypot(x, y)
    corners = product((-1, 1), repeat=2)
    with np.errstate(divide="ignore", invalid="ignore"):
        near = sum(along * across * _corner(x + along / 2, y + across / 2) for along, across in corners)
        return np.where(r < FAR, near, 1 / r) / np.pi


def _corner(x, y):
    """Double primitive of 1/r, whose terms are nothing on the axes."""
    return sum(np.nan_to_num(a * np.arcsinh(b / np.abs(a))) for a, b in ((x, y), (y, x)))


def retarded(x, ny, shares, lengths):
    """Kernel convolved downstream with sum_k shares exp(-s/l)/l.

    The kernel has kinks at the pixels' edges, which lie alike in every pixel for all x; panels end there.
    """
    total = np.zeros((*x.shape, ny))
    edges = np.arange(np.ceil(x.max() + 2)) + (x[0] + 0.5) % 1
    for share, length in zip(shares, lengths, strict=True):
        end = 40 * length
        cuts = np.unique([0.0, *edges[edges < end], *np.geomspace(min(length / 4096, x.max() + 2), end, PANELS)])
        widths = np.diff(cuts)[:, None]
        s = (cuts[:-1, None] + widths * PLACES).ravel()
        weights = (widths * WEIGHTS).ravel() * np.exp(-s / length) / length
        total += share * np.array([weights @ influence(at - s, ny) for at in x])
    return total
