"""Contacts that no grid can answer are refused, by an error that names what to change."""

import re
from dataclasses import replace
from functools import partial
from math import radians

import numpy as np
import pytest

from bem3d import BEM
from compare.studies.checks.closed_forms import CROSSED_CLOSURE, WAVES
from compare.studies.checks.ordinary import (
    DEPTH,
    ELASTIC,
    KELVIN,
    LOAD,
    PACE,
    RADIUS,
    ROUGH,
    SOLID,
    TIME,
    program,
    resting,
    sliding,
    stage,
)
from mdr1d import MDR
from scene import (
    Cone,
    Coulomb,
    CrossedWaves,
    Cylinder,
    Elastic,
    EmptyContact,
    Indent,
    Layer,
    Measured,
    Plane,
    PowerLaw,
    Prony,
    Refused,
    Scene,
    SelfAffine,
    Shear,
    Slide,
    SolveError,
    StandardLinearSolid,
    Wave,
)

LINE, SPACE = MDR(points=1000), BEM(points=48, extent=3.2 * RADIUS, tolerance=1e-7)
BOTH = LINE, SPACE
WIDE = MDR(points=1000, extent=4 * RADIUS), replace(SPACE, extent=4 * RADIUS)
SQUARE, ROW = BEM(points=48), BEM(points=128)
PERIOD = SelfAffine(hurst=0.8, rms_height=1e-6, longest=1e-3, shortest=1e-5, seed=2)


def rough(**changed):
    return replace(ROUGH, **changed)


def pressed(surface, **motion):
    return Scene(Plane(), ELASTIC, Indent(**motion), surface)


def above(surface, depth):
    return Scene(Cone(radians(88)), SOLID, Slide(speed=PACE, depth=depth), surface)


