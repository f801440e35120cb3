"""Many scenes on many rough profiles of a Kelvin foundation: the sweeps of MDR without a Result for each.

Profiles of a spectrum differ in the seed. Each profile is drawn once, all scenes are solved on it,
and every depth starts the search for the next. Every answer equals the answer of MDR on as many points a period.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import inf, nan, sqrt
from typing import Any

import numpy as np

from scene import Kelvin, Scene, SelfAffine, Slide, SolveError
from scene.protocol import numeric_guard
from scene.scales import elastic_contact

from .domain import whole
from .element import compiled, summed
from .indentation import ACCEPTED, nearer
from .kelvin import flow_kelvin
from .surface import MOST_NODES, Surface, family_of, nodes_needed

# Relative misfit of the load at which a search stops: friction needs no more.
_AIM = 1e-11
# Profiles that are drawn at once.
_TOGETHER = 4
# Parts of a scene that are taken, no more and no less.
_PARTS = {"indenter", "elastomer", "motion", "roughness"}


@dataclass(frozen=True)
class Answers:
    """Answers for each scene and seed, arrays (scenes, seeds); NaN where a load is not met to a relative 1e-10.

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


@numeric_guard()
def solve_profiles(scenes: Sequence[Scene], points: Sequence[int], seeds: Sequence[int]) -> Answers:
    """Solve every scene on the profiles of all seeds, repeated as far as contact goes.

    scenes : a body of revolution sliding under a load, rough with a self-affine spectrum, on a Kelvin solid; the
        seeds of their own are replaced
    points : pixels on the longest wavelength, one number a scene

    Raises ValueError where a scene is another, its roughness is not resolved, or points or seeds are no whole
    numbers; SolveError where a period or contact would take too many pixels, or the numbers of a scene are too far
    apart.
    """
    if len(points) != len(scenes):
        raise ValueError(f"points has {len(points)} values, scenes has {len(scenes)}: each scene needs one number")
    whole(1, points=points)
    whole(0, seeds=seeds)
    for scene, count in zip(scenes, points, strict=True):
        _check(scene)
        _check_resolved(scene.roughness, count)
    members: dict[tuple, list[int]] = {}
    for i, (scene, count) in enumerate(zip(scenes, points, strict=True)):
        rough: Any = scene.roughness
        unit = replace(rough, rms_height=1.0, seed=0)
        members.setdefault((count, unit, scene.indenter.exponent), []).append(i)
    # In the order of their points: transforms of equal length share their factors.
    series = [
        (indices, unit, family_of(unit, count), _Series([scenes[i] for i in indices], count))
        for (count, unit, _), indices in sorted(members.items(), key=lambda member: member[0][0])
    ]
    found = np.full((len(scenes), len(seeds), 6), nan)
    slopes = np.full((len(scenes), len(seeds)), nan)
    # All spectra of some seeds together: their phases are the same.
    for first in range(0, len(seeds), _TOGETHER):
        columns = range(len(seeds))[first : first + _TOGETHER]
        ratios: dict[tuple, float] = {}
        for indices, unit, family, each in series:
            surfaces = family.drawn_together([seeds[column] for column in columns])
            for column, surface in zip(columns, surfaces, strict=True):
                start = ratios.get((unit, column), 1.0)
                found[indices, column], slopes[indices, column], ratios[unit, column] = each.solve(surface, start)
    misfit, friction, depth, length, span, sweeps = np.moveaxis(found, -1, 0)
    answers = (friction, depth, length, span, slopes, sweeps)
    return Answers(*(np.where(misfit <= ACCEPTED, answer, nan) for answer in answers))


class _Series:
    """Scenes on one profile, as arrays (scenes,)."""

    def __init__(self, scenes, points):
        self.powers = np.empty(0)
        self.pixel = scenes[0].roughness.longest / points
        self.exponent = scenes[0].indenter.exponent
        self.coefficient = np.array([scene.indenter.mdr_coefficient for scene in scenes])
        self.rms = np.array([scene.roughness.rms_height for scene in scenes])
        self.memory = np.array([scene.motion.speed * scene.elastomer.relaxation_time for scene in scenes])
        self.load = np.array([scene.motion.load / scene.elastomer.indentation_modulus for scene in scenes])
        smooth = [elastic_contact(scene) for scene in scenes]
        radius = np.array([contact.radius for contact in smooth])
        self.depth = np.array([contact.depth for contact in smooth])
        # A chord between nodes lies above the shape, and nowhere above the shape a pixel farther out.
        self.enough = self.coefficient * (radius + self.pixel) ** self.exponent

    def solve(self, surface: Surface, ratio: float):
        """Answer of _press_many on one profile, drawn with a unit rms height; its rms slope; and the last ratio.

        ratio : of the depth to the smooth one, from which the first search starts
        """
        heights = surface.heights
        top, rms_slope = heights.max(), sqrt(_squared_steps(heights) / heights.size) / self.pixel
        rise = self.enough + (top - heights.min()) * self.rms
        half = np.ceil((rise / self.coefficient) ** (1 / self.exponent) / self.pixel) + 1
        farthest = half.max()
        if farthest > MOST_NODES:
            raise SolveError(
                f"contact may take {2 * farthest:.2g} pixels of {self.pixel:g} m, more than {2 * MOST_NODES}: "
                "take fewer points, a longer period or a lesser load"
            )
        found = np.empty((self.rms.size, 6))
        ratio = _press_many(
            heights,
            top,
            self._powers(int(farthest) + 1),
            self.pixel,
            half.astype(int),
            self.coefficient,
            self.rms,
            self.memory,
            self.load,
            self.depth,
            self.enough,
            ratio,
            _AIM,
            ACCEPTED,
            found,
        )
        return found, rms_slope * self.rms, ratio

    def _powers(self, nodes):
        """|x|^n at `nodes` nodes or more, from the tip on: kept, as all profiles reach about as far."""
        if self.powers.size < nodes:
            self.powers = (np.arange(1.1 * nodes) * self.pixel) ** self.exponent
        return self.powers


