"""Figs. 5 to 7: friction against load at many speeds, shifted onto one curve, and the shift against the speed.

The measured data were never published. What is shifted here is simulated, on a solid whose loss is a power of the
frequency, Eq. 24, or comes from a user's own table of friction, load and speed: both take the same way.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import nan

import numpy as np

from mdr1d import MDR, amplitudes, draw, equations
from scene import Regime, Scene
from scene.scales import elastic_contact

from .. import mastercurve
from ..commoncurve import Curve, Misfit
from ..outcome import Outcome
from ..resampling import interval, standard_error
from ..store import Task as AnyTask
from ..study import Task
from ..vertical import Vertical, vertical_shifts
from . import parameters


@dataclass(frozen=True)
class Shifted:
    """Curves of friction against load, and what horizontal shifts make of them.

    title : what the curves are
    collapse : the joint fit of the shifts; its curves are ln mu against ln F_N, one a speed
    exponent_error : standard error of the exponent of the shifts against the speed; of simulated curves by leaving
        out one profile at a time, as the same profiles stand behind all points
    exponent_interval : of 95 %
    expected : that exponent, -beta (n+1)/n; None where nothing is expected
    predicted : misfit of the curves once shifted by it
    vertical : what vertical shifts achieve beside the horizontal ones; None where points are too few for both, or
        not independent, as simulated ones on the same profiles
    """

    title: str
    collapse: mastercurve.Collapse
    exponent_error: float
    exponent_interval: tuple[float, float]
    expected: float | None = None
    predicted: Misfit | None = None
    vertical: Vertical | None = None

    @classmethod
    def measured(cls, title: str, curves: Sequence[Curve]) -> "Shifted":
        """Shift curves of which every point was measured by itself. Raises ValueError where points are too few."""
        collapse = mastercurve.collapse(curves)
        error = collapse.exponent_error
        within = interval(collapse.exponent, error, collapse.after.freedom)
        try:
            vertical = vertical_shifts(collapse)
        except ValueError:
            vertical = None
        return cls(title, collapse, error, within, vertical=vertical)

    @classmethod
    def simulated(cls, title: str, friction: np.ndarray, expected: float) -> "Shifted":
        """Shift curves of friction (speeds, loads, profiles) at the speeds and forces of parameters."""
        collapse = mastercurve.collapse(_curves(friction))
        error = nan
        if np.isfinite(collapse.exponent_error) and friction.shape[2] > 2:
            left_out = range(friction.shape[2])
            without = [mastercurve.collapse(_curves(np.delete(friction, k, axis=2))).exponent for k in left_out]
            error = float(standard_error(np.array(without)))
        within = interval(collapse.exponent, error, friction.shape[2] - 1)
        return cls(title, collapse, error, within, expected, mastercurve.misfit_at(collapse, expected))


@dataclass(frozen=True)
class Lossy:
    """One exponent of the loss; arrays (speeds, loads) unless stated.

    exponent : beta of Eq. 24
    whole, rough : friction, and what of it is left without that of the smooth body at the same load and speed
    smooth : mu of the smooth body
    one_frequency, spectral : mu of Eq. 22 with the loss at the shortest wave, and with that of every wave at its
        own frequency; both leave out the macroscopic slope
    regime : of each load, arrays (loads,)
    failed : solves without an answer; their profiles are left out everywhere
    """

    exponent: float
    whole: Shifted
    rough: Shifted
    smooth: np.ndarray
    one_frequency: np.ndarray
    spectral: np.ndarray
    regime: Regime
    failed: int


def tasks(exponent: float, profiles: int = parameters.LOSS_PROFILES) -> list[Task]:
    """The tasks for one exponent: of the rough profiles at each speed and load, then of the smooth body."""
    scenes = [parameters.lossy(exponent, load, speed) for speed in parameters.SPEEDS for load in parameters.FORCES]
    solver = MDR(points=parameters.POINTS)
    modes = scenes[0].elastomer.relaxation()[2].size
    rough = [
        Task(solver, _drawn(scene, profiles), work=profiles * parameters.POINTS * 15.0 * modes) for scene in scenes
    ]
    smooth = [Task(solver, (replace(scene, roughness=None),), work=parameters.POINTS * 15.0) for scene in scenes]
    return rough + smooth


def _drawn(scene: Scene, profiles: int) -> tuple[Scene, ...]:
    rough = scene.roughness
    return tuple(replace(scene, roughness=replace(rough, seed=seed)) for seed in range(profiles))


def collect(exponent: float, found: Sequence[Task], outcomes: Mapping[AnyTask, Outcome]) -> Lossy:
    """Put the tasks of one exponent together."""
    rows = [[row.friction_coefficient for row in outcomes[task].rows] for task in found]
    shape = len(parameters.SPEEDS), len(parameters.FORCES), -1
    friction = np.array(rows[: len(rows) // 2]).reshape(shape)
    smooth = np.array(rows[len(rows) // 2 :]).reshape(shape)
    known = friction[:, :, np.isfinite(friction).all(axis=(0, 1))]
    expected = equations.force_shift_exponent(exponent, parameters.lossy(exponent, 1.0, 1.0).indenter.exponent)
    one_frequency, spectral, regime = _predicted(exponent)
    return Lossy(
        exponent=exponent,
        whole=Shifted.simulated(f"β = {exponent:g}, whole friction", known, expected),
        rough=Shifted.simulated(f"β = {exponent:g}, less that of the smooth body", known - smooth, expected),
        smooth=smooth[:, :, 0],
        one_frequency=one_frequency,
        spectral=spectral,
        regime=regime,
        failed=sum(row.reason is not None for task in found for row in outcomes[task].rows),
    )


def _curves(friction):
    """Means over the profiles, of points that have friction left."""
    mean = friction.mean(axis=2)
    error = friction.std(axis=2, ddof=1) / np.sqrt(friction.shape[2])
    logs = np.log(parameters.FORCES)
    return [
        Curve(speed, logs[mu > 0], np.log(mu[mu > 0]), (deviation / mu)[mu > 0])
        for speed, mu, deviation in zip(parameters.SPEEDS, mean, error, strict=True)
    ]


def _predicted(exponent):
    """mu of Eq. 22 in both forms, and the regime of each load."""
    speeds, loads = np.array(parameters.SPEEDS)[:, None], np.array(parameters.FORCES)
    scene = parameters.lossy(exponent, 1.0, 1.0)
    solid, body, rough = scene.elastomer, scene.indenter, scene.roughness
    c, n = body.mdr_coefficient, body.exponent
    surface = draw(rough, parameters.POINTS)
    slope, highest = surface.rms_slope, np.pi / surface.pixel
    contacts = [
        elastic_contact(replace(scene, motion=replace(scene.motion, load=load))) for load in loads.tolist()
    ]
    radius, depth = (np.array([getattr(at, name) for at in contacts]) for name in ("radius", "depth"))

    def loss(omega):
        return solid.complex_modulus(omega).imag

    one = equations.general_friction(loads, solid.modulus, loss, highest, speeds, slope, c, n)
    waves = amplitudes(rough, highest / rough.q_min)
    q = rough.q_min * np.arange(1, waves.size + 1)
    # A profile that is linear between nodes has of each wave the slope that finite differences see.
    seen = waves * np.sinc(q * surface.pixel / (2 * np.pi))
    slow = equations.wave_force(loss, q, seen, speeds, 2 * radius) / loads
    plateau = equations.plateau(slope)
    spectral = plateau * equations.interpolation(slow / plateau)
    return one, spectral, Regime.of((c, n), (radius, depth), rough.rms_height, rough.longest, slope)
