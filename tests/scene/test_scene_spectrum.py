"""Measured spectra: moments, Abel's inversion of line scans, what they leave out, and how a table is read."""

from dataclasses import replace
from itertools import pairwise
from math import gamma, pi, sqrt

import numpy as np
import pytest
from maps import refused
from scipy.integrate import quad

from scene import Elastic, Indent, Scene, SelfAffine, Spectrum, Sphere, doubts, notes
from scene.files.reading import read

ROUNDING = 1e-12
# Of scipy's quad between the points.
QUAD = 1e-9
Q = np.geomspace(1e3, 1e6, 7)
BENT = (3e-18, 2e-18, 2.5e-18, 3e-20, 5e-20, 1e-22, 4e-24)  # a density that rises and falls
ROUGH = Spectrum(q=Q, C2D=BENT, convention="persson", seed=3)
WRONG = {"q": [1e3, 1e4, 1e5], "C2D": [1e-18, 1e-20, 1e-24], "convention": "persson"}


def integral(rough, power, low=Q[0], high=Q[-1]):
    """int q^power C_2D dq by scipy, from point to point."""
    ends = [low, *(each for each in sorted(rough.q) if low < each < high), high]
    density = lambda q: float(rough.density_2d(q, rough.q_max(0.0)))  # noqa: E731
    return sum(quad(lambda q: q**power * density(q), *pair, epsrel=1e-11)[0] for pair in pairwise(ends))


def test_height_and_slope_are_the_moments_of_the_stated_density():
    top = ROUGH.q_max(0.0)
    np.testing.assert_allclose(ROUGH.density_2d(np.array(ROUGH.q), top), BENT, rtol=ROUNDING)
    assert (ROUGH.rms_height, ROUGH.rms_slope(top)) == pytest.approx(
        (sqrt(2 * pi * integral(ROUGH, 1)), sqrt(2 * pi * integral(ROUGH, 3))), rel=QUAD
    )


def test_between_the_points_the_density_is_a_power_law_and_beyond_them_zero():
    middle, top = np.sqrt(Q[1:] * Q[:-1]), ROUGH.q_max(0.0)
    expected = np.sqrt(np.array(BENT)[1:] * np.array(BENT)[:-1])
    np.testing.assert_allclose(ROUGH.density_2d(middle, top), expected, rtol=ROUNDING)
    np.testing.assert_array_equal(ROUGH.density_2d(np.array([0.99 * Q[0], 1.01 * Q[-1]]), top), 0.0)


def test_the_order_of_the_points_does_not_matter():
    turned = replace(ROUGH, q=ROUGH.q[::-1], C2D=ROUGH.C2D[::-1])
    assert (turned.rms_height, turned.longest, turned.notes) == (ROUGH.rms_height, ROUGH.longest, ROUGH.notes)


@pytest.mark.parametrize("hurst", [0.1, 0.8, 1.5])
def test_a_power_law_of_a_line_has_the_surface_of_the_closed_form(hurst):
    # 2 int_q^inf k C_2D / sqrt(k^2 - q^2) dk of C_2D = k^(-2 - 2 H)
    C1D = sqrt(pi) * gamma(hurst + 0.5) / gamma(hurst + 1) * Q ** (-1 - 2 * hurst)
    rough = Spectrum(q=Q, C1D=C1D, sides="two", convention="persson")
    np.testing.assert_allclose(rough.density_2d(Q, rough.q_max(0.0)), Q ** (-2 - 2 * hurst), rtol=1e-10)


def test_a_surface_has_the_line_scans_from_which_it_was_found():
    q = np.geomspace(1e3, 1e7, 41)
    C1D = 1e-15 / (1 + (q / 1e4) ** 2.6)
    rough = Spectrum(q=q, C1D=C1D, sides="two", convention="persson")
    seen = rough.density_line_scan(q, rough.q_max(0.0))
    below = q < 1e5  # above, what is cut off beyond the last point lacks: (q / q_max)^2.6 of it
    np.testing.assert_allclose(seen[below], C1D[below], rtol=2e-3)


def test_conventions_sides_and_frequencies_are_those_of_the_definitions():
    by_hand = sqrt(integral(ROUGH, 1) / (2 * pi))
    jacobs = replace(ROUGH, convention="jacobs")
    assert jacobs.rms_height == pytest.approx(by_hand, rel=QUAD)
    falling = np.array(Q) ** -2.6
    two = Spectrum(q=Q, C1D=falling, sides="two", convention="jacobs")
    same = (
        replace(two, sides="one", C1D=2 * falling),
        replace(two, convention="persson", C1D=falling / (2 * pi)),
        Spectrum(table={"frequency": Q / (2 * pi), "C1D": falling}, sides="two", convention="jacobs"),
        Spectrum(q=[f"{each} rad/m" for each in Q], C1D=two.C1D, sides="two", convention="jacobs"),
    )
    np.testing.assert_allclose([each.rms_height for each in same], two.rms_height, rtol=ROUNDING)
    # <h^2> = 1/pi int C1D dq of the line scans of what was drawn
    top = two.q_max(0.0)
    edges = np.append(1e-6, np.geomspace(1e2, top, 9))
    assert two.share_line_scan(edges[:-1], edges[1:], top).sum() == pytest.approx(1.0, abs=1e-7)


