"""Closed forms of contacts at rest, of friction and of histories, and the order of convergence to them."""

from dataclasses import replace
from itertools import product
from math import pi
from typing import Any

import numpy as np

from scene import (
    Coulomb,
    CrossedWaves,
    Cylinder,
    Elastic,
    Indent,
    Plane,
    PowerLaw,
    Program,
    Scene,
    Shear,
    Slide,
    Topography,
    Wave,
)
from scene.scales import elastic_contact

from ...models.exact import (
    foundation,
    full_contact,
    indentation,
    line_contact,
    mean_lag,
    slow_friction_3d,
    tangential,
    waves,
)
from .law import (
    FORCES,
    FRICTION,
    GRID,
    LIMIT,
    LINE,
    RIM,
    SAME,
    SPACE,
    Answers,
    Misfit,
    Missing,
    apart,
    laws,
    on_shares,
    stated,
    worst,
)
from .ordinary import (
    CONE,
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
    deep,
    loaded,
    program,
    resting,
    stage,
)

ROUND: dict[str, Any] = {"sphere": SPHERE, "cone": CONE}
BODIES = ROUND | {f"r^{n:g}": PowerLaw(DEPTH / RADIUS**n, n) for n in (1.5, 3.0, 4.0)}
LOSSY: dict[str, Any] = {"kelvin": KELVIN, "standard-linear": SOLID}
AMPLITUDE, WAVELENGTH = 1e-5, 1e-3
WAVES: dict[str, Any] = {"amplitude": AMPLITUDE, "wavelength": WAVELENGTH}
CELL = WAVELENGTH**2
WAVE_CLOSURE = waves.wave_closure(ELASTIC.indentation_modulus, **WAVES)
CROSSED_CLOSURE = waves.crossed_closure(ELASTIC.indentation_modulus, **WAVES)
LINE_LOAD = LOAD / RADIUS
FEWEST = 7.5  # points across the contact, eight with rounding, from which on a grid shows an order
ROUNDED = 1e-12  # of an error: rounding alone
# Sizes of grids: points over those of the model. Of three grids the largest error counts: the rim of a contact
# moves by whole pixels, so that single errors scatter.
SHARES = 0.25, 0.3, 0.35, 0.7, 0.85, 1.0
SLOW = 1e-3  # v tau/a: friction departs from its limit by about as much
SLOW_ONES = ("sphere", "kelvin"), ("sphere", "standard-linear"), ("cone", "kelvin"), ("r^3", "kelvin")
RUBBING = Coulomb(coefficient=0.3)
STEPS = 200  # in time, of a program
PERIOD = stated(0.01, "10/n² of the grid at the 32 points a period that a model has at least")


def wavy(pressure: float, rough: Any, elastomer: Any = ELASTIC, speed: float = 0.0) -> Scene:
    """A rough plane under a mean pressure, at rest or sliding."""
    motion = Slide(speed=speed, pressure=pressure) if speed else Indent(pressure=pressure)
    return Scene(Plane(), elastomer, motion, rough)


def cell(heights: Any) -> Topography:
    """A map of heights [m] that repeats after WAVELENGTH."""
    given: Any = {"heights": np.ascontiguousarray(heights), "pixel": WAVELENGTH / len(heights)}
    return Topography(**given, repeat="periodic", peaks="down")


def away(name: str, value: float, scale: float = 1.0) -> Misfit:
    """Distance of a number from a known one, over a scale that stays where the number falls to 0."""
    return lambda answers: abs(answers[0][name] - value) / scale


# At rest.


@laws(GRID)
def galin_and_sneddon():
    """Body at rest on any solid: force at a depth, and depth under a load, of Galin and Sneddon."""
    for name, body in BODIES.items():
        scene = deep(body)
        load = elastic_contact(scene).load
        why = "steeper at its edge by the exponent"
        bound = GRID.wider(why, times=body.exponent if body.exponent > 2 else 1.0)
        yield f"{name}.force", scene, {"normal_force": load}, bound
        yield f"{name}.depth", replace(scene, motion=Indent(load=load)), {"depth": scene.motion.depth}, bound
    compressible = {f"elastic-at-nu-{nu:g}": Elastic(MODULUS, nu) for nu in (0.3, -0.999999)}
    for name, solid in (LOSSY | compressible).items():
        scene = resting(elastomer=solid)
        yield f"rest.{name}", scene, {"normal_force": elastic_contact(scene).load}


