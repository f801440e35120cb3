"""Plan of a solver for a scene, before it solves: parts that are built, their costs, and parts left out."""

import csv
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, fields
from functools import cache
from math import prod
from pathlib import Path
from typing import Any

from .doubt import Doubt
from .motion import Program
from .printable import table
from .scene import Scene
from .surfaces.scanned import Scanned

# Share of the applications of a solve to 1e-7 that each power of ten in the tolerance saves. Contacts at rest and
# sliding, smooth and rough, took 0.81 of them to 1e-5 and 0.57 to 1e-3: medians of 22.
DECADE, LEAST = 0.1, 0.5


@dataclass(frozen=True)
class Expected:
    """A cost. value : None where it is not known; why : what it rests on, or why it is not known."""

    value: float | None
    why: str

    def times(self, factor: float, why: str) -> "Expected":
        """The value multiplied by a factor; an unknown value stays unknown."""
        return self if self.value is None else Expected(self.value * factor, f"{self.why}, times {why}")

    def __str__(self) -> str:
        return f"not known: {self.why}" if self.value is None else f"{two_digits(self.value)}, {self.why}"


def at_tolerance(counted: float, decades: float) -> float:
    """Applications at a tolerance that is `decades` powers of ten wider than the one they were counted at."""
    return counted * max(1 - DECADE * decades, LEAST)


def two_digits(value: float) -> str:
    """Two digits of a number, written out up to a million."""
    return f"{float(f'{value:.2g}'):g}"


def expected(plain: Callable[[], float], why: str, parts: Iterable[object], table: Path) -> Expected:
    """Expected applications.

    plain : gives those of a contact without these parts, by `why`; asked only where all parts are known
    parts : parts of a scene; each multiplies them by its line of the table
    """
    names, known = [type(part).__name__ for part in parts], multiples(table)
    if unknown := [name for name in names if name not in known]:
        return Expected(None, f"what {' and '.join(unknown)} takes was not measured")
    if names:
        why += f", times what {' and '.join(names)} took of a sphere"
    return Expected(plain() * prod(known[name] for name in names), why)


@cache
def multiples(table: Path) -> Mapping[str, float]:
    """Factors on the applications by the name of a part's type, from a CSV of part and operator_applications."""
    with table.open(encoding="utf-8", newline="") as file:
        return {row["part"]: float(row["operator_applications"]) for row in csv.DictReader(file)}


WIDTH = 36  # of the first column of a plan, at least
PIECE = 27  # words that Python needs for each array that is kept apart, and its time
# What an absent part means for every solver.
ABSENT = {
    "temperature": "times are as stated: none is shifted",
    "heating": "nothing gets warmer: no temperature is sought",
}
NO_MAP = "no map of heights is read, levelled or turned into waves"
NO_MODES = "the solid is elastic: it has none"
NO_REVERSAL = "nothing is kept of what is left behind"
NO_OSCILLATION = "no steps are there to follow one"


@dataclass(frozen=True)
class Kernel:
    """Kernel that is built once and multiplied with over and over.

    name : what of
    form : "kernel", values on the grid, rows along y, or "symbol", a factor on each wave of such a grid
    shape : of those values, or of the grid
    """

    name: str
    form: str
    shape: tuple[int, ...]

    def __str__(self) -> str:
        return f"{self.form}, {by(self.shape)}"


@dataclass(frozen=True)
class Modes:
    """Modes of the elastomer that are simulated. times : the shortest and the longest [s]; None without modes."""

    count: int
    times: tuple[float, float] | None = None

    @classmethod
    def of(cls, times: Sequence[float]) -> "Modes":
        """Modes by their times [s]."""
        return cls(len(times), (float(min(times)), float(max(times))) if len(times) else None)

    def __str__(self) -> str:
        if self.times is None:
            return "none"
        shortest, longest = self.times
        return f"{self.count}, {shortest:.3g} s" + ("" if shortest == longest else f" to {longest:.3g} s")


