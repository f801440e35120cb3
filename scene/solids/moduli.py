"""Tables of moduli, over the frequency or over the time of relaxation or creep, in the forms that are measured."""

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..files.reading import InvalidInput, made
from ..files.stated import TableFormat
from ..files.tablefile import Column, Columns, read_columns
from ..printable import shown
from ..quantities import COMPLIANCE, HERTZ, KELVIN, MODULUS, PASCAL_SECOND, RADIAN, RADIAN_PER_SECOND, SECOND
from .table import MOST_ROWS, SCATTER, Table

FREQUENCY = Column("frequency", ("f",), (HERTZ, RADIAN_PER_SECOND))
OMEGA = Column("omega", ("angular frequency",), (RADIAN_PER_SECOND,))
REDUCED = Column("reduced_frequency", (), (HERTZ, RADIAN_PER_SECOND))
TIME = Column("time", ("t",), (SECOND,))
TEMPERATURE = Column("temperature", ("T",), (KELVIN,), unit_needed=True)
A_T, B_T = Column("a_T", ("shift factor",)), Column("b_T", ("vertical shift factor",))
LOG_A_T = Column("log_a_T", ("log10 a_T",))
STORAGE = Column("storage", ("G'", "E'", "storage modulus"), (MODULUS,))
LOSS = Column("loss", ("G''", "E''", "loss modulus"), (MODULUS,))
MAGNITUDE = Column("magnitude", ("|G*|", "|E*|", "G*", "E*", "complex modulus"), (MODULUS,))
TANGENT = Column("tan_delta", ("tan(delta)", "loss factor"))
PHASE = Column("phase", ("delta", "phase angle"), (RADIAN,), unit_needed=True)
# G* = i omega eta*: the loss modulus is omega eta', and the storage modulus omega eta''.
VISCOSITY = Column("viscosity", ("|eta*|", "complex viscosity"), (PASCAL_SECOND,))
DYNAMIC = Column("dynamic_viscosity", ("eta'",), (PASCAL_SECOND,))
OUT_OF_PHASE = Column("out_of_phase_viscosity", ("eta''",), (PASCAL_SECOND,))
RELAXATION = Column("modulus", ("G(t)", "E(t)", "G", "E", "relaxation modulus"), (MODULUS,))
CREEP = Column("compliance", ("J(t)", "D(t)", "J", "D", "creep compliance"), (COMPLIANCE,))
OVER_FREQUENCY = STORAGE, LOSS, MAGNITUDE, VISCOSITY, DYNAMIC, OUT_OF_PHASE
COLUMNS = (
    *(FREQUENCY, OMEGA, REDUCED, TIME, TEMPERATURE, A_T, LOG_A_T, B_T, TANGENT, PHASE),
    *(*OVER_FREQUENCY, RELAXATION, CREEP),
)
_KINDS = {"G": "shear", "J": "shear", "E": "tensile", "D": "tensile"}
_SYMBOL = re.compile(r"\|?([GJED])(?!\w).*")
_MOST_DECADES = 300  # of a_T
_SAME = 0.1  # of the logarithm, of what columns state twice
_AGREE = 0.01  # relative, of a frequency and an angular one
_ONE_FREQUENCY = 1.05  # frequencies within this factor are one


@dataclass(frozen=True)
class Read:
    """Moduli as they were read.

    table : with its columns as numbers
    frequency_unit, kind : as the headings have them, or as stated; None where neither says so
    """

    table: Table
    frequency_unit: str | None
    kind: str | None


