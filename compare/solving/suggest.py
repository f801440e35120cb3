"""Names that are given and names that are known, and docstrings that say what each argument is."""

import re
from collections.abc import Callable, Collection, Iterator, Mapping
from functools import wraps
from inspect import cleandoc, signature
from textwrap import fill
from types import UnionType
from typing import Any, Literal, TypeVar, Union, get_args, get_origin

_T = TypeVar("_T", bound=Callable)

LONGEST = 100  # letters of a name that are compared


def suggestion(given: str, names: Collection[str]) -> str:
    """Known name that looks much like the given one, as the end of a sentence; empty if nothing does."""
    from difflib import get_close_matches

    close = get_close_matches(given[:LONGEST], names, n=1)
    return f"; did you mean {close[0]}?" if close else ""


def known(option: str, given: str, names: Collection[str], otherwise: str = "") -> None:
    """Raise InvalidInput where something is given that is not known."""
    if given not in names:
        from scene.files.reading import InvalidInput
        from scene.printable import brief

        near = suggestion(given, list(names)) or (otherwise and f"; {otherwise}")
        raise InvalidInput(f"{option} = {brief(given)}: allowed are {', '.join(names)}{near}")


class _Name(str):
    """Name of a type, which a signature shows without quotes."""

    __repr__ = str.__str__


def documented(function: _T) -> _T:
    """Decorator: the docstring says what each argument is whose annotation is a name of `compare.options`.

    Arguments that the docstring has a line on are left out. The signature names the types as the source does. An
    unknown argument raises InvalidInput with the one that was meant.
    """
    found = signature(function)
    names = {name: _Name(each.annotation) for name, each in found.parameters.items()}
    hints = {name: get_args(function.__globals__.get(each)) for name, each in names.items()}
    shown = [each.replace(annotation=names[name]) for name, each in found.parameters.items()]
    returned = _Name(found.return_annotation)
    options = function.__globals__["Options"].__annotations__ if "options" in names else {}

    @wraps(function)
    def called(*args, **given):
        for name in given if "given" not in names else ():
            known(f"argument of {function.__name__}", name, [*filter("options".__ne__, names), *options])
        return function(*args, **given)

    called.__signature__ = found.replace(parameters=shown, return_annotation=returned)  # type: ignore[attr-defined]
    about = cleandoc(function.__doc__ or "")
    called.__doc__ = "\n".join([about, *_texts(about, hints)])
    return called  # type: ignore[return-value]


def _texts(about: str, hints: Mapping[str, tuple[Any, ...]]) -> Iterator[str]:
    """Lines "name : text" on the arguments of a function that its docstring has none on."""
    own = re.findall(r"^(\w+) : ", about, re.MULTILINE)
    if not own:
        yield ""
    for name in (each for each in hints if hints[each] and each not in own):
        kind, option, *more = hints[name]
        words = [option.help, *more]
        kinds = get_args(kind) if get_origin(kind) in (Union, UnionType) else (kind,)
        allowed = [value for each in kinds if get_origin(each) is Literal for value in get_args(each)]
        if not all(each in option.help for each in allowed):
            words.append(f"One of {', '.join(allowed)}.")
        yield fill(f"{name} : {' '.join(words)}", 110, subsequent_indent="    ", break_on_hyphens=False)
