"""Layers: waves against elasticity itself, kernels against their waves, contacts against what needs no grid."""

from dataclasses import replace
from decimal import Decimal, localcontext

import numpy as np
import pytest
from changing_motion import program
from scipy.integrate import quad

from bem3d import BEM
from bem3d.grid import Grid
from bem3d.motion.steady import Flow
from bem3d.response import influence
from bem3d.response.engine import Engine
from bem3d.response.halfspace import HalfSpace, Line
from bem3d.response.layer import FALSIFIED, Layered
from bem3d.response.layerwaves import Bonded, Frictionless
from compare.models.exact import full_contact
from compare.models.exact import layer as reference
from scene import (
    Cone,
    Cylinder,
    Elastic,
    Indent,
    Layer,
    Plane,
    Scene,
    Slide,
    SolveError,
    Sphere,
    StandardLinearSolid,
    Wave,
)

BASES = [Bonded(0.5), Bonded(0.4999), Bonded(0.3), Bonded(0.0), Bonded(-0.9), Frictionless()]
SPHERE = Sphere(10e-3)
SOFT, STANDARD = Elastic(1e6), StandardLinearSolid(1e6, 5e6, 1e-3)
ROUNDING = 1e-14  # relative: some tens of the last place


@pytest.mark.parametrize("base", BASES, ids=str)
def test_every_wave_has_all_its_digits(base):
    with localcontext(prec=400):
        for exponent in np.linspace(-6, 2.4, 15):
            t = float(10**exponent)
            x, gone = Decimal(t), (-2 * Decimal(t)).exp()
            if isinstance(base, Bonded):
                k = 3 - 4 * Decimal(base.poisson_ratio)
                above, below = k * (1 - gone**2) - 4 * x * gone, k * (1 + gone**2) + (4 * x * x + 1 + k * k) * gone
            else:
                above, below = (1 - gone) ** 2 / 2, (1 - gone**2) / 2 + 2 * x * gone
            assert float(Decimal(float(base.yields(t))) / (above / below) - 1) == pytest.approx(0, abs=ROUNDING)
            one_minus_compliance = Decimal(float(base.one_minus_compliance(t)))
            assert float(one_minus_compliance / (1 - above / below) - 1) == pytest.approx(0, abs=ROUNDING)


@pytest.mark.parametrize("base", BASES, ids=str)
def test_long_waves_are_springs_and_short_ones_a_half_space(base):
    with np.errstate(over="raise", invalid="raise", divide="raise"):
        assert base.yields(1e-6) / 1e-6 == pytest.approx(base.springs, rel=1e-10, abs=1e-12)
        np.testing.assert_array_equal(base.yields(np.array([20.0, 1e3, 1e6, np.inf]))[1:], 1.0)
    if base.springs > 0:  # and springs that are coupled over a length, the less the longer the wave
        coupled = abs(base.yields(1e-3) / 1e-3 - base.springs) / base.springs / 1e-6
        assert coupled == pytest.approx(base.spread**2, rel=1e-3, abs=1e-5)


def seen(kernel, q):
    """What a kernel of pixels does to a wave along x."""
    n = kernel.shape[1] // 2
    return np.exp(-1j * q * np.arange(-n, n)) @ (kernel[0] + 2 * kernel[1:].sum(axis=0))


def alike(q, thickness, base, flow, shift):
    """What it should do: the sum over all waves that look like it on the pixels."""
    every = q + 2 * np.pi * np.arange(-30000, 30001)
    own = np.sin(every / 2) / (every / 2) * 2 / np.abs(every) * base.yields(np.abs(every) * thickness)
    return np.sum(own * flow.compliance(every, 1.0) * np.exp(1j * every * shift))


KERNEL = 1e-9  # of sums of some thousand pixels, with memory to 1e-11 each; the waves left out bring 1e-10
FLOWS = {
    "rest": Flow(1.0, 1.0, np.empty(0), np.empty(0)),
    "flow": Flow(1.0, 0.2, np.array([0.5, 0.3]), np.array([0.4, 3.0])),
}


