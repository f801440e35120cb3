"""Pages in their forms, their files, what is exported of them, and the one vocabulary."""

import json
import os
import re
import shutil
from functools import partial
from html.parser import HTMLParser
from math import inf, nan
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import xarray
from hypothesis import given
from hypothesis import strategies as st
from page_samples import FINDINGS, MEANS, ROWS, hostile_page, page, written
from pandas import DataFrame
from pandas.testing import assert_frame_equal
from PIL import Image
from strategies import examples

from compare.report import csvfiles, manifest, render, terminal
from compare.report.export import export
from compare.report.page import Page, Table, Text
from compare.solving import netcdf, vocabulary, words
from compare.solving.words import interval
from compare.statistics.finding import COLUMNS
from scene.files.reading import InvalidInput

draw_again = partial(export, format="png,pdf,svg")
STUDY = SimpleNamespace(command="run", inputs={"loads": np.array([1.0, nan])})
UNITS = {"m", "s", "N", "Pa", "K", "J", "byte", "Hz", "kg", "W", "rad"}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """What a command leaves: page, figures, tables, results and manifest."""
    path = tmp_path_factory.mktemp("left")
    drawn = []
    render.write(files := render.files(page(), FINDINGS, on_drawn=drawn.append), path)
    assert drawn == ["sphere/friction"]
    values = {"friction_force": ("seed", [0.1, 1 / 3]), "status": ("seed", ["solved", "not asked"])}
    dataset = xarray.Dataset(values, {"seed": [0, 1]})
    (path / netcdf.NAME).write_bytes(netcdf.packed(xarray.DataTree.from_dict({"/sphere/MDR": dataset})))
    manifest.stamp(path, STUDY, page(), SimpleNamespace(solved=1, reused=2, seconds=3.0), "solved", files)
    return path


@pytest.fixture
def copied(folder, tmp_path):
    """A folder that a command left, to be damaged."""
    return Path(shutil.copytree(folder, tmp_path / "left"))


# Numbers.


@pytest.mark.parametrize(
    ("value", "shown"),
    [(0.0, "0"), (-1.5, "−1.5"), (12345.6, "12350"), (1.234567e-5, "1.235 × 10⁻⁵"), (-2e7, "−2 × 10⁷"), (nan, "–"),
     (inf, "∞"), (np.int64(-4), "−4"), (True, "yes"), (None, "–"), ("as it is", "as it is")],
)  # fmt: skip
def test_a_value_is_shown_as(value, shown):
    assert words.shown(value) == shown


def test_ends_of_an_interval_are_shown_to_two_digits_of_its_half_and_not_at_all_where_unknown():
    assert interval(1.98292, 1.9735, 1.9924) == "1.9829 (1.9735 to 1.9924)"
    assert interval(1e-6, -1e-6, 3e-6) == "1.0 (−1.0 to 3.0) × 10⁻⁶"
    assert interval(1.98058, 1.98005, 1.98112) == "1.9806 (1.9801 to 1.9811)"
    assert interval(0.3413688752, 0.3413688655, 0.3413688849) == "0.34137"
    assert interval(2.0, nan, nan) == interval(2.0, 2.0, 2.0) == "2"


# Files.

FLOATS = st.floats(allow_nan=True, allow_infinity=True)
TEXTS = st.text(st.characters(codec="utf-8", exclude_characters="\r\0"), min_size=1).map(lambda text: f"a{text}")


@examples(30)
@given(st.lists(st.tuples(FLOATS, st.integers(-(2**62), 2**62), TEXTS), min_size=1))
def test_what_is_read_back_is_the_same_table(tmp_path_factory, rows):
    frame = DataFrame(rows, columns=["value", "count", "name"])
    path = tmp_path_factory.mktemp("csv") / "table.csv"
    path.write_text(csvfiles.text(frame), "utf-8")
    assert_frame_equal(csvfiles.read(path), frame, check_exact=True, check_dtype=False)


def test_every_table_of_a_page_lies_beside_it_with_every_digit(folder):
    assert_frame_equal(csvfiles.read(folder / "sphere/friction-speed.csv"), MEANS, check_exact=True)
    assert list(csvfiles.read(folder / "findings.csv")) == list(COLUMNS)
    listed = json.loads((folder / "manifest.json").read_text())["files"]
    assert {path for path in map(folder.joinpath, listed) if path.suffix == ".csv"} == set(folder.rglob("*.csv"))


