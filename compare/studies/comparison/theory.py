"""Theories that stand beside the models where nobody asks for them: solved, stored and drawn, not judged."""

from collections.abc import Sequence
from dataclasses import replace

from scene import SolveError, Solver
from scene.protocol import numeric_guard, why_not

from ...models.law.persson import Persson
from ...models.table import Model
from ...solving.curve import FINE, Curve
from ...trustmap.friction_law import FrictionLaw

THEORY, LAW = THEORIES = Persson(), FrictionLaw()


def with_theory(curve: Curve, theories: Sequence[Solver] = (THEORY,)) -> Curve:
    """A curve with theories beside the models, those that are none of them and answer all of it."""
    beside = {
        each.name: {FINE: each} for each in theories if each.name not in curve.levels and _answers(each, curve)
    }
    return replace(curve, levels={**curve.levels, **beside})


def _answers(theory, curve):
    """Whether a theory answers a curve; not where its numbers are too far apart, which others tell."""
    motion = curve.scene.motion
    if not Model.of(theory).tells(motion.pressed_by, motion.speed > 0):
        return False
    try:
        with numeric_guard():
            return not any(why_not(theory, scene) for scene in curve.corners)
    except SolveError:
        return False
