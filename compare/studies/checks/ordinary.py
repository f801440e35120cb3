"""The ordinary contact from which hard ones depart in one respect: a sphere that touches over a millimetre."""

from dataclasses import replace
from math import radians
from typing import Any

from scene import (
    Cone,
    Elastic,
    Indent,
    Kelvin,
    Program,
    Scene,
    SelfAffine,
    Slide,
    Sphere,
    Stage,
    StandardLinearSolid,
)
from scene.scales import elastic_contact

RADIUS, DEPTH, TIME, MODULUS = 1e-3, 1e-4, 1e-3, 1e6  # of contact at rest [m], [m], [s], shear [Pa]
PACE = RADIUS / TIME  # at which the memory of a Kelvin body is the contact's radius [m/s]
SPHERE, CONE = Sphere(RADIUS**2 / DEPTH), Cone(radians(10))
ELASTIC, KELVIN = Elastic(MODULUS), Kelvin(MODULUS, TIME)
STIFFENING = 10.0
SOLID = StandardLinearSolid(MODULUS, STIFFENING * MODULUS, TIME)
ROUGH = SelfAffine(hurst=0.5, rms_height=DEPTH / 10, longest=2 * RADIUS, shortest=RADIUS / 2, seed=1)
LOAD = elastic_contact(Scene(SPHERE, ELASTIC, Indent(depth=DEPTH))).load


def resting(**changed) -> Scene:
    """The contact at rest at its depth, with what is changed."""
    return replace(Scene(SPHERE, ELASTIC, Indent(depth=DEPTH)), **changed)


def sliding(speed: float, elastomer=SOLID, **changed) -> Scene:
    """The contact at its depth, sliding at a speed in units of PACE, with what is changed."""
    return resting(elastomer=elastomer, motion=Slide(speed=speed * PACE, depth=DEPTH), **changed)


def loaded(speed: float, elastomer=SOLID, **changed) -> Scene:
    """The contact under its load, sliding at a speed in units of PACE, with what is changed."""
    return resting(elastomer=elastomer, motion=Slide(speed=speed * PACE, load=LOAD), **changed)


def deep(body: Any, elastomer=ELASTIC, pace: float | None = None, **changed) -> Scene:
    """A body at the depth at which its contact at rest, of the 1D theory, has RADIUS: at rest or sliding."""
    depth = body.mdr_coefficient * RADIUS**body.exponent
    motion = Indent(depth=depth) if pace is None else Slide(speed=pace * PACE, depth=depth)
    return Scene(body, elastomer, motion, **changed)


def stage(duration: float, **values) -> Stage:
    """A stage of a program."""
    return Stage(duration=duration, **values)


def program(*stages: Stage, elastomer=SOLID, **changed) -> Scene:
    """The contact through stages, with what is changed."""
    return resting(elastomer=elastomer, motion=Program(stages=stages), **changed)


def family(kind: str, length: float = 1.0, modulus: float = 1.0, time: float = 1.0) -> Scene:
    """The contact in units of length, modulus and time over those of the ordinary one.

    kind : "at-rest", which is smooth, "sliding", or "program"
    """
    solid = StandardLinearSolid(MODULUS * modulus, STIFFENING * MODULUS * modulus, TIME * time)
    speed, depth, force = PACE * length / time, DEPTH * length, LOAD * length**2 * modulus
    seconds = TIME * time
    stages = stage(seconds, load=force), stage(2 * seconds, speed=speed / 8), stage(seconds, load=force / 10)
    motion: Any = {
        "at-rest": Indent(depth=depth),
        "sliding": Slide(speed=speed, depth=depth),
        "program": Program(stages=stages),
    }[kind]
    waves = {name: length * getattr(ROUGH, name) for name in ("rms_height", "longest", "shortest")}
    rough = None if kind == "at-rest" else replace(ROUGH, **waves)
    return Scene(Sphere(SPHERE.radius * length), solid, motion, rough)
