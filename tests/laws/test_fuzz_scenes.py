"""Scenes drawn over the whole vocabulary, with ratios beyond reason: each is answered by its laws, or is refused.

Half a thousand by each solver, as FUZZ_SEED has them, see `damage`. A hang is a failure too.
"""

from dataclasses import fields, replace
from math import isfinite

import numpy as np
import pytest
from damage import TRIES, bounded, fuzz, unshowable
from hypothesis import strategies as st
from solids import OF_EACH_TYPE
from strategies import bodies, decades, evenly, planes, rescaled

from bem3d import BEM
from mdr1d import MDR
from scene import (
    WLF,
    Arrhenius,
    Coulomb,
    Cylinder,
    Heating,
    Indent,
    InvalidInput,
    Layer,
    Measured,
    Program,
    Refused,
    Result,
    Shear,
    Slide,
    SolveError,
    Stage,
    Topography,
)

pytestmark = pytest.mark.slow
SCENES = TRIES // 2
LONGEST, STEPS, LARGEST = 2.0, 400, 1e8  # s, steps, bytes that a solve is planned to take; of more, a plan is all
SOLVERS = {"BEM": BEM(points=32, steps=10), "MDR": MDR(points=500, steps=10)}
ROUNDING = 1e-9  # of sums that hold what is prescribed
SENTENCES = 2000  # letters of all reasons of a refusal
seldom = st.integers(0, 3).map(lambda one: one == 3)
extremes = decades(-40, 40)
heights = st.integers(0, 99).map(lambda one: np.random.default_rng(one).standard_normal((6, 8)))


@st.composite
def stages(draw, by, value, speed):
    """Of a history: pressed in, then slid, held, lifted or shaken, forwards and backwards."""
    found = [Stage(duration=1.0, **{by: value})]
    for _ in range(draw(st.integers(0, 2))):
        pressed = draw(st.sampled_from(({}, {by: 0.0}, {by: value / 2}, {by: value})))
        moved = draw(st.sampled_from((0.0, speed, -speed)))
        shaken = {"amplitude": value / 4, "frequency": 0.5} if {by: value} == pressed and draw(seldom) else {}
        found.append(Stage(duration=draw(decades(-2, 1)) / max(speed, 1.0), speed=moved, **pressed, **shaken))
    return tuple(found)


@st.composite
def scenes(draw):
    """Any scene: most have a contact of radius 1, E* of 1 and times around 1; then single numbers go anywhere."""
    scene = draw(st.one_of(bodies(), bodies(), bodies(), planes()))
    by, speed = scene.motion.pressed_by, scene.motion.speed or 1.0
    value, extra = scene.motion.greatest, {}
    if by in ("load", "depth") and draw(seldom):
        kind, shape, rough = draw(st.sampled_from(("cylinder", "measured", "map"))), draw(heights), scene.roughness
        if kind == "cylinder":
            by, shape, rough = "line_load", Cylinder(radius=1 / value), rough if draw(seldom) else None
        elif kind == "measured":
            x = np.linspace(-1, 1, 8)
            shape = value * (shape / 10 + 2 * x**2 + 2 * x[:6, None] ** 2)
            shape, rough = Measured(heights=shape, pixel=0.4, peaks="down"), None
        else:
            shape, rough = scene.indenter, Topography(heights=value * shape, pixel=draw(decades(-1, 1)))
        extra |= {"indenter": shape, "roughness": rough}
    if draw(seldom):
        extra["elastomer"] = rescaled(draw(st.sampled_from(list(OF_EACH_TYPE.values()))), modulus=2.5e-7)
    motions = {
        "indent": lambda: Indent(**{by: value}),
        "slide": lambda: Slide(speed=scene.motion.speed, **{by: value}),
        "program": lambda: Program(stages=draw(stages(by, value, speed))),
        "shear": lambda: Shear(displacement=value * draw(decades(-3, 1)), **{by: value}),
    }
    moved = draw(st.sampled_from(("slide", "slide", "slide", "indent", "program", "shear")))
    extra["motion"] = motions[moved]()
    if draw(seldom):
        extra["layer"] = Layer(
            thickness=draw(decades(-2, 3)), base=draw(st.sampled_from(("bonded", "frictionless")))
        )
    if draw(seldom):
        warm = draw(evenly(-40, 200))
        law = draw(st.sampled_from((WLF(temperature=300 + warm, reference=300, c1=17.44, c2=51.6), None)))
        extra["temperature"] = law or Arrhenius(temperature=300 + warm, reference=300, activation_energy=5e4)
    if draw(seldom):
        feedback = draw(st.sampled_from((None, "average", "flash"))) if "temperature" in extra else None
        extra["heating"] = Heating(conductivity=draw(decades(-6, 3)), feedback=feedback)
    if moved == "shear" or draw(seldom):
        extra["interface"] = Coulomb(coefficient=draw(st.sampled_from((0.0, 1e-3, 0.5, 10.0))))
    return _stretched(draw, replace(scene, **extra))


