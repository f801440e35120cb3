"""One rule of the verdict, and one table of findings."""

from dataclasses import replace
from math import inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from compare.solving.words import found as worded
from compare.solving.words import sentences
from compare.solving.words import tested as against
from compare.statistics.finding import FAILS, HOLDS, REPORTED, UNDECIDED, Claim, Finding, verdict

FRICTION = Claim("friction.ratio", "Friction in 1D is that in 3D", expected=1.0, tolerance=0.05)
number = st.floats(-10, 10)
width = st.floats(0, 10)


def found(value=1.0, scatter=0.01, grid=0.01, **other):
    return Finding(FRICTION, value, (value - scatter, value + scatter), grid, **other)


@given(number, width, number, width)
def test_a_claim_holds_only_if_its_whole_interval_lies_inside_the_tolerance(expected, tolerance, value, half):
    low, high = value - half, value + half
    outcome = verdict(expected, tolerance, low, high)
    inside = low >= expected - tolerance and high <= expected + tolerance
    outside = high < expected - tolerance or low > expected + tolerance
    assert outcome == (HOLDS if inside else FAILS if outside else UNDECIDED)


@pytest.mark.parametrize(
    "unknown",
    [{"value": nan}, {"scatter": (nan, nan)}, {"grid": nan}, {"grid": inf}, {"reason": "too few points"}],
)
def test_without_errors_a_claim_is_undecided_and_says_why(unknown):
    finding = replace(found(), **unknown)
    assert finding.verdict == UNDECIDED
    assert finding.row["reason"]


def test_the_grid_widens_the_interval_of_the_scatter():
    assert found().interval == pytest.approx((0.98, 1.02))
    assert found().verdict == HOLDS
    assert found(grid=0.05).verdict == UNDECIDED
    assert found(value=1.2).verdict == FAILS
    # the interval of a number that is never negative is cut at zero
    assert found(grid=2.0, size=True).interval == (0.0, pytest.approx(3.01))


def test_a_law_states_its_verdict_and_a_number_without_a_claim_is_reported():
    assert Finding(FRICTION, 1.0, stated=FAILS).verdict == FAILS
    assert Finding(Claim("time", "Time to 1 %"), 3.0).verdict == REPORTED


def test_an_open_claim_says_across_what_its_interval_reaches_and_what_would_decide_it():
    open_ = found(value=1.04, remedy="some 30 more surfaces would decide it")
    assert open_.why == "its interval reaches across 1.05; some 30 more surfaces would decide it"
    assert found(scatter=0.1).why == "its interval reaches across 0.95 and 1.05"
    assert found(value=1.3, remedy="more").why == found().why == ""
    (line,) = sentences([open_])
    assert line.startswith("Undecided: ")
    assert line.endswith(" Its interval reaches across 1.05; some 30 more surfaces would decide it.")


def test_a_deviation_is_said_in_percent_and_stored_as_it_is():
    share = found(value=0.3, scatter=0.1, grid=0.0)
    share = replace(share, claim=replace(FRICTION, expected=0.0, percent=True))
    assert (worded(share), against(share.claim)) == ("30 (20 to 40) %", "0 ± 5 %")
    assert (share.row["value"], share.row["unit"]) == (0.3, "1")
