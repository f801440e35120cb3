"""The parameters of Popov et al., Sci. Rep. 4, 3750 (2014), and what stands for those it leaves open.

Given: the reference length, the set of Fig. 4, both contacts of Fig. 1, and the ranges of the studies of Fig. 3.
Not given: what is held while one parameter varies (here the set of Fig. 4), the speed of the studies, whether the
angle is that of the body or of its line (here of the body, mapped), and how values lie in a range (here
geometrically, angles evenly).
"""

from dataclasses import dataclass, replace
from math import radians

import numpy as np
from scipy.fft import next_fast_len

from mdr1d import equations
from scene import Cone, Fractional, Kelvin, Scene, SelfAffine, Slide, Sphere

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
# The waves that three dimensions resolve: the paper's own reach down to 4 micrometres.
SHORTEST = 5e-4
# Fig. 3 and Fig. 4: the load; slow enough that a viscous layer of a few pixels is remembered.
LOAD, LOW_SPEED = 10.0, 1e-3

# Figs. 5 to 7: as many speeds as in the experiment, in its range, on the sphere and the modulus of Fig. 4 with a
# loss that is a power of frequency; rougher at short waves: every force lies in the regime of the laws.
FORCES = tuple(float(f) for f in np.geomspace(2, 50, 10))
SPEEDS = tuple(float(v) for v in np.geomspace(5e-4, 0.58, 28))
LOSS_ROUGH = SelfAffine(hurst=0.2, rms_height=2e-5, longest=LENGTH)
LOSS_PROFILES = 24


@dataclass(frozen=True)
class Loss:
    """A rubber of Figs. 5 to 7, G = G_0 (1 + (i omega tau)^beta): the exponent beta and the time tau [s]."""

    exponent: float
    relaxation_time: float

    @property
    def symbols(self) -> str:
        """Exponent and time of the loss in Greek letters."""
        return f"β = {self.exponent:g}, τ = {self.relaxation_time:g} s"

    @property
    def suffix(self) -> str:
        """Ending of the names of files."""
        return f"-{self.exponent:g}-{self.relaxation_time:g}"


# With the time of Fig. 4 the modulus, which the paper takes for constant, grows with the speed on the scale of the
# contact too; with the shorter one it grows by less than a tenth there.
LOSSES = (
    Loss(0.1, SOLID.relaxation_time),
    Loss(0.1, 1e-14),
    Loss(0.5, SOLID.relaxation_time),
    Loss(0.5, 1e-5),
)


@dataclass(frozen=True)
class ParameterStudy:
    """One parameter varied, all others held: its name, unit, and values in SI units."""

    name: str
    unit: str
    values: tuple[float, ...]


def _pixels():
    """Twenty spacings from 1e-5 to 1e-7 m, moved by 2 % at most to where transforms over it are fast."""
    spacings = np.geomspace(1e-5, 1e-7, 20)
    return tuple(LENGTH / next_fast_len(round(LENGTH / spacing)) for spacing in spacings)


def _between(low, high):
    return tuple(float(value) for value in np.geomspace(low, high, 20))


STUDIES = (
    ParameterStudy("load", "N", _between(1e-1, 1e1)),
    ParameterStudy("modulus", "Pa", _between(1e5, 1e7)),
    ParameterStudy("rms height", "m", _between(1e-6, 1e-4)),
    ParameterStudy("spacing", "m", _pixels()),
    ParameterStudy("angle", "rad", tuple(radians(degrees) for degrees in np.linspace(5, 75, 20))),
    ParameterStudy("relaxation time", "s", _between(1e-4, 1e-2)),
)


def base(shape: str, speed: float = LOW_SPEED, load: float = LOAD) -> Scene:
    """The set of Fig. 4 at a speed."""
    return Scene(SHAPES[shape], SOLID, Slide(speed=speed, load=load), ROUGH)


def varied(study: ParameterStudy, value: float, hurst: float) -> tuple[Scene, int]:
    """A scene of Fig. 3, a cone, and the points over its length."""
    rough, points = replace(ROUGH, hurst=hurst), POINTS
    scene = replace(base("cone"), roughness=rough)
    match study.name:
        case "load":
            scene = replace(scene, motion=Slide(speed=LOW_SPEED, load=value))
        case "modulus":
            scene = replace(scene, elastomer=replace(SOLID, modulus=value))
        case "relaxation time":
            scene = replace(scene, elastomer=replace(SOLID, relaxation_time=value))
        case "angle":
            scene = replace(scene, indenter=Cone(angle=value))
        case "rms height":
            scene = replace(scene, roughness=replace(rough, rms_height=value))
        case "spacing":
            points = round(LENGTH / value)
    return scene, points


def contact(shape: str) -> Scene:
    """A contact of Fig. 1."""
    return Scene(SHAPES[shape], SOLID, CONTACT, contact_rough(shape))


def resolved(shape: str) -> Scene:
    """A contact of Fig. 1 with a shortest wave that both dimensionalities resolve."""
    return replace(contact(shape), roughness=replace(contact_rough(shape), shortest=SHORTEST))


def contact_rough(shape: str) -> SelfAffine:
    """The roughness of that contact."""
    return replace(ROUGH, hurst=CONTACT_HURST[shape], seed=CONTACT_SEED[shape])


def lossy(loss: Loss, load: float, speed: float) -> Scene:
    """A point of Figs. 5 to 7: loss G'' ~ omega^beta, Eq. 24, over all frequencies that the profile has."""
    lowest, highest = SPEEDS[0] / LENGTH, SPEEDS[-1] * np.pi * POINTS / LENGTH
    solid = Fractional(
        modulus=SOLID.modulus,
        relaxation_time=loss.relaxation_time,
        exponent=loss.exponent,
        lowest_frequency=lowest,
        highest_frequency=float(highest),
        tolerance=1e-2,
    )
    return Scene(SHAPES["sphere"], solid, Slide(speed=speed, load=load), LOSS_ROUGH)


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
