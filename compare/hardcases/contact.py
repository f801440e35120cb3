"""Contacts of one point and of all points, nearly closed and hardly touching."""

from dataclasses import replace

import numpy as np

from bem3d import BEM
from compare.exact import waves
from scene import CrossedWaves, Indent, Plane, Scene, Slide, SolveError, Wave

from .conditions import conditions as conditions_of
from .hardcase import Check, Group, deviation, refusal
from .matrix import Matrix, solved
from .ordinary import DEPTH, ELASTIC, LOAD, PACE, RADIUS, ROUGH, SOLID, TOLERANCE, dense, line, resting, space

FINE = 1e-9  # tolerance of problems given as a matrix
AMPLITUDE, WAVELENGTH = 1e-5, 1e-3
WAVE, CROSSED = (kind(amplitude=AMPLITUDE, wavelength=WAVELENGTH) for kind in (Wave, CrossedWaves))
WAVE_CLOSURE = waves.wave_closure(ELASTIC.indentation_modulus, AMPLITUDE, WAVELENGTH)
CROSSED_CLOSURE = waves.crossed_closure(ELASTIC.indentation_modulus, AMPLITUDE, WAVELENGTH)
CASES = case = Group("contact")


def _plane(rough, elastomer=ELASTIC, **pressed):
    motion = pressed.pop("speed", 0.0)
    return Scene(Plane(), elastomer, Slide(speed=motion, **pressed), rough)


@case(
    "One spike on a plain: a contact of a single pixel, under loads from 1e-12.",
    "The depth is load times the influence of a pixel on itself, to 1e-12, rounding; one pixel touches.",
)
def one_point(size):
    matrix, heights = Matrix(12, 12), np.ones((12, 12))
    heights[5, 7] = 0.0
    itself = float(matrix.values[0, 0])
    for load in (1e-12, 1e-3, 0.1):
        found = solved(matrix, heights, FINE, load=load)
        yield deviation(f"depth under {load:g}", found.depth, load * itself, 1e-12)
        yield Check(f"points under {load:g}, less one", abs(np.count_nonzero(found.pressure) - 1.0), 0.0)


@case(
    "A contact three pixels across, of which a force is no more than a guess.",
    "Refused: the error says how many there are, how many are needed, and to take more points.",
)
def few_pixels(size):
    for solver in (line(size), space(size)):
        asked, pixel = f"{solver.name}: a contact of three pixels across", 4 * RADIUS / solver.points
        scene = resting(motion=Indent(depth=DEPTH * (1.2 * pixel / RADIUS) ** 2))
        wide = replace(solver, extent=4 * RADIUS)
        yield refusal(asked, SolveError, "needed | take more points", wide.solve, scene)


@case(
    "Pressed beyond closure a wavy plane touches everywhere: there is no free point.",
    "Pressure of the closed form at every pixel, within 1e-4 of p* and of the mean: contact is solved to "
    "1e-7, and what that leaves of the gap is felt as pressure by the wave number.",
)
def whole_domain(size):
    for rough, closure in ((WAVE, WAVE_CLOSURE), (CROSSED, CROSSED_CLOSURE)):
        for fraction in (1.001, 2.0, 1e3):
            scene = _plane(rough, pressure=fraction * closure)
            answer = BEM(points=size.square, tolerance=TOLERANCE).solve(scene)
            x, y = (2 * np.pi / WAVELENGTH * answer.fields[name] for name in ("x", "y"))
            across = np.cos(y)[:, None] if rough is CROSSED else 1.0
            known = closure * (fraction - across * np.cos(x))
            apart = np.abs(answer.fields["pressure"] - known).max() / closure
            what = f"{type(rough).__name__}, p/p* = {fraction:g}: pressure against the closed form"
            yield Check(what, apart, 1e-4 * max(1.0, fraction))


@case(
    "At 0.99 and 0.9999 of closure a wave leaves gaps of a few pixels, with hardly any height.",
    "Westergaard's contact fraction to two pixels, of the two edges, and mean gap to 2/N^2, the order of the "
    "discretisation.",
)
def nearly_full_contact(size):
    for fraction in (0.99, 0.9999):
        scene = _plane(WAVE, pressure=fraction * WAVE_CLOSURE)
        answer = BEM(points=size.row, tolerance=1e-9).solve(scene)
        apart = answer.measures["contact_fraction"] - waves.wave_contact_fraction(fraction)
        yield Check(f"p/p* = {fraction:g}: contact fraction, in pixels", abs(apart) * size.row, 2.0)
        gap = answer.measures["mean_gap"] / AMPLITUDE - waves.wave_mean_gap(fraction)
        yield Check(f"p/p* = {fraction:g}: mean gap over h0", abs(gap), 2 / size.row**2)


