"""Whatever stands in a field: an error that names it, an answer within the laws, or a reason why there is none."""

import re
from contextlib import suppress
from dataclasses import fields, replace
from itertools import chain
from math import inf, isfinite, nan

import numpy as np
import pytest
from damage import TRIES, bounded, fuzz, unshowable
from effects import effects
from hypothesis import strategies as st
from maps import refused
from planned import STANDARD as SOLID
from solids import OF_EACH_TYPE
from strategies import bodies, decades, planes

from bem3d import BEM
from compare.solving.cost import work_of
from mdr1d import MDR
from mdr1d.ensemble import solve_profiles
from scene import (
    Cone,
    CrossedWaves,
    Cylinder,
    Indent,
    InvalidInput,
    Kelvin,
    Measured,
    Plane,
    PowerLaw,
    Program,
    Refused,
    Scene,
    SelfAffine,
    Slide,
    SolveError,
    Sphere,
    Stage,
    Wave,
)

# Waves and pressures that 16 points a side carry.
ROUGH = SelfAffine(hurst=0.7, rms_height=1e-5, longest=4e-3, shortest=1.5e-3, rolloff=2e-3, seed=1)
BALL = Scene(Sphere(1e-2), SOLID, Slide(speed=0.1, load=1.0), ROUGH)
PRESSED = Scene(Plane(), SOLID, Slide(speed=0.1, pressure=1e5), ROUGH)
LINE = Scene(Cylinder(1e-2), SOLID, Slide(speed=0.1, line_load=100.0))
STAGE = Stage(duration=1e-3, speed=0.1, load=1.0)
SOLVERS = MDR(points=200, steps=20), BEM(points=16, steps=20)
every_solver = pytest.mark.parametrize("solver", SOLVERS)
SQUARES = np.add.outer(*2 * [np.arange(-20, 21) ** 2])
ROUNDING = 1e-9  # of friction by traction, which cancels
SENTENCES = 2000  # letters of all reasons of a refusal

# A scene for each part whose fields are tried.
SCENES = {
    "indenter": (BALL, replace(BALL, indenter=Cone(0.2)), replace(BALL, indenter=PowerLaw(50.0, 2.5)), LINE),
    "elastomer": tuple(replace(BALL, elastomer=solid) for solid in OF_EACH_TYPE.values()),
    "motion": (
        BALL,
        replace(BALL, motion=Slide(speed=0.1, depth=1e-4)),
        replace(BALL, motion=Indent(load=1.0)),
        replace(BALL, motion=Indent(depth=1e-4)),
        LINE,
        PRESSED,
        replace(PRESSED, motion=Indent(gap=1e-5)),
    ),
    "roughness": (
        BALL,
        PRESSED,
        replace(PRESSED, roughness=Wave(amplitude=1e-6, wavelength=1e-3)),
        replace(PRESSED, roughness=CrossedWaves(amplitude=1e-6, wavelength=1e-3)),
    ),
}
FIELDS = [
    pytest.param(scene, part, field.name, id=f"{type(getattr(scene, part)).__name__}-{field.name}-{i}")
    for part, scenes in SCENES.items()
    for i, scene in enumerate(scenes)
    for field in fields(getattr(scene, part))
    if getattr(getattr(scene, part), field.name) is not None
]
# Not numbers, or no number that anything may be.
NEVER = (nan, inf, -inf, -1.0, "1", b"1", True, [1.0], {"value": 1.0}, 1j)
# Numbers that may be allowed, and must then have an answer or none for a reason.
EXTREME = (0.0, 5e-324, 1e-310, 1e-300, 1e-150, 1e150, 1e300, 1.7e308)


def placed(part, name, value):
    """The part with a value in a field, or in the first place of a field with several values."""
    given = getattr(part, name)
    return replace(part, **{name: (value, *given[1:]) if isinstance(given, tuple) else value})


def answered(asked, scene):
    """What a solver's plan or solve of a scene returns, or the reason why there is none."""
    try:
        return asked(scene)
    except (Refused, SolveError) as reason:
        return str(reason)


def lawful(answer):
    """Whether forces are numbers of the right sign: of friction as far as its estimates on a grid agree."""
    if isinstance(answer, str):
        return len(answer) > 20 and not unshowable(answer, letters=SENTENCES)
    pressure = answer.fields.get("pressure", answer.fields.get("line_force", np.zeros(1)))
    if not np.all(pressure >= -ROUNDING * np.max(pressure)):
        return False
    if isinstance(answer.scene.motion, Program):  # may be lifted, and slide backwards
        return 0 <= answer.normal_force < inf and isfinite(answer.friction_force)
    least = -2 * answer.measures.get("friction_disagreement", 0.0) - ROUNDING
    return (
        isfinite(answer.depth)
        and 0 < answer.normal_force < inf
        and least <= answer.friction_coefficient < inf
        and 0 <= answer.residual <= 1e-5
    )


