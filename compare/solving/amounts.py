"""Numbers as people read them: significant digits, intervals, times and errors in words."""

from math import floor, inf, isfinite, isnan, log10, nan
from numbers import Integral, Real
from typing import Any

from scene import plain
from scene.printable import brief
from scene.quantities import SECOND
from scene.reading import InvalidInput

# Numbers from the one to below the other are written without a power of ten.
LEAST_PLAIN, MOST_PLAIN = 1e-3, 1e5
DIGITS = 4
MOST_DIGITS = 5  # of a number with its interval, whatever the interval
# An error this small over its value is one of rounding.
ROUNDING = 1e-9
SUPERSCRIPT = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
UNKNOWN = "–"
HOUR = 3600.0


def shown(value: Any, digits: int = DIGITS) -> str:
    """Any value as text: yes or no, integers whole, other numbers to some digits, a dash for what is not known."""
    if value is None:
        return UNKNOWN
    if isinstance(value, str):
        return value
    if isinstance(value, bool) or type(value).__name__ in ("bool", "bool_"):
        return "yes" if value else "no"
    if isinstance(value, Integral):
        return _signed(str(int(value)))
    return number(float(value), digits) if isinstance(value, Real) else str(value)


def number(value: float, digits: int = DIGITS) -> str:
    """A number to some significant digits, without zeros at its end."""
    if not isfinite(value):
        return UNKNOWN if isnan(value) else "∞" if value > 0 else "−∞"
    value = float(f"{value:.{digits - 1}e}")  # 9.9999 is 10
    power = _power(value)
    scaled = value / 10.0**power
    decimals = digits - 1 - floor(log10(abs(scaled))) if scaled else 0
    text = f"{scaled:.{max(decimals, 0)}f}"
    return _signed(text.rstrip("0").rstrip(".") if "." in text else text) + _times(power)


def interval(value: float, low: float, high: float, digits: int = DIGITS) -> str:
    """A number with the ends of its interval, to two digits of half of it, five in all.

    The number alone where there is no interval, or where it is too narrow for these digits.
    """
    half = (high - low) / 2
    if not (isfinite(value) and ROUNDING * abs(value) < half < inf):
        return number(value, digits)
    largest = max(map(abs, (value, low, high)))
    power = _power(largest)
    decimals = min(_decimals(half / 10.0**power), MOST_DIGITS - 1 - floor(log10(largest / 10.0**power)))
    middle, below, above = (_signed(f"{each / 10.0**power:.{decimals}f}") for each in (value, low, high))
    return number(value, MOST_DIGITS) if below == above else f"{middle} ({below} to {above}){_times(power)}"


def with_unit(text: str, unit: str) -> str:
    """A number as text with its unit, of which a ratio has none."""
    return text if unit in ("", "1") else f"{text} {unit}"


def plus_minus(value: float, error: float, digits: int = DIGITS) -> str:
    """value ± error, to two digits of the error; the number alone without one."""
    if not (isfinite(value) and ROUNDING * abs(value) < error < inf):
        return number(value, digits)
    error = float(f"{error:.1e}")  # 9.96 is 10
    power = _power(max(abs(value), error))
    decimals = _decimals(error / 10.0**power)
    both = f"{_signed(f'{value / 10.0**power:.{decimals}f}')} ± {error / 10.0**power:.{decimals}f}"
    return f"({both}){_times(power)}" if power else both


def _power(value):
    """Power of ten that is written behind a number; 0 behind one of ordinary size."""
    return 0 if value == 0 or LEAST_PLAIN <= abs(value) < MOST_PLAIN else floor(log10(abs(value)))


def _decimals(error):
    return max(0, 1 - floor(log10(error)))


def _times(power):
    return f" × 10{str(power).translate(SUPERSCRIPT)}" if power else ""


def _signed(text):
    """A minus that is as wide as a plus; none before zero."""
    if not text.startswith("-"):
        return text
    return f"−{text[1:]}" if text.strip("-0.") else text[1:]


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


def share_of(name: str, given: Any) -> float:
    """Share between 0 and 1, of a number, one of another library too, or a text as 2%. Raises InvalidInput.

    name : of the argument, for the error
    """
    found, why = nan, ""
    try:
        found = _share(given)
    except plain.NotPlain as reason:
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
    held, unit = plain.bare(given)
    return float(plain.number(held, None)) / 100 if unit == "%" else float(plain.number(given, None))


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