def test_waves_that_are_not_kept_are_cut_off_exactly():
    cut = replace(ROUGH, longest_kept=2 * pi / 2e3, shortest_kept=2 * pi / 3e5)
    assert (cut.q_min, cut.q_max(0.0)) == pytest.approx((2e3, 3e5), rel=ROUNDING)
    assert cut.rms_height == pytest.approx(sqrt(2 * pi * integral(ROUGH, 1, 2e3, 3e5)), rel=QUAD)
    assert cut.density_2d(1e4, 3e5) == pytest.approx(float(ROUGH.density_2d(1e4, 1e6)), rel=ROUNDING)


@pytest.mark.parametrize(("low", "high"), [(-1.0, -5.0), (0.0, -4.5), (-2.0, -4.0), (-3.0, -2.5)])
def test_what_the_ends_leave_out_is_the_integral_of_their_laws(low, high):
    """q^low below 1e4 rad/m and q^high above: C_2D goes on, to where its moments have no bound."""
    q = np.array([1e3, 1e4, 1e5])
    rough = Spectrum(q=q, C2D=[10.0**-low, 1.0, 10.0**high], convention="persson")
    for m in (1, 3):
        inside, longer, shorter = rough._moment(m, 0.0, 1e9), 1.0, 1.0
        if low + m + 1 > 0:
            left = 10.0**-low * 1e3 ** (m + 1) / (low + m + 1)
            longer = left / (left + inside)
        if high + m + 1 < 0:
            left = 10.0**high * 1e5 ** (m + 1) / -(high + m + 1)
            shorter = left / (left + inside)
        assert (rough.height_left_out if m == 1 else rough.slope_left_out) == pytest.approx(
            (longer, shorter), rel=1e-9
        )


def test_what_is_not_kept_of_a_table_counts_as_left_out():
    # Next to nothing is beyond the table, and a tenth of the mean square height not kept.
    rough = Spectrum(q=[1e3, 1e4, 2e4, 1e5], C2D=[1e-20, 1e-18, 1e-21, 1e-30], convention="persson")
    assert max(rough.height_left_out) < 0.01
    cut = replace(rough, shortest_kept=2 * pi / 1.1e4)
    assert cut.height_left_out[1] == pytest.approx(1 - (cut.rms_height / rough.rms_height) ** 2, abs=1e-4)


def scene_of(rough):
    return Scene(Sphere(radius=1e-2), Elastic(1e6), Indent(load=1.0), rough)


def test_height_slope_and_what_is_left_out_are_said():
    seen = Spectrum(q=[1e3, 1e4, 3e4, 1e5], C2D=[2e-22, 1e-20, 1e-23, 1e-28], convention="persson")
    assert doubts(scene_of(seen)) == ()
    high, wide = notes(scene_of(seen))
    assert f"rms height of {seen.rms_height:.3g} m" in high
    assert f"rms slope of the full gradient of {seen.rms_slope(1e5):.3g}" in high
    shorter = [100 * each[1] for each in (seen.height_left_out, seen.slope_left_out)]
    assert wide.endswith("shorter waves {:.3g} % and {:.3g} %".format(*shorter))
    self_affine = Spectrum(q=[1e3, 1e5], C2D=[1e-20, 1e-27], convention="persson")
    names = [each.name for each in doubts(scene_of(self_affine))]
    assert names == [
        f"share of the mean square {each} beyond an end of the spectrum" for each in ("height", "slope")
    ]


