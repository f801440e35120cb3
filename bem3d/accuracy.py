"""Settings for a wanted accuracy, from errors that were measured; and whether an answer keeps the promise.

`ladder.csv` has the largest errors of many contacts against finer solutions, by how finely they were resolved.
"""

import csv
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from math import inf, pi, sqrt
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from scipy.fft import next_fast_len

from scene import Cylinder, Measured, Plane, Program, Refused, Result, Scene, Shear, SolveError
from scene.scales import elastic_contact

from .problem import row_width
from .sliding import Flow

if TYPE_CHECKING:
    from .solver import BEM

LADDER = Path(__file__).with_name("ladder.csv")
BANDS = ("rest", "slow", "middle", "fast")
SLOW, FAST = 0.1, 10.0  # memory over the shortest length of the contact, between which it slides at middle speed
LEAVES = 3.0  # error over tolerance, at most
SHARE = 1 / 30  # tolerance over wanted error: a tenth of that error is left to it
TOLERANCES = (1e-3, 1e-5, 1e-7)  # of the solve that finds the contact; a narrow gap is lost at the first
LADDERS = {"friction": "friction", "depth": "pressing", "load": "pressing"}
COSTS = "seconds", "applications"  # of a solve, medians by points a side
PILOTS = (64, 128, 256, 512, 1024)  # points a side of the solve that finds the contact
LEAST, MOST = 32, 16384
CARRIED = 2.5  # points a wave, with which the window may turn out wider than that of the coarse solve
LEAST_SINGLE = 1e-5  # tolerance that transforms in single precision still reach


class Unconfirmed(UserWarning):
    """An answer changes by more than the wanted error when the pixel is halved."""


@dataclass(frozen=True)
class Assured:
    """An answer, and what of it changed from half the points to all, relative as the wanted errors are.

    The error of the grid is no larger than that change where it falls with the first power of the points or
    faster: an indication, and no bound. It is infinite where half the points have no answer.
    """

    result: Result
    wanted: Mapping[str, float]
    change: Mapping[str, float]

    @property
    def confirmed(self) -> bool:
        """Whether every quantity changed by less than the error wanted of it."""
        return all(self.change[name] <= wanted for name, wanted in self.wanted.items())


