"""Claims of Eqs. 22 and 23: what shifts of friction at several speeds, fitted or predicted, come to."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from math import isfinite, nan
from operator import attrgetter
from typing import Any, TypeVar

import numpy as np

from ..finding import EXACT, HALVED, UNKNOWN, Claim, Finding
from .collapse import DEGREE, Collapse
from .commoncurve import LEAST_OVERLAP
from .intervals import Estimated, RmsMisfit

# Of ln mu, and relative of an exponent: what still counts as one curve, and as the exponent predicted.
TOLERANCE = 0.05
_MISFIT = "rms of ln mu about one curve, without what scatter adds"
COLLAPSE = Claim(
    id="eq23.collapse",
    sentence="Eq. 23: shifts along the load bring friction at all speeds onto one curve",
    expected=0.0,
    tolerance=TOLERANCE,
    meaning=f"{_MISFIT}. All shifts are found at once, and neighbouring curves share {LEAST_OVERLAP:.0%} of their "
    "range at least.",
)
VERTICAL = Claim(
    id="eq23.vertical",
    sentence="Eq. 23: no shift along friction is needed",
    expected=0.0,
    tolerance=TOLERANCE,
    meaning="rms of ln mu of what vertical shifts beside the horizontal ones would take from the misfit.",
)
PREDICTED = Claim(
    id="eq23.predicted",
    sentence="Eqs. 22, 23: shifted by p(v) of the loss at the shortest wave, friction falls onto one curve",
    expected=0.0,
    tolerance=TOLERANCE,
    meaning=f"{_MISFIT}, with the shifts that the theory gives, none fitted.",
)
EXPONENT = Claim(
    id="eq23.exponent",
    sentence="Eqs. 22, 23: p(v) is the power of the speed that the loss at the shortest wave gives",
    meaning="Exponent of the horizontal shifts against the speed, least squares.",
)
UNSHIFTED = Claim(
    id="eq23.unshifted",
    sentence="Misfit of friction to one curve before shifting",
    meaning=f"{_MISFIT}, where no curve is shifted.",
)
VERTICAL_ALONE = Claim(
    id="eq23.vertical-alone",
    sentence="Misfit of friction to one curve with vertical shifts alone",
    meaning=f"{_MISFIT}, with a shift along friction at each speed and none along the load.",
)
BOTH = Claim(
    id="eq23.both",
    sentence="Misfit of friction to one curve with shifts along load and friction",
    meaning=f"{_MISFIT}, with both shifts at each speed.",
)
MISFIT, MENDED = attrgetter("horizontal.misfit"), attrgetter("horizontal.mended")
_Number = TypeVar("_Number", RmsMisfit, Estimated)
TOO_FEW = "too few points have an answer on half of the surfaces"
_UNKNOWN = "the scatter is not known, or neighbouring curves share too little once shifted"


def findings(
    fine: Collapse,
    coarse: Collapse | None,
    dimension: str,
    shifts: Mapping[float, float] | np.ndarray | None = None,
    exponent: float = nan,
    where: str = "",
    draws: int | None = None,
    regime: str = "",
    plots: tuple[str, str] = ("", ""),
) -> Iterator[Finding]:
    """Every finding on the shifts of one set of curves.

    coarse : the collapse on a grid of half the points; None of data without a grid, which have no error of one
    shifts : ln p(v) that the theory predicts, for `fine.speeds` (S,) or by speed; None where it predicts none
    exponent : of p(v) as a power of the speed, predicted; NaN where p(v) is none
    draws : number of random surfaces; that of the fit if None
    plots : names of the plots that show the collapse, and the shifts
    """
    parted, straight = fine.horizontal.reason, fine.inseparable
    if shifts is not None and not isinstance(shifts, Mapping):
        shifts = dict(zip(fine.speeds.tolist(), shifts, strict=True))

    def predicted(found):
        return found.misfit_at(np.array([shifts[speed] for speed in found.speeds.tolist()]))

    collapsed, plot_of_shifts = plots
    measured: list[tuple[Claim, Callable[[Collapse], Any], str, str]] = [
        (COLLAPSE, MISFIT, straight or _unless_beyond(MISFIT(fine), parted), collapsed),
        (VERTICAL, MENDED, straight or _unless_beyond(MENDED(fine), parted), plot_of_shifts),
    ]
    if shifts is not None:
        measured.append((PREDICTED, predicted, "", collapsed))
    if shifts is not None and isfinite(exponent):
        claim = replace(EXPONENT, expected=exponent, tolerance=TOLERANCE * abs(exponent))
        measured.append((claim, attrgetter("horizontal.exponent"), straight or parted, plot_of_shifts))
    measured.append((UNSHIFTED, attrgetter("unshifted.misfit"), "", collapsed))
    measured.append((VERTICAL_ALONE, attrgetter("vertical.misfit"), "", plot_of_shifts))
    if not fine.both.reason:
        measured.append((BOTH, attrgetter("both.misfit"), "", plot_of_shifts))
    drawn = fine.data.surfaces if draws is None else draws
    for claim, number, reason, plot in measured:
        found = finding(claim, number(fine), number(coarse) if coarse else None, reason)
        yield replace(found, dimension=dimension, where=where, draws=drawn, regime=regime, plot=plot)


def finding(claim: Claim, fine: _Number, coarse: _Number | None = None, reason: str = "") -> Finding:
    """Finding of a number that fits on two grids give; on one, with None, of data that have no grid."""
    grid = 0.0 if coarse is None else fine.apart(coarse)
    method = EXACT if coarse is None else HALVED if isfinite(grid) else UNKNOWN
    low, high = (float(end) for end in fine.interval())
    known = isfinite(low) and isfinite(high) and isfinite(grid)
    return Finding(
        claim=claim,
        value=float(fine.value),
        scatter=(low, high),
        grid=grid,
        grid_method=method,
        reason=reason or ("" if known else _UNKNOWN),
        size=isinstance(fine, RmsMisfit),
    )


def too_few(dimension: str, where: str = "", draws: int = 0, regime: str = "", plot: str = "") -> Finding:
    """Finding on the collapse where points were asked for that can be shifted, and too few have an answer."""
    return Finding(
        COLLAPSE, nan, dimension=dimension, where=where, draws=draws, regime=regime, plot=plot, reason=TOO_FEW
    )


def shiftable(speeds: int, points: int) -> bool:
    """Whether so many speeds, each with so many points, are enough to find shifts of both kinds."""
    return speeds > 1 and speeds * points > 2 * (speeds - 1) + DEGREE + 1


def _unless_beyond(missed, reason):
    """The reason, unless the misfit is too large: curves that part miss by more at any larger overlap."""
    return "" if missed.interval()[0] > TOLERANCE else reason
