"""Agreement with contact codes that no one here wrote: tamaas and ContactMechanics, the extra `peers`.

They put constant pressure on the same pixels, or the same waves of it on the same cell, so the discrete answers
are the same numbers: two answers differ by no more than their solvers were told to leave. Tolerances are about
ten times what was found. Without a peer its tests are skipped.
"""

import numpy as np
import pytest

from bem3d import BEM
from bem3d.cell import Cell
from bem3d.engine import Engine
from bem3d.grid import Grid
from bem3d.halfspace import HalfSpace
from bem3d.sliding import Flow
from bem3d.surface import RoughSurface
from scene import Elastic, Indent, Plane, Prony, Scene, SelfAffine, Sphere

# Of the peers, not of ours: without mpi4py, NuMPI warns on import that it stands in for it.
pytestmark = pytest.mark.filterwarnings("ignore:Could not import mpi4py:ImportWarning")

ELASTIC = Elastic(0.25)  # E* = 4G = 1
SLOPE = 0.1  # rms of the full gradient of every rough plane here
TOLERANCE = 1e-10  # of ours on the gap, over the depth below the lowest point
LEFT = 1e-10  # complementarity error left by the peers, sum(p gap) / (sum(p) rms height)
PRESSURE = 1e-7  # of the largest pressure: like the square root of LEFT where an edge of contact hardly presses
GAP = 1e-8  # of the mean gap, over the rms height
POINTS = 1e-4  # of the surface may touch in one answer only: where it touches without pressure
FORCE = 1e-8


@pytest.fixture(scope="module")
def tamaas():
    module = pytest.importorskip("tamaas", exc_type=ImportError)
    module.initialize(1)
    module.set_log_level(module.LogLevel.warning)
    return module


@pytest.fixture(scope="module")
def contact_mechanics():
    pytest.importorskip("ContactMechanics", exc_type=ImportError)
    import ContactMechanics

    return ContactMechanics


def rough_plane(points, **changed):
    """Self-affine with roll-off, eight pixels on the shortest wave, rms gradient SLOPE, on a unit cell."""
    of = {"hurst": 0.8, "longest": 1.0, "rolloff": 0.25, "shortest": 8 / points, "seed": 1} | changed
    unit = SelfAffine(rms_height=1.0, **of)
    return SelfAffine(rms_height=SLOPE / unit.rms_slope(unit.q_max(1 / points)), **of)


def ours(indenter, motion, roughness, elastomer=ELASTIC, points=128, **settings):
    """Our result, and the heights that a peer is to be given."""
    solver = BEM(points=points, **{"tolerance": TOLERANCE} | settings)
    result = solver.solve(Scene(indenter, elastomer, motion, roughness))
    x, y = result.fields["x"], result.fields["y"]
    heights = indenter.height(x[None, :], y[:, None])
    if roughness is not None:
        q_max = roughness.q_max(result.measures["pixel"])
        heights = heights + RoughSurface.of(roughness, q_max).heights(x, y)
    return result, heights


def by_tamaas(tamaas, heights, pressure, modulus=1.0, ratio=0.0, steps=1, **history):
    """Pressure and gap on a cell; with shear moduli, times and a time step, after so many steps."""
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [1.0, 1.0], list(heights.shape))
    model.E, model.nu = modulus, ratio
    kind = tamaas.MaxwellViscoelastic if history else tamaas.PolonskyKeerRey
    solver = kind(model, np.ascontiguousarray(-heights), LEFT, **history)
    for _ in range(steps):
        left = solver.solve(pressure)
    assert left <= LEFT
    return model.traction.copy(), model["gap"].copy()


def by_contact_mechanics(substrate, heights, side, **pressed):
    """Pressure and gap, on a cell under a load or on a free surface at a depth (as `offset`)."""
    from ContactMechanics.Systems import NonSmoothContactSystem
    from SurfaceTopography import Topography

    points, pixel = len(heights), side / len(heights)
    system = NonSmoothContactSystem(substrate, Topography(-heights, (side, side)))
    scale = pressed.get("offset", heights.std())
    # Dimensional tolerances: of penetration, of tension, and of what a step changes.
    limits = {"pentol": LEFT * scale, "forcetol": LEFT * pixel**2, "thermotol": LEFT, "maxiter": 1000}
    if "offset" in pressed:  # from its own first guess, of displacements, it cycles on some rough spheres
        pressed["initial_forces"] = np.zeros((2 * points, 2 * points))
        pressed["initial_forces"][:points, :points] = -np.maximum(pressed["offset"] - heights, 0) * pixel
    found = system.minimize_proxy(**limits, **pressed)
    assert found.success, found.message
    return found.jac / pixel**2, found.x[:points, :points] + heights - found.offset


