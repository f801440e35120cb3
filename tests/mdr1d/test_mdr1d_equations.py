"""Eqs. 10 to 25 of the paper: their limits, their dimensions, one another, and the simulation."""

from dataclasses import replace
from functools import partial
from inspect import signature
from math import ceil, pi, sqrt

import numpy as np
import pytest
from maps import noise, refused
from scipy.integrate import quad

from mdr1d import draw, estimates, modes_of, sweep_modes
from mdr1d import equations as eq
from scene import (
    Elastic,
    Indent,
    PowerLaw,
    Prony,
    Scene,
    SelfAffine,
    Sphere,
    StandardLinearSolid,
)
from scene.scales import elastic_contact

# A few powers and products.
ROUNDING = 1e-13
# The energy in a period is the difference of two sums, over n and over n + 1 periods with their ends.
ROUNDING_OF_A_PERIOD = 1e-10
# Lengths of the longest memory after which an end is forgotten: exp(-40).
FORGOTTEN = 40

# One point in every variable, of no symmetry, and the powers of length, force and time in its unit.
VARIABLES = {
    "load": (7.0, (0, 1, 0)),
    "modulus": (1.3e6, (-2, 1, 0)),
    "relaxation_time": (2e-3, (0, 0, 1)),
    "speed": (0.03, (1, 0, -1)),
    "rms_slope": (0.11, (0, 0, 0)),
    "wave_number": (4e4, (-1, 0, 0)),
    "loss": (2e5, (-2, 1, 0)),
    "reference_frequency": (300.0, (0, 0, -1)),
    "beta": (0.3, (0, 0, 0)),
    "radius": (0.02, (1, 0, 0)),
    "depth": (3e-4, (1, 0, 0)),
    "contact_length": (5e-3, (1, 0, 0)),
    "c": (50.0, (-1, 0, 0)),
    "n": (2.0, (0, 0, 0)),
}
POINT = {name: value for name, (value, _) in VARIABLES.items()}
UNITS = {name: powers for name, (_, powers) in VARIABLES.items()}
NUMBER = (0, 0, 0)
RESULTS = {
    eq.contact_radius: (1, 0, 0),
    eq.indentation_depth: (1, 0, 0),
    eq.one_sided_speed: (1, 0, -1),
    eq.high_frequency_force: (0, 1, 0),
    eq.force_shift: (0, -1, 0),
    **dict.fromkeys((eq.macroscopic_slope, eq.low_speed_friction, eq.similarity_variable), NUMBER),
    **dict.fromkeys((eq.one_frequency_friction, eq.general_friction, eq.power_law_friction), NUMBER),
}

every_equation = pytest.mark.parametrize("function", RESULTS)


def at(function, **changed):
    """The function at the point but for what is changed, called with those numbers that it has arguments for."""
    point = POINT | changed
    loss = partial(eq.power_law_loss, **{k: point[k] for k in ("loss", "reference_frequency", "beta")})
    known = {"loss_modulus": loss} | point
    return function(**{name: known[name] for name in signature(function).parameters if name in known})


def kelvin_loss(modulus, time):
    return lambda omega: modulus * time * omega


@pytest.mark.parametrize("n", [1.0, 3.5])
@every_equation
def test_every_equation_keeps_its_meaning_in_other_units(function, n):
    known, point, units = at(function, n=n), POINT | {"n": n}, UNITS | {"c": (1 - n, 0, 0)}
    for powers in ((-10, 0, 0), (0, 10, 0), (0, 0, -10), (7, -8, 9)):
        scaled = {k: x * 10.0 ** np.dot(powers, units[k]) for k, x in point.items()}
        assert at(function, **scaled) == pytest.approx(
            known * 10.0 ** np.dot(powers, RESULTS[function]), rel=1e-12
        )


@pytest.mark.parametrize("shape", [Sphere(radius=0.02), PowerLaw(coefficient=3e3, exponent=3.5)])
def test_radius_depth_and_slope_are_those_of_the_contact_at_rest(shape):
    contact = elastic_contact(Scene(shape, Elastic(modulus=1e6), Indent(load=2.0)))
    asked = 2.0, 1e6, shape.mdr_coefficient, shape.exponent
    assert (eq.indentation_depth(*asked), eq.contact_radius(*asked)) == pytest.approx(
        (contact.depth, contact.radius), rel=ROUNDING
    )
    heights = shape.mdr_coefficient * (np.arange(20001) / 20000 * contact.radius) ** shape.exponent
    slopes = np.diff(heights) / (contact.radius / 20000)
    assert eq.macroscopic_slope(*asked) == pytest.approx(sqrt(np.mean(slopes**2)), rel=1e-6)


