"""MDR against points: how far it is from what one dimension itself would answer."""

from collections.abc import Sequence

from mdr1d import MDR
from scene.scales import elastic_contact

from ...models.exact import foundation, indentation
from .convergence import Convergence, Ladder
from .diagram import convergence
from .reference import FORCE, FRICTION, Known, closed_form, finer
from .scenes import CONE, KELVIN, SPHERE, STANDARD_LINEAR, TIME, at, powers, pressed, rough, slid, some, withdrawal

POINTS = {"quick": (32, 512, 8192), "full": powers(16, 65536, 4)}
ROUGH_POINTS = {"quick": (256, 1024, 8192), "full": powers(256, 65536, 4)}
HISTORY_POINTS = {"quick": (64, 512, 4096), "full": powers(16, 16384, 4)}
REFERENCE = MDR(points=2**20)
STEPS = {"quick": (1, 100), "full": (1, 10, 100, 1000)}
# Pressed in for two relaxation times and drawn back as fast, for less than one.
IN, BACK = 2 * TIME, 0.2 * TIME
SMOOTH = {
    "quick": (("sphere", SPHERE, "Kelvin", KELVIN), ("cone", CONE, "standard linear", STANDARD_LINEAR)),
    "full": (
        ("sphere", SPHERE, "Kelvin", KELVIN),
        ("sphere", SPHERE, "standard linear", STANDARD_LINEAR),
        ("cone", CONE, "Kelvin", KELVIN),
        ("cone", CONE, "standard linear", STANDARD_LINEAR),
    ),
}


def contacts(size: str) -> Sequence[Convergence]:
    """Rest, sliding, a rough sphere, and a withdrawal."""
    smooth = (_sliding(each, size) for each in some(SMOOTH, size))
    return [_at_rest(size), *smooth, _rough(size), _withdrawal(size)]


def _points(scene, values):
    return Ladder.of("MDR, by points", scene, MDR(), "points", values)


def _at_rest(size):
    scene = pressed(SPHERE)
    truth = closed_form("Hertz", {FORCE.name: Known(elastic_contact(scene).load)})
    ladders = (_points(scene, at(POINTS, size)),)
    return Convergence("rest-sphere", "sphere at rest", truth, (FORCE,), ladders, {FORCE.name: 2.0})


def _sliding(contact, size):
    name, shape, solid_name, solid = contact
    scene = slid(shape, solid, 1.0)
    normal, friction = foundation.sliding_forces(shape, solid, scene.motion.speed, scene.motion.depth)
    values = {FORCE.name: Known(normal), FRICTION.name: Known(friction / normal)}
    truth = closed_form("the closed form of the foundation", values)
    ladders = (_points(scene, at(POINTS, size)),)
    title = f"{name}, {solid_name}, v τ = a"
    return Convergence(f"{name}-{solid_name.split()[0].lower()}", title, truth, (FORCE, FRICTION), ladders)


def _rough(size):
    scene = rough(0.1)
    truth = finer(scene, REFERENCE, "{} points on the same profile")
    ladders = (_points(scene, at(ROUGH_POINTS, size)),)
    return Convergence("rough-sphere", "rough sphere, 0.1 m/s", truth, (FRICTION,), ladders)


def _withdrawal(size):
    scene, times, depths = withdrawal(IN, BACK)
    (force,), _ = indentation.force_of_depth(SPHERE, STANDARD_LINEAR, times, depths, times[-1])
    truth = closed_form("Ting", {FORCE.name: Known(float(force))})
    by_points = Ladder.of("MDR, by points", scene, MDR(steps=50), "points", at(HISTORY_POINTS, size))
    by_steps = Ladder.of("MDR, by steps", scene, MDR(points=512), "steps", at(STEPS, size))
    title = "sphere pressed in and drawn back"
    return Convergence("withdrawal", title, truth, (FORCE,), (by_points, by_steps), {FORCE.name: 2.0})


DIAGRAM = convergence(
    "mdr",
    "One dimension: error against points",
    "The errors of MDR against what one dimension itself would answer: closed forms of the foundation, or the "
    "same rough profile on far more points. They say nothing of three dimensions.",
    contacts,
)
