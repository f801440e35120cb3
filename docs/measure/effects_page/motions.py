"""A sphere that starts, changes its speed, swings, comes down at an angle and turns back, in 1D and 3D."""

from collections.abc import Mapping

import numpy as np

from bem3d import BEM
from compare.solving.outcome import Outcome
from compare.solving.task import SceneTask as Task
from compare.solving.task import Task as AnyTask
from mdr1d import MDR
from scene import Program, Scene, Slide, Sphere, Stage, StandardLinearSolid
from scene.scales import elastic_contact

from .chapter import Chapter, Rows
from .figures import motions as drawing
from .track import NEAR, Track

NAME = "motions"
SOLVERS: Mapping[str, MDR | BEM] = {"1D": MDR(points=1000, steps=200), "3D": BEM(points=64, steps=60)}
SPHERE, SOLID = Sphere(radius=10e-3), StandardLinearSolid(1e6, 5e6, 1e-3)
DRAWN = 500  # places of a curve, more or less
LOAD = 1.0  # [N]
REST = elastic_contact(Scene(SPHERE, SOLID, Slide(speed=0.0, load=LOAD)))
CREEP = float(SOLID.retardation()[2][0])  # time in which it creeps [s]
A, SPEED = REST.radius, REST.radius / (2 * CREEP)
SWINGS = (0.1, 0.2, 0.4, 0.8)  # amplitudes over the load
PERIODS = 6  # each as long as the way of one contact radius
HOLD, WAY = 10 * CREEP, A / SPEED  # before anything slides, and for one contact radius [s]


def slid(way: float, speed: float = SPEED, **given) -> Stage:
    """A stage of so many contact radii, backwards below zero."""
    return Stage(duration=abs(way) * A / speed, speed=float(np.copysign(speed, way)), **given)


def programs() -> dict[str, Program]:
    """By the panel of the figure, and of oscillations by their amplitude."""
    press = Stage(duration=2 * CREEP, load=LOAD), Stage(duration=8 * CREEP)
    found = {
        "start": Program(stages=(*press, slid(6))),
        "steps": Program(stages=(*press, slid(6), slid(6, 4 * SPEED), slid(6))),
        "oblique": Program(stages=(slid(3, load=LOAD), slid(5))),
        "reversal": Program(stages=(*press, slid(2), *(slid(way) for way in (-4, 4, -4, 4)))),
    }
    for swing in SWINGS:
        stage = slid(PERIODS, amplitude=swing * LOAD, frequency=SPEED / A)
        found[f"oscillation {swing:g}"] = Program(stages=(*press, slid(5), stage))
    return found


def tasks() -> list[Task]:
    """Programs, and steady sliding."""
    return [*_tracks().values(), *_steady().values()]


def chapter(outcomes: Mapping[AnyTask, Outcome]) -> Chapter:
    """What friction does in each motion."""
    tracks = {key: Track.of(outcomes[task]) for key, task in _tracks().items()}
    steady = {key: outcomes[task].rows[0].friction_force for key, task in _steady().items()}
    rows = [*_curves(tracks, steady), *_means(tracks)]
    figure = drawing.figure(rows)
    return Chapter({"Motions in numbers": _table(tracks, steady)}, {drawing.NAME: figure}, {drawing.NAME: rows})


def _tracks():
    return {
        (dimension, name): Task(solver, (Scene(SPHERE, SOLID, program),), keeps_fields=True, work=_work(solver))
        for dimension, solver in SOLVERS.items()
        for name, program in programs().items()
    }


def _steady():
    return {
        (dimension, speed): Task(solver, (Scene(SPHERE, SOLID, Slide(speed=speed, load=LOAD)),))
        for dimension, solver in SOLVERS.items()
        for speed in (SPEED, 4 * SPEED)
    }


def _work(solver):
    return solver.points / 10 if solver.name == "MDR" else solver.points**2


def _curves(tracks, steady) -> Rows:
    """Friction over the load against the way over a, which is also a period."""
    rows = []
    for (dimension, name), track in tracks.items():
        panel = name.split()[0]
        if panel == "oscillation" and name != f"oscillation {SWINGS[2]:g}":
            continue
        x = track.path / A - (5 if panel == "oscillation" else 0)
        chosen = np.flatnonzero(track.time > (0.0 if panel == "oblique" else HOLD - CREEP))
        chosen = chosen[:: max(1, len(chosen) // DRAWN)]
        for at, friction in zip(x[chosen], track.friction[chosen], strict=True):
            rows.append({"panel": panel, "dimension": dimension, "x": at, "y": friction / LOAD})
    for (dimension, speed), friction in steady.items():
        rows.append({"panel": "steady", "dimension": dimension, "x": speed / SPEED, "y": friction / LOAD})
    return rows


def _means(tracks) -> Rows:
    """Amplitude over the load, and by which share friction in the mean of the last two periods is lower for it."""
    return [
        {"panel": "mean", "dimension": dimension, "x": swing, "y": _lowered(tracks, dimension, swing)}
        for dimension in SOLVERS
        for swing in SWINGS
    ]


def _lowered(tracks, dimension, swing):
    """Against the end of the start, the same program without oscillation."""
    swung, plain = tracks[dimension, f"oscillation {swing:g}"], tracks[dimension, "start"]
    end = HOLD + (5 + PERIODS) * WAY
    return 1 - swung.within(end - 2 * WAY).mean / plain.within(HOLD + 5 * WAY).mean


def _table(tracks, steady) -> Rows:
    """A row a number, a column a dimensionality: ways over a, friction over the load."""
    columns = {dimension: _numbers(dimension, tracks, steady) for dimension in SOLVERS}
    return [{"": name} | {key: column[name] for key, column in columns.items()} for name in columns["1D"]]


def _numbers(dimension, tracks, steady) -> dict[str, str]:
    settled, fast = steady[dimension, SPEED], steady[dimension, 4 * SPEED]
    start, steps, turning = (tracks[dimension, name] for name in ("start", "steps", "reversal"))
    back = turning.within(HOLD + 2 * WAY, HOLD + 6 * WAY)
    lowered = [_lowered(tracks, dimension, swing) for swing in SWINGS]
    power = np.polyfit(np.log(SWINGS[:3]), np.log(np.abs(lowered[:3])), 1)[0]
    return {
        "steady friction": f"{settled / LOAD:.4f}",
        f"within {NEAR:.0%} of it from rest after": f"{start.within(HOLD).until(settled) / A:.2f} a",
        "at four times the speed after another": (
            f"{steps.within(HOLD + 6 * WAY, HOLD + 7.5 * WAY).until(fast) / A:.2f} a"
        ),
        "zero after a reversal after": f"{back.until_zero / A:.2f} a",
        f"within {NEAR:.0%} of minus the steady one after": f"{back.until(-settled) / A:.2f} a",
        "lost in a cycle of 8 a": f"{turning.within(HOLD + 10 * WAY).work * 1e6:.0f} µJ",
        f"mean friction lower by a load that swings by {SWINGS[2]:.0%}": f"{lowered[2]:.2%}",
        f"by {SWINGS[3]:.0%}": f"{lowered[3]:.2%}",
        "power of the three smaller amplitudes": f"{power:.2f}",
    }
