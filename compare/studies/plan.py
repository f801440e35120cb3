"""Plan of a scene: what both solvers would simulate, and what that costs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import ceil, isfinite, isinf, nan
from textwrap import fill

from bem3d import BEM
from mdr1d import MDR
from scene import Refused, Scene, SolveError, notes
from scene.plan import Plan, size
from scene.protocol import foresee, numeric_guard

from ..library.case import Case, NotCompared, doubted
from ..library.lookup import SceneLike, case_of
from ..models.law.extended import ExtendedBEM
from ..models.table import KNOWN
from ..solving.cost import Cost, seconds_per_work, work_of
from ..solving.curve import on_levels
from ..solving.words import pascals, seconds, share
from ..statistics.multilevel import MARGIN, OWN_SHARE
from ..trustmap.measured import OffTheMap, Place, as_judged
from ..trustmap.model import LAW, NORMAL, asked_of
from ..trustmap.table import model
from .comparison.around import FINER, Around, extended_of, for_interval, left_by_grid, with_points
from .comparison.series import pilot

WIDTH = 100
WHOLE = {"break_long_words": False, "break_on_hyphens": False}
INDENT = 11  # of the lines, after their names
INTERVALS = 0.1, 0.05, 0.02, 0.01
# Share of the scatter that control variates leave on coarse grids: 16 to 42 % of the variance.
SCATTER_LEFT = 0.6


@dataclass(frozen=True)
class Accuracy:
    """What an interval of 95 % of the mean over rough surfaces takes in 3D, of the scene as it stands.

    interval : half-width, relative
    surfaces : by the scatter that the trust map expects; all but a few are solved on the coarsest grid
    points : a side of a grid whose error leaves room for it, no fewer than stated
    seconds : processor time, a forecast
    """

    interval: float
    surfaces: int
    points: int
    seconds: float

    @classmethod
    def of(cls, interval: float, solver: BEM | ExtendedBEM, scene: Scene, scatter: float) -> Accuracy:
        """By the scatter of single surfaces."""
        if error := left_by_grid(solver, scene):
            solver, error = with_points(solver, scene, interval), min(error, OWN_SHARE * interval)
            scatter *= SCATTER_LEFT
        works = [work_of(each, scene) for each in on_levels(solver, [scene]).values()]
        *finer, least = pilot(len(works))
        counts = [*finer, max(least, ceil(MARGIN * (NORMAL * scatter / (interval - error)) ** 2))]
        work = sum(count * sum(works[k : k + 2]) for k, count in enumerate(counts))
        return cls(interval, sum(counts), solver.points, seconds_per_work() * work)

    def __str__(self) -> str:
        counted = f"{self.surfaces:,} surfaces on up to {self.points} points a side"
        return f"{share(self.interval)}: {counted}, {seconds(self.seconds)} in 3D"


class Plans(dict[str, Plan | str]):
    """Plans by the names of the solvers, or why there is none.

    Printed, six lines, and one for each interval.

    stated, case, scene : what is planned, as it is stated and on the points that its interval takes
    cost : what all contacts of `crosscheck run` take; the reason where it solves none
    refused : whether that refuses the numbers of a scene of a kind that it compares
    doubts : about the scene, and notes on what was read for it, as sentences
    """

    def __init__(self, case: Case) -> None:
        self.stated, case = case, for_interval(case, case.interval)
        super().__init__({each.name: planned(each, case.scene) for each in (case.mdr, case.bem)})
        self.case, self.scene = case, case.scene
        self.cost, self.refused, self.doubts = _cost(case)

    @property
    def feasible(self) -> bool:
        """Whether a model would solve it, and `crosscheck run` would not refuse it for its numbers."""
        return bool(self._plans or isinstance(self.cost, Cost)) and not self.refused

    @property
    def times(self) -> dict[str, float]:
        """Processor time of this contact [s], a forecast, by the names of the solvers that have a plan."""
        solvers = {each.name: each for each in (self.case.mdr, self.case.bem)}
        return {name: seconds_per_work() * work_of(solvers[name], self.scene) for name in self._plans}

    @property
    def accuracies(self) -> tuple[Accuracy, ...]:
        """What intervals of this contact take in 3D; none of a smooth body and where its scatter is not known."""
        rough = isinstance(self.cost, Cost) and hasattr(self.scene.roughness, "seed")
        if not (rough and isfinite(scatter := _scatter(self.scene))):
            return ()
        solver = self.stated.bem if "BEM" in self._plans else extended_of(self.stated)
        return tuple(Accuracy.of(each, solver, self.scene, scatter) for each in INTERVALS)

    @property
    def details(self) -> str:
        """Every kernel and grid: what `crosscheck plan -v` prints."""
        return "\n\n".join([_lines(self._summary()), *map(str, self.values())])

    def __str__(self) -> str:
        return _lines(self._summary())

    __repr__ = __str__

    @property
    def _plans(self) -> dict[str, Plan]:
        return {name: each for name, each in self.items() if isinstance(each, Plan)}

    def _summary(self) -> Iterator[tuple[str, str]]:
        """Names and texts of doubts and notes, of the lines of a plan, then the reasons against the scene."""
        yield from (("doubtful", each) for each in self.doubts)
        yield from (("note", each) for each in notes(self.scene))
        plans, times = self._plans, list[str]()
        if isinstance(self.cost, Cost):
            contacts = f"at most {self.cost.contacts:,}, solved by crosscheck run"
            contacts += ", and more as its interval asks" * (self.case.interval is not None)
            yield "contacts", contacts if plans else f"{contacts} with {' and '.join(FINER)}"
            times.append(f"about {seconds(self.cost.seconds)} on one processor")
        elif self.refused and plans:
            yield "contacts", "none by crosscheck run, which refuses this scene"
        elif plans:
            yield "contacts", "1, from Python: crosscheck run does not compare this scene, see below"
        if plans:
            times.append(f"this contact {_by_dimension(seconds, self.times)}")
        if times:
            yield "time", "; ".join(times)
        if plans:
            memory = _by_dimension(size, {name: each.memory for name, each in plans.items()})
            yield "memory", f"{memory}, at most, in each process"
            yield "simulated", ", ".join(type(part).__name__ for part in self.scene.parts.values())
            left = dict.fromkeys(name for plan in plans.values() for name in plan.left_out)
            yield "left out", ", ".join(left) or "nothing"
        yield from (("interval", str(each)) for each in self.accuracies)
        yield "modulus", _stiffness(self.scene)
        # What refuses all contacts refuses this one too, with values that work for all of them.
        refusal = self.cost if isinstance(self.cost, str) else ""
        reasons = {name: each for name, each in self.items() if isinstance(each, str)}
        for name, each in reasons.items():
            if not (self.refused and f"{name} cannot solve" in refusal):
                yield "refused", each
        if refusal and (self.refused or not reasons):
            yield "refused" if self.refused else "alone", refusal


def _scatter(scene):
    """Relative scatter of single surfaces in 3D; NaN where the trust map does not know it."""
    try:
        place = Place.of(as_judged(scene))
    except OffTheMap:
        return nan
    models = (model(name) for name in asked_of(scene) if name != LAW)
    return nan if place.beyond else max(float(each.surface_scatter(place.values[None])[0]) for each in models)


def _by_dimension(text, numbers):
    return ", ".join(f"{text(number)} in {KNOWN[name][0]}" for name, number in numbers.items())


def _stiffness(scene):
    """Shear and Young's modulus of the solid at rest and at the instant, in words."""
    try:
        with numeric_guard():
            rest, instant = scene.solid.static_modulus, scene.solid.glassy_modulus
    except SolveError as error:
        return f"not known: {error}"
    stiffer = 2 * (1 + scene.solid.poisson_ratio)
    at_rest = f"shear G = {pascals(rest)}, Young's E = {pascals(stiffer * rest)} at rest"
    if isinf(instant):
        return f"{at_rest}; infinite at the instant (a dashpot)"
    if instant == rest:
        return f"{at_rest} and at the instant"
    return f"{at_rest}; {pascals(instant)}, {pascals(stiffer * instant)} at the instant"


def plans(asked: SceneLike) -> Plans:
    """The plans of a case, of a scene alone, of a file or of a ready scene, whether or not both can solve it.

    Raises InvalidInput.
    """
    return Plans(case_of(asked))


def planned(solver: MDR | BEM, scene: Scene) -> Plan | str:
    """The plan of a solver, or its reasons against the scene."""
    try:
        foresee(solver, scene)
        return solver.plan(scene)
    except Refused as reasons:
        return str(reasons)
    except SolveError as reason:
        return f"{solver.name} would not get through this scene: {reason}"


def _cost(case: Case) -> tuple[Cost | str, bool, tuple[str, ...]]:
    """Cost of all contacts that `crosscheck run` solves, or why it solves none and whether that is a refusal.

    Also the doubts about them.
    """
    try:
        asked = Around("scene", case)
        return sum((each.cost for each in asked.curves.values()), Cost()), False, tuple(asked.doubts)
    except NotCompared as reason:
        return str(reason), False, doubted(case)
    except Refused as reason:
        return str(reason), True, doubted(case)


def _lines(summary):
    return "\n".join(
        fill(f"{name:<{INDENT}s}{text}", WIDTH, subsequent_indent=INDENT * " ", **WHOLE) for name, text in summary
    )
