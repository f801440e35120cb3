"""The one-dimensional solver: the method of dimensionality reduction (MDR) behind the common protocol."""

import logging
from dataclasses import replace
from math import ceil, inf
from time import process_time
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field
from pydantic.dataclasses import dataclass

from scene import Doubt, EmptyContact, Program, Result, Scene, SolveError, doubts
from scene.plan import Plan
from scene.protocol import numeric_guard, refuse, shortage
from scene.quantities import CLOSED, Length, Whole
from scene.surfaces.roughness import Roughness
from scene.terms import Table, refused_parts, terms_of, wrap_solve

from .accuracy import friction_error
from .history import at_greatest, marched
from .indentation import Sweep, at_depth, under_load
from .kelvin import sweep
from .measures import measures
from .modes import modes_of
from .plan import plan_of
from .profile import Grid, check_resolved, drawn_closer, lay_out, map_profile, unmapped
from .steady import sweep_modes
from .surface import MOST_NODES, Band, Spectrum, band_of
from .terms import TERMS

_LOG = logging.getLogger(__name__)
SPARE = 1.25  # of an extent, for the contacts of other draws
FULLER = 1.01  # of two pixels, so that they are carried with few digits too


@dataclass(frozen=True, config=CLOSED)
class MDR:
    """Body of revolution on a viscoelastic half-space as a profile on a one-dimensional foundation.

    points : spacings of the grid over its extent, rounded up to an even number; on a rough indenter up to what
        divides its period into whole pixels
    extent : length of the grid, centred on the tip [m]; by default the period of the roughness if the grid is
        its cut-off (as in the paper), else the least that surely holds the contact
    shape : "mapped", the line kappa_n c |x|^n of the body c r^n, which keeps its relaxed force and depth, or
        "as-given", its meridian c |x|^n; the paper leaves open which
    spectrum : of the rough line, "mapped", C_1D = pi q C_2D, or "line-scan", the spectrum of a cut of the rough
        surface
    steps : in time, of the whole of a Program; while it slides, a step is a pixel of path at most
    frames : instants of a Program, alike apart, at which the contact is kept in the fields

    Solves any elastomer, at rest with its relaxed modulus, in steady sliding and in time. The contact is exact on
    a profile that is linear between nodes; against a smooth shape the error is of second order in the pixel.
    Result.residual is the relative misfit of a prescribed load, at most 1e-10, and zero at a prescribed depth;
    Result.operator_applications counts sweeps along the profile.

    >>> from mdr1d import MDR
    >>> from scene import Kelvin, Scene, Slide, Sphere
    >>> solid = Kelvin(modulus=1e6, relaxation_time=1e-3)
    >>> answer = MDR(points=2000).solve(Scene(Sphere(radius=10e-3), solid, Slide(speed=0.1, load=1.0)))
    >>> print(f"{1e3 * answer.depth:.3f} mm, {answer.friction_coefficient:.4f}")
    0.152 mm, 0.0188

    Result.measures: friction_error, a bound of 95 % on the relative error of friction by the grid, against the
    same line on ever finer grids, absent without friction; pixel, contact_length [m], contact_fraction (of the
    span from the first to the last contact),
    points_across_contact (pixels in that span), rms_slope_contact (of the profile over the real contact),
    stiffness dF_N/d(depth) [N/m], friction_by_traction [N] (-int g' f dx, where Result.friction_force is the
    energy lost per length slid), one_sidedness and load_on_leading_flanks (shares of the real contact and of the
    load where g' < 0); of a rough indenter also rms_height [m], rms_slope (finite differences) and
    rms_slope_spectral, each over a period, points_per_shortest_wave, and of scene.Regime height_over_depth,
    contact_over_period and macro_over_rough, with the smooth relaxed contact of the line.
    Result.fields: x, profile, displacement [m] and contact (bool) at the nodes, and line_force [N/m], the mean
    force per length from each node to the next.

    With Coulomb friction in the interface, in sliding: measures friction_in_elastomer, friction_in_interface [N],
    which together are the friction. Under a Shear: friction_force is the tangential force; measures
    friction_in_interface, tangential_displacement, stick_length, slip_length [m]; fields slip [m] at the nodes, of
    the elastomer past the indenter, and tangential_line_force [N/m] as line_force.

    In a Program the elements lie a pixel apart and each is followed in time, exactly at a prescribed depth that
    does not oscillate; a load is met once a step. Result.fields: time [s], path [m], depth [m], normal_force [N],
    contact_length [m], work of the indenter, dissipated and stored energy [J] at the end of each step (steps,),
    its speed [m/s], and the mean friction_force [N], by traction, over the last whole pixel slid one way, else
    over the step; path, speed and the friction that opposes them are below zero backwards; x, profile,
    displacement, contact of the elements at the end. The result's own forces and depth are the last of those.
    Without load the depth is that at which the indenter just touches. Result.measures: of the above pixel,
    contact_length, contact_fraction, points_across_contact; stiffness, dF_N over d(depth) of a sudden step,
    infinite with a dashpot; time_steps. Result.residual is the misfit of the load over the greatest one.
    With `frames` also, at the ends of the steps nearest to these instants: frame_time [s], frame_depth [m] (F,);
    frame_x, frame_profile, frame_displacement [m] and frame_contact (bool) of the elements (F, N).
    """

    terms: ClassVar[Table] = TERMS

    points: Annotated[Whole, Field(ge=8, le=2**25)] = 5000
    extent: Length | None = None
    shape: Literal["mapped", "as-given"] = "mapped"
    spectrum: Spectrum = "mapped"
    steps: Annotated[Whole, Field(ge=1, le=10**6)] = 200
    frames: Annotated[Whole, Field(ge=0, le=10**4)] = 0

    @property
    def name(self) -> str:
        return "MDR"

    def refusals(self, scene: Scene) -> list[str]:
        """Reasons why the scene cannot be solved, one sentence each; empty when it can."""
        reasons = refused_parts(self.terms, scene)
        if not reasons and scene.roughness is not None:
            rough, band = scene.roughness, band_of(scene.roughness, self.spectrum)
            reasons += _too_broad(band) or _unresolved(rough, band, self._laid_out(scene), self.points)
        return reasons or shortage(plan_of(self, scene, self._laid_out(scene)).memory)

    def foreseen(self, scene: Scene) -> list[str]:
        """Reasons why a solve that is not refused would fail all the same: by a stated extent, which is tried."""
        if self.extent is None or isinstance(scene.motion, Program):
            return []
        try:
            self._pressed(self._reduced(scene))
        except EmptyContact:
            return []
        except SolveError as reason:
            return [str(reason)]
        return []

    def doubts(self, scene: Scene) -> tuple[Doubt, ...]:
        """Doubts about a scene, whose roughness this grid may cut off. Nothing is solved."""
        rough = scene.roughness
        if rough is None or rough.shortest is not None or self.refusals(scene):
            return doubts(scene)
        return doubts(scene, self._laid_out(scene).pixel)

    def plan(self, scene: Scene) -> Plan:
        """Plan of a scene: the parts that would be simulated, and their costs; nothing is solved.

        Raises Refused as `solve` does, and SolveError for a program of too many steps or lengths beyond the range
        of numbers. For which other reasons a solve would fail, as far as that shows beforehand, `foreseen` says.
        """
        with numeric_guard():
            refuse(self, scene)
            return replace(plan_of(self, scene, self._laid_out(scene)), doubts=self.doubts(scene))

    def solve(self, scene: Scene) -> Result:
        """Solve the scene.

        Raises Refused for what refusals names; EmptyContact if a prescribed depth does not reach the highest
        asperity; SolveError if the contact leaves the grid, or a smooth one spans too few of its pixels;
        OutOfMemory where memory ran out.
        """
        with numeric_guard():
            refuse(self, scene)
            result = wrap_solve(self._solved, terms_of(self.terms, scene))(scene)
            if not np.isfinite([result.normal_force, result.friction_force]).all():
                raise ArithmeticError("forces beyond the range of numbers")
            _LOG.info("answered with %s", result.settings)
            return result

    def _solved(self, scene: Scene) -> Result:
        start, reduced = process_time(), self._reduced(scene)
        if isinstance(scene.motion, Program):
            return marched(self, scene, reduced, start)
        result = self._steady(scene, reduced, start)
        for term in terms_of(self.terms, scene):
            result = term.completed(result)
        return result

    def _steady(self, scene: Scene, reduced: Scene, start: float) -> Result:
        layout, body, approach, contact, sweep, sweeps = self._pressed(reduced)
        modulus, load = scene.solid.indentation_modulus, scene.motion.load
        seconds = process_time() - start
        force = modulus * contact.force
        if not 0 < force < inf:
            raise ArithmeticError(f"a force of {force:g} N is beyond the range of numbers")
        error = friction_error(body, approach, contact, sweep, load is not None)
        return Result(
            scene=scene,
            solver=self.name,
            settings=self.settings(scene, layout),
            normal_force=force,
            depth=approach + body.lowest,
            friction_force=modulus * contact.dissipation,
            residual=0.0 if load is None else abs(force / load - 1),
            operator_applications=sweeps,
            seconds=seconds,
            measures=measures(reduced, body, contact) | ({} if error is None else {"friction_error": error}),
            fields={
                "x": body.x.copy(),
                "profile": body.heights.copy(),
                "displacement": contact.displacement,
                "contact": contact.touching,
                "line_force": modulus / body.pixel * np.append(contact.pushed[:, 1], 0.0),
            },
        )

    def settings(self, scene: Scene, layout: Grid) -> dict:
        """Settings of the solve, derived ones included."""
        return {
            "points": 2 * layout.half,
            "extent": layout.extent,
            "pixel": layout.pixel,
            "cutoff": _cutoff(scene),
            "shape": self.shape,
            "spectrum": self.spectrum,
        }

    def _laid_out(self, scene: Scene) -> Grid:
        """The first grid."""
        reduced = self._reduced(scene)
        if isinstance(scene.motion, Program):
            reduced = at_greatest(reduced)
        return lay_out(reduced, self.points, self.extent, self.spectrum)

    def _reduced(self, scene: Scene) -> Scene:
        """The scene whose mapped profile is the line asked for."""
        return scene if self.shape == "mapped" else unmapped(scene)

    def _pressed(self, scene: Scene):
        """The contact, on a grid drawn closer around the tip while viscosity keeps a smooth contact small."""
        press = at_depth if scene.motion.load is None else under_load
        sweep, total, extent = _flow(scene), 0, self.extent
        while True:
            layout = lay_out(scene, self.points, extent, self.spectrum)
            body = map_profile(scene, layout, self.spectrum)
            approach, contact, sweeps = press(scene, body, sweep)
            total += sweeps
            span = contact.last - contact.first
            reach = max(abs(end - layout.extent / 2) for end in (contact.first, contact.last))
            free = self.extent is None and scene.roughness is None
            extent = drawn_closer(layout, span, reach) if free else None
            if extent is None:
                # A rough profile is what its nodes make it and may touch on less than a pixel.
                if body.surface is None:
                    check_resolved(body, span)
                return layout, body, approach, contact, sweep, total


