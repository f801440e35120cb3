"""A page with a block of every kind, made of numbers alone, for tests of its renderers."""

from math import nan

import numpy as np
from pandas import DataFrame

from compare.report import render
from compare.report.page import Findings, Page, Section, Table, Text
from compare.statistics.finding import HALVED, Claim, Finding, sentences
from compare.studies.sweep import figure as sweep

DEPTH = Claim("rest.depth", "Depths at rest agree", 1.0, 0.05, "Ratio of depths at one load.", dimension="1D/3D")
SLOW = Claim("slow", "Friction & <speed> fall as n_1 = 40 %", 0.4, 0.01, dimension="1D")
COST = Claim("cost", "Seconds of a solve", unit="s", dimension="3D")
FINDINGS = (
    Finding(
        DEPTH, 1.01, (0.99, 1.03), 0.004, HALVED, "rough sphere", 8, "h0 = 0.1 d to d", plot="sphere/friction"
    ),
    Finding(DEPTH, 1.21, (1.19, 1.23), 0.004, HALVED, "plane", 8),
    Finding(SLOW, 0.41, (0.38, 0.43), nan, where="rough sphere", draws=8),
    Finding(COST, 12.3, (11.0, 13.7), 0.1, HALVED),
)
MEANS = DataFrame(
    [
        {"solver": solver, "speed": speed, "load": 1.0}
        | {"friction_coefficient_mean": mu}
        | {"friction_coefficient_low": 0.9 * mu, "friction_coefficient_high": 1.2 * mu}
        for solver, slope in (("MDR", 0.2), ("BEM", 0.1))
        for speed in np.geomspace(1e-3, 1.0, 4)
        for mu in (slope * speed**0.4,)
    ]
)  # fmt: skip
ROWS = DataFrame(
    {"body": ["b", "a", "c"], "order": [10.5, 9.0, nan], "memory": [1, 200, 30], "reason": ["", "x", "|y|"]}
)
LONG = DataFrame({"x": np.linspace(0, 1, 1000), "pressure": np.linspace(0, 1e6, 1000) / 3})
PROSE = "Some *emphasis*, `code_x`, a [link](https://example.org) & <b>50 %</b>.\n\n- one\n- two"


def written(page, findings, folder, format="html"):
    """The file of a page, with its figures and tables beside it."""
    return render.write(render.files(page, findings, format), folder)[-1]


def page() -> Page:
    plot = sweep.plot(MEANS)
    plot = type(plot)("sphere/friction", plot.draw, plot.tables, plot.caption, plot.alternative)
    blocks = [Text(PROSE), Table("sphere/rows", ROWS, "Rows."), Table("sphere/long", LONG, "All.", long=True)]
    return Page(
        "1D & 3D: *demo* of µ_x", sentences(FINDINGS), [plot, Findings(FINDINGS), Section("A sphere", blocks)]
    )
