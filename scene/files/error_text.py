"""Mistakes in the content of a file or of a call: all at once, one line each, with the nearest known name."""

from collections.abc import Iterable
from datetime import date, time
from difflib import get_close_matches
from functools import reduce
from operator import getitem
from typing import Any

from pydantic import TypeAdapter, ValidationError

from ..printable import brief

CHOICE = "a choice: "  # with which the tags of a choice begin that no type decides: they are no names of the file
LISTED = 50  # mistakes that are listed, and for which a near name is sought; of others there is only the number
_LONGEST_NAME = 100  # letters that are compared
_LONGEST_NUMBER, _LONGEST_LIST = 4096, 10  # bits of a whole number, and items of a list, that are shown
_WORDS = {"array": "a list", "string": "a text", "boolean": "true or false", "number": "a number"}


def error_text(error: ValidationError, content: Any, adapter: TypeAdapter) -> list[str]:
    """One line a mistake: where it is, what stands there, what is allowed; unknown names and types come first.

    A table whose type is missing or unknown is checked too: as one of the nearest type, or else of the type that
    has most of its names.
    """
    schema, unknown, others = adapter.json_schema(), [], []
    untyped: dict[tuple, set[str]] = {}  # tables of no type that is known, and the names that any type has
    meant: set[tuple] = set()  # names that others are most like

    def like(name, known):
        """The known name that one is most like; None where none is, and beyond the mistakes that are listed."""
        if len(unknown) + len(others) >= LISTED or not isinstance(name, str):
            return None
        return next(iter(get_close_matches(name[:_LONGEST_NAME].lower(), known, 1)), None)

    while tags := [each for each in error.errors() if each["type"].startswith("union_tag")]:
        for each in tags:
            where = place(each["loc"], content)
            table, kinds = _part(where, content), _kinds(schema, where, content)
            near = like(table.get("type"), kinds)
            stated = _written((*where, "type"), table["type"]) if "type" in table else _missing((*where, "type"))
            unknown.append(f"{stated} one of {', '.join(map(repr, kinds))}{_meant(near)}")
            if near is None:
                untyped[where] = set().union(*kinds.values())
            guess = near or max(kinds, key=lambda kind: len(kinds[kind] & table.keys()))
            content = _replaced(content, where, table | {"type": guess})
        try:
            adapter.validate_python(content)
            return unknown
        except ValidationError as left:
            error = left
    found = [(place(each["loc"], content), each) for each in error.errors(include_url=False)]
    for where, each in found:
        if each["type"] != "unexpected_keyword_argument":
            continue
        *table, name = where
        known = untyped.get(tuple(table)) or _node(schema, table, content).get("properties", {})
        if name not in known:
            near = like(name, known)
            meant.add((*table, near))
            listed = f"{' Known' if near else '; known'} are {', '.join(known)}"
            listed = "" if tuple(table) in untyped else listed
            unknown.append(f"{_written(where, each['input'])} unknown here{_meant(near)}{listed}")
    for where, each in found:
        kind, value, allowed = each["type"], each["input"], each["msg"].removeprefix("Value error, ")
        if kind == "unexpected_keyword_argument" or where in meant:
            continue
        if kind == "missing" and where[:-1] in untyped:
            continue  # what it needs is not known
        if kind == "value_error" and any(one[: len(where)] == where for one in untyped):
            continue  # nor what fits together
        if kind == "too_short" and len(value) >= each["ctx"]["min_length"]:
            continue  # it is long enough: what is wrong with its items has a line of its own
        if kind == "missing":
            node = _node(schema, where[:-1], content).get("properties", {}).get(where[-1], {})
            usual = "a table" if {"$ref", "discriminator"} & node.keys() else "a value"
            others.append(f"{_missing(where)} {node.get('description') or _WORDS.get(node.get('type'), usual)}")
            continue
        stated = _part(where, content, value)
        if kind.endswith("attributes_type") or kind == "dataclass_type":
            allowed = "a table"
        elif kind == "literal_error":
            allowed += _meant(like(value, each["ctx"]["expected"].split("'")[1::2]))
        elif "than" in kind and isinstance(stated, str):
            allowed += ", in SI units"
        # What is wrong with the parts of the whole names them itself.
        others.append(f"{_written(where, stated)} {allowed}" if where else allowed)
    return list(dict.fromkeys(unknown + others))


def place(location: Iterable[str | int], content: Any) -> tuple[str | int, ...]:
    """The names on the way to a mistake as they stand in the file: the type of a table, or a choice, is none."""
    where: tuple[str | int, ...] = ()
    tag = None
    for part in location:
        if part == tag or str(part).startswith(CHOICE):
            tag = None
        elif isinstance(part, int) or isinstance(content, dict):
            where, content = (*where, part), _part((part,), content)
            tag = content.get("type") if isinstance(content, dict) else None
    return where


def _node(schema, where, content):
    """JSON schema of what stands at a place."""
    node = _followed(schema, schema, content)
    for part in where:
        inner = node.get("items", {}) if isinstance(part, int) else node.get("properties", {}).get(part, {})
        content = _part((part,), content)
        node = _followed(schema, inner, content)
    kinds = node.get("discriminator", {}).get("mapping", {})
    kind = content.get("type") if isinstance(content, dict) else None
    return _followed(schema, {"$ref": kinds[kind]}, content) if kind in [*kinds] else node


def _kinds(schema, where, content):
    """Names of fields by the types that a table at a place may have."""
    node = _node(schema, where, content)
    named = {name: {"$ref": each} for name, each in node["discriminator"]["mapping"].items()}
    return {name: {*_followed(schema, each, {})["properties"]} for name, each in named.items()}


def _followed(schema, node, content):
    """A schema without references, of those of a choice the one of the kind of the content."""
    while "$ref" in node:
        node = schema["$defs"][node["$ref"].rpartition("/")[2]]
    choices = node.get("anyOf") or node.get("oneOf")
    if not choices or "discriminator" in node or "properties" in node:
        return node
    kind = "array" if isinstance(content, list) else "object"
    every = [_followed(schema, each, content) for each in choices]
    fitting = [each for each in every if each.get("type", "object") == kind]
    return fitting[0] if len(fitting) == 1 else {}


def _replaced(content, where, value):
    """Content with another value at a place."""
    if not where:
        return value
    first, *rest = where
    inner = _replaced(content[first], rest, value)
    if isinstance(content, dict):
        return content | {first: inner}
    return [*content[:first], inner, *content[first + 1 :]]


def _part(where, content, absent=None):
    """Content at a place; another value where there is nothing."""
    try:
        return reduce(getitem, where, content)
    except (LookupError, TypeError):
        return absent


def _written(where, value):
    return _dotted(where) + (f" = {brief(repr(value))}:" if _short(value) else ":")


def _missing(where):
    return f"{_dotted(where)}: missing,"


def _dotted(where):
    return ".".join(brief(str(part)) for part in where)


def _meant(near):
    return f"; did you mean {near}?" if near else ""


def _short(value):
    """Whether a value is short enough for a message: tables and rows of numbers are not."""
    if isinstance(value, list | tuple):
        return len(value) <= _LONGEST_LIST and all(map(_short, value))
    if isinstance(value, int):
        return value.bit_length() <= _LONGEST_NUMBER
    return value is None or isinstance(value, str | float | date | time)
