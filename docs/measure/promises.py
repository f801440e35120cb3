"""Errors that are stated, and errors that are wanted: tables of docs/results/promises.md and its folder.

What has been solved once is in docs/results/promises/solved.

python docs/measure/promises.py [learn|fit|costs]
    learn   solves contacts to learn from (two hours): docs/results/promises/learned.csv.gz
    fit     writes the weights of the signs of an error of friction from it: bem3d/friction_error.csv
    costs   measures what a solve takes, on a quiet machine: bem3d/costs.csv
"""

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

import pandas
from campaign import solved
from promises_page import costs, errors, promises
from tables import replaced, stored, table

from bem3d.costs import MEASURED

PAGE = Path(__file__).parents[1] / "results" / "promises.md"
FOLDER = PAGE.with_suffix("")
LEARNED = *range(300), *range(9000, 9180), *range(11000, 11180)  # seeds of contacts that bounds are fitted to
HELD_OUT = range(13000, 13180)  # and of those that they are tested on
PRICED = range(40)  # of those whose costs are measured


def main() -> None:
    """Solve what is judged, and write the page."""
    if "fit" in sys.argv[1:]:
        errors.write(errors.refitted(FOLDER / "learned.csv.gz"))
        return
    if "costs" in sys.argv[1:]:
        priced = list(costs.asked(PRICED))
        stored(MEASURED, costs.rows(priced, solved(PAGE, priced)))
        return
    if "learn" in sys.argv[1:]:
        every = list(errors.to_learn(LEARNED))
        tasks = [task for _, own, finer in every for task in (own, *finer)]
        errors.learn(FOLDER / "learned.csv.gz", every, solved(PAGE, dict.fromkeys(tasks)))
        return
    judged = [*errors.judged(HELD_OUT), *errors.judged_lines(HELD_OUT)]
    outcomes = solved(PAGE, dict.fromkeys(task for each in judged for task in each.tasks))
    stated = errors.rows(judged, outcomes)
    stored(FOLDER / "errors.csv", stated)
    asked = list(promises.asked())
    made = promises.rows(asked, solved(PAGE, [task for each in asked for task in each.tasks]))
    stored(FOLDER / "promises.csv", promises.missed(made))
    replaced(PAGE, "counts", _counts(judged, outcomes, stated))
    replaced(PAGE, "regions", _regions(stated))
    replaced(PAGE, "kept", f"{_kept(made)}\n\n{promises.said(made)}")


def _counts(judged, outcomes, stated: Sequence[Mapping]) -> str:
    """Numbers of contacts that were learned from, judged and left out, and the worst region, in sentences."""
    answered = sum(outcomes[each.task].rows[0].reason is None for each in judged)
    low = [f"{each['model']}, {each['region']}" for each in errors.regions(stated) if each["upper"] < errors.SHARE]
    worst = f"Significantly below 95 %: {'; '.join(low)}." if low else "No region is significantly below 95 %."
    return (
        f"Learned from {len(pandas.read_csv(FOLDER / 'learned.csv.gz'))} answers. Tested on "
        f"{len({each.task.scenes for each in judged})} contacts of other seeds, each on one or two grids: "
        f"{len(stated)} answers, and {answered - len(stated)} more whose truth is not known well enough. {worst}"
    )


def _regions(stated) -> str:
    def rows():
        for each in errors.regions(stated):
            share = each["held"] / each["answers"]
            held = f"{share:.1%} ({each['lower']:.1%} to {each['upper']:.1%})"
            median, bound = (f"{each[name]:.2g}" for name in ("median_error", "median_bound"))
            yield each["model"], each["region"], str(each["answers"]), held, median, bound

    return table("model|region|answers|within the bound|median error|median bound", rows())


def _kept(made) -> str:
    def rows():
        for each in promises.kept(made):
            yield each["quantity"], f"{each['wanted']:.1%}", *(str(each[name]) for name in promises.NUMBERS)

    return table("of|wanted|" + "|".join(promises.NUMBERS), rows())


if __name__ == "__main__":
    main()
