"""Docstrings of this project as reStructuredText, and the signatures that are shown in Python.

A docstring is plain text. A line `name : text [unit]`, with its indented continuations, states a field or an
argument, and becomes an entry of a list; of several on one line, separated by semicolons, each does. Stars, bars
and underscores are themselves. What stands in single backticks is a name.
"""

import inspect
import re

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


def signature(owner) -> str | None:
    """Arguments of a class or function whose package makes them readable; None of any other.

    A field `type` of one value only tells tables of a file apart and is left out.
    """
    if not isinstance(getattr(owner, "__signature__", None), inspect.Signature):
        return None
    found = owner.__signature__
    kept = [each for each in found.parameters.values() if each.name != "type"]
    return str(found.replace(parameters=kept, return_annotation=inspect.Signature.empty)).replace(
        "<factory>", "..."
    )


def _process_docstring(app, what, name, owner, options, lines):
    lines[:] = listed(lines)


def _process_signature(app, what, name, owner, options, given, returned):
    # Sphinx links the types of a function: it is left as it is, unless they spell out checks.
    if what == "class" or "Annotated[" in (given or ""):
        found = signature(owner)
        return None if found is None else (found, None if what == "class" else returned)
    return None


def setup(app):
    app.connect("autodoc-process-docstring", _process_docstring)
    app.connect("autodoc-process-signature", _process_signature)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
