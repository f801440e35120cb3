"""Friction that a user measured, out of a file or from Python: a row a measurement, in SI."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import xarray
from pydantic import ValidationError

from scene.files.reading import InvalidInput, error_text, validator
from scene.files.stated import TableFormat
from scene.files.tablefile import Column, Columns, read_columns
from scene.printable import printable
from scene.quantities import KELVIN, NEWTON, SPEED

from ...solving.vocabulary import attributes

if TYPE_CHECKING:
    from pandas import DataFrame

# A table of friction as a file, or as what holds its columns by their names.
Measurements: TypeAlias = "str | Path | DataFrame | xarray.Dataset | Mapping[str, Any]"

MOST_ROWS = 100_000  # of a table: measurements, repeated ones too
COLUMNS = (
    Column("mu", ("cof", "friction coefficient", "coefficient of friction")),
    Column("F_T", ("friction force", "tangential force"), (NEWTON,)),
    Column("F_N", ("normal force", "load", "normal load"), (NEWTON,), needed=True),
    Column("v", ("speed", "velocity", "sliding speed", "sliding velocity"), (SPEED,), needed=True),
    Column("T", ("temperature",), (KELVIN,), unit_needed=True),
)
VARIABLES = {"mu": "friction_coefficient", "F_N": "normal_force", "v": "speed", "T": "temperature"}
DIRECTION = "must be greater than 0: of strokes to and fro give the size, half the difference of both"
MOST_FRICTION = 10.0  # no dry pair of bodies has more, see the doubts about a scene
AGREE = 0.05  # relative, of mu and F_T / F_N where both are given
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
    def of(cls, table: Measurements, **stated: Any) -> "MeasuredFriction":
        """Measurements of a file, a DataFrame, a Dataset, or arrays by the names of columns.

        stated : what differs of a table from the documented form, see `scene.files.stated.TableFormat`

        Raises InvalidInput naming the place and what is allowed.
        """
        path = Path(table) if isinstance(table, str | Path) else None
        try:
            columns = read_columns(path or table, COLUMNS, TableFormat(**stated))
            numbers, notes = _numbers(columns)
        except ValidationError as error:
            lines = error_text(error, stated, validator(TableFormat))
            raise InvalidInput("\n".join(lines)) from error
        except ValueError as error:
            raise InvalidInput(str(error)) from error
        named = printable(path.stem if path else columns.name)
        count = len(numbers["F_N"])
        source = printable(str(table)) if path else f"a {columns.name} from Python, {count} rows"
        data = {
            name: ("measurement", numbers[field], attributes(name))
            for field, name in VARIABLES.items()
            if field in numbers
        }
        return cls(xarray.Dataset(data), named, source, notes)


def _numbers(columns: Columns) -> tuple[dict[str, np.ndarray], tuple[str, ...]]:
    """Numbers above zero by field, and notes. Raises ValueError."""
    name, notes, found = columns.name, list(columns.notes), dict(columns)
    if not {"mu", "F_T"} & set(found):
        raise ValueError(f'{name}: there is no column mu and none F_T: state columns = {{mu = "..."}}')
    if len(found["F_N"]) > MOST_ROWS:
        raise ValueError(f"{name}: {len(found['F_N']):,} rows: at most {MOST_ROWS:,} are read: state rows")
    for field in ("mu", "F_N", "F_T", "v"):
        if field in found and (found[field] < 0).all():  # the sign that a sensor gives to a direction
            found[field] = -found[field]
            notes.append(f"{name}: {field} is negative throughout, and its sizes are used")
    for field, numbers in found.items():
        columns.refuse(field, numbers <= 0, DIRECTION)
    if "F_T" in found:
        ratio = found.pop("F_T") / found["F_N"]
        if "mu" in found:
            apart = np.abs(ratio / found["mu"] - 1)
            columns.refuse(
                "mu", apart > AGREE, f"and F_T / F_N must agree within {AGREE:.0%}: leave one of them out"
            )
            notes.append(f"{name}: mu is used; F_T / F_N agrees with it within {max(apart.max(), 1e-4):.2%}")
        found.setdefault("mu", ratio)
    if (most := float(found["mu"].max())) > MOST_FRICTION:
        notes.append(f"{name}: coefficients of up to {most:.3g}: is a force, or another unit, meant?")
    return found, tuple(notes)
