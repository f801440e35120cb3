"""Agreement with contact codes that no one here wrote: tamaas and ContactMechanics, the extra `peers`.

They put constant pressure on the same pixels, or the same waves of it on the same cell, so the discrete answers
are the same numbers: two answers differ by no more than the tolerances of their solvers. Tolerances here are about
ten times what was found. Without a peer its tests are skipped. tamaas 2.9 is wrong by 1/n in its highest wave
numbers where n, the points a side, is odd: it is compared at even n only.
"""

import numpy as np
import pytest
from changing_motion import program

from bem3d import BEM
from bem3d.grid import Grid
from bem3d.motion.marching import march
from bem3d.problem import Problem
from bem3d.response.engine import Engine
from scene import Elastic, Indent, Plane, Prony, Scene, SelfAffine, Sphere

# A warning of the peers, not of ours: without mpi4py, NuMPI warns on import that it stands in for it.
pytestmark = pytest.mark.filterwarnings("ignore:Could not import mpi4py:ImportWarning")

ELASTIC = Elastic(0.25)  # E* = 4G = 1
PRONY = Prony(1.0, (4.0, 2.0), (1.0, 0.1))
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


def ours(indenter, motion, roughness, points=128, **settings):
    """Our result, and the heights that a peer is to be given."""
    solver = BEM(points=points, **{"tolerance": TOLERANCE} | settings)
    result = solver.solve(Scene(indenter, ELASTIC, motion, roughness))
    return result, result.fields["height"]


def model_of(tamaas, heights, modulus, ratio):
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [1.0, 1.0], list(heights.shape))
    model.E, model.nu = modulus, ratio
    return model


def by_tamaas(tamaas, heights, pressure):
    """Pressure and gap on a cell."""
    model = model_of(tamaas, heights, 1.0, 0.0)
    solver = tamaas.PolonskyKeerRey(model, np.ascontiguousarray(-heights), LEFT)
    assert solver.solve(pressure) <= LEFT
    return model.traction, model["gap"]


def viscoelastic(tamaas, heights, tolerance, step):
    """The solver of tamaas for a cell of PRONY: a generalized Maxwell solid by backward Euler.

    Its answers are right only where the long-time shear modulus, here E / 3, is 1.
    """
    model = model_of(tamaas, heights, 3.0 * PRONY.equilibrium_modulus, PRONY.poisson_ratio)
    modes = list(PRONY.moduli), list(PRONY.relaxation_times)
    return tamaas.MaxwellViscoelastic(model, np.ascontiguousarray(-heights), tolerance, step, *modes)


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


# Mean pressure over E* times the rms gradient, from a few asperities to the last dry spots to none: what touches.
LOADS = {0.035: 0.08, 0.8: 0.92, 1.7: 0.9997, 2.5: 1.0}


@pytest.mark.parametrize("load", LOADS)
def test_a_rough_cell_agrees_with_both_peers_up_to_full_contact(tamaas, contact_mechanics, load):
    pressure = load * SLOPE
    result, heights = ours(Plane(), Indent(pressure=pressure), rough_plane(128))
    substrate = contact_mechanics.PeriodicFFTElasticHalfSpace(heights.shape, 1.0, (1.0, 1.0))
    for peer in (
        by_tamaas(tamaas, heights, pressure),
        by_contact_mechanics(substrate, heights, 1.0, external_force=pressure),
    ):
        assert agree(result, peer), apart(result, peer)
    assert result.measures["contact_fraction"] == pytest.approx(LOADS[load], rel=0.05)
    assert result.measures["mean_pressure"] == pytest.approx(pressure, rel=1e-12)


# Pressed for a second and held for another: 64 of our steps, of second order; 128 and 256 of theirs, of first
# order, extrapolated: the difference falls with the square of our step until it reaches the error of theirs, 1e-4.
PROGRAM = program({"duration": 1.0, "pressure": 0.1}, {"duration": 1.0})
IN_TIME = 3e-4


@pytest.fixture(scope="module")
def transients(tamaas):
    """Ours; times, mean gaps and shares in contact of tamaas in the middles of our steps; its last pressure."""
    rough, grid = rough_plane(64), Grid(64, 1.0)
    problem = Problem(Scene(Plane(), PRONY, PROGRAM.held, rough), Engine())
    history = march(problem, PROGRAM, grid, 1e-8, 64)
    heights = problem.heights(grid, problem.surface(grid))
    found = []
    for finer in (1, 2):
        solver = viscoelastic(tamaas, heights, 1e-8, 1 / (64 * finer))
        rows = []
        for step in range(1, 127 * finer + 1):
            solver.solve(float(PROGRAM.prescribed(step * solver.time_step)))
            traction = solver.model.traction
            rows.append((solver.model["gap"].mean(), np.mean(traction > 0)))
        found.append((np.array(rows[finer - 1 :: 2 * finer]), traction.copy()))
    (coarse, early), (fine, late) = found
    return history, rough.rms_height, 2 * fine - coarse, 2 * late - early


@pytest.mark.slow
def test_a_viscoelastic_cell_goes_the_way_of_tamaas(transients):
    history, height, theirs, pressure = transients
    resolved = history.time > 0.25  # at first a few pixels touch
    assert np.abs(-history.depth - theirs[:, 0])[resolved].max() <= IN_TIME * height
    # a share of pixels that come into contact one by one: to eight of 4096
    assert np.abs(history.contact_area - theirs[:, 1]).max() <= 0.002
    assert np.abs(history.pressure - pressure).sum() <= IN_TIME * pressure.sum()


# A sphere of unit radius at a depth of 0.02: the contact is 0.28 across, on 0.6.
SPHERE = Sphere(1.0)
DEPTH, SIDE = 0.02, 0.6
ROUGH = SelfAffine(hurst=0.8, rms_height=4e-4, longest=1.0, rolloff=0.25, shortest=0.0625, seed=1)


@pytest.mark.parametrize("points", [64, 150])
@pytest.mark.parametrize("rough", [None, ROUGH])
def test_a_sphere_on_a_free_surface_agrees_with_contact_mechanics(contact_mechanics, rough, points):
    result, heights = ours(SPHERE, Indent(depth=DEPTH), rough, points=points, extent=SIDE)
    substrate = contact_mechanics.FreeFFTElasticHalfSpace(heights.shape, 1.0, (SIDE, SIDE))
    peer = by_contact_mechanics(substrate, heights, SIDE, offset=DEPTH)
    assert agree(result, peer), apart(result, peer)
    assert result.normal_force == pytest.approx(peer[0].sum() * (SIDE / points) ** 2, rel=FORCE)
