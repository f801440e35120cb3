"""Long histories: marches without drift, separation and return, holds of ages."""

from dataclasses import replace

import numpy as np

from scene import Indent

from ....models.exact import indentation
from .hardcase import Check, Group, deviation
from .ordinary import (
    CONE,
    DEPTH,
    ELASTIC,
    KELVIN,
    LOAD,
    PACE,
    RADIUS,
    ROUGH,
    SOLID,
    SPHERE,
    TIME,
    program,
    resting,
    sliding,
    stage,
)
from .solvers import dense, line, space, square

PRESSED, LOADED = stage(TIME, depth=DEPTH), stage(TIME, load=LOAD)
CASES = case = Group("histories")


def _coarse(size, steps_1d, steps_3d):
    """Both solvers on grids on which long histories end."""
    return line(size, points=400, steps=steps_1d), space(size, points=24, steps=steps_3d)


def _balanced(what, answer):
    """Work is what was lost and what is stored, at every step."""
    work, lost, stored = (answer.fields[name] for name in ("work", "dissipated", "stored"))
    off = np.abs(work - lost - stored).max() / np.abs(work).max()
    return Check(f"{what}: balance of energy", off, 1e-10)


def _pull(what, answer):
    """No force is below zero, without any allowance."""
    return Check(f"{what}: pull", max(-answer.fields["normal_force"].min(), 0.0), 0.0)


