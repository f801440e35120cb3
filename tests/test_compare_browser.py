"""Pages in a browser: nothing is fetched, nothing is broken, tables sort, a phone and A4 hold them."""

import re
import shutil
from dataclasses import replace
from functools import partial
from itertools import pairwise

import pytest
from test_compare_report import CASE, solved
from test_compare_study_report import SWEPT, two_series

from bem3d import BEM
from compare import illustration, publish, report
from compare.paper import campaign, contacts, law, parameters
from compare.paper.claims import claims
from compare.paper.report import write_paper
from compare.paper.reproduction import Reproduction
from compare.stability.examination import Examination
from compare.stability.report import record, write_stability
from compare.studies.report import write_study
from compare.workprecision.contest import FORCE, ClosedForm, Contest, Known, Ladder
from compare.workprecision.diagram import Diagram
from compare.workprecision.report import chapter, write_workprecision
from scene import Indent, Kelvin, Scene, Sphere
from scene.scales import elastic_contact

playwright = pytest.importorskip("playwright.sync_api", reason="playwright drives the browser: extra browser")
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no chromium on the path")
ALONE = (
    *("--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"),
    *("--disable-background-networking", "--disable-component-update", "--disable-sync"),
)
PAGES = ("run", "paper", "study", "workprecision", "stability")
PHONE, DESK = {"width": 360, "height": 740}, {"width": 1280, "height": 900}
# Between the margins of A4, at 96 dots per inch.
PAPER = {"width": int((210 - 2 * 12) / 25.4 * 96), "height": 1000}
SMALL = campaign.Campaign(values=2, hurst=(0.0, 1.0), profiles=3)
PRESSED = Scene(Sphere(radius=10e-3), Kelvin(modulus=1e6, relaxation_time=1e-3), Indent(depth=1e-4))
HERTZ = ClosedForm("Hertz", {"force": Known(elastic_contact(PRESSED).load)})
LANDSCAPE = {"width": int((297 - 2 * 10) / 25.4 * 96), "height": 700}  # for tables of data
# Of text against what lies behind it, which WCAG 2 asks of level AA.
CONTRAST = 4.5
# A picture said in fewer letters says nothing of what is seen.
SAID = 20

