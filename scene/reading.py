"""Reading TOML files into validated objects, with every mistake named at once."""

import tomllib
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError


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
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InvalidInput(f"{path} is not valid TOML: {error}") from error
    try:
        return TypeAdapter(what).validate_python(content)
    except ValidationError as error:
        raise InvalidInput("\n".join(f"{path}: {line}" for line in mistakes(error))) from error


def mistakes(error: ValidationError) -> list[str]:
    """One line a mistake: where it is, what stands there, what is allowed."""
    lines = []
    for mistake in error.errors(include_url=False):
        where = ".".join(str(part) for part in mistake["loc"]) or "the file"
        value = mistake["input"]
        # A whole table says nothing that its own message does not.
        said = "" if isinstance(value, dict) or mistake["type"] == "missing" else f" = {value!r}"
        lines.append(f"{where}{said}: {mistake['msg'].removeprefix('Value error, ')}")
    return lines
