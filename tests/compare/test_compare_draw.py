"""A contact as a picture: what is drawn is what was solved, and what no picture shows is refused."""

import sys
from dataclasses import replace

import numpy as np
import pandas
import pytest
from drawn_scenes import KELVIN, LOAD, SCENES, TAU, A, R
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from typer.testing import CliRunner

import compare
from bem3d import BEM
from compare.cli.app import app
from compare.figures import style
from compare.library.lookup import case_of
from compare.report import vtk
from compare.studies.draw import figure as draw
from compare.studies.draw import program
from compare.studies.draw.study import APART
from mdr1d import MDR
from scene import (
    WLF,
    Cylinder,
    Doubtful,
    Heating,
    Indent,
    Layer,
    Refused,
    Scene,
    SelfAffine,
    Slide,
    SolveError,
    Sphere,
)
from scene.reading import InvalidInput

pytestmark = pytest.mark.usefixtures("in_this_process")

REST = replace(case_of(Scene(Sphere(R), KELVIN, Indent(load=LOAD))), bem=BEM(points=64), mdr=MDR(points=500))
FAST = replace(REST, motion=Slide(speed=A / TAU, load=LOAD))
ROUGH = replace(FAST, roughness=SelfAffine(hurst=0.2, rms_height=1e-6, longest=1e-2, shortest=1e-3, seed=5))
LINE = replace(FAST, indenter=Cylinder(R), motion=Slide(speed=0.1, line_load=100.0))


@pytest.fixture(scope="module")
def drawn(tmp_path_factory):
    """Reports by name, each solved once."""
    cases = {"rest": REST, "fast": FAST, "rough": ROUGH, "line": LINE}
    folder = tmp_path_factory.mktemp("drawn")
    return {name: compare.draw(case, output=folder / name, workers=1) for name, case in cases.items()}


def table(report, name):
    return next(report.page.every(draw.Plot)).tables[name]


def test_under_a_smooth_sphere_at_rest_the_springs_carry_the_pressure_integrated_over_y(drawn):
    """The force per length of the MDR is the Abel transform of the pressure, which is its integral over y."""
    lines = table(drawn["rest"], draw.LINES)
    assert lines["line_force_1d"].max() == pytest.approx(lines["line_force_3d"].max(), rel=5e-3)
    found = {each.claim.id: each.value for each in drawn["rest"].findings}
    assert found[APART.id] < 0.01 < {each.claim.id: each.value for each in drawn["rough"].findings}[APART.id]


@pytest.mark.parametrize("name", ["rest", "fast", "rough"])
def test_both_line_forces_sum_up_to_the_load(drawn, name):
    lines = table(drawn[name], draw.LINES)
    width = lines["x"][1] - lines["x"][0]
    assert lines["line_force_1d"].sum() * width == pytest.approx(LOAD, rel=1e-6)
    assert lines["line_force_3d"].sum() * width == pytest.approx(LOAD, rel=1e-4)  # the tolerance of the solve


def test_the_surface_is_deepest_under_the_sphere_and_lower_behind_it_than_before(drawn):
    surface = drawn["fast"].answers["surface"].to_dataset()
    middle = surface["displacement"].sel(y=0, method="nearest")
    assert float(middle.max()) == pytest.approx(float(surface["depth"]), rel=1e-2)
    behind, before = (float(middle.sel(x=at, method="nearest")) for at in (1.3 * A, -1.3 * A))
    assert behind > 1.3 * before > 0
    assert float(surface["x"].max()) > 2 * A


def test_springs_are_drawn_where_the_surface_is_known_and_nowhere_beyond():
    places = np.linspace(-2e-3, 2e-3, draw.STRIPS)
    known = np.linspace(-5e-4, 1e-3, 301)
    section = pandas.DataFrame({"x": known, "indenter": known**2, "surface": -1e-6, "touching": False})
    with style.applied():
        axes = Figure().subplots()
        draw.row(axes, section, pandas.DataFrame({"x": places}), (-2e-3, 2e-3))
    middles = 1e-3 * np.array([np.mean(path[:, 0]) for each in axes.collections for path in each_spring(each)])
    expected = places[(known[0] < places) & (places < known[-1])]
    assert (middles.min(), middles.max()) == pytest.approx((expected.min(), expected.max()), abs=1e-4)


def each_spring(collection):
    return collection.get_segments() if isinstance(collection, LineCollection) else []


