"""Pictures of pages that have tables or formulas alone: theory, accuracy and benchmark.

python docs/measure/pictures.py

Those of accuracy and benchmark show the tables that these pages hold; that of the theory shows two solves, of a
second.
"""

import re
from io import StringIO
from pathlib import Path

import numpy as np
import pandas
from matplotlib.figure import Figure
from pandas import DataFrame

from bem3d import BEM
from compare.report.plots import style
from compare.report.views import View, view
from mdr1d import MDR
from scene import Kelvin, Scene, Slide, Sphere

DOCS = Path(__file__).parents[1]
SLIDING = Scene(Sphere(10e-3), Kelvin(1e6, 1e-3), Slide(speed=1.0, load=1.0))
SHOWN, SPRINGS = (-1.95e-3, 3.0e-3), 41  # of the section of the theory [m], and how many springs stand in it
CODES = {
    "this": ("this solver", "BEM"),
    "tamaas": ("tamaas", None),
    "ContactMechanics": ("ContactMechanics", None),
}


def section(page: str, title: str) -> DataFrame:
    """The first table under a heading of a page, as text."""
    text = (DOCS / "results" / f"{page}.md").read_text(encoding="utf-8")
    body = re.search(rf"^## {re.escape(title)}$(.*?)(?=^## |\Z)", text, re.DOTALL | re.MULTILINE)[1]
    head, _, *rows = re.findall(r"^\| (.*) \|$", body, re.MULTILINE)
    found = pandas.read_csv(StringIO("\n".join([head, *rows])), sep="|", dtype=str, keep_default_na=False)
    return found.rename(columns=str.strip).map(str.strip)


def accuracy() -> Figure:
    """Error of the force at rest and in time, over the points."""
    figure = style.canvas("double", 2.5)
    rest, timed = figure.subplots(1, 2)
    for _, row in section("accuracy", "At rest: Hertz and Sneddon").iterrows():
        body, name = row["shape"].split()[0], row["solver"]
        points = [int(each.split()[0]) for each in row.index if each.endswith(" points")]
        errors = row.filter(regex=" points$").astype(float)
        if errors.min() > 1e-13:
            filled = {} if body == "sphere" else {"markerfacecolor": style.paper()}
            rest.loglog(points, errors, **style.look(name, label=f"{body}, {name}", **filled))
    _order_two(rest, 0.3, points)
    rest.set(xlabel="points across the contact", ylabel="relative error of the force")
    style.head(rest, "a  At rest, against closed forms", 2)
    table = section("accuracy", "Indentation in time")
    for body, rows in table.groupby("shape", sort=False):
        filled = {} if body == "sphere" else {"markerfacecolor": style.paper()}
        worst = rows.iloc[:, 3:].map(lambda text: abs(float(text.rstrip("%"))) / 100).max(axis=1)
        timed.loglog(rows["points"].astype(int), worst, **style.look("BEM", label=f"{body}, BEM", **filled))
    timed.set(xlabel="points a side of the window", ylabel="worst relative error of the force")
    style.head(timed, "b  In time, against closed forms", 2)
    _order_two(timed, 20.0, [64, 128, 256])
    for panel in (rest, timed):
        panel.legend()
    return figure


def _order_two(panel, factor: float, points: list[int]):
    """A line of the second order, and these points as the numbers of the axis."""
    panel.loglog(points, factor * np.array(points, float) ** -2, label="second order", **style.line(0.4, 0.8))
    panel.set_xticks(points, map(str, points))
    panel.minorticks_off()


