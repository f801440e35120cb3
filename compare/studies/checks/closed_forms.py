"""Closed forms of contacts at rest, and the order at which a model converges to them."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from math import pi
from typing import Any

import numpy as np

from scene import CrossedWaves, Cylinder, Elastic, Indent, Layer, Plane, PowerLaw, Scene, Slide, Topography, Wave
from scene.scales import elastic_contact

from ...models.exact import layer, waves
from .law import (
    BOTH,
    CLOSED,
    GRID,
    LIMIT,
    LINE,
    RIM,
    SPACE,
    Answers,
    Bound,
    Law,
    Missing,
    apart,
    exact,
    on_shares,
    slug,
    stated,
    worst,
)
from .ordinary import CONE, DEPTH, ELASTIC, KELVIN, LOAD, MODULUS, RADIUS, SOLID, SPHERE, resting

BODIES: dict[str, Any] = {"sphere": SPHERE, "cone": CONE} | {
    f"r^{n:g}": PowerLaw(DEPTH / RADIUS**n, n) for n in (1.5, 3.0, 4.0)
}
ROUND = "sphere", "cone"
SOLIDS: dict[str, Any] = {
    "elastic": ELASTIC,
    "elastic at nu = 0.3": Elastic(MODULUS, 0.3),
    "Kelvin": KELVIN,
    "standard linear": SOLID,
}
AMPLITUDE, WAVELENGTH = 1e-5, 1e-3
WAVES: dict[str, Any] = {"amplitude": AMPLITUDE, "wavelength": WAVELENGTH}
WAVE_CLOSURE = waves.wave_closure(ELASTIC.indentation_modulus, **WAVES)
CROSSED_CLOSURE = waves.crossed_closure(ELASTIC.indentation_modulus, **WAVES)
FEWEST = 7.5  # points across the contact, eight with rounding, from which on a grid shows an order
ROUNDED = 1e-12  # of an error: rounding alone
# Sizes of grids: points over those of the model. Of three grids the largest error counts: the rim of a contact
# moves by whole pixels, so that single errors scatter.
SHARES = 0.25, 0.3, 0.35, 0.7, 0.85, 1.0


def deep(body: Any, elastomer: Any = ELASTIC, **changed: Any) -> Scene:
    """A body at rest at the depth at which its contact has RADIUS."""
    depth = body.mdr_coefficient * RADIUS**body.exponent
    return Scene(body, elastomer, Indent(depth=depth), **changed)


def wavy(pressure: float, rough: Any, elastomer: Any = ELASTIC, speed: float = 0.0) -> Scene:
    """A rough plane under a mean pressure, at rest or sliding."""
    motion = Slide(speed=speed, pressure=pressure) if speed else Indent(pressure=pressure)
    return Scene(Plane(), elastomer, motion, rough)


def cell(heights: Any) -> Topography:
    """A map of heights [m] that repeats after WAVELENGTH."""
    given: Any = {"heights": np.ascontiguousarray(heights), "pixel": WAVELENGTH / len(heights)}
    return Topography(**given, repeat="periodic", peaks="down")


def laws() -> Iterator[Law]:
    """All of them."""
    for each in (of_revolution, on_layers, on_waves, on_lines, orders):
        yield from each()


def of_revolution() -> Iterator[Law]:
    """Galin and Sneddon: force at a depth, depth under a load, and what touches."""
    for name, body in BODIES.items():
        scene = deep(body)
        form = elastic_contact(scene)
        loaded = replace(scene, motion=Indent(load=form.load))
        bound = GRID if body.exponent <= 2 else GRID.times(body.exponent, "steeper at its edge")
        rows: list[tuple[str, str, Scene, Bound, tuple[str, ...], dict[str, Any]]] = [
            ("force", "force at a depth", scene, bound, BOTH, {"normal_force": form.load}),
            ("depth", "depth under a load", loaded, bound, BOTH, {"depth": form.depth}),
        ]
        if name in ROUND:
            area, length = {"contact_area": pi * form.radius**2}, {"contact_length": 2 * form.radius}
            rows += [
                ("area", "area of contact", scene, RIM.times(2, "an area"), SPACE, area),
                ("length", "length of contact", scene, RIM, LINE, length),
            ]
        for id, what, asked, allowed, kinds, numbers in rows:
            yield exact(f"{name}.{id}", f"{name}: {what} of Galin and Sneddon", asked, allowed, kinds, **numbers)
    for name, solid in SOLIDS.items():
        if solid is not ELASTIC:
            scene, said = resting(elastomer=solid), f"Force at rest by the modulus at rest: {name}"
            yield exact(f"rest.{slug(name)}", said, scene, GRID, normal_force=elastic_contact(scene).load)


def on_layers() -> Iterator[Law]:
    """A sphere on an elastic layer of its own thickness, thicker and thinner."""
    bases: tuple[Any, ...] = "bonded", "frictionless"
    for base in bases:
        for ratio in (0.3, 1.0, 3.0):
            under = Layer(thickness=RADIUS / ratio, base=base)
            form = layer.of_radius(SPHERE, under, ELASTIC.indentation_modulus, ELASTIC.poisson_ratio, RADIUS)
            scene = resting(layer=under, motion=Indent(depth=form.depth))
            said = f"Sphere on a {base} layer, radius over thickness {ratio:g}: force of Lebedev and Ufliand"
            bound = GRID.times(1 + ratio, "steeper at its edge as the layer is thinner")
            yield exact(f"layer.{base}.{ratio:g}", said, scene, bound, SPACE, normal_force=form.load)


def on_waves() -> Iterator[Law]:
    """Westergaard: mean gap of one wave, and what touches; of crossed waves a solution on a fine grid."""
    for part in (0.2, 0.5, 0.8):
        scene, said = wavy(part * WAVE_CLOSURE, Wave(**WAVES)), f"One wave at p/p* = {part:g}: {{}} of Westergaard"
        gap, fraction = waves.wave_mean_gap(part) * AMPLITUDE, float(waves.wave_contact_fraction(part))
        yield _away(f"wave.gap.{part:g}", said.format("mean gap"), scene, GRID, "depth", -float(gap), AMPLITUDE)
        words = said.format("fraction in contact")
        yield _away(f"wave.fraction.{part:g}", words, scene, RIM, "contact_fraction", fraction)
    for part in (0.3, 0.7):
        scene, fraction = wavy(part * CROSSED_CLOSURE, CrossedWaves(**WAVES)), waves.CROSSED_FRACTIONS[part]
        said = f"Crossed waves at p/p* = {part:g}: fraction in contact on 512 x 512 points"
        yield _away(f"crossed.fraction.{part:g}", said, scene, RIM, "contact_fraction", fraction)


def _away(id, said, scene, bound, name, value, scale=1.0) -> Law:
    """Law on the difference of a number from a known one, over a scale that stays where the number falls to 0."""

    def misfit(answers: Answers) -> float:
        return abs(answers[0][name] - value) / scale

    return Law(id, CLOSED, said, (scene,), misfit, bound, SPACE, drawn=True)


def on_lines() -> Iterator[Law]:
    """A cylinder: Hertz."""
    scene = Scene(Cylinder(SPHERE.radius), ELASTIC, Indent(line_load=LOAD / RADIUS))
    form, wide = elastic_contact(scene), RIM.times(2, "two edges")
    yield exact("line.depth", "Cylinder: depth of Hertz", scene, GRID, SPACE, depth=form.depth)
    yield exact("line.width", "Cylinder: width of Hertz", scene, wide, SPACE, contact_area=2 * form.radius)


def orders() -> Iterator[Law]:
    """The error of the force falls with the pixel, to first order at least."""
    for name in ("sphere", "cone", "r^4"):
        scene = deep(BODIES[name])
        bound = stated(0.5, "a half: of first order in the pixel")
        said = f"{name}: error of the force on three grids over that on three with half the points"
        scenes, misfit = (scene,) * len(SHARES), _falling(elastic_contact(scene).load)
        yield Law(f"order.{name}", LIMIT, said, scenes, misfit, bound, models=on_shares(*SHARES))


def _falling(load: float) -> Callable[[Answers], float]:
    def misfit(answers: Answers) -> float:
        if answers[0].across < FEWEST:
            raise Missing(f"a quarter of the points are {answers[0].across:.3g} across the contact: no order yet")
        errors = [apart(answer["normal_force"], load) for answer in answers]
        coarse, fine = worst(errors[:3]), worst(errors[3:])
        return fine / coarse if fine > ROUNDED else 0.0

    return misfit
