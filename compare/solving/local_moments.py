"""Moments of the rough surface below a body: cheap numbers that follow friction and depth, of mean exactly nil.

The friction of one surface follows to a good part from the waves below the contact: from their slopes, their
curvatures, and the pressure that would flatten them. Averages of such products, weighted with the pressure of the
smooth body, are control variates (Lavenberg and Welch, Manage. Sci. 27, 322, 1981): their means over all surfaces
follow from the spectrum. Phases are random, so that h is as likely as -h and products of one or of three have a
mean of nil; at every place that of h_x^2 is sum A^2 q_x^2 / 2, that of p h_xx is -sum A^2 s q_x^2 / 2, with the
pressure of a wave s times its height.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from bem3d import BEM
from bem3d.surface import RoughSurface
from mdr1d import MDR
from mdr1d.surface import LineFamily, amplitudes
from scene import Plane, Program, Refused, Scene, SelfAffine, SolveError, Solver

WIDER = 1.15  # footprint over the smooth contact, around which peaks touch
CUT = 10  # of the shortest waves that count lie across a footprint: what is shorter averages out
MOST = 64  # waves in a period
PLACES = 20  # along a side of a footprint
TOGETHER = 64  # surfaces at once: 9 MB of waves at most
ENOUGH = {"BEM": 64, "MDR": 1024}  # points for a smooth body


@dataclass(frozen=True, eq=False)
class Footprint:
    """Places below a body, and the share of its force at each.

    x, y : places (X,), (Y,) [m], from the axis of the body; of a line y is 0
    weight : (Y, X), its sum is 1
    """

    x: np.ndarray
    y: np.ndarray
    weight: np.ndarray

    @classmethod
    def of(cls, x: np.ndarray, y: np.ndarray, pressure: np.ndarray) -> "Footprint | None":
        """Footprint of a smooth contact: its pressure (Y, X), or a line force (1, X), on a wider patch.

        None where the places fall beside what presses.
        """
        across, to_y = _patch(y, (pressure > 0).any(axis=1))
        along, to_x = _patch(x, (pressure > 0).any(axis=0))
        weight = np.maximum(to_y @ pressure @ to_x.T, 0.0)
        return cls(along, across, weight / weight.sum()) if weight.any() else None

    @property
    def size(self) -> float:
        """Longer side [m]."""
        return float(max(np.ptp(self.x), np.ptp(self.y)))


def local_moments(solver: Solver, scenes: Sequence[Scene], seeds: Sequence[int]) -> np.ndarray:
    """Moments of the surfaces that a solver draws, (scenes, seeds, K) [1], in units of the spectrum.

    K is 8 of surfaces in 3D: h, p, p h_xx, h_x^2, h_xx, p^2 h_xx, p h_x^2, h_x; 7 of lines in 1D, where the
    pressure p of full contact is as the height h. It is 0 of what has no such moments: of another model, a plane,
    a motion in time, and roughness that is not drawn from a self-affine spectrum.

    scenes : of one body and roughness, steady; where the smooth body has no answer its moments are nil
    seeds : of the surfaces; those of the scenes are replaced
    """
    rough = scenes[0].roughness
    if not (type(solver) in (BEM, MDR) and isinstance(rough, SelfAffine)) or any(
        isinstance(each.motion, Program) or isinstance(each.indenter, Plane) for each in scenes
    ):
        return np.empty((len(scenes), len(seeds), 0))
    asked: Any = solver
    smooth = replace(asked, points=min(asked.points, ENOUGH[solver.name]), extent=None)
    footprints = [_footprint(smooth, replace(each, roughness=None)) for each in scenes]
    tops = [0 if each is None else _waves_of(rough, each) for each in footprints]
    found = np.zeros((len(scenes), len(seeds), 7 if isinstance(solver, MDR) else 8))
    if not any(tops):
        return found
    # Heights of any unit have the same moments but for a factor.
    drawn = _Lines if isinstance(solver, MDR) else _Surfaces
    family = drawn(solver, replace(rough, rms_height=1.0), max(tops))
    for first in range(0, len(seeds), TOGETHER):
        some = slice(first, first + TOGETHER)
        waves = family.drawn(seeds[some])
        for each, top, own in zip(footprints, tops, found, strict=True):
            if each is not None:
                own[some] = _moments(each, family, top, waves)
    return found


def _patch(at, touched):
    """Places across a contact, and from evenly spaced ones the matrix that interpolates to as many within it."""
    if at.size == 1:
        return at, np.ones((1, 1))
    ends = at[touched]
    within = np.linspace(ends[0], ends[-1], PLACES)
    middle = (ends[0] + ends[-1]) / 2
    hats = np.maximum(1 - np.abs(within[:, None] - at) / (at[1] - at[0]), 0.0)
    return middle + WIDER * (within - middle), hats


@lru_cache(maxsize=1024)
def _footprint(solver, scene) -> Footprint | None:
    """Footprint of a smooth body; None where it has no answer."""
    try:
        fields = solver.solve(scene).fields
    except (SolveError, Refused, NotImplementedError):
        return None
    x = fields["x"]
    if isinstance(solver, BEM):
        return Footprint.of(x, fields["y"], fields["pressure"])
    return Footprint.of(x + (x[1] - x[0]) / 2, np.zeros(1), fields["line_force"][None])


def _waves_of(rough, footprint):
    """Number in a period of the shortest waves that count."""
    most = min(MOST, int(_bandwidth(rough, MOST) * (1 + 1e-12)))
    across = footprint.size / rough.longest
    return most if across * most <= CUT else max(int(CUT / across), 1)


def _bandwidth(rough, top):
    """Highest wave number, over the lowest, of up to a number of waves in a period: or all of the surface."""
    return top + 0.5 if rough.shortest is None else min(top + 0.5, rough.longest / rough.shortest)


class _Surfaces:
    """Surfaces of one spectrum, by complex amplitudes (seeds, 2 top + 1, top + 1) as those of `scene.waves`.

    power : their mean squares, halved; stiffness : pressure of each wave over its height, of the shortest 1
    """

    def __init__(self, solver, rough, top):
        self.rough, self.q_max, self.step = rough, _bandwidth(rough, top) * rough.q_min, rough.q_min
        waves = RoughSurface.draw(replace(rough, amplitudes="fixed"), self.q_max).waves
        self.power, self.stiffness = waves.power * waves.unit**2, waves.q / (top * self.step)

    def drawn(self, seeds):
        return np.array([RoughSurface.draw(replace(self.rough, seed=s), self.q_max).amplitudes for s in seeds])


class _Lines:
    """Lines of one spectrum, by complex amplitudes (seeds, 1, top + 1); springs press as they are high."""

    stiffness = None

    def __init__(self, solver, rough, top):
        waves = amplitudes(rough, _bandwidth(rough, top), solver.spectrum)
        nodes = 4 * top  # a wave of two nodes would have no phase
        pixel = rough.longest / nodes
        self.step = rough.q_min
        self.power = np.append(0.0, np.square(waves) / 2)[None]
        self.family = LineFamily(waves, rough.amplitudes == "gaussian", nodes, pixel, rough.longest / top)

    def drawn(self, seeds):
        heights = np.array([each.heights for each in self.family.drawn_together(seeds)])
        return 2 * np.fft.rfft(heights, norm="forward")[:, None, : self.power.size]


def _moments(footprint, family, top, waves):
    """Moments (seeds, K) of some surfaces, from their waves up to a number in a period."""
    high = family.power.shape[0] // 2
    low = slice(max(high - top, 0), high + top + 1), slice(top + 1)
    waves, power = waves[:, *low], family.power[low]
    k_x, k_y = np.arange(top + 1) / top, (np.arange(power.shape[0]) - power.shape[0] // 2) / top
    turns = 1j * top * family.step
    along, across = np.exp(turns * np.outer(k_x, footprint.x)), np.exp(turns * np.outer(footprint.y, k_y))
    along_x = np.concatenate([along, 1j * k_x[:, None] * along, -np.square(k_x)[:, None] * along], axis=1)
    h, h_x, h_xx = np.split(_real(across @ waves, along_x), 3, axis=-1)
    surface = family.stiffness is not None
    stiffness = family.stiffness[low] if surface else 1.0
    p = _real(across @ (waves * stiffness), along) if surface else h
    squares = np.square(k_x)
    slopes, pressed = np.sum(power * squares), -np.sum(power * stiffness * squares)
    products = [h] * surface + [p, p * h_xx - pressed, h_x**2 - slopes, h_xx, p**2 * h_xx, p * h_x**2, h_x]
    return np.stack([np.tensordot(each, footprint.weight, 2) for each in products], axis=-1)


def _real(rows, columns):
    return rows.real @ columns.real - rows.imag @ columns.imag
