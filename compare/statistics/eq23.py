"""Claims of Eqs. 22 and 23: what shifts of friction at several speeds, fitted or predicted, come to."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from math import isfinite, nan
from operator import attrgetter
from typing import Any, TypeVar

import numpy as np

from .collapse import DEGREE, PARTED, ROUNDING, Alignment, Collapse
from .commoncurve import LEAST_OVERLAP
from .finding import FAILS, Claim, Finding
from .intervals import Estimated, RmsMisfit

# Largest misfit in ln mu that counts as one curve, and relative error of an exponent that counts as predicted.
TOLERANCE = 0.05
_MISFIT = "rms of ln μ about one curve, without what scatter adds"
_POWER = "Exponent of the horizontal shifts against the speed, least squares."


def _misfit(name: str, sentence: str, meaning: str, expected: float = nan) -> Claim:
    """Claim on a misfit in percent, or a number that is only reported."""
    return Claim(f"eq23.{name}", sentence, expected, expected + TOLERANCE, meaning, percent=True)


COLLAPSE = _misfit(
    "collapse",
    "Eq. 23: shifts along the load bring friction at all speeds onto one curve",
    f"{_MISFIT}. All shifts are found at once, and neighbouring curves share {LEAST_OVERLAP:.0%} of their "
    "range at least.",
    0.0,
)
VERTICAL = _misfit(
    "vertical",
    "Eq. 23: no shift along friction is needed",
    "rms of ln μ that vertical shifts, in addition to the horizontal ones, would take from the misfit.",
    0.0,
)
PREDICTED = _misfit(
    "predicted",
    "Eqs. 22, 23: shifted by p(v) of the loss at the shortest wave, friction falls onto one curve",
    f"{_MISFIT}, with the shifts that the theory gives, none fitted.",
    0.0,
)
EXPONENT = Claim(
    "eq23.exponent",
    "Eqs. 22, 23: p(v) is the power of the speed that the loss at the shortest wave gives",
    meaning=_POWER,
)
UNSHIFTED = _misfit(
    "unshifted", "Misfit of friction to one curve before shifting", f"{_MISFIT}, where no curve is shifted."
)
VERTICAL_ALONE = _misfit(
    "vertical-alone",
    "Misfit of friction to one curve with vertical shifts alone",
    f"{_MISFIT}, with a shift along friction at each speed and none along the load.",
)
BOTH = _misfit(
    "both",
    "Misfit of friction to one curve with shifts along load and friction",
    f"{_MISFIT}, with both shifts at each speed.",
)
NOT_SHIFTED = Claim(
    "eq23.vertical-exponent",
    "Eq. 23: exponent of a shift along friction, with a shift along the load, as a power of the speed",
    expected=0.0,
    tolerance=0.0,
    meaning="Exponent of the vertical shifts against the speed, least squares. Zero is claimed where both shifts "
    "can be distinguished and the interval excludes it: then both are the answer.",
)
JOINT = Claim(
    "eq23.exponent-beside-vertical",
    "Exponent of the shift along the load where the curves are shifted along friction too",
    meaning=_POWER,
)
ALONE = Claim(
    "eq23.exponent-alone",
    "Exponent of the shift along the load where no curve is shifted along friction",
    meaning=_POWER,
)
NO_SHIFT = "none, as these shifts do not bring the curves onto one"
MISFIT, GAIN = attrgetter("horizontal.misfit"), attrgetter("horizontal.gain_from_vertical_shift")
LEFT = attrgetter("both.misfit")
_Number = TypeVar("_Number", RmsMisfit, Estimated)
TOO_FEW = "too few points have an answer on half of the surfaces"
CLOSER = "speeds closer to each other may tell"
_UNKNOWN = "its scatter is not known, or neighbouring curves share too little once shifted"


def findings(
    fine: Collapse,
    coarse: Collapse | None,
    dimension: str,
    shifts: Mapping[float, float] | np.ndarray | None = None,
    exponent: float = nan,
    every: bool = False,
    horizontal: bool = False,
    **place: Any,
) -> Iterator[Finding]:
    """Findings on the shifts of a set of curves; the first is on horizontal shifts alone.

    Where friction itself is shifted (`needs_vertical_shift`), the exponent comes from the fit of both shifts, and
    the gain from vertical shifts is reported without a claim: a small gain does not show that there is no shift.

    coarse : the collapse on a grid of half the points; None for data without a grid, which have no grid error
    shifts : ln p(v) that the theory predicts, for `fine.speeds` (S,) or by speed; None where it predicts none
    exponent : of p(v) as a power of the speed, predicted; NaN where p(v) is none
    every : whether the exponents of both fits are reported even where horizontal shifts are the answer
    horizontal : whether these are the only shifts that are asked about, as in the paper
    place : other fields of a `Finding`, such as where; `draws`, if absent, is taken from the fit
    """
    both = not horizontal and needs_vertical_shift(fine, coarse)
    parted, straight = fine.horizontal.reason, fine.inseparable
    if shifts is not None and not isinstance(shifts, Mapping):
        shifts = dict(zip(fine.speeds.tolist(), shifts, strict=True))
    place = {"dimension": dimension, "draws": fine.data.surfaces} | place

    def judged(claim, number, reason=""):
        return finding(claim, number(fine), number(coarse) if coarse else None, reason, **place)

    yield judged(COLLAPSE, MISFIT, straight or _unless_beyond(MISFIT(fine), parted))
    vertical = replace(VERTICAL, tolerance=nan) if both else VERTICAL
    yield judged(vertical, GAIN, straight or _unless_beyond(GAIN(fine), parted))
    if shifts is not None:
        known = shifts
        yield judged(
            PREDICTED, lambda found: found.misfit_at(np.array([known[speed] for speed in found.speeds.tolist()]))
        )
        if isfinite(exponent):
            claim = replace(EXPONENT, expected=exponent, tolerance=TOLERANCE * abs(exponent))
            number = attrgetter("both.exponent" if both else "horizontal.exponent")
            yield judged(claim, number, straight or ("" if both else parted))
    yield judged(UNSHIFTED, attrgetter("unshifted.misfit"))
    yield judged(VERTICAL_ALONE, attrgetter("vertical.misfit"))
    if not fine.both.reason:
        yield judged(BOTH, LEFT)
    if both or every:
        none, neither = parted or _apart(MISFIT, fine, coarse), _neither(fine, coarse)
        across = NOT_SHIFTED if both else replace(NOT_SHIFTED, tolerance=nan)
        for claim, name, reason in (
            (ALONE, "horizontal.exponent", none),
            (JOINT, "both.exponent", neither),
            (across, "both.vertical_exponent", neither),
        ):
            yield judged(claim, (lambda found: Estimated(nan, nan, 0)) if reason else attrgetter(name), reason)


def needs_vertical_shift(fine: Collapse, coarse: Collapse | None = None) -> bool:
    """Whether the fit of both shifts is the answer, and horizontal ones alone are its alternative.

    Where both can be distinguished and bring the curves onto one, the interval of the vertical exponent has to
    exclude zero. Nearly straight lines distinguish them so little that the interval is found from a tangent that
    does not hold; there vertical shifts have to lower the misfit, too.
    """
    if _neither(fine, coarse) or not GAIN(fine).interval()[0] > ROUNDING:
        return False
    grid = coarse.both.vertical_exponent if coarse else None
    low, high = finding(NOT_SHIFTED, fine.both.vertical_exponent, grid).interval
    return low > 0 or high < 0


def leading(found: Collapse, findings: Iterable[Finding]) -> Alignment:
    """Alignment that findings on curves have as the answer."""
    both = any(each.claim.id == NOT_SHIFTED.id and each.verdict == FAILS for each in findings)
    return found.both if both else found.horizontal


def finding(claim: Claim, fine: _Number, coarse: _Number | None = None, reason: str = "", **place: Any) -> Finding:
    """Finding of a number that fits on two grids give; on one, with None, of data that have no grid."""
    found = replace(fine, grid=0.0 if coarse is None else fine.apart(coarse))
    remedy = CLOSER if reason == PARTED else ""
    return Finding.of(claim, found, _UNKNOWN, reason, remedy=remedy, **place)


def too_few(dimension: str, **place: Any) -> Finding:
    """Finding on the collapse where points were asked for that can be shifted, and too few have an answer."""
    return Finding(COLLAPSE, nan, reason=TOO_FEW, dimension=dimension, **place)


def shiftable(speeds: int, points: int) -> bool:
    """Whether a number of speeds, with a number of points each, is enough to find shifts of both kinds."""
    return speeds > 1 and speeds * points > 2 * (speeds - 1) + DEGREE + 1


def _neither(fine, coarse):
    """Reason why the fit of both shifts has no exponents."""
    return fine.both.reason or _apart(LEFT, fine, coarse)


def _apart(misfit, fine, coarse):
    """Reason why shifts have no exponent: what they leave is no one curve."""
    return NO_SHIFT if finding(COLLAPSE, misfit(fine), coarse and misfit(coarse)).verdict == FAILS else ""


def _unless_beyond(missed, reason):
    """The reason, unless the misfit is too large: curves that part miss by more at any larger overlap."""
    return "" if missed.interval()[0] > TOLERANCE else reason