def test_eq_17_is_eq_12_in_other_variables():
    for n in (1.0, 2.0, 5.0):
        scaled = eq.normalised_friction(at(eq.low_speed_friction, n=n), POINT["rms_slope"])
        assert scaled == pytest.approx(at(eq.similarity_variable, n=n), rel=ROUNDING)


def test_contact_becomes_one_sided_at_the_knee_of_the_law():
    # F_N and d in xi leave (n + 1)/(sqrt 2 n), whatever the scene.
    for n in (1.0, 2.0, 9.0):
        speed = at(eq.one_sided_speed, depth=at(eq.indentation_depth, n=n))
        xi = at(eq.similarity_variable, n=n, speed=speed)
        assert xi == pytest.approx((n + 1) / (sqrt(2) * n), rel=ROUNDING)


def test_interpolation_is_xi_at_first_and_one_in_the_end():
    xi = np.array([0.0, 5e-324, 1e-300, 1e-8, 1e8, 1e300, np.inf])
    np.testing.assert_allclose(eq.interpolation(xi), np.minimum(xi, 1.0), rtol=1e-11)
    assert eq.interpolation(1.0, alpha=2.0) == pytest.approx(sqrt(0.5), rel=ROUNDING)
    middle = np.geomspace(1e-3, 1e3, 61)
    for alpha in (0.5, 1.5, 8.0):
        plain = (1 + middle**-alpha) ** (-1 / alpha)
        np.testing.assert_allclose(eq.interpolation(middle, alpha), plain, rtol=1e-12)


def test_the_plateau_of_exponential_slopes_is_the_root_of_two_and_of_gaussian_ones_the_root_of_half_pi():
    share = (np.arange(10**6) + 0.5) / 10**6
    exponential = -np.log(share)
    gaussian = noise(10**6)
    # The tail beyond 1e-6, and 1e6 samples.
    for slopes, ratio in ((exponential, sqrt(2)), (gaussian, sqrt(pi / 2))):
        rms = sqrt(np.mean(slopes**2))
        assert eq.plateau_of_slopes(slopes) / rms == pytest.approx(ratio, rel=3e-3)
    assert eq.plateau(0.3) == pytest.approx(eq.plateau_of_slopes(exponential) * 0.3 / sqrt(2), rel=1e-4)


def test_the_last_form_of_eq_15_as_printed_depends_on_the_unit_of_length():
    slopes, lengths = np.array([-0.1, 0.3, -0.2]), np.array([1e-3, 2e-3, 5e-3])
    for unit in (1.0, 1e3):
        total = lengths.sum() * unit
        right = eq.plateau_of_slopes(slopes, lengths * unit)
        assert right == pytest.approx((0.01 + 0.18 + 0.2) / (0.1 + 0.6 + 1.0), rel=ROUNDING)
        printed = eq.plateau_of_slopes(slopes, lengths * unit, form="as_printed")
        assert printed == pytest.approx(right / sqrt(total), rel=ROUNDING)


def test_the_root_over_both_is_right_at_an_rms_slope_of_one_alone():
    slope = np.array([0.25, 1.0, 4.0])
    ratio = eq.normalised_friction(0.1, slope, form="as_printed") / eq.normalised_friction(0.1, slope)
    np.testing.assert_allclose(ratio, np.sqrt(slope), rtol=ROUNDING)


def test_in_the_kelvin_limit_eq_21_is_eq_12_and_as_printed_half_of_it():
    kelvin = at(eq.low_speed_friction)
    loss = kelvin_loss(POINT["modulus"], POINT["relaxation_time"])
    right, printed = (
        at(eq.one_frequency_friction, loss_modulus=loss, form=form) for form in ("corrected", "as_printed")
    )
    general = at(eq.general_friction, loss_modulus=loss)
    law = eq.plateau(POINT["rms_slope"]) * eq.interpolation(at(eq.similarity_variable))
    assert (right, printed, general) == pytest.approx((kelvin, kelvin / 2, law), rel=ROUNDING)