def read_moduli(
    table: Any, frequency_unit: str | None = None, kind: str | None = None, stated: TableFormat | None = None
) -> Read:
    """A table of moduli, out of a file or of arrays.

    table, stated : see `tablefile.read_columns`
    frequency_unit, kind : as stated with the table, see `Tabulated`

    Raises ValueError that names file, line and column, and where what is stated contradicts a heading.
    """
    columns = read_columns(table, COLUMNS, stated)
    if any(each.field in columns for each in OVER_FREQUENCY):
        kind = _kind(columns, OVER_FREQUENCY, kind)
        places, frequency_unit = _frequencies(columns, frequency_unit)
        made = {"frequency": places} | _complex_modulus(columns)
        return Read(_table(columns, made), frequency_unit, kind)
    found = [each for each in (RELAXATION, CREEP) if each.field in columns]
    if len(found) != 1 or TIME.field not in columns:
        raise ValueError(
            f"{columns.name}: there is no table of moduli in the columns {_headings(columns)}: storage and loss "
            "modulus (or one of them, or the complex modulus or viscosity, with tan delta or the phase) over the "
            'frequency, or relaxation modulus or creep compliance over time: state columns = {storage = "..."}'
        )
    if frequency_unit is not None:
        raise ValueError(f"{columns.name} is a table over time: leave frequency_unit = {frequency_unit!r} out")
    name = found[0].field
    columns.refuse("time", columns["time"] < 0, "must not be below 0")
    made = {"time": columns["time"], name: _positive(columns, name)}
    return Read(_table(columns, made), None, _kind(columns, found, kind))


def read_table(path: str | Path, **stated: Any) -> Table:
    """The table in a text file. stated : see `stated.TableFormat`. Raises ValueError naming file and line."""
    return read_moduli(path, stated=made(stated, TableFormat, path)).table


def _positive(columns: Columns, name: str) -> np.ndarray:
    columns.refuse(name, columns[name] <= 0, "must be greater than 0")
    return columns[name]


def _headings(columns):
    return ", ".join(map(shown, columns.headings.values())) or "none that is known"


def _kind(columns, quantities, stated):
    """Kind of the moduli, by the symbols of their headings or as stated; None where neither says so."""
    headings = {each.field: columns.headings[each.field] for each in quantities if each.field in columns}
    found = {_KINDS[symbol[1]] for each in headings.values() if (symbol := _SYMBOL.fullmatch(each))}
    found |= {"shear"} if any("viscosity" in each for each in headings) else set()
    if len(found | ({stated} if stated in _KINDS.values() else set())) > 1:
        raise ValueError(
            f"{columns.name}: {', '.join(map(shown, headings.values()))} are moduli of kind "
            f"{' and '.join(map(repr, sorted(found)))}, and kind = {stated!r} is stated: state columns of equal "
            "kind, or correct kind"
        )
    return next(iter(found), stated)


def _frequencies(columns, stated):
    """Frequencies and their unit, as written or stated; None where neither says so."""
    names = [each.field for each in (REDUCED, OMEGA, FREQUENCY) if each.field in columns]
    if not names:
        raise ValueError(
            f"{columns.name}: no column of {_headings(columns)} is a frequency, and a sweep of temperature is no "
            'table of moduli: state columns = {frequency = "..."}'
        )
    name, unit = names[0], _unit(columns, names[0])
    if names == [OMEGA.field, FREQUENCY.field] and _unit(columns, FREQUENCY.field):
        omega, cycles = (_angular(columns, each) for each in names)
        columns.refuse(
            "omega", np.abs(omega - cycles) > _AGREE * omega, "contradicts frequency: 1 Hz is 2 pi rad/s"
        )
    if unit and stated not in (None, unit):
        raise ValueError(
            f"{columns.name}: {shown(columns.headings[name])} is in {unit}, and frequency_unit = {stated!r} is "
            "stated: leave frequency_unit out, or correct the heading"
        )
    return _positive(columns, name), unit or stated


def _unit(columns, name):
    unit = columns.units[name]
    return "rad/s" if name == OMEGA.field else unit and unit.symbol


def _angular(columns, name):
    return columns[name] * (2 * np.pi if _unit(columns, name) == "Hz" else 1.0)


