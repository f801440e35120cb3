"""The pages run: the gallery, the examples of README and pages, conventions of other codes, and what ties them."""

import inspect
import re
import shutil
import sys
from pathlib import Path

import matplotlib
import numpy as np
import pandas
import pytest

import bem3d
import compare
import scene
from compare import commands
from compare.cli.app import app

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
CELL = re.compile(r"^```\{code-cell\}[^\n]*\n(.*?)^```", re.DOTALL | re.MULTILINE)
PYTHON = re.compile(r"^```python\n(.*?)^```", re.DOTALL | re.MULTILINE)
TEXT = re.compile(r"^```text\n(.*?)^```", re.DOTALL | re.MULTILINE)


def text_of(*parts):
    """Text of a page."""
    return DOCS.joinpath(*parts).read_text(encoding="utf-8")


def run(text, blocks):
    """Names after all blocks of a text, from top to bottom."""
    names = {"__name__": "page"}
    for number, block in enumerate(blocks.findall(text)):
        exec(compile(block, f"block {number}", "exec"), names)
    return names


@pytest.fixture
def shown(monkeypatch):
    """Run an example of the gallery; it has to leave a figure that can be drawn."""
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    monkeypatch.setattr(plt, "show", lambda: None)

    def show(name):
        sections = rf"^\({name}\)=\n(.*?)(?=^\(\w+\)=$|\Z)"
        (section,) = re.findall(sections, text_of("howto", "gallery.md"), re.DOTALL | re.MULTILINE)
        names = run(section, CELL)
        names["figure"].canvas.draw()
        return names

    yield show
    plt.close("all")


def test_a_sphere_at_rest_is_that_of_hertz(shown):
    missed = shown("hertz")["missed"]
    assert missed["MDR"] < 1e-6  # second order in the pixel; there are some 800 across the contact
    assert missed["BEM"] < 1e-3  # some 50 pixels across


@pytest.mark.slow
def test_friction_at_low_speed_is_twice_that_of_three_dimensions(shown):
    ratio = shown("speed")["ratio"]
    assert ratio[0] == pytest.approx(2, rel=0.02)  # on 64 points
    assert ratio[-1] < 1.6  # and not at high speed


def test_the_load_lies_ahead_of_the_axis(shown):
    assert shown("wake")["centre"] < -1e-4


@pytest.mark.slow
def test_a_layer_carries_more_and_as_much_as_without_a_grid(shown):
    names = shown("layer")
    assert names["missed"] < 1e-3
    assert np.all(np.diff(names["forces"]) < 0)
    assert names["forces"][-1] > names["half_space"]


@pytest.mark.slow
def test_temperatures_fall_onto_one_curve(shown):
    names = shown("temperature")
    assert names["missed"] < 1e-12
    assert np.ptp(np.log(names["shifts"])) > 2  # which they do not by being alike


def test_partial_slip_is_that_of_cattaneo_and_mindlin(shown):
    missed = shown("partialslip")["missed"]
    assert missed["MDR"] < 1e-5
    # tractions that point aside are worth 0.16 % of what is held, says the theory
    assert missed["BEM"] < 3e-3


@pytest.mark.slow
def test_turning_back_ends_in_steady_sliding(shown):
    names = shown("reversal")
    for name, answer in names["answers"].items():
        assert abs(names["missed"][name]) < 0.03  # as much is left of the turn, three contacts away
        assert answer.fields["friction_force"].min() < -0.8 * names["steady"][name].friction_force


def test_contacts_of_practice_have_friction_with_an_interval(shown):
    friction = shown("practice")["friction"]
    values = [0.1427, 0.409, 0.107, 0.0378, 0.192, 0.0443]
    assert [each.value for each in friction.values()] == pytest.approx(values, rel=5e-3)
    assert all(each.low < each.value < each.high for each in friction.values())


