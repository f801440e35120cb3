"""MDR against points: how far it is from what one dimension itself would answer."""

from collections.abc import Sequence

from mdr1d import MDR
from scene import Program, Scene, Stage
from scene.scales import elastic_contact

from ...exact import foundation, indentation
from .. import wording
from ..contest import FORCE, FRICTION, ClosedForm, Contest, Finer, Judged, Known, Ladder
from ..diagram import Diagram
from .scenes import CONE, KELVIN, SPHERE, STANDARD, TIME, depth, powers, pressed, rough, slid

POINTS = {"quick": (32, 512, 8192), "full": powers(16, 65536, 4)}
ROUGH_POINTS = {"quick": (256, 1024, 8192), "full": powers(256, 65536, 4)}
HISTORY_POINTS = {"quick": (64, 512, 4096), "full": powers(16, 16384, 4)}
REFERENCE = MDR(points=2**20)
LEVELS = (1e-2, 1e-3, 1e-5)
STEPS = {"quick": (1, 100), "full": (1, 10, 100, 1000)}
# Pressed in for two relaxation times and drawn back as fast, for less than one.
IN, BACK = 2 * TIME, 0.2 * TIME


def contests(size: str) -> Sequence[Contest]:
    """Rest, sliding, a rough sphere, and a withdrawal."""
    smooth = [_sliding("sphere", SPHERE, "Kelvin", KELVIN, size)]
    if size == "full":
        smooth.append(_sliding("sphere", SPHERE, "standard linear", STANDARD, size))
        smooth.append(_sliding("cone", CONE, "Kelvin", KELVIN, size))
    smooth.append(_sliding("cone", CONE, "standard linear", STANDARD, size))
    return [_at_rest(size), *smooth, _rough(size), _withdrawal(size)]


def _points(scene, values):
    return Ladder.of("MDR, by points", scene, MDR(), "points", values)


def _at_rest(size):
    scene = pressed(SPHERE)
    truth = ClosedForm("Hertz", {FORCE.name: Known(elastic_contact(scene).load)})
    return Contest("rest-sphere", "sphere at rest", truth, (FORCE,), (_points(scene, POINTS[size]),))


def _sliding(name, shape, solid_name, solid, size):
    scene = slid(shape, solid, 1.0)
    normal, friction = foundation.sliding_forces(shape, solid, scene.motion.speed, scene.motion.depth)
    values = {FORCE.name: Known(normal), FRICTION.name: Known(friction / normal)}
    truth = ClosedForm("the closed form of the foundation", values)
    ladders = (_points(scene, POINTS[size]),)
    title = f"{name}, {solid_name}, v τ = a"
    return Contest(f"{name}-{solid_name.split()[0].lower()}", title, truth, (FORCE, FRICTION), ladders)


def _rough(size):
    scene = rough(0.1)
    truth = Finer.of(scene, REFERENCE, f"{REFERENCE.points} points on the same profile")
    ladders = (_points(scene, ROUGH_POINTS[size]),)
    return Contest("rough-sphere", "rough sphere, 0.1 m/s", truth, (FRICTION,), ladders)


def _withdrawal(size):
    top = depth(SPHERE)
    end = top * (1 - BACK / IN)
    stages = Stage(duration=IN, depth=top), Stage(duration=BACK, depth=end)
    scene = Scene(SPHERE, STANDARD, Program(stages=stages))
    times, depths = (0.0, IN, IN + BACK), (0.0, top, end)
    (force,), _ = indentation.force_of_depth(SPHERE, STANDARD, times, depths, IN + BACK)
    truth = ClosedForm("Ting", {FORCE.name: Known(float(force))})
    by_points = Ladder.of("MDR, by points", scene, MDR(steps=50), "points", HISTORY_POINTS[size])
    by_steps = Ladder.of("MDR, by steps", scene, MDR(points=512), "steps", STEPS[size])
    return Contest("withdrawal", "sphere pressed in and drawn back", truth, (FORCE,), (by_points, by_steps))


def advice(found: Sequence[Judged]) -> str:
    """Points for a level, order, and what steps buy."""
    said = []
    for judged in found:
        points = judged.climbed[0]
        name = (FRICTION if FRICTION.name in judged.known else FORCE).name
        what = "friction" if name == FRICTION.name else "normal force"
        levels = wording.levels(judged, points, name, LEVELS)
        said.append(
            f"For the {what} of the {judged.contest.title}, {levels}; {wording.order(judged, points, name)}."
        )
        said += [f"As for its steps, {wording.enough(steps, name)}." for steps in judged.climbed[1:]]
    return (
        "In one dimension the error of the grid is cheap to remove; what is left against three dimensions is that "
        f"of the model. {' '.join(said)}{wording.failures(found)}"
    )


DIAGRAM = Diagram(
    "mdr",
    "One dimension: error against points",
    "The errors of MDR against what one dimension itself would answer: closed forms of the foundation, or the "
    "same rough profile on far more points. They say nothing of three dimensions.",
    contests,
    advice,
)
