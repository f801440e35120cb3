"""Sections of docs/results/accuracy.md on the 3D solver: lines, cells and histories against closed forms."""

from math import inf, sqrt

import numpy as np
from tables import order, table

from bem3d import BEM
from bem3d.surface import RoughSurface
from compare.models.exact import full_contact, indentation, line_contact, waves
from scene import (
    Cone,
    CrossedWaves,
    Cylinder,
    Elastic,
    Indent,
    Kelvin,
    Plane,
    Program,
    Scene,
    SelfAffine,
    Slide,
    Sphere,
    Stage,
    StandardLinearSolid,
    Wave,
)

G, R, TAU = 1e6, 10e-3, 1e-3
LOAD = 10.0  # per metre of a line


def solid(stiffening: float):
    """Relaxed modulus G, glassy 1 + stiffening times that, retardation time TAU."""
    if stiffening == inf:
        return Kelvin(G, TAU)
    return StandardLinearSolid(G, G * (1 + stiffening), TAU / (1 + stiffening))


def lines() -> str:
    """Friction of a sliding cylinder."""
    grids = (32, 64, 128, 256, 512, 1024)
    rest, _ = line_contact.hertz(R, 4 * G, LOAD)

    def rows():
        for stiffening in (1.0, 9.0, 1e6, inf):
            for ratio in (1e-2, 0.1, 1.0, 10.0, 1e3):
                speed = ratio * rest / TAU
                exact = line_contact.sliding(R, 4 * G, 4 * G * (1 + stiffening), TAU, speed, LOAD)
                scene = Scene(Cylinder(R), solid(stiffening), Slide(speed=speed, line_load=LOAD))
                found = [BEM(points=n).solve(scene).friction_coefficient for n in grids]
                errors = [abs(mu / exact.friction_coefficient - 1) for mu in found]
                name = "Kelvin" if stiffening == inf else f"{1 + stiffening:g}"
                shown = (f"{error:.1e}" for error in errors[1::2])
                yield name, f"{ratio:g}", *shown, f"{order(grids, errors):.1f}"

    return table("E_g/E_r|v τ_c/a|64 points|256 points|1024 points|observed order", rows())


def stored_pressures() -> str:
    """Peak pressures of a published program."""
    elastomer = StandardLinearSolid(1905e6 / 8, 1905e6 / 4, TAU / 2)

    def rows():
        for memory, peak in ((0.0, 60.32), (9e-3, 78.74), (45e-3, 84.72), (2.0, 85.31)):
            scene = Scene(Cylinder(50e-3), elastomer, Slide(speed=memory / TAU, line_load=600e3))
            found = BEM(points=512).solve(scene).fields["pressure"].max() / 1e6
            yield f"{memory * 1e3:g}", f"{peak:.2f}", f"{found:.2f}"

    return table("v τ_c, mm|published, MPa|found, MPa", rows())


def plane_waves() -> str:
    """Westergaard's wave: contact, mean gap and pressure."""
    wave, grids = Wave(amplitude=1e-5, wavelength=1e-3), (64, 128, 256, 512, 1024, 2048)
    closure = waves.wave_closure(4 * G, wave.amplitude, wave.wavelength)

    def rows():
        for fraction in (0.1, 0.5, 0.9):
            scene = Scene(Plane(), Elastic(G), Indent(pressure=fraction * closure), wave)
            gaps, pressures = [], []
            for n in grids:
                result = BEM(points=n, tolerance=1e-8).solve(scene)
                gaps.append(abs(result.measures["mean_gap"] / wave.amplitude - waves.wave_mean_gap(fraction)))
                phase = np.pi * (result.fields["x"] / wave.wavelength + 0.5)
                error = result.fields["pressure"][0] / (fraction * closure) - waves.wave_pressure(fraction, phase)
                pressures.append(np.abs(error).mean())
            for name, errors in (("mean gap over h₀", gaps), ("pressure over its mean, mean error", pressures)):
                shown = (f"{error:.1e}" for error in errors[1::2])
                yield f"{fraction:g}", name, *shown, f"{order(grids, errors):.1f}"

    return table("p/p*|what|128 points|512 points|2048 points|observed order", rows())


def crossed_waves() -> str:
    """Contact fraction of crossed waves."""
    crossed = CrossedWaves(amplitude=1e-5, wavelength=1e-3)
    closure = waves.crossed_closure(4 * G, crossed.amplitude, crossed.wavelength)

    def rows():
        for fraction, published in waves.CROSSED_FRACTIONS.items():
            scene = Scene(Plane(), Elastic(G), Indent(pressure=fraction * closure), crossed)
            yield (
                f"{fraction:g}",
                f"{published:.4f}",
                *(f"{BEM(points=n).solve(scene).measures['contact_fraction']:.4f}" for n in (128, 512, 1024)),
            )

    return table("p/p*|published, 512 points|128 points|512 points|1024 points", rows())


