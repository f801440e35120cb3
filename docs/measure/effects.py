"""What each effect multiplies the costs of a plan with: writes bem3d/effects.csv and mdr1d/effects.csv.

python docs/measure/effects.py

Each solve is measured alone in a process of its own, on a quiet machine.
"""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from campaign import solved
from pydantic import TypeAdapter
from tables import stored

import bem3d.plan
import mdr1d.plan
from bem3d import BEM
from bem3d.surface import RoughSurface
from compare.solving.outcome import Outcome
from compare.solving.task import Task
from compare.studies.workprecision.timed import TimedSolve
from mdr1d import MDR
from scene import Scene, SelfAffine
from scene.plan import COSTS

STORE = Path(__file__).parents[1] / "results" / "effects.md"  # what is solved lies in the folder of this name
SOLVERS: Mapping[Path, BEM | MDR] = {
    bem3d.plan.EFFECTS: BEM(points=256, steps=40),
    mdr1d.plan.EFFECTS: MDR(points=5000, steps=40),
}
COUNTED = {"BEM": (), "MDR": ("Program",)}  # parts that a plan counts by itself
SCENES = TypeAdapter(Scene)
SLIDING: dict[str, Any] = {
    "indenter": {"type": "sphere", "radius": 10e-3},
    "elastomer": {
        "type": "standard-linear-solid",
        "rubbery_modulus": 1e6,
        "glassy_modulus": 10e6,
        "relaxation_time": 1e-3,
    },
    "motion": {"type": "slide", "speed": 0.1, "load": 1.0},
}
AT_REST = SLIDING | {"motion": {"type": "indent", "load": 1.0}}
ROUGH = {"hurst": 0.8, "rms_height": 5e-6, "longest": 4e-3, "shortest": 0.25e-3, "seed": 1}
PIXELS = 128  # a side of the measured surface; the shortest wave has eight


class Effect(NamedTuple):
    """One effect.

    parts : names of the types whose costs in a plan are multiplied by the cost of this effect
    added : its tables of a scene file
    plain : tables of the contact that it is added to
    """

    parts: tuple[str, ...]
    added: Mapping[str, Any]
    plain: Mapping[str, Any] = SLIDING

    @property
    def scenes(self) -> tuple[Scene, Scene]:
        """The contact with the effect, and without it."""
        return SCENES.validate_python({**self.plain, **self.added}), SCENES.validate_python(self.plain)


def measured() -> np.ndarray:
    """Heights (PIXELS, PIXELS) [m] of one period of the self-affine surface, in place of a measured map."""
    rough = SelfAffine(**ROUGH)
    places = np.arange(PIXELS) / PIXELS * rough.longest
    return RoughSurface.of(rough, rough.q_max(rough.longest / PIXELS)).heights(places, places)


def effects() -> tuple[Effect, ...]:
    """All effects."""
    map_ = {"heights": measured(), "pixel": ROUGH["longest"] / PIXELS, "repeat": "periodic", "level": "mean"}
    topography = {"type": "topography", **map_, "shortest_kept": ROUGH["shortest"]}
    self_affine = {"type": "self-affine", **ROUGH}
    warm = {"type": "wlf", "temperature": 301.0, "reference": 300.0, "c1": 10.0, "c2": 100.0}
    rubbed = {"interface": {"coefficient": 0.3}}
    shear = {"motion": {"type": "shear", "load": 1.0, "displacement": 2e-5}}
    stages = [{"duration": 1e-3, "load": 1.0}, {"duration": 1e-3, "speed": 0.1}]
    return (
        Effect(("Topography",), {"roughness": topography}, SLIDING | {"roughness": self_affine}),
        Effect(("Layer",), {"layer": {"thickness": 2e-3}}),
        Effect(("WLF", "Arrhenius", "ShiftFactors"), {"temperature": warm}),
        Effect(("Heating",), {"heating": {"conductivity": 50.0}}),
        Effect(("Coulomb",), rubbed),
        Effect(("Shear",), shear | rubbed, AT_REST),
        Effect(("Program",), {"motion": {"type": "program", "stages": stages}}, AT_REST),
    )


def pairs(solver: BEM | MDR) -> dict[str, tuple[Task, Task]]:
    """Solves with and without what a part stands for, by the part, of those that the solver does not refuse."""
    size = solver.points if solver.name == "MDR" else solver.points**2
    return {
        part: tuple(TimedSolve(solver, (scene,), work=300.0 * size) for scene in effect.scenes)
        for effect in effects()
        if not solver.refusals(effect.scenes[0])
        for part in effect.parts
        if part not in COUNTED[solver.name]
    }


def priced(asked: Mapping[str, tuple[Task, Task]], outcomes: Mapping[Task, Outcome]) -> Iterator[dict]:
    """Rows of a table: costs over those without the effect; of a program, for one step."""
    for part, tasks in asked.items():
        row, plain = (outcomes[task].rows[0] for task in tasks)
        steps = row.measures.get("time_steps", 1.0)
        times = row.measures["processor"] / plain.measures["processor"]
        multiples = row.operator_applications / plain.operator_applications, times
        yield {"part": part} | {
            cost: float(f"{value / steps:.3g}") for cost, value in zip(COSTS, multiples, strict=True)
        }


def main() -> None:
    """Measure, and write the tables."""
    asked = {path: pairs(solver) for path, solver in SOLVERS.items()}
    tasks = (task for each in asked.values() for both in each.values() for task in both)
    outcomes = solved(STORE, dict.fromkeys(tasks), fresh=True)
    for path, each in asked.items():
        stored(path, priced(each, outcomes))


if __name__ == "__main__":
    main()
