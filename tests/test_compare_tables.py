"""Tables for others: every digit as CSV, and LaTeX that prints what is stored, whatever letters it has."""

import csv
import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import examples

from compare.archive import RESULTS, SOLVED, record
from compare.cases import Case, Study
from compare.store import Store
from compare.study import points, tasks
from compare.sweep import Swept
from compare.tables import FORMS, cell, escaped, export, latex
from compare.verdict import Judgement, Number, judge
from mdr1d import MDR
from scene import Indent, Kelvin, SelfAffine, Sphere
from scene.reading import InvalidInput

CASE = Case(
    title="50 % & more_or_less #1",
    indenter=Sphere(radius=1e-2),
    elastomer=Kelvin(modulus=1e6, relaxation_time=1e-3),
    motion=Indent(depth=1e-4),
    roughness=SelfAffine(hurst=0.5, rms_height=1e-6, longest=1e-2, shortest=1e-3, seed=1),
    study=Study(depths=(0.5, 1.0), surfaces=1, profiles=3),
    mdr=MDR(points=200),
)


@pytest.fixture(scope="module")
def judgement() -> Judgement:
    """Solved in one dimension; three is failed, which a table must survive."""
    asked = points(CASE)
    solved = {t: t.solve() if t.solver.name != "BEM" else t.failed("none") for t in tasks(asked)}
    found = judge(CASE, asked, Swept(solved, len(solved), 0, 1.0))
    return replace(found, numbers=(Number("force_ratio & co", "−6.7 ± 6.4 %", -0.067, 0.064, "50 % of µ²"),))


@pytest.fixture(scope="module")
def folder(judgement, tmp_path_factory):
    folder = tmp_path_factory.mktemp("report")
    (folder / "rough_sphere").mkdir()
    record(folder / "rough_sphere" / RESULTS, judgement)
    first = tasks(points(CASE))[0]
    Store(folder / SOLVED).put(first, first.solve())
    return folder


