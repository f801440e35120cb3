"""A law: scenes, the number that their answers must keep small, and the bound with its source."""

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf, isfinite
from typing import Any

from scene import Result, Scene

GROUPS = CLOSED, INVARIANCE, LIMIT, HARD, STORED = "closed-form", "invariance", "limit", "hard", "stored"
BOTH, LINE, SPACE = ("1D", "3D"), ("1D",), ("3D",)
UNKNOWN = 50.0  # points across the contact of a model that tells none
SHARE = 2.0  # window over contact at most, where only the points of the window are known
UNKNOWN_LEFT = 1e-5  # in the conditions of contact of a model that does not say
ROUNDING = 1e-9  # of forces that are found in another order
LEFT = 10.0  # times what a model says is left in its conditions, which is felt in the forces
MOST, MOST_LEFT = 0.05, 1e-3  # no grid excuses more, and nothing that is left in the conditions
FORCES = ("normal_force", "friction_force")


class Missing(LookupError):
    """The model does not give a number that a law asks for."""


@dataclass(frozen=True)
class Answer:
    """The result of one scene, by a model of a dimension. Its numbers and measures are found by their names."""

    result: Result
    dimension: str

    def __getitem__(self, name: str) -> float:
        """A number of the result, or a measure. Raises Missing."""
        if name in self.result.measures:
            return self.result.measures[name]
        if not hasattr(self.result, name):
            raise Missing(f"the model does not give {name}")
        return getattr(self.result, name)

    @property
    def fields(self) -> Mapping[str, Any]:
        """Arrays of the result."""
        return self.result.fields

    @property
    def points(self) -> float:
        """Points of the window."""
        return float(self.result.settings.get("points", SHARE * UNKNOWN))

    @property
    def across(self) -> float:
        """Points across the contact as the model measures them, else from the points of its window."""
        measured = self.result.measures.get("points_across_contact", 0.0)
        return measured if measured > 0 else self.points / SHARE  # nothing touches at the end of some programs


Answers = Sequence[Answer]
Misfit = Callable[[Answers], float]


@dataclass(frozen=True)
class Bound:
    """Bound of a number, and where it comes from."""

    source: str
    of: Misfit

    def and_(self, more: float, why: str) -> "Bound":
        """This bound, and a number more for a reason."""
        return Bound(f"{self.source}; {more:g}, {why}", lambda answers: self.of(answers) + more)

    def times(self, factor: float, why: str) -> "Bound":
        """This bound so many times, for a reason; MOST at most."""
        source = f"{factor:g} times, {why}: {self.source}"
        return Bound(source, lambda answers: min(factor * self.of(answers), MOST))


def _left(answers):
    left = [each["residual"] for each in answers]
    return min(ROUNDING + LEFT * sum(each if isfinite(each) else UNKNOWN_LEFT for each in left), MOST_LEFT)


def _grid(source: str, line: Callable[[float], float], space: Callable[[float], float]) -> Bound:
    """Bound of the grid with fewest points across the contact, in 1D and in 3D, and what is left; MOST at most."""

    def of(answers):
        grid = line if answers[0].dimension == "1D" else space
        return min(grid(min(each.across for each in answers)) + _left(answers), MOST)

    return Bound(source, of)


SAME = Bound("what a model says is left in its conditions, ten times, and 1e-9 for rounding", _left)
GRID = _grid(
    "n points across the contact: 2/n² in 1D, of second order; (2/n)^1.5 in 3D, the load on the outermost half "
    "pixel",
    lambda n: 2 / n**2,
    lambda n: (2 / n) ** 1.5,
)
FRICTION = _grid(
    "n points across the contact: 4/n² in 1D, of second order; 1/n in 3D, half a pixel of the contact's width",
    lambda n: 4 / n**2,
    lambda n: 1 / n,
)
RIM = Bound(
    "a pixel at each end of n across the contact, 2/n",
    lambda answers: min(2 / min(each.across for each in answers), MOST),
)


def stated(value: float, source: str) -> Bound:
    """A bound that no grid changes."""
    return Bound(source, lambda answers: value)


EXACT = stated(0.0, "exact, to the last bit")


@dataclass(frozen=True)
class Law:
    """What answers to some scenes must hold.

    id : name of the law, unique in the table
    group : one of GROUPS
    sentence : in words, without a full stop
    scenes : that are asked, in the order of the answers
    misfit : of the answers; a number not below zero, or one that is stored. Raises Missing
    bound : that the misfit, or its distance from `expected`, must not exceed; its source says why
    kinds : dimensions of the models that must hold it
    drawn : whether a model must draw surfaces
    solvers : of a hard case, functions of a size that make the solvers that are asked; empty: any model is asked
    models : function of the model that gives that of each scene; absent, the model itself
    expected : 0, or the number that is stored
    """

    id: str
    group: str
    sentence: str
    scenes: tuple[Scene, ...]
    misfit: Misfit
    bound: Bound
    kinds: tuple[str, ...] = BOTH
    drawn: bool = False
    solvers: tuple[Callable[[Any], Any], ...] = ()
    models: Callable[[Any], tuple[Any, ...]] | None = None
    expected: float = 0.0

    @property
    def source(self) -> str:
        """Where the bound comes from."""
        return self.bound.source


def apart(found: float, known: float) -> float:
    """Relative deviation; nothing is nothing."""
    if found == known:
        return 0.0
    return abs(found - known) / abs(known) if known else abs(found)


def exact(
    id: str,
    sentence: str,
    scene: Scene,
    bound: Bound,
    kinds: tuple[str, ...] = BOTH,
    group: str = CLOSED,
    **numbers: float,
) -> Law:
    """Law that numbers of one answer are known: the largest of their relative deviations."""
    drawn = type(scene.indenter).__name__ == "Plane"
    return Law(id, group, sentence, (scene,), rows_misfit([(scene, numbers)]), bound, kinds, drawn)


def alike(factors: Mapping[str, float]) -> Misfit:
    """Largest relative deviation of numbers of the second answer from those of the first times factors."""

    def misfit(answers: Answers) -> float:
        first, second = answers
        return worst(apart(second[name], factor * first[name]) for name, factor in factors.items())

    return misfit


def rows_misfit(rows: Sequence[tuple], of: Sequence[str] = ("normal_force",)) -> Misfit:
    """Largest relative deviation of rows: a scene, and another one or known numbers by their names.

    Answers are in the order in which the scenes stand in the rows. of : numbers of two scenes that are compared
    """

    def misfit(answers: Answers) -> float:
        rest, found = iter(answers), []
        for _, other in rows:
            answer = next(rest)
            known: Any = next(rest) if isinstance(other, Scene) else other
            names = of if isinstance(other, Scene) else other
            found += [apart(answer[name], known[name]) for name in names]
        return worst(found)

    return misfit


def worst(values: Iterable[float]) -> float:
    """The largest; infinite where one is no number."""
    every = list(values)
    return max(every, default=0.0) if all(map(isfinite, every)) else inf


def on_shares(*shares: float) -> Callable[[Any], tuple[Any, ...]]:
    """Models on shares of the points of a model. They raise Missing where it has no points, or too few."""

    def models(model):
        if not hasattr(model, "points"):
            raise Missing("the model has no field points to refine")
        try:
            return tuple(replace(model, points=int(model.points * each + 1e-6)) for each in shares)
        except (TypeError, ValueError):
            raise Missing(f"the model refuses a part of its {model.points} points") from None

    return models


def slug(words: str) -> str:
    """Words as part of the name of a law: letters of an alphabet, digits, points and hyphens."""
    return "-".join(re.findall(r"[a-z0-9.^]+", words.lower()))
