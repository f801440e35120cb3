"""Contacts of one point and of all points, nearly closed and hardly touching."""

from functools import partial

import numpy as np

from scene import CrossedWaves, Indent, Plane, Scene, Slide, Wave

from ....models.exact import waves
from .conditions import conditions
from .hardcase import Check, Group, deviation
from .laws import BOTH, asked, refused
from .matrix import Matrix, solved
from .ordinary import DEPTH, ELASTIC, LOAD, PACE, RADIUS, ROUGH, SOLID, resting
from .solvers import TOLERANCE, dense, line, row, space, square

AMPLITUDE, WAVELENGTH = 1e-5, 1e-3
WAVE, CROSSED = (kind(amplitude=AMPLITUDE, wavelength=WAVELENGTH) for kind in (Wave, CrossedWaves))
CLOSURE = {
    WAVE: waves.wave_closure(ELASTIC.indentation_modulus, AMPLITUDE, WAVELENGTH),
    CROSSED: waves.crossed_closure(ELASTIC.indentation_modulus, AMPLITUDE, WAVELENGTH),
}
CASES = case = Group("contact")


def _plane(rough, **pressed):
    return Scene(Plane(), ELASTIC, Slide(speed=0.0, **pressed), rough)


@case(
    "One spike on a plain: a contact of a single pixel, under loads from 1e-12.",
    "The depth is load times the influence of a pixel on itself, to 1e-12, rounding; one pixel touches.",
)
def one_point(size):
    matrix, heights = Matrix(12, 12), np.ones((12, 12))
    heights[5, 7] = 0.0
    for load in (1e-12, 1e-3, 0.1):
        found = solved(matrix, heights, load=load)
        yield deviation(f"depth under {load:g}", found.depth, load * float(matrix.values[0, 0]), 1e-12)
        yield Check(f"points under {load:g}, less one", abs(np.count_nonzero(found.pressure) - 1.0), 0.0)


@case(
    "A contact three pixels across, of which a force is no more than a guess.",
    "Refused: the error says how many there are, how many are needed, and to take more points.",
)
def few_pixels(size):
    for build, points in ((line, size.line), (space, size.square)):
        shallow = resting(motion=Indent(depth=DEPTH * (1.2 * (4 * RADIUS / points) / RADIUS) ** 2))
        yield from refused("needed | take more points", shallow, partial(build, extent=4 * RADIUS))(size)


@case(
    "Pressed beyond closure a wavy plane touches everywhere: there is no free point.",
    "Pressure of the closed form at every pixel, within 1e-4 of p* and of the mean: contact is solved to "
    "1e-7, and what that leaves of the gap is felt as pressure by the wave number.",
)
def whole_domain(size):
    for rough, closure in CLOSURE.items():
        for fraction in (1.001, 2.0, 1e3):
            answer = square(size, tolerance=TOLERANCE).solve(_plane(rough, pressure=fraction * closure))
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
        found = row(size, tolerance=1e-9).solve(_plane(WAVE, pressure=fraction * CLOSURE[WAVE])).measures
        apart = found["contact_fraction"] - waves.wave_contact_fraction(fraction)
        yield Check(f"p/p* = {fraction:g}: contact fraction, in pixels", abs(apart) * size.row, 2.0)
        gap = found["mean_gap"] / AMPLITUDE - waves.wave_mean_gap(fraction)
        yield Check(f"p/p* = {fraction:g}: mean gap over h0", abs(gap), 2 / size.row**2)


@case(
    "At the pressure of closure itself points touch under no pressure, or are about to.",
    "The mean gap is zero to 1e-3 h0, that of the last pixels; conditions of contact, computed anew.",
)
def just_closed(size):
    for rough, closure in CLOSURE.items():
        what, scene = type(rough).__name__, _plane(rough, pressure=closure)
        answer = square(size, tolerance=TOLERANCE).solve(scene)
        yield Check(f"{what}: mean gap over h0", abs(answer.measures["mean_gap"] / AMPLITUDE), 1e-3)
        yield from conditions(answer, 2 * TOLERANCE, what)


case.add(
    "gap-to-nothing",
    "A mean gap of 1e-9 and 1e-300 of the amplitude: any pressure above closure would do.",
    "Refused: the error names motion.gap and its value, and says to prescribe the pressure.",
    *(
        refused(f"motion.gap | {gap:g} | prescribe the pressure", _plane(CROSSED, gap=gap), square)
        for gap in (1e-9 * AMPLITUDE, 1e-300 * AMPLITUDE)
    ),
)
FAINT = {f"p/p* = {part:g}": _plane(CROSSED, pressure=part * CLOSURE[CROSSED]) for part in (1e-9, 1e-300)}
case.add(
    "load-to-nothing",
    "Two crests of a crossed wave carry 1e-9 and 1e-300 of the pressure of closure: less than a pixel each.",
    "Refused: the error says how many points the contact covers, and to take more.",
    refused("covers | take more points", FAINT, square),
)


@case(
    "Rounded random heights, tied everywhere, seen from the other side: ties must not be broken by order.",
    "Pressure of the mirrored problem is the mirrored one, to 1e-6 of its peak: contact is solved to 1e-9.",
)
def mirrored_plateaus(size):
    matrix, heights = Matrix(15, 15), np.round(np.random.default_rng(5).standard_normal((15, 15)))
    pressure = solved(matrix, heights, load=20.0).pressure
    for name, turned in (("left and right", np.fliplr), ("rows and columns", np.transpose)):
        other = solved(matrix, turned(heights).copy(), load=20.0).pressure
        yield Check(f"{name}: pressure", np.abs(turned(pressure) - other).max() / pressure.max(), 1e-6)


MOTIONS = Indent(depth=DEPTH), Indent(load=LOAD), Slide(speed=PACE, depth=DEPTH)
case.add(
    "beyond-the-window",
    "The contact is twice as wide as the stated extent.",
    "Refused by both solvers: the error names the contact, the extent and its value.",
    refused(
        f"contact | {RADIUS:g} | extent",
        {f"{motion}": resting(elastomer=SOLID, motion=motion) for motion in MOTIONS},
        *(partial(build, extent=RADIUS) for build in BOTH),
    ),
)


@case(
    "Depths a thousandth apart: on a grid, contact grows by whole pixels.",
    "Force rises by no less than half of its greatest gain, as stiffness falls nowhere by more than 1e-5 of "
    "itself: contact grows with the depth, and stiffness with the contact.",
)
def force_rises_with_depth(size):
    depths = DEPTH * (1 + 1e-3 * np.arange(12))
    bodies = {"smooth": None, "rough": ROUGH}
    for what, solver, rough in asked(size, bodies, (line, partial(dense, tolerance=1e-9))):
        scenes = (resting(motion=Indent(depth=depth), roughness=rough) for depth in depths)
        stiffness = np.diff([solver.solve(scene).normal_force for scene in scenes])
        least, most = stiffness.min(), stiffness.max()
        yield Check(f"{what}: least gain over the greatest, negative", -least / most, -0.5)
        yield Check(f"{what}: greatest loss of stiffness", -np.diff(stiffness).min() / most, 1e-5)
