"""Tables of points: means over profiles with intervals, and the conditions that the laws presuppose."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from pandas import DataFrame

from scene import Regime, Scene
from scene.scales import elastic_contact

from ...statistics.intervals import Estimated
from . import parameters

# A model that is linear and knows no length has the same contact whatever the scale of heights, slopes and loads:
# where slopes are not small the equations describe no body, but what they say of one another stands.
SCALE_FREE = "small slopes"
FLAG = "holds: "


def with_ends(name: str, found: Estimated) -> dict[str, Any]:
    """A number, or a column of them, and both ends of its interval of 95 %, by name."""
    low, high = found.interval()
    return {name: found.value, f"{name}_low": low, f"{name}_high": high}


def regime_of(scenes: Sequence[Scene], rms_slope: float | np.ndarray) -> Regime:
    """Ratios of contacts under a load, arrays (scenes,); rms_slope : of the roughness, of all or of each."""
    bodies, relaxed = [scene.indenter for scene in scenes], [elastic_contact(scene) for scene in scenes]
    profile = [np.array([getattr(body, name) for body in bodies]) for name in ("mdr_coefficient", "exponent")]
    contact = [np.array([getattr(each, name) for each in relaxed]) for name in ("radius", "depth")]
    heights = np.array([scene.roughness.rms_height for scene in scenes])
    return Regime.of(profile, contact, heights, parameters.LENGTH, rms_slope)


def with_conditions(
    points: DataFrame, regime: Regime, others: Mapping[str, tuple[str, np.ndarray, np.ndarray]] | None = None
) -> DataFrame:
    """Points with the ratios of their regime, a column for each condition, and whether all hold.

    `holds` leaves out the condition of small slopes, without which the model itself still is one.

    others : by the name of a further condition, the name of its ratio, the ratio, and where it holds
    """
    flags: dict[str, Any] = {}
    ratios: dict[str, Any] = dict(vars(regime))
    for condition, (name, ratio, flag) in (others or {}).items():
        ratios[name], flags[condition] = ratio, flag
    flags |= regime.flags
    shape = (len(points),)
    columns = {name: np.broadcast_to(ratio, shape) for name, ratio in ratios.items() if name not in points}
    columns |= {FLAG + name: np.broadcast_to(flag, shape) for name, flag in flags.items()}
    scale_bound = [np.broadcast_to(flag, shape) for name, flag in flags.items() if name != SCALE_FREE]
    return points.assign(**columns, holds=np.logical_and.reduce(scale_bound))


def between(values) -> str:
    """Least and greatest of some numbers, in words."""
    low, high = np.nanmin(values), np.nanmax(values)
    return f"{low:.2g}" if np.isclose(low, high, rtol=1e-6) else f"{low:.2g} to {high:.2g}"
