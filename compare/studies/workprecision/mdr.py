"""MDR against points: how far it is from what one dimension itself would answer."""

from collections.abc import Sequence
from itertools import product

from mdr1d import MDR
from scene.scales import elastic_contact

from ...models.exact import foundation, indentation
from .convergence import Convergence, Ladder
from .reference import FORCE, FRICTION, Known, closed_form, finer
from .scenes import CONE, KELVIN, SPHERE, STANDARD_LINEAR, TIME, at, powers, pressed, rough, slid, some, withdrawal

POINTS = {"quick": (32, 512, 8192), "full": powers(16, 65536, 4)}
ROUGH_POINTS = {"quick": (256, 1024, 8192), "full": powers(256, 65536, 4)}
HISTORY_POINTS = {"quick": (64, 512, 4096), "full": powers(16, 16384, 4)}
STEPS = {"quick": (1, 100), "full": (1, 10, 100, 1000)}
BODIES = {"sphere": SPHERE, "cone": CONE}
SOLIDS = {"Kelvin": KELVIN, "standard linear": STANDARD_LINEAR}
SLIDING = {
    "quick": (("sphere", "Kelvin"), ("cone", "standard linear")),
    "full": tuple(product(BODIES, SOLIDS)),
}
SECOND_ORDER = {FORCE.name: 2.0}


def contacts(size: str) -> Sequence[Convergence]:
    """Rest, sliding, a rough sphere, and a withdrawal."""
    sliding = (_sliding(body, solid, size) for body, solid in some(SLIDING, size))
    return [_at_rest(size), *sliding, _rough(size), _withdrawal(size)]


def _points(scene, values):
    return Ladder.of("MDR, by points", scene, MDR(), "points", values)


def _at_rest(size):
    scene = pressed(SPHERE)
    truth = closed_form("Hertz", {FORCE.name: Known(elastic_contact(scene).load)})
    ladders = (_points(scene, at(POINTS, size)),)
    return Convergence("rest-sphere", "sphere at rest", truth, (FORCE,), ladders, SECOND_ORDER)


def _sliding(body, solid, size):
    scene = slid(BODIES[body], SOLIDS[solid], 1.0)
    speed, depth = scene.motion.speed, scene.motion.depth
    normal, friction = foundation.sliding_forces(scene.indenter, scene.elastomer, speed, depth)
    values = {FORCE.name: Known(normal), FRICTION.name: Known(friction / normal)}
    truth = closed_form("the closed form of the foundation", values)
    ladders = (_points(scene, at(POINTS, size)),)
    name, title = f"{body}-{solid.split()[0].lower()}", f"{body}, {solid}, v τ = a"
    return Convergence(name, title, truth, (FORCE, FRICTION), ladders)


def _rough(size):
    scene = rough(0.1)
    truth = finer(scene, MDR(points=2**20), "{} points on the same profile")
    ladders = (_points(scene, at(ROUGH_POINTS, size)),)
    return Convergence("rough-sphere", "rough sphere, 0.1 m/s", truth, (FRICTION,), ladders)


def _withdrawal(size):
    """Pressed in for two relaxation times and drawn back as fast, for less than one."""
    scene, times, depths = withdrawal(2 * TIME, 0.2 * TIME)
    (force,), _ = indentation.force_of_depth(SPHERE, STANDARD_LINEAR, times, depths, times[-1])
    truth = closed_form("Ting", {FORCE.name: Known(float(force))})
    by_points = Ladder.of("MDR, by points", scene, MDR(steps=50), "points", at(HISTORY_POINTS, size))
    by_steps = Ladder.of("MDR, by steps", scene, MDR(points=512), "steps", at(STEPS, size))
    title = "sphere pressed in and drawn back"
    return Convergence("withdrawal", title, truth, (FORCE,), (by_points, by_steps), SECOND_ORDER)
