"""Scenes and studies to begin with, which come with the package: what there is, and a copy of one of them."""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from textwrap import wrap
from typing import Any

from ..solving.suggest import known, suggestion

_TITLE = re.compile(r'^title = "(.+)"$', re.MULTILINE)
_END = "\n#\n"  # of what a file is about, in the comment with which it begins
_ALONE = "from Python"  # how it is solved, in the same comment of a scene that cannot be compared
WIDTH = 100
FOLDERS = {"scene": "scenes", "study": "studies"}  # by kind
# Headings of scenes by the command that takes them, and of studies.
SCENES = {
    "run": "Scenes: crosscheck run NAME",
    "plan": "Scenes that crosscheck run does not compare: crosscheck plan NAME",
}
STUDIES = "Studies: crosscheck study NAME"
ALL = "`crosscheck study all` does the first six of them."
NEW = "`crosscheck new NAME` copies a scene, or a study that is a file, for you to change."


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


@dataclass(frozen=True)
class About:
    """Title of a study, and what it is about, for people."""

    title: str
    about: str


# Studies that are no files. Their texts stand here, as those who list them import no solver.
CATALOGUE = {
    "collapse": About(
        "Does friction collapse on one curve?",
        "Eq. 23 for the rough sphere and the rough cone of Fig. 1 on a Kelvin solid, across the knee of the "
        "curve, at prescribed load and at prescribed depth.",
    ),
    "solids": About(
        "Do other solids collapse on one curve too?",
        "Eq. 23 for the rough sphere and the rough cone of Fig. 1 at prescribed load, on a standard linear solid, "
        "E_g = 10 E_r, and on a solid whose loss grows as the root of the frequency.",
    ),
    "hurst": About(
        "Hurst exponents from 0.1 to 0.9",
        "Eq. 23 for rough spheres and cones on a Kelvin solid at prescribed load, of several Hurst exponents, "
        "with the same rms height and the same waves.",
    ),
    "parameters": About(
        "One parameter at a time",
        "Eq. 23 for rough spheres and cones on a Kelvin solid at prescribed load, with another rms height, "
        "another shortest wave, another relaxation time.",
    ),
    "regime": About(
        "The regime of the paper",
        "Roughness that is small against the depth and steep against the body, which in three dimensions takes "
        "waves far shorter than the contact: a spectrum rolled off at a q_r of 20 or more.",
    ),
    "depth": About(
        "Force and depth",
        "The rough sphere and the rough cone of Fig. 1, pressed in to rest, and at constant rates on a standard "
        "linear solid.",
    ),
}


class Listing(dict[str, Any]):
    """All that can be named, each with its title and subject; printed, a table of names and titles.

    offered : by name; groups : headings with the names below each, all names under none if absent
    end : last line
    """

    def __init__(
        self, offered: Mapping[str, Any], groups: Mapping[str, Sequence[str]] | None = None, end: str = ""
    ) -> None:
        super().__init__(offered)
        self.groups, self.end = groups or {"": list(offered)}, end

    def __str__(self) -> str:
        return self._table(lambda name, width: [])

    @property
    def details(self) -> str:
        """The table with what each is about: what the command prints under -v."""
        return self._table(lambda name, width: wrap(self[name].about, WIDTH - width, break_on_hyphens=False))

    def _table(self, below: Callable[[str, int], list[str]]) -> str:
        width = max((len(name) for name in self), default=0) + 2
        lines = []
        for heading, names in self.groups.items():
            lines += [heading] if heading else []
            lines += [f"{'Name':{width}s}Title", "-" * (width + max(len(self[name].title) for name in names))]
            for name in names:
                lines += [f"{name:{width}s}{self[name].title}"]
                lines += [" " * width + line for line in below(name, width)]
            lines.append("")
        return "\n".join([*lines, self.end]).strip("\n")

    __repr__ = __str__


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
    """Every study that comes with the package: those of the paper's claims, then those of files."""
    found = CATALOGUE | {name: each for name, each in ready().items() if each.kind == "study"}
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
    """Content of a name. Raises NotReady."""
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
