"""Where a rough contact stands: its ratios from their definitions, its flags at their limits."""

from dataclasses import replace
from math import inf, sqrt

import numpy as np
import pytest

from scene import Cone, Elastic, Indent, PowerLaw, Regime, Scene, Sphere
from scene.scales import MUCH_LESS_HEIGHT, MUCH_LESS_SLOPE, SMALL_SLOPE, elastic_contact

# A mean over 20000 points of a smooth function.
QUADRATURE = 1e-8
GOOD = Regime(height_over_depth=0.05, contact_over_period=0.5, macro_over_rough=0.1, rms_slope=0.2)


@pytest.mark.parametrize("shape", [Sphere(radius=0.1), Cone(angle=0.1), PowerLaw(coefficient=50.0, exponent=3.5)])
def test_ratios_are_those_of_the_smooth_contact(shape):
    contact = elastic_contact(Scene(shape, Elastic(modulus=1e6), Indent(load=2.0)))
    c, n = shape.mdr_coefficient, shape.exponent
    regime = Regime.of((c, n), (contact.radius, contact.depth), 1e-6, 1e-2, 0.07)
    x = (np.arange(20000) + 0.5) / 20000 * contact.radius
    macro = sqrt(np.mean((c * n * x ** (n - 1)) ** 2))
    assert regime.macro_over_rough == pytest.approx(macro / 0.07, rel=QUADRATURE)
    assert (regime.height_over_depth, regime.contact_over_period) == pytest.approx(
        (1e-6 / contact.depth, 2 * contact.radius / 1e-2)
    )
    assert regime.rms_slope == 0.07


@pytest.mark.parametrize(
    ("name", "condition", "limit"),
    [
        ("height_over_depth", "h0 << d", MUCH_LESS_HEIGHT),
        ("contact_over_period", "2a < L", np.nextafter(1.0, 0.0)),
        ("macro_over_rough", "macro slope << roughness slope", MUCH_LESS_SLOPE),
        ("rms_slope", "small slopes", SMALL_SLOPE),
    ],
)
def test_each_flag_falls_with_its_own_ratio(name, condition, limit):
    assert all(GOOD.flags.values())
    assert all(replace(GOOD, **{name: limit}).flags.values())
    beyond = replace(GOOD, **{name: np.nextafter(limit, inf)}).flags
    assert [key for key, holds in beyond.items() if not holds] == [condition]


def test_heights_that_are_all_zero_have_no_slope_to_outweigh_the_indenter():
    regime = Regime.of((10.0, 2.0), (1e-3, 1e-5), 0.0, 1e-2, 0.0)
    assert regime.macro_over_rough == inf
    assert not regime.flags["macro slope << roughness slope"]
