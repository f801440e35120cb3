"""The regimes in which the models are asked for the true answer of three dimensions."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, TypeVar

from bem3d import BEM
from mdr1d import MDR
from scene import Indent, Scene, Slide, StandardLinearSolid
from scene.scales import elastic_contact

from ..claims.study_file import STUDIES
from ..paper import parameters
from .convergence import Convergence, Ladder
from .ensemble import Ensemble, corrected_solve
from .reference import DEPTH, FORCE, FRICTION, Known, closed_form, finer

# quick: few contacts on short ladders; standard: all contacts on short ladders; full: all on long ladders.
SIZES = QUICK, STANDARD, FULL = "quick", "standard", "full"
LOAD = 1.0
SPHERE, CONE = (replace(parameters.resolved(shape), roughness=None) for shape in ("sphere", "cone"))
KELVIN = SPHERE.elastomer
LINEAR = StandardLinearSolid(KELVIN.modulus, 10 * KELVIN.modulus, KELVIN.relaxation_time)
# Name, title, body and speed in contact radii per relaxation time.
SMOOTH = (
    ("smooth-rest", "sphere at rest", SPHERE, 0.0),
    ("smooth-slow", "sphere, vτ = 0.01 a", SPHERE, 0.01),
    ("smooth-middle", "sphere, vτ = a", SPHERE, 1.0),
    ("smooth-fast", "sphere, vτ = 100 a", SPHERE, 100.0),
    ("cone-middle", "cone, vτ = a", CONE, 1.0),
    ("linear-middle", "standard linear sphere, vτ = a", replace(SPHERE, elastomer=LINEAR), 1.0),
)
POINTS: dict[str, dict[str, Any]] = {
    "quick": {"BEM": (32, 64, 128), "MDR": (100, 400), "truth": 256},
    "full": {"BEM": (32, 64, 128, 256, 512), "MDR": (50, 500, 5000), "truth": 1024},
}
# Speeds in shortest waves per relaxation time.
SPEEDS = {"slow": 0.02, "middle": 0.2, "fast": 20.0}
ROUGH: dict[str, dict[str, Any]] = {
    "quick": {"grids": (64, 128, 256), "surfaces": 40, "paired": 6, "lines": (1000,), "profiles": 1000},
    "full": {
        "grids": (64, 128, 256, 512),
        "surfaces": 200,
        "paired": 12,
        "lines": (250, 5000),
        "profiles": 1500,
        "timed_surfaces": 2,
    },
}
# Where three dimensions need fine grids to resolve the waves.
STEEP = {"grids": (512, 1024), "surfaces": 12, "paired": 4, "lines": (5000,), "profiles": 1500}
Values = TypeVar("Values")


def at(values: Mapping[str, Values], size: str) -> Values:
    """Settings of a size: those of "full", or those of "quick" for both smaller sizes."""
    return values[FULL if size == FULL else QUICK]


def smooth(size: str) -> list[Convergence]:
    """A sphere at rest and at three speeds, a cone and a standard linear solid at the speed of most friction."""
    asked = ("smooth-rest", "smooth-middle") if size == QUICK else [name for name, *_ in SMOOTH]
    return [_smooth(*each, at(POINTS, size)) for each in SMOOTH if each[0] in asked]


def rough(size: str) -> list[Ensemble]:
    """The rough sphere and cone, at rest at a depth and sliding under a load; a steep sphere as in the paper."""
    settings = at(ROUGH, size)
    found: list[Ensemble] = []
    for shape in ("sphere", "cone"):
        scene = parameters.resolved(shape)
        rest = replace(scene, motion=Indent(depth=elastic_contact(scene).depth))
        found.append(Ensemble(f"rough-{shape}-rest", f"rough {shape} at rest", rest, (FORCE,), **settings))
        for speed, factor in SPEEDS.items():
            motion = Slide(speed=factor * parameters.SHORTEST / KELVIN.relaxation_time, load=LOAD)
            title = f"rough {shape}, vτ = {factor:g} λₛ"
            found.append(_sliding(f"rough-{shape}-{speed}", title, replace(scene, motion=motion), settings))
    if size == QUICK:
        return [each for each in found if each.name == "rough-sphere-middle"]
    return [*found, _steep()] if size == FULL else found  # its grids cannot be coarse


def _smooth(name, title, body, flow, points):
    rest = replace(body, motion=Indent(load=LOAD))
    contact = elastic_contact(rest)
    if flow:
        speed = flow * contact.radius / KELVIN.relaxation_time
        scene, quantities = replace(body, motion=Slide(speed=speed, load=LOAD)), (FRICTION, DEPTH)
        truth = finer(scene, BEM(points=points["truth"]), "3D, {} points", {"depth": contact.depth})
    else:
        scene, quantities = rest, (DEPTH,)
        truth = closed_form("Galin and Sneddon", {"depth": Known(contact.depth)})
    mdr, bem = (Ladder.of(each.name, scene, each, "points", points[each.name]) for each in (MDR(), BEM()))
    line = Ladder.over("CorrectedMDR", "points", points["MDR"], lambda each: corrected_solve(scene, each))
    return Convergence(name, title, truth, quantities, (mdr, bem, line))


def _steep():
    """At the largest load and the speed of the study of the regime of the paper."""
    series = STUDIES["regime"].series(FULL)[0]
    scene, speed = series.scene, 1.0
    rough = replace(scene.roughness, seed=0)
    scene = replace(scene, roughness=rough, motion=Slide(speed=speed, load=series.values[-1]))
    factor = speed * scene.elastomer.relaxation_time / scene.roughness.shortest
    return _sliding("steep-sphere", f"steep sphere, vτ = {factor:.2g} λₛ", scene, STEEP)


def _sliding(name, title, scene: Scene, settings):
    scales = {"depth": elastic_contact(scene).depth}
    return Ensemble(name, title, scene, (FRICTION, DEPTH), scales=scales, **settings)
