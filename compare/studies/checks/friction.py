"""Closed forms of friction, and of histories in time."""

from collections.abc import Iterator
from dataclasses import replace
from math import pi
from typing import Any

import numpy as np

from scene import Coulomb, CrossedWaves, Cylinder, Elastic, Scene, Shear, Slide, Wave
from scene.scales import elastic_contact

from ...models.exact import (
    foundation,
    full_contact,
    indentation,
    line_contact,
    mean_lag,
    slow_friction_3d,
    tangential,
)
from .closed_forms import AMPLITUDE, BODIES, ROUND, SOLIDS, WAVELENGTH, WAVES, cell, deep, wavy
from .law import (
    CLOSED,
    FORCES,
    FRICTION,
    GRID,
    LINE,
    SAME,
    SPACE,
    Answers,
    Law,
    Misfit,
    apart,
    exact,
    slug,
    stated,
)
from .ordinary import (
    DEPTH,
    ELASTIC,
    KELVIN,
    LOAD,
    MODULUS,
    PACE,
    RADIUS,
    SOLID,
    SPHERE,
    STIFFENING,
    TIME,
    program,
    resting,
    stage,
    to_radius,
)

SLOW = 1e-3  # v tau/a: friction departs from its limit by about as much
SLOW_ONES = ("sphere", "Kelvin"), ("sphere", "standard linear"), ("cone", "Kelvin"), ("r^3", "Kelvin")
COEFFICIENT = 0.3
STEPS = 200  # in time, of a program
# Most relative changes of force or depth in the last step, over a step's share of the program.
FIRST, FASTEST = 2.0, 4.0


def laws() -> Iterator[Law]:
    """All of them."""
    for each in (slow, on_lines, on_foundation, in_full_contact, of_interface, at_depth, under_load):
        yield from each()


def slow() -> Iterator[Law]:
    """Friction of slow bodies: to first order in the speed, and exactly twice as high in one dimension."""
    for name, solid in SLOW_ONES:
        body, elastomer = BODIES[name], SOLIDS[solid]
        lag, modulus = mean_lag(elastomer), elastomer.indentation_modulus
        speed = SLOW * RADIUS / lag
        scene = Scene(body, elastomer, Slide(speed=speed, load=elastic_contact(deep(body, elastomer)).load))
        force = slow_friction_3d(speed, RADIUS, lag, modulus, body.mdr_coefficient, body.exponent)
        bound = FRICTION.and_(10 * SLOW, "ten v tau/a, by which friction departs from its limit")
        said = f"Slow {name} on a {solid} solid: friction is v tau E* int g'^2 dx, and twice as high in 1D"
        misfit = _twice_in_1d(force)
        yield Law(f"slow.{name}.{slug(solid)}", CLOSED, said, (scene,), misfit, bound)


def _twice_in_1d(force: float) -> Misfit:
    def misfit(answers: Answers) -> float:
        known = force * (2 if answers[0].dimension == "1D" else 1)
        return apart(answers[0]["friction_force"], known)

    return misfit


def on_lines() -> Iterator[Law]:
    """A sliding cylinder: Hunter."""
    soft, line_load = SOLID.indentation_modulus, LOAD / RADIUS
    for pace in (1e-6, 0.1, 1.0, 10.0, 1000.0):
        speed = pace * PACE
        scene = Scene(Cylinder(SPHERE.radius), SOLID, Slide(speed=speed, line_load=line_load))
        form = line_contact.sliding(SPHERE.radius, soft, STIFFENING * soft, STIFFENING * TIME, speed, line_load)
        said = f"Cylinder sliding on a standard linear solid at v tau/a = {pace:g}: friction of Hunter"
        mu = form.friction_coefficient
        yield exact(f"line.hunter.{pace:g}", said, scene, FRICTION, SPACE, friction_coefficient=mu)


def on_foundation() -> Iterator[Law]:
    """Sphere and cone sliding on a foundation in one dimension."""
    for solid in ("Kelvin", "standard linear"):
        for shape in ROUND:
            for pace in (0.1, 1.0, 10.0):
                scene, numbers = founded(BODIES[shape], SOLIDS[solid], pace)
                id = f"foundation.{slug(solid)}.{shape}.{pace:g}"
                said = f"{shape.capitalize()} sliding on a {solid} foundation at v tau/a = {pace:g}: both forces"
                yield exact(id, said, scene, FRICTION, LINE, **numbers)


def founded(body: Any, elastomer: Any, pace: float) -> tuple[Scene, dict[str, Any]]:
    """A body that slides on a foundation, and both forces."""
    scene = to_radius(body, elastomer, pace)
    forces = foundation.sliding_forces(body, elastomer, pace * PACE, scene.motion.greatest)
    return scene, dict(zip(FORCES, forces, strict=True))


