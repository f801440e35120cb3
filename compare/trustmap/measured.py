"""What was measured for the map: parts of scenes and ranges of groups, and the place of a scene among them."""

from collections.abc import Mapping
from dataclasses import asdict, astuple, dataclass, replace
from functools import cache, cached_property, lru_cache
from math import exp

import numpy as np

from scene import Cone, Indent, PowerLaw, Profile, Scene, Slide, SolveError, Sphere, Topography
from scene.surfaces.isotropic import Isotropic

from ..models.law.parts import LawParts
from . import table
from .groups import DimensionlessGroups, SmoothReference
from .model import NAMES

# Tolerated extrapolation, as a fraction of the measured range.
SLACK = 0.02
# Towards these ends the ratio has a limit, which what was measured has reached: slow, low, pressed flat.
LIMITED_BELOW = "height", "sliding_height", "lost_waves", "lost_contact", "stiffening", "doubt"
LIMITED_ABOVE = "pressure", "slope", "sliding_pressure", "line_pressure", "nominal"
# Standard groups for people, and those of them that place a scene on the map.
SYMBOLS = {
    "shape": "1/n",
    "breadth": "h0 h''/h'^2",
    "slope": "slope of the body/h'",
    "side": "radius/side of the map",
    "directed": "rms slope along/across the direction of the map",
    "skewness": "skewness of the heights",
    "tails": "kurtosis of the heights/3",
    "height": "h0/d",
    "waves": "a/λ_c",
    "pressure": "p/(E* h')",
    "lost_waves": "G''(v q_c)/G0",
    "lost_contact": "G''(v/a)/G0",
    "stiffening": "E_g/E_r",
}
PLACED = tuple(SYMBOLS)[-6:]
# Parts of scenes that were never measured.
NEVER = "layer", "interface", "heating"
# Groups that are no logarithms.
PLAIN = "shape", "prescribed", "full_share", "share", "riding", "side", "skewness", "gaussian"


class OffTheMap(SolveError):
    """A scene whose parts were never measured, or whose smooth body has no answer: it has no place on the map."""


@dataclass(frozen=True)
class Place:
    """Place of a rough scene on the map.

    smooth : the body without its roughness; law : parts of the law of friction
    groups : dimensionless groups; stiffening : of the solid, glassy over relaxed modulus
    """

    smooth: SmoothReference
    law: LawParts
    groups: DimensionlessGroups
    stiffening: float

    @classmethod
    @lru_cache(maxsize=8)
    def of(cls, scene: Scene) -> "Place":
        """Place of a rough scene; take `as_judged` of a measured line first. Raises OffTheMap."""
        if reasons := unmeasured(scene):
            raise OffTheMap(f"Off the map: {'; '.join(reasons)}.")
        try:
            smooth = SmoothReference.of(scene)
            law = LawParts.of(scene, smooth.contact)
            stiffening = scene.solid.glassy_modulus / scene.solid.static_modulus
            return cls(smooth, law, DimensionlessGroups.of(scene, smooth, law), stiffening)
        except (SolveError, ArithmeticError, ValueError) as error:
            raise OffTheMap(f"Off the map: the smooth body in its place has no answer ({error}).") from error

    @property
    def named(self) -> dict[str, float]:
        """Groups as numbers, by name."""
        plain = {name: value if name in PLAIN else exp(value) for name, value in asdict(self.groups).items()}
        return plain | {"stiffening": self.stiffening}

    @cached_property
    def values(self) -> np.ndarray:
        """Groups (D,), those with a limit moved to where it is reached."""
        return np.clip(np.array(astuple(self.groups)), *limits())

    @cached_property
    def beyond(self) -> str:
        """Groups beyond what was measured, in words; empty where there is none."""
        found = beyond_measured(self.values)
        named = [found[name] for name in SYMBOLS if name in found] or list(found.values())
        return f"Off the map: {'; '.join(named)}." if named else ""

    def predicted(self, name: str) -> tuple[float, float, float]:
        """Logarithm of the ratio of a name, its standard error, and the relative scatter of single surfaces."""
        logarithm, error, scatter = table.model(name).predicted(self.values[None])
        return float(logarithm[0]), float(error[0]), float(scatter[0])


def as_judged(scene: Scene) -> Scene:
    """The scene with the surface that is fitted to a measured line in its place."""
    rough = scene.roughness
    return replace(scene, roughness=rough.fitted) if isinstance(rough, Profile) else scene


def unmeasured(scene: Scene) -> list[str]:
    """Parts of a scene that were never measured, a reason each; empty if all were."""
    scene = as_judged(scene)
    reasons = [
        f"{name} = {type(part).__name__}: no scene with one was measured"
        for name in NEVER
        if (part := getattr(scene, name))
    ]
    if not isinstance(scene.indenter, Sphere | Cone | PowerLaw):
        reasons.append(f"indenter = {type(scene.indenter).__name__} is no body of revolution")
    if not isinstance(scene.motion, Indent | Slide):
        reasons.append(f"motion = {type(scene.motion).__name__} was not measured, Indent and Slide were")
    rough = scene.roughness
    if rough is None or rough.flat:
        return reasons
    if isinstance(rough, Topography):
        reasons += [f"roughness = Topography has {rough.crowded}"] if rough.crowded else []
    elif not isinstance(rough, Isotropic):
        reasons.append(
            f"roughness = {type(rough).__name__} has no spectrum: SelfAffine, Spectrum, Topography, Profile have"
        )
    elif rough.shortest is None:
        reasons.append("roughness.shortest is absent, so that either grid cuts the spectrum where it ends")
    return reasons


@cache
def _ranges():
    """Least and greatest of each group that was measured (2, D)."""
    groups = table.groups(table.read(table.LEARNED))
    return np.array([groups.min(axis=0), groups.max(axis=0)])


@cache
def limits() -> tuple[np.ndarray, np.ndarray]:
    """Least and greatest values (D,) to which groups are moved that have a limit beyond."""
    low, high = _ranges()
    below, above = np.isin(NAMES, LIMITED_BELOW), np.isin(NAMES, LIMITED_ABOVE)
    return np.where(below, low, -np.inf), np.where(above, high, np.inf)


def beyond_measured(place: np.ndarray) -> dict[str, str]:
    """Groups (D,) beyond what was measured, each in words by its name."""
    (low, high), (least, greatest) = _ranges(), limits()
    slack = SLACK * (high - low)
    found = {}
    for name, *values in zip(NAMES, np.clip(place, least, greatest), low - slack, high + slack, strict=True):
        value, start, end = values if name in PLAIN else np.exp(values)
        if not start <= value <= end:
            found[name] = f"{SYMBOLS.get(name, name)} = {value:.3g}, where {start:.3g} to {end:.3g} was measured"
    return found


def placed(groups: Mapping[str, float]) -> str:
    """Place on the map, in standard groups with their numbers."""
    return ", ".join(f"{SYMBOLS[name]} = {groups[name]:.2g}" for name in PLACED).replace("= inf", "is infinite")