@pytest.mark.slow
def test_the_examples_in_python_print_what_they_say(capsys, tmp_path, monkeypatch):
    whole, second, third, first, others = PYTHON.findall(text_of("howto", "python.md"))
    names = {}
    exec(first, names)
    assert names["choice"].confirmed
    assert names["answer"].friction_coefficient == pytest.approx(0.0378, rel=0.01)
    exec(others, {})
    capsys.readouterr()
    exec(second, {})
    (one, *in_one), (three, *in_three) = (line.split() for line in capsys.readouterr().out.splitlines())
    assert (one, three) == ("MDR", "BEM")
    # one surface each of those whose mean ratio the page of answers states, 0.61; they scatter
    assert 0.3 < float(in_one[1]) / float(in_three[1]) < 0.9
    exec(third, names)
    assert names["answer"].friction_coefficient == pytest.approx(0.00806, rel=0.01)
    monkeypatch.chdir(tmp_path)
    exec(whole, {"__name__": "__main__"})
    printed = capsys.readouterr().out
    assert "holds" in printed
    assert "{'model': 3, 'level': 2, 'speed': 3, 'load': 1, 'surface': 10}" in printed
    assert re.search(r"BEM +0\.01", printed)
    assert Path("friction.pdf").stat().st_size > 1000


@pytest.mark.slow
def test_the_example_of_the_readme_prints_the_table_that_stands_there(capsys, tmp_path, monkeypatch):
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    (example,), (table,) = PYTHON.findall(readme), TEXT.findall(readme)
    monkeypatch.chdir(tmp_path)
    exec(example, {"__name__": "__main__"})
    assert table in capsys.readouterr().out


def test_the_first_page_has_friction_of_1d_twice_that_of_3d():
    names = run(text_of("index.md"), PYTHON)
    assert names["one"].depth == pytest.approx(names["three"].depth, rel=0.01)
    assert names["one"].friction_coefficient == pytest.approx(2 * names["three"].friction_coefficient, rel=0.02)


def test_the_example_of_the_page_on_heights_presses_a_plane_and_a_body():
    names = run(text_of("howto", "heights.md"), PYTHON)
    plane, body = names["plane"], names["body"]
    assert plane.fields["pressure"].mean() == pytest.approx(20e3, rel=1e-9)
    assert body.fields["pressure"].sum() * 5e-6**2 == pytest.approx(0.5e-3, rel=1e-9)
    assert not body.fields["pressure"][[0, -1]].any()


@pytest.mark.filterwarnings("ignore:Could not import mpi4py:ImportWarning")
@pytest.mark.filterwarnings("ignore:Function/property:DeprecationWarning")
@pytest.mark.parametrize("code", ["tamaas", "ContactMechanics"])
def test_the_codes_of_the_page_on_heights_give_the_pressure_and_the_gap_of_press(code):
    names = {"n": 64, "L": 1.0, "E": 1.0, "p": 0.05, "press": bem3d.press}
    names["heights"] = np.random.default_rng(1).normal(size=(64, 64)) / 64
    for module in {"tamaas": ["tamaas"], "ContactMechanics": ["SurfaceTopography", code, f"{code}.Systems"]}[code]:
        names |= vars(pytest.importorskip(module, exc_type=ImportError))
    answers = {}
    for row in ("here", code):
        page = re.search(rf"^\| {row} \| (.*) \| (`.*`, `.*`) \|$", text_of("howto", "heights.md"), re.MULTILINE)
        exec("; ".join(re.findall("`(.*?)`", page[1])), names)
        answers[row] = [eval(field, names) for field in re.findall("`(.*?)`", page[2])]
    for ours, theirs in zip(*answers.values(), strict=True):
        np.testing.assert_allclose(theirs, ours, rtol=0, atol=1e-4 * ours.max())  # at the tolerances they have


@pytest.fixture
def files(tmp_path, monkeypatch):
    """The files that the page on scenes speaks of, where its examples look for them."""
    page = text_of("reference", "scenes.md")
    plane = re.search(r"^## A rough plane.*?^```toml\n(.*?)^```", page, re.DOTALL | re.MULTILINE)[1]
    for name in ("plane.toml", "scene.toml"):
        (tmp_path / name).write_text(plane, encoding="utf-8")
    np.save(tmp_path / "surface.npy", 1e-6 * np.random.default_rng(1).standard_normal((16, 16)))
    shutil.copy(tmp_path / "surface.npy", tmp_path / "tread.npy")
    monkeypatch.chdir(tmp_path)


