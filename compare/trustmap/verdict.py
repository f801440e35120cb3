"""Correction of the cheap answers to a scene, of 1D and of the law: use one, multiply it, or solve in 3D."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import astuple, dataclass, fields, replace
from math import exp, hypot, isfinite, log, nan, sqrt
from typing import TYPE_CHECKING, Literal

import numpy as np

from scene import Doubt, Indent, Profile, Scene, Slide, SolveError, Spectrum, doubts, notes
from scene.doubt import beyond_linear, beyond_table

from ..solving.words import capital, interval, off, share
from .estimate import Estimate, estimates, of_finer
from .groups import LINE, SPACE, SmoothReference
from .measured import OffTheMap, Place, as_judged, placed, unmeasured
from .model import LAW, MOST_SCATTER, NORMAL, RATIOS, asked_of, lost

if TYPE_CHECKING:
    from pandas import DataFrame

Treatment = Literal["use", "multiply", "solve", "none"]
USE: Treatment = "use"
MULTIPLY: Treatment = "multiply"
SOLVE: Treatment = "solve"
NONE: Treatment = "none"  # of neither solver
# Error of 1D as it is that is no reason to correct it, and half an interval of 95 % that is one to solve in 3D.
SMALL, WIDE = 0.05, 0.15
SHAPED = "Self-affine spectra were measured: the map knows this one by its rms height, slope and curvature."
FITTED = "The surface is one fitted to a measured line: the uncertainty of that fit comes on top."
SOLVED = "the body is smooth, and both solvers answered it"
NOTHING = "One surface says nothing: single surfaces differ by as much as their mean."
# Of a force where the roughness touches in part and is as high as the body is deep.
NARROW = "Here it held 90 of 103 scenes held out, and one half as wide again 96: take that."
# Models by ratio, and what they are called in sentences.
MODELS = {"friction": "MDR", LAW: "FrictionLaw", "depth": "MDR", "force": "MDR"}
CALLED = {"MDR": "1D", "FrictionLaw": "the 3D law"}
SUBJECTS = {name: f"{'friction' if name == LAW else name} by {CALLED[model]}" for name, model in MODELS.items()}
# Share of friction, and radius over the shortest wave at which the reason names them.
MOST, FEW = 0.5, 2.0


@dataclass(frozen=True)
class Correction:
    """Correction of the answer of a cheap model for one quantity.

    model : MDR, whose answer is the mean over profiles, or FrictionLaw
    ratio : its answer over the mean over surfaces in 3D; nan if not known, 1 for FrictionLaw, in whose answer the
        ratio of the bare law is already
    low, high : its interval of 95 %
    surface_low, surface_high : interval of 95 % of its answer over one single surface in 3D; nan where single
        surfaces differ so much that one says nothing, as the reason then tells
    advice : "use" it as it is, "multiply" it by 1 / ratio, "solve" in 3D, or "none" beyond every linear theory and
        beyond the table of an elastomer
    reason : in a sentence or two
    """

    model: str
    ratio: float
    low: float
    high: float
    surface_low: float
    surface_high: float
    advice: Treatment
    reason: str

    @property
    def times(self) -> str:
        """Factor that the answer is multiplied by, 1 / ratio, with its interval of 95 % in words."""
        return interval(1 / self.ratio, 1 / self.high, 1 / self.low, 3)

    @property
    def half(self) -> float:
        """Half the interval of 95 % of the logarithm of the ratio."""
        return log(self.high / self.low) / 2

    @property
    def scatter(self) -> float:
        """Standard deviation of the logarithm of single surfaces in 3D; nan where it is not known."""
        return sqrt(max((log(self.surface_high / self.surface_low) / 2) ** 2 - self.half**2, 0.0)) / NORMAL

    def __str__(self) -> str:
        if self.advice == NONE:
            return f"no advice. {self.reason}"
        if self.advice == SOLVE:
            return f"solve in 3D. {self.reason}"
        if self.advice == USE:
            return f"use {CALLED[self.model]} as it is. {self.reason}"
        return f"multiply {CALLED[self.model]} by {self.times}. {self.reason}"


HEADINGS = "quantity", *(each.name for each in fields(Correction))


@dataclass(frozen=True)
class Advice:
    """Corrections of cheap models for a scene; None where a quantity is prescribed or zero.

    friction, depth, force : of 1D: of the coefficient of friction, the depth under a load, the force at a depth
    law : of the law of friction in three dimensions: of the coefficient of friction
    groups : dimensionless groups by name, as numbers; empty of a smooth body and of what was never measured
    doubts : about the scene
    notes : on what was read for it
    estimates : friction, depth or force themselves
    finer : relative change of friction, by the law alone, where the shortest wave is half as long; NaN without one
    """

    friction: Correction | None
    depth: Correction | None
    force: Correction | None
    law: Correction | None
    groups: Mapping[str, float]
    doubts: tuple[Doubt, ...] = ()
    notes: tuple[str, ...] = ()
    estimates: tuple[Estimate, ...] = ()
    finer: float = nan

    @property
    def corrections(self) -> dict[str, Correction]:
        """Ratios that the scene has, by name: of 1D, and of the law."""
        return {name: worth for name in RATIOS if (worth := getattr(self, name))}

    def of_model(self, name: str) -> dict[str, Correction]:
        """Corrections of a model, by quantity."""
        return {each: worth for each, worth in self.corrections.items() if worth.model == name}

    @property
    def taken(self) -> Correction | None:
        """Correction of friction to take, that with the narrower interval; None where it is to be solved in 3D."""
        known = [each for each in (self.friction, self.law) if each and each.advice in (USE, MULTIPLY)]
        return min(known, key=lambda each: each.half, default=None)

    @property
    def choice(self) -> str:
        """Cheap model to take for friction, in a sentence; empty where there is no friction."""
        if not self.friction:
            return ""
        if self.friction.advice == NONE:
            return "For friction take no model as it is."
        if (best := self.taken) is None:
            return "For friction solve in 3D."
        as_it_is = (
            f"as it is, {off(best.low)} to {off(best.high)}" if best.advice == USE else f"times {best.times}"
        )
        return f"For friction take {CALLED[best.model]} {as_it_is}."

    def __str__(self) -> str:
        lines = [*(f"doubtful: {each}" for each in self.doubts), *(f"note: {each}" for each in self.notes)]
        lines += map(str, self.estimates)
        if isfinite(self.finer):
            more = share(self.finer)
            lines.append(f"waves half as short as the shortest would add {more} of friction, by the law alone")
        lines += [self.choice] if self.choice else []
        lines += [f"{SUBJECTS[name]}: {worth}" for name, worth in self.corrections.items()]
        if self.groups:
            lines.append(f"place on the map: {placed(self.groups)}")
        return "\n".join(lines)

    def table(self) -> DataFrame:
        """A row for each quantity and model."""
        from pandas import DataFrame

        named = self.corrections.items()
        rows = [("friction" if name == LAW else name, *astuple(worth)) for name, worth in named]
        return DataFrame(rows, columns=HEADINGS)


def trust(scene: Scene) -> Advice:
    """Corrections for a scene, from its groups and the smooth body in its place; nothing rough is solved.

    A measured line is judged as the surface that is fitted to it. Beyond every linear theory of contact there is
    no advice: 3D is as linear as 1D.
    """
    known = estimates(scene)
    finer = of_finer(scene) if any(each.quantity == "friction" for each in known) else nan
    found = _advised(as_judged(scene))
    found = replace(found, doubts=doubts(scene), notes=notes(scene), estimates=known, finer=finer)
    if isinstance(scene.roughness, Profile | Spectrum):
        why = FITTED if isinstance(scene.roughness, Profile) else SHAPED
        noted = {name: replace(each, reason=f"{each.reason} {why}") for name, each in found.corrections.items()}
        return replace(found, **noted)
    return found


def _advised(scene):
    if (steep := beyond_linear(scene)) is not None:
        why = (
            f"This advice is about linear contacts, and this is none: {steep.name} = {steep.number:.3g}, above 1."
        )
        return _unknown(scene, f"{why} 3D is as linear as 1D.", NONE)
    if (unseen := beyond_table(scene)) is not None:
        number = f"{unseen.name} = {unseen.number:.3g} {unseen.unit}".strip()
        return _unknown(scene, f"The table of moduli does not show it: {number}.", NONE)
    try:
        if (scene.roughness is None or scene.roughness.flat) and not unmeasured(scene):
            return _smooth(scene)
        place = Place.of(scene)
    except OffTheMap as error:
        return _unknown(scene, str(error))
    except (SolveError, ArithmeticError, ValueError) as error:
        return _unknown(scene, f"Off the map: the smooth body has no answer ({error}).")
    if place.beyond:
        return replace(_unknown(scene, place.beyond), groups=place.named)
    rubs = bool(place.smooth.friction_coefficient)
    asked = [name for name in asked_of(scene) if rubs or name not in ("friction", LAW)]
    return _of({name: _predicted(name, place) for name in asked}, place.named)


def _unknown(scene, reason, advice=SOLVE):
    asked = asked_of(scene) if isinstance(scene.motion, Indent | Slide) else RATIOS
    return _of({name: Correction(MODELS[name], *[nan] * 5, advice, reason) for name in asked})


def _of(corrections: Mapping[str, Correction], groups: Mapping[str, float] | None = None) -> Advice:
    friction, depth, force, law = (corrections.get(name) for name in RATIOS)
    return Advice(friction, depth, force, law, groups or {})


def _smooth(scene) -> Advice:
    """Solved in both dimensionalities, on two grids in 3D: their change is the interval."""
    finer = replace(SPACE, points=2 * SPACE.points)
    line = LINE.solve(replace(scene, roughness=None))
    fine, coarse = (
        SmoothReference.of(scene, line, solver.solve(replace(scene, roughness=None))) for solver in (finer, SPACE)
    )
    corrections = {}
    for name in asked_of(scene):
        # The law is the smooth solve itself.
        if name == LAW or (name == "friction" and not fine.friction_coefficient):
            continue
        ratio, other = getattr(fine, name), getattr(coarse, name)
        error = abs(log(ratio / other)) / NORMAL
        corrections[name] = _worth(name, ratio, error, 0.0, SOLVED)
    return _of(corrections)


def _predicted(name, place):
    (logarithm, error, scatter), groups = place.predicted(name), place.groups
    worth = _worth(name, exp(logarithm), error, scatter, _because(name, groups))
    return replace(worth, reason=f"{worth.reason} {NARROW}") if name == "force" and _lost(groups) else worth


def advice_on(ratio: float, error: float) -> Treatment:
    """Treatment on a ratio whose logarithm has a standard error."""
    half = NORMAL * error
    if ratio * exp(-half) >= 1 - SMALL and ratio * exp(half) <= 1 + SMALL:
        return USE
    return MULTIPLY if half <= WIDE else SOLVE


def _worth(name, ratio, error, scatter, because):
    """Correction by a ratio; the answer of `FrictionLaw` has the bare ratio in it: it is used, or not."""
    left, advice, bare = ratio, advice_on(ratio, error), ""
    if name == LAW:
        left, advice = 1.0, USE if NORMAL * error <= WIDE else SOLVE
        bare = f"; its formula alone is {off(ratio)}"
    called, (low, high) = CALLED[MODELS[name]], (left * exp(end * NORMAL * error) for end in (-1, 1))
    within = "" if name == LAW else f"within {share(SMALL)} of 3D, "
    reason = {
        USE: f"{capital(called)} is {within}{off(low)} to {off(high)}",
        MULTIPLY: f"{capital(called)} is {off(ratio)}",
        SOLVE: f"The map knows no more than that {called} is {off(low)} to {off(high)}",
    }[advice]
    return _correction(name, left, error, scatter, advice, f"{reason}{bare}: {because}.")


def _correction(name, ratio, error, scatter, advice, reason):
    """Correction with its intervals, of the mean and of single surfaces."""
    half = NORMAL * error
    whole = NORMAL * hypot(error, scatter) if scatter < MOST_SCATTER else nan
    ends = (ratio * exp(each) for each in (-half, half, -whole, whole))
    text = reason if isfinite(whole) else f"{reason} {NOTHING}"
    return Correction(MODELS[name], ratio, *ends, advice, text)


def _lost(groups):
    return bool(lost(np.array([astuple(groups)]))[0])


def _because(name, groups):
    """Reason that decides the ratio in this part of the map."""
    if name == "depth" and _lost(groups):
        return "the roughness is nearly as high as the body is deep"
    flat = "is pressed flat" if groups.sliding_pressure > 0 else "touches in part"
    if name in ("friction", LAW) and groups.share > MOST:
        return f"the roughness {flat} and makes most of the friction"
    few = ", with few waves in the contact" if groups.sliding_waves < log(FEW) else ""
    return f"the roughness {flat}{few}"
