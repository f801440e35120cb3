"""Model of one quantity: the ratio of 1D over 3D from groups, learned from scenes that both have solved."""

from dataclasses import dataclass, fields, replace
from math import log
from typing import NamedTuple, TypeAlias

import numpy as np
from scipy.special import digamma, polygamma

from .groups import DimensionlessGroups
from .regions import LOST, WIDENED, parts
from .regression import Process, Scales

NAMES = tuple(each.name for each in fields(DimensionlessGroups))
# Estimate in closed form, of which the model learns the rest: exact where the body is smooth, and in full contact.
ESTIMATES = {"friction": "friction", "depth": "smooth_depth", "force": "smooth_force"}
# Change of the grid that is taken where half the points have no answer.
UNKNOWN_GRID = 0.02
# Noise beyond which a measured ratio says nothing, and surfaces below which it has no scatter.
MOST_NOISE, LEAST_SURFACES = 0.25, 3
LEAST_VARIANCE = 1e-8
# Scenes from which the scatter of one surface is learned, and scenes of like error whose intervals widen alike.
SCATTERED, ALIKE = 600, 150
# Share of the scenes left out that is to lie within, and that in a region of enough scenes: so large that 95 % of
# those lie within to which no scale was fitted.
HELD, HELD_IN_PART, FEWEST = 0.95, 0.97, 40
# Least factor on an error: noise that is larger says little of it.
LEAST_FACTOR = 0.5
# How well a depth is known at best that is lost in the roughness: of the scenes left out fewer than 95 % lie in
# narrower intervals.
LEAST_LOST = 0.08
NORMAL = 1.959964
# Scatter of one surface from which on one in forty has no value above zero, so that its interval has no end.
MOST_SCATTER = 1 / NORMAL
# Inputs, values and variances of a process.
Points: TypeAlias = tuple[np.ndarray, np.ndarray, np.ndarray]


class Predicted(NamedTuple):
    """Logarithm of the ratio, its standard error, and the relative scatter of one surface (M,)."""

    logarithm: np.ndarray
    error: np.ndarray
    scatter: np.ndarray

    @property
    def surface_told(self) -> np.ndarray:
        """Scenes (M,) of which one surface says something: its values are above zero."""
        return self.scatter < MOST_SCATTER


@dataclass(frozen=True)
class Measurements:
    """Ratios of one quantity as measured on scenes.

    groups : of each scene (N, D), in the order of NAMES
    logarithm : of the ratio (N,); nan where it has none
    line_error, scatter, grid : relative (N,), see `ratio.Ratio`
    surfaces : (N,)
    """

    groups: np.ndarray
    logarithm: np.ndarray
    line_error: np.ndarray
    scatter: np.ndarray
    surfaces: np.ndarray
    grid: np.ndarray

    def taken(self, chosen: np.ndarray) -> "Measurements":
        """Measurements on some scenes: a mask or numbers of scenes."""
        return Measurements(*(getattr(self, each.name)[chosen] for each in fields(self)))

    def variance(self, scatter: np.ndarray) -> np.ndarray:
        """Variance of each logarithm; scatter : of one surface as predicted, for four of them hardly know it."""
        grid = np.nan_to_num(self.grid, nan=UNKNOWN_GRID)
        return np.maximum(self.line_error**2 + scatter**2 / self.surfaces + grid**2 / 2, LEAST_VARIANCE)


@dataclass(frozen=True, eq=False)
class Fitted:
    """Fitted part of a model; the measurements are the other part.

    process : scales of what is measured beyond the estimate in closed form
    scatter : scales of the logarithm of the scatter of one surface
    errors, widening : standard errors of the process (K,), and factors on them under which 95 % hold
    parts : further factors (P,), at least 1, one for each of `regions.WIDENED`
    """

    process: Scales
    scatter: Scales
    errors: np.ndarray
    widening: np.ndarray
    parts: np.ndarray

    def widened(self, error: np.ndarray, groups: np.ndarray) -> np.ndarray:
        """Standard errors of the process (M,) at groups (M, D), as wide as those left out ask for."""
        error = error * np.interp(np.log(error), np.log(self.errors), self.widening)
        return error * np.prod(
            [np.where(here, factor, 1.0) for here, factor in zip(_parts(groups), self.parts, strict=True)], axis=0
        )


