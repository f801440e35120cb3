"""The trust map, made of its campaign: `python docs/measure/trust.py solve`.

Solves the scenes of the tables in 1D and 3D, what is not solved yet, in hours, and writes into the package the
tables and the models that are fitted to the one learned from. Without an argument it writes only what follows
from these tables: the tables of docs/results/trust.md.
"""

import gzip
import sys
from dataclasses import asdict
from functools import cache
from math import nan

import design
import numpy as np
from contact import GREAT, USUAL, Contact, Ratio, ratio_of
from fitting import as_json, fit
from pandas import DataFrame
from scoring import BEST, advice_rows, coverage_rows, error_rows, of_surfaces, scored, used
from tables import RESULTS, cells, fill, solved, stored, table

from compare.models.law.parts import LawParts
from compare.trustmap import table as ratios
from compare.trustmap.groups import DimensionlessGroups, SmoothReference
from compare.trustmap.model import LAW, RATIOS, asked_of

PAGE = RESULTS / "trust.md"
# Standard error that is wanted of a scene, and most surfaces, by table; and where waves are many.
KNOWN, KNOWN_WIDE = {ratios.LEARNED: (0.015, 64), ratios.HELD_OUT: (0.01, 600)}, (0.01, 300)
# Of what the errors are, in words.
NAMED = {
    "friction": "friction by corrected 1D",
    "depth": "depth by corrected 1D",
    "force": "force by corrected 1D",
    LAW: "friction by the 3D law",
    BEST: "friction by the best advice",
}
# Errors on all held-out scenes that are usable, of a ratio and kind of surface.
ERRORS = (
    "{ratio}, {region}|{scenes}|{usable:.0f} %|{median:.2g} %|{nine in ten:.2g} %"
    "|{in 95 %:.1f} ({least:.1f} to {most:.1f}) %"
)


def contact_at(point, path):
    """Task of a point of a table."""
    many = point >= design.WIDE
    return Contact(design.scene(point), *(KNOWN_WIDE if many else KNOWN[path]), GREAT if many else USUAL)


def row(point, scene, outcome):
    """Point, groups, and the numbers of each ratio of a rough scene."""
    smooth, asked = SmoothReference.of(scene), asked_of(scene)
    parts, none = LawParts.of(scene, smooth.contact), Ratio(nan, nan, nan, 0, nan)
    found = {"point": point, **asdict(DimensionlessGroups.of(scene, smooth, parts))}
    for name in RATIOS:
        ratio = ratio_of(outcome, name, parts.friction_coefficient) if name in asked else none
        found |= {ratios.column(name, number): value for number, value in ratio._asdict().items()}
    return found


def written(rows):
    """Table as compressed CSV, to five digits, far below the noise of a ratio."""
    return gzip.compress(rows.to_csv(index=False, float_format="%.5g", lineterminator="\n").encode(), mtime=0)


def ship():
    """Solve, and write the tables, and models fitted to what these hold, as they are read again."""
    for path in KNOWN:
        contacts = {point: contact_at(point, path) for point in ratios.read(path)["point"].astype(int).tolist()}
        outcomes = solved(PAGE, contacts.values())
        rows = DataFrame(row(point, each.scene, outcomes[each]) for point, each in contacts.items())
        path.write_bytes(written(rows))
    ratios.read.cache_clear()
    learned = ratios.read(ratios.LEARNED)
    models = {name: fit(name, ratios.measurements(learned, name)[1]) for name in RATIOS}
    ratios.FITTED.write_text(as_json(models) + "\n", encoding="utf-8")
    ratios.model.cache_clear()


@cache
def scores():
    """Scores of the models that come with the package."""
    return scored(ratios.read(ratios.HELD_OUT), {name: ratios.model(name) for name in RATIOS})


def parts():
    """Text between two comments of the page, by the name of the comment."""
    on_spectra, found = of_surfaces(scores(), "spectrum"), error_rows(scores(), ["surface"])
    columns = "|held-out scenes|use or multiply|median error|nine in ten within|in their interval of 95 %"
    return {
        "advice": table(
            "|".join(["", *(NAMED[name] for name in RATIOS)]), advice_rows([on_spectra[name] for name in RATIOS])
        ),
        "errors": table(columns, cells(ERRORS, map(_errors, found))),
    }


def _errors(row):
    """Row of a ratio and kind of surface, in percent."""
    shares = "usable", "median", "nine in ten", "in 95 %", "least", "most"
    return row | {"ratio": NAMED[row["ratio"]]} | {name: 100 * row[name] for name in shares}


def corrected():
    """Sentences of the README on the errors of friction by the best advice."""
    off = np.abs(used(of_surfaces(scores(), "spectrum")[BEST])["off"])
    half, most = 100 * np.quantile(off, (0.5, 0.9))
    return (
        f"Multiplied as `crosscheck trust` says, it is within {half:.1f} % of 3D for half of "
        f"{len(off)} unseen rough contacts, and within {most:.1f} % for nine in ten."
    )


def main(solve=""):
    """Write everything; without `solve`, what follows from the tables of the package."""
    if solve:
        ship()
    stored(RESULTS / "trust/coverage.csv", coverage_rows(scores()))
    fill(PAGE, parts())


if __name__ == "__main__":
    main(*sys.argv[1:])
