"""Regime of each point of a study: the ratios of a rough contact that decide which laws can hold."""

from collections.abc import Mapping
from math import pi
from typing import Any

import numpy as np

from scene import Indent, Regime, Scene, Slide
from scene.indenter import Axisymmetric
from scene.scales import elastic_contact

from ...models.exact import mean_lag

# Ratios by the order in which words tell them, behind load and speed.
SYMBOLS = {
    "depth_over_height": "d/h₀",
    "shortest_in_contact": "a q_s",
    "contact_over_period": "2a/L",
    "macro_over_rough": "macro/rough slope",
    "rms_slope": "rms slope",
    "pressure_over_slope": "p/(E* h')",
    "memory_over_contact": "vτ/a",
    "memory_over_shortest": "vτ q_s",
    "contact_fraction": "contact",
}
_TOLD = {"load": "F_N", "xi": "ξ", **SYMBOLS}
_UNITS = {"load": (1, " N", 3), "contact_fraction": (100, " %", 2)}  # scale, unit and digits of what has any


def ratios(scene: Scene, measures: Mapping[str, float]) -> dict[str, float]:
    """Ratios of a rough body of revolution that is pressed in or slides steadily, by name; NaN of a NaN measure.

    Radius a, depth d and load F_N are those of the smooth relaxed contact at the same load or depth; q_s is the
    highest wave number of the roughness, h' its rms slope as the solver measures it. The time tau is the mean lag
    of the elastomer, for a Kelvin body its relaxation time: v tau q_s is then the loss tangent of the shortest
    wave at low speed, whereas the longest retardation time may be that of a mode with next to no compliance.

    depth_over_height : d / h_0
    shortest_in_contact : a q_s
    pressure_over_slope : mean pressure over E* h', F_N / (pi a^2 E* h')
    memory_over_contact, memory_over_shortest : v tau / a and v tau q_s, zero at rest
    contact_fraction : real over nominal contact, of area pi a^2 in three dimensions, of length 2a in one
    contact_over_period, macro_over_rough, rms_slope : see scene.Regime

    measures : of its answer, or their means over surfaces: rms_slope, pixel [m], and contact_area [m^2] in three
        dimensions or contact_length [m] in one

    Raises ValueError where the scene is another, KeyError where a measure is missing.
    """
    body, rough, motion = scene.indenter, scene.roughness, scene.motion
    if not (isinstance(body, Axisymmetric) and rough and not rough.flat and isinstance(motion, Indent | Slide)):
        raise ValueError(f"scene = {scene!r}: these ratios are of a rough body of revolution, in Indent or Slide")
    smooth, slope = elastic_contact(scene), measures["rms_slope"]
    a, q_s, memory = smooth.radius, rough.q_max(measures["pixel"]), motion.speed * mean_lag(scene.solid)
    profile = body.mdr_coefficient, body.exponent
    regime = Regime.of(profile, (a, smooth.depth), rough.rms_height, rough.period, slope)
    in_3d = "contact_area" in measures
    return {
        "depth_over_height": 1 / regime.height_over_depth,
        "shortest_in_contact": a * q_s,
        "pressure_over_slope": smooth.load / (pi * a**2 * scene.solid.indentation_modulus * slope),
        "memory_over_contact": memory / a,
        "memory_over_shortest": memory * q_s,
        "contact_fraction": (
            measures["contact_area"] / (pi * a**2) if in_3d else measures["contact_length"] / (2 * a)
        ),
        "contact_over_period": regime.contact_over_period,
        "macro_over_rough": regime.macro_over_rough,
        "rms_slope": regime.rms_slope,
    }


def words(found: Mapping[str, Any]) -> str:
    """Ranges of load [N], xi and ratios, numbers or arrays, for a table; without what is zero or unknown."""
    said = []
    for name in (name for name in _TOLD if name in found):
        symbol, (scale, unit, digits) = _TOLD[name], _UNITS.get(name, (1, "", 2))
        values = scale * np.asarray(found[name], float)
        if reach := _range(values[np.isfinite(values)], digits):
            said.append(f"{symbol} {reach}{unit}")
    return ", ".join(said)


def _range(known, digits):
    """Least and greatest number to so many digits; empty where there is none, or all are zero."""
    if not known.any():
        return ""
    low, high = (f"{float(f'{end:.{digits}g}'):g}" for end in (known.min(), known.max()))
    return low if low == high else f"{low} to {high}"
