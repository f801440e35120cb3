"""Fig. 4 with every place of the contact a rough plane, which tells why alpha depends on the shape.

A place is pressed as deep as it is in the contact, and the less deep, the sooner it loses contact as the speed
grows, Eq. 13. A cone has more of the shallow places than a sphere: its friction bends towards the plateau over a
wider range of speeds.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import PchipInterpolator
from scipy.optimize import brentq

from mdr1d import draw, sweep
from scene.scales import elastic_contact

from ...solving.task import SCENES
from . import parameters
from .arrays import ArrayTask

PROFILES = 8
# Depths of a plane, in rms heights: none touches below the first, and few miss above the second.
AIR, DEEP, STEPS = -5.0, 5.0, 24
# Places from the middle of the contact to its edge.
PLACES = 2001


@dataclass(frozen=True)
class Planes(ArrayTask):
    """Task of the friction of one shape from planes, at speeds [m/s]. Needs a memory short beside the contact."""

    shape_name: str
    speeds: tuple[float, ...]
    names = ("friction",)

    @property
    def label(self) -> str:
        """Name of the shape."""
        return f"Fig. 4, {self.shape_name} as rough planes"

    @property
    def work(self) -> float:
        """Rough cost: a sweep of two periods at every depth."""
        return 2.0 * 2 * STEPS * PROFILES * len(self.speeds) * parameters.POINTS

    @property
    def question(self) -> Mapping:
        """Scene, speeds, and how it is solved."""
        scene = SCENES.dump_python((parameters.base(self.shape_name),), mode="json")
        return {"scene": scene, "speeds": self.speeds, "planes": (PROFILES, AIR, DEEP, STEPS, PLACES)}

    @property
    def shape(self) -> tuple[int]:
        """Speeds."""
        return (len(self.speeds),)

    def arrays(self) -> Mapping[str, np.ndarray]:
        """Friction coefficient at each speed."""
        return {"friction": np.array([self._friction(speed) for speed in self.speeds])}

    def _friction(self, speed):
        scene = parameters.base(self.shape_name, speed)
        body, relaxed = scene.indenter, elastic_contact(scene)
        height = scene.roughness.rms_height
        deepest = relaxed.depth + DEEP * height
        push, pull = _plane(scene.roughness, speed * scene.elastomer.relaxation_time, deepest)
        x = np.linspace(0, (deepest / body.mdr_coefficient) ** (1 / body.exponent), PLACES)
        macro = body.mdr_coefficient * x**body.exponent
        load = scene.motion.load / scene.elastomer.indentation_modulus

        def over_contact(force, depth):
            return 2 * np.trapezoid(force(np.maximum(depth - macro, AIR * height)), x)

        depth = brentq(lambda depth: over_contact(push, depth) - load, -height, deepest)
        return over_contact(pull, depth) / load


def _plane(rough, memory, deepest):
    """Force and friction of a rough plane per length and stiffness [m] as functions of its depth [m].

    Of the second of two periods, which slides in the wake of the first.
    """
    height = rough.rms_height
    near = np.linspace(AIR * height, DEEP * height, STEPS, endpoint=False)
    depths = np.concatenate([near, np.geomspace(DEEP * height, deepest, STEPS)])
    sums = np.zeros((depths.size, 2))
    for seed in range(PROFILES):
        surface = draw(replace(rough, seed=seed), parameters.POINTS)
        heights = np.tile(surface.heights, 2)
        slopes = (np.diff(heights) / surface.pixel)[-parameters.POINTS :]
        for row, depth in zip(sums, depths, strict=True):
            pushed = sweep(heights, surface.pixel, memory, depth).pushed[-parameters.POINTS :, 1]
            row += pushed.sum(), -slopes @ pushed
    push, pull = (sums / (PROFILES * rough.longest)).T
    return PchipInterpolator(depths, push), PchipInterpolator(depths, pull)
