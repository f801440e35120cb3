"""Which estimate of friction is worth its time: writes docs/results/contest.md, .csv and .png.

One asperity, crossed waves, a rough cell and the steep sphere at three speeds, each on a ladder of grids. What has
been solved once is in docs/results/contest/solved; from nothing it takes half an hour and 5 GB of memory.
"""

from dataclasses import dataclass, replace
from math import pi
from pathlib import Path

import numpy as np
from campaign import solved
from pandas import DataFrame
from spectrum import Refined
from tables import limit, replaced, table

from bem3d import BEM
from compare.report.csvfiles import text, write_text
from compare.report.plots import style
from compare.report.plots.lettering import lettered
from compare.solving.task import SceneTask
from compare.statistics.digits import number
from compare.studies.claims.contacts import STEEP
from scene import CrossedWaves, Kelvin, Plane, Scene, SelfAffine, Slide, Sphere
from scene.scales import elastic_contact

PAGE = Path(__file__).parents[1] / "results" / "contest.md"
TIME, PRESSURE, LENGTH, LOAD = 1e-3, 2e4, 1e-3, 0.4
SPEEDS = {0.03: "slow", 3.0: "at the knee", 35.0: "fast"}  # v tau q of the shortest wave
# v tau over the radius of the contact at rest, of the asperity
OF_ASPERITY = {0.03: 0.01, 3.0: 1.0, 35.0: 10.0}
CELL, STEEP_GRIDS = (32, 64, 128, 256, 512, 1024, 4096), (320, 640, 1280, 2560)
FINER = 2, 4  # pixels of a grid that the points in contact are refined below it
WANTED = 0.01
LEAST_ORDER = 0.5  # of which one can be told from three grids
ESTIMATES = {
    "answered": "as answered",
    "traction": "by traction",
    "loss": "by loss",
    "curvature": "by curvature",
    "extrapolated": "extrapolated",
    "refined": "spots refined",
}
COLOURS = (style.COLOUR["BEM"], "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000")


@dataclass(frozen=True)
class Case:
    """A contact that slides, at each of the speeds, on a ladder of grids of which the finest is the reference."""

    name: str
    scene: Scene
    speeds: dict[float, float]
    grids: tuple[int, ...]
    finer: tuple[int, ...] = ()

    def tasks(self) -> dict[tuple, SceneTask]:
        """Contacts by speed, points and how much finer their spots are."""
        found = {}
        for slow, speed in self.speeds.items():
            scene = replace(self.scene, motion=replace(self.scene.motion, speed=speed))
            for points in self.grids:
                found[slow, points, 1] = SceneTask(BEM(points=points), (scene,), work=points**2)
            # Elsewhere too much touches for a matrix of its points.
            for points in self.grids[:-2] if self.finer and slow == max(self.speeds) else ():
                for times in (each for each in self.finer if each * points < self.grids[-1]):
                    solver = Refined(BEM(points=points), times)
                    found[slow, points, times] = SceneTask(solver, (scene,), work=points**2)
        return found


def cases() -> list[Case]:
    """The four contacts."""
    solid, pressed = Kelvin(1e6, TIME), Slide(speed=0.0, pressure=PRESSURE)
    body = Scene(Sphere(1e-2), solid, Slide(speed=0.0, load=1.0))
    radius = elastic_contact(body).radius
    steep, _ = STEEP["sphere"]
    steep = replace(steep, roughness=replace(steep.roughness, seed=1), motion=Slide(speed=0.0, load=LOAD))
    short = LENGTH / 8
    rough = SelfAffine(hurst=0.8, rms_height=1e-5, longest=LENGTH, shortest=short, seed=1)
    return [
        Case("one asperity", body, {k: v * radius / TIME for k, v in OF_ASPERITY.items()}, CELL),
        Case(
            "crossed waves",
            Scene(Plane(), solid, pressed, CrossedWaves(amplitude=2e-5, wavelength=LENGTH)),
            _of_wave(LENGTH, TIME),
            CELL,
        ),
        Case("rough cell", Scene(Plane(), solid, pressed, rough), _of_wave(short, TIME), CELL),
        Case(
            "steep sphere",
            steep,
            _of_wave(steep.roughness.shortest, steep.elastomer.relaxation_time),
            STEEP_GRIDS,
            FINER,
        ),
    ]


def _of_wave(wavelength, time):
    return {each: each * wavelength / (2 * pi * time) for each in SPEEDS}


