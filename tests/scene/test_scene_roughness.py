"""Self-affine spectra: both densities carry the rms height and the rms slope, in either dimension."""

from dataclasses import replace
from itertools import pairwise, product

import numpy as np
import pytest
from maps import refused

from scene import CrossedWaves, SelfAffine, Spectrum, Wave

ROUNDING = 1e-12
# Integral over the directions of a line scan: measured 5e-14 on two decades.
QUADRATURE = 1e-11
ROUGH = SelfAffine(hurst=0.7, rms_height=3e-5, longest=1e-2, shortest=1e-4, seed=3)
TOP = ROUGH.q_max(0.0)
# The ends, the exponents at which an integral turns into a logarithm, and as near to those as numbers go.
HURSTS = [0.0, 1e-9, 0.5, np.nextafter(0.5, 1), 0.8, 1.0]
NODES, WEIGHTS = np.polynomial.legendre.leggauss(60)


@pytest.fixture(params=product(HURSTS, (None, 2e-3, 1e-2)), ids=str)
def rough(request):
    hurst, rolloff = request.param
    return replace(ROUGH, hurst=hurst, rolloff=rolloff)


def integral(function, rough):
    """Over the wave numbers of the spectrum, in their logarithm: to the corner and from it."""
    low, corner, high = np.log([rough.q_min, rough.q_rolloff, TOP])
    return _between(low, corner, function) + _between(corner, high, function)


def _between(low, high, function):
    # Not a rounding outside.
    q = np.exp((low + high) / 2 + (high - low) / 2 * NODES)
    return (high - low) / 2 * WEIGHTS @ (q * function(q))


def test_both_densities_integrate_to_the_rms_height_and_to_the_rms_slope(rough):
    line = 2 * integral(lambda q: rough.density_1d(q, TOP), rough)
    surface = 2 * np.pi * integral(lambda q: q * rough.density_2d(q, TOP), rough)
    assert (line, surface) == pytest.approx((rough.rms_height**2,) * 2, rel=ROUNDING)
    steep = 2 * integral(lambda q: q**2 * rough.density_1d(q, TOP), rough)
    gradient = 2 * np.pi * integral(lambda q: q**3 * rough.density_2d(q, TOP), rough)
    assert (steep, gradient) == pytest.approx((rough.rms_slope(TOP) ** 2,) * 2, rel=ROUNDING)


@pytest.mark.parametrize("hurst", [0.0, 0.3, 1.0])
@pytest.mark.parametrize("rolloff", [None, 1.1e-4, 1e-3, 1e-2])
@pytest.mark.parametrize("slope", [0.0, 1e-9, 0.3, 5.0])
def test_a_slope_in_place_of_the_height_is_the_slope_of_the_surface(hurst, rolloff, slope):
    rough = SelfAffine(hurst=hurst, rms_slope=slope, longest="10 mm", shortest="0.1 mm", rolloff=rolloff)
    assert rough.rms_slope(rough.q_max(0.0)) == pytest.approx(slope, rel=ROUNDING)
    assert rough.flat == (slope == 0)
    assert replace(rough, seed=2).rms_height == rough.rms_height


@pytest.mark.parametrize("rolloff", [None, 2e-3])
@pytest.mark.parametrize("slope", [0.1, 0.3, 1.3])
def test_a_spectrum_is_cut_where_its_slope_reaches_what_is_stated(rolloff, slope):
    stated = {"hurst": 0.6, "rms_height": "20 um", "longest": "10 mm", "rolloff": rolloff}
    rough = SelfAffine(**stated, shortest_at_slope=slope)
    assert rough.rms_slope(rough.q_max(0.0)) == pytest.approx(slope, rel=1e-9)
    q = np.geomspace(rough.q_min, 1e3 * rough.q_min, 400)
    density = replace(rough, shortest=rough.longest / 1e3).density_2d(q, q[-1])
    table = Spectrum(q=q, C2D=density, convention="persson", shortest_at_slope=0.04)
    assert table.rms_slope(table.q_max(0.0)) == pytest.approx(0.04, rel=1e-9)
    assert table.shortest_kept == table.shortest


# Cut off where its slope is that of 0.1.
CUT = {"rms_slope": None, "shortest": None, "rms_height": 1e-5, "shortest_at_slope": 0.1}


