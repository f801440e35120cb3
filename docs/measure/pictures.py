"""Pictures of pages that have tables or commands alone: accuracy, benchmark, and one contact.

python docs/measure/pictures.py

Those of accuracy and benchmark show the tables that these pages hold; that of a contact is `crosscheck draw`.
"""

import re
import shutil
from io import StringIO
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pandas
from matplotlib.figure import Figure
from pandas import DataFrame

import compare
from compare.figures import style
from scene import Kelvin, Scene, Slide, Sphere

RESULTS = Path(__file__).parents[1] / "results"
SLIDING = Scene(Sphere(10e-3), Kelvin(1e6, 1e-3), Slide(speed=1.0, load=1.0))
CODES = {
    "this": ("this solver", "BEM"),
    "tamaas": ("tamaas", None),
    "ContactMechanics": ("ContactMechanics", None),
}


def section(page: str, title: str) -> DataFrame:
    """The first table under a heading of a page, as text."""
    text = (RESULTS / f"{page}.md").read_text(encoding="utf-8")
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
    rest.set(xlabel="points across the contact [1]", ylabel="relative error of the force [1]", title="at rest")
    table = section("accuracy", "Indentation in time")
    for body, rows in table.groupby("shape", sort=False):
        filled = {} if body == "sphere" else {"markerfacecolor": style.paper()}
        worst = rows.iloc[:, 3:].map(lambda text: abs(float(text.rstrip("%"))) / 100).max(axis=1)
        timed.loglog(rows["points"].astype(int), worst, **style.look("BEM", label=f"{body}, BEM", **filled))
    timed.set(xlabel="points a side of the window [1]", ylabel="worst error of the force [1]", title="in time")
    _order_two(timed, 20.0, [64, 128, 256])
    for panel in (rest, timed):
        panel.legend()
    style.lettered((rest, timed))
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
        drawn = {"color": style.colour(solver) if solver else style.ink(), "label": label, **form}
        for panel, table, along in ((grids, cells, "points"), (loads, others, "mean pressure / E*")):
            rows = table[(table["code"] == name) & (table["processor s"] != "")]
            panel.loglog(rows[along].str.rstrip("²").astype(float), rows["processor s"].astype(float), **drawn)
    grids.set(xlabel="points a side [1]", ylabel="processor time [s]", title="rough cells")
    grids.set_xticks([256, 512, 1024, 2048], ["256", "512", "1024", "2048"], minor=False)
    grids.minorticks_off()
    loads.set(xlabel="mean pressure / $E^*$ [1]", ylabel="processor time [s]", title="512² points")
    style.lettered((grids, loads))
    grids.legend()
    return figure


def contact() -> None:
    """The picture of a contact in howto/figures.md, as `crosscheck draw` has it."""
    with TemporaryDirectory() as folder:
        compare.draw(SLIDING, output=folder, workers=1)
        shutil.copy(Path(folder) / "contact.png", RESULTS / "draw.png")


def main() -> None:
    """Draw all of them."""
    for figure in (accuracy, benchmark):
        with style.applied():
            figure().savefig(RESULTS / f"{figure.__name__}.png", dpi=200)
    contact()


if __name__ == "__main__":
    main()
