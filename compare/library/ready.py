"""Scenes and studies that come with the package: a list of them, and copies of them as files."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any

from ..solving.suggest import known

_STATED = re.compile(r'^(title|about) = "(.+)"$', re.MULTILINE)
_END = "\n#\n"  # of what a file is about, in the comment with which it begins
_ALONE = "from Python"  # how it is solved, in the same comment of a scene that cannot be compared
FOLDERS = {"scene": "scenes", "study": "studies"}  # by kind
# Headings of scenes by the command that takes them, and of studies.
SCENES = {
    "run": "Scenes: crosscheck run NAME",
    "plan": "Scenes that crosscheck run does not compare: crosscheck plan NAME",
}
STUDIES = "Studies: crosscheck study NAME"
ALL = "`crosscheck study all` does the first six of them."
NEW = "`crosscheck new NAME` copies a scene or a study, for you to change."
# Studies of the paper's claims, which `crosscheck study all` does.
CLAIMS = "collapse", "solids", "hurst", "parameters", "regime", "depth"


@dataclass(frozen=True)
class Ready:
    """A file to begin with.

    name : of the file, without .toml
    title, about : for people; of a scene what stands in its first lines, and where it has no title their first
        words
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
    """All that can be named, each with its title and subject; printed, a table of names and titles.

    offered : by name; groups : headings with the names below each; end : last line
    """

    def __init__(self, offered: Mapping[str, Any], groups: Mapping[str, Sequence[str]], end: str) -> None:
        super().__init__(offered)
        self.groups, self.end = groups, end

    def __str__(self) -> str:
        width = max(map(len, self), default=0) + 2
        lines = []
        for heading, names in self.groups.items():
            lines.append(heading)
            lines += [f"{'Name':{width}s}Title", "-" * (width + max(len(self[name].title) for name in names))]
            for name in names:
                lines.append(f"{name:{width}s}{self[name].title}")
            lines.append("")
        return "\n".join([*lines, self.end]).strip("\n")

    __repr__ = __str__


@cache
def ready() -> dict[str, Ready]:
    """Scenes and studies that come as files: scenes, then studies, by name. Nothing is imported for it."""
    found = {}
    for kind, folder in FOLDERS.items():
        paths = [path for path in (files("compare.library") / folder).iterdir() if path.name.endswith(".toml")]
        for path in sorted(paths, key=lambda path: path.name):
            each = _ready(kind, path.name.removesuffix(".toml"), path.read_text(encoding="utf-8"))
            found[each.name] = each
    return found


def studies() -> Listing:
    """Every study that comes with the package: first those of the paper's claims."""
    every = {name: each for name, each in ready().items() if each.kind == "study"}
    found = {name: every[name] for name in CLAIMS} | every
    return Listing(found, {STUDIES: list(found)}, ALL)


def offered() -> Listing:
    """Every scene and every study that comes with the package."""
    scenes = {name: each for name, each in ready().items() if each.kind == "scene"}
    groups: dict[str, Sequence[str]] = {
        heading: [name for name, each in scenes.items() if each.command == command]
        for command, heading in SCENES.items()
    }
    asked = studies()
    return Listing(scenes | asked, groups | dict(asked.groups), NEW)


def find(name: str) -> Ready:
    """Scene or study of a name. Raises InvalidInput."""
    known("NAME", name, ready())
    return ready()[name]


def write(name: str, path: str | Path) -> Path:
    """Write a copy of a ready scene or study to a path where there is no file yet, and return the path.

    Raises InvalidInput for another name or a file that is there, OSError where it cannot be written.
    """
    text, path = find(name).text, Path(path)
    try:
        with path.open("x", encoding="utf-8", newline="\n") as file:
            file.write(text)
    except FileExistsError as error:
        from scene.files.reading import InvalidInput
        from scene.printable import brief

        raise InvalidInput(
            f"{brief(str(path))}: is there already, and nothing is overwritten: name another FILE"
        ) from error
    return path


def _ready(kind, name, text):
    comment = text.partition("\n\n")[0]
    words = " ".join(line.removeprefix("# ") for line in comment.partition(_END)[0].splitlines())
    command = "study" if kind == "study" else "plan" if _ALONE in comment else "run"
    stated = dict(_STATED.findall(text.partition("\n[")[0]))
    title = stated.get("title", re.split("[.:]", words)[0])
    return Ready(name, title, stated.get("about", words), kind, command, text)
