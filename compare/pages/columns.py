"""Columns of a table as people read them: in words with units, a number together with its interval."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite, nan
from numbers import Real
from typing import Any

from pandas import DataFrame

from .. import digits
from ..finding import Finding
from ..vocabulary import head

LOW, HIGH, ERROR = "_low", "_high", "_error"
# Columns of findings that are told together.
JOINED = {"value": ("low", "high"), "expected": ("tolerance",)}


@dataclass(frozen=True)
class Column:
    """A column that is shown.

    name : in the vocabulary
    title : of its head
    values : what its cells are sorted by
    texts : what its cells show
    """

    name: str
    title: str
    values: Sequence[Any]
    texts: Sequence[str]

    @property
    def numeric(self) -> bool:
        """Whether it holds numbers, which stand on the right."""
        return not any(isinstance(value, str) for value in self.values)


def columns(frame: DataFrame, figures: int = digits.DIGITS, merged: bool = True) -> list[Column]:
    """Columns of a table.

    figures : significant digits of numbers without an interval
    merged : whether NAME_low and NAME_high, or NAME_error, are told in the cells of NAME
    """
    names = list(map(str, frame.columns))
    joined = {name: _ends(name, names) if merged else () for name in names}
    hidden = {end for ends in joined.values() for end in ends}
    return [_column(frame, name, joined[name], figures) for name in names if name not in hidden]


def _ends(name, names):
    """Columns that hold the interval of another, or its error."""
    for ends in (JOINED.get(name, ()), (f"{name}{LOW}", f"{name}{HIGH}"), (f"{name}{ERROR}",)):
        if ends and all(end in names for end in ends):
            return ends
    return ()


def _column(frame, name, ends, figures):
    values = frame[name].tolist()
    written = {0: digits.shown, 1: digits.plus_minus, 2: digits.interval}[len(ends)]
    beside = (frame[end].tolist() for end in ends)
    texts = [written(*each, figures) for each in zip(values, *beside, strict=True)]
    return Column(name, head(name), [_key(value) for value in values], texts)


def _key(value):
    return float(value) if isinstance(value, Real) else "" if value is None else str(value)


@dataclass(frozen=True)
class Row:
    """A finding as people read it.

    claim, meaning : what is claimed, and how it is measured
    place : where it was measured, and in which dimensionality
    found : value with its interval and unit
    claimed : number expected with its tolerance; empty of a number without a claim
    """

    finding: Finding

    @property
    def claim(self) -> str:
        return self.finding.claim.sentence

    @property
    def meaning(self) -> str:
        return self.finding.claim.meaning

    @property
    def dimension(self) -> str:
        return self.finding.dimension or self.finding.claim.dimension

    @property
    def place(self) -> str:
        return ", ".join(part for part in (self.finding.where, self.finding.regime) if part)

    @property
    def value(self) -> float:
        return self.finding.value

    @property
    def found(self) -> str:
        low, high = self.finding.interval
        if not isfinite(self.value):
            return "not known"
        return digits.interval(self.value, low, high) + self._unit

    @property
    def expected(self) -> float:
        return self.finding.claim.expected if isfinite(self.finding.claim.tolerance) else nan

    @property
    def claimed(self) -> str:
        claim = self.finding.claim
        if not isfinite(claim.tolerance):
            return ""
        if not isfinite(claim.expected):
            return f"at most {digits.number(claim.tolerance)}{self._unit}"
        return f"{digits.number(claim.expected)} ± {digits.number(claim.tolerance)}{self._unit}"

    @property
    def verdict(self) -> str:
        return self.finding.verdict

    @property
    def reason(self) -> str:
        """Why there is no verdict, or what else has to be said."""
        return self.finding.row["reason"]

    @property
    def basis(self) -> str:
        """What the interval is made of."""
        finding = self.finding
        if not isfinite(finding.grid):
            return ""
        surfaces = f"{finding.draws} surfaces, " if finding.draws else ""
        exact = "" if not finding.grid else f" {digits.number(finding.grid, 2)}"
        return f"{surfaces}grid{exact} ({finding.grid_method})"

    @property
    def _unit(self) -> str:
        unit = self.finding.claim.unit
        return "" if unit in ("", "1") else f" {unit}"
