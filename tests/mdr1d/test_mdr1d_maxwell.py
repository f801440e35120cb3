"""The sweep over Maxwell branches against the sweep of Kelvin, closed forms, and its own identities."""

import numpy as np
import pytest

from mdr1d import lay_out, map_profile, modes_of, sweep, sweep_modes
from scene import Kelvin, KelvinChain, Prony, Scene, SelfAffine, Slide, Sphere, StandardLinearSolid

# Sums of some thousand terms; friction of the order of a slope times the force may lose what cancels in it.
ROUNDING = 1e-11

SOLID = StandardLinearSolid(rubbery_modulus=1.0, glassy_modulus=10.0, relaxation_time=1.0)


def line():
    """Heights above the lowest one, and the pixel."""
    rough = SelfAffine(hurst=0.6, rms_height=1e-5, longest=5e-4, shortest=5e-5, seed=4)
    scene = Scene(Sphere(radius=1e-2), Kelvin(modulus=1.0, relaxation_time=1.0), Slide(speed=1.0, load=1.0), rough)
    body = map_profile(scene, lay_out(scene, 160, 1.6e-3))
    return body.heights - body.lowest, body.pixel


def slope(heights, pixel):
    return np.abs(np.diff(heights)).max() / pixel


# At a memory of a pixel contact lands and is released again within the third interval, see the test of `sweep`.
SPOT = np.array([2.0, 0.0, 0.7, 0.8548, 5.0]) * 2e-5


@pytest.mark.parametrize("memory", [0.0, 1e-6, 1e-4, 1e3])
@pytest.mark.parametrize(("heights", "pixel"), [line(), (SPOT, 1e-4)], ids=["rough", "spot"])
def test_a_lone_dashpot_is_the_kelvin_foundation(heights, pixel, memory):
    modes = modes_of(Kelvin(modulus=3.0, relaxation_time=1.0))
    general, kelvin = sweep_modes(heights, pixel, modes, memory, 2e-5), sweep(heights, pixel, memory, 2e-5)
    for name in ("force", "dissipation", "stiffness", "length", "slope_square", "first", "last"):
        assert getattr(general, name) == pytest.approx(getattr(kelvin, name), rel=ROUNDING, abs=1e-40), name
    np.testing.assert_allclose(general.displacement, kelvin.displacement, atol=ROUNDING * 2e-5)
    np.testing.assert_array_equal(general.touching, kelvin.touching)


@pytest.mark.parametrize("speed", [1e-6, 1e-4, 1.0])
def test_two_times_that_approach_each_other_become_one(speed):
    heights, pixel = line()

    def force(distance):
        solid = Prony(equilibrium_modulus=1.0, moduli=(1.0, 2.0), relaxation_times=(1.0, 1.0 + distance))
        contact = sweep_modes(heights, pixel, modes_of(solid), speed, 2e-5)
        return np.array([contact.force, contact.dissipation, contact.stiffness])

    for distance in (1e-3, 1e-6, 1e-9, 1e-12, 1e-15):
        np.testing.assert_allclose(force(distance), force(0.0), rtol=distance + ROUNDING)


def test_modes_over_eighteen_decades_exchange_without_loss():
    generator = np.random.default_rng(1)
    for _ in range(30):
        count = generator.integers(1, 31)
        moduli, times = 10 ** generator.uniform(-3, 6, count), np.sort(10 ** generator.uniform(-12, 6, count))
        series = Prony(equilibrium_modulus=2.0, moduli=tuple(2 * moduli), relaxation_times=tuple(times))
        chain = KelvinChain(
            instantaneous_compliance=0.0, compliances=tuple(1 / moduli), retardation_times=tuple(times)
        )
        for elastomer in (series, chain):
            modes = modes_of(elastomer)
            _, compliances, times_of_creep = elastomer.retardation()
            np.testing.assert_allclose(modes.retardation_times, times_of_creep, rtol=ROUNDING)
            np.testing.assert_allclose(modes.compliances, compliances * elastomer.static_modulus, rtol=1e-9)
            # r -> u, y -> r is the identity: the two sets of variables describe one state.
            to_stretch = -modes.exchange * modes.compliances
            to_force = -modes.exchange.T * modes.moduli
            there_and_back = modes.compliances + to_force @ to_stretch
            np.testing.assert_allclose(there_and_back, np.eye(modes.compliances.size), atol=1e-9)


def test_crowded_times_of_unlike_moduli_keep_the_balance_of_energy():
    # Zeros between times that agree in up to 15 digits are uncertain one by one, but not together.
    generator = np.random.default_rng(5)
    heights, pixel = line()
    for _ in range(40):
        count = generator.integers(2, 31)
        times = 10.0 ** generator.integers(-9, 0, count) * (1 + 10 ** generator.uniform(-16, 0, count))
        moduli = 10 ** generator.uniform(-12, 6, count)
        for solid in (
            Prony(equilibrium_modulus=1.0, moduli=tuple(moduli), relaxation_times=tuple(times)),
            KelvinChain(
                instantaneous_compliance=1e-3, compliances=tuple(1 / moduli), retardation_times=tuple(times)
            ),
        ):
            contact = sweep_modes(heights, pixel, modes_of(solid), 1.0, 2e-5)
            loss = slope(heights, pixel) * contact.force
            assert contact.traction == pytest.approx(contact.dissipation, rel=1e-10, abs=1e-13 * loss)


@pytest.mark.parametrize("memory", [1e-3, 1.0])
def test_a_flat_that_starts_pressed_in_relaxes_as_the_modulus_does(memory):
    # Lengths in those of the flat, u = 1: f = 1 + 9 exp(-x/m), without slope nor friction.
    contact = sweep_modes(np.zeros(101), 0.01, modes_of(SOLID), memory, 1.0)
    assert (contact.force, contact.stiffness, contact.length) == pytest.approx(
        (1 - 9 * memory * np.expm1(-1 / memory), contact.force, 1.0), rel=ROUNDING
    )
    assert contact.traction == 0
    # What the jump stores is lost on the flat and behind it.
    assert contact.dissipation == pytest.approx(0.0, abs=ROUNDING * contact.force)
