"""Mistakes in the content of a file or of a call: all at once, one line each, with the nearest known name."""

from collections.abc import Iterable
from datetime import date, time
from difflib import get_close_matches
from functools import reduce
from operator import getitem, or_
from typing import Any

from pydantic import TypeAdapter, ValidationError
from pydantic.errors import PydanticInvalidForJsonSchema

from .printable import brief

CHOICE = "a choice: "  # with which the tags of a choice begin that no type decides: they are no names of the file
SAID = 50  # mistakes that are listed, and for which a near name is sought; of others there is only the number
_LIKE, _LONGEST_NAME = 0.6, 100  # as of difflib, where 1 is equal; letters that are compared
_LONGEST_NUMBER, _LONGEST_LIST = 4096, 10  # bits of a whole number, and items of a list, that are shown
_KINDS = {dict: "object", list: "array"}
_WORDS = {"array": "a list", "string": "a text", "boolean": "true or false", "number": "a number"}


def first(error: ValidationError) -> str:
    """The first mistake of what is no file, in words."""
    return error.errors(include_url=False)[0]["msg"].removeprefix("Value error, ")


def mistakes(error: ValidationError, content: dict, adapter: TypeAdapter) -> list[str]:
    """One line a mistake: where it is, what stands there, what is allowed; unknown names and types come first.

    What stands under a misspelt name, and in a table whose type is missing or unknown, is checked too: as if the
    nearest name stood there, and the type that has most of the names.
    """
    lines, tables, untyped = [], {}, set()
    try:
        schema = adapter.json_schema()
    except PydanticInvalidForJsonSchema:  # of types whose names nothing tells
        schema = {}

    def like(name, known):
        return nearest(name, known) if len(lines) < SAID and isinstance(name, str) else None

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
        """A table with a type: the nearest to its own, or the one that has most of its names."""
        given, allowed = content.get("type"), f"one of {', '.join(map(repr, kinds))}"
        near = like(given, kinds)
        if near is None:
            untyped.add(where)
            near = max(kinds, key=lambda each: len(kinds[each].keys() & content.keys()))
            lines.append(_line((*where, "type"), given, allowed))
        else:
            lines.append(_line((*where, "type"), given, allowed, near))
        return content | {"type": near}

    def renamed(where, node, content):
        """Content under the nearest names and types; what is unknown is noted, and left out without a near name."""
        node = followed(node, _KINDS.get(type(content)))
        if isinstance(content, list):
            return [renamed((*where, k), node.get("items", {}), each) for k, each in enumerate(content)]
        known = node.get("properties", {})
        if isinstance(content, dict) and "discriminator" in node:
            types = node["discriminator"]["mapping"]
            kinds = {name: followed({"$ref": each})["properties"] for name, each in types.items()}
            if content.get("type") not in [*kinds]:
                content = typed(where, content, kinds)
            known = reduce(or_, kinds.values()) if where in untyped else kinds[content["type"]]
        if not isinstance(content, dict) or not known:
            return content
        tables[where], found = known, {}
        for name, value in content.items():
            near = name
            if name not in known:
                near = like(name, known)
                lines.append(_line((*where, name), value, f"unknown here; known are {', '.join(known)}", near))
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
            continue
        if where in untyped and kind == "value_error":
            continue
        if kind == "too_short" and len(value) >= each["ctx"]["min_length"]:
            continue  # it is long enough: what is wrong with its items has a line of its own
        stated, near = _part(where, content, value), None
        if kind == "missing":
            stated, node = None, tables.get(where[:-1], {}).get(where[-1], {})
            usual = "a table" if {"$ref", "discriminator"} & node.keys() else "a value"
            allowed = node.get("description") or _WORDS.get(node.get("type"), usual)
        elif kind.endswith("attributes_type") or kind == "dataclass_type":
            allowed = "a table"
        elif kind == "int_type" and isinstance(value, float):
            allowed += ", written without a decimal point"
        elif kind == "literal_error":
            near = like(value, each["ctx"]["expected"].split("'")[1::2])
        elif "than" in kind and isinstance(stated, str):
            allowed += ", in SI units"
        # What is wrong with the parts of the whole names them itself.
        allowed = allowed.replace("valid tuple", "list")
        lines.append(_line(where, stated, allowed, near) if where else allowed)
    return list(dict.fromkeys(lines))


def nearest(name: str, known: Iterable[str]) -> str | None:
    """The known name that one is most like; None where none is."""
    plain = {each.lower().replace("_", "-"): each for each in reversed(list(known))}
    found = get_close_matches(name[:_LONGEST_NAME].lower().replace("_", "-"), plain, 1, _LIKE)
    return plain[found[0]] if found else None


def place(location: Iterable[str | int], content: Any) -> tuple[str | int, ...]:
    """The names on the way to a mistake as they stand in the file: the type of a table, or a choice, is none."""
    where, tag = (), None
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


def _line(where, value, allowed, near=None):
    stated = ": missing," if value is None else f" = {brief(repr(value))}:" if _short(value) else ":"
    question = f"; did you mean {near}?" if near else ""
    return f"{'.'.join(brief(str(part)) for part in where)}{stated} {allowed}{question}"


def _short(value):
    """Whether a value is short enough for a message: tables and rows of numbers are not."""
    if isinstance(value, list | tuple):
        return len(value) <= _LONGEST_LIST and all(map(_short, value))
    if isinstance(value, int):
        return value.bit_length() <= _LONGEST_NUMBER
    return isinstance(value, str | float | date | time)
