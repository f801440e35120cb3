"""A sphere that starts, changes its speed, swings, comes down at an angle and turns back: friction in 1D and 3D.

What has a closed form is held against it.
"""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from math import nan, pi

import numpy as np

from bem3d import BEM
from compare.solving.outcome import Outcome
from compare.solving.task import SceneTask as Task
from compare.solving.task import Task as AnyTask
from mdr1d import MDR
from scene import Kelvin, Plane, Program, Scene, Slide, Sphere, Stage, StandardLinearSolid, Wave
from scene.scales import elastic_contact

from . import closed_forms as exact
from .chapter import Chapter, Rows
from .figures import motions as drawing
from .track import NEAR, Track, harmonic

NAME, TITLE = "motions", "Motions: start, steps of the speed, oscillation, oblique approach, reversal"
SOLVERS: Mapping[str, MDR | BEM] = {"1D": MDR(points=1000, steps=200), "3D": BEM(points=64, steps=60)}
SPHERE, SOLID = Sphere(radius=10e-3), StandardLinearSolid(1e6, 5e6, 1e-3)
DRAWN = 500  # places of a curve, more or less
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

The table has the closed forms: the force of a small oscillation of the depth about a contact at rest,
2 a E*(ω); friction of one wave in full contact while speed and direction change, at the worst of all steps; forces
of a sphere that comes down on a Kelvin foundation at an angle; the steady friction after four reversals. All is
solved with half the points, too: what that changes is of the size of the error that is left, and no bound on it,
as the edge of the contact lies anywhere in its pixel. Friction of the oblique approach is the mean over the last
pixel that was slid, half a pixel late, while it still grows: its error is of the first order in the pixel."""
SAID = """In {dimension} friction comes within {near:.0%} of the steady {settled:.4f} F after {started:.2f} a from
rest, and of that of four times the speed after {faster:.2f} a more. After a reversal it is zero after {zero:.2f} a
and within {near:.0%} of minus the steady one after {turned:.2f} a; in a cycle of 8 a, {lost:.0f} µJ are lost. An
oscillation of the load by {third:.0%} lowers the mean friction by {less:.2%} and one by {fourth:.0%} by
{least:.2%}, as the power {exponent:.2f} of the three smaller amplitudes. With half the points these ways change by
{off_ways:.1g} a at most, friction by {off_friction:.1g} %, the work lost by {off_lost:.1g} %, and what an
oscillation takes from friction by {off_lowered:.1g} % of it."""
WHOLE, HALF = 1, 2  # by what the points of a solver are divided


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
    """Programs, steady sliding, and what has a closed form, with all points and with half of them."""
    kinds = (kind(by) for by in (WHOLE, HALF) for kind in (_tracks, _steady, _checks))
    return [task for kind in kinds for task in kind.values()]


def chapter(outcomes: Mapping[AnyTask, Outcome]) -> Chapter:
    """What friction does in each motion."""
    every = {by: _answered(outcomes, by) for by in (WHOLE, HALF)}
    tracks, steady = every[WHOLE]
    rows = [*_curves(tracks, steady), *_means(tracks)]
    figure = drawing.figure(rows)
    text = TEXT.format(
        load=LOAD,
        stiffening=SOLID.glassy_modulus / SOLID.rubbery_modulus,
        creep=CREEP * 1e3,
        a=A * 1e3,
        speed=SPEED,
        line=SOLVERS["1D"].points,
        space=SOLVERS["3D"].points,
        found="\n\n".join(_said(dimension, every) for dimension in SOLVERS) + _failures(outcomes),
    )
    tables = {"Against closed forms": _table(outcomes, every)}
    return Chapter(text, tables, {drawing.NAME: figure}, {drawing.NAME: rows})


def _solvers(by):
    return {dimension: replace(solver, points=solver.points // by) for dimension, solver in SOLVERS.items()}


def _tracks(by):
    return {
        (dimension, name): Task(solver, (Scene(SPHERE, SOLID, program),), keeps_fields=True, work=_work(solver))
        for dimension, solver in _solvers(by).items()
        for name, program in programs().items()
    }


def _steady(by):
    return {
        (dimension, speed): Task(solver, (Scene(SPHERE, SOLID, Slide(speed=speed, load=LOAD)),))
        for dimension, solver in _solvers(by).items()
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


def _answered(outcomes, by):
    """Tracks of all programs, and steady friction [N]."""
    tracks = {key: Track.of(outcomes[task]) for key, task in _tracks(by).items()}
    return tracks, {key: outcomes[task].rows[0].friction_force for key, task in _steady(by).items()}


def _checks(by):
    """What has a closed form, one task each."""
    solvers = _solvers(by)
    small = {
        (dimension, omega): Task(solver, (Scene(SPHERE, SOLID, _swung(omega)[0]),), keeps_fields=True)
        for dimension, solver in solvers.items()
        for omega in OMEGAS
    }
    down = Program(stages=(Stage(duration=REST.depth / (APPROACH * SPEED), depth=REST.depth, speed=SPEED),))
    oblique = Task(solvers["1D"], (Scene(SPHERE, KELVIN, down),))
    fine = BEM(points=128 // by, steps=2000, tolerance=1e-8)
    wave = Task(fine, (Scene(Plane(), SOLID, _changed()[0], WAVE),), keeps_fields=True)
    return small | {"oblique": oblique, "wave": wave}


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


def _said(dimension, every):
    """What one dimensionality comes to."""
    numbers, coarse = (_numbers(dimension, *every[by]) for by in (WHOLE, HALF))

    def change(*names):
        """With half the points, the largest; a number that is not known makes it unknown."""
        return np.max(np.abs([coarse[name] - numbers[name] for name in names]))

    def percent(*names):
        return 100 * np.max(np.abs([coarse[name] / numbers[name] - 1 for name in names]))

    return SAID.format(
        dimension=dimension,
        near=NEAR,
        third=SWINGS[2],
        fourth=SWINGS[3],
        **numbers,
        off_ways=change("started", "faster", "zero", "turned"),
        off_friction=percent("settled"),
        off_lost=percent("lost"),
        off_lowered=percent("less", "least"),
    )


def _numbers(dimension, tracks, steady):
    """By the name that the text has for them: friction over the load, ways over a, work [µJ], shares, a power."""
    settled, fast = steady[dimension, SPEED], steady[dimension, 4 * SPEED]
    start, steps, turning = (tracks[dimension, name] for name in ("start", "steps", "reversal"))
    back = turning.within(HOLD + 2 * WAY, HOLD + 6 * WAY)
    lowered = [_lowered(tracks, dimension, swing) for swing in SWINGS]
    return {
        "settled": settled / LOAD,
        "started": start.within(HOLD).until(settled) / A,
        "faster": steps.within(HOLD + 6 * WAY, HOLD + 7.5 * WAY).until(fast) / A,
        "zero": back.until_zero / A,
        "turned": back.until(-settled) / A,
        "lost": turning.within(HOLD + 10 * WAY).work * 1e6,
        "less": lowered[2],
        "least": lowered[3],
        "exponent": np.polyfit(np.log(SWINGS[:3]), np.log(np.abs(lowered[:3])), 1)[0],
    }


def _failures(outcomes):
    """What has no numbers, with the reason."""
    reasons = [(task.label, outcomes[task].rows[0].reason) for task in tasks()]
    return "".join(f"\n\nNot solved: {label}: {reason}." for label, reason in reasons if reason is not None)


def _table(outcomes, every) -> Rows:
    whole, half = (list(_closed(outcomes, by, *every[by])) for by in (WHOLE, HALF))
    return [
        {
            "": what,
            "in": dimension,
            "found": f"{found:.4g}",
            "with half the points": f"{coarse:.4g}",
            "closed form": f"{known:.4g}",
        }
        for (what, dimension, found, known), (_, _, coarse, _) in zip(whole, half, strict=True)
    ]


def _closed(outcomes, by, tracks, steady) -> Iterator[tuple[str, str, float, float]]:
    """What, in which dimensionality, as found and in closed form."""
    checks = _checks(by)
    for dimension in SOLVERS:
        for omega in OMEGAS:
            yield from _stiffness(dimension, omega, outcomes[checks[dimension, omega]].fields)
    for dimension in SOLVERS:
        last = tracks[dimension, "reversal"].within(HOLD + 17 * WAY).mean
        yield "friction after four reversals, mN", dimension, last * 1e3, steady[dimension, SPEED] * 1e3
    down = outcomes[checks["oblique"]].rows[0]
    force, friction = exact.oblique(
        SPHERE.radius, KELVIN, SPEED, APPROACH * SPEED, REST.depth / (APPROACH * SPEED)
    )
    yield "force of an oblique approach, mN", "1D", down.normal_force * 1e3, force * 1e3
    yield (
        "friction of an oblique approach, over the last pixel, mN",
        "1D",
        down.friction_force * 1e3,
        friction * 1e3,
    )
    worst, known = _farthest(outcomes[checks["wave"]].fields)
    yield "friction of a wave in full contact where it is farthest off, µN", "3D", worst * 1e6, known * 1e6


def _stiffness(dimension, omega, fields):
    """Magnitude and phase of the force of a small oscillation over the depth."""
    found, start = complex(nan), _swung(omega)[1]
    if fields:
        late = fields["time"] >= start * (1 - 1e-9)
        at = fields["time"][late] - start, fields["normal_force"][late]
        found = harmonic(*at, omega / SOLID.relaxation_time) / (SMALL * REST.depth)
    known = complex(exact.stiffness(A, SOLID, omega / SOLID.relaxation_time))
    what = f"stiffness at ω τ = {omega:g}"
    yield f"{what}, N/mm", dimension, abs(found) * 1e-3, abs(known) * 1e-3
    yield f"{what}, phase", dimension, np.angle(found), np.angle(known)


def _farthest(fields):
    """Friction of the wave where it is farthest from the closed form, and that [N]."""
    program, begin = _changed()
    if not fields:
        return nan, nan
    moving = fields["time"] > begin
    known = WAVE.period**2 * exact.wave_friction(
        WAVE.amplitude, WAVE.wavelength, SOLID, program, fields["time"][moving], begin
    )
    found = fields["friction_force"][moving]
    worst = np.abs(found - known).argmax()
    return found[worst], known[worst]
