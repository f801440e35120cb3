"""Reading TOML files into validated objects, with every mistake named at once."""

import tomllib
from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

from ..printable import brief, printable
from ..quantities import WHOLE
from . import files
from .error_text import LISTED, error_text

__all__ = [
    "InvalidInput",
    "error_text",
    "invalid",
    "made",
    "parsed",
    "read",
    "text_of",
    "validator",
    "whole",
]

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
    name, said = brief(str(path)), [*lines[:LISTED], *more]
    return InvalidInput("\n".join(f"{name}: {brief(line, LONGEST)}" for line in said))


def whole(name: str, given: Any, most: int) -> int:
    """A whole number from 1 on, as an argument of a function. Raises InvalidInput, which names it."""
    try:
        found = WHOLE.value(given)
    except ValueError:
        found = 0
    if not 1 <= found <= most:
        raise InvalidInput(f"{name} = {brief(repr(given))}: a whole number from 1 to {most}")
    return found
