"""Content of docstrings: their first paragraph, and the lines "name : text" about fields and arguments."""

import re
from collections.abc import Iterator
from inspect import cleandoc

_FIELD = re.compile(r"([a-z_0-9]+(?:, [a-z_0-9]+)*) : (.+)")


def documented(docstring: str | None) -> tuple[str, dict[str, str]]:
    """First paragraph of a docstring, and what it says of each field in lines of the form "name : text"."""
    paragraphs = re.split(r"\n\s*\n", cleandoc(docstring or ""))
    return " ".join(paragraphs[0].split()), dict(_fields(cleandoc(docstring or "").splitlines()))


def _fields(lines) -> Iterator[tuple[str, str]]:
    entries = []
    for line in lines:
        if found := _FIELD.fullmatch(line):
            entries.append([found[1], found[2]])
        elif entries and line.startswith("    "):
            entries[-1][1] += " " + line.strip()
        else:
            entries.append(["", ""])
    for names, text in entries:
        for name in filter(None, names.split(", ")):
            yield name, text
