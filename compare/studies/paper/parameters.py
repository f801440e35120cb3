"""The parameters of Popov et al., Sci. Rep. 4, 3750 (2014), and what stands for those it leaves open.

Given: the reference length, the set of Fig. 4, both contacts of Fig. 1, and the ranges of the studies of Fig. 3.
Not given: what is held while one parameter varies (here the set of Fig. 4), the speed of the studies, whether the
angle belongs to the body or to its line (here to the body, mapped), and how values lie in a range (here
geometrically, angles evenly).
"""

from collections.abc import Sequence
from dataclasses import replace
from math import pi, radians
from typing import Any

import numpy as np
from scipy.fft import next_fast_len

from mdr1d import MDR, draw, equations
from scene import Cone, Fractional, Kelvin, Regime, Scene, SelfAffine, Slide, Sphere
from scene.scales import elastic_contact

from ...solving.curve import FINE, Curve

LENGTH, POINTS = 1e-2, 5000
PROFILES = 200
ROUGH = SelfAffine(hurst=0.4, rms_height=5e-5, longest=LENGTH)
SOLID = Kelvin(modulus=1e6, relaxation_time=1e-3)
SHAPES: dict[str, Cone | Sphere] = {"cone": Cone(angle=radians(10)), "sphere": Sphere(radius=1e-2)}
HURST = tuple(k / 10 for k in range(11))

# Fig. 1: load and speed, and of each contact the Hurst exponent and the profile.
CONTACT = Slide(speed=0.1, load=1.0)
CONTACT_HURST = {"cone": 0.1, "sphere": 0.2}
CONTACT_SEED = {"cone": 1, "sphere": 2}
# Fig. 3 and Fig. 4: the load; slow enough that a viscous layer of a few pixels is remembered.
LOAD, LOW_SPEED = 10.0, 1e-3

# Figs. 5 to 7: as many speeds as in the experiment, in its range, on the sphere and the modulus of Fig. 4 with a
# loss that is a power of frequency; rougher at short waves: every force lies in the regime of the laws.
FORCES = tuple(np.geomspace(2, 50, 10).tolist())
SPEEDS = tuple(np.geomspace(5e-4, 0.58, 28).tolist())
LOSS_ROUGH = SelfAffine(hurst=0.2, rms_height=2e-5, longest=LENGTH)
LOSS_PROFILES = 24
# Exponent beta and time tau [s] of each loss, G = G_0 (1 + (i omega tau)^beta). With the time of Fig. 4 the
# modulus, which the paper takes for constant, grows with the speed on the scale of the contact too; with the
# shorter one it grows by less than a tenth there.
LOSSES = ((0.1, SOLID.relaxation_time), (0.1, 1e-14), (0.5, SOLID.relaxation_time), (0.5, 1e-5))


def _between(low, high):
    return np.geomspace(low, high, 20).tolist()


# Fig. 3: part of the scene and parameter that a study varies, and its values in SI units; spacings are moved by
# 2 % at most, to where transforms over the length are fast.
STUDIES = {
    "load": ("motion", "load", _between(1e-1, 1e1)),
    "modulus": ("elastomer", "modulus", _between(1e5, 1e7)),
    "rms height": ("roughness", "rms_height", _between(1e-6, 1e-4)),
    "spacing": ("", "", [LENGTH / next_fast_len(round(LENGTH / spacing)) for spacing in _between(1e-5, 1e-7)]),
    "angle": ("indenter", "angle", np.radians(np.linspace(5, 75, 20)).tolist()),
    "relaxation time": ("elastomer", "relaxation_time", _between(1e-4, 1e-2)),
}


def base(shape: str, speed: float = LOW_SPEED) -> Scene:
    """The set of Fig. 4 at a speed."""
    return Scene(SHAPES[shape], SOLID, Slide(speed=speed, load=LOAD), ROUGH)


def varied(study: str, value: float, hurst: float) -> tuple[Scene, int]:
    """A scene of Fig. 3, a cone, and the points over its length."""
    scene = replace(base("cone"), roughness=replace(ROUGH, hurst=hurst))
    part, name, _ = STUDIES[study]
    if not part:
        return scene, round(LENGTH / value)
    changed: Any = {part: replace(getattr(scene, part), **{name: value})}
    return replace(scene, **changed), POINTS


def contact(shape: str) -> Scene:
    """A contact of Fig. 1."""
    rough = replace(ROUGH, hurst=CONTACT_HURST[shape], seed=CONTACT_SEED[shape])
    return Scene(SHAPES[shape], SOLID, CONTACT, rough)


def lossy(exponent: float, relaxation_time: float) -> Scene:
    """The first point of Figs. 5 to 7, with a power law of loss, Eq. 24, over all frequencies of the profile."""
    solid = Fractional(
        modulus=SOLID.modulus,
        relaxation_time=relaxation_time,
        exponent=exponent,
        lowest_frequency=SPEEDS[0] / LENGTH,
        highest_frequency=SPEEDS[-1] * pi * POINTS / LENGTH,
        tolerance=1e-2,
    )
    return Scene(SHAPES["sphere"], solid, Slide(speed=SPEEDS[0], load=FORCES[0]), LOSS_ROUGH)


def rms_slope() -> float:
    """Rms slope of Fig. 4 by finite differences; waves of fixed amplitude have the same on every profile."""
    return draw(ROUGH, POINTS).rms_slope


def variable(scene: Scene, rms_slope: float) -> float:
    """Variable xi of a scene on a Kelvin solid, Eq. 18."""
    body, solid, motion = scene.indenter, scene.elastomer, scene.motion
    return equations.similarity_variable(
        motion.load,
        solid.modulus,
        solid.relaxation_time,
        motion.speed,
        rms_slope,
        body.mdr_coefficient,
        body.exponent,
    )


def regime(scene: Scene, rms_slope: float) -> Regime:
    """Ratios of a contact under a load; rms_slope : of its roughness."""
    body, relaxed = scene.indenter, elastic_contact(scene)
    profile, contact = (body.mdr_coefficient, body.exponent), (relaxed.radius, relaxed.depth)
    return Regime.of(profile, contact, scene.roughness.rms_height, LENGTH, rms_slope)


def holds(regime: Regime) -> bool:
    """Whether all conditions except small slopes hold; without small slopes the model itself still holds.

    With heights, slopes and loads times any number, friction of the model is times that number exactly.
    """
    return all(holds for name, holds in regime.flags.items() if name != "small slopes")


def grid(scene: Scene, speeds: Sequence[float], loads: Sequence[float], profiles: int = 1) -> Curve:
    """Contacts of a scene at the given speeds and loads on the given number of profiles."""
    return Curve(
        scene=scene,
        speeds=tuple(speeds),
        values=tuple(loads),
        levels={"MDR": {FINE: MDR(points=POINTS)}},
        draws={"MDR": profiles},
    )
