"""Quantities written with a unit, as "5 mm": read into SI, exactly up to the one rounding to a float."""

import re
from decimal import Decimal, InvalidOperation
from fractions import Fraction
from functools import lru_cache

LONGEST = 100  # letters of a quantity
_DECADES = 400  # of a number; beyond them lies the range of floats, whatever the prefix
_MOST = 9  # power of a unit
# Where a number goes on that ought to have ended: why it is none.
_NO_NUMBER = (
    (re.compile(r"\s*,"), "; numbers have decimal points, and nothing parts their thousands"),
    (re.compile(r"\s*(?:['’_]\s*)?[0-9]"), "; nothing parts the digits of a number"),
    (re.compile(r"\s*(?:±|\+)"), "; a number stands alone, without its uncertainty"),
    (re.compile(r"\s*[*·⋅x×]?\s*(?:10)?\s*(?:\^|\*\*)"), "; powers of ten are written as 1e6"),
)

_PREFIXES = (
    *("femto- = 1e-15 = f-", "pico- = 1e-12 = p-", "nano- = 1e-9 = n-", "micro- = 1e-6 = µ- = μ- = u-"),
    *("milli- = 1e-3 = m-", "centi- = 1e-2 = c-", "deci- = 1e-1 = d-", "hecto- = 1e2 = h-", "kilo- = 1e3 = k-"),
    *("mega- = 1e6 = M-", "giga- = 1e9 = G-", "tera- = 1e12 = T-"),
)
# An angle counts as a dimension: so that a frequency [Hz] is not taken for an angular one [rad/s].
_UNITS = (
    *("meter = [length] = m = metre", "kilogram = [mass] = kg", "second = [time] = s = sec"),
    *("kelvin = [temperature]; offset: 0 = K", "mole = [substance] = mol", "radian = [angle] = rad"),
    *("gram = 1e-3 * kilogram = g", "minute = 60 * second = min", "hour = 3600 * second = h = hr"),
    *("micron = 1e-6 * meter", "angstrom = 1e-10 * meter = Å"),
    *("inch = 0.0254 * meter = in = inches", "foot = 0.3048 * meter = ft = feet"),
    *("mil = 1e-3 * inch = _ = thou", "mile = 1609.344 * meter", "day = 24 * hour"),
    *("mph = mile / hour", "kph = kilometer / hour = _ = kmh = kmph"),  # not thousands of mph
    "degree = 0.01745329251994329576923690768488612713442871888541725 * radian = deg = °",
    "turn = 6.283185307179586476925286766559005768394338798750211642 * radian = _ = revolution",
    *("hertz = 1 / second = Hz", "revolution_per_minute = turn / minute = rpm"),
    *("newton = kilogram * meter / second ** 2 = N", "pascal = newton / meter ** 2 = Pa"),
    *("dyne = 1e-5 * newton = dyn", "gram_force = 9.80665e-3 * newton = gf"),
    *("joule = newton * meter = J", "watt = joule / second = W", "calorie = 4.184 * joule = cal"),
    *("bar = 1e5 * pascal", "atmosphere = 101325 * pascal = atm"),
    *("pound_force = 4.4482216152605 * newton = lbf", "psi = pound_force / inch ** 2", "ksi = 1000 * psi"),
    "degree_Celsius = kelvin; offset: 273.15 = degC = °C = C = celsius = Celsius",
    "degree_Fahrenheit = 5 / 9 * kelvin; offset: 233.15 + 200 / 9 = degF = °F = F = fahrenheit = Fahrenheit",
)
_COUNTED = ("degree_Celsius", "degree_Fahrenheit")
_SHORT = {"delta_degC": "delta_degree_Celsius", "delta_degF": "delta_degree_Fahrenheit"}
# What is suggested, of several that are alike the more usual one first; each prefix where it is in use.
_PREFIXES_IN_USE = {"Pa": "MkGm", "m": "muµnk", "s": "muµn", "N": "mkuµM", "Hz": "kMGm"}
KNOWN = (
    *(prefix + unit for unit, prefixes in _PREFIXES_IN_USE.items() for prefix in prefixes),
    *("m", "s", "K", "mol", "rad", "kg", "g", "min", "h", "deg", "Hz", "rpm", "N", "Pa", "J", "W", "cal", "bar"),
    *("atm", "psi", "ksi", "in", "inch", "ft", "mil", "micron", "angstrom", "turn", "degC", "degF", "kelvin"),
    *("meter", "second", "newton", "pascal", "hertz", "radian", "degree", "joule", "watt", "mole", "celsius"),
    *("lbf", "kgf", "dyn", "mph", "cm", "hPa", "kJ", "mW", "kW", "mK", "mrad", "kcal"),
)
# What is often stated in place of something else: its unit, the wanted one, and what to do.
_CONFUSED = (
    ("1/s", "rad/s", "an angle counts: of f cycles a second give 2 pi f, in rad/s"),
    ("rad/s", "1/s", "cycles are counted: of omega in rad/s give omega / (2 pi), in Hz"),
    ("1/m", "rad/m", "an angle counts: of a wavelength give 2 pi / wavelength, in rad/m"),
    ("kg", "N", "this is a mass: the weight of 1 kg is 1 kgf"),
    ("Pa s", "s", "this is a viscosity: a time is viscosity / shear modulus"),
    ("N", "N/m", "this is a whole force: divide it by the length of the line"),
    ("W/K", "W/(m K)", "mK is a millikelvin: write W/(m K)"),
)

