"""What a plan says is what a solve builds: kernels counted as they are made, memory as it is held."""

from collections import Counter
from dataclasses import replace

import numpy as np
import planned as shared
import pytest
from changing_motion import program
from planned import BOWL, DRAWN, FACTOR, KELVIN, LOAD, SPHERE, STANDARD, STICKS, all_of_a_scene, held_by

from bem3d import BEM
from bem3d.plan import EFFECTS
from bem3d.response.convolution import FreeConvolution, FreePair, PeriodicFilter, PeriodicPair
from bem3d.response.halfspace import HalfSpace
from bem3d.response.layerwaves import PIECES, Taken, taking
from bem3d.response.memory import _kept
from bem3d.surface import RoughSurface
from scene import (
    CrossedWaves,
    Cylinder,
    Elastic,
    Indent,
    Layer,
    Measured,
    Plane,
    Prony,
    Scene,
    SelfAffine,
    Shear,
    Slide,
    Topography,
    Wave,
)
from scene.plan import multiples, size

EXTENT = 3e-3
ROUGH = SelfAffine(hurst=0.8, rms_height=5e-6, longest=2e-3, shortest=0.25e-3, seed=1)
CELL = SelfAffine(hurst=0.8, rms_height=2e-6, longest=1e-3, shortest=1.25e-4, seed=1)
MANY = Prony(1e6, (1e6,) * 40, tuple(1e-4 * 1.3**k for k in range(40)))
FAR = program(*({"duration": 1e-2, "load": LOAD, "speed": way} for way in (1.0, -1.0)))
PRESSED = program({"duration": 1e-3, "load": LOAD})
SCENES = shared.SCENES | {
    "rough": Scene(SPHERE, STANDARD, Slide(speed=0.1, load=LOAD), ROUGH),
    "plane": Scene(Plane(), KELVIN, Indent(pressure=1e4), CELL),
    "plane-slide": Scene(Plane(), STANDARD, Slide(speed=0.1, pressure=1e4), CELL),
    "waves": Scene(Plane(), KELVIN, Slide(speed=0.1, pressure=1e3), CrossedWaves(amplitude=1e-6, wavelength=1e-3)),
    "wave": Scene(Plane(), KELVIN, Slide(speed=0.1, pressure=1e4), Wave(amplitude=1e-6, wavelength=1e-3)),
    "line": Scene(Cylinder(10e-3), KELVIN, Indent(line_load=500.0)),
    "line-slide": Scene(Cylinder(10e-3), KELVIN, Slide(speed=0.1, line_load=500.0)),
    "pressed": Scene(SPHERE, STANDARD, PRESSED),
    "plane-program": Scene(Plane(), STANDARD, program({"duration": 1e-3, "pressure": 1e4, "speed": 0.1}), CELL),
}
HEIGHTS = RoughSurface.of(ROUGH, ROUGH.q_max(1.0)).heights(*np.tile(np.arange(16) * ROUGH.longest / 16, (2, 1)))
LAYER = Layer(thickness=1e-3)
SCENES |= {
    "layer": replace(SCENES["slide"], layer=LAYER),
    "layer-rest": replace(SCENES["rest"], layer=LAYER),
    "layer-plane": replace(SCENES["plane"], layer=LAYER),
    "layer-line": replace(SCENES["line-slide"], layer=LAYER),
    "layer-program": replace(SCENES["pressed"], layer=LAYER),
    "shear-uncoupled": Scene(SPHERE, Elastic(1e6, poisson_ratio=0.0), DRAWN, interface=STICKS),
    "shear-plane": replace(SCENES["plane"], motion=Shear(pressure=1e5, displacement=1e-7), interface=STICKS),
    "shear-line": replace(
        SCENES["line"], motion=Shear(line_load=500.0, displacement=1e-6), elastomer=Elastic(1e6), interface=STICKS
    ),
    "shear-not": replace(SCENES["rest"], motion=replace(DRAWN, displacement=0.0), interface=STICKS),
    "far-and-back": Scene(SPHERE, MANY, FAR),
    "measured": replace(SCENES["slide"], indenter=Measured(heights=BOWL, pixel=1e-4, peaks="down")),
    "topography": replace(
        SCENES["slide"], roughness=Topography(heights=HEIGHTS, pixel=ROUGH.longest / 16, repeat="periodic")
    ),
}
PLANES = SCENES["plane"], SCENES["plane-slide"], SCENES["layer-plane"], SCENES["plane-program"]


