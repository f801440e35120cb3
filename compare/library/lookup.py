"""Scenes that a user gives: by path, by the name of a ready one, or as objects."""

from collections.abc import Mapping, Sequence
from dataclasses import fields
from importlib import resources
from os import PathLike
from os.path import isdir, isfile
from pathlib import Path
from typing import Any, TypeAlias

from scene import Scene
from scene.files.files import Unreadable, checked
from scene.files.reading import MOST, InvalidInput, read
from scene.printable import brief, printable

from ..solving.suggest import suggestion
from .case import Case
from .ready import FOLDERS, ready

PAPER = "paper-sphere", "paper-cone"
# A scene as a file, as the name of a ready one, or as an object.
SceneLike: TypeAlias = str | Path | Case | Scene
SeveralScenes: TypeAlias = SceneLike | Sequence[str | Path] | Mapping[str, SceneLike]


def named_cases(asked: SeveralScenes | None = None) -> dict[str, Case]:
    """Cases by name: one, several by their names or those of their files, or the paper's sphere and cone of none.

    Raises InvalidInput.
    """
    if asked is None or isinstance(asked, str | Path | Sequence):
        several: dict[str, Any] = {}
        files = [asked] if isinstance(asked, str | Path) else asked or PAPER
        for path in map(located, files):
            if (other := several.setdefault(printable(path.stem), path)) is not path:
                raise InvalidInput(
                    f"scene = {brief(str(other))}, {brief(str(path))}: both are called {brief(path.stem)}, which "
                    "their results are named by: rename one, or from Python give names, run({name: file})"
                )
    else:
        several = dict(asked) if isinstance(asked, Mapping) else {"scene": asked}
    return {name: case_of(each) for name, each in several.items()}


def case_of(asked: SceneLike) -> Case:
    """One case, whether or not both solvers can solve it. Raises InvalidInput."""
    if isinstance(asked, Case):
        return asked
    if isinstance(asked, Scene):
        return Case(**{each.name: getattr(asked, each.name) for each in fields(Scene)})
    return read(located(asked), Case)


def located(asked: str | Path, kind: str = "scene") -> Path:
    """A file as it stands, or the ready scene or study of that name. Raises InvalidInput with a suggestion."""
    if not isinstance(asked, str | PathLike):
        others = ", a Scene or a Case" if kind == "scene" else ""
        raise InvalidInput(f"{kind} = {brief(repr(asked))}: a file, the name of a ready {kind}{others} is needed")
    path, every, name = Path(asked), ready(), str(asked)
    # Only a file hides a ready one: a folder of this name may be left by an earlier run.
    if (found := every.get(name)) and not isfile(path):
        if found.kind != kind:
            raise InvalidInput(
                f"{name}: is a ready {found.kind}, and no {kind}: crosscheck {found.command} {name}"
            )
        return Path(str(resources.files("compare.library"))) / FOLDERS[kind] / f"{name}.toml"
    try:
        checked(path, MOST)
    except Unreadable as error:
        known = [each.name for each in every.values() if each.kind == kind]
        neighbours = [str(each) for each in path.parent.glob("*.toml")] if isdir(path.parent) else []
        raise InvalidInput(f"{error}, and no ready {kind}{suggestion(name, [*known, *neighbours])}") from error
    return path
