"""Parameter grid: contacts of one scene at every speed and every load or depth, and their answers as Datasets."""

# xarray is imported where a Dataset is made: to count contacts, as `crosscheck plan` does, takes none.
from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from math import ceil, inf, nan
from typing import TYPE_CHECKING, Any

import numpy as np

from bem3d import BEM
from mdr1d import MDR
from scene import Indent, Program, Refused, Scene, Slide, Solver, Stage
from scene.motion import PRESSES, UNITS, Motion
from scene.printable import brief
from scene.protocol import lacking, trusted, why_not
from scene.quantities import SPEED, WHOLE, argument
from scene.result import provenance
from scene.scales import elastic_contact

from .continuation import Continuation, by_contact, joined
from .control_variates import VARIATES, control_variates
from .cost import MOST_DRAWS, Cost
from .outcome import Outcome, Row
from .task import SceneTask, Task, draws_of, refuse_seed
from .vocabulary import attributes

if TYPE_CHECKING:
    import xarray

    from ..models.table import Models

FINE, COARSE = "fine", "coarse"
LEVELS = FINE, COARSE, "coarser", "coarsest"
LEAST = {"BEM": 32, "MDR": 512}  # points of the coarsest, below which a surface costs hardly less
# Status of a contact: solved, solved by the next finer grid that can, without a contact at the prescribed depth,
# without an answer, or never asked for.
SOLVED, FINER, EMPTY, FAILED, NOT_ASKED = (
    "solved", "solved on a finer grid", "no contact", "failed", "not asked"
)  # fmt: skip
NO_DRAWS = "none"  # of a model that answers for all surfaces at once
UNASKED = Row()  # of a draw that is not solved on a grid
ROOM = 1.5  # times the points that a line takes at least: then others of its family do not need more
MOST_ASKED = 1000  # lines drawn, whether each fits its grid
TOGETHER = 8  # profiles of a stratum that are one task, so that more of them leave those before as they are
POINTS = re.compile(r"(?<=points = )\d+")  # that a reason names: those of its solver, and those that would do
# What a solver gives of every contact, by the names of a Dataset: there `depth` is one that is prescribed, which a
# march answers half a step before.
NUMBERS = {
    "normal_force": "normal_force",
    "depth_reached": "depth",
    "friction_force": "friction_force",
    "friction_coefficient": "friction_coefficient",
    "residual": "residual",
    "operator_applications": "operator_applications",
    "seconds": "seconds",
}


