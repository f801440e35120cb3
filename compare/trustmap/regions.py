"""Regions of the map in words, each a condition on groups: where errors and advice are stated."""

from collections.abc import Callable, Iterator, Mapping
from itertools import product
from math import log

import numpy as np

# Height over depth from which a depth is lost in a roughness that touches in part.
LOST = 0.3
Columns = Mapping[str, np.ndarray]
Condition = Callable[[Columns], np.ndarray]

BODIES: dict[str, Condition] = {
    "cone": lambda g: g["shape"] == 1,
    "sphere": lambda g: g["shape"] == 0.5,
    "other powers": lambda g: (g["shape"] != 1) & (g["shape"] != 0.5),
}
SHAPES: dict[str, Condition] = {
    "cone": BODIES["cone"],
    "n from 1 to 2": lambda g: (g["shape"] < 1) & (g["shape"] > 0.5),
    "sphere": BODIES["sphere"],
    "blunt, n > 2": lambda g: g["shape"] < 0.5,
}
# Flat: the smooth contact presses harder than the waves resist. Slow and fast: G''(v/a) against a tenth of G_0.
FLOWS: dict[str, Condition] = {
    "slow": lambda g: g["lost_contact"] < log(0.1),
    "fast": lambda g: g["lost_contact"] >= log(0.1),
}
SPEEDS: dict[str, Condition] = {
    "at rest": lambda g: ~g["slides"],
    "slow": lambda g: g["slides"] & FLOWS["slow"](g),
    "fast": lambda g: g["slides"] & FLOWS["fast"](g),
}
ROUGHNESS: dict[str, Condition] = {
    "pressed flat": lambda g: g["sliding_pressure"] >= 0,
    "touching in part": lambda g: (g["sliding_pressure"] < 0) & (g["sliding_height"] < log(LOST)),
    "as high as the body is deep": lambda g: (g["sliding_pressure"] < 0) & (g["sliding_height"] >= log(LOST)),
}
SOLIDS: dict[str, Condition] = {
    "Kelvin-like, E_g > 10^4 E_r": lambda g: g["stiffening"] > log(1e4),
    "E_g 10^2 to 10^4 E_r": lambda g: (g["stiffening"] <= log(1e4)) & (g["stiffening"] > log(1e2)),
    "E_g up to 10^2 E_r": lambda g: g["stiffening"] <= log(1e2),
}
WAVES: dict[str, Condition] = {
    "less than 2 waves on the radius": lambda g: g["sliding_waves"] < log(2),
    "2 to 6 waves": lambda g: (g["sliding_waves"] >= log(2)) & (g["sliding_waves"] < log(6)),
    "more than 6 waves": lambda g: g["sliding_waves"] >= log(6),
}
PRESCRIBED: dict[str, Condition] = {
    "load": lambda g: g["prescribed"] == 0,
    "depth": lambda g: g["prescribed"] == 1,
}
SURFACES: dict[str, Condition] = {
    "spectrum": lambda g: (g["side"] == 0) & (g["gaussian"] == 0),
    "as measured": lambda g: (g["side"] > 0) | (g["gaussian"] > 0),
}
REGIONS = {"body": SHAPES, "speed": SPEEDS, "roughness": ROUGHNESS, "solid": SOLIDS, "waves": WAVES}
# What coverage is stated by, and in what parts intervals are widened: there rest is as slow as can be.
COVERED = {"speed": SPEEDS, "roughness": ROUGHNESS, "prescribed": PRESCRIBED, "body": SHAPES}
WIDENED = COVERED | {"speed": FLOWS}


def parts(
    kinds: Mapping[str, Mapping[str, Condition]], groups: Columns
) -> Iterator[tuple[tuple[str, ...], np.ndarray]]:
    """Names of each combination of regions, one of each kind, and the mask of its scenes."""
    for named in product(*(regions.items() for regions in kinds.values())):
        yield tuple(name for name, _ in named), np.all([condition(groups) for _, condition in named], axis=0)
