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


def at_paces(*paces: float, elastomer=SOLID, **changed) -> dict[str, Scene]:
    """The contact sliding at several speeds, by name."""
    return {f"v tau/a = {pace:g}": sliding(pace, elastomer, **changed) for pace in paces}


def to_radius(indenter, elastomer, pace: float) -> Scene:
    """Another indenter sliding at the depth at which its contact at rest, of the 1D theory, has RADIUS."""
    depth = indenter.mdr_coefficient * RADIUS**indenter.exponent
    return Scene(indenter, elastomer, Slide(speed=pace * PACE, depth=depth))


def stage(duration: float, **values) -> Stage:
    """A stage of a program."""
    return Stage(duration=duration, **values)


def program(*stages: Stage, elastomer=SOLID, **changed) -> Scene:
    """The contact through stages, with what is changed."""
    return resting(elastomer=elastomer, motion=Program(stages=stages), **changed)


def moved(scene: Scene, **motion) -> Scene:
    """A scene with some values of its motion replaced."""
    return replace(scene, motion=replace(scene.motion, **motion))


def family(kind: str, length: float = 1.0, modulus: float = 1.0, time: float = 1.0) -> Scene:
    """The contact in units of length, modulus and time over those of the ordinary one.

    kind : "at rest", "sliding", under a "load", or a "program"; of a "rough" body where that word is among them
    """
    solid = StandardLinearSolid(MODULUS * modulus, STIFFENING * MODULUS * modulus, TIME * time)
    waves = {name: length * getattr(ROUGH, name) for name in ("rms_height", "longest", "shortest")}
    speed, depth, force = PACE * length / time, DEPTH * length, LOAD * length**2 * modulus
    motion: Any = Slide(speed=speed, depth=depth)
    if "rest" in kind:
        motion = Indent(depth=depth)
    elif "load" in kind:
        motion = Slide(speed=speed, load=force)
    elif "program" in kind:
        away = stage(2 * TIME * time, speed=speed / 8)
        motion = Program(stages=(stage(TIME * time, load=force), away, stage(TIME * time, load=force / 10)))
    rough = replace(ROUGH, **waves) if "rough" in kind else None
    return Scene(Sphere(SPHERE.radius * length), solid, motion, rough)
