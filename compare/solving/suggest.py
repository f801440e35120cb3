"""Names that are given and names that are known, and arguments of a type that no function takes."""

from collections.abc import Callable, Collection, Mapping
from functools import wraps
from inspect import signature
from typing import Any, Literal, ParamSpec, TypeVar, get_args, get_origin

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


def checked(function: Callable[_P, _T]) -> Callable[_P, _T]:
    """Decorator that refuses arguments of a wrong type before the function begins.

    Texts, paths, names and truths are checked by their annotations, and None where nothing may be absent. Numbers,
    scenes and models are checked where they are read. Raises InvalidInput.
    """
    stated = {name: each.annotation for name, each in signature(function).parameters.items()}

    @wraps(function)
    def called(*args: _P.args, **given: _P.kwargs) -> _T:
        for name, value in [*zip(stated, args, strict=False), *given.items()]:
            if name in stated:
                _check(name, value, stated[name].split(" | "), function.__globals__)
        return function(*args, **given)

    return called


def _check(name: str, value: Any, kinds: Collection[str], names: Mapping[str, Any]) -> None:
    """Raise InvalidInput where a value is of none of these types; one that is not checked takes all but None."""
    allowed = [_allowed(kind, names) for kind in kinds]
    absent = value is None and "None" not in kinds
    if absent or all(words and not fits(value) for words, fits in allowed):
        from scene.printable import brief  # slow, and only a mistake needs it
        from scene.reading import InvalidInput

        words = " or ".join(dict.fromkeys(words for words, _ in allowed if words)) or "a value"
        raise InvalidInput(f"{name} = {brief(repr(value))}: {words} is needed")


def _allowed(kind: str, names: Mapping[str, Any]) -> tuple[str, Callable[[Any], bool]]:
    """What a type is in words, empty of one that is not checked, and whether a value is of it."""
    alias = names.get(kind)
    if kind == "None":
        return "None", lambda value: value is None
    if kind == "bool":
        return "True or False", lambda value: type(value).__name__ in ("bool", "bool_")
    if kind in ("Path", "PathLike"):
        return "a path", lambda value: hasattr(value, "__fspath__")
    named = any(get_origin(each) is Literal for each in (alias, *get_args(alias)))
    if kind == "str" or kind.startswith("Literal[") or named:
        return "a text", lambda value: isinstance(value, str)
    return "", lambda value: True
