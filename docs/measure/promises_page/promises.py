"""Whether settings found by `bem3d.for_accuracy` keep what was wanted, on random scenes."""

import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import isfinite, nan

from pandas import DataFrame

from bem3d import Unconfirmed, for_accuracy
from compare.solving.task import Outcome, Row, SceneTask, Task
from scene import Result, Scene, SolveError
from scene.scales import elastic_contact

from . import scenes
from .errors import reference, settled

WANTED = (0.1, 0.03, 0.01, 0.003)
FIRST = 7000  # seed
COUNTS = {"smooth": 400, "rough": 100}
KNOWN = 0.2  # of a wanted error: what the truth is known to where a promise is checked


@dataclass(frozen=True)
class Promised:
    """A solver that finds its settings for a wanted error; its measure `shown` is the error of three grids."""

    quantity: str
    wanted: float
    name = "BEM"
    packages = ("scene", "bem3d", __name__)

    def solve(self, scene: Scene) -> Result:
        """Answer with the settings found."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", Unconfirmed)
            try:
                choice = for_accuracy(scene, **{self.quantity: self.wanted})
            except ValueError as reason:
                raise SolveError(str(reason)) from reason
        error = choice.error[self.quantity]
        return replace(choice.result, measures={"shown": error if isfinite(error) else nan})


def asked() -> Iterator[SceneTask]:
    """Every quantity of every scene within every error wanted."""
    for kind, count in COUNTS.items():
        for seed in range(FIRST, FIRST + count):
            scene = scenes.drawn(kind, seed)
            for quantity in ("friction", "depth" if scene.motion.depth is None else "load"):
                for wanted in WANTED:
                    yield SceneTask(Promised(quantity, wanted), (scene,), work=1e8)


def with_truth(task: SceneTask) -> tuple[SceneTask, ...]:
    """A promise, and the tasks that it is checked against."""
    return task, *reference(task.scenes[0])


def rows(tasks: Sequence[SceneTask], outcomes: Mapping[Task, Outcome]) -> list[dict]:
    """Each promise with its answer and error, NaN where the truth is not known well enough."""
    return [_entry(task, *(outcomes[each].rows[0] for each in with_truth(task))) for task in tasks]


def kept(made: Sequence[Mapping]) -> list[dict]:
    """Counts of promises by quantity and wanted error, and of all."""
    groups = DataFrame(made).groupby(["quantity", "wanted"], sort=False)
    return [{"quantity": quantity, "wanted": wanted, **_counted(own)} for (quantity, wanted), own in groups]


def _counted(own):
    sure = own[own["shown"] <= own["wanted"]]
    return {
        "asked": len(own),
        "answered": own["points"].count(),
        "confirmed": len(sure),
        "checked": sure["error"].count(),
        "broken": (sure["error"] > sure["wanted"]).sum(),
        "worst_error": sure["error"].max(),
    }


def _entry(task, answer: Row, *finer: Row):
    (scene,), quantity, wanted = task.scenes, task.solver.quantity, task.solver.wanted
    points, shown = answer.settings.get("points", nan), answer.measures.get("shown", nan)
    unit = {"friction": None, "depth": elastic_contact(scene).depth, "load": None}[quantity]
    truth, unsure = settled([_value(quantity, each) for each in finer if each.reason is None], unit)
    error = nan
    if answer.reason is None and unsure <= KNOWN * wanted and 2 * points <= finer[-1].settings.get("points", 0):
        error = abs(_value(quantity, answer) - truth) / (abs(truth) if unit is None else unit)
    return {"quantity": quantity, "wanted": wanted, "points": points, "shown": shown, "error": error}


def _value(quantity, answer: Row):
    names = {"friction": "friction_coefficient", "depth": "depth", "load": "normal_force"}
    return getattr(answer, names[quantity])