def test_the_examples_of_the_page_on_scenes_run(files, capsys):
    for block in PYTHON.findall(text_of("reference", "scenes.md")):
        exec(block.replace('file="tyre-tread.sur"', 'file="tread.npy", pixel=1e-5, unit="m"'), {})
    fraction, friction = capsys.readouterr().out.splitlines()[0].split()
    assert 0 < float(fraction) < 1
    assert float(friction) > 0


def test_the_example_of_the_page_on_the_command_asks_for_what_there_is(monkeypatch, capsys):
    asked, takes = [], inspect.signature(compare.run)
    monkeypatch.setattr(compare, "run", lambda *given, **named: asked.append(takes.bind(*given, **named)))
    (example,) = PYTHON.findall(text_of("reference", "command.md"))
    exec(example, {"__name__": "__main__"})
    assert [bound.arguments["output"] for bound in asked] == ["report"]
    assert capsys.readouterr().out


def test_the_page_on_the_command_has_every_command_and_function():
    page = text_of("reference", "command.md")
    table = re.findall(r"^\| (?:`(\w+)[^`]*`)? ?\| `compare\.(\w+)\(", page, re.MULTILINE)
    assert {command for command, _ in table if command} == {each.name for each in app.registered_commands}
    functions = {name for name in vars(commands) if name in compare.__all__ and name != "Case"}
    assert {function for _, function in table} == functions - {"solve", "friction_plot"}


