"""Claims on one scene in one and in three dimensions, and their findings on its curves."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from math import isfinite, nan

import numpy as np
import xarray
from pandas import DataFrame

from ...library.case import Case
from ...models.table import FORCE, FRICTION, Model, Models
from ...solving.parameter_grid import COARSE, FINE
from ...statistics import eq23, means
from ...statistics.collapse import Collapse, collapse
from ...statistics.finding import HALVED, UNKNOWN, Claim, Finding, said_of
from ...statistics.frictioncurves import SimulatedCurves
from ...statistics.jackknife import DrawSet, mean
from ...statistics.means import Compared, compared
from ...statistics.multilevel import MEANS, WORDS, DrawnSurfaces, pooled
from ..claims.claims import CLAIMS, TOLERANCE
from ..claims.points import stacked
from ..theory import THEORY
from .curves import (
    CURVES,
    LOAD,
    OWN,
    REST,
    ROUGH_DEPTH,
    SLIDING,
    SMOOTH_DEPTH,
    SMOOTH_SPEED,
    SPEED,
    predicted_exponent,
    scaled_speed,
)

SLOW = CLAIMS["friction.ratio.smooth-slow"]
# Of the scene as it stands, by the name of the mean, see `sampling.MEANS`.
OWN_RATIOS = {
    "friction_coefficient": CLAIMS["friction.ratio.own"],
    "depth_reached": CLAIMS["own.depth"],
    "normal_force": CLAIMS["own.force"],
}
ROUGH_FORCE, SMOOTH_FORCE = CLAIMS["force.ratio.rough"], CLAIMS["force.ratio.smooth"]
# Numbers that tell how far those above can be trusted.
AT_SPEEDS, SPREAD = CLAIMS["friction.ratio.speed"], CLAIMS["friction.spread"]
CLOSED_FORM, GRID = CLAIMS["force.closed-form"], CLAIMS["grid.change"]


def own_means(case: Case) -> Iterator[str]:
    """Means of the scene's own contact that tell what it is: friction, and what is not prescribed."""
    if case.slides and case.motion.speed > 0:
        yield "friction_coefficient"
    yield "normal_force" if case.motion.load is None else "depth_reached"


def draws_of(found: Finding) -> str:
    """Name of the draws that a finding stands on."""
    return REST if found.claim.id == ROUGH_FORCE.id else SLIDING


def _slow(model: Model, reference: Model) -> Claim:
    """What slow friction of the smooth body is over that of the reference: 2 of one dimension over three."""
    factor = model.slow_factor / reference.slow_factor
    if factor == SLOW.expected:
        return said_of(SLOW, f"{model.label}/{reference.label}")
    words = "the same in" if factor == 1.0 else "half as high in"
    return replace(
        SLOW,
        sentence=f"Slow friction of the smooth body is {words} {model.label} as in {reference.label}",
        expected=factor,
        tolerance=factor * TOLERANCE,
        meaning=f"Friction in {model.label} over {reference.label} at the lowest speed; it tends to {factor:g}.",
    )


@dataclass(frozen=True)
class Shifted:
    """Curves of friction against load of one solver, shifted onto one.

    collapse : on the fine grid; findings : on it
    """

    solver: str
    collapse: Collapse
    findings: tuple[Finding, ...]


