"""Regions of the map in words, each a condition on groups: where errors and advice are stated."""

from collections.abc import Callable, Mapping
from math import log

import numpy as np

from .model import LOST

Columns = Mapping[str, np.ndarray]
Condition = Callable[[Columns], np.ndarray]

BODIES: dict[str, Condition] = {
    "cone": lambda g: g["shape"] == 1,
    "sphere": lambda g: g["shape"] == 0.5,
    "other powers": lambda g: (g["shape"] != 1) & (g["shape"] != 0.5),
}
# Flat: the smooth contact presses harder than the waves resist. Slow and fast: G''(v/a) against a tenth of G_0.
SPEEDS: dict[str, Condition] = {
    "at rest": lambda g: ~g["slides"],
    "slow": lambda g: g["slides"] & (g["lost_contact"] < log(0.1)),
    "fast": lambda g: g["slides"] & (g["lost_contact"] >= log(0.1)),
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
REGIONS = {"body": BODIES, "speed": SPEEDS, "roughness": ROUGHNESS, "solid": SOLIDS, "waves": WAVES}