@case(
    "Up to 1e5 steps of sliding: rounding and forgotten memory would add up.",
    "Forces of the last quarter are those before to 1e-4, of the ripple of pixels; friction is that of steady "
    "sliding within 0.02, of 400 points; work is energy lost and stored to 1e-10.",
)
def many_steps_1d(size):
    solver = line(size, points=400, extent=2.4 * RADIUS, steps=size.steps)
    path = size.steps / 400 * 2.4 * RADIUS
    answer = solver.solve(program(PRESSED, stage(path / PACE, speed=PACE)))
    yield Check("steps less those wanted, negative", size.steps - answer.measures["time_steps"], 0.0)
    half = len(answer.fields["time"]) // 2
    for name in ("normal_force", "friction_force"):
        late = answer.fields[name][half:]
        first, last = late[: len(late) // 4].mean(), late[-(len(late) // 4) :].mean()
        yield deviation(f"{name}: last quarter against one before", last, first, 1e-4)
    steady = solver.solve(sliding(1.0))
    yield deviation("friction against steady sliding", answer.friction_force, steady.friction_force, 0.02)
    yield _balanced("all steps", answer)


@case(
    "Thousands of steps on a small grid.",
    "Friction spreads by at most 0.02 in the last third and is that of steady sliding within 0.05, of 24 "
    "points; every step is solved to the tolerance.",
)
def many_steps_3d(size):
    points, pace = 24, 0.1
    solver = square(size, points=points, extent=3.2 * RADIUS, steps=size.march)
    path = size.march / points * 3.2 * RADIUS
    answer = solver.solve(program(PRESSED, stage(path / (pace * PACE), speed=pace * PACE)))
    friction = answer.fields["friction_force"][-(len(answer.fields["time"]) // 3) :]
    yield Check("friction in the last third: spread", np.ptp(friction) / friction.mean(), 0.02)
    steady = solver.solve(sliding(pace)).friction_force
    yield deviation("friction against steady sliding", friction[-1], steady, 0.05)
    yield Check("worst residual of all steps", answer.residual, solver.tolerance)


@case(
    "A load put on in a thousandth of the relaxation time and held for a billion of them.",
    "The indenter never rises, and ends at the relaxed depth: within 1e-4 in 1D and 0.02 in 3D, of the grids.",
)
def held_for_ages(size):
    for solver, allowed in zip(_coarse(size, size.steps // 4, 40), (1e-4, 0.02), strict=True):
        answer = solver.solve(program(stage(1e-3 * TIME, load=LOAD), stage(1e9 * TIME)))
        yield deviation(f"{solver.name}: depth at the end", answer.depth, DEPTH, allowed)
        sunk = -np.diff(answer.fields["depth"]).min() / DEPTH
        yield Check(f"{solver.name}: greatest rise of the indenter", sunk, 1e-6)


@case(
    "A load that rises, rests and rises again.",
    "Depth of Lee and Radok within 1e-3, as a load is met once a step.",
)
def load_up_hold_up(size):
    times, loads = (0.0, TIME, 3 * TIME, 4 * TIME), (0.0, LOAD, LOAD, 2 * LOAD)
    scene = program(LOADED, stage(2 * TIME), stage(TIME, load=2 * LOAD))
    fields = line(size, points=1000, steps=200).solve(scene).fields
    known = indentation.loading_depth(SPHERE, SOLID, times, loads, fields["time"][20::20])
    yield Check("1D: depth against Lee and Radok", np.abs(fields["depth"][20::20] / known - 1).max(), 1e-3)


@case(
    "Drawn back faster than the elastomer recovers: contact is lost before depth zero.",
    "Force of Lee, Radok and Ting at every step, within 1e-3 of the greatest in 1D and 0.1 in 3D, of 32 "
    "points and 60 steps; no pull; zero at the end.",
)
def drawn_out(size):
    times, depths, wide = (0.0, 2 * TIME, 4 * TIME), (0.0, DEPTH, 0.0), 4 * RADIUS
    in_1d = line(size, points=500, steps=100, extent=wide)
    in_3d = space(size, points=32, steps=60, extent=wide)
    for shape in (SPHERE, CONE):
        scene = program(stage(2 * TIME, depth=DEPTH), stage(2 * TIME, depth=0.0), indenter=shape)
        for solver, allowed in ((in_1d, 1e-3), (in_3d, 0.1)):
            answer, what = solver.solve(scene), f"{solver.name}, {type(shape).__name__}"
            yield Check(f"{what}: force at the end over the greatest", answer.normal_force / LOAD, 0.0)
            known, _ = indentation.force_of_depth(shape, SOLID, times, depths, answer.fields["time"])
            off = np.abs(answer.fields["normal_force"] - known).max() / known.max()
            yield Check(f"{what}: force against Lee, Radok and Ting", off, allowed)
            yield _pull(what, answer)


@case(
    "Pressed in, drawn out, and pressed in again into a surface that has or has not recovered.",
    "After 1000 relaxation times the force is that of the first time within 1e-3, what is left of it; after "
    "one it is less.",
)
def separation_and_return(size):
    rests = ((PRESSED, stage(TIME, depth=0.0), stage(rest, depth=0.0)) for rest in (1e3 * TIME, TIME))
    scenes = [program(*before, PRESSED) for before in ((), *rests)]
    for solver in _coarse(size, 20, 20):
        once, late, soon = (solver.solve(scene).normal_force for scene in scenes)
        yield deviation(f"{solver.name}: after a long rest", late, once, 1e-3)
        yield Check(f"{solver.name}: after a short one, over the first", soon / once, 1.0)


@case(
    "Without load nothing touches, or the indenter just rests on the surface.",
    "No force beyond 1e-9 of the load while there is none, and the load at the end within 0.03, half of the "
    "last step in 3D.",
)
def load_to_zero_and_back(size):
    for solver in _coarse(size, 100, 60):
        fields = solver.solve(program(LOADED, stage(TIME, load=0.0), stage(TIME), LOADED)).fields
        force, time = fields["normal_force"], fields["time"]
        away = (time > 2.05 * TIME) & (time < 2.95 * TIME)
        yield Check(f"{solver.name}: greatest force without load", np.abs(force[away]).max(), 1e-9 * LOAD)
        yield deviation(f"{solver.name}: force at the end", force[-1], LOAD, 0.03)


@case(
    "A rough body lifted to a fifth and pressed in again forty times, sliding half of the time.",
    "Work is energy lost and stored to 1e-10; lost energy never comes back; no pull.",
)
def forty_cycles(size):
    cycle = stage(TIME / 5, depth=DEPTH / 5, speed=PACE / 10), stage(TIME / 5, depth=DEPTH)
    scene = program(PRESSED, *cycle * 40, roughness=ROUGH)
    answer = line(size, points=500, extent=4 * RADIUS, steps=40).solve(scene)
    yield _balanced("80 stages", answer)
    lost = answer.fields["dissipated"]
    yield Check("greatest gain of lost energy", -np.diff(lost).min() / lost[-1], 1e-12)
    yield _pull("80 stages", answer)


@case(
    "Sliding that ends at once, and a rest of a thousand relaxation times.",
    "Friction falls to a hundredth of its greatest at least.",
)
def stop(size):
    for solver in _coarse(size, 200, 60):
        answer = solver.solve(program(PRESSED, stage(2 * TIME, speed=PACE), stage(1e3 * TIME)))
        friction = answer.fields["friction_force"]
        yield Check(f"{solver.name}: friction left, over the greatest", abs(friction[-1]) / friction.max(), 0.01)


@case(
    "An elastic solid in time has no modes to follow.",
    "No energy is lost, to 1e-12 of the work; force after all of it as at rest, within 1e-3 in 1D and 0.03 "
    "in 3D, of the sums over pixels.",
)
def elastic_march(size):
    smooth = program(PRESSED, stage(TIME, speed=PACE), stage(TIME, depth=DEPTH / 2), elastomer=ELASTIC)
    in_1d, in_3d = line(size, points=500, extent=4 * RADIUS), dense(size, steps=20)
    rough = in_1d.solve(replace(smooth, roughness=ROUGH)).fields
    yield Check("1D: energy lost over work", abs(rough["dissipated"]).max() / rough["work"].max(), 1e-12)
    for solver, allowed in ((in_1d, 1e-4), (in_3d, 1e-2)):
        last = solver.solve(smooth)
        still = solver.solve(resting(motion=Indent(depth=last.depth))).normal_force
        yield deviation(f"{solver.name}: force after all, against rest", last.normal_force, still, allowed)


@case(
    "A Kelvin body held after a ramp: its force jumps within a millionth of the relaxation time.",
    "Force at rest in the end, within 1e-4; work is energy lost and stored to 1e-10.",
)
def dashpot_march(size):
    scene = program(PRESSED, stage(1e-6 * TIME), stage(50 * TIME), elastomer=KELVIN)
    answer = line(size, points=1000, steps=200).solve(scene)
    still = line(size).solve(resting()).normal_force
    yield deviation("1D: force at the end", answer.normal_force, still, 1e-4)
    yield _balanced("1D", answer)