@dataclass(frozen=True, kw_only=True)
class ParameterGrid:
    """Contacts of one scene at every speed and every load or depth, each solver on its grids, on the same draws.

    scene : its motion says whether a load or a depth is prescribed; a Program is pressed in from nothing at a
        constant rate, every other scene slides steadily or, at speed 0, is at rest
    speeds : of sliding, or rates of pressing in [m/s]; 0 is rest
    values : loads [N] or depths [m] that are prescribed
    grids : settings of a solver by the name of the grid, by the name of the solver
    draws : number of rough surfaces by the name of the solver, which are solved on all grids; 1 if absent.
        Several numbers are those of strata, one for each grid, from fine to coarse: surfaces of each are solved on
        that grid and on the next coarser one, see `statistics.multilevel`
    keeps_fields : whether the fields of the first draw on the fine grid are kept, for pictures
    """

    scene: Scene
    speeds: tuple[float, ...]
    values: tuple[float, ...]
    grids: Mapping[str, Mapping[str, Solver]]
    draws: Mapping[str, int | tuple[int, ...]]
    keeps_fields: bool = False

    def __post_init__(self):
        for name, unit in (("speeds", SPEED), ("values", PRESSES[self.prescribed])):
            object.__setattr__(self, name, argument(name, getattr(self, name), unit.row))
        draws = {}
        for name, given in self.draws.items():
            strata, grids = isinstance(given, tuple), len(self.grids.get(name, ()))
            draws[name] = counts = argument("draws", given, WHOLE.row if strata else WHOLE.value)
            if strata and not (len(counts) == grids and 0 < min(counts) <= max(counts) <= MOST_DRAWS):
                allowed = f"{grids} whole numbers, one for each grid, from 1 to {MOST_DRAWS:,}"
                raise ValueError(f"draws = {brief(repr(counts))} of {name}: {allowed}")
        object.__setattr__(self, "draws", draws)
        refuse_seed(self.scene, len(LEVELS) * MOST_DRAWS)  # of all strata, however many surfaces they will have

    @property
    def prescribed(self) -> str:
        """Name of what is prescribed: "load" or "depth"."""
        return self.scene.motion.pressed_by

    @property
    def costs(self) -> Mapping[str, tuple[float, ...]]:
        """Planned work of one surface of each stratum, on all of its grids, by the solver."""
        points = len(self.speeds) * len(self.values)
        found = {}
        for name, grids in self.grids.items():
            each = [points * work_of(solver, self.scene) for solver in grids.values()]
            pairs = [each[k : k + 2] for k in range(len(each))]
            found[name] = tuple(map(sum, pairs if self._stratified(name) else [each]))
        return found

    @property
    def cost(self) -> Cost:
        """Cost of all contacts, by counting."""
        points = len(self.speeds) * len(self.values)
        asked = [
            (points * sum(map(len, seeds)), work_of(solver, self.scene))
            for name, grids in self.grids.items()
            for solver, seeds in zip(grids.values(), self._seeds(name), strict=True)
        ]
        costs = (Cost(count, count * work) for count, work in asked)
        fine = (each for grids in self.grids.values() for name, each in grids.items() if name == FINE)
        planes = (each.points**2 for each in fine if self.keeps_fields and isinstance(each, BEM))
        # Heights, pressure and gap, in the store and in the file of results.
        return sum(costs, Cost(kept=sum(48 * points for points in planes)))

    @property
    def random(self) -> bool:
        """Whether the body has draws: rough surfaces that differ by their seed."""
        return hasattr(self.scene.roughness, "seed")

    def strata(self, name: str) -> tuple[range, ...]:
        """Seeds of a solver's draws by stratum, less that of the scene; however many, each has its own."""
        counts = self.draws.get(name, 1) if self.random else 1
        counts = counts if isinstance(counts, tuple) else (counts,)
        return tuple(range(k * MOST_DRAWS, k * MOST_DRAWS + count) for k, count in enumerate(counts))

    def told(self, name: str, word: str) -> str:
        """Numbers of a model's draws in words, with the points of their grids where these differ.

        word : what they are called, in the plural
        """
        counts = [len(each) for each in self.strata(name)]
        if not self._stratified(name):
            return f"{counts[0]} {word}"
        points = [str(getattr(solver, "points", "")) for solver in self.grids[name].values()]
        on = [" and ".join(points[k : k + 2]) for k in range(len(counts))]
        return ", ".join(f"{count:,} {word} on {grids} points" for count, grids in zip(counts, on, strict=True))

    def _seeds(self, name):
        """Seeds of the draws on each grid, as `strata`: of a stratum on its grid and on the next coarser one."""
        strata, grids = self.strata(name), range(len(self.grids[name]))
        return [strata[max(k - 1, 0) : k + 1] if self._stratified(name) else strata for k in grids]

    def _stratified(self, name):
        return self.random and isinstance(self.draws.get(name), tuple)

    def at(self, value: float, speed: float = 0.0) -> Scene:
        """The scene under one load or depth, at rest or at a speed."""
        pressed: dict[str, Any] = {self.prescribed: value}
        motion: Motion
        if speed and isinstance(self.scene.motion, Program):
            motion = Program(stages=(Stage(duration=value / speed, **pressed),))
        else:
            motion = Slide(speed=speed, **pressed) if speed else Indent(**pressed)
        return replace(self.scene, motion=motion)

    @property
    def corners(self) -> list[Scene]:
        """Scenes at the greatest and the least load or depth and speed, that with the widest contact first."""
        speeds, values = (sorted({min(each), max(each)}) for each in (self.speeds, self.values))
        return [self.at(value, speed) for value in reversed(values) for speed in speeds]

    def refuse(self) -> None:
        """Raise as `refuse` of this one alone."""
        refuse([self])

    def tasks(self) -> list[SceneTask | Continuation]:
        """Every task, each once: all profiles of a 1D contact, and all speeds on a surface in 3D."""
        return tasks_of({"": self})

    def datasets(self, outcomes: Mapping[Task, Outcome]) -> dict[str, xarray.Dataset]:
        """Datasets by the name of the solver, with the dimensions grid, speed, load or depth, and seed.

        A smooth body has no seed. `status` tells failed from not asked, `reason` why a solve failed. Where nothing
        touches, the force is 0, and friction and contact are NaN.
        """
        rows: dict[str, list[Row]] = {name: [] for name in self.grids}
        answers = by_contact(outcomes)
        for name, contacts in self.contacts:
            rows[name] += [row for each in contacts for row in answers[each].rows]
        return {name: self._dataset(name, found) for name, found in rows.items()}

    def fields(self, outcomes: Mapping[Task, Outcome]) -> dict[str, Mapping[str, np.ndarray]]:
        """Fields that were kept of the first contact, by the name of the solver."""
        kept = ((name, outcomes[first].fields) for name, (first, *_) in self.contacts if first.keeps_fields)
        return {name: fields for name, fields in kept if fields}

    @cached_property
    def contacts(self) -> tuple[tuple[str, tuple[SceneTask, ...]], ...]:
        """Solver's name and contacts of every point, by grid, speed and value. Cached: building scenes is slow.

        All profiles of a 1D contact are one, of strata some of them; each surface in 3D is one.
        """
        found = []
        own = self.speeds[0], self.values[0]
        for name, grids in self.grids.items():
            stratified = self._stratified(name)
            on = [*zip(grids.items(), self._seeds(name), strict=True)]
            for (k, ((grid, solver), seeds)), speed, value in product(enumerate(on), self.speeds, self.values):
                alike = 1 if not isinstance(solver, MDR) else TOGETHER if stratified else MOST_DRAWS
                together = [
                    draws_of(self.at(value, speed), each[start : start + alike])
                    for each in seeds
                    for start in range(0, len(each), alike)
                ]
                first = self.keeps_fields and grid == FINE and (speed, value) == own
                finer = tuple(reversed([*grids.values()][:k])) if stratified else ()
                contacts = [
                    SceneTask(solver, each, finer, first and not n, len(each) * work_of(solver, each[0]))
                    for n, each in enumerate(together)
                ]
                found.append((name, tuple(contacts)))
        return tuple(found)

    def _dataset(self, name, rows):
        import pandas
        import xarray

        grids, seeds = self.grids[name], [seed for each in self.strata(name) for seed in each]
        asked = np.array([np.isin(seeds, [seed for each in on for seed in each]) for on in self._seeds(name)])
        shape = len(grids), len(self.speeds), len(self.values), len(seeds)
        found = np.full(shape, UNASKED)
        found[np.broadcast_to(asked[:, None, None], shape)] = rows
        table = pandas.DataFrame([_numbers(row) for row in found.ravel()])
        names = [*NUMBERS, *sorted({*table} - {*NUMBERS, "status", "reason"}), "status", "reason"]
        dims = "level", "speed", self.prescribed, "surface"
        first = self.scene.roughness.seed if self.random else 0
        dataset = xarray.Dataset(
            {label: (dims, table[label].to_numpy(copy=True).reshape(shape)) for label in names},
            {
                "level": list(grids),
                "speed": list(self.speeds),
                self.prescribed: list(self.values),
                "points": ("level", [getattr(solver, "points", 0) for solver in grids.values()]),
                "surface": [first + seed for seed in seeds],
            },
        )
        if self._stratified(name):
            dataset.coords["stratum"] = "surface", [k for k, each in enumerate(self.strata(name)) for _ in each]
            coarsest = dataset["surface"].values[dataset["stratum"] == len(grids) - 1]
            scenes = [self.at(value, speed) for speed, value in product(self.speeds, self.values)]
            found = control_variates([*grids.values()][-1], scenes, coarsest.tolist())
            if found.size:  # NaN of all other surfaces
                found = found.reshape(*shape[1:3], *found.shape[1:])
                dataset[VARIATES] = xarray.DataArray(found, {"surface": coarsest}, [*dims[1:], "variate"])
        if not self.random or getattr(grids[FINE], "draws", "") == NO_DRAWS:
            dataset = dataset.isel(surface=0, drop=True)
        for label in dataset.variables:
            dataset[label].attrs = attributes(str(label), self.scene)
        drawn = dataset["surface"].values.tolist() if "surface" in dataset else ()
        return dataset.assign_attrs(provenance(self.scene, drawn) | {"solver": name})


