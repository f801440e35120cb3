"""Costs of steady contacts by points, from random contacts: what plans are priced by, bem3d/costs.csv."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from math import isnan
from typing import Any

from pandas import DataFrame

from bem3d import BEM
from bem3d.costs import COSTS, band, body
from compare.solving.task import Outcome, SceneTask, Task
from scene import Indent

from . import scenes

POINTS = {"smooth": (16, 24, 32, 48, 64, 96, 128, 192, 512), "rough": (48, 64, 96, 128, 192, 256, 512)}
TIGHT = 1e-7  # tolerance; plans bring its costs to others
FEWEST = 3  # solves for a median


def asked(seeds: range) -> Iterator[SceneTask]:
    """Contacts on every grid, sliding and at rest."""
    for kind, grids in POINTS.items():
        for seed in seeds:
            scene = scenes.drawn(kind, seed)
            held = Indent(**{scene.motion.pressed_by: scene.motion.greatest})
            for each in (scene, replace(scene, motion=held)):
                for points in grids:
                    solver = BEM(points=points, tolerance=TIGHT)
                    if not solver.refusals(each):
                        yield SceneTask(solver, (each,), work=points**2.2 * 50.0)


def rows(tasks: Sequence[SceneTask], outcomes: Mapping[Task, Outcome]) -> list[dict[str, Any]]:
    """Medians of each cost by body, band and points, of FEWEST solves at least."""
    spent = [
        {"body": body(scene), "band": band(scene), "cost": cost, "points": task.solver.points, "value": value}
        for task in tasks
        for scene in task.scenes
        for cost in COSTS
        if not isnan(value := getattr(outcomes[task].rows[0], cost))
    ]
    names = ["body", "band", "cost", "points"]
    return [
        {**dict(zip(names, key, strict=True)), "value": float(f"{each.median():.3g}"), "answers": len(each)}
        for key, each in DataFrame(spent).groupby(names, sort=False)["value"]
        if len(each) >= FEWEST
    ]