@pytest.mark.parametrize(
    ("message", "stated"),
    [
        ("1 points: from 2 to 5,000", {"q": [1e3], "C2D": [1e-18]}),
        ("5,001 points: .*average", {"q": range(1, 5002), "C2D": range(1, 5002)}),
        ("q = 1000 rad/m is there twice", {"q": [1e3, 1e4, 1e3]}),
        ("the longest has to be at least twice as long as the shortest", {"q": [1e3, 1.2e3, 1.9e3]}),
        ("q has 2 values, and the density 3", {"q": [1e3, 1e4]}),
        ("C2D.1.*Input should be greater than 0", {"C2D": [1e-18, 0.0, 1e-24]}),
        ("C2D.0.*Input should be a finite number", {"C2D": [np.nan, 1e-20, 1e-24]}),
        ("q.2.*Input should be a finite number", {"q": [1e3, 1e4, np.inf]}),
        ("give one of them", {"C1D": [1e-15, 1e-16, 1e-18], "sides": "one"}),
        ("give one of them", {"C2D": None}),
        ("C2D has none, leave it out", {"sides": "two"}),
        ('C1D: state sides = "two"', {"C2D": None, "C1D": [1e-15, 1e-16, 1e-18]}),
        ("at q = 1e[+]04 rad/m .* below zero", {"C2D": None, "C1D": [1e-15, 1e-18, 1.1e-18], "sides": "two"}),
        (
            "at q = 4e[+]04 rad/m .* below zero",
            {"q": [1e3, 4e4, 9e4], "C2D": None, "C1D": [1e-15, 1e-18, 1e-18], "sides": "two"},
        ),
        ("1/m are cycles", {"q": ["1 1/mm", 1e4, 1e5]}),
        ("waves from 1e-06 m to .* of those of q from 6.28319e-05 m", {"shortest_kept": "1 um"}),
        ("waves from .* to 1 m, of those of q from .* to 0.00628", {"longest_kept": 1.0}),
        ("at least twice as long", {"longest_kept": "1 mm", "shortest_kept": "0.6 mm"}),
        ("an rms height of .* check the units", {"C2D": [1e120, 1e120, 1e120]}),
        ("table is missing", {"skip": 2}),
        ("q is stated, and a column of the table", {"table": {"q": [1.0, 3.0], "C2D": [1.0, 0.1]}, "C2D": None}),
    ],
)
def test_a_spectrum_that_is_none_is_refused_with_the_reason(message, stated):
    content = {name: value for name, value in (WRONG | stated).items() if value is not None}
    refused(message, Spectrum, **content)


def test_ten_decades_have_finite_numbers():
    q = np.array([1.0, 1e3, 1e10])
    wide = Spectrum(q=q, C2D=1e-10 * q**-3.6, convention="persson", seed=1)
    line = SelfAffine(hurst=0.8, rms_height=wide.rms_height, longest=2 * pi, shortest=2 * pi / 1e10)
    assert wide.rms_slope(1e10) == pytest.approx(line.rms_slope(1e10), rel=1e-9)
    edges = np.geomspace(1.0, 1e10, 50)
    np.testing.assert_allclose(
        wide.share(edges[:-1], edges[1:], 1e10), line.share(edges[:-1], edges[1:], 1e10), rtol=1e-9
    )


SCENE = """\
[indenter]
type = "sphere"
radius = "2 mm"
[elastomer]
type = "elastic"
modulus = "1 MPa"
[motion]
type = "indent"
load = "20 mN"
[roughness]
type = "spectrum"
table = "psd.csv"
"""
ROWS = "\n1;2e-5\n10;2,0e-9\n"
BY_MICROMETRES = {"q": (1e6, 1e7), "C2D": (2e-29, 2e-33)}


@pytest.mark.parametrize(
    ("heading", "stated", "expected"),
    [
        ("q [rad/um];C2D [um^4]", "", BY_MICROMETRES),
        ("wavevector (1/um);C_iso (um^4)", "", BY_MICROMETRES),
        ("q;C2D", "", {"q": (1.0, 10.0), "C2D": (2e-5, 2e-9)}),
        ("Frequency [1/mm];C1D [um^3]", 'sides = "one"', {"q": (2e3 * pi, 2e4 * pi), "C1D": (2e-23, 2e-27)}),
        (
            "a title\nk;PSD [um^4]",
            'skip = 1\ncolumns = {q = "k", C2D = "PSD"}\nunits = {q = "rad/um"}',
            BY_MICROMETRES,
        ),
    ],
)
def test_a_table_is_read_by_its_names_and_units(heading, stated, expected, tmp_path):
    (tmp_path / "psd.csv").write_text(heading + ROWS, encoding="utf-8")
    (tmp_path / "scene.toml").write_text(f'{SCENE}convention = "jacobs"\n{stated}\n', encoding="utf-8")
    rough = read(tmp_path / "scene.toml", Scene).roughness
    for name, values in expected.items():
        assert getattr(rough, name) == pytest.approx(values, rel=ROUNDING)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("q;C2D [um^4]" + ROWS, 'column .q. has no unit: state units = {q = "rad/m"}'),
        ("q [rad/um];C2D [um^3]" + ROWS, "a spectral density of a surface"),
        ("q;frequency;C2D\n1;2;3\n5;4;3\n", "one column q or frequency is needed"),
        ("q;C2D\n1;2\n10;0\n", "psd.csv, line 3: C2D = 0 is not above zero"),
    ],
)
def test_a_table_that_leaves_something_open_is_refused_with_the_option(text, message, tmp_path):
    (tmp_path / "psd.csv").write_text(text, encoding="utf-8")
    (tmp_path / "scene.toml").write_text(f'{SCENE}convention = "jacobs"\n', encoding="utf-8")
    refused(message, read, tmp_path / "scene.toml", Scene)
