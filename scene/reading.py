"""Reading TOML files into validated objects, with every mistake named at once."""

import tomllib
from copy import deepcopy
from datetime import date, time
from functools import reduce
from operator import getitem
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

# Stands for what is missing; nothing allows it.
MISSING = "\0"
LONGEST = 4096  # bits of a whole number that is shown


class InvalidInput(ValueError):
    """A file that cannot be read as what it should be; the message lists every mistake, one a line."""


def read(path: str | Path, what: Any):
    """Read a TOML file as `what`, a validated dataclass or model.

    Raises InvalidInput naming for each mistake the field, the value and what is allowed.
    """
    path = Path(path)
    try:
        content = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InvalidInput(f"{path}: {error.strerror}") from error
    except ValueError as error:  # also of characters that are none, and of numbers too long to be read
        raise InvalidInput(f"{path} is not valid TOML: {error}") from error
    adapter = TypeAdapter(what)
    try:
        return adapter.validate_python(content)
    except ValidationError as error:
        lines = mistakes(error, content, adapter)
        raise InvalidInput("\n".join(f"{path}: {line}" for line in lines)) from error


def mistakes(error: ValidationError, content: dict, adapter: TypeAdapter) -> list[str]:
    """One line a mistake: where it is, what stands there, what is allowed."""
    lines = []
    for mistake in _with_what_is_missing(error, content, adapter).errors(include_url=False):
        kind, value, allowed = mistake["type"], mistake["input"], mistake["msg"].removeprefix("Value error, ")
        where = _place(mistake["loc"], content)
        if kind == "too_short" and len(value) >= mistake["ctx"]["min_length"]:
            continue  # it is long enough: what is wrong with its items has a line of its own
        if kind == "union_tag_invalid":
            where, value = (*where, "type"), value["type"]
            allowed = f"one of {mistake['ctx']['expected_tags']}"
        elif kind.endswith("attributes_type") or kind == "dataclass_type":
            allowed = "a table"
        elif kind == "int_type" and isinstance(value, float):
            allowed += ", written without a decimal point"
        allowed = allowed.replace("valid tuple", "list")
        said = f" = {value!r}: " if _brief(value) else ": "
        if isinstance(value, str) and value == MISSING:
            said, allowed = ": missing, ", allowed.removeprefix("Input should be ")
        # What is wrong with the parts of the whole names them itself.
        lines.append(".".join(map(str, where)) + said + allowed if where else allowed)
    return lines


def _brief(value):
    """Whether a message is clearer by it: a table, or rows of numbers, say nothing that their own does not."""
    if isinstance(value, list | tuple):
        return not any(isinstance(each, list | tuple | dict) for each in value) and all(map(_brief, value))
    if isinstance(value, int):
        return value.bit_length() <= LONGEST
    return isinstance(value, str | float | date | time)


def _with_what_is_missing(error, content, adapter):
    """The same mistakes where what is missing is there, but wrong: its message then says what is allowed."""
    filled = deepcopy(content)
    for mistake in error.errors(include_url=False):
        where = _place(mistake["loc"], content)
        if mistake["type"] == "union_tag_not_found":
            where = (*where, "type")
        elif mistake["type"] != "missing":
            continue
        try:
            reduce(getitem, where[:-1], filled)[where[-1]] = MISSING
        except (LookupError, TypeError):
            continue  # beyond the end of a list, or of what was read from another file
    try:
        adapter.validate_python(filled)
    except ValidationError as fuller:
        return fuller
    return error


def _place(location, content):
    """The names on the way to a mistake as they stand in the file: the type of a table is none of them."""
    where = ()
    for part in location:
        if isinstance(content, dict) and part not in content and part == content.get("type"):
            continue
        where = (*where, part)
        try:
            content = content[part]
        except (LookupError, TypeError):
            content = None
    return where