def test_the_picture_is_drawn_again_from_its_tables_to_the_last_byte(drawn, tmp_path):
    folder = drawn["rough"].output
    again = compare.export(folder, format="png", output=tmp_path)
    png = next(path for path in again if path.suffix == ".png")
    assert png.read_bytes() == (folder / "draw.png").read_bytes()


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name == "dip" else pytest.mark.slow) for name in ("dip", "lift")]
)
def test_a_program_is_drawn_in_time_by_the_forces_of_both_and_sections_at_instants(name, tmp_path):
    case = replace(case_of(SCENES[name]), bem=BEM(points=64, steps=20), mdr=MDR(points=200, steps=20))
    report = compare.draw(case, output=tmp_path / name, workers=1)
    tables = next(each for each in report.page.every(draw.Plot) if each.name == program.NAME).tables
    for solver in (case.mdr, case.bem):
        answer = solver.solve(case.scene)
        forces, sections = (each[each["solver"] == solver.name] for each in tables.values())
        for force in program.HISTORIES:
            assert forces[force].to_numpy() == pytest.approx(answer.fields[force], rel=1e-12, abs=1e-15)
        assert sections["time"].nunique() == program.INSTANTS
        touched = sections[sections["touching"]]
        # Over the depth: the tolerance of the contact.
        near = 1e-4 * np.nanmax(answer.fields["depth"])
        assert touched["surface"].to_numpy() == pytest.approx(touched["indenter"].to_numpy(), abs=near)
        assert len(touched)
    png = tmp_path / name / f"{program.NAME}.png"
    (again,) = (
        path for path in compare.export(png.parent, "png", output=tmp_path / "again") if path.name == png.name
    )
    assert again.read_bytes() == png.read_bytes()


def test_a_layer_has_no_springs_and_that_is_said(tmp_path):
    report = compare.draw(replace(REST, layer=Layer(thickness=2e-3)), output=tmp_path, workers=1)
    assert "No row of springs: MDR" in str(report)
    assert draw.ROW not in next(report.page.every(draw.Plot)).tables


def test_what_no_picture_shows_is_refused_before_anything_is_solved(tmp_path):
    glass = WLF(temperature=300.0, reference=300.0, c1=8.86, c2=101.6)
    warm = replace(FAST, temperature=glass, heating=Heating(conductivity=0.2, feedback="average"))
    with pytest.raises(Refused, match=r"heating\.feedback"):
        compare.draw(warm, output=tmp_path / "no")
    assert not (tmp_path / "no").exists()


def test_a_contact_that_does_not_touch_is_no_picture(tmp_path):
    above = replace(ROUGH, motion=Indent(depth=1e-9), roughness=replace(ROUGH.roughness, rms_height=1e-5))
    high = pytest.warns(Doubtful, match="rms height of the roughness over the depth")
    with high, pytest.raises(SolveError, match=r"nothing touches|no contact"):
        compare.draw(above, output=tmp_path, workers=1)


def test_without_meshio_the_extra_is_named_in_one_line(drawn, monkeypatch):
    monkeypatch.setitem(sys.modules, "meshio", None)
    result = CliRunner().invoke(app, ["export", str(drawn["rest"].output), "--format", "vtk"])
    assert result.exit_code == 2
    assert vtk.EXTRA in result.output
    assert len(result.output.strip().splitlines()) == 1


def test_a_surface_for_paraview_holds_the_load_and_what_is_displaced(drawn):
    meshio = pytest.importorskip("meshio")
    (path,) = compare.export(drawn["rest"].output, format="vtk")
    mesh, surface = meshio.read(path), drawn["rest"].answers["surface"].to_dataset()
    pressure = mesh.point_data["pressure [Pa]"]
    pixel = float(surface["x"][1] - surface["x"][0])
    assert pressure.sum() * pixel**2 == pytest.approx(LOAD, rel=1e-4)
    down = mesh.point_data["displacement [m]"]
    assert -down[:, 2].min() == pytest.approx(float(surface["displacement"].max()))
    assert not down[:, :2].any()
    (cells,) = mesh.cells
    assert len(cells.data) == (surface.sizes["x"] - 1) * (surface.sizes["y"] - 1)


def test_a_folder_without_a_surface_is_no_file_for_paraview(tmp_path):
    pytest.importorskip("meshio")
    compare.sweep(replace(FAST, bem=BEM(points=32)), speed=[0.1], output=tmp_path, workers=1, report=False)
    with pytest.raises(InvalidInput, match="no surface"):
        compare.export(tmp_path, format="vtk")
