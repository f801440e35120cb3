"""`ExtendedBEM`: friction of surfaces finer than a grid, by BEM on coarse waves and the law for the finer ones."""

from dataclasses import replace
from math import exp, inf, log, log1p, pi, sqrt
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
from scene.solids.viscoelastic import Linear
from scene.terms import refused_parts

from .bands import Bands
from .parts import LawParts, known_errors, rows_of
from .persson import OF_LAW

FINE, ENOUGH = 8.0, 6.5  # points to the shortest wave that is kept: as planned, and at least
COARSE = 64  # points of the contact that shows how wide the window is
# Beyond which what enters the interval changes no more: change of the law, waves in the contact, x.
LEAST_CHANGE, FEW_WAVES, LEAST_WAVES, LIGHT = 2e-3, 20.0, 0.1, 0.1
LIGHTEST = 0.01  # x below which the excess of the law grows no more
LEARNED = -0.4, 0.5  # ends of the excess in the contacts that it was learned from
MOST_POINTS = 4096  # a side of the finest grid that a wanted accuracy leads to
ROUNDS = 4  # of the cut, which follows from the window, which follows from the contact


@readable
@dataclass(frozen=True, config=CLOSED)
class ExtendedBEM:
    """Boundary elements on the waves that a grid holds, and the law of friction in 3D for the finer ones.

    points : a side of the grid; waves of fewer than eight pixels are left to the law
    accuracy : half of the interval of 95 % of friction that is wanted, relative: points are doubled until it is
        reached, up to MOST_POINTS; None leaves them as they are

    The coefficient is mu_BEM(waves kept) plus, octave by octave, what the law adds for the finer waves under the
    load that BEM found. Each addition is corrected by a factor, near 1 except in light contacts, that was learned
    from contacts solved with every wave; together they never lower friction. There is no correction on a plane,
    nor where no wave is kept. Where the grid holds every wave the coefficient is that of BEM; where it holds none,
    BEM solves the smooth body. The depth, or the force at a depth, is that of the contact on the waves kept.

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
        pressed = under(scene, found.normal_force)
        steps = octaves(pressed, cut.shortest) if cut else [LawParts.of(pressed)]
        if not cut:
            added, half = steps[0].rough, known_errors(scene, steps[0].x).half
        elif steps[-1].friction_coefficient:
            # In 96 of 777 cuts the law falls with more waves; BEM rose in 84 of these, and fell by 5 % at most.
            added = max(_added(steps, scene), 0.0)
            waves = found.measures["contact_area"] / cut.shortest**2
            half = exp(fitted("half", numbers_of_cut(steps[0], steps[-1], waves)))
    total = solved + added
    return {
        "shortest_kept": cut.shortest if cut else inf,
        "slope_kept": slope(left) / slope(every),
        "friction_kept": solved,
        "friction_added": added,
        "friction_low": total * exp(-half),
        "friction_high": total * exp(half),
        "height_left": sqrt(max(every.rms_height**2 - left.rms_height**2, 0.0)),
    }


FITTED = Path(__file__).with_name("extended.csv")


def fitted(to: str, numbers: dict[str, float]) -> float:
    """Sum of numbers times their coefficients; to : "excess" of the law, or "half" of the interval, logarithms."""
    return sum(float(row["value"]) * numbers[row["times"]] for row in rows_of(FITTED) if row["to"] == to)


def octaves(scene: Scene, longest: float) -> list[LawParts]:
    """Law of a scene with its waves down to a length [m], down to half of it and so on, and with all of them."""
    rough: Any = scene.roughness
    own, length = LawParts.of(without(scene, longest)), longest / 2
    found = [own]
    while length > rough.shortest * (1 + 1e-9):
        found.append(LawParts.of(without(scene, length), own.contact))
        length /= 2
    return [*found, LawParts.of(scene, own.contact)]


def _added(steps: list[LawParts], scene: Scene) -> float:
    """Friction that the law adds, octave by octave, each divided by the excess of the law there."""
    more, plane = np.diff([each.friction_coefficient for each in steps]), isinstance(scene.indenter, Plane)
    too_much = [0.0 if plane else excess(each, scene.solid) for each in steps[1:]]
    return float(more @ np.exp(np.negative(too_much)))


def excess(parts: LawParts, solid: Linear) -> float:
    """Logarithm of the friction that the law adds for its finest waves, over the friction that BEM adds."""
    return float(np.clip(fitted("excess", numbers_of_law(parts, solid)), *LEARNED))


def numbers_of_law(parts: LawParts, solid: Linear) -> dict[str, float]:
    """Numbers of waves, contact and solid, times ln(1 + 1/x), that the excess is linear in."""
    waves = parts.waves
    soft = solid.static_modulus / solid.glassy_modulus
    light = log1p(1 / max(parts.x, LIGHTEST))
    return {
        "one": light,
        "harder": light * waves.harder,
        "faster": light * waves.faster,
        "shorter": light * waves.shorter,
        "spread": light * log(parts.radius / parts.contact.radius),
        "unbounded": light * (soft == 0),
        "glassy": light * soft**0.25,
    }


def numbers_of_cut(kept: LawParts, whole: LawParts, waves: float) -> dict[str, float]:
    """Numbers that the logarithm of half the interval is linear in.

    kept, whole : law of the waves kept, and of all; waves : area of contact over the square of the shortest kept
    """
    own, every = kept.friction_coefficient, whole.friction_coefficient
    return {
        "one": 1.0,
        "rough": whole.rough / every,
        "change": log(abs(every - own) / max(every, own) + LEAST_CHANGE),
        "few": log1p(FEW_WAVES / max(waves, LEAST_WAVES)),
        "light": log1p(1 / max(whole.x, LIGHT)),
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
