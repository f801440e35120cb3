"""Curves around one scene, as `crosscheck run` solves them, and what is judged on them.

The scene as it stands, force against depth, friction against speed and against load. A scene in time, or drawn
against friction in its interface, has one curve: over time, or over the displacement.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from math import ceil, sqrt
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from bem3d import BEM
from bem3d.plan import likely_grid
from scene import Indent, InvalidInput, Program, Refused, Scene, Shear, SolveError, Solver
from scene.protocol import numeric_guard, why_not
from scene.scales import elastic_contact

from ...library.case import Case, doubted
from ...models import exact
from ...models.law.extended import ExtendedBEM, without_fine_waves
from ...models.table import DEPTH, FORCE, FRICTION, ModelLike, Models
from ...solving.curve import FINE, LEVELS, Curve, levels, refuse
from ...solving.task import SceneTask
from ...statistics.finding import Finding
from ...statistics.jackknife import mean
from ...statistics.means import touches
from ...statistics.multilevel import MEANS, OWN_SHARE, WORDS
from ...trustmap.verdict import Advice, trust
from .answers import Answers, with_theory
from .claims import CLAIMS
from .measures import Here, Place, Row, Where, at
from .series import Counts, Judged, Series, Wanted, ratio_of

if TYPE_CHECKING:
    import xarray

OWN, SPEED, LOAD = "own", "friction-speed", "friction-load"
ROUGH_DEPTH, SMOOTH_DEPTH, SMOOTH_SPEED = "force-depth-rough", "force-depth-smooth", "smooth-speed"
# Rough curves whose contacts share their surfaces, so that each of them has the same number of surfaces.
SHARED = {"rest": (ROUGH_DEPTH,), "sliding": (OWN, SPEED, LOAD)}
# Claims on the scene as it stands by the name of its mean.
OWN_RATIOS = {
    "friction_coefficient": "friction.ratio.own",
    "depth_reached": "own.depth",
    "normal_force": "own.force",
}
SPREAD, EXACT = "friction_spread", "exact"
MU = "friction_coefficient"
HISTORIES = {FORCE: "normal_force", DEPTH: "depth_reached", FRICTION: "friction_force"}
STEPS = 10  # displacements, or tangential forces, to which a shear is drawn


def over(name: str, less: float = 0.0) -> Callable[..., np.ndarray]:
    """Measure of a mean divided by the mean of the reference, minus a number, at every place."""
    return lambda here, one, three: mean(one, *MEANS[name]) / mean(three, *MEANS[name]) - less


def own(name: str) -> Where:
    """The scene as it stands, where this mean tells what it is."""
    return at((0, 0), lambda here: name in here.series.own_means and not here.series.history)


def slowest(here: Here) -> Iterator[Place]:
    yield "", (int(np.argmin(here.series.curves[SMOOTH_SPEED].speeds)), 0)


def slow_factor(here: Here) -> float:
    """Friction of the smooth, slow body by a model, divided by the friction by the reference."""
    return here.model.slow_factor / here.series.models[here.series.models.reference].slow_factor


def speeds(here: Here) -> Iterator[Place]:
    for k, speed in enumerate(here.series.curves[SPEED].speeds):
        yield f"v = {speed:.3g} m/s", (k, 0)


def spread(here: Here) -> Iterator[Place]:
    """Speeds at which both estimates of friction in three dimensions are known."""
    if SPREAD in (found := here.answers(SPEED, here.model.name)):
        known = np.isfinite(mean(found, SPREAD)).ravel()
        yield from (each for each, is_known in zip(speeds(here), known, strict=True) if is_known)


def touching(curve: str, model: str = "") -> Where:
    """Depths at which a model touches, the reference if none is named."""

    def where(here: Here) -> Iterator[Place]:
        name = model or here.series.models.reference
        if here.answers.has(curve, name):
            found = here.answers.two_levels(curve, name)
            for k, depth in enumerate(found["depth"].values.tolist()):
                if touches(found)[0, k]:
                    yield f"{depth * 1e6:.3g} µm", (0, k)

    return where


def over_exact(here: Here, it: xarray.Dataset) -> np.ndarray:
    return mean(it, "normal_force") / mean(here.answers(SMOOTH_DEPTH, EXACT), "normal_force") - 1


def goes_on(quantity: str) -> Where:
    """All instants of a history in which a quantity changes."""

    def changes(here: Here) -> bool:
        motion = here.series.case.motion
        moves = isinstance(motion, Shear) or (here.series.history and motion.length > 0)
        return here.series.history and (moves if quantity == FRICTION else quantity == here.series.pressed)

    return at(..., changes)


def apart(name: str) -> Callable[..., np.ndarray]:
    """Measure of the differences from the reference over its rms."""

    def measure(here: Here, *both: xarray.Dataset) -> np.ndarray:
        one, three = (mean(each, name).ravel() for each in both)
        return (one - three) / np.sqrt(np.mean(np.square(three)))

    return measure


ROWS = (
    Row(
        "friction.ratio.smooth-slow",
        slowest,
        over(MU),
        pair=True,
        curve=SMOOTH_SPEED,
        each=True,
        expected=slow_factor,
    ),
    *(
        Row(id, own(name), over(name), pair=True, quantity=WORDS[name], curve=OWN, each=True)
        for name, id in OWN_RATIOS.items()
    ),
    *(
        Row(id, touching(curve), over("normal_force", 1.0), pair=True, quantity=FORCE, curve=curve, each=True)
        for id, curve in (("force.ratio.rough", ROUGH_DEPTH), ("force.ratio.smooth", SMOOTH_DEPTH))
    ),
    Row("friction.ratio.speed", speeds, over(MU), pair=True, curve=SPEED, each=True),
    Row(
        "force.closed-form",
        touching(SMOOTH_DEPTH, EXACT),
        over_exact,
        quantity=FORCE,
        curve=SMOOTH_DEPTH,
        each=True,
    ),
    Row("friction.spread", spread, lambda here, it: mean(it, SPREAD), curve=SPEED, each=True, size=True),
    *(
        Row(f"history.{quantity}", goes_on(quantity), apart(name), pair=True, quantity=quantity, curve=OWN)
        for quantity, name in HISTORIES.items()
    ),
)


def models_of(case: Case, asked: Sequence[ModelLike] | None = None, reference: str | None = None) -> Models:
    """Models that are asked for, else those that a case names, with the case's settings. Raises InvalidInput.

    By default they are 1D and 3D, and those of FINER where the grid in 3D cannot hold the waves.
    """
    own: dict[str, Solver] = {"mdr": case.mdr, "bem": case.bem}
    given = asked or case.models or None
    if given is None and finer_than_its_grid(case):
        given, own["extended"] = FINER, extended_of(case)
    return Models.of(given, reference or case.reference or None, own)


def extended_of(case: Case) -> ExtendedBEM:
    """The model of waves that a grid cannot hold, on no fewer points than a case states."""
    return ExtendedBEM(points=max(ExtendedBEM().points, case.bem.points))


FINER = "law", "extended"
EXTENDED = (
    "Waves of fewer than eight pixels are left to the law of friction in 3D by the model 3D extended; "
    "shortest_kept tells which wave it solved, and slope_kept their share of the rms slope."
)


def finer_than_its_grid(case: Case) -> bool:
    """Whether a scene has waves that its grid in 3D cannot hold, and nothing else is against it."""
    if not case.roughness:
        return False
    try:
        with numeric_guard():
            coarse, law = why_not(case.bem, without_fine_waves(case.scene)), why_not(ExtendedBEM(), case.scene)
            return not coarse and not law and bool(why_not(case.bem, case.scene))
    except SolveError:  # its numbers are too far apart for any model
        return False


# Error of friction on the plateau times the square of the pixels on the shortest wave: docs/results/accuracy.md.
GRID_ERROR = 1.7
MOST_POINTS = 16384  # a side


def left_by_grid(solver: BEM | ExtendedBEM, scene: Scene) -> float:
    """Relative error of friction that BEM leaves on the plateau; 0 at rest, or without a shortest wave."""
    shortest = getattr(scene.roughness, "shortest", None)
    if not (isinstance(solver, BEM) and shortest and getattr(scene.motion, "speed", 0.0)):
        return 0.0
    return GRID_ERROR * (likely_grid(solver, scene).pixel / shortest) ** 2


def with_points(solver: Any, scene: Scene, interval: float) -> Any:
    """The solver on no fewer points, of which the error of the grid leaves room for an interval of 95 %."""
    over = left_by_grid(solver, scene) / (OWN_SHARE * interval)
    return replace(solver, points=max(solver.points, min(2 * ceil(solver.points * sqrt(over) / 2), MOST_POINTS)))


def for_interval(case: Case, interval: float | None) -> Case:
    """The case on as many points in 3D as an interval asks for; its own if stated, or too few for its waves."""
    with suppress(SolveError), numeric_guard():
        if interval and case.bem == Case.bem and not why_not(case.bem, case.scene):
            return replace(case, bem=with_points(case.bem, case.scene, interval))
    return case


@dataclass(frozen=True)
class Around(Series):
    """One case with the curves around it.

    asked, reference : models and the reference among them, in place of those that the case names, see `Models.of`
    wanted_interval : in place of the interval of the case
    """

    name: str
    case: Case
    asked: tuple[ModelLike, ...] = ()
    reference: str | None = None
    wanted_interval: float | None = None
    strata: Mapping[str, Counts] = field(default_factory=dict, hash=False)
    shared = SHARED
    rows = ROWS
    by_speed, by_load = SPEED, LOAD
    bodies: ClassVar[Mapping[str, str]] = {ROUGH_DEPTH: "rough", SMOOTH_DEPTH: "smooth"}

    @property
    def title(self) -> str:  # type: ignore[override]
        return self.case.title or self.name

    @property
    def scene(self) -> Scene:  # type: ignore[override]
        return self.case.scene

    @property
    def interval(self) -> float | None:  # type: ignore[override]
        return self.case.interval if self.wanted_interval is None else self.wanted_interval

    @cached_property
    def models(self) -> Models:  # type: ignore[override]
        return models_of(self.case, self.asked, self.reference)

    @cached_property
    def curves(self) -> Mapping[str, Curve]:
        """Curves by name that every model can solve completely, as far as is known beforehand.

        Raises Refused, also where what follows from the numbers of the case is beyond the range of numbers.
        """
        try:
            found = self.with_strata(_curves(self.case, self.models), _most_levels(self.scene))
            if self.case.roughness:
                found |= {name: with_theory(found[name]) for name in (SPEED, LOAD) if name in found}
            refuse([found[OWN]])
        except (ArithmeticError, SolveError, InvalidInput) as error:
            # The case is valid; what follows from it is not.
            raise Refused("its numbers are so far apart that the contact leaves their range") from error
        return found

    @property
    def remarks(self) -> Sequence[str]:
        extended = any(each.name == "ExtendedBEM" for each in self.models)
        return (*self.case.departures, *self.case.notes, *([EXTENDED] if extended else []))

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
        friction = [MU] if self.case.slides and self.case.motion.speed > 0 else []
        return [*friction, "normal_force" if self.case.motion.pressed_by == "depth" else "depth_reached"]

    @property
    def wanted(self) -> Wanted:
        if not self.curves[OWN].over_time:
            yield from ((OWN, name, self.curves[OWN].speeds) for name in self.own_means)

    @property
    def history(self) -> bool:
        """Whether it is judged over time, or over what it is drawn by."""
        return isinstance(self.case.motion, Program | Shear)

    def more(self, answers: Answers, findings: Sequence[Finding]) -> dict[str, Counts]:
        """Numbers of surfaces that its own contact asks for; open claims on the curves around it ask for none."""
        return super().more(answers, [each for each in findings if each.curve == self.place(OWN)])

    def judge(self, answers: Answers) -> Judged:
        found = super().judge(answers)
        return replace(found, findings=[*found.findings, *(() if self.history else self._grid(answers))])

    def _grid(self, answers: Answers) -> Iterator[Finding]:
        """Change of the scene's own answer from half the points to all."""
        first = self.own_means[0]
        for model in answers.claiming(OWN, WORDS[first]):
            if model.has_grid:
                found = answers.compared(OWN, (model.name,), ratio_of(first, model.name)).at((0, 0))
                change = float(np.divide(found.grid, abs(found.value)))
                yield Finding(
                    CLAIMS["grid.change"], change, where=self.name, dimension=model.label, drawn=found.drawn
                )


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
    own = models.claiming(motion.pressed_by, sliding)
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
