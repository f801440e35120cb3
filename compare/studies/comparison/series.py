"""Series: one scene with the curves that are solved of it, what is judged on them, and its surfaces."""

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import ceil, inf
from typing import ClassVar

import numpy as np
import xarray

from scene import Scene

from ...library.describe import slug
from ...models.table import Model, Models
from ...solving.curve import LEVELS, Curve, levels
from ...solving.task import SceneTask
from ...statistics.collapse import Collapse
from ...statistics.finding import Claim, Finding, said_of
from ...statistics.intervals import Estimated
from ...statistics.jackknife import mean
from ...statistics.means import touches
from ...statistics.multilevel import MEANS, WORDS, DrawnSurfaces, means_of, unreached
from .answers import Answers
from .laws import Laws

Counts = Mapping[str, tuple[int, ...]]  # numbers of surfaces on each level, by model
Places = Mapping[tuple[int, int], str]  # places of speed and value on a curve, in words
# Surfaces of a pilot on the coarsest level, of each difference, and of that of the finest of several, which
# scatters least and costs most.
PILOT, DIFFERENCES, FINEST = 32, 8, 4


@dataclass(frozen=True)
class Judged:
    """What becomes of the claims on a series.

    findings : one by one
    collapses : what shifts of its curves achieve on the fine level, by model
    laws : of the paper at its points, by model; none of a series that does not slide, or has no answers
    """

    findings: Sequence[Finding]
    collapses: Mapping[str, Collapse] = field(default_factory=dict)
    laws: Mapping[str, Laws] = field(default_factory=dict)


class Series(ABC):
    """One scene on its curves.

    name, title : of the folder, and for people
    scene : as it stands
    models : that are compared
    interval : half-width that is wanted of intervals of 95 %, relative; None of fixed numbers of surfaces
    strata : then numbers of surfaces by the curves that share them, else those of a pilot. Fewer numbers than
        levels leave out the coarsest
    shared : names of the curves that share their surfaces, by a name of them
    """

    name: str
    title: str
    scene: Scene
    models: Models
    interval: float | None
    strata: Mapping[str, Counts]
    shared: ClassVar[Mapping[str, tuple[str, ...]]]

    @property
    @abstractmethod
    def curves(self) -> Mapping[str, Curve]:
        """Curves by name. Raises InvalidInput, Refused."""

    @abstractmethod
    def judge(self, answers: Answers) -> Judged:
        """Findings on the answers, and what shows them."""

    @property
    def wanted(self) -> Iterator[tuple[str, str, tuple[float, ...]]]:
        """Curve, name and speeds of each mean that an interval is wanted of, whatever is claimed."""
        yield from ()

    @property
    def own(self) -> Sequence[SceneTask]:
        """Contacts of the scene as it stands."""
        return ()

    @property
    def doubts(self) -> Sequence[str]:
        """Doubts about the scene and the corners of its curves."""
        return ()

    @property
    def counts(self) -> dict[str, Counts]:
        """Numbers of surfaces of the curves that share them, by model."""
        drawing = [each.name for each in self.models.drawn]
        return {
            name: {model: each.counts[model] for model in drawing if model in each.counts}
            for name, each in self.drawn.items()
        }

    @property
    def folder(self) -> str:
        """Folder of its figures and tables below that of the page."""
        return slug(self.name)

    def path(self, curve: str) -> str:
        """Path of a curve in the tree of all answers."""
        return f"{self.folder}/{curve}"

    def answers(self, tree: xarray.DataTree) -> Answers:
        """Its part of all answers."""
        below = (tree[self.folder] if self.folder else tree).children
        return Answers({name: below[name].to_dataset(inherit=False) for name in self.curves}, self.models)

    @property
    def sampled(self) -> bool:
        """Whether its numbers of surfaces follow from a wanted interval."""
        return self.interval is not None and self.scene.roughness is not None

    def place(self, curve: str) -> str:
        """Name of a curve among those of all series."""
        return f"{self.name}/{curve}"

    @cached_property
    def drawn(self) -> Mapping[str, DrawnSurfaces]:
        """Surfaces of the curves that share them, by the name of these."""
        found = {
            name: [self.curves[each] for each in curves if each in self.curves]
            for name, curves in self.shared.items()
        }
        return {name: DrawnSurfaces.of(curves) for name, curves in found.items() if curves}

    def told(self, found: Finding) -> Finding:
        """A finding with what would decide it."""
        words = {each.name: each.draws for each in self.models}
        for name, curves in self.shared.items():
            if name in self.drawn and found.curve in (*map(self.place, curves), self.family):
                return self.drawn[name].told(found, words)
        return found

    @property
    def family(self) -> str:
        """Place of findings on it together with others; empty without any."""
        return ""

    def more(self, answers: Answers, findings: Sequence[Finding], growth: float) -> dict[str, Counts]:
        """Numbers of surfaces that undecided claims and wide intervals ask for, of the curves that share them."""
        made: dict[str, Counts] = {}
        for name, drawn in self.drawn.items():
            places = (*map(self.place, self.shared[name]), self.family)
            own = [each for each in findings if each.curve in places]
            means = [each for *_, found in self._means(name, answers, self.counts[name]) for each in found]
            counts = drawn.more([*own, *means], self.interval or inf, growth)
            made[name] = {model: counts[model] for model in self.counts[name]}
        return made

    def unreached(self, answers: Answers) -> Iterator[str]:
        """Sentences on means whose intervals are wider than wanted."""
        for name in self.drawn:
            for model, mean_name, found in self._means(name, answers, self.models.labels):
                if why := unreached(found, self.interval or inf):
                    yield f"{self.name}: the {WORDS[mean_name]} in {self.models.labels[model]} {why}."

    def _means(self, shared, answers, models):
        """Means that an interval is wanted of, on curves that share their surfaces: model, name and findings."""
        wanted = [each for each in self.wanted if each[0] in self.shared[shared] and each[0] in self.curves]
        for model in (each.name for each in self.models.drawn if each.name in models):
            for curve, mean_name, speeds in wanted:
                if model in self.curves[curve].levels:
                    found = answers.interval(curve, model, *MEANS[mean_name])
                    asked = found.at(np.isin(answers.two_levels(curve, model)["speed"], speeds))
                    yield model, mean_name, means_of(model, asked)

    def finding(
        self,
        claim: Claim,
        found: Estimated,
        at: tuple[int, ...],
        curve: str,
        place: str = "",
        less: float = 0.0,
        regime: str = "",
    ) -> Finding:
        """Finding of a claim on one of some numbers of a curve. less : what is taken off them"""
        one = found.at(at)
        where = f"{self.name}, {place}" if place else self.name
        one = replace(one, value=one.value - less)
        return Finding.of(claim, one, where=where, drawn=one.drawn, regime=regime, curve=self.place(curve))

    def ratios(
        self,
        claim: Claim,
        answers: Answers,
        curve: str,
        mean_name: str,
        places: Places,
        less=0.0,
    ) -> list[tuple[Model, tuple[int, int], Finding]]:
        """Findings on a mean of each model over that of the reference, at some places of a curve."""
        rows, reference = [], self.models.reference
        for model in answers.judged(curve, WORDS[mean_name]):
            found = answers.compared(curve, (model.name, reference), ratio_of(mean_name, model.name, reference))
            own = said_of(claim, beside := self.models.beside(model.name))
            rows += [
                (model, at, replace(self.finding(own, found, at, curve, words, less), dimension=beside))
                for at, words in places.items()
            ]
        return rows

    def touched(self, answers: Answers, curve: str, model: str) -> Iterator[tuple[tuple[int, int], float]]:
        """Places at rest, each with its depth, at which a model touches."""
        depths = answers.curves[curve]["depth"].values.tolist()
        seen = touches(answers.two_levels(curve, model))[0]
        yield from (((0, k), depth) for k, depth in enumerate(depths) if seen[k])


