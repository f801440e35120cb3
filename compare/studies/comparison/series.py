"""Series: one scene with the curves that are solved of it, what is judged on them, and its surfaces."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import ceil, inf, nan
from typing import TYPE_CHECKING, Any, ClassVar, TypeAlias

import numpy as np

from scene import Scene, Solver

from ...models.table import DEPTH, FORCE, FRICTION, NONE, Model, Models
from ...solving.curve import COARSE, FINE, LEVELS, Curve, levels
from ...solving.folders import slug
from ...solving.task import SceneTask
from ...statistics import eq23
from ...statistics.collapse import Collapse, collapse
from ...statistics.finding import Claim, Finding, relabelled
from ...statistics.frictioncurves import SimulatedCurves
from ...statistics.jackknife import mean, measured
from ...statistics.multilevel import MEANS, WORDS, DrawnSurfaces, means_of, unreached
from .answers import Answers
from .claims import claim
from .laws import Laws, laws
from .measures import Here, Row

if TYPE_CHECKING:
    import xarray

Counts = Mapping[str, tuple[int, ...]]  # numbers of surfaces on each level, by model
Wanted: TypeAlias = Iterator[tuple[str, str, tuple[float, ...]]]  # curve, name and speeds of means
Places = Mapping[tuple[int, int], str]  # places of speed and value on a curve, in words
# Surfaces of a pilot on the coarsest level, of each difference of levels, and of the difference between the finest
# levels where there are several, which scatters least and costs most.
PILOT, DIFFERENCES, FINEST = 32, 4, 3


@dataclass(frozen=True)
class Judged:
    """What becomes of the claims on a series.

    series, answers : that were judged
    findings : one by one
    collapses : what shifts of its curves achieve on the fine level, by model
    laws : of the paper at the points of its curve of friction against load, by model
    """

    series: Any
    answers: Answers
    findings: Sequence[Finding] = ()
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
    rows : of claims that are judged on it
    by_speed, by_load : names of the curves of friction against speed, and against load, which is shifted onto one;
        empty where there is none
    bodies : rough or smooth, by the name of a curve of force against depth
    """

    name: str
    title: str
    scene: Scene
    models: Models
    interval: float | None
    strata: Mapping[str, Counts]
    shared: ClassVar[Mapping[str, tuple[str, ...]]]
    rows: ClassVar[Sequence[Row]]
    by_speed: ClassVar[str]
    by_load: ClassVar[str] = ""
    bodies: ClassVar[Mapping[str, str]] = {}

    @property
    @abstractmethod
    def curves(self) -> Mapping[str, Curve]:
        """Curves by name. Raises InvalidInput, Refused."""

    @property
    def wanted(self) -> Wanted:
        """Curve, name and speeds of each mean that an interval is wanted of, whatever is claimed."""
        yield from ()

    @property
    def own(self) -> Sequence[SceneTask]:
        """Contacts of the scene as it stands."""
        return ()

    @property
    def remarks(self) -> Sequence[str]:
        """Sentences that its file has for people."""
        return ()

    @property
    def doubts(self) -> Sequence[str]:
        """Doubts about the scene and the corners of its curves."""
        return ()

    @property
    def prescribed(self) -> str:
        """Name of what presses: "load", "depth", or "gap"."""
        return self.scene.motion.pressed_by

    @property
    def pressed(self) -> str:
        """Quantity that answers the pressing: the depth under loads, the force at depths."""
        return FORCE if self.prescribed in ("depth", "gap") else DEPTH

    @property
    def counts(self) -> dict[str, Counts]:
        """Numbers of surfaces of the curves that share them, by model."""
        return {name: dict(each.counts) for name, each in self.drawn.items()}

    @property
    def folder(self) -> str:
        """Folder of its figures and tables below the folder of the page."""
        return slug(self.name)

    def path(self, curve: str) -> str:
        """Path of a curve in the tree of all answers, or of a table or figure below the page."""
        return f"{self.folder}/{curve}" if self.folder else curve

    def answers(self, tree: xarray.DataTree) -> Answers:
        """Its part of all answers."""
        below = (tree[self.folder] if self.folder else tree).children
        known = {name: below[name].to_dataset(inherit=False) for name in self.curves if name in below}
        return Answers(known, self.models)

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

    @property
    def label(self) -> str:
        """Its name where its findings stand with others."""
        return self.name

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

    def with_remedy(self, found: Finding) -> Finding:
        """The finding, with advice on what would decide it."""
        name = self.behind(found)
        words = {each.name: each.draws for each in self.models}
        return found if name is None else self.drawn[name].with_remedy(found, words)

    def more(self, answers: Answers, findings: Sequence[Finding]) -> dict[str, Counts]:
        """Numbers of surfaces that undecided claims and wide intervals ask for, of the curves that share them."""
        made: dict[str, Counts] = {}
        for name, drawn in self.drawn.items():
            own = [each for each in findings if self.behind(each) == name]
            own += [each for *_, found in self._means(name, answers) for each in found]
            made[name] = drawn.more(own, self.interval or inf)
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

    def judge(self, answers: Answers) -> Judged:
        """Findings on the answers, and what shows them: a finding a claim, model and place."""
        rubbing = answers.claiming(self.by_load, FRICTION)
        found = {each.name: laws(self.curves[self.by_load], answers(self.by_load, each.name)) for each in rubbing}
        ruled = {name: own for name, own in found.items() if own is not None}
        collapses, findings = dict[str, Collapse](), list[Finding]()
        for model in rubbing:
            fine, own = self._shifted(answers, model, ruled.get(model.name))
            collapses |= {model.name: fine} if fine else {}
            findings += own
        for row in self.rows:
            findings += self._judged(answers, row, ruled)
        return Judged(self, answers, findings, collapses, ruled)

    def _judged(self, answers: Answers, row: Row, ruled: Mapping[str, Laws]) -> Iterator[Finding]:
        """Findings of a row of claims, on each model with a claim on its quantity."""
        quantity, reference = row.quantity or self.pressed, self.models.reference
        for model in (answers.judged if row.pair else answers.claiming)(row.curve, quantity):
            models = (model.name, reference) if row.pair else (model.name,)
            dimension = self.models.pair_label(model.name) if row.pair else model.label
            here = Here(self, model, answers, ruled.get(models[-1]))

            def asked(ending="", here=here, models=models, dimension=dimension):
                found = claim(row.id.format(quantity=quantity) + ending, row.expected(here))
                found = relabelled(found, dimension) if row.pair else found
                measure = lambda sample: row.measure(here, *(sample[each] for each in models))  # noqa: E731
                return replace(found, dimension=dimension, measure=measure)

            if row.each and (places := {at: words for words, at in row.where(here)}):
                yield from self.compared(answers, asked(), row.curve, models, places, row.size)
            for ending, at in () if row.each else row.where(here):
                there = replace(here, place=at)
                fine, coarse = (answers.sample(level, row.curve, *models) for level in (FINE, COARSE))
                found = measured(asked(ending, there), fine, coarse, self.name, there.regime)
                yield replace(found, curve=self.place(row.curve))

    def compared(
        self, answers: Answers, claim: Claim, curve: str, models: Sequence[str], places: Places, size: bool = False
    ) -> Iterator[Finding]:
        """Findings of a claim at places of a curve; the claim measures one or more models at all of them."""
        found = answers.compared(curve, tuple(models), claim.measure, size)
        for at, words in places.items():
            where = ", ".join(filter(None, (self.label, words)))
            yield Finding.of(claim, found.at(at), where=where, drawn=found.drawn, curve=self.place(curve))

    def _shifted(self, answers: Answers, model: Model, own: Laws | None) -> tuple[Collapse | None, list[Finding]]:
        """Findings on curves of friction that are shifted onto one, and the collapse, where points are enough."""
        name, curve = self.by_load, self.curves[self.by_load]
        speeds = [speed for speed in curve.speeds if speed > 0]
        drawn = sum(map(len, curve.strata(model.name))) if curve.random else 0
        place: dict[str, Any] = {"where": self.name, "draws": drawn, "regime": own.words() if own else ""}
        known = answers.halved(name, model.name)
        every = (answers(name, model.name, level) for level in ((FINE, COARSE) if known else (FINE,)))
        try:
            fine, *coarse = [collapse(SimulatedCurves.of(each.sel(speed=each["speed"] > 0))) for each in every]
        except ValueError:
            enough = eq23.shiftable(len(speeds), len(curve.values))
            return None, [eq23.too_few(model.label, **place)] if enough else []
        shifts = dict(zip(speeds, own.shifts.tolist(), strict=True)) if own else None
        exponent, half = own.exponent if own else nan, coarse[0] if known else None
        findings = eq23.findings(fine, half, model.label, shifts, exponent, horizontal=not known, **place)
        # Data without a grid are exact, a surface that has no other grid is not.
        unknown: dict[str, Any] = {} if known else {"grid": nan}
        return fine, [replace(each, curve=self.place(name), **unknown) for each in findings]


def ratio_of(mean_name: str, *models: str):
    """Measure at every place: the mean of a model, or the ratio of the means of two models."""

    def measure(sample):
        values = [mean(sample[model], *MEANS[mean_name]) for model in models]
        return values[0] / values[1] if len(values) > 1 else values[0]

    return measure


def pilot(count: int, least: int = PILOT) -> tuple[int, ...]:
    """Numbers of surfaces of each stratum before anything is known of their scatter.

    count : levels
    least : of the coarsest, in whose proportion the others are then more
    """
    finer = (FINEST,) * (count > 2) + (DIFFERENCES,) * (count - 1)
    scale = max(1.0, least / PILOT)
    return tuple(ceil(each * scale) for each in (*finer[: count - 1], PILOT))
