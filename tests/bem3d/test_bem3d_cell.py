"""Surfaces that repeat: waves against closed forms at rest and in full contact, and the wake that comes round."""

import numpy as np
import pytest

from bem3d import BEM
from bem3d.surface import RoughSurface
from compare.models.exact import full_contact, waves
from scene import (
    CrossedWaves,
    Elastic,
    Fractional,
    Indent,
    Kelvin,
    Plane,
    Prony,
    Scene,
    SelfAffine,
    Slide,
    StandardLinearSolid,
    Wave,
)

MODULUS = 4e6  # E* of a shear modulus of 1 MPa
SOFT = Elastic(1e6)
WAVE = Wave(amplitude=1e-5, wavelength=1e-3)
CROSSED = CrossedWaves(amplitude=1e-5, wavelength=1e-3)
ROUGH = SelfAffine(hurst=0.8, rms_height=2e-6, longest=1e-3, rolloff=2.5e-4, shortest=1e-3 / 16, seed=1)
ROUNDING = 1e-9
SOLIDS = [
    Kelvin(1e6, 1e-3),
    StandardLinearSolid(rubbery_modulus=1e6, glassy_modulus=1e9, relaxation_time=1e-3),
    Prony(equilibrium_modulus=1e6, moduli=(1e7, 1e6, 1e8), relaxation_times=(1e-5, 1e-2, 1e-9)),
    Fractional(modulus=1e6, relaxation_time=1e-3, exponent=0.3, lowest_frequency=1e-3, highest_frequency=1e9),
]


def pressed(roughness, motion, elastomer=SOFT):
    return Scene(Plane(), elastomer, motion, roughness)


@pytest.mark.parametrize("fraction", [0.02, 0.5, 0.98])
def test_one_wave_is_westergaards(fraction):
    closure = waves.wave_closure(MODULUS, WAVE.amplitude, WAVE.wavelength)
    scene = pressed(WAVE, Indent(pressure=fraction * closure))
    for points in (128, 512):
        result = BEM(points=points, tolerance=1e-7).solve(scene)
        assert result.fields["pressure"].shape == (1, points)  # nothing varies along y: one row stands for all
        assert result.normal_force == pytest.approx(fraction * closure * WAVE.wavelength**2, rel=ROUNDING)
        found = result.measures["contact_fraction"]
        assert found == pytest.approx(waves.wave_contact_fraction(fraction), abs=2 / points)
        gap = result.measures["mean_gap"] / WAVE.amplitude
        assert gap == pytest.approx(waves.wave_mean_gap(fraction), abs=5 / points**1.5)
        # the indenter's crests are the cosine's troughs
        phase = np.pi * result.fields["x"] / WAVE.wavelength + np.pi / 2
        expected = fraction * closure * waves.wave_pressure(fraction, phase)
        # the edge is known to a pixel, and the pressure rises there as a root: order 3/2 in the mean
        error = np.abs(result.fields["pressure"][0] - expected).mean() / (fraction * closure)
        assert error < 40 / points**1.5


@pytest.mark.parametrize(("fraction", "contact"), waves.CROSSED_FRACTIONS.items())
def test_crossed_waves_touch_as_published(fraction, contact):
    closure = waves.crossed_closure(MODULUS, CROSSED.amplitude, CROSSED.wavelength)
    result = BEM(points=512).solve(pressed(CROSSED, Indent(pressure=fraction * closure)))
    assert result.measures["contact_fraction"] == pytest.approx(contact, abs=5e-4)  # some pixels of the rim


