"""Regime map: friction of 1D over 3D against pressure and speed, predicted for a family of scenes."""

from collections.abc import Mapping, Sequence
from dataclasses import astuple, replace
from math import exp, inf, log, nan, pi

import numpy as np
from pandas import DataFrame

from scene import Kelvin, Scene, SelfAffine, Slide, Sphere
from scene.scales import elastic_contact

from ...models.exact import mean_lag
from ...models.law.parts import LawParts
from ...trustmap import measured, shipped, verdict
from ...trustmap.groups import DimensionlessGroups, SmoothReference
from ...trustmap.model import NORMAL, Model
from ...trustmap.table import measurements
from . import design

COLUMNS = "pressure_over_slope", "memory_over_shortest", "ratio", "ratio_low", "ratio_high"
RADIUS, DEPTH, SOLID = 1e-3, 1e-4, Kelvin(1e6, 1.0)
# A family, as a scene and in words; its smooth contact at rest has the radius and the depth.
FAMILY = Scene(
    Sphere(RADIUS**2 / DEPTH),
    SOLID,
    Slide(speed=1.0, load=4 / 3 * SOLID.indentation_modulus * DEPTH * RADIUS),
    SelfAffine(hurst=0.7, rms_height=DEPTH, longest=4 * RADIUS, shortest=RADIUS / 4, seed=0),
)
ABOUT = "spheres on Kelvin solids under a load (H = 0.7, a/λ_s = 4, longest wave 4 a, no roll-off)"
# Contacts are like a family if they have as many waves on the radius, within this factor.
ALIKE = 2.0
PRESSURES = tuple(np.geomspace(0.05, 30, 51).tolist())
MEMORIES = tuple(np.geomspace(1e-2, 1e3, 41).tolist())


def regime_table(
    family: Scene = FAMILY,
    pressures: Sequence[float] = PRESSURES,
    memories: Sequence[float] = MEMORIES,
    model: Model | None = None,
) -> DataFrame:
    """Friction of 1D over 3D with its interval of 95 % on a rectangle of scenes; nan off the map.

    family : a rough scene that slides; its rms height and its speed are replaced
    pressures : p / (E* h'), set by the rms height
    memories : v tau q_s, set by the speed
    model : of friction; that of the package if absent

    Rows of infinite pressure are the smooth body, solved in both dimensionalities. Raises ValueError of a family
    that was not measured, SolveError where the smooth body has no answer.
    """
    if reasons := measured.unmeasured(family):
        raise ValueError("; ".join(reasons))
    family = measured.as_judged(family)
    rows: list[tuple[float, ...]] = []
    for memory in memories:
        speed = memory / (mean_lag(family.solid) * family.roughness.q_max(0.0))
        slides = replace(family, motion=replace(family.motion, speed=speed))
        flat = verdict.trust(replace(slides, roughness=None)).friction
        found = _predicted(slides, pressures, model or shipped.model("friction"))
        rows += [(pressure, memory, *each) for pressure, each in zip(pressures, found, strict=True)]
        rows.append((inf, memory, flat.ratio, flat.low, flat.high))
    return DataFrame(rows, columns=COLUMNS)


def contacts_like(learned: Mapping[str, np.ndarray], family: Scene = FAMILY) -> DataFrame:
    """Contacts of a table of the campaign that are like a family, with their ratios as measured and intervals.

    They have its shape and kinds of solid and motion, roughness of any Hurst exponent, and about as many waves.
    """
    numbers, found = measurements(learned, "friction")
    error = NORMAL * np.sqrt(found.variance(found.scatter))
    own = {"side": 0.0, "shape": 1 / family.indenter.exponent, "prescribed": family.motion.pressed_by == "depth"}
    alike = np.logical_and.reduce([np.isclose(learned[name][numbers], value) for name, value in own.items()])
    rows: list[tuple[float, ...]] = []
    for k in np.flatnonzero(alike):
        scene = design.scene(int(learned["point"][numbers[k]]))
        if type(scene.solid) is type(family.solid) and abs(log(_waves(scene) / _waves(family))) <= log(ALIKE):
            memory = scene.motion.speed * mean_lag(scene.solid) * scene.roughness.q_max(0.0)
            pressure = exp(learned["pressure"][numbers[k]])
            rows.append((pressure, memory, *np.exp(found.logarithm[k] + error[k] * np.array((0, -1, 1)))))
    return DataFrame(rows, columns=COLUMNS, dtype=float)


def _waves(scene):
    """Shortest waves on the radius of the smooth contact at rest."""
    return elastic_contact(scene).radius * scene.roughness.q_max(0.0) / (2 * pi)


def _predicted(scene, pressures, model):
    """Ratio, low and high (N, 3) of a scene at the heights of pressures."""
    smooth, rough = SmoothReference.of(scene), scene.roughness

    def groups(height):
        higher = replace(scene, roughness=replace(rough, rms_height=height))
        return DimensionlessGroups.of(higher, smooth, LawParts.of(higher, smooth.contact))

    own = np.exp(groups(rough.rms_height).pressure)
    places = np.array([astuple(groups(height)) for height in rough.rms_height * own / np.array(pressures)])
    known = [not measured.beyond_measured(place) for place in places]
    logarithm, error, _ = model.predicted(np.clip(places, *measured.limits()))
    ratios = np.exp(logarithm + NORMAL * np.outer((0, -1, 1), error))
    return np.where(known, ratios, nan).T