_NUMBER = re.compile(r"\s*([+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)(.*)", re.DOTALL)
# A digit that is glued to a name is its power, as in mm2 and s-1, unless more is glued to it.
_TOKEN = re.compile(
    r"\s*(?:(Δ?°[CF]?|[^\W\d_]+(?:_[^\W\d_]+)*)(?:([2-9]|-[1-9])(?![\w.,^]))?"
    r"|(\*\*|\^)\s*(-?[0-9]+)|([*·⋅/()]|(?<=[^\W_])\.(?=[^\W\d_]))|(1)(?=\s*/))"
)
_RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
# Letters as a keyboard has them; "m²" is m^2.
_PLAIN = (
    ("−", "-"),
    ("\N{KELVIN SIGN}", "K"),
    ("\N{ANGSTROM SIGN}", "Å"),
    ("℃", "°C"),
    ("℉", "°F"),
    ("º", "°"),
    ("˚", "°"),
)
_DEGREES = re.compile(r"(?:\bdeg\.?\s+|°\s+)([CF])(?!\w)")  # as in "deg C"
_SUPERSCRIPT = re.compile("[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+")

PATTERN = r"^\s*[+\-−]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+\-−]?[0-9]+)?\s*[^\s0-9.,].*$"  # of a quantity, roughly


class Unreadable(ValueError):
    """A text is no quantity of the wanted unit; the message says why, unless that is obvious."""


class _Unknown(Unreadable):
    """No unit has this name."""

    def __init__(self, name):
        super().__init__(f"no unit is called {name!r}")
        self.name = name


def in_si(text: str, unit: str, difference: bool = True) -> float:
    """The float nearest to a quantity in an SI unit.

    unit : such as "m", "m/s" or "W/(m K)"
    difference : whether a temperature is a difference, which has no degrees Celsius; else it is an absolute one

    Raises Unreadable for any other dimension, for what is no number with a unit, and beyond the range of floats.
    """
    text = _typed(text)
    written = _NUMBER.fullmatch(text)
    if written is None:
        raise Unreadable("there is no number before the unit" if any(map(str.isalnum, text)) else "")
    factor, zero = scale(written[2], unit, difference)
    return _nearest(_exact(written[1]) * factor + zero)


@lru_cache(maxsize=256)
def scale(given: str, unit: str, difference: bool = True) -> tuple[Fraction, Fraction]:
    """One of a unit, and its zero, in an SI unit: a number of it times the first plus the second is in SI.

    Raises Unreadable as `in_si`.
    """
    given = _typed(given)
    factors = _factors(given)
    if not factors:
        raise Unreadable("there is no unit")
    try:
        asked, wanted = _product(factors), _product(_factors(unit))
    except _Unknown as unknown:
        raise Unreadable(f"{unknown}{_meant(given, unknown.name, unit, difference)}") from None
    if asked.dimensionality != wanted.dimensionality:
        raise Unreadable(_confused(asked, wanted))
    _check_temperature(asked, factors, difference)
    zero, one = (
        Fraction(asked.__class__(each, asked.units).to_base_units().magnitude) for each in map(Fraction, "01")
    )
    return one - zero, zero


@lru_cache(maxsize=256)
def known(given: str) -> bool:
    """Whether a text is a unit of anything. Raises Unreadable as `in_si`."""
    return bool(factors := _factors(_typed(given))) and _product(factors) is not None


def _typed(text):
    """A text in the letters of a keyboard."""
    if len(text) > LONGEST:
        raise Unreadable(f"more than {LONGEST} letters")
    for letter, plain in _PLAIN:
        text = text.replace(letter, plain)
    text = _DEGREES.sub(r"°\1", text)
    return _SUPERSCRIPT.sub(lambda found: "^" + found[0].translate(_RAISED), text)


