"""Linear solids: one list of modes, and everything that must follow from it."""

from dataclasses import replace
from decimal import Decimal, localcontext

import numpy as np
import pytest
from maps import refused
from solids import OF_EACH_TYPE

from scene import Elastic, Fractional, Kelvin, KelvinChain, Prony, StandardLinearSolid
from scene.solids.modes import Relaxation, Retardation

ROUNDING = 1e-13  # some tens of roundings; sums of terms with the same sign
EXACT = 1e-14  # of a single mode against 80 digits, a few roundings
G = 1e6
FREQUENCIES = np.geomspace(1e-10, 1e10, 2001)

every_solid = pytest.mark.parametrize("solid", OF_EACH_TYPE.values(), ids=OF_EACH_TYPE)


def spread(ratio=1e6, seed=0, viscosity=0.0):
    """Thirty random branches over 15 decades, moduli scattered by `ratio`."""
    rng = np.random.default_rng(seed)
    times = 10 ** np.append(rng.uniform(-15, 0, 28), (-15, 0)) * 1e3
    form = Relaxation.of(G, G * ratio ** rng.uniform(-1, 1, 30), times)
    return replace(form, viscosity=viscosity)


FORMS = {
    "30 modes over 15 decades": spread(),
    "tiny moduli": spread(ratio=1e20, seed=1),
    "glass of 1e12 times the rubber": Relaxation.of(
        1.0, np.geomspace(1e12, 1.0, 30), np.geomspace(1e-15, 1.0, 30)
    ),
    "equal moduli a decade apart": Relaxation.of(G, np.full(16, G), np.geomspace(1e-12, 1e3, 16)),
    "nearly equal times": Relaxation.of(G, np.full(10, G), 1e-3 * (1 + 1e-9 * np.arange(10) ** 2)),
    "neighbouring numbers": Relaxation.of(G, (G, 2 * G), (1e-3, np.nextafter(1e-3, 1))),
    "close pairs": Relaxation.of(
        G, np.tile((G, 1e-3 * G), 8), (np.geomspace(1e-9, 1e3, 8)[:, None] * (1, 1 + 1e-8)).ravel()
    ),
    "one mode": Relaxation.of(G, (9 * G,), (1e-3,)),
    "a dashpot": spread(viscosity=1e-4, seed=2),
    "a dashpot alone": replace(Relaxation.of(G), viscosity=1e3),
}
every_form = pytest.mark.parametrize("form", FORMS.values(), ids=FORMS)


def worst(found, expected):
    """Largest relative deviation, each number against its own."""
    return np.max(np.abs(np.asarray(found) / np.asarray(expected) - 1), initial=0.0)


@every_solid
def test_the_modulus_ends_at_the_static_and_the_glassy_one(solid):
    rest, glass = solid.static_modulus, solid.glassy_modulus
    ends = solid.complex_modulus(0.0), solid.relaxation_modulus(1e30), solid.relaxation_modulus(0.0)
    assert ends == pytest.approx((rest, rest, glass), rel=ROUNDING)
    creep = solid.creep_compliance(1e30), solid.creep_compliance(0.0)
    assert creep == pytest.approx((1 / rest, 1 / glass), rel=ROUNDING)
    assert replace(solid, poisson_ratio=0.5).indentation_modulus == 4 * rest
    assert replace(solid, poisson_ratio=0.0).indentation_modulus == pytest.approx(2 * rest)
    fast = solid.complex_modulus(1e30)
    if np.isfinite(glass):
        assert solid.viscosity == 0
        assert fast.real == pytest.approx(glass, rel=ROUNDING)
    else:
        assert fast.imag == pytest.approx(1e30 * solid.viscosity, rel=ROUNDING)