@pytest.mark.parametrize("flow", FLOWS.values(), ids=FLOWS)
@pytest.mark.parametrize(
    ("medium", "base", "thickness"),
    [
        (HalfSpace, Bonded(0.3), 1.0),
        (HalfSpace, Frictionless(), 1.7),
        (Line, Bonded(0.5), 1.0),
        (Line, Bonded(0.3), 3.0),
    ],
)
def test_kernels_are_the_sum_of_their_waves(medium, base, thickness, flow):
    """44 thicknesses are all of them, and 40 memories."""
    n, width = 140, 1.0 if medium is Line else None
    surface, grid = medium(flow, Engine(), Layered(thickness, base)), Grid(n, float(n), width=width)
    shift = flow.collocation(grid)
    if flow.at_rest:
        kernel = surface._elastic(grid)
    else:
        kernel = surface._flowing(grid, flow.instantaneous, flow.shares, flow.lengths, shift)
    for q in (0.05, 0.4, 2.0, np.pi):
        assert abs(seen(kernel, q) - alike(q, thickness, base, flow, shift)) < KERNEL


@pytest.mark.parametrize("by", ["by_pixel", "by_strip"])
@pytest.mark.parametrize("base", [Bonded(0.5), Bonded(0.3)], ids=str)
def test_a_layer_no_thicker_than_a_pixel_yields_to_long_waves_as_it_should(base, by):
    n = 64
    for thickness in (0.999999, 0.3, 1e-6):
        rows = 1 if by == "by_strip" else n
        kernel = influence.elastic(n, rows, 0.0, getattr(Layered(thickness, base), by)(1.0))
        for q in (0.01, 0.1):
            true = 2 / q * base.yields(q * thickness)
            # pixels add 0.03 (q h)^2 h, see `Layered.falsified`
            assert seen(kernel, q) == pytest.approx(true, rel=0.01 * q**2, abs=0.04 * thickness**3 * q**2)


ENOUGH = 1.4  # pixels to the thickness with which every layer is shown


@pytest.mark.parametrize("poisson_ratio", [-0.9, 0.499, 0.5])
def test_enough_points_show_every_layer(poisson_ratio):
    for radius in (0.3, 3.0, 30.0, 1e3):
        assert Layered(1.0, Bonded(poisson_ratio)).falsified(1 / ENOUGH, radius) < FALSIFIED


ON_HALF_SPACES = 3e-3  # of the force: what 20 points and more bring there, with contacts of 8 pixels across


@pytest.mark.parametrize(
    "poisson_ratio",
    [0.49, *(pytest.param(nu, marks=pytest.mark.slow) for nu in (0.3, 0.45, 0.48, 0.493, 0.499, 0.4995, 0.5))],
)
def test_a_grid_that_is_not_refused_has_the_force_and_those_twice_as_fine_are_not_refused(poisson_ratio):
    """Contacts of 3 to 90 thicknesses, pixels of 1/8 to 10: some refused ones were up to 20 % off."""
    stated, solid, taken = Layer(thickness=1e-4), Elastic(1e6, poisson_ratio=poisson_ratio), 0
    for slenderness in (3, 20, 60, 90):
        known = reference.of_radius(
            SPHERE, stated, solid.indentation_modulus, poisson_ratio, slenderness * stated.thickness
        )
        scene, before = Scene(SPHERE, solid, Indent(depth=known.depth), layer=stated), False
        for points in (24, 32, 48, 64, 96):
            try:
                found = BEM(points=points).solve(scene)
            except SolveError:
                assert not before
                continue
            before = True
            taken += 1
            assert found.normal_force == pytest.approx(known.load, rel=FALSIFIED + ON_HALF_SPACES)
    assert taken > 5


