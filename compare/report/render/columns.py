"""Columns of a table as people read them: in words with units, a number together with its interval."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from numbers import Real
from typing import Any

from pandas import DataFrame

from ...solving.vocabulary import head
from ...statistics import digits
from ...statistics.finding import Finding

LOW, HIGH, ERROR = "_low", "_high", "_error"
# Columns of findings that are told together.
JOINED = {"value": ("low", "high"), "expected": ("tolerance",)}


@dataclass(frozen=True)
class Column:
    """A column that is shown.

    name : in the vocabulary
    title : of its head
    values : what its cells stand for, numbers as floats
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


def regimes_once(findings: Sequence[Finding]) -> list[Finding]:
    """Findings to show, with a regime in the first row of its place alone."""
    seen, found = set(), []
    for each in findings:
        key = each.where, each.dimension, each.regime
        found.append(replace(each, regime="") if key in seen else each)
        seen.add(key)
    return found


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
    keys = [float(each) if isinstance(each, Real) else "" if each is None else str(each) for each in values]
    return Column(name, head(name), keys, texts)
