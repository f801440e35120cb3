"""Laws at every point of a series: those of the paper, and the exact limits of low speed."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import nan
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray

from mdr1d import equations

from ...statistics.jackknife import mean_ratio
from .answers import Answers
from .regime import SYMBOLS, ratios, words

if TYPE_CHECKING:
    from .rough import RoughSeries

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


def laws(series: "RoughSeries", answers: Answers, model: str) -> Laws | None:
    """Laws for the rough body that slides; None where no solve has an answer, or none measures the slope.

    The load in Eqs. 18 to 23 is that of the answers, that prescribed where every solve failed, the slope the
    solver's own measure.
    """
    moving = answers("rough", model).isel(speed=slice(1, None))
    if not {"rms_slope", "pixel"} <= set(moving.variables):
        return None
    groups = regimes(series, moving)
    if not np.isfinite(groups["depth_over_height"]).any():
        return None
    scene, speeds = series.scene, np.array(series.speeds)
    solid, body = scene.solid, scene.indenter
    slope = float(np.nanmean(moving["rms_slope"].values))
    highest = scene.roughness.q_max(float(np.nanmean(moving["pixel"].values)))
    c, n = body.mdr_coefficient, body.exponent
    # Written for a Poisson ratio of 1/2: E*/4 stands for G, and its loss for that of G.
    modulus = solid.indentation_modulus / 4

    def loss(omega):
        return modulus / solid.static_modulus * solid.complex_modulus(omega).imag

    load = mean_ratio(_draws(moving, "normal_force")).value
    if series.prescribed == "load":
        load = np.where(np.isfinite(load), load, series.values)
    one = equations.one_frequency_friction(
        np.nan_to_num(load, nan=1.0), modulus, loss, highest, speeds[:, None], slope, c, n
    )
    xi = np.where(np.isfinite(load), one / equations.plateau(slope), nan)
    shift = equations.force_shift(speeds, modulus, loss, highest, slope, c, n)
    rates = np.diff(np.log(shift)) / np.diff(np.log(speeds))
    slowest = solid.complex_modulus(highest * speeds[0])
    return Laws(
        speeds=speeds,
        ratios=groups,
        load=load,
        exponent_of_load=-n / (n + 1),
        xi=xi,
        wave_number=highest,
        slowest_loss=float(slowest.imag / slowest.real),
        loss_exponent=np.diff(np.log(loss(highest * speeds))) / np.diff(np.log(speeds)),
        plateau=float(equations.plateau(slope)),
        shifts=np.log(shift),
        exponent=_power(rates),
    )


def regimes(series: "RoughSeries", answers: xarray.Dataset) -> dict[str, np.ndarray]:
    """Groups of each rough contact of one grid by name, (speeds, values), from means over the surfaces.

    NaN where it is pressed in at a rate, which has none, and where every solve failed.
    """
    force = _draws(answers, "normal_force")
    measures = {name: _draws(answers, name) for name in GROUPED if name in answers}
    found = {name: np.full(force.shape[:2], nan) for name in SYMBOLS}
    for i, speed in enumerate(answers["speed"].values.tolist()):
        for j, value in enumerate(series.values):
            known = np.isfinite(force[i, j])
            if known.any() and not (speed and series.pressed_in):
                here = {name: float(values[i, j][known].mean()) for name, values in measures.items()}
                for name, ratio in ratios(series.at(value, speed), here).items():
                    found[name][i, j] = ratio
    return found


def _draws(answers, name):
    """Variable with the draws along the last axis; smooth bodies have one."""
    values = answers[name]
    return values.transpose(..., "surface").values if "surface" in values.dims else values.values[..., None]


def _power(rates):
    """The exponent, where it is the same between all speeds."""
    return float(rates.mean()) if rates.size and np.ptp(rates) <= SAME * abs(rates.mean()) else nan