@dataclass(frozen=True)
class CaseFindings:
    """Findings, curves and points of one case.

    name : of the case; folder : of its figures
    answers : by "curve/model"
    draws : of the curves that share them, REST and SLIDING
    """

    name: str
    folder: str
    case: Case
    models: Models
    answers: Mapping[str, xarray.Dataset]
    draws: Mapping[str, DrawnSurfaces]

    @cached_property
    def findings(self) -> list[Finding]:
        """Findings on claims, then numbers that tell how far these can be trusted."""
        words = {each.name: each.draws for each in self.models}
        drawn = [(self.draws.get(draws_of(each)), each) for each in self._found]
        return [each if draws is None else draws.told(each, words) for draws, each in drawn]

    @cached_property
    def datasets(self) -> Mapping[str, xarray.Dataset]:
        """Draws of two grids, by "curve/model"."""
        return {place: pooled(each) for place, each in self.answers.items()}

    def own(self, mean: str) -> dict[str, tuple[float, ...]]:
        """A mean of the scene as it stands, of each model and over that of the reference, with its interval.

        mean : see `sampling.MEANS`
        """
        points = self.points[self.points["curve"] == OWN].set_index("solver")
        ends = [f"{mean}_{end}" for end in ("mean", "low", "high")]
        found = {each.label: tuple(points.loc[each.name, ends]) for each in self._claiming(OWN, WORDS[mean])}
        return found | {
            self.models.beside(model.name): (each.value, *each.interval)
            for name, model, each in self.own_ratios
            if name == mean
        }

    @property
    def _found(self):
        return [
            *self._slow(),
            *(found for _, _, found in self.own_ratios),
            *(found for _, _, found in self.forces(ROUGH_FORCE)),
            *(found for _, _, found in self.forces(SMOOTH_FORCE)),
            *(each for shifted in self.shifted for each in shifted.findings),
            *self._unshifted(),
            *(found for _, _, found in self.at_speeds),
            *self._closed_form(),
            *self._grid(),
            *self._spread(),
        ]

    def _slow(self):
        """Friction of the smooth body at its lowest speed."""
        if speeds := self._speeds(SMOOTH_SPEED):
            lowest = int(np.argmin(speeds))
            regime = f"v τ / a = {scaled_speed(self.case, speeds[lowest]):.2g}"
            for model in self._judged(SMOOTH_SPEED, FRICTION):
                told = {"plot": "smooth-limit", "regime": regime, "dimension": self.models.beside(model.name)}
                found = self._friction(SMOOTH_SPEED, model.name)
                yield self._finding(_slow(model, self.models[self.models.reference]), found, (lowest, 0), **told)

    @cached_property
    def own_ratios(self) -> list[tuple[str, Model, Finding]]:
        """Means of the scene as it stands, of each model over that of the reference."""
        rows = []
        for name in own_means(self.case):
            plot = "friction-speed" if WORDS[name] == FRICTION else "force-depth"
            for model in self._judged(OWN, WORDS[name]):
                beside = self.models.beside(model.name)
                found = self._ratio(OWN, (model.name, self.models.reference), *MEANS[name])
                claim = said_of(OWN_RATIOS[name], beside)
                rows.append((name, model, self._finding(claim, found, (0, 0), plot=plot, dimension=beside)))
        return rows

    @cached_property
    def at_speeds(self) -> list[tuple[str, float, Finding]]:
        """Friction of each model over that of the reference at every speed."""
        return self.ratios(SPEED)

    def ratios(self, curve: str) -> list[tuple[str, float, Finding]]:
        """Friction of each model over that of the reference at every speed of a curve."""
        rows = []
        speeds = self._speeds(curve)
        for model in self._judged(curve, FRICTION):
            beside, found = self.models.beside(model.name), self._friction(curve, model.name)
            claim = said_of(AT_SPEEDS, beside)
            rows += [
                (model.name, speed, self._at_speed(claim, found, k, speed, beside))
                for k, speed in enumerate(speeds)
            ]
        return rows

    def forces(self, claim: Claim) -> list[tuple[str, float, Finding]]:
        """Force of each model over that of the reference less one, at every depth at which that one touches."""
        curve, reference = ROUGH_DEPTH if claim is ROUGH_FORCE else SMOOTH_DEPTH, self.models.reference
        rows = []
        for model in self._judged(curve, FORCE):
            beside = self.models.beside(model.name)
            found = self._deviations(said_of(claim, beside), curve, model.name, reference, beside)
            rows += [(model.name, depth, each) for depth, each in found.items()]
        return rows

    def _closed_form(self):
        """Force on the smooth body over the closed form, less one."""
        if f"{SMOOTH_DEPTH}/exact" in self.datasets:
            for model in self._claiming(SMOOTH_DEPTH, FORCE):
                yield from self._deviations(CLOSED_FORM, SMOOTH_DEPTH, model.name, "exact", model.label).values()

    def _grid(self):
        """Change of the scene's own answer from half the points to all."""
        first = next(own_means(self.case))
        for model in self._claiming(OWN, WORDS[first]):
            if model.has_grid:
                number = self._ratio(OWN, (model.name,), *MEANS[first])
                value = float((number.grid / np.abs(number.value))[0, 0])
                yield Finding(GRID, value, where=self.name, drawn=number.drawn, dimension=model.label)

    def _spread(self):
        """Spread of both estimates of friction in three dimensions, at every speed."""
        speeds = self._speeds(SPEED)
        for model in self._claiming(SPEED, FRICTION):
            solver, dimension = model.name, model.label
            if "friction_spread" not in self.datasets[f"{SPEED}/{solver}"]:
                continue
            found = self._ratio(SPEED, (solver,), "friction_spread", size=True)
            known = [(k, speed) for k, speed in enumerate(speeds) if isfinite(found.value[k, 0])]
            yield from (
                replace(self._at_speed(SPREAD, found, k, speed, dimension), size=True) for k, speed in known
            )

    @cached_property
    def shifted(self) -> list[Shifted]:
        """Curves of friction against load shifted onto one, of each solver where there are points enough."""
        found = []
        for model in self._claiming(LOAD, FRICTION):
            solver, dimension = model.name, model.label
            fine, coarse = (self._collapse(solver, grid) for grid in (FINE, COARSE))
            if fine is None:
                continue
            exponent = predicted_exponent(self.case)
            shifts = exponent * np.log(fine.speeds / fine.speeds[fine.speeds.size // 2])
            told = eq23.findings(
                fine,
                coarse,
                dimension,
                shifts,
                exponent,
                where=self.name,
                draws=0 if self.case.roughness is None else fine.data.surfaces,
                plots=(f"{self.folder}/collapse", f"{self.folder}/collapse"),
                horizontal=coarse is None,
            )
            if coarse is None:  # for want of an answer: data without a grid are exact, this is not
                told = (replace(each, grid=nan, grid_method=UNKNOWN) for each in told)
            found.append(Shifted(solver, fine, tuple(told)))
        return found

    def _unshifted(self):
        """Curves that cannot be shifted for want of answers."""
        asked = self.datasets.get(f"{LOAD}/{self.models.reference}")
        if asked is not None and eq23.shiftable(asked.sizes["speed"], asked.sizes[means.pressed(asked)]):
            known = {each.solver for each in self.shifted}
            yield from (
                eq23.too_few(each.label, self.name)
                for each in self._claiming(LOAD, FRICTION)
                if each.name not in known
            )

    @cached_property
    def points(self) -> DataFrame:
        """Every point of every curve on the fine grid, a row each."""
        frames = {}
        for curve, solver in product(CURVES, dict.fromkeys((*self._labels, THEORY.name, "exact"))):
            place = f"{curve}/{solver}"
            if (dataset := self.answers.get(place)) is not None:
                rough = "surface" in dataset.dims or (self.case.roughness and "smooth" not in curve)
                frames[curve, solver, "rough" if rough else "smooth"] = means.means(
                    dataset, self.datasets[f"{curve}/{solver}"]
                )
        every = stacked(frames, "curve", "solver", "body")
        first = [name for name in ("curve", "solver", "body", "points", "speed", "load", "depth") if name in every]
        return every[[*first, *(name for name in every if name not in first)]]

    @cached_property
    def failures(self) -> DataFrame:
        """Every solve that failed, with its reason."""
        found = {tuple(place.split("/")): means.failures(dataset) for place, dataset in self.answers.items()}
        return stacked(found, "curve", "solver")

    def _speeds(self, curve):
        """Speeds of a curve; none if it was not asked for."""
        asked = self.datasets.get(f"{curve}/{self.models.reference}")
        return [] if asked is None else asked["speed"].values.tolist()

    @property
    def _labels(self):
        return self.models.labels

    def _claiming(self, curve, quantity) -> list[Model]:
        """Models of a curve with a claim on a quantity."""
        return [
            each for each in self.models if quantity in each.answers and f"{curve}/{each.name}" in self.datasets
        ]

    def _judged(self, curve, quantity) -> list[Model]:
        """Models of a curve that are compared with the reference; none where the reference has no answer."""
        found = {each.name: each for each in self._claiming(curve, quantity)}
        reference = found.pop(self.models.reference, None)
        return list(found.values()) if reference else []

    def _friction(self, curve, model) -> Compared:
        return self._ratio(curve, (model, self.models.reference), *means.FRICTION)

    def _ratio(self, curve, solvers, over, under=None, size=False) -> Compared:
        """A mean, or a ratio of two means, of one solver, or of one over another, at every point of a curve."""
        names = [over] if under is None else [over, under]
        datasets = {solver: self.datasets[f"{curve}/{solver}"][names] for solver in solvers}

        def ratio(sample):
            values = [mean(sample[solver], over, under) for solver in solvers]
            return values[0] / values[1] if len(values) > 1 else values[0]

        # Of a model without points there is no other grid, and its answers have no error of it.
        alone = {name for name in datasets if name in self._labels and not self.models[name].has_grid}
        coarser = {name: FINE if name in alone else COARSE for name in datasets}
        on_both = all(grid in datasets[name]["level"].values for name, grid in coarser.items())
        fine = DrawSet({name: each.sel(level=FINE) for name, each in datasets.items()})
        coarse = {name: each.sel(level=coarser[name]) for name, each in datasets.items()} if on_both else None
        return compared(ratio, fine, coarse, size)

    def _deviations(self, claim, curve, above, below, dimension="") -> dict[float, Finding]:
        """Force of one over that of another less one, by depth."""
        reference = self.datasets[f"{curve}/{below}"]
        touched, depths = means.touches(reference)[0], reference["depth"].values.tolist()
        found = self._ratio(curve, (above, below), "normal_force")
        place = {"plot": "force-depth", "less": 1.0, "dimension": dimension}
        return {
            depth: self._finding(claim, found, (0, k), f"{depth * 1e6:.3g} µm", **place)
            for k, depth in enumerate(depths)
            if touched[k]
        }

    def _at_speed(self, claim, found, place, speed, dimension):
        where = f"v = {speed:.3g} m/s"
        return self._finding(claim, found, (place, 0), where, "friction-speed", dimension=dimension)

    def _finding(self, claim, found, at, place="", plot="", less=0.0, regime="", dimension="") -> Finding:
        value, low, high, grid = (float(each[at]) for each in (found.value, found.low, found.high, found.grid))
        parts = {source: float(each[at]) for source, each in found.parts.items()}
        return Finding(
            claim=claim,
            value=value - less,
            scatter=(low - less, high - less),
            grid=grid,
            grid_method=HALVED if isfinite(grid) else UNKNOWN,
            where=f"{self.name}, {place}" if place else self.name,
            drawn=found.drawn,
            regime=regime,
            plot=f"{self.folder}/{plot}" if plot else "",
            dimension=dimension,
            parts=parts,
        )

    def _collapse(self, solver, grid) -> Collapse | None:
        """None with too few speeds or points."""
        dataset = self.datasets.get(f"{LOAD}/{solver}")
        if dataset is None or grid not in dataset["level"].values:
            return None
        try:
            return collapse(SimulatedCurves.of(dataset.sel(level=grid)))
        except ValueError:
            return None
