"""What the package has of the trust map, made of its campaign: `python docs/trust.py crosscheck-study`.

The folder is that of `crosscheck study trust --size standard`. Written are the measured tables, what is fitted to
those learned from, beside the modules that read them, and the tables of docs/trust.md and the README.
"""

import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray
from tables import replaced
from tables import table as markdown

import compare
from compare.studies.trust import shipped, table
from compare.studies.trust.model import Model
from compare.studies.trust.ratio import QUANTITIES
from compare.studies.trust.regions import BODIES
from compare.studies.trust.scoring import Score
from compare.studies.trust.study import HELD_OUT, LEARNED, TrustStudy, advice_rows

PAGE = Path(__file__).with_suffix(".md")
README = PAGE.parent.parent / "README.md"


def ship(answers: xarray.DataTree) -> None:
    """Write the tables, and models fitted to what these hold: to five digits, as they are read again."""
    for name, path in ((LEARNED, table.LEARNED), (HELD_OUT, table.HELD_OUT)):
        path.write_bytes(table.written(table.columns(answers[name].to_dataset())))
    table.read.cache_clear()
    learned = table.read(table.LEARNED)
    models = {name: Model.fit(name, table.measurements(learned, name)[1]) for name in QUANTITIES}
    shipped.FITTED.write_text(shipped.as_json(models) + "\n", encoding="utf-8")
    shipped.model.cache_clear()


def scores() -> dict[str, tuple[Score, Mapping[str, np.ndarray]]]:
    """Scores of the models that come with the package."""
    return TrustStudy.scored(table.read(table.HELD_OUT), {name: shipped.model(name) for name in QUANTITIES})


def advice(rows: list[dict[str, Any]], quantity: str) -> Iterator[dict[str, str]]:
    """A row for each regime, a cell for each body: factor with the range over scenes, interval, share to solve."""
    cells: dict[tuple[str, str], dict[str, str]] = {}
    for row in rows:
        if row["quantity"] == quantity:
            cells.setdefault((row["speed"], row["roughness"]), {})[row["body"]] = _cell(row)
    for (speed, roughness), found in cells.items():
        yield {"": f"{speed}, roughness {roughness}", **{body: found.get(body, "") for body in BODIES}}


def friction(rows: list[dict[str, Any]]) -> str:
    """The table of friction, in short: factors alone."""
    return told(advice(rows, "friction")).replace("multiply by ", "×")


def _cell(row):
    if row["solve"] > 0.5:
        return f"**solve** ({100 * row['solve']:.0f} %)"
    kind = "use" if row["use"] > 0.5 else f"multiply by {row['factor']:.2f} ({row['from']:.2f} to {row['to']:.2f})"
    solve = round(100 * row["solve"])
    return f"{kind}, ±{100 * row['interval']:.2g} %" + (f"; solve {solve} %" if solve else "")


def errors(found: Mapping[str, tuple[Score, Mapping[str, np.ndarray]]]) -> Iterator[dict[str, str]]:
    """A row for each quantity: errors on all held-out scenes that are usable."""
    for name, (score, _) in found.items():
        used = score.used
        own, raw = (np.quantile(np.abs(each), (0.5, 0.9)) for each in (used.own, used.errors))
        yield {
            "": name,
            "held-out scenes": f"{score.usable.size}",
            "use or multiply": f"{100 * score.usable.mean():.0f} %",
            "median error, map alone": f"{100 * own[0]:.2g} %",
            "nine in ten within": f"{100 * own[1]:.2g} %",
            "the same as measured": f"{100 * raw[0]:.2g} %, {100 * raw[1]:.2g} %",
            "in their interval of 95 %": f"{100 * used.covered:.1f} %",
        }


def told(rows: Iterator[dict[str, str]]) -> str:
    """Rows as a Markdown table."""
    first, *others = rows
    return markdown("|".join(first), (tuple(row.values()) for row in (first, *others)))


def main(folder: Path | None) -> None:
    """Write everything; without a folder, the tables of the pages alone."""
    if folder is not None:
        ship(compare.load(folder / "trust-standard"))
    found = scores()
    rows = list(advice_rows(found))
    parts = [f"**{name}**\n\n{told(advice(rows, name))}" for name in found]
    replaced(PAGE, "advice", "\n\n".join(parts))
    replaced(PAGE, "errors", told(errors(found)))
    replaced(README, "friction", friction(rows))


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else None)
