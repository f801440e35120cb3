"""The paper's experiment in three dimensions: the tables and the figure of results/experiment.md.

They are those of `crosscheck study experiment --size standard`, in whose folder it is solved. From nothing it
takes six minutes of processor time.
"""

import shutil
from collections.abc import Iterator
from pathlib import Path

from pandas import DataFrame
from tables import finding, replaced, stored, table

import compare
from compare.statistics.digits import interval

PAGE = Path(__file__).parents[1] / "results" / "experiment.md"
STORED = PAGE.parent / "study" / "experiment-standard"
NAME = "experiment"
PLACES = {
    "50 mm on 10 mm, as the paper assumes": "layer, as the paper assumes",
    "50 mm on 10 mm, all that is plausible": "layer, all that is plausible",
    "50 mm on a half-space, as the paper assumes": "half-space, as the paper assumes",
}
CLAIMS = {
    "unshifted": "misfit before any shift [%]; tested against 0 ± 2",
    "collapse": "misfit, shifted along the force at best [%]; 0 ± 2",
    "along-friction": "misfit, shifted along friction at best [%]; 0 ± 2",
    "same": "the latter minus the former [%]; 0 ± 2",
    "predicted": "misfit, shifted along the force by the paper's power [%]; 0 ± 2",
    "exponent": "exponent of the shift along the force; paper: −0.15 ± 0.0075",
    "one-line": "misfit of one straight line [%]; 0 ± 2",
    "two-lines": "misfit of two straight lines [%]; 0 ± 2",
    "over-cubic": "the latter over that of a cubic; 0 to 1",
    "slope-light": "slope of the first line; paper: −0.667 to 0",
    "slope-heavy": "slope of the second; paper: −0.667 to 0",
    "break": "force at which they meet over F*; paper: 1 ± 0.25",
    "width": "diameter of the contact at F* over the thickness; paper: 1 ± 0.05",
    "level": "greatest friction; paper: 0.5 ± 0.25",
    "ball-light": "share of the smooth ball in friction, 1 N",
    "ball-heavy": "share of the smooth ball in friction, 100 N",
    "pressed": "least mean pressure over the rms pressure of full contact",
}
PERCENT = "unshifted", "collapse", "along-friction", "same", "predicted", "one-line", "two-lines"
LAW = {
    "law": "friction law/BEM on the layer; tested against 1 ± 0.05",
    "law-of-roughness": "the same, of roughness alone",
    "law-on-layer": "law/BEM, layer over half-space; tested against 1 ± 0.05",
}


def main() -> None:
    """Solve what is not solved yet, and write the tables and the figure."""
    report = compare.study(NAME, "standard", progress="lines")
    found = report.table.drop(columns=["meaning", "plot", "sentence"])
    stored(STORED / "findings.csv", found)
    shutil.copy(report.path.parent / f"{NAME}.png", STORED)
    rows = ((words, *(_cell(found, claim, place) for place in PLACES)) for claim, words in CLAIMS.items())
    replaced(PAGE, "numbers", table("|".join(["", *PLACES.values()]), rows))
    replaced(PAGE, "law", table("|".join(["", *LAW.values()]), _checks(found)))


def _checks(found: DataFrame) -> Iterator[tuple[str, ...]]:
    for where in found.loc[found["claim"] == f"{NAME}.law", "where"]:
        yield where, *(_cell(found, claim, where) for claim in LAW)


def _cell(found: DataFrame, claim: str, where: str) -> str:
    """Verdict, unless the number is only reported, and the number with its interval."""
    row = finding(found, f"{NAME}.{claim}", where)
    scale = 100 if claim in PERCENT else 1
    said = interval(*(scale * row[name] for name in ("value", "low", "high")))
    return said if row["verdict"] == "reported" else f"{row['verdict']}: {said}"


if __name__ == "__main__":
    main()
