"""Series: one scene with the curves that are solved of it, what is judged on them, and its surfaces."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import ceil, inf, nan
from typing import Any, ClassVar

import numpy as np
import xarray

from scene import Scene, Solver

from ...library.describe import slug
from ...models.table import NONE, Model, Models
from ...solving.curve import COARSE, FINE, LEVELS, Curve, levels
from ...solving.task import SceneTask
from ...statistics import eq23
from ...statistics.collapse import Collapse, collapse
from ...statistics.finding import Claim, Finding, said_of
from ...statistics.frictioncurves import SimulatedCurves
from ...statistics.jackknife import mean, measured
from ...statistics.means import touches
from ...statistics.multilevel import MEANS, WORDS, DrawnSurfaces, means_of, unreached
from .answers import Answers
from .claims import CLAIMS, claim
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
    def every_model(self) -> Models:
        """Models that are asked for, those among them that claim nothing here."""
        return self.models

    @property
    def remarks(self) -> Sequence[str]:
        """Sentences that its file has for people."""
        return ()

    @property
    def doubts(self) -> Sequence[str]:
        """Doubts about the scene and the corners of its curves."""
        return ()

    @property
    def counts(self) -> dict[str, Counts]:
        """Numbers of surfaces of the curves that share them, by model."""
        return {name: dict(each.counts) for name, each in self.drawn.items()}

    @property
    def folder(self) -> str:
        """Folder of its figures and tables below that of the page."""
        return slug(self.name)

    def path(self, curve: str) -> str:
        """Path of a curve in the tree of all answers, or of a table or figure below the page."""
        return f"{self.folder}/{curve}" if self.folder else curve

    def answers(self, tree: xarray.DataTree) -> Answers:
        """Its part of all answers."""
        below = (tree[self.folder] if self.folder else tree).children
        return Answers({name: below[name].to_dataset(inherit=False) for name in self.curves}, self.models)

    @property
    def sampled(self) -> bool:
        """Whether its numbers of surfaces follow from a wanted interval."""
        return self.interval is not None and hasattr(self.scene.roughness, "seed")

    def with_strata(
        self, curves: Mapping[str, Curve], most: int = len(LEVELS), least: Mapping[str, int] = {}
    ) -> dict[str, Curve]:
        """Curves with as many surfaces as is asked for, those that share them on all levels that hold them.

        most : levels
        least : numbers of surfaces of a pilot on the coarsest level, by model, where more than usual are wanted
        """
        made = dict(curves)
        for shared, names in self.shared.items() if self.sampled else ():
            own = {name: curves[name] for name in names if name in curves and not curves[name].over_time}
            known, strata = next(iter(own.values()), None), self.strata.get(shared, {})
            kept: dict[str, Mapping[str, Solver]] = {}
            draws: dict[str, tuple[int, ...]] = {}
            for name, each in levels(self.models, [*own.values()], most).items() if known else ():
                if name in known.levels:
                    if self.models[name].draws != NONE:
                        draws[name] = strata.get(name) or pilot(len(each), least.get(name, 0))
                    kept[name] = dict(list(each.items())[: len(draws.get(name, each))])
            made |= {name: replace(each, levels=kept, draws={**each.draws, **draws}) for name, each in own.items()}
        return made

    def place(self, curve: str) -> str:
        """Name of a curve among those of all series."""
        return f"{self.name}/{curve}"

    @cached_property
    def drawn(self) -> Mapping[str, DrawnSurfaces]:
        """Surfaces of the curves that share them, by the name of these, of models that draw any."""
        drawing, found = [each.name for each in self.models.drawn], {}
        for shared, names in self.shared.items():
            if own := [self.curves[each] for each in names if each in self.curves]:
                every = DrawnSurfaces.of(own)
                counts = {name: count for name, count in every.counts.items() if name in drawing}
                found[shared] = replace(every, counts=counts)
        return found

    @property
    def family(self) -> str:
        """Place of findings on it together with others; empty without any."""
        return ""

    def behind(self, found: Finding) -> str | None:
        """Name of the curves whose surfaces are behind a finding; None where there are none."""
        places = {name: (*map(self.place, curves), self.family) for name, curves in self.shared.items()}
        return next((name for name in self.drawn if found.curve in places[name]), None)

    def told(self, found: Finding) -> Finding:
        """A finding with what would decide it."""
        name = self.behind(found)
        words = {each.name: each.draws for each in self.models}
        return found if name is None else self.drawn[name].told(found, words)

    def more(self, answers: Answers, findings: Sequence[Finding], growth: float) -> dict[str, Counts]:
        """Numbers of surfaces that undecided claims and wide intervals ask for, of the curves that share them."""
        made: dict[str, Counts] = {}
        interval = self.interval or inf
        for name, drawn in self.drawn.items():
            own = [each for each in findings if self.behind(each) == name]
            own += [each for *_, found in self._means(name, answers) for each in found]
            made[name] = drawn.more(own, interval, growth)
        return made

    def unreached(self, answers: Answers) -> Iterator[str]:
        """Sentences on means whose intervals are wider than wanted."""
        for name in self.drawn:
            for model, mean_name, found in self._means(name, answers):
                if why := unreached(found, self.interval or inf):
                    yield f"{self.name}: the {WORDS[mean_name]} in {self.models.labels[model]} {why}."

    def _means(self, shared, answers):
        """Model, name and findings of each mean that an interval is wanted of, on curves that share surfaces."""
        for model in self.drawn[shared].counts:
            for curve, mean_name, speeds in self.wanted:
                if curve in self.shared[shared] and model in self.curves[curve].levels:
                    found = answers.interval(curve, model, *MEANS[mean_name])
                    asked = found.at(np.isin(answers.two_levels(curve, model)["speed"], speeds))
                    yield model, mean_name, means_of(model, asked)

    def compared(
        self,
        answers: Answers,
        claim: Claim,
        curve: str,
        models: Sequence[str],
        measure,
        places: Places,
        **told: Any,
    ) -> Iterator[Finding]:
        """Findings of a claim on numbers of one or more models at some places of a curve; told : other fields"""
        found = answers.compared(curve, tuple(models), measure, told.pop("size", False))
        told |= {"drawn": found.drawn, "curve": self.place(curve)}
        for at, words in places.items():
            yield Finding.of(claim, found.at(at), where=", ".join(filter(None, (self.name, words))), **told)

    def ratios(
        self,
        name: str,
        answers: Answers,
        curve: str,
        mean_name: str,
        places: Places,
        less: float = 0.0,
        **told: Any,
    ) -> Iterator[Finding]:
        """Findings on a mean of each model over that of the reference, less a number, at places of a curve."""
        for model in answers.judged(curve, WORDS[mean_name]):
            both, beside = (model.name, self.models.reference), self.models.beside(model.name)
            own, over = said_of(CLAIMS[name], beside), ratio_of(mean_name, *both, less=less)
            yield from self.compared(answers, own, curve, both, over, places, dimension=beside, **told)

    def measured(
        self,
        answers: Answers,
        name: str,
        curve: str,
        models: Sequence[str],
        measure: Callable[..., Any],
        expected: float | None = None,
        regime: str = "",
    ) -> Finding:
        """Finding of a claim on a whole curve, of one model or of two that are compared.

        measure : of their answers; a number, or an array of which the root mean square counts
        """
        pair = len(models) > 1
        beside = self.models.beside(models[0]) if pair else self.models.labels[models[0]]
        asked = claim(name, lambda sample: measure(*(sample[each] for each in models)), beside, expected)
        fine, coarse = (answers.sample(level, curve, *models) for level in (FINE, COARSE))
        found = measured(said_of(asked, beside) if pair else asked, fine, coarse, self.name, regime)
        return replace(found, curve=self.place(curve))

    def shifted(
        self,
        answers: Answers,
        curve: str,
        model: Model,
        shifts: Mapping[float, float],
        exponent: float,
        regime: str = "",
    ) -> tuple[Collapse | None, list[Finding]]:
        """Findings on curves of friction that are shifted onto one, and the collapse, where points are enough.

        shifts, exponent : ln p(v) that Eq. 23 predicts by speed, and its exponent; NaN where it is no power
        """
        own = self.curves[curve]
        drawn = sum(map(len, own.strata(model.name))) if own.random else 0
        place: dict[str, Any] = {"where": self.name, "draws": drawn, "regime": regime}
        known = answers.halved(curve, model.name)
        every = (answers(curve, model.name, level) for level in ((FINE, COARSE) if known else (FINE,)))
        try:
            fine, *coarse = [collapse(SimulatedCurves.of(each.sel(speed=each["speed"] > 0))) for each in every]
        except ValueError:
            enough = eq23.shiftable(len(shifts), len(own.values))
            return None, [eq23.too_few(model.label, **place)] if enough else []
        told = eq23.findings(
            fine, coarse[0] if known else None, model.label, shifts, exponent, horizontal=not known, **place
        )
        # Data without a grid are exact, a surface that has no other grid is not.
        unknown: dict[str, Any] = {} if known else {"grid": nan}
        return fine, [replace(each, curve=self.place(curve), **unknown) for each in told]

    def touched(self, answers: Answers, curve: str, model: str) -> Iterator[tuple[tuple[int, int], float]]:
        """Places at rest, each with its depth, at which a model touches."""
        depths = answers.curves[curve]["depth"].values.tolist()
        seen = touches(answers.two_levels(curve, model))[0]
        yield from (((0, k), depth) for k, depth in enumerate(depths) if seen[k])


def ratio_of(mean_name: str, *models: str, less: float = 0.0):
    """Measure of the mean of a model, or of that of one over that of another, less a number, at every place."""

    def measure(sample):
        values = [mean(sample[model], *MEANS[mean_name]) for model in models]
        return values[0] / values[1] - less if len(values) > 1 else values[0]

    return measure


def pilot(count: int, least: int = PILOT) -> tuple[int, ...]:
    """Numbers of surfaces of each stratum before anything is known of their scatter.

    count : levels
    least : of the coarsest, in whose proportion the others are then more
    """
    finer = (FINEST,) * (count > 2) + (DIFFERENCES,) * (count - 1)
    scale = max(1.0, least / PILOT)
    return tuple(ceil(each * scale) for each in (*finer[: count - 1], PILOT))