def _exact(digits):
    try:
        number = Decimal(digits)
    except InvalidOperation:  # of an exponent that is a number of many digits
        raise Unreadable("beyond the range of floating-point numbers") from None
    if number and abs(number.adjusted()) > _DECADES:
        raise Unreadable("beyond the range of floating-point numbers")
    return Fraction(number) if number else Fraction(0)


def _nearest(exact):
    try:
        found = float(exact)
    except OverflowError:
        found = 0.0
    if exact and not found:
        raise Unreadable("beyond the range of floating-point numbers")
    return found


def _factors(text):
    """Names of units with their powers: "W/(m K)" is W, m^-1, K^-1. A slash divides by what follows next."""
    found, position, sign, closing = [], 0, 1, []
    while text[position:].strip():
        token = _TOKEN.match(text, position)
        if token is None:
            raise _no_unit(text)
        name, glued, raised, power, mark, one = token.groups()
        position = token.end()
        outer = closing[-1] if closing else 1
        if name:
            found.append((name, sign * outer * int(glued or 1)))
            sign = 1
        elif raised and found and text[: token.start()].rstrip()[-1:] not in tuple("*·⋅/()"):
            name, before = found[-1]
            if abs(int(power)) > _MOST or abs(before) > 1:
                raise Unreadable(f"{text.strip()!r}: powers of units are whole numbers up to {_MOST}")
            found[-1] = name, before * int(power)
        elif mark == "(":
            closing.append(sign * outer)
            sign = 1
        elif mark == ")" and closing:
            closing.pop()
        elif mark == "/" and sign > 0:
            sign = -1
        elif not one and (mark is None or mark in "()/"):
            raise _no_unit(text)
    if closing or sign < 0:
        raise _no_unit(text)
    return found


def _no_unit(text):
    why = next((why for begins, why in _NO_NUMBER if begins.match(text)), "")
    return Unreadable(f"{text.strip()!r} is no unit{why}")


def _product(factors):
    registry, alone = _registry(), [power for _, power in factors] == [1]
    product = None
    for name, power in factors:
        called = _called(name)
        # A degree in a product is a difference.
        called = called if alone or called not in _COUNTED else f"delta_{called}"
        unit = registry.Quantity(Fraction(1), called) ** power
        product = unit if product is None else product * unit
    return product


def _called(name):
    """Name of a unit in the registry. Raises _Unknown."""
    name, registry = _SHORT.get(name, name), _registry()
    # A name that begins a sentence, as Newton.
    known = registry.parse_unit_name(name) or (name.istitle() and registry.parse_unit_name(name.lower()))
    plural = name.endswith("s") and len(name) <= 4 and known and known == registry.parse_unit_name(name[:-1])
    if known and not plural:  # a plural of a symbol would be taken for a product with seconds
        prefix, unit, _ = known[0]
        return prefix + unit
    raise _Unknown(name)


def _meant(given, name, unit, difference):
    """Units of the wanted dimension that an unknown name may stand for, and what they are in SI, as a question."""
    # Only a mistake needs it.
    from difflib import get_close_matches

    alike = [each for each in KNOWN if each.casefold() == name.casefold()]
    said = []
    for each in alike or get_close_matches(name, KNOWN, n=9):
        meant = re.sub(rf"(?<![^\W\d_]){re.escape(name)}(?![^\W\d_])", each, given.strip())
        try:
            one, zero = scale(meant, unit, difference)
        except Unreadable:
            continue
        said.append(repr(meant) if zero or one == 1 else f"{meant!r} ({float(one):g} {unit})")
    # Letters that differ in case alone leave all of them open.
    return f", did you mean {' or '.join(said if alike else said[:1])}?" if said else ""


def _confused(asked, wanted):
    """What to do with a unit of another dimension that is often stated in place of the wanted one."""
    return next(
        (
            why
            for given, needed, why in _CONFUSED
            if asked.is_compatible_with(_product(_factors(given)))
            and wanted.is_compatible_with(_product(_factors(needed)))
        ),
        "",
    )


def _check_temperature(asked, factors, difference):
    """Degrees Celsius are absolute temperatures, and no differences."""
    if difference and any(asked.units == _registry().Unit(degree) for degree in _COUNTED):
        raise Unreadable("degrees count from a zero of their own, and a difference is in K")
    if not difference and any(name.startswith(("delta", "Δ")) for name, _ in factors):
        raise Unreadable("this is a difference of temperatures")


@lru_cache(maxsize=1)
def _registry():
    # Takes a third of a second, and only what is written with units needs it.
    import pint

    registry = pint.UnitRegistry(None, non_int_type=Fraction)
    for definition in (*_PREFIXES, *_UNITS):
        registry.define(definition)
    return registry
