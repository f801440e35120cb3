"""Regions of the map in words, each a condition on groups, in which intervals are widened."""

from collections.abc import Callable, Iterator, Mapping
from itertools import product
from math import log

import numpy as np

# Height over depth from which a depth is lost in a roughness that touches in part.
LOST = 0.3
Columns = Mapping[str, np.ndarray]
Condition = Callable[[Columns], np.ndarray]

SHAPES: dict[str, Condition] = {
    "cone": lambda g: g["shape"] == 1,
    "n from 1 to 2": lambda g: (g["shape"] < 1) & (g["shape"] > 0.5),
    "sphere": lambda g: g["shape"] == 0.5,
    "blunt, n > 2": lambda g: g["shape"] < 0.5,
}
# Slow and fast: G''(v/a) against a tenth of G_0; rest is as slow as can be.
FLOWS: dict[str, Condition] = {
    "slow": lambda g: g["lost_contact"] < log(0.1),
    "fast": lambda g: g["lost_contact"] >= log(0.1),
}
# Flat: the smooth contact presses harder than the waves resist.
ROUGHNESS: dict[str, Condition] = {
    "pressed flat": lambda g: g["sliding_pressure"] >= 0,
    "touching in part": lambda g: (g["sliding_pressure"] < 0) & (g["sliding_height"] < log(LOST)),
    "as high as the body is deep": lambda g: (g["sliding_pressure"] < 0) & (g["sliding_height"] >= log(LOST)),
}
PRESCRIBED: dict[str, Condition] = {
    "load": lambda g: g["prescribed"] == 0,
    "depth": lambda g: g["prescribed"] == 1,
}
WIDENED = {"speed": FLOWS, "roughness": ROUGHNESS, "prescribed": PRESCRIBED, "body": SHAPES}


def parts(
    kinds: Mapping[str, Mapping[str, Condition]], groups: Columns
) -> Iterator[tuple[tuple[str, ...], np.ndarray]]:
    """Names of each combination of regions, one of each kind, and the mask of its scenes."""
    for named in product(*(regions.items() for regions in kinds.values())):
        yield tuple(name for name, _ in named), np.all([condition(groups) for _, condition in named], axis=0)
