"""Slow friction in the paper's own regime: the numbers and figures of results/slow.md, and the README.

They are those of `crosscheck study steep-and-slow --size standard`, in whose folder they are solved. From nothing
it takes half an hour on two cores.
"""

import shutil
from pathlib import Path

from pandas import DataFrame
from tables import replaced, table

import compare
from compare.report.csvfiles import text, write_text

PAGE = Path(__file__).parents[1] / "results" / "slow.md"
README = PAGE.parents[2] / "README.md"
BODIES, DIMENSIONS = ("sphere", "cone"), ("1D", "3D")
CLAIMS = {
    "eq17.load-exponent": "friction goes with the load to the power",
    "eq17.level": "friction over the law",
    "eq17.contact": "real contact goes with the load to the power",
    "eq17.friction-per-contact": "friction over real contact to the power",
    "eq17.slope-in-contact": "slope of what touches to the power",
    "limit.slow": "friction over its exact limit",
}
ANSWER = (
    "Inside the regime of the paper, slow friction in 3D goes with the load to the power {} for the sphere and {} "
    "for the cone, where Eq. 17 has −0.667 and −0.5, and is {} and {} times as high."
)


def main() -> None:
    """Solve what is not solved yet, and write the numbers, the figures and the answer."""
    report = compare.study("steep-and-slow", "standard", progress="lines")
    found = report.table[report.table["claim"].isin(CLAIMS)]
    write_text(PAGE.with_suffix(".csv"), text(found.drop(columns=["regime", "meaning", "plot"])))
    for body in BODIES:
        shutil.copy(report.path.parent / body / "behind.png", PAGE.with_name(f"slow-{body}.png"))
    columns = [(body, dimension) for body in BODIES for dimension in DIMENSIONS]
    rows = (
        (words, *(_said(found, claim, dimension, body) for body, dimension in columns))
        for claim, words in CLAIMS.items()
    )
    replaced(PAGE, "numbers", table("|".join(["", *(f"{body}, {dim}" for body, dim in columns)]), rows))
    for page in (PAGE, README):
        replaced(page, "slow", answer(found))


def answer(found: DataFrame) -> str:
    """The answer in one sentence."""
    asked = [(claim, body) for claim in ("eq17.load-exponent", "eq17.level") for body in BODIES]
    return ANSWER.format(*(_said(found, claim, "3D", body) for claim, body in asked))


def _said(found: DataFrame, claim: str, dimension: str, body: str) -> str:
    """Value with its interval."""
    chosen = (found["claim"] == claim) & (found["dimension"] == dimension) & (found["where"] == body)
    (row,) = found[chosen].itertuples()
    digits = 1 if row.value > 2 else 3
    value, low, high = (f"{each:.{digits}f}".replace("-", "−") for each in (row.value, row.low, row.high))
    return f"{value} ({low} to {high})"


if __name__ == "__main__":
    main()
