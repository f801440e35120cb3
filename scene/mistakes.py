"""What is wrong with the content of a file: every mistake at once, one line each, with what was probably meant."""

import re
from collections.abc import Iterator, Sequence
from copy import deepcopy
from dataclasses import dataclass
from datetime import date, time
from functools import reduce
from operator import getitem
from typing import Any

from pydantic import TypeAdapter, ValidationError

from .names import CLOSE, Names, nearest

# Stand for what is missing, and for a type that is; nothing allows them.
MISSING, NO_TYPE = object(), "\0"
LONGEST = 4096  # bits of a whole number that is shown
CHOICE = "a choice: "  # with which the tags of a choice begin that no type decides: they are no names of the file
_ROUNDS = 10  # of mending: a table in a table that is misspelt takes two
_OUT_OF_RANGE = ("greater_than", "greater_than_equal", "less_than", "less_than_equal")

Place = tuple[str | int, ...]


@dataclass(frozen=True)
class Mistake:
    """One of them.

    where : names on the way to it
    line : for people
    mended : whether what was probably meant was checked in its stead
    """

    where: Place
    line: str
    mended: bool = True


def mistakes(error: ValidationError, content: dict, adapter: TypeAdapter) -> list[str]:
    """One line a mistake: where it is, what stands there, what is allowed; in the order of the file.

    A name that is misspelt, or stands in the wrong table, is one mistake; what stands under it is checked as if it
    were right.
    """
    return [each.line for each in examined(error, content, adapter)[0]]


def examined(error: ValidationError, content: dict, adapter: TypeAdapter) -> tuple[list[Mistake], dict]:
    """Every mistake with its place, and the content with what was probably meant in place of wrong names."""
    names, mended, said = Names.of(adapter), deepcopy(content), []
    for _ in range(_ROUNDS):
        found = _mended(error, mended, names)
        said += found
        error = _error(adapter, mended)
        if error is None or not found:
            break
    if error is not None:
        left_out = [each.where for each in said if not each.mended]
        said += _remaining(_with_what_is_missing(error, mended, adapter), mended, left_out)
    said.sort(key=lambda each: _order(each.where, content))
    return list({each.line: each for each in said}.values()), mended


def _error(adapter, content):
    try:
        adapter.validate_python(content)
    except ValidationError as error:
        return error
    return None


def _mended(error, content, names) -> list[Mistake]:
    """Names and types that are unknown, said, and in the content made what was probably meant."""
    said = []
    for mistake in error.errors(include_url=False):
        where, kind = place(mistake["loc"], content), mistake["type"]
        if kind in ("unexpected_keyword_argument", "extra_forbidden"):
            said.append(_unknown_name(where, content, names))
        elif kind == "union_tag_invalid":
            said += _unknown_type(where, content, mistake)
        elif kind == "union_tag_not_found" and isinstance(mistake["input"], dict):
            said += _misspelt_type(where, content)
    return said


def _unknown_name(where, content, names):
    table, name = reduce(getitem, where[:-1], content), where[-1]
    value, known = table.pop(name), names.at(where[:-1], content)
    meant = names.meant(where, value, content)
    line = f"{_written(where, value)}unknown here"
    if meant:
        line += f"; did you mean {_dotted(meant[len(where) - 1 :] if meant[:-1] == where[:-1] else meant)}?"
        _home(meant[:-1], content).setdefault(meant[-1], value)
    elif (like := nearest(name, known, CLOSE)) is not None:
        line += f"; did you mean {like}?"
    if known:
        line += f"{' Known' if line.endswith('?') else '; known'} are {', '.join(known)}"
    return Mistake(where, line, meant is not None)


def _home(where, content):
    """The table at a place, made where it is not there yet."""
    for part in where:
        content = content[part] if isinstance(content, list) else content.setdefault(part, {})
    return content


