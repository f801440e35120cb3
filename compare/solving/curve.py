"""Curve: contacts of a scene at every speed and every load or depth, by several models on the same surfaces."""

# xarray is imported where a Dataset is made: to count contacts, as `crosscheck plan` does, takes none.
from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from math import ceil, inf, nan
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from mdr1d import MDR
from scene import Indent, Program, Refused, Scene, Shear, Slide, Solver, Stage
from scene.motion import PRESSES, UNITS
from scene.protocol import lacking, numeric_guard, why_not
from scene.quantities import SPEED, WHOLE, argument
from scene.result import provenance
from scene.scales import elastic_contact

from .continuation import Continuation, by_contact, joined
from .control_variates import VARIATES, control_variates
from .cost import MOST_DRAWS, Cost, work_of
from .task import Outcome, Row, SceneTask, Task, draws_of
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
OVER_TIME = "normal_force", "depth_reached", "friction_force"  # of a program, by the names of NUMBERS


class Contact(NamedTuple):
    """Contacts of a model on a level at a point of a curve, on several surfaces, solved as one task."""

    model: str
    level: str
    speed: float
    value: float
    task: SceneTask


@dataclass(frozen=True, kw_only=True)
class Curve:
    """Contacts of a scene at every speed and load or depth, each model on its levels, on the same surfaces.

    scene : its motion says what is prescribed; a Program is pressed in from nothing at a constant rate, a Shear is
        drawn to each displacement or force, and every other scene slides steadily or, at speed 0, is at rest
    speeds : of sliding, or rates of pressing in [m/s]; 0 is rest. Of a Program none where it runs as it is stated:
        its curve is then over time
    values : loads [N], depths [m], displacements [m] or tangential forces [N] that are prescribed
    levels : settings of a model by the name of the level, by the name of the model
    draws : number of rough surfaces by the name of the model, which are solved on all levels; 1 if absent.
        Several numbers are those of strata, one for each level, from fine to coarse: surfaces of each are solved
        on that level and on the next coarser one, see `statistics.multilevel`
    keeps_fields : whether the fields of the first surface on the fine level are kept, for pictures
    """

    scene: Scene
    speeds: tuple[float, ...]
    values: tuple[float, ...]
    levels: Mapping[str, Mapping[str, Solver]]
    draws: Mapping[str, int | tuple[int, ...]]
    keeps_fields: bool = False

    def __post_init__(self):
        alike = {"displacement": "depth", "force": "load"}.get(self.prescribed, self.prescribed)
        for name, unit in (("speeds", SPEED), ("values", PRESSES[alike])):
            object.__setattr__(self, name, argument(name, getattr(self, name), unit.row))
        take = {name: WHOLE.row if isinstance(given, tuple) else WHOLE.value for name, given in self.draws.items()}
        draws = {name: argument("draws", given, take[name]) for name, given in self.draws.items()}
        object.__setattr__(self, "draws", draws)

    @property
    def prescribed(self) -> str:
        """Name of what is prescribed: load, depth, or of a Shear displacement or force."""
        motion = self.scene.motion
        if isinstance(motion, Shear):
            return "force" if motion.displacement is None else "displacement"
        return motion.pressed_by

    @property
    def over_time(self) -> bool:
        """Whether the curve is an answer over time to a program as it is stated."""
        return isinstance(self.scene.motion, Program) and not self.speeds

    @property
    def axis(self) -> str:
        """Dimension of its Dataset in addition to the speed."""
        return "time" if self.over_time else self.prescribed

    @property
    def points(self) -> list[tuple[float, float]]:
        """Speed and value of every contact of a surface; speed 0 where none is stated."""
        return list(product(self.speeds or (0.0,), self.values))

    @property
    def costs(self) -> Mapping[str, tuple[float, ...]]:
        """Planned work for a surface of each stratum, on all of its levels, by the name of the model."""
        found = {}
        for name, levels in self.levels.items():
            each = [self._work(solver) for solver in levels.values()]
            pairs = [each[k : k + 2] for k in range(len(each))]
            found[name] = tuple(map(sum, pairs if self.stratified(name) else [each]))
        return found

    @property
    def cost(self) -> Cost:
        """Cost of all contacts, by counting."""
        counts = [
            (sum(map(len, seeds)), self._work(solver))
            for name, levels in self.levels.items()
            for solver, seeds in zip(levels.values(), self._seeds(name), strict=True)
        ]
        return sum((Cost(count * len(self.points), count * work) for count, work in counts), Cost())

    def _work(self, solver):
        """Work of a surface at all speeds and values."""
        each = (work_of(solver, self.at(self.values[0], speed)) for speed in self.speeds or (0.0,))
        return len(self.values) * sum(each)

    @property
    def random(self) -> bool:
        """Whether the body has draws: rough surfaces that differ by their seed."""
        return hasattr(self.scene.roughness, "seed")

    def strata(self, name: str) -> tuple[range, ...]:
        """Seeds of a model's draws by stratum, less the seed of the scene; no two strata share a seed."""
        counts = self.draws.get(name, 1) if self.random else 1
        counts = counts if isinstance(counts, tuple) else (counts,)
        return tuple(range(k * MOST_DRAWS, k * MOST_DRAWS + count) for k, count in enumerate(counts))

    def stratified(self, name: str) -> bool:
        """Whether a model has surfaces in strata."""
        return self.random and isinstance(self.draws.get(name), tuple)

    def _seeds(self, name):
        """Seeds of the draws on each level, as `strata`: of a stratum on its level and on the next coarser one."""
        strata, levels = self.strata(name), range(len(self.levels[name]))
        return [strata[max(k - 1, 0) : k + 1] if self.stratified(name) else strata for k in levels]

    def at(self, value: float, speed: float = 0.0) -> Scene:
        """The scene under one of its values, at rest or at a speed."""
        motion: Any = self.scene.motion
        if isinstance(motion, Shear):
            drawn: dict[str, Any] = {self.prescribed: value}
            return replace(self.scene, motion=replace(motion, **drawn))
        if self.over_time:
            return self.scene
        pressed: dict[str, Any] = {self.prescribed: value}
        if speed and isinstance(motion, Program):
            motion = Program(stages=(Stage(duration=value / speed, **pressed),))
        else:
            motion = Slide(speed=speed, **pressed) if speed else Indent(**pressed)
        return replace(self.scene, motion=motion)

    @property
    def corners(self) -> list[Scene]:
        """Scenes at the greatest and the least value and speed, that with the widest contact first."""
        speeds, values = (sorted({min(each), max(each)}) for each in (self.speeds or (0.0,), self.values))
        return [self.at(value, speed) for value in reversed(values) for speed in speeds]

    def tasks(self) -> list[SceneTask | Continuation]:
        """Every task, each once: all profiles of a 1D contact, and all speeds on a surface in 3D."""
        return tasks_of({"": self})

    @cached_property
    def contacts(self) -> tuple[Contact, ...]:
        """Contacts of every model, level, speed and value. Cached: building scenes is slow.

        All profiles of a 1D contact are one task, of strata some of them; each surface in 3D is one, and so is
        each profile over time.
        """
        found = []
        for name, levels in self.levels.items():
            for k, ((level, solver), seeds) in enumerate(zip(levels.items(), self._seeds(name), strict=True)):
                alike = TOGETHER if self.stratified(name) else MOST_DRAWS
                alike = alike if isinstance(solver, MDR) and not self.over_time else 1
                finer = tuple(reversed([*levels.values()][:k])) if self.stratified(name) else ()
                for number, (speed, value) in enumerate(self.points):
                    together = [
                        draws_of(self.at(value, speed), each[start : start + alike])
                        for each in seeds
                        for start in range(0, len(each), alike)
                    ]
                    first = self.keeps_fields and level == FINE and number == 0
                    found += [
                        Contact(name, level, speed, value, SceneTask(
                            solver, each, finer, self.over_time or (first and not n),
                            len(each) * work_of(solver, each[0]),
                        ))
                        for n, each in enumerate(together)
                    ]  # fmt: skip
        return tuple(found)

    def fields(self, outcomes: Mapping[Task, Outcome]) -> dict[str, Mapping[str, np.ndarray]]:
        """Fields that were kept of the first contact, by the name of the model."""
        found: dict[str, Mapping[str, np.ndarray]] = {}
        for each in self.contacts:
            if each.level == FINE and each.task.keeps_fields and (fields := outcomes[each.task].fields):
                found.setdefault(each.model, fields)
        return found

    def dataset(self, outcomes: Mapping[Task, Outcome]) -> xarray.Dataset:
        """All answers, with the dimensions model, level, speed, load or depth, and surface.

        A smooth body has no surface, and a program over time has neither speed nor load or depth, but time.
        `status` tells failed from not asked, `reason` why a solve failed. Where nothing touches, the force is 0,
        and friction and contact are NaN.
        """
        import pandas
        import xarray

        answers = by_contact(outcomes)
        rows = [row for each in self.contacts for row in self._rows(each, answers[each.task])]
        most = max(self.levels.values(), key=len)
        places: dict[str, list[Any]] = {"model": list(self.levels), "level": list(most)}
        places |= (
            {} if self.over_time else {"speed": list(self.speeds or (0.0,)), self.prescribed: list(self.values)}
        )
        frame = pandas.DataFrame(rows).set_index([*places, *(["time"] if self.over_time else []), "surface"])
        dataset = xarray.Dataset.from_dataframe(frame).reindex(places)
        for name, missing in (("status", NOT_ASKED), ("reason", "")):
            dataset[name] = dataset[name].where(dataset[name].notnull(), missing).astype(str)
        points = [
            [getattr(own.get(level), "points", 0) for level in places["level"]] for own in self.levels.values()
        ]
        draws = [str(getattr(own[FINE], "draws", "")) for own in self.levels.values()]
        dataset = dataset.assign_coords(points=(("model", "level"), points), draws=("model", draws))
        if any(map(self.stratified, self.levels)):
            first = getattr(self.scene.roughness, "seed", 0)
            dataset.coords["stratum"] = "surface", (dataset["surface"].values - first) // MOST_DRAWS
            dataset = self._with_variates(dataset)
        dataset = dataset if self.random else dataset.isel(surface=0, drop=True)
        for label in dataset.variables:
            dataset[label].attrs = attributes(str(label), self.scene)
        seeds = dataset["surface"].values.tolist() if self.random else ()
        return dataset.assign_attrs(provenance(self.scene, seeds), prescribed=self.prescribed)

    def _rows(self, contact, outcome) -> Iterator[dict[str, Any]]:
        """A row of the Dataset for each surface of a contact, and for each instant of a program."""
        place = {"model": contact.model, "level": contact.level}
        for scene, row in zip(contact.task.scenes, outcome.rows, strict=True):
            own = place | {"surface": getattr(scene.roughness, "seed", 0)}
            if not self.over_time:
                yield own | {"speed": contact.speed, self.prescribed: contact.value} | _numbers(row)
                continue
            times, fields = np.linspace(0, scene.motion.duration, INSTANTS + 1)[1:], outcome.fields
            found = {
                name: np.interp(times, fields["time"], fields[NUMBERS[name]])
                if fields
                else np.full(times.size, nan)
                for name in OVER_TIME
            }
            shared = {name: value for name, value in _numbers(row).items() if name not in OVER_TIME}
            for k, time in enumerate(times.tolist()):
                yield own | {"time": time} | shared | {name: each[k] for name, each in found.items()}

    def _with_variates(self, dataset):
        """The Dataset with control variates of the surfaces on the coarsest level of each model."""
        import xarray

        scenes, found = [self.at(value, speed) for speed, value in self.points], []
        for name in filter(self.stratified, self.levels):
            *_, (level, solver) = self.levels[name].items()
            asked = (
                dataset["status"].sel(model=name, level=level).isel(speed=0, **{self.prescribed: 0}) != NOT_ASKED
            )
            own = asked & (dataset["stratum"] == len(self.levels[name]) - 1)
            seeds = dataset["surface"].values[own.values]
            numbers = control_variates(solver, scenes, seeds.tolist())
            if numbers.size:  # NaN of all other surfaces
                shape = len(self.speeds or (0.0,)), len(self.values), *numbers.shape[1:]
                dims = "speed", self.prescribed, "surface", "variate"
                array = xarray.DataArray(numbers.reshape(shape), {"surface": seeds, "model": name}, dims)
                found.append(array)
        return dataset.assign({VARIATES: xarray.concat(found, "model", join="outer")}) if found else dataset


