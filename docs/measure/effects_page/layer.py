"""A rubber of finite thickness under a sphere: stiffness and friction on both sides of the paper's force F*."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import pairwise
from math import log
from typing import Literal

import numpy as np

from bem3d import BEM
from compare.models.exact import layer as reference
from compare.models.exact import mean_lag
from compare.solving.outcome import Outcome
from compare.solving.task import SceneTask as Task
from compare.solving.task import Task as AnyTask
from mdr1d.estimates import layer_force
from scene import Elastic, Indent, Layer, Scene, SelfAffine, Slide, Sphere, StandardLinearSolid

from .chapter import Chapter, Rows
from .figures import layer as drawing
from .means import mean

NAME = "layer"
SOLVER, SLIDING, ROUGH = BEM(points=128, tolerance=1e-7), BEM(points=64), BEM(points=128)
MODULUS = 3e6  # G_0 [Pa]
THICKNESS, SPHERE = 10e-3, Sphere(radius=50e-3)
FORCES = tuple(float(force) for force in np.geomspace(1e-2, 1e4, 13))  # [N]
APART = 0.05  # of a load, to either side: for a stiffness
STIFFENING = 9.0  # glassy over rubbery modulus, less one
CREEP = 1e-3  # [s]
MEMORIES = (0.01, 0.1, 1.0)  # length that the sphere slides in that time, over the thickness
OVER_F = (1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0)
ROUGHNESS = SelfAffine(hurst=0.8, rms_height=30e-6, longest=8e-3, shortest=2e-3)
ROUGH_MEMORY, ROUGH_OVER_F = 0.2, (0.1, 1.0, 10.0)  # length over the shortest wave
SURFACES = 3


@dataclass(frozen=True)
class Rubber:
    """Body that is pressed: base of the layer, None of a half-space, and Poisson ratio."""

    base: Literal["bonded", "frictionless"] | None
    poisson_ratio: float

    @property
    def name(self) -> str:
        """For people."""
        if self.base is None:
            return "half-space"
        return f"{self.base}, ν = {self.poisson_ratio:g}"

    @property
    def layer(self) -> Layer | None:
        """As a scene states it."""
        return None if self.base is None else Layer(thickness=THICKNESS, base=self.base)

    @property
    def modulus(self) -> float:
        """E* [Pa]."""
        return 2 * MODULUS / (1 - self.poisson_ratio)

    @property
    def force(self) -> float:
        """F* [N] of this E*."""
        return float(layer_force(self.modulus / 4, THICKNESS, SPHERE.mdr_coefficient, SPHERE.exponent))

    def known(self, load) -> reference.Contact:
        """By the integral equation; a half-space is a layer of a million times the thickness."""
        layer = self.layer or Layer(thickness=1e6 * THICKNESS)
        return reference.of_load(SPHERE, layer, self.modulus, self.poisson_ratio, load)


HALF_SPACE, FILM = Rubber(None, 0.5), Rubber("bonded", 0.5)
RUBBERS = (HALF_SPACE, FILM, Rubber("bonded", 0.45), Rubber("bonded", 0.3), Rubber("frictionless", 0.5))
SLID = (HALF_SPACE, FILM, Rubber("bonded", 0.3))


def tasks() -> list[Task]:
    """Pairs of loads for stiffness, sliding at several speeds, and rough surfaces."""
    pairs = (task for rubber in RUBBERS for force in FORCES for task in _pair(rubber, force))
    return [*pairs, *_slid().values(), *_rough().values()]


def chapter(outcomes: Mapping[AnyTask, Outcome]) -> Chapter:
    """What becomes of both sides of F*."""
    found = [_stiffness(rubber, force, outcomes) for rubber in RUBBERS for force in FORCES]
    slid = [_friction(*asked, outcomes[task]) for asked, task in _slid().items()]
    rows = [*found, *_exponents(found), *slid]
    rough = [{f"at {over:g} F*": _compared(outcomes, over) for over in ROUGH_OVER_F}]
    tables = {"Exponents of the stiffness": _table(rows), "Friction over the half-space": rough}
    return Chapter(tables, {drawing.NAME: drawing.figure(rows)}, {drawing.NAME: rows})


def _pair(rubber, force):
    solid = Elastic(MODULUS, poisson_ratio=rubber.poisson_ratio)
    scene = Scene(SPHERE, solid, Indent(load=force), layer=rubber.layer)
    return [
        Task(SOLVER, (replace(scene, motion=Indent(load=force * by)),), work=3.0) for by in (1 - APART, 1 + APART)
    ]


def _solid(rubber):
    return StandardLinearSolid(
        MODULUS, (1 + STIFFENING) * MODULUS, CREEP / (1 + STIFFENING), poisson_ratio=rubber.poisson_ratio
    )


def _sliding(rubber, memory, over, roughness=None):
    motion = Slide(speed=memory / CREEP, load=over * rubber.force)
    return Scene(SPHERE, _solid(rubber), motion, roughness, rubber.layer)


def _slid() -> dict[tuple[Rubber, float, float], Task]:
    """By rubber, memory and load over F*."""
    return {
        (rubber, memory, over): Task(SLIDING, (_sliding(rubber, memory * THICKNESS, over),), work=10.0)
        for rubber in SLID
        for memory in MEMORIES
        for over in OVER_F
    }


def _rough():
    """By rubber, load over F* and surface."""
    memory = ROUGH_MEMORY * ROUGHNESS.shortest
    return {
        (rubber, over, seed): Task(
            ROUGH, (_sliding(rubber, memory, over, replace(ROUGHNESS, seed=seed)),), work=40.0
        )
        for rubber in SLID
        for over in ROUGH_OVER_F
        for seed in range(SURFACES)
    }


def _slope(outcomes, pair):
    """dF/dd between two loads [N/m]."""
    below, above = (outcomes[task].rows[0] for task in pair)
    return (above.normal_force - below.normal_force) / (above.depth - below.depth)


def _stiffness(rubber, force, outcomes):
    """Stiffness at a load, of the solver and as known, in the same difference."""
    known = [rubber.known(force * by) for by in (1 - APART, 1 + APART)]
    unit = 2 * rubber.modulus * THICKNESS / 2
    return {
        "quantity": "stiffness",
        "rubber": rubber.name,
        "x": force / rubber.force,
        "force": force,
        "found": _slope(outcomes, _pair(rubber, force)) / unit,
        "known": (known[1].load - known[0].load) / (known[1].depth - known[0].depth) / unit,
        "radius": rubber.known(force).radius,
    }


def _exponents(found) -> Rows:
    """Between neighbours of the same rubber."""
    rows = []
    for one, other in pairwise(found):
        if one["rubber"] != other["rubber"]:
            continue
        step = log(other["x"] / one["x"])
        rows.append(
            {
                "quantity": "exponent",
                "rubber": one["rubber"],
                "x": float(np.sqrt(one["x"] * other["x"])),
                "force": float(np.sqrt(one["force"] * other["force"])),
                "found": float(np.log(other["found"] / one["found"]) / step),
                "known": float(np.log(other["known"] / one["known"]) / step),
                "radius": other["radius"],
            }
        )
    return rows


def _friction(rubber, memory, over, outcome):
    """Friction over that at low speed."""
    slow = memory * THICKNESS / CREEP * mean_lag(_solid(rubber)) / SPHERE.radius
    return {
        "quantity": f"friction {memory:g}",
        "rubber": rubber.name,
        "x": over,
        "force": over * rubber.force,
        "found": outcome.rows[0].friction_coefficient / slow,
        "known": 1.0,
        "radius": float("nan"),
    }


def _table(rows) -> Rows:
    """A row a rubber, a column a load."""
    table = []
    for rubber in RUBBERS:
        own = [row for row in rows if row["quantity"] == "exponent" and row["rubber"] == rubber.name]
        cells = {
            f"{float(format(row['force'], '.2g')):g} N": f"{row['found']:.3f} ({row['known']:.3f})"
            for row in own[1::2]
        }
        table.append({"3D (integral equation)": rubber.name} | cells)
    return table


def _compared(outcomes, over):
    """Friction of the rough sphere over that on the half-space, surface by surface."""
    tasks = _rough()
    on_film, on_half_space = (
        np.array([outcomes[tasks[rubber, over, seed]].rows[0].friction_coefficient for seed in range(SURFACES)])
        for rubber in (FILM, HALF_SPACE)
    )
    return mean(on_film / on_half_space)
