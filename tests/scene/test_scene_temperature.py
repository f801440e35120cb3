"""Temperature of the elastomer: one factor on all its times, and nothing else."""

from dataclasses import dataclass, replace
from math import log, log10

import numpy as np
import pytest
from maps import refused
from solids import OF_EACH_TYPE

from scene import WLF, Arrhenius, Indent, Kelvin, KelvinChain, Prony, Scene, Sphere
from scene.effects.temperature import GAS_CONSTANT, UNIVERSAL, Shifted
from scene.solids.modes import Relaxation
from scene.solids.viscoelastic import Linear

# A sum of a few exactly rounded numbers.
ROUNDING = 1e-13
# The zeros of a rational function are found anew from shifted poles, each to rounding.
CONVERTED = 1e-11
FACTORS = (1e-9, 7.0)


def universal(above):
    """At so much above the glass transition."""
    return WLF(temperature=220.0 + above, reference=220.0, **UNIVERSAL)


def test_the_universal_law_falls_by_nine_decades_over_fifty_kelvin():
    # by hand: -17.44 * 50 / 101.6
    assert (log10(universal(50.0).shift), log10(universal(100.0).shift)) == pytest.approx(
        (-8.58267716535433, -17.44 * 100 / 151.6), rel=ROUNDING
    )


def test_a_law_of_williams_landel_and_ferry_is_the_same_from_another_reference():
    # From T_g + 50 K the published constants are 8.86 and 101.6 K: 17.44 * 51.6 / 101.6 to three digits.
    moved = {"c1": UNIVERSAL["c1"] * UNIVERSAL["c2"] / (UNIVERSAL["c2"] + 50), "c2": UNIVERSAL["c2"] + 50}
    assert moved["c1"] == pytest.approx(8.86, abs=5e-3)
    for above in (10.0, 50.0, 90.0, 200.0):
        there = WLF(temperature=220.0 + above, reference=270.0, **moved)
        step = universal(above).log_shift - universal(50.0).log_shift
        assert there.log_shift == pytest.approx(step, rel=ROUNDING, abs=ROUNDING)


def test_the_law_of_arrhenius_is_straight_over_the_inverse_temperature():
    def law(temperature):
        return Arrhenius(temperature=temperature, reference=300.0, activation_energy=80e3)

    # 1/310 - 1/300 = -10/93000
    assert law(310.0).log_shift == pytest.approx(-80000 * 10 / 93000 / 8.314462618, rel=1e-12)
    temperatures = np.array([250.0, 280.0, 330.0, 500.0])
    shifts = np.array([log(law(float(t)).shift) for t in temperatures])
    slopes = np.diff(shifts) / np.diff(1 / temperatures)
    np.testing.assert_allclose(slopes, 80e3 / GAS_CONSTANT, rtol=1e-12)


@pytest.mark.parametrize(
    "law", [universal(0.0), Arrhenius(temperature=220.0, reference=220.0, activation_energy=1e6)]
)
def test_at_the_reference_nothing_is_shifted_not_even_by_rounding(law):
    assert law.shift == 1.0
    for solid in OF_EACH_TYPE.values():
        scene = Scene(Sphere(radius=1e-2), solid, Indent(load=1.0), temperature=law)
        for form in ("relaxation", "retardation"):
            for stated, found in zip(getattr(solid, form)(), getattr(scene.solid, form)(), strict=True):
                np.testing.assert_array_equal(found, stated)
        assert scene.solid.viscosity == solid.viscosity


@pytest.mark.parametrize("factor", FACTORS)
@pytest.mark.parametrize("name", OF_EACH_TYPE)
def test_all_times_are_longer_by_the_factor_and_no_modulus_is_another(name, factor):
    solid, shifted = OF_EACH_TYPE[name], Shifted(OF_EACH_TYPE[name], factor)
    omega = np.geomspace(1e-3, 1e9, 25)
    np.testing.assert_allclose(
        shifted.complex_modulus(omega / factor), solid.complex_modulus(omega), rtol=ROUNDING
    )
    for form in ("relaxation", "retardation"):
        rest, amounts, times = getattr(solid, form)()
        found_rest, found_amounts, found_times = getattr(shifted, form)()
        assert found_rest == pytest.approx(rest, rel=CONVERTED)
        np.testing.assert_allclose(found_amounts, amounts, rtol=CONVERTED)
        np.testing.assert_allclose(found_times, times * factor, rtol=CONVERTED)
    assert (shifted.viscosity, shifted.glassy_modulus, shifted.indentation_modulus) == pytest.approx(
        (solid.viscosity * factor, solid.glassy_modulus, solid.indentation_modulus), rel=CONVERTED
    )
    assert shifted.poisson_ratio == solid.poisson_ratio


def test_the_dashpot_of_a_solid_that_states_its_relaxation_is_slower_too():
    @dataclass(frozen=True)
    class Damped(Linear):
        poisson_ratio = 0.5

        def modes(self):
            return Relaxation(1e6, np.array([2e6]), np.array([1e-3]), viscosity=50.0)

    omega = np.geomspace(1e-3, 1e9, 25)
    found = Shifted(Damped(), 7.0).complex_modulus(omega / 7.0)
    np.testing.assert_allclose(found, Damped().complex_modulus(omega), rtol=ROUNDING)


def test_times_that_rounding_makes_equal_are_one_mode():
    time, later, factor = 1.9, float(np.nextafter(1.9, 2)), 5.0
    assert time != later
    assert time * factor == later * factor
    merged = Shifted(Prony(1e6, (1e6, 1e6), (time, later)), factor)
    np.testing.assert_array_equal(merged.relaxation()[1], [2e6])
    chain = Shifted(KelvinChain(1e-7, (1e-6, 1e-6), (time, later)), factor)
    np.testing.assert_array_equal(chain.retardation()[1], [2e-6])
    assert chain.static_modulus == pytest.approx(1 / 2.1e-6, rel=ROUNDING)


def test_temperatures_where_a_law_ends_are_named():
    def arrhenius(temperature):
        return Arrhenius(temperature=temperature, reference=300.0, activation_energy=1e5)

    for ask, message in (
        (lambda: WLF(c1=8.86, c2=51.6, reference=293.15, temperature=20.0), r'above; is "20 degC" meant\?'),
        (lambda: universal(-51.6), r"temperature = 168.4 K: the law ends at reference - c2 = 168.4 K"),
        (lambda: universal(-50.5), r"temperature = 169.5 K: times would be longer by exp\(1.84e\+03\)"),
        (lambda: arrhenius(10.0), r"temperature = 10 K: times would be longer by exp\(1.16e\+03\), beyond"),
        (lambda: arrhenius(5e-324), r"beyond the range of numbers; give one closer to reference = 300 K"),
        (lambda: replace(arrhenius(300.0), activation_energy=1e300, temperature=301.0), "beyond the range"),
        (lambda: replace(universal(1.0), c2=-51.6), "greater than 0"),
    ):
        refused(message, ask)
    # so close to either end, and still a number
    assert 0 < universal(-48.0).shift < float("inf")
    assert 0 < arrhenius(1e300).shift < 1e-15


@pytest.mark.parametrize("factor", [1e305, 1e-320])
def test_times_that_leave_the_range_of_numbers_are_an_error(factor):
    far = Shifted(Kelvin(1e6, 1e10 if factor > 1 else 1e-10), factor)
    with pytest.raises(OverflowError, match="leave the range of numbers"):
        far.relaxation()