def solver(scene, points=64, **settings):
    """With a stated extent, so that one window is solved on and no other."""
    extent = None if isinstance(scene.indenter, Plane) else EXTENT
    return BEM(points=points, extent=extent, steps=10, **settings)


def forget_kernels(monkeypatch):
    """Build kernels anew, whatever other solves have left."""
    for name in ("_symbol", "_losing"):
        monkeypatch.setattr(HalfSpace, name, getattr(HalfSpace, name).__wrapped__)


@pytest.fixture
def built(monkeypatch):
    """Kernels and symbols as they are made: form and shape."""
    found = []

    def noting(kind, form, shape_of):
        make = kind.__init__

        def noted(self, first, *others, **named):
            found.append((form, shape_of(first)))
            make(self, first, *others, **named)

        monkeypatch.setattr(kind, "__init__", noted)

    noting(FreeConvolution, "kernel", lambda shape: (shape[0], 2 * shape[1]))
    noting(PeriodicFilter, "symbol", lambda shape: shape)
    noting(FreePair, "kernel", lambda kernels: kernels[0].shape)
    noting(PeriodicPair, "symbol", lambda shape: shape)
    noting(Taken, "table", lambda _: PIECES)
    lost = HalfSpace.lost

    def noted(self, grid, pressure):
        found.extend(2 * [("kernel", (grid.rows, 2 * grid.points + 2))])  # by the slope, and from pixel to pixel
        return lost(self, grid, pressure)

    monkeypatch.setattr(HalfSpace, "lost", noted)
    # What is kept from another solve is built as well.
    taking.cache_clear()
    monkeypatch.setattr("bem3d.grid.SIZES", ())
    forget_kernels(monkeypatch)
    return found


def planned(plan):
    """Of two components there are as many kernels, in one product."""
    return Counter((kernel.form, kernel.shape[-2:]) for kernel in plan.kernels)


def of_the_finest(built, plan):
    """Of a march everything: it has no coarser grids. Of the rest those of the finest."""
    if plan.steps:
        return Counter(built)
    rows, points = plan.shape
    finest = {
        "kernel": {(rows, 2 * points), (rows, 2 * points + 2)}
        | ({plan.shape} if rows > 1 else set()),  # pairs are of squares
        "symbol": {plan.shape},
        "table": {PIECES},
    }
    return Counter((form, shape) for form, shape in built if shape in finest[form])


@pytest.mark.parametrize("name", SCENES)
def test_the_kernels_of_a_plan_are_those_that_a_solve_builds_and_all_of_a_scene_is_in_it(name, built):
    scene = SCENES[name]
    asked = solver(scene, points=32 if name == "far-and-back" else 64)
    plan = asked.plan(scene)
    assert not built  # a plan builds none
    assert all_of_a_scene(plan, scene)
    assert ("measured surface" in plan.left_out) == (name not in ("topography", "measured"))
    answer = asked.solve(scene)
    assert planned(plan) == of_the_finest(built, plan)
    assert plan.steps == answer.measures.get("time_steps", 0)
    assert plan.shape == answer.fields["pressure"].shape


@pytest.mark.parametrize(
    ("name", "points"),
    [
        *((name, 128) for name in ("rough", "plane-slide", "program")),
        *(pytest.param(name, 128, marks=pytest.mark.slow) for name in ("rest", "modes", "layer", "shear")),
        *(pytest.param(*each, marks=pytest.mark.slow) for each in (("line-slide", 1024), ("far-and-back", 64))),
    ],
)
def test_the_memory_of_a_plan_is_what_a_solve_holds_at_most(name, points, monkeypatch):
    scene = SCENES[name]
    # Not by ducc0: a table in its bindings grows with the calls of all tests before, by megabytes at a time.
    asked = solver(scene, points=points, transforms="fftw")
    replace(asked, points=64).solve(scene)  # what is loaded once is no part of it
    taking.cache_clear()  # a layer's table is, and samples of a kernel are
    forget_kernels(monkeypatch)
    _kept.cache_clear()
    _, most = held_by(asked.solve, scene)
    assert most / FACTOR < asked.plan(scene).memory < most * FACTOR


