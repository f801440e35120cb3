"""Mistakes in the content of a file: all at once, one line each, with what was probably meant."""

import re
from collections.abc import Callable, Iterator, Sequence
from copy import deepcopy
from dataclasses import dataclass
from datetime import date, time
from functools import reduce
from operator import getitem
from typing import Any

from pydantic import TypeAdapter, ValidationError

from .meanings import meaning, type_meant
from .names import CLOSE, Names, nearest
from .printable import brief

# Stand for what is missing, and for a type that is; nothing allows them.
MISSING, NO_TYPE = object(), "\0"
LONGEST = 4096  # bits of a whole number that is shown
CHOICE = "a choice: "  # with which the tags of a choice begin that no type decides: they are no names of the file
SAID = 50  # mistakes of a file that are said; of others there is only the number
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


def said(error: ValidationError) -> str:
    """The first mistake of what is no file, in words."""
    return error.errors(include_url=False)[0]["msg"].removeprefix("Value error, ")


def mistakes(error: ValidationError, content: dict, adapter: TypeAdapter) -> list[str]:
    """One line a mistake: where it is, what stands there, what is allowed; in the order of the file.

    A name that is misspelt, or stands in the wrong table, is one mistake; what stands under it is checked as if it
    were right.
    """
    return [each.line for each in examined(error, content, adapter)[0]]


def examined(error: ValidationError, content: dict, adapter: TypeAdapter) -> tuple[list[Mistake], dict]:
    """Every mistake with its place, and the content with what was probably meant in place of wrong names.

    What was probably meant is sought for the first SAID of them.
    """
    names, mended, order, said = Names.of(adapter), deepcopy(content), _order(content), []
    for _ in range(_ROUNDS):
        found = _mended(error, mended, names, order)
        said += found
        error = _error(adapter, mended)
        if error is None or not found:
            break
    if error is not None:
        left_out = [each.where for each in said if not each.mended]
        said += _remaining(_with_what_is_missing(error, mended, adapter), mended, names, left_out, order)
    said.sort(key=lambda each: order(each.where))
    return list({each.line: each for each in said}.values()), mended


def _error(adapter, content):
    try:
        adapter.validate_python(content)
    except ValidationError as error:
        return error
    return None


def _placed(error, content, order) -> list[tuple[Place, Any]]:
    """Mistakes of an error, each with its place, in the order of the file."""
    found = [(place(each["loc"], content), each) for each in error.errors(include_url=False)]
    return sorted(found, key=lambda each: order(each[0]))


def _mended(error, content, names, order) -> list[Mistake]:
    """Names and types that are unknown, said, and in the content made what was probably meant."""
    said: list[Mistake] = []
    for where, mistake in _placed(error, content, order):
        kind, suggests = mistake["type"], len(said) < SAID
        if kind in ("unexpected_keyword_argument", "extra_forbidden"):
            said += _unknown_name(where, content, names, suggests)
        elif kind == "union_tag_invalid" and suggests:
            said += _unknown_type(where, content, mistake)
        elif kind == "union_tag_not_found" and suggests:
            said += _misspelt_type(where, content)
    return said


def _unknown_name(where, content, names, suggests):
    table, name = _at(where[:-1], content), where[-1]
    if not (isinstance(table, dict) and name in table):
        return
    value = table.pop(name)
    line, meant = f"{_written(where, value)}unknown here", None
    if suggests:
        known, meant = names.at(where[:-1], content), names.meant(where, value, content)
        here = meaning(name, known)
        like = here.field(known) if here else nearest(name, known, CLOSE)
        if meant:
            line += f"; did you mean {_dotted(meant[len(where) - 1 :] if meant[:-1] == where[:-1] else meant)}?"
            _home(meant[:-1], content).setdefault(meant[-1], value)
        elif here and here.says:
            line += f"; {here.says}"
        elif like in table:
            line += f"; did you mean {like}? It has a value already"
        elif like:
            line += f"; {like} takes {names.takes((*where[:-1], like), content)}"
        if known:
            line += f"{' Known' if line.endswith('?') else '; known'} are {', '.join(known)}"
    yield Mistake(where, line, meant is not None)


def _home(where, content):
    """The table at a place, made where it is not there yet."""
    for part in where:
        content = content[part] if isinstance(content, list) else content.setdefault(part, {})
    return content


