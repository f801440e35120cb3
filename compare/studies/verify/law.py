"""A law: scenes, the number that their answers must keep small, and the bound with its source."""

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import isfinite
from typing import Any

from scene import Scene

from ...solving.outcome import Row

BOTH, LINE, SPACE = ("1D", "3D"), ("1D",), ("3D",)
SECTIONS = ("closed forms", "friction", "histories", "invariances", "limits", "hard cases", "convergence")
UNKNOWN = 50.0  # points across the contact of a model that tells none
SHARE = 2.0  # window over contact at most, where only the points of the window are known
UNKNOWN_LEFT = 1e-5  # in the conditions of contact of a model that does not say
ROUNDING = 1e-9  # of forces that are found in another order
LEFT = 10.0  # times what a model says is left in its conditions, which is felt in the forces
MOST, MOST_LEFT = 0.05, 1e-3  # no grid excuses more, and nothing that is left in the conditions


class Missing(LookupError):
    """The model does not give a number that a law asks for."""


@dataclass(frozen=True)
class Answer:
    """Row of one scene, with what a bound has to know of it.

    dimension : of the model
    across : points of the grid across the contact
    """

    row: Row
    dimension: str
    across: float

    @classmethod
    def of(cls, row: Row, model: Any, dimension: str) -> "Answer":
        """Points across the contact as the model measures them, else from the points of its window."""
        across = row.measures.get("points_across_contact", float("nan"))
        if not across > 0:  # nothing touches at the end of some programs
            window = row.settings.get("points", getattr(model, "points", SHARE * UNKNOWN))
            across = float(window) / SHARE
        return cls(row, dimension, across)

    def __getitem__(self, name: str) -> float:
        """A number of a result, or a measure. Raises Missing."""
        if name in self.row.measures:
            return self.row.measures[name]
        if not hasattr(self.row, name):
            raise Missing(f"the model does not give {name}")
        return getattr(self.row, name)


Answers = Sequence[Answer]


@dataclass(frozen=True)
class Bound:
    """Bound of a number, and where it comes from."""

    source: str
    of: Callable[[Answers], float]

    def __call__(self, answers: Answers) -> float:
        """The bound for some answers."""
        return self.of(answers)

    def and_(self, more: float, why: str) -> "Bound":
        """This bound, and a number more for a reason."""
        return Bound(f"{self.source}; {more:g}, {why}", lambda answers: self.of(answers) + more)

    def times(self, factor: float, why: str) -> "Bound":
        """This bound so many times, for a reason; MOST at most."""
        source = f"{factor:g} times, {why}: {self.source}"
        return Bound(source, lambda answers: min(factor * self.of(answers), MOST))


def _solved(answers):
    left = [each["residual"] for each in answers]
    return min(ROUNDING + LEFT * sum(each if isfinite(each) else UNKNOWN_LEFT for each in left), MOST_LEFT)


def _on_grid(answers):
    """A line meets a smooth profile to second order; in 3D pixels of the rim are in contact or not."""
    least = min(each.across for each in answers)
    grid = 2 / least**2 if answers[0].dimension == "1D" else (2 / least) ** 1.5
    return min(grid + _solved(answers), MOST)


def _friction(answers):
    least = min(each.across for each in answers)
    grid = 4 / least**2 if answers[0].dimension == "1D" else 1 / least
    return min(grid + _solved(answers), MOST)


SAME = Bound("what a model says is left in its conditions, ten times, and 1e-9 for rounding", _solved)
GRID = Bound(
    "n points across the contact: 2/n² in 1D, of second order; (2/n)^1.5 in 3D, the load on the outermost half "
    "pixel",
    _on_grid,
)
FRICTION = Bound(
    "n points across the contact: 4/n² in 1D, of second order; 1/n in 3D, half a pixel of the contact's width",
    _friction,
)
RIM = Bound(
    "a pixel at each end of n across the contact, 2/n",
    lambda answers: min(2 / min(each.across for each in answers), MOST),
)
EXACT = Bound("exact, to the last bit", lambda answers: 0.0)


def stated(value: float, source: str) -> Bound:
    """A bound that no grid changes."""
    return Bound(source, lambda answers: value)


@dataclass(frozen=True)
class Law:
    """What answers to some scenes must hold.

    id : name of the law below "verify."
    section : one of SECTIONS
    sentence : in words, without a full stop
    scenes : that are asked, in the order of the answers
    misfit : of the answers, a number not below zero; raises Missing
    bound : that the misfit must not exceed
    kinds : dimensions of the models that must hold it
    shares : of the points of the model, for each scene; all points if absent
    drawn : whether a model must draw surfaces
    twice : whether the scenes are one and the same, asked one after the other
    """

    id: str
    section: str
    sentence: str
    scenes: tuple[Scene, ...]
    misfit: Callable[[Answers], float]
    bound: Bound
    kinds: tuple[str, ...] = BOTH
    shares: tuple[float, ...] = ()
    drawn: bool = False
    twice: bool = False

    def models(self, model: Any) -> tuple[Any, ...]:
        """The model of each scene, on its share of the points. Raises ValueError where it has too few."""
        if not self.shares:
            return (model,) * len(self.scenes)
        return tuple(
            model if each == 1 else replace(model, points=int(model.points * each)) for each in self.shares
        )


def apart(found: float, known: float) -> float:
    """Relative deviation; nothing is nothing."""
    if found == known:
        return 0.0
    return abs(found - known) / abs(known) if known else abs(found)


def exact(
    id: str,
    section: str,
    sentence: str,
    scene: Scene,
    bound: Bound,
    kinds: tuple[str, ...] = BOTH,
    drawn: bool = False,
    **numbers: float,
) -> Law:
    """Law that numbers of one answer are known: the largest of their relative deviations."""

    def misfit(answers: Answers) -> float:
        return max(apart(answers[0][name], value) for name, value in numbers.items())

    return Law(id, section, sentence, (scene,), misfit, bound, kinds, drawn=drawn)


def alike(factors: Mapping[str, float]) -> Callable[[Answers], float]:
    """Largest relative deviation of numbers of the second answer from those of the first times factors."""

    def misfit(answers: Answers) -> float:
        first, second = answers
        return max(apart(second[name], factor * first[name]) for name, factor in factors.items())

    return misfit


def worst(values: Iterable[float]) -> float:
    """The largest; NaN where one is no number."""
    every = list(values)
    return max(every) if all(map(isfinite, every)) else float("nan")


def slug(words: str) -> str:
    """Words as part of the name of a law: letters of an alphabet, digits, points and hyphens."""
    return "-".join(re.findall(r"[a-z0-9.^]+", words.lower()))
