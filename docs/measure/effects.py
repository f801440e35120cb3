"""What each effect does, and what it costs: tables of results/effects.md, figures and numbers in results/effects.

What has been solved once is in docs/results/effects/solved. Costs want a quiet machine.

python docs/measure/effects.py

What plans multiply costs with, bem3d/effects.csv and mdr1d/effects.csv, is written from the same measurements.
"""

from collections.abc import Iterator
from pathlib import Path

from campaign import solved
from effects_page import costs
from effects_page.asked import Effect, effects
from effects_page.catalogue import STUDIES
from effects_page.chapter import Chapter
from tables import by_column, replaced, stored, table

import bem3d.plan
import mdr1d.plan
from compare.report.manifest import machine, versions
from compare.report.plots import style
from compare.report.plots.rendering import rendered
from scene.costs import two_digits

FOLDER = Path(__file__).parents[1] / "results" / "effects"
PAGE = FOLDER.with_suffix(".md")
TABLES = {"3D": bem3d.plan.EFFECTS, "1D": mdr1d.plan.EFFECTS}


def main() -> None:
    """Solve what is not solved yet, and write the page."""
    FOLDER.mkdir(exist_ok=True)
    outcomes = solved(PAGE, [task for study in STUDIES for task in study.tasks()])
    timed = solved(PAGE, costs.tasks(), fresh=True)
    billed = costs.costs(timed)
    for name, rows in costs.tables(billed).items():
        stored(TABLES[name], rows)
    with style.applied():
        for chapter in (*(study.chapter(outcomes) for study in STUDIES), costs.chapter(timed)):
            _put(chapter)
    told = ", ".join(f"{name} {number}" for name, number in versions().items())
    where = "{system}, {machine}, {processors} processors".format(**machine())
    replaced(PAGE, "machine", f"{where}; {told}.")
    replaced(PAGE, "effects", table("effect|on top of|in a scene file|1D|times, 1D|3D|times, 3D", _rows(billed)))
    replaced(PAGE, "refused", "\n".join(_refused()))
    replaced(PAGE, "costs", costs.said(billed))


def _rows(billed) -> Iterator[tuple[str, ...]]:
    for one, three in zip(billed["1D"], billed["3D"], strict=True):
        effect = one.effect
        lines = "<br>".join(f"`{line}`" for line in effect.file.splitlines())
        cells = (cell for cost, name in ((one, "1D"), (three, "3D")) for cell in _cells(effect, cost, name))
        yield effect.title, effect.over or "", lines, *cells


def _cells(effect: Effect, cost: costs.Cost, name: str) -> Iterator[str]:
    yield effect.verdict(costs.SOLVERS[name]).split(":")[0]
    yield two_digits(cost.times) if effect.over and cost.row.reason is None else ""


def _refused() -> Iterator[str]:
    for effect in effects():
        for name, solver in costs.SOLVERS.items():
            for reason in solver.refusals(effect.scene):
                yield f"- {effect.title}, {name}: {reason}."


def _put(chapter: Chapter) -> None:
    """Write figures and numbers of a chapter, and its tables into the page."""
    for name, figure in chapter.figures.items():
        (FOLDER / f"{name}.png").write_bytes(rendered(figure, ("png",)).files["png"])
    for name, rows in chapter.tables.items():
        replaced(PAGE, name, by_column(rows))
    for name, rows in chapter.data.items():
        stored(FOLDER / f"{name}.csv", rows)


if __name__ == "__main__":
    main()
