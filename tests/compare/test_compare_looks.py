"""Looks of figures: widths and texts of journals, users' own styles, colours that every reader can distinguish.

Every figure that a command can leave is drawn from the tables in plots, as `crosscheck export` draws it.
"""

import re
import zlib
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from functools import cache
from itertools import combinations, product
from pathlib import Path
from string import ascii_lowercase

import matplotlib
import numpy as np
import pytest
from drawn_again import from_files
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import same_color, to_rgba
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.text import Text
from matplotlib.transforms import Bbox
from page_samples import MEANS
from pandas import DataFrame, concat
from small_cases import seldom

from compare.figures import curves, force_depth, friction, shades, style
from compare.figures.plot import FORMS, Plot, picture
from compare.figures.style import COLUMNS
from compare.report import csvfiles, manifest
from compare.report.export import function
from compare.statistics.means import ENDS

SAMPLES = Path(__file__).parent / "plots"
ENTRIES = {entry.name.partition("/")[0]: entry for entry in next(manifest.folders(SAMPLES))[1].plots}
# Least text and line [point] that journals ask for, as the head of each style sheet says with its source.
LEAST = dict.fromkeys(COLUMNS, (6.0, 0.3)) | {
    "acs": (4.5, 0.5),
    "aip": (8.0, 0.5),
    "aps": (8.0, 0.51),
    "elsevier": (7.0, 0.25),
    "ieee": (8.0, 0.3),
    "iop": (8.0, 0.3),
    "nature": (5.0, 0.25),
    "springer": (8.0, 0.3),
}
NARROW, OTHERS = "iop", [name for name in COLUMNS if name != "iop"]
# Boxes of texts hold a pixel of nothing on each side [pixel].
TOUCHING = 1.0
ROUNDING = 1e-9
# Lightness in CIE Lab: ten are a step of a grey scale of eleven, as print tells them apart. Colours so different
# in lightness differ for every reader; the two of the models are of the set of Okabe and Ito.
LIGHTER = 10.0

# Figures held against every law in each run: an image and a legend, curves with bands and bars; else on demand.
OFTEN = {"contact-figure", "force_depth-figure"}

every_figure = pytest.mark.parametrize("name", seldom(ENTRIES, OFTEN))


@cache
def sample(name):
    """A figure with the tables of its sample."""
    entry = ENTRIES[name]
    tables = {table: csvfiles.read(SAMPLES / name / f"{table}.csv") for table in entry.tables}
    return Plot(name, function(entry, SAMPLES), tables, "", options=entry.options)


def lightness(colour):
    """L of CIE Lab of a colour as seen on white."""
    *solid, alpha = to_rgba(colour)
    seen = alpha * np.array(solid) + 1 - alpha
    linear = np.where(seen <= 0.04045, seen / 12.92, ((seen + 0.055) / 1.055) ** 2.4)
    luminance = np.dot([0.2126, 0.7152, 0.0722], linear)
    return 116 * np.cbrt(luminance) - 16 if luminance > (6 / 29) ** 3 else (29 / 3) ** 3 * luminance


def drawn(name, look=style.PRINT):
    with style.applied(look):
        return sample(name).figure()


@cache
def plain(name):
    """As it is without a journal or a user's own style; only to be looked at."""
    return drawn(name)


@cache
def laid_out(name, asked):
    """The figure in a journal, and the texts and lines that drawing puts into it."""
    texts: dict[int, Text] = {}
    lines: dict[int, Line2D] = {}
    with style.applied(style.Look(asked)), pytest.MonkeyPatch.context() as patch:
        drawing = sample(name).figure()
        FigureCanvasAgg(drawing)
        drawing.draw_without_rendering()
        drawing.set_layout_engine("none")
        for kind, kept in ((Text, texts), (Line2D, lines)):
            patch.setattr(kind, "draw", _noting(kind.draw, kept))
        drawing.canvas.draw()
    return drawing, [text for text in texts.values() if text.get_text().strip()], list(lines.values())


def _noting(draw, kept):
    def noted(artist, *given, **named):
        if artist.get_visible():
            kept[id(artist)] = artist
        return draw(artist, *given, **named)

    return noted


