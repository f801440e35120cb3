"""What a user states of a table that differs from the documented form, see `tablefile`."""

from collections.abc import Mapping
from dataclasses import InitVar
from typing import Annotated, Any, Literal

from pydantic import Field
from pydantic.dataclasses import dataclass

from .quantities import CLOSED

SEPARATORS = {"tab": "\t", "semicolon": ";", "comma": ",", "blanks": " "}
_Lines = Annotated[int, Field(strict=True, ge=0)]


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class TableFormat:
    """What a user states of a table that differs from the documented form.

    columns : heading by field, as {"storage": "E' (MPa)"}; or number from 1 on, of a file without a heading
    units : unit by field, of columns whose heading has none
    where : value by heading, of the rows that are read; "*" for rows of any value
    separator : "tab", "semicolon", "comma" or "blanks", or the character itself
    decimal : "." or ","
    encoding : of the file, as "cp1252"
    skip : number of lines above the heading
    rows : number of rows below it that are read
    """

    columns: Mapping[str, str | Annotated[int, Field(strict=True, ge=1)]] | None = None
    units: Mapping[str, str] | None = None
    where: Mapping[str, str | int | float] | None = None
    separator: Literal["tab", "semicolon", "comma", "blanks", "\t", ";", ",", " "] | None = None
    decimal: Literal[".", ","] | None = None
    encoding: str | None = None
    skip: _Lines | None = None
    rows: _Lines | None = None


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class FromTable:
    """A part of a scene that may be read from a table, with the fields of `TableFormat` as arguments."""

    columns: InitVar[Mapping[str, str | int] | None] = None
    units: InitVar[Mapping[str, str] | None] = None
    where: InitVar[Mapping[str, str | int | float] | None] = None
    separator: InitVar[str | None] = None
    decimal: InitVar[str | None] = None
    encoding: InitVar[str | None] = None
    skip: InitVar[int | None] = None
    rows: InitVar[int | None] = None


def split_format(given: Mapping[str, Any]) -> tuple[TableFormat, dict[str, Any]]:
    """What is stated of the table among what is stated for a part of a scene, and the rest."""
    names = TableFormat.__dataclass_fields__
    rest = {name: value for name, value in given.items() if name not in names}
    return TableFormat(**{name: value for name, value in given.items() if name in names}), rest
