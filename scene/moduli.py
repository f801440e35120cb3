"""Tables of moduli as people have them: columns found by their names, in a file or in Python, made one table."""

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import ValidationError

from . import modulinames as names
from .columns import Chosen, chosen, joined, sheet_of
from .files import once
from .mistakes import said
from .modulinames import KINDS, OPEN
from .quantities import HERTZ
from .sheet import Sheet, read_sheets
from .table import MOST_ROWS, SCATTER, CreepTable, RelaxationTable, Table

UNITS = ("rad/s", "Hz")
_FREQUENCIES = names.FREQUENCY, names.ANGULAR, names.REDUCED, names.REDUCED_ANGULAR
# In brackets behind a name: what the number depends on, and no unit.
_ARGUMENTS = ("t", "ω", "omega", "w", "f", "δ", "delta", "φ", "d", "phi", "aT", "a_T", "T")
_OTHER = "another "  # before a letter that is no name of ours in this size
_IDLE = ("(ω)", "(omega)", "(w)", "(f)", "(iω)")
_PER_SECOND = ("1/s", "s^-1", "s-1", "s⁻¹", "1/sec", "sec^-1")
_ONE_FREQUENCY = 1.05  # frequencies within this factor are one
_SAME = 0.1  # of the logarithm, of what columns state twice
_AGREE = 0.01  # relative, of a frequency and an angular one beside it


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
    sheet = once(_sheet, table) if isinstance(table, str | Path) else sheet_of(table)
    sheet = _spelt(sheet)
    found, notes = chosen(sheet, names.COLUMNS, ("frequency", "storage", "loss"))
    notes = tuple(each.replace(f"'{_OTHER}", "'") for each in notes)
    return _Columns(sheet, found, list(notes), frequency_unit, kind).read()


def read_table(path: str | Path) -> Table | RelaxationTable | CreepTable:
    """The table in a text or CSV file: its columns by their headings, else frequency, storage and loss modulus.

    Raises ValueError naming file, line and column.
    """
    return read_moduli(path).table


def _sheet(path):
    return joined(read_sheets(path, MOST_ROWS))


def _spelt(sheet: Sheet) -> Sheet:
    """The sheet with arguments as parts of names such as G(t), and without those that say nothing."""
    called, units = list(sheet.names), list(sheet.units)
    for k, (name, unit) in enumerate(zip(called, units, strict=True)):
        if unit in _ARGUMENTS:
            name, units[k] = f"{name}({unit})", ""
        for idle in _IDLE:
            name = name.removesuffix(idle).strip()
        exact = any(name in each.called for each in names.COLUMNS)
        other = len(name) == 1 and not exact and any(_is(name, each) for each in names.COLUMNS)
        called[k] = f"{_OTHER}{name}" if other else name  # "F" is a force, and "d" a thickness
        if units[k] in _PER_SECOND:
            angular = any(_is(name, each) for each in (names.ANGULAR, names.REDUCED_ANGULAR))
            units[k] = "rad/s" if angular else "" if _is(name, names.FREQUENCY) else units[k]
    return replace(sheet, heading=replace(sheet.heading, names=tuple(called), units=tuple(units)))


def _is(name, column):
    return name.casefold() in map(str.casefold, column.called)