@pytest.mark.parametrize("width", [None, 1.0])
def test_the_radius_of_spots_is_that_of_one_of_them(width):
    grid = Grid(400, 2.0, width=width)
    x, y = grid.places
    for middle in (0.0, 0.5):  # of one, and of two on either side
        touched = np.hypot(abs(x) - middle, y) < 0.3
        assert grid.spot_radius(touched) == pytest.approx(0.3, rel=0.02)  # of pixels: 1/60


@pytest.mark.parametrize(("thickness", "digit"), [(1e-7, 4), (1.55e-7, 9)])
def test_a_layer_that_no_grid_shows_is_refused_with_what_would_do_instead(thickness, digit):
    layer, nearly = Layer(thickness=thickness), 0.5 - 1e-10
    scene = Scene(SPHERE, Elastic(1e6, poisson_ratio=nearly), Indent(load=1.0), layer=layer)
    coarse = BEM(points=64, extent=2e-3)
    (reason,) = coarse.refusals(scene)
    assert f"of nu = {nearly:.15g} is too thin" in reason
    assert "no allowed number of points would do" in reason
    most = float(reason.split("Poisson ratio of at most ")[1])
    assert 0.5 - most == pytest.approx(digit * 1e-8, rel=1e-6)  # the greatest with one digit
    assert coarse.refusals(replace(scene, elastomer=Elastic(1e6, poisson_ratio=most))) == []
    assert BEM(points=16384, extent=2e-3).refusals(scene) != []


@pytest.mark.parametrize(
    ("shape", "base", "slenderness"),
    [
        (SPHERE, Bonded(0.45), 1.0),
        (SPHERE, Frictionless(), 10.0),
        (SPHERE, Bonded(0.0), 0.01),
        (Cone(0.1), Bonded(0.5), 10.0),
        (Cone(0.1), Bonded(0.0), 1.0),
    ],
    ids=str,
)
def test_force_and_depth_are_those_of_the_integral_equation(shape, base, slenderness):
    nu = getattr(base, "poisson_ratio", 0.4)
    stated = Layer(thickness=1e-3 / slenderness, base="bonded" if isinstance(base, Bonded) else "frictionless")
    solid = Elastic(1e6, poisson_ratio=nu)
    known = reference.of_radius(shape, stated, solid.indentation_modulus, nu, 1e-3)
    by_depth, by_load = (
        BEM(points=128).solve(Scene(shape, solid, motion, layer=stated))
        for motion in (Indent(depth=known.depth), Indent(load=known.load))
    )
    # of second order in the pixel, of first at the tip of a cone; and what pixels add to a layer of 5 of them
    tolerance = 3e-4 if shape is SPHERE else 3e-3
    assert (by_depth.normal_force, by_load.depth) == pytest.approx((known.load, known.depth), rel=tolerance)


WAVE = Wave(amplitude=1e-6, wavelength=1e-3)


@pytest.mark.parametrize(
    "scene",
    [
        Scene(SPHERE, STANDARD, Slide(speed=0.1, load=1.0)),
        Scene(Plane(), STANDARD, Slide(speed=0.1, pressure=2e4), WAVE),
        Scene(SPHERE, STANDARD, program({"duration": 1e-3, "load": 1.0}, {"duration": 1e-2, "speed": 0.1})),
    ],
    ids=["sphere", "plane", "program"],
)
def test_a_layer_without_end_is_a_half_space(scene):
    solver = BEM(points=64, tolerance=1e-9, steps=20)
    plain, endless, thin = (
        solver.solve(replace(scene, layer=each)) for each in (None, Layer(thickness=1e300), Layer(thickness=1e-4))
    )
    assert (endless.depth, endless.friction_force) == pytest.approx((plain.depth, plain.friction_force), rel=1e-8)
    assert abs(thin.friction_force / plain.friction_force - 1) > 0.02