@dataclass(frozen=True)
class Plan:
    """Plan of what a solver would simulate for a scene, without solving it. Printed, it is a page.

    solver, settings : name, and the settings that matter here, in words
    terms : by the field of the scene, what is simulated for the part that stands there
    method : how the contact is found
    shape : points of the finest grid, (rows, points)
    grids : in words, all of them
    kernels : built for the finest grid; coarser ones have the same, smaller
    modes : that are followed
    memory : most that is held at once [bytes], what the process holds without it excluded
    steps : in time; 0 of what is steady
    operator_applications : in equivalents of the finest grid
    left_out : what the scene does not ask for, and what therefore is not done
    doubts : about the scene, and about how well the grid shows it
    """

    solver: str
    settings: str
    terms: Mapping[str, str]
    method: str
    shape: tuple[int, ...]
    grids: tuple[str, ...]
    kernels: tuple[Kernel, ...]
    modes: Modes
    memory: int
    steps: int
    operator_applications: Expected
    left_out: Mapping[str, str] = field(default_factory=dict)
    doubts: tuple[Doubt, ...] = ()

    def __str__(self) -> str:
        lines = [f"{self.solver}, {self.settings}"]
        for title, group in self._groups.items():
            width = max([WIDTH, *map(len, filter(None, map(str, group)))])
            lines += [f"  {title}"]
            lines += [
                f"    {name!s:<{width}s} {text}".rstrip() if text else f"    {name}"
                for name, text in group.items()
            ]
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        rows = []
        for title, group in self._groups.items():
            first = [title, *[""] * len(group)]  # a group is named once
            rows += [(name, *row) for name, row in zip(first, group.items(), strict=False)]
        return table(rows, title=f"{self.solver}, {self.settings}")

    @property
    def _groups(self) -> dict[str, Mapping[Any, Any]]:
        """Lines by title: names and their texts; a text is empty where the name is enough."""
        groups: dict[str, Mapping[Any, Any]] = {
            "doubtful": dict.fromkeys(self.doubts, ""),
            "simulated": self.terms,
            "method": {self.method: ""},
            "grids": dict.fromkeys(self.grids, ""),
            "kernels": {kernel.name: kernel for kernel in self.kernels} or {"none": ""},
            "modes": {self.modes: ""},
            "steps in time": {self.steps or "none": ""},
            "memory": {size(self.memory): ""},
            "expected": {"operator_applications": self.operator_applications},
            "left out": self.left_out or {"none": ""},
        }
        return {title: group for title, group in groups.items() if group}


def absent(scene: Scene, meanings: Mapping[str, str]) -> dict[str, str]:
    """The fields of a scene in which nothing stands, and what that means."""
    empty = (each.name for each in fields(scene) if each.name not in scene.parts)
    return {name: meanings.get(name, "nothing is built for it") for name in empty}


def left_out(scene: Scene, meanings: Mapping[str, str]) -> dict[str, str]:
    """Parts that a scene does not ask for, and what follows from that.

    meanings : of absent fields, for the solver, and of "time" and "flow", where nothing changes or flows
    """
    left, delayed = absent(scene, {**ABSENT, **meanings}), len(scene.solid.retardation()[2]) > 0
    if not any(isinstance(part, Scanned) for part in scene.parts.values()):
        left["measured surface"] = NO_MAP
    if not delayed:
        left["modes"] = NO_MODES
    if isinstance(scene.motion, Program):
        if not scene.motion.reverses:
            left["reversal"] = NO_REVERSAL
        if not any(stage.oscillation for stage in scene.motion.stages):
            left["oscillation"] = NO_OSCILLATION
        return left
    left["time"] = meanings["time"]
    if not delayed or not scene.motion.speed:
        left["flow"] = meanings["flow"]
    return left


def by(shape: Sequence[int]) -> str:
    """A shape in words."""
    return " x ".join(map(str, shape))


def size(count: float) -> str:
    """A number of bytes in words."""
    for unit in ("B", "kB", "MB"):
        if count < 1000:
            return f"{count:.3g} {unit}"
        count /= 1000
    return f"{count:.3g} GB"
