"""Times, errors and settings in words."""

from math import inf, isfinite, nan
from typing import Any

from scene.plain import NotPlain, bare, number
from scene.printable import brief
from scene.quantities import SECOND
from scene.reading import InvalidInput

HOUR = 3600.0


def seconds(value: float) -> str:
    """A time in two digits with a unit."""
    if not isfinite(value):
        return "an unknown time"
    if value < 0.995e-4:
        return f"{1e6 * value:.2g} µs"
    if value < 0.0995:
        return f"{1e3 * value:.2g} ms"
    if value < 2 * HOUR:
        return f"{value:.2g} s" if value < 99.5 else f"{value:.0f} s"
    return f"{value / HOUR:.2g} h" if value < 99.5 * HOUR else f"{value / HOUR:.0f} h"


def duration(seconds: float | None) -> str:
    """Seconds as a person says them; a question mark where they are not known."""
    if seconds is None:
        return "?"
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02d} s"
    return f"{whole // 3600} h {whole % 3600 // 60:02d} min"


def pascals(value: float) -> str:
    """A modulus in three digits, with the prefix in which it reads well."""
    units = ((1e9, "GPa"), (1e6, "MPa"), (1e3, "kPa"))
    one, unit = next((each for each in units if value >= 0.9995 * each[0]), (1.0, "Pa"))
    return f"{value / one:.3g} {unit}"


def share(value: float) -> str:
    """A relative error, per cent while they are readable."""
    if not isfinite(value):
        return "an unknown error"
    if value >= 0.995:
        return f"{100 * value:.0f} %"
    return f"{100 * value:.2g} %" if value >= 0.99e-4 else f"{value:.0e}".replace("e-0", "e-")


def off(ratio: float) -> str:
    """A number over what it should be, in words: 39 % too low, 2.6 times as high."""
    if not isfinite(ratio):
        return "off by an unknown share"
    if ratio >= 2:
        return f"{ratio:.3g} times as high"
    apart = 100 * (ratio - 1)
    return f"{abs(apart):.2g} % too {'high' if apart > 0 else 'low'}"


def capital(words: str) -> str:
    """Words with a capital at their beginning."""
    return words[:1].upper() + words[1:]


def digits(value: float) -> str:
    """A setting as it is written at a point: 1024, 0.5, 1e-3."""
    return f"{value:g}" if value >= 0.01 else f"{value:.0e}".replace("e-0", "e-")


def share_of(name: str, given: Any) -> float:
    """Share between 0 and 1, of a number, one of another library too, or a text as 2%. Raises InvalidInput.

    name : of the argument, for the error
    """
    found, why = nan, ""
    try:
        found = _share(given)
    except NotPlain as reason:
        why = f"; {reason}" if str(reason) else ""
    except (
        ValueError,
        OverflowError,
    ):  # of a text that is no number, and of a number beyond those of floating point
        pass
    if not 0 < found < 1:
        raise InvalidInput(f"{name} = {brief(repr(given))}: a share above 0 and below 1, as 2% or 0.02{why}")
    return found


def _share(given):
    if isinstance(given, str):
        text = given.strip()
        return float(text.removesuffix("%")) / (100 if text.endswith("%") else 1)
    held, unit = bare(given)
    return float(number(held, None)) / 100 if unit == "%" else float(number(given, None))


def seconds_of(name: str, given: float | str) -> float:
    """Seconds above zero, of a number or a text with a unit such as 10min. Raises InvalidInput.

    name : of the argument, for the error
    """
    try:
        found = float(SECOND.value(given))
    except ValueError:
        found = nan
    if not 0 < found < inf:
        raise InvalidInput(f"{name} = {brief(repr(given))}: a time above zero, as 10min or 600 s")
    return found
