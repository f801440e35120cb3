"""Programs whose stages do not fit together, ask for too much or for nothing."""

from functools import partial

from scene import EmptyContact, Plane, Program, Refused, Scene, SolveError, Stage

from .hardcase import Group, invalid
from .laws import equal, refused
from .ordinary import DEPTH, PACE, RADIUS, ROUGH, SOLID, TIME, program, resting, stage
from .solvers import line, space

SOLVERS = line, partial(space, points=24, steps=20)
BRIEF_FIRST = program(stage(1e-15, depth=DEPTH), stage(1e15))
BRIEF_LAST = program(stage(1e15, depth=DEPTH), stage(1e-15, depth=2 * DEPTH))
LONG_PATH = program(stage(TIME, depth=DEPTH), stage(1.0, speed=1e6 * PACE))
SHALLOW = program(stage(TIME, depth=1e-9 * DEPTH))
CASES = case = Group("programs")

case.add(
    "stages-apart",
    "Stages of 1e-15 and 1e15 s: after the long one steps of the short one are lost to rounding.",
    "The short one first, force at rest within 1e-4, of the sums over pixels; last, refused by the durations.",
    equal((BRIEF_FIRST, resting()), 1e-4, *SOLVERS),
    refused("durations | 1e-15 | rounding", BRIEF_LAST, *SOLVERS),
)
case.add(
    "too-many-steps",
    "A path of a thousand kilometres over pixels of micrometres.",
    "Refused at once: the error says how many steps, the most allowed and what to change.",
    refused("steps on pixels | 1000000 | shorter path", LONG_PATH, error=(Refused, SolveError)),
)
case.add(
    "never-touching",
    "A program that presses in by less than a pixel can see.",
    "Refused: the error says so and what to do.",
    refused("nothing touches in the whole program | press", SHALLOW, space, error=EmptyContact),
    refused("pixels | take more points", SHALLOW, partial(line, extent=4 * RADIUS)),
)


def _through(*stages):
    return program(*(Stage(**each) for each in stages))


@case(
    "Programs without stages, without load, of two quantities, backwards in time, below zero.",
    "Refused: each error names the field, the value and what is allowed.",
)
def no_programs(size):
    one, swing = {"duration": 1.0}, {"amplitude": 2.0, "frequency": 3.0}
    loaded, pressed = one | {"load": 1.0}, one | {"depth": 1.0}
    negative = "load | -1 | greater than or equal to 0"
    yield invalid("no stage", "stages | at least 1", _through)
    yield invalid("pressed nowhere", "press nowhere", _through, one)
    yield invalid("pressed by nothing", "press nowhere | above zero", _through, one | {"load": 0.0})
    yield invalid("load, then depth", "load and depth | one and the same", _through, loaded, pressed)
    yield invalid("a duration of 0", "duration | greater than 0", _through, loaded | {"duration": 0.0})
    yield invalid("an oscillation into the air", "amplitude | 2 N | give less of it", _through, loaded | swing)
    yield invalid("a pull", negative, _through, loaded | {"load": -1.0})
    motion = Program(stages=(Stage(**loaded),))
    yield invalid("a plane under a load in time", "load | Plane | pressure", Scene, Plane(), SOLID, motion, ROUGH)
