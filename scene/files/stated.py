"""Fields of a part of a scene as they are stated: by name, and in a table in place of others."""

from collections.abc import Callable, Mapping
from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Field, TypeAdapter, ValidationError, model_validator
from pydantic.dataclasses import dataclass
from pydantic_core import ArgsKwargs

from ..quantities import CLOSED

_Lines = Annotated[int, Field(strict=True, ge=0)]


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class TableFormat:
    """Form of a table where it differs from the documented one, as a user states it.

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


FORM: dict[str, Any] = TypeAdapter(TableFormat).json_schema()["properties"]


def alternatives(*needless: str, **properties: Any) -> ConfigDict:
    """Configuration of a part of a scene that may be stated otherwise than by its fields.

    needless : fields that then are not needed
    properties : in JSON schema, of what stands in their place; it becomes fields by a `restated`
    """

    def added(schema: dict[str, Any]) -> None:
        schema["properties"] |= properties
        schema["required"] = [name for name in schema.get("required", ()) if name not in needless]

    return ConfigDict(**CLOSED, json_schema_extra=added)


def restated(make: Callable[[Any, dict[str, Any]], Any]) -> Any:
    """Validator before those of the fields: `make` gets the class and what is stated for its fields, by name."""

    def taken(cls, given):
        if isinstance(given, ArgsKwargs) and not given.args:
            given = given.kwargs or {}
        return make(cls, dict(given)) if isinstance(given, dict) else given

    return model_validator(mode="before")(taken)


def split_format(given: Mapping[str, Any]) -> tuple[TableFormat, dict[str, Any]]:
    """Form of the table and the other fields, out of those that are stated for a part of a scene."""
    written = {name: given[name] for name in TableFormat.__dataclass_fields__ if name in given}
    return TableFormat(**written), {name: value for name, value in given.items() if name not in written}


def filled(given: Mapping[str, Any], read: Callable[[Any, TableFormat], Mapping[str, Any]]) -> dict[str, Any]:
    """Fields of a part of a scene, where `table` is stated with those of its columns.

    read : gives fields out of the table and its form

    Raises ValueError for what is stated of no table, and ValidationError, at table, for one that is refused.
    """
    written, rest = split_format(given)
    if (table := rest.pop("table", None)) is None:
        if written != TableFormat():
            raise ValueError("table is missing, although its columns, units or lines are stated")
        return rest
    try:
        found = read(table, written)
        if both := found.keys() & rest.keys():
            raise ValueError(f"{min(both)} is stated, and a column of the table: leave one out")
    except ValueError as error:
        raise refused("table", table, error) from error
    return {**rest, **found}


def taken(name: str, stated: Mapping[str, Any], take: Callable[[Any], Any]) -> Any:
    """Value that is stated under a name, as `take` reads it. Raises ValidationError, at the name."""
    try:
        return take(stated[name])
    except ValueError as error:
        raise refused(name, stated[name], error) from error


def refused(name: str, given: Any, reason: ValueError) -> ValidationError:
    """A mistake of a field, or of what stands in its place."""
    line: Any = {
        "type": "value_error",
        "loc": (name,),
        "input": given,
        "ctx": {"error": ValueError(str(reason))},
    }
    return ValidationError.from_exception_data(name, [line])
