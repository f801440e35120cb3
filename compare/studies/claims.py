"""The claims on one series that slides: what each of them comes to in one dimension and in three."""

from collections.abc import Iterator, Mapping

import numpy as np

from ..finding import Finding
from ..statistics.jackknife import mean_ratio
from ..verdict import DIMENSIONS
from .laws import Laws, slow_drag
from .pairclaims import friction_questions, pairs, rest_questions, smooth_question
from .question import BOTH, COLLAPSE, TOLERANCE, Question, answered, extent, geometric, power
from .series import COARSE, FINE, REST, ROUGH, Solved
from .sides import Side

EXACT = "exact limit of low speed"
# Slow: the loss tangent of the shortest wave, v times the longest time over it, and xi, below which friction is
# off its limit by less than the tolerance. Above FAST Eq. 19 is within 12 % of its plateau.
SLOW, FAST = 0.1, 3.0


def friction_findings(solved: Solved, laws: Mapping[str, Laws]) -> list[Finding]:
    """Of a series that slides, but for what shifts of its curves say."""
    found = []
    for solver, dimension in DIMENSIONS.items():
        one, other = (Side.of(solved, solver, grid) for grid in (FINE, COARSE))
        words = laws[solver].regime.words
        for question in _one_sided(solved, solver, laws[solver]):
            found.append(answered(question, dimension, one, other, words))
    (fine, coarse), words = pairs(solved), laws["BEM"].regime.words
    friction, rest = friction_questions(laws["BEM"]), rest_questions(solved.series)
    found += [answered(question, BOTH, fine, coarse, words) for question in friction]
    found.append(answered(smooth_question(), BOTH, fine.smooth, coarse.smooth, words))
    return found + [answered(question, BOTH, fine, coarse, words) for question in rest]


def _one_sided(solved: Solved, solver: str, laws: Laws) -> Iterator[Question]:
    """What the paper claims of friction, asked of one dimensionality."""
    if len(laws.speeds) > 1 and laws.slowest_loss <= SLOW and _all_slow(laws.xi[0]):
        yield from _at_low_speed(solved, laws)
    fast = laws.xi[-1] >= FAST
    if fast.any():
        yield Question(
            "Eq. 14: at high speed friction is sqrt(2) times the rms slope",
            1.0,
            "mu over that, times what Eq. 19 has there, at the fastest speed, "
            f"xi = {extent(laws.xi[-1][fast])}, geometric mean over the presses.",
            lambda side: geometric(side.friction()[-1][fast] / laws.law_of(_xi(laws, side))[-1][fast]),
        )
    yield Question(
        "Eq. 19: friction at all speeds and loads",
        0.0,
        "rms over all points of ln mu less that of the law with alpha = 1.5, without what scatter adds.",
        lambda side: np.log(side.friction() / laws.law_of(_xi(laws, side))),
        2 * TOLERANCE,
    )


def _at_low_speed(solved: Solved, laws: Laws) -> Iterator[Question]:
    speeds, low = np.array(solved.series.speeds), extent(laws.xi[0])
    apart = np.log(speeds[1] / speeds[0])
    yield Question(
        "Eq. 17: at low speed friction grows with the speed as the loss at the shortest wave does",
        float(laws.loss_exponent[0]),
        f"d ln mu / d ln v between the two slowest speeds, from xi = {low} on, mean over the presses.",
        lambda side: float(np.mean(np.log(side.friction()[1] / side.friction()[0])) / apart),
    )
    if len(solved.series.presses) > 1:
        yield Question(
            "Eqs. 16, 17: at low speed friction falls with the load as F_N^(-n/(n+1))",
            laws.exponent_of_load,
            f"d ln mu / d ln F_N at the slowest speed, xi = {low}, least squares over the presses. The law leaves "
            "out the slope of the macroscopic shape.",
            _load_exponent,
            figure=COLLAPSE,
        )
    yield Question(
        "Eq. 17: the level of friction at low speed",
        1.0,
        f"mu over the law at the slowest speed, xi = {low}, geometric mean over the presses, with the rms slope "
        "as this dimensionality has it and every wave taken for the shortest.",
        lambda side: geometric(side.friction()[0] / (laws.plateau * _xi(laws, side)[0])),
    )
    if _is_slow(solved, laws):
        yield Question(
            EXACT,
            1.0,
            "Not of the paper: mu at the slowest speed over v tau times the mean of d2z/dx2 weighted with the "
            "pressure at rest (3D), or over Eq. 10 with the contact at rest (1D); geometric mean over the "
            "presses, on the same surfaces. It tells a fault of a solver from the failure of a law. In 3D "
            "friction is found by that mean where the contact trails by less than a quarter of a pixel "
            "(docs/theory.md, Eq. 5e): the check is then of the pressure found in sliding.",
            lambda side: geometric(side.friction()[0] / _limit(solved, side)),
        )


def _xi(laws, side):
    return laws.xi_under(side.mean("normal_force", ROUGH))


def _is_slow(solved, laws):
    """Whether every mode of the solid is fast against the slowest speed, so that the limit can be seen."""
    longest = solved.series.scene.solid.retardation()[2].max()
    return laws.wave_number * solved.series.speeds[0] * longest <= SLOW


def _limit(solved, side):
    """mu of the exact limit at the slowest speed, (presses,), on the same surfaces."""
    drag = slow_drag(solved.series.scene.solid, side.solver, side[REST])
    return solved.series.speeds[0] * mean_ratio(drag, side[REST].normal_force[0]).value


def _load_exponent(side: Side) -> float:
    return power(side.mean("normal_force", ROUGH)[0], side.friction()[0])


def _all_slow(xi):
    """Whether xi is small wherever it is known."""
    known = xi[np.isfinite(xi)]
    return known.size > 0 and known.max() <= SLOW