INSTANTS = 100  # of a program, alike apart, at which answers are compared


def of_model(dataset: xarray.Dataset, model: str) -> xarray.Dataset:
    """Answers of a model: the levels and surfaces that were asked of it, and the variables that it has."""
    own = dataset.sel(model=model)
    draws = str(own["draws"].values)
    own = own.drop_vars(["model", "draws"])
    asked = own["status"] != NOT_ASKED
    for dim in ("level", "surface"):
        if dim in own.dims:
            own = own.isel({dim: np.flatnonzero(asked.any([each for each in asked.dims if each != dim]))})
    if "surface" in own.dims and draws == NO_DRAWS:
        own = own.isel(surface=0, drop=True)
    if VARIATES in own and own[VARIATES].isnull().all():
        own = own.drop_vars(VARIATES)
    others = [
        name
        for name, each in own.data_vars.items()
        if name not in NUMBERS and each.dtype.kind == "f" and each.isnull().all()
    ]
    return own.drop_vars(others).assign_attrs(solver=model)


def _numbers(row: Row) -> dict[str, Any]:
    """What a Dataset has of a contact; without a force there is no friction."""
    status = (FINER if row.finer else SOLVED) if row.normal_force else EMPTY
    numbers = {own: getattr(row, of) for own, of in NUMBERS.items()} | {**row.measures}
    numbers |= {} if row.normal_force else {"friction_force": nan}
    return numbers | {"status": status if row.reason is None else FAILED, "reason": row.reason or ""}