def main() -> None:
    """Solve what is not solved yet, and write the page, its table and its figure."""
    tasks = {case.name: case.tasks() for case in cases()}
    # One at a time: what is timed does not share the processor.
    outcomes = solved(PAGE, [task for each in tasks.values() for task in each.values()], workers=1)
    rows = []
    for name, each in tasks.items():
        for speed in SPEEDS:
            found = {place[1:]: outcomes[task].rows[0] for place, task in each.items() if place[0] == speed}
            rows += _rungs(name, speed, {place: row for place, row in found.items() if not row.reason})
    frame = DataFrame(rows)
    write_text(PAGE.with_suffix(".csv"), text(frame))
    header = "|".join(["case", "known to", *ESTIMATES.values()])
    replaced(PAGE, "costs", table(header, _costs(frame)))
    with style.applied():
        _figure(frame).savefig(PAGE.with_suffix(".png"), dpi=200)


def _rungs(case, speed, found):
    """Error and processor time of each estimate on each grid; the finest grid is the reference."""
    grids = sorted(points for points, times in found if times == 1)
    finest, before = (found[points, 1].friction_coefficient for points in (grids[-1], grids[-2]))
    at = {points: found[points, 1] for points in grids[:-1]}

    def rung(estimate, points, value, seconds):
        return {
            "case": case,
            "speed": SPEEDS[speed],
            "estimate": estimate,
            "points": points,
            "error": abs(value / finest - 1),
            "seconds": seconds,
            "known_to": abs(before / finest - 1),
        }

    for points, row in at.items():
        yield rung("answered", points, row.friction_coefficient, row.seconds)
        for name in ("traction", "loss", "curvature") if speed < 1 else ("traction", "loss"):
            yield rung(name, points, row.measures[f"friction_by_{name}"] / row.normal_force, row.seconds)
    for three in zip(grids, grids[1:-1], grids[2:-1], strict=False):
        values = [at[points].friction_coefficient for points in three]
        value = limit(values, LEAST_ORDER)
        value = value if np.isfinite(value) else values[-1]
        yield rung("extrapolated", three[-1], value, sum(at[points].seconds for points in three))
    for (points, times), row in found.items():
        if times > 1:
            yield rung("refined", points * times, row.friction_coefficient, at[points].seconds + row.seconds)


def _costs(frame):
    """Processor time from which on an estimate stays within what is wanted."""
    for (case, speed), own in frame.groupby(["case", "speed"], sort=False):
        known = own["known_to"].iloc[0]
        yield f"{case}, {speed}", f"{100 * known:.1g} %", *(_cost(own, name) for name in ESTIMATES)


def _cost(own, name):
    rungs = own[own["estimate"] == name].sort_values("seconds")
    if rungs.empty:
        return ""
    inside = (rungs["error"] <= WANTED).to_numpy()
    stays = np.logical_and.accumulate(inside[::-1])[::-1]
    if not stays.any():
        return "not reached"
    first = rungs.iloc[int(np.argmax(stays))]
    return f"{number(first['seconds'], 2)} s, {first['points']}²"


def _figure(frame):
    drawing = style.canvas("double", 6.5)
    names = list(frame["case"].unique())
    panels = drawing.subplots(len(names), len(SPEEDS), sharex=True, sharey=True)
    for row, name in zip(panels, names, strict=True):
        for axes, speed in zip(row, SPEEDS.values(), strict=True):
            own = frame[(frame["case"] == name) & (frame["speed"] == speed)]
            for look, colour, (estimate, words) in zip(style.forms(), COLOURS, ESTIMATES.items(), strict=False):
                rungs = own[own["estimate"] == estimate].sort_values("seconds")
                axes.plot(rungs["seconds"], rungs["error"], color=colour, label=words, **look)
            axes.axhspan(1e-9, own["known_to"].iloc[0], color=style.grey(0.9), lw=0, zorder=0)
            axes.set(xscale="log", yscale="log", title=f"{name}, {speed}", ylim=(1e-5, 1))
    for axes in panels[:, 0]:
        axes.set_ylabel("error of friction [1]")
    for axes in panels[-1]:
        axes.set_xlabel("processor time [s]")
    lettered(panels.ravel())
    style.legend(drawing, panels[-1, 0].get_legend_handles_labels()[0], "outside lower center", 6)
    return drawing


if __name__ == "__main__":
    main()
