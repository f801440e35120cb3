"""The share of its friction in full contact that a rough plane keeps in partial contact, as measured on planes."""

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from math import prod
from pathlib import Path
from typing import Any

import numpy as np

from .bands import FullContact

FITTED = Path(__file__).with_name("share.csv")
# Between which pressures, over the rms pressure of full contact, it bends; below it is in proportion to them.
LEAST, MOST = 5e-3, 2.0


@dataclass(frozen=True)
class Share:
    """S(x) = 1 - exp{-x e^A (1 + B x) (x + 0.01)^C}, x the pressure over the rms pressure of full contact.

    Within the powers x is at least LEAST and at most MOST, so that S is in proportion to light pressures, and 1 in
    full contact.

    level, bend, power : A, B, C [1]
    """

    level: float
    bend: float
    power: float

    @classmethod
    def of(cls, full: FullContact) -> "Share":
        """Share of these waves, by the coefficients of `share.csv`."""
        return cls.summed(coefficients(), waves(full))

    @classmethod
    def summed(cls, values: Mapping[tuple[str, str], float], known: Mapping[str, Any]) -> "Share":
        """Share with A, B, C the sums of coefficients times numbers of waves, or products of these, as "a*b"."""
        sums: dict[str, Any] = {name: 0.0 for name in ("level", "bend", "power")}
        for (name, times), value in values.items():
            sums[name] = sums[name] + value * prod(known[each] for each in times.split("*"))
        return cls(**sums)

    def __call__(self, x: np.ndarray) -> np.ndarray:
        """Share at pressures x >= 0, of any shape."""
        inside = np.clip(x, LEAST, MOST)
        return -np.expm1(
            -x * np.exp(self.level) * np.maximum(1 + self.bend * inside, 0.05) * (inside + 0.01) ** self.power
        )


def waves(full: FullContact) -> dict[str, float]:
    """Numbers of waves in full contact that coefficients are multiplied by, by name."""
    names = "lossy", "along", "across", "shorter", "harder", "rising", "faster"
    return {"one": 1.0, **{name: getattr(full, name) for name in names}}


@cache
def coefficients() -> Mapping[tuple[str, str], float]:
    """Coefficients by what they add to, and what they are multiplied by."""
    with FITTED.open(encoding="utf-8", newline="") as file:
        return {(row["to"], row["times"]): float(row["value"]) for row in csv.DictReader(file)}