def test_eq_22_tends_to_eq_21_and_to_the_plateau_of_its_form():
    for form, top in (("corrected", sqrt(2) * 0.11), ("as_printed", sqrt(2 * 0.11))):
        slow, fast = (at(eq.general_friction, loss_modulus=lambda w, x=x: x, form=form) for x in (1e-6, 1e30))
        assert fast == pytest.approx(top, rel=ROUNDING)
        expected = at(eq.one_frequency_friction, loss_modulus=lambda w: 1e-6, form=form)
        assert slow / top == pytest.approx(expected / (sqrt(2) * 0.11), rel=1e-9)


def test_eq_25_is_eq_22_of_a_sphere_with_a_power_law_loss():
    sphere = {"c": 1 / POINT["radius"], "n": 2.0, "speed": np.geomspace(1e-6, 1e3, 10)}
    right = at(eq.power_law_friction, **sphere)
    np.testing.assert_allclose(right, at(eq.general_friction, **sphere), rtol=1e-12)
    # As printed, at a reference frequency of 1, the only one at which it has a unit.
    sphere |= {"form": "as_printed"}
    printed = at(eq.power_law_friction, **sphere, reference_frequency=1.0)
    np.testing.assert_allclose(printed, at(eq.general_friction, **sphere, reference_frequency=1.0), rtol=1e-12)
    np.testing.assert_allclose(printed, at(eq.power_law_friction, **sphere))
    assert at(eq.power_law_friction, speed=0.0) == 0.0


@pytest.mark.parametrize("n", [1.0, 4.0])
def test_the_force_master_curve_is_eq_22(n):
    speeds, loads = np.geomspace(1e-6, 1e2, 5)[:, None], np.geomspace(1e-3, 1e4, 8)
    shifted = loads * at(eq.force_shift, n=n, speed=speeds)
    whole = eq.master_curve(shifted, POINT["rms_slope"], n)
    np.testing.assert_allclose(whole, at(eq.general_friction, n=n, speed=speeds, load=loads), rtol=1e-12)
    ends = eq.master_curve(np.array([0.0, np.inf]), 0.1, n)
    np.testing.assert_allclose(ends, [eq.plateau(0.1), 0.0], rtol=ROUNDING)
    slope = np.diff(np.log(at(eq.force_shift, n=n, speed=speeds)), axis=0) / np.diff(np.log(speeds), axis=0)
    np.testing.assert_allclose(slope, eq.force_shift_exponent(POINT["beta"], n), rtol=1e-10)


ROUGH = SelfAffine(hurst=0.4, rms_height=1e-6, longest=1e-3, shortest=1e-4, seed=1)


def test_the_spectral_force_of_a_kelvin_solid_is_eq_11():
    for rough in (ROUGH, replace(ROUGH, hurst=1.0), replace(ROUGH, rolloff=4e-4)):
        q = rough.q_max(0.0)
        speeds = np.array([0.1, 3.0])
        force = eq.spectral_force(
            kelvin_loss(1e6, 1e-3), lambda k, r=rough, q=q: r.density_1d(k, q), (rough.q_min, q), speeds, 2e-3
        )
        one = eq.high_frequency_force(kelvin_loss(1e6, 1e-3), q, speeds, rough.rms_slope(q), 2e-3)
        np.testing.assert_allclose(force, one, rtol=1e-9)


def test_the_spectral_force_is_the_integral_and_its_waves_add_up_to_it():
    solid = StandardLinearSolid(rubbery_modulus=1e6, glassy_modulus=1e7, relaxation_time=1e-3)
    fine = replace(ROUGH, longest=0.1)

    def loss(omega):
        return solid.complex_modulus(omega).imag

    q = fine.q_max(0.0)
    integral = quad(
        lambda k: k * fine.density_1d(k, q) * loss(0.1 * k), fine.q_min, q, limit=500, epsabs=0, epsrel=1e-9
    )[0]
    force = eq.spectral_force(loss, lambda k: fine.density_1d(k, q), (fine.q_min, q), 0.1, 2e-3)
    assert force == pytest.approx(8 * 2e-3 * integral, rel=1e-8)
    surface = draw(fine, 4096)
    numbers = 2 * pi / fine.longest * np.arange(1, surface.amplitudes.size + 1)
    # A thousand waves stand for the integral; the first of them are the coarsest.
    assert eq.wave_force(loss, numbers, surface.amplitudes, 0.1, 2e-3) == pytest.approx(force, rel=1e-3)


