"""What each effect costs in each solver: for results/workprecision.md, and the tables of plans.

python docs/measure/effects.py

Each solve is measured alone in a process of its own, on a quiet machine. Plans multiply costs with
bem3d/effects.csv and mdr1d/effects.csv, which are written from the same measurements.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import product
from math import nan
from pathlib import Path
from typing import Any

import numpy as np
import pandas
from pandas import DataFrame
from pydantic import TypeAdapter
from tables import fill, solved, stored, table

import bem3d.plan
import mdr1d.plan
from bem3d import BEM
from bem3d.surface import RoughSurface
from compare.solving.task import Row
from compare.studies.workprecision.ladder import TimedSolve
from mdr1d import MDR
from scene import Scene, SelfAffine
from scene.plan import COSTS, two_digits

PAGE = Path(__file__).parents[1] / "results" / "workprecision.md"
MEASURED = PAGE.with_suffix("") / "effects.csv"
SOLVERS = {"3D": BEM(points=256, steps=40), "1D": MDR(points=5000, steps=40)}
TABLES = {"3D": bem3d.plan.EFFECTS, "1D": mdr1d.plan.EFFECTS}
COUNTED = {"3D": (), "1D": ("Program",)}  # parts that a plan counts by itself
SCENES = TypeAdapter(Scene)
PLAIN = {
    "indenter": {"type": "sphere", "radius": 10e-3},
    "elastomer": {
        "type": "standard-linear-solid",
        "rubbery_modulus": 1e6,
        "glassy_modulus": 10e6,
        "relaxation_time": 1e-3,
    },
    "motion": {"type": "slide", "speed": 0.1, "load": 1.0},
}
ROUGH = {"hurst": 0.8, "rms_height": 5e-6, "longest": 4e-3, "shortest": 0.25e-3, "seed": 1}
SELF_AFFINE = {"roughness": {"type": "self-affine", **ROUGH}}
WARM = {"temperature": {"type": "wlf", "temperature": 301.0, "reference": 300.0, "c1": 10.0, "c2": 100.0}}
RUBBED = {"interface": {"coefficient": 0.3}}
PRESSED, SLID = {"duration": 1e-3, "load": 1.0}, {"duration": 1e-3, "speed": 0.1}
UNSHOWN = "plane", "reversal"  # on the page
PIXELS = 128  # a side of the measured surface; the shortest wave has eight


@dataclass(frozen=True)
class Effect:
    """One effect, on a plain contact.

    tables : its tables of a scene file, in place of those of PLAIN
    over : title of the effect that it is added to
    parts : names of the types whose costs in a plan are multiplied by the cost of this effect
    """

    title: str
    tables: Mapping[str, Any] = field(default_factory=dict)
    over: str | None = None
    parts: tuple[str, ...] = ()

    @property
    def scene(self):
        """The contact that is solved."""
        return SCENES.validate_python({**PLAIN, **self.tables})


def measured():
    """Heights (PIXELS, PIXELS) [m] of one period of the self-affine surface, in place of a measured map."""
    rough = SelfAffine(**ROUGH)
    places = np.arange(PIXELS) / PIXELS * rough.longest
    return RoughSurface.of(rough, rough.q_max(rough.longest / PIXELS)).heights(places, places)


def effects():
    """All effects, plain contacts first."""
    map_ = {"heights": measured(), "pixel": ROUGH["longest"] / PIXELS, "repeat": "periodic", "level": "mean"}
    topography = {"type": "topography", **map_, "shortest_kept": ROUGH["shortest"]}
    plane = {"indenter": {"type": "plane"}, "motion": {"type": "slide", "speed": 0.1, "pressure": 2e4}}
    shear = {"motion": {"type": "shear", "load": 1.0, "displacement": 2e-5}}
    return (
        Effect("steady sliding"),
        Effect("contact at rest", {"motion": {"type": "indent", "load": 1.0}}),
        Effect("roughness", SELF_AFFINE, "steady sliding"),
        Effect("measured topography", {"roughness": topography}, "roughness", ("Topography",)),
        Effect("plane", plane | SELF_AFFINE, "roughness"),
        Effect("layer", {"layer": {"thickness": 2e-3}}, "steady sliding", ("Layer",)),
        Effect("temperature", WARM, "steady sliding", ("WLF", "Arrhenius", "ShiftFactors")),
        Effect("heating, estimated", {"heating": {"conductivity": 50.0}}, "steady sliding", ("Heating",)),
        Effect(
            "heating, fed back", WARM | {"heating": {"conductivity": 0.2, "feedback": "average"}}, "temperature"
        ),
        Effect("friction in the interface", RUBBED, "steady sliding", ("Coulomb",)),
        Effect("partial slip", shear | RUBBED, "contact at rest", ("Shear",)),
        Effect("program", _program(SLID), "contact at rest", ("Program",)),
        Effect("reversal", _program(SLID, {**SLID, "speed": -0.1}), "program"),
        Effect("oscillation", _program({**SLID, "amplitude": 0.2, "frequency": 2000.0}), "program"),
    )


def _program(*stages):
    return {"motion": {"type": "program", "stages": [PRESSED, *stages]}}


def tasks():
    """A solve for each dimensionality and title, except for effects that the solver refuses."""
    return {
        (name, effect.title): TimedSolve(solver, (effect.scene,), work=_work(solver, effect))
        for name, solver in SOLVERS.items()
        for effect in effects()
        if not solver.refusals(effect.scene)
    }


def _work(solver, effect):
    steps = 20.0 * solver.steps if effect.scene.motion.type == "program" else 300.0
    return steps * (solver.points if solver.name == "MDR" else solver.points**2)


def table_of(outcomes):
    """Rows of MEASURED: times is the processor time over the time without the effect, 1 of a plain contact."""
    rows, asked = [], tasks()
    for name, effect in product(SOLVERS, effects()):
        task, refused = asked.get((name, effect.title)), "; ".join(SOLVERS[name].refusals(effect.scene))
        row = outcomes[task].rows[0] if task else Row(reason=f"refused: {refused}")
        found = {"dimension": name, "effect": effect.title, "over": effect.over or ""}
        found |= {"seconds": row.measures.get("processor", nan), "times": nan}
        found |= {"operator_applications": row.operator_applications}
        rows.append(found | {"time_steps": row.measures.get("time_steps", nan), "reason": row.reason or ""})
    found = DataFrame(rows)
    return found.assign(times=_times(found, "seconds"))


def _times(found, cost):
    """A cost over the one of the contact that an effect is added to, of a plain contact itself."""
    over = found["over"].where(found["over"] != "", found["effect"])
    by_effect = found.set_index(["dimension", "effect"])[cost]
    return found[cost] / by_effect[zip(found["dimension"], over, strict=True)].to_numpy()


def priced(name, found):
    """Rows of a table that plans multiply costs with: parts whose cost was measured; of a program, for a step."""
    costs = dict(zip(COSTS, (_times(found, "operator_applications"), found["times"]), strict=True))
    own = DataFrame(costs).div(found["time_steps"].fillna(1.0), axis=0).set_index(found["effect"])
    own = own[(found["dimension"] == name).to_numpy()].dropna()
    for effect in effects():
        for part in effect.parts:
            if effect.title in own.index and part not in COUNTED[name]:
                yield {"part": part} | {cost: float(f"{own.loc[effect.title, cost]:.3g}") for cost in COSTS}


def cells(found):
    """Cells of the table of the page: times, or why there are none."""
    for (effect, over), both in found.groupby(["effect", "over"], sort=False):
        if over and effect not in UNSHOWN:
            by = both.set_index("dimension")
            yield effect, over, *(_cell(by.loc[name]) for name in ("1D", "3D"))


def _cell(row):
    return row["reason"].split(":")[0] or two_digits(float(row["times"]))


def parts():
    """Text between two comments of the page, by the name of the comment."""
    found = pandas.read_csv(MEASURED, keep_default_na=False, na_values="nan")
    return {"effects": table("effect|added to|1D|3D", cells(found))}


def main():
    """Measure, and write the tables and the part of the page."""
    found = table_of(solved(MEASURED, tasks().values(), fresh=True))
    for name, path in TABLES.items():
        stored(path, priced(name, found))
    stored(MEASURED, found)
    fill(PAGE, parts())


if __name__ == "__main__":
    main()