@pytest.mark.parametrize(
    ("message", "stated"),
    [
        (
            "at_slope = 1e-05: between .* the rms slopes with waves down to 0.005",
            CUT | {"shortest_at_slope": 1e-5},
        ),
        ("shortest_at_slope = 1e[+]09: between", CUT | {"shortest_at_slope": 1e9}),
        ("shortest_at_slope = 0.1: state rms_height, and neither", CUT | {"shortest": 1e-4}),
        ("shortest_at_slope = '1 um': .*a number without a unit", CUT | {"shortest_at_slope": "1 um"}),
        ("rms_slope = 0.1: state shortest", {"shortest": None}),
        ("rms_slope = 0.1: .* no rms_height", {"rms_height": 1e-6}),
        ("rms_slope = -1: .* a number from 0 on", {"rms_slope": -1}),
        ("rms_slope = '3 deg': .*a number without a unit", {"rms_slope": "3 deg"}),
        ("rms_slope = True", {"rms_slope": True}),
        ("rms_slope = nan: .* a number from 0 on", {"rms_slope": float("nan")}),
        ("rms_height = inf: .*finite", {"rms_slope": 1e300, "longest": 1e300, "shortest": 1e200}),
        # mistakes of other fields are their own
        ("hurst.*Input should be less than or equal to 1", {"hurst": 2}),
        ("longest: missing", {"longest": None}),
    ],
)
def test_a_slope_that_states_or_cuts_no_surface_is_refused_with_the_reason(message, stated):
    content = {"hurst": 0.5, "rms_slope": 0.1, "longest": 1e-2, "shortest": 1e-4} | stated
    refused(message, SelfAffine, **{name: value for name, value in content.items() if value is not None})


@pytest.mark.parametrize("hurst", HURSTS)
def test_the_density_falls_with_the_power_of_its_hurst_exponent_and_ends_at_the_cut_offs(hurst):
    rough = replace(ROUGH, hurst=hurst)
    first, second = rough.density_2d(rough.q_min * np.array([2.0, 4.0]), TOP)
    assert second / first == pytest.approx(2 ** (-2 * hurst - 2), rel=ROUNDING)
    outside = rough.density_2d(np.array([0.0, 0.99 * rough.q_min, 1.01 * TOP]), TOP)
    np.testing.assert_array_equal(outside, 0.0)
    assert np.all(rough.density_2d(np.array([rough.q_min, TOP]), TOP) > 0)


def test_above_the_rolloff_the_spectrum_is_flat_and_below_it_falls():
    rough = replace(ROUGH, rolloff=1e-3)
    q = rough.q_rolloff * np.array([0.1, 0.5, 1.0, 2.0])
    density = rough.density_2d(q, TOP) / rough.density_2d(rough.q_rolloff, TOP)
    np.testing.assert_allclose(density, [1, 1, 1, 2 ** (-2 * rough.hurst - 2)], rtol=ROUNDING)


@pytest.mark.parametrize(("kind", "mean_square"), [(Wave, 1 / 2), (CrossedWaves, 1 / 4)])
def test_waves_have_the_rms_height_of_their_cosines(kind, mean_square):
    wave = kind(amplitude=3.0, wavelength=2.0)
    assert wave.rms_height == pytest.approx(3 * mean_square**0.5, rel=ROUNDING)
    assert not wave.flat
    assert replace(wave, amplitude=0.0).flat
    assert replace(ROUGH, rms_height=0.0).flat


def by_quadrature(rough, q):
    """C_1D of a line scan by its definition: over the wave numbers s across the line, in panels."""
    corners = [np.sqrt(max(c**2 - q**2, 0.0)) for c in (rough.q_min, rough.q_rolloff, TOP)]
    total = 0.0
    for low, high in pairwise(corners):
        # s = q sinh(t)
        edges = np.linspace(np.arcsinh(low / q), np.arcsinh(high / q), 9)
        for a, b in pairwise(edges):
            t = (a + b) / 2 + (b - a) / 2 * NODES
            total += (b - a) / 2 * WEIGHTS @ (q * np.cosh(t) * rough.density_2d(q * np.cosh(t), TOP))
    return 2 * total


def test_a_line_scan_has_the_density_of_all_waves_that_it_cuts(rough):
    q = np.array([1e-3, 0.5, 0.99, 1.0, 1.01, 4.0, 20.0, 99.0, 99.99]) * rough.q_min
    expected = [by_quadrature(rough, each) for each in q]
    np.testing.assert_allclose(rough.density_line_scan(q, TOP), expected, rtol=QUADRATURE)
    np.testing.assert_array_equal(rough.density_line_scan(np.array([TOP, 2 * TOP]), TOP), 0.0)


def test_the_shares_of_a_line_scan_add_up_to_the_mean_square_height(rough):
    edges = rough.q_min * np.array([1e-9, 0.5, 1.0, 3.0, 50.0, 100.0])
    edges[-1] = TOP
    shares = rough.share_line_scan(edges[:-1], edges[1:], TOP)
    assert np.all(shares > 0)
    # Below the first edge its density is constant: 1e-9 of the first wave number hold about as much.
    assert shares.sum() == pytest.approx(1.0, abs=1e-8)
    inner = rough.q_min * np.array([7.0, 30.0])
    q = np.mean(inner) + np.diff(inner) / 2 * NODES
    held = np.diff(inner) * WEIGHTS @ rough.density_line_scan(q, TOP) / rough.rms_height**2
    assert rough.share_line_scan(*inner, TOP) == pytest.approx(held, rel=QUADRATURE)
