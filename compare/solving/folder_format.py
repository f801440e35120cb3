"""Format of the folders that commands write: it changes with the names of figures, columns and studies."""

from pathlib import Path
from typing import TypeVar

from pydantic import BaseModel, ValidationError

from scene.files import Unreadable, content
from scene.printable import brief
from scene.reading import InvalidInput

FORMAT = 2
UNSTATED = 1  # files of the first format do not state it
MANIFEST = "manifest.json"
MOST_BYTES = 2**30  # of a manifest, which has the heights of measured maps in it


class Stated(BaseModel):
    """Part of a manifest that all versions have, or leave out.

    format : of the folder
    finished : whether the run that writes the folder has come to its end
    results : digest of results.nc; empty where none is stated
    """

    format: int = UNSTATED
    finished: bool = True
    results: str = ""


Kind = TypeVar("Kind", bound=Stated)


def read(path: Path, kind: type[Kind]) -> Kind:
    """A manifest. Raises InvalidInput of one that is damaged, or of another version."""
    try:
        text = content(path, MOST_BYTES)
        refuse_other(path, Stated.model_validate_json(text).format)
        return kind.model_validate_json(text)
    except Unreadable as error:
        raise InvalidInput(str(error)) from error
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(map(str, first["loc"]))
        reason = f"{brief(where)}: {first['msg']}" if where else first["msg"]
    raise InvalidInput(f"{brief(str(path))}: was not written by this version of the command: {reason}")


def finished(path: Path, kind: type[Kind]) -> Kind:
    """The manifest of a run that has come to its end. Raises InvalidInput of another, and as `read`."""
    found = read(path, kind)
    if not found.finished:
        raise InvalidInput(
            f"{brief(str(path.parent))}: a run that writes this folder has not come to its end, or was killed: "
            "run the command again, which solves nothing twice"
        )
    return found


def refuse_other(path: Path, found: int) -> None:
    """Raise InvalidInput of a file in another format than this version writes."""
    if found != FORMAT:
        age = "an earlier" if found < FORMAT else "a later"
        raise InvalidInput(
            f"{brief(str(path))}: was written by {age} version of this program, which has other names: run the "
            "command again, which solves its contacts again"
        )