def test_a_surface_of_many_waves_is_drawn_in_the_memory_that_a_plan_says():
    rough = replace(ROUGH, shortest=2e-3 / 128)
    few = BEM(points=32, extent=2e-4)  # so that nothing on the grid is as large
    _, most = held_by(lambda drawn: RoughSurface.draw(drawn, drawn.q_max(0.0)), rough)
    assert most / FACTOR < few.plan(replace(SCENES["rough"], roughness=rough)).memory < most * FACTOR


def test_a_plan_draws_no_surface_and_holds_next_to_nothing(monkeypatch):
    def drawn(*_):
        raise AssertionError("a surface was drawn")

    monkeypatch.setattr(RoughSurface, "of", drawn)
    plan, most = held_by(BEM(points=8192).plan, SCENES["rough"])
    assert plan.memory > 5e9
    assert most < 1e6


def test_at_rest_no_mode_is_followed_and_no_loss_is_looked_for():
    rest, slide = (solver(SCENES[name]).plan(SCENES[name]) for name in ("rest", "slide"))
    assert (rest.modes.count, slide.modes.count) == (0, 1)
    assert ("flow" in rest.left_out, "flow" in slide.left_out) == (True, False)
    assert ("conjugate gradients" in rest.method, "GMRES" in slide.method) == (True, True)
    elastic = solver(SCENES["elastic"]).plan(SCENES["elastic"])  # whatever the motion
    assert elastic.modes.count == 0
    assert {"modes", "flow"} <= set(elastic.left_out)
    assert elastic.kernels == rest.kernels


@pytest.mark.parametrize(
    ("name", "tolerance"),
    [("rest", 1e-7), ("slide", BEM().tolerance), ("rough", 1e-7), ("modes", BEM().tolerance)],
)
def test_the_applications_expected_are_near_those_that_it_takes(name, tolerance):
    # medians over other contacts: a factor of two is their scatter
    scene = SCENES[name]
    asked = replace(solver(scene, points=128), tolerance=tolerance, extent=None)
    expected, taken = asked.plan(scene).operator_applications, asked.solve(scene).operator_applications
    assert taken / 2 < expected.value < taken * 2
    assert "medians" in expected.why


def test_costs_that_the_ladder_does_not_have_are_said_to_be_unknown():
    bare = replace(SCENES["rough"], roughness=replace(ROUGH, shortest=None))
    for scene in (SCENES["line"], bare, SCENES["wave"], SCENES["measured"], *PLANES):
        plan = solver(scene).plan(scene)
        assert plan.operator_applications.value is None
        assert "not known: " in str(plan)


def test_parts_that_the_ladder_does_not_have_multiply_its_costs_by_what_they_were_measured_to_take():
    known = multiples(EFFECTS)
    asked, scene = solver(SCENES["layer"]), SCENES["layer"]
    plain, layered = asked.plan(SCENES["slide"]), asked.plan(scene)
    assert layered.operator_applications.value == pytest.approx(plain.operator_applications.value * known["Layer"])
    held, march = asked.plan(SCENES["rest"]), asked.plan(replace(SCENES["pressed"], elastomer=KELVIN))
    expected = held.operator_applications.value * known["Program"] * march.steps
    assert march.operator_applications.value == pytest.approx(expected)


def test_a_looser_tolerance_is_expected_to_take_less_and_a_closer_one_more():
    scene = SCENES["slide"]
    plans = [BEM(points=128, tolerance=tolerance).plan(scene) for tolerance in (1e-3, 1e-5, 1e-7, 1e-9)]
    values = [plan.operator_applications.value for plan in plans]
    assert values == sorted(values)
    assert values[0] < values[-1]


def test_what_an_estimated_window_could_not_carry_is_said():
    asked = BEM(points=64)
    thin = Scene(SPHERE, Elastic(1e6), Indent(load=LOAD), layer=Layer(thickness=1e-12))
    assert "too thin" in str(asked.plan(thin))
    assert not asked.plan(SCENES["layer"]).doubts
    assert "as on a half-space" in str(asked.plan(SCENES["layer"]))


def test_a_printed_plan_says_all_of_it():
    plan = solver(SCENES["rough"]).plan(SCENES["rough"])
    page = str(plan)
    assert len({line.index("symbol,") for line in page.splitlines() if "symbol, " in line}) == 1  # in columns
    for text in (
        *plan.terms.values(),
        *plan.left_out.values(),
        *(kernel.name for kernel in plan.kernels),
        size(plan.memory),
    ):
        assert text in page
