"""Control variates: numbers of each rough surface that cost little, have a mean of zero, and follow its answers.

Friction of a surface follows largely from averages, below the smooth contact, of products of its height h, its
slope, its curvature, and the pressure p that flattens it. As h is as likely as -h, odd products average to zero;
the mean of h_x^2 is sum A^2 q_x^2 / 2, and the mean of p h_xx is -sum A^2 s q_x^2 / 2, where s is pressure over
height. A regression on them lessens the scatter (Lavenberg and Welch, Manage. Sci. 27, 322, 1981).
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np

from bem3d import BEM
from bem3d.surface import RoughSurface
from mdr1d import MDR
from mdr1d.surface import LineFamily, amplitudes
from scene import Plane, Program, Refused, Scene, SolveError, Solver
from scene.surfaces.isotropic import Isotropic

VARIATES = "control_variates"  # name in a Dataset
EACH = 4  # surfaces for each variate at least: what a regression leaves of few surfaces is known roughly
ALIKE = 1e-10  # of the largest, below which a direction of the variates is none
WIDER = 1.15  # places over the smooth contact, around which peaks touch
ACROSS, MOST = 10, 64  # shortest waves that count, across these places and in a period: others average out
TOGETHER = 64  # surfaces at once: 9 MB of waves at most


def control_variates(solver: Solver, scenes: Sequence[Scene], seeds: Sequence[int]) -> np.ndarray:
    """Control variates (scenes, seeds, 8) [1] of the surfaces that a solver draws, in units of the spectrum.

    They are h, p, p h_xx, h_x^2, h_xx, p^2 h_xx, p h_x^2 and h_x; on a line p is h. There are none,
    (scenes, seeds, 0), for another model, a plane, a motion in time, and measured roughness.

    scenes : scenes with the same body and roughness; the variates are 0 where the smooth body has no answer
    seeds : of the surfaces; those of the scenes are replaced
    """
    rough: Any = scenes[0].roughness
    steady = not any(isinstance(each.motion, Program) or isinstance(each.indenter, Plane) for each in scenes)
    if not (steady and type(solver) in (BEM, MDR) and isinstance(rough, Isotropic)):
        return np.empty((len(scenes), len(seeds), 0))
    found, narrowest = np.zeros((len(scenes), len(seeds), 8)), ACROSS * rough.longest / MOST
    below = [_footprint(replace(each, roughness=None), isinstance(solver, MDR)) for each in scenes]
    tops = [max(int(ACROSS * rough.longest / max(np.ptp(each[0]), narrowest)), 1) if each else 1 for each in below]
    rough = rough.normalized  # heights of any unit have the same variates but for a factor
    power = np.square(abs(_waves(solver, replace(rough, amplitudes="fixed"), max(tops), [rough.seed])[0])) / 2
    for first in range(0, len(seeds), TOGETHER):
        waves = _waves(solver, rough, max(tops), seeds[first : first + TOGETHER])
        for own, places, top in zip(found, below, tops, strict=True):
            if places:
                low = slice(max(len(power) // 2 - top, 0), len(power) // 2 + top + 1), slice(top + 1)
                own[first : first + TOGETHER] = _averages(places, rough.q_min, waves[:, *low], power[low])
    return found


@lru_cache(maxsize=1024)
def _footprint(scene, line):
    """Places x (X,), y (Y,) [m] around a smooth contact, or on a line, and their share (Y, X) in its force."""
    try:
        found = BEM(points=64).solve(scene).fields
    except (SolveError, Refused, NotImplementedError):
        return None
    pressed = found["pressure"] > 0
    down, along = pressed.any(axis=1), pressed.any(axis=0)
    weight = found["pressure"][np.ix_(down, along)]
    x, y = (each.mean() + WIDER * (each - each.mean()) for each in (found["x"][along], found["y"][down]))
    if line:  # the line carries the force of all places along y
        y, weight = np.zeros(1), weight.sum(axis=0, keepdims=True)
    return x, y, weight / weight.sum()


def _waves(solver, rough, top, seeds):
    """Amplitudes (seeds, 2 K + 1, K + 1) of surfaces, or (seeds, 1, K + 1) of lines, with at most `top` waves."""
    highest = top + 0.5 if rough.shortest is None else min(top + 0.5, rough.longest / rough.shortest)
    if isinstance(solver, BEM):
        drawn = (RoughSurface.draw(replace(rough, seed=each), highest * rough.q_min) for each in seeds)
        return np.array([each.amplitudes for each in drawn])
    waves = amplitudes(rough, highest, solver.spectrum)
    family = LineFamily(waves, rough.amplitudes == "gaussian", 4 * waves.size, 1.0, 1.0)  # of any pixel
    heights = np.array([each.heights for each in family.drawn_together(seeds)])
    return 2 * np.fft.rfft(heights, norm="forward")[:, None, : waves.size + 1]


def _averages(places, step, waves, power):
    """Control variates (seeds, 8) of waves of multiples of a wave number, with their mean squares halved."""
    (x, y, weight), rows = places, len(power) // 2
    k_x, k_y = np.arange(power.shape[1]), np.arange(len(power)) - rows
    stiffness = np.hypot(k_x, k_y[:, None]) / k_x[-1] if rows else 1.0
    along, across = np.exp(1j * step * np.outer(k_x, x)), np.exp(1j * step * np.outer(y, k_y))
    slope, bend = 1j * k_x / k_x[-1], -np.square(k_x / k_x[-1])
    along_x = np.concatenate([along, slope[:, None] * along, bend[:, None] * along], axis=1)
    h, h_x, h_xx = np.split((across @ waves @ along_x).real, 3, axis=-1)
    p = (across @ (waves * stiffness) @ along).real
    products = [h, p, p * h_xx - np.sum(power * stiffness * bend), h_x**2 + np.sum(power * bend)]
    products += [h_xx, p**2 * h_xx, p * h_x**2, h_x]
    return np.stack([np.tensordot(each, weight, 2) for each in products], axis=-1)


def controlled(values: np.ndarray, variates: np.ndarray) -> np.ndarray:
    """Values (..., n) less what variates (..., n, K) of mean zero explain of each, by least squares a point.

    The slopes for a value are those of all others, so that the mean has no bias (Avramidis and Wilson, Oper. Res.
    Lett. 14, 187, 1993). NaN stays. With fewer than 4 values for each variate only the first variates are used.
    """
    known = np.isfinite(values)
    count = known.sum(axis=-1, keepdims=True)
    used = known[..., None] & (np.arange(variates.shape[-1]) < count[..., None] // EACH)
    with np.errstate(invalid="ignore", divide="ignore"):
        given = np.where(used, variates, 0.0)
        about = np.where(used, given - given.sum(axis=-2, keepdims=True) / count[..., None], 0.0)
        answers = np.where(known, values - np.where(known, values, 0.0).sum(axis=-1, keepdims=True) / count, 0.0)
        inverse = np.linalg.pinv(about, rcond=ALIKE)
        slopes, turned = inverse @ answers[..., None], np.swapaxes(inverse, -1, -2)
        rest = answers - (about @ slopes)[..., 0]
        # Without a value the slopes differ by its distance from the plane through all others.
        moved = rest / np.maximum(1 - np.sum(about * turned, axis=-1) - 1 / count, ALIKE)
        explained = (given @ slopes)[..., 0] - np.sum(given * turned, axis=-1) * moved
    return np.where(known, values - explained, values)
