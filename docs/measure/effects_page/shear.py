"""A sphere drawn along the surface until it slips: smooth and rough, in both dimensionalities and by closed forms.

The sphere of the paper's experiment with the roughness of the shipped scenes, pressed to a depth at which that is
small. Forces over those that friction holds, mu F_N, do not depend on the coefficient mu.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from bem3d import BEM
from compare.library.case import shipped_cases
from compare.models.exact import tangential
from compare.solving.outcome import Outcome
from compare.solving.task import SceneTask as Task
from compare.solving.task import Task as AnyTask
from mdr1d import MDR
from scene import Coulomb, Indent, Kelvin, Scene, Shear, Sphere

from .chapter import Chapter, Rows
from .figures import shear as drawing
from .means import estimate, mean

NAME = "shear"
DEPTH, FRICTION, NU = 4e-4, 0.5, 0.5
SHARES = tuple(round(0.05 * k, 2) for k in range(1, 33))  # displacements over 3/2 mu d
LINES, SURFACES = 20, 3
PRESSED = (0.2, 0.4, 0.6, 0.8)  # of them those at which the contact is compared with two pressures of its own
UNCOUPLED = "smooth, 3D, ν = 0"
SOLVERS = {
    "smooth, 1D": MDR(points=5000),
    "smooth, 3D": BEM(points=128),
    UNCOUPLED: BEM(points=128),
    "rough, 1D": MDR(points=5000),
    "rough, 3D": BEM(points=128),
}


@dataclass(frozen=True)
class Curve:
    """Look of one kind of body.

    force : over mu F_N, (shares, bodies); NaN where a solve failed
    sticks : whether anything still sticks, (shares, bodies)
    superposed : the force by two normal contacts of the same bodies, over mu F_N, (pressed, bodies)
    """

    way: str
    force: np.ndarray
    sticks: np.ndarray
    superposed: np.ndarray

    @property
    def mean(self) -> np.ndarray:
        """Over bodies (shares,)."""
        return self.force.mean(axis=1)

    @property
    def full(self) -> np.ndarray:
        """The first of SHARES at which a body slips everywhere (bodies,); NaN of one that never does."""
        found = [np.flatnonzero(~column) for column in self.sticks.T]
        return np.array([SHARES[places[0]] if len(places) else np.nan for places in found])

    @property
    def most(self) -> np.ndarray:
        """Share at which nine tenths of mu F_N are reached (bodies,)."""
        return np.array([np.interp(0.9, column, SHARES) for column in self.force.T])

    @property
    def off_superposed(self) -> float:
        """The largest distance from two normal contacts."""
        places = [SHARES.index(share) for share in PRESSED]
        return float(np.max(np.abs(self.force[places] - self.superposed)))

    def off(self, full: float | np.ndarray) -> float:
        """The largest distance from Cattaneo and Mindlin. full : displacement of full slip, over 3/2 mu d."""
        expected = tangential.force(np.minimum(np.array(SHARES)[:, None] / full, 1.0))
        return float(np.max(np.abs(self.force - expected)))


def tasks() -> list[Task]:
    """Every displacement of every kind of body, all bodies of a kind together."""
    drawn = [_task(way, share) for way in SOLVERS for share in SHARES]
    return drawn + [_pressed(way, share) for way in SOLVERS for share in PRESSED]


@cache
def _roughness():
    return shipped_cases()["paper-sphere"].roughness


def _scene(share, rough, seed=1, nu=NU):
    drawn = share * tangential.full_slip_displacement(FRICTION, DEPTH, nu)
    roughness = replace(_roughness(), seed=seed) if rough else None
    return Scene(
        Sphere(radius=50e-3),
        Kelvin(modulus=3e6, relaxation_time=1e-3, poisson_ratio=nu),
        Shear(depth=DEPTH, displacement=drawn),
        roughness,
        interface=Coulomb(coefficient=FRICTION),
    )


def _task(way, share):
    solver, rough = SOLVERS[way], way.startswith("rough")
    bodies = 1 if not rough else SURFACES if isinstance(solver, BEM) else LINES
    nu = 0.0 if way == UNCOUPLED else NU
    scenes = tuple(_scene(share, rough, seed, nu) for seed in range(1, bodies + 1))
    return _asked(solver, scenes)


def _pressed(way, share):
    """The same bodies at rest, at the depth d_c that belongs to a displacement."""
    motion = Indent(depth=(1 - share) * DEPTH)
    return _asked(SOLVERS[way], tuple(replace(s, motion=motion, interface=None) for s in _task(way, share).scenes))


def _asked(solver, scenes):
    each = 200.0 * solver.points**2 if isinstance(solver, BEM) else 2.0 * solver.points
    return Task(solver, scenes, work=len(scenes) * each)


def curves(outcomes: Mapping[AnyTask, Outcome]) -> dict[str, Curve]:
    """By the kind of body."""
    found = {}
    for way in SOLVERS:
        rows = [outcomes[_task(way, share)].rows for share in SHARES]
        force = np.array([[row.friction_coefficient / FRICTION for row in each] for each in rows])
        sticks = np.array([[_sticking(row) > 0 for row in each] for each in rows])
        less = np.array([[row.normal_force for row in outcomes[_pressed(way, share)].rows] for share in PRESSED])
        whole = np.array([row.normal_force for row in rows[0]])
        found[way] = Curve(way, force, sticks, 1 - less / whole)
    return found


def _sticking(row):
    """Area or length that sticks, of the solver that has answered; NaN, which is not above zero, of none."""
    return next((row.measures[name] for name in ("stick_area", "stick_length") if name in row.measures), np.nan)


def chapter(outcomes: Mapping[AnyTask, Outcome]) -> Chapter:
    """What came of smooth and rough bodies."""
    found = curves(outcomes)
    drawn = [row for curve in found.values() for row in _sheet(curve)]
    return Chapter(
        {"Slip in numbers": _numbers(found), "Tangential force over μ F_N": _table(found)},
        {drawing.NAME: drawing.figure(drawn)},
        {drawing.NAME: drawn},
    )


def _numbers(found) -> Rows:
    """How far curves are from closed forms, over mu F_N, and where rough bodies slip, over 3/2 mu d."""
    rows = []
    for dimension in ("1D", "3D"):
        smooth, rough = found[f"smooth, {dimension}"], found[f"rough, {dimension}"]
        row = {
            "": dimension,
            "smooth, off Cattaneo and Mindlin": f"{smooth.off(1.0):.1e}",
            "rough, slips at": mean(rough.full),
            "nine tenths at": mean(rough.most),
            "off the smooth over its own u_max": f"{rough.off(rough.full):.2f}",
            "off two normal contacts": f"{rough.off_superposed:.1e}",
        }
        rows.append(row)
    return rows


def _table(found) -> Rows:
    rows = []
    for share in SHARES[7::8]:
        k = SHARES.index(share)
        closed = float(tangential.force(min(share, 1.0)))
        row = {"u / (3/2 μ d)": f"{share:.2f}", "Cattaneo and Mindlin": f"{closed:.4f}"}
        for way, curve in found.items():
            row[way] = mean(curve.force[k])
        rows.append(row)
    return rows


def _sheet(curve: Curve):
    full = estimate(curve.full)
    return [
        {
            "way": curve.way,
            "share": share,
            "force": value.mean,
            **dict(zip(("low", "high"), value.found.interval(), strict=True)),
            "bodies": value.count,
            "full_slip": full.mean,
            "closed_form": float(tangential.force(min(share, 1.0))),
            "superposed": float(curve.superposed[PRESSED.index(share)].mean()) if share in PRESSED else np.nan,
        }
        for share, value in zip(SHARES, map(estimate, curve.force), strict=True)
    ]
