"""Signatures that a person reads: `radius: Length`, where the type itself spells out every check of a number."""

import dataclasses
import inspect
import re
import sys
import types
import typing
from collections.abc import Callable, Iterable, Mapping
from functools import cache, wraps
from typing import Any, TypeVar

from pydantic import ValidationError
from pydantic.dataclasses import is_pydantic_dataclass

from . import quantities
from .files.reading import error_text, invalid, validator

_T = TypeVar("_T", bound=Callable)


class _Words(str):
    """An annotation or a default that is shown as it stands."""

    def __repr__(self) -> str:
        return str(self)


def make_readable(owners: Iterable[object]) -> None:
    """Give dataclasses and functions, of anything that a package exports, signatures and errors for people."""
    for each in owners:
        if inspect.isfunction(each) or (inspect.isclass(each) and dataclasses.is_dataclass(each)):
            readable(each)


def readable(owner: _T) -> _T:
    """Decorator: `help` and `inspect.signature` show names of types, without their modules and checks.

    A type that its module gives a name, as `Indenter`, is shown by that name. A dataclass that pydantic checks
    raises InvalidInput, a line a mistake.
    """
    found, names = inspect.signature(owner), {**kinds(), **_annotated(vars(sys.modules[owner.__module__]))}
    parameters = [
        each.replace(annotation=_shown(each.annotation, names), default=_brief(each.default))
        for each in found.parameters.values()
    ]
    shown = found.replace(parameters=parameters, return_annotation=_shown(found.return_annotation, names))
    if inspect.isclass(owner) and is_pydantic_dataclass(owner):
        setattr(owner, "__init__", _in_lines(owner))  # noqa: B010 - mypy knows no method that is assigned
    owner.__signature__ = shown  # type: ignore[attr-defined]
    return owner


def _in_lines(cls):
    """The constructor of a dataclass, which raises InvalidInput in place of ValidationError."""
    checked = cls.__init__
    names = [each.name for each in dataclasses.fields(cls) if each.init and not each.kw_only]

    @wraps(checked)
    def constructed(self, *args, **kwargs):
        stated = {**dict(zip(names, args, strict=False)), **kwargs}
        if len(stated) < len(args) + len(kwargs):
            few = f"{len(args)} values without a name: {len(names)} at most, others by name, each once"
            raise invalid(cls.__name__, [few])
        try:
            checked(self, **stated)
        except ValidationError as error:
            raise invalid(cls.__name__, error_text(error, stated, validator(cls))) from None

    return constructed


@cache
def kinds() -> dict[str, Any]:
    """The annotated numbers that `quantities` declares, by name."""
    return _annotated(vars(quantities))


def words(annotation: Any, names: Mapping[str, Any]) -> str:
    """An annotation as it reads in the source.

    names : annotated types, by name: what narrows one further is shown by that name too
    """
    origin, arguments = typing.get_origin(annotation), typing.get_args(annotation)
    if isinstance(annotation, str):
        return annotation
    if origin is typing.Annotated:
        return _named(annotation, names) or words(arguments[0], names)
    if origin in (typing.Union, types.UnionType):
        return " | ".join(words(each, names) for each in arguments)
    if origin is tuple:
        return f"tuple[{', '.join('...' if each is ... else words(each, names) for each in arguments)}]"
    if annotation is type(None):
        return "None"
    return re.sub(r"\b(?:\w+\.)+(\w+)", r"\1", inspect.formatannotation(annotation))


def _annotated(names):
    """The annotated types of a module, by name."""
    return {
        name: each
        for name, each in names.items()
        if not name.startswith("_") and typing.get_origin(each) is typing.Annotated
    }


def _named(annotation, names):
    """Name of what an annotation is, or narrows further; None of anything else."""
    stated = annotation.__metadata__
    fitting = {
        name: alias.__metadata__
        for name, alias in names.items()
        if alias.__origin__ == annotation.__origin__ and stated[: len(alias.__metadata__)] == alias.__metadata__
    }
    return max(fitting, key=lambda name: len(fitting[name]), default=None)


def _shown(annotation, names):
    return annotation if annotation in (inspect.Parameter.empty, None) else _Words(words(annotation, names))


def _brief(default):
    """A default of many fields by its class alone."""
    return _Words(f"{type(default).__name__}(...)") if dataclasses.is_dataclass(default) else default
