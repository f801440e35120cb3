"""Tables as CSV files: every digit is written, and what is read back is the same table."""

import io
from pathlib import Path

import pandas
from pandas import DataFrame, RangeIndex

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
        # Which digits the engine in C keeps differs between versions of pandas; that in Python keeps all of them.
        found = pandas.read_csv(io.BytesIO(file), engine="python", keep_default_na=False, na_values=["nan"])
        if not found.index.equals(RangeIndex(len(found))):  # pandas takes what stands in front for names of rows
            raise ValueError("its rows are longer than its head")
        return found
    except Unreadable as error:
        raise InvalidInput(str(error)) from error
    except (ValueError, MemoryError) as error:
        raise InvalidInput(f"{path}: is not a table that a command has written: {brief(str(error))}") from error