def test_csv_has_every_digit_and_every_unit(folder, judgement, tmp_path):
    written = export(folder, tmp_path, "csv")
    assert {path.name for path in written} >= {"rough-sphere-points.csv", "rough-sphere-numbers.csv", "solved.csv"}
    assert sorted(tmp_path.iterdir()) == sorted(written)
    with (tmp_path / "rough-sphere-points.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == len(judgement.table)
    for row, point in zip(rows, judgement.table, strict=True):
        assert row["kind"] == point.kind
        assert repr(float(row["normal_force [N]"])) == repr(point.normal_force.mean)
        assert repr(float(row["depth_reached_error [m]"])) == repr(point.depth_reached.error)
    assert "friction_coefficient" in rows[0]


def test_latex_has_points_numbers_and_collapses_as_a_paper_shows_them(folder, tmp_path):
    written = {path.name: path.read_text(encoding="utf-8") for path in export(folder, tmp_path, "latex")}
    points = written["rough-sphere-force-depth.tex"]
    assert "normal force {[}N{]}" in points
    assert r"\pm" in points
    assert "--" in points  # of the failed ones
    assert "friction coefficient" in points
    numbers = written["rough-sphere-numbers.tex"]
    assert r"force\_ratio \& co & $-$6.7 $\pm$ 6.4 \% \\" in numbers
    for name, text in written.items():
        assert rf"\label{{tab:{name.removesuffix('.tex')}}}" in text
        check_structure(text)


def test_a_file_of_one_task_is_a_table_too(folder, tmp_path):
    (path,) = (folder / SOLVED).glob("*.nc")
    for form, ending in FORMS.items():
        written = [file for file in export(path, tmp_path / form, form) if file.stem == path.stem]
        assert [file.suffix for file in written] == [ending]
    check_structure((tmp_path / "latex" / f"{path.stem}.tex").read_text())


def test_tables_of_a_command_without_a_file_of_results_become_latex(folder, tmp_path):
    left = tmp_path / "study"
    (left / "series-1").mkdir(parents=True)
    first = tasks(points(CASE))[0]
    Store(left / SOLVED).put(first, first.solve())
    (left / "series-1" / "findings.csv").write_text(
        "claim,value,text\nμ ~ v^b,0.25,100 % sure\n", encoding="utf-8"
    )
    (path,) = export(left, tmp_path / "latex", "latex")
    assert path.name == "series-1-findings.tex"
    assert r"$\mu$ \textasciitilde{} v\textasciicircum{}b & 0.25 & 100 \% sure \\" in path.read_text(
        encoding="utf-8"
    )


def test_mistakes_are_said_before_anything_is_written(folder, tmp_path):
    with pytest.raises(ValueError, match="form = 'word': one of csv, latex"):
        export(folder, tmp_path / "new", "word")
    (tmp_path / "empty").mkdir()
    with pytest.raises(InvalidInput, match="no command has left results here"):
        export(tmp_path / "empty", tmp_path / "new", "csv")
    assert not (tmp_path / "new").exists()


@pytest.mark.parametrize(
    ("value", "printed"),
    [
        ((0.1234567, 0.0021), r"$0.1235 \pm 0.0021$"),
        ((-6.66, 6.4), r"$-6.7 \pm 6.4$"),
        ((1.234e-5, 2.1e-7), r"$(1.234 \pm 0.021) \times 10^{-5}$"),
        ((123456.0, 7000.0), r"$(1.235 \pm 0.070) \times 10^{5}$"),
        ((1234.5, 250.0), r"$1234 \pm 250$"),
        ((0.0, 0.5), r"$0.00 \pm 0.50$"),
        ((0.5, float("nan")), "0.5"),
        ((float("nan"), 0.1), "--"),
        ((1.0000000000000002, 2e-16), "1"),
        (-0.25, "$-0.25$"),
        (3.14159e-7, r"$3.142 \times 10^{-7}$"),
        (float("inf"), r"$\infty$"),
        (float("-inf"), r"$-\infty$"),
        (np.float64(2.0), "2"),
        (np.int64(-3), "$-3$"),
        (True, "yes"),
        (np.False_, "no"),
        (None, ""),
        ("a_b", r"a\_b"),
    ],
)
def test_a_cell_prints_as(value, printed):
    assert cell(value) == printed


@examples(200)
@given(
    value=st.floats(-1e12, 1e12, allow_subnormal=False).filter(lambda value: abs(value) > 1e-12),
    relative=st.floats(1e-6, 10.0),
)
def test_a_printed_value_is_within_a_twentieth_of_its_error(value, relative):
    """Two digits of the error: of the first, a tenth; half of that at most is lost by rounding."""
    error = abs(value) * relative
    numbers = re.findall(r"-?\d+(?:\.\d+)?", cell((value, error)))
    power = 10.0 ** int(numbers[3]) if "times" in cell((value, error)) else 1.0
    least = 0.5 if "." not in numbers[1] else 0.0  # no digit behind the point where the error has three before it
    assert abs(float(numbers[0]) * power - value) <= max(0.0501 * error, least)
    assert abs(float(numbers[1]) * power - error) <= max(0.0501 * error, least)


@examples(200)
@given(
    text=st.text(
        st.characters(codec="latin-1") | st.sampled_from('µμ±×²⁻−≤≥τξ°→\\&%$#_{}~^<>|[]*"\n'), max_size=30
    )
)
def test_text_is_escaped_whatever_it_is(text):
    """Nothing that LaTeX takes for a command is left, but what was put there: groups close, mathematics ends."""
    plain = re.sub(r"\\[&%$#_{}]|\\text[a-z]+\{\}", "", escaped(text))
    assert not re.search(r"[&%#_~\"\n]", plain)
    assert plain.count("$") % 2 == 0
    outside = re.sub(r"\$[^$]*\$", "", plain)
    assert not re.search(r"[\\^<>|]", outside)
    assert outside.replace("{[}", "").replace("{]}", "").replace("{*}", "").count("{") == 0


def test_an_escaped_text_is_another_where_it_must_be():
    assert escaped("100 % of a_b & {c} [d] ~ ^ \\ #1 $") == (
        r"100 \% of a\_b \& \{c\} {[}d{]} \textasciitilde{} \textasciicircum{} \textbackslash{} \#1 \$"
    )


def test_rows_become_booktabs_with_caption_and_label():
    text = latex([{"name": "a & b", "x": (1.0, 0.1)}, {"name": "[c]", "x": (2.0, 0.1)}], "50 %", "tab:x")
    assert text.splitlines() == [
        r"\begin{table}",
        r"  \centering",
        r"  \caption{50 \%}",
        r"  \label{tab:x}",
        r"  \begin{tabular}{lr}",
        r"    \toprule",
        r"    name & x \\",
        r"    \midrule",
        r"    a \& b & $1.00 \pm 0.10$ \\",
        r"    {[}c{]} & $2.00 \pm 0.10$ \\",
        r"    \bottomrule",
        r"  \end{tabular}",
        r"\end{table}",
    ]


def check_structure(text):
    """Environments close in turn, and every line has as many cells as the table has columns."""
    open_ones = []
    for kind, name in re.findall(r"\\(begin|end)\{(\w+)\}", text):
        if kind == "begin":
            open_ones.append(name)
        else:
            assert open_ones.pop() == name
    assert open_ones == []
    (sides,) = re.findall(r"\\begin\{tabular\}\{([lr]+)\}", text)
    body = [line for line in text.splitlines() if line.endswith(r"\\")]
    assert len(body) > 1
    for line in body:
        assert len(re.findall(r"(?<!\\)&", line)) == len(sides) - 1
    assert text.count("$") - text.count(r"\$") == len(re.findall(r"(?<!\\)\$", text))
    assert len(re.findall(r"(?<!\\)\$", text)) % 2 == 0


def test_a_broken_table_is_seen():
    with pytest.raises(AssertionError):
        check_structure(latex([{"a": 1, "b": "x"}]).replace("1 & x", "1 & x & y"))
