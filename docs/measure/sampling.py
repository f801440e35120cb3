"""Processor time that an interval takes: writes docs/results/sampling.md, .csv and .png, in five minutes.

All is solved in this process, on one thread. A contact that several half-widths ask for is solved and timed once.
"""

from dataclasses import replace
from pathlib import Path
from time import process_time

import numpy as np
from matplotlib.lines import Line2D
from pandas import DataFrame
from tables import replaced, table

from compare.library.case import shipped_cases
from compare.models.table import Model, Models
from compare.report.csvfiles import text, write_text
from compare.report.plots import style
from compare.report.plots.lettering import lettered
from compare.solving.parameter_grid import FINE, ParameterGrid, on_two_grids
from compare.statistics import means
from compare.statistics.jackknife import mean_ratio
from compare.statistics.levels import pooled
from compare.statistics.means import FRICTION
from compare.studies.accuracy import sufficient
from compare.studies.sweep.study import Sweep
from scene import Slide

PAGE = Path(__file__).parents[1] / "results" / "sampling.md"
LOAD, SPEEDS, WIDTHS = 1.0, (0.1, 1.0), (0.05, 0.02, 0.01)
ASKED = {128: (3, "a third"), 256: (5, "a fifth")}  # times less than on the fixed grid
TIMED = 24  # surfaces of a fixed grid
OTHERS = 1000, 2000  # seeds of these, of which nothing is remembered from other solves
COLOUR = {128: "#0072B2", 256: "#D55E00"}
HEADER = "body|v [m/s]|finest grid|half-width|surfaces by grid|sampled [s]|fixed [s]|share|alone [s]|share"


def main() -> None:
    """Measure all, and write the page, its table and its figure."""
    rows = []
    for name, case in shipped_cases().items():
        for points in ASKED:
            scene = replace(case, bem=replace(case.bem, points=points))
            _fixed(scene, SPEEDS[0], 1, OTHERS[0])  # what is planned or compiled once
            for speed in SPEEDS:
                rows += _rows(name.removeprefix("paper-"), scene, speed)
    frame = DataFrame(rows)
    write_text(PAGE.with_suffix(".csv"), text(frame))
    written(frame)


def written(frame: DataFrame) -> None:
    """Write the page and its figure."""
    replaced(PAGE, "summary", "\n".join(_summary(own, points) for points, own in frame.groupby("points")))
    replaced(PAGE, "numbers", table(HEADER, map(_line, frame.itertuples())))
    with style.applied():
        _figure(frame).savefig(PAGE.with_suffix(".png"), dpi=200)


def _rows(body, case, speed):
    """Rows of one contact: sampled for each half-width, beside fixed grids that reach as much."""
    both, change = _fixed(case, speed, TIMED, OTHERS[0])
    alone, _ = _fixed(case, speed, TIMED, OTHERS[1], False)
    known: dict = {}
    rows = [_sampled(case, speed, wanted, known) for wanted in WIDTHS]
    scatter = rows[-1]["scatter"]  # of the most surfaces
    for row in rows:
        # On half the points too, the error of the grid takes its part of the half-width; on one grid nobody knows it.
        counts = [sufficient(scatter, row["half_width"] - grid) for grid in (change, 0.0)]
        row |= {"scatter": scatter, "fixed_surfaces": counts[0], "fixed_seconds": counts[0] * both}
        row |= {"alone_surfaces": counts[1], "alone_seconds": counts[1] * alone}
        print(body, speed, row, flush=True)
    return [{"body": body, "speed": speed, "points": case.bem.points, **row} for row in rows]


def _fixed(case, speed, count, seed, halves=True):
    """Processor seconds of a surface on a fixed grid, with half the points too or alone; what these change."""
    started = process_time()
    grids = on_two_grids(case.bem) if halves else {case.bem.name: {FINE: case.bem}}
    scene = replace(case.scene, roughness=replace(case.scene.roughness, seed=seed))
    one = ParameterGrid(scene=scene, speeds=(speed,), values=(LOAD,), grids=grids, draws={case.bem.name: count})
    found = one.datasets({task: task.solve() for task in one.tasks()})[case.bem.name]
    seconds = (process_time() - started) / count
    friction = found["friction_force"].mean("seed").values.ravel()
    return seconds, abs(friction[-1] / friction[0] - 1)


