"""Names that are given and names that are known, and arguments of a type that no function takes."""

from collections.abc import Callable, Collection
from functools import wraps
from inspect import signature
from pathlib import Path
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, ParamSpec, TypeVar, Union, get_args, get_origin

_P = ParamSpec("_P")
_T = TypeVar("_T")

LONGEST = 100  # letters of a name that are compared


def suggestion(given: str, names: Collection[str]) -> str:
    """Known name that looks much like the given one, as the end of a sentence; empty if nothing does."""
    from difflib import get_close_matches

    close = get_close_matches(given[:LONGEST], names, n=1)
    return f"; did you mean {close[0]}?" if close else ""


def known(option: str, given: str, names: Collection[str], otherwise: str = "") -> None:
    """Raise InvalidInput where something is given that is not known."""
    if given not in names:
        from scene.printable import brief  # slow, and only a mistake needs it
        from scene.reading import InvalidInput

        near = suggestion(given, list(names)) or (otherwise and f"; {otherwise}")
        raise InvalidInput(f"{option} = {brief(given)}: allowed are {', '.join(names)}{near}")


class _Name(str):
    """Name of a type, which a signature shows without quotes."""

    __repr__ = str.__str__


def checked(function: Callable[_P, _T]) -> Callable[_P, _T]:
    """Decorator that refuses arguments of a wrong type before the function begins.

    It checks each argument whose annotation is a name of `compare.options`: paths, texts, named values, truths and
    None. Numbers, scenes and models are checked where they are read. Raises InvalidInput.
    """
    found = signature(function)
    stated = {name: _Name(each.annotation) for name, each in found.parameters.items()}

    @wraps(function)
    def called(*args: _P.args, **given: _P.kwargs) -> _T:
        for name, value in [*zip(stated, args, strict=False), *given.items()]:
            hint = function.__globals__.get(stated.get(name, ""))
            if get_origin(hint) is Annotated:
                _check(name, value, *get_args(hint))
        return function(*args, **given)

    shown = [each.replace(annotation=stated[name]) for name, each in found.parameters.items()]
    returned = _Name(found.return_annotation)
    called.__signature__ = found.replace(parameters=shown, return_annotation=returned)  # type: ignore[attr-defined]
    return called


def _check(name: str, value: Any, hint: Any, *marks: Any) -> None:
    """Raise InvalidInput where a value is not of the type that is stated of it; marks : "text" of a plain text."""
    kinds = get_args(hint) if get_origin(hint) in (Union, UnionType) else (hint,)
    if value is None:
        words = "" if NoneType in kinds else "a value"
    elif bool in kinds:
        words = "" if type(value).__name__ in ("bool", "bool_") else "True or False"
    elif Path in kinds:
        words = "" if isinstance(value, str) or hasattr(value, "__fspath__") else "a path or a text"
    else:
        text = "text" in marks or any(get_origin(each) is Literal for each in kinds)
        words = "" if not text or isinstance(value, str) else "a text"
    if words:
        from scene.printable import brief  # slow, and only a mistake needs it
        from scene.reading import InvalidInput

        raise InvalidInput(f"{name} = {brief(repr(value))}: {words} is needed")