@every_solid
def test_convolving_relaxation_with_creep_gives_time(solid):
    # int_0^t G(t - s) J(s) ds = t, the dashpot's share viscosity * J(t) included.
    times = np.concatenate([solid.relaxation()[2], solid.retardation()[2], [1.0]])
    nodes, weights = np.polynomial.legendre.leggauss(20)
    for t in (times.min() / 3, np.median(times), times.max() * 3):
        # Both ends are resolved over all times that there are.
        half = np.geomspace(1e-30, 1.0, 400) * t / 2
        panels = np.concatenate([[0.0], half, t - half[-2::-1], [t]])
        low, width = panels[:-1, None], np.diff(panels)[:, None]
        s = low + width * (nodes + 1) / 2
        young = np.where(low < t / 2, t - s, (panels[1:, None] - s) + (t - panels[1:, None]))
        integral = np.sum(
            width / 2 * weights * solid.relaxation_modulus(young.clip(1e-300)) * solid.creep_compliance(s)
        )
        assert integral + solid.viscosity * solid.creep_compliance(t) == pytest.approx(t, rel=1e-9)


def test_a_negative_time_is_refused_by_value():
    for function in (Kelvin(G, 1e-3).relaxation_modulus, Kelvin(G, 1e-3).creep_compliance):
        refused(r"-0\.5", function, [1.0, -0.5], error=ValueError)


@every_solid
def test_modes_are_found_once_and_cannot_be_changed(solid):
    assert solid.retardation()[2] is solid.retardation()[2]
    for array in (*solid.relaxation()[1:], *solid.retardation()[1:]):
        assert not array.flags.writeable
        assert array.dtype == float


def test_a_kelvin_body_is_a_spring_beside_a_dashpot():
    body = Kelvin(G, 1e-3)
    np.testing.assert_allclose(body.complex_modulus(FREQUENCIES), G * (1 + 1e-3j * FREQUENCIES), rtol=ROUNDING)
    rest, moduli, times = body.relaxation()
    assert (rest, len(moduli), len(times)) == (pytest.approx(G, rel=ROUNDING), 0, 0)
    assert body.viscosity == pytest.approx(G * 1e-3, rel=ROUNDING)
    assert body.glassy_modulus == np.inf


def test_a_standard_linear_solid_is_a_prony_series_of_one_mode_and_a_chain_of_one_element():
    solid = StandardLinearSolid(G, 5 * G, 1e-3)
    one = Prony(G, (4 * G,), (1e-3,))
    chain = KelvinChain(0.2 / G, (0.8 / G,), (5e-3,))
    for other in (one, chain):
        np.testing.assert_allclose(
            other.complex_modulus(FREQUENCIES), solid.complex_modulus(FREQUENCIES), rtol=ROUNDING
        )


def test_branches_of_equal_times_are_one_in_either_form_and_in_any_order():
    parts = Prony(G, (2e6, 1e5, 3e6), (1e-3, 1e-6, 1e-3))
    whole = Prony(G, (1e5, 5e6), (1e-6, 1e-3))
    chain = KelvinChain(1e-9, (2e-6, 1e-8, 3e-6), (1.0, 1e-2, 1.0))
    merged = KelvinChain(1e-9, (1e-8, 5e-6), (1e-2, 1.0))
    for one, other in ((parts, whole), (chain, merged)):
        for first, second in zip(
            one.retardation() + one.relaxation(), other.retardation() + other.relaxation(), strict=True
        ):
            np.testing.assert_allclose(first, second, rtol=EXACT)


def by_decimals(form, nearby):
    """Retardation times and compliances, by bisection between two poles to far more digits, from EXACT ones on."""
    moduli, times = ([Decimal(float(value)) for value in array] for array in (form.moduli, form.times))
    poles, weights = times, [g * t for g, t in zip(moduli, times, strict=True)]
    if form.viscosity:
        poles, weights = [Decimal(0), *poles], [Decimal(form.viscosity), *weights]
    rest, near = Decimal(float(form.equilibrium)), Decimal(3 * EXACT)
    highest = poles[-1] + sum(weights) / rest
    for low, high, x in zip(poles, [*poles[1:], highest], nearby, strict=True):
        left, right = max(low, Decimal(float(x)) * (1 - near)), min(high, Decimal(float(x)) * (1 + near))
        for _ in range(150):
            x = (left + right) / 2
            excess = rest - sum(w / (x - p) for w, p in zip(weights, poles, strict=True))
            left, right = (left, x) if excess > 0 else (x, right)
        yield x, 1 / sum(w * x / (x - p) ** 2 for w, p in zip(weights, poles, strict=True))


