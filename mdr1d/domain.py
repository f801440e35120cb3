"""Arguments of formulas: their units, by name, and checks that name the argument and its value."""

from numbers import Integral

import numpy as np

from scene.quantities import (
    BARE,
    CONDUCTIVITY,
    METRE,
    NEWTON,
    PASCAL,
    RADIAN_PER_METRE,
    RADIAN_PER_SECOND,
    SECOND,
    SPEED,
    Unit,
    takes,
)

_LENGTHS = (
    "depth",
    "lengths",
    "contact_length",
    "amplitudes",
    "radius",
    "rms_height",
    "displacement",
    "thickness",
)
_BARE = ("rms_slope", "slopes", "n", "xi", "alpha", "beta", "friction", "shifted_load", "poisson_ratio")

# Decorator of a formula: its arguments become plain numbers in SI, or are refused.
in_si = takes(
    load=NEWTON,
    relaxation_time=SECOND,
    speed=SPEED,
    conductivity=CONDUCTIVITY,
    c=Unit("m^(1-n)"),
    **dict.fromkeys(("modulus", "glassy_modulus", "loss"), PASCAL),
    **dict.fromkeys(_LENGTHS, METRE),
    **dict.fromkeys(("wave_number", "wave_numbers", "band"), RADIAN_PER_METRE),
    **dict.fromkeys(("omega", "reference_frequency"), RADIAN_PER_SECOND),
    **dict.fromkeys(_BARE, BARE),
)


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
    """Values out of a list."""
    for name, value in arguments.items():
        if value not in allowed:
            raise ValueError(f"{name} = {value!r} must be one of {', '.join(allowed)}")


def _require(arguments, holds, allowed):
    for name, value in arguments.items():
        numbers = np.atleast_1d(np.asarray(value, float))
        wrong = numbers[~holds(numbers)]
        if wrong.size:
            raise ValueError(f"{name} = {wrong[0]:g} must be {allowed}")
