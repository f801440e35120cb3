"""A hard case: what is hard, what must hold, and how it is examined."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from math import inf, nan

from pydantic import ValidationError


@dataclass(frozen=True)
class Size:
    """Size of the grids and histories of the collection.

    line, square, row : points of a 1D grid, a side of a 3D one, and along a single row of pixels
    dense : points a side of grids on which the conditions of contact are computed anew, point by point
    steps : of the longest march in one dimension
    march : of the longest in three dimensions, on a square of 24 points
    """

    line: int
    square: int
    row: int
    dense: int
    steps: int
    march: int


SIZES = {
    "quick": Size(line=1000, square=48, row=128, dense=24, steps=2000, march=60),
    "standard": Size(line=5000, square=96, row=512, dense=24, steps=20_000, march=600),
    "full": Size(line=20_000, square=192, row=1024, dense=48, steps=100_000, march=3000),
}


@dataclass(frozen=True)
class Check:
    """One number that must not exceed another; NaN never holds.

    message : error that came of what must be refused; what came instead, in brackets, where it was the wrong one
        or none; absent where an answer was due
    """

    what: str
    found: float
    allowed: float
    message: str | None = None

    @property
    def holds(self) -> bool:
        """Whether the number stays within its bound."""
        return bool(self.found <= self.allowed)

    @property
    def nearness(self) -> tuple[bool, float]:
        """Broken checks are greatest, then those that took most of what is allowed."""
        if self.found != self.found:
            return True, inf
        return not self.holds, self.found / self.allowed if self.allowed > 0 else self.found


@dataclass(frozen=True)
class HardCase:
    """One hard case.

    group, name : the name in kebab-case, unique in the collection
    about : what is hard, one sentence
    law : what must hold, with the tolerance and where it comes from
    examine : size -> what was found, one check at least; raises what a solve raises
    laws : the laws of which `examine` asks one after the other; none of a case with a function of its own
    """

    group: str
    name: str
    about: str
    law: str
    examine: Callable[[Size], Iterable[Check]]
    laws: tuple[Callable[[Size], Iterable[Check]], ...] = ()


class Group(list[HardCase]):
    """Hard cases of one kind, in their order."""

    def __init__(self, name: str) -> None:
        super().__init__()
        self.name = name

    def add(self, name: str, about: str, law: str, *laws: Callable[[Size], Iterable[Check]]) -> None:
        """Add a case that keeps one or several laws."""

        def examine(size):
            return [check for each in laws for check in each(size)]

        self.append(HardCase(self.name, name, about, law, examine, laws))

    def __call__(self, about: str, law: str) -> Callable[[Callable], Callable]:
        """Decorator that makes a function of a size, with a law of its own, the case of its name."""

        def decorated(examine):
            self.add(examine.__name__.replace("_", "-"), about, law, examine)
            return examine

        return decorated


def refusal(what: str, error: type[Exception] | tuple, words: str, ask: Callable, *given, **named) -> Check:
    """Check that a question without an answer is refused by an error with some words, split by " | ".

    It counts how many of them are missing; NaN with the wrong error or none.
    """
    try:
        answer = ask(*given, **named)
    except error as said:
        message = " ".join(str(said).split())
        return Check(what, float(sum(word not in message for word in words.split(" | "))), 0.0, message)
    except Exception as said:
        return Check(what, nan, 0.0, f"({type(said).__name__}: {said})")
    return Check(what, nan, 0.0, f"(answered: {answer!s:.80})")


def invalid(what: str, words: str, ask: Callable, *given, **named) -> Check:
    """Check that an invalid value of a part or a setting is refused when the part is made."""
    return refusal(what, ValidationError, words, ask, *given, **named)


def deviation(what: str, found: float, expected: float, allowed: float) -> Check:
    """A number is another to within a relative deviation; nothing is nothing."""
    apart = 0.0 if found == expected == 0 else abs(found - expected) / abs(expected)
    return Check(f"{what}: relative deviation", apart, allowed)
