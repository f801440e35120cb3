"""Curves around one scene, as `crosscheck run` solves them, and what is judged on them.

The scene as it stands, force against depth, friction against speed and against load. A scene in time, or drawn
against friction in its interface, has one curve: over time, or over the displacement.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import isfinite, nan
from typing import Any

import numpy as np
from pydantic import ValidationError

from mdr1d import equations
from scene import Indent, Program, Refused, Scene, Shear, SolveError, Solver
from scene.scales import elastic_contact

from ...library.case import Case, doubted
from ...models import exact
from ...models.table import DEPTH, FORCE, FRICTION, PROFILES, Model, ModelLike, Models
from ...solving.curve import COARSE, FINE, LEVELS, Curve, levels, refuse
from ...solving.task import SceneTask
from ...statistics import eq23
from ...statistics.collapse import Collapse, collapse
from ...statistics.finding import Claim, Finding, said_of
from ...statistics.frictioncurves import SimulatedCurves
from ...statistics.jackknife import mean, measured
from ...statistics.multilevel import WORDS
from ...trustmap.verdict import Advice, trust
from .answers import Answers
from .claims import CLAIMS, TOLERANCE
from .series import Counts, Judged, Series, on_levels_alike, ratio_of
from .theory import with_theory

OWN, SPEED, LOAD = "own", "friction-speed", "friction-load"
ROUGH_DEPTH, SMOOTH_DEPTH, SMOOTH_SPEED = "force-depth-rough", "force-depth-smooth", "smooth-speed"
# Rough curves whose contacts share their surfaces: those of one are as many as those of the others.
SHARED = {"rest": (ROUGH_DEPTH,), "sliding": (OWN, SPEED, LOAD)}
# Claims on the scene as it stands by the name of its mean; on force against depth by curve.
OWN_RATIOS = {
    "friction_coefficient": "friction.ratio.own",
    "depth_reached": "own.depth",
    "normal_force": "own.force",
}
FORCES = {ROUGH_DEPTH: "force.ratio.rough", SMOOTH_DEPTH: "force.ratio.smooth"}
STEPS = 10  # displacements, or tangential forces, to which a shear is drawn


def models_of(case: Case, asked: Sequence[ModelLike] | None = None, reference: str | None = None) -> Models:
    """Models that are asked for, else those that a case names, with the case's settings. Raises InvalidInput."""
    own: dict[str, Solver] = {"mdr": case.mdr, "bem": case.bem}
    return Models.of(asked or case.models or None, reference or case.reference or None, own)


