"""One scene on many rough profiles, solved in one dimension, and how far a formula is from it."""

from dataclasses import replace
from functools import lru_cache
from math import ceil

import numpy as np

from compare.statistics.jackknife import mean_ratio
from mdr1d import MDR, draw
from mdr1d import equations as eq
from scene import Cone, Regime, Result, Scene, SelfAffine, Sphere
from scene.scales import elastic_contact

PROFILES = 20
# Points on the shortest wave where it is resolved, and on the paper's period where the grid is the cut-off.
RESOLVED, PAPER = 16, 5000


def pixels(rough: SelfAffine) -> int:
    """Points a period."""
    return PAPER if rough.shortest is None else RESOLVED * round(rough.longest / rough.shortest)


def solve(scene: Scene, points: int | None = None) -> list[Result]:
    """The scene on the profiles of seeds 0, 1, ..., so many points a period, on a grid that holds the contact."""
    smooth, rough = elastic_contact(scene), scene.roughness
    # A peak of the profile stands 5 rms heights high at most.
    reach = smooth.radius * (1 + 5 * rough.rms_height / smooth.depth)
    periods = ceil(2 * reach / rough.longest)
    solver = MDR(points=(points or pixels(rough)) * periods, extent=rough.longest * periods)
    return [solver.solve(replace(scene, roughness=replace(rough, seed=seed))) for seed in range(PROFILES)]


def measured(results: list[Result], name: str) -> np.ndarray:
    """One measure of all results."""
    return np.array([result.measures[name] for result in results])


def friction(results: list[Result]) -> np.ndarray:
    """mu of all results."""
    return np.array([result.friction_coefficient for result in results])


def deviation(expected, found) -> str:
    """Ratio of the means over the profiles, less one, and its standard error; from 10 on the ratio."""
    over = mean_ratio(expected, found)
    ratio, error = over.value, over.error
    if ratio >= 10:
        return f"× {ratio:.3g} ± {error:.2g}"
    digits = 0 if error >= 0.02 or ratio >= 2 else 1
    return f"{ratio - 1:+.{digits}%} ± {error:.{digits}%}"


@lru_cache
def mean_slope(rough: SelfAffine, points: int) -> float:
    """rms slope by finite differences, mean over the profiles."""
    return float(np.mean([draw(replace(rough, seed=seed), points).rms_slope for seed in range(PROFILES)]))


def steep(rough: SelfAffine, slope: float) -> SelfAffine:
    """The roughness with another spectral rms slope."""
    return replace(rough, rms_height=rough.rms_height * slope / rough.rms_slope(rough.q_max(0.0)))


def profile(shape: Sphere | Cone) -> tuple[float, float]:
    """c and n of the mapped profile."""
    return shape.mdr_coefficient, shape.exponent


def speed_at(xi: float, shape: Sphere | Cone, load: float, slope: float, modulus: float, time: float) -> float:
    """Speed [m/s] at a value of Eq. 18."""
    return xi / eq.similarity_variable(load, modulus, time, 1.0, slope, *profile(shape))


def broken(scene: Scene, slope: float) -> str:
    """Conditions of the paper that the scene does not meet."""
    contact, rough = elastic_contact(scene), scene.roughness
    size = contact.radius, contact.depth
    regime = Regime.of(profile(scene.indenter), size, rough.rms_height, rough.longest, slope)
    return ", ".join(name for name, holds in regime.flags.items() if not holds) or "none"
