"""The one-dimensional solver: the method of dimensionality reduction (MDR) behind the common protocol."""

from math import ceil, sqrt
from time import process_time
from typing import Annotated

from pydantic import Field
from pydantic.dataclasses import dataclass

from scene import Cylinder, Plane, Program, Result, Scene, SolveError, Wave
from scene.protocol import refuse, trusted
from scene.quantities import CLOSED, Positive, Whole

from .foundation import Contact, sweep
from .indentation import Sweep, at_depth, under_load
from .maxwell import sweep_modes
from .modes import modes_of
from .profile import Grid, Profile, lay_out, map_profile

# Span of a smooth contact over its grid below which the grid is drawn closer, and the room then left around it.
_LEAST_SHARE, _ROOM = 0.2, 1.05
# Pixels across a contact below which its forces are those of the pixels.
_LEAST_PIXELS = 5
# One period of roughness must fit into memory, and have waves at all.
_MOST_NODES, _LEAST_NODES = 2**25, 4


@dataclass(frozen=True, config=CLOSED)
class MDR:
    """Body of revolution on a viscoelastic half-space as a profile on a one-dimensional foundation.

    points : spacings of the grid over its extent, rounded up to an even number; on a rough indenter up to what
        divides its period into whole pixels
    extent : length of the grid, centred on the tip [m]; by default the period of the roughness if the grid is
        its cut-off (as in the paper), else the least that surely holds the contact

    Solves any elastomer, at rest with its relaxed modulus and in steady sliding. The contact is exact on a profile
    that is linear between nodes; against a smooth shape the error is of second order in the pixel.
    Result.residual is the relative misfit of a prescribed load, at most 1e-10, and zero at a prescribed depth;
    Result.applications counts sweeps along the profile.

    Result.measures: pixel, contact_length [m], contact_fraction (of the span from the first to the last contact),
    points_across_contact (pixels in that span), rms_slope_contact (of the profile over the real contact),
    stiffness dF_N/d(depth) [N/m], friction_by_traction [N] (-int g' f dx, where Result.friction_force is the
    energy lost per length slid); of a rough indenter also rms_height [m], rms_slope (finite differences) and
    rms_slope_spectral, each over a period, and points_per_shortest_wave.
    Result.fields: x, profile, displacement [m] and contact (bool) at the nodes.
    """

    points: Annotated[Whole, Field(ge=8, le=2**25)] = 5000
    extent: Positive | None = None

    @property
    def name(self) -> str:
        return "MDR"

    def refusals(self, scene: Scene) -> list[str]:
        """Why the scene cannot be solved, one sentence each; empty when it can."""
        reasons = []
        if isinstance(scene.indenter, Cylinder | Plane):
            reasons.append(
                f"a {type(scene.indenter).__name__} is no body of revolution, so it has no one-dimensional "
                "profile: use a Sphere, Cone or PowerLaw, or a three-dimensional solver"
            )
        elif isinstance(scene.motion, Program):
            reasons.append(
                "motion = Program is a history in time, which is not followed in one dimension: use Indent or "
                "Slide, or a three-dimensional solver"
            )
        elif isinstance(scene.roughness, Wave):
            reasons.append(
                f"roughness = {type(scene.roughness).__name__} is not isotropic, so no one-dimensional spectrum "
                "stands for it: use SelfAffine, or a three-dimensional solver"
            )
        elif scene.roughness is not None:
            reasons += _too_broad(scene) or _unresolved(
                scene, lay_out(scene, self.points, self.extent), self.points
            )
        return reasons

    def solve(self, scene: Scene) -> Result:
        """Solve the scene.

        Raises Refused for what refusals names; EmptyContact if a prescribed depth does not reach the highest
        asperity; SolveError if the contact leaves the grid, or a smooth one spans too few of its pixels.
        """
        refuse(self, scene)
        start = process_time()
        with trusted():
            layout, body, approach, contact, sweeps = self._pressed(scene)
        modulus = scene.elastomer.indentation_modulus
        seconds = process_time() - start
        force, load = modulus * contact.force, scene.motion.load
        return Result(
            scene=scene,
            solver=self.name,
            settings={
                "points": 2 * layout.half,
                "extent": layout.extent,
                "pixel": layout.pixel,
                "cutoff": _cutoff(scene),
            },
            normal_force=force,
            depth=approach + body.lowest,
            friction_force=modulus * contact.dissipation,
            residual=0.0 if load is None else abs(force / load - 1),
            applications=sweeps,
            seconds=seconds,
            measures=_measures(body, contact, modulus),
            fields={
                "x": body.x,
                "profile": body.heights,
                "displacement": contact.displacement,
                "contact": contact.touching,
            },
        )

    def _pressed(self, scene: Scene):
        """The contact, on a grid drawn closer around the tip while viscosity keeps a smooth contact small."""
        press = at_depth if scene.motion.load is None else under_load
        sweep, total, extent = _flow(scene), 0, self.extent
        while True:
            layout = lay_out(scene, self.points, extent)
            body = map_profile(scene, layout)
            approach, contact, sweeps = press(scene, body, sweep)
            total += sweeps
            span = contact.last - contact.first
            free = self.extent is None and scene.roughness is None
            if not (free and span < _LEAST_SHARE * layout.extent):
                break
            reach = max(abs(end - layout.extent / 2) for end in (contact.first, contact.last))
            # A contact of a few pixels is known to a pixel at best.
            extent = 2 * _ROOM * (reach + _LEAST_PIXELS * layout.pixel)
        if body.surface is None:
            _check_resolved(body, span)
        return layout, body, approach, contact, total


