"""Frictional heating, on contacts whose friction is a formula of the temperature."""

from dataclasses import dataclass, replace
from math import exp, inf, isnan, nan

import numpy as np
import pytest
from changing_motion import program
from maps import refused
from scipy.optimize import bisect

from scene import (
    Arrhenius,
    Cylinder,
    Heating,
    Indent,
    Kelvin,
    Layer,
    Plane,
    Result,
    Scene,
    SelfAffine,
    Slide,
    SolveError,
    Sphere,
    StandardLinearSolid,
)
from scene.effects.terms import Heated, settled

ROUNDING = 1e-13
# What temperature and heat agree to, as stated.
AGREE = 1e-6

COLD = Arrhenius(temperature=300.0, reference=300.0, activation_energy=80e3)
SOLID = StandardLinearSolid(1e6, 1e9, 1e-3)
ROUGH = SelfAffine(hurst=0.8, rms_height=1e-6, longest=1e-3, shortest=1e-4)
SCENE = Scene(Sphere(radius=50e-3), SOLID, Slide(speed=0.01, load=10.0), temperature=COLD)
DEPTH = 1e-4


@dataclass(frozen=True)
class Fake:
    """A solver: friction is a hump over the speed in the times of the solid, the depth is always the same."""

    friction: float = 0.5
    peak: float = 1.0
    depth: float = DEPTH
    rms_height: float | None = None

    def at(self, scene):
        """mu at the scene's own temperature."""
        seen = scene.temperature.shift / self.peak if scene.temperature else 1.0
        return 2 * self.friction / (seen + 1 / seen) if scene.motion.speed else 0.0

    def __call__(self, scene):
        assert scene.heating is None
        measures = {"own": 7.0} | ({} if self.rms_height is None else {"rms_height": self.rms_height})
        return Result(
            scene, "fake", {"points": 3}, 2.0, self.depth, 2.0 * self.at(scene), 0.0, 5.0, 0.25, measures
        )


def heated(scene, fake=Fake(), **heating):
    scene = replace(scene, heating=Heating(**heating))
    term = Heated("heating", scene.heating)
    assert not term.refusals(scene)
    return term.around(fake)(scene)


@dataclass
class Trial:
    warmer: float
    rise: float


def counted(rise):
    """An attempt that `settled` takes, and the list of what it asked for."""
    asked = []

    def attempt(warmer):
        asked.append(warmer)
        return Trial(warmer, rise(warmer))

    return attempt, asked


@pytest.mark.parametrize("poisson_ratio", [-0.9, 0.3])
def test_contacts_that_are_pressed_alike_are_heated_alike_whatever_the_poisson_ratio(poisson_ratio):
    # E* = 2G/(1 - nu) is kept: so are load, depth and radius, and the heat mu F v
    alike = (1 - poisson_ratio) / (1 - 0.5)
    solid = StandardLinearSolid(1e6 * alike, 1e9 * alike, 1e-3, poisson_ratio)
    fake = Fake(rms_height=1e-6)
    found = heated(replace(SCENE, elastomer=solid), fake, conductivity=20.0).measures
    wanted = heated(SCENE, fake, conductivity=20.0).measures
    assert (found["average_heating"], found["flash_heating"]) == pytest.approx(
        (wanted["average_heating"], wanted["flash_heating"]), rel=ROUNDING
    )


def test_what_has_no_estimate_is_not_a_number_or_infinite_and_what_has_no_length_is_zero():
    assert isnan(heated(SCENE, Fake(depth=-1e-6), conductivity=20.0).measures["average_heating"])
    assert heated(SCENE, Fake(depth=0.0), conductivity=20.0).measures["average_heating"] == 0.0
    assert heated(SCENE, Fake(), conductivity=20.0).measures["flash_heating"] == 0.0
    kelvin = replace(SCENE, elastomer=Kelvin(1e6, 1e-3))
    assert heated(kelvin, Fake(rms_height=1e-6), conductivity=20.0).measures["flash_heating"] == inf
    assert heated(kelvin, Fake(), conductivity=20.0).measures["flash_heating"] == 0.0


@pytest.mark.parametrize("motion", [Indent(load=10.0), Slide(speed=0.0, load=10.0)])
def test_what_does_not_move_is_not_heated_whatever_its_glassy_modulus(motion):
    scene = replace(SCENE, motion=motion, elastomer=Kelvin(1e6, 1e-3))
    found = heated(scene, Fake(rms_height=1e-6), conductivity=1e-3).measures
    assert found["average_heating"] == found["flash_heating"] == 0.0


@pytest.mark.parametrize(("feedback", "peak"), [("average", 1e-3), ("average", 1e3), ("flash", 1.0)])
def test_with_feedback_temperature_and_heat_agree(peak, feedback):
    fake = Fake(peak=peak, rms_height=1e-7)
    answer = heated(SCENE, fake, conductivity=0.1, feedback=feedback)
    found = answer.measures
    law = replace(COLD, temperature=found["temperature"])
    assert answer.friction_coefficient == fake.at(replace(SCENE, temperature=law))
    rise = found[f"{feedback}_heating"]
    assert rise > 0
    assert found["temperature"] - 300.0 == pytest.approx(rise, rel=2 * AGREE, abs=1e-9)
    assert answer.scene == replace(SCENE, heating=Heating(conductivity=0.1, feedback=feedback))
    assert answer.settings == {"points": 3}
    count = found["heating_solves"]
    assert (answer.operator_applications, answer.seconds) == (5.0 * count, 0.25 * count)
    # it matters
    cold = heated(SCENE, fake, conductivity=0.1)
    assert abs(answer.friction_coefficient / cold.friction_coefficient - 1) > 1e-3