def _numbers(row):
    """What a Dataset has of a contact; without a force there is no friction."""
    status = (FINER if row.finer else SOLVED) if row.normal_force else EMPTY
    status = NOT_ASKED if row is UNASKED else status if row.reason is None else FAILED
    numbers = {own: getattr(row, of) for own, of in NUMBERS.items()} | {**row.measures}
    numbers |= {} if row.normal_force else {"friction_force": nan}
    return numbers | {"status": status, "reason": row.reason or ""}


def on_two_grids(*solvers: Solver) -> dict[str, dict[str, Solver]]:
    """Settings of solvers on their own grid and on one of half the points, if they have points."""
    halves = ((each, halved(each)) for each in solvers)
    return {each.name: {FINE: each} | ({COARSE: half} if half else {}) for each, half in halves}


def on_levels(solver: Solver, scenes: Iterable[Scene], most: int = len(LEVELS)) -> dict[str, Solver]:
    """Settings of a solver on its own grid and on coarser ones, halved as long as they can solve some scenes.

    scenes : the widest contact first; a grid that lacks what one of them takes is left out, with all coarser ones
    most : grids
    """
    first, *others = scenes
    found: list[Any] = [solver]
    with trusted():
        # Half the points tell the error of the grid, however few they are.
        while len(found) < most and (len(found) == 1 or found[-1].points >= 2 * LEAST.get(solver.name, 1)):
            coarser = halved(found[-1])
            if coarser is None or why_not(coarser, first) or any(lacking(coarser, each) for each in others):
                break
            found.append(coarser)
    return dict(zip(LEVELS, found, strict=False))


