"""Tables as CSV files: every digit is written, and what is read back is the same table."""

import io
from contextlib import suppress
from pathlib import Path

import pandas
from pandas import DataFrame, RangeIndex, Series

from scene.files.files import Unreadable, content
from scene.files.reading import InvalidInput
from scene.printable import brief

MOST_BYTES = 2**28  # of a table that is read; those of a page have some megabytes


def text(frame: DataFrame) -> str:
    """A table as the text of its file; the index is left out."""
    return frame.to_csv(index=False, na_rep="nan", lineterminator="\n")


def read(path: Path) -> DataFrame:
    """A table from its file, numbers exact.

    Raises InvalidInput where there is none, it is damaged, or it is larger than MOST_BYTES.
    """
    try:
        file = content(path, MOST_BYTES)
        if not file.strip():
            return DataFrame()
        # Which digits a reader of numbers keeps differs between versions of pandas; Python keeps all of them.
        words = pandas.read_csv(io.BytesIO(file), dtype=str, keep_default_na=False)
        if not isinstance(words.index, RangeIndex):  # pandas takes what stands in front for names of rows
            raise ValueError("its rows are longer than its head")
        return words.apply(_numbers)
    except Unreadable as error:
        raise InvalidInput(str(error)) from error
    except (ValueError, MemoryError) as error:
        raise InvalidInput(f"{path}: is not a table that a command has written: {brief(str(error))}") from error


def _numbers(column: Series) -> Series:
    """A column of words as whole numbers, as numbers or as truth values where all of them are."""
    if set(column) <= {"True", "False"} and len(column):
        return column == "True"
    for dtype in ("int64", "float64"):
        with suppress(ValueError, OverflowError):  # also of whole numbers that are too long
            return column.astype(object).astype(dtype)
    return column
