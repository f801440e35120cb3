"""Claims on both dimensionalities: whether one dimension gives the friction, depth and force of three."""

from collections.abc import Iterator

import numpy as np

from scene.regime import MUCH_LESS_HEIGHT
from scene.scales import elastic_contact

from .laws import Laws
from .question import DEPTH, Question, extent, geometric
from .series import COARSE, FINE, REST, SMOOTH, Series, Solved
from .sides import Pair, Side

# Of xi to 1: the speed closest to the knee is at it.
AT_THE_KNEE = 3.0


def pairs(solved: Solved) -> tuple[Pair, Pair]:
    """Both dimensionalities on the fine grids and on the coarse ones."""
    fine, coarse = (Pair(Side.of(solved, "MDR", grid), Side.of(solved, "BEM", grid)) for grid in (FINE, COARSE))
    return fine, coarse


def friction_questions(laws: Laws) -> Iterator[Question]:
    """Whether friction is the same below, at and above the knee, where there are such speeds.

    laws : of three dimensions
    """
    for place, what in _places(laws):
        yield Question(
            f"friction in 1D is that in 3D, rough, at {what}",
            1.0,
            f"Ratio at xi = {extent(laws.xi[place])} (3D), geometric mean over the presses.",
            lambda both, place=place: geometric(both.one.friction()[place] / both.three.friction()[place]),
        )


def smooth_question() -> Question:
    """Of a Pair of smooth bodies."""
    return Question(
        "friction in 1D is that in 3D, smooth, at the slowest speed",
        1.0,
        "Ratio for the body without roughness, geometric mean over the presses; it tends to 2 as the speed tends "
        "to zero.",
        lambda both: geometric(both.one.friction(SMOOTH)[0] / both.three.friction(SMOOTH)[0]),
    )


def rest_questions(series: Series) -> Iterator[Question]:
    """Whether depth or force at rest is the same in both, where roughness is small against depth and elsewhere."""
    depths = np.array([elastic_contact(series.at(press)).depth for press in series.presses])
    deep = depths * MUCH_LESS_HEIGHT >= series.scene.roughness.rms_height
    for where, what in ((deep, f"h0 at most {MUCH_LESS_HEIGHT:g} d"), (~deep, f"h0 above {MUCH_LESS_HEIGHT:g} d")):
        if not where.any():
            continue
        if series.pressed_by == "load":
            yield Question(
                f"at rest, rough, {what}: the depth under a load is the same in 1D and 3D",
                0.0,
                f"rms over {where.sum()} loads of the difference of depths, over that of the smooth body.",
                lambda both, where=where: _apart(both, "depth")[where] / depths[where],
                figure=DEPTH,
            )
        else:
            yield Question(
                f"at rest, rough, {what}: the force at a depth is the same in 1D and 3D",
                0.0,
                f"rms over {where.sum()} depths of ln of the ratio of forces.",
                lambda both, where=where: _apart(both, "normal_force", np.log)[where],
                figure=DEPTH,
            )


def _places(laws) -> Iterator[tuple[int, str]]:
    """Speeds by where the median of xi over the presses lies; each is asked once."""
    known = [row[np.isfinite(row)] for row in laws.xi]
    middle = np.array([np.exp(np.median(np.log(row))) if row.size else np.nan for row in known])
    away = np.nan_to_num(np.abs(np.log(middle)), nan=np.inf)
    last, closest = len(middle) - 1, int(np.argmin(away))
    knee = closest if away[closest] <= np.log(AT_THE_KNEE) else None
    if middle[0] < 1 and knee != 0:
        yield 0, "the slowest speed"
    if knee is not None:
        yield knee, "the knee"
    if middle[last] > 1 and knee != last:
        yield last, "the fastest speed"


def _apart(both, name, scale=lambda values: values):
    """1D less 3D at rest, (presses,)."""
    one, three = (scale(side.mean(name, REST)[0]) for side in (both.one, both.three))
    return one - three
