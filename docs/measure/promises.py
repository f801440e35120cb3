"""Errors that are stated, and errors that are wanted: writes docs/results/promises.md, with docs/results/promises.

What has been solved once is in docs/results/promises/solved.

python docs/measure/promises.py [learn|fit|errors|costs]
    learn   solves contacts to learn from (two hours): docs/results/promises/learned.csv.gz
    fit     writes the weights of the signs of an error of friction from it: bem3d/friction_error.csv
    costs   measures what a solve takes, on a quiet machine: bem3d/costs.csv
    errors  tests the errors that are stated, without the promises, and prints the table
"""

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

from pandas import DataFrame
from promises_page import costs, errors, promises
from rich.console import Console
from tables import table

from bem3d.costs import MEASURED
from compare.report import csvfiles
from compare.solving.runner import sweep
from compare.solving.store import Store
from compare.solving.terminal import SweepBar

FOLDER = Path(__file__).parents[1] / "results" / "promises"
LEARNED = *range(300), *range(9000, 9180), *range(11000, 11180)  # seeds of contacts that bounds are fitted to
HELD_OUT = range(13000, 13180)  # and of those that they are tested on
PRICED = range(40)  # of those whose costs are measured
PAGE = """# Errors that are stated, and errors that are wanted

## Every answer states the error of its friction

`friction_error` in the measures of a steady answer is a bound of 95 % on the relative error of friction by the
grid: |μ − μ*| / |μ*|, μ* being friction of the same model on the same surface, on ever finer grids. It takes no
other solve. There is none where there is no friction, nor of the tangential force under a `Shear`.

- **3D.** Friction is estimated in three ways from one pressure, and in the same ways from this pressure on
  pixels twice as wide. The 95 % quantile of the logarithm of the error is linear in the logarithms of what
  changes, and of how many pixels there are on a spot of contact, on the shortest wave and on the edge of a
  blunt body (quantile regression, Koenker and Bassett, Econometrica 46, 33, 1978). It was fitted to {learned}
  answers to random contacts of other seeds, and widened, by kind of contact, to hold {share:.1%} of those left
  out in turn.
- **1D.** The profile on every second, third and fourth node is swept once or twice more, at a depth that is
  known. The change of friction is taken as an error of second order; the bound is twice the greatest, and
  more where less than six nodes lie on the shortest wave.

Where the estimates of three dimensions differ by more than half of the answer, or the bound is more than half,
there is no answer: the `SolveError` names the points that would do. A power law r^100 that slides slowly is
refused on 64 points and answered on 128.

### Does it hold?

{scenes} contacts to which nothing was fitted, each on one or two grids ({answers} answers). Bodies with
exponents from 1 to 100, smooth and rough, planes, waves and lines; solids of every kind with modes up to seven
decades apart; memories from 1e-4 to 300 times the length that tells slow from fast. The truth is the answer on
512 points (1D: sixteen times the nodes), by the order at which the last answers change; contacts whose truth
is not known to a third of the error are left out ({unknown} answers). {worst}

{regions}

In brackets the interval of 95 % of the share (Clopper and Pearson). Numbers: [errors.csv](promises/errors.csv).

## Settings for a wanted accuracy

`BEM.for_accuracy(scene, friction=0.01)` doubles the points, from 32 a side to 1024 at most, until the answers
on the last three grids keep what is wanted of friction, of the depth or of the load.

```python
choice = BEM.for_accuracy(scene, friction=0.01)
choice.solver, choice.result, choice.error  # the settings, their answer, and its error as three grids show it
```

Of the changes at the last halving of the pixel and at the one before, the order p is taken (at least 1/2, at
most 2). The error is the last change over 2^p − 1, and no less than the last change nor a quarter of the one
before: that a change is small by chance does not fool it. A thirtieth of the wanted error is the tolerance.
`Unconfirmed` is warned where 1024 points do not confirm it, or would not by that order. No promise is made of
programs and of roughness without a shortest wave.

### Kept?

SceneLike on {smooth} smooth and {rough} rough contacts of other seeds. Errors are against 128, 256 and 512
points, by the order at which these change, where 512 are twice as many or more and the truth is known to a
fifth of what is wanted. Those that were not confirmed, or broken: [promises.csv](promises/promises.csv).

{kept}

{found}

Written by `python docs/measure/promises.py`.
"""


def main() -> None:
    """Solve what is judged, and write the page."""
    if "fit" in sys.argv[1:]:
        errors.write(errors.refitted(FOLDER / "learned.csv.gz"))
        return
    console, store = Console(highlight=False, soft_wrap=True), Store(FOLDER / "solved")
    if "costs" in sys.argv[1:]:
        priced = list(costs.asked(PRICED))
        _write(MEASURED, costs.rows(priced, _swept(console, store, priced)))
        return
    if "learn" in sys.argv[1:]:
        every = list(errors.to_learn(LEARNED))
        tasks = [task for _, own, finer in every for task in (own, *finer)]
        errors.learn(FOLDER / "learned.csv.gz", every, _swept(console, store, dict.fromkeys(tasks)))
        return
    judged = [*errors.judged(HELD_OUT), *errors.judged_lines(HELD_OUT)]
    outcomes = _swept(console, store, dict.fromkeys(task for each in judged for task in each.tasks))
    stated = errors.rows(judged, outcomes)
    _write(FOLDER / "errors.csv", stated)
    if "errors" in sys.argv[1:]:
        console.print(_regions(stated))
        return
    asked = list(promises.asked())
    made = promises.rows(asked, _swept(console, store, [task for each in asked for task in each.tasks]))
    _write(FOLDER / "promises.csv", promises.missed(made))
    csvfiles.write_text(
        Path(__file__).parents[1] / "results" / "promises.md", page(judged, outcomes, stated, made)
    )


def page(judged, outcomes, stated: Sequence[Mapping], made: Sequence[Mapping]) -> str:
    """The page, from what was judged and what was promised."""
    answered = sum(outcomes[each.task].rows[0].reason is None for each in judged)
    found = list(errors.regions(stated))
    low = [f"{each['model']}, {each['region']}" for each in found if each["upper"] < errors.SHARE]
    return PAGE.format(
        learned=errors.learned(FOLDER / "learned.csv.gz"),
        share=errors.WIDENED,
        scenes=len({each.task.scenes for each in judged}),
        answers=len(stated),
        unknown=answered - len(stated),
        worst="No region of forty answers or more is significantly below 95 %."
        if not low
        else f"Significantly below 95 %: {'; '.join(low)}.",
        regions=_regions(stated),
        smooth=promises.COUNTS["smooth"],
        rough=promises.COUNTS["rough"],
        kept=_kept(made),
        found=promises.said(made),
    )


def _swept(console, store, tasks):
    with SweepBar(console) as progress:
        return sweep(list(tasks), store, None, progress).outcomes


def _write(path: Path, rows: Sequence[Mapping]) -> None:
    csvfiles.write_text(path, csvfiles.text(DataFrame(rows)))


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
