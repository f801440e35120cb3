"""The reference of layers against what was published, its limits and a derivative; and the study of layers."""

from math import pi

import numpy as np
import pytest

from compare.models.exact import layer as reference
from scene import Cone, Layer, PowerLaw, Sphere

SPHERE, CONE = Sphere(10e-3), Cone(0.1)
MODULUS = 4e6
# F/F_Hertz(d) and a/sqrt(R d) of a sphere on a bonded incompressible layer by a/h.
PUBLISHED = {0.2: (1.26977, 1.08065), 0.5: (1.85712, 1.19845), 1.0: (3.37110, 1.33700), 2.0: (8.4680, 1.4827)}
ROUNDING = 1e-9  # of the equation at up to 100 thicknesses, whose condition is their cube


either_shape = pytest.mark.parametrize("shape", [SPHERE, CONE], ids=lambda shape: shape.type)


def contact(shape, slenderness, poisson_ratio, by=1.0, **base):
    """At a radius of a millimetre times a factor, over the thickness of the layer."""
    layer = Layer(thickness=1e-3 / slenderness, **base)
    return reference.of_radius(shape, layer, MODULUS, poisson_ratio, 1e-3 * by)


@pytest.mark.parametrize(("slenderness", "published"), PUBLISHED.items())
def test_a_bonded_incompressible_layer_is_the_published_one(slenderness, published):
    found = contact(SPHERE, slenderness, 0.5)
    hertz = 4 / 3 * MODULUS * np.sqrt(SPHERE.radius) * found.depth**1.5
    assert found.load / hertz == pytest.approx(published[0], rel=1e-5)  # digits as stated, also below
    assert found.radius / np.sqrt(SPHERE.radius * found.depth) == pytest.approx(published[1], abs=5e-5)


@pytest.mark.parametrize("shape", [SPHERE, CONE, PowerLaw(1e3, 4.0)], ids=lambda shape: shape.type)
@pytest.mark.parametrize("base", ["bonded", "frictionless"])
def test_a_thick_layer_is_a_half_space(shape, base):
    found = contact(shape, 1e-9, 0.4, base=base)
    n = shape.exponent
    depth = shape.mdr_coefficient * 1e-3**n
    assert found.depth == pytest.approx(depth, rel=1e-8)  # a/h = 1e-9 is left
    assert found.load == pytest.approx(2 * n / (n + 1) * MODULUS * depth * 1e-3, rel=1e-8)
    assert found.stiffness == pytest.approx(2 * MODULUS * 1e-3, rel=1e-8)


@either_shape
@pytest.mark.parametrize(
    ("base", "poisson_ratio"), [("bonded", 0.0), ("bonded", 0.3), ("frictionless", 0.5), ("bonded", 0.5)]
)
def test_a_thin_layer_is_a_bed_of_springs_or_a_film(shape, base, poisson_ratio):
    """What is left falls with h/a: half of it at twice the radius, or less.

    Springs yield to an even pressure, p = (d - z) / long_waves: d = c a^n, F = pi n / (n + 2) a^2 d / long_waves.
    A film at nu = 1/2 is squeezed out sideways, d - z = -(4 h^3 / (3 E*)) div grad p with p and its slope zero at
    the edge: 2 c a^n = (n + 2) d, F = 3 E* / (4 h^3) c a^(n + 4) pi n / [4 (n + 2) (n + 4)]; of a sphere
    F = 2 pi G R^2 (d/h)^3.
    """
    left, n = [], shape.exponent
    for slenderness in (25, 50, 100):
        stated = Layer(thickness=1e-3 / slenderness, base=base)
        found = contact(shape, slenderness, poisson_ratio, base=base)
        if base == "bonded" and poisson_ratio == 0.5:
            radius, order = ((n + 2) / 2 * found.depth / shape.coefficient) ** (1 / n), n + 4
            stiff = 3 * MODULUS / (4 * stated.thickness**3) / (4 * (n + 4))
            load = pi * n / (n + 2) * stiff * shape.coefficient * radius ** (n + 4)
        else:
            radius, order = (found.depth / shape.coefficient) ** (1 / n), n + 2
            softness = reference.long_waves(stated, MODULUS, poisson_ratio)
            load = pi * n / (n + 2) * radius**2 * found.depth / softness
        stiffness = order / n * load / found.depth
        left.append([found.radius / radius - 1, found.load / load - 1, found.stiffness / stiffness - 1])
    left = np.abs(left)
    assert np.all(left[-1] < 0.04)
    assert np.all(left[1:] < 0.6 * left[:-1] + 10 * ROUNDING)


@pytest.mark.parametrize("poisson_ratio", [-0.5, 0.3, 0.499, 0.5])
@pytest.mark.parametrize("slenderness", [0.1, 2.0, 50.0])
def test_stiffness_is_the_derivative_of_the_load(poisson_ratio, slenderness):
    below, at, above = (contact(CONE, slenderness, poisson_ratio, by) for by in (1 - 1e-4, 1, 1 + 1e-4))
    # of second order in 1e-4
    assert (above.load - below.load) / (above.depth - below.depth) == pytest.approx(at.stiffness, rel=1e-6)


@either_shape
@pytest.mark.parametrize("slenderness", [1e-3, 0.5, 10.0])
def test_a_contact_is_found_by_its_depth_and_by_its_load(shape, slenderness):
    stated = Layer(thickness=1e-3 / slenderness)
    known = contact(shape, slenderness, 0.5)
    for found in (
        reference.of_depth(shape, stated, MODULUS, 0.5, known.depth),
        reference.of_load(shape, stated, MODULUS, 0.5, known.load),
    ):
        assert (found.radius, found.load) == pytest.approx((known.radius, known.load), rel=ROUNDING)


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        (lambda layer: reference.of_radius(SPHERE, layer, MODULUS, 0.5, 1.0), "at most 100 thicknesses"),
        (lambda layer: reference.of_load(SPHERE, layer, MODULUS, 0.5, 1e12), "more than 100 thicknesses"),
    ],
)
def test_what_is_not_known_is_named(asked, message):
    with pytest.raises(ValueError, match=message):
        asked(Layer(thickness=1e-4))
