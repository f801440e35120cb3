"""Stored laws: the accuracy of the one-dimensional answer in numbers, ratios to 3D and to closed forms."""

import json
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import partial
from itertools import product
from math import isfinite, nan, radians
from pathlib import Path
from typing import Any

import numpy as np
from pydantic.dataclasses import dataclass as validated

from bem3d import BEM
from mdr1d import MDR, draw, equations
from scene import (
    Cone,
    Indent,
    Kelvin,
    PowerLaw,
    Program,
    Scene,
    SelfAffine,
    Slide,
    Sphere,
    Stage,
    StandardLinearSolid,
)
from scene.quantities import CLOSED, Finite
from scene.reading import read
from scene.scales import elastic_contact

from ...models.exact import foundation, indentation
from ...solving.folders import write
from ...solving.task import draws_of
from ...statistics.finding import FAILS, HOLDS, UNDECIDED, Finding
from .law import FORCES, STORED, Law, stated

SHIPPED = Path(__file__).with_name("baseline.toml")
NEW = "not in the file of stored numbers"
DIGITS = 10  # of a stored value: no tolerance is less than these leave
# Three dimensions are solved closer than by default, so that what is seen is their discretisation.
SPACE, LINE = BEM(points=128, tolerance=1e-7), MDR(points=2000)
RADIUS, TIME = 1e-3, 1e-3
# Of the paper: the shapes, the solid, the roughness of Fig. 4, and the Hurst exponents of Fig. 1.
SHAPES: dict[str, Any] = {"cone": Cone(angle=radians(10)), "sphere": Sphere(radius=1e-2)}
KELVIN, ROUGH = Kelvin(1e6, TIME), SelfAffine(hurst=0.4, rms_height=5e-5, longest=1e-2)
HURST = {"cone": 0.1, "sphere": 0.2}
QUARTIC = PowerLaw(coefficient=5e7, exponent=4.0)
SOLIDS: dict[str, Any] = {"Kelvin": KELVIN, "standard linear": StandardLinearSolid(1e6, 1e7, TIME)}
PROFILES, SURFACES, PAPER_PROFILES, PAPER_POINTS = 20, 8, 50, 5000
DECADES = {"1e-2": 0.01, "1": 1.0, "1e2": 100.0}
# Tolerances, each with its reason; measured by solving everything again in those ways.
ROUNDING = 1e-8, "rounding alone: 1D is exact on its grid, loads are met to 1e-10"
AT_REST = 1e-6, "solving 3D to 1e-9 for 1e-7 moves it by 2e-8 at most, 120 points for 128 by 2e-6 to 4e-5"
SLIDING = 1e-5, "solving 3D to 1e-9 for 1e-7 moves it by 6e-7 at most, 120 points for 128 by up to 2e-3"


def laws(values: Mapping[str, float] | None = None) -> Iterator[Law]:
    """Each ratio, which must be the stored value of its id; NaN of one that is not stored."""
    known = read_values(SHIPPED) if values is None else values
    for part in (_at_rest, _smooth, _rough, _paper, _withdrawal, _foundation):
        for id, said, of, scenes, line, over, (tolerance, why) in part():
            value = known.get(id, nan)
            bound = stated(tolerance * abs(value), f"{tolerance:g}: {why}")
            drawn = draws_of(over, SURFACES) if isinstance(over, Scene) else ()
            models = partial(_as_stated, (line,) * len(scenes) + (SPACE,) * len(drawn))
            misfit = _ratio(of, len(scenes), over)
            yield Law(id, STORED, said, (*scenes, *drawn), misfit, bound, models=models, expected=value)


def _as_stated(models, _):
    """Models of the scenes, whatever model is asked."""
    return models


def _ratio(of, count, over):
    """Mean of a number of so many answers over its mean of the others, or over a known one without others."""

    def misfit(answers):
        found = [answer[of] for answer in answers]
        return float(np.mean(found[:count]) / np.mean(found[count:] or [over]))

    return misfit


def _in_3d(id: str, said: str, of: str, scene: Scene, why: tuple[float, str]) -> tuple:
    """Ratio of 1D over 3D: id, sentence, number, scenes in 1D, their solver, what is below, and the tolerance."""
    return id, said, of, draws_of(scene, PROFILES), LINE, scene, why


def _at_rest() -> Iterator[tuple]:
    for name, shape in (SHAPES | {"quartic": QUARTIC}).items():
        scene = Scene(shape, KELVIN, Indent(depth=_depth(shape)))
        yield _in_3d(f"rest.{name}.force", f"at rest, {name}: force 1D/3D", "normal_force", scene, AT_REST)


def _smooth() -> Iterator[tuple]:
    """Ratios in smooth sliding, at the load whose static contact has the radius a."""
    for (solid_name, solid), (name, shape) in product(SOLIDS.items(), SHAPES.items()):
        load = elastic_contact(Scene(shape, solid, Indent(depth=_depth(shape)))).load
        for label, flow in DECADES.items():
            scene = Scene(shape, solid, Slide(speed=flow * RADIUS / TIME, load=load))
            where = f"sliding, smooth {name}, {solid_name}, v tau/a = {flow:g}"
            for what, of in (("friction", "friction_force"), ("depth", "depth"))[: 1 if flow < 1 else 2]:
                id = f"slide.{name}.{_short(solid_name)}.{label}.{what}"
                yield _in_3d(id, f"{where}: {what} 1D/3D", of, scene, SLIDING)