def _stretched(draw, scene):
    """Numbers of one part in three multiplied by anything."""
    for name, part in scene.parts.items():
        numbers = [each.name for each in fields(part) if isinstance(getattr(part, each.name), float)]
        if numbers and draw(seldom):
            number = draw(st.sampled_from(numbers))
            try:
                part = replace(part, **{number: getattr(part, number) * draw(extremes)})
                scene = replace(scene, **{name: part})
            except InvalidInput:  # beyond what a scene may say: it stays as it was
                pass
    return scene


def answer(solver, scene) -> Result | None:
    """The answer, None where the scene is refused in words or would take long."""
    with bounded():
        try:
            plan = solver.plan(scene)
            if plan.steps > STEPS or plan.memory > LARGEST or (plan.seconds.value or 0.0) > LONGEST:
                return None
            return solver.solve(scene)
        except (Refused, SolveError) as error:
            refused = str(error)
    wrong = unshowable(refused, letters=SENTENCES)
    assert not wrong, f"{wrong}: {refused}"
    return None


def broken(result) -> list[str]:
    """Laws of any answer that this one does not keep."""
    scene, measures, force = result.scene, result.measures, result.normal_force
    motion, friction = scene.motion, result.friction_force
    history = isinstance(motion, Program)  # whose forces are of the middle of its last step
    met = {"load": force, "line_load": force, "pressure": measures.get("mean_pressure"), "depth": result.depth}
    found = None if history else met.get(motion.pressed_by)
    # A depth is counted from the mean of the roughness.
    scale = motion.greatest + (measures.get("rms_height", 0.0) if motion.pressed_by == "depth" else 0.0)
    pressure = result.fields.get("pressure", result.fields.get("line_force"))
    # Uncertainty of mu, as estimates of one pressure differ; none where friction is a sum of losses.
    unsure = 2 * measures.get("friction_disagreement", 0.0) + ROUNDING * measures.get("rms_slope", 1.0)
    rubbed = measures.get("friction_in_interface", 0.0)
    lossless = motion.speed == 0 or len(scene.solid.retardation()[2]) == 0 if not history else False
    laws = {
        "forces are finite": isfinite(force) and isfinite(friction),
        "nothing pulls": force >= 0
        and (pressure is None or bool(np.all(pressure >= -ROUNDING * np.max(pressure)))),
        "what is prescribed is met": found is None or abs(found - motion.greatest) <= ROUNDING * scale,
        "the residual is within the tolerance": result.residual <= 1e-5,
        "friction opposes the motion": history or friction >= rubbed - unsure * force,
        "without loss friction is that of the interface": not lossless or friction == rubbed,
    }
    return [law for law, holds in laws.items() if not holds]


@pytest.mark.parametrize("name", SOLVERS)
def test_a_scene_is_answered_by_its_laws_or_refused(name):
    solver = SOLVERS[name]

    def law(scene):
        found = answer(solver, scene)
        assert not (wrong := [] if found is None else broken(found)), "; ".join(wrong)

    fuzz(law, scenes(), tries=SCENES)
