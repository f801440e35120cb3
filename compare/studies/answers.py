"""What `--json` prints of every command, as types, from which its JSON schema is made."""

from dataclasses import dataclass
from math import nan
from pathlib import Path
from typing import Any, TypeAlias

from pydantic import Field, create_model

from scene import notes
from scene.plan import Plan

from ..library.ready import Listing
from ..report.manifest import json_of
from ..report.page import Table
from ..solving.cost import Cost
from ..solving.vocabulary import entry
from ..statistics.finding import Claim, Finding
from ..trustmap.verdict import Advice
from .plan import Accuracy, Plans
from .report import Report

Cell: TypeAlias = str | bool | int | float | None
_FOUND: Any = {
    name: (type(value), Field(description=found.text if (found := entry(name)) else name.replace("_", " ")))
    for name, value in Finding(Claim("", ""), nan).row.items()
}
Row: Any = create_model("Row", **_FOUND)


@dataclass(frozen=True)
class Reported:
    """JSON answer of a command that solves, `study` with a name among them.

    page : file of the page; null if none was written
    doubts : doubts and notes, which stand before the answer
    answer : the answer in words
    findings : one by one, as in findings.csv
    tables : short tables of the page by name, as in its CSV files: rows of cells by column
    """

    page: str | None
    doubts: tuple[str, ...]
    answer: tuple[str, ...]
    findings: tuple[Row, ...]
    tables: dict[str, tuple[dict[str, Cell], ...]]


@dataclass(frozen=True)
class Planned:
    """JSON answer of `plan`.

    solvers : plan of each solver by its name, or in words why there is none
    contacts, seconds : of `crosscheck run`, at most, and its processor time [s]; null where it solves nothing
    times : processor time of this contact by solver [s]
    accuracies : what intervals of this contact take in 3D; empty where its scatter is not known, or none
    reason : why it solves nothing; empty where it does
    doubts, notes : about the scene, and on what was read for it
    """

    solvers: dict[str, Plan | str]
    contacts: int | None
    seconds: float | None
    times: dict[str, float]
    accuracies: tuple[Accuracy, ...]
    reason: str
    doubts: tuple[str, ...]
    notes: tuple[str, ...]


@dataclass(frozen=True)
class Offered:
    """Scene or study that comes with the package. title, about : for people"""

    title: str
    about: str


@dataclass(frozen=True)
class Listed:
    """JSON answer of `scenes`, and of `study` without a name. offered : by name"""

    offered: dict[str, Offered]


@dataclass(frozen=True)
class Written:
    """JSON answer of `new` and `export`. files : that were written"""

    files: tuple[str, ...]


# The answer of `trust` is an Advice.
Answer: TypeAlias = Reported | Advice | Planned | Listed | Written


def answer(found: Any) -> Answer:
    """What `--json` prints of what a command returns."""
    match found:
        case Report():
            page, path = found.page, str(found.path) if found.path else None
            short = (each for each in (*page.every(Table), *page.opening) if not each.long)
            tables = {each.name: _rows(each.frame) for each in short}
            return Reported(path, tuple(page.first), tuple(page.answer), _rows(found.findings), tables)
        case Plans():
            cost = found.cost if isinstance(found.cost, Cost) else None
            return Planned(
                solvers=found,
                contacts=cost.contacts if cost else None,
                seconds=cost.seconds if cost else None,
                times=found.times,
                accuracies=found.accuracies,
                reason="" if cost else str(found.cost),
                doubts=found.doubts,
                notes=tuple(notes(found.scene)),
            )
        case Listing():
            return Listed({name: Offered(each.title, each.about) for name, each in found.items()})
        case Path():
            return Written((str(found),))
        case list():
            return Written(tuple(map(str, found)))
    return found


def written(found: Any) -> str:
    """JSON of what a command returns; a number that is not known or not finite is null."""
    return json_of(answer(found))


def _rows(frame):
    return tuple(frame.to_dict("records"))
