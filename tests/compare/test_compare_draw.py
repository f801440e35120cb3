"""A contact as a picture: what is drawn is what was solved, and what no picture shows is refused."""

import re
import sys
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from drawn_again import from_files
from drawn_scenes import KELVIN, LOAD, PAPER, ROUGH, SCENES, STANDARD, TAU, A, R
from small_cases import seldom

import compare
from bem3d import BEM
from compare.figures import contact, history
from compare.figures.contact import SURFACE, view
from compare.figures.plot import Plot
from compare.library.lookup import case_of
from compare.report import vtk
from mdr1d import MDR
from scene import (
    WLF,
    Doubtful,
    Heating,
    Indent,
    Layer,
    Program,
    Refused,
    Scene,
    SelfAffine,
    Slide,
    SolveError,
    Sphere,
    Stage,
)
from scene.files.reading import InvalidInput

pytestmark = pytest.mark.usefixtures("in_this_process")

REST = replace(case_of(Scene(Sphere(R), KELVIN, Indent(load=LOAD))), bem=BEM(points=64), mdr=MDR(points=500))
FAST = replace(REST, motion=Slide(speed=A / TAU, load=LOAD))
MICRONS = replace(FAST, roughness=SelfAffine(hurst=0.2, rms_height=1e-6, longest=1e-2, shortest=1e-3, seed=5))
LINE, SPACE = MDR(points=500, steps=20), BEM(points=48, steps=20)
BACK = Program(stages=(Stage(duration=TAU, depth=1e-4, speed=0.5), Stage(duration=TAU, speed=-0.5)))
CONTACTS = {name: SCENES[name] for name in ("rest", "line", "full", "plane")} | {
    "rough": PAPER,
    "layer": replace(PAPER, roughness=None, layer=Layer(thickness=2e-3)),
    "back": Scene(Sphere(R), STANDARD, BACK, ROUGH),
    "tiny": Scene(Sphere(1e-9), KELVIN, Indent(depth=1e-12)),
}
PANELS = {"rough": 4, "layer": 2, "line": 2, "full": 2, "back": 3}  # without an empty one


@pytest.fixture(scope="module")
def drawn(tmp_path_factory):
    """Reports by name, each solved once."""
    cases, folder = {"rest": REST, "fast": FAST, "rough": MICRONS}, tmp_path_factory.mktemp("drawn")
    return {name: compare.draw(case, output=folder / name, workers=1) for name, case in cases.items()}


@cache
def answered(name):
    """Fields of a contact by solver."""
    scene = CONTACTS[name]
    return {each.name: each.solve(scene).fields for each in (LINE, SPACE) if not each.refusals(scene)}


@cache
def seen(name):
    return view(CONTACTS[name], SPACE, answered(name))


def table(report, name):
    return next(report.page.every(Plot)).tables[name]


@pytest.mark.parametrize("name", seldom(CONTACTS, ("rough", "line", "full")))
def test_every_contact_has_a_picture_with_units_and_no_empty_panel(name):
    plot = contact.plot(CONTACTS[name], seen(name))
    drawing = from_files(plot)
    panels = [axes for axes in drawing.axes if axes.get_label() != "<colorbar>"]
    assert len(panels) == len(plot.tables) == PANELS.get(name, len(panels))
    assert all(axes.has_data() and axes.get_title(loc="left") for axes in panels)
    assert len(plot.caption.split()) <= 60
    flow = {"back": "indenter slides →", "rest": "at rest", "tiny": "at rest"}.get(name, "← indenter slides")
    assert panels[0].get_title(loc="right") == flow


def test_the_map_is_the_pressure_of_the_answer_on_what_touches():
    axes = from_files(contact.plot(CONTACTS["rough"], seen("rough"))).axes[0]
    shown, pressure = axes.collections[0].get_array(), answered("rough")["BEM"]["pressure"]
    assert 1e6 * shown.sum() == pytest.approx(pressure.sum(), rel=1e-12)
    assert shown.count() == (pressure > 0).sum()


def test_bodies_touch_where_contact_is_bold_and_nowhere_overlap():
    for name in ("rough", "layer", "line", "plane", "back"):
        for section in (
            each for key, each in contact.plot(CONTACTS[name], seen(name)).tables.items() if "sec" in key
        ):
            gap, deepest = section["indenter"] - section["surface"], np.ptp(section["surface"])
            # residual of the contact, and in a program what the depth moves within half a step
            np.testing.assert_allclose(gap[section["touching"]], 0, atol=1e-4 * deepest)
            assert np.nanmin(gap) > -1e-4 * deepest


def test_full_contact_has_no_gap_of_rounding():
    surface = seen("full")[SURFACE]
    assert surface["gap"].max() < 1e-6 * np.ptp(surface["displacement"].values)


def test_the_surface_is_deepest_under_the_sphere_and_lower_behind_it_than_before(drawn):
    surface = drawn["fast"].answers["surface"].to_dataset()
    middle = surface["displacement"].sel(y=0, method="nearest")
    assert float(middle.max()) == pytest.approx(float(surface["depth"]), rel=1e-2)
    assert float(middle[-1]) > 1.1 * float(middle.interp(x=-surface["x"][-1])) > 0
    rest = drawn["rest"].answers["surface"].to_dataset()["displacement"].sel(y=0, method="nearest")
    assert float(rest[-1]) == pytest.approx(float(rest[0]), rel=1e-9)