@compiled
def _raise_heights(unit, powers, coefficient, rms, heights):
    """Write coefficient * powers + rms * unit on both sides of the tip, above its lowest node, and return that."""
    half, period = heights.size // 2, unit.size
    for begin in range(0, half + 1, period):
        end = min(begin + period, half + 1)
        rise = powers[begin:end]
        right, left = heights[half + begin : half + end], heights[half - end + 1 : half - begin + 1]
        for k in range(rise.size):
            right[k] = coefficient * rise[k] + rms * unit[k]
            left[rise.size - 1 - k] = coefficient * rise[k] + rms * unit[-k]
    lowest = heights.min()
    heights -= lowest
    return lowest


@compiled
def _press_many(
    unit, top, powers, pixel, half, coefficient, rms, memory, load, smooth, enough, ratio, aim, accepted, found
):
    """Press profiles coefficient * powers + rms * unit down with loads, as many as there are.

    unit : one period of roughness (M,), top : its highest node; powers : |x|^n at the nodes from the tip on
    half : nodes that contact may reach on each side; coefficient, rms, memory; load, over K [m^2]; smooth, the
        depth of the smooth relaxed contact, and enough, one that surely carries the load on chords between the
        nodes: all (scenes,)
    aim, accepted : relative misfit of the load at which the search stops, and at which it may
    found : misfit, friction, depth, length, span, sweeps (scenes, 6), to be filled; NaN where nothing is found

    Each search starts from a ratio of the depth to the smooth one, where that makes sense: the ratio found before,
    and at first the one given. The last is returned.
    """
    room = np.empty(2 * half.max() + 1)
    for s in range(load.size):
        heights = room[: 2 * half[s] + 1]
        lowest = _raise_heights(unit, powers, coefficient[s], rms[s], heights)
        # A depth far below the heights of roughness may be lost to rounding.
        surely = max(enough[s] + rms[s] * top - lowest, enough[s])
        approach = ratio * smooth[s] - lowest
        if not 0.0 < approach < surely:
            approach = surely
        lower, upper = 0.0, inf
        best, sweeps = inf, 0
        found[s] = nan
        while sweeps < 200 and lower < approach < upper:
            force, lost, _, stiffness, length, _, first, last = flow_kelvin(heights, pixel, memory[s], approach)
            sweeps += 1
            misfit = abs(force / load[s] - 1.0)
            if misfit < best:
                best = misfit
                found[s, 0], found[s, 1], found[s, 2] = misfit, lost / force, approach + lowest
                found[s, 3], found[s, 4], found[s, 5] = length, last - first, sweeps
            elif best <= accepted:
                break
            if misfit <= aim:
                break
            approach, lower, upper = nearer(approach, force, stiffness, load[s], lower, upper, surely)
        ratio = found[s, 2] / smooth[s]
    return ratio


@summed
def _squared_steps(heights):
    total = (heights[0] - heights[-1]) ** 2
    for k in range(heights.size - 1):
        total += (heights[k + 1] - heights[k]) ** 2
    return total


def _check(scene):
    fit = (
        set(scene.parts) == _PARTS
        and isinstance(scene.elastomer, Kelvin)
        and isinstance(scene.motion, Slide)
        and scene.motion.load is not None
        and isinstance(scene.roughness, SelfAffine)
        and hasattr(scene.indenter, "mdr_coefficient")
    )
    if not fit:
        raise ValueError(
            f"scene = {scene!r}: profiles are solved together for a body of revolution with self-affine roughness "
            "that slides under a load on a Kelvin half-space, and nothing else; take MDR for any other scene"
        )


def _check_resolved(rough, points):
    needed = nodes_needed(rough)
    if points < needed:
        raise ValueError(
            f"points = {points} do not resolve roughness with longest = {rough.longest:g}: it takes at least "
            f"{needed}" + ("" if rough.shortest is None else f" for shortest = {rough.shortest:g}")
        )
    if points > MOST_NODES:
        raise SolveError(f"points = {points} on roughness.longest = {rough.longest:g} are more than {MOST_NODES}")