def _flow(scene: Scene) -> Sweep:
    """The sweep for the elastomer at its speed: Kelvin's own where no Maxwell branch remembers anything."""
    elastomer, speed = scene.elastomer, scene.motion.speed
    equilibrium, moduli, _ = elastomer.relaxation()
    if speed > 0 and moduli.size:
        modes = modes_of(elastomer)
        return lambda heights, pixel, depth: sweep_modes(heights, pixel, modes, speed, depth)
    memory = speed * elastomer.viscosity / equilibrium
    return lambda heights, pixel, depth: sweep(heights, pixel, memory, depth)


def _check_resolved(body: Profile, span: float) -> None:
    """A rough profile is what its nodes make it and may touch on less than a pixel; a smooth shape may not."""
    if span < _LEAST_PIXELS * body.pixel:
        raise SolveError(
            f"the contact spans {span / body.pixel:.2g} pixels of {body.pixel:g} m, {_LEAST_PIXELS} are needed: "
            "take more points or a smaller extent"
        )


def _too_broad(scene: Scene) -> list[str]:
    """Whether the spectrum alone asks for too much."""
    rough = scene.roughness
    if rough.shortest is None or rough.longest / rough.shortest <= _MOST_NODES / 16:
        return []
    return [
        f"roughness from longest = {rough.longest:g} to shortest = {rough.shortest:g} spans a ratio of "
        f"{rough.longest / rough.shortest:g}, more than {_MOST_NODES // 16}: raise shortest"
    ]


def _unresolved(scene: Scene, layout: Grid, points: int) -> list[str]:
    """What is wrong with the grid for the roughness."""
    rough = scene.roughness
    needed = _LEAST_NODES if rough.shortest is None else ceil(2 * rough.longest / rough.shortest * (1 - 1e-12))
    if layout.period < needed:
        shortest = "" if rough.shortest is None else f", shortest = {rough.shortest:g},"
        enough = ceil(needed * layout.extent / rough.longest)
        return [
            f"points = {points} over an extent of {layout.extent:g} m make a pixel of {layout.pixel:g} m, on "
            f"which roughness with longest = {rough.longest:g}{shortest} is not resolved: "
            f"it takes at least points = {enough}"
        ]
    if layout.period > _MOST_NODES:
        return [
            f"points = {points} over an extent of {layout.extent:g} m divide the period roughness.longest = "
            f"{rough.longest:g} into {layout.period} pixels, more than {_MOST_NODES}: take fewer points, a larger "
            "extent or a shorter period"
        ]
    return []


def _cutoff(scene: Scene) -> str | None:
    if scene.roughness is None:
        return None
    return "nyquist" if scene.roughness.shortest is None else "resolved"


def _measures(body: Profile, contact: Contact, modulus: float) -> dict[str, float]:
    # Rounding of the two ends may leave nothing of a minute contact.
    span = max(contact.last - contact.first, contact.length)
    measures = {
        "pixel": body.pixel,
        "contact_length": contact.length,
        "contact_fraction": contact.length / span,
        "points_across_contact": span / body.pixel,
        "rms_slope_contact": sqrt(contact.slope_square / contact.length),
        "friction_by_traction": modulus * contact.traction,
        "stiffness": modulus * contact.stiffness,
    }
    if (surface := body.surface) is not None:
        measures |= {
            "rms_height": surface.rms_height,
            "rms_slope": surface.rms_slope,
            "rms_slope_spectral": surface.rms_slope_spectral,
            "points_per_shortest_wave": surface.shortest / surface.pixel,
        }
    return measures