@case(
    "At the pressure of closure itself points touch under no pressure, or are about to.",
    "The mean gap is zero to 1e-3 h0, that of the last pixels; conditions of contact, computed anew.",
)
def just_closed(size):
    for rough, closure in ((WAVE, WAVE_CLOSURE), (CROSSED, CROSSED_CLOSURE)):
        answer = BEM(points=size.square, tolerance=TOLERANCE).solve(_plane(rough, pressure=closure))
        yield Check(
            f"{type(rough).__name__}: mean gap over h0", abs(answer.measures["mean_gap"] / AMPLITUDE), 1e-3
        )
        yield from conditions_of(answer, 2 * TOLERANCE, type(rough).__name__)


@case(
    "A mean gap of 1e-9 and 1e-300 of the amplitude: any pressure above closure would do.",
    "Refused: the error names motion.gap and its value, and says to prescribe the pressure.",
)
def gap_to_nothing(size):
    for gap in (1e-9, 1e-300):
        scene, solver = _plane(CROSSED, gap=gap * AMPLITUDE), BEM(points=size.square)
        words = f"motion.gap | {gap * AMPLITUDE:g} | prescribe the pressure"
        yield refusal(f"a mean gap of {gap:g} h0", SolveError, words, solver.solve, scene)


@case(
    "Two crests of a crossed wave carry 1e-9 and 1e-300 of the pressure of closure: less than a pixel each.",
    "Refused: the error says how many points the contact covers, and to take more.",
)
def load_to_nothing(size):
    for fraction in (1e-9, 1e-300):
        scene, solver = _plane(CROSSED, pressure=fraction * CROSSED_CLOSURE), BEM(points=size.square)
        yield refusal(f"p/p* = {fraction:g}", SolveError, "covers | take more points", solver.solve, scene)


@case(
    "Rounded random heights, tied everywhere, seen from the other side: ties must not be broken by order.",
    "Pressure of the mirrored problem is the mirrored one, to 1e-6 of its peak: contact is solved to 1e-9.",
)
def mirrored_plateaus(size):
    heights = np.round(np.random.default_rng(5).standard_normal((15, 15)))
    matrix = Matrix(15, 15)
    found = solved(matrix, heights, FINE, load=20.0)
    for name, turned in (("left and right", np.fliplr), ("rows and columns", np.transpose)):
        other = solved(matrix, turned(heights).copy(), FINE, load=20.0)
        apart = np.abs(turned(found.pressure) - other.pressure).max() / found.pressure.max()
        yield Check(f"{name}: pressure", apart, 1e-6)


@case(
    "The contact is twice as wide as the stated extent.",
    "Refused by both solvers: the error names the contact, the extent and its value.",
)
def beyond_the_window(size):
    for solver in (line(size, extent=RADIUS), space(size, extent=RADIUS)):
        for motion in (Indent(depth=DEPTH), Indent(load=LOAD), Slide(speed=PACE, depth=DEPTH)):
            what, words = f"{solver.name}: {motion}", f"contact | {RADIUS:g} | extent"
            yield refusal(what, SolveError, words, solver.solve, resting(elastomer=SOLID, motion=motion))


@case(
    "Depths a thousandth apart: on a grid, contact grows by whole pixels.",
    "Force rises by no less than half of its greatest gain, as stiffness falls nowhere by more than 1e-5 of "
    "itself: contact grows with the depth, and stiffness with the contact.",
)
def force_rises_with_depth(size):
    depths = DEPTH * (1 + 1e-3 * np.arange(12))
    for solver in (line(size), dense(size, tolerance=1e-9)):
        for rough in (None, ROUGH):
            scenes = [resting(motion=Indent(depth=depth), roughness=rough) for depth in depths]
            forces = np.array([solver.solve(scene).normal_force for scene in scenes])
            stiffness = np.diff(forces)
            body = "smooth" if rough is None else "rough"
            yield Check(
                f"{solver.name}, {body}: least gain over the greatest, negative",
                -stiffness.min() / stiffness.max(),
                -0.5,
            )
            bend = -np.diff(stiffness).min() / stiffness.max()
            yield Check(f"{solver.name}, {body}: greatest loss of stiffness", bend, 1e-5)