def _unknown_type(where, content, mistake):
    table, one_of = _at(where, content), mistake["ctx"]["expected_tags"]
    given = table.get("type") if isinstance(table, dict) else None
    if not isinstance(given, str):
        return
    if (meant := type_meant(given, _quoted(one_of)) or _literal(given, one_of)) is None:
        return
    table["type"] = meant
    yield Mistake((*where, "type"), f"{_written((*where, 'type'), given)}one of {one_of}; did you mean {meant!r}?")


def _misspelt_type(where, content):
    table = _at(where, content)
    if not isinstance(table, dict):
        return
    if (name := nearest("type", [key for key in table if isinstance(table[key], str)])) is None:
        return
    value = table["type"] = table.pop(name)
    yield Mistake((*where, name), f"{_written((*where, name), value)}unknown here; did you mean type?")


def _remaining(error, content, names, left_out, order) -> Iterator[Mistake]:
    """Wrong values, and missing fields; nothing of a table as a whole that has lost a part."""
    poorer = {where[:depth] for where in left_out for depth in range(len(where) + 1)}
    for number, (where, mistake) in enumerate(_placed(error, content, order)):
        kind, value, allowed = mistake["type"], mistake["input"], mistake["msg"].removeprefix("Value error, ")
        if kind == "too_short" and len(value) >= mistake["ctx"]["min_length"]:
            continue  # it is long enough: what is wrong with its items has a line of its own
        if kind == "value_error" and where in poorer:
            continue
        if kind == "union_tag_invalid":
            where, value = (*where, "type"), _at(("type",), value)
            allowed = f"one of {mistake['ctx']['expected_tags']}"
        elif kind.endswith("attributes_type") or kind == "dataclass_type":
            allowed = "a table"
        elif kind == "int_type" and isinstance(value, float):
            allowed += ", written without a decimal point"
        elif kind == "literal_error" and number < SAID and (meant := _literal(value, mistake["ctx"]["expected"])):
            allowed += f"; did you mean {meant!r}?"
        elif kind in _OUT_OF_RANGE and isinstance(stated := _at(where, content), str):
            value, allowed = stated, f"{allowed}, in SI units"
        allowed = allowed.replace("valid tuple", "list")
        if value is MISSING or value is NO_TYPE:
            allowed = "; or ".join([allowed.removeprefix("Input should be "), *names.instead(where, content)])
            yield Mistake(where, f"{_dotted(where)}: missing, {allowed}")
        else:
            # What is wrong with the parts of the whole names them itself.
            yield Mistake(where, _written(where, value) + allowed if where else allowed)


def _literal(value, expected):
    return nearest(value, _quoted(expected)) if isinstance(value, str) else None


def _quoted(text):
    return re.findall(r"'([^']*)'", text)


def _written(where, value):
    return _dotted(where) + (f" = {brief(repr(value))}: " if _brief(value) else ": ")


def _dotted(where):
    return ".".join(brief(str(part)) for part in where)


def _brief(value):
    """Whether a value is short enough for a message: tables and rows of numbers are not."""
    if isinstance(value, list | tuple):
        return not any(isinstance(each, list | tuple | dict) for each in value) and all(map(_brief, value))
    if isinstance(value, int):
        return value.bit_length() <= LONGEST
    return isinstance(value, str | float | date | time)


def _with_what_is_missing(error, content, adapter):
    """Mistakes with a wrong value in place of each missing one, so that its message says what is allowed."""
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
    for number, part in enumerate(location, start=1):
        if isinstance(part, str) and part.startswith(CHOICE):
            continue
        if _is_type(part, content) and (
            part not in content or _leads_on(place(location[number:], content), content)
        ):
            continue  # a table may also have a name that is called as its type
        where = (*where, part)
        content = _at((part,), content)
    return where


def _is_type(part, content):
    return isinstance(content, dict) and part == content.get("type")


def _leads_on(where, content):
    """Whether what a place names could stand there."""
    return bool(where) and isinstance(_at(where[:-1], content), dict if isinstance(where[-1], str) else list)


def _at(where, content):
    """Content at a place; None where there is nothing."""
    try:
        return reduce(getitem, where, content)
    except (LookupError, TypeError):
        return None


def _order(content: Any) -> Callable[[Place], list[int]]:
    """Order of places in a file; a missing field comes after those of the same table."""
    numbers: dict[int, dict[str, int]] = {}

    def of(where):
        order, inside = [], content
        for part in where:
            known = {}
            if isinstance(inside, dict):
                known = numbers.get(id(inside)) or {name: number for number, name in enumerate(inside)}
                numbers[id(inside)] = known
            order.append(known.get(part, part if isinstance(part, int) else len(known)))
            inside = _at((part,), inside)
        return order

    return of