def laws_of_layout(name, asked):
    """What is wrong with the figure in a journal."""
    drawing, texts, lines = laid_out(name, asked)
    boxes = [(text.get_text(), text.get_window_extent()) for text in texts]
    least, thinnest = LEAST[asked]
    for text in texts:
        if text.get_fontsize() < least - ROUNDING:
            yield f"{text.get_text()!r} has {text.get_fontsize():.3g} points"
    for line in lines:
        if line.get_linestyle() not in ("None", "none", "") and line.get_linewidth() < thinnest - ROUNDING:
            yield f"a line has {line.get_linewidth():.3g} points"
    if drawing.get_figwidth() not in COLUMNS[asked]:
        yield "it is neither as wide as a column nor as the page"
    width, height = drawing.bbox.width, drawing.bbox.height
    for text, box in boxes:
        if min(box.x0, box.y0) < -TOUCHING or box.x1 > width + TOUCHING or box.y1 > height + TOUCHING:
            yield f"{text!r} is cut"
    for (text, box), (other, other_box) in combinations(boxes, 2):
        over = Bbox.intersection(box, other_box)
        if over is not None and min(over.width, over.height) > TOUCHING:
            yield f"{text!r} lies over {other!r}"
    for axes in drawing.axes:
        legend = axes.get_legend()
        points = [line.get_transform().transform(line.get_xydata()) for line in axes.lines]
        if legend is not None and any(legend.get_window_extent().count_contains(each) for each in points):
            yield f"a legend of {axes.get_title(loc='left')!r} lies over curves"


def test_a_sample_is_there_for_every_figure_of_the_package():
    drawn_by = {(entry.module.rpartition(".")[2], entry.function) for entry in ENTRIES.values()}
    known = {
        (path.stem, name)
        for path in style.SHEETS.glob("*.py")
        for name in re.findall(
            r"^def ([a-z]\w*)\(\s*tables: Tables.*?\) -> Figure:", path.read_text(), re.M | re.S
        )
    }
    assert known <= drawn_by


@every_figure
def test_in_the_narrowest_page_texts_are_large_enough_whole_and_apart(name):
    assert not list(laws_of_layout(name, NARROW))


@pytest.mark.slow
@pytest.mark.parametrize("asked", OTHERS)
@every_figure
def test_in_every_journal_texts_are_large_enough_whole_and_apart(name, asked):
    assert not list(laws_of_layout(name, asked))


def test_texts_too_small_cut_or_over_one_another_are_found(monkeypatch):
    monkeypatch.setitem(COLUMNS, NARROW, (1.2, 2.4))
    drawing, texts, lines = laid_out.__wrapped__("force_depth-figure", NARROW)
    texts[0].set_fontsize(7.9)
    monkeypatch.setitem(globals(), "laid_out", lambda *_: (drawing, texts, lines))
    found = list(laws_of_layout("force_depth-figure", NARROW))
    assert any("is cut" in fault or "lies over" in fault for fault in found)
    assert any("has 7.9 points" in fault for fault in found)


@every_figure
def test_every_axis_says_its_unit(name):
    drawing, texts, _ = laid_out(name, NARROW)
    shown = {id(text) for text in texts}
    for axes, direction in product((axes for axes in drawing.axes if axes.axison), "xy"):
        ticks = [
            label.get_text() for label in getattr(axes, f"get_{direction}majorticklabels")() if id(label) in shown
        ]
        words = [text for text in ticks if re.search(r"[a-z]{3}", text) and "math" not in text]
        if words or not re.search(r"\d", " ".join(ticks)):
            continue
        shared = getattr(axes, f"get_shared_{direction}_axes")().get_siblings(axes)
        labels = [getattr(each, f"get_{direction}label")() for each in (axes, *shared)]
        assert any("[" in label for label in labels), (direction, axes.get_title(loc="left"), labels)


@every_figure
def test_every_panel_has_its_letter(name):
    drawn_in = [axes for axes in plain(name).axes if not axes.get_label().startswith("<")]  # no colour bars
    drawn_in = [axes for axes in drawn_in if axes.axison or axes.get_title(loc="left")]
    letters = [axes.get_title(loc="left").split(" ")[0] for axes in drawn_in]
    assert len(letters) == 1 or letters == [f"({letter})" for letter in ascii_lowercase[: len(letters)]]


