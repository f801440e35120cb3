"""Figs. 5 to 7: friction against load at many speeds, shifted along the load.

The measured data were never published. The friction shifted here is simulated, on a solid whose loss is a power
of the frequency, Eq. 24.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import nan

import numpy as np
import xarray
from pandas import DataFrame

from mdr1d import MDR, equations
from scene import Regime, SolveError

from ...comparison.curve import FINE, Curve
from ...statistics.collapse import Collapse, along_load, collapse
from ...statistics.frictioncurves import SimulatedCurves
from . import parameters
from .conditions import with_conditions
from .parameters import Loss
from .predicted import CONSTANT, EVERY, SHORTEST, WITH_SMOOTH, predict

# Misfit of ln mu up to which the curves of a law, which have no scatter, are one: as well as Eq. 19 is followed.
ONE = 0.01
STIFFNESS = "macroscopic_modulus"
WHOLE, ROUGH = "whole friction", "less smooth body"


def grids(loss: Loss, profiles: int = parameters.LOSS_PROFILES) -> dict[str, Curve]:
    """Contacts of one rubber at each speed and load: rough, and of the smooth body."""
    grids = {"MDR": {FINE: MDR(points=parameters.POINTS)}}
    scene = parameters.lossy(loss, parameters.FORCES[0], parameters.SPEEDS[0])
    rough = Curve(
        scene=scene, speeds=parameters.SPEEDS, values=parameters.FORCES, grids=grids, draws={"MDR": profiles}
    )
    smooth = replace(rough, scene=replace(scene, roughness=None), draws={})
    return {f"loss{loss.suffix}": rough, f"loss{loss.suffix}-smooth": smooth}


@dataclass(frozen=True)
class Lossy:
    """One rubber.

    points : speed, normal_force, friction simulated, of the smooth body and of each form of Eq. 22, conditions
    collapses : what shifts along the load make of the whole friction, and of what exceeds that of the smooth body
    powers : exponents of the shifts that each form of Eq. 22 has of its own; NaN where its curves do not collapse
    profiles : number that are averaged
    """

    loss: Loss
    points: DataFrame
    collapses: Mapping[str, Collapse]
    powers: Mapping[str, float]
    profiles: int

    @property
    def exponent(self) -> float:
        """Exponent of the shifts against the speed that is expected, -beta (n+1)/n."""
        return exponent_of(self.loss)

    def where(self, of: str) -> str:
        """The rubber and what of its friction is shifted, in words."""
        return f"{self.loss.symbols}, {of}"

    def conditions(self, of: str) -> DataFrame:
        """Conditions of the points that were shifted."""
        speeds, loads = np.log(parameters.SPEEDS), np.log(parameters.FORCES)
        at = [
            np.abs(speeds - np.log(curve.speed)).argmin() * loads.size + np.abs(loads - load).argmin()
            for curve in self.collapses[of].curves
            for load in curve.log_load
        ]
        first = self.points.columns.get_loc(STIFFNESS)
        ratios = [name for name in vars(Regime(0, 0, 0, 0)) if name in self.points]
        return self.points.iloc[at][[*dict.fromkeys([*ratios, *self.points.columns[first:]])]]


def exponent_of(loss: Loss) -> float:
    """Exponent of a rubber's shifts against the speed that is expected, -beta (n+1)/n."""
    return equations.force_shift_exponent(loss.exponent, parameters.SHAPES["sphere"].exponent)


def lossy(loss: Loss, rough: xarray.Dataset, smooth: xarray.Dataset) -> Lossy:
    """One rubber from what was solved.

    Raises SolveError where no profile has an answer at every point, as profiles are shared, or the smooth body has
    none at one.
    """
    whole = SimulatedCurves.of(rough.sel(level=FINE))
    body = SimulatedCurves.of(smooth.sel(level=FINE))
    known = np.isfinite(whole.friction_force).all(axis=(0, 1))
    of_body = body.friction_force / body.load
    if not known.any() or not np.isfinite(of_body).all():
        reasons = [each for part in (rough, smooth) for each in part["reason"].values.flat if each]
        raise SolveError(f"Fig. 7, {loss.symbols}: {reasons[0] if reasons else 'nothing was solved'}")
    whole = replace(whole, load=whole.load[..., known], friction_force=whole.friction_force[..., known])
    excess = replace(whole, friction_force=whole.friction_force - of_body[..., None] * whole.load)
    predicted = predict(loss)
    forms = predicted.forms(of_body)
    speeds, loads = (each.ravel() for each in np.meshgrid(whole.speeds, parameters.FORCES, indexing="ij"))
    points = DataFrame(
        {
            "loss_exponent": loss.exponent,
            "relaxation_time": loss.relaxation_time,
            "speed": speeds,
            "normal_force": loads,
            "simulated": (whole.friction_force / whole.load).mean(axis=2).ravel(),
            "smooth": of_body.ravel(),
            **{name.replace(" ", "_"): form.ravel() for name, form in forms.items()},
        }
    )
    stiffness = predicted.stiffness.ravel()
    constant = {"constant macroscopic modulus": (STIFFNESS, stiffness, stiffness <= CONSTANT)}
    regime = Regime(**{name: ratio.ravel() for name, ratio in vars(predicted.regime).items()})
    return Lossy(
        loss=loss,
        points=with_conditions(points, regime, constant),
        collapses={WHOLE: collapse(whole), ROUGH: collapse(excess)},
        powers={name: own_exponent(form) for name, form in forms.items()},
        profiles=int(known.sum()),
    )


def own_exponent(friction: np.ndarray) -> float:
    """Exponent of the shifts that bring curves of a law (speeds, loads) onto one; NaN where none do."""
    loads = np.broadcast_to(parameters.FORCES, friction.shape)
    found = along_load(SimulatedCurves(np.array(parameters.SPEEDS), loads, friction * loads))
    return float(found.exponent.value) if not found.reason and found.rms <= ONE else nan


def comparable(of: str) -> tuple[str, ...]:
    """Names of the forms of Eq. 22 that are about the same friction."""
    return (WITH_SMOOTH,) if of == WHOLE else (SHORTEST, EVERY)
