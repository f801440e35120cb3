"""The claims of Eq. 23: what shifts of the curves of one series come to."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import isfinite, nan
from typing import Generic, TypeVar

import numpy as np

from ..commoncurve import LEAST_OVERLAP
from ..finding import Finding
from ..mastercurve import DEGREE
from ..statistics.jackknife import Estimated, RmsMisfit
from ..samples import Samples
from ..shifting import Shifting, misfit_at, shift
from ..verdict import DIMENSIONS
from .laws import Laws
from .question import COLLAPSE, TOLERANCE
from .series import COARSE, FINE, ROUGH, Series, Solved

SHIFTS = "study-shifts"
_UNKNOWN = "the scatter is not known, or neighbouring curves share too little once shifted"
ONE_CURVE = "Eq. 23: shifts along the load bring friction at all speeds onto one curve"


def shiftings(solved: Solved, solver: str) -> tuple[Shifting, Shifting] | None:
    """Of the fine and of the coarse answers; None where points are too few."""
    try:
        return shift(samples(solved, solver, FINE)), shift(samples(solved, solver, COARSE))
    except ValueError:
        return None


def samples(solved: Solved, solver: str, grid: str = FINE) -> Samples:
    """Friction of the rough body."""
    answers = solved(solver, ROUGH, grid)
    return Samples(np.array(solved.series.speeds), answers.normal_force, answers.friction_force)


def shift_findings(solver: str, both: tuple[Shifting, Shifting], laws: Laws) -> Iterator[Finding]:
    """Whether curves fall onto one, with the shifts that are best and with those predicted."""
    for claim in (*_fitted(*both), *_predicted(both, laws)):
        measured, grid = claim.numbers[0], claim.grid
        low, high = (float(end) for end in measured.interval())
        known = isfinite(low) and isfinite(high) and isfinite(grid)
        yield Finding(
            claim=claim.claim,
            dimension=DIMENSIONS[solver],
            expected=claim.expected,
            tolerance=claim.tolerance,
            value=float(measured.value),
            statistical=(low, high),
            grid=grid,
            surfaces=both[0].samples.surfaces,
            regime=laws.regime.words,
            figure=claim.figure,
            text=claim.text,
            undecidable=claim.undecidable or ("" if known else _UNKNOWN),
        )


_Number = TypeVar("_Number", RmsMisfit, Estimated[float])


@dataclass(frozen=True)
class _Claim(Generic[_Number]):
    """What two fits say of a claim: numbers of the fine and of the coarse one, all else as of Finding."""

    claim: str
    numbers: tuple[_Number, _Number]
    figure: str
    text: str
    undecidable: str = ""
    expected: float = 0.0
    tolerance: float = TOLERANCE

    @property
    def grid(self) -> float:
        fine, coarse = self.numbers
        return fine.apart(coarse)


def _fitted(fine: Shifting, coarse: Shifting) -> Iterator[_Claim[RmsMisfit]]:
    """With the shifts that are best."""
    straight, parted = inseparable(fine), fine.horizontal.reason or ""
    beside = "" if fine.both.reason else f" Shifted along friction too, they miss by {fine.both.misfit.value:.1%}."
    yield _Claim(
        ONE_CURVE,
        (fine.horizontal.misfit, coarse.horizontal.misfit),
        COLLAPSE,
        f"rms of ln mu about one curve without what scatter adds; {fine.none.rms:.0%} before shifting. All shifts "
        f"are found at once, and neighbouring curves share {LEAST_OVERLAP:.0%} of their range at least.{beside}",
        straight or _unless_beyond(fine.horizontal.misfit, parted),
    )
    yield _Claim(
        "Eq. 23: no shift along friction is needed",
        (fine.horizontal.mended, coarse.horizontal.mended),
        SHIFTS,
        "rms of ln mu of what vertical shifts beside the horizontal ones would take from the misfit; vertical "
        f"shifts alone leave {fine.vertical.misfit.value:.1%}.",
        straight or _unless_beyond(fine.horizontal.mended, parted),
    )


def _predicted(both: tuple[Shifting, Shifting], laws: Laws) -> Iterator[_Claim[RmsMisfit] | _Claim[Estimated[float]]]:
    """With those of the theory, and how the best ones compare."""
    fine, coarse = both
    yield _Claim(
        "Eqs. 22, 23: shifted by p(v) of the loss at the shortest wave, friction falls onto one curve",
        (misfit_at(fine, _kept(fine, laws)), misfit_at(coarse, _kept(coarse, laws))),
        COLLAPSE,
        "The same with the shifts that the theory gives, none fitted.",
    )
    if isfinite(laws.exponent):
        yield _Claim(
            "Eqs. 22, 23: p(v) is the power of the speed that the loss at the shortest wave gives",
            (fine.horizontal.exponent, coarse.horizontal.exponent),
            SHIFTS,
            "Exponent of the horizontal shifts against the speed, least squares.",
            inseparable(fine) or fine.horizontal.reason or "",
            laws.exponent,
            TOLERANCE * abs(laws.exponent),
        )


def inseparable(shifting: Shifting) -> str:
    """Why a horizontal shift cannot be told from a vertical one; empty where it can."""
    if shifting.separable:
        return ""
    if not isfinite(shifting.straight.value):
        return "scatter is not known, nor whether the curves are bent"
    return "straight parallel lines fit: a horizontal shift cannot be told from a vertical one"


def unshifted(series: Series, solver: str, laws: Laws) -> Iterator[Finding]:
    """The first of these claims where points were asked for that can be shifted, and too few have an answer."""
    speeds, presses = len(series.speeds), len(series.presses)
    if speeds > 1 and speeds * presses > 2 * (speeds - 1) + DEGREE + 1:
        yield Finding(
            claim=ONE_CURVE,
            dimension=DIMENSIONS[solver],
            expected=0.0,
            tolerance=TOLERANCE,
            value=nan,
            statistical=(nan, nan),
            grid=nan,
            surfaces=series.drawn(solver),
            regime=laws.regime.words,
            figure=COLLAPSE,
            text="Nothing was shifted.",
            undecidable="too few points have an answer on half of the surfaces",
        )


def _unless_beyond(size, reason):
    """Curves that part miss by more at any overlap that is larger: beyond the tolerance that decides."""
    return "" if size.interval()[0] > TOLERANCE else reason


def _kept(shifting, laws):
    """The shifts predicted for the speeds that are left."""
    return laws.shifts[np.isin(laws.speeds, shifting.speeds)]
