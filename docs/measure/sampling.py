"""Processor time that an interval takes: writes docs/results/sampling.md, .csv and .png, in five minutes.

All is solved in this process, on one thread. A contact that several half-widths ask for is solved and timed once.
"""

from dataclasses import replace
from math import ceil
from pathlib import Path
from time import process_time

import numpy as np
from compare.studies.sweep.study import Sweep
from pandas import DataFrame
from tables import replaced, stored, table

from compare.comparison.curve import FINE, Curve, on_two_levels
from compare.figures import style
from compare.figures.lettering import lettered
from compare.library.lookup import named_cases
from compare.models.table import Model, Models
from compare.statistics import means
from compare.statistics.intervals import student
from compare.statistics.jackknife import mean_ratio
from compare.statistics.means import FRICTION
from compare.statistics.multilevel import pooled
from scene import Slide

PAGE = Path(__file__).parents[1] / "results" / "sampling.md"
LOAD, SPEEDS, WIDTHS = 1.0, (0.1, 1.0), (0.05, 0.02, 0.01)
ASKED = {128: (3, "a third"), 256: (5, "a fifth")}  # times less than on the fixed grid
TIMED = 24  # surfaces of a fixed grid, on half the points too and alone, and the first seeds of both
FIXED = {"fixed": 2_000_000, "alone": 3_000_000}
FIRST = 1, 1_000_001, 1_100_001  # seeds of repeats: other surfaces, at other stops
COLOUR = {128: "#0072B2", 256: "#D55E00"}
LOOK = {"seconds": ("-", "os", "sampled"), "fixed_seconds": ("--", "  ", "fixed, and half the points")}
LOOK |= {"alone_seconds": (":", "  ", "fixed alone")}
HEADER = "body|v [m/s]|grid|half-width|surfaces by grid|sampled [s]|fixed [s]|share|alone [s]|share"


def main() -> None:
    """Measure all, and write the page, its table and its figure."""
    rows = []
    for name, case in named_cases().items():
        for points, speed in ((points, speed) for points in ASKED for speed in SPEEDS):
            scene = replace(case, bem=replace(case.bem, points=points))
            rows += [{"body": name.removeprefix("paper-"), **row} for row in _rows(scene, speed)]
            print(DataFrame(rows[-len(WIDTHS) :]).to_string(), flush=True)
    frame = DataFrame(rows)
    stored(PAGE.with_suffix(".csv"), frame)
    numbers = frame.groupby(["body", "speed", "points", "wanted"], sort=False).mean().reset_index()
    replaced(PAGE, "summary", "\n".join(_summary(own, points) for points, own in numbers.groupby("points")))
    replaced(PAGE, "numbers", table(HEADER, map(_line, numbers.itertuples())))
    with style.applied():
        _figure(numbers).savefig(PAGE.with_suffix(".png"), dpi=200)


def _rows(case, speed):
    """Rows of one contact: sampled for each half-width, beside fixed grids that reach as much."""
    for seed in FIXED.values():
        _fixed(case, speed, seed - 1, 1)  # what is planned or compiled once
    costs = [_fixed(case, speed, seed, TIMED, name == "fixed") for name, seed in FIXED.items()]
    for first in FIRST:
        known: dict = {}
        rows = [_sampled(_drawn(case, first), speed, wanted, known) for wanted in WIDTHS]
        for row in rows:
            # The scatter is that of the most surfaces. One grid alone tells no error of the grid.
            lefts = row["half_width"] - row["grid"], row["half_width"]
            for name, cost, left in zip(FIXED, costs, lefts, strict=True):
                count = sufficient(rows[-1]["scatter"], left)
                row |= {f"{name}_surfaces": count, f"{name}_seconds": count * cost}
            yield {"speed": speed, "points": case.bem.points, "first": first, **row}


def sufficient(scatter: float, half: float) -> int:
    """Fewest surfaces of a scatter whose mean has an interval of 95 % of a half-width, both relative."""
    count = max(2, ceil((student(0.95, np.inf) * scatter / half) ** 2))
    while student(0.95, count - 1) * scatter > half * count**0.5:
        count += 1
    return count


def _drawn(case, seed):
    return replace(case, roughness=replace(case.roughness, seed=seed))


