"""Speeds, loads and depths of a sweep: numbers, quantities with units, lists and ranges of them."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import islice
from math import isfinite, log10
from typing import Any, TypeAlias

import numpy as np

from scene.files.reading import InvalidInput, whole
from scene.motion import PRESSES
from scene.numeric_input import one_by_one
from scene.printable import brief
from scene.quantities import SPEED

from ...solving.cost import MOST_VALUES

# Speeds, loads or depths as they are given: numbers in SI, or texts, see `values_of`.
Values: TypeAlias = Sequence[str | float] | str | float
# Points of a range over a factor of ten where no number of them is stated.
TO_A_DECADE = 3


def values_of(name: str, given: Any, least: float | None = None) -> tuple[float, ...]:
    """Distinct finite numbers in SI, in rising order, of a speed, load or depth. Raises InvalidInput.

    given : numbers, or texts as "1 mm/s", "1mm/s,10mm/s", "1mm/s..1m/s" or, of seven points, "1mm/s..1m/s:7"
    least : 0 where zero is allowed too
    """
    single = isinstance(given, str) or getattr(given, "ndim", None) == 0 or not isinstance(given, Iterable)
    try:
        parts = [given] if single else list(islice(one_by_one(given), MOST_VALUES + 1))
    except ValueError as error:
        raise InvalidInput(f"{name} = {brief(repr(given))}: {error}") from None
    found = [number for part in parts for number in _numbers(name, part, least)]
    if len(found) > MOST_VALUES:
        raise InvalidInput(f"{name}: more than {MOST_VALUES:,} values: at most so many are solved at")
    if not found or len(set(found)) < len(found):
        raise InvalidInput(f"{name} = {brief(repr(parts))}: at least one, and each once")
    return tuple(sorted(found))


def _numbers(name, given, least) -> Iterator[float]:
    """Numbers of one item, of which a text may state several."""
    for part in given.split(",") if isinstance(given, str) else [given]:
        low, dots, rest = part.partition("..") if isinstance(part, str) else (part, "", "")
        if not dots:
            yield _number(name, part, least)
            continue
        high, colon, count = rest.partition(":")
        first, last = (_number(name, end, None) for end in (low, high))
        points = 1 + round(TO_A_DECADE * abs(log10(last / first)))
        if colon:
            told = f"{name} = {brief(repr(part))}: points"
            points = whole(told, int(count) if count.strip().isdecimal() else count, MOST_VALUES)
        yield from np.geomspace(first, last, max(2, points)).tolist()


def _number(name, given, least):
    allowed = "finite numbers of zero or more" if least == 0 else "finite numbers above zero"
    try:
        value = float((SPEED if name == "speed" else PRESSES[name]).value(given))
        wrong = "" if isfinite(value) and (value > 0 or value == least) else allowed
    except OverflowError:  # of a whole number beyond those of floating point
        wrong = allowed
    except ValueError as error:
        wrong = f"{allowed}, {str(error).removeprefix('Input should be ')}"
    if wrong:
        raise InvalidInput(f"{name} = {brief(repr(given))}: {wrong}")
    return value