@pytest.mark.parametrize(("roughness", "pressure"), [(ROUGH, 2e2), (ROUGH, 1e5), (CROSSED, 2e4)], ids=str)
def test_the_gap_of_a_pressure_asks_for_that_pressure(roughness, pressure):
    solver = BEM(points=128, tolerance=1e-7)
    by_pressure = solver.solve(pressed(roughness, Indent(pressure=pressure)))
    assert by_pressure.depth == pytest.approx(-by_pressure.measures["mean_gap"], rel=1e-6)
    by_gap = solver.solve(pressed(roughness, Indent(gap=by_pressure.measures["mean_gap"])))
    assert by_gap.measures["mean_pressure"] == pytest.approx(pressure, rel=1e-4)
    np.testing.assert_allclose(
        by_gap.fields["pressure"], by_pressure.fields["pressure"], atol=1e-3 * by_pressure.fields["pressure"].max()
    )


@pytest.mark.parametrize("speed", [0.0, 1e-2, 1e4])
@pytest.mark.parametrize("elastomer", SOLIDS, ids=lambda solid: solid.type)
@pytest.mark.parametrize("wave", [WAVE, CROSSED], ids=["one", "crossed"])
def test_full_contact_is_exact(elastomer, speed, wave):
    closed, friction = {
        Wave: (full_contact.wave_closure, full_contact.wave_friction),
        CrossedWaves: (full_contact.crossed_closure, full_contact.crossed_friction),
    }[type(wave)]
    pressure = 1.1 * closed(wave.amplitude, wave.wavelength, elastomer, speed)
    result = BEM(points=32, tolerance=1e-10).solve(pressed(wave, Slide(speed=speed, pressure=pressure), elastomer))
    expected = friction(wave.amplitude, wave.wavelength, elastomer, speed) * wave.wavelength**2
    assert result.measures["contact_fraction"] == 1
    for name in ("friction_by_traction", "friction_by_loss"):
        if speed or name == "friction_by_loss":
            assert result.measures[name] == pytest.approx(expected, rel=1e-6, abs=1e-9 * result.normal_force)
    assert result.friction_force == pytest.approx(expected, rel=1e-6, abs=1e-12 * result.normal_force)


def test_a_rough_plane_in_full_contact_is_the_sum_of_its_waves():
    elastomer, points, speed = SOLIDS[1], 64, 0.1
    surface, sides = RoughSurface.of(ROUGH, ROUGH.q_max(0.0)), (ROUGH.longest, ROUGH.longest)
    along = (np.arange(points) - (points - 1) / 2) * ROUGH.longest / points
    heights = surface.heights(along, along)
    expected = full_contact.pressure(-heights, sides, elastomer, speed)
    pressure = -1.1 * min(expected.min(), -expected.max())
    scene = pressed(ROUGH, Slide(speed=speed, pressure=pressure), elastomer)
    result = BEM(points=points, tolerance=1e-11).solve(scene)
    np.testing.assert_allclose(result.fields["pressure"] - pressure, -expected, atol=1e-6 * np.abs(expected).max())
    friction = full_contact.friction(heights, sides, elastomer, speed) * ROUGH.longest**2
    assert result.friction_force == pytest.approx(friction, rel=1e-6)


def test_the_wake_of_a_repeated_surface_lowers_what_touches():
    # slow, every asperity meets a relaxed surface; fast, it runs in the dent of the one before it
    fractions = [
        BEM(points=64).solve(pressed(ROUGH, Slide(speed=v, pressure=4e4), SOLIDS[0])).measures["contact_fraction"]
        for v in (0.0, 1e-2, 1.0)
    ]
    assert np.all(np.diff(fractions) < 0)


def test_friction_of_a_rough_plane_converges_and_its_disagreement_says_how_far():
    scene = pressed(ROUGH, Slide(speed=1e-1, pressure=1e5), SOLIDS[1])
    coarse, middle, fine = (BEM(points=n).solve(scene) for n in (64, 128, 512))
    for result in (coarse, middle):
        error = abs(result.friction_coefficient - fine.friction_coefficient)
        assert error < 3 * result.measures["friction_disagreement"]
    assert fine.measures["friction_disagreement"] < 0.3 * middle.measures["friction_disagreement"]