def _fixed(case, speed, seed, count, halves=True):
    """Processor seconds of a surface on a fixed grid, with half the points too or alone."""
    started, name = process_time(), case.bem.name
    grids = on_two_levels(case.bem) if halves else {name: {FINE: case.bem}}
    scene = _drawn(case, seed).scene
    one = Curve(scene=scene, speeds=(speed,), values=(LOAD,), grids=grids, draws={name: count})
    one.datasets({task: task.solve() for task in one.tasks()})
    return (process_time() - started) / count


def _sampled(case, speed, wanted, known):
    """Half-width that is reached, surfaces and processor seconds; known : outcomes and seconds by task."""
    name, started, solving = case.bem.name, process_time(), 0.0
    alone, moving = Models((Model.of(case.bem),), name), replace(case, motion=Slide(speed=speed, load=LOAD))
    study = Sweep(moving, (speed,), (LOAD,), 1, alone, wanted)
    while study is not None:
        last, tasks, begun = study, study.batches()[0].tasks, process_time()
        for task in (task for task in tasks if task not in known):
            at = process_time()
            known[task] = task.solve(), process_time() - at
        solving += process_time() - begun
        answers = study.answers({task: known[task][0] for task in tasks})
        study = study.more(answers, [])
    seconds = process_time() - started - solving + sum(known[task][1] for task in tasks)
    found = answers["contacts"].children[name].to_dataset(inherit=False)
    both = pooled(found)
    value, low, high = (each.item() for each in means.interval(both, *FRICTION))
    fine, coarse = (
        (both["friction_force"] / both["normal_force"].mean("surface")).mean("surface").values.ravel()[:2]
    )
    many = found.isel(level=-1, surface=np.flatnonzero(found["stratum"] == found.sizes["level"] - 1))
    one = mean_ratio(many["friction_force"].values, many["normal_force"].values)
    scatter = (one.error / one.value).item() * many.sizes["surface"] ** 0.5
    row = {"wanted": wanted, "half_width": (high - low) / 2 / value, "grid": abs(coarse / fine - 1)}
    points = found["points"].values.tolist()
    strata = zip(points, last.grids()["contacts"].strata(name), strict=True)
    return row | {"scatter": scatter, "seconds": seconds} | {f"on_{at}": len(each) for at, each in strata}


def _line(row):
    widths = [getattr(row, f"on_{points}") for points in (256, 128, 64, 32)]
    surfaces = " + ".join(f"{count:.0f}" for count in widths if np.isfinite(count))
    times = row.fixed_seconds, row.seconds / row.fixed_seconds, row.alone_seconds, row.seconds / row.alone_seconds
    shown = [f"{each:.{digits}f}" for each, digits in zip((row.seconds, *times), (1, 1, 2, 1, 2), strict=True)]
    return row.body, f"{row.speed:g}", f"{row.points}²", f"{100 * row.half_width:.2f} %", surfaces, *shown


def _summary(own, points):
    """Lines that say how many contacts stay within what is asked, and the largest share of the fixed time."""
    (times, words), said = ASKED[points], []
    for name in FIXED:
        shares = (own["seconds"] / own[f"{name}_seconds"]).groupby(own["wanted"], sort=False)
        counts, most = shares.agg(lambda each: (each <= 1 / times).sum()), shares.max()
        said.append(f"{', '.join(f'{each:.0f}' for each in counts)} ({', '.join(f'{each:.2f}' for each in most)})")
    return f"- {words} of fixed {points}²: {said[0]}; alone: {said[1]}"


def _figure(numbers):
    """Half-width against processor seconds, a panel for each body and speed."""
    drawing = style.canvas("double", 2.8)
    contacts = list(numbers.groupby(["body", "speed"], sort=False))
    panels = drawing.subplots(1, len(contacts), sharex=True, sharey=True)
    for axes, ((body, speed), some) in zip(panels, contacts, strict=True):
        for column, (line, markers, name) in LOOK.items():
            for marker, (points, own) in zip(markers, some.groupby("points"), strict=True):
                looks = {"linestyle": line, "marker": marker, "color": COLOUR[points]}
                axes.plot(own[column], 100 * own["half_width"], label=f"{name}, {points}²", **looks)
        axes.set(xscale="log", yscale="log", title=f"{body}, {speed:g} m/s", xlabel="processor time [s]")
    panels[0].set(ylabel="half the interval of friction [%]", ylim=(0.8, 5.5))
    lettered(panels)
    style.decades(*panels)
    style.legend(drawing, panels[-1].get_legend_handles_labels()[0], "outside lower center", 3)
    return drawing


if __name__ == "__main__":
    main()
