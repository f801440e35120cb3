"""BEM in time: points and steps, against closed forms and against the steady solver."""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from math import nan

import numpy as np

from bem3d import BEM
from scene import Program, Scene, Stage

from ...exact import indentation
from .. import wording
from ..contest import FORCE, FRICTION, ClosedForm, Contest, Finer, Judged, Known, Ladder, Quantity
from ..diagram import Diagram
from ..rung import Rung
from .scenes import CONTACT, SPHERE, STANDARD, TIME, depth, powers, slid

POINTS = {"quick": (32, 64, 128), "full": powers(32, 256)}
STEPS = {"quick": (40, 80, 160), "full": powers(40, 320)}
SLID = {"quick": (32, 64), "full": (32, 64, 128)}
PATHS = {"quick": (2, 8, 16), "full": (1, 2, 4, 8, 16, 32)}  # over the radius of contact, at the least points
REFERENCE = {"quick": 256, "full": 1024}
# Pressed in for two relaxation times and drawn back for less than one.
TOP, IN, BACK = depth(SPHERE), 2 * TIME, 0.5 * TIME
TIMES, DEPTHS = (0.0, IN, IN + BACK), (0.0, TOP, TOP * (1 - BACK / IN))
# Of v tau / a; the solid creeps for ten times as long.
FLOW = 0.1
LEVELS = (1e-2, 1e-3, 1e-4)


def contests(size: str) -> Sequence[Contest]:
    """Pressed in and drawn back; set in motion."""
    return [_withdrawal(size), _started(size)]


def _off_ting(row, fields):
    """rms over the steps, over the greatest force."""
    if row.reason is not None:
        return nan
    force, _ = indentation.force_of_depth(SPHERE, STANDARD, TIMES, DEPTHS, fields["time"])
    return float(np.sqrt(np.mean(np.square(fields["normal_force"] - force))) / force.max())


HISTORY = Quantity("history", "normal force, all history", _off_ting)


def _withdrawal(size):
    stages = Stage(duration=IN, depth=TOP), Stage(duration=BACK, depth=DEPTHS[-1])
    scene = Scene(SPHERE, STANDARD, Program(stages=stages))
    points, steps = POINTS[size], STEPS[size]
    made = partial(Ladder.of, scene=scene, keeps=("time", "normal_force"))
    both = [BEM(points=n, steps=s) for n, s in zip(points, steps, strict=True)]
    ladders = (
        made(f"BEM, by points at {steps[-1]} steps", solver=BEM(steps=steps[-1]), setting="points", values=points),
        made(f"BEM, by steps at {points[-1]}²", solver=BEM(points=points[-1]), setting="steps", values=steps),
        Ladder.through(
            "BEM, points and steps together", scene, both, "points", points, keeps=("time", "normal_force")
        ),
    )
    truth = ClosedForm("Lee and Radok, Ting", {HISTORY.name: Known(0.0, scale=1.0)})
    return Contest("withdrawal", "sphere pressed in and drawn back", truth, (HISTORY,), ladders)


def _started(size):
    steady = slid(SPHERE, STANDARD, FLOW)
    reference = BEM(points=REFERENCE[size], tolerance=1e-7)
    truth = Finer.of(steady, reference, f"the steady solver, {reference.points} points")
    *_, longest = PATHS[size]
    few, paths = BEM(points=SLID[size][0], steps=20), PATHS[size]
    ladders = (
        Ladder.of("BEM, steady, by points", steady, BEM(), "points", (*SLID[size], 2 * SLID[size][-1])),
        Ladder.of(f"BEM, marched {longest} a, by points", _set_in_motion(longest), few, "points", SLID[size]),
        Ladder(
            f"BEM, marched, by path over a at {few.points}²",
            "path over a",
            paths,
            tuple(Rung(few, _set_in_motion(path), work=few.points**2.2 * 50.0) for path in paths),
        ),
    )
    return Contest("started", "sphere set in motion", truth, (FORCE, FRICTION), ladders)


def _set_in_motion(path):
    """Pressed in at once and slid along so many radii of contact."""
    speed = FLOW * CONTACT / TIME
    pressed, moving = Stage(duration=TIME, depth=TOP), Stage(duration=path * CONTACT / speed, speed=speed)
    return replace(slid(SPHERE, STANDARD, FLOW), motion=Program(stages=(pressed, moving)))


def advice(found: Sequence[Judged]) -> str:
    """Points and steps for a level, what is enough of each, and the price of marching to a steady state."""
    withdrawal, started = found
    points, steps, both = withdrawal.climbed
    said = [
        f"For the {HISTORY.label}, of a {withdrawal.contest.title}, {_together(withdrawal, both)}. By points "
        f"alone, {wording.enough(points, HISTORY.name)}; by steps alone, {wording.enough(steps, HISTORY.name)}."
    ]
    steady, marched, paths = started.climbed
    for each in started.contest.quantities:
        said.append(
            f"For the steady {each.label} of a {started.contest.title}, the steady solver: "
            f"{wording.levels(started, steady, each.name, LEVELS)}; marched: "
            f"{wording.levels(started, marched, each.name, LEVELS)}; of the path, "
            f"{wording.enough(paths, each.name)}."
        )
    return f"{' '.join(said)} {_price(steady, marched)}{wording.failures(found)}"


def _together(judged, both):
    levels = wording.levels(judged, both, HISTORY.name, LEVELS)
    steps = ", ".join(f"{rung.solver.points} with {rung.solver.steps}" for rung in both.ladder.rungs)
    return f"{levels} (points and steps: {steps})"


def _price(steady, marched):
    """Of marching over solving at once, on the same points."""
    at = {value: k for k, value in enumerate(steady.ladder.values)}
    ratios = [
        marched.processor[k] / steady.processor[at[value]]
        for k, value in enumerate(marched.ladder.values)
        if value in at
    ]
    ratios = [ratio for ratio in ratios if np.isfinite(ratio)]
    if not ratios:
        return "What marching costs beside the steady solver cannot be told."
    return (
        f"Marched to the steady state, a solve takes {min(ratios):.0f} to {max(ratios):.0f} times as long as the "
        "steady solver on the same points: march only for what happens on the way."
    )


DIAGRAM = Diagram(
    "marching",
    "Three dimensions in time: error against points and steps",
    "BEM marched through a program: a sphere pressed in and drawn back against Lee, Radok and Ting, by points, by "
    "steps and by both together; and a sphere set in motion, against the steady solver and its cost.",
    contests,
    advice,
)