def _flow(scene: Scene) -> Sweep:
    """The sweep for the elastomer at its speed: Kelvin's own where no Maxwell branch remembers anything."""
    elastomer, speed = scene.solid, scene.motion.speed
    equilibrium, moduli, _ = elastomer.relaxation()
    if speed > 0 and moduli.size:
        modes = modes_of(elastomer)
        return lambda heights, pixel, depth: sweep_modes(heights, pixel, modes, speed, depth)
    memory = speed * elastomer.viscosity / equilibrium
    return lambda heights, pixel, depth: sweep(heights, pixel, memory, depth)


def _too_broad(band: Band) -> list[str]:
    """Reason why the spectrum has too many waves on any grid."""
    if band.shortest is None or band.period / band.shortest <= MOST_NODES / 16:
        return []
    return [
        f"roughness from longest = {band.period:g} to shortest = {band.shortest:g} spans a ratio of "
        f"{band.period / band.shortest:g}, more than {MOST_NODES // 16}: raise shortest, or state "
        "shortest_kept"
    ]


def _unresolved(rough: Roughness, band: Band, layout: Grid, points: int) -> list[str]:
    """Reasons why the grid does not resolve the roughness."""
    if layout.period is None or layout.period < band.nodes:
        shortest = "" if band.shortest is None else f", shortest = {band.shortest:g},"
        enough = ceil(band.nodes * layout.extent / band.period)
        return [
            f"points = {points} over an extent of {layout.extent:g} m make a pixel of {layout.pixel:g} m, on "
            f"which roughness with longest = {band.period:g}{shortest} is not resolved: "
            f"it takes at least points = {enough:.15g}{_room(rough, band, layout, enough)}"
        ]
    if layout.period > MOST_NODES:
        return [
            f"points = {points} over an extent of {layout.extent:g} m divide the period roughness.longest = "
            f"{band.period:g} into {layout.period:.15g} pixels, more than {MOST_NODES}: take fewer points, a "
            "larger extent or a shorter period"
        ]
    return []


def _room(rough, band, layout, enough):
    """Advice that leaves room for other draws of the roughness, whose contacts may be wider."""
    advice = f"; points = {ceil(SPARE * enough):.15g} would leave room for other draws"
    kept = 2 * SPARE * layout.pixel
    if (keepable := getattr(rough, "keepable", None)) is not None:
        least, most = keepable
        kept = max(kept, FULLER * least)
        if kept <= most:
            advice += f"; roughness.shortest_kept = {kept:.3g} would leave out waves that the pixels cannot carry"
    elif band.shortest is not None and kept <= band.period / 2:
        advice += f"; roughness.shortest = {kept:.3g} would do"
    return advice


def _cutoff(scene: Scene) -> str | None:
    if scene.roughness is None:
        return None
    return "nyquist" if scene.roughness.shortest is None else "resolved"
