"""What is asked: scenes by path, by name or as objects, and folders that can be written into."""

import errno
import os
import tempfile
from collections.abc import Iterable, Mapping
from dataclasses import fields
from importlib.resources import files
from pathlib import Path
from typing import TypeAlias

from pydantic import ValidationError

from scene import Scene, SolveError
from scene.reading import InvalidInput, parsed, read, text_of

from .cases import Case, read_case, shipped_cases
from .suggest import suggestion

ASKS = {"scene": "run", "study": "study"}  # which command takes a file of which kind
# A file, the name of a ready scene, or what it says.
Asked: TypeAlias = str | Path | Case | Scene


def named_cases(asked: Asked | Mapping[str, Asked] | None = None) -> dict[str, Case]:
    """Cases by name: one, several by their names, or the paper's sphere and cone where nothing is asked.

    Raises InvalidInput, Refused: nothing is solved of a case that cannot be compared.
    """
    from .study import points  # a plan does without

    try:
        cases = _cases(asked)
        for case in cases.values():
            points(case)
    except (ArithmeticError, SolveError, ValidationError) as error:
        # The file is valid; what follows from it is not.
        raise InvalidInput(f"{asked}: its numbers are so far apart that the contact leaves their range") from error
    return cases


def case_of(asked: Asked) -> Case:
    """One case, whether or not both solvers can solve it. Raises InvalidInput."""
    if isinstance(asked, Case):
        return asked
    if isinstance(asked, Scene):
        return Case(**{each.name: getattr(asked, each.name) for each in fields(Scene)})
    return read(located(asked), Case)


def located(asked: str | Path, kind: str = "scene") -> Path:
    """A file as it stands, or the ready scene or study of that name. Raises InvalidInput with a suggestion."""
    from .library import FOLDERS, ready

    path = Path(asked)
    if path.is_dir():
        raise InvalidInput(f"{asked}: is a folder, and no {kind}")
    if path.exists():
        if (other := _other_kind(path, kind)) is not None:
            raise InvalidInput(f"{asked}: is a {other}, and no {kind}: crosscheck {ASKS[other]} {asked}")
        return path
    every = ready()
    known = [name for name, each in every.items() if each.kind == kind]
    if str(asked) in known:
        return Path(str(files("compare"))) / FOLDERS[kind] / f"{asked}.toml"
    if str(asked) in every:
        found = every[str(asked)]
        raise InvalidInput(f"{asked}: is a ready {found.kind}, and no {kind}: crosscheck {found.command} {asked}")
    beside = (
        [str(path.with_name(each.name)) for each in path.parent.glob("*.toml")] if path.parent.is_dir() else []
    )
    raise InvalidInput(f"{asked}: no such file, and no ready {kind}{suggestion(str(asked), [*known, *beside])}")


def _other_kind(path: Path, kind: str) -> str | None:
    """What a file is if it is not of this kind: a study has series, a scene its motion; None if that is open."""
    try:
        tables = parsed(text_of(path), path)
    except InvalidInput:
        return None  # whoever reads it says what is wrong
    has = {"scene": "motion" in tables, "study": "series" in tables}
    other = "study" if kind == "scene" else "scene"
    return other if has[other] and not has[kind] else None


def make_folders(folder: Path, names: Iterable[str] = (), written: Iterable[str] = ()) -> None:
    """Make every folder that is going to be written into. Raises OSError, before anything is solved.

    names : of folders below it; written : files that will be written into it, and are no folders
    """
    for below in (folder, *(folder / name for name in names)):
        if below.exists() and not below.is_dir():
            raise NotADirectoryError(errno.ENOTDIR, "is a file, and no folder", str(below))
        below.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=below):
            pass
    for path in (folder / name for name in written):
        if path.is_dir():
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))


def _cases(asked):
    if asked is None:
        return shipped_cases()
    if isinstance(asked, Mapping):
        cases = {name: case_of(each) for name, each in asked.items()}
    elif isinstance(asked, Case | Scene):
        cases = {"scene": case_of(asked)}
    else:
        path = located(asked)
        return {path.stem: read_case(path)}
    for case in cases.values():
        case.refuse()
    return cases
