"""Claims of the paper on its one-dimensional model, and what the simulation measures of each.

The body of the model is the straight line between the nodes of its profile, and the flow past it is solved
exactly: on half the pixel the same line has the same friction to rounding. A finer grid with more waves is another
body, as the pixel is the cut-off by definition, and one of the parameters of Fig. 3. The grid has no share in the
intervals.
"""

from collections.abc import Iterator
from dataclasses import replace

from ...statistics.finding import Claim, Finding
from ...statistics.intervals import Estimated
from .law import Law
from .parameter_studies import SlowFriction

EXPONENT = Claim(
    id="paper.eq17.exponent",
    sentence="Eq. 17: friction at low speed grows as ξ¹ where its conditions hold",
    expected=1.0,
    tolerance=0.02,
    meaning="Exponent of a power law through points with ξ at most 0.05, h₀ at most d/10, 2a below L, and a "
    "macroscopic slope of at most a fifth of that of the roughness. Small slopes are not among the conditions: "
    "with heights, the slope of the cone and the load times any number, friction is times that number exactly.",
    dimension="1D",
)
ANY_SLOPE = replace(
    EXPONENT,
    id="paper.eq17.exponent.any-slope",
    sentence="Eq. 17: friction at low speed grows as ξ¹ whatever the macroscopic slope",
    meaning="Exponent without the condition on the macroscopic slope: Eq. 11 drops it, which on a nearly smooth "
    "profile makes all the friction.",
)
SLOPE_KEPT = replace(
    EXPONENT,
    id="paper.eq17.exponent.slope-kept",
    sentence="Eq. 17: friction at low speed grows as ξ¹ with the macroscopic slope kept as in Eq. 10",
    meaning="Exponent without the condition on the macroscopic slope, with the mean square of both slopes in "
    "place of that of the roughness.",
)
ALPHA = Claim(
    id="paper.eq19.alpha",
    sentence="Eq. 19: the exponent α that joins low speed and plateau is 1.5",
    expected=1.5,
    tolerance=0.1,
    meaning="Least squares of ln μ over all ξ.",
    dimension="1D",
)
SAME_ALPHA = Claim(
    id="paper.eq19.alpha.difference",
    sentence="Eq. 19: α does not depend on the shape",
    expected=0.0,
    tolerance=0.1,
    meaning="Difference of α between the shapes, on the same profiles. Places of a cone differ more in depth, "
    "and lose contact over a wider range of speeds.",
    dimension="1D",
)
PLATEAU = Claim(
    id="paper.eq14.plateau",
    sentence="Eq. 14: the plateau of friction is √2 times the rms slope",
    expected=1.0,
    tolerance=0.03,
    meaning="μ̃ at the greatest ξ over Eq. 19 there, with the rms slope by finite differences.",
    dimension="1D",
)


def of_low_speed(slow: SlowFriction) -> Iterator[Finding]:
    """Eq. 17: where its conditions hold, with any macroscopic slope, and with that slope kept."""
    for claim, condition, over in (
        (EXPONENT, "holds", 1.0),
        (ANY_SLOPE, "slow", 1.0),
        (SLOPE_KEPT, "slow", slow.with_macro_slope),
    ):
        slope, count = slow.power(slow.points[condition].to_numpy(), over)
        yield exact(claim, slope, slow.samples.shape[1], regime=f"{count} points")


def of_law(one: Law, other: Law) -> Iterator[Finding]:
    """Eq. 19 and Eq. 14, of each shape and between both."""
    for law in (one, other):
        yield exact(ALPHA, law.alpha, law.profiles, law.shape)
        yield exact(PLATEAU, law.plateau, law.profiles, law.shape)
    between = f"{one.shape} minus {other.shape}"
    yield exact(SAME_ALPHA, one.less(other), min(one.profiles, other.profiles), between)


def exact(claim: Claim, measured: Estimated, draws: int, where: str = "", regime: str = "") -> Finding:
    """Finding of a number whose only error is that of the average over profiles."""
    return Finding.of(claim, measured, where=where, draws=draws, regime=regime)
