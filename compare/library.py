"""Scenes and studies to begin with, which come with the package: what there is, and a copy of one of them."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from textwrap import wrap
from typing import Any

from .suggest import known, suggestion

_TITLE = re.compile(r'^title = "(.+)"$', re.MULTILINE)
_END = "\n#\n"  # of what a file is about, in the comment with which it begins
_ALONE = "from Python"  # how it is solved, in the same comment of a scene that cannot be compared
FOLDERS = {"scene": "scenes", "study": "ownstudies"}  # by kind


class NotReady(LookupError):
    """No scene or study of that name comes with the package; the message says which do."""

    def __str__(self) -> str:
        return str(self.args[0])


@dataclass(frozen=True)
class Ready:
    """A file to begin with.

    name : of the file, without .toml
    title, about : for people; what it is about stands in its first lines; a scene alone, which
        has no title, has its first words
    kind : "scene" or "study"
    command : of `crosscheck`, by which it is asked: run, study, or plan of a scene that cannot be compared
    text : the file
    """

    name: str
    title: str
    about: str
    kind: str
    command: str
    text: str


class Listing(dict[str, Any]):
    """What can be named, each with a title and what it is about; printed, a list for people.

    offered : by name; groups : headings with the names below each, all names under none if absent
    end : last line
    """

    def __init__(
        self, offered: Mapping[str, Any], groups: Mapping[str, Sequence[str]] | None = None, end: str = ""
    ) -> None:
        super().__init__(offered)
        self.groups, self.end = groups or {"": list(offered)}, end

    def __str__(self) -> str:
        width = max((len(name) for name in self), default=0) + 2
        lines = []
        for heading, names in self.groups.items():
            lines += [f"{heading}:", ""] if heading else []
            for name in names:
                lines.append(f"{name:{width}s}{self[name].title}")
                lines += wrap(self[name].about, 79, initial_indent=width * " ", subsequent_indent=width * " ")
            lines.append("")
        return "\n".join([*lines, self.end]).strip("\n")

    __repr__ = __str__


def ready() -> Listing:
    """Scenes and studies that come with the package: scenes, then studies, by name. Nothing is imported for it."""
    found = {}
    for kind, folder in FOLDERS.items():
        paths = [path for path in (files("compare") / folder).iterdir() if path.name.endswith(".toml")]
        for path in sorted(paths, key=lambda path: path.name):
            each = _ready(kind, path.name.removesuffix(".toml"), path.read_text(encoding="utf-8"))
            found[each.name] = each
    groups = {
        f"{what}, crosscheck {command} NAME": [name for name, each in found.items() if each.command == command]
        for command, what in (("run", "Scenes"), ("plan", "Scenes that nothing compares"), ("study", "Studies"))
    }
    return Listing(found, groups, "`crosscheck new NAME` writes one into a file of your own.")


def find(name: str) -> Ready:
    """That of a name. Raises NotReady."""
    every = ready()
    if name not in every:
        from scene.printable import brief  # slow, and only a mistake needs it

        meant = suggestion(name, every) or "."
        raise NotReady(f"no scene or study is called {brief(repr(name))}{meant} There are {', '.join(every)}")
    return every[name]


def write(name: str, path: str | Path, schema: str | Path | None = None) -> Path:
    """Write a copy of one of them, never over a file that is there, and return its path.

    schema : of a JSON schema, by which editors check and complete: named in the first line. Absent, none is

    Raises InvalidInput for another name or a file that is there, OSError where it cannot be written.
    """
    known("NAME", name, ready())
    text, path = find(name).text, Path(path)
    try:
        with path.open("x", encoding="utf-8", newline="\n") as file:
            file.write((f"#:schema {schema}\n" if schema is not None else "") + text)
    except FileExistsError as error:
        from scene.printable import brief  # slow, and only a mistake needs it
        from scene.reading import InvalidInput

        raise InvalidInput(
            f"{brief(str(path))}: is there already, and nothing is overwritten: name another FILE"
        ) from error
    return path


def _ready(kind, name, text):
    comment = text.partition("\n\n")[0]
    about = " ".join(line.removeprefix("# ") for line in comment.partition(_END)[0].splitlines())
    title = _TITLE.search(text)
    command = "study" if kind == "study" else "plan" if _ALONE in comment else "run"
    return Ready(name, title[1] if title else re.split("[.:]", about)[0], about, kind, command, text)
