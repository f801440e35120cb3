"""Errors of three dimensions by how finely a contact is resolved: the ladder behind `BEM.for_accuracy`.

All in units of the contact: radius of curvature 1 m, contact radius about 0.1 m, retardation in 1 s, E* = 1 Pa.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import isnan

import numpy as np

from bem3d import BEM
from bem3d.accuracy import BANDS, COSTS, LADDERS, apart, band, resolution
from bem3d.sliding import Flow
from compare.outcome import Outcome, Row
from compare.task import SceneTask, Task
from scene import (
    Cone,
    Cylinder,
    Indent,
    Kelvin,
    Plane,
    PowerLaw,
    Scene,
    SelfAffine,
    Slide,
    Sphere,
    StandardLinearSolid,
)
from scene.rheology import Elastomer
from scene.scales import elastic_contact

RADIUS = 0.1  # of the smooth contact at rest [m]
KELVIN = Kelvin(modulus=0.25, relaxation_time=1.0)
STANDARD = StandardLinearSolid(rubbery_modulus=0.25, glassy_modulus=2.5, relaxation_time=0.1)
SHAPES = Sphere(radius=1.0), Cone(angle=0.05), PowerLaw(coefficient=2.0, exponent=4.0)
# Speed times the time of the solid over the contact radius.
SPEEDS: dict[Elastomer, tuple[float, ...]] = {
    KELVIN: (0.0, 1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0),
    STANDARD: (1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0),
}
# Hurst exponent, rms height over depth, contact radius over shortest wave, seed.
ROUGHNESS = (
    (0.2, 0.1, 3, 1),
    (0.2, 0.3, 6, 1),
    (0.8, 0.3, 6, 1),
    (0.8, 1.0, 4, 2),
    (0.5, 0.5, 12, 1),
)
# The last is what the others are measured against.
SMOOTH_POINTS, ROUGH_POINTS = (16, 24, 32, 48, 64, 96, 128, 192, 512), (48, 64, 96, 128, 192, 256, 512)
TIGHT = 1e-7  # tolerance, so that what is seen is the grid
# Resolutions at which the ladder has a rung.
RUNGS = (2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256)
# Of friction: the answer, and what it joins.
ESTIMATES = "joined", "traction", "loss", "curvature"
MEMORIES = 0.0, 0.03, 0.1, 0.25, 1.0, 3.0, 10.0, np.inf  # over the pixel
FEWEST = 3  # answers from which a rung is made


@dataclass(frozen=True)
class Probe:
    """A scene solved on several grids, the last of which is what the others are measured against."""

    scene: Scene
    points: tuple[int, ...]

    @property
    def body(self) -> str:
        """Kind of body: smooth or rough."""
        return "smooth" if self.scene.roughness is None else "rough"

    @property
    def tasks(self) -> list[Task]:
        """Tasks, one a grid."""
        solvers = (BEM(points=n, tolerance=TIGHT) for n in self.points)
        return [SceneTask(each, (self.scene,), work=each.points**2.2 * 50.0) for each in solvers]

    @property
    def quantities(self) -> tuple[str, ...]:
        """Quantities whose error is asked for."""
        motion, elastomer = self.scene.motion, self.scene.solid
        found = ("friction",) if motion.speed and len(elastomer.retardation()[2]) else ()
        if isinstance(self.scene.indenter, Plane | Cylinder):
            return found
        return (*found, "depth" if motion.depth is None else "load")


def probes() -> list[Probe]:
    """The scenes of which the ladder is made."""
    return [Probe(scene, SMOOTH_POINTS) for scene in _smooth()] + [
        Probe(scene, ROUGH_POINTS) for scene in _rough()
    ]


def rows(found: Sequence[Probe], outcomes: Mapping[Task, Outcome]) -> list[dict]:
    """The ladder: the largest error of all answers resolved as finely as a rung or more finely."""
    errors: dict[tuple[str, str, str], list[tuple[float, float]]] = {}
    costs: dict[tuple[str, str, str], dict[int, list[float]]] = {}
    for probe in found:
        answers = [outcomes[task].rows[0] for task in probe.tasks]
        kind = probe.body, band(probe.scene)
        for points, answer in zip(probe.points, answers, strict=True):
            for cost in COSTS:
                if not isnan(value := getattr(answer, cost)):
                    costs.setdefault((*kind, cost), {}).setdefault(points, []).append(value)
        for name in probe.quantities:
            errors.setdefault((*kind, LADDERS[name]), []).extend(_errors(probe, name, answers))
    ladder = []
    for key in sorted(errors, key=lambda key: (key[0], BANDS.index(key[1]), key[2])):
        ladder += [_entry(key, *rung) for rung in _rungs(np.reshape(errors[key], (-1, 2)).T)]
    for key, by_points in costs.items():
        ladder += [_entry(key, points, float(np.median(each)), len(each)) for points, each in by_points.items()]
    return ladder


def estimates(found: Sequence[Probe], outcomes: Mapping[Task, Outcome]) -> list[dict]:
    """Errors of the estimates of friction against the finest grid, by memory over pixel.

    Medians, and the 90th percentile of the answer that joins them.
    """
    errors = []
    for probe in (each for each in found if "friction" in each.quantities):
        *coarser, truth = [outcomes[task].rows[0] for task in probe.tasks]
        memory = Flow.of(probe.scene.solid, probe.scene.motion.speed).memory
        errors += [
            (memory / answer.measures["pixel"], *_of_estimates(answer, truth))
            for answer in coarser
            if answer.reason is None and truth.reason is None
        ]
    over_pixel, *by_estimate = np.array(errors).T
    table = []
    for low, high in pairwise(MEMORIES):
        within = (over_pixel >= low) & (over_pixel < high)
        medians = {name: float(np.median(each[within])) for name, each in zip(ESTIMATES, by_estimate, strict=True)}
        rare = {"joined_90": float(np.quantile(by_estimate[0][within], 0.9))}
        table.append({"from": low, "to": high, "answers": int(within.sum())} | medians | rare)
    return table


def _of_estimates(answer: Row, truth: Row) -> list[float]:
    forces = (answer.friction_force, *(answer.measures[f"friction_by_{name}"] for name in ESTIMATES[1:]))
    return [abs(force / answer.normal_force / truth.friction_coefficient - 1) for force in forces]


def _entry(key, resolution, value, answers):
    body, band, quantity = key
    return {
        "body": body,
        "band": band,
        "quantity": quantity,
        "resolution": resolution,
        "value": float(f"{value:.3g}"),
        "answers": answers,
    }


def _rungs(pairs) -> Iterator[tuple[float, float, int]]:
    resolved, error = pairs
    for low, high in zip(RUNGS, (*RUNGS[1:], np.inf), strict=True):
        if np.count_nonzero((resolved >= low) & (resolved < high)) >= FEWEST:
            yield low, float(error[resolved >= low].max()), int(np.count_nonzero(resolved >= low))


def _errors(probe, name, answers: Sequence[Row]) -> Iterator[tuple[float, float]]:
    """Resolution and error of each answer but the last."""
    *coarser, truth = zip(probe.points, answers, strict=True)
    for points, answer in coarser:
        if answer.reason is None and truth[1].reason is None:
            error = apart(probe.scene, name, answer, truth[1]) * missing(points, truth[0])
            yield resolution(probe.scene, answer.measures), error


def missing(points: float, finer: float) -> float:
    """What a difference to a finer grid is multiplied with for the error, which falls with the points at least."""
    return finer / (finer - points)


def _smooth() -> Iterator[Scene]:
    for shape in SHAPES:
        depth = shape.mdr_coefficient * RADIUS**shape.exponent
        for elastomer, speeds in SPEEDS.items():
            load = elastic_contact(Scene(shape, elastomer, Indent(depth=depth))).load
            for speed in speeds:
                yield Scene(shape, elastomer, Slide(speed=speed * RADIUS, load=load))
                if shape is SHAPES[0]:
                    yield Scene(shape, elastomer, Slide(speed=speed * RADIUS, depth=depth))
    for speed in SPEEDS[KELVIN][1:]:
        yield Scene(Cylinder(radius=1.0), KELVIN, Slide(speed=speed * RADIUS, line_load=np.pi * RADIUS**2 / 4))


def _rough() -> Iterator[Scene]:
    for shape in SHAPES[:2]:
        depth = shape.mdr_coefficient * RADIUS**shape.exponent
        for hurst, height, waves, seed in ROUGHNESS:
            rough = SelfAffine(
                hurst=hurst, rms_height=height * depth, longest=3 * RADIUS, shortest=RADIUS / waves, seed=seed
            )
            for elastomer, speeds in SPEEDS.items():
                load = elastic_contact(Scene(shape, elastomer, Indent(depth=depth))).load
                for speed in speeds:
                    yield Scene(shape, elastomer, Slide(speed=speed * RADIUS, load=load), rough)
            yield Scene(shape, KELVIN, Slide(speed=RADIUS, depth=depth), rough)
            yield Scene(shape, KELVIN, Indent(depth=depth), rough)
    for hurst, waves, pressure in ((0.8, 8, 0.01), (0.3, 16, 0.02)):
        rough = SelfAffine(hurst=hurst, rms_height=1e-2, longest=1.0, shortest=1 / waves, seed=1)
        for elastomer, speeds in SPEEDS.items():
            for speed in speeds[1:]:
                yield Scene(Plane(), elastomer, Slide(speed=speed * RADIUS, pressure=pressure), rough)
