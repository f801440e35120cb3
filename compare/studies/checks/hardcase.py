"""A hard case: a contact in which a solver may fail, its law, and the solvers that are asked."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import chain, islice
from typing import Any, NamedTuple

from bem3d import BEM
from mdr1d import MDR
from scene import Scene

from .conditions import violation
from .law import HARD, Answers, Bound, Law, Laws, Misfit, alike, known, sentence, stated, worst
from .ordinary import RADIUS

TOLERANCE = 1e-7  # of contact in three dimensions, where a law is finer than its default
NOTHING = 5e-324  # that is allowed where a number must be exact: the least above 0
Allowed = float | Misfit


@dataclass(frozen=True)
class Size:
    """Size of the grids and histories of the hard cases.

    line, square : points of a 1D grid, and a side of a 3D one
    dense : points a side of grids on which the conditions of contact are computed anew, point by point
    steps : of the longest march in one dimension
    march : of the longest in three dimensions, on a square of 24 points
    """

    line: int
    square: int
    dense: int
    steps: int
    march: int


SIZES = {
    "quick": Size(line=1000, square=48, dense=24, steps=2000, march=60),
    "standard": Size(line=5000, square=96, dense=24, steps=20_000, march=600),
    "full": Size(line=20_000, square=192, dense=48, steps=100_000, march=3000),
}


def line(size: Size, **settings: Any) -> MDR:
    """The one-dimensional solver."""
    return MDR(**{"points": size.line} | settings)


def square(size: Size, **settings: Any) -> BEM:
    """The three-dimensional solver with its own extent."""
    return BEM(**{"points": size.square, "tolerance": TOLERANCE} | settings)


def space(size: Size, **settings: Any) -> BEM:
    """The three-dimensional solver around the ordinary contact."""
    return square(size, **{"extent": 3.2 * RADIUS} | settings)


def dense(size: Size, **settings: Any) -> BEM:
    """The three-dimensional solver on a grid whose conditions can be computed anew."""
    return space(size, **{"points": size.dense} | settings)


class Part(NamedTuple):
    """Scenes, one number of their answers, and what it must not exceed."""

    scenes: tuple[Scene, ...]
    misfit: Misfit
    allowed: Allowed

    def share(self, answers: Answers) -> float:
        """The number divided by what is allowed; a negative number counts as 0."""
        return max(float(self.misfit(answers)), 0.0) / (_value(self.allowed, answers) or NOTHING)


def hard(source: str, *solvers: Callable, any_model: Bound | None = None) -> Callable:
    """Decorator of a function that yields parts: a hard case of its name and docstring.

    Of several numbers the largest share of what is allowed is the misfit.

    source : what must hold, with the tolerance and where it comes from
    solvers : functions of a size that make those that are asked; both where none is named
    any_model : bound for models of any grid; None: they are not asked
    """

    def decorated(case):
        def make():
            parts, name = list(case()), case.__name__.replace("_", "-")
            common = HARD, sentence(case), tuple(chain(*(part.scenes for part in parts)))
            yield Law(name, *common, shares(parts), stated(1.0, source), solvers=solvers or (line, space))
            if any_model is not None:
                own = [part._replace(allowed=any_model.of) for part in parts]
                yield Law(f"hard.{name}", *common, shares(own), stated(1.0, any_model.source))

        return Laws(make)

    return decorated


def shares(parts: list[Part]) -> Misfit:
    """Largest share of what is allowed, of answers to the scenes of parts one after the other."""

    def misfit(answers: Answers) -> float:
        rest = iter(answers)
        return worst([part.share(list(islice(rest, len(part.scenes)))) for part in parts])

    return misfit


def equal(allowed: Allowed, *rows: tuple, of: tuple[str, ...] = ("normal_force",)) -> Iterator[Part]:
    """Answers are those of other scenes on the same grid, or stated numbers by their names.

    rows : scene, and the other scene or the numbers; of : numbers that are compared with those of another scene
    """
    for scene, other in rows:
        if isinstance(other, Scene):
            yield Part((other, scene), alike(**dict.fromkeys(of, 1.0)), allowed)
        else:
            yield Part((scene,), known(**other), allowed)


def touching(*scenes: Scene) -> Part:
    """Conditions of contact in three dimensions, computed anew, hold within twice the tolerance."""
    return each_of(lambda answer: violation(answer.result), 2 * TOLERANCE, *scenes)


def each_of(number: Callable[[Any], float], allowed: Allowed, *scenes: Scene) -> Part:
    """A number of each answer; the largest counts."""
    return Part(scenes, lambda answers: worst(map(number, answers)), allowed)


def _value(allowed, answers):
    return allowed(answers) if callable(allowed) else allowed


def by_dimension(in_1d: Allowed, in_3d: Allowed) -> Misfit:
    """Bound of a misfit, one in one dimension and another in three."""
    return lambda answers: _value(in_1d if answers[0].dimension == "1D" else in_3d, answers)


def over_points(factor: float, power: float = 1.0) -> Misfit:
    """A factor over a power of the points of the grid."""
    return lambda answers: factor / min(each.points for each in answers) ** power