def ratio_of(mean_name: str, *models: str):
    """Measure of the mean of a model, or of that of one over that of another, at every place."""

    def measure(sample):
        values = [mean(sample[model], *MEANS[mean_name]) for model in models]
        return values[0] / values[1] if len(values) > 1 else values[0]

    return measure


def on_levels_alike(
    curves: Mapping[str, Curve],
    models: Models,
    strata: Counts,
    most: int = len(LEVELS),
    least: Mapping[str, int] = {},
) -> dict[str, Curve]:
    """Curves that share their surfaces, on all levels that hold them.

    strata : numbers of surfaces on each level, by model; those of a pilot where absent. Fewer numbers than levels
        leave out the coarsest
    most : levels
    least : numbers of surfaces of a pilot on the coarsest level, by model, where more than usual are wanted
    """
    first, *_ = curves.values()
    found = {name: own for name, own in levels(models, [*curves.values()], most).items() if name in first.levels}
    pilots = {
        each.name: pilot(len(found[each.name]), least.get(each.name, 0))
        for each in models.drawn
        if each.name in found
    }
    drawn = {name: strata.get(name, counts) for name, counts in pilots.items()}
    kept = {name: dict(list(each.items())[: len(drawn.get(name, each))]) for name, each in found.items()}
    return {name: replace(each, levels=kept, draws={**each.draws, **drawn}) for name, each in curves.items()}


def pilot(count: int, least: int = PILOT) -> tuple[int, ...]:
    """Numbers of surfaces of each stratum before anything is known of their scatter.

    count : levels
    least : of the coarsest, in whose proportion the others are then more
    """
    finer = (FINEST,) * (count > 2) + (DIFFERENCES,) * (count - 1)
    scale = max(1.0, least / PILOT)
    return tuple(ceil(each * scale) for each in (*finer[: count - 1], PILOT))