AUDIT = """
([contrast, said]) => {
  const faults = [], all = selector => [...document.querySelectorAll(selector)];
  const fault = (what, element) => faults.push(`${what}: ${element.outerHTML?.slice(0, 90) ?? element}`);
  for (const image of all("img")) {
    if (!image.complete || image.naturalWidth === 0) fault("image not loaded", image);
    if ((image.alt ?? "").length < said) fault("image not said", image);
  }
  const ids = all("[id]").map(element => element.id);
  ids.filter((id, place) => ids.indexOf(id) !== place).forEach(id => fault("id twice", id));
  for (const link of all("a")) {
    const target = link.getAttribute("href") ?? "";
    if (target.startsWith("#") && !document.getElementById(target.slice(1))) fault("dead link", link);
    if (!(link.textContent.trim() || link.getAttribute("aria-label"))) fault("link not said", link);
  }
  all("th:not([scope])").forEach(head => fault("head without scope", head));
  const levels = all("h1, h2, h3, h4, h5, h6").map(heading => Number(heading.tagName[1]));
  if (levels.filter(level => level === 1).length !== 1) fault("h1", levels.join(" "));
  levels.forEach((level, place) => {
    if (level > (levels[place - 1] ?? 0) + 1) fault("heading skipped", `${place}`);
  });
  if (!document.documentElement.lang) fault("no language", document.documentElement);
  if (!document.title) fault("no title", document.documentElement);
  for (const table of all("table")) {
    const wide = row => [...row.cells].reduce((sum, cell) => sum + cell.colSpan, 0);
    for (const row of table.rows) if (wide(row) !== wide(table.rows[0])) fault("row of another width", row);
  }
  const parts = colour => colour.match(/[\\d.]+/g).map(Number);
  const light = colour => {
    const linear = c => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
    const [r, g, b] = parts(colour).map(c => linear(c / 255));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const ground = element => {
    for (let part = element; part; part = part.parentElement) {
      const colour = getComputedStyle(part).backgroundColor;
      if ((parts(colour)[3] ?? 1) > 0) return colour;
    }
    return "rgb(255, 255, 255)";
  };
  const seen = new Set();
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const element = walker.currentNode.parentElement;
    if (seen.has(element) || !walker.currentNode.textContent.trim()) continue;
    if (["SCRIPT", "STYLE"].includes(element.tagName)) continue;
    seen.add(element);
    const [one, other] = [getComputedStyle(element).color, ground(element)].map(light);
    const found = (Math.max(one, other) + 0.05) / (Math.min(one, other) + 0.05);
    if (found < contrast) fault(`contrast ${found.toFixed(1)}`, element);
  }
  return faults;
}
"""
WIDE = "document.scrollingElement.scrollWidth - innerWidth"
OPEN = "for (const part of document.querySelectorAll('details')) part.open = true"
FILES = "[...document.querySelectorAll('[href], [src]')].map(e => e.getAttribute('href') ?? e.getAttribute('src'))"


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """Every page of the command from a small run, by its name; figures as the page has them and no more."""
    root = tmp_path_factory.mktemp("pages")
    folders = {name: root / name for name in PAGES}
    for folder in folders.values():
        folder.mkdir()
    case = replace(CASE, study=replace(CASE.study, surfaces=2, profiles=2))
    judgement, swept = solved(case)
    asked = Contest("sphere", "a sphere", HERTZ, (FORCE,), (Ladder.of("BEM", PRESSED, BEM(), "points", (32, 64)),))
    rungs = {rung: rung.solve() for rung in asked.timed}
    diagram = Diagram(
        "elastic", "A sphere at rest", "Hertz.", lambda size: [asked], lambda found: "Take 64 points."
    )
    chapters = [chapter(folders["workprecision"], diagram, diagram.judge("quick", rungs))]
    records = [record(name, Examination(name, "small").solve()) for name in ("speed-zero", "no-shapes")]
    found = reproduction()
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(illustration, "draw", partial(publish.draw, forms=("png",)))
        patched.setattr(publish, "DOTS_PER_INCH", 100)
        return {
            "run": report.write_report(folders["run"], {"data": judgement}, swept),
            "paper": write_paper(folders["paper"], found, claims(found), SWEPT),
            "study": write_study(folders["study"], two_series(), SWEPT),
            "workprecision": write_workprecision(folders["workprecision"], chapters, "quick", SWEPT),
            "stability": write_stability(folders["stability"], records, "small", SWEPT),
        }


def reproduction():
    """The paper on three profiles, without what it measured."""

    def answers(tasks):
        return {task: task.solve() for task in tasks}

    lawful = {shape: law.tasks(shape, 3) for shape in parameters.SHAPES}
    return Reproduction(
        contacts={shape: contacts.collect(shape, answers([contacts.task(shape)])) for shape in parameters.SHAPES},
        collapse=campaign.collect(SMALL, answers(campaign.blocks(SMALL))),
        laws=tuple(law.collect(shape, tasks, answers(tasks)) for shape, tasks in lawful.items()),
        losses=(),
    )


@pytest.fixture(scope="module")
def browser():
    with playwright.sync_playwright() as driver:
        found = driver.chromium.launch(executable_path=CHROMIUM, args=ALONE)
        yield found
        found.close()


@pytest.fixture
def opened(browser):
    """A page opened offline, and what it complained of and asked the network for."""
    contexts = []

    def open_page(path, **asked):
        context = browser.new_context(**{"viewport": DESK, "offline": True} | asked)
        contexts.append(context)
        page, complaints = context.new_page(), []
        page.on("console", lambda said: complaints.append(f"{said.type}: {said.text}"))
        page.on("pageerror", lambda error: complaints.append(f"error: {error}"))
        context.on("request", lambda request: complaints.extend(fetched(request.url)))
        page.goto(path.as_uri())
        return page, complaints

    yield open_page
    for context in contexts:
        context.close()


def fetched(url):
    return [] if url.startswith(("file:", "data:")) else [f"fetched: {url}"]


def faults(page, path, complaints):
    """Everything that is wrong with a page as it stands."""
    page.evaluate(OPEN)
    files = [link for link in page.evaluate(FILES) if not link.startswith(("#", "data:"))]
    missing = [f"no such file: {link}" for link in files if not (path.parent / link).is_file()]
    return complaints + missing + page.evaluate(AUDIT, [CONTRAST, SAID])


