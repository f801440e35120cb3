"""Docstrings of this project as reStructuredText, and signatures that name the kinds of number.

A docstring is plain text. A line `name : text [unit]`, with its indented continuations, states a field or an
argument, and becomes an entry of a list; of several on one line, separated by semicolons, each does. Stars, bars
and underscores are themselves. What stands in single backticks is a name.
"""

import dataclasses
import inspect
import re
import types
import typing

from kinds import named

_NAME = r"[A-Za-z_]\w*"
_FIELD = re.compile(rf"^({_NAME}(?:, {_NAME})*) : (.*)$")
_ANOTHER = re.compile(rf"; (?={_NAME}(?:, {_NAME})* : )")
_QUOTED = re.compile(r"(`[^`\n]+`)")


def escaped(text: str) -> str:
    """Text whose stars, bars, backslashes and trailing underscores are not markup; names in backticks stay."""
    parts = _QUOTED.split(text)
    parts[::2] = [re.sub(r"([\\*|]|_(?=\W|$)|`)", r"\\\1", part) for part in parts[::2]]
    return "".join(parts)


def listed(lines: list[str]) -> list[str]:
    """The lines of a docstring, its fields as a definition list."""
    found, in_fields, in_session = [], False, False
    for line in lines:
        in_session = line.startswith(">>>") or (in_session and bool(line.strip()))
        if in_session:
            found.append(line)
            continue
        stated = [_FIELD.match(part) for part in _ANOTHER.split(line)]
        if all(stated):
            if not in_fields and found and found[-1]:
                found.append("")
            for name, text in (match.groups() for match in stated):
                names = ", ".join(f"``{one}``" for one in name.split(", "))
                found += [names, f"    {escaped(text)}"]
            in_fields = True
            continue
        if in_fields and line and not line.startswith(" "):
            found.append("")
        in_fields = in_fields and (not line or line.startswith(" "))
        found.append(escaped(line))
    return found


def kind(annotation) -> str:
    """An annotation as it reads in the source: the name of a kind of number for what that stands for."""
    name = named(annotation)
    if name:
        return name
    origin, arguments = typing.get_origin(annotation), typing.get_args(annotation)
    if origin is typing.Annotated:
        return kind(arguments[0])
    if origin in (typing.Union, types.UnionType):
        return " | ".join(kind(each) for each in arguments)
    if origin is typing.Literal:
        return " | ".join(repr(each) for each in arguments)
    if origin is tuple:
        return f"tuple[{', '.join('...' if each is ... else kind(each) for each in arguments)}]"
    if annotation is type(None):
        return "None"
    if inspect.isclass(annotation) and not arguments and annotation.__module__ != "builtins":
        return f"~{annotation.__module__}.{annotation.__name__}"  # packages share names; the name alone is shown
    return inspect.formatannotation(annotation).rsplit(".", 1)[-1] if not arguments else _generic(annotation)


def _generic(annotation) -> str:
    return re.sub(r"\b(?:\w+\.)+(\w+)", r"\1", inspect.formatannotation(annotation))


def signature(owner) -> str | None:
    """Arguments of a dataclass in the words of its fields; None where it has none of its own to show.

    A field `type` of one value only tells tables of a file apart and is left out.
    """
    if not (inspect.isclass(owner) and dataclasses.is_dataclass(owner)):
        return None
    shown, by_name = [], False
    for field in dataclasses.fields(owner):
        if not field.init or field.name == "type":
            continue
        if field.kw_only and not by_name:
            shown.append("*")
            by_name = True
        default = _default(field)
        spaced = f": {kind(field.type)}" if not isinstance(field.type, str) else f": {field.type}"
        shown.append(f"{field.name}{spaced}" + (f" = {default}" if default else ""))
    return f"({', '.join(shown)})"


def _default(field) -> str:
    value = field.default
    if hasattr(value, "get_default"):
        value = value.get_default(call_default_factory=True)
        if type(value).__name__ == "PydanticUndefinedType":
            return ""
    if value is dataclasses.MISSING:
        return "..." if field.default_factory is not dataclasses.MISSING else ""
    return repr(value)


def _process_docstring(app, what, name, owner, options, lines):
    lines[:] = listed(lines)


def _process_signature(app, what, name, owner, options, given, returned):
    found = signature(owner) if what == "class" else None
    return None if found is None else (found, None)


def setup(app):
    app.connect("autodoc-process-docstring", _process_docstring)
    app.connect("autodoc-process-signature", _process_signature)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
