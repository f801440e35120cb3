"""A hard case: a contact in which a solver may fail, its law, and the solvers that are asked."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import inf
from typing import Any, NamedTuple

from bem3d import BEM
from mdr1d import MDR
from scene import Scene

from .conditions import violation
from .law import BOTH, HARD, Answers, Bound, Law, Misfit, apart, rows_misfit, stated, worst
from .ordinary import RADIUS

TOLERANCE = 1e-7  # of contact in three dimensions, where a law is finer than its default
Allowed = float | Misfit


@dataclass(frozen=True)
class Size:
    """Size of the grids and histories of the hard cases.

    line, square, row : points of a 1D grid, a side of a 3D one, and along a single row of pixels
    dense : points a side of grids on which the conditions of contact are computed anew, point by point
    steps : of the longest march in one dimension
    march : of the longest in three dimensions, on a square of 24 points
    """

    line: int
    square: int
    row: int
    dense: int
    steps: int
    march: int


SIZES = {
    "quick": Size(line=1000, square=48, row=128, dense=24, steps=2000, march=60),
    "standard": Size(line=5000, square=96, row=512, dense=24, steps=20_000, march=600),
    "full": Size(line=20_000, square=192, row=1024, dense=48, steps=100_000, march=3000),
}


def line(size: Size, **settings: Any) -> MDR:
    """The one-dimensional solver."""
    return MDR(**{"points": size.line} | settings)


def space(size: Size, **settings: Any) -> BEM:
    """The three-dimensional solver, around the ordinary contact."""
    return BEM(**{"points": size.square, "extent": 3.2 * RADIUS, "tolerance": TOLERANCE} | settings)


def dense(size: Size, **settings: Any) -> BEM:
    """The three-dimensional solver on a grid whose conditions can be computed anew."""
    return space(size, **{"points": size.dense} | settings)


def row(size: Size, **settings: Any) -> BEM:
    """The three-dimensional solver along a single row of pixels."""
    return BEM(**{"points": size.row} | settings)


def square(size: Size, **settings: Any) -> BEM:
    """The three-dimensional solver with its own extent and tolerance."""
    return BEM(**{"points": size.square} | settings)


class Part(NamedTuple):
    """Scenes, one number of their answers, and what it must not exceed."""

    scenes: tuple[Scene, ...]
    misfit: Misfit
    allowed: Allowed

    def share(self, answers: Answers) -> float:
        """The number over what is allowed."""
        found = self.misfit(answers)
        allowed = self.allowed(answers) if callable(self.allowed) else self.allowed
        return found / allowed if allowed else 0.0 if found <= 0 else inf


@dataclass(frozen=True)
class HardCase:
    """A hard case. Its parts are one law: of several the largest share of what is allowed counts.

    parts : function without arguments, whose name and docstring are those of the case
    source : what must hold, with the tolerance and where it comes from
    solvers : functions of a size that make the solvers that are asked
    any_model, kinds : bound for models of any grid, and the dimensions that must hold it; None: they are not asked
    """

    parts: Callable[[], Iterator[Part]]
    source: str
    solvers: tuple[Callable[[Size], Any], ...]
    any_model: Bound | None
    kinds: tuple[str, ...]

    def laws(self) -> Iterator[Law]:
        """The law of both solvers, and that of any model."""
        parts, name = list(self.parts()), self.parts.__name__.replace("_", "-")
        sentence = " ".join((self.parts.__doc__ or "").split()).removesuffix(".")
        scenes = tuple(scene for part in parts for scene in part.scenes)
        if len(parts) == 1:
            (_, misfit, allowed), stated_of = parts[0], self.source
            bound = Bound(stated_of, allowed if callable(allowed) else lambda answers: allowed)
        else:
            misfit, bound = _shares(parts), stated(1.0, f"{self.source} Each number over its own bound.")
        yield Law(name, HARD, sentence, scenes, misfit, bound, self.kinds, solvers=self.solvers)
        if self.any_model is not None:
            yield Law(f"hard.{name}", HARD, sentence, scenes, parts[0].misfit, self.any_model, self.kinds)


def _shares(parts: list[Part]) -> Misfit:
    def misfit(answers: Answers) -> float:
        rest, found = list(answers), []
        for part in parts:
            own, rest = rest[: len(part.scenes)], rest[len(part.scenes) :]
            found.append(part.share(own))
        return worst(found) if inf not in found else inf

    return misfit


def hard(
    source: str, *solvers: Callable, any_model: Bound | None = None, kinds: tuple[str, ...] = BOTH
) -> Callable[[Callable], HardCase]:
    """Decorator that makes a function, which yields parts, a hard case; of both solvers where none is named."""
    return lambda parts: HardCase(parts, source, solvers or (line, space), any_model, kinds)


def equal(allowed: Allowed, *rows: tuple, of: tuple[str, ...] = ("normal_force",)) -> Part:
    """Answers are those of other scenes on the same grid, or stated numbers by their names.

    rows : scene, and the other scene or the numbers; of : numbers that are compared with those of another scene
    """
    scenes = tuple(each for row in rows for each in row if isinstance(each, Scene))
    return Part(scenes, rows_misfit(rows, of), allowed)


def touching(*scenes: Scene) -> Part:
    """Conditions of contact in three dimensions, computed anew, hold within twice the tolerance."""
    return each_of(lambda answer: violation(answer.result), 2 * TOLERANCE, *scenes, only="3D")


def energy_is_lost(allowed: Allowed, *scenes: Scene, dimension: str = "1D") -> Part:
    """Friction by the traction on the slopes, or in 3D by the loss, is the friction of the answer."""
    by = "friction_by_traction" if dimension == "1D" else "friction_by_loss"
    return each_of(lambda answer: apart(answer[by], answer["friction_force"]), allowed, *scenes, only=dimension)


def each_of(number: Callable[[Any], float], allowed: Allowed, *scenes: Scene, only: str = "") -> Part:
    """A number of each answer, of models of one dimension alone if one is given: the largest counts."""

    def misfit(answers: Answers) -> float:
        return worst(float(number(each)) for each in answers if only in ("", each.dimension))

    return Part(scenes, misfit, allowed)


def by_dimension(in_1d: float, in_3d: float) -> Misfit:
    """What is allowed in one and in three dimensions."""
    return lambda answers: in_1d if answers[0].dimension == "1D" else in_3d


def over_points(factor: float, power: float = 1.0) -> Misfit:
    """A factor over a power of the points of the grid."""
    return lambda answers: factor / min(each.points for each in answers) ** power