def benchmark() -> Figure:
    """Processor time of this solver and of its peers over the points, and over the load."""
    figure = style.canvas("double", 2.5)
    grids, loads = figure.subplots(1, 2)
    cells, others = section("benchmark", "Rough cells"), section("benchmark", "Other loads")
    for (name, (label, solver)), form in zip(CODES.items(), style.forms(), strict=False):
        drawn = {"color": style.current().palette[solver] if solver else style.ink(), "label": label, **form}
        for panel, table, along in ((grids, cells, "points"), (loads, others, "mean pressure / E*")):
            rows = table[(table["code"] == name) & (table["processor s"] != "")]
            panel.loglog(rows[along].str.rstrip("²").astype(float), rows["processor s"].astype(float), **drawn)
    grids.set(xlabel="points a side", ylabel="processor time [s]")
    grids.set_xticks([256, 512, 1024, 2048], ["256", "512", "1024", "2048"], minor=False)
    grids.minorticks_off()
    style.head(grids, "a  Rough cells, finer and finer", 2)
    loads.set(xlabel="mean pressure over $E^*$", ylabel="processor time [s]")
    style.head(loads, "b  512² points, at other loads", 2)
    grids.legend()
    return figure


def theory() -> Figure:
    """A sphere that slides, in both models: the surface with its wake, and the row of springs."""
    solvers = MDR(points=2000), BEM(points=128)
    seen = view(SLIDING, solvers[1], {each.name: each.solve(SLIDING).fields for each in solvers})
    figure = style.canvas("double", 2.4)
    space, line = figure.subplots(1, 2, sharex=True, sharey=True)
    _surface(space, seen, "BEM")
    style.head(space, "a  Three dimensions: one surface", 2)
    _surface(line, seen, "MDR")
    _springs(line, seen)
    style.head(line, "b  One dimension: a row of springs", 2)
    for panel in (space, line):
        panel.set(xlabel="$x$ [mm]; the elastomer flows to the right")
    space.set_ylabel("height [µm]")
    return figure


def _surface(panel, seen: View, name: str):
    """Section of indenter and elastomer; the pressure, or force per length, drawn below where they touch."""
    shown = seen.space.section if name == "BEM" else seen.line
    x, surface, indenter = 1e3 * shown.x, 1e6 * shown.surface, 1e6 * shown.indenter
    low, high = -1.9e6 * seen.radius**2 / 10e-3, 1.1e6 * seen.radius**2 / 10e-3
    if name == "BEM":
        panel.fill_between(x, surface, low, color=style.grey(0.9), lw=0)
        panel.text(
            1e3 * seen.span[0] / 2, 0.8 * low, "half-space: every point feels every other", fontsize=style.small()
        )
    panel.fill_between(x, indenter, high, where=indenter < high, color=style.grey(0.7), lw=0)
    panel.plot(x, surface, color=style.current().palette[name], lw=style.width(1.3))
    panel.text(0, high * 0.55, "rigid indenter", ha="center", fontsize=style.small())
    panel.text(2.3, 0.1 * high, "wake", ha="center", fontsize=style.small())
    panel.set(ylim=(low, high), xlim=tuple(1e3 * np.clip(seen.span, *SHOWN)))


def _springs(panel, seen: View):
    """A spring under every place of a row, from the base to the surface."""
    base = 0.82 * panel.get_ylim()[0]
    places = np.linspace(*np.clip(seen.span, *SHOWN), SPRINGS)[1:-1]
    top = np.interp(places, seen.line.x, 1e6 * seen.line.surface)
    touching = np.interp(places, seen.line.x, seen.line.touching.astype(float)) > 0.5
    step = 0.32e3 * (places[1] - places[0])
    for place, height, touches in zip(1e3 * places, top, touching, strict=True):
        along = np.linspace(base, height, 22)
        across = place + step * np.r_[0, 0, np.resize([1, -1], 18), 0, 0]
        colour = style.current().palette["MDR"] if touches else style.grey(0.45)
        panel.plot(across, along, color=colour, lw=style.width(0.6))
    panel.axhline(base, color=style.ink(), lw=style.width(1.0))


PLACES = {theory: "explanation", accuracy: "results", benchmark: "results"}


def main() -> None:
    """Draw all of them."""
    for figure in PLACES:
        with style.applied():
            figure().savefig(DOCS / PLACES[figure] / f"{figure.__name__}.png", dpi=200)


if __name__ == "__main__":
    main()