def on_two_levels(*solvers: Solver) -> dict[str, dict[str, Solver]]:
    """Settings of solvers on their own grid and on one of half the points, if they have points."""
    halves = ((each, scaled(each, 0.5)) for each in solvers)
    return {each.name: {FINE: each} | ({COARSE: half} if half else {}) for each, half in halves}


def on_levels(solver: Solver, scenes: Iterable[Scene], most: int = len(LEVELS)) -> dict[str, Solver]:
    """Settings of a solver on its own grid and on coarser ones, halved as long as they can solve some scenes.

    scenes : the widest contact first; a grid that lacks what one of them takes is left out, with all coarser ones
    most : levels
    """
    first, *others = scenes
    found: list[Any] = [solver]
    with numeric_guard():
        # Half the points tell the error of the grid, however few they are.
        while len(found) < most and (len(found) == 1 or found[-1].points >= 2 * LEAST.get(solver.name, 1)):
            coarser = scaled(found[-1], 0.5)
            if coarser is None or why_not(coarser, first) or any(lacking(coarser, each) for each in others):
                break
            found.append(coarser)
    return dict(zip(LEVELS, found, strict=False))


def levels(models: Models, curves: Sequence[Curve], most: int = len(LEVELS)) -> dict[str, dict]:
    """Levels of each model, at most `most`, halved as long as they can solve all contacts of some curves."""
    corners = sorted((corner for each in curves for corner in each.corners), key=lambda each: -width(each))
    return {each.name: on_levels(each.solver, corners, most) for each in models}