def apart(result, peer):
    """Largest difference of the pressure, difference of the mean gap, points that touch in one answer only."""
    pressure, gap = result.fields["pressure"], result.fields["gap"]
    height = result.measures.get("rms_height") or result.depth
    return (
        np.abs(pressure - peer[0]).max() / peer[0].max(),
        abs(gap.mean() - peer[1].mean()) / height,
        np.mean((pressure > 0) != (peer[0] > 0)),
    )


def agree(result, peer):
    return np.all(np.array(apart(result, peer)) <= (PRESSURE, GAP, POINTS))


def complementarity(pressure, gap, height):
    """The peers' error, by which all codes can be compared."""
    return np.sum(np.abs(pressure * gap)) / (pressure.sum() * height)


# Mean pressure over E* times the rms gradient, from a few asperities to the last dry spots to none: what touches.
LOADS = {0.035: 0.08, 0.2: 0.4, 0.8: 0.92, 1.4: 0.997, 1.7: 0.9997, 2.5: 1.0}


@pytest.mark.parametrize("load", LOADS)
def test_a_rough_cell_agrees_with_tamaas_up_to_full_contact(tamaas, load):
    pressure = load * SLOPE
    result, heights = ours(Plane(), Indent(pressure=pressure), rough_plane(128))
    peer = by_tamaas(tamaas, heights, pressure)
    assert agree(result, peer), apart(result, peer)
    assert result.measures["contact_fraction"] == pytest.approx(LOADS[load], rel=0.05)
    assert result.measures["mean_pressure"] == pytest.approx(peer[0].mean(), rel=1e-12)


@pytest.mark.parametrize("load", [0.035, 1.4])
def test_a_finer_rough_cell_agrees_with_both_peers(tamaas, contact_mechanics, load):
    pressure = load * SLOPE
    result, heights = ours(Plane(), Indent(pressure=pressure), rough_plane(256, seed=2), points=256)
    substrate = contact_mechanics.PeriodicFFTElasticHalfSpace(heights.shape, 1.0, (1.0, 1.0))
    for peer in (
        by_tamaas(tamaas, heights, pressure),
        by_contact_mechanics(substrate, heights, 1.0, external_force=pressure),
    ):
        assert agree(result, peer), apart(result, peer)


def test_a_cell_pressed_to_a_mean_gap_carries_the_pressure_of_tamaas(tamaas):
    wanted = 0.02
    _, heights = ours(Plane(), Indent(pressure=wanted), rough_plane(128))
    peer = by_tamaas(tamaas, heights, wanted)
    result, _ = ours(Plane(), Indent(gap=float(peer[1].mean())), rough_plane(128))
    assert agree(result, peer), apart(result, peer)
    assert result.measures["mean_pressure"] == pytest.approx(wanted, rel=PRESSURE)


@pytest.mark.parametrize("load", [0.035, 0.8])
def test_the_complementarity_error_of_the_peers_follows_our_tolerance(tamaas, load):
    # theirs is a mean over the pressure, ours the largest single gap over a depth of a few rms heights
    pressure = load * SLOPE
    for tolerance in (1e-4, 1e-6, 1e-8):
        result, heights = ours(Plane(), Indent(pressure=pressure), rough_plane(128), tolerance=tolerance)
        fields, height = result.fields, result.measures["rms_height"]
        assert complementarity(fields["pressure"], fields["gap"], height) <= 2 * tolerance
    assert complementarity(*by_tamaas(tamaas, heights, pressure), height) <= LEFT


def test_the_comparison_of_cells_can_fail(tamaas):
    pressure = 0.2 * SLOPE
    result, heights = ours(Plane(), Indent(pressure=pressure), rough_plane(128))
    nearly, _ = ours(Plane(), Indent(pressure=pressure * (1 + 1e-5)), rough_plane(128))
    peer = by_tamaas(tamaas, heights, pressure)
    assert agree(result, peer)
    assert not agree(nearly, peer)  # a load larger by 1e-5
    assert not agree(result, (peer[0].T, peer[1].T))  # x for y
    assert not agree(result, by_tamaas(tamaas, heights, pressure, modulus=1 + 1e-5))


