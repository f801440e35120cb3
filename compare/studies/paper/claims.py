"""Claims of the paper on its one-dimensional model, and what the simulation measures of each.

The body of the model is the straight line between the nodes of its profile, and the flow past it is solved
exactly: on half the pixel the same line has the same friction to rounding. A finer grid with more waves is another
body, as the pixel is the cut-off by definition, and one of the parameters of Fig. 3. The grid has no share in the
intervals.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import product

import numpy as np

from ...statistics import eq23
from ...statistics.finding import EXACT, FAILS, Claim, Finding
from ...statistics.intervals import Estimated
from .conditions import FLAG, between
from .law import Law, difference
from .losses import ROUGH, STIFFNESS, WHOLE, Lossy
from .parameter_studies import Line, SlowFriction, line

DIMENSION = "1D"
_EXPONENT = Claim(
    id="paper.eq17.exponent",
    sentence="Eq. 17: friction at low speed grows as ξ¹ where its conditions hold",
    expected=1.0,
    tolerance=0.02,
    meaning="Exponent of a power law through points with ξ at most 0.05, h₀ at most d/10, 2a below L, and a "
    "macroscopic slope of at most a fifth of that of the roughness. Small slopes are not among the conditions: "
    "with heights, the slope of the cone and the load times any number, friction is times that number exactly.",
    dimension=DIMENSION,
)
_ANY_SLOPE = replace(
    _EXPONENT,
    id="paper.eq17.exponent.any-slope",
    sentence="Eq. 17: friction at low speed grows as ξ¹ whatever the macroscopic slope",
    meaning="Exponent without the condition on the macroscopic slope: Eq. 11 drops it, which on a nearly smooth "
    "profile makes all the friction.",
)
_SLOPE_KEPT = replace(
    _EXPONENT,
    id="paper.eq17.exponent.slope-kept",
    sentence="Eq. 17: friction at low speed grows as ξ¹ with the macroscopic slope kept as in Eq. 10",
    meaning="Exponent without the condition on the macroscopic slope, with the mean square of both slopes in "
    "place of that of the roughness.",
)
_ALPHA = Claim(
    id="paper.eq19.alpha",
    sentence="Eq. 19: the exponent α that joins low speed and plateau is 1.5",
    expected=1.5,
    tolerance=0.1,
    meaning="Least squares of ln μ over all ξ. How it depends on what is made least is in the table of exponents.",
    dimension=DIMENSION,
)
_SAME_ALPHA = Claim(
    id="paper.eq19.alpha.difference",
    sentence="Eq. 19: α does not depend on the shape",
    expected=0.0,
    tolerance=0.1,
    meaning="Difference of α between the shapes, on the same profiles. Places of a cone differ more in depth, "
    "and lose contact over a wider range of speeds.",
    dimension=DIMENSION,
)
_PLATEAU = Claim(
    id="paper.eq14.plateau",
    sentence="Eq. 14: the plateau of friction is √2 times the rms slope",
    expected=1.0,
    tolerance=0.03,
    meaning="μ̃ at the greatest ξ over Eq. 19 there, with the rms slope by finite differences.",
    dimension=DIMENSION,
)
_MEANINGLESS = "the curves do not collapse, and their shifts have no meaning"
# The paper's claims on shifts.
_SHIFTS = (eq23.COLLAPSE.id, eq23.PREDICTED.id, eq23.EXPONENT.id)


def lines(slow: SlowFriction) -> dict[str, Line]:
    """Straight lines through the logarithms of Fig. 3, by what the points are."""
    points, kept, xi = slow.points, slow.with_macro_slope, slow.points["xi"].to_numpy()
    choices = {
        "conditions hold": points["holds"].to_numpy(bool),
        "any macroscopic slope": _slow(points),
        "all points": np.ones(len(points), bool),
    }
    return {
        name + suffix: line(xi, slow.samples, where, over)
        for name, where in choices.items()
        for suffix, over in (("", 1.0), (", over 1 + r²", kept))
    }


def findings(
    slow: SlowFriction, fits: Mapping[str, Line], laws: Sequence[Law], losses: Sequence[Lossy]
) -> list[Finding]:
    """Every claim, in the order of the paper."""
    one, other = laws
    where, draws = f"{one.shape} minus {other.shape}", min(one.profiles, other.profiles)
    return [
        *_slope_one(slow, fits),
        *(exact(_ALPHA, law.alpha, law.profiles, "paper-law", law.shape, _regime(law)) for law in laws),
        exact(_SAME_ALPHA, difference(one, other), draws, "paper-law", where),
        *(exact(_PLATEAU, law.plateau, law.profiles, "paper-law", law.shape, _regime(law)) for law in laws),
        *_shifts(losses),
    ]


def exact(claim: Claim, measured: Estimated, draws: int, plot: str, where: str = "", regime: str = "") -> Finding:
    """Finding of a number whose only error is that of the average over profiles."""
    low, high = (float(end) for end in measured.interval())
    return Finding(
        claim=claim,
        value=float(measured.value),
        scatter=(low, high),
        grid=0.0,
        grid_method=EXACT,
        where=where,
        draws=draws,
        regime=regime,
        plot=plot,
    )


def _slope_one(slow, fits) -> Iterator[Finding]:
    """Eq. 17: where its conditions hold, with any macroscopic slope, and with that slope kept."""
    points = slow.points
    for claim, name, where in (
        (_EXPONENT, "conditions hold", points["holds"].to_numpy(bool)),
        (_ANY_SLOPE, "any macroscopic slope", _slow(points)),
        (_SLOPE_KEPT, "any macroscopic slope, over 1 + r²", _slow(points)),
    ):
        fit = fits[name]
        slopes = f", rms slope {between(points['rms_slope'][where])}" if where.any() else ""
        draws, regime = slow.samples.shape[1], f"{fit.count} points{slopes}"
        yield exact(claim, fit.slope, draws, "paper-studies", regime=regime)


def _slow(points):
    """Points at which all conditions hold but that on the macroscopic slope."""
    return np.logical_and.reduce([points[FLAG + name].to_numpy(bool) for name in ("xi << 1", "2a < L", "h0 << d")])


def _regime(law):
    points = law.points
    return f"ξ {between(points['xi'])}, rms slope {between(points['rms_slope'])}"


def _shifts(losses) -> Iterator[Finding]:
    for lossy, of in product(losses, (WHOLE, ROUGH)):
        found, collapse = lossy.collapses[of], ""
        middle = found.speeds[found.speeds.size // 2]
        for each in eq23.findings(
            found,
            None,
            DIMENSION,
            shifts=lossy.exponent * np.log(found.speeds / middle),
            exponent=lossy.exponent,
            where=lossy.where(of),
            draws=lossy.profiles,
            regime=f"|G(v/a)|/G₀ {between(lossy.points[STIFFNESS])}",
            plots=(f"shifted-curves{lossy.loss.suffix}",) * 2,
            horizontal=True,
        ):
            if each.claim.id == eq23.COLLAPSE.id:
                collapse = each.verdict
            if each.claim.id == eq23.EXPONENT.id and collapse == FAILS:
                each = replace(each, reason=_MEANINGLESS)
            if each.claim.id in _SHIFTS:
                yield each
