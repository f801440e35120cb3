"""A sphere that starts, changes its speed, swings, comes down at an angle and turns back: friction in 1D and 3D.

What has a closed form is held against it.
"""

from collections.abc import Mapping
from math import nan, pi

import numpy as np

from bem3d import BEM
from mdr1d import MDR
from scene import Kelvin, Plane, Program, Scene, Slide, Sphere, Stage, StandardLinearSolid, Wave
from scene.scales import elastic_contact

from ..figures import effect_motions
from ..outcome import Outcome
from ..references import motions as exact
from ..study import Task
from .chapter import Chapter, Rows
from .track import NEAR, Track, harmonic

NAME, TITLE = "motions", "Motions: start, steps of the speed, oscillation, oblique approach, reversal"
SOLVERS: Mapping[str, MDR | BEM] = {"1D": MDR(points=1000, steps=200), "3D": BEM(points=64, steps=60)}
SPHERE, SOLID = Sphere(radius=10e-3), StandardLinearSolid(1e6, 5e6, 1e-3)
LOAD = 1.0  # [N]
REST = elastic_contact(Scene(SPHERE, SOLID, Slide(speed=0.0, load=LOAD)))
CREEP = float(SOLID.retardation()[2][0])  # time in which it creeps [s]
A, SPEED = REST.radius, REST.radius / (2 * CREEP)
SWINGS = (0.1, 0.2, 0.4, 0.8)  # amplitudes over the load
PERIODS = 6  # each as long as the way of one contact radius
OMEGAS = (0.2, 1.0, 5.0)  # times the relaxation time
SMALL = 1e-3  # amplitude over the depth
KELVIN, APPROACH = Kelvin(1e6, 1e-3), 0.25  # speed of approach over that along the surface
WAVE = Wave(amplitude=1e-6, wavelength=1e-3)
FULL = 5e5  # mean pressure that closes the wave on the glass several times [Pa]
HOLD, WAY = 10 * CREEP, A / SPEED  # before anything slides, and for one contact radius [s]
TEXT = """A sphere of 10 mm under {load:g} N on a standard linear solid, glass over rubber {stiffening:g}, which
creeps in {creep:g} ms. Lengths are in units of the contact radius at rest, a = {a:.2f} mm; it slides at
{speed:.3g} m/s, half of a in that time. In one dimension {line} points, in three {space}². Friction is that of a
motion forwards: backwards one that opposes it is below zero.

{found}

What has a closed form is in the table: the force of a small oscillation of the depth about a contact at rest,
2 a E*(ω); friction of one wave in full contact while speed and direction change, at the worst of all steps; forces
of a sphere that comes down on a Kelvin foundation at an angle; the steady friction after four reversals."""
SAID = """In {dimension} friction comes within {near:.0%} of the steady {settled:.4f} F after {started:.2f} a from
rest, and of that of four times the speed after {faster:.2f} a more. After a reversal it is zero after {zero:.2f} a
and within {near:.0%} of minus the steady one after {turned:.2f} a; in a cycle of 8 a, {lost:.0f} µJ are lost. An
oscillation of the load by {third:.0%} lowers the mean friction by {less:.2%} and one by {fourth:.0%} by
{least:.2%}, as the power {exponent:.2f} of the three smaller amplitudes."""


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
    """Programs, steady sliding, and what has a closed form."""
    return [*_tracks().values(), *_steady().values(), *_checks().values()]


def chapter(outcomes: Mapping[Task, Outcome]) -> Chapter:
    """What friction does in each motion."""
    tracks = {key: Track.of(outcomes[task]) for key, task in _tracks().items()}
    steady = {key: outcomes[task].rows[0].friction_force for key, task in _steady().items()}
    rows = [*_curves(tracks, steady), *_means(tracks)]
    drawing = effect_motions.figure(rows)
    text = TEXT.format(
        load=LOAD,
        stiffening=SOLID.glassy_modulus / SOLID.rubbery_modulus,
        creep=CREEP * 1e3,
        a=A * 1e3,
        speed=SPEED,
        line=SOLVERS["1D"].points,
        space=SOLVERS["3D"].points,
        found="\n\n".join(_said(dimension, tracks, steady) for dimension in SOLVERS) + _failures(outcomes),
    )
    tables = {"Against closed forms": _table(outcomes, tracks, steady)}
    return Chapter(text, tables, {effect_motions.NAME: drawing}, {effect_motions.NAME: rows})


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


def _swung(omega):
    """A depth held until all has relaxed, then swinging, and when its last period begins [s]."""
    frequency = omega / (2 * pi) / SOLID.relaxation_time
    periods = 2 + int(2 * omega)
    stages = (
        Stage(duration=CREEP, depth=REST.depth),
        Stage(duration=20 * CREEP),
        Stage(duration=periods / frequency, amplitude=SMALL * REST.depth, frequency=frequency),
    )
    return Program(stages=stages), 21 * CREEP + (periods - 1) / frequency


def _changed():
    """A wave in full contact, set in motion, slowed down and turned back, and when it is set in motion [s]."""
    speed, length = WAVE.wavelength / (2 * pi * CREEP), WAVE.wavelength
    stages = [Stage(duration=CREEP, pressure=FULL), Stage(duration=40 * CREEP)]
    for way, pace in ((1.0, 3 * speed), (0.5, speed), (-1.6, 2 * speed)):
        stages.append(Stage(duration=abs(way) * length / pace, speed=float(np.copysign(pace, way))))
    return Program(stages=tuple(stages)), 41 * CREEP


