"""Odd and prime grids, the smallest ones, single rows, and grids that do not exist."""

from dataclasses import replace
from functools import partial
from math import sqrt

import numpy as np

from bem3d import BEM
from mdr1d import MDR
from scene import CrossedWaves, Cylinder, Indent, Plane, Scene, SelfAffine, Slide, Wave
from scene.scales import elastic_contact

from ....models.exact import full_contact, line_contact, waves
from .hardcase import Check, Group, deviation, invalid
from .laws import asked, energy_is_lost, equal, in_contact, refused
from .matrix import Matrix, conditions, solved
from .ordinary import CONE, DEPTH, ELASTIC, KELVIN, LOAD, PACE, RADIUS, ROUGH, SOLID, SPHERE, resting, sliding
from .solvers import TOLERANCE, line, row, space, square

PERIOD = SelfAffine(hurst=0.8, rms_height=1e-6, longest=1e-3, shortest=2.5e-4, seed=2)
CASES = case = Group("grids")


def _cone(depth):
    """A cone at rest at a depth, and its force, exact in 1D."""
    force = 2 / np.pi * ELASTIC.indentation_modulus * depth**2 / CONE.coefficient
    return resting(indenter=CONE, motion=Indent(depth=depth)), {"normal_force": force}


def _grids(build, *points, **settings):
    """A solver on several grids."""
    return [partial(build, points=each, **settings) for each in points]


def _wavy(pressure, rough):
    return Scene(Plane(), SOLID, Slide(speed=PACE, pressure=pressure), rough)


class _WithRow(Matrix):
    """A matrix that is asked for single columns too."""

    def __init__(self, matrix):
        self.values, self.shape, self.symmetric = matrix.values, matrix.shape, matrix.symmetric


case.add(
    "prime-squares",
    "Squares of 17, 31 and 47 points, which no transform divides.",
    "Conditions of contact, computed anew, within twice the tolerance.",
    in_contact({"": resting(), "rough": sliding(1.0, KELVIN, roughness=ROUGH)}, *_grids(space, 17, 31, 47)),
)


@case(
    "One point more or less puts the indenter's tip between pixels or on one.",
    "Forces of three successive grids lie within 8/N^1.5: the edge of contact moves by parts of a pixel.",
)
def odd_next_to_even(size):
    even = size.square
    forces = [space(size, points=points).solve(sliding(1.0)).normal_force for points in range(even - 1, even + 2)]
    yield Check("force of three successive grids: spread", np.ptp(forces) / forces[1], 8 / even**1.5)


case.add(
    "prime-periods",
    "A surface that repeats on 17, 31 and 47 points, where no wave stands at the Nyquist wave number.",
    "Conditions of contact, computed anew wave by wave, within twice the tolerance.",
    in_contact(
        {f"p/E* = {part:g}": _wavy(part * SOLID.indentation_modulus, PERIOD) for part in (1e-3, 1.0)},
        *_grids(square, 17, 18, 31, 47, tolerance=TOLERANCE),
    ),
)


@case("Full contact on 17 and 31 points.", "Friction of the closed form within 10/N^2.")
def prime_periods_in_full_contact(size):
    pressure = 3 * full_contact.crossed_closure(1e-6, 1e-3, SOLID, PACE)
    scene = _wavy(pressure, CrossedWaves(amplitude=1e-6, wavelength=1e-3))
    friction = full_contact.crossed_friction(1e-6, 1e-3, SOLID, PACE) * 1e-6
    for build in _grids(square, 17, 31, 32, tolerance=TOLERANCE):
        # Heights are seen behind the pixels' centres, where pressure lags by as much.
        allowed = 10 / build(size).points ** 2
        yield from equal((scene, {"friction_force": friction}), allowed, build)(size)


@case(
    "A line contact on single rows of 17 and 31 points; squares are the only other shape of a grid.",
    "Hertz's half-width to a pixel, depth to 4/N^1.5 of itself; the answer has one row.",
)
def prime_rows(size):
    half_width, _ = line_contact.hertz(SPHERE.radius, ELASTIC.indentation_modulus, LOAD / RADIUS)
    scene = Scene(Cylinder(SPHERE.radius), ELASTIC, Indent(line_load=LOAD / RADIUS))
    for points in (17, 31, size.row - 1, size.row):
        answer = row(size, points=points).solve(scene)
        found = answer.measures["contact_area"] / 2 - half_width
        yield Check(f"{points} points: half-width, in pixels", abs(found) / answer.measures["pixel"], 1.0)
        depth = answer.depth - elastic_contact(scene).depth
        yield Check(f"{points} points: depth, relative", abs(depth / answer.depth), 4 / points**1.5)
        yield Check(f"{points} points: rows of the answer", abs(answer.fields["pressure"].shape[0] - 1.0), 0.0)


@case(
    "A plane with one wave is alike along y and is solved on one row, of 61, 63 and 64 points.",
    "Westergaard's contact fraction to two pixels, of the two edges.",
)
def one_wave_on_a_row(size):
    wave = Wave(amplitude=1e-5, wavelength=1e-3)
    closure = waves.wave_closure(ELASTIC.indentation_modulus, 1e-5, 1e-3)
    for points in (63, 64, 61):
        answer = row(size, points=points).solve(Scene(Plane(), ELASTIC, Indent(pressure=0.5 * closure), wave))
        apart = answer.measures["contact_fraction"] - waves.wave_contact_fraction(0.5)
        yield Check(f"{points} points: contact fraction, in pixels", abs(apart) * points, 2.0)