def _complex_modulus(columns):
    """Storage and loss modulus [Pa], however they are stated."""
    known = {name: _positive(columns, name) for name in ("storage", "loss", "magnitude") if name in columns}
    for name, column in {"magnitude": VISCOSITY, "loss": DYNAMIC, "storage": OUT_OF_PHASE}.items():
        if column.field in columns and name not in known:
            place = OMEGA.field if OMEGA.field in columns else FREQUENCY.field
            if place not in columns or _unit(columns, place) is None:
                raise ValueError(
                    f"{columns.name}: moduli are {shown(columns.headings[column.field])} times the angular "
                    'frequency: state its unit, as units = {frequency = "Hz"}'
                )
            known[name] = _positive(columns, column.field) * _angular(columns, place)
    tangent = _positive(columns, "tan_delta") if "tan_delta" in columns else None
    if "phase" in columns and tangent is None:
        columns.refuse("phase", columns["phase"] >= np.pi / 2, "must be below pi/2, 90 deg")
        tangent = np.tan(_positive(columns, "phase"))
    storage, loss, size = (known.get(name) for name in ("storage", "loss", "magnitude"))
    if tangent is not None and storage is None:
        storage = (
            loss / tangent if loss is not None else size / np.hypot(1.0, tangent) if size is not None else None
        )
    if tangent is not None and loss is None and storage is not None:
        loss = storage * tangent
    if storage is None or loss is None:
        raise ValueError(
            f"{columns.name}: no complete modulus is in the columns {_headings(columns)}: storage and loss "
            "modulus, or one of them, the complex modulus or viscosity with tan delta or the phase: state "
            'columns = {loss = "..."}'
        )
    apart = 0.0 if tangent is None else float(np.median(np.abs(np.log(loss / storage / tangent))))
    if apart > _SAME:
        raise ValueError(
            f"{columns.name}: loss over storage modulus is {np.exp(apart):.2g} times off tan delta or the phase: "
            "correct their units, or state the columns of two of them"
        )
    return {"storage": storage, "loss": loss}


def _table(columns, made):
    """The table, shifted to one temperature where columns say by how much."""
    (place, places), *moduli = made.items()
    reduced = REDUCED.field in columns
    temperature = columns.get("temperature")
    if B_T.field in columns:
        if reduced:
            raise ValueError(
                f"{columns.name}: b_T with reduced frequencies leaves open whether moduli are reduced"
            )
        lift = _positive(columns, "b_T")
        made |= {name: each * lift if name == "compliance" else each / lift for name, each in moduli}
    if temperature is not None and np.ptp(temperature) > SCATTER:
        if place == "frequency" and places.max() < _ONE_FREQUENCY * places.min():
            raise ValueError(
                f"{columns.name}: a sweep of temperature at one frequency, {places[0]:g}, is no table of "
                "frequencies: measure at several frequencies, at one temperature or at each"
            )
        temperature = None if reduced else temperature
    if (A_T.field in columns or LOG_A_T.field in columns) and not reduced:
        longer = factors(columns)
        made[place] = places / longer if place == "time" else places * longer
        temperature = None if temperature is None else _reference(columns, longer, temperature)
    made |= {} if temperature is None else {"temperature": temperature}
    notes = columns.notes
    if place == "time" and (start := made["time"] == 0).any():
        notes = (*notes, f"{columns.name}: {int(start.sum())} rows at time 0 are left out")
        made = {name: values[~start] for name, values in made.items()}
    if len(places) > MOST_ROWS:
        raise ValueError(f"{columns.name}: {len(places):,} rows: at most {MOST_ROWS:,} are fitted: state rows")
    try:
        return Table(**made).noted(notes)
    except InvalidInput as error:
        raise ValueError(f"{columns.name}: {str(error).partition(': ')[2]}") from None


def factors(columns: Columns) -> np.ndarray:
    """Shift factors a_T of a table that has them."""
    if A_T.field not in columns:
        columns.refuse("log_a_T", np.abs(columns["log_a_T"]) > _MOST_DECADES, "is no logarithm to base 10")
        return 10.0 ** columns["log_a_T"]
    columns.refuse("a_T", columns["a_T"] <= 0, "must be greater than 0; a logarithm to base 10 is log_a_T")
    return columns["a_T"]


def _reference(columns, longer, temperature):
    """Temperature at which a_T is 1 [K], of every row; None where it does not lie between those of the rows.

    Raises ValueError for factors that grow with the temperature.
    """
    warm, cold = (np.median(longer[temperature == end]) for end in (temperature.max(), temperature.min()))
    if warm > cold:
        raise ValueError(
            f"{columns.name}: a_T grows with the temperature, but it multiplies times, which grow shorter: state "
            "its inverse"
        )
    order = np.argsort(longer)
    at = np.interp(0.0, np.log(longer[order]), temperature[order], left=np.nan, right=np.nan)
    return None if np.isnan(at) else np.full(len(longer), at)
