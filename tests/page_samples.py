"""A page with a block of every kind, made of numbers alone, for tests of its renderers, and one of a stranger."""

from dataclasses import replace
from math import nan

import numpy as np
from pandas import DataFrame

from compare.figures import friction
from compare.report import render
from compare.report.page import Findings, Page, Section, Table, Text
from compare.solving.words import sentences
from compare.statistics.finding import Claim, Finding

DEPTH = Claim("rest.depth", "Depths at rest agree", 1.0, 0.05, "Ratio of depths at one load.", dimension="1D/3D")
SLOW = Claim("slow", "Friction & <speed> fall as n_1 = 40 %", 0.4, 0.01, dimension="1D")
COST = Claim("cost", "Seconds of a solve", unit="s", dimension="3D")
FINDINGS = (
    Finding(DEPTH, 1.01, (0.99, 1.03), 0.004, "rough sphere", 8, "h0 = 0.1 d to d"),
    Finding(DEPTH, 1.21, (1.19, 1.23), 0.004, "plane", 8),
    Finding(SLOW, 0.41, (0.38, 0.43), nan, where="rough sphere", draws=8),
    Finding(COST, 12.3, (11.0, 13.7), 0.1),
)
MEANS = DataFrame(
    [
        {"model": model, "speed": speed, "load": 1.0}
        | {"friction_coefficient_mean": mu}
        | {"friction_coefficient_low": 0.9 * mu, "friction_coefficient_high": 1.2 * mu}
        for model, slope in (("MDR", 0.2), ("BEM", 0.1))
        for speed in np.geomspace(1e-3, 1.0, 4)
        for mu in (slope * speed**0.4,)
    ]
)  # fmt: skip
ROWS = DataFrame(
    {"body": ["b", "a", "c"], "order": [10.5, 9.0, nan], "memory": [1, 200, 30], "reason": ["", "x", "|y|"]}
)
LONG = DataFrame({"x": np.linspace(0, 1, 1000), "pressure": np.linspace(0, 1e6, 1000) / 3})
PROSE = "Some *words* of code_x & <b>50 %</b>\nover two lines.\n\n- one\n- two, on\n  and on"


def written(page, findings, folder):
    """Write a page with its figures and tables, and return the file of the page."""
    return render.write(render.files(page, findings), folder)[-1]


def page() -> Page:
    plot = friction.plot(MEANS)
    plot = type(plot)("sphere/friction", plot.draw, plot.tables, plot.caption, plot.alternative)
    blocks = [Text(PROSE), Table("sphere/rows", ROWS, "Rows."), Table("sphere/long", LONG, "All.", long=True)]
    # out of the order of reading, which a page has by itself
    given = [Section("A sphere", blocks[::-1]), Findings(FINDINGS), plot]
    return Page("1D & 3D: *demo* of µ_x", sentences(FINDINGS), given)


# Where the texts of a stranger would have a browser, Markdown, Sphinx, LaTeX or a terminal go.
PLACE = "http://127.0.0.1:PORT"
HOSTILE = (
    "<script>owned = 1</script>",
    "<img src=x onerror='owned = 1'><svg onload='owned = 1'><details open ontoggle='owned = 1'>",
    f"<style>@import '{PLACE}/a';</style><link rel=stylesheet href={PLACE}/b><base href={PLACE}>",
    f"<iframe src={PLACE}/c></iframe><object data={PLACE}/d><meta http-equiv=refresh content='0;{PLACE}'>",
    "\"'><b onmouseover='owned = 1' autofocus onfocus='owned = 1' tabindex=1>",
    "</code></p></td></table></main></title></style><script>owned = 1</script>",
    "&lt;script&gt;owned = 1&lt;/script&gt; &#60;img src=x onerror=owned=1&#62; &#x202e;",
    "<!-- ]]> --!> <![CDATA[ <math><mtext><img src=x onerror=owned=1></mtext></math>",
    "[a](javascript:owned=1) [b](JaVaScRiPt&colon;owned=1) [c](data:text/html,x) [d](file:///etc/passwd)",
    "[e](../../etc/passwd) [f](%2e%2e/x) [g](//host/x) [h](/etc/passwd) [i](myst:x) <javascript:owned=1>",
    f"![j]({PLACE}/e.png) \\![k]({PLACE}/f.png) ![l][l] [m]\n\n[l]: {PLACE}/g.png\n[m]: {PLACE}",
    "{{ 7 * 7 }} {% include x %} {include}`/etc/passwd` {.a onclick=owned=1}",
    "```{eval-rst}\n.. include:: /etc/passwd\n```",
    ":::{include} /etc/passwd\n:::",
    "~~~{raw} html\n<script>owned = 1</script>\n~~~",
    "setext\n===\n# head\n---\nmyst: x\n---",
    "| a | b |\n|---|---|\n| x | y |",
    "n[^1] ~~s~~ term\n: text\n\n[^1]: note",
    "(target)=\n% comment\n+++\n1. one\n\n    code",
    r"$\href{javascript:owned=1}{x}$ $\input{/etc/passwd}$ $^^5cinput{/etc/passwd}$ $a%$ $$\write18{x}$$",
    r"\input{/etc/passwd} ^^5cinput{x} \catcode`\%=0 \begin{align}x\end{align} \(x\)",
    "\x1b[2J\x1b]0;t\x07\x9b \u202egpj.exe\u2066 \u200b\u200f\u061c",
)


def hostile_page() -> Page:
    """A page with the texts of a stranger in every place."""
    text = " ".join(HOSTILE)
    claim = Claim("x", f"{text} xi", 1.0, 0.1, text, dimension="1D")
    found = Finding(claim, 1.0, (0.9, 1.1), nan, where=f"{text} a", draws=3, regime=text, reason=text)
    plot = friction.plot(MEANS)
    plot = replace(plot, name="friction", caption=text, alternative=text)
    frame = DataFrame({"reason": HOSTILE, text: range(len(HOSTILE)), "body": [each[:9] for each in HOSTILE]})
    blocks = [*(Text(each) for each in HOSTILE), Text("\n".join(f"- {each}" for each in HOSTILE)), plot]
    blocks += [Findings([found], text), Findings([found, replace(found, where=text)]), Table("rows", frame, text)]
    sections = [Section(each, [Text(each)]) for each in HOSTILE]
    return Page(text, HOSTILE, [*blocks, *sections], HOSTILE, HOSTILE, [Table("opening", frame, text)])
