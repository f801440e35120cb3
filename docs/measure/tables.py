"""Tables of the pages that are measured."""

import re
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

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


def limit(values, least: float = 0.0) -> float:
    """Limit of numbers on grids of half the pixel each, at the order of the last three.

    NaN where they show none, or one below the least.
    """
    first, second = np.diff(values[-3:])
    ratio = first / second if second else np.nan
    return values[-1] + second / (ratio - 1) if ratio > 2**least else np.nan


def replaced(path: Path, name: str, text: str) -> None:
    """Replace what stands between two comments of a page."""
    page = path.read_text(encoding="utf-8")
    pattern = re.compile(rf"(<!-- {name} -->\n).*?(<!-- end -->)", re.DOTALL)
    assert len(pattern.findall(page)) == 1, (path, name)
    path.write_text(pattern.sub(lambda found: f"{found[1]}{text.strip()}\n{found[2]}", page), encoding="utf-8")


def write(page: Path, sections: Mapping[str, Callable[[], str]]) -> None:
    """Measure each section; its table goes where the page has one between comments of its name."""
    for name, measure in sections.items():
        text = measure()
        print(name, text, sep="\n", flush=True)
        replaced(page, name, text)
