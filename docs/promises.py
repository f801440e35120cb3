"""Settings for a wanted accuracy: writes docs/promises.md, with docs/promises.

What has been solved once is in docs/promises/solved.

python docs/promises.py [ladder]   with the word ladder, writes anew what the promises rest on, bem3d/ladder.csv
"""

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

from pandas import DataFrame
from promises_page import ladder, promises
from rich.console import Console
from tables import table

import bem3d.accuracy
from compare import csvfiles
from compare.progress import Watched
from compare.runner import sweep
from compare.store import Store

FOLDER = Path(__file__).with_suffix("")
COUNTS = ("asked", "made", "checked", "kept", "confirmed", "confirmed_and_kept")
PROMISES = """# Settings for a wanted accuracy

`BEM.for_accuracy(scene, friction=0.01)` takes the least points and the loosest tolerance that keep the error
wanted of friction, of the depth or of the load, from a ladder of errors that were measured: {probes} contacts,
smooth (spheres, cones, a blunt body, lines) and rough (spheres, cones, planes), on a Kelvin and a standard
linear solid, each on six or eight grids against 512 points a side, solved to {tight:g}. A difference to a finer
grid is multiplied by N/(N - n), what is missing of an error that falls with the first power of the points. Of
each kind of body and speed the ladder keeps the largest error of all that was resolved as finely or more
finely. A grid has to resolve the shortest wave of the roughness, and the contact as a whole; a coarse solve,
which comes first, finds how finely a grid does so. A tenth of the wanted error is left to the tolerance.

```python
choice = BEM.for_accuracy(scene, friction=0.01)
choice.solver, choice.expected, choice.seconds  # the settings, the errors expected of them, and how long it takes
answer = choice.solve()  # answer.result; warns where half the points do not confirm it
```

`Choice.solve` solves on half the points too: what changes from there to all is no less than the error of the
grid where that falls with the first power of the points or faster, and where it is more than was wanted,
`Unconfirmed` is warned. No promise is made of programs, of roughness without a shortest wave, nor of errors
below those measured. The seconds are medians of solves to {tight:g}.

Written by `python docs/promises.py`.

## The ladder

Largest relative error, by points across what has to be resolved. Slow: the solid remembers less than a tenth of
the shortest wave (of the radius of contact, if smooth); fast: more than ten of them. All of it:
[bem3d/ladder.csv](../bem3d/ladder.csv).

{ladder}

## Kept?

Asked on {scenes} scenes of which the ladder knows nothing: other speeds and loads, other spectra and seeds, a
blunt body of another exponent, a steeper cone, a solid of three relaxation times, one with a glass a hundred
times as stiff, a fractional one. Errors are against {finest} points a side, where that is twice those chosen or
more, multiplied as above. Confirmed: changed by less than was wanted from half the points to all. All of them,
with the reasons why some were not made: [promises.csv](promises/promises.csv).

{kept}

{found}

## Estimates of friction

Median relative errors of the estimates that the answer joins (theory, Eqs. 5c to 5f), against its own on 512
points, over all contacts of the ladder: by the length that the solid remembers over the pixel. Numbers:
[estimates.csv](promises/estimates.csv).

{estimates}
"""


def main() -> None:
    """Measure the ladder and the promises, and write the page."""
    console, store = Console(highlight=False, soft_wrap=True), Store(FOLDER / "solved")
    measured = ladder.probes()
    outcomes = _swept(console, store, [task for probe in measured for task in probe.tasks])
    estimates = ladder.estimates(measured, outcomes)
    _write(FOLDER / "estimates.csv", estimates)
    if "ladder" in sys.argv[1:]:
        _write(bem3d.accuracy.LADDER, ladder.rows(measured, outcomes))
    asked = promises.asked()
    truths = [promises.truth(scene) for scene in promises.scenes()]
    made = promises.rows(asked, _swept(console, store, [*asked, *truths]))
    _write(FOLDER / "promises.csv", made)
    csvfiles.write_text(Path(__file__).with_suffix(".md"), promised(made, estimates))


def promised(made: Sequence[Mapping], estimates: Sequence[Mapping]) -> str:
    """What the ladder is, and whether its promises are promises."""
    totals = {name: sum(each[name] for each in promises.kept(made)) for name in COUNTS}
    said = (
        "Of {asked} promises asked for {made} were made; {checked} of these could be checked, and {kept} were "
        "kept. {confirmed} were confirmed, of which {confirmed_and_kept} were kept."
    ).format(**totals)
    return PROMISES.format(
        probes=len(ladder.probes()),
        tight=ladder.TIGHT,
        ladder=_ladder(),
        scenes=len(list(promises.scenes())),
        finest=promises.FINEST,
        kept=_kept(made),
        found=said,
        estimates=_estimates(estimates),
    )


def _swept(console, store, tasks):
    with Watched(console) as progress:
        return sweep(tasks, store, None, progress).outcomes


def _write(path: Path, rows: Sequence[Mapping]) -> None:
    csvfiles.write_text(path, csvfiles.text(DataFrame(rows)))


def _ladder() -> str:
    known = {kind: rungs for kind, rungs in bem3d.accuracy.ladder().items() if kind[2] not in bem3d.accuracy.COSTS}
    resolved = sorted({float(value) for rungs in known.values() for value in rungs[0]})

    def rows():
        for (body, band, quantity), rungs in known.items():
            errors = dict(zip(rungs[0].tolist(), rungs[1].tolist(), strict=True))
            cells = (f"{errors[value]:.1e}" if value in errors else "" for value in resolved)
            yield body, band, "depth, load" if quantity == "pressing" else quantity, *cells

    return table("|".join(["body", "speed", "error of", *(f"{value:g}" for value in resolved)]), rows())


def _kept(made) -> str:
    def rows():
        for each in promises.kept(made):
            counts = (str(each[name]) for name in COUNTS)
            worst, points = f"{each['worst_error']:.2%}", f"{each['median_points']:.0f}"
            yield each["quantity"], f"{each['wanted']:.1%}", *counts, worst, points

    return table(
        "of|wanted|asked|made|checked|kept|confirmed|confirmed and kept|worst error|points, median", rows()
    )


def _estimates(found) -> str:
    def rows():
        for each in found:
            errors = (f"{each[name]:.2%}" for name in (*ladder.ESTIMATES, "joined_90"))
            yield f"{each['from']:g} to {each['to']:g}", str(each["answers"]), *errors

    return table(
        "memory over pixel|answers|joined|by traction|by loss|by curvature|joined, 90 % are below", rows()
    )


if __name__ == "__main__":
    main()
