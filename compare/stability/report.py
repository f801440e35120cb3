"""The collection examined, and what came of it as records, a table and a page."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import inf, nan
from pathlib import Path

from ..glossary import Definitions
from ..outcome import Outcome
from ..publish import render, write_csv, write_text
from ..sheets import Sheet, anchored, reading
from ..store import Store, Task
from ..runner import Progress, SweepResult, sweep
from .collection import CASES
from .examination import Examination, checks
from .hardcase import Check, Refusal

VERDICTS = HELD, REFUSED, BROKEN = "held", "refused as it should", "BROKEN"
TABLE, MARKDOWN, PAGE = "stability.csv", "stability.md", "stability.html"
# Where a file lay when a case was examined: all before its name, of a path from the root.
FOLDERS = re.compile(r"(?<![\w.])/(?:[^\s/]+/)+")


@dataclass(frozen=True)
class Record:
    """What came of one case.

    group, name, about, law : as of HardCase
    what, found, allowed, message : the check that came nearest to its bound, or a broken one; NaN and the reason
        where the case raised
    count, broken : of its checks
    verdict : HELD, REFUSED if all of its checks were refusals, or BROKEN
    seconds : processor time of the case [s]
    """

    group: str
    name: str
    about: str
    law: str
    what: str
    found: float
    allowed: float
    message: str
    count: int
    broken: int
    verdict: str
    seconds: float


def write_stability(folder: Path, found: Sequence[Record], size: str, swept: SweepResult) -> Path:
    """Write the table as CSV and as Markdown, and the page; return the path of the page."""
    write_csv(folder / TABLE, [vars(record) for record in found])
    write_text(folder / MARKDOWN, markdown(found))
    table = Sheet.read(folder, folder / TABLE, "Cases")
    groups = grouped(found)
    page = render(
        "stability.html",
        title="Where it is hard",
        contents=[("summary", "Summary"), *((anchored("group", group), group.capitalize()) for group in groups)],
        size=size,
        verdicts={verdict: [record.verdict for record in found].count(verdict) for verdict in VERDICTS},
        refused=REFUSED,
        lost=BROKEN,
        broken=[record for record in found if record.verdict == BROKEN],
        groups=groups,
        rows={record.name: row for row, record in enumerate(found, 1)},
        table=table,
        sheets=[table],
        anchored=anchored,
        definitions=Definitions(),
        **reading(),
        swept=swept,
    )
    write_text(folder / PAGE, page)
    return folder / PAGE


def grouped(found: Sequence[Record]) -> dict[str, list[Record]]:
    """By what is hard, in the order of the collection."""
    return {
        group: [each for each in found if each.group == group] for group in dict.fromkeys(r.group for r in found)
    }


def conduct(
    size: str, folder: Path, solved: Path, workers: int | None = None, progress: Progress | None = None
) -> list[Record]:
    """Examine every case at a size, "small" or "large", and write table and page into a folder.

    solved : folder of what has been examined, which is not examined again; workers, progress : as of sweep
    """
    tasks = [Examination(name, size) for name in CASES]
    swept = sweep(tasks, Store(solved), workers, progress)
    found = records(swept.outcomes)
    write_stability(folder, found, size, swept)
    return found


def records(outcomes: Mapping[Task, Outcome]) -> list[Record]:
    """One a case, in the order of the collection."""
    of = {task.case: outcome for task, outcome in outcomes.items() if isinstance(task, Examination)}
    return [record(name, of[name]) for name in CASES if name in of]


def record(name: str, outcome: Outcome) -> Record:
    """What came of one case."""
    case, found, seconds = CASES[name], checks(outcome), outcome.rows[0].seconds
    asked = case.group, case.name, case.about, case.law
    if not found:
        return Record(
            *asked, "the case itself", nan, nan, _named(outcome.rows[0].reason or ""), 1, 1, BROKEN, seconds
        )
    broken = sum(not check.holds for check in found)
    verdict = BROKEN if broken else REFUSED if all(isinstance(check, Refusal) for check in found) else HELD
    nearest = max(found, key=_nearness)
    told = nearest.what, nearest.found, nearest.allowed, _named(nearest.message or "")
    return Record(*asked, *told, len(found), broken, verdict, seconds)


def _nearness(check: Check | Refusal) -> tuple[bool, float]:
    """Broken checks first, then by the share of what is allowed."""
    if check.found != check.found:
        return True, inf
    return not check.holds, check.found / check.allowed if check.allowed > 0 else check.found


def markdown(found: Sequence[Record]) -> str:
    """A section a group: what is hard, what must hold, what was found."""
    groups = grouped(found)
    return "\n\n".join(f"## {group.capitalize()}\n\n{table(found, group)}" for group in groups) + "\n"


def table(found: Sequence[Record], group: str) -> str:
    """The cases of one group as a Markdown table."""
    lines = ["case | what is hard | what must hold | found | allowed | verdict | s", " | ".join(["---"] * 7)]
    lines += [" | ".join(_cells(record)) for record in found if record.group == group]
    return "\n".join(f"| {line} |" for line in lines)


def _cells(record):
    numbers = (f"{record.found:.2g}", f"{record.allowed:.2g}")
    if record.verdict == REFUSED:
        numbers = f"“{_short(record.message)}”", "-"
    elif record.verdict == BROKEN:
        numbers = f"{record.what}: {numbers[0]} {_short(record.message)}".strip(), numbers[1]
    cells = record.name, record.about, record.law, *numbers, record.verdict, f"{record.seconds:.2f}"
    return (cell.replace("|", "\\|") for cell in cells)


def _named(message):
    """Files by their names, whatever the folder."""
    return FOLDERS.sub("", message)


def _short(message, most=120):
    return message if len(message) <= most else message[: most - 1] + "…"
