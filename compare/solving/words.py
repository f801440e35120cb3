"""Words: numbers as people read them, intervals, times and errors, and the verdicts on claims.

It imports neither what solves nor what judges, so that both may word what they have to say.
"""

from collections import Counter
from collections.abc import Sequence
from math import floor, inf, isfinite, isnan, log10
from numbers import Integral, Real
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ..statistics.finding import Claim, Finding

# Numbers from the one to below the other are written without a power of ten.
LEAST_PLAIN, MOST_PLAIN = 1e-3, 1e5
DIGITS = 4
MOST_DIGITS = 5  # of a number with its interval, whatever the interval
# An error this small over its value is one of rounding.
ROUNDING = 1e-9
SUPERSCRIPT = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
UNKNOWN = "–"
HOUR = 3600.0
# Units of times with the time from which on the next one is taken, and units of moduli.
TIMES = (0.995e-4, 1e-6, "µs"), (0.0995, 1e-3, "ms"), (99.5, 1.0, "s"), (2 * HOUR, 60.0, "min"), (inf, HOUR, "h")
MODULI = (1e9, "GPa"), (1e6, "MPa"), (1e3, "kPa"), (1.0, "Pa")
VERDICTS = ("holds", "fails", "undecided", "reported")
HOLDS, FAILS, UNDECIDED, REPORTED = VERDICTS
# What draws of a solver, or of a model, are called.
DRAWS = {"MDR": "profiles", "BEM": "surfaces", "1D": "profiles", "1D corrected": "profiles", "3D": "surfaces"}


def shown(value: Any) -> str:
    """Any value as text: yes or no, integers whole, other numbers to four digits, a dash for what is not known."""
    if type(value).__name__ in ("bool", "bool_"):
        return "yes" if value else "no"
    if isinstance(value, Integral):
        return _signed(str(int(value)))
    if isinstance(value, Real):
        return number(float(value))
    return UNKNOWN if value is None else str(value)


def number(value: float, digits: int = DIGITS) -> str:
    """A number to some significant digits, without zeros at its end."""
    if not isfinite(value):
        return UNKNOWN if isnan(value) else "∞" if value > 0 else "−∞"
    value = float(f"{value:.{digits - 1}e}")  # 9.9999 is 10
    power = _power(value)
    return _signed(f"{value / 10.0**power:.15g}") + _times(power)


def interval(value: float, low: float, high: float, digits: int = DIGITS) -> str:
    """A number with the ends of its interval, to two digits of half of it, five in all.

    The number alone where there is no interval, or where it is too narrow for these digits.
    """
    half = (high - low) / 2
    if not ROUNDING * abs(value) < half < inf:  # not known, or an error of rounding
        return number(value, digits)
    largest = max(map(abs, (value, low, high)))
    power = _power(largest)
    decimals = max(0, 1 - floor(log10(half / 10.0**power)))
    decimals = min(decimals, MOST_DIGITS - 1 - floor(log10(largest / 10.0**power)))
    middle, below, above = (_signed(f"{each / 10.0**power:.{decimals}f}") for each in (value, low, high))
    return number(value, MOST_DIGITS) if below == above else f"{middle} ({below} to {above}){_times(power)}"


def counted(findings: Sequence["Finding"]) -> str:
    """Verdict of all findings, or how often each stands."""
    counts = Counter(each.verdict for each in findings)
    if len(counts) == 1:
        return findings[0].verdict
    return ", ".join(f"{name} {counts[name]}" for name in VERDICTS if counts[name])


def _power(value):
    """Power of ten that is written behind a number; 0 behind one of ordinary size."""
    return 0 if value == 0 or LEAST_PLAIN <= abs(value) < MOST_PLAIN else floor(log10(abs(value)))


def _times(power):
    return f" × 10{str(power).translate(SUPERSCRIPT)}" if power else ""


def _signed(text):
    """A minus that is as wide as a plus; none before zero."""
    return text.replace("-", "−") if text.strip("-0.") else text.lstrip("-")


def seconds(value: float) -> str:
    """A time in two digits with a unit."""
    if not isfinite(value):
        return "an unknown time"
    one, unit = next((one, unit) for most, one, unit in TIMES if value < most)
    return f"{value / one:.{'2g' if value < 99.5 * one else '0f'}} {unit}"


def pascals(value: float) -> str:
    """A modulus in three digits, with the prefix in which it reads well."""
    one, unit = next((each for each in MODULI if value >= 0.9995 * each[0]), MODULI[-1])
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


def amount(claim: "Claim", text: str) -> str:
    """A number of a claim with its unit; text : the number in words, already to scale"""
    unit = "%" if claim.percent else claim.unit
    return text if unit in ("", "1") else f"{text} {unit}"


def tested(claim: "Claim") -> str:
    """Number that a claim is tested against, with tolerance and unit; empty without a claim."""
    if not isfinite(claim.tolerance):
        return ""
    expected, tolerance = (number(claim.scale * each) for each in (claim.expected, claim.tolerance))
    if not isfinite(claim.expected):
        return amount(claim, f"at most {tolerance}")
    return amount(claim, f"{expected} ± {tolerance}" if claim.tolerance else expected)


def found(finding: "Finding", figures: int = DIGITS) -> str:
    """Value with its interval and unit; figures : significant digits of a value without interval"""
    if not isfinite(finding.value):
        return "not known"
    value, low, high = (finding.claim.scale * each for each in (finding.value, *finding.interval))
    return amount(finding.claim, interval(value, low, high, figures))


def crossed(finding: "Finding") -> str:
    """Where an interval leaves the tolerance; empty where it does not."""
    claim, (low, high) = finding.claim, finding.interval
    ends = (claim.expected - claim.tolerance, claim.expected + claim.tolerance)
    inside = [amount(claim, number(claim.scale * each)) for each in ends if low < each < high]
    return f"its interval reaches across {' and '.join(inside)}" if inside else ""


def basis(finding: "Finding") -> str:
    """Parts of an interval: numbers of profiles and surfaces, and error of the grid."""
    if not isfinite(finding.grid):
        return ""
    counts = finding.drawn or ({finding.dimension: finding.draws} if finding.draws else {})
    parts = [f"{count} {DRAWS.get(name, f'draws of {name}')}" for name, count in counts.items()]
    return ", ".join([*parts, f"grid {number(finding.grid, 2)}"])


def sentences(findings: Sequence["Finding"]) -> list[str]:
    """A line for each finding: the verdict, the claim, the number in its place, and why it is open."""
    return list(map(_sentence, findings))


def _sentence(finding) -> str:
    verdict = "" if finding.verdict == REPORTED else f"{capital(finding.verdict)}: "
    place = ", ".join(filter(None, [finding.where, finding.dimension]))
    against = tested(finding.claim)
    parts = [f"{found(finding, 3)} ({place})", f"tested against {against}" if against else ""]
    why = f" {capital(finding.why)}." if finding.why else ""
    return f"{verdict}{finding.claim.sentence}: {', '.join(filter(None, parts))}.{why}"
