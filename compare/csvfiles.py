"""Tables as CSV files: every digit is written, and what is read back is the same table."""

import io
from pathlib import Path

import pandas
from pandas import DataFrame, Series

from scene.reading import InvalidInput

from .store import write

NOT_KNOWN = "nan"


def text(frame: DataFrame) -> str:
    """A table as the text of its file; the index is left out."""
    return frame.to_csv(index=False, na_rep=NOT_KNOWN, lineterminator="\n")


def write_text(path: Path, content: str) -> None:
    """Write a text whole or not at all; the folder is made. Raises OSError."""
    path.parent.mkdir(parents=True, exist_ok=True)
    write(path, lambda file: file.write(content.encode()))


def read(path: Path) -> DataFrame:
    """A table from its file, numbers exact. Raises InvalidInput where there is none or it is damaged."""
    try:
        content = path.read_text(encoding="utf-8")
        if not content.strip():
            return DataFrame()
        # Which digits a reader of numbers keeps differs between versions of pandas; Python keeps all of them.
        words = pandas.read_csv(io.StringIO(content), dtype=str, keep_default_na=False)
        return words.apply(_numbers)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else error
        raise InvalidInput(f"{path}: is no table as a command leaves it: {reason}") from error


def _numbers(column: Series) -> Series:
    """A column of words as whole numbers, as numbers or as truth values where all of them are."""
    if set(column) <= {"True", "False"} and len(column):
        return column == "True"
    for kind in (int, float):
        try:
            return Series([kind(word) for word in column], column.index, name=column.name)
        except ValueError:
            continue
    return column
