"""Contacts that the diagrams are made of, and what the sizes mean."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import radians
from typing import TypeVar

from scene import Cone, Indent, Kelvin, Program, Scene, Slide, Sphere, Stage, StandardLinearSolid

from ..claims import contacts

# quick: few contacts on short ladders; standard: all contacts on short ladders; full: all on long ladders.
SIZES = QUICK, STANDARD, FULL = "quick", "standard", "full"
# Radius [m] of the contacts at rest, and the time [s] in which the solids relax.
CONTACT, TIME = 1e-3, 1e-3
SPHERE, CONE = Sphere(radius=10e-3), Cone(angle=radians(5))
KELVIN = Kelvin(modulus=1e6, relaxation_time=TIME)
STANDARD_LINEAR = StandardLinearSolid(rubbery_modulus=1e6, glassy_modulus=1e7, relaxation_time=TIME)
# Its surface is the same on every grid, as its shortest wave is stated.
ROUGH = contacts.kelvin("sphere", seed=1)

Values = TypeVar("Values")


def at(values: Mapping[str, Values], size: str) -> Values:
    """Settings of a size: those of "full", or those of "quick" for both smaller sizes."""
    return values[FULL if size == FULL else QUICK]


def some(values: Mapping[str, Sequence], size: str) -> Sequence:
    """Contacts of a size: those of "quick", or those of "full" for both larger sizes."""
    return values[QUICK if size == QUICK else FULL]


def depth(shape) -> float:
    """Depth at which the contact at rest has the radius CONTACT [m]."""
    return shape.mdr_coefficient * CONTACT**shape.exponent


def pressed(shape) -> Scene:
    """A body at rest, at that depth."""
    return Scene(shape, KELVIN, Indent(depth=depth(shape)))


def slid(shape, solid, flow: float) -> Scene:
    """A body sliding at that depth; flow : v tau / a of the speed, the relaxation time and the contact at rest"""
    return Scene(shape, solid, Slide(speed=flow * CONTACT / TIME, depth=depth(shape)))


def withdrawal(pressed: float, back: float) -> tuple[Scene, tuple[float, ...], tuple[float, ...]]:
    """The sphere pressed in to that depth in a time [s], and drawn back as fast for a shorter one.

    With the times [s] of its corners and their depths [m].
    """
    depths = 0.0, depth(SPHERE), depth(SPHERE) * (1 - back / pressed)
    stages = Stage(duration=pressed, depth=depths[1]), Stage(duration=back, depth=depths[2])
    return Scene(SPHERE, STANDARD_LINEAR, Program(stages=stages)), (0.0, pressed, pressed + back), depths


def rough(speed: float, load: float = 1.0) -> Scene:
    """The rough sphere under a load [N], at rest or sliding at a speed [m/s]."""
    motion = Slide(speed=speed, load=load) if speed else Indent(load=load)
    return replace(ROUGH, motion=motion)


def powers(first: int, last: int, base: int = 2) -> tuple[int, ...]:
    """first, base * first, ... up to last."""
    found = [first]
    while base * found[-1] <= last:
        found.append(base * found[-1])
    return tuple(found)