@every_solver
def test_ordinary_numbers_have_an_answer(solver):
    """Where none is due for the kind of the scene: one dimension has no planes and no cylinders."""
    for scene in chain(*SCENES.values()):
        answer = answered(solver.solve, scene)
        declined = solver.name == "MDR" and isinstance(scene.indenter, Plane | Cylinder)
        assert isinstance(answer, str) == declined, (scene, answer)
        assert lawful(answer)


THINGS = [*(getattr(scene, part) for part, scenes in SCENES.items() for scene in scenes), STAGE, *SOLVERS]


@pytest.mark.parametrize(
    ("thing", "name"),
    [
        pytest.param(thing, field.name, id=f"{type(thing).__name__}-{field.name}-{i}")
        for i, thing in enumerate(THINGS)
        for field in fields(thing)
    ],
)
def test_what_can_be_no_value_is_named_with_its_field(thing, name):
    """-1 is none but of a speed that turns back, True none but of a switch, 0 none of a solver but its frames."""
    switch, backwards = isinstance(getattr(thing, name), bool), (thing, name) == (STAGE, "speed")
    nothing = (0,) if thing in SOLVERS and name != "frames" else ()
    for value in (*NEVER, *nothing):
        if not ((switch and value is True) or (backwards and value == -1.0)):
            with pytest.raises(InvalidInput) as caught:
                placed(thing, name, value)
            assert re.match(rf"{type(thing).__name__}: {name}\b.*: .{{10}}", str(caught.value)), value


@pytest.mark.parametrize(("scene", "part", "name"), FIELDS)
@pytest.mark.parametrize("solver", [SOLVERS[0], pytest.param(SOLVERS[1], marks=pytest.mark.slow)])
def test_extreme_numbers_are_solved_within_the_laws_or_declined_with_a_reason(scene, part, name, solver):
    """Zero, denormal, tiny and huge numbers in every field of a scene."""
    for value in EXTREME:
        try:
            changed = replace(scene, **{part: placed(getattr(scene, part), name, value)})
        except InvalidInput:
            continue
        assert lawful(answered(solver.solve, changed)), value


# Of every part that a scene may have; each solver refuses some.
OF_EVERY_PART = (
    *(effect.scene for effect in effects()),
    *chain(*SCENES.values()),
    replace(BALL, indenter=Measured(heights=1e-7 * SQUARES, pixel=5e-5, peaks="down"), roughness=None),
)
LONGEST, STEPS, LARGEST = (
    3e7,
    400,
    1e8,
)  # work, steps, bytes that a solve is planned to take; of more, a plan is all


@st.composite
def stretched(draw):
    """Any scene: at random around a contact of radius 1, or one of every part; then single numbers go anywhere."""
    scene = draw(st.one_of(bodies(), planes(), st.sampled_from(OF_EVERY_PART)))
    for name, part in scene.parts.items():
        numbers = [each.name for each in fields(part) if isinstance(getattr(part, each.name), float)]
        if numbers and draw(st.integers(0, 3)) == 3:
            number = draw(st.sampled_from(numbers))
            with suppress(InvalidInput):  # beyond what a scene may say: it stays as it was
                part = replace(part, **{number: getattr(part, number) * draw(decades(-40, 40))})
                scene = replace(scene, **{name: part})
    return scene


@pytest.mark.slow
@every_solver
def test_scenes_of_every_part_with_numbers_beyond_reason_are_answered_within_the_laws_or_declined(solver):
    """Half a thousand, as FUZZ_SEED has them, see `damage`. A hang is a failure too."""

    def law(scene):
        with bounded():
            plan = answered(solver.plan, scene)
            if isinstance(plan, str):
                assert lawful(plan)
            elif plan.steps <= STEPS and plan.memory <= LARGEST and work_of(solver, scene) <= LONGEST:
                assert lawful(answered(solver.solve, scene))

    fuzz(law, stretched(), tries=TRIES // 2)


@pytest.mark.parametrize(
    ("part", "name"), [(BALL.indenter, "radius"), (BALL.motion, "load"), (SOLVERS[0], "extent")]
)
def test_a_whole_number_beyond_the_range_of_numbers_is_named(part, name):
    refused(rf"{name}.*within the range of floating-point numbers", replace, part, **{name: 10**400})


@pytest.mark.parametrize(
    ("points", "seeds", "message"),
    [
        ([1000], [-1], r"seeds = -1 must be a whole number, at least 0"),
        ([1000], [True], r"seeds = True must be a whole number"),
        ([0], [1], r"points = 0 must be a whole number, at least 1"),
        ([1000.5], [1], r"points = 1000.5 must be a whole number"),
        ([], [1], r"points has 0 values, scenes has 1"),
    ],
)
def test_profiles_solved_together_name_bad_points_and_seeds(points, seeds, message):
    scene = replace(BALL, elastomer=Kelvin(1e6, 1e-3))
    refused(message, solve_profiles, [scene], points, seeds, error=ValueError)


@pytest.mark.parametrize("name", ["longest", "shortest", "rolloff"])
def test_a_wavelength_without_a_wave_number_is_named(name):
    refused(f"{name}.*wavelengths are at least 1e-300 m", replace, ROUGH, **{name: 1e-310})
