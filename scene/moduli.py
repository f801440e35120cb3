"""Tables of moduli as people have them: columns found by their names, in a file or in Python, made one table."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from . import modulinames as names
from .blocks import joined
from .columns import chosen, meant, sheet_of
from .files import once
from .heading import named
from .modulicolumns import Columns
from .moduliplaces import FREQUENCIES, factors, frequencies, reference, temperatures, times
from .sheet import Sheet, read_sheets
from .table import MOST_ROWS, SCATTER, CreepTable, RelaxationTable, Table

# In brackets behind a name: what the number depends on, and no unit.
_ARGUMENTS = ("t", "ω", "omega", "w", "f", "δ", "delta", "φ", "d", "phi", "aT", "a_T", "T")
_IDLE = ("(ω)", "(omega)", "(w)", "(f)", "(iω)")
_LOGARITHM = re.compile(r"(?P<log>log10|log|lg|ln)[ _]?(?:\((?P<a>.+)\)|(?P<b>.+))", re.IGNORECASE)
_OTHER = "another "  # before a letter that is no name of ours in this size
_PER_SECOND = ("1/s", "s^-1", "s-1", "s⁻¹", "1/sec", "sec^-1")
_ONE_FREQUENCY = 1.05  # frequencies within this factor are one
_OVER_FREQUENCY, _OVER_TIME = ("storage", "loss", "magnitude"), ("relaxation", "creep")


@dataclass(frozen=True)
class Read:
    """What was read.

    table : with its columns as numbers
    frequency_unit, kind : as the headings have them, or as stated; None where neither says so
    """

    table: Table | RelaxationTable | CreepTable
    frequency_unit: str | None
    kind: str | None


def read_moduli(table: Any, frequency_unit: str | None = None, kind: str | None = None) -> Read:
    """A table of moduli, by its columns, out of a file or of what other libraries hold.

    table : path of a text file, a DataFrame, a Dataset of xarray, or arrays by their names
    frequency_unit, kind : as stated beside it, see `Tabulated`

    Raises ValueError that names file, line and column, and where what is stated contradicts a heading.
    """
    if not _is_table(table):
        raise ValueError(
            "Input should be the path of a text file, numbers by the names of their columns, a DataFrame or a "
            "Dataset of xarray"
        )
    sheet = _spelt(once(_sheet, table) if isinstance(table, str | Path) else sheet_of(table))
    found, notes = chosen(sheet, names.COLUMNS, ("frequency", "storage", "loss"))
    columns = Columns(sheet, found, [each.replace(f"'{_OTHER}", "'") for each in notes])
    over_frequency = any(map(columns.has, _OVER_FREQUENCY)) or (
        names.TIME.field not in columns and any(each in columns for each in FREQUENCIES)
    )
    kind = columns.kind(_OVER_FREQUENCY if over_frequency else _OVER_TIME, kind)
    if over_frequency:
        moduli = columns.complex_modulus(kind)
        place, frequency_unit, reduced = frequencies(columns, frequency_unit)
        return Read(_table(columns, {"frequency": place} | moduli, reduced), frequency_unit, kind)
    moduli = _over_time(columns, kind)
    if frequency_unit is not None:
        raise ValueError(f"{sheet.name} is a table over time: leave frequency_unit = {frequency_unit!r} out")
    return Read(_table(columns, {"time": times(columns)} | moduli), None, kind)


def read_table(path: str | Path) -> Table | RelaxationTable | CreepTable:
    """The table in a text or CSV file: its columns by their headings, else frequency, storage and loss modulus.

    Raises ValueError naming file, line and column.
    """
    return read_moduli(path).table


def _is_table(given):
    """Whether something is a path, or a table of some library."""
    return isinstance(given, str | Path | Mapping) or any(
        hasattr(given, each) for each in ("columns", "variables")
    )


def _sheet(path):
    return joined(read_sheets(path, MOST_ROWS), (names.TEMPERATURE,))


def _spelt(sheet: Sheet) -> Sheet:
    """The sheet with numbers of logarithms, arguments as parts of names such as G(t), and no others in names."""
    called, units, numbers = list(sheet.names), list(sheet.units), sheet.numbers.copy()
    for k, (name, unit) in enumerate(zip(called, units, strict=True)):
        if unit in _ARGUMENTS:
            name, units[k] = f"{name}({unit})", ""
        if logarithm := _LOGARITHM.fullmatch(name):
            inner, within = named(logarithm["a"] or logarithm["b"])
            if meant(inner, names.COLUMNS):
                name, units[k] = inner, units[k] or within
                with np.errstate(over="ignore"):
                    numbers[:, k] = (np.e if logarithm["log"].lower() == "ln" else 10.0) ** numbers[:, k]
        for idle in _IDLE:
            name = name.removesuffix(idle).strip()
        exact = any(name in each.called for each in names.COLUMNS)
        other = len(name) == 1 and not exact and any(_is(name, each) for each in names.COLUMNS)
        called[k] = f"{_OTHER}{name}" if other else name  # "F" is a force, and "d" a thickness
        if units[k] in _PER_SECOND:
            angular = any(_is(name, each) for each in (names.ANGULAR, names.REDUCED_ANGULAR))
            units[k] = "rad/s" if angular else "" if _is(name, names.FREQUENCY) else units[k]
    heading = replace(sheet.heading, names=tuple(called), units=tuple(units))
    return replace(sheet, numbers=numbers, heading=heading)


def _is(name, column):
    return name.casefold() in map(str.casefold, column.called)


def _over_time(columns, kind):
    """The relaxation modulus, or the creep compliance."""
    relaxation, creep = (columns.modulus(each, kind) for each in _OVER_TIME)
    if relaxation is None and creep is None:
        raise ValueError(
            f"{columns.heading} has no modulus: give storage and loss modulus over the frequency, or a relaxation "
            "modulus or creep compliance over time"
        )
    if relaxation is not None and creep is not None:
        raise ValueError(f"{columns.heading} has both a relaxation modulus and a creep compliance: keep one")
    return {"modulus": relaxation} if creep is None else {"compliance": creep}


def _table(columns, made, reduced=False):
    """The table of rows in which nothing is missing, at one temperature where a column shifts them there."""
    sheet, place = columns.sheet, next(iter(made))
    longer = None if reduced else factors(columns)
    beside = {"temperature": temperatures(columns, reduced), "factor": longer}
    made = made | {name: values for name, values in beside.items() if values is not None}
    whole = ~np.isnan(np.column_stack(list(made.values()))).any(axis=1)
    if count := int((~whole).sum()):
        columns.notes.append(f"{sheet.name}: {count} of {whole.size} rows lack a number, and are left out")
    if not whole.any():
        raise ValueError(f"{sheet.name}: no row has all of {', '.join(made)}")
    made = {name: values[whole] for name, values in made.items()}
    _refuse_sweep(sheet, made)
    if (longer := made.pop("factor", None)) is not None:
        made[place] = made[place] / longer if place == "time" else made[place] * longer
        if (temperature := made.pop("temperature", None)) is not None:
            at = reference(columns, longer, temperature)
            made |= {} if at is None else {"temperature": np.full(len(longer), at)}
    kinds = {"storage": Table, "modulus": RelaxationTable, "compliance": CreepTable}
    kind: Any = next(kinds[name] for name in made if name in kinds)
    try:
        table = kind(**{name: tuple(values.tolist()) for name, values in made.items()})
    except ValueError as error:
        raise ValueError(f"{sheet.name}: {str(error).partition(': ')[2]}") from None
    return table.noted((*columns.notes, *columns.unused()))


def _refuse_sweep(sheet, made):
    """Raise ValueError for a sweep of temperature at one frequency."""
    frequency, temperature = made.get("frequency"), made.get("temperature")
    if frequency is None or temperature is None or np.ptp(temperature) <= SCATTER:
        return
    if frequency.max() < _ONE_FREQUENCY * frequency.min():
        raise ValueError(
            f"{sheet.name}: a sweep of temperature at one frequency, {frequency[0]:g}, is no table of "
            "frequencies: measure at several frequencies, at one temperature or at each"
        )
