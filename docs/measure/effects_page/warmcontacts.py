"""Contacts of warmer and colder rubber, and of rubber that its own friction heats, as they are solved."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import product
from math import isfinite, nan
from typing import Literal

import numpy as np

from bem3d import BEM
from compare.solving.outcome import Outcome, Row
from compare.solving.task import SceneTask as Task
from compare.solving.task import Task as AnyTask
from mdr1d import MDR
from scene import WLF, Coulomb, Fractional, Heating, Scene, SelfAffine, Slide, Sphere, StandardLinearSolid
from scene.temperature import UNIVERSAL

SOLVERS: dict[str, MDR | BEM] = {"1D": MDR(points=1000), "3D": BEM(points=64)}
GLASS, ROOM = 223.0, 296.0  # [K]: where the rubber turns to glass, and where its moduli are stated
# The universal law, whose constants are stated at the glass transition, from room temperature.
C2 = UNIVERSAL["c2"] + ROOM - GLASS
LAW = WLF(temperature=ROOM, reference=ROOM, c1=UNIVERSAL["c1"] * UNIVERSAL["c2"] / C2, c2=C2)
SPHERE, MODULUS = Sphere(radius=50e-3), 3e6
# A law for all frequencies that are seen at all temperatures; its glassy modulus is 1.5 GPa.
POWER = Fractional(
    modulus=MODULUS,
    relaxation_time=1e-2,
    exponent=0.5,
    lowest_frequency=1e-6,
    highest_frequency=1e6,
    tolerance=1e-2,
)
TEMPERATURES = (260.0, 280.0, 296.0, 320.0)  # [K]
SPEEDS = tuple(float(v) for v in np.geomspace(1e-3, 1.0, 7))  # [m/s]
LOAD = 10.0  # [N]

# The experiment of the paper: friction of about a half, of which a smooth rubber loses little inside.
RUBBING = Coulomb(0.5)
FINE = SelfAffine(hurst=0.8, rms_height=1e-7, longest=20e-3, shortest=4e-3)
CONTACTS = ((1.0, 1e-2), (100.0, 1e-2), (100.0, 2e-2))  # [N], [m/s]
CONDUCTIVITIES = {"steel": 20.0, "polymer": 0.2}  # [W/(m K)]
FEEDBACKS: tuple[Literal["average", "flash"] | None, ...] = (None, "average", "flash")

# A rubber that is glassy where it slides fast: friction falls with the speed, and grows with the temperature.
STIFF = StandardLinearSolid(MODULUS, 100 * MODULUS, 0.05)
HEATED_SPEEDS = tuple(float(v) for v in np.geomspace(1e-3, 1.0, 13))  # [m/s]
WARMER = tuple(float(x) for x in np.geomspace(0.1, 200.0, 25))  # [K]
SEVERAL_AT = HEATED_SPEEDS[8]
HEAVY = 100.0  # [N]


@dataclass(frozen=True)
class Point:
    """One contact: what was asked, and what it came to; a row of the numbers beside the figure.

    panel : "temperature"; "partner", of the same reduced speed at the reference; "experiment"; "warmer"; "speed"
    temperature : of the scene [K]
    """

    panel: str
    dimension: str
    temperature: float
    speed: float
    load: float
    conductivity: float
    feedback: str
    friction: float
    average_heating: float
    flash_heating: float
    contact_temperature: float
    depth: float

    @property
    def reduced_speed(self) -> float:
        """Speed times a_T."""
        return self.speed * shift(self.temperature)


def scenes() -> dict[str, list[Scene]]:
    """By panel."""
    power = Scene(SPHERE, POWER, Slide(speed=1.0, load=LOAD), temperature=LAW)
    stiff = replace(power, elastomer=STIFF, motion=Slide(speed=1.0, load=HEAVY))
    cold = Heating(conductivity=CONDUCTIVITIES["polymer"])
    fed_back = replace(cold, feedback="average")
    return {
        "temperature": [_at(power, t, v) for t, v in product(TEMPERATURES, SPEEDS)],
        "partner": [_at(power, ROOM, v * shift(t)) for t, v in product(TEMPERATURES, SPEEDS)],
        "experiment": [
            replace(
                power,
                motion=Slide(speed=speed, load=load),
                roughness=FINE,
                interface=RUBBING,
                heating=Heating(conductivity=conductivity, feedback=feedback),
            )
            for conductivity in CONDUCTIVITIES.values()
            for load, speed in CONTACTS
            for feedback in FEEDBACKS
        ],
        "warmer": [replace(_at(stiff, ROOM + x, SEVERAL_AT), heating=cold) for x in (0.0, *WARMER)],
        "speed": [
            replace(_at(stiff, ROOM, v), heating=heating) for v in HEATED_SPEEDS for heating in (cold, fed_back)
        ],
    }


def _at(scene, temperature, speed):
    law, motion = replace(LAW, temperature=temperature), replace(scene.motion, speed=speed)
    return replace(scene, temperature=law, motion=motion)


def shift(temperature: float) -> float:
    """a_T at a temperature [K]; NaN where that is."""
    return replace(LAW, temperature=temperature).shift if isfinite(temperature) else nan


def every() -> list[Task]:
    """Every scene in both dimensionalities, each once."""
    asked = [_task(solver, scene) for part in scenes().values() for scene in part for solver in SOLVERS.values()]
    return list(dict.fromkeys(asked))


def _task(solver, scene):
    solves = 6.0 if scene.heating is not None and scene.heating.feedback else 1.0
    return Task(solver, (scene,), work=solves * (1e6 if solver.name == "BEM" else 1e4))


def points(outcomes: Mapping[AnyTask, Outcome]) -> list[Point]:
    """Everything that was solved; what failed is NaN."""
    return [
        _point(panel, dimension, scene, outcomes[_task(solver, scene)].rows[0])
        for panel, part in scenes().items()
        for scene in part
        for dimension, solver in SOLVERS.items()
    ]


def _point(panel, dimension, scene, row: Row):
    heating = scene.heating
    return Point(
        panel=panel,
        dimension=dimension,
        temperature=scene.temperature.temperature,
        speed=scene.motion.speed,
        load=scene.motion.load,
        conductivity=heating.conductivity if heating else nan,
        feedback=(heating.feedback or "") if heating else "",
        friction=row.friction_coefficient,
        average_heating=row.measures.get("average_heating", nan),
        flash_heating=row.measures.get("flash_heating", nan),
        contact_temperature=row.measures.get("temperature", nan),
        depth=row.depth,
    )
