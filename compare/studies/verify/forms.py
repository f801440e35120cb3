"""Closed forms of contacts at rest: bodies of revolution, layers, waves and lines."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from math import pi
from typing import Any

import numpy as np

from scene import CrossedWaves, Cylinder, Elastic, Indent, Layer, Plane, PowerLaw, Scene, Slide, Topography, Wave
from scene.scales import elastic_contact

from ...models.exact import layer, waves
from ..stability.cases.ordinary import (
    CONE,
    DEPTH,
    ELASTIC,
    KELVIN,
    LOAD,
    MODULUS,
    RADIUS,
    SOLID,
    SPHERE,
    resting,
)
from .law import GRID, LINE, RIM, SPACE, Answers, Law, exact, slug

REST = "closed forms"
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
    for each in (of_revolution, on_layers, on_waves, on_lines):
        yield from each()


def of_revolution() -> Iterator[Law]:
    """Galin and Sneddon: force at a depth, depth under a load, and what touches."""
    for name, body in BODIES.items():
        scene = deep(body)
        form = elastic_contact(scene)
        bound = GRID if body.exponent <= 2 else GRID.times(body.exponent, "steeper at its edge")
        said = f"{name}: {{}} of Galin and Sneddon"
        loaded = replace(scene, motion=Indent(load=form.load))
        force, depth = said.format("force at a depth"), said.format("depth under a load")
        yield exact(f"{name}.force", REST, force, scene, bound, normal_force=form.load)
        yield exact(f"{name}.depth", REST, depth, loaded, bound, depth=form.depth)
        if name in ROUND:
            area, length = said.format("area of contact"), said.format("length of contact")
            wide = RIM.times(2, "an area")
            yield exact(f"{name}.area", REST, area, scene, wide, SPACE, contact_area=pi * form.radius**2)
            yield exact(f"{name}.length", REST, length, scene, RIM, LINE, contact_length=2 * form.radius)
    for name, solid in SOLIDS.items():
        if solid is not ELASTIC:
            scene, said = resting(elastomer=solid), f"Force at rest by the modulus at rest: {name}"
            yield exact(f"rest.{slug(name)}", REST, said, scene, GRID, normal_force=elastic_contact(scene).load)


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
            yield exact(f"layer.{base}.{ratio:g}", REST, said, scene, bound, SPACE, normal_force=form.load)


def on_waves() -> Iterator[Law]:
    """Westergaard: mean gap of one wave, and what touches; of crossed waves a solution on a fine grid."""
    wave, crossed = (kind(amplitude=AMPLITUDE, wavelength=WAVELENGTH) for kind in (Wave, CrossedWaves))
    closure = waves.wave_closure(ELASTIC.indentation_modulus, AMPLITUDE, WAVELENGTH)
    for part in (0.2, 0.5, 0.8):
        scenes, said = (wavy(part * closure, wave),), f"One wave at p/p* = {part:g}: {{}} of Westergaard"
        gap, fraction = waves.wave_mean_gap(part) * AMPLITUDE, float(waves.wave_contact_fraction(part))
        gaps, fractions = said.format("mean gap"), said.format("fraction in contact")
        form = _away("depth", -float(gap), AMPLITUDE)
        yield Law(f"wave.gap.{part:g}", REST, gaps, scenes, form, GRID, SPACE, drawn=True)
        form = _away("contact_fraction", fraction)
        yield Law(f"wave.fraction.{part:g}", REST, fractions, scenes, form, RIM, SPACE, drawn=True)
    closure = waves.crossed_closure(ELASTIC.indentation_modulus, AMPLITUDE, WAVELENGTH)
    for part in (0.3, 0.7):
        scene, form = wavy(part * closure, crossed), _away("contact_fraction", waves.CROSSED_FRACTIONS[part])
        said = f"Crossed waves at p/p* = {part:g}: fraction in contact on 512 x 512 points"
        yield Law(f"crossed.fraction.{part:g}", REST, said, (scene,), form, RIM, SPACE, drawn=True)


def _away(name: str, value: float, scale: float = 1.0) -> Callable[[Answers], float]:
    """Difference of a number from a known one, over a scale that stays where the number falls to nothing."""

    def misfit(answers: Answers) -> float:
        return abs(answers[0][name] - value) / scale

    return misfit


def on_lines() -> Iterator[Law]:
    """A cylinder: Hertz."""
    scene = Scene(Cylinder(SPHERE.radius), ELASTIC, Indent(line_load=LOAD / RADIUS))
    form, wide = elastic_contact(scene), RIM.times(2, "two edges")
    yield exact("line.depth", REST, "Cylinder: depth of Hertz", scene, GRID, SPACE, depth=form.depth)
    yield exact("line.width", REST, "Cylinder: width of Hertz", scene, wide, SPACE, contact_area=2 * form.radius)