@every_figure
def test_a_style_of_ones_own_holds_in_every_figure(name):
    """A quarter more text, twice the lines, in another font and on black; the colours of models stay."""
    sheet = {"font.size": 10, "lines.linewidth": 2.2, "lines.markersize": 8, "font.family": "serif"}
    styled = drawn(name, style.Look(sheet=sheet | {"axes.facecolor": "black", "text.color": "white"}))
    for solver in style.COLOURS.values():
        assert _uses(plain(name), solver) == _uses(styled, solver)
    sizes, larger = (max(text.get_fontsize() for text in _written(each)) for each in (plain(name), styled))
    assert larger == pytest.approx(1.25 * sizes, rel=ROUNDING)
    assert {text.get_fontfamily()[0] for text in _written(styled)} == {"serif"}
    widths, wider = (_widths(each) for each in (plain(name), styled))
    assert max(wider, default=0) == pytest.approx(2 * max(widths, default=0), rel=ROUNDING)


def _written(drawing):
    return [text for text in drawing.findobj(Text) if text.get_text().strip()]


def _widths(drawing):
    """Of curves, not of axes, ticks and edges of markers."""
    lines = (line for axes in drawing.axes for line in axes.lines)
    return [line.get_linewidth() for line in lines if line.get_linestyle() not in ("None", "")]


def _uses(drawing, colour):
    return sum(same_color(line.get_color(), colour) for line in drawing.findobj(Line2D))


def _handles(drawing):
    """Of each panel, what has a label; and what stands before the labels of legends made apart."""
    for axes in drawing.axes:
        yield [
            _sight(each)
            for each in {each.get_label(): each for each in axes.get_legend_handles_labels()[0]}.values()
        ]
    for legend in drawing.findobj(Legend):
        if all(isinstance(handle, Line2D | Patch) for handle in legend.legend_handles):
            yield [_sight(handle) for handle in legend.legend_handles]


def _sight(handle):
    """Colour, and what else tells it from others: dashes, marker, whether hollow or thin."""
    handle = handle.lines[0] if hasattr(handle, "lines") else handle  # of error bars
    if isinstance(handle, Line2D):
        thin = handle.get_linewidth() < 0.66
        form = str(handle._dash_pattern), handle.get_linestyle(), str(handle.get_marker()), _hollow(handle), thin
        return handle.get_color(), ("line", *form)
    if isinstance(handle, Patch):
        return handle.get_facecolor(), ("patch",)
    colours = [*handle.get_facecolor(), *handle.get_edgecolor()]
    paths = tuple(len(path.vertices) for path in handle.get_paths())
    return tuple(colours[0]), ("points", paths, len(handle.get_facecolor()) == 0)


def _hollow(line):
    return not same_color(line.get_markerfacecolor(), line.get_color())


@every_figure
def test_what_a_legend_names_is_told_apart_in_grey(name):
    for handles in _handles(plain(name)):
        for (colour, form), (other, beside) in combinations(handles, 2):
            assert form != beside or abs(lightness(colour) - lightness(other)) >= LIGHTER, (colour, other, form)


@pytest.mark.parametrize("shades_of", [shades.SPEED, shades.PRESS])
def test_colour_maps_grow_lighter_in_even_steps(shades_of):
    steps = np.diff([lightness(colour) for colour in shades_of(np.linspace(0, 1, 21))])
    assert 0 < steps.min() < steps.max() < 2 * steps.mean()


@pytest.fixture(scope="module")
def files():
    """A figure as files: with an image, curves and a legend."""
    return picture(sample("contact-figure"), FORMS)


def test_the_same_numbers_give_the_same_files(files):
    assert tuple(files.files) == FORMS
    assert picture(sample("contact-figure"), FORMS) == files


def test_every_font_of_a_pdf_is_inside_as_truetype(files):
    content = files.files["pdf"]
    whole = content + b"".join(_streams(content))
    fonts, inside = whole.count(b"/Type /FontDescriptor"), whole.count(b"/FontFile2 ")
    assert fonts == inside > 0
    assert b"/Type3" not in whole  # fonts drawn as procedures


def _streams(content):
    for found in re.finditer(rb"stream\r?\n", content):
        with suppress(zlib.error):
            yield zlib.decompressobj().decompress(content[found.end() :])


def test_vector_files_name_no_day_and_hold_their_letters(files):
    text = files.files["svg"].decode()
    assert "<dc:date>" not in text
    assert "<text" not in text  # letters are outlines: no font has to be at the reader's


