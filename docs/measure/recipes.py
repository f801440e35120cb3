"""Which recipe of the method of dimensionality reduction is least wrong: friction of 1D by four of them, over 3D.

python docs/measure/recipes.py [WORKERS]   solves what is not solved yet, and writes results/trust/recipes.csv

A body is mapped or as given; a rough line has C_1D = pi q C_2D or is a line scan. Each is held against the truth
of the trust map in three dimensions, alone and multiplied by what a model makes of scenes to learn from.
"""

import sys
from collections.abc import Iterator, Mapping
from itertools import product
from math import log
from pathlib import Path

import design
import numpy as np
from campaign import friction, solved
from pandas import DataFrame
from scoring import STATED
from tables import by_column, replaced, stored

from compare.models.law.parts import LawParts
from compare.solving.outcome import Outcome
from compare.solving.task import SceneTask, draws_of
from compare.trustmap import table
from compare.trustmap.model import NAMES, Measurements, Model
from compare.trustmap.ratio import LAW
from mdr1d import MDR

PAGE = Path(__file__).parents[1] / "results" / "trust.md"
CSV = PAGE.with_suffix("") / "recipes.csv"
RECIPES = {
    f"{'mapped' if shape == 'mapped' else 'as given'}, {'π q C₂D' if spectrum == 'mapped' else 'line scan'}": MDR(
        points=4000, shape=shape, spectrum=spectrum
    )
    for shape, spectrum in product(("mapped", "as-given"), ("mapped", "line-scan"))
}
# Scenes of each set that slide, and profiles of each.
SETS = {"learned": (table.LEARNED, 600, 40), "held-out": (table.HELD_OUT, 400, 80)}


def chosen(name: str) -> np.ndarray:
    """Rows of a set, evenly over its table, that have a ratio of friction."""
    path, count, _ = SETS[name]
    rows = np.flatnonzero(np.isfinite(table.read(path)[table.column(LAW, "logarithm")]))
    return rows[np.linspace(0, rows.size - 1, min(count, rows.size)).astype(int)]


def tasks(name: str) -> Iterator[tuple[int, str, SceneTask]]:
    """Row, recipe and task of each solve of a set."""
    path, _, profiles = SETS[name]
    points = table.read(path)["point"]
    for row, (recipe, solver) in product(chosen(name), RECIPES.items()):
        yield int(row), recipe, SceneTask(solver, draws_of(design.scene(int(points[row])), profiles), work=1e-2)


def logarithms(name: str, outcomes: Mapping[SceneTask, Outcome]) -> DataFrame:
    """ln of friction by each recipe over 3D, and its standard error, a row for each scene and recipe."""
    found = table.read(SETS[name][0])
    points, over_law = found["point"], found[table.column(LAW, "logarithm")]
    rows = []
    for row, recipe, task in tasks(name):
        # Friction in 3D, as the table has it beside the law.
        space = LawParts.of(task.scenes[0]).friction_coefficient / np.exp(over_law[row])
        line = friction(outcomes[task].rows)
        value, error = float(line.value), float(line.error)
        rows.append(
            {
                "set": name,
                "point": int(points[row]),
                "recipe": recipe,
                "logarithm": float(f"{log(value / space):.5g}") if value > 0 else np.nan,
                "error": float(f"{error / value:.3g}"),
            }
        )
    return DataFrame(rows)


def errors(found: DataFrame) -> Iterator[dict[str, str]]:
    """A row for each region: error of each recipe alone and multiplied, median over the scenes held out."""
    off = {recipe: _errors(found[found["recipe"] == recipe]) for recipe in RECIPES}
    held = found[(found["set"] == "held-out") & (found["recipe"] == next(iter(RECIPES)))]
    columns = _rows("held-out", held["point"])
    columns["slides"] = np.ones(len(held), bool)
    for kind, regions in {"all": {"all": lambda groups: groups["slides"]}, **STATED}.items():
        for region, condition in regions.items():
            if (here := condition(columns)).sum() < 5:
                continue
            yield {
                "": f"{region if kind == 'all' else f'{kind}: {region}'} ({here.sum()})",
                **{
                    recipe: " → ".join(f"{100 * np.nanmedian(np.abs(each[here])):.2g}" for each in both)
                    for recipe, both in off.items()
                },
            }


def _errors(found):
    """Relative errors of a recipe on the scenes held out, alone and multiplied (N,)."""
    sets = {name: found[found["set"] == name] for name in SETS}
    learned, held = (_measured(name, each) for name, each in sets.items())
    model = Model.fit("friction", learned)
    alone = held.logarithm
    return np.expm1(alone), np.expm1(alone - model.predicted(held.groups).logarithm)


def _measured(name, found):
    """What was measured of a recipe on the scenes of a set."""
    told = _rows(name, found["point"])
    numbers = (told[table.column("friction", each)] for each in ("scatter", "surfaces", "grid"))
    groups = np.stack([told[each] for each in NAMES], axis=1)
    return Measurements(groups, found["logarithm"].values, found["error"].values, *numbers)


def _rows(name, points):
    found = table.read(SETS[name][0])
    where = {int(point): row for row, point in enumerate(found["point"])}
    rows = np.array([where[int(point)] for point in points])
    return {each: values[rows] for each, values in found.items()}


def main(workers: int | None = None) -> None:
    """Solve what is not solved yet, and write what was found."""
    every = {name: [task for _, _, task in tasks(name)] for name in SETS}
    outcomes = solved(CSV.with_suffix(".md"), [task for each in every.values() for task in each], workers)
    found = DataFrame([row for name in SETS for row in logarithms(name, outcomes).to_dict("records")])
    stored(CSV, found)
    replaced(PAGE, "recipes", by_column(errors(found)))


if __name__ == "__main__":
    main(*(int(each) for each in sys.argv[1:]))
