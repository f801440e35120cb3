"""Reading TOML files into validated objects, with every mistake named at once."""

import tomllib
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

from .mistakes import mistakes

__all__ = ["InvalidInput", "made", "mistakes", "parsed", "read", "tables", "text_of"]


class InvalidInput(ValueError):
    """A file that cannot be read as what it should be; the message lists every mistake, one a line."""


def read(path: str | Path, what: Any):
    """Read a TOML file as `what`, a validated dataclass or model.

    Raises InvalidInput naming for each mistake the field, the value, what is allowed, and for a name that is
    misspelt the one that was probably meant.
    """
    return made(tables(path), what, path)


def tables(path: str | Path) -> dict[str, Any]:
    """The content of a TOML file as it stands there. Raises InvalidInput."""
    return parsed(text_of(path), path)


def text_of(path: str | Path) -> str:
    """A file in UTF-8. Raises InvalidInput."""
    try:
        return Path(path).read_text(encoding="utf-8")
    except OSError as error:
        raise InvalidInput(f"{path}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise InvalidInput(f"{path} is not valid TOML: {error}") from error


def parsed(text: str, path: str | Path) -> dict[str, Any]:
    """What a text of TOML says; path : that it is of, for mistakes. Raises InvalidInput."""
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError) as error:  # also of numbers too long to be read, and of lists too deep
        raise InvalidInput(f"{path} is not valid TOML: {error}") from error


def made(content: dict[str, Any], what: Any, path: str | Path):
    """What a file holds as `what`. Raises InvalidInput, naming the file, as `read` does."""
    adapter = TypeAdapter(what)
    try:
        return adapter.validate_python(content)
    except ValidationError as error:
        lines = mistakes(error, content, adapter)
        raise InvalidInput("\n".join(f"{path}: {line}" for line in lines)) from error
