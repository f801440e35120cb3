"""The result of a program: a window that holds all its contacts, the march, and the fields of the result."""

import time
from dataclasses import replace

from scene import EmptyContact, Plane, Result, Slide

from .. import window
from ..grid import Box, Grid
from ..measures import measured
from ..problem import Problem
from .marching import march


def marched(solver, scene, started) -> Result:
    """The answer of a solver to a scene whose motion is a Program; `started` is its processor time [s]."""
    program = scene.motion
    problem = Problem(replace(scene, motion=program.held), solver.engine, solver.terms)
    grid = _grid(solver, problem, program)
    window.check_waves(scene, grid, solver.extent)
    window.check_layer(scene, grid)
    history = march(problem, program, grid, solver.tolerance, solver.steps, solver.frames)
    _check(grid, history)
    points, (x, y) = grid.points * grid.rows, grid.centre
    seen = replace(grid, centre=(x + history.offset, y))
    return Result(
        scene=scene,
        solver=solver.name,
        settings=solver.settings(problem, grid) | {"steps": solver.steps},
        normal_force=float(history.normal_force[-1]),
        depth=float(history.depth[-1]),
        friction_force=float(history.friction_by_traction[-1]),
        residual=float(history.residual.max()),
        operator_applications=problem.work / points,
        seconds=time.process_time() - started,
        measures={
            **measured(problem, seen, history.pressure, history.gap),
            "friction_by_traction": float(history.friction_by_traction[-1]),
            "friction_by_work": float(history.friction_by_work[-1]),
            "rounds": float(history.rounds.sum()),
            "time_steps": float(len(history.time)),
            "transform_pairs": problem.transforms / points,
        },
        fields={
            "time": history.time,
            "path": history.path,
            "speed": history.speed,
            "depth": history.depth,
            "normal_force": history.normal_force,
            "friction_force": history.friction_by_traction,
            "friction_by_work": history.friction_by_work,
            "contact_area": history.contact_area,
            "x": seen.x,
            "y": seen.y,
            "height": problem.heights(seen, problem.surface(seen)),
            "pressure": history.pressure,
            "gap": history.gap,
            "surface_displacement": history.displacement,
            **_frames(history),
        },
    )


def _frames(history):
    """Frames of a history, with shifts from the place of the grid at the end."""
    if not history.frames:
        return {}
    return {**history.frames, "frame_shift": history.frames["frame_shift"] - history.offset}


def _check(grid, history):
    """Raise SolveError where nothing ever touches on the grid, or too few pixels do at the end."""
    if not history.contact_area.any():
        raise EmptyContact(
            f"nothing touches in the whole program on pixels of {grid.pixel:g} m; "
            "press deeper, or take more points"
        )
    touched = history.pressure > 0
    if touched.any():
        window.check_resolved(grid, touched)


def _grid(solver, problem, program):
    """Extent as stated, the period of a plane, or around all contacts that the program could hold for ever."""
    scene = problem.scene
    if isinstance(scene.indenter, Plane):
        return Grid(solver.points, scene.roughness.period, width=problem.width)
    if solver.extent is not None:
        return Grid(solver.points, solver.extent, width=problem.width)
    boxes = [_held(window.fitted(problem, solver.points).grid(solver.points, problem.width))]
    for speed in sorted({stage.speed for stage in program.stages} - {0.0}):
        sliding = Slide(speed=abs(speed), **{program.pressed_by: program.greatest})
        seen = Problem if speed > 0 else _Mirrored
        steady = seen(replace(scene, motion=sliding), solver.engine, solver.terms)
        box = _held(window.fitted(steady, solver.points).grid(solver.points, problem.width))
        boxes.append(box if speed > 0 else replace(box, left=-box.right, right=-box.left))
    all_of_them = boxes[0]
    for box in boxes[1:]:
        all_of_them = all_of_them.union(box)
    return Grid.around(all_of_them, solver.points, 1.0, problem.width)


class _Mirrored(Problem):
    """A scene with x reversed, so that sliding backwards becomes sliding forwards."""

    def heights(self, grid, surface, shift=0.0):
        x, y = grid.centre
        return super().heights(replace(grid, centre=(-x, y)), surface, -shift)[:, ::-1]


def _held(grid):
    """Box that a grid covers."""
    half = grid.extent / 2
    (x, y), across = grid.centre, half if grid.width is None else 0.0
    return Box(x - half, x + half, y - across, y + across)
