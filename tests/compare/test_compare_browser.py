"""A page in a browser: nothing is fetched, nothing is broken, a phone and A4 hold it."""

import re
import shutil
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import pytest
from page_samples import FINDINGS, HOSTILE, hostile_page, page

from compare.report import render

playwright = pytest.importorskip("playwright.sync_api", reason="playwright drives the browser: extra browser")
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no chromium on the path")
ALONE = (
    *("--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"),
    *("--disable-background-networking", "--disable-component-update", "--disable-sync"),
)
PHONE, DESK = {"width": 360, "height": 740}, {"width": 1280, "height": 900}
# Between the margins of A4, at 96 dots per inch.
PAPER = {"width": int((210 - 2 * 12) / 25.4 * 96), "height": 1000}
# Least contrast of text against what lies behind it, WCAG 2, level AA.
CONTRAST = 4.5
# Letters of a text that describes a picture: fewer say nothing of what it shows.
LETTERS = 20

AUDIT = """
([contrast, letters]) => {
  const faults = [], all = selector => [...document.querySelectorAll(selector)];
  const fault = (what, element) => faults.push(`${what}: ${element.outerHTML?.slice(0, 90) ?? element}`);
  for (const image of all("img")) {
    if (!image.complete || image.naturalWidth === 0) fault("image not loaded", image);
    if ((image.alt ?? "").length < letters) fault("image unnamed", image);
  }
  for (const link of all("a")) {
    if (!(link.textContent.trim() || link.getAttribute("aria-label"))) fault("link unnamed", link);
  }
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


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """The page, as it is written."""
    return render.write(render.files(page(), FINDINGS), tmp_path_factory.mktemp("page"))[-1]


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
        page.on("console", lambda message: complaints.append(f"{message.type}: {message.text}"))
        page.on("pageerror", lambda error: complaints.append(f"error: {error}"))
        context.on("request", lambda request: complaints.extend(fetched(request.url)))
        page.goto(path.as_uri())
        return page, complaints

    yield open_page
    for context in contexts:
        context.close()


def fetched(url):
    return [] if url.startswith(("file:", "data:")) else [f"fetched: {url}"]


def faults(page, complaints):
    """Everything that is wrong with a page as it stands; anchors and files are in test_compare_pages.py."""
    return complaints + page.evaluate(AUDIT, [CONTRAST, LETTERS])


def test_a_page_opens_offline_without_a_fault_by_day_and_by_night(written, opened):
    shown, complaints = opened(written)
    assert shown.locator("img").count() == 1
    for scheme in ("light", "dark"):
        shown.emulate_media(color_scheme=scheme)
        assert faults(shown, complaints) == []


def test_a_phone_needs_no_sideways_scrolling(written, opened):
    shown, _ = opened(written, viewport=PHONE)
    assert shown.evaluate(WIDE) <= 0


def test_a_page_prints_on_a4_with_all_figures_and_no_table_cut(written, opened):
    shown, _ = opened(written, viewport=PAPER)
    shown.emulate_media(media="print")
    assert shown.evaluate(WIDE) <= 0
    clipped = "[...document.querySelectorAll('.table')].filter(t => t.scrollWidth > t.clientWidth + 1).length"
    assert shown.evaluate(clipped) == 0
    printed = shown.pdf(prefer_css_page_size=True)
    (width, height), *_ = re.findall(rb"/MediaBox \[0 0 ([\d.]+) ([\d.]+)\]", printed)
    assert (float(width), float(height)) == pytest.approx((595.3, 841.9), abs=1)
    assert len(re.findall(rb"/Subtype\s*/Image", printed)) >= 1


def changed(written, folder, part, policy=""):
    """The page with another part, and another policy or none."""
    text = written.read_text(encoding="utf-8").replace("</main>", f"{part}</main>")
    path = folder / "changed.html"
    path.write_text(re.sub("<meta http-equiv.*>", policy, text, count=1), encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("broken", "complaint"),
    [
        ("<img src='data:image/png;base64,AAAA' alt='A picture that is not one at all.'>", "image not loaded"),
        ("<figure><img src='data:image/gif;base64,R0lGODlhAQABAAAAACw=' alt='curve'></figure>", "image unnamed"),
        ("<a href='#made'></a>", "link unnamed"),
        ("<table><tr><td>1</td></tr><tr><td>1</td><td>2</td></tr></table>", "row of another width"),
        ("<h2>one</h2><h4>three</h4>", "heading skipped"),
        ("<p style='color: #999; background: #fff'>pale</p>", "contrast 2.8"),
        ("<script>throw new Error('broken')</script>", "error: broken"),
        ("<script>console.error('wrong')</script>", "error: wrong"),
        (
            "<img src='https://example.org/a.png' alt='A picture from somewhere else.'>",
            "fetched: https://example.org",
        ),
    ],
)
def test_every_check_finds_what_it_looks_for(written, opened, tmp_path, broken, complaint):
    shown, complaints = opened(changed(written, tmp_path, broken))
    assert any(complaint in fault for fault in faults(shown, complaints))


def test_what_is_too_wide_is_seen_on_a_phone_and_on_paper(written, opened, tmp_path):
    path = changed(written, tmp_path, "<div style='width: 800px'>wide</div>")
    for viewport in (PHONE, PAPER):
        assert opened(path, viewport=viewport)[0].evaluate(WIDE) > 0


@pytest.fixture
def stranger():
    """Address of a machine that a page must not ask for anything, and what it was asked for."""
    asked = []

    class Asked(BaseHTTPRequestHandler):
        def do_GET(self):
            asked.append(self.path)
            self.send_error(404)

        def log_message(self, *_):
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), Asked)
    threading.Thread(target=server.serve_forever, args=(0.05,), daemon=True).start()
    yield f"127.0.0.1:{server.server_port}", asked
    server.shutdown()
    server.server_close()


STRANGE = "script, iframe, object, embed, link, base, form, input, svg, meta[http-equiv=refresh], b, [autofocus]"
OBEYED = f"""() => [typeof owned, document.querySelectorAll("{STRANGE}").length, document.images.length,
  [...document.querySelectorAll("*")].filter(e => e.getAttributeNames().some(n => n.startsWith("on"))).length]"""
LINKS = "[...document.links].filter(a => !a.hash || a.host).map(a => [a.protocol, a.rel])"


@pytest.mark.parametrize("policy", [True, False])
def test_the_texts_of_a_stranger_run_nothing_and_load_nothing_even_without_the_policy(
    tmp_path, opened, stranger, policy
):
    address, asked = stranger
    path = render.write(render.files(hostile_page(), []), tmp_path)[-1]
    text = path.read_text(encoding="utf-8").replace("127.0.0.1:PORT", address)
    path.write_text(text, encoding="utf-8")
    shown, complaints = opened(path if policy else changed(path, tmp_path, ""), offline=False)
    assert shown.evaluate(OBEYED) == ["undefined", 0, 1, 0]
    assert shown.evaluate(LINKS) == []
    assert HOSTILE[0] in shown.locator("main").inner_text()
    assert not asked
    assert complaints == []
