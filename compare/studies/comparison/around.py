"""Curves around one scene, as `crosscheck run` solves them, and what is judged on them.

The scene as it stands, force against depth, friction against speed and against load. A scene in time, or drawn
against friction in its interface, has one curve: over time, or over the displacement.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from math import isfinite
from typing import Any

import numpy as np

from mdr1d import equations
from scene import Indent, InvalidInput, Program, Refused, Scene, Shear, SolveError, Solver
from scene.scales import elastic_contact

from ...library.case import Case, doubted
from ...models import exact
from ...models.table import DEPTH, FORCE, FRICTION, PROFILES, ModelLike, Models
from ...solving.curve import FINE, LEVELS, Curve, levels, refuse
from ...solving.task import SceneTask
from ...statistics.finding import Finding
from ...statistics.jackknife import mean
from ...statistics.multilevel import WORDS
from ...trustmap.verdict import Advice, trust
from .answers import Answers
from .claims import CLAIMS, TOLERANCE
from .series import Counts, Judged, Series, ratio_of
from .theory import with_theory

OWN, SPEED, LOAD = "own", "friction-speed", "friction-load"
ROUGH_DEPTH, SMOOTH_DEPTH, SMOOTH_SPEED = "force-depth-rough", "force-depth-smooth", "smooth-speed"
# Rough curves whose contacts share their surfaces: those of one are as many as those of the others.
SHARED = {"rest": (ROUGH_DEPTH,), "sliding": (OWN, SPEED, LOAD)}
# Claims on the scene as it stands by the name of its mean; of force against depth, with their curves.
OWN_RATIOS = {
    "friction_coefficient": "friction.ratio.own",
    "depth_reached": "own.depth",
    "normal_force": "own.force",
}
SLOW_RATIO, SPREAD, EXACT = "friction.ratio.smooth-slow", "friction_spread", "exact"
MU = "friction_coefficient"
FORCES = {"force.ratio.rough": ROUGH_DEPTH, "force.ratio.smooth": SMOOTH_DEPTH}
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
    strata: Mapping[str, Counts] = field(default_factory=dict, hash=False)
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
        """Curves by name, all of which every model can solve, as far as that is known beforehand.

        Raises Refused, also where what follows from the numbers of the case is beyond the range of numbers.
        """
        try:
            found = self.with_strata(_curves(self.case, self.models), _most_levels(self.scene))
            if self.case.roughness:
                found |= {name: with_theory(found[name]) for name in (SPEED, LOAD) if name in found}
            refuse(found.values())
        except (ArithmeticError, SolveError, InvalidInput) as error:
            # The case is valid; what follows from it is not.
            raise Refused("its numbers are so far apart that the contact leaves their range") from error
        return found

    @property
    def remarks(self) -> Sequence[str]:
        return (*self.case.departures, *self.case.notes)

    @property
    def own(self) -> Sequence[SceneTask]:
        first = {each.model: each.task for each in reversed(self.curves[OWN].contacts) if each.level == FINE}
        return list(first.values())

    @cached_property
    def doubts(self) -> Sequence[str]:
        return doubted(self.case, curves=(corner for each in self.curves.values() for corner in each.corners))

    @cached_property
    def advice(self) -> Advice:
        """Advice of the trust map on 1D: predicted, and not from what is solved here."""
        return trust(self.scene)

    @property
    def own_means(self) -> list[str]:
        """Means of the scene's own contact that tell what it is: friction, and what is not prescribed."""
        friction = ["friction_coefficient"] if self.case.slides and self.case.motion.speed > 0 else []
        return [*friction, "normal_force" if self.case.motion.pressed_by == "depth" else "depth_reached"]

    @property
    def wanted(self) -> Iterator[tuple[str, str, tuple[float, ...]]]:
        if not self.curves[OWN].over_time:
            yield from ((OWN, name, self.curves[OWN].speeds) for name in self.own_means)

    def judge(self, answers: Answers) -> Judged:
        if self.curves[OWN].axis in ("time", "displacement", "force"):
            return Judged([*self._history(answers)])
        shifted = {}
        if LOAD in self.curves:
            exponent = predicted_exponent(self.case)
            shifts = {speed: exponent * float(np.log(speed)) for speed in self.curves[LOAD].speeds}
            for model in answers.claiming(LOAD, FRICTION):
                shifted[model.name] = self.shifted(answers, LOAD, model, shifts, exponent)
        rows: list[tuple] = [(OWN_RATIOS[name], OWN, name, {(0, 0): ""}) for name in self.own_means]
        for name, curve in FORCES.items():
            if curve in self.curves and answers.has(curve, self.models.reference):
                places = self._depths(answers, curve, self.models.reference)
                rows.append((name, curve, "normal_force", places, 1.0))
        if SPEED in self.curves:
            rows.append(("friction.ratio.speed", SPEED, MU, self._speeds()))
        found = [
            *self._slow(answers),
            *(each for name, *row in rows for each in self.ratios(name, answers, *row)),
            *(each for _, findings in shifted.values() for each in findings),
            *self._closed_form(answers),
            *self._spread(answers),
            *self._grid(answers),
        ]
        return Judged(found, {name: fine for name, (fine, _) in shifted.items() if fine is not None})

    def _slow(self, answers: Answers) -> Iterator[Finding]:
        """Friction of the smooth body at its lowest speed: 2 of one dimension over three."""
        if SMOOTH_SPEED not in self.curves:
            return
        speeds, factors = self.curves[SMOOTH_SPEED].speeds, {each.label: each.slow_factor for each in self.models}
        lowest = int(np.argmin(speeds))
        regime = f"v τ / a = {scaled_speed(self.case, speeds[lowest]):.2g}"
        for each in self.ratios(SLOW_RATIO, answers, SMOOTH_SPEED, MU, {(lowest, 0): ""}, regime=regime):
            one, _, other = each.dimension.partition("/")
            factor = factors[one] / factors[other]
            if factor != each.claim.expected:
                sentence = f"Slow friction of the smooth body in {one} is {factor:g} times that in {other}"
                meaning = f"Friction in {one} over {other} at the lowest speed; it tends to {factor:g}."
                law: dict[str, Any] = {"sentence": sentence, "meaning": meaning, "expected": factor}
                each = replace(each, claim=replace(each.claim, tolerance=factor * TOLERANCE, **law))
            yield each

    def _closed_form(self, answers: Answers) -> Iterator[Finding]:
        """Force on the smooth body over the closed form, less one, at every depth."""
        if answers.has(SMOOTH_DEPTH, EXACT):
            places, claim = self._depths(answers, SMOOTH_DEPTH, EXACT), CLAIMS["force.closed-form"]
            for model in answers.claiming(SMOOTH_DEPTH, FORCE):
                both, told = (model.name, EXACT), {"dimension": model.label}
                over = ratio_of("normal_force", *both, less=1.0)
                yield from self.compared(answers, claim, SMOOTH_DEPTH, both, over, places, **told)

    def _depths(self, answers, curve, model):
        """Places at which a model touches, in words."""
        return {at: f"{depth * 1e6:.3g} µm" for at, depth in self.touched(answers, curve, model)}

    def _speeds(self):
        """Places on the curve of friction against speed, in words."""
        return {(k, 0): f"v = {speed:.3g} m/s" for k, speed in enumerate(self.curves[SPEED].speeds)}

    def _spread(self, answers: Answers) -> Iterator[Finding]:
        """Spread of both estimates of friction in three dimensions, at every speed at which it is known."""
        for model in answers.claiming(SPEED, FRICTION):
            if SPREAD in answers.two_levels(SPEED, model.name):
                measure = lambda sample, name=model.name: mean(sample[name], SPREAD)  # noqa: E731
                found = self.compared(
                    answers, CLAIMS["friction.spread"], SPEED, (model.name,), measure, self._speeds(),
                    size=True, dimension=model.label,
                )  # fmt: skip
                yield from (each for each in found if isfinite(each.value))

    def _grid(self, answers: Answers) -> Iterator[Finding]:
        """Change of the scene's own answer from half the points to all."""
        first, claim = self.own_means[0], CLAIMS["grid.change"]
        for model in answers.claiming(OWN, WORDS[first]):
            if model.has_grid:
                measure = ratio_of(first, model.name)
                for each in self.compared(answers, claim, OWN, (model.name,), measure, {(0, 0): ""}):
                    change = float(np.divide(each.grid, abs(each.value)))
                    yield Finding(claim, change, where=self.name, drawn=each.drawn, dimension=model.label)

    def _history(self, answers: Answers) -> Iterator[Finding]:
        """Differences of models from the reference over time, or over the displacement."""
        motion, reference = self.case.motion, self.models.reference
        moves = isinstance(motion, Shear) or motion.length > 0
        pressed = FORCE if motion.pressed_by in ("depth", "gap") else DEPTH
        for quantity in (pressed, FRICTION)[: 1 + moves]:

            def apart(one, three, name=HISTORIES[quantity]):
                one, three = mean(one, name).ravel(), mean(three, name).ravel()
                return (one - three) / np.sqrt(np.mean(np.square(three)))

            for model in answers.judged(OWN, quantity):
                yield self.measured(answers, f"history.{quantity}", OWN, (model.name, reference), apart)


