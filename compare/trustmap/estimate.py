"""Friction, depth and force of a scene by the cheapest model that knows them, each with an interval."""

from dataclasses import dataclass, replace
from math import nan

from scene import Indent, Plane, Scene, SelfAffine, Slide, SolveError
from scene.doubt import least_friction
from scene.protocol import numeric_guard

from ..models.law.bands import Bands
from ..models.law.extended import without
from ..models.law.nominal import mean_gap
from ..models.law.parts import DEPTH, LawParts, known_errors
from ..models.law.smooth import SPACE, SmoothContact
from ..solving.words import interval
from .friction_law import FrictionLaw

SCALES = {"m": (1e6, "µm"), "N": (1.0, "N"), "": (1.0, "")}
SMOOTH = "the smooth contact on 64 and 128 points"
GAP = "the smooth contact and the mean gap of the roughness"
ON_THE_MAP = "the 3D law with the ratio of the trust map"


@dataclass(frozen=True)
class Estimate:
    """An answer to a scene in three dimensions, which no solve of the rough contact has checked.

    quantity : friction, depth or force; unit : "", "m" or "N"
    value, low, high : with the ends of an interval of 95 %
    way : how it was found, in words
    least : whether a table of moduli ends before the finest waves, so that the answer is a lower bound
    """

    quantity: str
    unit: str
    value: float
    low: float
    high: float
    way: str
    least: bool = False

    def __str__(self) -> str:
        scale, unit = SCALES[self.unit]
        number = interval(scale * self.value, scale * self.low, scale * self.high)
        least = " at least" if self.least else ""
        return f"{self.quantity}{least} {number} {unit}".rstrip() + f", by {self.way}"


def estimates(scene: Scene) -> tuple[Estimate, ...]:
    """Answers to a scene that slides steadily or rests, friction first; none where no cheap model simulates it."""
    if not isinstance(scene.motion, Indent | Slide):
        return ()
    try:
        with numeric_guard():
            if FrictionLaw().refusals(scene):
                return ()
            return _of_rough(scene) if scene.roughness and not scene.roughness.flat else _of_smooth(scene)
    except (SolveError, ArithmeticError):
        return ()


def _of_smooth(scene):
    fine, coarse = (SmoothContact.of_answer(each.solve(scene)) for each in (replace(SPACE, points=128), SPACE))
    found = {_pressed(scene): ("load" if _pressed(scene) == "force" else "depth")}
    found |= {"friction": "friction_coefficient"} if fine.friction_coefficient else {}
    ends = {name: (getattr(fine, of), abs(getattr(fine, of) - getattr(coarse, of))) for name, of in found.items()}
    return tuple(_estimate(name, *ends[name], SMOOTH) for name in sorted(ends, reverse=True))


def _of_rough(scene):
    found, answers = FrictionLaw().solve(scene), []
    value, x = found.friction_coefficient, found.measures["pressure_ratio"]
    if value:
        way = ON_THE_MAP
        if found.measures["outside"]:
            way = f"the 3D law alone, off the trust map; {known_errors(scene, x).words}"
        ends = (found.measures[f"friction_{end}"] for end in ("low", "high"))
        answers.append(Estimate("friction", "", value, *ends, way, least_friction(scene)))
    if not isinstance(scene.indenter, Plane):
        answers.append(_depth_or_force(scene, x))
    return tuple(answers)


def _depth_or_force(scene, x):
    """The rough body stands further out than the smooth one under the same load, by the mean gap."""
    name, height = _pressed(scene), Bands.of(scene.roughness).rms_height
    gap, half = mean_gap(x) * height, known_errors(scene, x, DEPTH).half * height
    if name == "depth":
        return _estimate(name, SmoothContact.of(scene).depth - gap, half, GAP)
    depth = scene.motion.depth
    low, value, high = (
        SmoothContact.of(replace(scene, motion=replace(scene.motion, depth=max(each, depth / 1e6)))).load
        for each in (depth + gap - half, depth + gap, depth + gap + half)
    )
    return Estimate(name, "N", value, low, high, GAP)


def of_finer(scene: Scene) -> float:
    """Relative change of friction by waves down to half the shortest, by the law alone; NaN without a spectrum."""
    rough = scene.roughness
    if not isinstance(rough, SelfAffine) or rough.shortest is None:
        return nan
    own, other = (LawParts.of(each).friction_coefficient for each in (scene, without(scene, rough.shortest / 2)))
    return other / own - 1


def _pressed(scene):
    return "depth" if scene.motion.pressed_by == "load" else "force"


def _estimate(name, value, half, way):
    unit, value, half = {"depth": "m", "force": "N", "friction": ""}[name], float(value), float(half)
    return Estimate(name, unit, value, value - half, value + half, way)