def test_under_a_smooth_sphere_at_rest_the_springs_carry_the_pressure_integrated_over_y(drawn):
    """The force per length of the MDR is the Abel transform of the pressure, which is its integral over y."""
    lines = table(drawn["rest"], contact.LINES)
    assert lines["line_force_1d"].max() == pytest.approx(lines["line_force_3d"].max(), rel=5e-3)
    shares = [line_forces / line_forces.sum() for line_forces in (lines["line_force_1d"], lines["line_force_3d"])]
    assert abs(shares[0] - shares[1]).sum() / 2 < 0.01


@pytest.mark.parametrize("name", ["rest", "fast", "rough"])
def test_both_line_forces_sum_up_to_the_load(drawn, name):
    lines = table(drawn[name], contact.LINES)
    width = lines["x"][1] - lines["x"][0]
    assert lines["line_force_1d"].sum() * width == pytest.approx(LOAD, rel=1e-6)
    assert lines["line_force_3d"].sum() * width == pytest.approx(LOAD, rel=1e-4)  # the tolerance of the solve


@pytest.mark.parametrize("name", seldom(("dip", "lift"), ("dip",)))
def test_a_program_is_drawn_in_time_by_force_and_depth_of_both(name, tmp_path):
    case = replace(case_of(SCENES[name]), bem=BEM(points=64, steps=20), mdr=MDR(points=200, steps=20))
    report = compare.draw(case, output=tmp_path)
    (plot,) = (plot for plot in report.page.every(Plot) if plot.name == history.NAME)
    histories = plot.tables[history.NAME].rename(columns={"depth_reached": "depth"}).set_index("model")
    for solver in (case.mdr, case.bem):
        fields = solver.solve(case.scene).fields
        for each in ("normal_force", "friction_force", "depth"):
            np.testing.assert_allclose(histories.loc[solver.name, each], fields[each], rtol=1e-12, atol=1e-15)
    labels = [axes.get_ylabel() for axes in report.figures[history.NAME].axes]
    assert [each.partition(" [")[0] for each in labels] == ["normal force", "depth", "tangential force"]


def test_a_layer_has_no_springs_and_that_is_said(tmp_path):
    report = compare.draw(replace(REST, layer=Layer(thickness=2e-3)), output=tmp_path)
    assert "No row of springs: MDR" in str(report)
    assert contact.SECTIONS["MDR"] not in next(report.page.every(Plot)).tables


def test_what_no_picture_shows_is_refused_before_anything_is_solved(tmp_path):
    glass = WLF(temperature=300.0, reference=300.0, c1=8.86, c2=101.6)
    warm = replace(FAST, temperature=glass, heating=Heating(conductivity=0.2, feedback="average"))
    with pytest.raises(Refused, match=r"heating\.feedback"):
        compare.draw(warm, output=tmp_path / "no")
    assert not (tmp_path / "no").exists()
    assert not view(warm.scene, SPACE, {"BEM": {}})


def test_a_contact_that_does_not_touch_is_no_picture(tmp_path):
    above = replace(MICRONS, motion=Indent(depth=1e-9), roughness=replace(MICRONS.roughness, rms_height=1e-5))
    high = pytest.warns(Doubtful, match="rms height of the roughness over the depth")
    with high, pytest.raises(SolveError, match=r"nothing touches|no contact"):
        compare.draw(above, output=tmp_path)


def test_without_meshio_the_extra_is_named(drawn, monkeypatch):
    monkeypatch.setitem(sys.modules, "meshio", None)
    with pytest.raises(Refused, match=re.escape(vtk.EXTRA)):
        compare.export(drawn["rest"].output, format="vtk")


def test_a_surface_for_paraview_holds_the_load_and_what_is_displaced(drawn):
    meshio = pytest.importorskip("meshio")
    (path,) = compare.export(drawn["rest"].output, format="vtk")
    mesh, surface = meshio.read(path), drawn["rest"].answers["surface"].to_dataset()
    pressure = mesh.point_data["pressure [Pa]"]
    pixel = float(surface["x"][1] - surface["x"][0])
    assert pressure.sum() * pixel**2 == pytest.approx(LOAD, rel=1e-4)
    *across, down = mesh.point_data["displacement [m]"].T
    assert -down.min() == pytest.approx(float(surface["displacement"].max()))
    assert not np.any(across)
    assert len(mesh.cells[0].data) == (surface.sizes["x"] - 1) * (surface.sizes["y"] - 1)


def test_a_folder_without_a_surface_is_no_file_for_paraview(tmp_path):
    pytest.importorskip("meshio")
    compare.sweep(replace(FAST, bem=BEM(points=32)), speed=[0.1], output=tmp_path, workers=1, report=False)
    with pytest.raises(InvalidInput, match="no surface"):
        compare.export(tmp_path, format="vtk")
