"""The claims of Eq. 23: what shifts of the curves of one series come to."""

from collections.abc import Iterator

import numpy as np

from ..finding import Finding
from ..samples import Samples
from ..shifting import Shifting, misfit_at, shift
from .claims import DIMENSIONS, TOLERANCE
from .laws import Laws
from .series import COARSE, FINE, ROUGH, Solved

COLLAPSE, SHIFTS = "study-collapse", "study-shifts"


def shiftings(solved: Solved, solver: str) -> tuple[Shifting, Shifting] | None:
    """Of the fine and of the coarse answers; None where points are too few."""
    try:
        return tuple(shift(samples(solved, solver, grid)) for grid in (FINE, COARSE))
    except ValueError:
        return None


def samples(solved: Solved, solver: str, grid: str = FINE) -> Samples:
    """Friction of the rough body."""
    answers = solved(solver, ROUGH, grid)
    return Samples(np.array(solved.series.speeds), answers.normal_force, answers.friction_force)


def shift_findings(solver: str, both: tuple[Shifting, Shifting], laws: Laws) -> Iterator[Finding]:
    """Whether curves fall onto one, with the shifts that are best and with those predicted."""
    fine, coarse = both
    straight = (
        ""
        if fine.separable
        else ("straight parallel lines fit: a horizontal shift cannot be told from a vertical one")
    )

    def found(claim, expected, tolerance, numbers, figure, text, undecidable=""):
        measured, other = numbers
        low, high = measured.interval()
        return Finding(
            claim=claim,
            dimension=DIMENSIONS[solver],
            expected=expected,
            tolerance=tolerance,
            value=float(measured.value),
            statistical=(float(low), float(high)),
            grid=abs(float(measured.value) - float(other.value)),
            surfaces=fine.samples.surfaces,
            regime=laws.regime.words,
            figure=figure,
            text=text,
            undecidable=undecidable,
        )

    yield found(
        "Eq. 23: shifts along the load bring friction at all speeds onto one curve",
        0.0,
        TOLERANCE,
        (fine.horizontal.misfit, coarse.horizontal.misfit),
        COLLAPSE,
        f"rms of ln mu about one curve without what scatter adds; {fine.none.rms:.0%} before shifting. All shifts "
        "are found at once.",
        straight or fine.horizontal.reason or "",
    )
    yield found(
        "Eq. 23: no shift along friction is needed",
        0.0,
        TOLERANCE,
        (fine.horizontal.mended, coarse.horizontal.mended),
        SHIFTS,
        "rms of ln mu of what vertical shifts beside the horizontal ones would take from the misfit; vertical "
        f"shifts alone leave {fine.vertical.misfit.value:.1%}.",
        straight or fine.horizontal.reason or "",
    )
    yield found(
        "Eqs. 22, 23: shifted by p(v) of the loss at the shortest wave, friction falls onto one curve",
        0.0,
        TOLERANCE,
        tuple(misfit_at(each, _kept(each, laws)) for each in both),
        COLLAPSE,
        "The same with the shifts that the theory gives, none fitted.",
        straight,
    )
    if np.isfinite(laws.exponent):
        yield found(
            "Eqs. 22, 23: p(v) is that power of the speed",
            laws.exponent,
            TOLERANCE * abs(laws.exponent),
            (fine.horizontal.exponent, coarse.horizontal.exponent),
            SHIFTS,
            "Exponent of the horizontal shifts against the speed, least squares.",
            straight or fine.horizontal.reason or "",
        )


def _kept(shifting, laws):
    """The shifts predicted for the speeds that are left."""
    return laws.shifts[np.isin(laws.speeds, shifting.speeds)]