@every_form
def test_every_mode_has_its_digits(form):
    creep = form.retardation()
    assert creep.instantaneous == pytest.approx(1 / form.glassy, rel=ROUNDING)
    with localcontext(prec=60):
        known = by_decimals(form, creep.times)
        for time, compliance, (x, residue) in zip(creep.times, creep.compliances, known, strict=True):
            assert abs(float(x / Decimal(float(time)) - 1)) <= EXACT
            assert abs(float(residue / Decimal(float(compliance)) - 1)) <= EXACT


@every_form
def test_conversion_keeps_the_complex_modulus_over_twenty_decades(form):
    creep = form.retardation()
    phase = 1 / (1 + 1j * FREQUENCIES[:, None] * creep.times)
    product = form.complex_modulus(FREQUENCIES) * (creep.instantaneous + phase @ creep.compliances)
    np.testing.assert_allclose(product, 1.0, rtol=1e-12)
    again = creep.relaxation().complex_modulus(FREQUENCIES) / form.complex_modulus(FREQUENCIES)
    np.testing.assert_allclose(again, 1.0, rtol=1e-12)


@pytest.mark.parametrize("instantaneous", [0.0, 1e-9])
def test_retardation_to_relaxation_and_back_is_where_it_began(instantaneous):
    form = Retardation.of(instantaneous, np.geomspace(1e-8, 1e-5, 20), np.geomspace(1e-9, 1e6, 20))
    between = form.relaxation()
    again = between.retardation()
    # Without a spring a dashpot takes the place of a branch.
    assert (len(between.times), between.viscosity > 0) == ((20, False) if instantaneous else (19, True))
    assert again.instantaneous == pytest.approx(instantaneous, rel=1e-12)
    assert worst(again.times, form.times) <= 1e-12
    assert worst(again.compliances, form.compliances) <= 1e-12


def test_numbers_beyond_the_range_of_numbers_are_an_error_and_no_answer():
    with pytest.raises((ArithmeticError, RuntimeWarning)):
        Relaxation.of(1.0, (1e300, 1.0), (1e300, 1.0)).retardation()
    with pytest.raises(ArithmeticError, match="further apart than the range of numbers"):
        StandardLinearSolid(1e-300, 1e300, 1e-3).retardation()


@pytest.mark.parametrize("make", [lambda many: Prony(1e6, many, many), lambda many: KelvinChain(1e-7, many, many)])
def test_the_modes_of_a_solid_have_a_bound_that_is_said(make):
    assert make((1.0,) * 200)
    refused("at most 200 items", make, (1.0,) * 201, error=ValueError)


IN_SHEAR = {
    Elastic: {"modulus": 1e6},
    Kelvin: {"modulus": 1e6, "relaxation_time": 1e-3},
    StandardLinearSolid: {"rubbery_modulus": 1e6, "glassy_modulus": 7e8, "relaxation_time": 1e-3},
    Prony: {"equilibrium_modulus": 1e6, "moduli": (2e6, 3e7), "relaxation_times": (1.0, 1e-3)},
    Fractional: {
        "modulus": 1e6,
        "relaxation_time": 1e-3,
        "exponent": 0.5,
        "lowest_frequency": 1.0,
        "highest_frequency": 1e3,
    },
}


