"""Programs whose stages do not fit together, ask for too much or for nothing."""

from scene import EmptyContact, Plane, Program, Refused, Scene, SolveError, Stage

from .hardcase import Group, deviation, invalid, refusal
from .ordinary import DEPTH, PACE, RADIUS, ROUGH, SOLID, TIME, line, program, resting, space

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
        what = f"{solver.name}: 1e15 s and then 1e-15 s"
        yield refusal(what, SolveError, "durations | 1e-15 | rounding", solver.solve, lost)


@case(
    "A path of a thousand kilometres over pixels of micrometres.",
    "Refused at once: the error says how many steps, the most allowed and what to change.",
)
def too_many_steps(size):
    scene = program({"duration": TIME, "depth": DEPTH}, {"duration": 1.0, "speed": 1e6 * PACE})
    for solver in (line(size), space(size)):
        words = "steps on pixels | 1000000 | shorter path"
        yield refusal(f"{solver.name}: a path of 1000 km", (Refused, SolveError), words, solver.solve, scene)


@case("A program that presses in by less than a pixel can see.", "Refused: the error says so and what to do.")
def never_touching(size):
    scene = program({"duration": TIME, "depth": 1e-9 * DEPTH})
    in_3d, in_1d = space(size), line(size, extent=4 * RADIUS)
    yield refusal("BEM", EmptyContact, "nothing touches in the whole program | press", in_3d.solve, scene)
    yield refusal("MDR", SolveError, "pixels | take more points", in_1d.solve, scene)


@case(
    "Programs without stages, without load, of two quantities, backwards in time, below zero.",
    "Refused: each error names the field, the value and what is allowed.",
)
def no_programs(size):
    one, swing = {"duration": 1.0}, {"amplitude": 2.0, "frequency": 3.0}
    loaded, pressed = one | {"load": 1.0}, one | {"depth": 1.0}
    negative = "load | -1 | greater than or equal to 0"
    yield invalid("no stage", "stages | at least 1", program)
    yield invalid("pressed nowhere", "press nowhere", program, one)
    yield invalid("pressed by nothing", "press nowhere | above zero", program, one | {"load": 0.0})
    yield invalid("load, then depth", "load and depth | one and the same", program, loaded, pressed)
    yield invalid("a duration of 0", "duration | greater than 0", program, loaded | {"duration": 0.0})
    yield invalid("an oscillation into the air", "amplitude | 2 N | give less of it", program, loaded | swing)
    yield invalid("a pull", negative, program, loaded | {"load": -1.0})
    motion = Program(stages=(Stage(**loaded),))
    yield invalid("a plane under a load in time", "load | Plane | pressure", Scene, Plane(), SOLID, motion, ROUGH)
