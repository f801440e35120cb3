"""What each effect does, and what it costs: writes results/effects.md, with figures and tables in results/effects.

What has been solved once is in docs/results/effects/solved. Costs want a quiet machine.

python docs/measure/effects.py

What plans multiply costs with, bem3d/effects.csv and mdr1d/effects.csv, is written from the same measurements.
"""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from effects_page import costs
from effects_page.asked import Effect, effects
from effects_page.catalogue import STUDIES
from effects_page.chapter import Chapter
from pandas import DataFrame
from rich.console import Console
from tables import table

import bem3d.plan
import mdr1d.plan
from compare.report import csvfiles
from compare.report.manifest import machine, versions
from compare.report.plots import style
from compare.report.plots.rendering import rendered
from compare.solving.runner import sweep
from compare.solving.store import Store
from compare.solving.terminal import SweepBar
from scene.costs import two_digits

FOLDER = Path(__file__).parents[1] / "results" / "effects"
TABLES = {"3D": bem3d.plan.EFFECTS, "1D": mdr1d.plan.EFFECTS}
INTRODUCTION = """# Effects

A scene lists what is there, and the solvers simulate that and nothing else. An absent part costs nothing: no
kernel is built for it, no array allocated, and every digit of the answer is unchanged. `crosscheck plan
scene.toml` says what a scene asks for, what that costs, and what is left out;
[extending.md](../howto/extending.md) how to add an effect.

Written by `python docs/measure/effects.py`. {machine}

## Which effect in which solver

Each alone, on a smooth sphere that slides steadily on a standard linear solid. Times: processor seconds over those
of what it comes on top of, as measured [below](#{costs}). The lines are those of a scene file, in place of others.

{effects}

Refused, and why:

{refused}
"""


def main() -> None:
    """Solve what is not solved yet, and write the page."""
    FOLDER.mkdir(exist_ok=True)
    console, store = Console(), Store(FOLDER / "solved")
    outcomes = _swept(console, store, [task for study in STUDIES for task in study.tasks()])
    timed = _swept(console, store, costs.tasks(), fresh=True)
    billed = costs.costs(timed)
    for name, rows in costs.tables(billed).items():
        _write_csv(TABLES[name], rows)
    with style.applied():
        chapters = {study.TITLE: study.chapter(outcomes) for study in STUDIES}
        chapters[costs.TITLE] = costs.chapter(timed)
        sections = [_section(title, each) for title, each in chapters.items()]
    csvfiles.write_text(FOLDER.with_suffix(".md"), "\n".join([_introduction(billed), *sections]))


def _swept(console, store, tasks, workers=None, **how):
    with SweepBar(console) as progress:
        return sweep(tasks, store, workers, progress, **how).outcomes


def _introduction(billed: Mapping[str, Sequence[costs.Cost]]) -> str:
    told = ", ".join(f"{name} {number}" for name, number in versions().items())
    where = "{system}, {machine}, {processors} processors".format(**machine())
    return INTRODUCTION.format(
        machine=f"{where}; {told}.",
        costs=_anchor(costs.TITLE),
        effects=table("effect|on top of|in a scene file|1D|times, 1D|3D|times, 3D", _rows(billed)),
        refused="\n".join(_refused()),
    )


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


def _section(title: str, chapter: Chapter) -> str:
    parts = [f"## {title}", chapter.text]
    for name, figure in chapter.figures.items():
        (FOLDER / f"{name}.png").write_bytes(rendered(figure, ("png",)).files["png"])
        parts.append(f"![{name}]({FOLDER.name}/{name}.png)")
    for heading, rows in chapter.tables.items():
        parts += [f"### {heading}", table("|".join(rows[0]), (tuple(map(str, row.values())) for row in rows))]
    for name, rows in chapter.data.items():
        _write_csv(FOLDER / f"{name}.csv", rows)
    if chapter.data:
        parts.append(
            "Numbers: " + ", ".join(f"[{name}.csv]({FOLDER.name}/{name}.csv)" for name in chapter.data) + "."
        )
    return "\n\n".join(parts) + "\n"


def _write_csv(path, rows):
    csvfiles.write_text(path, csvfiles.text(DataFrame(rows)))


def _anchor(title: str) -> str:
    return "".join(c for c in title.lower().replace(" ", "-") if c.isalnum() or c == "-")


if __name__ == "__main__":
    main()
