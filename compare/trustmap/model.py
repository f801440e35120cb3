"""Model of a quantity: its ratio of 1D over 3D from groups, learned from scenes that both have solved."""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from math import log
from typing import NamedTuple, TypeAlias

import numpy as np
from scipy.special import digamma, polygamma

from scene import Scene

from .groups import DimensionlessGroups
from .regression import Process, Scales

# Ratios that are learned: friction, depth and force of 1D over those of 3D, and friction by the law over 3D.
QUANTITIES = "friction", "depth", "force"
LAW = "law"
RATIOS = (*QUANTITIES, LAW)


def asked_of(scene: Scene) -> tuple[str, ...]:
    """Ratios that a scene has: of friction if it slides, of depth under a load, of force at a depth."""
    free = "depth" if scene.motion.pressed_by == "load" else "force"
    return ("friction", LAW, free) if scene.motion.speed else (free,)


# Height over depth from which a depth is lost in a roughness that touches in part.
LOST = 0.3
# Numbers of the regions of each kind in which intervals widen, see `regions_of`.
REGIONS = 2, 3, 2, 4


def regions_of(groups: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Regions (M,) that scenes are in, a number for each kind, from their groups by name.

    speed : 0 slow, 1 fast, by G''(v/a) against a tenth of G_0; rest is as slow as can be
    roughness : 0 pressed flat, where the smooth contact presses harder than the waves resist; 1 touching in part;
        2 touching in part and as high as the body is deep
    prescribed : 0 load, 1 depth
    body : 0 cone, 1 n from 1 to 2, 2 sphere, 3 blunt, n > 2
    """
    shape, high = groups["shape"], groups["sliding_height"] >= log(LOST)
    return {
        "speed": (groups["lost_contact"] >= log(0.1)).astype(int),
        "roughness": np.where(groups["sliding_pressure"] >= 0, 0, 1 + high),
        "prescribed": (groups["prescribed"] == 1).astype(int),
        "body": (shape < 1).astype(int) + (shape <= 0.5) + (shape < 0.5),
    }


NAMES = tuple(each.name for each in fields(DimensionlessGroups))
# Estimate in closed form, to which the model adds: exact where the body is smooth, and in full contact.
ESTIMATES = {"friction": "friction", "depth": "smooth_depth", "force": "smooth_force"}
# Groups with whose root what is left of a ratio goes, and so towards nothing as roughness does.
UNITS = {"friction": "doubt", LAW: "doubt", "depth": "sliding_height", "force": "sliding_height"}
# Change of the grid that is taken where half the points have no answer.
UNKNOWN_GRID = 0.02
LEAST_SURFACES = 3  # below which a measured ratio has no scatter
LEAST_VARIANCE = 1e-8
SCATTERED = 600  # scenes from which the scatter of single surfaces is learned
# How well a depth is known at best that is lost in the roughness: of the scenes left out fewer than 95 % lie in
# narrower intervals.
LEAST_LOST = 0.08
NORMAL = 1.959964
# Scatter from which on one surface in forty has no value above zero, so that the interval has no end.
MOST_SCATTER = 1 / NORMAL
# Inputs, values and variances of a process.
Points: TypeAlias = tuple[np.ndarray, np.ndarray, np.ndarray]


class Predicted(NamedTuple):
    """Logarithm of the ratio, its standard error, and the relative scatter of single surfaces (M,)."""

    logarithm: np.ndarray
    error: np.ndarray
    scatter: np.ndarray


@dataclass(frozen=True)
class Measurements:
    """Ratios of a quantity, mean over profiles in 1D over mean over surfaces in 3D, as measured on scenes.

    groups : of each scene (N, D), in the order of NAMES
    logarithm : of the ratio (N,); nan where one of the means is not above zero
    line_error : relative standard error of the mean in 1D (N,)
    scatter : relative standard deviation of a single surface in 3D (N,); nan with fewer than two
    surfaces : in 3D that would know their mean as well, if all of them were on all points (N,)
    grid : relative change of the mean in 3D from half the points to all (N,)
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
        """Variance of each logarithm. scatter : predicted for single surfaces, as four of them hardly show it"""
        grid = np.nan_to_num(self.grid, nan=UNKNOWN_GRID)
        return np.maximum(self.line_error**2 + scatter**2 / self.surfaces + grid**2 / 2, LEAST_VARIANCE)


@dataclass(frozen=True, eq=False)
class Fitted:
    """Fitted part of a model; the measurements are the other part.

    process : scales of what is measured beyond the estimate in closed form
    taken : numbers of the scenes that the process goes through, among all that were measured
    scatter : scales of the logarithm of the scatter of single surfaces
    errors, widening : standard errors of the process (K,), and factors on them under which 95 % hold
    parts : further factors (P,), at least 1, one for each combination of REGIONS
    """

    process: Scales
    taken: np.ndarray
    scatter: Scales
    errors: np.ndarray
    widening: np.ndarray
    parts: np.ndarray

    def widened(self, error: np.ndarray, groups: np.ndarray) -> np.ndarray:
        """Standard errors of the process (M,) at groups (M, D), as wide as those left out ask for."""
        error = error * np.interp(np.log(error), np.log(self.errors), self.widening)
        return error * self.parts[region_of(groups)]


@dataclass(frozen=True, eq=False)
class Model:
    """Model of the ratio of a quantity.

    process, scatter : through what was measured, see `Fitted`
    """

    quantity: str
    process: Process
    scatter: Process
    fitted: Fitted

    @classmethod
    def of(cls, quantity: str, measured: Measurements, fitted: Fitted) -> "Model":
        """Model of measurements to which it was fitted."""
        scatter = Process(*scattered(measured.taken(usable(measured))), fitted.scatter)
        process = Process(*learned(quantity, measured.taken(fitted.taken), scatter), fitted.process)
        return cls(quantity, process, scatter, fitted)

    def predicted(self, groups: np.ndarray) -> Predicted:
        """Ratios at groups (M, D)."""
        rest, variance = self.process.predicted(groups)
        unit = scale(self.quantity, groups)
        error = self.fitted.widened(np.sqrt(variance), groups) * unit
        if self.quantity == "depth":
            error = np.where(lost(groups), np.maximum(error, LEAST_LOST), error)
        return Predicted(estimate(self.quantity, groups) + rest * unit, error, self.surface_scatter(groups))

    def surface_scatter(self, groups: np.ndarray) -> np.ndarray:
        """Relative scatter (M,) of single surfaces at groups (M, D)."""
        logarithm, variance = self.scatter.predicted(groups)
        return np.exp(logarithm + variance / 2)


def lost(groups: np.ndarray) -> np.ndarray:
    """Scenes (M,) whose depth is lost in a roughness that touches in part and is as high as the body is deep."""
    height, pressure = (groups[:, NAMES.index(name)] for name in ("sliding_height", "sliding_pressure"))
    return (height > log(LOST)) & (pressure < 0)


def estimate(quantity: str, groups: np.ndarray) -> np.ndarray:
    """Estimates in closed form of the logarithm of the ratio (M,); the law is one itself."""
    return groups[:, NAMES.index(ESTIMATES[quantity])] if quantity in ESTIMATES else np.zeros(len(groups))


def scale(quantity: str, groups: np.ndarray) -> np.ndarray:
    """Unit (M,) in which a process learns what is beyond the estimate."""
    return np.exp(groups[:, NAMES.index(UNITS[quantity])] / 2)


def usable(measured):
    """Numbers of the scenes that have a ratio and enough surfaces."""
    return np.flatnonzero(np.isfinite(measured.logarithm) & (measured.surfaces >= LEAST_SURFACES))


def scattered(measured) -> Points:
    """Groups, logarithms of the scatter without the bias of few surfaces, and their variances: of chi squared."""
    known = np.flatnonzero(measured.scatter > 0)
    known = known[np.linspace(0, known.size - 1, min(SCATTERED, known.size)).astype(int)]
    measured = measured.taken(known)
    half = (measured.surfaces - 1) / 2
    unbiased = np.log(measured.scatter) - (digamma(half) - np.log(half)) / 2
    return measured.groups, unbiased, polygamma(1, half) / 4


def learned(quantity, measured, scatter) -> Points:
    """Groups, what was measured beyond the estimate, and its variance."""
    variance = measured.variance(np.exp(scatter.mean(measured.groups)))
    beyond, unit = measured.logarithm - estimate(quantity, measured.groups), scale(quantity, measured.groups)
    return measured.groups, beyond / unit, variance / unit**2


def region_of(groups: np.ndarray) -> np.ndarray:
    """Number (M,) of the combination of regions that scenes of groups (M, D) are in."""
    return np.ravel_multi_index([*regions_of(dict(zip(NAMES, groups.T, strict=True))).values()], REGIONS)