@dataclass(frozen=True, eq=False)
class Model:
    """Model of the ratio of one quantity.

    process, scatter : through what was measured, see `Fitted`
    """

    quantity: str
    process: Process
    scatter: Process
    fitted: Fitted

    @classmethod
    def of(cls, quantity: str, measured: Measurements, fitted: Fitted) -> "Model":
        """Model of measurements to which it was fitted."""
        measured = _usable(measured)
        scatter = Process(*_scattered(measured), fitted.scatter)
        return cls(quantity, Process(*_learned(quantity, measured, scatter), fitted.process), scatter, fitted)

    @classmethod
    def fit(cls, quantity: str, measured: Measurements) -> "Model":
        """Model fitted to measurements; takes minutes for two thousand scenes."""
        usable = _usable(measured)
        scatter = Process.fitted(*_scattered(usable))
        process = Process.fitted(*_learned(quantity, usable, scatter))
        return cls(quantity, process, scatter, _fitted(quantity, process, scatter))

    def predicted(self, groups: np.ndarray) -> Predicted:
        """Ratios at groups (M, D)."""
        rest, variance = self.process.predicted(groups)
        error = self.fitted.widened(np.sqrt(variance), groups)
        if self.quantity == "depth":
            error = np.where(lost(groups), np.maximum(error, LEAST_LOST), error)
        logarithm, spread = self.scatter.predicted(groups)
        return Predicted(estimate(self.quantity, groups) + rest, error, np.exp(logarithm + spread / 2))


def lost(groups: np.ndarray) -> np.ndarray:
    """Scenes (M,) whose depth is lost in a roughness that touches in part and is as high as the body is deep."""
    height, pressure = (groups[:, NAMES.index(name)] for name in ("sliding_height", "sliding_pressure"))
    return (height > log(LOST)) & (pressure < 0)


def estimate(quantity: str, groups: np.ndarray) -> np.ndarray:
    """Estimates in closed form of the logarithm of the ratio (M,)."""
    return groups[:, NAMES.index(ESTIMATES[quantity])]


def _usable(measured):
    return measured.taken(np.isfinite(measured.logarithm) & (measured.surfaces >= LEAST_SURFACES))


def _scattered(measured) -> Points:
    """Groups, logarithms of the scatter without the bias of few surfaces, and their variances: of chi squared."""
    known = np.flatnonzero(measured.scatter > 0)
    known = known[np.linspace(0, known.size - 1, min(SCATTERED, known.size)).astype(int)]
    measured = measured.taken(known)
    half = (measured.surfaces - 1) / 2
    unbiased = np.log(measured.scatter) - (digamma(half) - np.log(half)) / 2
    return measured.groups, unbiased, polygamma(1, half) / 4


def _learned(quantity, measured, scatter) -> Points:
    """Groups, what was measured beyond the estimate, and its variance, where the noise lets it say something."""
    variance = measured.variance(np.exp(scatter.mean(measured.groups)))
    telling = variance < MOST_NOISE**2
    measured = measured.taken(telling)
    return measured.groups, measured.logarithm - estimate(quantity, measured.groups), variance[telling]


def _fitted(quantity, process, scatter):
    """Fitted part of a model: factors by which errors grow for as many of the values left out to lie within."""
    error, variance = process.left_out()
    own, inputs = np.sqrt(np.maximum(variance - process.variances, LEAST_VARIANCE)), process.inputs
    # How wide each error has to be for its value to lie within, beside the noise of what was measured.
    needed = np.sqrt(np.maximum((error / NORMAL) ** 2 - process.variances, 0))
    counted = np.flatnonzero(~lost(inputs)) if quantity == "depth" else np.arange(own.size)
    alike = np.array_split(counted[np.argsort(own[counted])], max(1, counted.size // ALIKE))
    errors = np.array([np.median(own[few]) for few in alike])
    factors = np.array([max(LEAST_FACTOR, np.quantile(needed[few] / own[few], HELD)) for few in alike])
    found = Fitted(process.scales, scatter.scales, errors, factors, np.ones(len(_parts(inputs))))
    needed = needed / found.widened(own, inputs)
    regions = [needed[counted[here[counted]]] for here in _parts(inputs)]
    widest = [max(1.0, np.quantile(few, HELD_IN_PART)) if few.size >= FEWEST else 1.0 for few in regions]
    return replace(found, parts=np.array(widest))


def _parts(groups):
    """Mask of scenes (M,) of each of the regions in which intervals widen."""
    return [here for _, here in parts(WIDENED, dict(zip(NAMES, groups.T, strict=True)))]