@pytest.mark.parametrize("name", PAGES)
def test_a_page_opens_offline_without_a_fault_by_day_and_by_night(written, opened, name):
    page, complaints = opened(written[name])
    assert page.locator("img").count() > 0 or name == "stability"
    for scheme in ("light", "dark"):
        page.emulate_media(color_scheme=scheme)
        assert faults(page, written[name], complaints) == []


@pytest.mark.parametrize("name", PAGES)
def test_a_page_moved_alone_is_whole(written, opened, tmp_path, name):
    alone = tmp_path / "moved.html"
    alone.write_bytes(written[name].read_bytes())
    page, complaints = opened(alone)
    assert faults(page, alone, complaints) == []


@pytest.mark.parametrize("name", PAGES)
def test_a_phone_needs_no_sideways_scrolling(written, opened, name):
    page, _ = opened(written[name], viewport=PHONE)
    assert page.evaluate(WIDE) <= 0
    page.evaluate(OPEN)
    assert page.evaluate(WIDE) <= 0


@pytest.mark.parametrize("name", PAGES)
def test_a_page_prints_on_a4_with_all_figures_and_no_table_cut(written, opened, name):
    page, _ = opened(written[name], viewport=PAPER)
    page.emulate_media(media="print")
    assert page.evaluate(WIDE) <= 0
    page.set_viewport_size(LANDSCAPE)
    page.evaluate(OPEN)
    assert page.evaluate(WIDE) <= 0
    clipped = "[...document.querySelectorAll('.table')].filter(t => t.scrollWidth > t.clientWidth + 1).length"
    assert page.evaluate(clipped) == 0
    printed = page.pdf(prefer_css_page_size=True)
    (width, height), *_ = re.findall(rb"/MediaBox \[0 0 ([\d.]+) ([\d.]+)\]", printed)
    assert (float(width), float(height)) == pytest.approx((595.3, 841.9), abs=1)
    pictures = set(page.locator("img").evaluate_all("images => images.map(image => image.src)"))
    assert len(re.findall(rb"/Subtype\s*/Image", printed)) >= len(pictures)


def keys(page, table, column):
    """What stands in a column, as it is sorted by; None where nothing is known."""
    cells = page.locator(table).locator(f"tbody tr td:nth-child({column + 1})")
    read = "cells => cells.map(c => (c.dataset.value ?? c.textContent).trim())"
    return [None if text in ("", "nan") else float(text) for text in cells.evaluate_all(read)]


def ordered(values, descending=False):
    """As they should stand: by value, equal ones as they stood, what is not known last."""
    known = [value for value in values if value is not None]
    return sorted(known, reverse=descending) + [None] * (len(values) - len(known))


@pytest.mark.parametrize("way", ["click", "Enter", "Space"])
def test_a_table_is_sorted_by_value_from_its_head(written, opened, way):
    page, _ = opened(written["run"])
    page.evaluate(OPEN)
    table = "details:has([id='data-data-points']) table"
    names = page.locator(f"{table} th").evaluate_all(
        "heads => heads.map(h => h.querySelector('button').textContent)"
    )
    column = names.index("depth [m]")
    head = page.locator(f"{table} th").nth(column)
    button = head.locator("button")

    def press():
        if way == "click":
            button.click()
        else:
            button.focus()
            page.keyboard.press(way)
        return keys(page, table, column), keys(page, table, 0), head.get_attribute("aria-sort")

    asked, rows = keys(page, table, column), keys(page, table, 0)
    assert None in asked
    assert sorted(map(str, asked)) != [str(value) for value in ordered(asked)]  # as text it would be another order
    up, rows_up, said_up = press()
    down, _, said_down = press()
    back, rows_back, said_back = press()
    assert (up, said_up) == (ordered(asked), "ascending")
    assert (down, said_down) == (ordered(asked, descending=True), "descending")
    assert (back, rows_back, said_back) == (asked, rows, None)
    place = dict(zip(rows, asked, strict=True))
    assert all(a < b for a, b in pairwise(rows_up) if place[a] == place[b])


