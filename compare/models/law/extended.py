"""`ExtendedBEM`: friction of surfaces finer than a grid, by BEM on coarse waves and the law for the finer ones."""

from dataclasses import replace
from math import exp, inf, pi, sqrt
from pathlib import Path
from time import process_time
from typing import Annotated, Any, ClassVar

import numpy as np
from pydantic import Field
from pydantic.dataclasses import dataclass

from bem3d import BEM
from scene import Plane, Profile, Result, Scene, SelfAffine, Slide, SolveError, Topography
from scene.protocol import numeric_guard, refuse, why_not
from scene.quantities import CLOSED, Positive, Whole
from scene.signatures import readable
from scene.terms import refused_parts

from .bands import Bands
from .parts import LawParts, rows_of
from .persson import OF_LAW

FINE, ENOUGH = 8.0, 6.5  # points to the shortest wave that is kept: as planned, and at least
COARSE = 64  # points of the contact that shows how wide the window is
# Beyond which what enters the interval changes no more: share of friction added, waves in the contact, x.
LEAST_ADDED, FEW_WAVES, LEAST_WAVES, LIGHT = 0.02, 20.0, 0.1, 0.1
MOST_POINTS = 4096  # a side of the finest grid that a wanted accuracy leads to
ROUNDS = 4  # of the cut, which follows from the window, which follows from the contact


@readable
@dataclass(frozen=True, config=CLOSED)
class ExtendedBEM:
    """Boundary elements on the waves that a grid holds, and the law of friction in 3D for the finer ones.

    points : a side of the grid; waves of fewer than eight pixels are left to the law
    accuracy : half of the interval of 95 % of friction that is wanted, relative: points are doubled until it is
        reached, up to MOST_POINTS; None leaves them as they are

    The coefficient is mu_BEM(waves kept) + mu_law(all waves) - mu_law(waves kept), with both laws under the load
    that BEM found; the waves left to the law never lower it. Where the grid holds every wave it is the coefficient
    of BEM; where it holds none, BEM solves the smooth body. The depth, or the force at a depth, is that of the
    contact on the waves kept.

    Result.measures: those of BEM; shortest_kept [m], the shortest wave that is solved, infinite where none is;
    slope_kept, the rms slope of the waves kept over the rms slope of all; friction_kept and friction_added, the
    coefficient of the waves kept and what the law adds; friction_low and friction_high, interval of 95 % of one
    surface, from contacts that were solved with every wave too; height_left [m], the rms height of the waves that
    are left to the law.
    """

    label: ClassVar[str] = "3D extended"
    draws: ClassVar[str] = "surfaces"
    # Whose code and data the answer depends on.
    packages: ClassVar[tuple[str, ...]] = ("bem3d", "compare.models")

    points: Annotated[Whole, Field(ge=COARSE, le=16384)] = 256
    accuracy: Annotated[Positive, Field(lt=1)] | None = None

    @property
    def name(self) -> str:
        return "ExtendedBEM"

    @property
    def work(self) -> float:
        """Cost of a contact in passes over a point of a grid: of BEM, which often solves it once more."""
        return 4e6 + 115.0 * self.points**2

    def refusals(self, scene: Scene) -> list[str]:
        """Reasons why the scene cannot be solved, one sentence each."""
        reasons = refused_parts(OF_LAW, scene)
        return reasons or BEM(points=self.points).refusals(without_fine_waves(scene))

    def solve(self, scene: Scene) -> Result:
        """Friction of all waves. Raises Refused, and SolveError as BEM does, and where the law has no answer."""
        start = process_time()
        refuse(self, scene)
        points, found = self.points, self._solved(scene, self.points)
        while self.accuracy and _half(found) > self.accuracy and 2 * points <= MOST_POINTS:
            points *= 2
            if why_not(BEM(points=points), without_fine_waves(scene)):  # no memory for it
                break
            found = self._solved(scene, points)
        return replace(found, seconds=process_time() - start)

    def _solved(self, scene: Scene, points: int) -> Result:
        kept, found = _kept(scene, points)
        if kept is scene:
            return replace(found, solver=self.name)
        with numeric_guard():
            measures = _with_law(scene, kept, found)
        return replace(
            found,
            scene=scene,
            solver=self.name,
            friction_force=(measures["friction_kept"] + measures["friction_added"]) * found.normal_force,
            measures={**found.measures, **measures},
        )


def _half(found: Result) -> float:
    """Half of the interval of friction, relative; 0 where BEM solved every wave, or nothing slides."""
    coefficient = found.friction_coefficient
    return found.measures.get("friction_high", coefficient) / coefficient - 1 if coefficient else 0.0