def _unknown_type(where, content, mistake):
    table, allowed = reduce(getitem, where, content), re.findall(r"'([^']*)'", mistake["ctx"]["expected_tags"])
    given = table.get("type")
    if not (isinstance(given, str) and (meant := nearest(given, allowed))):
        return
    table["type"] = meant
    one_of = mistake["ctx"]["expected_tags"]
    yield Mistake((*where, "type"), f"{_written((*where, 'type'), given)}one of {one_of}; did you mean {meant!r}?")


def _misspelt_type(where, content):
    table = reduce(getitem, where, content)
    if (name := nearest("type", [key for key in table if isinstance(table[key], str)])) is None:
        return
    value = table["type"] = table.pop(name)
    yield Mistake((*where, name), f"{_written((*where, name), value)}unknown here; did you mean type?")


def _remaining(error, content, left_out) -> Iterator[Mistake]:
    """What is wrong with values, and what is missing; nothing of a table as a whole that has lost a part."""
    for mistake in error.errors(include_url=False):
        kind, value, allowed = mistake["type"], mistake["input"], mistake["msg"].removeprefix("Value error, ")
        where = place(mistake["loc"], content)
        if kind == "too_short" and len(value) >= mistake["ctx"]["min_length"]:
            continue  # it is long enough: what is wrong with its items has a line of its own
        if kind == "value_error" and any(each[: len(where)] == where for each in left_out):
            continue
        if kind == "union_tag_invalid":
            where, value = (*where, "type"), value["type"]
            allowed = f"one of {mistake['ctx']['expected_tags']}"
        elif kind.endswith("attributes_type") or kind == "dataclass_type":
            allowed = "a table"
        elif kind == "int_type" and isinstance(value, float):
            allowed += ", written without a decimal point"
        elif kind == "literal_error" and (meant := _literal(value, mistake["ctx"]["expected"])):
            allowed += f"; did you mean {meant!r}?"
        elif kind in _OUT_OF_RANGE and isinstance(stated := _at(where, content), str):
            value, allowed = stated, f"{allowed}, in SI units"
        allowed = allowed.replace("valid tuple", "list")
        if value is MISSING or value is NO_TYPE:
            yield Mistake(where, _dotted(where) + ": missing, " + allowed.removeprefix("Input should be "))
        else:
            # What is wrong with the parts of the whole names them itself.
            yield Mistake(where, _written(where, value) + allowed if where else allowed)


def _literal(value, expected):
    return nearest(value, re.findall(r"'([^']*)'", expected)) if isinstance(value, str) else None


def _written(where, value):
    return _dotted(where) + (f" = {value!r}: " if _brief(value) else ": ")


def _dotted(where):
    return ".".join(map(str, where))


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
        where, stands = place(mistake["loc"], content), MISSING
        if mistake["type"] == "union_tag_not_found":
            where, stands = (*where, "type"), NO_TYPE
        elif mistake["type"] != "missing":
            continue
        try:
            reduce(getitem, where[:-1], filled)[where[-1]] = stands
        except (LookupError, TypeError):
            continue  # beyond the end of a list, or of what was read from another file
    return _error(adapter, filled) or error


def place(location: Sequence[str | int], content: Any) -> Place:
    """The names on the way to a mistake as they stand in the file: the type of a table, or a choice, is none."""
    where: Place = ()
    for part in location:
        if isinstance(content, dict) and part not in content and part == content.get("type"):
            continue
        if isinstance(part, str) and part.startswith(CHOICE):
            continue
        where = (*where, part)
        content = _at((part,), content)
    return where


def _at(where, content):
    """What stands at a place; None where nothing does."""
    try:
        return reduce(getitem, where, content)
    except (LookupError, TypeError):
        return None


def _order(where, content):
    """Of places in the file; what is missing comes after what stands in the same table."""
    order = []
    for part in where:
        keys = list(content) if isinstance(content, dict) else []
        order.append(keys.index(part) if part in keys else part if isinstance(part, int) else len(keys))
        content = _at((part,), content)
    return order
