"""Speeds, loads and depths of a sweep: numbers, quantities with units, lists and ranges of them."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import islice
from math import isfinite, log10
from typing import Any, TypeAlias

import numpy as np

from scene.files.reading import InvalidInput
from scene.motion import PRESSES
from scene.numeric_input import one_by_one
from scene.printable import brief
from scene.quantities import SPEED, Unit

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
    unit, found = SPEED if name == "speed" else PRESSES[name], list[float]()
    try:
        for part in [given] if single else islice(one_by_one(given), MOST_VALUES + 1):
            found += _numbers(unit, part)
            if len(found) > MOST_VALUES:
                raise ValueError(f"at most {MOST_VALUES:,} values")
        if not all(isfinite(each) and (each > 0 or each == least) for each in found):
            raise ValueError(f"finite numbers {'of zero or more' if least == 0 else 'above zero'}")
        if not found or len(set(found)) < len(found):
            raise ValueError("at least one, and each once")
    except (ValueError, OverflowError) as error:
        reason = str(error).removeprefix("Input should be ")
        raise InvalidInput(f"{name} = {brief(repr(given))}: {reason}") from None
    return tuple(sorted(found))


def _numbers(unit: Unit, given: Any) -> Iterator[float]:
    """Numbers of one item, of which a text may state several."""
    for part in given.split(",") if isinstance(given, str) else [given]:
        ends, colon, count = part.partition(":") if isinstance(part, str) else (part, "", "")
        if not (isinstance(ends, str) and ".." in ends):
            yield float(unit.value(part))
            continue
        first, last = (float(unit.value(end)) for end in ends.split("..", 1))
        if not (first > 0 and last > 0 and isfinite(first + last)):
            raise ValueError("a range has finite ends above zero")
        points = int(count) if colon else 1 + round(TO_A_DECADE * abs(log10(last / first)))
        yield from np.geomspace(first, last, min(max(2, points), MOST_VALUES + 1)).tolist()
