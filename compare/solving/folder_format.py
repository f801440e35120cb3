"""Format of the folders that commands write: it changes with the names of figures, columns and studies."""

from pathlib import Path

from scene.printable import brief
from scene.reading import InvalidInput

FORMAT = 2
UNSTATED = 1  # files of the first format do not state it


def refuse_other(path: Path, found: int) -> None:
    """Raise InvalidInput of a file in another format than this version writes."""
    if found != FORMAT:
        age = "an earlier" if found < FORMAT else "a later"
        raise InvalidInput(
            f"{brief(str(path))}: was written by {age} version of this program, which has other names: run the "
            "command again, which solves its contacts again"
        )
