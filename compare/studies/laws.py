"""What theory says of every point of a series: the paper's laws, and the exact limits of low speed."""

from dataclasses import dataclass

import numpy as np

from mdr1d import equations

from .. import exact
from ..pointregime import PointRegime
from ..statistics.jackknife import mean_ratio
from .points import regime
from .series import REST, SMOOTH_REST, Answers, Solved

# Relative spread of exponents up to which they are one.
SAME = 0.02


@dataclass(frozen=True)
class Laws:
    """Of one solver on a series that slides, arrays (speeds, presses) unless stated.

    speeds : (speeds,) [m/s]
    regime : where each point lies, flat, the presses of the first speed first, but for points without any answer
    load : mean over surfaces, or prescribed [N]
    exponent_of_load : of xi, -n/(n+1)
    xi : friction at low speed over the plateau, Eq. 18 with the loss of the solid at the shortest wave
    wave_number : the highest of the roughness [rad/m]
    slowest_loss : loss tangent there at the slowest speed
    loss_exponent : d ln G'' / d ln omega there, (speeds - 1,), from one speed to the next
    plateau : mu of Eq. 14 [1]
    slow : mu of the exact limit of low speed, from the contact at rest, rough
    smooth : that of the smooth body, from its contact at rest
    shifts : ln p(v) that Eq. 23 predicts, (speeds,), up to a constant
    exponent : d ln p / d ln v of it; NaN where it is no power of the speed
    """

    speeds: np.ndarray
    regime: PointRegime
    load: np.ndarray
    exponent_of_load: float
    xi: np.ndarray
    wave_number: float
    slowest_loss: float
    loss_exponent: np.ndarray
    plateau: float
    slow: np.ndarray
    smooth: np.ndarray
    shifts: np.ndarray
    exponent: float

    def xi_under(self, load: np.ndarray) -> np.ndarray:
        """xi at other loads [N], (speeds, presses)."""
        return self.xi * (load / self.load) ** self.exponent_of_load

    @property
    def law(self) -> np.ndarray:
        """mu of Eq. 19."""
        return self.law_of(self.xi)

    def law_of(self, xi: np.ndarray) -> np.ndarray:
        """mu of Eq. 19 at any xi; NaN where that is."""
        return np.where(np.isfinite(xi), self.plateau * equations.interpolation(np.nan_to_num(xi)), np.nan)


def laws(solved: Solved, solver: str) -> Laws | None:
    """Of rough answers, None where there are none.

    The load in Eqs. 18 to 23 is that of the answers, that prescribed where every solve failed, the slope the
    solver's own measure.
    """
    series, regime_of_points = solved.series, regime(solved, solver)
    if regime_of_points is None:
        return None
    answers = solved(solver)
    scene, speeds = series.scene, np.array(series.speeds)
    body, solid, rough = scene.indenter, scene.solid, scene.roughness
    c, n = body.mdr_coefficient, body.exponent
    slope = float(np.nanmean(answers.measures["rms_slope"]))
    highest = rough.q_max(float(np.nanmean(answers.measures["pixel"])))
    # The paper's laws are written for a Poisson ratio of 1/2: E*/4 stands for G, and its loss for that of G.
    modulus = solid.indentation_modulus / 4

    def loss(omega):
        return modulus / solid.static_modulus * solid.complex_modulus(omega).imag

    load = mean_ratio(answers.normal_force).value
    if series.pressed_by == "load":
        load = np.where(np.isfinite(load), load, series.presses)
    one = equations.one_frequency_friction(
        np.nan_to_num(load, nan=1.0), modulus, loss, highest, speeds[:, None], slope, c, n
    )
    xi = np.where(np.isfinite(load), one / equations.plateau(slope), np.nan)
    shift = equations.force_shift(speeds, modulus, loss, highest, slope, c, n)
    rates = np.diff(np.log(shift)) / np.diff(np.log(speeds))
    return Laws(
        speeds=speeds,
        regime=regime_of_points,
        load=load,
        exponent_of_load=-n / (n + 1),
        xi=xi,
        wave_number=highest,
        slowest_loss=float(loss(highest * speeds[0]) / solid.complex_modulus(highest * speeds[0]).real),
        loss_exponent=np.diff(np.log(loss(highest * speeds))) / np.diff(np.log(speeds)),
        plateau=float(equations.plateau(slope)),
        slow=slow_friction(solved, solver, REST),
        smooth=slow_friction(solved, solver, SMOOTH_REST),
        shifts=np.log(shift),
        exponent=_power(rates),
    )


def slow_friction(solved: Solved, solver: str, body: str) -> np.ndarray:
    """mu at low speed, (speeds, presses), from the contact at rest of the rough or the smooth body."""
    rest = solved(solver, body)
    drag = slow_drag(solved.series.scene.solid, solver, rest)
    return np.array(solved.series.speeds)[:, None] * mean_ratio(drag, rest.normal_force[0]).value


def slow_drag(elastomer, solver: str, rest: Answers) -> np.ndarray:
    """Friction force over speed as that tends to zero [N s/m], (presses, surfaces), from the contact at rest."""
    lag = exact.mean_lag(elastomer)
    measures = {name: values[0] for name, values in rest.measures.items()}
    if solver == "BEM":
        return exact.slow_friction_by_curvature(1.0, lag, rest.normal_force[0], measures["curvature_by_pressure"])
    slope, length = measures["rms_slope_contact"], measures["contact_length"]
    return exact.slow_friction_by_slope(1.0, lag, elastomer.indentation_modulus, slope, length)


def _power(rates):
    """The exponent, where it is the same between all speeds."""
    return float(rates.mean()) if rates.size and np.ptp(rates) <= SAME * abs(rates.mean()) else np.nan