@dataclass
class _Columns:
    """The columns of one sheet, and what is stated beside it."""

    sheet: Sheet
    found: dict[str, Chosen]
    notes: list[str]
    frequency_unit: str | None
    kind: str | None
    used: set[str] = field(default_factory=set)

    def read(self) -> Read:
        over_frequency = any(self._has(each) for each in ("storage", "loss", "magnitude")) or (
            names.TIME.field not in self.found and any(each.field in self.found for each in _FREQUENCIES)
        )
        quantities = ("storage", "loss", "magnitude") if over_frequency else ("relaxation", "creep")
        kind = self._kind([each for each in quantities if self._has(each)])
        made = self._moduli(kind) if over_frequency else self._over_time(kind)
        unit = self.frequency_unit
        if over_frequency:
            place, unit, reduced = self._frequency()
            made = {"frequency": place} | made
        else:
            reduced = False
            if unit is not None:
                raise ValueError(f"{self.sheet.name} is a table over time: leave frequency_unit = {unit!r} out")
        return Read(self._table(made, reduced), unit, kind)

    def _table(self, made, reduced):
        """The table of rows in which nothing is missing."""
        name = next(iter(made))
        factors, temperature = self._shifts(reduced)
        if temperature is not None:
            made["temperature"] = temperature
        everywhere = np.ones(len(self.sheet.numbers), bool)
        for each in (*made.values(), *([] if factors is None else [factors])):
            everywhere &= ~np.isnan(each)
        if count := int((~everywhere).sum()):
            self.notes.append(
                f"{self.sheet.name}: {count} of {everywhere.size} rows lack a number, and are left out"
            )
        if not everywhere.any():
            raise ValueError(f"{self.sheet.name}: no row has all of {', '.join(made)}")
        made = {each: values[everywhere] for each, values in made.items()}
        places = made[name]
        several = temperature is not None and np.ptp(made["temperature"]) > SCATTER
        if several and name == "frequency" and places.max() < _ONE_FREQUENCY * places.min():
            raise ValueError(
                f"{self.sheet.name}: a sweep of temperature at one frequency, {places[0]:g}, is no table of "
                "frequencies: measure at several frequencies, at one temperature or at each"
            )
        if factors is not None:
            made[name] = places / factors[everywhere] if name == "time" else places * factors[everywhere]
            made.pop("temperature", None)
            if (reference := self._reference(factors)) is not None:
                made["temperature"] = np.full(int(everywhere.sum()), reference)
        kind = {"storage": Table, "modulus": RelaxationTable, "compliance": CreepTable}
        made_of: Any = next(kind[each] for each in made if each in kind)
        columns: dict[str, Any] = {each: tuple(values.tolist()) for each, values in made.items()}
        try:
            table = made_of(**columns)
        except ValidationError as error:
            raise ValueError(f"{self.sheet.name}: {said(error)}") from None
        unused = [column for field, column in self.found.items() if field not in self.used]
        beside = [f"{self.sheet.name}: column {each.name!r} is not used" for each in unused]
        return table.noted((*self.notes, *beside))

    # Columns

    def _has(self, quantity):
        return any(names.modulus(quantity, each).field in self.found for each in (*KINDS, OPEN))

    def _of(self, field):
        """Numbers of a column, > 0 or, where nothing was measured, NaN. Raises ValueError with the place of others."""
        column = self.found[field]
        wrong = ~(np.isnan(column.numbers) | ((column.numbers > 0) & np.isfinite(column.numbers)))
        if wrong.any():
            row = int(np.argmax(wrong))
            given, where = self.sheet.numbers[row, column.index], self.sheet.place(row, column.index)
            raise ValueError(f"{where}: {field} = {given:g} must be finite and greater than 0")
        self.used.add(field)
        return column.numbers

    def _modulus(self, quantity, kind):
        """Numbers of a quantity; None where it has no column."""
        for each in (kind, OPEN):
            if each is not None and (name := names.modulus(quantity, each).field) in self.found:
                return self._of(name)
        return None

    def _kind(self, quantities):
        told = [
            kind
            for kind in KINDS
            if any(names.modulus(quantity, kind).field in self.found for quantity in quantities)
        ]
        if self.kind in KINDS:
            if told and self.kind not in told:
                raise ValueError(
                    f"{self._heading()} names moduli of kind {told[0]!r}, and kind = {self.kind!r} is stated: "
                    "leave kind out, or correct the heading"
                )
            return self.kind
        if len(told) > 1:
            raise ValueError(
                f"{self._heading()} names moduli of both kinds: state kind, {' or '.join(map(repr, told))}"
            )
        return told[0] if told else self.kind

    def _heading(self):
        return f"{self.sheet.name}: the heading ({', '.join(self.sheet.names)})"

    # Over the frequency

    def _moduli(self, kind):
        """Storage and loss modulus, however they are stated."""
        storage, loss = self._modulus("storage", kind), self._modulus("loss", kind)
        tangent, size = (
            self._tangent(whole=storage is not None and loss is not None),
            self._modulus("magnitude", kind),
        )
        if storage is not None and loss is not None:
            self._check_tangent(loss / storage, tangent)
            return {"storage": storage, "loss": loss}
        if tangent is None or (storage is None and loss is None and size is None):
            raise ValueError(
                f"{self._heading()} has no complete modulus: give storage and loss modulus, or one of them or the "
                "complex modulus with tan delta or a phase"
            )
        if storage is not None:
            return {"storage": storage, "loss": storage * tangent}
        if loss is not None:
            return {"storage": loss / tangent, "loss": loss}
        along = size / np.hypot(1.0, tangent)
        return {"storage": along, "loss": along * tangent}

    def _tangent(self, whole):
        """Loss over storage modulus as a column states it; None without one. whole : whether both are there"""
        if names.TAN.field in self.found:
            return self._of(names.TAN.field)
        if names.PHASE.field not in self.found:
            return None
        phase, column = self._of(names.PHASE.field), self.found[names.PHASE.field]
        if column.unit is None and whole:
            return None
        if column.unit is None:
            raise ValueError(f"{self._heading()} states no unit of {column.name!r}: write deg or rad behind it")
        if (phase >= np.pi / 2).any():
            row = int(np.argmax(phase >= np.pi / 2))
            where, given = self.sheet.place(row, column.index), self.sheet.numbers[row, column.index]
            raise ValueError(f"{where}: phase = {given:g} must be below 90 deg")
        return np.tan(phase)

    def _check_tangent(self, found, stated):
        if stated is None:
            return
        apart = float(np.nanmedian(np.abs(np.log(found / stated))))
        if apart > _SAME:
            raise ValueError(
                f"{self._heading()}: loss over storage modulus is {np.exp(apart):.2g} times off tan delta or the "
                "phase beside them: correct their units, or keep two of them"
            )

    def _frequency(self):
        """Frequencies, their unit or None, and whether they are reduced to one temperature already."""
        reduced = any(each.field in self.found for each in (names.REDUCED, names.REDUCED_ANGULAR))
        wanted = (names.REDUCED_ANGULAR, names.REDUCED) if reduced else (names.ANGULAR, names.FREQUENCY)
        columns = {each.field: self.found[each.field] for each in wanted if each.field in self.found}
        if not columns:
            several = "a sweep of temperature is " if names.TEMPERATURE.field in self.found else ""
            raise ValueError(
                f"{self._heading()}: {several}no table of frequencies: it has no column of the frequency"
            )
        units = {field: self._unit_of(field, column) for field, column in columns.items()}
        self._check_both(columns, units)
        stated = self.frequency_unit if self.frequency_unit in UNITS else None
        fitting = [field for field, unit in units.items() if stated in (None, unit)]
        fitting += [field for field, unit in units.items() if unit is None]
        if not fitting:
            field, unit = next(iter(units.items()))
            raise ValueError(
                f"{self._heading()} gives {columns[field].name!r} in {unit}, and frequency_unit = {stated!r} is "
                "stated: leave frequency_unit out, or correct the heading"
            )
        self.used |= columns.keys()
        return self._of(fitting[0]), units[fitting[0]] or self.frequency_unit, reduced

    def _unit_of(self, field, column):
        if column.unit is None:
            return "rad/s" if field in (names.ANGULAR.field, names.REDUCED_ANGULAR.field) else None
        return "Hz" if column.unit is HERTZ else "rad/s"

    def _check_both(self, columns, units):
        if len(columns) < 2 or None in units.values():
            return
        one, other = (
            column.numbers * (2 * np.pi if units[field] == "Hz" else 1) for field, column in columns.items()
        )
        if (np.abs(one - other) > _AGREE * np.abs(one)).any():
            both = " and ".join(repr(column.name) for column in columns.values())
            raise ValueError(f"{self._heading()}: {both} contradict one another, 1 Hz is 2 pi rad/s: keep one")

    # Over the time

    def _over_time(self, kind):
        relaxation, creep = self._modulus("relaxation", kind), self._modulus("creep", kind)
        if (relaxation is None) == (creep is None):
            lack = "both a relaxation modulus and a creep compliance: keep one"
            if creep is None:
                lack = (
                    "no modulus: give storage and loss modulus over the frequency, or a relaxation modulus or "
                    "creep compliance over time"
                )
            raise ValueError(f"{self._heading()} has {lack}")
        if names.TIME.field not in self.found:
            raise ValueError(f"{self._heading()} has no column of the time")
        time = self._of(names.TIME.field)
        return {"time": time} | ({"modulus": relaxation} if creep is None else {"compliance": creep})

    # Temperatures

    def _shifts(self, reduced):
        """Factors by which times are longer than at the reference, and temperatures [K]; None where not known."""
        temperature = None
        if (column := self.found.get(names.TEMPERATURE.field)) is not None:
            if column.unit is None:
                raise ValueError(f"{self._heading()} states no unit of {column.name!r}: write degC or K behind it")
            temperature = self._of(names.TEMPERATURE.field)
        if reduced:
            known = temperature is not None and np.ptp(temperature[~np.isnan(temperature)]) <= SCATTER
            return None, temperature if known else None
        if names.SHIFT.field in self.found:
            return self._of(names.SHIFT.field), temperature
        for log, base in ((names.LOG_SHIFT.field, 10.0), (names.LN_SHIFT.field, np.e)):
            if log in self.found:
                self.used.add(log)
                with np.errstate(over="ignore"):
                    factors = base ** self.found[log].numbers
                if not ((factors > 0) & np.isfinite(factors) | np.isnan(factors)).all():
                    raise ValueError(f"{self._heading()}: {self.found[log].name!r} leaves the range of numbers")
                return factors, temperature
        return None, temperature

    def _reference(self, factors):
        """Temperature at which the factor is 1; None where the table has it not between its rows."""
        if names.TEMPERATURE.field not in self.found:
            return None
        temperature = self.found[names.TEMPERATURE.field].numbers
        known = ~(np.isnan(temperature) | np.isnan(factors))
        order = np.argsort(factors[known])
        logs, temperature = np.log(factors[known][order]), temperature[known][order]
        return float(np.interp(0.0, logs, temperature)) if logs[0] <= 0 <= logs[-1] else None