@dataclass(frozen=True)
class Choice:
    """Settings chosen for one scene.

    wanted, expected : relative errors by name: friction, and depth or load, whichever the scene does not
        prescribe; depth over that of the smooth contact at rest
    resolution : points across what has to be resolved, see `resolution`
    seconds : of processor on the machine on which the ladder was measured, the confirmation excluded
    """

    scene: Scene
    solver: "BEM"
    wanted: Mapping[str, float]
    expected: Mapping[str, float]
    resolution: float
    seconds: float

    def solve(self) -> Assured:
        """The answer, confirmed on half the points, which costs about a quarter more.

        Warns Unconfirmed where it changes by more than is wanted. Raises SolveError as the solver does.
        """
        fine = self.solver.solve(self.scene)
        try:
            coarse = replace(self.solver, points=self.solver.points // 2).solve(self.scene)
            change = {name: apart(self.scene, name, coarse, fine) for name in self.wanted}
        except (Refused, SolveError):
            change = dict.fromkeys(self.wanted, inf)
        assured = Assured(fine, self.wanted, change)
        if not assured.confirmed:
            said = ", ".join(f"{name} by {change[name]:.2g}, wanted {self.wanted[name]:g}" for name in change)
            message = f"from half the points to all the answer changed: {said}; take more points"
            warnings.warn(message, Unconfirmed, stacklevel=2)
        return assured


class Answer(Protocol):
    """Numbers by which two answers are compared: a Result, or numbers of one."""

    @property
    def friction_coefficient(self) -> float: ...

    @property
    def normal_force(self) -> float: ...

    @property
    def depth(self) -> float: ...


def apart(scene: Scene, name: str, one: Answer, other: Answer) -> float:
    """Relative difference of two answers to one scene in friction, depth or load; relative to the second."""
    match name:
        case "friction":
            values = one.friction_coefficient, other.friction_coefficient
        case "load":
            values = one.normal_force, other.normal_force
        case "depth":
            return abs(one.depth - other.depth) / elastic_contact(scene).depth
        case _:
            raise ValueError(f"{name} is none of friction, depth, load")
    if values[1] == 0:
        return 0.0 if values[0] == 0 else inf
    return abs(values[0] / values[1] - 1)


def choose(solver: "BEM", scene: Scene, wanted: Mapping[str, float]) -> Choice:
    """The least points and the loosest tolerance that keep every wanted error, by the ladder.

    solver : everything else that is set. Raises ValueError for what cannot be promised, Refused and SolveError as
    the solver does.
    """
    _check(solver, scene, wanted)
    pilot, loosest, found = _pilot(solver, scene)
    kind = _body(scene), band(scene)
    rungs = {name: ladder()[*kind, LADDERS[name]] for name in wanted}
    needed = max(_needed(name, rungs[name], error) for name, error in wanted.items())
    if kind[0] == "rough":  # less would not carry the waves
        needed = max(needed, CARRIED)
    # Even, so that half of them are half as many.
    points = max(LEAST, 2 * next_fast_len(int(np.ceil(pilot * needed / found / 2)), real=True))
    if points > MOST:
        raise ValueError(
            f"it takes {points} points a side, {needed:.0f} across what has to be resolved; {MOST} are the most"
        )
    tolerance, resolved = min(loosest, SHARE * min(wanted.values())), found * points / pilot
    return Choice(
        scene,
        replace(solver, points=points, tolerance=tolerance),
        dict(wanted),
        {name: _expected(rungs[name], resolved) + LEAVES * tolerance for name in wanted},
        resolved,
        _between(ladder()[*kind, "seconds"], points),
    )


def resolution(scene: Scene, measures: Mapping[str, float]) -> float:
    """The fewest points across anything that a contact has to resolve, from the measures of a result.

    Those to the shortest wave of the roughness, and those across the contact, were it all in one circle; of what
    is alike all along y, those along x.
    """
    points = measures["contact_points"]
    across = points if row_width(scene) else 2 * sqrt(points / pi)
    return min(across, measures.get("points_per_shortest_wave", inf))


def band(scene: Scene) -> str:
    """Class of speed of a scene, by the length of its memory over the shortest length of its contact."""
    flow, rough = Flow.of(scene.solid, scene.motion.speed), scene.roughness
    if flow.at_rest:
        return "rest"
    smooth = rough is None or rough.flat
    shortest: Any = elastic_contact(scene).radius if smooth else rough.shortest
    memory = flow.memory / shortest
    return "slow" if memory < SLOW else "middle" if memory < FAST else "fast"


def typical(scene: Scene, points: int) -> dict[str, float]:
    """Costs of such a body at such a speed on a square of so many points a side, by the names of `COSTS`."""
    kind = _body(scene), band(scene)
    return {name: _between(ladder()[*kind, name], points) for name in COSTS}


@cache
def ladder() -> Mapping[tuple[str, str, str], np.ndarray]:
    """Largest errors and their resolutions (2, rungs), sorted, by body (smooth, rough), band and quantity.

    Quantities: friction; pressing, of depth or load alike; and `COSTS`, of which there are points a side and what
    a solve takes: processor seconds, operator applications.
    """
    rungs: dict[tuple[str, str, str], list[tuple[float, float]]] = {}
    with LADDER.open(encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            kind = row["body"], row["band"], row["quantity"]
            rungs.setdefault(kind, []).append((float(row["resolution"]), float(row["value"])))
    return {kind: np.array(sorted(pairs)).T for kind, pairs in rungs.items()}


def _needed(name, rungs, error):
    """The resolution at which the ladder's errors are, and stay, at most this large."""
    good = rungs[0][rungs[1] <= error * (1 - LEAVES * SHARE)]
    if not good.size:
        raise ValueError(
            f"{name} = {error:g} is less than was measured, {rungs[1].min():.1g} at {rungs[0].max():.0f} points "
            "across what has to be resolved: no promise can be made"
        )
    return good.min()


def _expected(rungs, resolved):
    """Error of the last rung of the ladder that is reached."""
    return float(rungs[1][max(0, np.searchsorted(rungs[0], resolved, side="right") - 1)])


def _between(rungs, points):
    """Cost between two rungs of the ladder, by a power of the points."""
    x, y = np.log(rungs)
    k = int(np.clip(np.searchsorted(x, np.log(points)), 1, len(x) - 1))
    slope = (y[k] - y[k - 1]) / (x[k] - x[k - 1])
    return float(np.exp(y[k] + slope * (np.log(points) - x[k])))


def _body(scene):
    return "smooth" if scene.roughness is None or scene.roughness.flat else "rough"


def _pilot(solver, scene):
    """Points and tolerance of the first solve that has an answer, and how finely that resolves the contact."""
    fixed = solver.extent is not None or isinstance(scene.indenter, Plane)
    for tolerance in TOLERANCES if scene.motion.pressed_by == "gap" else TOLERANCES[:1]:
        for points in PILOTS:
            try:
                answer = replace(solver, points=points, tolerance=tolerance).solve(scene)
                return points, tolerance, resolution(scene, answer.measures)
            except Refused as reason:
                if not fixed:
                    raise
                left = reason
            except SolveError as reason:
                left = reason
    raise SolveError(f"no contact to choose settings for on up to {PILOTS[-1]} points: {left}")


def _check(solver, scene, wanted):
    """Raise ValueError for what the ladder does not know."""
    if isinstance(scene.motion, Program):
        raise ValueError("motion = Program: errors are promised at rest and in steady sliding")
    if isinstance(scene.indenter, Measured):
        raise ValueError("indenter = Measured: errors are promised of bodies of revolution, lines and planes")
    if scene.layer is not None:
        raise ValueError("layer = Layer: errors are promised on half-spaces, on which they were measured")
    if scene.heating is not None and scene.heating.feedback is not None:
        raise ValueError(f"heating.feedback = {scene.heating.feedback!r}: it adds to errors, promised without it")
    allowed = {"friction"} if scene.motion.speed > 0 and len(scene.solid.retardation()[2]) else set()
    if not isinstance(scene.indenter, Plane | Cylinder):
        allowed.add("depth" if scene.motion.depth is None else "load")
    known = " or ".join(sorted(allowed)) or "nothing: it loses nothing, and depths are of single bodies"
    if isinstance(scene.motion, Shear):
        known += "; motion = Shear: errors of tangential forces were not measured"
    if not wanted:
        raise ValueError(f"an error has to be wanted, of {known}")
    for name, error in wanted.items():
        if name not in allowed:
            raise ValueError(f"{name} = {error!r}: of this scene errors are promised of {known}")
        if isinstance(error, bool) or not isinstance(error, Real) or not 0 < error < 1:
            raise ValueError(f"{name} = {error!r}: a relative error between 0 and 1")
        if solver.precision == "single" and SHARE * error < LEAST_SINGLE:
            raise ValueError(f"{name} = {error:g}: in single precision at least {LEAST_SINGLE / SHARE:g}")
    if _body(scene) == "rough" and scene.roughness.shortest is None:
        raise ValueError("roughness.shortest = None: every grid has another surface, state the shortest wave")