def in_full_contact() -> Iterator[Law]:
    """Rough planes that touch everywhere: every wave by itself, and three waves by their sum."""
    kinds: dict[str, tuple] = {
        "wave": (Wave, full_contact.wave_friction, (0.01, 0.1, 1.0)),
        "crossed": (CrossedWaves, full_contact.crossed_friction, (0.1,)),
    }
    bound = stated(0.01, "10/n² of the grid at the 32 points a period that a model has at least")
    for name, (kind, friction, paces) in kinds.items():
        for pace in paces:
            moved: dict[str, Any] = WAVES | {"elastomer": SOLID, "speed": pace * PACE}
            scene = wavy(3 * full_contact.crossed_closure(**moved), kind(**WAVES), SOLID, pace * PACE)
            said = f"{name.capitalize()} in full contact at v tau/mm = {pace:g}: friction by its loss"
            force = friction(**moved) * WAVELENGTH**2
            yield exact(f"full.{name}.{pace:g}", said, scene, bound, SPACE, friction_force=force)
    along = 2 * pi * np.arange(32) / 32
    waves = [np.cos((k + 1) * along + turn * along[:, None]) / (k + 1) for k, turn in enumerate((0, 2, 3))]
    heights = AMPLITUDE * np.sum(waves, axis=0)
    pressure = 10 * full_contact.crossed_closure(AMPLITUDE, WAVELENGTH, SOLID, PACE)
    force = full_contact.friction(heights, (WAVELENGTH, WAVELENGTH), SOLID, PACE) * WAVELENGTH**2
    scene, said = wavy(pressure, cell(heights), SOLID, PACE), "Three waves in full contact: friction is their sum"
    yield exact("full.superposition", said, scene, bound, SPACE, friction_force=force)

    def open_(answers):
        return abs(answers[0]["depth"]) / AMPLITUDE

    bound, said = stated(1e-3, "a thousandth of the amplitude"), "In full contact the mean gap is nothing"
    yield Law("full.gap", CLOSED, said, (scene,), open_, bound, SPACE, drawn=True)


def of_interface() -> Iterator[Law]:
    """Friction of the interface: Coulomb in sliding, Cattaneo and Mindlin before it."""
    rubbing, rigid = Coulomb(coefficient=COEFFICIENT), Elastic(MODULUS, 0.0)
    scene = Scene(SPHERE, ELASTIC, Slide(speed=PACE, load=LOAD), interface=rubbing)
    said = "Sliding on an elastic solid: friction of Coulomb"
    yield exact("coulomb", said, scene, FRICTION, friction_coefficient=COEFFICIENT)
    lossy = replace(scene, elastomer=KELVIN)

    def added(answers):
        both, one = (answer["friction_coefficient"] for answer in answers)
        return apart(both - one, COEFFICIENT)

    pair, said = (lossy, replace(lossy, interface=None)), "Coulomb friction adds to that of the elastomer"
    yield Law("coulomb.added", CLOSED, said, pair, added, SAME)
    for name, body, parts in (("sphere", SPHERE, (0.2, 0.5, 0.9)), ("cone", BODIES["cone"], (0.5,))):
        still = deep(body, rigid, interface=rubbing)
        depth = still.motion.greatest
        whole = tangential.full_slip_displacement(COEFFICIENT, depth, rigid.poisson_ratio)
        for part in parts:
            mu = float(tangential.force(part, body.exponent)) * COEFFICIENT
            scene = replace(still, motion=Shear(depth=depth, displacement=part * whole))
            said = f"{name.capitalize()} drawn by {part:g} of what makes all slip: force of Cattaneo and Mindlin"
            bound = GRID.times(2, "two contacts, one less the other")
            yield exact(f"mindlin.{name}.{part:g}", said, scene, bound, friction_coefficient=mu)


def at_depth() -> Iterator[Law]:
    """Pressed to a depth, held and withdrawn: Lee and Radok, and Ting."""
    press, hold, lift = stage(TIME, depth=DEPTH), stage(TIME), stage(0.2 * TIME, depth=0.9 * DEPTH)
    paths: dict[str, tuple[Any, tuple, tuple]] = {
        "loading": ((press,), (0.0, TIME), (0.0, DEPTH)),
        "held": ((press, hold), (0.0, TIME, 2 * TIME), (0.0, DEPTH, DEPTH)),
        "withdrawn": ((press, lift), (0.0, TIME, 1.2 * TIME), (0.0, DEPTH, 0.9 * DEPTH)),
    }
    for name, (stages, times, depths) in paths.items():
        for shape in ROUND:
            (force,), _ = indentation.force_of_depth(BODIES[shape], SOLID, times, depths, times[-1])
            scene = program(*stages, indenter=BODIES[shape])
            said = f"{shape.capitalize()} {name}: force of {'Ting' if name == 'withdrawn' else 'Lee and Radok'}"
            bound = GRID.and_(FASTEST / STEPS, f"of first order in {STEPS} steps, twice, as force falls fast")
            yield exact(f"history.{name}.{shape}", said, scene, bound, normal_force=float(force))


def under_load() -> Iterator[Law]:
    """A load that is held: creep; and a history of what remembers nothing."""
    bound = GRID.and_(FIRST / STEPS, f"of first order in {STEPS} steps")
    scene = program(stage(TIME, load=LOAD), stage(TIME))
    times, loads = (0.0, TIME, 2 * TIME), (0.0, LOAD, LOAD)
    (depth,) = indentation.loading_depth(SPHERE, SOLID, times, loads, 2 * TIME)
    said = "Sphere under a load that is held: depth of Lee and Radok"
    yield exact("history.creep", said, scene, bound, depth=float(depth))
    scene, said = program(stage(TIME, depth=DEPTH), elastomer=ELASTIC), "An elastic history ends as at rest"
    yield exact("history.elastic", said, scene, bound, normal_force=elastic_contact(resting()).load)
