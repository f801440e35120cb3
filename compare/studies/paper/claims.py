"""Claims of the paper on its one-dimensional model, and what the simulation measures of each.

The body of the model is the straight line between the nodes of its profile, and the flow past it is solved
exactly: on half the pixel the same line has the same friction to rounding. A finer grid with more waves is another
body, as the pixel is the cut-off by definition, and one of the parameters of Fig. 3. The grid has no share in the
intervals.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from ...finding import EXACT, FAILS, Claim, Finding
from ...statistics import eq23
from ...statistics.jackknife import Estimated
from .conditions import FLAG, between
from .law import Law, difference
from .losses import ROUGH, STIFFNESS, WHOLE, Lossy
from .parameter_studies import Line, SlowFriction, line

DIMENSION = "1D"
_EXPONENT = Claim(
    id="paper.eq17.exponent",
    sentence="Eq. 17: friction at low speed grows as xi^1 where its conditions hold",
    expected=1.0,
    tolerance=0.02,
    meaning="Exponent of a power law through points with xi at most 0.05, h_0 at most d/10, 2a below L, and a "
    "macroscopic slope of at most a fifth of that of the roughness. Small slopes are not among the conditions: "
    "with heights, the slope of the cone and the load times any number, friction is times that number exactly.",
    dimension=DIMENSION,
)
_ANY_SLOPE = replace(
    _EXPONENT,
    id="paper.eq17.exponent.any-slope",
    sentence="Eq. 17: friction at low speed grows as xi^1 whatever the macroscopic slope",
    meaning="Exponent without the condition on the macroscopic slope: Eq. 11 drops it, which on a nearly smooth "
    "profile makes all the friction.",
)
_SLOPE_KEPT = replace(
    _EXPONENT,
    id="paper.eq17.exponent.slope-kept",
    sentence="Eq. 17: friction at low speed grows as xi^1 with the macroscopic slope kept as in Eq. 10",
    meaning="Exponent without the condition on the macroscopic slope, with the mean square of both slopes in "
    "place of that of the roughness.",
)
_ALPHA = Claim(
    id="paper.eq19.alpha",
    sentence="Eq. 19: the exponent alpha that joins low speed and plateau is 1.5",
    expected=1.5,
    tolerance=0.1,
    meaning="Least squares of ln mu over all xi. How it depends on what is made least is in the table of "
    "exponents.",
    dimension=DIMENSION,
)
_SAME_ALPHA = Claim(
    id="paper.eq19.alpha.difference",
    sentence="Eq. 19: alpha does not depend on the shape",
    expected=0.0,
    tolerance=0.1,
    meaning="Difference of alpha between the shapes, on the same profiles. Places of a cone differ more in depth, "
    "and lose contact over a wider range of speeds.",
    dimension=DIMENSION,
)
_PLATEAU = Claim(
    id="paper.eq14.plateau",
    sentence="Eq. 14: the plateau of friction is sqrt(2) times the rms slope",
    expected=1.0,
    tolerance=0.03,
    meaning="mu-tilde at the greatest xi over Eq. 19 there, with the rms slope by finite differences.",
    dimension=DIMENSION,
)
_MEANINGLESS = "the curves do not collapse, and their shifts have no meaning"
# Of the claims on shifts, those of the paper.
_SHIFTS = (eq23.COLLAPSE.id, eq23.PREDICTED.id, eq23.EXPONENT.id)


def lines(slow: SlowFriction) -> dict[str, Line]:
    """Straight lines through the logarithms of Fig. 3, by what the points are."""
    points, kept = slow.points, slow.with_macro_slope
    holds = points["holds"].to_numpy(bool)
    slowly = _slow(points)
    everywhere = np.ones_like(holds)
    asked: dict[str, tuple[np.ndarray, np.ndarray | float]] = {
        "conditions hold": (holds, 1.0),
        "conditions hold, over 1 + r²": (holds, kept),
        "any macroscopic slope": (slowly, 1.0),
        "any macroscopic slope, over 1 + r²": (slowly, kept),
        "all points": (everywhere, 1.0),
        "all points, over 1 + r²": (everywhere, kept),
    }
    xi = points["xi"].to_numpy()
    return {name: line(xi, slow.samples, where, over) for name, (where, over) in asked.items()}


def findings(
    slow: SlowFriction, fits: Mapping[str, Line], laws: Sequence[Law], losses: Sequence[Lossy]
) -> list[Finding]:
    """Every claim, in the order of the paper."""
    return [*_slope_one(slow, fits), *_alphas(laws), *_plateaus(laws), *_shifts(losses)]


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
    cases = (
        (_EXPONENT, "conditions hold", points["holds"].to_numpy(bool)),
        (_ANY_SLOPE, "any macroscopic slope", _slow(points)),
        (_SLOPE_KEPT, "any macroscopic slope, over 1 + r²", _slow(points)),
    )
    for claim, name, where in cases:
        fit = fits[name]
        slopes = f", rms slope {between(points['rms_slope'][where])}" if where.any() else ""
        found = exact(claim, Estimated(fit.slope, np.nan, 0), slow.samples.shape[1], "paper-studies")
        yield replace(found, scatter=fit.slope_interval, regime=f"{fit.count} points{slopes}")


def _slow(points):
    """Where all conditions hold but that on the macroscopic slope."""
    return np.logical_and.reduce([points[FLAG + name].to_numpy(bool) for name in ("xi << 1", "2a < L", "h0 << d")])


def _alphas(laws) -> Iterator[Finding]:
    for law in laws:
        yield exact(_ALPHA, law.alpha, law.profiles, "paper-law", law.shape, _regime(law))
    one, other = laws
    where, draws = f"{one.shape} minus {other.shape}", min(one.profiles, other.profiles)
    yield exact(_SAME_ALPHA, difference(one, other), draws, "paper-law", where)


def _plateaus(laws) -> Iterator[Finding]:
    for law in laws:
        yield exact(_PLATEAU, law.plateau, law.profiles, "paper-law", law.shape, _regime(law))


def _regime(law):
    points = law.points
    return f"xi {between(points['xi'])}, rms slope {between(points['rms_slope'])}"


def _shifts(losses) -> Iterator[Finding]:
    for lossy in losses:
        ratio = lossy.points[STIFFNESS]
        for of in (WHOLE, ROUGH):
            found = lossy.collapses[of]
            collapse = ""
            middle = found.speeds[found.speeds.size // 2]
            for each in eq23.findings(
                found,
                None,
                DIMENSION,
                shifts=lossy.exponent * np.log(found.speeds / middle),
                exponent=lossy.exponent,
                where=f"{lossy.loss.symbols}, {of}",
                draws=lossy.profiles,
                regime=f"|G(v/a)|/G₀ {between(ratio)}",
                plots=(f"shifted-curves{lossy.loss.suffix}",) * 2,
            ):
                if each.claim.id == eq23.COLLAPSE.id:
                    collapse = each.verdict
                if each.claim.id == eq23.EXPONENT.id and collapse == FAILS:
                    each = replace(each, reason=_MEANINGLESS)
                if each.claim.id in _SHIFTS:
                    yield each
