"""What converges of a steep sphere, and what does not: writes docs/results/resolution.md, .csv and .png.

The steep sphere of the studies at 0.4 N, one surface, at rest and at three speeds, on a ladder of grids. What has
been solved once is in docs/results/resolution/solved; from nothing it takes half an hour and 1.5 GB of memory.
"""

from dataclasses import replace
from math import nan, pi
from pathlib import Path

import numpy as np
from campaign import solved
from pandas import DataFrame
from tables import replaced, stored

from bem3d import BEM
from compare.figures import style
from compare.solving.task import SceneTask
from compare.studies.comparison.study_file import STUDIES
from scene import Indent, Slide

PAGE = Path(__file__).parents[1] / "results" / "resolution.md"
POINTS, LOAD = (320, 640, 1280, 2560), 0.4
# v tau q_s: rest, low speed, the knee, and the fastest of the studies.
SPEEDS = {0.0: "at rest", 0.03: "slow", 3.0: "at the knee", 35.0: "fast"}
ESTIMATES = {"curvature": "by curvature", "traction": "by traction", "loss": "by loss", "friction": "as answered"}


def main() -> None:
    """Solve what is not solved yet, and write the page, its table and its figure."""
    scene = STUDIES["regime"].series("full")[0].scene  # steep sphere
    wave = scene.roughness.shortest / (2 * pi * scene.elastomer.relaxation_time)
    tasks = {}
    for speed in SPEEDS:
        motion = Slide(speed=speed * wave, load=LOAD) if speed else Indent(load=LOAD)
        moving = replace(scene, motion=motion)
        tasks |= {(speed, points): SceneTask(BEM(points=points), (moving,), work=points**2) for points in POINTS}
    outcomes = solved(PAGE, tasks.values())
    frame = DataFrame([_row(*place, outcomes[task].rows[0]) for place, task in tasks.items()])
    stored(PAGE.with_suffix(".csv"), frame)
    with style.applied():
        _figure(frame).savefig(PAGE.with_suffix(".png"), dpi=200)
    replaced(PAGE, "summary", _summary(frame))


def _row(speed, points, row):
    """Numbers of one solve; at rest curvature is friction, in 1/m."""
    known, force = row.measures, row.normal_force
    friction = {name: known[f"friction_by_{name}"] / force if speed else nan for name in ("traction", "loss")}
    curvature = known["friction_by_curvature"] / force if speed else known["curvature_by_pressure"]
    return {
        "speed": speed,
        "points": points,
        "pixels_a_wave": known["points_per_shortest_wave"],
        "pixels_across_a_spot": 2 * known["spot_radius"] / known["pixel"],
        "curvature": curvature,
        **friction,
        "friction": row.friction_coefficient if speed else curvature,
        "depth": row.depth,
        "contact": known["contact_area"],
    }


def _over_the_finest(frame, speed):
    own = frame[frame["speed"] == speed].sort_values("points")
    last = own.iloc[-1]
    return own, own[list(ESTIMATES)] / last["friction"]


def _summary(frame):
    """What the grids short of the finest are off by, as answered."""
    parts = []
    for points in POINTS[:-1]:
        own = frame[frame["points"] == points]
        finest = frame[frame["points"] == POINTS[-1]]
        off = own["friction"].values / finest["friction"].values - 1
        said = ", ".join(f"{each:+.1%} {name}" for each, name in zip(off, SPEEDS.values(), strict=True))
        parts.append(f"- {points}², {own['pixels_a_wave'].iloc[0]:.1f} pixels a wave: {said}")
    return "As answered, friction differs from that on the finest grid by\n\n" + "\n".join(parts)


def _figure(frame):
    drawing = style.canvas("double", 2.6)
    panels = drawing.subplots(1, len(SPEEDS), sharey=True, sharex=True)
    for axes, (speed, name) in zip(panels, SPEEDS.items(), strict=True):
        own, over = _over_the_finest(frame, speed)
        colours = "#56B4E9", "#009E73", "#CC79A7", style.colour("BEM")
        for look, colour, (estimate, words) in zip(style.forms(), colours, ESTIMATES.items(), strict=False):
            if np.isfinite(over[estimate]).all():
                axes.plot(own["pixels_a_wave"], over[estimate], color=colour, label=words, **look)
        axes.axhline(1, **style.line(0.6, 0.65, zorder=0))
        axes.set(xscale="log", xlabel="pixels a wave [1]", title=name, ylim=(0.5, 1.2))
    panels[0].set_ylabel("curvature / finest answer [1]")
    panels[1].set_ylabel("friction / finest answer [1]")
    style.lettered(panels)
    style.decades(*panels)
    style.legend(drawing, panels[-1:], 4)
    return drawing


if __name__ == "__main__":
    main()
