"""The ordinary contact from which hard ones depart in one respect: a sphere that touches over a millimetre."""

from dataclasses import replace
from math import radians

from bem3d import BEM
from mdr1d import MDR
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

from .hardcase import Size

RADIUS, DEPTH, TIME, MODULUS = 1e-3, 1e-4, 1e-3, 1e6  # of contact at rest [m], [m], [s], shear [Pa]
PACE = RADIUS / TIME  # at which the memory of a Kelvin body is the contact's radius [m/s]
SPHERE, CONE = Sphere(RADIUS**2 / DEPTH), Cone(radians(10))
ELASTIC, KELVIN = Elastic(MODULUS), Kelvin(MODULUS, TIME)
STIFFENING = 10.0
SOLID = StandardLinearSolid(MODULUS, STIFFENING * MODULUS, TIME)
ROUGH = SelfAffine(hurst=0.5, rms_height=DEPTH / 10, longest=2 * RADIUS, shortest=RADIUS / 2, seed=1)
LOAD = elastic_contact(Scene(SPHERE, ELASTIC, Indent(depth=DEPTH))).load
TOLERANCE = 1e-7  # of contact in three dimensions, where a law is finer than its default


def resting(**changed) -> Scene:
    """The contact at rest at its depth, with what is changed."""
    return replace(Scene(SPHERE, ELASTIC, Indent(depth=DEPTH)), **changed)


def sliding(speed: float, elastomer=SOLID, **changed) -> Scene:
    """The contact at its depth, sliding at a speed in units of PACE, with what is changed."""
    return resting(elastomer=elastomer, motion=Slide(speed=speed * PACE, depth=DEPTH), **changed)


def program(*stages, elastomer=SOLID, **changed) -> Scene:
    """The contact through stages, each given by the values of a Stage, with what is changed."""
    motion = Program(stages=tuple(Stage(**stage) for stage in stages))
    return resting(elastomer=elastomer, motion=motion, **changed)


def stage(duration, **values) -> dict[str, float]:
    """Values of a Stage, for `program`."""
    return {"duration": duration, **values}


def moved(scene: Scene, **motion) -> Scene:
    """A scene with some values of its motion replaced."""
    return replace(scene, motion=replace(scene.motion, **motion))


def line(size: Size, **settings) -> MDR:
    """The one-dimensional solver."""
    return MDR(**{"points": size.line} | settings)


def space(size: Size, **settings) -> BEM:
    """The three-dimensional solver, around the ordinary contact."""
    return BEM(**{"points": size.square, "extent": 3.2 * RADIUS, "tolerance": TOLERANCE} | settings)


def dense(size: Size, **settings) -> BEM:
    """The three-dimensional solver on a grid whose conditions can be computed anew."""
    return space(size, **{"points": size.dense} | settings)
