"""Numbers as people read them: significant digits, powers of ten, and errors to two digits."""

from math import floor, inf, isfinite, isnan, log10
from numbers import Integral, Real
from typing import Any

# Numbers from the one to below the other are written without a power of ten.
LEAST_PLAIN, MOST_PLAIN = 1e-3, 1e5
DIGITS = 4
MOST_DIGITS = 5  # of a number with its interval, whatever the interval
# An error this small over its value is one of rounding.
ROUNDING = 1e-9
SUPERSCRIPT = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
UNKNOWN = "–"


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
