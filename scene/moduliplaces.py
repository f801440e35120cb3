"""Where the moduli of a table were measured: at which frequencies or times, and at which temperatures."""

from dataclasses import replace

import numpy as np

from . import modulinames as names
from .modulicolumns import Columns
from .quantities import HERTZ
from .table import SCATTER

UNITS = ("rad/s", "Hz")
_ANGULAR = names.ANGULAR.field, names.REDUCED_ANGULAR.field
FREQUENCIES = *_ANGULAR, names.FREQUENCY.field, names.REDUCED.field
_AGREE = 0.01  # relative, of a frequency and an angular one beside it


def frequencies(columns: Columns, stated: str | None) -> tuple[np.ndarray, str | None, bool]:
    """Frequencies, their unit or None, and whether they are reduced to one temperature already.

    stated : unit of the field beside the table. Raises ValueError where the heading contradicts it.
    """
    reduced = any(each.field in columns for each in (names.REDUCED, names.REDUCED_ANGULAR))
    wanted = (names.REDUCED_ANGULAR, names.REDUCED) if reduced else (names.ANGULAR, names.FREQUENCY)
    units = {each.field: _unit(columns, each.field) for each in wanted if each.field in columns}
    if not units:
        sweep = "a sweep of temperature is " if names.TEMPERATURE.field in columns else ""
        raise ValueError(f"{columns.heading}: {sweep}no table of frequencies: it has no column of the frequency")
    _check_both(columns, units)
    known = stated if stated in UNITS else None
    fitting = [name for name, unit in units.items() if known in (None, unit)]
    fitting += [name for name, unit in units.items() if unit is None]
    if not fitting:
        name, unit = next(iter(units.items()))
        raise ValueError(
            f"{columns.heading} gives {columns.found[name].name!r} in {unit}, and frequency_unit = {known!r} is "
            "stated: leave frequency_unit out, or correct the heading"
        )
    columns.used |= units.keys()
    return columns.of(fitting[0]), units[fitting[0]] or stated, reduced


def times(columns: Columns) -> np.ndarray:
    """Times [s], NaN at the step itself, whose modulus no instrument sees."""
    name, table = names.TIME.field, columns.sheet.name
    if name not in columns:
        raise ValueError(f"{columns.heading} has no column of the time")
    column = columns.found[name]
    if (start := column.numbers == 0).any():
        columns.notes.append(f"{table}: {int(start.sum())} rows at time 0 are left out")
        columns.found[name] = replace(column, numbers=np.where(start, np.nan, column.numbers))
    return columns.of(name)


def temperatures(columns: Columns, reduced: bool) -> np.ndarray | None:
    """Temperatures [K]; None where they are not known, and of rows that are reduced from several."""
    name = names.TEMPERATURE.field
    if name not in columns:
        return None
    if columns.found[name].unit is None:
        called = columns.found[name].name
        raise ValueError(f"{columns.heading} states no unit of {called!r}: write degC or K behind it")
    found = columns.of(name)
    return None if reduced and np.ptp(found[~np.isnan(found)]) > SCATTER else found


def factors(columns: Columns) -> np.ndarray | None:
    """By which times are longer than at the reference; None where no column says so."""
    return columns.of(names.SHIFT.field) if names.SHIFT.field in columns else None


def reference(columns: Columns, longer: np.ndarray, temperature: np.ndarray) -> float | None:
    """Temperature at which the factor is 1 [K]; None where it does not lie between those of the rows.

    Raises ValueError of factors that grow with the temperature.
    """
    warm, cold = (longer[temperature == end] for end in (temperature.max(), temperature.min()))
    if np.median(warm) > np.median(cold):
        raise ValueError(
            f"{columns.heading}: the shift factor grows with the temperature, and it is that of times, which grow "
            "shorter: state its inverse"
        )
    order = np.argsort(longer)
    logs = np.log(longer[order])
    return float(np.interp(0.0, logs, temperature[order])) if logs[0] <= 0 <= logs[-1] else None


def _unit(columns, name):
    if columns.found[name].unit is None:
        return "rad/s" if name in _ANGULAR else None
    return "Hz" if columns.found[name].unit is HERTZ else "rad/s"


def _check_both(columns, units):
    """Raise ValueError where a frequency and an angular one contradict one another."""
    if len(units) < 2 or None in units.values():
        return
    one, other = (columns.of(name) * (2 * np.pi if unit == "Hz" else 1) for name, unit in units.items())
    if (np.abs(one - other) > _AGREE * one).any():
        both = " and ".join(repr(columns.found[name].name) for name in units)
        raise ValueError(f"{columns.heading}: {both} contradict one another, 1 Hz is 2 pi rad/s: keep one")
