"""BEM in time: points and steps, against closed forms and against the steady solver."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from bem3d import BEM
from scene import Program, Stage

from ...models.exact import indentation
from ...statistics.convergence import MeasuredLadder
from .convergence import Convergence, Ladder
from .diagram import reported
from .reference import FORCE, FRICTION, Known, Quantity, closed_form, finer
from .scenes import CONTACT, SPHERE, STANDARD_LINEAR, TIME, at, powers, slid, withdrawal
from .timed_solve import TimedSolve

POINTS = {"quick": (32, 64, 128), "full": powers(32, 256)}
STEPS = {"quick": (40, 80, 160), "full": powers(40, 320)}
SLID = {"quick": (32, 64), "full": (32, 64, 128)}
PATHS = {"quick": (2, 8, 16), "full": (1, 2, 4, 8, 16, 32)}  # over the radius of contact, at the least points
REFERENCE = {"quick": 256, "full": 1024}
# Pressed in for two relaxation times and drawn back for less than one.
SCENE, TIMES, DEPTHS = withdrawal(2 * TIME, 0.5 * TIME)
# Speed as v tau / a; the solid creeps for ten times as long.
FLOW = 0.1


def contacts(size: str) -> Sequence[Convergence]:
    """Pressed in and drawn back; set in motion."""
    return [_withdrawal(size), _started(size)]


def _off_ting(_, fields):
    """Deviation from the closed form, rms over the steps, over the greatest force."""
    force, _ = indentation.force_of_depth(SPHERE, STANDARD_LINEAR, TIMES, DEPTHS, fields["time"])
    return float(np.sqrt(np.mean(np.square(fields["normal_force"] - force))) / force.max())


HISTORY = Quantity("history", "normal force, all history", _off_ting)


def _withdrawal(size):
    points, steps, keeps = at(POINTS, size), at(STEPS, size), ("time", "normal_force")
    made = partial(Ladder.of, scene=SCENE, keeps=keeps)
    both = dict(zip(points, steps, strict=True))
    ladders = (
        made(f"BEM, by points at {steps[-1]} steps", solver=BEM(steps=steps[-1]), setting="points", values=points),
        made(f"BEM, by steps at {points[-1]}²", solver=BEM(points=points[-1]), setting="steps", values=steps),
        Ladder.over(
            "BEM, points and steps together",
            "points",
            points,
            lambda n: TimedSolve.of(BEM(points=n, steps=both[n]), SCENE, keeps),
        ),
    )
    truth = closed_form("Lee and Radok, Ting", {HISTORY.name: Known(0.0, scale=1.0)})
    return Convergence("withdrawal", "sphere pressed in and drawn back", truth, (HISTORY,), ladders)


def _started(size):
    steady = slid(SPHERE, STANDARD_LINEAR, FLOW)
    reference = BEM(points=at(REFERENCE, size), tolerance=1e-7)
    truth = finer(steady, reference, "the steady solver, {} points")
    paths, slides = at(PATHS, size), at(SLID, size)
    few, longest = BEM(points=slides[0], steps=20), paths[-1]
    ladders = (
        Ladder.of("BEM, steady, by points", steady, BEM(), "points", (*slides, 2 * slides[-1])),
        Ladder.of(f"BEM, marched {longest} a, by points", _set_in_motion(longest), few, "points", slides),
        Ladder.over(
            f"BEM, marched, by path over a at {few.points}²",
            "path over a",
            paths,
            lambda path: TimedSolve.of(few, _set_in_motion(path)),
        ),
    )
    return Convergence("started", "sphere set in motion", truth, (FORCE, FRICTION), ladders)


def _set_in_motion(path):
    """Pressed in at once and slid along so many radii of contact."""
    speed = FLOW * CONTACT / TIME
    pressed, moving = Stage(duration=TIME, depth=DEPTHS[1]), Stage(duration=path * CONTACT / speed, speed=speed)
    return replace(slid(SPHERE, STANDARD_LINEAR, FLOW), motion=Program(stages=(pressed, moving)))


def price(found: Mapping[str, list[MeasuredLadder]]) -> Iterator:
    """Time of marching to the steady state over that of solving at once, on the same points."""
    steady, marched = (
        each for each in found["started"] if each.quantity == FORCE.name and each.setting == "points"
    )
    times = dict(zip(steady.values, steady.processor, strict=True))
    for value, spent in zip(marched.values, marched.processor, strict=True):
        ratio = float(spent / times[value])
        sentence = "Time of marching to the steady state over that of the steady solver"
        why = "one of both was not solved"
        yield reported("marching.price", sentence, ratio, f"{value:g} points", missing=why)
