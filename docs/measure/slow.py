"""Slow friction in the paper's own regime: the numbers and figures of results/slow.md, and the README.

They are those of `crosscheck study steep-and-slow --size standard`, in whose folder they are solved. From nothing
it takes half an hour on two cores.
"""

import shutil
from pathlib import Path

from pandas import DataFrame
from tables import finding, replaced, said, stored, table

import compare
from compare.studies.comparison import asked

PAGE = Path(__file__).parents[1] / "results" / "slow.md"
BODIES, MODELS = ("sphere", "cone"), ("1D", "3D")
STUDY, SIZE = "steep-and-slow", "standard"
CLAIMS = {
    "eq17.load-exponent": "exponent of the load: friction",
    "eq17.level-least": "friction over Eq. 17, least load",
    "eq17.level-greatest": "friction over Eq. 17, greatest load",
    "eq17.contact": "exponent of the load: real contact",
    "eq17.friction-per-contact": "exponent of the load: friction over real contact",
    "eq17.slope-in-contact": "exponent of the load: rms slope in contact",
    "limit.slow": "friction over its exact limit",
}
ANSWER = (
    "Inside the regime of the paper, slow friction in 3D goes with the load to the power {} for the sphere and {} "
    "for the cone, where Eq. 17 has −0.667 and −0.5. It is {} times as high as Eq. 17 under {} N and {} times "
    "under {} N (sphere, where p/(E* h') is 0.051 and 0.087), {} times under {} N and {} times under {} N (cone, "
    "0.062 under any load)."
)
LEVELS = "eq17.level-least", "eq17.level-greatest"


def main() -> None:
    """Solve what is not solved yet, and write the numbers, the figures and the answer."""
    report = compare.study(STUDY, SIZE, progress="lines")
    found = report.findings[report.findings["claim"].isin(CLAIMS)]
    stored(PAGE.with_suffix(".csv"), found.drop(columns=["meaning"]))
    for body in BODIES:
        shutil.copy(report.path.parent / body / "behind.png", PAGE.with_name(f"slow-{body}.png"))
    columns = [(body, model) for body in BODIES for model in MODELS]
    rows = (
        (words, *(_said(found, claim, model, body) for body, model in columns)) for claim, words in CLAIMS.items()
    )
    replaced(PAGE, "numbers", table("|".join(["", *(f"{body}, {dim}" for body, dim in columns)]), rows))
    replaced(PAGE, "slow", answer(found))


def answer(found: DataFrame) -> str:
    """The answer in one sentence."""
    numbers = [_said(found, "eq17.load-exponent", "3D", body) for body in BODIES]
    for series in asked.study(STUDY, SIZE).series:
        for claim, load in zip(LEVELS, (series.values[0], series.values[-1]), strict=True):
            numbers += [_said(found, claim, "3D", series.name), f"{load:.3g}"]
    return ANSWER.format(*numbers)


def _said(found: DataFrame, claim: str, model: str, body: str) -> str:
    """Value with its interval."""
    row = finding(found, claim, body, model)
    return said(row, 1 if row["value"] > 2 else 3)


if __name__ == "__main__":
    main()
