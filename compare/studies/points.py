"""Every point of a series: means over its surfaces with their errors, where it lies, and the table of all."""

from collections.abc import Iterator
from math import nan

import numpy as np

from scene import Scene

from ..pointregime import PointRegime, gathered
from ..statistics.jackknife import Estimated, Value, mean_ratio
from ..verdict import DIMENSIONS
from .series import FINE, REST, ROUGH, Answers, Key, Solved

RANDOM = (ROUGH, REST)
# Of a regime, as the table calls them.
REGIME = (
    "depth_over_height",
    "shortest_in_contact",
    "pressure_over_slope",
    "memory_over_contact",
    "memory_over_shortest",
    "contact_fraction",
)
SCENE_REGIME = ("contact_over_period", "macro_over_rough", "rms_slope")


def mean_of(answers: Answers, body: str, above: str, below: str | None = None) -> Estimated[np.ndarray]:
    """Mean over surfaces, or ratio of two, of what answers name so; exact of a smooth body."""
    top = getattr(answers, above)
    found = mean_ratio(top, getattr(answers, below) if below else 1.0)
    return found if body in RANDOM else Estimated.exact(found.value)


def friction(solved: Solved, solver: str, body: str = ROUGH, grid: str = FINE) -> Estimated[np.ndarray]:
    """Mean friction force over mean normal force (speeds, presses)."""
    return mean_of(solved(solver, body, grid), body, "friction_force", "normal_force")


def quotient(one: Estimated[Value], other: Estimated[Value]) -> Estimated[Value]:
    """Of two independent numbers, to first order; degrees of freedom after Welch and Satterthwaite."""
    with np.errstate(invalid="ignore", divide="ignore"):
        value = one.value / other.value
        parts = [np.square(each.error / each.value) for each in (one, other)]
        rest = sum(np.square(part) / each.freedom for part, each in zip(parts, (one, other), strict=True))
        freedom = np.where(rest > 0, np.square(sum(parts)) / rest, np.inf)
    return Estimated(value, np.abs(value) * np.sqrt(sum(parts)), freedom)


def regime(solved: Solved, solver: str) -> PointRegime | None:
    """Where the rough points lie, those that slide or else those at rest, one after the other; None of none."""
    series = solved.series
    key = Key(solver, ROUGH if series.slides else REST, FINE)
    if key not in solved.answers:
        return None
    found = [at for row in _regimes(solved, key) for at in row if at is not None]
    return gathered(found) if found else None


def ratio(solved: Solved, solver: str, name: str) -> np.ndarray:
    """One ratio of every rough point that slides, (speeds, presses), NaN where every solve failed."""
    rows = _regimes(solved, Key(solver, ROUGH, FINE))
    return np.array([[nan if at is None else getattr(at, name) for at in row] for row in rows])


def table(solved: Solved) -> list[dict]:
    """A row a point, of every solver, body and grid; units SI, errors standard errors over surfaces."""
    return [row for key in solved.answers for row in _rows(solved, key)]


def _rows(solved, key) -> Iterator[dict]:
    answers, series = solved.answers[key], solved.series
    numbers = {
        "normal_force": mean_of(answers, key.body, "normal_force"),
        "friction_force": mean_of(answers, key.body, "friction_force"),
        "friction_coefficient": mean_of(answers, key.body, "friction_force", "normal_force"),
        "depth": mean_of(answers, key.body, "depth"),
        "contact": mean_of(answers, key.body, "contact"),
    }
    regimes = _regimes(solved, key)
    for i, speed in enumerate(_speeds(series, key)):
        for j, press in enumerate(series.presses):
            row = {
                "dimension": DIMENSIONS[key.solver],
                "body": key.body,
                "grid": key.grid,
                "points": answers.points,
                "speed": speed,
                f"prescribed_{series.pressed_by}": press,
                "surfaces": int(np.isfinite(answers.normal_force[i, j]).sum()),
                "asked_surfaces": answers.normal_force.shape[2],
            }
            for name, number in numbers.items():
                row |= {name: float(number.value[i, j]), f"{name}_error": float(number.error[i, j])}
            yield row | _ratios(regimes[i][j])


def _ratios(at: PointRegime | None) -> dict:
    if at is None:
        return dict.fromkeys((*REGIME, *SCENE_REGIME), nan)
    return {name: float(getattr(at, name)) for name in REGIME} | {
        name: float(getattr(at.regime, name)) for name in SCENE_REGIME
    }


def _regimes(solved, key) -> list[list[PointRegime | None]]:
    """Of each point; None of smooth bodies, of what is pressed in at a rate, and where every solve failed."""
    answers, series = solved.answers[key], solved.series
    speeds = _speeds(series, key)
    moving = key.body == ROUGH and not series.slides
    if key.body not in RANDOM or moving:
        return [[None] * len(series.presses) for _ in speeds]
    return [
        [_at(series.at(press, speed), answers, (i, j)) for j, press in enumerate(series.presses)]
        for i, speed in enumerate(speeds)
    ]


def _at(scene: Scene, answers, place):
    known = np.isfinite(answers.normal_force[place])
    if not known.any():
        return None
    measures = {name: float(values[place][known].mean()) for name, values in answers.measures.items()}
    return PointRegime.of(scene, measures)


def _speeds(series, key):
    """Of the rows of answers: bodies at rest have one."""
    return (0.0,) if "rest" in key.body else series.speeds
