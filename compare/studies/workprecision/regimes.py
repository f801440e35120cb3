"""The regimes in which the models are asked for the true answer of three dimensions."""

from dataclasses import replace
from typing import Any

from bem3d import BEM
from mdr1d import MDR
from scene import Indent, Scene, Slide, StandardLinearSolid
from scene.scales import elastic_contact

from ..claims import contacts
from .convergence import Convergence, Ladder
from .ensemble import Ensemble, corrected_solve
from .reference import DEPTH, FORCE, FRICTION, Known, closed_form, finer
from .scenes import FULL, QUICK, at

LOAD = 1.0
# Sliding speeds, in contact radii per relaxation time on the smooth body, in shortest waves on the rough one.
SMOOTH_SPEEDS = {"slow": 0.01, "middle": 1.0, "fast": 100.0}
ROUGH_SPEEDS = {"slow": 0.02, "middle": 0.2, "fast": 20.0}
GLASSY_OVER_RUBBERY = 10.0
SMOOTH: dict[str, dict[str, Any]] = {
    "quick": {"BEM": (32, 64, 128), "MDR": (100, 400), "truth": 256},
    "full": {"BEM": (32, 64, 128, 256, 512), "MDR": (50, 500, 5000), "truth": 1024},
}
ROUGH = {
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


def smooth(size: str) -> list[Convergence]:
    """A sphere at rest and at three speeds, a cone and a standard linear solid at the speed of most friction."""
    sphere = _body("sphere")
    solid = sphere.elastomer
    linear = StandardLinearSolid(
        rubbery_modulus=solid.modulus,
        glassy_modulus=GLASSY_OVER_RUBBERY * solid.modulus,
        relaxation_time=solid.relaxation_time,
    )
    rest = _at_rest("smooth-rest", "sphere at rest", sphere, size)
    middle = _sliding("smooth-middle", "sphere, vτ = a", sphere, "middle", size)
    if size == QUICK:
        return [rest, middle]
    return [
        rest,
        _sliding("smooth-slow", "sphere, vτ = 0.01 a", sphere, "slow", size),
        middle,
        _sliding("smooth-fast", "sphere, vτ = 100 a", sphere, "fast", size),
        _sliding("cone-middle", "cone, vτ = a", _body("cone"), "middle", size),
        _sliding(
            "linear-middle", "standard linear sphere, vτ = a", replace(sphere, elastomer=linear), "middle", size
        ),
    ]


def rough(size: str) -> list[Ensemble]:
    """The rough sphere and cone, at rest at a depth and sliding under a load; a steep sphere as in the paper."""
    settings = at(ROUGH, size)
    if size == QUICK:
        return [_rough_sliding("sphere", "middle", settings)]
    found = [
        regime
        for shape in ("sphere", "cone")
        for regime in (
            _rough_at_rest(shape, settings),
            *(_rough_sliding(shape, speed, settings) for speed in ROUGH_SPEEDS),
        )
    ]
    return [*found, _steep()] if size == FULL else found  # its grids cannot be coarse


def _body(shape) -> Scene:
    """The rough contact without its roughness."""
    return replace(contacts.kelvin(shape), roughness=None)


def _at_rest(name, title, body, size):
    scene = replace(body, motion=Indent(load=LOAD))
    depth = elastic_contact(scene).depth
    truth = closed_form("Galin and Sneddon", {"depth": Known(depth)})
    return Convergence(name, title, truth, (DEPTH,), _ladders(scene, size))


def _sliding(name, title, body, speed, size):
    contact = elastic_contact(replace(body, motion=Indent(load=LOAD)))
    velocity = SMOOTH_SPEEDS[speed] * contact.radius / contacts.kelvin("sphere").elastomer.relaxation_time
    scene = replace(body, motion=Slide(speed=velocity, load=LOAD))
    known = finer(scene, BEM(points=at(SMOOTH, size)["truth"]), "3D, {} points", {"depth": contact.depth})
    return Convergence(name, title, known, (FRICTION, DEPTH), _ladders(scene, size))


def _ladders(scene: Scene, size) -> tuple[Ladder, ...]:
    points = at(SMOOTH, size)
    mdr, bem = (Ladder.of(each.name, scene, each, "points", points[each.name]) for each in (MDR(), BEM()))
    line = Ladder.over("CorrectedMDR", "points", points["MDR"], lambda each: corrected_solve(scene, each))
    return mdr, bem, line


def _rough_at_rest(shape, settings):
    scene = contacts.kelvin(shape)
    depth = elastic_contact(scene).depth
    scene = replace(scene, motion=Indent(depth=depth))
    return Ensemble(f"rough-{shape}-rest", f"rough {shape} at rest", scene, (FORCE,), **settings)


def _rough_sliding(shape, speed, settings):
    scene = contacts.kelvin(shape)
    factor = ROUGH_SPEEDS[speed]
    velocity = factor * contacts.SHORTEST / scene.elastomer.relaxation_time
    scene = replace(scene, motion=Slide(speed=velocity, load=LOAD))
    return _under_load(f"rough-{shape}-{speed}", f"rough {shape}, vτ = {factor:g} λₛ", scene, settings)


def _steep():
    """At the largest load and the speed of the study of the regime of the paper."""
    scene, (_, load) = contacts.STEEP["sphere"]
    speed, shortest = scene.motion.speed, scene.roughness.shortest
    scene = replace(scene, motion=Slide(speed=speed, load=load))
    factor = speed * scene.elastomer.relaxation_time / shortest
    return _under_load("steep-sphere", f"steep sphere, vτ = {factor:.2g} λₛ", scene, STEEP)


def _under_load(name, title, scene, settings):
    scales = {"depth": elastic_contact(scene).depth}
    return Ensemble(name, title, scene, (FRICTION, DEPTH), scales=scales, **settings)
