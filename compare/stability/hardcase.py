"""A hard case: what is hard, what must hold, and how it is examined."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from math import nan
from typing import ClassVar


@dataclass(frozen=True)
class Size:
    """How large the grids and histories of the collection are.

    line, square, row : points of a 1D grid, a side of a 3D one, and along a single row of pixels
    dense : points a side of grids on which the conditions of contact are computed anew, point by point
    steps : of the longest march in one dimension
    march : of the longest in three dimensions, on a square of 24 points
    """

    name: str
    line: int
    square: int
    row: int
    dense: int
    steps: int
    march: int


SMALL = Size("small", line=1000, square=48, row=128, dense=24, steps=2000, march=60)
LARGE = Size("large", line=20_000, square=192, row=1024, dense=48, steps=100_000, march=3000)
SIZES = {size.name: size for size in (SMALL, LARGE)}


@dataclass(frozen=True)
class Check:
    """One number that must not exceed another; NaN never holds."""

    what: str
    found: float
    allowed: float
    message: ClassVar[None] = None

    @property
    def holds(self) -> bool:
        return bool(self.found <= self.allowed)


@dataclass(frozen=True)
class Refusal:
    """What cannot be answered and must be refused by name.

    what : was asked
    message : the error that came of it; what came instead, in brackets, where it was the wrong one or none
    found : how many of the names that the message must contain are missing; NaN with the wrong error or none
    """

    what: str
    message: str
    found: float
    allowed: ClassVar[float] = 0.0

    @property
    def holds(self) -> bool:
        return bool(self.found <= self.allowed)


def refusal(what: str, error: type[Exception], names: Iterable[str], ask: Callable[[], object]) -> Refusal:
    """Ask for what must be refused with an error whose message contains some names."""
    try:
        answer = ask()
    except error as said:
        message = " ".join(str(said).split())
        return Refusal(what, message, float(sum(name not in message for name in names)))
    except Exception as said:
        return Refusal(what, f"({type(said).__name__}: {said})", nan)
    return Refusal(what, f"(answered: {answer!s:.80})", nan)


def deviation(what: str, found: float, expected: float, allowed: float) -> Check:
    """That a number is another to within a relative deviation."""
    return Check(f"{what}: relative deviation", abs(found - expected) / abs(expected), allowed)


@dataclass(frozen=True)
class HardCase:
    """One hard case.

    group, name : the name in kebab-case, unique in the collection
    about : what is hard, one sentence
    law : what must hold, with the tolerance and where it comes from
    examine : size -> what was found, one check or refusal at least; raises what a solve raises
    """

    group: str
    name: str
    about: str
    law: str
    examine: Callable[[Size], tuple[Check | Refusal, ...]]