def rubber(peak, steepness):
    """Rise, relative to its maximum, by a friction that is a hump over ln a_T = -k x."""

    def rise(x):
        shift = np.exp(np.minimum(steepness * np.asarray(x), 600.0))
        return 2 / (peak / shift + shift / peak)

    return rise


def test_the_coldest_of_several_temperatures_is_found():
    # against a scan of all temperatures; the rise has its maximum at random, and is of any strength
    draw = np.random.default_rng(1)
    several, trials = 0, []
    for _ in range(300):
        strength, peak = 10 ** draw.uniform(-3, 3), 10 ** draw.uniform(-4, 4)
        steepness = 10 ** draw.uniform(-2.5, 0.5)
        shape = rubber(peak, steepness)
        attempt, asked = counted(lambda x, s=strength, f=shape: float(s * f(x)))
        found = settled(attempt).warmer
        x = np.concatenate([[0.0], np.geomspace(1e-9, 1.1 * strength + 1e-8, 20001)])
        excess = strength * shape(x) - x
        signs = np.flatnonzero(np.diff(np.sign(excess)) != 0)
        several += len(signs) > 1
        low, high = x[signs[0]], x[signs[0] + 1]
        # the scan knows it to a step, and both sides agree to 1e-6 of a rise that may be nearly parallel
        assert low * (1 - 1e-3) - 1e-8 <= found <= high * (1 + 1e-3) + 1e-8
        trials.append(len(asked))
    assert several >= 15
    assert np.median(trials) <= 5
    assert max(trials) <= 25


def test_without_an_agreement_there_is_no_answer():
    def step(x):
        return 10.0 if x < 3.0 else 1.0

    for rise, message in (
        (step, "friction jumps where it heats the contact by 3 K"),
        (lambda x: x + 1.0, "in 100 solves: it lies above"),
        (lambda x: -1.0, "heating by -1 K of a contact warmer by 0 K"),
        (lambda x: nan, "heating by nan K"),
        (lambda x: 1.0 if x == 0 else inf, "heating by inf K of a contact warmer by 1 K"),
    ):
        refused(message, settled, counted(rise)[0], error=SolveError)
    # friction that rounding makes negative heats nothing
    assert settled(counted(lambda x: -1e-15)[0]).warmer == 0.0
    with pytest.raises(SolveError, match="depth that are not negative"):
        heated(SCENE, Fake(depth=-1e-6), conductivity=1.0, feedback="average")


def test_a_scatter_in_the_rise_does_not_keep_from_an_answer():
    # a solver leaves 1e-5 of its friction undecided: more than both sides shall agree to
    attempt, asked = counted(lambda x: 10.0 * exp(-0.1 * x) * (1 + 1e-5 * np.sin(1e9 * x)))
    exact = bisect(lambda x: 10.0 * exp(-0.1 * x) - x, 0, 10, xtol=1e-12)
    assert settled(attempt).warmer == pytest.approx(exact, rel=2e-5)
    assert len(asked) < 60


def test_heat_beyond_where_the_law_of_the_shift_ends_is_an_error():
    steep = replace(SCENE, temperature=Arrhenius(temperature=300.0, reference=300.0, activation_energy=2.4e6))
    with pytest.raises(SolveError, match=r"friction heats the contact by 1e\+08 K, where Arrhenius"):
        heated(steep, conductivity=1e-8, feedback="average")


def test_scenes_without_an_estimate_are_refused_by_name():
    motion = program({"duration": 1.0, "load": 1.0}, {"duration": 1.0, "speed": 0.1})
    for changes, feedback, message in (
        (
            {"indenter": Cylinder(radius=1.0), "motion": Slide(speed=1.0, line_load=1.0)},
            None,
            "of a body of revolution, which a Cylinder is not",
        ),
        (
            {"indenter": Plane(), "motion": Slide(speed=1.0, pressure=1.0), "roughness": ROUGH},
            None,
            "which a Plane is not",
        ),
        ({"layer": Layer(thickness=1e-2)}, None, "leave layer or heating out"),
        ({"motion": motion}, None, "not of a Program"),
        ({"elastomer": Kelvin(1e6, 1e-3), "roughness": ROUGH}, "flash", "a Kelvin has no glassy modulus"),
    ):
        heating = Heating(conductivity=1.0, feedback=feedback)
        scene = replace(SCENE, **changes, heating=heating)
        (reason,) = Heated("heating", heating).refusals(scene)
        assert reason.startswith("heating = Heating: ")
        assert message in reason
    for allowed in ({"roughness": ROUGH}, {"elastomer": Kelvin(1e6, 1e-3)}):
        heating = Heating(conductivity=1.0, feedback="flash")
        assert not Heated("heating", heating).refusals(replace(SCENE, **allowed, heating=heating))


def test_feedback_without_a_temperature_is_refused():
    message = "heating.feedback = 'flash' shifts the times of the elastomer: give temperature"
    refused(message, replace, SCENE, temperature=None, heating=Heating(conductivity=1.0, feedback="flash"))
