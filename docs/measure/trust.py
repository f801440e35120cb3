"""What the package has of the trust map, made of its campaign: `python docs/measure/trust.py crosscheck-study`.

The folder is that of `crosscheck study trust --size standard`. Written are the measured tables, what is fitted to
those learned from, beside the modules that read them, and the tables of docs/results/trust.md and the README.
"""

import sys
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import cache
from math import exp, hypot
from pathlib import Path
from typing import Any

import numpy as np
import xarray
from tables import by_column, replaced, stored
from tables import table as markdown

import compare
from compare.library.lookup import case_of
from compare.report.page import Table
from compare.report.plots.rendering import picture
from compare.statistics.finding import table as findings
from compare.studies.trust import design
from compare.studies.trust.contact import Contact
from compare.studies.trust.scoring import of_count
from compare.studies.trust.statements import BEST, Scored, advice_rows, error_rows, of_surfaces
from compare.studies.trust.study import (
    HELD_OUT,
    KNOWN,
    LEARNED,
    NAMED,
    TrustStudy,
    answers_of,
    contact_at,
    labelled,
    tasks_of,
)
from compare.trustmap import shipped, table
from compare.trustmap.model import NORMAL, Model
from compare.trustmap.ratio import LAW, RATIOS, ratio_of
from compare.trustmap.regions import BODIES, SURFACES
from scene import Indent
from scene.scales import elastic_contact

PAGE = Path(__file__).parents[1] / "results" / "trust.md"
STORED = PAGE.parent / "study" / "trust-standard"
README = PAGE.parents[2] / "README.md"
# Scenes below which a number says how few there are.
FEW = 20
# Speeds of the ready scenes, v τ over the shortest wave.
SPEEDS = 0.02, 0.2, 20.0
# Columns of the table of the README.
SHORT = "roughness|multiply 1D by (nine in ten scenes)|± for one scene, 95 %|solve in 3D|scenes"


def ship(answers: xarray.DataTree) -> None:
    """Write the tables, and models fitted to what these hold: to five digits, as they are read again."""
    for name, path in ((LEARNED, table.LEARNED), (HELD_OUT, table.HELD_OUT)):
        path.write_bytes(table.written(table.columns(answers[name].to_dataset())))
    table.read.cache_clear()
    learned = table.read(table.LEARNED)
    models = {name: Model.fit(name, table.measurements(learned, name)[1]) for name in RATIOS}
    shipped.FITTED.write_text(shipped.as_json(models) + "\n", encoding="utf-8")
    shipped.model.cache_clear()


@cache
def scores() -> dict[str, Scored]:
    """Scores of the models that come with the package."""
    return TrustStudy.scored(table.read(table.HELD_OUT), {name: shipped.model(name) for name in RATIOS})


def advice(rows: list[dict[str, Any]], quantity: str) -> Iterator[dict[str, str]]:
    """A row for each regime, a cell for each body: factor with the range over scenes, interval, share to solve."""
    cells: dict[tuple[str, str], dict[str, str]] = {}
    for row in rows:
        if row["quantity"] == quantity:
            cells.setdefault((row["speed"], row["roughness"]), {})[row["body"]] = _cell(row)
    for (speed, roughness), found in cells.items():
        yield {"": f"{speed}, roughness {roughness}", **{body: found.get(body, "") for body in BODIES}}


def _cell(row):
    few = f"; {row['scenes']} scenes" if row["scenes"] < FEW else ""
    return _advised(row) + few


def _advised(row):
    if row["solve"] > 0.5:
        return f"**solve** ({100 * row['solve']:.0f} %)"
    kind = "use" if row["use"] > 0.5 else f"multiply by {row['factor']:.2f} ({row['from']:.2f} to {row['to']:.2f})"
    solve = round(100 * row["solve"])
    return f"{kind}, ±{100 * row['interval']:.2g} %" + (f"; solve {solve} %" if solve else "")


def errors(found: Mapping[str, Scored]) -> Iterator[dict[str, str]]:
    """A row for each ratio and kind of surface: errors on all held-out scenes that are usable."""
    for kind in SURFACES:
        for name, (score, _) in of_surfaces(found, kind).items():
            used, counts = score.used, np.isfinite(score.measured.logarithm)
            own, raw = (np.quantile(np.abs(each), (0.5, 0.9)) for each in (used.own, used.errors))
            low, high = of_count(int(used.held.sum()), used.held.size)
            yield {
                "": f"{NAMED[name]}, {kind}",
                "held-out scenes": f"{counts.sum()}",
                "use or multiply": f"{100 * score.usable[counts].mean():.0f} %",
                "median error, as measured": f"{100 * raw[0]:.2g} %",
                "nine in ten within, as measured": f"{100 * raw[1]:.2g} %",
                "both without the scatter of the truth": f"{100 * own[0]:.2g} %, {100 * own[1]:.2g} %",
                "in their interval of 95 %": f"{100 * used.covered:.1f} ({100 * low:.1f} to {100 * high:.1f}) %",
            }


def regions(found: Mapping[str, Scored]) -> Iterator[dict[str, str]]:
    """A row for each region: errors of friction by 1D, by the law, by the best advice, and the share held."""
    cells: dict[str, dict[str, str]] = {}
    for row in error_rows({name: found[name] for name in ("friction", LAW, BEST)}):
        told = f"{100 * row['median']:.2g} / {100 * row['nine in ten']:.2g}, {100 * row['in 95 %']:.0f}"
        few = f" ({row['scenes']})" if row["scenes"] < FEW else ""
        cells.setdefault(f"{row['by']}: {row['region']}", {})[NAMED[row["ratio"]]] = told + few
    for region, found_there in cells.items():
        yield {"median / nine in ten, held [%]": region, **found_there}


