"""Scenes of every part, with numbers beyond reason: each is answered by its laws, or is refused.

Half a thousand by each solver, as FUZZ_SEED has them, see `damage`. A hang is a failure too.
"""

from dataclasses import fields, replace
from math import isfinite

import numpy as np
import pytest
from damage import TRIES, bounded, fuzz, unshowable
from effects import effects
from hypothesis import strategies as st
from solids import OF_EACH_TYPE
from strategies import bodies, decades, planes

from bem3d import BEM
from mdr1d import MDR
from scene import (
    Cylinder,
    InvalidInput,
    Measured,
    Program,
    Refused,
    Result,
    Slide,
    SolveError,
)

pytestmark = pytest.mark.slow
SCENES = TRIES // 2
LONGEST, STEPS, LARGEST = 2.0, 400, 1e8  # s, steps, bytes that a solve is planned to take; of more, a plan is all
SOLVERS = {"BEM": BEM(points=32, steps=10), "MDR": MDR(points=500, steps=10)}
ROUNDING = 1e-9  # of sums that hold what is prescribed
SENTENCES = 2000  # letters of all reasons of a refusal
seldom = st.integers(0, 3).map(lambda one: one == 3)
extremes = decades(-40, 40)
BALL = effects()[0].scene
SQUARES = np.arange(-20, 21) ** 2
# Of every part that a scene may have; each solver refuses some.
OF_EVERY_PART = (
    *(effect.scene for effect in effects()),
    *(replace(BALL, elastomer=solid) for solid in OF_EACH_TYPE.values()),
    replace(BALL, indenter=Cylinder(radius=1e-2), motion=Slide(speed=0.1, line_load=100.0)),
    replace(BALL, indenter=Measured(heights=1e-7 * np.add.outer(SQUARES, SQUARES), pixel=5e-5, peaks="down")),
)


@st.composite
def scenes(draw):
    """Any scene: at random around a contact of radius 1, or one of every part; then single numbers go anywhere."""
    return _stretched(draw, draw(st.one_of(bodies(), planes(), st.sampled_from(OF_EVERY_PART))))


def _stretched(draw, scene):
    """Numbers of one part in three multiplied by anything."""
    for name, part in scene.parts.items():
        numbers = [each.name for each in fields(part) if isinstance(getattr(part, each.name), float)]
        if numbers and draw(seldom):
            number = draw(st.sampled_from(numbers))
            try:
                part = replace(part, **{number: getattr(part, number) * draw(extremes)})
                scene = replace(scene, **{name: part})
            except InvalidInput:  # beyond what a scene may say: it stays as it was
                pass
    return scene


def answer(solver, scene) -> Result | None:
    """The answer, None where the scene is refused in words or would take long."""
    with bounded():
        try:
            plan = solver.plan(scene)
            if plan.steps > STEPS or plan.memory > LARGEST or (plan.seconds.value or 0.0) > LONGEST:
                return None
            return solver.solve(scene)
        except (Refused, SolveError) as error:
            refused = str(error)
    wrong = unshowable(refused, letters=SENTENCES)
    assert not wrong, f"{wrong}: {refused}"
    return None


def broken(result) -> list[str]:
    """Laws of any answer that this one does not keep."""
    scene, measures, force = result.scene, result.measures, result.normal_force
    motion, friction = scene.motion, result.friction_force
    history = isinstance(motion, Program)  # whose forces are of the middle of its last step
    met = {"load": force, "line_load": force, "pressure": measures.get("mean_pressure"), "depth": result.depth}
    found = None if history else met.get(motion.pressed_by)
    # A depth is counted from the mean of the roughness.
    scale = motion.greatest + (measures.get("rms_height", 0.0) if motion.pressed_by == "depth" else 0.0)
    pressure = result.fields.get("pressure", result.fields.get("line_force"))
    # Uncertainty of mu, as estimates of one pressure differ; none where friction is a sum of losses.
    unsure = 2 * measures.get("friction_disagreement", 0.0) + ROUNDING * measures.get("rms_slope", 1.0)
    rubbed = measures.get("friction_in_interface", 0.0)
    lossless = motion.speed == 0 or len(scene.solid.retardation()[2]) == 0 if not history else False
    laws = {
        "forces are finite": isfinite(force) and isfinite(friction),
        "nothing pulls": force >= 0
        and (pressure is None or bool(np.all(pressure >= -ROUNDING * np.max(pressure)))),
        "what is prescribed is met": found is None or abs(found - motion.greatest) <= ROUNDING * scale,
        "the residual is within the tolerance": result.residual <= 1e-5,
        "friction opposes the motion": history or friction >= rubbed - unsure * force,
        "without loss friction is that of the interface": not lossless or friction == rubbed,
    }
    return [law for law, holds in laws.items() if not holds]


@pytest.mark.parametrize("name", SOLVERS)
def test_a_scene_is_answered_by_its_laws_or_refused(name):
    solver = SOLVERS[name]

    def law(scene):
        found = answer(solver, scene)
        assert not (wrong := [] if found is None else broken(found)), "; ".join(wrong)

    fuzz(law, scenes(), tries=SCENES)