# tamaas steps a generalized Maxwell solid by backward Euler. Its answers are right only where the long-time shear
# modulus, here model.E / 3 at nu = 1/2, is 1.
PRONY = Prony(1.0, (4.0, 2.0), (1.0, 0.1))
HISTORY = {"shear_moduli": list(PRONY.moduli), "characteristic_times": list(PRONY.relaxation_times)}


def test_a_viscoelastic_cell_held_for_long_is_where_tamaas_ends(tamaas):
    result, heights = ours(Plane(), Indent(pressure=0.1), rough_plane(128), PRONY)
    peer = by_tamaas(tamaas, heights, 0.1, 3.0, 0.5, steps=20, time_step=100.0, **HISTORY)
    assert agree(result, peer), apart(result, peer)


def test_a_viscoelastic_cell_pressed_at_once_is_where_tamaas_begins(tamaas):
    result, heights = ours(Plane(), Indent(pressure=0.1), rough_plane(128), Elastic(PRONY.glassy_modulus))
    peer = by_tamaas(tamaas, heights, 0.1, 3.0, 0.5, time_step=1e-9, **HISTORY)
    assert agree(result, peer), apart(result, peer)


def test_the_comparison_of_viscoelastic_cells_can_fail(tamaas):
    result, heights = ours(Plane(), Indent(pressure=0.1), rough_plane(128), PRONY)
    underway = by_tamaas(tamaas, heights, 0.1, 3.0, 0.5, steps=5, time_step=0.1, **HISTORY)
    assert not agree(result, underway)


# A sphere of unit radius at a depth of 0.02: the contact is 0.28 across, on 0.6.
SPHERE = Sphere(1.0)
DEPTH, SIDE = 0.02, 0.6
ROUGH = SelfAffine(hurst=0.8, rms_height=4e-4, longest=1.0, rolloff=0.25, shortest=0.0625, seed=1)


@pytest.mark.parametrize("points", [64, 150])
def test_the_kernels_are_those_of_contact_mechanics(contact_mechanics, points):
    # lengths in pixels, E* = 1; their free kernel has logarithms of ratios near one, which cost it 1e-12
    pressure, grid = np.random.default_rng(points).random((points, points)), Grid(points, float(points))
    flow = Flow.of(ELASTIC, speed=0.0)
    free = contact_mechanics.FreeFFTElasticHalfSpace(grid.shape, 1.0, grid.shape)
    cell = contact_mechanics.PeriodicFFTElasticHalfSpace(grid.shape, 1.0, grid.shape, stiffness_q0=0.0)
    for medium, theirs in ((HalfSpace(flow, Engine()), free), (Cell(flow, Engine()), cell)):
        displacement = medium.operator(grid)(pressure)
        expected = -theirs.evaluate_disp(pressure)  # of forces that pull
        np.testing.assert_allclose(displacement, expected, rtol=0, atol=1e-11 * np.abs(expected).max())


@pytest.mark.parametrize("points", [64, 128, 150])
@pytest.mark.parametrize("rough", [None, ROUGH], ids=["smooth", "rough"])
def test_a_sphere_on_a_free_surface_agrees_with_contact_mechanics(contact_mechanics, rough, points):
    result, heights = ours(SPHERE, Indent(depth=DEPTH), rough, points=points, extent=SIDE)
    substrate = contact_mechanics.FreeFFTElasticHalfSpace(heights.shape, 1.0, (SIDE, SIDE))
    peer = by_contact_mechanics(substrate, heights, SIDE, offset=DEPTH)
    assert agree(result, peer), apart(result, peer)
    assert result.normal_force == pytest.approx(peer[0].sum() * (SIDE / points) ** 2, rel=FORCE)


def test_the_comparison_of_spheres_can_fail(contact_mechanics):
    result, heights = ours(SPHERE, Indent(depth=DEPTH), ROUGH, points=64, extent=SIDE)
    _, smooth = ours(SPHERE, Indent(depth=DEPTH), None, points=64, extent=SIDE)
    substrate = contact_mechanics.FreeFFTElasticHalfSpace(heights.shape, 1.0, (SIDE, SIDE))
    assert not agree(result, by_contact_mechanics(substrate, smooth, SIDE, offset=DEPTH))
    assert not agree(result, by_contact_mechanics(substrate, heights, SIDE, offset=DEPTH * (1 + 1e-5)))
    stiffer = contact_mechanics.FreeFFTElasticHalfSpace(heights.shape, 1 + 1e-5, (SIDE, SIDE))
    assert not agree(result, by_contact_mechanics(stiffer, heights, SIDE, offset=DEPTH))
