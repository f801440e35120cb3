"""Inputs as JSON, and back: a map of heights that was measured is held whole."""

from typing import Any, TypeVar

import numpy as np
from pydantic import TypeAdapter

T = TypeVar("T")


def as_json(kind: type[T], asked: T) -> Any:
    """A validated dataclass as JSON can hold it."""
    content = TypeAdapter(kind).dump_python(asked, mode="json")
    for name, part in vars(asked).items():
        if hasattr(part, "heights"):
            content[name] |= {"heights": np.asarray(part.heights.heights).tolist()}
    return content


def from_json(kind: type[T], content: Any) -> T:
    """Inputs from their JSON. Raises pydantic.ValidationError of what an earlier version wrote otherwise."""
    return TypeAdapter(kind).validate_python(content)