def _sampled(case, speed, wanted, known):
    """Half-width that is reached, surfaces and processor seconds; known : outcomes and seconds by task."""
    alone = Models((Model.of(case.bem),), case.bem.name)
    study = Sweep(replace(case, motion=Slide(speed=speed, load=LOAD)), (speed,), (LOAD,), 1, alone, wanted)
    started, solving, looks = process_time(), 0.0, 0
    while study is not None:
        tasks, begun = study.batches()[0].tasks, process_time()
        for task in tasks:
            if task not in known:
                at = process_time()
                known[task] = task.solve(), process_time() - at
        solving += process_time() - begun
        last, looks = study, looks + 1
        answers = study.answers({task: known[task][0] for task in tasks})
        study = study.more(answers, [])
    beside = process_time() - started - solving
    found = answers["contacts"].children[case.bem.name].to_dataset(inherit=False)
    value, low, high = (each.item() for each in means.interval(pooled(found), *FRICTION))
    many = found.isel(grid=-1, seed=np.flatnonzero(found["stratum"] == found.sizes["grid"] - 1))
    one = mean_ratio(many["friction_force"].values, many["normal_force"].values)
    return {
        "wanted": wanted,
        "half_width": (high - low) / 2 / value,
        "surfaces": " + ".join(str(len(each)) for each in last.grids()["contacts"].strata(case.bem.name)),
        "looks": looks,
        "seconds": sum(known[task][1] for task in tasks) + beside,
        "beside": beside,
        "scatter": (one.error / one.value).item() * many.sizes["seed"] ** 0.5,
    }


def _line(row):
    shares = row.seconds / row.fixed_seconds, row.seconds / row.alone_seconds
    times = f"{row.fixed_seconds:.1f}", f"{shares[0]:.2f}", f"{row.alone_seconds:.1f}", f"{shares[1]:.2f}"
    width = f"{100 * row.half_width:.2f} %"
    return row.body, f"{row.speed:g}", f"{row.points}²", width, row.surfaces, f"{row.seconds:.1f}", *times


def _summary(own, points):
    """Whether a finest grid takes as little as is asked, at each half-width."""
    times, words = ASKED[points]
    said = []
    for wanted, some in own.groupby("wanted", sort=False):
        shares = (some["seconds"] / some["fixed_seconds"]).sort_values()
        kept = f"{(shares <= 1 / times).sum()} of {shares.size}"
        said.append(f"{kept} at {100 * wanted:g} % ({shares.iloc[0]:.2f} to {shares.iloc[-1]:.2f})")
    return f"- At most {words} of {points}²: {', '.join(said)}."


def _figure(frame):
    """Half-width against processor seconds, a panel for each body and speed."""
    drawing = style.canvas("double", 2.6)
    contacts = list(frame.groupby(["body", "speed"], sort=False))
    panels = drawing.subplots(1, len(contacts), sharex=True, sharey=True)
    for axes, ((body, speed), some) in zip(panels, contacts, strict=True):
        for points, own in some.groupby("points"):
            widths = 100 * own["half_width"]
            axes.plot(own["fixed_seconds"], widths, "--", color=COLOUR[points])
            axes.plot(own["seconds"], widths, "o" if points == 128 else "s", linestyle="-", color=COLOUR[points])
        axes.set(xscale="log", yscale="log", title=f"{body}, {speed:g} m/s", xlabel="processor time [s]")
    panels[0].set_ylabel("half-width [%]")
    lettered(panels)
    style.decades(*panels)
    looks = {"sampled": ("os", "-"), "fixed grid": (("", ""), "--")}
    handles = [
        Line2D([], [], color=COLOUR[points], marker=marker, linestyle=line, label=f"{name}, {points}²")
        for name, (markers, line) in looks.items()
        for marker, points in zip(markers, COLOUR, strict=True)
    ]
    style.legend(drawing, handles, "outside lower center", 4)
    return drawing


if __name__ == "__main__":
    main()
