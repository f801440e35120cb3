"""Surfaces that repeat: full contact against its closed form, and the pressure of a mean gap."""

import numpy as np
import pytest

from bem3d import BEM
from bem3d.surface import RoughSurface
from compare.models.exact import full_contact
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
)

SOFT = Elastic(1e6)
CROSSED = CrossedWaves(amplitude=1e-5, wavelength=1e-3)
ROUGH = SelfAffine(hurst=0.8, rms_height=2e-6, longest=1e-3, rolloff=2.5e-4, shortest=1e-3 / 16, seed=1)
SOLIDS = [
    Kelvin(1e6, 1e-3),
    StandardLinearSolid(rubbery_modulus=1e6, glassy_modulus=1e9, relaxation_time=1e-3),
    Prony(equilibrium_modulus=1e6, moduli=(1e7, 1e6, 1e8), relaxation_times=(1e-5, 1e-2, 1e-9)),
    Fractional(modulus=1e6, relaxation_time=1e-3, exponent=0.3, lowest_frequency=1e-3, highest_frequency=1e9),
]


def pressed(roughness, motion, elastomer=SOFT):
    return Scene(Plane(), elastomer, motion, roughness)


@pytest.mark.parametrize(("roughness", "pressure"), [(ROUGH, 2e2), (ROUGH, 1e5), (CROSSED, 2e4)])
def test_the_gap_of_a_pressure_asks_for_that_pressure(roughness, pressure):
    solver = BEM(points=128, tolerance=1e-7)
    by_pressure = solver.solve(pressed(roughness, Indent(pressure=pressure)))
    assert by_pressure.depth == pytest.approx(-by_pressure.measures["mean_gap"], rel=1e-6)
    by_gap = solver.solve(pressed(roughness, Indent(gap=by_pressure.measures["mean_gap"])))
    assert by_gap.measures["mean_pressure"] == pytest.approx(pressure, rel=1e-4)
    np.testing.assert_allclose(
        by_gap.fields["pressure"], by_pressure.fields["pressure"], atol=1e-3 * by_pressure.fields["pressure"].max()
    )


@pytest.mark.parametrize("speed", [1e-2, 1e4])
@pytest.mark.parametrize("elastomer", SOLIDS)
def test_a_rough_plane_in_full_contact_is_the_sum_of_its_waves(elastomer, speed):
    points = 64
    surface, sides = RoughSurface.of(ROUGH, ROUGH.q_max(0.0)), (ROUGH.longest, ROUGH.longest)
    along = (np.arange(points) - (points - 1) / 2) * ROUGH.longest / points
    heights = surface.heights(along, along)
    expected = full_contact.pressure(-heights, sides, elastomer, speed)
    pressure = -1.1 * min(expected.min(), -expected.max())
    scene = pressed(ROUGH, Slide(speed=speed, pressure=pressure), elastomer)
    result = BEM(points=points, tolerance=1e-10).solve(scene)
    np.testing.assert_allclose(result.fields["pressure"] - pressure, -expected, atol=1e-6 * np.abs(expected).max())
    friction = full_contact.friction(heights, sides, elastomer, speed) * ROUGH.longest**2
    for force in (
        result.friction_force,
        *(result.measures[f"friction_by_{name}"] for name in ("traction", "loss")),
    ):
        assert force == pytest.approx(friction, rel=1e-6, abs=1e-9 * result.normal_force)
