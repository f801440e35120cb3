"""Single against double precision: what single can still reach, and what it saves."""

from collections.abc import Iterator, Mapping, Sequence
from math import nan

import numpy as np

from bem3d import BEM
from scene import Scene

from ...statistics.convergence import MeasuredLadder
from .convergence import Convergence, Ladder
from .diagram import reported
from .reference import DEPTH, FORCE, FRICTION, Quantity, finer
from .scenes import KELVIN, QUICK, SPHERE, at, pressed, rough, slid

DOUBLE = {"quick": (1e-3, 1e-5, 1e-7), "full": (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)}
SINGLE = {"quick": (1e-3, 1e-5), "full": (1e-2, 1e-3, 1e-4, 1e-5)}
POINTS = {"quick": 256, "full": 512}
TIGHTEST = 1e-10, 1e-9


CONTACTS: tuple[tuple[str, str, Scene, tuple[Quantity, ...]], ...] = (
    ("rest-sphere", "sphere at rest", pressed(SPHERE), (FORCE,)),
    ("sliding-sphere", "sphere, v τ = a", slid(SPHERE, KELVIN, 1.0), (FORCE, FRICTION)),
    ("rest-rough", "rough sphere at rest", rough(0.0), (DEPTH,)),
    ("sliding-rough", "rough sphere, 0.1 m/s", rough(0.1), (FRICTION,)),
)
QUICKLY = "sliding-sphere", "rest-rough"


def contacts(size: str) -> Sequence[Convergence]:
    """Smooth and rough, at rest and sliding; errors of the solution alone, on one grid."""
    return [_contact(*each, size) for each in CONTACTS if size != QUICK or each[0] in QUICKLY]


def _contact(name, title, scene, quantities, size):
    points, (tightest, less) = at(POINTS, size), TIGHTEST
    truth = finer(
        scene,
        BEM(points=points, tolerance=tightest),
        f"the same {points}² points at a tolerance of {tightest:.0e} in double precision",
        tolerance=less,
    )
    double, single = BEM(points=points), BEM(points=points, precision="single")
    ladders = (
        Ladder.of("BEM, double, by tolerance", scene, double, "tolerance", at(DOUBLE, size)),
        Ladder.of("BEM, single, by tolerance", scene, single, "tolerance", at(SINGLE, size)),
    )
    return Convergence(name, f"{title}, {points}²", truth, quantities, ladders)


def saved(found: Mapping[str, list[MeasuredLadder]]) -> Iterator:
    """Least errors, and the time and memory that single saves at equal tolerance."""
    for own in found.values():
        for each in own:
            kind = each.ladder.split(", ")[1]
            sentence = f"Least error in {kind} precision"
            yield reported(f"precision.least-{kind}", sentence, each.best, each.where, missing=each.unsolved)
        double, single = own[0], next(each for each in own if "single" in each.ladder)
        times = dict(zip(double.values, double.processor, strict=True))
        ratios = np.array([times.get(value, nan) for value in single.values]) / single.processor
        ratio = float(np.exp(np.log(ratios).mean())) if np.isfinite(ratios).all() else nan
        sentence = "Time in double precision over that in single at equal tolerance, geometric mean"
        yield reported("precision.time-ratio", sentence, ratio, double.title, missing="not every step was solved")
        held, less = (np.fmax.reduce(each.memory) for each in (double, single))
        ratio = float(less / held) if held > 0 else nan
        sentence = "Memory in single precision over that in double"
        yield reported("precision.memory-ratio", sentence, ratio, double.title, missing="not measured")
