"""Reading TOML files into validated objects, with every mistake named at once, one line each."""

import tomllib
from collections.abc import Iterable, Sequence
from datetime import date, time
from difflib import get_close_matches
from functools import lru_cache, reduce
from operator import getitem
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

from ..printable import brief, printable
from ..quantities import WHOLE
from . import files

CHOICE = "a choice: "  # with which the tags of a choice begin that no type decides: they are no names of the file
LISTED = 50  # mistakes that are listed, and for which a near name is sought; of others there is only the number
_LONGEST_NAME = 100  # letters that are compared
_LONGEST_LIST = 10  # items of a list that are shown
_KINDS = {dict: "object", list: "array"}
_WORDS = {"array": "a list", "string": "a text", "boolean": "true or false", "number": "a number"}
_UNKNOWN, _UNTYPED = _FIRST = "unexpected_keyword_argument", "union_tag"


def error_text(error: ValidationError, content: dict, adapter: TypeAdapter) -> list[str]:
    """One line a mistake: where it is, what stands there, what is allowed; unknown names and types come first."""
    lines: list[str] = []
    schema, meant = adapter.json_schema(), set()

    def like(name, known):
        """The known name that one is most like; None where none is, and beyond the mistakes that are listed."""
        if len(lines) >= LISTED or not isinstance(name, str):
            return None
        return next(iter(get_close_matches(name[:_LONGEST_NAME].lower(), known, 1)), None)

    def followed(node, held):
        """The schema of a value without references, of those of a choice the one that the value is of."""
        while "$ref" in node:
            node = schema["$defs"][node["$ref"].rpartition("/")[2]]
        if "discriminator" in node:
            kinds, kind = node["discriminator"]["mapping"], _part(("type",), held)
            return followed({"$ref": kinds[kind]}, held) if isinstance(kind, str) and kind in kinds else node
        choices = [followed(each, held) for each in node.get("anyOf", ())]
        return next(
            (each for each in choices if each.get("type", "object") == _KINDS.get(type(held), "object")), node
        )

    def node_at(where):
        """The schema at a place."""
        node, held = followed(schema, content), content
        for name in where:
            held = _part((name,), held)
            inner = node.get("items", {}) if isinstance(name, int) else node.get("properties", {}).get(name, {})
            node = followed(inner, held)
        return node

    for each in sorted(error.errors(include_url=False), key=lambda each: not each["type"].startswith(_FIRST)):
        kind, value, allowed = each["type"], each["input"], each["msg"].removeprefix("Value error, ")
        where = place(each["loc"], content)
        if kind == _UNKNOWN:
            known = node_at(where[:-1]).get("properties", {})
            near = like(where[-1], known)
            meant.add((*where[:-1], near))
            listed = f"{' Known' if near else '; known'} are {', '.join(known)}"
            lines.append(f"{_written(where, value)} unknown here{_meant(near)}{listed}")
        elif kind.startswith(_UNTYPED):
            kinds = node_at(where)["discriminator"]["mapping"]
            place_of_type, given = (*where, "type"), _part(("type",), value)
            stated = f"{_dotted(place_of_type)}: missing," if given is None else _written(place_of_type, given)
            lines.append(f"{stated} one of {', '.join(map(repr, kinds))}{_meant(like(given, kinds))}")
        elif kind == "missing":
            if where not in meant:
                node = node_at(where[:-1]).get("properties", {}).get(where[-1], {})
                usual = "a table" if {"$ref", "discriminator"} & node.keys() else "a value"
                allowed = node.get("description") or _WORDS.get(node.get("type"), usual)
                lines.append(f"{_dotted(where)}: missing, {allowed}")
        elif kind == "too_short" and len(value) >= each["ctx"]["min_length"]:
            continue  # it is long enough: what is wrong with its items has a line of its own
        else:
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


MOST = 1_000_000  # bytes of a file
LONGEST = 2000  # letters of a mistake


class InvalidInput(ValueError):
    """Input that is not what it should be, of a file or of a call; the message lists mistakes, a line each."""

    def __init__(self, message: str):
        super().__init__(printable(message))


def read(path: str | Path, what: Any):
    """Read a TOML file as `what`, a validated dataclass or model.

    Raises InvalidInput naming for each mistake the field, the value, what is allowed, and the known name nearest
    to an unknown one; of more than LISTED mistakes the first, and how many there are.
    """
    return made(parsed(text_of(path), path), what, path)


def text_of(path: str | Path) -> str:
    """A file in UTF-8 of MOST bytes or less. Raises InvalidInput."""
    try:
        return files.text(path, MOST)
    except files.Unreadable as error:
        raise InvalidInput(str(error)) from error


def parsed(text: str, path: str | Path) -> dict[str, Any]:
    """Content of a text in TOML; path : of its file, for mistakes. Raises InvalidInput."""
    try:
        return tomllib.loads(text)
    except RecursionError as error:
        raise invalid(path, ["tables and lists stand in one another too deep"]) from error
    except tomllib.TOMLDecodeError as error:
        raise invalid(path, [f"is not valid TOML: {error}"]) from error
    except ValueError as error:  # of dates that are none, and of numbers too long to be read
        raise invalid(path, [f"is not valid TOML: {str(error).partition(';')[0]}"]) from error


def made(content: dict[str, Any], what: Any, path: str | Path):
    """Content of a file as `what`. Raises InvalidInput, naming the file, as `read` does."""
    adapter = validator(what)
    with files.paths_from(path):
        try:
            return adapter.validate_python(content)
        except ValidationError as error:
            raise invalid(path, error_text(error, content, adapter)) from error


@lru_cache(maxsize=8)
def validator(what: Any) -> TypeAdapter:
    """Validator of content as `what`, made once: that takes longer than its use."""
    return TypeAdapter(what)


def invalid(path: str | Path, lines: Sequence[str]) -> InvalidInput:
    """The mistakes of a file, a line each: the first LISTED, and how many more there are."""
    more = [f"and {len(lines) - LISTED:,} more mistakes"] if len(lines) > LISTED else []
    name, messages = brief(str(path)), [*lines[:LISTED], *more]
    return InvalidInput("\n".join(f"{name}: {brief(line, LONGEST)}" for line in messages))


def whole(name: str, given: Any, most: int) -> int:
    """A whole number from 1 on, as an argument of a function. Raises InvalidInput, which names it."""
    try:
        found = WHOLE.value(given)
    except ValueError:
        found = 0
    if not 1 <= found <= most:
        raise InvalidInput(f"{name} = {brief(repr(given))}: a whole number from 1 to {most}")
    return found
