"""Figs. 5 to 7: friction against load at many speeds, shifted onto one curve, and the shift against the speed.

The measured data were never published. What is shifted here is simulated, on a solid whose loss is a power of the
frequency, Eq. 24, or comes from a user's own table of friction, load and speed: both take the same way.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import nan

import numpy as np

from mdr1d import MDR, equations
from scene import SolveError

from .. import mastercurve
from ..commoncurve import Curve, Misfit
from ..outcome import Outcome
from ..statistics.jackknife import interval, standard_error
from ..store import Task as AnyTask
from ..study import Task, surfaces_of
from ..vertical import Vertical, vertical_shifts
from . import parameters
from .conditions import Conditions
from .parameters import Loss
from .predicted import EVERY, SHORTEST, WITH_SMOOTH, Predicted, predict

# Misfit of ln mu up to which the curves of a law, which have no scatter, are one: as well as Eq. 19 is followed.
ONE = 0.01
STRAIGHT = "straight parallel lines: a horizontal shift cannot be told from a vertical one"


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
    conditions : of the points of each curve; empty where they are not known
    laws : exponents that the forms of Eq. 22 for such friction have of their own, by name; NaN of one whose curves
        do not collapse
    """

    title: str
    collapse: mastercurve.Collapse
    exponent_error: float
    exponent_interval: tuple[float, float]
    expected: float | None = None
    predicted: Misfit | None = None
    vertical: Vertical | None = None
    conditions: tuple[Conditions, ...] = ()
    laws: Mapping[str, float] = field(default_factory=dict)

    @property
    def decided(self) -> bool:
        """Whether the shifts mean anything: not of curves that they do not bring onto one, nor of those that part.

        Straight parallel lines do come onto one; their shifts are taken for horizontal.
        """
        return self.collapse.overlaps and self.collapse.verdict != "fails"

    @property
    def exponent(self) -> float:
        """Of the shifts as a power of the speed; NaN where they mean nothing."""
        return self.collapse.exponent if self.decided else nan

    @property
    def within(self) -> tuple[float, float]:
        """Its interval of 95 %; NaN where the shifts mean nothing."""
        return self.exponent_interval if self.decided else (nan, nan)

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
    def simulated(
        cls, title: str, friction: np.ndarray, expected: float, conditions: Conditions, laws: Mapping[str, float]
    ) -> "Shifted":
        """Shift curves of friction (speeds, loads, profiles) at the speeds and forces of parameters.

        conditions : of arrays (speeds, loads)
        """
        collapse = mastercurve.collapse(_curves(friction))
        error = nan
        if np.isfinite(collapse.exponent_error) and friction.shape[2] > 2:
            left_out = range(friction.shape[2])
            without = [mastercurve.collapse(_curves(np.delete(friction, k, axis=2))).exponent for k in left_out]
            error = float(standard_error(np.array(without)))
        within = interval(collapse.exponent, error, friction.shape[2] - 1)
        return cls(
            title,
            collapse,
            error,
            within,
            expected,
            mastercurve.misfit_at(collapse, expected),
            conditions=tuple(conditions.at((i, row > 0)) for i, row in enumerate(friction.mean(axis=2))),
            laws=laws,
        )


@dataclass(frozen=True)
class Lossy:
    """One rubber; arrays (speeds, loads) unless stated.

    loss : its exponent and time
    whole, rough : friction, and what of it is left without that of the smooth body at the same load and speed
    smooth : mu of the smooth body
    predicted : what the laws say
    failed : solves without an answer; their profiles are left out everywhere
    """

    loss: Loss
    whole: Shifted
    rough: Shifted
    smooth: np.ndarray
    predicted: Predicted
    failed: int

    @property
    def forms(self) -> dict[str, np.ndarray]:
        """mu of each form of Eq. 22, by name; the last adds the simulated friction of the smooth body."""
        return self.predicted.forms(self.smooth)


def exponent_of(loss: Loss) -> float:
    """That expected of a rubber's shifts against the speed, -beta (n+1)/n."""
    return equations.force_shift_exponent(loss.exponent, parameters.lossy(loss, 1.0, 1.0).indenter.exponent)


def tasks(loss: Loss, profiles: int = parameters.LOSS_PROFILES) -> list[Task]:
    """The tasks for one rubber: of the rough profiles at each speed and load, then of the smooth body."""
    scenes = [parameters.lossy(loss, load, speed) for speed in parameters.SPEEDS for load in parameters.FORCES]
    solver = MDR(points=parameters.POINTS)
    modes = scenes[0].elastomer.relaxation()[2].size
    # As measured: a mode costs a tenth of all else.
    work = parameters.POINTS * 15.0 * (1 + modes / 10)
    rough = [Task(solver, surfaces_of(scene, profiles), work=profiles * work) for scene in scenes]
    smooth = [Task(solver, (replace(scene, roughness=None),), work=work) for scene in scenes]
    return rough + smooth


def collect(loss: Loss, found: Sequence[Task], outcomes: Mapping[AnyTask, Outcome]) -> Lossy:
    """Put the tasks of one rubber together. Raises SolveError where one of them broke: profiles are shared."""
    for task in found:
        if all(row.reason is not None for row in outcomes[task].rows):
            raise SolveError(f"Fig. 7: {task.label}: {outcomes[task].rows[0].reason}")
    rows = [[row.friction_coefficient for row in outcomes[task].rows] for task in found]
    shape = len(parameters.SPEEDS), len(parameters.FORCES), -1
    friction = np.array(rows[: len(rows) // 2]).reshape(shape)
    smooth = np.array(rows[len(rows) // 2 :]).reshape(shape)
    known = friction[:, :, np.isfinite(friction).all(axis=(0, 1))]
    expected = exponent_of(loss)
    predicted = predict(loss)
    laws = {name: _own_exponent(form) for name, form in predicted.forms(smooth[:, :, 0]).items()}

    def shift(title, of, *comparable):
        own = {name: laws[name] for name in comparable}
        return Shifted.simulated(f"{loss.symbols}, {title}", of, expected, predicted.conditions, own)

    return Lossy(
        loss=loss,
        whole=shift("whole friction", known, WITH_SMOOTH),
        rough=shift("less that of the smooth body", known - smooth, SHORTEST, EVERY),
        smooth=smooth[:, :, 0],
        predicted=predicted,
        failed=sum(row.reason is not None for task in found for row in outcomes[task].rows),
    )


def _own_exponent(friction):
    """Of the shifts that bring curves of a law (speeds, loads) onto one; NaN where none do."""
    found = mastercurve.collapse(_curves(friction[:, :, None]))
    return found.exponent if found.overlaps and found.after.rms <= ONE else nan


def _curves(friction):
    """Means over the profiles, of points that have friction left; one alone has no scatter."""
    mean, count = friction.mean(axis=2), friction.shape[2]
    error = friction.std(axis=2, ddof=1) / np.sqrt(count) if count > 1 else np.full(mean.shape, nan)
    logs = np.log(parameters.FORCES)
    return [
        Curve(speed, logs[mu > 0], np.log(mu[mu > 0]), (deviation / mu)[mu > 0])
        for speed, mu, deviation in zip(parameters.SPEEDS, mean, error, strict=True)
    ]
