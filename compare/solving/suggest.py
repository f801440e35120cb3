"""Names that are given and names that are known, and arguments of a type that no function takes."""

import re
from collections.abc import Callable, Collection, Iterator, Mapping
from functools import wraps
from inspect import cleandoc, signature
from pathlib import Path
from textwrap import fill
from types import NoneType, UnionType
from typing import Any, Literal, ParamSpec, TypeVar, Union, get_args, get_origin

_P = ParamSpec("_P")
_T = TypeVar("_T")

TEXT = object()  # marks an argument that is a text in Python too
LONGEST = 100  # letters of a name that are compared


def suggestion(given: str, names: Collection[str]) -> str:
    """Known name that looks much like the given one, as the end of a sentence; empty if nothing does."""
    from difflib import get_close_matches

    close = get_close_matches(given[:LONGEST], names, n=1)
    return f"; did you mean {close[0]}?" if close else ""


def known(option: str, given: str, names: Collection[str], otherwise: str = "") -> None:
    """Raise InvalidInput where something is given that is not known."""
    if given not in names:
        near = suggestion(given, list(names)) or (otherwise and f"; {otherwise}")
        raise _mistake(option, given, f"allowed are {', '.join(names)}{near}")


def _mistake(name: str, given: str, allowed: str) -> ValueError:
    from scene.files.reading import InvalidInput
    from scene.printable import brief

    return InvalidInput(f"{name} = {brief(given)}: {allowed}")


class _Name(str):
    """Name of a type, which a signature shows without quotes."""

    __repr__ = str.__str__


def checked(function: Callable[_P, _T]) -> Callable[_P, _T]:
    """Decorator: arguments of a wrong type are refused, and the docstring says what each argument is.

    It checks that each argument is known, and the type of each whose annotation is a name of `compare.options`:
    paths, texts, named values, truths and None. Numbers, scenes and models are checked where they are read. Raises
    InvalidInput. The docstring gets the texts of these options, except for arguments that it has a line on.
    """
    found = signature(function)
    stated = {name: _Name(each.annotation) for name, each in found.parameters.items()}
    hints = {name: get_args(function.__globals__.get(each)) for name, each in stated.items()}
    options = function.__globals__["Options"].__annotations__ if "options" in stated else {}

    @wraps(function)
    def called(*args: _P.args, **given: _P.kwargs) -> _T:
        for name in given if "given" not in stated else ():
            known(f"argument of {function.__name__}", name, [*filter("options".__ne__, stated), *options])
        for name, value in [*zip(stated, args, strict=False), *given.items()]:
            if hint := hints.get(name):
                _check(name, value, *hint)
        return function(*args, **given)

    shown = [each.replace(annotation=stated[name]) for name, each in found.parameters.items()]
    returned = _Name(found.return_annotation)
    called.__signature__ = found.replace(parameters=shown, return_annotation=returned)  # type: ignore[attr-defined]
    if about := cleandoc(function.__doc__ or ""):
        called.__doc__ = "\n".join([about, *_texts(about, hints)])
    return called


def _texts(about: str, hints: Mapping[str, tuple[Any, ...]]) -> Iterator[str]:
    """Lines "name : text" on the arguments of a function that its docstring has none on."""
    own = re.findall(r"^(\w+) : ", about, re.MULTILINE)
    if not own:
        yield ""
    for name in (each for each in hints if hints[each] and each not in own):
        kind, option, *more = hints[name]
        words = [option.help, *(each for each in more if each is not TEXT)]
        allowed = [value for each in _kinds(kind) if get_origin(each) is Literal for value in get_args(each)]
        if not all(each in option.help for each in allowed):
            words.append(f"One of {', '.join(allowed)}.")
        yield fill(f"{name} : {' '.join(words)}", 110, subsequent_indent="    ", break_on_hyphens=False)


def _kinds(hint: Any) -> tuple[Any, ...]:
    return get_args(hint) if get_origin(hint) in (Union, UnionType) else (hint,)


def _check(name: str, value: Any, hint: Any, *marks: Any) -> None:
    """Raise InvalidInput where a value is not of the type that is stated of it; marks : TEXT of a plain text."""
    kinds = _kinds(hint)
    if value is None:
        fits, words = NoneType in kinds, "a value"
    elif bool in kinds:
        fits, words = type(value).__name__ in ("bool", "bool_"), "True or False"
    elif Path in kinds:
        fits, words = isinstance(value, str) or hasattr(value, "__fspath__"), "a path or a text"
    else:
        text = TEXT in marks or any(get_origin(each) is Literal for each in kinds)
        fits, words = not text or isinstance(value, str), "a text"
    if not fits:
        raise _mistake(name, repr(value), f"{words} is needed")
