"""The foundation of the flow: what sinks it, what it gives back, and how few products a sliding contact takes."""

import numpy as np
import pytest
from solids import SOLIDS

from bem3d import BEM
from bem3d.contact import sums as kernels
from bem3d.grid import Grid
from bem3d.motion.steady import Flow
from bem3d.response.medium import MERGED, Foundation
from scene import Kelvin, Prony, Scene, SelfAffine, Slide, Sphere, StandardLinearSolid

ROWS, POINTS = 11, 40  # more rows than are marched side by side, and not a multiple
GRID = Grid(POINTS, float(POINTS))
FLOWS = {
    name: {speed: Flow.of(solid, speed) for speed in (0.1, 5.0, 1e5)}
    for name, solid in SOLIDS.items()
    if name != "elastic"
}
CASES = [
    pytest.param(flow, id=f"{name}-{speed:g}") for name, flows in FLOWS.items() for speed, flow in flows.items()
]


def drawn():
    """A set of contact, and values on the whole plane."""
    rng = np.random.default_rng(0)
    contact = rng.random((ROWS, POINTS)) < 0.6
    contact[3] = False
    return contact, rng.standard_normal((ROWS, POINTS))


def sinking(pressure, foundation):
    """How deep a pressure sinks the foundation."""
    plane = pressure.copy()
    kernels.foundation_displacement(plane, foundation)
    return plane


@pytest.mark.parametrize("wraps", [False, True])
@pytest.mark.parametrize("flow", CASES)
def test_a_foundation_that_is_pushed_back_had_that_pressure(flow, wraps):
    foundation, (contact, pressure) = Foundation.of(flow, GRID, wraps), drawn()
    pressure *= contact
    sunk = sinking(pressure, foundation)
    plane = sunk.copy()
    kernels.foundation_pressure(plane, contact, foundation)
    # A memory of many pixels leaves that few digits to the pressure on one.
    assert plane == pytest.approx(pressure, abs=1e-12 / foundation.at_once)
    released = np.where(contact, sunk, 7.0)
    kernels.with_free_surface(released, contact, foundation)
    assert released == pytest.approx(sunk, abs=1e-9)  # where nothing presses it is the surface that was


def test_a_step_of_pressure_sinks_as_the_solid_creeps():
    flow = Flow.of(SOLIDS["standard"], 5.0)
    plane = sinking(np.ones((1, POINTS)), Foundation.of(flow, GRID))
    (share,), (length,) = flow.shares, flow.lengths
    passed = np.arange(1, POINTS + 1)
    np.testing.assert_allclose(plane[0], flow.instantaneous + share * (1 - np.exp(-passed / length)), rtol=1e-12)
    np.testing.assert_allclose(flow.instantaneous + share, 1.0, rtol=1e-12)


def test_a_row_that_repeats_under_equal_pressure_is_relaxed():
    for flow in FLOWS["series"].values():
        plane = sinking(np.full((2, POINTS), 3.0), Foundation.of(flow, GRID, wraps=True))
        np.testing.assert_allclose(plane, 3.0, rtol=1e-9)


def test_what_would_pull_is_let_go_and_what_follows_presses_the_less():
    foundation = Foundation.of(Flow.of(SOLIDS["kelvin"], 10.0), GRID)
    pressure = np.array([[-1.0, 3.0, 2.0, 0.0, 1.0]])
    before = sinking(pressure, foundation)
    plane = before.copy()
    kernels.foundation_pressure(plane, pressure != 0, foundation, least=0.0)
    assert (plane >= 0).all()
    assert plane[0, 0] == 0.0
    assert 1.9 < plane[0, 1] < 3.0
    after = sinking(plane, foundation)
    np.testing.assert_allclose(after[0, 1:], before[0, 1:], rtol=1e-12)  # all that still presses is as deep
    np.testing.assert_allclose(plane[0, 2:], pressure[0, 2:], rtol=1e-9)


def test_modes_that_last_about_as_long_are_one_and_nothing_is_lost():
    flow = Flow(1.0, 0.2, np.array([0.1, 0.3, 0.4]), np.array([7.0, 1.0, 1.0 * MERGED**3]))
    foundation = Foundation.of(flow, GRID)
    assert len(foundation.kept) == 2
    np.testing.assert_allclose(np.sum(foundation.gained / (1 - foundation.kept)), 0.8, rtol=1e-12)
    assert Foundation.of(Flow.of(SOLIDS["kelvin"], 0.0), GRID) is None


# The slowest of 300 scenes drawn at random, at 256² and at 512², and some quick ones.
HARD = {
    "slow": (Kelvin(1e6, 1e-3), 0.004, None),
    "smooth, fast": (Kelvin(1e6, 1e-3), 380.0, None),
    "smooth, a glass 3000 times as stiff": (StandardLinearSolid(1e6, 3e9, 1e-3), 0.002, None),
    "rough": (Kelvin(1e6, 1e-3), 0.5, (0.04, 0.8, 6.0)),
    "rough, fast": (Kelvin(1e6, 1e-3), 25.0, (0.04, 0.4, 7.0)),
    "rough, faster": (Kelvin(1e6, 1e-3), 940.0, (0.012, 0.4, 2.5)),
    "rougher": (Kelvin(1e6, 1e-3), 6.0, (0.11, 0.7, 6.0)),
    "rough, of three modes": (Prony(1e6, (1e6, 3e7, 1e6), (1e-3, 1e-5, 1e-2)), 1.0, (0.2, 0.3, 3.0)),
}
A, RADIUS = 1e-3, 1e-2


def pairs(solid, memory, rough):
    """Transform pairs of a sphere; memory over a; rms height over depth, Hurst exponent, a over shortest wave."""
    if rough:
        height, hurst, waves = rough
        rough = SelfAffine(
            hurst=hurst, rms_height=height * A**2 / RADIUS, longest=3 * A, shortest=A / waves, seed=3
        )
    load = 4 / 3 * solid.indentation_modulus * A**3 / RADIUS
    scene = Scene(Sphere(RADIUS), solid, Slide(speed=memory * A / 1e-3, load=load), rough)
    return BEM(points=128).solve(scene).measures["transform_pairs"]


def test_sliding_takes_few_transforms():
    counts = [pairs(*case) for case in HARD.values()]
    assert max(counts) <= 200
    assert np.median(counts) <= 110  # of hard ones: 60 drawn at random have 55
