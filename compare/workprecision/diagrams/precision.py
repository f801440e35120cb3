"""Single against double precision: what single can still reach, and what it saves."""

from collections.abc import Sequence

import numpy as np

from bem3d import BEM

from .. import wording
from ..contest import DEPTH, FORCE, FRICTION, Climbed, Contest, Finer, Judged, Ladder
from ..diagram import Diagram
from .scenes import KELVIN, SPHERE, pressed, rough, slid

DOUBLE = {"quick": (1e-3, 1e-5, 1e-7), "full": (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)}
SINGLE = {"quick": (1e-3, 1e-5), "full": (1e-2, 1e-3, 1e-4, 1e-5)}
POINTS = {"quick": 256, "full": 512}
TIGHTEST = 1e-10, 1e-9


def contests(size: str) -> Sequence[Contest]:
    """Smooth and rough, at rest and sliding; errors of the solution alone, on one grid."""
    flow = _contest("sliding-sphere", "sphere, v τ = a", slid(SPHERE, KELVIN, 1.0), (FORCE, FRICTION), size)
    body = _contest("rest-rough", "rough sphere at rest", rough(0.0), (DEPTH,), size)
    if size == "quick":
        return [flow, body]
    at_rest = _contest("rest-sphere", "sphere at rest", pressed(SPHERE), (FORCE,), size)
    return [at_rest, flow, body, _contest("sliding-rough", "rough sphere, 0.1 m/s", rough(0.1), (FRICTION,), size)]


def _contest(name, title, scene, quantities, size):
    points, (tightest, less) = POINTS[size], TIGHTEST
    truth = Finer.of(
        scene,
        BEM(points=points, tolerance=tightest),
        f"the same {points}² points at a tolerance of {tightest:.0e} in double precision",
        tolerance=less,
    )
    ladders = (
        Ladder.of("BEM, double, by tolerance", scene, BEM(points=points), "tolerance", DOUBLE[size]),
        Ladder.of(
            "BEM, single, by tolerance", scene, BEM(points=points, precision="single"), "tolerance", SINGLE[size]
        ),
    )
    return Contest(name, f"{title}, {points}²", truth, quantities, ladders)


def advice(found: Sequence[Judged]) -> str:
    """What single reaches, and the time and memory that it saves at equal tolerance."""
    said = []
    for judged in found:
        double, single = judged.climbed
        for each in judged.contest.quantities:
            reached = wording.unsolved(single, each.name) or _reached(single, each.name)
            tight = wording.unsolved(double, each.name) or _reached(double, each.name)
            said.append(f"For the {each.label} of the {judged.contest.title}, single: {reached}; double: {tight}.")
        said.append(_saved(double, single))
    return (
        "Errors are those of the solution on its grid, to which that of the grid adds. "
        f"{' '.join(said)}{wording.failures(found)}"
    )


def _reached(climbed: Climbed, name):
    errors = climbed.errors[name]
    k = int(np.nanargmin(errors))
    return f"{wording.share(errors[k])} with {wording.rung(climbed, k)} at best"


def _saved(double, single):
    shared = [
        (double.ladder.values.index(value), k)
        for k, value in enumerate(single.ladder.values)
        if value in double.ladder.values
    ]
    times = [double.processor[i] / single.processor[k] for i, k in shared]
    times = [ratio for ratio in times if np.isfinite(ratio)]
    if not times:
        return "What single saves cannot be told."
    held, less = np.fmax.reduce(double.memory), np.fmax.reduce(single.memory)
    memory = f", and single holds {less / held:.2g} of its memory" if held > 0 and np.isfinite(less) else ""
    return (
        f"At equal tolerance, double takes {min(times):.2g} to {max(times):.2g} times as long as single{memory}."
    )


DIAGRAM = Diagram(
    "precision",
    "Single against double precision",
    "BEM in single and in double precision by tolerance, on one grid each: against the same grid solved tightly "
    "in double precision, so that the error of the grid does not enter.",
    contests,
    advice,
)
