"""Mistakes in the content of a file or of a call: all at once, one line each, with the nearest known name."""

from collections.abc import Iterable
from datetime import date, time
from difflib import get_close_matches
from functools import reduce
from operator import getitem, or_
from typing import Any

from pydantic import TypeAdapter, ValidationError

from ..printable import brief

CHOICE = "a choice: "  # with which the tags of a choice begin that no type decides: they are no names of the file
LISTED = 50  # mistakes that are listed, and for which a near name is sought; of others there is only the number
_LONGEST_NAME = 100  # letters that are compared
_LONGEST_LIST = 10  # items of a list that are shown
_KINDS = {dict: "object", list: "array"}
_WORDS = {"array": "a list", "string": "a text", "boolean": "true or false", "number": "a number"}


def error_text(error: ValidationError, content: dict, adapter: TypeAdapter) -> list[str]:
    """One line a mistake: where it is, what stands there, what is allowed; unknown names and types come first.

    What stands under a misspelt name, and in a table whose type is missing or unknown, is checked too: as if the
    nearest name stood there, and the type that has most of the names.
    """
    lines: list[str] = []
    schema, tables, untyped = adapter.json_schema(), {}, set()

    def like(name, known):
        """The known name that one is most like; None where none is, and beyond the mistakes that are listed."""
        if len(lines) >= LISTED or not isinstance(name, str):
            return None
        return next(iter(get_close_matches(name[:_LONGEST_NAME].lower(), known, 1)), None)

    def followed(node, kind="object"):
        """A schema without references, of those of a choice the one of a kind."""
        while "$ref" in node:
            node = schema["$defs"][node["$ref"].rpartition("/")[2]]
        choices = node.get("anyOf") or node.get("oneOf")
        if not choices or "discriminator" in node or "properties" in node:
            return node
        fitting = [each for each in map(followed, choices) if each.get("type", "object") == kind]
        return fitting[0] if len(fitting) == 1 else {}

    def typed(where, content, kinds):
        """Type of a table: the nearest to its own, or the one that has most of its names."""
        place, allowed = (*where, "type"), f"one of {', '.join(map(repr, kinds))}"
        near = like(content.get("type"), kinds)
        stated = _written(place, content["type"]) if "type" in content else f"{_dotted(place)}: missing,"
        lines.append(f"{stated} {allowed}{_meant(near)}")
        if near is None:
            untyped.add(where)
        return near or max(kinds, key=lambda each: len(kinds[each].keys() & content.keys()))

    def renamed(where, node, content):
        """Content under the nearest names and types; unknown ones are noted, and left out without a near name."""
        node = followed(node, _KINDS.get(type(content)))
        if isinstance(content, list):
            return [renamed((*where, k), node.get("items", {}), each) for k, each in enumerate(content)]
        known = node.get("properties", {})
        if isinstance(content, dict) and "discriminator" in node:
            types = node["discriminator"]["mapping"]
            kinds = {name: followed({"$ref": each})["properties"] for name, each in types.items()}
            if content.get("type") not in [*kinds]:
                content = content | {"type": typed(where, content, kinds)}
            known = reduce(or_, kinds.values()) if where in untyped else kinds[content["type"]]
        if not isinstance(content, dict) or not known:
            return content
        tables[where], found = known, {}
        for name, value in content.items():
            near = name
            if name not in known:
                near = like(name, known)
                listed = "" if where in untyped else f"{' Known' if near else '; known'} are {', '.join(known)}"
                lines.append(f"{_written((*where, name), value)} unknown here{_meant(near)}{listed}")
            if near in known and (near == name or near not in content):
                found[near] = renamed((*where, near), known[near], value)
        return found

    content = renamed((), schema, content)
    try:
        if lines:
            adapter.validate_python(content)
            return lines
    except ValidationError as left:
        error = left
    for each in error.errors(include_url=False):
        kind, value, allowed = each["type"], each["input"], each["msg"].removeprefix("Value error, ")
        where = place(each["loc"], content)
        if where[:-1] in untyped and kind in ("missing", "unexpected_keyword_argument"):
            continue  # what it needs is not known
        if kind == "value_error" and any(each[: len(where)] == where for each in untyped):
            continue  # nor what fits together
        if kind == "too_short" and len(value) >= each["ctx"]["min_length"]:
            continue  # it is long enough: what is wrong with its items has a line of its own
        if kind == "missing":
            node = tables.get(where[:-1], {}).get(where[-1], {})
            usual = "a table" if {"$ref", "discriminator"} & node.keys() else "a value"
            allowed = node.get("description") or _WORDS.get(node.get("type"), usual)
            lines.append(f"{_dotted(where)}: missing, {allowed}")
            continue
        stated = _part(where, content, value)
        if kind.endswith("attributes_type") or kind == "dataclass_type":
            allowed = "a table"
        elif kind == "literal_error":
            allowed += _meant(like(value, each["ctx"]["expected"].split("'")[1::2]))
        elif "than" in kind and isinstance(stated, str):
            allowed += ", in SI units"
        # What is wrong with the parts of the whole names them itself.
        lines.append(f"{_written(where, stated)} {allowed}" if where else allowed)
    return list(dict.fromkeys(lines))


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


def _part(where, content, absent=None):
    """Content at a place; another value where there is nothing."""
    try:
        return reduce(getitem, where, content)
    except (LookupError, TypeError):
        return absent


def _written(where, value):
    return _dotted(where) + (f" = {brief(repr(value))}:" if _short(value) else ":")


def _dotted(where):
    return ".".join(brief(str(part)) for part in where)


def _meant(near):
    return f"; did you mean {near}?" if near else ""


def _short(value):
    """Whether a value is short enough for a message: tables and rows of numbers are not."""
    if isinstance(value, list | tuple):
        return len(value) <= _LONGEST_LIST and all(map(_short, value))
    return value is None or isinstance(value, str | int | float | date | time)