def scaled(solver: Solver, times: float) -> Any:
    """The solver with a multiple of its points and steps; None without points, or if it takes no such number."""
    if not hasattr(solver, "points"):
        return None
    steps = {"steps": max(1, int(times * solver.steps))} if hasattr(solver, "steps") else {}
    try:
        return replace(solver, points=int(times * solver.points), **steps)
    except ValueError:
        return None


def refuse(curves: Iterable[Curve]) -> None:
    """Raise Refused where a model cannot solve a contact of these, SolveError where numbers are too far apart.

    The reasons of a model concern the widest contact that it cannot solve: a remedy for it is a remedy for all.
    Only the corners of a curve are checked, between which nothing else is lacking. For the widest contact the
    checks include failures that are foreseen.
    """
    asked = [(each, levels) for each in curves for levels in each.levels.values()]
    asked.sort(key=lambda pair: -width(pair[0].corners[0]))
    reasons: dict[str, str] = {}
    with numeric_guard():
        for one, own in asked:
            # What mends the coarsest of a solver mends its finer ones, which may lack memory all the same.
            for solver in reversed([*own.values()]):
                if solver.name not in reasons and (reason := _reason(solver, one, own)):
                    reasons[solver.name] = reason
    if reasons:
        raise Refused("; ".join(reasons.values()))