def test_what_the_machine_has_set_does_not_show():
    with matplotlib.rc_context({"lines.linewidth": 9.0, "font.size": 30, "axes.facecolor": "yellow"}):
        figure = drawn("friction-figure")
    assert figure.axes[0].get_facecolor() == (1.0, 1.0, 1.0, 1.0)
    assert max(_widths(figure)) < 2


def test_a_logarithmic_axis_has_few_round_numbers_however_short_it_is():
    axes = Figure().subplots()
    axes.set_xscale("log")
    for low, share in product((1.05e-4, 0.31, 7.0, 480.0), (1.05, 1.5, 2.5, 9.0, 60.0, 2e3, 1e9)):
        axes.set_xlim(low, share * low)
        style.decades(axes)
        seen = [tick for tick in axes.get_xticks() if low <= tick <= share * low]
        assert 2 <= len(seen) <= 9, (low, share)
        assert seen == pytest.approx([float(f"{tick:.4g}") for tick in seen])


def test_what_has_no_answer_is_crossed_on_the_axis_and_without_an_end_there_is_no_bar():
    axes = Figure().subplots()
    ends = {"mu_low": [np.nan, 1.0, np.nan], "mu_high": [np.nan, 3.0, 3.0]}
    points = DataFrame({"model": "BEM", "speed": [0.1, 1.0, 2.0], "mu": [np.nan, 2.0, 2.0], **ends})
    curves.curves(axes, points, "speed", "mu")
    crosses = axes.lines[-1]
    assert (crosses.get_xdata().tolist(), crosses.get_marker()) == ([0.1], "x")
    assert crosses.get_label() == "3D (BEM): no answer"
    (bars,) = axes.containers[0].lines[2]
    assert [len(each) > 1 for each in bars.get_segments()] == [False, True, False]  # places of both ends


@pytest.mark.slow
def test_threads_that_draw_at_once_draw_as_one_alone():
    def drawn_in(chosen):
        return picture(sample("friction-figure"), look=style.Look(chosen)).files

    asked, outside = ("default", "nature"), dict(matplotlib.rcParams)
    with ThreadPoolExecutor(len(asked)) as threads:
        together = list(threads.map(drawn_in, asked))
    assert together == [drawn_in(each) for each in asked]
    assert dict(matplotlib.rcParams) == outside


# Curves: axes end where the data do, a depth is one place for all models, and few curves are drawn.


def test_a_line_decades_below_does_not_press_the_curves_together():
    lines = DataFrame({"model": ["MDR"] * 2, "speed": [0.1, 1.0], "load": 1.0, "friction_coefficient": 1e-9})
    lines["kind"] = "Eq. 19"
    axes = from_files(friction.plot(MEANS, lines=lines)).axes[0]
    ends = MEANS["friction_coefficient_low"].min() / 1.2, MEANS["friction_coefficient_high"].max() * 1.2
    assert axes.get_ylim() == pytest.approx(ends)
    assert style.LABEL["MDR"] + ", Eq. 19" in axes.get_legend_handles_labels()[1]


def test_ratios_of_every_panel_are_within_the_axes_that_panels_share():
    points = concat([MEANS, MEANS.assign(load=2.0)])
    ratios = points[points["model"] == "MDR"].assign(body="rough")
    for end in ("", "_low", "_high"):
        ratios[f"ratio{end}"] = 3.0 * ratios["load"]
    lower = [axes for axes in from_files(friction.plot(points, ratios)).axes if axes.get_ylim()[0] == 0]
    assert min(axes.get_ylim()[1] for axes in lower) > 6


def test_both_models_stand_at_the_depth_that_was_prescribed():
    names = {"speed": "depth"} | {f"friction_coefficient{end}": f"normal_force{end}" for end in ENDS}
    forces = MEANS.drop(columns="load").rename(columns=names).assign(body="rough", closed_form=1.0)
    for axes in from_files(force_depth.plot(forces, DataFrame())).axes[:2]:
        places = [bars[0].get_xdata().astype(float) for bars in axes.containers]
        np.testing.assert_allclose(places, 2 * [1e6 * forces["depth"].unique()], rtol=1e-12)


@pytest.mark.parametrize("count", [1, 3, 8, 30])
def test_few_values_keep_the_least_and_the_greatest(count):
    values = np.geomspace(1, 10, count)
    chosen = shades.few(values[::-1], 8)
    assert len(chosen) == min(count, 8)
    assert (chosen[0], chosen[-1]) == (values[0], values[-1])