def full() -> str:
    """Friction in full contact of one wave and of a rough plane."""
    wave = Wave(amplitude=1e-5, wavelength=1e-3)
    rough = SelfAffine(hurst=0.8, rms_height=2e-6, longest=1e-3, shortest=1e-3 / 16, seed=1)
    sides, along = (rough.longest, rough.longest), (np.arange(64) - 31.5) * rough.longest / 64
    heights = RoughSurface.of(rough, rough.q_max(0.0)).heights(along, along)

    def rows():
        for name, elastomer in (("Kelvin", solid(inf)), ("E_g/E_r = 1000", solid(999.0))):
            for speed in (1e-3, 0.1, 10.0):
                needed = np.abs(full_contact.pressure(heights, sides, elastomer, speed)).max()
                pressure = 1.2 * max(needed, full_contact.wave_closure(1e-5, 1e-3, elastomer, speed))
                one = full_contact.wave_friction(wave.amplitude, wave.wavelength, elastomer, speed)
                many = full_contact.friction(heights, sides, elastomer, speed)
                errors = []
                for roughness, expected in ((wave, one), (rough, many)):
                    scene = Scene(Plane(), elastomer, Slide(speed=speed, pressure=pressure), roughness)
                    result = BEM(points=64, tolerance=1e-11).solve(scene)
                    errors.append(abs(result.friction_force / (expected * roughness.period**2) - 1))
                yield name, f"{speed:g}", *(f"{error:.1e}" for error in errors)

    return table("solid|speed, m/s|one wave|rough plane", rows())


def indentations() -> str:
    """Force of a sphere and a cone pressed in and drawn back at a constant rate."""
    elastomer, times, depths = StandardLinearSolid(0.25, 1.25, 1.0), [0.0, 2.0, 4.0], [0.0, 0.2, 0.0]
    program = Program(stages=(Stage(duration=2.0, depth=0.2), Stage(duration=2.0, depth=0.0)))

    def rows():
        for shape, extent in ((Sphere(1.0), 1.5), (Cone(np.pi / 4), 0.4)):
            for points, steps in ((64, 40), (128, 80), (256, 160)):
                solver = BEM(points=points, extent=extent, steps=steps)
                fields = solver.solve(Scene(shape, elastomer, program)).fields
                errors = []
                for t in (1.0, 1.9, 2.2, 2.5):
                    found = np.interp(t, fields["time"], fields["normal_force"])
                    exact, _ = indentation.force_of_depth(shape, elastomer, times, depths, np.array([t]))
                    errors.append(f"{float(found / exact[0] - 1):+.2%}")
                yield shape.type, f"{points}", f"{steps}", *errors

    return table("shape|points|steps|t = 1, loading|1.9|2.2, unloading|2.5", rows())


def marched() -> str:
    """A sphere marched from rest into steady sliding, against the steady solver."""
    depth = 1e-4
    radius = sqrt(R * depth)

    def rows():
        for name, elastomer in (("E_g/E_r = 10", solid(9.0)), ("Kelvin", solid(inf))):
            for ratio in (0.1, 1.0, 10.0):
                speed = ratio * radius / TAU
                path = 4 * radius + 12 * ratio * radius
                program = Program(
                    stages=(Stage(duration=TAU, depth=depth), Stage(duration=path / speed, speed=speed))
                )
                found = []
                for n in (32, 64):
                    solver = BEM(points=n, extent=3.2 * radius, steps=10)
                    steady = solver.solve(Scene(Sphere(R), elastomer, Slide(speed=speed, depth=depth)))
                    march = solver.solve(Scene(Sphere(R), elastomer, program))
                    found += [
                        f"{march.normal_force / steady.normal_force - 1:+.3%}",
                        f"{march.friction_coefficient / steady.friction_coefficient - 1:+.2%}",
                    ]
                yield name, f"{ratio:g}", *found

    return table("solid|v τ_c/a|force, 32 points|μ|force, 64 points|μ", rows())


SECTIONS = {
    "Line contacts": (
        "A cylinder against Hunter's closed form (1961): relative error of the friction coefficient, by points "
        "across the window, some 0.87 of it in contact. a is the half-width at rest.",
        lines,
    ),
    "Peak pressures of a line contact": (
        "A published program's case: combined radius 50 mm, E_g = 1905 MPa, E_g/E_r = 2, 600 N/mm; 512 points.",
        stored_pressures,
    ),
    "A wave pressed flat": ("Westergaard's closed form (1939), at rest, on one row.", plane_waves),
    "Crossed waves pressed flat": ("Contact fraction against published numbers of another code.", crossed_waves),
    "Full contact": (
        "Relative error of the friction force of a plane that touches everywhere, against the sum of the loss "
        "modulus over its waves; 64 points.",
        full,
    ),
    "Indentation in time": (
        "Pressed in at a constant rate for 2 s and drawn back, standard linear solid, E_g/E_r = 5, relaxing in "
        "1 s: force against Lee and Radok while loading, Ting while unloading.",
        indentations,
    ),
    "Marching into steady sliding": (
        "A sphere at the depth a²/R, started from rest and slid until the start is forgotten, against the steady "
        "solver on the same grid: relative differences, which neither solver's own error need share.",
        marched,
    ),
}
