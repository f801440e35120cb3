"""Every effect alone: how a scene file asks for it, and which solver simulates it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from pydantic import TypeAdapter

from bem3d.surface import RoughSurface
from scene import Scene, SelfAffine, Solver

SCENES = TypeAdapter(Scene)
PLAIN: Mapping[str, Any] = {
    "indenter": {"type": "sphere", "radius": 10e-3},
    "elastomer": {
        "type": "standard-linear-solid",
        "rubbery_modulus": 1e6,
        "glassy_modulus": 10e6,
        "relaxation_time": 1e-3,
    },
    "motion": {"type": "slide", "speed": 0.1, "load": 1.0},
}
ROUGH: Mapping[str, Any] = {
    "type": "self-affine",
    "hurst": 0.8,
    "rms_height": 5e-6,
    "longest": 4e-3,
    "shortest": 0.25e-3,
    "seed": 1,
}
WARM = {"type": "wlf", "temperature": 301.0, "reference": 300.0, "c1": 10.0, "c2": 100.0}
PRESSED, SLID = {"duration": 1e-3, "load": 1.0}, {"duration": 1e-3, "speed": 0.1}
# Pixels a side of the measured surface, as many as the shortest wave of ROUGH needs and more.
PIXELS = 128


@dataclass(frozen=True)
class Effect:
    """One effect, on a plain contact.

    title : for people
    tables : what a file states for it, by the name of the table, in place of those of PLAIN
    over : title of the effect that it comes on top of
    parts : names of the types whose costs in a plan are multiplied by what this one took
    """

    title: str
    tables: Mapping[str, Any] = field(default_factory=dict)
    over: str | None = None
    parts: tuple[str, ...] = ()

    @property
    def scene(self) -> Scene:
        """What a solver is asked."""
        return SCENES.validate_python({**PLAIN, **self.tables})

    @property
    def file(self) -> str:
        """Lines of a scene file, one a table."""
        return "\n".join(f"{name} = {_inline(table)}" for name, table in self.tables.items())

    def verdict(self, solver: Solver) -> str:
        """Whether a solver simulates it, or why not."""
        reasons = solver.refusals(self.scene)
        return f"refused: {'; '.join(reasons)}" if reasons else "simulated"


def measured() -> np.ndarray:
    """A map of heights (PIXELS, PIXELS) [m] in place of a measured one: drawn from ROUGH, over a period."""
    rough = SelfAffine(**ROUGH)
    places = np.arange(PIXELS) / PIXELS * rough.longest
    return RoughSurface.of(rough, rough.q_max(rough.longest / PIXELS)).heights(places, places)


def effects() -> tuple[Effect, ...]:
    """All of them, plain contacts first."""
    topography = {
        "type": "topography",
        "heights": measured(),
        "pixel": ROUGH["longest"] / PIXELS,
        "repeat": "periodic",
        "level": "mean",
        "shortest_kept": ROUGH["shortest"],
    }
    rest = {"type": "indent", "load": 1.0}
    shear = {"type": "shear", "load": 1.0, "displacement": 2e-5}
    there_and_back = [PRESSED, SLID, {**SLID, "speed": -0.1}]
    swinging = [PRESSED, {**SLID, "amplitude": 0.2, "frequency": 2000.0}]
    cell = {"type": "slide", "speed": 0.1, "pressure": 2e4}
    return (
        Effect("steady sliding"),
        Effect("contact at rest", {"motion": rest}),
        Effect("roughness", {"roughness": ROUGH}, "steady sliding"),
        Effect("measured topography", {"roughness": topography}, "roughness", ("Topography",)),
        Effect("plane", {"indenter": {"type": "plane"}, "motion": cell, "roughness": ROUGH}, "roughness"),
        Effect("layer", {"layer": {"thickness": 2e-3}}, "steady sliding", ("Layer",)),
        Effect("temperature", {"temperature": WARM}, "steady sliding", ("WLF", "Arrhenius")),
        Effect("heating, estimated", {"heating": {"conductivity": 50.0}}, "steady sliding", ("Heating",)),
        Effect(
            "heating, fed back",
            {"temperature": WARM, "heating": {"conductivity": 0.2, "feedback": "average"}},
            "temperature",
        ),
        Effect("friction in the interface", {"interface": {"coefficient": 0.3}}, "steady sliding", ("Coulomb",)),
        Effect(
            "partial slip", {"motion": shear, "interface": {"coefficient": 0.3}}, "contact at rest", ("Shear",)
        ),
        Effect(
            "program",
            {"motion": {"type": "program", "stages": [PRESSED, SLID]}},
            "contact at rest",
            ("Program",),
        ),
        Effect(
            "reversal",
            {"motion": {"type": "program", "stages": there_and_back}},
            "program",
        ),
        Effect(
            "oscillation",
            {"motion": {"type": "program", "stages": swinging}},
            "program",
        ),
    )


def _inline(value: Any) -> str:
    """As TOML writes it on one line; an array of heights stands in a file of its own."""
    match value:
        case Mapping():
            return "{" + ", ".join(_entry(name, each) for name, each in value.items()) + "}"
        case str():
            return f'"{value}"'
        case Sequence():
            return "[" + ", ".join(map(_inline, value)) + "]"
        case _:
            return repr(value)


def _entry(name, value):
    return f'file = "{name}.npy", unit = "m"' if isinstance(value, np.ndarray) else f"{name} = {_inline(value)}"
