"""Plan of a solver for a scene, before it solves: parts that are built, their costs, and parts left out."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import Any

from .costs import Expected
from .doubt import Doubt
from .markup import table
from .motion import Program
from .scene import Scene
from .surfaces.scanned import Scanned

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
    """Plan of what a solver would simulate of one scene, and nothing else. Printed, it is a page.

    solver, settings : name, and the settings that matter here, in words
    terms : by the field of the scene, what is simulated for the part that stands there
    method : how the contact is found
    shape : points of the finest grid, (rows, points)
    grids : in words, all of them
    kernels : built for the finest grid; coarser ones have the same, smaller
    modes : that are followed
    memory : most that is held at once [bytes], what the process holds without it excluded
    steps : in time; 0 of what is steady
    operator_applications, seconds : in equivalents of the finest grid, and of processor time
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
    seconds: Expected
    left_out: Mapping[str, str] = field(default_factory=dict)
    doubts: tuple[Doubt, ...] = ()

    def __str__(self) -> str:
        return "\n".join([f"{self.solver}, {self.settings}", *self._lines()])

    def _repr_html_(self) -> str:
        groups: dict[str, Mapping[Any, Any]] = {
            "doubtful": dict.fromkeys(self.doubts, ""),
            "simulated": self.terms,
            "method": {"": self.method},
            "grids": dict.fromkeys(self.grids, ""),
            "kernels": {kernel.name: kernel for kernel in self.kernels},
            "modes": {"": self.modes},
            "steps in time": {"": self.steps or "none"},
            "memory": {"": size(self.memory)},
            "expected": {"operator_applications": self.operator_applications, "seconds": self.seconds},
            "left out": self.left_out,
        }
        rows = [(title, name, said) for title, group in groups.items() for name, said in group.items()]
        # A group is named once.
        named = [("" if k and rows[k - 1][0] == row[0] else row[0], *row[1:]) for k, row in enumerate(rows)]
        return table(named, title=f"{self.solver}, {self.settings}")

    def _lines(self) -> Iterator[str]:
        if self.doubts:
            yield from _list("doubtful", self.doubts)
        yield from _table("simulated", self.terms)
        yield from _list("method", [self.method])
        yield from _list("grids", self.grids)
        yield from _table("kernels", {kernel.name: kernel for kernel in self.kernels})
        yield from _list("modes", [self.modes])
        yield from _list("steps in time", [self.steps or "none"])
        yield from _list("memory", [size(self.memory)])
        yield from _table(
            "expected", {"operator_applications": self.operator_applications, "seconds": self.seconds}
        )
        yield from _table("left out", self.left_out)


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


def _table(title, rows):
    width = max([WIDTH, *map(len, rows)])
    return _list(title, [f"{name:<{width}s} {value}" for name, value in rows.items()] or ["none"])


def _list(title, lines):
    yield f"  {title}"
    yield from (f"    {line}" for line in lines)
