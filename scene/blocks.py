"""Blocks of a file that are one table, and what lines above them state of all their rows, as "T = 25 °C"."""

import re
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from .columns import Column, meant
from .printable import brief
from .sheet import Sheet
from .spelling import speaks_of
from .units import in_si

_STATED = re.compile(r"([^:=]+?)\s*[:=]\s*(.*)")  # "T = 25 °C"
_THOUSANDS = re.compile(r"\d[.,]\d{3}(?!\d)")  # or decimals
# Lines that count blocks, or say when they were measured.
_COUNT = re.compile(
    r"(?:interval|step|segment|run|number of|points?|data points|date|time|start)\b", re.IGNORECASE
)


def joined(sheets: Sequence[Sheet], stated: Sequence[Column] = ()) -> Sheet:
    """Blocks of one table of columns as one.

    stated : what lines above a block may state of its rows and of those below, where no column does

    Raises ValueError for blocks with headings of their own, or with fewer or more columns, and for lines that tell
    blocks apart otherwise.
    """
    first, *others = sheets
    for each in others:
        if each.names and (each.names, each.units) != (first.names, first.units):
            raise ValueError(
                f"{first.name} has two tables, from line {first.lines[0]} and from line {each.lines[0]} on: keep "
                "one"
            )
        if each.unread and not each.commented:
            raise ValueError(
                f"{each.name}, line {each.lines[0] - 1}: {brief(repr(each.unread))} parts two tables: keep one"
            )
        if each.numbers.shape[1] != first.numbers.shape[1]:
            raise ValueError(
                f"{each.name}, line {each.lines[0]}: {each.numbers.shape[1]} columns, where line {first.lines[0]} "
                f"has {first.numbers.shape[1]}"
            )
    before = tuple(dict.fromkeys(text for each in sheets for text in each.before))
    lines = tuple(line for each in sheets for line in each.lines)
    heading = replace(first.heading, before=before)
    whole = replace(first, numbers=np.vstack([each.numbers for each in sheets]), lines=lines, heading=heading)
    lacking = [each for each in stated if first.names and not _named(whole, each)]
    for column in lacking:
        whole = _with_stated(whole, sheets, column)
    if stated:
        _refuse_other_blocks(sheets, [each for each in stated if _named(whole, each)])
    return whole


def _named(sheet, column):
    return any(meant(name, (column,)) for name in sheet.names)


def _with_stated(whole, sheets, column):
    """The whole with one column more if lines above its blocks state it for all rows."""
    told, values = None, []
    for each in sheets:
        here = {found for text in each.before if (found := _value(text, column)) is not None}
        if len(here) > 1:
            return whole
        told = next(iter(here), told)
        values.append(told)
    if None in values:
        return whole
    further = np.repeat(values, [len(each.lines) for each in sheets])
    names, units = (*whole.names, column.called[0]), (*whole.units, column.units[0].symbol)
    heading = replace(whole.heading, names=names, units=units)
    return replace(whole, numbers=np.column_stack([whole.numbers, further]), heading=heading)


def _value(text, column):
    """What a line states of a column, in SI; None where it does not, or not in a unit of it."""
    name, value = _STATED.fullmatch(text).groups() if _STATED.fullmatch(text) else ("", "")
    if not meant(name, (column,)):
        return None
    if _THOUSANDS.search(value):
        return None
    unit = column.units[0]
    try:
        return in_si(" ".join(re.split(r"[\s;]+", value)).replace(",", "."), unit.symbol, unit.difference)
    except ValueError:
        return None


def _refuse_other_blocks(sheets, known):
    """Raise ValueError for a line above a later block that says what no column does."""
    for each in sheets[1:]:
        for text in each.before:
            name = _STATED.fullmatch(text)
            if not name or text in sheets[0].before or _COUNT.match(text):
                continue
            if not any(speaks_of(name[1], called) for column in known for called in column.called):
                raise ValueError(
                    f"{each.name}: {brief(repr(text))} above line {each.lines[0]} tells one block from another: "
                    "give what it says, a temperature for one, as a column, or keep one of the blocks"
                )
