"""Friction that a user measured, out of a file or from Python: a row a measurement, in SI."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import xarray

from scene.blocks import joined
from scene.columns import PURE, Chosen, Column, chosen, meant, refuse_half_stated, sheet_of
from scene.printable import printable
from scene.quantities import HERTZ, KELVIN, NEWTON, RADIAN_PER_SECOND, SPEED
from scene.reading import InvalidInput
from scene.sheet import Sheet, read_sheets

from ...solving.vocabulary import attributes

if TYPE_CHECKING:
    from pandas import DataFrame

# A table of friction as a file, or as what holds its columns by their names.
Measurements: TypeAlias = "str | Path | DataFrame | xarray.Dataset | Mapping[str, Any]"

MOST_ROWS = 100_000  # of a table: measurements, repeated ones too
POSITIONAL = ("mu", "F_N", "v")
NAMES = {
    "mu": "mu, µ, friction, friction coefficient, friction coeff, friction coef, coefficient of friction, "
    "coeff. of friction, friction factor, cof, mu k, µ k, µk, coefficient of kinetic friction, coefficient of "
    "dynamic friction",
    "F_T": "F_T, FT, friction force, frictional force, tangential force, lateral force, shear force, "
    "traction force, drag, drag force, F_F, FF, F_R, FR, Fx, F_x, force x",
    "F_N": "F_N, FN, load, normal force, normal load, force, applied force, applied load, vertical force, "
    "vertical load, contact force, Fz, F_z, force z",
    "v": "v, speed, velocity, vel, sliding speed, sliding velocity, slip speed, slip velocity, linear speed, "
    "track speed, stage speed, sled speed, scan speed, max linear speed, v rel, vrel, relative velocity",
    "T": "T, temperature, temp, test temperature, sample temperature, rubber temperature, ambient "
    "temperature, chamber temperature",
    # Named to say what it lacks.
    "rotation": "rpm, rotation, rotational speed, rotation speed, angular speed, angular velocity, revolutions",
}
# Said beside a name of them, before or behind it.
_KIND = "(?:mean|average|avg|kinetic|dynamic)"
_KINDS = re.compile(rf"{_KIND}[ _](.+)|(.+)[ _]{_KIND}", re.IGNORECASE)
UNITS = {
    "F_T": (NEWTON,),
    "F_N": (NEWTON,),
    "v": (SPEED, RADIAN_PER_SECOND, HERTZ),
    "T": (KELVIN,),
    "rotation": (RADIAN_PER_SECOND, HERTZ),
}
COLUMNS = tuple(
    Column(field, tuple(names.split(", ")), UNITS.get(field, ()), optional=field != "F_N")
    for field, names in NAMES.items()
)
STATED = tuple(each for each in COLUMNS if each.field in ("F_N", "v", "T"))
VARIABLES = {"mu": "friction_coefficient", "F_N": "normal_force", "v": "speed", "T": "temperature"}
SPINS = (
    "the speed of a rotation is one of sliding only with the radius of its track: give v = 2 pi radius times "
    "revolutions per second, as v [m/s]"
)
DIRECTION = ": of strokes to and fro give the size, half the difference of both"
MOST_FRICTION = 10.0  # no dry pair of bodies has more, see the doubts about a scene
AGREE = 0.05  # relative, of mu and F_T / F_N where both are given
SECONDS = ("s", "sec", "ms", "min", "h")
COLDEST = 100.0  # [K]: a number below it without a unit is hardly one of kelvins


@dataclass(frozen=True, eq=False)
class MeasuredFriction:
    """Measurements of friction.

    data : friction_coefficient, normal_force, speed and, where it was measured, temperature, a measurement a row
    name : of the table, as findings have it
    source : what the table came from, in words
    notes : what was read and not used, and what was left out
    """

    data: xarray.Dataset
    name: str
    source: str
    notes: tuple[str, ...] = ()

    @classmethod
    def of(cls, table: Measurements) -> "MeasuredFriction":
        """Measurements of a file, a DataFrame, a Dataset, or arrays by the names of columns.

        Raises InvalidInput naming the place and what is allowed.
        """
        path = Path(table) if isinstance(table, str | Path) else None
        try:
            sheet = joined(read_sheets(path, MOST_ROWS), STATED) if path else sheet_of(_flat(table))
            columns, notes = _columns(sheet)
        except ValueError as error:
            raise InvalidInput(str(error)) from error
        named = printable(path.stem if path else sheet.name)
        count = len(columns["F_N"])
        source = printable(str(table)) if path else f"a {sheet.name} from Python, {count} rows"
        data = {
            name: ("measurement", columns[field], attributes(name))
            for field, name in VARIABLES.items()
            if field in columns
        }
        return cls(xarray.Dataset(data), named, source, notes)


def _sizes(found):
    """Columns without the sign that a sensor gives to a direction, and fields that were turned."""
    turned = [
        name
        for name in ("mu", "F_N", "F_T", "v")
        if name in found and not np.any(found[name].numbers >= 0) and not np.isnan(found[name].numbers).all()
    ]
    return found | {name: replace(found[name], numbers=-found[name].numbers) for name in turned}, turned


def _flat(table):
    """A Dataset of several dimensions as one of rows; anything else as it is."""
    if not isinstance(table, xarray.Dataset) or len(table.sizes) < 2:
        return table
    dims = tuple(table.sizes)
    spread = xarray.broadcast(*(table[name] for name in table.variables))
    rows = {
        str(each.name): xarray.DataArray(each.transpose(*dims).data.reshape(-1), dims="row", attrs=own.attrs)
        for each, own in zip(spread, (table[name] for name in table.variables), strict=True)
    }
    return xarray.Dataset(rows)


def _columns(sheet: Sheet) -> tuple[dict[str, np.ndarray], tuple[str, ...]]:
    """Columns of a sheet in SI by field, of the rows that are complete, and notes. Raises ValueError."""
    found, notes = chosen(_spelled(sheet), COLUMNS, POSITIONAL)
    if "v" not in found:
        raise ValueError(
            f"{sheet.name}: there is {found['rotation'].name} and no v: {SPINS}"
            if "rotation" in found
            else f"{sheet.name}: there is no column for v, called {NAMES['v']}"
        )
    if found["v"].unit not in (None, SPEED):
        raise ValueError(f"{sheet.name}: v is no speed of sliding: {SPINS}")
    if "rotation" in found:
        notes = (*notes, f"{sheet.name}: column {found.pop('rotation').name!r} is not used beside v")
    if not {"mu", "F_T"} & set(found):
        raise ValueError(
            f"{sheet.name}: there is no column for mu, called {NAMES['mu']}; nor for F_T, called {NAMES['F_T']}"
        )
    refuse_half_stated(sheet, [found[name] for name in ("F_T", "F_N") if name in found])
    found, turned = _sizes(found)
    notes = (*notes, *(f"{sheet.name}: {name} is negative throughout, and its sizes are used" for name in turned))
    missing = np.any([np.isnan(each.numbers) for each in found.values()], axis=0)
    if missing.all():
        raise ValueError(f"{sheet.name}: no row has a number in every column")
    if count := int(missing.sum()):
        notes = (*notes, f"{sheet.name}: {count} of {missing.size} rows lack a number and are left out")
    for name, each in found.items():
        _check(sheet, name, each, missing)
    columns = {name: each.numbers for name, each in found.items()}
    if "F_T" in columns:
        ratio = columns.pop("F_T") / columns["F_N"]
        if "mu" in columns:
            notes = (*notes, _agreement(sheet, columns["mu"], ratio, missing))
        columns.setdefault("mu", ratio)
    if (most := float(columns["mu"][~missing].max())) > MOST_FRICTION:
        notes = (*notes, f"{sheet.name}: coefficients of up to {most:.3g}: is a force, or another unit, meant?")
    return {name: each[~missing] for name, each in columns.items()}, notes


def _spelled(sheet):
    """The sheet with names that have two meanings as they are meant: t is a time, friction in newtons a force."""

    def spelled(name, unit):
        if name == "t":
            return "t (time)"
        if name == "T" and unit in SECONDS:
            return "time"
        said = _KINDS.fullmatch(name)
        if said and meant(said[1] or said[2], COLUMNS):
            name = said[1] or said[2]
        return "friction force" if name.lower() == "friction" and unit not in PURE else name

    names = tuple(map(spelled, sheet.names, sheet.units))
    return replace(sheet, heading=replace(sheet.heading, names=names))


def _check(sheet: Sheet, name: str, column: Chosen, missing: np.ndarray) -> None:
    """Raise ValueError for the first number that is not finite and above zero, and for a temperature in doubt."""
    numbers = column.numbers
    wrong = ~(np.isfinite(numbers) & (numbers > 0)) & ~missing
    if name == "T" and column.unit is None and np.any(cold := (numbers < COLDEST) & ~missing):
        where = _row(sheet, int(np.argmax(cold)))
        raise ValueError(
            f"{where}: T = {numbers[cold][0]:g} has no unit, and {numbers[cold][0]:g} K is hardly meant: write "
            "T [degC] or T [K] in the heading"
        )
    if wrong.any():
        raise ValueError(
            f"{_row(sheet, int(np.argmax(wrong)))}: {name} = {numbers[wrong][0]:g} must be finite and greater "
            f"than 0{DIRECTION if numbers[wrong][0] < 0 else ''}"
        )


def _agreement(sheet, mu, ratio, missing):
    """A note on mu and F_T / F_N. Raises ValueError for the first row in which they are two numbers."""
    apart = np.where(missing, 0.0, np.abs(ratio / mu - 1))
    if np.any(wrong := apart > AGREE):
        first = int(np.argmax(wrong))
        raise ValueError(
            f"{_row(sheet, first)}: mu = {mu[first]:g}, and F_T / F_N = {ratio[first]:g}: they must agree within "
            f"{AGREE:.0%}, or one of both columns has to go"
        )
    return f"{sheet.name}: mu is used; F_T / F_N agrees with it within {max(apart.max(), 1e-4):.2%}"


def _row(sheet, index):
    return f"{sheet.name}, line {sheet.lines[index]}" if len(sheet.lines) else f"{sheet.name}, row {index + 1}"