def _checks():
    """What has a closed form, one task each."""
    small = {
        (dimension, omega): Task(solver, (Scene(SPHERE, SOLID, _swung(omega)[0]),), keeps_fields=True)
        for dimension, solver in SOLVERS.items()
        for omega in OMEGAS
    }
    down = Program(stages=(Stage(duration=REST.depth / (APPROACH * SPEED), depth=REST.depth, speed=SPEED),))
    oblique = Task(SOLVERS["1D"], (Scene(SPHERE, KELVIN, down),))
    wave = Task(BEM(points=128, steps=2000, tolerance=1e-8), (Scene(Plane(), SOLID, _changed()[0], WAVE),), True)
    return small | {"oblique": oblique, "wave": wave}


def _curves(tracks, steady) -> Rows:
    """Friction over the load against the way over a, which is also a period."""
    rows = []
    for (dimension, name), track in tracks.items():
        panel = name.split()[0]
        if panel == "oscillation" and name != f"oscillation {SWINGS[2]:g}":
            continue
        x = track.path / A - (5 if panel == "oscillation" else 0)
        chosen = track.time > (0.0 if panel == "oblique" else HOLD - CREEP)
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


def _said(dimension, tracks, steady):
    """What one dimensionality comes to."""
    settled, fast = steady[dimension, SPEED], steady[dimension, 4 * SPEED]
    start, steps, turning = (tracks[dimension, name] for name in ("start", "steps", "reversal"))
    back = turning.within(HOLD + 2 * WAY, HOLD + 6 * WAY)
    lowered = [_lowered(tracks, dimension, swing) for swing in SWINGS]
    return SAID.format(
        dimension=dimension,
        near=NEAR,
        settled=settled / LOAD,
        started=start.within(HOLD).until(settled) / A,
        faster=steps.within(HOLD + 6 * WAY, HOLD + 7.5 * WAY).until(fast) / A,
        zero=back.until_zero / A,
        turned=back.until(-settled) / A,
        lost=turning.within(HOLD + 10 * WAY).work * 1e6,
        third=SWINGS[2],
        less=lowered[2],
        fourth=SWINGS[3],
        least=lowered[3],
        exponent=np.polyfit(np.log(SWINGS[:3]), np.log(np.abs(lowered[:3])), 1)[0],
    )


def _failures(outcomes):
    """What has no numbers, with the reason."""
    reasons = [(task.label, outcomes[task].rows[0].reason) for task in tasks()]
    return "".join(f"\n\nNot solved: {label}: {reason}." for label, reason in reasons if reason is not None)


def _table(outcomes, tracks, steady) -> Rows:
    checks = _checks()
    rows = [
        row
        for dimension in SOLVERS
        for omega in OMEGAS
        for row in _stiffness(dimension, omega, outcomes[checks[dimension, omega]].fields)
    ]
    for dimension in SOLVERS:
        last = tracks[dimension, "reversal"].within(HOLD + 17 * WAY).mean
        known = steady[dimension, SPEED]
        rows.append(_row("friction after four reversals, mN", dimension, last * 1e3, known * 1e3))
    down = outcomes[checks["oblique"]].rows[0]
    forces = exact.oblique(SPHERE.radius, KELVIN, SPEED, APPROACH * SPEED, REST.depth / (APPROACH * SPEED))
    found = {"force": down.normal_force, "friction": down.friction_force}
    for (what, one), known in zip(found.items(), forces, strict=True):
        rows.append(_row(f"{what} of an oblique approach, mN", "1D", one * 1e3, known * 1e3))
    return [*rows, _wave_row(outcomes[checks["wave"]].fields)]


def _stiffness(dimension, omega, fields):
    """Magnitude and phase of the force of a small oscillation over the depth."""
    found, start = complex(nan), _swung(omega)[1]
    if fields:
        late = fields["time"] >= start * (1 - 1e-9)
        at = fields["time"][late] - start, fields["normal_force"][late]
        found = harmonic(*at, omega / SOLID.relaxation_time) / (SMALL * REST.depth)
    known = complex(exact.stiffness(A, SOLID, omega / SOLID.relaxation_time))
    what = f"stiffness at ω τ = {omega:g}"
    yield _row(f"{what}, N/mm", dimension, abs(found) * 1e-3, abs(known) * 1e-3)
    yield _row(f"{what}, phase", dimension, np.angle(found), np.angle(known))


def _wave_row(fields):
    """Friction of the wave where it is farthest from the closed form."""
    program, begin = _changed()
    worst = known = nan
    if fields:
        moving = fields["time"] > begin
        all_known = WAVE.period**2 * exact.wave_friction(
            WAVE.amplitude, WAVE.wavelength, SOLID, program, fields["time"][moving], begin
        )
        off = np.abs(fields["friction_force"][moving] - all_known)
        worst, known = fields["friction_force"][moving][off.argmax()], all_known[off.argmax()]
    return _row("friction of a wave in full contact where it is farthest off, µN", "3D", worst * 1e6, known * 1e6)


def _row(what, dimension, found, known):
    return {"": what, "in": dimension, "found": f"{found:.4g}", "closed form": f"{known:.4g}"}
