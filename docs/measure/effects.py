"""What each effect costs in each solver: for results/workprecision.md, and the tables of plans.

python docs/measure/effects.py   measures the effects of effects.toml

Each solve is measured alone in a process of its own, on a quiet machine. Plans multiply operator
applications with bem3d/effects.csv and mdr1d/effects.csv, which are written from the same measurements.
"""

import tomllib
from collections import namedtuple
from functools import cache
from itertools import product
from math import nan
from pathlib import Path

import numpy as np
import pandas
from pandas import DataFrame
from pydantic import TypeAdapter
from tables import RESULTS, fill, solved, stored, table

import bem3d.plan
import mdr1d.plan
from bem3d import BEM
from bem3d.surface import RoughSurface
from compare.solving.cost import work_of
from compare.solving.task import Row
from compare.studies.workprecision.ladder import TimedSolve
from mdr1d import MDR
from scene import Scene
from scene.plan import two_digits

PAGE, MEASURED = RESULTS / "workprecision.md", RESULTS / "workprecision/effects.csv"
SOLVERS = {"3D": BEM(points=256, steps=40), "1D": MDR(points=5000, steps=40)}
WRITTEN = Path(__file__).with_suffix(".toml")
TABLES = {"3D": bem3d.plan.EFFECTS, "1D": mdr1d.plan.EFFECTS}
COUNTED = {"3D": (), "1D": ("Program",)}  # parts that a plan counts by itself
SCENES = TypeAdapter(Scene)
APPLICATIONS = "operator_applications"
UNSHOWN = "plane", "reversal"  # on the page
PIXELS = 128  # a side of the measured surface; the shortest wave has eight


# One effect on a plain contact: the scene that is solved, the title of the effect that it is added to, and names
# of the types whose applications in a plan are multiplied by those of this effect.
Effect = namedtuple("Effect", "title scene over parts", defaults=[None, ()])


def measured(rough):
    """Heights (PIXELS, PIXELS) [m] of one period of a surface, in place of a measured map, and their distance."""
    places = np.arange(PIXELS) / PIXELS * rough.longest
    heights = RoughSurface.of(rough, rough.q_max(rough.longest / PIXELS)).heights(places, places)
    return {"heights": heights, "pixel": rough.longest / PIXELS}


@cache
def effects():
    """All effects of effects.toml, plain contacts first."""
    written, found = tomllib.loads(WRITTEN.read_text(encoding="utf-8")), []
    for each in written["effect"]:
        named = {name: each.pop(name) for name in ("title", "over", "parts") if name in each}
        if named["title"] == "measured topography":
            each["roughness"] |= measured(found[-1].scene.roughness)
        found.append(Effect(scene=SCENES.validate_python(written["plain"] | each), **named))
    return found


def tasks():
    """A solve for each dimensionality and title, except for effects that the solver refuses."""
    return {
        (name, effect.title): TimedSolve(solver, (effect.scene,), work=work_of(solver, effect.scene))
        for name, solver in SOLVERS.items()
        for effect in effects()
        if not solver.refusals(effect.scene)
    }


def table_of(outcomes):
    """Rows of MEASURED: times is the processor time over the time without the effect, 1 of a plain contact."""
    rows, asked = [], tasks()
    for name, effect in product(SOLVERS, effects()):
        task, refused = asked.get((name, effect.title)), "; ".join(SOLVERS[name].refusals(effect.scene))
        row = outcomes[task].rows[0] if task else Row(reason=f"refused: {refused}")
        found = {
            "dimension": name,
            "effect": effect.title,
            "over": effect.over or "",
            "seconds": row.measures.get("processor", nan),
            "times": nan,
            APPLICATIONS: row.operator_applications,
            "time_steps": row.measures.get("time_steps", nan),
            "reason": row.reason or "",
        }
        rows.append(found)
    found = DataFrame(rows)
    return found.assign(times=_times(found, "seconds"))


def _times(found, cost):
    """A cost over the one of the contact that an effect is added to, of a plain contact itself."""
    plain = found.assign(effect=found["over"].where(found["over"] != "", found["effect"]))[["dimension", "effect"]]
    return found[cost] / plain.merge(found, "left")[cost]


def priced(name, found):
    """Rows of a table that plans multiply with: parts that were measured; of a program, for a step."""
    own = _times(found, APPLICATIONS) / found["time_steps"].fillna(1.0).to_numpy()
    own = own.set_axis(found["effect"])[(found["dimension"] == name).to_numpy()].dropna()
    for effect in effects():
        for part in effect.parts:
            if effect.title in own.index and part not in COUNTED[name]:
                yield {"part": part, APPLICATIONS: float(f"{own.loc[effect.title]:.3g}")}


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
