"""Programs whose stages do not fit together, ask for too much or for nothing."""

from functools import partial

from pydantic import ValidationError

from scene import EmptyContact, Plane, Program, Refused, Scene, SolveError, Stage

from .hardcase import Group, deviation, refusal
from .ordinary import (
    DEPTH,
    PACE,
    RADIUS,
    ROUGH,
    SOLID,
    TIME,
    line,
    program,
    resting,
    space,
)

REFUSED = (Refused, SolveError)
CASES = case = Group("programs")


@case(
    "Stages of 1e-15 and 1e15 s: after the long one steps of the short one are lost to rounding.",
    "The short one first, force at rest within 1e-4, of the sums over pixels; last, refused by the durations.",
)
def stages_apart(size):
    solvers = line(size), space(size, points=24, steps=20)
    for solver in solvers:
        answer = solver.solve(program({"duration": 1e-15, "depth": DEPTH}, {"duration": 1e15}))
        still = solver.solve(resting()).normal_force
        yield deviation(f"{solver.name}: force after 1e15 s", answer.normal_force, still, 1e-4)
    lost = program({"duration": 1e15, "depth": DEPTH}, {"duration": 1e-15, "depth": 2 * DEPTH})
    for solver in solvers:
        ask = partial(solver.solve, lost)
        yield refusal(
            f"{solver.name}: 1e15 s and then 1e-15 s", SolveError, ("durations", "1e-15", "rounding"), ask
        )


@case(
    "A path of a thousand kilometres over pixels of micrometres.",
    "Refused at once: the error says how many steps, the most allowed and what to change.",
)
def too_many_steps(size):
    scene = program({"duration": TIME, "depth": DEPTH}, {"duration": 1.0, "speed": 1e6 * PACE})
    for solver in (line(size), space(size)):
        names = ("steps on pixels", "1000000", "shorter path")
        yield refusal(f"{solver.name}: a path of 1000 km", REFUSED, names, partial(solver.solve, scene))


@case(
    "A program that presses in by less than a pixel can see.",
    "Refused: the error says so and what to do.",
)
def never_touching(size):
    scene = program({"duration": TIME, "depth": 1e-9 * DEPTH})
    names = ("nothing touches in the whole program", "press")
    yield refusal("BEM", EmptyContact, names, partial(space(size).solve, scene))
    names = ("pixels", "take more points")
    yield refusal("MDR", SolveError, names, partial(line(size, extent=4 * RADIUS).solve, scene))


@case(
    "Programs without stages, without load, of two quantities, backwards in time, below zero.",
    "Refused: each error names the field, the value and what is allowed.",
)
def no_programs(size):
    asks = {
        "no stage": ((), ("stages", "at least 1")),
        "pressed nowhere": (({"duration": 1.0},), ("press nowhere",)),
        "pressed by nothing": (({"duration": 1.0, "load": 0.0},), ("press nowhere", "above zero")),
        "load, then depth": (
            ({"duration": 1.0, "load": 1.0}, {"duration": 1.0, "depth": 1.0}),
            ("load and depth", "one and the same"),
        ),
        "a duration of 0": (({"duration": 0.0, "load": 1.0},), ("duration", "greater than 0")),
        "an oscillation into the air": (
            ({"duration": 1.0, "load": 1.0, "amplitude": 2.0, "frequency": 3.0},),
            ("amplitude", "2 N", "give less of it"),
        ),
        "a pull": (({"duration": 1.0, "load": -1.0},), ("load", "-1", "greater than or equal to 0")),
    }
    for what, (stages, names) in asks.items():
        yield refusal(what, ValidationError, names, partial(program, *stages))
    gap = partial(Scene, Plane(), SOLID, Program(stages=(Stage(duration=1.0, load=1.0),)), ROUGH)
    yield refusal("a plane under a load in time", ValidationError, ("load", "Plane", "pressure"), gap)