HISTORIES = {FORCE: "normal_force", DEPTH: "depth_reached", FRICTION: "friction_force"}


def _curves(case, models):
    plan, scene, motion = case.plan(), case.scene, case.motion
    if isinstance(motion, Shear):
        drawn = motion.displacement or motion.force or 0.0
        steps = tuple(drawn * k / STEPS for k in range(1, STEPS + 1)) if drawn else (0.0,)
        return {OWN: _curve(case, models, scene, (0.0,), steps)}
    own, greatest = partial(_curve, case, models), (motion.greatest,)
    over_time = isinstance(motion, Program)
    found = {OWN: own(scene, () if over_time else (motion.speed,), greatest, keeps_fields=True)}
    if over_time:
        return found
    depths = tuple(factor * elastic_contact(scene).depth for factor in plan.depths)
    smooth, indented = replace(scene, roughness=None), Indent(depth=depths[0])
    if case.roughness:
        found[ROUGH_DEPTH] = own(replace(scene, motion=indented), (0.0,), depths)
    pressed = own(replace(smooth, motion=indented), (0.0,), depths)
    found[SMOOTH_DEPTH] = with_theory(pressed, (exact.Exact(),))
    if plan.speeds:
        found[SPEED] = own(scene, plan.speeds, greatest)
        found[LOAD] = own(scene, plan.load_speeds, tuple(motion.greatest * factor for factor in plan.pressing))
    if plan.smooth_speeds:
        found[SMOOTH_SPEED] = own(smooth, plan.smooth_speeds, greatest)
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
    contact, solid, body = elastic_contact(case.scene), case.scene.solid, case.indenter
    speed = contact.radius / float(solid.retardation()[2][0])
    given = speed, contact.radius, exact.mean_lag(solid), solid.indentation_modulus
    one, three = (
        law(*given, body.mdr_coefficient, body.exponent) / contact.load / edge_slope(case)
        for law in (exact.slow_friction_1d, exact.slow_friction_3d)
    )
    return {each.name: one if each.draws == PROFILES else three for each in models}


def edge_slope(case: Case) -> float:
    """Slope of the smooth body at the edge of the smooth relaxed contact."""
    return exact.edge_slope(case.indenter, elastic_contact(case.scene).radius)
