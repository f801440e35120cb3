"""Golden answers are kept: verdicts, numbers to 1e-9 of their size, and apart from these the ends of intervals."""

from functools import cache
from math import nan

import make
import pytest

# Parts that take seconds, and parts that take minutes and run on demand.
QUICK, LONG = {"solvers", "law", "trust"}, {"hurst", "parameters", "regime"}
WITHOUT_INTERVALS = {"solvers", "law", "regress"}


def parts(names):
    marks = {name: pytest.mark.hours if name in LONG else pytest.mark.slow for name in set(names) - QUICK}
    return pytest.mark.parametrize("name", [pytest.param(name, marks=marks.get(name, ())) for name in names])


@cache
def found(name):
    """A part as it is stored, and as two workers find it."""
    return make.stored(name), make.made(name, workers=2)


def moved(name, *columns):
    """What moved in some columns, after a line on the largest change."""
    stored, now = found(name)
    changes = make.moved(stored, now, *columns)
    print(f"{name}: the largest change of {len(now)} numbers is {changes.max():.2g}, of {changes.idxmax()}")
    return make.differences(stored, now, *columns)


@parts(make.PARTS)
def test_verdicts_and_numbers_are_kept(name):
    lines = moved(name, "value") + make.verdicts(*found(name))
    assert not lines, "\n".join(lines)


@parts([name for name in make.PARTS if name not in WITHOUT_INTERVALS])
def test_ends_of_intervals_are_kept(name):
    lines = moved(name, *make.ENDS)
    assert not lines, "\n".join(lines)


def test_a_number_a_verdict_and_a_row_that_changed_are_each_told():
    stored = make.stored("trust").query("value > 0")
    first, others = stored.index[:1], stored[1:]
    for factor, expected in ((1 + make.CLOSE / 2, 0), (1 + 3 * make.CLOSE, 1), (nan, 1)):
        changed = stored.assign(value=stored["value"].where(~stored.index.isin(first), factor * stored["value"]))
        assert len(make.differences(stored, changed, "value")) == expected
        assert not make.differences(stored, changed, *make.ENDS)
    assert len(make.verdicts(stored, stored.assign(verdict=["another", *others["verdict"]]))) == 1
    assert not make.verdicts(stored, stored)
    assert len(make.differences(stored, others, "value")) == len(make.differences(others, stored, "value")) == 1
