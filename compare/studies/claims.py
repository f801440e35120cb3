"""The claims on one series that slides: what each of them comes to in one dimension and in three."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from scene.regime import MUCH_LESS_HEIGHT
from scene.scales import elastic_contact

from ..finding import Finding
from ..resampling import Replicates, mean_ratio, resample
from .laws import Laws, slow_drag
from .series import COARSE, FINE, REST, ROUGH, SMOOTH, Solved
from .sides import Pair, Side

DIMENSIONS = {"MDR": "1D", "BEM": "3D"}
BOTH = "1D/3D"
# How far from what is claimed still counts as it: what a reader of a diagram over decades of friction would not
# see, and less than what any measured roughness is known to.
TOLERANCE = 0.05
EXACT = "exact limit of low speed"
# Slow: the loss tangent of the shortest wave, v times the longest time over it, and xi, below which friction is
# off its limit by less than the tolerance. Above FAST Eq. 19 is within 12 % of its plateau.
SLOW, FAST = 0.1, 3.0
LEVELS = "study-levels"


@dataclass(frozen=True)
class Question:
    """A claim that one number decides.

    claim, expected, tolerance, text : as of Finding
    statistic : of a Side or a Pair, a number or an array of which the rms counts
    """

    claim: str
    expected: float
    text: str
    statistic: Callable
    tolerance: float = TOLERANCE


def friction_findings(solved: Solved, laws: Mapping[str, Laws]) -> list[Finding]:
    """Of a series that slides, but for what shifts of its curves say."""
    found = []
    for solver, dimension in DIMENSIONS.items():
        fine, coarse = (Side.of(solved, solver, grid) for grid in (FINE, COARSE))
        words = laws[solver].regime.words
        for question in _one_sided(solved, solver, laws[solver]):
            found.append(answered(question, dimension, fine, coarse, words))
    fine, coarse = (pair(solved, grid) for grid in (FINE, COARSE))
    words = laws["BEM"].regime.words
    found += [answered(question, BOTH, fine, coarse, words) for question in _two_sided(solved, laws["BEM"])]
    return found


def pair(solved: Solved, grid: str) -> Pair:
    """Both dimensionalities on one grid."""
    return Pair(*(Side.of(solved, solver, grid) for solver in DIMENSIONS))


def answered(
    question: Question,
    dimension: str,
    fine,
    coarse,
    regime: str,
    figure: str = LEVELS,
    surfaces: int | None = None,
) -> Finding:
    """The finding from a statistic on two grids; an array counts by its rms, without what scatter adds."""
    replicates: Replicates = resample(lambda side: {"": question.statistic(side)}, fine)[""]
    measured = replicates.size if np.ndim(replicates.value) else replicates.estimated
    low, high = measured.interval()
    other = np.asarray(question.statistic(coarse))
    grid = float(np.sqrt(np.mean(np.square(other - replicates.value))))
    drawn = fine.three.surfaces if isinstance(fine, Pair) else fine.surfaces
    return Finding(
        claim=question.claim,
        dimension=dimension,
        expected=question.expected,
        tolerance=question.tolerance,
        value=float(measured.value),
        statistical=(float(low), float(high)),
        grid=grid,
        surfaces=drawn if surfaces is None else surfaces,
        regime=regime,
        figure=figure,
        text=question.text,
    )


def _one_sided(solved: Solved, solver: str, laws: Laws) -> Iterator[Question]:
    """What the paper claims of friction, asked of one dimensionality."""
    if len(laws.speeds) > 1 and laws.slowest_loss <= SLOW and np.nanmax(laws.xi[0]) <= SLOW:
        yield from _at_low_speed(solved, laws)
    fast = laws.xi[-1] >= FAST
    if fast.any():
        yield Question(
            "Eq. 14: at high speed friction is sqrt(2) times the rms slope",
            1.0,
            "mu over that, times what Eq. 19 has there, at the fastest speed, "
            f"xi = {_range(laws.xi[-1][fast])}, geometric mean over the presses.",
            lambda side: _geometric(side.friction()[-1][fast] / laws.law[-1][fast]),
        )
    yield Question(
        "Eq. 19: friction at all speeds and loads",
        0.0,
        "rms over all points of ln mu less that of the law with alpha = 1.5, without what scatter adds.",
        lambda side: np.log(side.friction() / (laws.law_of(_xi(laws, side)))),
        2 * TOLERANCE,
    )


def _at_low_speed(solved: Solved, laws: Laws) -> Iterator[Question]:
    speeds, low = np.array(solved.series.speeds), _range(laws.xi[0])
    apart = np.log(speeds[1] / speeds[0])
    yield Question(
        "Eq. 17: at low speed friction grows with the speed as the loss at the shortest wave does",
        float(laws.loss_exponent[0]),
        f"d ln mu / d ln v between the two slowest speeds, from xi = {low} on, mean over the presses.",
        lambda side: float(np.mean(np.log(side.friction()[1] / side.friction()[0])) / apart),
    )
    yield Question(
        "Eqs. 16, 17: at low speed friction falls with the load as F_N^(-n/(n+1))",
        laws.exponent_of_load,
        f"d ln mu / d ln F_N at the slowest speed, xi = {low}, least squares over the presses. The law leaves out "
        "the slope of the macroscopic shape.",
        _load_exponent,
    )
    yield Question(
        "Eq. 17: the level of friction at low speed",
        1.0,
        f"mu over the law at the slowest speed, xi = {low}, geometric mean over the presses, with the rms slope "
        "as this dimensionality has it and every wave taken for the shortest.",
        lambda side: _geometric(side.friction()[0] / (laws.plateau * _xi(laws, side)[0])),
    )
    if _is_slow(solved, laws):
        yield Question(
            EXACT,
            1.0,
            "Not of the paper: mu at the slowest speed over v tau times the mean of d2z/dx2 weighted with the "
            "pressure at rest (3D), or over Eq. 10 with the contact at rest (1D); geometric mean over the "
            "presses, on the same surfaces. It tells a fault of a solver from the failure of a law.",
            lambda side: _geometric(side.friction()[0] / _limit(solved, side)),
        )


def _two_sided(solved: Solved, laws: Laws) -> Iterator[Question]:
    """Whether one dimension gives the numbers of three."""
    middle = np.median(np.log(laws.xi), axis=1)
    knee = int(np.argmin(np.nan_to_num(np.abs(middle), nan=np.inf)))
    for place, what in ((0, "the slowest speed"), (knee, "the knee"), (len(middle) - 1, "the fastest speed")):
        yield Question(
            f"friction in 1D is that in 3D, rough, at {what}",
            1.0,
            f"Ratio at xi = {_range(laws.xi[place])}, geometric mean over the presses.",
            lambda both, place=place: _geometric(both.one.friction()[place] / both.three.friction()[place]),
        )
    yield Question(
        "friction in 1D is that in 3D, smooth, at the slowest speed",
        1.0,
        "Ratio for the body without roughness, geometric mean over the presses; it tends to 2 as the speed tends "
        "to zero.",
        lambda both: _geometric(both.one.friction(SMOOTH)[0] / both.three.friction(SMOOTH)[0]),
    )
    yield from rest_questions(solved)


def rest_questions(solved: Solved) -> Iterator[Question]:
    """Whether depth or force at rest is the same in both, where roughness is small against depth and elsewhere."""
    series = solved.series
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
            )
        else:
            yield Question(
                f"at rest, rough, {what}: the force at a depth is the same in 1D and 3D",
                0.0,
                f"rms over {where.sum()} depths of ln of the ratio of forces.",
                lambda both, where=where: _apart(both, "normal_force", np.log)[where],
            )


def _apart(both, name, scale=lambda values: values):
    """1D less 3D at rest, (presses,)."""
    one, three = (scale(side.mean(name, REST)[0]) for side in (both.one, both.three))
    return one - three


def _xi(laws, side):
    return laws.xi_under(side.mean("normal_force", ROUGH))


def _is_slow(solved, laws):
    """Whether every mode of the solid is fast against the slowest speed, so that the limit can be seen."""
    longest = solved.series.scene.elastomer.retardation()[2].max()
    return laws.wave_number * solved.series.speeds[0] * longest <= SLOW


def _limit(solved, side):
    """mu of the exact limit at the slowest speed, (presses,), on the same surfaces."""
    drag = slow_drag(solved.series.scene.elastomer, side.solver, side[REST])
    return solved.series.speeds[0] * mean_ratio(drag, side[REST].normal_force[0]).value


def _load_exponent(side: Side) -> float:
    load = np.log(side.mean("normal_force", ROUGH)[0])
    return float(np.polyfit(load, np.log(side.friction()[0]), 1)[0])


def _geometric(ratios):
    return float(np.exp(np.mean(np.log(ratios))))


def _range(values):
    low, high = np.nanmin(values), np.nanmax(values)
    return f"{low:.2g} to {high:.2g}"