@case(
    "Rectangles of 3 x 40 to 40 x 3 points and a row of 60, at rest and in a flow.",
    "Conditions of contact by a plain product to 1e-9.",
)
def oblong_problems(size):
    for ny, nx in ((3, 40), (40, 3), (7, 13), (1, 60)):
        heights = np.random.default_rng(ny).standard_normal((ny, nx))
        for memory in (0.0, 4.0):
            matrix = Matrix(ny, nx, memory)
            found = solved(_WithRow(matrix) if ny == 1 and memory else matrix, heights, load=3.0)
            yield from conditions(matrix, heights, found, f"{ny} x {nx}, memory {memory:g}")


@case(
    "16 points a side in 3D, 8 on a line in 1D, and one less.",
    "Conditions of contact, computed anew; a cone exact to 1e-12; one point less is refused by name and number.",
)
def smallest_grids(size):
    yield from in_contact(sliding(1.0), *_grids(space, 16, extent=2.4 * RADIUS))(size)
    yield from equal(_cone(RADIUS / 4), 1e-12, *_grids(line, 8, extent=2.4 * RADIUS))(size)
    yield invalid("BEM: 15 points", "points | 15 | 16", BEM, points=15)
    yield invalid("MDR: 7 points", "points | 7 | 8", MDR, points=7)


@case(
    "Grids too large, of half points or of True points, extents of 0 and inf, tolerances below rounding.",
    "Refused: each error names the setting, its value and what is allowed.",
)
def settings_that_do_not_exist(size):
    single = {"precision": "single", "tolerance": 1e-6}
    yield invalid("BEM: 16385 points", "points | 16385 | 16384", BEM, points=16385)
    yield invalid("BEM: 1e12 points", "points | 16384", BEM, points=10**12)
    yield invalid("MDR: 2^25 + 1 points", "points | 33554432", MDR, points=2**25 + 1)
    yield invalid("BEM: 64.5 points", "points | 64.5 | integer", BEM, points=64.5)
    yield invalid("MDR: True points", "points | True | integer", MDR, points=True)
    yield invalid("BEM: a tolerance of 1e-13", "tolerance | 1e-13 | 0.000000000001", BEM, tolerance=1e-13)
    yield invalid("BEM: an extent of 0", "extent | greater than 0", BEM, extent=0.0)
    yield invalid("MDR: an extent of inf", "extent | finite", MDR, extent=np.inf)
    yield invalid("BEM: 1e7 steps", "steps | 1000000", BEM, steps=10**7)
    yield invalid("BEM: single precision, 1e-6", "tolerance | single", BEM, **single)


@case(
    "Odd and prime numbers of points in 1D, which are rounded up to have a node at the tip.",
    "Force on a cone exact to 1e-12: it is linear between nodes.",
)
def odd_lines(size):
    grids = _grids(line, 9, 31, 101, 997)
    yield from equal(_cone(DEPTH), 1e-12, *grids)(size)
    for what, solver, scene in asked(size, resting(indenter=CONE), grids):
        yield Check(f"{what}: oddness of what is solved on", solver.solve(scene).settings["points"] % 2, 0.0)


@case(
    "An extent that is no rational part of the period of the roughness, on prime numbers of points.",
    "Pixels divide the period to 1e-9, the rms height is h0 to 1e-12, friction by traction is the energy lost "
    "to 1e-9.",
)
def lines_off_the_period(size):
    for points in (997, 1009):
        answer = MDR(points=points, extent=sqrt(2) * 3 * RADIUS).solve(sliding(1.0, KELVIN, roughness=ROUGH))
        period = ROUGH.longest / answer.measures["pixel"]
        yield Check(f"{points} points: pixels in a period, off whole", abs(period - round(period)), 1e-9)
        yield deviation(f"{points} points: rms height", answer.measures["rms_height"], ROUGH.rms_height, 1e-12)
        yield energy_is_lost(f"{points} points: ", answer, 1e-9)


@case(
    "A surface with the symmetry of the square on an even and an odd grid.",
    "Pressure is symmetric to 1e-4 of its peak: contact is solved to 1e-7 of the depth, which the shortest "
    "waves feel some hundred times as much.",
)
def turned_grids(size):
    scene = resting(roughness=CrossedWaves(amplitude=DEPTH / 10, wavelength=RADIUS / 2))
    for points in (31, 32):
        pressure = space(size, points=points).solve(scene).fields["pressure"]
        for name, turned in (("transpose", pressure.T), ("mirror image", pressure[:, ::-1])):
            apart = np.abs(pressure - turned).max() / pressure.max()
            yield Check(f"{points} points: pressure less its {name}", apart, 1e-4)


@case(
    "A window sought on grids that halve to odd ones.", "The contact lies inside of it, solved to the tolerance."
)
def windows_of_odd_grids(size):
    for points in (size.square - 1, 65, 130):
        answer = space(size, points=points, extent=None).solve(sliding(3.0, roughness=ROUGH))
        touched = answer.fields["pressure"] > 0
        rim = touched[[0, -1]].any() or touched[:, [0, -1]].any()
        yield Check(f"{points} points: contact at the rim", float(rim), 0.0)
        yield Check(f"{points} points: residual", answer.residual, TOLERANCE)


WAVES = Scene(Plane(), ELASTIC, Indent(pressure=1e5), PERIOD)
HUNDRED_WAVES = replace(WAVES, roughness=replace(PERIOD, shortest=1e-5))
case.add(
    "waves-beyond-a-coarse-grid",
    "A hundred waves on 17 points.",
    "Refused: the error names shortest and the points that carry it; with longer waves it is solved.",
    refused("points = 200 | shortest", HUNDRED_WAVES, *_grids(square, 17), error=ValueError),
    in_contact(WAVES, *_grids(square, 17, tolerance=TOLERANCE)),
)
