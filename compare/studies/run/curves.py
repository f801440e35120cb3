"""Curves around one scene: its own contact, force against depth, friction against speed and against load."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TypeAlias

from pydantic import ValidationError

from mdr1d import equations
from scene import Indent, Refused, Scene, SolveError, Solver
from scene.scales import elastic_contact

from ...library.case import Case
from ...models import exact
from ...models.table import PROFILES, ModelLike, Models
from ...solving.parameter_grid import COARSE, FINE, LEVELS, ParameterGrid, levels, refuse
from ..theory import with_theory

OWN, SPEED, LOAD = "own", "friction-speed", "friction-load"
ROUGH_DEPTH, SMOOTH_DEPTH, SMOOTH_SPEED = "force-depth-rough", "force-depth-smooth", "smooth-speed"
CURVES = {
    OWN: "The scene as it stands",
    ROUGH_DEPTH: "Force against depth, rough",
    SMOOTH_DEPTH: "Force against depth, smooth",
    SPEED: "Friction against speed",
    LOAD: "Friction against load",
    SMOOTH_SPEED: "Friction of the smooth body against speed",
}


def models_of(case: Case, asked: Sequence[ModelLike] | None = None, reference: str | None = None) -> Models:
    """Models that are asked for, else those that a case names, with the case's settings. Raises InvalidInput."""
    own: dict[str, Solver] = {"mdr": case.mdr, "bem": case.bem}
    return Models.of(asked or case.models or None, reference or case.reference or None, own)


# Rough curves whose contacts share their surfaces: those of one are as many as those of the others.
REST, SLIDING = "rest", "sliding"
SHARED = {REST: (ROUGH_DEPTH,), SLIDING: (OWN, SPEED, LOAD)}
Strata: TypeAlias = Mapping[str, Mapping[str, tuple[int, ...]]]


def curves(case: Case, models: Models, strata: Strata | None = None) -> dict[str, ParameterGrid]:
    """Parameter grids of a case by name, all of which every model can solve, as far as that is known beforehand.

    strata : numbers of surfaces on each grid by model, of REST and SLIDING, where these are not fixed; those of a
        pilot where one of them is not stated. Fewer numbers than grids leave out the coarsest

    Raises Refused, also where what follows from the numbers of the case is beyond the range of numbers.
    """
    try:
        found = _curves(case, models)
        if strata is not None and case.roughness:
            found |= _in_strata(found, models, strata)
        found |= {name: with_theory(found[name]) for name in (SPEED, LOAD) if name in found}
        refuse(found.values())
    except (ArithmeticError, SolveError, ValidationError) as error:
        # The case is valid; what follows from it is not.
        raise Refused("its numbers are so far apart that the contact leaves their range") from error
    return found


def corners(grids: Mapping[str, ParameterGrid]) -> Iterator[Scene]:
    """Contacts at the ends of all curves."""
    return (corner for grid in grids.values() for corner in grid.corners)


def _curves(case, models):
    plan, scene, motion = case.plan(), case.scene, case.motion
    smooth = replace(scene, roughness=None)
    found = {OWN: _grid(case, models, scene, (motion.speed,), (motion.greatest,), keeps_fields=True)}
    depths = tuple(factor * elastic_contact(scene).depth for factor in plan.depths)
    indented = Indent(depth=depths[0])
    if case.roughness:
        found[ROUGH_DEPTH] = _grid(case, models, replace(scene, motion=indented), (0.0,), depths)
    pressed = _grid(case, models, replace(smooth, motion=indented), (0.0,), depths)
    closed_form = exact.Exact()
    if closed_form.name not in pressed.grids and not closed_form.refusals(pressed.scene):
        known: dict[str, dict[str, Solver]] = {closed_form.name: {FINE: closed_form, COARSE: closed_form}}
        pressed = replace(pressed, grids={**pressed.grids, **known})
    found[SMOOTH_DEPTH] = pressed
    if plan.speeds:
        found[SPEED] = _grid(case, models, scene, plan.speeds, (motion.greatest,))
        loads = tuple(motion.greatest * factor for factor in plan.pressing)
        found[LOAD] = _grid(case, models, scene, plan.load_speeds, loads)
    if plan.smooth_speeds:
        found[SMOOTH_SPEED] = _grid(case, models, smooth, plan.smooth_speeds, (motion.greatest,))
    return found


def _in_strata(found, models, strata):
    """The rough curves on all grids that hold them, with so many surfaces on each."""
    from ...statistics.multilevel import in_strata  # slow, and a plan has no use for it

    made = {}
    for shared, names in SHARED.items():
        own = {name: found[name] for name in names if name in found}
        if own:
            sampled = in_strata(list(own.values()), models, strata.get(shared, {}), _most_grids(found[OWN].scene))
            made |= dict(zip(own, sampled, strict=True))
    return made


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


def _grid(case: Case, models: Models, scene: Scene, speeds, values, keeps_fields=False) -> ParameterGrid:
    """Contacts on the grid of each solver, and on half its points where that is a grid of the same surface."""
    plan, models = case.plan(), models.telling(scene.motion.pressed_by, any(speeds))
    found = ParameterGrid(
        scene=scene,
        speeds=tuple(speeds),
        values=tuple(values),
        grids={each.name: {FINE: each.solver} for each in models},
        draws={each.name: each.count(plan.profiles, plan.surfaces) for each in models},
        keeps_fields=keeps_fields,
    )
    return replace(found, grids=levels(models, [found], min(2, _most_grids(scene))))


def _most_grids(scene):
    """A grid that cuts the roughness off has another surface on half the points."""
    return 1 if scene.roughness is not None and scene.roughness.shortest is None else len(LEVELS)