def test_two_tables_of_one_name_are_refused_unless_they_are_one():
    one, same, other = (Table("points", frame) for frame in (ROWS, ROWS.copy(), ROWS * 2))
    render.tables(Page("", [], [one, same]), [])
    with pytest.raises(ValueError, match="'points'"):
        render.tables(Page("", [], [one, other]), [])


# Renderers.


class Links(HTMLParser):
    """Attributes and words of a page."""

    def __init__(self, text):
        super().__init__()
        self.attributes, self.words = [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.attributes += attributes

    def every(self, name):
        return [value for own, value in self.attributes if own == name]

    def handle_data(self, data):
        self.words.append(data)


def test_the_page_needs_nothing_else_and_every_link_leads_somewhere(folder):
    found = Links((folder / "report.html").read_text())
    anchors = found.every("id")
    assert len(anchors) == len(set(anchors))
    for link in found.every("href"):
        assert link[0] == "#"  # no link to another file, so that the page may be moved alone
        assert link[1:] in anchors
    for name in re.findall(r"<code>([^<]+\.(?:csv|png))</code>", (folder / "report.html").read_text()):
        assert (folder / name).is_file()
    assert [source[:22] for source in found.every("src")] == ["data:image/png;base64,"]
    assert found.every("alt")[0].startswith("Friction of all models")


def test_the_page_opens_with_its_answer_then_the_figure_then_tables(folder):
    text = (folder / "report.html").read_text()
    first = "<h1>", 'class="answer"', "<figure", "<table", 'id="section-3"'
    places = [text.index(part) for part in (*first, "Some *words*", "Rows.", 'id="made"')]
    assert places == sorted(places)


def test_a_page_has_answer_findings_tables_and_figures_escaped(tmp_path):
    text = written(page(), FINDINGS, tmp_path).read_text()
    shown = "".join(Links(text).words)
    for each in ("Depths at rest agree", "1.010 (0.986 to 1.034)", "fails", "undecided", "12.3 (10.9 to 13.8) s"):
        assert each in shown
    assert "the error of the grid is not known" in shown
    assert "sphere/friction.png" in text
    assert "<speed>" not in text
    assert "0.9009009" not in shown  # a long table is a file alone


def test_the_terminal_shows_a_claim_once_with_all_that_was_found():
    text = terminal.text(page())
    table = [line for line in text.splitlines() if "  1D/3D  " in line]
    assert [line.split()[0] for line in table] == ["holds", "fails"]
    assert [text.count(words) for words in ("1.010 (0.986 to 1.034)", "1 ± 0.05")] == [2, 4]
    assert text.count("Depths at rest agree") == 3  # twice in the answer, once in the table
    assert "Some *words* of code_x & <b>50 %</b> over two lines." in text
    assert "\n- one\n- two, on and on" in text
    assert all(len(line) <= terminal.WIDEST for line in text.splitlines())


def test_in_a_notebook_a_page_is_the_same_text(monkeypatch):
    plain = terminal.text(page())
    monkeypatch.setattr("rich.console._is_jupyter", lambda: True)
    assert terminal.text(page()) == plain


def test_a_notebook_gets_answer_findings_and_tables_without_links_that_lead_nowhere():
    found = Links(render.fragment(page()))
    assert not found.every("src") + found.every("href")
    assert "Depths at rest agree" in "".join(found.words)


def test_a_text_is_paragraphs_and_lists_and_any_mark_in_it_is_text():
    text = "*a* `b`\nc\n- [d](e)\n f\n- g\n\n$h$ <script>"
    assert Text(text).lines == ["*a* `b` c", "- [d](e) f", "- g", "$h$ <script>"]
    shown = "".join(render.fragment(Page("", (), [Text(text)])).split("\n"))
    item = '<p class="item">• '
    assert f"<p>*a* `b` c</p>{item}[d](e) f</p>{item}g</p><p>$h$ &lt;script&gt;</p>" in shown


def test_the_texts_of_a_stranger_are_no_marks_of_html_and_control_no_terminal(tmp_path):
    whole = written(hostile_page(), [], tmp_path).read_text(encoding="utf-8")
    for text in (whole, render.fragment(hostile_page())):
        found = Links(text)
        assert not re.search(
            r"<(script|svg|iframe|object|link|base|b|details open|meta http-equiv=refresh)\b", text
        )
        assert all(source.startswith("data:image/png;base64,") for source in found.every("src"))
        assert all(each[0] == "#" for each in found.every("href"))
        assert all(map(str.isprintable, text.split("\n")))
    (policy,) = re.findall('<meta http-equiv="Content-Security-Policy" content="(.*)">', whole)
    assert policy.startswith("default-src 'none'; ")
    assert all(map(str.isprintable, terminal.text(hostile_page()).split("\n")))


# Drawn again, and for others.


def test_a_figure_drawn_again_from_its_table_is_the_same_picture(folder, tmp_path):
    written = draw_again(folder, output=tmp_path)
    assert [path.suffix for path in written] == [".png", ".pdf", ".svg"]
    assert (tmp_path / "sphere/friction.png").read_bytes() == (folder / "sphere/friction.png").read_bytes()


@pytest.mark.parametrize(
    ("look", "millimetres"),
    [({"journal": "nature"}, 89), ({"width": "84 mm"}, 84), ({"journal": "wiley", "width": 0.1}, 100)],
)
def test_figures_of_a_journal_have_the_width_of_its_column(folder, tmp_path, look, millimetres):
    for asked, forms in ((None, [".png", ".pdf", ".svg"]), ("svg, png", [".png", ".svg"])):
        written = export(folder, asked, **look, output=tmp_path)
        assert [path.suffix for path in written] == forms
    with Image.open(written[0]) as drawn:
        assert drawn.width == pytest.approx(millimetres / 25.4 * 300, abs=1)


FORGED = [
    ({"module": "os"}, "os:figure"),
    ({"function": "DataFrame"}, "no figure of compare"),
    ({"name": "../friction"}, "leads out of"),
    ({"tables": ["missing"]}, "missing.csv"),
    ({"tables": "friction"}, "plots.0.tables"),
    ({"options": {"unheard": 1}}, "unheard"),
    ({"options": {"figsize": [1e9, 1e9]}}, "figsize"),
    ({"module": "compare.figures.contact", "options": {"aside": nan}}, "cannot be drawn"),
    ({"options": 3}, "plots.0.options"),
]


@pytest.mark.parametrize(("change", "message"), FORGED, ids=range(len(FORGED)))
def test_a_forged_figure_is_refused_by_name(copied, tmp_path, change, message):
    path = copied / "manifest.json"
    content = json.loads(path.read_text())
    content["plots"][0] |= change
    path.write_text(json.dumps(content))
    with pytest.raises(InvalidInput, match=re.escape(message)):
        draw_again(copied, output=tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_a_folder_of_another_version_says_so_in_one_line(copied):
    path = copied / "manifest.json"
    # also where the rest cannot be understood
    for changed in (json.loads(path.read_text()), {"plots": "elsewhere"}):
        path.write_text(json.dumps(changed | {"format": 1}))
        for ask in (draw_again, export):
            with pytest.raises(InvalidInput, match=r"manifest\.json: was written by another version"):
                ask(copied)


JSON = st.recursive(
    st.none() | st.booleans() | st.floats(allow_nan=False) | st.text(max_size=3),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(st.sampled_from(["plots", "command", "inputs", "solved", "name"]), inner)
    ),
)


@examples(30)
@given(JSON | st.binary(max_size=20))
def test_a_damaged_manifest_is_named_whatever_is_in_it(tmp_path_factory, content):
    path = tmp_path_factory.mktemp("forged")
    (path / "manifest.json").write_bytes(content if isinstance(content, bytes) else json.dumps(content).encode())
    with pytest.raises(InvalidInput, match=r"manifest\.json|no figures"):
        draw_again(path)


@pytest.mark.parametrize(
    ("damage", "message"),
    [
        (b"", "cannot be drawn"),
        (b"\xff", "not a table"),
        (b"a,b\n1\n1,2,3\n", "not a table"),
        (b"a\n1\n", "cannot be drawn"),
    ],
)
def test_a_damaged_table_is_named(copied, damage, message):
    (copied / "sphere/friction-speed.csv").write_bytes(damage)
    with pytest.raises(InvalidInput, match=message):
        draw_again(copied)


def circle(path):
    path.symlink_to(path)


def elsewhere(path):
    other = path.parent.parent.parent / "other"
    other.write_text("solver\nMDR\n")
    path.symlink_to(other)


READ = {
    "manifest.json": [draw_again, export],
    "sphere/friction-speed.csv": [draw_again, export],
    "results.nc": [netcdf.load],
}


@pytest.mark.skipif(os.name != "posix", reason="pipes and links")
@pytest.mark.parametrize("placed", [getattr(os, "mkfifo", os.mkdir), circle, elsewhere])
@pytest.mark.parametrize("name", READ)
def test_what_stands_in_the_place_of_a_file_is_named_and_not_read(copied, name, placed):
    (copied / name).unlink()
    placed(copied / name)
    for read in READ[name]:
        with pytest.raises(InvalidInput, match=f"{re.escape(name)}|results here"):
            read(copied)


def test_a_table_comes_back_whatever_its_numbers_are(tmp_path):
    (tmp_path / "table.csv").write_text("a,b\n1,2,3\n4,5,6\n")
    with pytest.raises(InvalidInput, match="longer than its head"):
        csvfiles.read(tmp_path / "table.csv")
    (tmp_path / "table.csv").write_text(f"a\n{'1' * 30}\n2\n")
    assert csvfiles.read(tmp_path / "table.csv")["a"].tolist() == [int("1" * 30), 2]


def test_nothing_is_written_out_of_the_folder(copied, tmp_path):
    (copied / "figures").symlink_to(tmp_path)
    with pytest.raises(InvalidInput, match="leads out of"):
        export(copied)
    assert [path.name for path in tmp_path.iterdir()] == ["left"]
    assert not list(tmp_path.parent.glob("*.csv"))


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"journal": "natur"}, "mean nature"),
        ({"width": "5 m"}, "width = '5 m': 80 mm to 200 mm"),
        ({"width": "84 s"}, "width = '84 s': a length"),
        ({"style": "no-such-style"}, "no-such-style"),
        ({"style": {"lines.colour": "red"}}, r"lines\.colour"),
    ],
)
def test_a_look_that_does_not_exist_is_refused(folder, tmp_path, given, message):
    with pytest.raises(InvalidInput, match=message):
        export(folder, output=tmp_path, **given)
    assert not list(tmp_path.iterdir())