def test_the_example_of_the_page_on_figures_draws_in_the_style_it_states(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("mine.mplstyle").write_text("lines.linewidth: 3.5", encoding="utf-8")
    rows = [
        {"model": model, "speed": speed, "load": 1.0}
        | {"friction_coefficient_mean": speed, "friction_coefficient_low": 0.9 * speed}
        for model in ("MDR", "BEM")
        for speed in (0.1, 1.0)
    ]
    means = pandas.DataFrame(rows).assign(
        friction_coefficient_high=lambda frame: 1.1 * frame["friction_coefficient_mean"]
    )
    Path("crosscheck-sweep").mkdir()
    means.to_csv("crosscheck-sweep/friction-speed.csv", index=False)
    figure = run(text_of("howto", "figures.md"), PYTHON)["figure"]
    lines = [bar[0] for bar in figure.axes[0].containers]
    assert [line.get_linewidth() for line in lines] == [3.5, 3.5]
    assert [line.get_color() for line in lines] == ["#0072B2", "#D55E00"]
    assert Path("friction.pdf").stat().st_size > 1000


def test_numbers_of_equations_in_the_text_are_equations():
    theory = text_of("explanation", "theory.md")
    tags = re.findall(r"\\tag\{(\w+)\}", theory)
    assert len(tags) == len(set(tags))
    prose = re.sub(r"\$\$.*?\$\$|\$[^$]*\$|Popov 2014[^.;]*", "", theory, flags=re.DOTALL)
    assert set(re.findall(r"\((\d{1,2}[a-z]?)\)", prose)) <= set(tags)
    for page in DOCS.rglob("*.md"):
        labels = re.findall(r"theory, Eqs?\. (\w+)", page.read_text(encoding="utf-8"))
        assert set(labels) <= set(tags), page.name


@pytest.fixture(scope="module")
def docstrings():
    """The extension that reads docstrings."""
    pytest.importorskip("sphinx")
    sys.path.insert(0, str(DOCS / "_ext"))
    try:
        import docstrings
    finally:
        sys.path.pop(0)
    return docstrings


def test_fields_become_a_list_and_text_stays_text(docstrings):
    stated = ["load, depth : of it [N], [m]; with stars *", "    and more"]
    assert docstrings.listed(["A body.", "", *stated, "G_0 |x|^n `name`", "", ">>> 2*3"]) == [
        "A body.",
        "",
        "``load``, ``depth``",
        r"    of it [N], [m]; with stars \*",
        "    and more",
        "",
        r"G_0 \|x\|^n `name`",
        "",
        ">>> 2*3",
    ]
    assert docstrings.listed(["a : one; b : two"]) == ["``a``", "    one", "``b``", "    two"]


def test_a_signature_names_kinds_of_number(docstrings):
    assert docstrings.signature(scene.Sphere) == "(radius: Length)"
    assert docstrings.signature(scene.Cone) == "(angle: Angle)"
    assert "speed: Velocity = 0.0, load: ForceOrZero | None = None" in docstrings.signature(scene.Stage)


def test_the_citation_the_page_how_to_cite_and_the_paper_of_at_most_1000_words_agree():
    yaml = pytest.importorskip("yaml")
    citation, page, bibliography = (
        each.read_text(encoding="utf-8")
        for each in (ROOT / "CITATION.cff", DOCS / "howto" / "cite.md", DOCS / "joss" / "paper.bib")
    )
    cited = yaml.safe_load(citation)
    (author,), (law,) = cited["authors"], cited["references"]
    version = re.search(r'^version = "(.*)"', (ROOT / "pyproject.toml").read_text(), re.MULTILINE)[1]
    assert cited["version"] == version
    for stated in (f"title   = {{{cited['title']}}}", f"{{{{{author['name']}}}}}", f"version = {{{version}}}"):
        assert stated in page
    for stated in (f"{{{law['title']}}}", f"{{{law['doi']}}}"):
        assert stated in page
        assert stated in bibliography
    _, heading, paper = text_of("joss", "paper.md").split("---\n", 2)
    assert yaml.safe_load(heading)["title"] == cited["title"]
    assert len(re.sub("<!--.*?-->", "", paper).split()) <= 1000
    keys = re.findall(r"^@\w+\{(\w+),", bibliography, re.MULTILINE)
    assert {*re.findall(r"@(\w+)", paper)} == {*keys}


WAVES, SIDE, HEIGHT = 4, 2.0, 0.3


@pytest.fixture
def wave():
    """One cosine along x on a square: WAVES in SIDE, of the mean square HEIGHT^2 / 2."""
    x = np.arange(64) * SIDE / 64
    return np.repeat(HEIGHT * np.cos(2 * np.pi * WAVES * x / SIDE)[:, None], 64, axis=1)


def test_conventions_of_tamaas_are_as_the_page_has_them(wave):
    tamaas = pytest.importorskip("tamaas", exc_type=ImportError)
    tamaas.initialize(1)
    found = tamaas.Statistics2D.computePowerSpectrum(wave).real
    assert found[WAVES, 0] == pytest.approx(HEIGHT**2 / 4, rel=1e-12)  # of +q, and as much of -q
    slope = HEIGHT * 2 * np.pi * WAVES / SIDE / np.sqrt(2)
    assert tamaas.Statistics2D.computeSpectralRMSSlope(wave) == pytest.approx(slope * SIDE, rel=1e-9)
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [1.0, 1.0], [32, 32])
    model.E, model.nu = 3.0, 0.5
    assert model.E_star == pytest.approx(3.0 / (1 - 0.5**2))  # signs and means are those of test_bem3d_peers.py


@pytest.mark.filterwarnings("ignore:Could not import mpi4py:ImportWarning")
@pytest.mark.filterwarnings("ignore:Function/property:DeprecationWarning")
def test_conventions_of_surfacetopography_are_as_the_page_has_them(wave):
    """Those of its densities in two dimensions are in test_compare_topography.py."""
    peer = pytest.importorskip("SurfaceTopography")
    map_ = peer.Topography(wave, (SIDE, SIDE), periodic=True)
    q, density = map_.power_spectrum_from_profile(resampling_method=None, reliable=False)
    assert q[np.argmax(density)] == pytest.approx(2 * np.pi * WAVES / SIDE)
    assert density.max() * (q[1] - q[0]) / np.pi == pytest.approx(HEIGHT**2 / 2)