@dataclass(frozen=True)
class Around(Series):
    """One case with the curves around it.

    asked, reference : models and the reference among them, in place of those that the case names, see `Models.of`
    wanted_interval : in place of that of the case
    """

    name: str
    case: Case
    asked: tuple[ModelLike, ...] = ()
    reference: str | None = None
    wanted_interval: float | None = None
    strata: Mapping[str, Counts] = field(default_factory=dict)
    shared = SHARED

    @property
    def title(self) -> str:  # type: ignore[override]
        return self.case.title or self.name

    @property
    def scene(self) -> Scene:  # type: ignore[override]
        return self.case.scene

    @property
    def interval(self) -> float | None:  # type: ignore[override]
        return self.case.study.interval if self.wanted_interval is None else self.wanted_interval

    @cached_property
    def models(self) -> Models:  # type: ignore[override]
        return models_of(self.case, self.asked, self.reference)

    @cached_property
    def curves(self) -> Mapping[str, Curve]:
        return curves(self.case, self.models, None if self.interval is None else self.strata)

    @property
    def own(self) -> Sequence[SceneTask]:
        first = {each.model: each.task for each in reversed(self.curves[OWN].contacts) if each.level == FINE}
        return list(first.values())

    @cached_property
    def doubts(self) -> Sequence[str]:
        return doubted(self.case, curves=corners(self.curves))

    @cached_property
    def advice(self) -> Advice:
        """Advice of the trust map on 1D: predicted, and not from what is solved here."""
        return trust(self.scene)

    @property
    def own_means(self) -> list[str]:
        """Means of the scene's own contact that tell what it is: friction, and what is not prescribed."""
        friction = ["friction_coefficient"] if self.case.slides and self.case.motion.speed > 0 else []
        return [*friction, "normal_force" if self.case.motion.load is None else "depth_reached"]

    @property
    def wanted(self) -> Iterator[tuple[str, str, tuple[float, ...]]]:
        if not self.curves[OWN].over_time:
            yield from ((OWN, name, self.curves[OWN].speeds) for name in self.own_means)

    def judge(self, answers: Answers) -> Judged:
        shifted = dict(self._shifted(answers))
        collapsed = [each for _, findings in shifted.values() for each in findings]
        if self.curves[OWN].axis in ("time", "displacement", "force"):
            return Judged([*self._history(answers)])
        found = [
            *self._slow(answers),
            *(each for name in self.own_means for _, _, each in self._own(answers, name)),
            *self._forces(answers),
            *collapsed,
            *self._unshifted(answers, shifted),
            *(each for _, _, each in self.at_speeds(answers)),
            *self._closed_form(answers),
            *self._grid(answers),
            *self._spread(answers),
        ]
        return Judged(found, {name: each for name, (each, _) in shifted.items()})

    def _slow(self, answers: Answers) -> Iterator[Finding]:
        """Friction of the smooth body at its lowest speed."""
        if SMOOTH_SPEED not in self.curves:
            return
        speeds, reference = self.curves[SMOOTH_SPEED].speeds, self.models[self.models.reference]
        lowest = int(np.argmin(speeds))
        regime = f"v τ / a = {scaled_speed(self.case, speeds[lowest]):.2g}"
        for model, _, found in self.ratios(
            CLAIMS["friction.ratio.smooth-slow"], answers, SMOOTH_SPEED, "friction_coefficient", {(lowest, 0): ""}
        ):
            yield replace(found, claim=slow_claim(model, reference), regime=regime)

    def _own(self, answers, name):
        return self.ratios(CLAIMS[OWN_RATIOS[name]], answers, OWN, name, {(0, 0): ""})

    def _forces(self, answers: Answers) -> Iterator[Finding]:
        """Force of each model over that of the reference less one, at every depth at which that one touches."""
        for curve, name in FORCES.items():
            if curve in self.curves and answers.has(curve, self.models.reference):
                touched = self.touched(answers, curve, self.models.reference)
                places = {at: f"{depth * 1e6:.3g} µm" for at, depth in touched}
                yield from (
                    row[2] for row in self.ratios(CLAIMS[name], answers, curve, "normal_force", places, 1.0)
                )

    def at_speeds(self, answers: Answers) -> list[tuple[Model, tuple[int, int], Finding]]:
        """Friction of each model over that of the reference at every speed."""
        if SPEED not in self.curves:
            return []
        places = {(k, 0): f"v = {speed:.3g} m/s" for k, speed in enumerate(self.curves[SPEED].speeds)}
        return self.ratios(CLAIMS["friction.ratio.speed"], answers, SPEED, "friction_coefficient", places)

    def _closed_form(self, answers: Answers) -> Iterator[Finding]:
        """Force on the smooth body over the closed form, less one."""
        if not answers.has(SMOOTH_DEPTH, "exact"):
            return
        for model in answers.claiming(SMOOTH_DEPTH, FORCE):
            both = model.name, "exact"
            found = answers.compared(SMOOTH_DEPTH, both, ratio_of("normal_force", *both))
            for at, depth in self.touched(answers, SMOOTH_DEPTH, "exact"):
                each = self.finding(
                    CLAIMS["force.closed-form"], found, at, SMOOTH_DEPTH, f"{depth * 1e6:.3g} µm", 1.0
                )
                yield replace(each, dimension=model.label)

    def _grid(self, answers: Answers) -> Iterator[Finding]:
        """Change of the scene's own answer from half the points to all."""
        first = self.own_means[0]
        for model in answers.claiming(OWN, WORDS[first]):
            if model.has_grid:
                found = answers.compared(OWN, (model.name,), ratio_of(first, model.name))
                value = float((found.grid / np.abs(found.value))[0, 0])
                yield Finding(
                    CLAIMS["grid.change"], value, where=self.name, drawn=found.drawn, dimension=model.label
                )

    def _spread(self, answers: Answers) -> Iterator[Finding]:
        """Spread of both estimates of friction in three dimensions, at every speed."""
        for model in answers.claiming(SPEED, FRICTION) if SPEED in self.curves else ():
            if "friction_spread" in answers.two_levels(SPEED, model.name):
                measure = lambda sample, name=model.name: mean(sample[name], "friction_spread")  # noqa: E731
                found = answers.compared(SPEED, (model.name,), measure, size=True)
                for k, speed in enumerate(self.curves[SPEED].speeds):
                    if isfinite(found.value[k, 0]):
                        place = f"v = {speed:.3g} m/s"
                        each = self.finding(CLAIMS["friction.spread"], found, (k, 0), SPEED, place)
                        yield replace(each, dimension=model.label)

    def _history(self, answers: Answers) -> Iterator[Finding]:
        """How far apart models are over time, or over the displacement, each from the reference."""
        pressed, motion, reference = DEPTH, self.case.motion, self.models.reference
        pressed = DEPTH if motion.pressed_by in ("load", "line_load", "pressure") else FORCE
        moves = isinstance(motion, Shear) or motion.length > 0
        for quantity in (pressed, *([FRICTION] if moves else [])):
            for model in answers.judged(OWN, quantity):
                both, name = (model.name, reference), HISTORIES[quantity]

                def apart(sample, both=both, name=name):
                    one, three = (mean(sample[each], name).ravel() for each in both)
                    return (one - three) / np.sqrt(np.mean(np.square(three)))

                beside = self.models.beside(model.name)
                claim = replace(said_of(CLAIMS[f"history.{quantity}"], beside), measure=apart, dimension=beside)
                fine, coarse = (answers.sample(level, OWN, *both) for level in (FINE, COARSE))
                yield replace(measured(claim, fine, coarse, self.name), curve=self.place(OWN))

    def _shifted(self, answers: Answers) -> Iterator[tuple[str, tuple[Collapse, list[Finding]]]]:
        """Curves of friction against load shifted onto one, of each model where there are points enough."""
        for model in answers.claiming(LOAD, FRICTION) if LOAD in self.curves else ():
            fine, coarse = (_collapse(answers, model.name, level) for level in (FINE, COARSE))
            if fine is None:
                continue
            exponent = predicted_exponent(self.case)
            shifts = exponent * np.log(fine.speeds / fine.speeds[fine.speeds.size // 2])
            draws = 0 if self.case.roughness is None else fine.data.surfaces
            place: dict[str, Any] = {"where": self.name, "draws": draws, "curve": self.place(LOAD)}
            alone = coarse is None
            found = eq23.findings(fine, coarse, model.label, shifts, exponent, horizontal=alone, **place)
            if coarse is None:  # for want of an answer: data without a grid are exact, this is not
                found = (replace(each, grid=nan) for each in found)
            yield model.name, (fine, list(found))

    def _unshifted(self, answers, shifted) -> Iterator[Finding]:
        """Curves that cannot be shifted for want of answers."""
        own = self.curves.get(LOAD)
        if own and self.models.reference in own.levels and eq23.shiftable(len(own.speeds), len(own.values)):
            for each in answers.claiming(LOAD, FRICTION):
                if each.name not in shifted:
                    yield eq23.too_few(each.label, where=self.name)


HISTORIES = {FORCE: "normal_force", DEPTH: "depth_reached", FRICTION: "friction_force"}


def slow_claim(model: Model, reference: Model) -> Claim:
    """What slow friction of the smooth body is over that of the reference: 2 of one dimension over three."""
    claim, factor = CLAIMS["friction.ratio.smooth-slow"], model.slow_factor / reference.slow_factor
    if factor == claim.expected:
        return said_of(claim, f"{model.label}/{reference.label}")
    words = "the same in" if factor == 1.0 else "half as high in"
    return replace(
        claim,
        sentence=f"Slow friction of the smooth body is {words} {model.label} as in {reference.label}",
        expected=factor,
        tolerance=factor * TOLERANCE,
        meaning=f"Friction in {model.label} over {reference.label} at the lowest speed; it tends to {factor:g}.",
    )


def _collapse(answers: Answers, model: str, level: str) -> Collapse | None:
    """None with too few speeds or points, and where the level was not solved."""
    found = answers.two_levels(LOAD, model)
    if level not in found["level"]:
        return None
    try:
        return collapse(SimulatedCurves.of(found.sel(level=level)))
    except ValueError:
        return None


def curves(case: Case, models: Models, strata: Mapping[str, Counts] | None = None) -> dict[str, Curve]:
    """Curves of a case by name, all of which every model can solve, as far as that is known beforehand.

    strata : numbers of surfaces on each level by model, of the curves that share them, where these are not fixed

    Raises Refused, also where what follows from the numbers of the case is beyond the range of numbers.
    """
    try:
        found = _curves(case, models)
        if strata is not None and case.roughness:
            most = _most_levels(case.scene)
            for shared, names in SHARED.items():
                if own := {name: found[name] for name in names if name in found and not found[name].over_time}:
                    found |= on_levels_alike(own, models, strata.get(shared, {}), most)
        found |= {name: with_theory(found[name]) for name in (SPEED, LOAD) if name in found}
        refuse(found.values())
    except (ArithmeticError, SolveError, ValidationError) as error:
        # The case is valid; what follows from it is not.
        raise Refused("its numbers are so far apart that the contact leaves their range") from error
    return found


def corners(found: Mapping[str, Curve]) -> Iterator[Scene]:
    """Contacts at the ends of all curves."""
    return (corner for each in found.values() for corner in each.corners)


def _curves(case, models):
    plan, scene, motion = case.plan(), case.scene, case.motion
    own: Callable[..., Curve] = lambda *given, **other: _curve(case, models, scene, *given, **other)  # noqa: E731
    if isinstance(motion, Program):
        return {OWN: own((), (motion.greatest,), keeps_fields=True)}
    if isinstance(motion, Shear):
        drawn = motion.displacement or motion.force or 0.0
        return {OWN: own((0.0,), tuple(drawn * k / STEPS for k in range(1, STEPS + 1)) if drawn else (0.0,))}
    found = {OWN: own((motion.speed,), (motion.greatest,), keeps_fields=True)}
    if case.interface is not None:
        return found
    smooth = replace(scene, roughness=None)
    depths = tuple(factor * elastic_contact(scene).depth for factor in plan.depths)
    indented = Indent(depth=depths[0])
    if case.roughness:
        found[ROUGH_DEPTH] = _curve(case, models, replace(scene, motion=indented), (0.0,), depths)
    pressed = _curve(case, models, replace(smooth, motion=indented), (0.0,), depths)
    closed_form = exact.Exact()
    if closed_form.name not in pressed.levels and not closed_form.refusals(pressed.scene):
        known: dict[str, Any] = {closed_form.name: {FINE: closed_form, COARSE: closed_form}}
        pressed = replace(pressed, levels={**pressed.levels, **known})
    found[SMOOTH_DEPTH] = pressed
    if plan.speeds:
        found[SPEED] = own(plan.speeds, (motion.greatest,))
        found[LOAD] = own(plan.load_speeds, tuple(motion.greatest * factor for factor in plan.pressing))
    if plan.smooth_speeds:
        found[SMOOTH_SPEED] = _curve(case, models, smooth, plan.smooth_speeds, (motion.greatest,))
    return found


def _curve(case: Case, models: Models, scene: Scene, speeds, values, keeps_fields=False) -> Curve:
    """Contacts on the grid of each model, and on half its points where that is a grid of the same surface."""
    plan, motion = case.plan(), scene.motion
    sliding = any(speeds) or (isinstance(motion, Program) and motion.length > 0) or isinstance(motion, Shear)
    own = models.telling(motion.pressed_by, sliding)
    found = Curve(
        scene=scene,
        speeds=tuple(speeds),
        values=tuple(values),
        levels={each.name: {FINE: each.solver} for each in own},
        draws={each.name: each.count(plan.profiles, plan.surfaces) for each in own},
        keeps_fields=keeps_fields,
    )
    return replace(found, levels=levels(own, [found], min(2, _most_levels(scene))))


def _most_levels(scene):
    """A grid that cuts the roughness off has another surface on half the points."""
    return 1 if scene.roughness is not None and scene.roughness.shortest is None else len(LEVELS)


def predicted_exponent(case: Case) -> float:
    """d ln p / d ln v that Eq. 23 predicts for the shortest wave of the case, or of its 1D grid's cut-off."""
    speeds, rough = case.plan().load_speeds, case.roughness
    if rough is None or len(speeds) < 2:
        return equations.force_shift_exponent(1.0, case.indenter.exponent)
    q_max = rough.q_max(rough.longest / case.mdr.points)
    beta = exact.loss_exponent(case.scene.solid, q_max, speeds)
    return equations.force_shift_exponent(beta, case.indenter.exponent)


def friction_law(case: Case, load, speed, rms_slope):
    """Coefficient of friction of Eq. 19 at loads [N] and speeds [m/s]."""
    time = float(case.scene.solid.retardation()[2].max())
    shape = (case.indenter.mdr_coefficient, case.indenter.exponent)
    # Eqs. 18 and 19 are written for a Poisson ratio of 1/2.
    modulus = case.scene.solid.indentation_modulus / 4
    xi = equations.similarity_variable(load, modulus, time, speed, rms_slope, *shape)
    return equations.plateau(rms_slope) * equations.interpolation(xi)


def scaled_speed(case: Case, speed: float) -> float:
    """v tau / a with the radius of the smooth relaxed contact; tau is the retardation time of the one mode."""
    return speed * float(case.scene.solid.retardation()[2][0]) / elastic_contact(case.scene).radius


def slow_friction(case: Case, models: Models) -> Mapping[str, float]:
    """Friction of the smooth body over the slope at the contact's edge, per v tau / a at low speed, by model."""
    contact = elastic_contact(case.scene)
    shape = (case.indenter.mdr_coefficient, case.indenter.exponent)
    speed = contact.radius / float(case.scene.solid.retardation()[2][0])
    lag, modulus = exact.mean_lag(case.scene.solid), case.scene.solid.indentation_modulus
    in_one, in_three = (
        law(speed, contact.radius, lag, modulus, *shape) / contact.load / edge_slope(case)
        for law in (exact.slow_friction_1d, exact.slow_friction_3d)
    )
    return {each.name: in_one if each.draws == PROFILES else in_three for each in models}


def edge_slope(case: Case) -> float:
    """Slope of the smooth body at the edge of the smooth relaxed contact."""
    return exact.edge_slope(case.indenter, elastic_contact(case.scene).radius)