# Vocabulary.

# Columns that explain themselves.
PLAIN = frozenset(
    ("case", "cases", "group", "broken", "solved", "checks", "outcome", "title", "label", "series", "shape")
)
PREFIXES = ("holds: ", "within ", "must hold", "hard because", "refused as it should", "tolerances moved")


def test_every_entry_has_a_sentence_and_a_unit_that_is_si_as_udunits_spells_it():
    for name, entry in vocabulary.LABELS.items():
        assert entry.text.endswith((".", "]")), name
        assert set(re.findall(r"[A-Za-z]+|[^ -~]", entry.unit)) <= UNITS, name


def test_an_ending_says_what_it_adds():
    low, whole = vocabulary.entry("friction_force_low"), vocabulary.entry("friction_force")
    assert low.unit == whole.unit == "N"
    assert low.text.startswith("Lower end")
    assert low.text.endswith(whole.text)
    assert vocabulary.stem("reference_error") == "reference_error"
    assert vocabulary.entry("no such column") is None


def test_the_same_page_gives_the_same_bytes(folder, tmp_path):
    again = written(page(), FINDINGS, tmp_path)
    assert again.read_bytes() == (folder / "report.html").read_bytes()


def test_every_column_of_findings_is_defined_and_those_of_figures_are_or_explain_themselves():
    assert all(vocabulary.entry(name) for name in COLUMNS)
    for path in (Path(__file__).parent / "plots").rglob("*.csv"):
        for name in csvfiles.read(path):
            explains_itself = name in PLAIN or name.startswith(PREFIXES)
            assert explains_itself or vocabulary.entry(name), (path.parent.name, name)