def test_the_datum_of_a_line_is_what_a_thick_layer_gives_it():
    """A line load sinks -(2/pi) [ln(x/h) + c(0)] on it, so that the datum of the same depth is h exp(-c(0))."""
    thickness, motion = 10.0, Slide(speed=1.0, line_load=100.0)
    scene = Scene(Cylinder(10e-3), STANDARD, motion)
    plain = BEM(points=128).solve(scene)
    layered = BEM(points=128).solve(replace(scene, layer=Layer(thickness=thickness)))
    base = Bonded(0.5)
    rest = quad(lambda t: (base.yields(t) + np.expm1(-2 * t)) / t, 0, 30, epsabs=1e-13)[0]
    sunk = np.log(thickness / 10e-3) + np.log(2) + rest
    modulus = STANDARD.indentation_modulus
    expected = plain.depth + 2 * motion.line_load / np.pi / modulus * sunk
    assert layered.depth == pytest.approx(expected, rel=1e-6)
    assert layered.friction_force == pytest.approx(plain.friction_force, rel=1e-5)


@pytest.mark.parametrize(
    ("base", "thickness"),
    [("bonded", 1e-9), ("bonded", 1e-4), ("frictionless", 1e-9), ("frictionless", 1e-5), ("frictionless", 1e-3)],
)
def test_full_contact_of_a_wave_on_a_layer_is_exact(base, thickness):
    """Pressure, closure and friction are those of a half-space over M, from layers of 1e-6 waves to 1."""
    asked, t = (1e-9, 1e-3, STANDARD, 0.1), 2 * np.pi * thickness / 1e-3  # amplitude, wavelength, solid, speed
    hard = 1 - float(reference.remainder(t, base, 0.5))
    if thickness < 1e-4:
        hard = 2 * t**3 / 3 if base == "bonded" else t / 2
    closure, friction = full_contact.wave_closure(*asked) / hard, full_contact.wave_friction(*asked) / hard * 1e-6
    motion, wave = Slide(speed=0.1, pressure=1.1 * closure), replace(WAVE, amplitude=1e-9)
    scene = Scene(Plane(), STANDARD, motion, wave, Layer(thickness=thickness, base=base))
    found = BEM(points=32, tolerance=1e-10).solve(scene)
    assert found.measures["contact_fraction"] == 1
    # by the limit of thin layers to (q h)^2
    assert found.friction_force == pytest.approx(friction, rel=1e-2 if thickness == 1e-5 else 1e-6)


@pytest.mark.parametrize("indenter", [SPHERE, Cylinder(10e-3)])
def test_a_layer_too_thin_for_its_grid_is_refused_with_the_points_that_would_do(indenter):
    motion = Indent(load=1.0) if indenter is SPHERE else Indent(line_load=1000.0)
    scene = Scene(indenter, SOFT, motion, layer=Layer(thickness=1e-5))
    with pytest.raises(SolveError, match=r"layer\.thickness = 1e-05 m of nu = 0\.5 is too thin for pixels"):
        BEM(points=32).solve(scene)
    coarse = BEM(points=32, extent=2e-3)
    (reason,) = coarse.refusals(scene)
    enough = int(reason.split("points = ")[1].split()[0])
    assert BEM(points=enough, extent=2e-3).refusals(scene) == []
    # a layer that yields to an even pressure needs none of it
    assert coarse.refusals(replace(scene, elastomer=Elastic(1e6, poisson_ratio=0.3))) == []


def test_layers_beyond_all_measure_are_solved_or_an_error():
    scene = Scene(SPHERE, Elastic(1e6, poisson_ratio=0.3), Indent(load=1.0))
    thin = Layer(thickness=1e-12)
    found = BEM(points=64).solve(replace(scene, layer=thin))
    softness = reference.long_waves(thin, scene.solid.indentation_modulus, 0.3)
    assert found.depth == pytest.approx(
        np.sqrt(softness / np.pi / SPHERE.radius), rel=2e-3
    )  # F = pi R d^2/softness
    with pytest.raises(SolveError):
        BEM(points=64).solve(replace(scene, layer=Layer(thickness=1e-320)))