def levels(models: Models, grids: Sequence[ParameterGrid], most: int = len(LEVELS)) -> dict[str, dict]:
    """Grids of each model, halved as long as they can solve all of some parameter grids, at most so many."""
    corners = sorted((corner for each in grids for corner in each.corners), key=lambda each: -width(each))
    return {each.name: on_levels(each.solver, corners, most) for each in models}


def halved(solver: Solver) -> Any:
    """The solver on half the points, and half the steps in time; None of one without, or that takes no fewer."""
    if not hasattr(solver, "points"):
        return None
    steps = {"steps": max(1, solver.steps // 2)} if hasattr(solver, "steps") else {}
    try:
        return replace(solver, points=solver.points // 2, **steps)
    except ValueError:
        return None


def refuse(parameter_grids: Iterable[ParameterGrid]) -> None:
    """Raise Refused where a solver cannot solve a contact of these, SolveError where numbers are too far apart.

    Of each solver the reasons are told against the widest contact that it cannot solve: what mends that mends all.
    Asked at the corners of a parameter grid, between which nothing else is lacking; of the widest contact also
    what is foreseen of its solve, and, where one line hardly fits its grid, whether every other does.
    """
    asked = [(each, grids) for each in parameter_grids for grids in each.grids.values()]
    asked.sort(key=lambda pair: -width(pair[0].corners[0]))
    told: dict[str, str] = {}
    with trusted():
        for one, grids in asked:
            # What mends the coarsest of a solver mends its finer ones, which may lack memory all the same.
            for solver in reversed([*grids.values()]):
                if solver.name not in told and (reason := _reason(solver, one, grids)):
                    told[solver.name] = reason
    if told:
        raise Refused("; ".join(told.values()))


def _reason(solver, one, grids):
    """Why a solver cannot solve all of a parameter grid; empty where nothing is known."""
    widest, *others = one.corners
    if why := why_not(solver, widest):
        return _against(solver, widest, why, grids)
    draws: tuple[Scene, ...] = ()
    if isinstance(solver, MDR) and replace(solver, points=max(8, int(solver.points / ROOM))).refusals(widest):
        draws = draws_of(widest, [seed for each in one.strata(solver.name) for seed in each][:MOST_ASKED])
    for scene in (*others, *draws[1:]):
        if why := lacking(solver, scene):
            return _against(solver, scene, why, grids)
    return ""


def _against(solver, scene, why, grids):
    """Reasons of a solver on one of its grids, with the points that have to be stated for all of them."""
    pressed, motion = scene.motion.pressed_by, scene.motion
    speed = f" at {motion.speed:.3g} m/s" if getattr(motion, "speed", 0.0) else ""
    points, said = "", "; ".join(why)
    if hasattr(solver, "points"):
        own = [each.points for each in grids.values()]
        stated, coarsest = max(own), min(own)
        points = f" on {solver.points} points"
        if solver.points < stated:
            points += f", which show the error of the grid of {stated}"

        def for_all(named):
            number = int(named[0])
            return named[0] if number == solver.points else str(ceil(number * stated / coarsest))

        said = POINTS.sub(for_all, said)
    place = f"{pressed} = {motion.greatest:.3g} {UNITS[pressed]}{speed}{points}"
    return f"{solver.name} cannot solve this scene with {place}: {said}"


def width(scene):
    """Radius of the smooth relaxed contact [m]; infinite beyond the range of numbers."""
    motion = scene.motion
    try:
        return elastic_contact(replace(scene, motion=motion.held) if isinstance(motion, Program) else scene).radius
    except ArithmeticError:
        return inf


def tasks_of(grids: Mapping[str, ParameterGrid]) -> list[SceneTask | Continuation]:
    """Tasks of several grids: those that cross share the contacts where they do."""
    return joined(contacts_of(grids))


def contacts_of(grids: Mapping[str, ParameterGrid]) -> list[SceneTask]:
    """Contacts of several grids, each once."""
    every = [each for grid in grids.values() for _, contacts in grid.contacts for each in contacts]
    found = {each: each for each in every} | {each: each for each in every if each.keeps_fields}
    return list(found.values())


def tree(grids: Mapping[str, ParameterGrid], outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
    """Everything solved of some grids: a Dataset for each of them and solver, at /name/solver."""
    import xarray

    answers = by_contact(outcomes)
    parts = {
        f"/{name}/{solver}": dataset
        for name, each in grids.items()
        for solver, dataset in each.datasets(answers).items()
    }
    return xarray.DataTree.from_dict(parts)


def work_of(solver, scene):
    """Cost of a contact in passes over a point of a grid, roughly."""
    if isinstance(solver, MDR):
        # As measured: a mode costs a tenth of all else.
        each = solver.points * 5.0 * (1 + scene.solid.relaxation()[2].size / 10)
    elif isinstance(solver, BEM):
        each = solver.points**2.2 * 50.0
    else:
        return 1.0
    return each * (solver.steps if isinstance(scene.motion, Program) else 1)
