"""A law: scenes, the number that their answers must keep small, and the bound with its source."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import repeat
from math import inf, isfinite, isnan
from typing import Any

import numpy as np

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
    """The result of a scene by a model of a dimension. Numbers and measures of the result are found by name."""

    result: Result
    dimension: str

    def __getitem__(self, name: str) -> float:
        """A number of the result, or a measure. Raises Missing."""
        found = self.result.measures.get(name, getattr(self.result, name, None))
        if found is None:
            raise Missing(f"the model does not give {name}")
        return found

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

    def wider(self, why: str, more: float = 0.0, times: float = 1.0) -> "Bound":
        """This bound multiplied by `times`, at most MOST, plus `more`, for the stated reason."""
        return Bound(f"{self.source}; {why}", lambda answers: min(times * self.of(answers), MOST) + more)


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
    solvers : of a hard case, functions of a size that make the solvers that are asked; empty: any model is asked
    models : function of the model that returns the models of the scenes
    expected : 0, or the number that is stored
    """

    id: str
    group: str
    sentence: str
    scenes: tuple[Scene, ...]
    misfit: Misfit
    bound: Bound
    kinds: tuple[str, ...] = BOTH
    solvers: tuple[Callable[[Any], Any], ...] = ()
    models: Callable[[Any], Iterable[Any]] = repeat
    expected: float = 0.0


@dataclass(frozen=True)
class Laws:
    """Laws that are made when they are asked for.

    make : function without arguments that yields them
    """

    make: Callable[[], Iterator[Law]]


def laws(bound: Bound, kinds: tuple[str, ...] = BOTH, group: str = CLOSED, **others: Any) -> Callable:
    """Decorator of a function whose docstring says what laws hold, and which yields a row for each.

    A row has the id, a scene or several, the misfit or the numbers that are known of every answer, and where the
    law has a bound of its own that bound. others : fields of each law
    """

    def decorated(rows):
        def make():
            for id, asked, misfit, *own in rows():
                scenes = (asked,) if isinstance(asked, Scene) else tuple(asked)
                form = misfit if callable(misfit) else known(**misfit)
                yield Law(id, group, f"{sentence(rows)}: {id}", scenes, form, *own or [bound], kinds, **others)

        return Laws(make)

    return decorated


def sentence(function: Callable) -> str:
    """Docstring of a function as a sentence without a full stop."""
    return " ".join((function.__doc__ or "").split()).removesuffix(".")


def apart(found: float, known: float) -> float:
    """Relative deviation; nothing is nothing."""
    if found == known:
        return 0.0
    return abs(found - known) / abs(known) if known else abs(found)


def worst(values: Iterable[float]) -> float:
    """The largest, 0 at least; infinite where one is no number."""
    found = float(np.max([0.0, *values]))
    return inf if isnan(found) else found


def known(**numbers: float) -> Misfit:
    """Largest relative deviation of any answer from numbers by their names."""
    return lambda answers: worst(apart(each[name], numbers[name]) for each in answers for name in numbers)


def alike(**factors: float) -> Misfit:
    """Largest relative deviation of numbers of the second answer from those of the first times factors."""
    return lambda answers: worst(apart(answers[1][name], factors[name] * answers[0][name]) for name in factors)


def on_shares(*shares: float) -> Callable[[Any], tuple[Any, ...]]:
    """Models on shares of the points of a model. They raise Missing where it has no points, or too few."""

    def models(model):
        try:
            return tuple(replace(model, points=int(model.points * each + 1e-6)) for each in shares)
        except (AttributeError, TypeError, ValueError):
            raise Missing("the model cannot be asked on a part of its points") from None

    return models
