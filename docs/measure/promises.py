"""Errors that are stated, and errors that are wanted: numbers of docs/results/accuracy.md, and shipped tables.

What has been solved once is in docs/results/accuracy/promises/solved.

python docs/measure/promises.py [learn|fit|costs]
    learn   solves contacts to learn from (two hours): docs/results/accuracy/learned.csv.gz
    fit     writes the weights of the signs of an error of friction from it: bem3d/friction/friction_error.csv
    costs   counts the operator applications of solves: bem3d/costs.csv
"""

import sys
from dataclasses import replace

import friction_errors as errors
import pandas
import promised
from pandas import DataFrame
from random_contacts import drawn
from tables import RESULTS, cells, fill, of_count, solved, stored, table, task

from bem3d import BEM
from bem3d.costs import MEASURED, band, body
from bem3d.friction.bound import FITTED
from scene import Indent

PAGE, FOLDER = RESULTS / "accuracy.md", RESULTS / "accuracy"
SOLVED, STATED, KEPT, TABLE = (FOLDER / name for name in ("promises", "errors.csv", "kept.csv", "learned.csv.gz"))
LEARNED = *range(300), *range(9000, 9180), *range(11000, 11180)  # seeds of contacts that bounds are fitted to
HELD_OUT = range(13000, 13180)  # and of those that they are tested on
# Contacts whose costs are measured: their seeds, grids and tolerance, and the fewest solves for a median.
PRICED, TIGHT, FEWEST = range(40), 1e-7, 3
POINTS = {"smooth": (16, 24, 32, 48, 64, 96, 128, 192, 512), "rough": (48, 64, 96, 128, 192, 256, 512)}


def main(asked=""):
    """Do what is asked; without a word, solve what is judged, and write the numbers and the parts of the page."""
    {"": judge, "learn": learn, "fit": fit, "costs": price}[asked]()


def price():
    """Measure costs."""
    tasks = list(priced())
    stored(MEASURED, costs(tasks, solved(SOLVED, tasks)))


def learn():
    """Solve contacts to learn from."""
    every = list(errors.to_learn(LEARNED))
    found = DataFrame(errors.learn(every, _solved(every)))
    found.to_csv(TABLE, index=False, compression={"method": "gzip", "mtime": 0})


def fit():
    """Write the weights where three dimensions read them."""
    weights = errors.refitted(pandas.read_csv(TABLE)).map("{:.4g}".format)
    weights.to_csv(FITTED, index_label="sign", lineterminator="\n")


def judge():
    """Solve what is judged, and write."""
    judged = [*errors.judged(HELD_OUT), *errors.judged_lines(HELD_OUT)]
    stored(STATED, errors.rows(judged, _solved(judged)))
    asked = list(promised.asked())
    stored(KEPT, promised.kept(DataFrame(promised.rows(asked, _solved(asked)))))
    fill(PAGE, parts())


def _solved(judged):
    return solved(SOLVED, (one for each in judged for one in each.tasks))


def priced():
    """Contacts on every grid, sliding and at rest."""
    for kind, grids in POINTS.items():
        for seed in PRICED:
            scene = drawn(kind, seed)
            held = Indent(**{scene.motion.pressed_by: scene.motion.greatest})
            for each in (scene, replace(scene, motion=held)):
                for points in grids:
                    solver = BEM(points=points, tolerance=TIGHT)  # plans bring its costs to other tolerances
                    if not solver.refusals(each):
                        yield task(solver, each)


def costs(tasks, outcomes):
    """Median applications by body, band and points, of FEWEST solves at least."""
    names = ["body", "band", "points"]
    spent = [
        (body(scene), band(scene), each.solver.points, outcomes[each].rows[0].operator_applications)
        for each in tasks
        for scene in each.scenes
    ]
    groups = DataFrame(spent, columns=[*names, "value"]).dropna().groupby(names, sort=False)["value"]
    found = groups.agg(value="median", answers="size").reset_index()
    found["value"] = [float(f"{value:.3g}") for value in found["value"]]
    return found[found["answers"] >= FEWEST]


def parts():
    """Text between two comments of the page, by the name of the comment."""
    regions = list(errors.regions(pandas.read_csv(STATED)))
    low = [f"{each['model']}, {each['region']}" for each in regions if each["upper"] < errors.SHARE]
    worst = f"Significantly below 95 %: {'; '.join(low)}." if low else "No region is significantly below 95 %."
    rows = (each | {"share": each["held"] / each["answers"]} for each in regions if each["region"] == "all")
    form = "{model}|{answers}|{share:.1%}|{lower:.1%} to {upper:.1%}|{error:.2g}|{bound:.2g}"
    header = "solver|answers|within the bound|interval of 95 %|median error|median bound"
    return {
        "stated": f"{table(header, cells(form, rows))}\n\n{worst}",
        "kept": _kept(pandas.read_csv(KEPT)[["asked", "confirmed", "checked", "broken"]].sum()),
    }


def _kept(counts):
    """Counts of all promises in words, with intervals."""
    asked, confirmed, checked, broken = counts.tolist()
    left = asked - confirmed
    return (
        f"Of {asked} settings that were asked for, {left} ({_share(left, asked)}) were not "
        f"confirmed. Of {checked} confirmed ones that could be checked, {broken} "
        f"({_share(broken, checked)}) missed the wanted accuracy."
    )


def _share(part, whole):
    low, high = of_count(part, whole)
    return f"{part / whole:.1%}, {low:.1%} to {high:.1%}"


if __name__ == "__main__":
    main(*sys.argv[1:])
