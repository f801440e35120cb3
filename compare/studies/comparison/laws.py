"""Laws of the paper at every point of a series."""

from __future__ import annotations

from dataclasses import dataclass
from math import nan
from typing import TYPE_CHECKING, Any

import numpy as np

from mdr1d import equations
from scene import Indent, Slide
from scene.indenter import Axisymmetric

from ...solving.curve import Curve
from ...statistics.jackknife import draws_of, off_the_ratio

if TYPE_CHECKING:
    import xarray

# Relative spread of exponents up to which they are one.
SAME = 0.02


@dataclass(frozen=True)
class Laws:
    """Laws for one solver on a series that slides, arrays (speeds, values) unless stated.

    speeds : (speeds,) [m/s]
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
        """Ranges of load and xi of points, all if no place among them is given."""
        load, xi = np.broadcast_to(self.load, self.xi.shape)[place], self.xi[place]
        reach = (f"F_N {_range(load, 3)} N", f"ξ {_range(xi, 2)}")
        return ", ".join(reach) if np.isfinite(xi).any() else ""

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
    """Laws for a rough body of revolution that slides; None of others, and where no solve answers all waves.

    answers : of a single model on the curve. The load in Eqs. 18 to 23 is theirs, or the prescribed load where
        every solve failed; the slope is the solver's own measure
    """
    moving, scene = answers.sel(speed=answers["speed"] > 0), curve.scene
    speeds, shape = moving["speed"].values, scene.indenter
    slides = isinstance(scene.motion, Indent | Slide) and speeds.size and isinstance(shape, Axisymmetric)
    if not (slides and scene.roughness and {"rms_slope", "pixel"} <= set(moving.variables)):
        return None
    if "shortest_kept" in moving.variables or not moving["normal_force"].notnull().any():
        return None
    solid, body = scene.solid, (shape.mdr_coefficient, shape.exponent)
    slope, pixel = (float(np.nanmean(moving[name].values)) for name in ("rms_slope", "pixel"))
    highest = scene.roughness.q_max(pixel)
    # Written for a Poisson ratio of 1/2: E*/4 stands for G, and the loss of E*/4 for the loss of G.
    modulus = solid.indentation_modulus / 4

    def loss(omega):
        return modulus / solid.static_modulus * solid.complex_modulus(omega).imag

    def rates(values):
        return np.diff(np.log(values)) / np.diff(np.log(speeds))

    load = off_the_ratio(draws_of(moving, "normal_force"))[0]
    if curve.prescribed == "load":
        load = np.where(np.isfinite(load), load, curve.values)
    of_rough = modulus, loss, highest
    one = equations.one_frequency_friction(np.nan_to_num(load, nan=1.0), *of_rough, speeds[:, None], slope, *body)
    shift = equations.force_shift(speeds, *of_rough, slope, *body)
    powers, slowest = rates(shift), solid.complex_modulus(highest * speeds[0])
    return Laws(
        speeds=speeds,
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


def _range(values, digits):
    """Least and greatest of the numbers that are known, to a number of digits."""
    known = values[np.isfinite(values)]
    low, high = (f"{float(f'{end:.{digits}g}'):g}" for end in (known.min(), known.max()))
    return low if low == high else f"{low} to {high}"
