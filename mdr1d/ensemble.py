"""Many scenes on many rough profiles of a Kelvin foundation: the sweeps of MDR without a Result for each.

Profiles of one spectrum differ in the seed. On each of them a whole list of scenes is solved, one after the other:
it is drawn once, and every depth starts the search for the next. Every answer is that of MDR on as many points a
period.
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from math import ceil, nan

import numpy as np

from scene import Kelvin, Scene, SelfAffine, Slide
from scene.scales import elastic_contact

from .foundation import _sweep, compiled
from .surface import Surface, draw

# Relative misfit of the load: where Newton stops, and what is still an answer.
_AIM, _ACCEPTED = 1e-11, 1e-10
_MOST_SWEEPS = 200


@dataclass(frozen=True)
class Answers:
    """One number a scene and a seed, arrays (scenes, seeds); NaN where a load is not met to a relative 1e-10.

    friction : coefficient of friction [1]
    depth : of the macroscopic tip [m]
    length, span : of the real contact, and from its first to its last point [m]
    rms_slope : of the profile over its period, by finite differences [1]
    sweeps : along the profile
    """

    friction: np.ndarray
    depth: np.ndarray
    length: np.ndarray
    span: np.ndarray
    rms_slope: np.ndarray
    sweeps: np.ndarray


def solve_profiles(scenes: Sequence[Scene], points: Sequence[int], seeds: Sequence[int]) -> Answers:
    """Solve every scene on the profiles of all seeds, repeated as far as contact goes.

    scenes : a body of revolution sliding under a load, rough with a self-affine spectrum, on a Kelvin solid; the
        seeds of their own are replaced
    points : pixels on the longest wavelength, one number a scene

    Raises ValueError where a scene is another.
    """
    for scene in scenes:
        _check(scene)
    groups: dict[tuple, list[int]] = {}
    for i, (scene, count) in enumerate(zip(scenes, points, strict=True)):
        unit = replace(scene.roughness, rms_height=1.0, seed=0)
        groups.setdefault((unit, count, scene.indenter.exponent), []).append(i)
    answers = Answers(*(np.full((len(scenes), len(seeds)), nan) for _ in fields(Answers)))
    series = {key: _Series([scenes[i] for i in members], key[1]) for key, members in groups.items()}
    for column, seed in enumerate(seeds):
        for (unit, count, exponent), members in groups.items():
            surface = draw(replace(unit, seed=seed), count)
            found = series[unit, count, exponent].solve(surface)
            for name, values in zip((field.name for field in fields(Answers)), found, strict=True):
                getattr(answers, name)[members, column] = values
    return answers


class _Series:
    """Scenes on one profile, as arrays (scenes,)."""

    def __init__(self, scenes, points):
        pixel = scenes[0].roughness.longest / points
        smooth = [elastic_contact(scene) for scene in scenes]
        self.coefficient = np.array([scene.indenter.mdr_coefficient for scene in scenes])
        self.exponent = scenes[0].indenter.exponent
        self.rms = np.array([scene.roughness.rms_height for scene in scenes])
        self.memory = np.array([scene.motion.speed * scene.elastomer.relaxation_time for scene in scenes])
        self.load = np.array([scene.motion.load / scene.elastomer.indentation_modulus for scene in scenes])
        self.depth = np.array([contact.depth for contact in smooth])
        self.pixel = pixel

    def solve(self, surface: Surface):
        """The columns of Answers on one profile, drawn with a unit rms height."""
        heights = surface.heights
        rise = self.depth + (heights.max() - heights.min()) * self.rms
        half = np.ceil((rise / self.coefficient) ** (1 / self.exponent) / self.pixel).astype(int) + 1
        shape = (np.arange(half.max() + 1) * self.pixel) ** self.exponent
        found = np.empty((self.rms.size, 6))
        _press(
            heights, shape, self.pixel, half, self.coefficient, self.rms, self.memory, self.load, self.depth, found
        )
        misfit, friction, depth, length, span, sweeps = found.T
        met = misfit <= _ACCEPTED
        columns = (friction, depth, length, span, surface.rms_slope * self.rms, sweeps)
        return tuple(np.where(met, column, nan) for column in columns)


@compiled
def _press(unit, shape, pixel, half, coefficient, rms, memory, load, smooth, found):
    """Press profiles rms * unit + coefficient * shape down with loads over E*, by Newton as in indentation.

    unit : one period of roughness; shape : |x|^n from the tip on; half : nodes that contact may reach on each side
    smooth : depths of the smooth relaxed contact; found : misfit, friction, depth, length, span, sweeps (scenes, 6)
    """
    top = unit.max()
    ratio = 0.0  # of the last depth to its smooth one, counted from the same height of roughness
    for s in range(load.size):
        size = 2 * half[s] + 1
        heights = np.empty(size)
        k = (-half[s]) % unit.size
        for i in range(size):
            heights[i] = coefficient[s] * shape[abs(i - half[s])] + rms[s] * unit[k]
            k = k + 1 if k + 1 < unit.size else 0
        lowest = heights.min()
        heights -= lowest
        displacement, touching = np.empty(size), np.empty(size, np.bool_)
        surely = smooth[s] + rms[s] * top - lowest
        approach = ratio * smooth[s] - lowest if ratio > 0.0 else surely
        if not 0.0 < approach < surely:
            approach = surely
        best = np.inf
        for sweeps in range(1, _MOST_SWEEPS + 1):
            force, lost, _, stiffness, length, _, first, last = _sweep(
                heights, pixel, memory[s], approach, displacement, touching
            )
            misfit = abs(force / load[s] - 1.0)
            if misfit < best:
                best = misfit
                found[s, 0], found[s, 1], found[s, 2] = misfit, lost / force, approach + lowest
                found[s, 3], found[s, 4], found[s, 5] = length, last - first, sweeps
                if misfit <= _AIM:
                    break
            elif best <= _ACCEPTED:
                break
            approach = min(approach - (force - load[s]) / stiffness, surely)
        ratio = found[s, 2] / smooth[s]


def _check(scene):
    body, rough = scene.indenter, scene.roughness
    fit = (
        isinstance(scene.elastomer, Kelvin)
        and isinstance(scene.motion, Slide)
        and scene.motion.load is not None
        and isinstance(rough, SelfAffine)
        and hasattr(body, "mdr_coefficient")
    )
    if not fit:
        raise ValueError(
            f"scene = {scene!r}: profiles are solved together for a body of revolution with self-affine roughness "
            "that slides under a load on a Kelvin solid; take MDR for any other scene"
        )