def _rough() -> Iterator[tuple]:
    """Ratios of the paper's contacts with a shortest wave that both resolve."""
    for name, shape in SHAPES.items():
        rough = SelfAffine(hurst=HURST[name], rms_height=5e-5, longest=1e-2, shortest=5e-4, seed=1)
        scene = Scene(shape, KELVIN, Slide(speed=0.1, load=1.0), rough)
        pressed = replace(scene, motion=Indent(depth=elastic_contact(scene).depth))
        said = f"at rest, rough {name}: force 1D/3D"
        yield _in_3d(f"rest.rough-{name}.force", said, "normal_force", pressed, AT_REST)
        for label, speed in {"1e-2": 0.01, "1e-1": 0.1, "1e1": 10.0}.items():
            moved = replace(scene, motion=Slide(speed=speed, load=1.0))
            said = f"sliding, rough {name}, {speed:g} m/s: friction 1D/3D"
            yield _in_3d(f"slide.rough-{name}.{label}.friction", said, "friction_force", moved, SLIDING)


def _paper() -> Iterator[tuple]:
    """Fig. 4 of the paper at three xi."""
    slope, load = draw(ROUGH, PAPER_POINTS).rms_slope, 10.0
    for (name, shape), (label, xi) in product(SHAPES.items(), DECADES.items()):
        body = shape.mdr_coefficient, shape.exponent
        unit = equations.similarity_variable(load, KELVIN.modulus, TIME, 1.0, slope, *body)
        scene = Scene(shape, KELVIN, Slide(speed=xi / unit, load=load), ROUGH)
        scenes = tuple(replace(scene, roughness=replace(ROUGH, seed=seed)) for seed in range(PAPER_PROFILES))
        known = equations.plateau(slope) * equations.interpolation(xi)
        said, of = f"Fig. 4, {name}, xi = {xi:g}: friction 1D/Eq. 19", "friction_coefficient"
        yield f"law.{name}.{label}.friction", said, of, scenes, MDR(points=PAPER_POINTS), known, ROUNDING


def _withdrawal() -> Iterator[tuple]:
    """Pressed in at a constant rate for 2 s and drawn back as fast, on a solid that relaxes in 1 s."""
    solid, rate = StandardLinearSolid(1e6, 5e6, 1.0), RADIUS / 40
    times, depths = (0.0, 2.0, 4.0), (0.0, 2 * rate, 0.0)
    for (name, shape), time in product(SHAPES.items(), (2.2, 2.5)):
        stages = Stage(duration=2.0, depth=2 * rate), Stage(duration=time - 2, depth=(4 - time) * rate)
        (known,), _ = indentation.force_of_depth(shape, solid, times, depths, time)
        id, said = f"withdrawal.{name}.{1e3 * time:.0f}ms.force", f"withdrawal, {name}, {time:g} s: force 1D/Ting"
        scenes = (Scene(shape, solid, Program(stages=stages)),)
        yield id, said, "normal_force", scenes, MDR(points=400, steps=20), float(known), ROUNDING


def _foundation() -> Iterator[tuple]:
    for (solid_name, solid), (name, shape) in product(SOLIDS.items(), SHAPES.items()):
        motion = Slide(speed=RADIUS / TIME, depth=_depth(shape))
        known = foundation.sliding_forces(shape, solid, motion.speed, motion.depth)
        for of, force in zip(FORCES, known, strict=True):
            what = of.split("_")[0]
            said = f"foundation, {name}, {solid_name}, v tau/a = 1: {what} force 1D/exact"
            scenes, id = (Scene(shape, solid, motion),), f"foundation.{name}.{_short(solid_name)}.{what}"
            yield id, said, of, scenes, MDR(points=400), float(force), ROUNDING


def _short(solid_name):
    return solid_name.lower().replace(" ", "-")


def _depth(shape):
    """Depth at which the smooth static contact has the radius RADIUS."""
    return shape.mdr_coefficient * RADIUS**shape.exponent


def held(found: Finding, value: float, share: float) -> Finding:
    """A finding held against a stored value, within a share of it; undecided where either is not known."""
    claim = replace(found.claim, expected=value, tolerance=share * abs(value))
    if not isfinite(found.value):
        return replace(found, claim=claim, stated=UNDECIDED, reason=found.reason or "the number is not known")
    if not isfinite(value):
        return replace(found, claim=claim, stated=UNDECIDED, reason=f"{NEW}: {found.value:.{DIGITS}g}")
    stated = HOLDS if abs(found.value - value) <= claim.tolerance else FAILS
    return replace(found, claim=claim, stated=stated, reason="", remedy="")


@validated(frozen=True, config=CLOSED)
class _Stored:
    values: dict[str, Finite]


def read_values(path: Path) -> dict[str, float]:
    """Stored values by id. Raises InvalidInput if the file is none."""
    return read(path, _Stored).values


def write_values(path: Path, values: Mapping[str, float], heading: str) -> None:
    """Write one line a number, in the order of their ids; printable JSON strings are TOML strings."""
    lines = [
        f"{json.dumps(id, ensure_ascii=False)} = {float(f'{value:.{DIGITS}g}')!r}\n"
        for id, value in sorted(values.items())
    ]
    text = f"# {heading}\n\n[values]\n" + "".join(lines)
    write(path, lambda file: file.write(text.encode()))
