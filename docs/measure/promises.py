"""Errors that are stated, and errors that are wanted: numbers of docs/results/accuracy.md, and shipped tables.

What has been solved once is in docs/results/accuracy/promises/solved.

python docs/measure/promises.py [learn|fit|costs]
    learn   solves contacts to learn from (two hours): docs/results/accuracy/learned.csv.gz
    fit     writes the weights of the signs of an error of friction from it: bem3d/friction/friction_error.csv
    costs   measures the cost of solves, on a quiet machine: bem3d/costs.csv
"""

import sys
from collections.abc import Mapping
from pathlib import Path

import pandas
from campaign import solved
from promises_page import costs, errors, promises
from tables import fill, of_count, stored, table

from bem3d.costs import MEASURED

PAGE = Path(__file__).parents[1] / "results" / "accuracy.md"
FOLDER = PAGE.with_suffix("")
SOLVED, STATED, KEPT, TABLE = (FOLDER / name for name in ("promises", "errors.csv", "kept.csv", "learned.csv.gz"))
LEARNED = *range(300), *range(9000, 9180), *range(11000, 11180)  # seeds of contacts that bounds are fitted to
HELD_OUT = range(13000, 13180)  # and of those that they are tested on
PRICED = range(40)  # of those whose costs are measured


def main(asked: str = "") -> None:
    """Do what is asked; without a word, solve what is judged, and write the numbers and the parts of the page."""
    {"": judge, "learn": learn, "fit": lambda: errors.write(errors.refitted(TABLE)), "costs": price}[asked]()


def price() -> None:
    """Measure costs."""
    priced = list(costs.asked(PRICED))
    stored(MEASURED, costs.rows(priced, solved(SOLVED, priced)))


def learn() -> None:
    """Solve contacts to learn from."""
    every = list(errors.to_learn(LEARNED))
    tasks = [task for _, each in every for task in each.tasks]
    errors.learn(TABLE, every, solved(SOLVED, dict.fromkeys(tasks)))


def judge() -> None:
    """Solve what is judged, and write."""
    judged = [*errors.judged(HELD_OUT), *errors.judged_lines(HELD_OUT)]
    outcomes = solved(SOLVED, dict.fromkeys(task for each in judged for task in each.tasks))
    stored(STATED, errors.rows(judged, outcomes))
    asked = list(promises.asked())
    outcomes = solved(SOLVED, [task for each in asked for task in promises.with_truth(each)])
    stored(KEPT, promises.kept(promises.rows(asked, outcomes)))
    fill(parts())


def parts() -> Mapping[tuple[Path, str], str]:
    """Text between two comments, by the page and the name of the comment, from what is stored."""
    regions = list(errors.regions(pandas.read_csv(STATED).to_dict("records")))
    low = [f"{each['model']}, {each['region']}" for each in regions if each["upper"] < errors.SHARE]
    worst = f"Significantly below 95 %: {'; '.join(low)}." if low else "No region is significantly below 95 %."
    rows = (_of_region(each) for each in regions if each["region"] == "all")
    header = "solver|answers|within the bound|interval of 95 %|median error|median bound"
    return {
        (PAGE, "stated"): f"{table(header, rows)}\n\n{worst}",
        (PAGE, "kept"): _kept(pandas.read_csv(KEPT)[["asked", "confirmed", "checked", "broken"]].sum()),
    }


def _of_region(each) -> tuple[str, ...]:
    share, interval = f"{each['held'] / each['answers']:.1%}", f"{each['lower']:.1%} to {each['upper']:.1%}"
    medians = (f"{each[name]:.2g}" for name in ("median_error", "median_bound"))
    return each["model"], str(each["answers"]), share, interval, *medians


def _kept(counts) -> str:
    """Counts of all promises in words, with intervals."""
    left, broken = int(counts["asked"] - counts["confirmed"]), int(counts["broken"])
    return (
        f"Of {counts['asked']} settings that were asked for, {left} ({_share(left, counts['asked'])}) were not "
        f"confirmed. Of {counts['checked']} confirmed ones that could be checked, {broken} "
        f"({_share(broken, counts['checked'])}) missed the wanted accuracy."
    )


def _share(part, whole):
    low, high = of_count(part, whole)
    return f"{part / whole:.1%}, {low:.1%} to {high:.1%}"


if __name__ == "__main__":
    main(*sys.argv[1:])