@laws(RIM.wider("twice, an area", times=2), SPACE)
def areas():
    """Body of revolution at rest: area of contact of Galin and Sneddon."""
    for name, body in ROUND.items():
        yield f"{name}.area", deep(body), {"contact_area": pi * RADIUS**2}


@laws(RIM, LINE)
def lengths():
    """Body of revolution at rest: length of contact of Galin and Sneddon."""
    for name, body in ROUND.items():
        yield f"{name}.length", deep(body), {"contact_length": 2 * RADIUS}


@laws(RIM, SPACE)
def on_waves():
    """Westergaard: mean gap of a wave, and what touches; of crossed waves a solution on 512 x 512 points."""
    for part in (0.2, 0.5, 0.8, 0.99, 0.9999, 1.0):
        scene, gap = wavy(part * WAVE_CLOSURE, Wave(**WAVES)), waves.wave_mean_gap(part)
        yield f"wave.gap.{part:g}", scene, away("depth", -gap * AMPLITUDE, AMPLITUDE), GRID
        yield f"wave.fraction.{part:g}", scene, away("contact_fraction", waves.wave_contact_fraction(part))
    for part in (0.3, 0.7):
        scene = wavy(part * CROSSED_CLOSURE, CrossedWaves(**WAVES))
        yield f"crossed.fraction.{part:g}", scene, away("contact_fraction", waves.CROSSED_FRACTIONS[part])


@laws(GRID, SPACE)
def hertz_on_a_line():
    """Cylinder at rest: depth and width of Hertz."""
    scene = Scene(Cylinder(SPHERE.radius), ELASTIC, Indent(line_load=LINE_LOAD))
    form = elastic_contact(scene)
    yield "line.depth", scene, {"depth": form.depth}
    yield "line.width", scene, {"contact_area": 2 * form.radius}, RIM.wider("twice, two edges", times=2)


@laws(stated(0.5, "a half: of first order in the pixel"), group=LIMIT, models=on_shares(*SHARES))
def orders():
    """Error of the force on three grids over that on three with half the points."""
    for name in ("sphere", "cone", "r^4"):
        scene = deep(BODIES[name])
        yield f"order.{name}", (scene,) * len(SHARES), _falling(elastic_contact(scene).load)


def _falling(load: float) -> Misfit:
    def misfit(answers: Answers) -> float:
        if answers[0].across < FEWEST:
            raise Missing("a quarter of the points are too few across the contact: no order yet")
        errors = [apart(answer["normal_force"], load) for answer in answers]
        coarse, fine = worst(errors[:3]), worst(errors[3:])
        return fine / coarse if fine > ROUNDED else 0.0

    return misfit


# In motion.


@laws(FRICTION.wider("0.01, ten v tau/a, by which friction departs from its limit", more=10 * SLOW))
def slow():
    """Slow body on a viscoelastic solid: friction is v tau E* int g'^2 dx, and twice as high in 1D."""
    for name, solid in SLOW_ONES:
        scene = deep(BODIES[name], LOSSY[solid], SLOW * TIME / mean_lag(LOSSY[solid]))
        yield f"slow.{name}.{solid}", scene, slow_friction(scene)


def slow_friction(scene: Scene) -> Misfit:
    """Deviation of friction from the limit of low speed of a contact of RADIUS, twice as high in 1D."""
    body, solid = scene.indenter, scene.solid
    lag, shape = mean_lag(solid), (body.mdr_coefficient, body.exponent)
    force = slow_friction_3d(scene.motion.speed, RADIUS, lag, solid.indentation_modulus, *shape)

    def misfit(answers):
        return apart(answers[0]["friction_force"], force * (2 if answers[0].dimension == "1D" else 1))

    return misfit


@laws(FRICTION, SPACE)
def hunter():
    """Cylinder sliding on a standard linear solid: friction of Hunter."""
    soft = SOLID.indentation_modulus
    for pace in (1e-6, 0.1, 1.0, 10.0, 1000.0):
        speed = pace * PACE
        scene = Scene(Cylinder(SPHERE.radius), SOLID, Slide(speed=speed, line_load=LINE_LOAD))
        form = line_contact.sliding(SPHERE.radius, soft, STIFFENING * soft, STIFFENING * TIME, speed, LINE_LOAD)
        yield f"line.hunter.{pace:g}", scene, {"friction_coefficient": form.friction_coefficient}