def _reason(solver, one, own):
    """Why a solver cannot solve all of a curve; empty where nothing is known."""
    widest, *others = one.corners
    if why := why_not(solver, widest):
        return _against(solver, widest, why, own)
    for scene in others:
        if why := lacking(solver, scene):
            return _against(solver, scene, why, own)
    return ""


def _against(solver, scene, why, own):
    """Reasons of a solver on one of its levels, with the points that have to be stated for all of them."""
    pressed, motion = scene.motion.pressed_by, scene.motion
    speed = f" at {motion.speed:.3g} m/s" if getattr(motion, "speed", 0.0) else ""
    points, text = "", "; ".join(why)
    if hasattr(solver, "points"):
        every = [each.points for each in own.values()]
        stated, coarsest = max(every), min(every)
        points = f" on {solver.points} points"
        if solver.points < stated:
            points += f", to show the error of {stated}"

        def for_all(named):
            number = int(named[0])
            return named[0] if number == solver.points else str(ceil(number * stated / coarsest))

        text = POINTS.sub(for_all, text)
    place = f"{pressed} = {motion.greatest:.3g} {UNITS[pressed]}{speed}{points}"
    return f"{solver.name} cannot solve this scene with {place}: {text}"


def width(scene):
    """Radius of the smooth relaxed contact [m]; infinite beyond the range of numbers."""
    motion = scene.motion
    held = Indent(**{motion.pressed_by: motion.greatest}) if isinstance(motion, Program | Shear) else motion
    try:
        return elastic_contact(replace(scene, motion=held)).radius
    except ArithmeticError:
        return inf


def tasks_of(curves: Mapping[str, Curve]) -> list[SceneTask | Continuation]:
    """Tasks of several curves: those that cross share the contacts where they do.

    Contacts of curves whose fields are kept are on no path with others, so that they can be solved before these.
    """
    first = {*contacts_of({name: each for name, each in curves.items() if each.keeps_fields})}
    return joined(contacts_of(curves), first)


def contacts_of(curves: Mapping[str, Curve]) -> list[SceneTask]:
    """Contacts of several curves, each once."""
    every = [each.task for curve in curves.values() for each in curve.contacts]
    found = {each: each for each in every} | {each: each for each in every if each.keeps_fields}
    return list(found.values())


def tree(curves: Mapping[str, Curve], outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
    """Everything solved of some curves: a Dataset for each of them, at /name."""
    import xarray

    answers = by_contact(outcomes)
    return xarray.DataTree.from_dict({f"/{name}": each.dataset(answers) for name, each in curves.items()})