crossed = CrossedWaves(**WAVES)
cylinder = Cylinder(0.01)
PRESSED = program(stage(TIME, depth=DEPTH))
FLAT = Scene(Plane(), SOLID, Indent(pressure=1e4), ROUGH)
STICKS = Coulomb(coefficient=0.4)
sought = "motion.depth | {:g} | lowest point"
# What is asked, of whom, and the words of the error.
CASES = {
    **{
        f"few pixels of {each.name}": (
            resting(motion=Indent(depth=DEPTH * (4.8 / each.points) ** 2)),
            [each],
            "needed | take more points",
        )
        for each in WIDE
    },
    "a gap of nearly nothing": (
        pressed(crossed, gap=1e-14),
        [SQUARE],
        "motion.gap | 1e-14 | prescribe the pressure",
    ),
    "a gap of nothing": (pressed(crossed, gap=1e-305), [SQUARE], "motion.gap | 1e-305 | prescribe the pressure"),
    "hardly a load": (pressed(crossed, pressure=1e-9 * CROSSED_CLOSURE), [SQUARE], "covers | take more points"),
    "no load": (pressed(crossed, pressure=1e-300 * CROSSED_CLOSURE), [SQUARE], "covers | take more points"),
    **{
        f"beyond the window, {motion.pressed_by} {type(motion).__name__}": (
            resting(elastomer=SOLID, motion=motion),
            [replace(each, extent=RADIUS) for each in BOTH],
            f"contact | {RADIUS:g} | extent",
        )
        for motion in (Indent(depth=DEPTH), Indent(load=LOAD), Slide(speed=PACE, depth=DEPTH))
    },
    "a speed beyond numbers": (sliding(1e308 / PACE, KELVIN), BOTH, "numbers of the scene | units"),
    "a line beyond digits": (
        Scene(cylinder, KELVIN, Slide(speed=1e9 * PACE, line_load=LOAD / RADIUS)),
        [ROW],
        "take",
    ),
    "above the peaks of a line": (above(rough(seed=4), DEPTH / 100), WIDE[:1], sought.format(DEPTH / 100)),
    "far above the peaks of a line": (above(rough(seed=4), 1e-300), WIDE[:1], sought.format(1e-300)),
    "above the peaks": (
        above(CrossedWaves(amplitude=DEPTH / 10, wavelength=RADIUS), DEPTH / 100),
        [SPACE],
        sought.format(DEPTH / 100),
    ),
    "unresolved waves": (
        resting(roughness=rough(shortest=1e-6 * RADIUS)),
        (WIDE[0], SPACE),
        f"shortest | {1e-6 * RADIUS:g} | would do",
    ),
    "nine decades of waves": (
        resting(roughness=rough(shortest=1e-12)),
        [LINE],
        "longest | shortest | raise shortest",
    ),
    "more than memory": (
        pressed(rough(shortest=2 * RADIUS / 4000), pressure=1e4),
        [BEM(points=16384)],
        "memory | use",
    ),
    "waves beyond a coarse grid": (pressed(PERIOD, pressure=1e5), [BEM(points=17)], "points = 200 | shortest"),
    "moduli 300 decades apart": (sliding(1.0, StandardLinearSolid(1e-300, 1e300, TIME)), BOTH, "units | moduli"),
    "moduli 400 decades apart": (sliding(1.0, Prony(1e-200, (1e200,), (TIME,))), BOTH, "units | moduli"),
    "a brief stage last": (
        program(stage(1e15, depth=DEPTH), stage(1e-15, depth=2 * DEPTH)),
        (LINE, replace(SPACE, points=24, steps=20)),
        "durations | 1e-15 | rounding",
    ),
    "too many steps": (
        program(stage(TIME, depth=DEPTH), stage(1.0, speed=1e6 * PACE)),
        BOTH,
        "steps on pixels | 1000000 | shorter path",
    ),
    "never touching": (program(stage(TIME, depth=1e-9 * DEPTH)), WIDE[:1], "pixels | take more points"),
    "never touching in 3D": (
        program(stage(TIME, depth=1e-9 * DEPTH)),
        [SPACE],
        "nothing touches in the whole program | press",
    ),
    "squares that vanish": (
        resting(indenter=PowerLaw(1.0, 100.0), motion=Indent(depth=1e-300)),
        [BEM(points=24)],
        "violation | wanted",
    ),
    **{
        f"an extent of {extent:g} m": (resting(), [replace(each, extent=extent) for each in BOTH], words)
        for words, extents in {
            "extent": (1e-5, 1e-150, 1e150),
            "take": (1e4,),
            "units": (5e-324, 1e-310, 1e300, 1.7e308),
        }.items()
        for extent in extents
    },
    "a program beyond the window": (
        PRESSED,
        [replace(each, extent=RADIUS) for each in BOTH],
        f"{RADIUS:g} m | take a larger extent",
    ),
    "a program on few pixels": (
        PRESSED,
        [replace(SPACE, extent=0.1)],
        "take more points",
    ),
    "too many periods": (
        program(stage(TIME, depth=DEPTH), stage(1.0, amplitude=0.1 * DEPTH, frequency=1e6)),
        BOTH,
        "steps | oscillate for fewer periods",
    ),
    "a history of partial slip": (
        program(stage(TIME, load=LOAD), interface=STICKS),
        BOTH,
        "interface = Coulomb | a history of partial slip is not simulated",
    ),
    "a pull on a layer": (
        resting(motion=Shear(load=LOAD, force=0.1 * LOAD), interface=STICKS, layer=Layer(thickness=1e-3)),
        [SPACE],
        "motion = Shear | tangential kernels are those of a half-space",
    ),
    **{
        f"a pull of {share:g} of what friction holds": (
            resting(motion=Shear(load=LOAD, force=share * STICKS.coefficient * LOAD), interface=STICKS),
            solvers,
            f"motion.force = {share * STICKS.coefficient * LOAD:g} slides | use Slide",
        )
        # in one dimension the load itself is met to 1e-13
        for share, solvers in ((1.0, [SPACE]), (1 + 1e-9, BOTH), (3.0, BOTH))
    },
    "friction beyond numbers": (
        resting(elastomer=KELVIN, motion=Slide(speed=PACE, load=1e5), interface=Coulomb(1e308)),
        [LINE],
        "forces beyond the range of numbers",
    ),
    **{
        f"a {motion.pressed_by} beyond numbers": (
            resting(elastomer=KELVIN, motion=motion),
            [BEM(points=32)],
            "too far apart to be computed with",
        )
        for motion in (Indent(load=1e300), Indent(depth=1e300), Slide(speed=PACE, load=1e-307))
    },
    # The square of a slope of 1e290; a period of 1e310 pixels.
    "a slope whose square is no number": (
        Scene(PowerLaw(0.018, 100.0), Elastic(1e-300), Slide(speed=1.0, load=2e-5)),
        [MDR(points=100)],
        "too far apart to be computed with",
    ),
    "a period beyond numbers": (
        resting(roughness=rough(longest=1e308, shortest=1e307)),
        [MDR(points=100)],
        "too far apart to be computed with",
    ),
    "a gap above the peaks": (pressed(crossed, gap=1e-3), [SQUARE], "motion.gap | 0.001 | take a gap below"),
    "a measured body in 1D": (
        resting(indenter=Measured(heights=np.eye(5), pixel=1e-3)),
        [LINE],
        "MDR cannot | Measured",
    ),
    "a plane in 1D": (FLAT, [LINE], "Plane | no body of revolution"),
    "a cylinder in 1D": (
        Scene(cylinder, SOLID, Indent(line_load=1e3)),
        [LINE],
        "Cylinder | no body of revolution",
    ),
    "a layer in 1D": (resting(layer=Layer(thickness=1e-3)), [LINE], "layer = Layer | three-dimensional solver"),
    "one wave in 1D": (resting(roughness=Wave(amplitude=1e-6, wavelength=1e-3)), [LINE], "Wave | not isotropic"),
    "a rough cylinder": (
        Scene(cylinder, SOLID, Indent(line_load=1e3), ROUGH),
        [SPACE],
        "rough Cylinder | Sphere or a Plane",
    ),
    "a plane on an extent": (FLAT, [SPACE], "extent | period"),
}


@pytest.mark.parametrize("name", CASES)
def test_a_contact_without_an_answer_is_refused_by_an_error_that_names_what_to_change(name):
    scene, solvers, words = CASES[name]
    expected = (
        EmptyContact if "above" in name or name == "never touching in 3D" else (Refused, SolveError, ValueError)
    )
    for solver in solvers:
        with pytest.raises(expected) as raised:
            solver.solve(scene)
        message = " ".join(str(raised.value).split())
        assert all(word in message for word in words.split(" | ")), message


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (partial(BEM, points=15), "points | 15 | 16"),
        (partial(MDR, points=7), "points | 7 | 8"),
        (partial(MDR, pixels=100), "pixels"),
        (partial(BEM, tolerance=1e-13), "tolerance | 1e-13 | 0.000000000001"),
        (partial(BEM, precision="single", tolerance=1e-6), "tolerance | single"),
    ],
)
def test_a_value_out_of_its_range_is_named_with_the_range(make, words):
    with pytest.raises(ValueError, match=re.escape(words.split(" | ")[0])) as raised:
        make()
    assert all(word in str(raised.value) for word in words.split(" | ")), raised.value
