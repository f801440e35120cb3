"""The temperature at which a contact makes just the heat that keeps it there."""

from collections.abc import Callable, Sequence
from math import isfinite, log, nan, sqrt
from typing import Protocol

from ..protocol import SolveError

RELATIVE, LEAST = 1e-6, 1e-9  # to which both sides agree: of the rise, and [K]
# Left between both sides where the temperature is known to that; more is a jump, at which they do not agree.
JUMP = 1e-3
MOST_TRIALS = 100
LEAP = 10.0  # times the difference of both sides, at most


class Trial(Protocol):
    """A contact that is warmer than the scene by so much [K], and the rise [K] that its friction then makes."""

    warmer: float
    rise: float


def settled(attempt: Callable[[float], Trial]) -> Trial:
    """The trial at the least x >= 0 with rise(x) = x, where a contact that warms up from 0 stays.

    The rise must not be negative, and grow ever faster, then ever slower, and then fall, as far as it does each:
    then no lower solution is passed by. Until a trial makes less heat than keeps it warm, each is as warm as the
    one before makes it, which is never too warm while the rise grows. Where it grows ever faster a secant is not
    either, and goes farther; past the place where both sides are closest, any step is safe. The first trial that
    is too warm lies beyond the solution, and no other is between it and the one before. Raises SolveError where
    there is none.
    """
    low, high, warmer = 0.0, None, 0.0
    tried: list[tuple[float, float]] = []
    while len(tried) < MOST_TRIALS:
        trial = attempt(warmer)
        excess, agreed = trial.rise - warmer, RELATIVE * abs(trial.rise) + LEAST
        _check(trial, agreed)
        tried.append((warmer, excess))
        if abs(excess) <= agreed:
            return trial
        low, high = (warmer, high) if excess > 0 else (low, warmer)
        if high is None:
            warmer = _ahead(tried)
        elif high - low > RELATIVE * low + LEAST:
            warmer = _between(low, high, tried)
        elif abs(excess) <= JUMP * trial.rise:
            return trial
        else:
            raise SolveError(
                f"friction jumps where it heats the contact by {warmer:g} K, so that no temperature agrees with "
                "the heat; leave heating.feedback out"
            )
    reached = f"above {low:g} K" if high is None else f"between {low:g} and {high:g} K"
    raise SolveError(
        f"no rise of temperature found that agrees with the heat in {MOST_TRIALS} solves: it lies {reached}; "
        "leave heating.feedback out"
    )


def _check(trial, agreed):
    """Raise SolveError for a rise that cannot warm anything."""
    if not isfinite(trial.rise) or trial.rise < -agreed:
        raise SolveError(
            f"heating by {trial.rise:g} K of a contact warmer by {trial.warmer:g} K: feedback takes friction and "
            "depth that are not negative, and a finite estimate; leave heating.feedback out"
        )


def _ahead(tried: Sequence[tuple[float, float]]) -> float:
    """Next trial, as warm as the last one makes it; farther, to the end of the secant, while the rise grows."""
    x, excess = tried[-1]
    if len(tried) == 1:
        return x + excess
    before, more = tried[-2]
    falls = (more - excess) / (x - before)
    return x + excess / min(max(falls, 1 / LEAP), 1.0)


def _between(low: float, high: float, tried: Sequence[tuple[float, float]]) -> float:
    """Next trial by the last two; by halves, or by halves of decades, where that leaves the bracket."""
    guess = _expected(*tried[-2:])
    if low < guess < high:
        return guess
    least = max(low, LEAST)
    return sqrt(least) * sqrt(high) if high > 4 * least else (low + high) / 2


def _expected(before: tuple[float, float], last: tuple[float, float]) -> float:
    """x = rise(x) from two trials: of an exponential where the rise falls, as times do, else of a line."""
    (a, first), (b, second) = before, last
    if min(first + a, second + b) > 0:
        rate = (log(first + a) - log(second + b)) / (b - a)
        if rate > 0:
            # Only feedback of heat needs it.
            from scipy.special import wrightomega

            return float(wrightomega(log(rate) + log(second + b) + rate * b)) / rate
    return b - second * (b - a) / (second - first) if second != first else nan
