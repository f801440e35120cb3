"""Tables of the pages that are measured."""

from collections.abc import Iterator

import numpy as np


def table(header: str, rows: Iterator[tuple]) -> str:
    """A Markdown table; columns are named in the header, separated by |."""
    names = header.split("|")
    lines = [" | ".join(names), " | ".join("---" for _ in names)]
    lines += [" | ".join(row) for row in rows]
    return "\n".join(f"| {line} |" for line in lines)


def order(points, errors) -> float:
    """Observed order: slope of error against points, in logarithms, over all of them."""
    return -np.polyfit(np.log(points), np.log(errors), 1)[0]
