"""Friction of a rough body of revolution from its spectrum: the law of three dimensions."""

from dataclasses import dataclass, replace
from math import pi, sqrt

import numpy as np

from bem3d import BEM
from scene import Scene

from .bands import Bands, FullContact
from .interface import SoftContact
from .share import Share

SPACE = BEM(points=64)


@dataclass(frozen=True)
class Parts:
    smooth: float
    rough: float
    radius: float
    x: float
    share: float
    load: float
    depth: float
    lossy: float
    stiffening: float
    height: float
    a: float
    mu0: float
    d: float
    waves: float

    @property
    def friction_coefficient(self):
        return self.smooth + self.rough


def friction_of(scene: Scene, passes=2, share=None, by="gyration") -> Parts:
    bare = SPACE.solve(replace(scene, roughness=None))
    shape, solid, speed = scene.indenter, scene.solid, scene.motion.speed
    a, load, mu0 = sqrt(bare.measures["contact_area"] / pi), bare.normal_force, bare.friction_coefficient
    n, g = shape.exponent, shape.mdr_coefficient
    modulus = load * (n + 1) / (2 * n * g * a ** (n + 1))
    smooth = SoftContact.smooth(shape, modulus, a)
    radius = a
    for _ in range(passes):
        bands = Bands.of(scene.roughness).beneath(radius)
        full = FullContact.of(bands, solid, speed)
        S = share(full) if share else Share.of(full)
        found = SoftContact.of(shape, modulus, smooth, bands.rms_height, full.pressure[-1])
        radius = a * found.gyration / smooth.gyration
    rough = full.friction.sum() * np.sum(S(found.pressure / full.pressure[-1]) * found.area) / found.load
    kept = found.friction(solid, speed) / smooth.friction(solid, speed) * smooth.load / found.load
    x = found.load / (pi * radius**2) / full.pressure[-1]
    return Parts(mu0 * kept, float(rough), radius, float(x), float(S(np.array(x))), found.load, found.depth,
                 full.lossy, full.stiffening, bands.rms_height, a, mu0, bare.depth, a * bands.q[-1] / (2 * pi))
