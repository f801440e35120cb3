"""Checks of the arguments of a formula: each function raises ValueError naming the argument and its value."""

from numbers import Integral

import numpy as np


def positive(**arguments):
    """Finite numbers above zero, or arrays of such."""
    _require(arguments, lambda x: (x > 0) & (x < np.inf), "positive and finite")


def not_negative(**arguments):
    """Finite numbers from zero on, or arrays of such."""
    _require(arguments, lambda x: (x >= 0) & (x < np.inf), "finite and not negative")


def between(low, high, **arguments):
    """Numbers from low to high, both included, or arrays of such."""
    _require(arguments, lambda x: (x >= low) & (x <= high), f"from {low:g} to {high:g}")


def whole(least, **arguments):
    """Sequences of whole numbers, none below the least."""
    for name, values in arguments.items():
        for value in values:
            if not isinstance(value, Integral) or isinstance(value, bool) or value < least:
                raise ValueError(f"{name} = {value!r} must be a whole number, at least {least}")


def one_of(allowed, **arguments):
    """Words out of a list."""
    for name, value in arguments.items():
        if value not in allowed:
            raise ValueError(f"{name} = {value!r} must be one of {', '.join(allowed)}")


def _require(arguments, holds, allowed):
    for name, value in arguments.items():
        numbers = np.atleast_1d(np.asarray(value, float))
        wrong = numbers[~holds(numbers)]
        if wrong.size:
            raise ValueError(f"{name} = {wrong[0]:g} must be {allowed}")