def apart() -> Iterator[dict[str, str]]:
    """A row for each speed, and for rest: 1D/3D of the ready sphere and cone, as solved and as foretold."""
    asked = {f"friction, v τ = {each:g} λ_s": each for each in SPEEDS} | {"force at rest at a depth": None}
    for named, speed in asked.items():
        row = {"": named}
        for body in ("sphere", "cone"):
            scene = _pressed(case_of(f"paper-{body}").scene, speed)
            quantity = "force" if speed is None else "friction"
            found = ratio_of(Contact(scene, *KNOWN[HELD_OUT]).solve(), quantity)
            error = NORMAL * hypot(found.line_error, found.scatter / found.surfaces**0.5)
            foretold = getattr(compare.trust(scene), quantity)
            measured = (exp(found.logarithm + each * error) for each in (0, -1, 1))
            row[f"{body}, measured"] = _between(*measured)
            row[f"{body}, map"] = _between(foretold.ratio, foretold.low, foretold.high)
        yield row


def _pressed(scene, speed):
    """The scene at rest at the depth of its smooth body, or so fast that it creeps so far in units of λ_s."""
    if speed is None:
        return replace(scene, motion=Indent(depth=elastic_contact(scene).depth))
    waves = scene.roughness.shortest / scene.elastomer.relaxation_time
    return replace(scene, motion=replace(scene.motion, speed=speed * waves))


def _between(middle, low, high):
    return f"{middle:.2f} ({low:.2f} to {high:.2f})"


def parts() -> Mapping[tuple[Path, str], str]:
    """Text between two comments, by the page and the name of the comment."""
    found = scores()
    drawn = of_surfaces(found, "spectrum")
    rows = list(advice_rows({name: each for name, each in drawn.items() if name != BEST}))
    return {
        (PAGE, "advice"): "\n\n".join(
            f"**{_titled(each)}**\n\n{by_column(advice(rows, each))}" for each in RATIOS
        ),
        (PAGE, "errors"): by_column(errors(found)),
        (PAGE, "regions"): by_column(regions(found)),
        (README, "friction"): in_short({"friction": drawn["friction"]}),
    }


def _titled(name):
    return f"{NAMED[name]}, whose answer has the factor" if name == LAW else NAMED[name]


def in_short(found: Mapping[str, Scored]) -> str:
    """Table of the README: advice on friction by 1D in each regime, of all bodies together."""
    rows = advice_rows(found, {"": lambda columns: np.isfinite(columns["shape"])})
    cells = (
        (
            f"{row['speed']}, {row['roughness']}",
            f"{row['factor']:.2f} ({row['from']:.2f} to {row['to']:.2f})",
            f"{100 * row['interval']:.2g} %",
            f"{100 * row['solve']:.0f} %",
            str(row["scenes"]),
        )
        for row in rows
    )
    return markdown(SHORT, cells)


def corrected() -> str:
    """Sentences of the README on the errors of friction by the best advice."""
    used = of_surfaces(scores(), "spectrum")[BEST][0].used
    measured = 100 * np.quantile(np.abs(used.errors), (0.5, 0.9))
    return (
        f"Multiplied as `crosscheck trust` says, friction of {used.usable.size} unseen rough contacts is within "
        f"{measured[0]:.1f} % of 3D in half, {measured[1]:.1f} % in nine of ten."
    )


def judged_again() -> None:
    """Write findings, tables and the map of the page of the campaign, judged from the tables of the package.

    Smooth scenes are in no table: those of the campaign are solved here, in minutes.
    """
    table_of = table.read(table.HELD_OUT)
    count = table_of["point"].size
    rows = {
        "point": table_of["point"],
        "groups": table.groups(table_of),
        "smooth": np.full((count, len(RATIOS)), np.nan),
        **{
            number: np.stack([table_of[table.column(name, number)] for name in RATIOS], axis=1)
            for number in table.NUMBERS
        },
    }
    evenly = range(design.EVENLY_AGAIN, int(max(rows["point"][rows["point"] < design.MEASURED])) + 1)
    smooth = {point: contact_at(point, HELD_OUT) for point in evenly if design.scene(point).roughness is None}
    outcomes = {task: task.solve() for task in tasks_of(smooth.values())}
    both = xarray.concat([labelled(rows), answers_of(smooth, outcomes)], "scene")
    tree = xarray.DataTree.from_dict({f"/{HELD_OUT}": both})
    judged = TrustStudy("standard").judge(tree)
    for plot in judged.plots:
        for name, frame in plot.files.items():
            stored(STORED / f"{name}.csv", frame)
        (STORED / f"{plot.name}.png").write_bytes(picture(plot).files["png"])
    frames = {each.name: each.frame for each in judged.page("", tree).every(Table)}
    for name, frame in {"findings": findings(judged.findings), **frames}.items():
        stored(STORED / f"{name}.csv", frame)


def main(folder: Path | None) -> None:
    """Write everything; without a folder, what follows from the tables of the package."""
    if folder is not None:
        ship(compare.load(folder / "trust-standard"))
    judged_again()
    replaced(PAGE, "apart", by_column(apart()))
    for (page, part), told in parts().items():
        replaced(page, part, told)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else None)
