"""What contacts on the same pixels have in common, kept for those that follow."""

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache, wraps
from math import prod
from typing import TypeVar

# Points of a grid up to which values are kept, by each method the last ones of as many grids as have KEPT points
# together: at 17 bytes a point 18 MB of each size, and 54 MB at most.
SIZES, KEPT = (2**10, 2**12, 2**14), 2**20

_T = TypeVar("_T")


def cached_on_small_grids(evaluate: Callable[..., _T]) -> Callable[..., _T]:
    """A method of a frozen medium, of a grid wherever that lies, whose last values on small grids are kept.

    They are found by all that they depend on, to the last digit: an answer is the same whatever was solved before.
    Nothing may be written into them.
    """
    remembered = {size: lru_cache(KEPT // size)(evaluate) for size in SIZES}

    @wraps(evaluate)
    def of(medium, grid):
        found = next((remembered[size] for size in SIZES if prod(grid.shape) <= size), evaluate)
        return found(medium, replace(grid, centre=(0.0, 0.0)))

    return of
