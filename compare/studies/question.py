"""Questions that one number answers, and the findings that come of them on two grids."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..finding import Finding
from ..statistics.jackknife import resample
from .sides import Pair, Side

BOTH = "1D/3D"
# How far from what is claimed still counts as it: what a reader of a diagram over decades of friction would not
# see, and less than what any measured roughness is known to.
TOLERANCE = 0.05
LEVELS, DEPTH, COLLAPSE = "study-levels", "study-depth", "study-collapse"
_ONE_SURFACE = "of one surface the scatter is not known"
_MISSING = "at some point fewer than half of the surfaces have an answer, or the mean is not positive"


@dataclass(frozen=True)
class Question:
    """A claim that one number decides.

    claim, expected, tolerance, text, figure : as of Finding
    statistic : of a Side or a Pair, a number or an array of which the rms counts
    """

    claim: str
    expected: float
    text: str
    statistic: Callable
    tolerance: float = TOLERANCE
    figure: str = LEVELS


def answered(question: Question, dimension: str, fine: Side | Pair, coarse: Side | Pair, regime: str) -> Finding:
    """The finding from a statistic on two grids; an array counts by its rms, without what scatter adds.

    Undecidable, with the reason, where the number or one of its errors is not known.
    """
    # What has no logarithm is not known, and said so below.
    with np.errstate(invalid="ignore", divide="ignore"):
        replicates = resample(lambda side: {"": question.statistic(side)}, fine)[""]
        other = np.asarray(question.statistic(coarse))
        measured = replicates.rms if np.ndim(replicates.value) else replicates.estimated
        low, high = measured.interval()
        grid = float(np.sqrt(np.mean(np.square(other - replicates.value))))
    return Finding(
        claim=question.claim,
        dimension=dimension,
        expected=question.expected,
        tolerance=question.tolerance,
        value=float(measured.value),
        statistical=(float(low), float(high)),
        grid=grid,
        surfaces=fine.surfaces,
        regime=regime,
        figure=question.figure,
        text=question.text,
        undecidable=_why(fine.surfaces, (measured.value, low, high, grid)),
    )


def power(abscissae: np.ndarray, values: np.ndarray) -> float:
    """d ln y / d ln x, least squares; NaN where any of them has no logarithm."""
    x, y = np.log(abscissae), np.log(values)
    lever = x - x.mean()
    return float(lever @ y / (lever @ lever))


def geometric(ratios: np.ndarray) -> float:
    """Geometric mean."""
    return float(np.exp(np.mean(np.log(ratios))))


def extent(values: np.ndarray) -> str:
    """Least and greatest of what is known, in words."""
    known = np.asarray(values)[np.isfinite(values)]
    return f"{known.min():.2g} to {known.max():.2g}" if known.size else "unknown"


def _why(surfaces, numbers):
    if np.all(np.isfinite(numbers)):
        return ""
    return _ONE_SURFACE if surfaces == 1 else _MISSING
