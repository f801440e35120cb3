"""Settings for a wanted accuracy: points are doubled until the changes of the answer confirm it."""

import logging
import warnings
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import pairwise
from math import inf, log2
from typing import Any

from scene import Cylinder, Doubtful, Measured, Plane, Program, Refused, Result, Scene, Shear, SolveError
from scene.quantities import Unit, takes
from scene.scales import elastic_contact

from .solver import BEM, LEAST_SINGLE, LOOSEST

_LOG = logging.getLogger(__name__)
FIRST, MOST = 32, 1024  # points a side
SHARE = 1 / 30  # tolerance over wanted error: a tenth of that error is left to it
NARROW = 1e-7  # tolerance of a prescribed gap, at least: a narrow one is lost in a looser one
# Order at which an error is taken to fall with the points: no lower one is waited for, no higher one believed.
ORDERS = 0.5, 2.0
HOPELESS = 4  # times MOST: no more points are tried where the observed order asks for more than this
RELATIVE = Unit("", "a relative error between 0 and 1")


class Unconfirmed(Doubtful):
    """An answer changes by too much when the pixel is halved."""


@dataclass(frozen=True)
class Choice:
    """Settings that keep wanted errors in a scene, and the answer by which they were found.

    solver, result : the settings, and their answer
    wanted, error : relative errors by name, as wanted, and as the answers on half and a quarter of the points show
        them: friction, and depth or load, whichever the scene does not prescribe; depth relative to the smooth
        contact at rest. An indication, not a bound; infinite where fewer than three grids have an answer
    """

    solver: BEM
    result: Result
    wanted: Mapping[str, float]
    error: Mapping[str, float]

    @property
    def confirmed(self) -> bool:
        """Whether every error is within what is wanted."""
        return all(self.error[name] <= wanted for name, wanted in self.wanted.items())


def apart(scene: Scene, name: str, one: Any, other: Any) -> float:
    """Relative difference of two answers to one scene in friction, depth or load; relative to the second.

    one, other : Results, or other objects with friction_coefficient, depth and normal_force
    """
    if name == "depth":
        return abs(one.depth - other.depth) / elastic_contact(scene).depth
    quantity = {"friction": "friction_coefficient", "load": "normal_force"}[name]
    value, reference = getattr(one, quantity), getattr(other, quantity)
    if reference == 0:
        return 0.0 if value == 0 else inf
    return abs(value / reference - 1)


@takes(friction=RELATIVE, depth=RELATIVE, load=RELATIVE)
def for_accuracy(
    scene: Scene,
    friction: float | None = None,
    depth: float | None = None,
    load: float | None = None,
    **settings: Any,
) -> Choice:
    """Settings of `BEM` that keep wanted relative errors in a scene, and their answer.

    friction, depth, load : wanted errors of the friction coefficient, and of the depth, relative to the smooth
        contact at rest, or of the load, whichever is not prescribed
    settings : of `BEM`, all but points and tolerance

    Points are doubled until what changed over two halvings of the pixel keeps the errors. Warns Unconfirmed
    where 1024 points do not, or would not. Raises ValueError for what cannot be promised: programs, roughness
    without a shortest wave; Refused and SolveError as the solver does where no grid has an answer.
    """
    for name in {"points", "tolerance"} & settings.keys():
        raise ValueError(f"{name} = {settings[name]!r}: it is chosen by the wanted errors, leave it out")
    asked, solver = {"friction": friction, "depth": depth, "load": load}, BEM(**settings)
    wanted = {name: each for name, each in asked.items() if each is not None}
    _check(solver, scene, wanted)
    answers: list[Result] = []
    choice: Choice | None = None
    left: Refused | SolveError | None = None
    for finer in _doubled(solver, scene, min(SHARE * min(wanted.values()), LOOSEST)):
        try:
            answers.append(finer.solve(scene))
        except (Refused, SolveError) as reason:
            # Too coarse, or too large; what answered before may still be all that there is.
            left, answers = reason, []
            continue
        seen = {name: changes(scene, name, answers) for name in wanted}
        choice = Choice(finer, answers[-1], dict(wanted), {name: error(*each) for name, each in seen.items()})
        _LOG.info("%d points a side: errors %s", finer.points, choice.error)
        if choice.confirmed or any(
            _needed(finer.points, *each, wanted[name]) > HOPELESS * MOST for name, each in seen.items()
        ):
            break
    if choice is None:
        assert left is not None
        raise left
    if not choice.confirmed:
        errors = ", ".join(f"{name} by {choice.error[name]:.2g}, wanted {wanted[name]:g}" for name in wanted)
        message = f"{choice.solver.points} points a side do not confirm the wanted errors: {errors}"
        warnings.warn(message, Unconfirmed, stacklevel=3)
    return choice


def changes(scene: Scene, name: str, answers: list[Result]) -> tuple[float, float]:
    """Changes of a quantity at the last halving of the pixel and at the one before; infinite without an answer."""
    steps = [apart(scene, name, *pair) for pair in pairwise(answers)]
    before, last = [inf, inf, *steps][-2:]
    return last, before


def error(last: float, before: float) -> float:
    """Error that is left after two halvings, from what changed at the last and at the one before.

    By the order at which the changes fall; no less than the last of them, as if of first order, nor than a quarter
    of the one before, as if the last were small by chance.
    """
    if before == inf:
        return inf
    return max(last / (2 ** _order(last, before) - 1), last, before / 4)


def _order(last, before):
    least, most = ORDERS
    return min(max(log2(before / last), least), most) if last and before else most if before else least


def _needed(points, last, before, wanted):
    """Points at which the error would be as small as wanted, by its order of convergence."""
    return 0 if before == inf else points * (error(last, before) / wanted) ** (1 / _order(last, before))


def _doubled(solver, scene, tolerance) -> Iterator[BEM]:
    """Settings with more and more points."""
    if scene.motion.pressed_by == "gap":
        tolerance = min(tolerance, NARROW)
    points = FIRST
    while points <= MOST:
        yield replace(solver, points=points, tolerance=tolerance)
        points *= 2


def _check(solver, scene, wanted):
    """Raise ValueError for what is not promised."""
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
    for name, each in wanted.items():
        if name not in allowed:
            raise ValueError(f"{name} = {each!r}: of this scene errors are promised of {known}")
        if not 0 < each < 1:
            raise ValueError(f"{name} = {each!r}: a relative error between 0 and 1")
        if solver.precision == "single" and SHARE * each < LEAST_SINGLE:
            raise ValueError(f"{name} = {each:g}: in single precision at least {LEAST_SINGLE / SHARE:g}")
    rough = scene.roughness
    if rough is not None and not rough.flat and rough.shortest is None:
        raise ValueError("roughness.shortest = None: every grid has another surface, state the shortest wave")
