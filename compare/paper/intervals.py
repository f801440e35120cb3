"""Intervals of what follows from averages over profiles, by leaving out one profile at a time (Tukey 1958).

The same profiles stand behind all points: each is left out everywhere at once. With Student's quantile the number
is inside as often as stated from three profiles on; percentiles of resampled profiles would be too narrow there.
"""

import numpy as np
from scipy import stats


def left_out(samples: np.ndarray) -> np.ndarray:
    """Averages over the profiles, the last axis, without one: (..., profiles) from (..., profiles)."""
    count = samples.shape[-1]
    return (samples.sum(axis=-1, keepdims=True) - samples) / (count - 1)


def standard_error(without: np.ndarray) -> np.ndarray:
    """Of a number, from its values (profiles, ...) each found without one profile."""
    return np.std(without, axis=0) * np.sqrt(len(without) - 1)


def interval(value: float, error: float, freedom: int) -> tuple[float, float]:
    """Of 95 %, from a standard error known with so many degrees of freedom."""
    half = error * stats.t.ppf(0.975, freedom)
    return float(value - half), float(value + half)