def per_period(elastomer, surface, speed, depth):
    """Friction [N] and length of contact [m] per period of a rough line far from its ends, simulated."""
    modulus, _, times = elastomer.relaxation()
    periods = 2 + ceil(FORGOTTEN * speed * max(times) / surface.period)
    sums = []
    for count in (periods, periods + 1):
        heights = np.tile(surface.heights, count)
        contact = sweep_modes(heights, surface.pixel, modes_of(elastomer), speed, depth)
        sums.append((4 * modulus * contact.dissipation, contact.length))
    return np.diff(sums, axis=0)[0]


SPEED, DEPTH = 0.1, 4e-5


def test_full_contact_is_the_sum_of_all_waves_of_the_polygon():
    """Linear interpolation makes of a wave q the waves q + 2 pi m / pixel, each sinc^2 of its amplitude."""
    solid = Prony(equilibrium_modulus=1e6, moduli=(2e6, 1e6), relaxation_times=(1e-4, 1e-3))
    surface = draw(ROUGH, 32)
    force, length = per_period(solid, surface, SPEED, DEPTH)
    assert length == pytest.approx(surface.period, rel=ROUNDING_OF_A_PERIOD)
    # The part beyond these aliases falls as the cube of their number.
    shifts = 2 * pi / surface.pixel * np.arange(-4000, 4001)[:, None]
    numbers = np.abs(2 * pi / surface.period * np.arange(1, surface.amplitudes.size + 1) + shifts)
    heights = surface.amplitudes * np.sinc(numbers * surface.pixel / (2 * pi)) ** 2
    total = eq.wave_force(
        lambda w: solid.complex_modulus(w).imag, numbers.ravel(), heights.ravel(), SPEED, surface.period
    )
    assert total == pytest.approx(force, rel=1e-8)


@every_equation
def test_arguments_out_of_range_are_named(function):
    for name in signature(function).parameters:
        if name in POINT:
            for wrong in (np.nan, np.array([1.0, -2.0])):
                refused(f"{name} = ", at, function, error=ValueError, **{name: wrong})


def test_further_arguments_out_of_range_are_named():
    for call, message in (
        (lambda: eq.interpolation(-1.0), "xi = -1 must be from 0 to inf"),
        (lambda: eq.interpolation(1.0, alpha=0.0), "alpha = 0 must be positive"),
        (lambda: eq.normalised_friction(0.1, 0.1, form="printed"), "form = 'printed' must be one of corrected"),
        (lambda: eq.plateau_of_slopes([0.0, 0.0]), "slopes must be finite, and not all"),
        (lambda: eq.spectral_force(abs, abs, (2.0, 1.0), 1.0, 1.0), r"band = \(2, 1\) must rise"),
        (lambda: eq.wave_force(abs, [1.0], [-1.0], 1.0, 1.0), "amplitudes = -1 must be finite and not negative"),
        (lambda: eq.power_law_loss(1.0, 1.0, 1.0, 1.5), "beta = 1.5 must be from 0 to 1"),
        (lambda: estimates.flash_heating(0.5, -1.0, 1e-7, 1.0, 1.0), "glassy_modulus = -1 must be positive"),
        (lambda: estimates.largest_displacement(0.5, 1.0, 0.6), "poisson_ratio = 0.6 must be from -1 to 0.5"),
        (lambda: estimates.partial_slip_force(-1.0, 0.5, 1.0, 1.0, 2), "displacement = -1 must be finite and not"),
        (lambda: estimates.layer_force(1.0, np.nan, 1.0, 2), "thickness = nan must be positive"),
        (lambda: estimates.stiffness_exponent(0.2, "half-space"), "n = 0.2 must be from 1 to 100"),
        (lambda: estimates.stiffness_exponent(2, "layer"), "base = 'layer' must be one of half-space, compr"),
    ):
        refused(message, call, error=ValueError)
