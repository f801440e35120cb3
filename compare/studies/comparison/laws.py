"""Laws of the paper at every point of a series, and the ratios of a rough contact that decide which can hold."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import nan, pi
from typing import Any

import numpy as np
import xarray
from pandas import DataFrame, Series

from mdr1d import equations
from scene import Indent, Regime, Scene, Slide
from scene.indenter import Axisymmetric
from scene.scales import elastic_contact

from ...models.exact import mean_lag
from ...solving.curve import Curve
from ...statistics.jackknife import draws_of, off_the_ratio

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
# Relative spread of exponents up to which they are one.
SAME = 0.02
# Measures that the dimensionless groups of a point need.
GROUPED = ("rms_slope", "pixel", "contact_area", "contact_length")


@dataclass(frozen=True)
class Laws:
    """Laws for one solver on a series that slides, arrays (speeds, values) unless stated.

    speeds : (speeds,) [m/s]
    ratios : dimensionless groups of each point by name, see `regime.ratios`; NaN where every solve failed
    load : mean over surfaces, or prescribed [N]
    exponent_of_load : of xi, -n/(n+1)
    xi : friction at low speed over the plateau, Eq. 18 with the loss of the solid at the shortest wave
    wave_number : the highest of the roughness [rad/m]
    slowest_loss : loss tangent there at the slowest speed
    loss_exponent : d ln G'' / d ln omega there, (speeds - 1,), from one speed to the next
    plateau : mu of Eq. 14 [1]
    shifts : ln p(v) that Eq. 23 predicts, (speeds,), up to a constant
    exponent : d ln p / d ln v of it; NaN where it is no power of the speed
    """

    speeds: np.ndarray
    ratios: Mapping[str, np.ndarray]
    load: np.ndarray
    exponent_of_load: float
    xi: np.ndarray
    wave_number: float
    slowest_loss: float
    loss_exponent: np.ndarray
    plateau: float
    shifts: np.ndarray
    exponent: float

    def words(self, place: Any = ...) -> str:
        """Ranges of load, xi and groups of points, all if no place among them is given."""
        known = {"load": np.broadcast_to(self.load, self.xi.shape), "xi": self.xi, **self.ratios}
        return words({name: values[place] for name, values in known.items()})

    def xi_under(self, load: np.ndarray) -> np.ndarray:
        """xi at other loads [N], (speeds, values)."""
        return self.xi * (load / self.load) ** self.exponent_of_load

    @property
    def law(self) -> np.ndarray:
        """mu of Eq. 19."""
        return self.law_of(self.xi)

    def law_of(self, xi: np.ndarray) -> np.ndarray:
        """mu of Eq. 19 at any xi; NaN where that is."""
        return np.where(np.isfinite(xi), self.plateau * equations.interpolation(np.nan_to_num(xi)), nan)


def laws(curve: Curve, answers: xarray.Dataset) -> Laws | None:
    """Laws for a rough body of revolution that slides; None of others, and where no solve has an answer.

    answers : of one model on the curve. The load in Eqs. 18 to 23 is theirs, that prescribed where every solve
        failed, and the slope the solver's own measure
    """
    moving, scene = answers.sel(speed=answers["speed"] > 0), curve.scene
    speeds, shape = moving["speed"].values, scene.indenter
    slides = isinstance(scene.motion, Indent | Slide) and speeds.size and isinstance(shape, Axisymmetric)
    if not (slides and scene.roughness and {"rms_slope", "pixel"} <= set(moving.variables)):
        return None
    groups = regimes(curve, moving)
    if not np.isfinite(groups["depth_over_height"]).any():
        return None
    solid, body = scene.solid, (shape.mdr_coefficient, shape.exponent)
    slope, pixel = (float(np.nanmean(moving[name].values)) for name in ("rms_slope", "pixel"))
    highest = scene.roughness.q_max(pixel)
    # Written for a Poisson ratio of 1/2: E*/4 stands for G, and its loss for that of G.
    modulus = solid.indentation_modulus / 4

    def loss(omega):
        return modulus / solid.static_modulus * solid.complex_modulus(omega).imag

    def rates(values):
        return np.diff(np.log(values)) / np.diff(np.log(speeds))

    load, _, _ = off_the_ratio(draws_of(moving, "normal_force"))
    if curve.prescribed == "load":
        load = np.where(np.isfinite(load), load, curve.values)
    of_rough = modulus, loss, highest
    one = equations.one_frequency_friction(np.nan_to_num(load, nan=1.0), *of_rough, speeds[:, None], slope, *body)
    shift = equations.force_shift(speeds, *of_rough, slope, *body)
    powers, slowest = rates(shift), solid.complex_modulus(highest * speeds[0])
    return Laws(
        speeds=speeds,
        ratios=groups,
        load=load,
        exponent_of_load=-body[1] / (body[1] + 1),
        xi=np.where(np.isfinite(load), one / equations.plateau(slope), nan),
        wave_number=highest,
        slowest_loss=float(slowest.imag / slowest.real),
        loss_exponent=rates(loss(highest * speeds)),
        plateau=float(equations.plateau(slope)),
        shifts=np.log(shift),
        exponent=float(powers.mean()) if powers.size and np.ptp(powers) <= SAME * abs(powers.mean()) else nan,
    )


def regimes(curve: Curve, answers: xarray.Dataset) -> dict[str, np.ndarray]:
    """Groups of each rough contact that slides by name, (speeds, values), from means over the surfaces.

    NaN where every solve failed.
    """
    known = answers[[name for name in GROUPED if name in answers]].where(answers["normal_force"].notnull())
    means = (known.mean("surface") if "surface" in known.dims else known).to_dataframe()[[*known]]
    found = DataFrame(nan, index=means.index, columns=[*SYMBOLS])
    for (speed, value), measures in means.dropna(how="all").iterrows():
        found.loc[speed, value] = Series(ratios(curve.at(value, speed), measures))
    return {name: each.unstack().to_numpy() for name, each in found.items()}


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
