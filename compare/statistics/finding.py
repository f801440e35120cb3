"""Claim and finding: what is claimed, what was measured of it, and the one rule of the verdict."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from math import isfinite, nan
from typing import TYPE_CHECKING, Any, Self

from scene.quantities import BARE, WHOLE, argument
from scene.signatures import readable

from ..solving.words import FAILS, HOLDS, REPORTED, UNDECIDED, crossed
from .intervals import Estimated, RmsMisfit

if TYPE_CHECKING:
    import pandas

BOTH = "1D/3D"


def verdict(expected: float, tolerance: float, low: float, high: float) -> str:
    """Verdict on a claim by its interval of 95 %.

    "holds" if the whole interval lies within the tolerance around the expected number, "fails" if none of it does,
    else "undecided"; "undecided" too where an end is unknown.
    """
    least, most = expected - tolerance, expected + tolerance
    if not (isfinite(low) and isfinite(high)):
        return UNDECIDED
    if least <= low and high <= most:
        return HOLDS
    return FAILS if high < least or low > most else UNDECIDED


@dataclass(frozen=True)
class Claim:
    """A statement that one number decides.

    id : name of the claim, such as "rest.depth"; it never changes, and no other claim has it
    sentence : the statement in words, without a full stop
    expected, tolerance : the number claimed, and how far from it still counts as it, both in `unit`; with a
        tolerance of NaN the number is reported without a claim
    meaning : how the number is measured, and what a deviation from it says
    dimension : "1D", "3D", or "1D/3D" of a comparison
    measure : function of a sample of these grids, see `statistics.jackknife.Sample`, that returns a number, or
        an array whose root mean square counts
    percent : whether people read the number in percent
    """

    id: str
    sentence: str
    expected: float = nan
    tolerance: float = nan
    meaning: str = ""
    unit: str = "1"
    dimension: str = BOTH
    measure: Callable[[Mapping[str, Any]], Any] | None = None
    percent: bool = False

    def __post_init__(self):
        for name in ("expected", "tolerance"):
            object.__setattr__(self, name, argument(name, getattr(self, name), BARE.value))

    @property
    def scale(self) -> float:
        """Factor on its numbers as people read them."""
        return 100.0 if self.percent else 1.0


@readable
@dataclass(frozen=True)
class Finding:
    """One claim, and what was measured of it in one place.

    claim : the statement
    value : number measured, in the unit of the claim
    scatter : (low, high), the interval of 95 % over rough surfaces alone; both ends are the value without any
    grid : error of discretisation, absolute, which widens the interval at both ends; NaN if unknown
    where : case, series or diagram in which it was measured
    draws : number of rough surfaces or profiles behind it, of the solver with the fewest; 0 of smooth bodies
    regime : range of the dimensionless groups in which it was measured, in words
    reason : why there is no verdict, or a remark on a stated verdict; else empty
    stated : verdict of a law or a stored value that is no interval; empty where the interval decides
    dimension : "1D", "3D", "1D/3D"; by default, the dimension of the claim
    size : whether the number is one that is never negative, such as an rms
    parts : share in the scatter by solver and stratum of the surfaces; empty where these are not known
    remedy : what would decide it, in words, where it is undecided; empty where nothing is known that would
    drawn : numbers of surfaces or profiles by solver, which `draws` then follows from
    curve : place of the curve that it was measured on, whose surfaces are behind it
    """

    claim: Claim
    value: float
    scatter: tuple[float, float] = (nan, nan)
    grid: float = nan
    where: str = ""
    draws: int = 0
    regime: str = ""
    reason: str = ""
    stated: str = ""
    dimension: str = ""
    size: bool = False
    parts: Mapping[tuple[str, int], float] = field(default_factory=dict, repr=False, compare=False)
    remedy: str = ""
    drawn: Mapping[str, int] = field(default_factory=dict)
    curve: str = ""

    def __post_init__(self):
        object.__setattr__(self, "dimension", self.dimension or self.claim.dimension)
        object.__setattr__(self, "draws", min(self.drawn.values(), default=self.draws))
        for name, take in (
            ("value", BARE.value),
            ("grid", BARE.value),
            ("draws", WHOLE.value),
            ("scatter", BARE.row),
        ):
            object.__setattr__(self, name, argument(name, getattr(self, name), take))

    @classmethod
    def of(
        cls,
        claim: Claim,
        found: Estimated[float] | RmsMisfit,
        unknown: str = "",
        reason: str = "",
        **place: Any,
    ) -> Self:
        """Finding of a number with its scatter and the error of its grid.

        unknown : the reason where the number or one of its errors is not known, unless another is stated
        place : the other fields
        """
        value, low, high, grid = map(float, (found.value, *found.interval(), found.grid))
        known = all(map(isfinite, (value, low, high, grid)))
        return cls(
            claim,
            max(value, 0.0) if found.size else value,
            (low, high),
            grid,
            reason=reason or ("" if known else unknown),
            size=found.size,
            parts={source: float(each) for source, each in found.parts.items()},
            **place,
        )

    @property
    def interval(self) -> tuple[float, float]:
        """Interval of 95 % with the scatter of surfaces and the error of the grid; NaN if either is unknown.

        The error of a grid lowers a size by at most the size of the error; where the error is larger, the size may
        be zero.
        """
        low, high = self.scatter
        less = low - self.grid
        return max(less, 0.0) if self.size else less, high + self.grid

    @property
    def verdict(self) -> str:
        """ "holds", "fails" or "undecided"; "reported" of a number without a claim."""
        if self.stated:
            return self.stated
        if not isfinite(self.claim.tolerance):
            return REPORTED
        if self.undecidable:
            return UNDECIDED
        return verdict(self.claim.expected, self.claim.tolerance, *self.interval)

    @property
    def undecidable(self) -> str:
        """Reason why no verdict is possible whatever the number is; empty if one is."""
        if self.reason:
            return self.reason
        if not isfinite(self.value):
            return "the number is not known"
        if not all(map(isfinite, self.scatter)):
            return "the scatter of surfaces is not known"
        return "" if isfinite(self.grid) else "the error of the grid is not known"

    @property
    def why(self) -> str:
        """Reason why there is no verdict and what would give one, or a remark on a stated verdict; else empty."""
        open_ = self.verdict == UNDECIDED
        reasons = (self.undecidable or crossed(self), self.remedy) if open_ else (self.reason,)
        return "; ".join(filter(None, reasons))

    @property
    def row(self) -> dict[str, Any]:
        """Finding as a row of the table that every command gives."""
        low, high = self.interval
        return {
            "claim": self.claim.id,
            "where": self.where,
            "model": self.dimension,
            "verdict": self.verdict,
            "value": self.value,
            "low": low,
            "high": high,
            "unit": self.claim.unit,
            "expected": self.claim.expected,
            "tolerance": self.claim.tolerance,
            "grid": self.grid,
            "surfaces": self.draws,
            "regime": self.regime,
            "reason": self.why,
            "sentence": self.claim.sentence,
            "meaning": self.claim.meaning,
        }


COLUMNS = tuple(Finding(Claim("", ""), nan).row)


def table(findings: Iterable[Finding]) -> pandas.DataFrame:
    """Findings as one DataFrame, the same columns whatever command they come from."""
    import pandas

    return pandas.DataFrame([each.row for each in findings], columns=list(COLUMNS))


def relabelled(claim: Claim, pair: str) -> Claim:
    """A claim on 1D over 3D, stated for two other models. pair : their labels, with a slash between"""
    if pair == BOTH:
        return claim
    labels = dict(zip(BOTH.split("/"), pair.split("/"), strict=True))

    def renamed(text):
        return re.sub("1D|3D", lambda found: labels[found[0]], text)

    return replace(claim, sentence=renamed(claim.sentence), meaning=renamed(claim.meaning))