@laws(FRICTION, LINE)
def on_foundation():
    """Sphere or cone sliding on a viscoelastic foundation: both forces."""
    for solid, shape, pace in product(LOSSY, ROUND, (0.1, 1.0, 10.0)):
        yield f"foundation.{solid}.{shape}.{pace:g}", *founded(ROUND[shape], LOSSY[solid], pace)


def founded(body: Any, elastomer: Any, pace: float) -> tuple[Scene, dict[str, Any]]:
    """A body that slides on a foundation, and both forces."""
    scene = deep(body, elastomer, pace)
    forces = foundation.sliding_forces(body, elastomer, pace * PACE, scene.motion.greatest)
    return scene, dict(zip(FORCES, forces, strict=True))


@laws(PERIOD, SPACE)
def in_full_contact():
    """Wavy plane that touches everywhere: friction is the loss of the wave."""
    one, crossed = (Wave, full_contact.wave_friction), (CrossedWaves, full_contact.crossed_friction)
    for (kind, friction), pace in ((one, 0.01), (one, 0.1), (one, 1.0), (crossed, 0.1)):
        moved: dict[str, Any] = WAVES | {"elastomer": SOLID, "speed": pace * PACE}
        scene = wavy(3 * full_contact.crossed_closure(**moved), kind(**WAVES), SOLID, pace * PACE)
        yield f"full.{kind.__name__.lower()}.{pace:g}", scene, {"friction_force": friction(**moved) * CELL}


@laws(SAME)
def of_interface():
    """Friction of the interface: of Coulomb in sliding, of Cattaneo and Mindlin before it."""
    mu = RUBBING.coefficient
    yield "coulomb", loaded(1.0, ELASTIC, interface=RUBBING), {"friction_coefficient": mu}, FRICTION

    def added(answers):
        both, one = (answer["friction_coefficient"] for answer in answers)
        return apart(both - one, mu)

    yield "coulomb.added", (loaded(1.0, KELVIN, interface=RUBBING), loaded(1.0, KELVIN)), added
    bound = GRID.wider("twice, two contacts, one less the other", times=2)
    compressible = resting(elastomer=Elastic(MODULUS, 0.0), interface=RUBBING)
    for part in (0.2, 0.5, 0.9):
        drawn = part * tangential.full_slip_displacement(mu, DEPTH, 0.0)
        scene = replace(compressible, motion=Shear(depth=DEPTH, displacement=drawn))
        pulled = {"friction_coefficient": tangential.force(part, SPHERE.exponent) * mu}
        yield f"mindlin.sphere.{part:g}", scene, pulled, bound


@laws(GRID.wider(f"{4 / STEPS:g}, of first order in {STEPS} steps, twice, as force falls fast", more=4 / STEPS))
def at_depth():
    """Pressed to a depth, held and withdrawn: force of Lee and Radok, and of Ting."""
    press, hold, lift = (TIME, DEPTH), (TIME, DEPTH), (0.2 * TIME, 0.9 * DEPTH)
    paths = {"loading": [press], "held": [press, hold], "withdrawn": [press, lift]}
    for (name, path), shape in product(paths.items(), ROUND):
        yield f"history.{name}.{shape}", *pressed(ROUND[shape], SOLID, *path)


def pressed(body: Any, solid: Any, *path: tuple[float, float]) -> tuple[Scene, dict[str, Any]]:
    """A body that is pressed through stages of a duration and a depth, and the force in the end."""
    durations, depths = zip((0.0, 0.0), *path, strict=True)
    times = np.cumsum(durations)
    (force,), _ = indentation.force_of_depth(body, solid, times, depths, times[-1])
    stages = tuple(stage(duration, depth=depth) for duration, depth in path)
    return Scene(body, solid, Program(stages=stages)), {"normal_force": force}


@laws(GRID.wider(f"{2 / STEPS:g}, of first order in {STEPS} steps", more=2 / STEPS))
def under_load():
    """A load that is held: depth of Lee and Radok."""
    times, loads = (0.0, TIME, 2 * TIME), (0.0, LOAD, LOAD)
    (depth,) = indentation.loading_depth(SPHERE, SOLID, times, loads, 2 * TIME)
    yield "history.creep", program(stage(TIME, load=LOAD), stage(TIME)), {"depth": depth}