def _kept(scene: Scene, points: int) -> tuple[Scene, Result]:
    """The scene with the waves that a grid holds, and the answer of BEM to it."""
    solver, base = BEM(points=points), without_fine_waves(scene)
    if base is scene:
        return scene, solver.solve(scene)
    rough: Any = scene.roughness
    shortest = max(rough.shortest, FINE * BEM(points=COARSE).solve(base).settings["extent"] / points)
    for _ in range(ROUNDS):
        kept = scene if shortest <= rough.shortest else without(scene, shortest)
        found = solver.solve(kept)
        pixels = found.measures.get("points_per_shortest_wave", FINE)
        if kept is scene or pixels >= ENOUGH:
            return kept, found
        shortest *= FINE / pixels
    raise SolveError(f"no cut of the spectrum leaves waves of {ENOUGH:g} pixels on {points} points a side")


def _with_law(scene, kept, found) -> dict[str, float]:
    """What the law adds to the friction of the waves kept, and what the cut leaves."""
    cut, every = kept.roughness, Bands.of(scene.roughness)
    left = Bands.of(cut) if cut else replace(every, power=0 * every.power)
    solved, added, half = found.friction_coefficient, 0.0, 0.0
    if isinstance(scene.motion, Slide):
        whole = LawParts.of(under(scene, found.normal_force))
        own = LawParts.of(under(kept, found.normal_force)).friction_coefficient if cut else whole.smooth
        # In 96 of 777 solved cuts the law falls with more waves; BEM rose in 84 of these, and fell by 5 % at most.
        added = max(whole.friction_coefficient - own, 0.0)
    shortest = cut.shortest if cut else inf
    if total := solved + added:
        half = uncertainty(
            added=added / total,
            waves=found.measures["contact_area"] / shortest**2,
            x=whole.x,
            rough=whole.rough / whole.friction_coefficient,
        )
    return {
        "shortest_kept": shortest,
        "slope_kept": slope(left) / slope(every),
        "friction_kept": solved,
        "friction_added": added,
        "friction_low": total * exp(-half),
        "friction_high": total * exp(half),
        "height_left": sqrt(max(every.rms_height**2 - left.rms_height**2, 0.0)),
    }


UNCERTAINTY = Path(__file__).with_name("extended.csv")


def uncertainty(**numbers: float) -> float:
    """Half an interval of 95 % of the logarithm of friction, fitted to contacts solved with every wave too."""
    numbers = {"one": 1.0, **scales(**numbers)}
    return exp(sum(float(row["value"]) * numbers[row["times"]] for row in rows_of(UNCERTAINTY)))


def scales(added: Any, waves: Any, x: Any, rough: Any) -> dict[str, Any]:
    """What the logarithm of the interval is linear in: little added, few waves in the contact, a light contact.

    added : share of friction that the law adds; waves : area of contact over the square of the shortest wave kept;
    x : p/p_rms with all waves; rough : share of friction that is not of the smooth body
    """
    return {
        "rough": rough,
        "added": np.log(np.abs(added) + LEAST_ADDED),
        "few": np.log1p(FEW_WAVES / np.maximum(waves, LEAST_WAVES)),
        "light": np.log1p(1 / np.maximum(x, LIGHT)),
    }


def without_fine_waves(scene: Scene) -> Scene:
    """The smooth body, or the longest waves of a plane, which any grid holds; the scene if it has no others."""
    rough: Any = scene.roughness
    if rough is None or rough.flat:
        return scene
    if not isinstance(scene.indenter, Plane):
        return replace(scene, roughness=None)
    longest = coarsest_wave(rough)
    return scene if rough.shortest >= longest else without(scene, longest)


def coarsest_wave(rough: Any) -> float:
    """Longest wave [m] that can be the shortest of a roughness: half of its period, along its shorter side."""
    return (min(rough.sides) if isinstance(rough, Topography) else rough.longest) / 2


def slope(bands: Bands) -> float:
    """Rms slope of bands of waves."""
    return bands.unit * sqrt(float(np.sum(bands.power * np.square(bands.q))))


def without(scene: Scene, shortest: float) -> Scene:
    """The scene without the waves of its roughness that are shorter than a length [m]; smooth where all are.

    A self-affine spectrum goes on to a length that is shorter than its own.
    """
    rough: Any = scene.roughness
    if shortest > coarsest_wave(rough):
        return replace(scene, roughness=None)
    if isinstance(rough, Profile):
        rough = rough.fitted
    if not isinstance(rough, SelfAffine):
        return replace(scene, roughness=replace(rough, shortest_kept=shortest))
    kept = float(rough.share(rough.q_min, 2 * pi / shortest, rough.q_max(0.0)))
    rolloff = None if rough.rolloff is None else max(rough.rolloff, shortest * (1 + 1e-9))
    fewer = replace(rough, shortest=shortest, rolloff=rolloff, rms_height=rough.rms_height * sqrt(kept))
    return replace(scene, roughness=fewer)


def under(scene: Scene, load: float) -> Scene:
    """The scene under a load [N]; a plane is under its pressure already."""
    if isinstance(scene.indenter, Plane):
        return scene
    return replace(scene, motion=Slide(speed=scene.motion.speed, load=load))
