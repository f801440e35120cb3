"""`ExtendedBEM`: friction of surfaces finer than a grid, by BEM on coarse waves and the law for the finer ones."""

from dataclasses import replace
from math import pi, sqrt
from time import process_time
from typing import Annotated, Any, ClassVar

import numpy as np
from pydantic import Field
from pydantic.dataclasses import dataclass

from bem3d import BEM
from scene import Profile, Result, Scene, SelfAffine, Slide, SolveError, Topography
from scene.protocol import numeric_guard, refuse
from scene.quantities import CLOSED, Whole
from scene.signatures import readable
from scene.terms import terms_of

from .bands import Bands
from .parts import LawParts
from .persson import OF_BODIES

FINE, ENOUGH = 8.0, 6.5  # points to the shortest wave that is kept: as planned, and at least
COARSE = 64  # points of the contact that shows how wide the window is
ROUNDS = 4  # of the cut, which follows from the window, which follows from the contact


@readable
@dataclass(frozen=True, config=CLOSED)
class ExtendedBEM:
    """Boundary elements on the waves that a grid holds, and the law of friction in 3D for the finer ones.

    points : a side of the grid; waves of fewer than eight pixels are left to the law

    The coefficient is mu_BEM(waves kept) + mu_law(all waves) - mu_law(waves kept), with both laws under the load
    that BEM found. Where the grid holds every wave it is the coefficient of BEM. The depth belongs to the
    contact on the waves kept.

    Result.measures: those of BEM; shortest_kept [m], the shortest wave that is solved; slope_kept, the rms slope
    of the waves kept over the rms slope of all; friction_kept and friction_added, the coefficient of the waves
    kept and what the law adds; height_left [m], the rms height of the waves that are left to the law.
    """

    label: ClassVar[str] = "3D extended"
    draws: ClassVar[str] = "surfaces"
    # Whose code and data the answer depends on.
    packages: ClassVar[tuple[str, ...]] = ("bem3d", "compare.models")

    points: Annotated[Whole, Field(ge=COARSE, le=16384)] = 256

    @property
    def name(self) -> str:
        return "ExtendedBEM"

    def refusals(self, scene: Scene) -> list[str]:
        """Reasons why the scene cannot be solved, one sentence each."""
        reasons = [reason for term in terms_of(OF_BODIES, scene) for reason in term.refusals(scene)]
        return reasons or BEM(points=self.points).refusals(_coarsest(scene))

    def solve(self, scene: Scene) -> Result:
        """Friction of all waves. Raises Refused, and SolveError as BEM does, and where the law has no answer."""
        start = process_time()
        refuse(self, scene)
        solver, coarsest = BEM(points=self.points), _coarsest(scene)
        rough: Any = scene.roughness
        if coarsest is scene:
            return replace(solver.solve(scene), solver=self.name)
        first = BEM(points=COARSE).solve(coarsest)
        finest = rough.shortest
        shortest = max(finest, FINE * first.settings["extent"] / self.points)
        for _ in range(ROUNDS):
            if shortest > coarsest_wave(rough):
                needed = shortest / coarsest_wave(rough) * self.points
                raise SolveError(f"points = {self.points} hold no wave of the roughness: {needed:.0f} would")
            kept = scene if shortest <= finest else without(scene, shortest)
            cut: Any = kept.roughness
            found = solver.solve(kept)
            pixels = found.measures["points_per_shortest_wave"]
            if kept is scene or pixels >= ENOUGH:
                break
            shortest *= FINE / pixels
        else:
            raise SolveError(
                f"no cut of the spectrum leaves waves of {ENOUGH:g} pixels on {self.points} points a side"
            )
        if kept is scene:
            return replace(found, solver=self.name)
        with numeric_guard():
            own, whole = (LawParts.of(under(each, found.normal_force)) for each in (kept, scene))
            solved, added = found.friction_coefficient, whole.friction_coefficient - own.friction_coefficient
            every, left = Bands.of(rough), Bands.of(cut)
        return replace(
            found,
            scene=scene,
            solver=self.name,
            friction_force=(solved + added) * found.normal_force,
            seconds=process_time() - start,
            measures={
                **found.measures,
                "shortest_kept": shortest,
                "slope_kept": slope(left) / slope(every),
                "friction_kept": solved,
                "friction_added": added,
                "height_left": sqrt(max(every.rms_height**2 - left.rms_height**2, 0.0)),
            },
        )


def _coarsest(scene):
    """The scene with the longest waves alone; as it stands where it has no finer ones that rub."""
    rough = scene.roughness
    if rough is None or rough.flat or not isinstance(scene.motion, Slide):
        return scene
    longest = coarsest_wave(rough)
    return scene if rough.shortest >= longest else without(scene, longest)


def coarsest_wave(rough: Any) -> float:
    """Longest wave [m] that can be the shortest of a roughness: half of its period, along its shorter side."""
    return (min(rough.sides) if isinstance(rough, Topography) else rough.longest) / 2


def slope(bands: Bands) -> float:
    """Rms slope of bands of waves."""
    return bands.unit * sqrt(float(np.sum(bands.power * np.square(bands.q))))


def without(scene: Scene, shortest: float) -> Scene:
    """The scene without the waves of its roughness that are shorter than a length [m]."""
    rough: Any = scene.roughness
    if isinstance(rough, Profile):
        rough = rough.fitted
    if not isinstance(rough, SelfAffine):
        return replace(scene, roughness=replace(rough, shortest_kept=shortest))
    kept = float(rough.share(rough.q_min, 2 * pi / shortest, rough.q_max(0.0)))
    rolloff = None if rough.rolloff is None else max(rough.rolloff, shortest * (1 + 1e-9))
    fewer = replace(rough, shortest=shortest, rolloff=rolloff, rms_height=rough.rms_height * sqrt(kept))
    return replace(scene, roughness=fewer)


def under(scene: Scene, load: float) -> Scene:
    """The scene under a load [N]."""
    return replace(scene, motion=Slide(speed=scene.motion.speed, load=load))
