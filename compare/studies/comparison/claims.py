"""Claims on one scene and on series, each by its id, and what measures them: powers, means, places along xi."""

from dataclasses import replace
from math import isfinite
from pathlib import Path

import numpy as np

from scene.files.reading import parsed, text_of

from ...statistics.finding import Claim

_FILE = Path(__file__).with_suffix(".toml")
_ROWS = parsed(text_of(_FILE), _FILE)
# Claims in a few words, by their ids, in the order in which tables have them.
SHORT: dict[str, str] = {name: row.pop("short") for name, row in _ROWS.items() if "short" in row}
CLAIMS = {name: Claim(name, **row) for name, row in _ROWS.items() if row}
ENDS = "least", "greatest"  # load or depth at which a level is stated


def claim(name: str, expected: float | None = None) -> Claim:
    """Claim of an id, with the number that the law has in one place, and its tolerance in proportion."""
    found = CLAIMS[name]
    if expected is None:
        return found
    times = expected / found.expected if isfinite(found.expected) else 1.0
    return replace(found, expected=expected, tolerance=found.tolerance * times)


def power(abscissae: np.ndarray, values: np.ndarray) -> float:
    """d ln y / d ln x, least squares; NaN where any of them has no logarithm."""
    x, y = np.log(abscissae), np.log(values)
    lever = x - x.mean()
    return float(lever @ y / (lever @ lever))


def geometric(ratios: np.ndarray) -> float:
    """Geometric mean; NaN where any of them is not positive."""
    return float(np.exp(np.mean(np.log(ratios))))
