"""The result of a program: a grid that holds all its contacts, the march, and the fields of the result."""

from dataclasses import replace
from time import process_time

import numpy as np

from scene import EmptyContact, Result, Scene

from .marching import History, march
from .modes import modes_of
from .profile import check_resolved, drawn_closer, lay_out, map_profile


def marched(solver, scene: Scene, reduced: Scene, started: float) -> Result:
    """The answer of a solver to a scene whose motion is a Program.

    reduced : the scene whose mapped profile is the line asked for
    started : processor time [s]
    """
    layout, body, history, marches = _followed(solver, reduced)
    program, modulus = scene.motion, scene.solid.indentation_modulus
    by_load = program.pressed_by == "load"
    force = program.prescribed(history.time) if by_load else modulus * history.force
    friction = modulus * history.friction
    return Result(
        scene=scene,
        solver=solver.name,
        settings=solver.settings(scene, layout) | {"steps": solver.steps},
        normal_force=float(force[-1]),
        depth=float(history.depth[-1]),
        friction_force=float(friction[-1]),
        residual=modulus * history.misfit / program.greatest if by_load else 0.0,
        operator_applications=marches * len(history.time),
        seconds=process_time() - started,
        measures=_measures(scene, body, history),
        fields={
            "time": history.time,
            "path": history.path,
            "speed": history.speed,
            "depth": history.depth,
            "normal_force": force,
            "friction_force": friction,
            "contact_length": history.length,
            "work": modulus * history.work,
            "dissipated": modulus * history.dissipated,
            "stored": modulus * history.stored,
            "x": history.x,
            "profile": history.heights,
            "displacement": history.displacement,
            "contact": history.touching,
            **history.frames,
        },
    )


def at_greatest(scene: Scene) -> Scene:
    """The scene with its program's greatest load or depth held for ever: no contact of the program is larger."""
    return replace(scene, motion=scene.motion.held)


def _followed(solver, scene):
    """The march, on a grid drawn closer around the tip while viscosity keeps a smooth contact small."""
    held, extent, marches = at_greatest(scene), solver.extent, 0
    modes, modulus = modes_of(scene.solid), scene.solid.indentation_modulus
    while True:
        layout = lay_out(held, solver.points, extent, solver.spectrum)
        body = map_profile(held, layout, solver.spectrum)
        history = march(scene.motion, body, modes, modulus, solver.steps, solver.frames)
        marches += 1
        free = solver.extent is None and scene.roughness is None and history.reach > 0
        extent = drawn_closer(layout, 2 * history.reach, history.reach) if free else None
        if extent is None:
            _check_touched(body, history)
            return layout, body, history, marches


def _check_touched(body, history: History):
    """Raise EmptyContact where nothing ever touches, SolveError where contact has too few pixels, rough or not."""
    widest = history.length.max()
    if not widest > 0:
        raise EmptyContact(
            f"nothing touches in the whole program: the lowest point lies at {body.lowest:g} m above the "
            "macroscopic tip; press deeper"
        )
    check_resolved(body, widest)
    # On the way a contact may have a few pixels, as on first touch, and its forces are a guess; the friction that
    # is left at the end is an answer.
    if history.touching.any() and history.speed[-1] != 0:
        check_resolved(body, history.length[-1])


def _measures(scene, body, history: History):
    """Measures of the contact at the end; NaN where nothing touches."""
    touching = np.flatnonzero(history.touching)
    span = float(np.ptp(touching)) + 1 if len(touching) else np.nan
    elastomer, length = scene.solid, float(history.length[-1])
    firmness = 2 * elastomer.glassy_modulus / (1 - elastomer.poisson_ratio)
    return {
        "pixel": body.pixel,
        "contact_length": length,
        "contact_fraction": len(touching) / span,
        "points_across_contact": span,
        "stiffness": firmness * length if length else 0.0,
        "time_steps": float(len(history.time)),
    }