def stretched(solid, ratio):
    """The fields of a solid with E in place of G."""
    found = {"poisson_ratio": ratio}
    for name, value in IN_SHEAR[solid].items():
        times = 2 * (1 + ratio) if "modul" in name else 1
        found[name.replace("modul", "youngs_modul")] = (
            tuple(times * each for each in value) if isinstance(value, tuple) else times * value
        )
    return found


@pytest.mark.parametrize("solid", IN_SHEAR)
@pytest.mark.parametrize("ratio", [0.5, 0.49, 0.3, 0.0, -0.5])
def test_a_solid_stated_by_young_s_modulus_is_that_of_its_shear_modulus(solid, ratio):
    found = solid(**stretched(solid, ratio))
    for name, value in IN_SHEAR[solid].items():
        assert getattr(found, name) == pytest.approx(value, rel=ROUNDING)
    assert found.poisson_ratio == ratio
    half = {name: value for name, value in stretched(solid, 0.5).items() if name != "poisson_ratio"}
    assert solid(**half) == solid(**IN_SHEAR[solid])


@pytest.mark.parametrize(
    ("stated", "message"),
    [
        ({"youngs_modulus": "3 MPa", "modulus": "1 MPa"}, "youngs_modulus and modulus: give one"),
        ({"youngs_modulus": "3 mm"}, "youngs_modulus.*a Young's modulus E, such as"),
        ({"youngs_modulus": 0.0}, "modulus = 0.0: .*greater than 0"),
        ({"youngs_modulus": 3e6, "poisson_ratio": 0.6}, "poisson_ratio.*0.5"),
        ({"youngs_modulus": 5e-324}, "modulus.*greater than 0"),
        ({}, "modulus.*missing"),
    ],
)
def test_a_wrong_young_s_modulus_is_refused_by_its_name(stated, message):
    refused(message, Elastic, **stated)


SHARES, TAU = (0.2, 0.3, 0.25), (0.1, 1.0, 10.0)
TERMS = Prony(2.5e6, (2e6, 3e6, 2.5e6), TAU)


@pytest.mark.parametrize(
    "modulus",
    [
        {"instantaneous_modulus": "10 MPa"},
        {"equilibrium_modulus": 2.5e6},
        {"instantaneous_youngs_modulus": "30 MPa"},
        {"instantaneous_youngs_modulus": 26e6, "poisson_ratio": 0.3},
    ],
)
@pytest.mark.parametrize("time", ["tau", "relaxation_times"])
def test_normalised_terms_are_the_plain_series(modulus, time):
    found = Prony(g=SHARES, **modulus, **{time: TAU})
    assert found == replace(TERMS, poisson_ratio=found.poisson_ratio)
    assert Prony(equilibrium_modulus=2.5e6, moduli=TERMS.moduli, tau=TAU) == TERMS


@pytest.mark.parametrize(
    ("stated", "message"),
    [
        ({"g": SHARES, "tau": TAU}, "give one of instantaneous_modulus and equilibrium_modulus"),
        (
            {"g": SHARES, "tau": TAU[:2], "instantaneous_modulus": 1e6},
            "relaxation_times has 2 values, moduli has 3",
        ),
        ({"g": (0.5, 0.7), "tau": TAU[:2], "equilibrium_modulus": 1e6}, "the sum 1.2 leaves no modulus at rest"),
        ({"g": (0.5, -0.1), "tau": TAU[:2], "instantaneous_modulus": 1e6}, "g: the sum 0.4 .*each above 0"),
        ({"g": SHARES, "moduli": SHARES, "tau": TAU, "instantaneous_modulus": 1e6}, "g and moduli"),
        ({"moduli": SHARES, "tau": TAU, "instantaneous_modulus": 1e6}, "instantaneous_modulus goes with g"),
        ({"g": (), "tau": (), "instantaneous_modulus": 1e6}, "moduli.*at least 1"),
    ],
)
def test_normalised_terms_that_are_no_solid_are_refused(stated, message):
    refused(message, Prony, **stated)