def test_words_are_sorted_as_words_and_cells_that_span_stay_in_their_column(written, opened):
    page, _ = opened(written["study"])
    table = "#summary ~ .table table >> nth=0"
    first = page.locator(table).locator("tbody tr td:first-child")
    before = first.all_text_contents()
    page.locator(table).locator("th button").first.click()
    assert first.all_text_contents() == sorted(before, key=str.lower)
    page.locator(table).locator("th button").last.click()
    assert sorted(first.all_text_contents()) == sorted(before)


def test_a_number_leads_to_its_definition_and_to_the_points_behind_it(written, opened):
    page, _ = opened(written["run"])
    value = page.locator("#summary ~ .table td.value a").first
    row = page.locator(f"[id='{value.get_attribute('href')[1:]}']")
    value.click()
    assert value.text_content() in row.text_content()
    row.locator("a.def").click()
    assert page.locator("dt:target").text_content().startswith("1D / 3D friction of the smooth body, slow")
    row.locator("td:last-child a").first.click()
    assert page.locator("tr:target").is_visible()


@pytest.mark.parametrize("name", PAGES)
def test_without_script_tables_are_plain_and_a_link_unfolds_what_it_leads_to(written, opened, name):
    page, _ = opened(written[name], java_script_enabled=False)
    assert page.locator("th button").count() == 0
    assert page.locator("th .label").count() > 0
    assert page.locator("tbody tr").count() > 1
    sheet = page.locator("details p[id]").first
    assert not sheet.is_visible()
    page.goto(f"{written[name].as_uri()}#{sheet.get_attribute('id')}")
    assert sheet.is_visible()


def test_what_is_saved_is_the_file_beside_the_page(written, opened):
    page, _ = opened(written["study"], accept_downloads=True)
    page.evaluate(OPEN)
    for link in (page.locator("a[download]").first, page.locator("a[download]").last):
        with page.expect_download() as saved:
            link.click()
        file = link.locator("xpath=..").locator("code").text_content()
        with open(saved.value.path(), "rb") as content:
            assert content.read() == (written["study"].parent / file).read_bytes()
        assert saved.value.suggested_filename == file.rsplit("/", 1)[-1]


@pytest.mark.parametrize(
    ("broken", "complaint"),
    [
        ("<img src='data:image/png;base64,AAAA' alt='A picture that is not one at all.'>", "image not loaded"),
        ("<img src='gone.png' alt='A picture that lies nowhere at all.'>", "no such file"),
        ("<figure><img src='data:image/gif;base64,R0lGODlhAQABAAAAACw=' alt='curve'></figure>", "image not said"),
        ("<p id='twice'></p><p id='twice'></p>", "id twice: twice"),
        ("<a href='#nowhere'>dead</a>", "dead link"),
        ("<a href='beside.csv'>beside</a>", "no such file: beside.csv"),
        ("<a href='#summary'></a>", "link not said"),
        ("<table><tr><th>head</th></tr></table>", "head without scope"),
        ("<table><tr><td>1</td></tr><tr><td>1</td><td>2</td></tr></table>", "row of another width"),
        ("<h2>one</h2><h4>three</h4>", "heading skipped"),
        ("<p style='color: #999; background: #fff'>pale</p>", "contrast 2.8"),
        ("<script>throw new Error('broken')</script>", "error: broken"),
        ("<script>console.error('said')</script>", "error: said"),
        (
            "<img src='https://example.org/a.png' alt='A picture from somewhere else.'>",
            "fetched: https://example.org",
        ),
    ],
)
def test_every_check_finds_what_it_looks_for(written, opened, tmp_path, broken, complaint):
    path = tmp_path / "broken.html"
    text = written["stability"].read_text(encoding="utf-8")
    path.write_text(text.replace("</main>", f"{broken}</main>"), encoding="utf-8")
    page, complaints = opened(path)
    assert any(complaint in fault for fault in faults(page, path, complaints))


def test_what_is_too_wide_is_seen_on_a_phone_and_on_paper(written, opened, tmp_path):
    path = tmp_path / "wide.html"
    text = written["stability"].read_text(encoding="utf-8")
    path.write_text(text.replace("</main>", "<div style='width: 800px'>wide</div></main>"), encoding="utf-8")
    for viewport in (PHONE, PAPER):
        assert opened(path, viewport=viewport)[0].evaluate(WIDE) > 0
