"""Whether settings found by `bem3d.for_accuracy` keep what was wanted, on random scenes."""

import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import isfinite, nan

from pandas import DataFrame

from bem3d import Unconfirmed, for_accuracy
from bem3d.costs import band
from compare.solving.outcome import Outcome, Row, row
from compare.solving.task import SCENES, Task
from scene import Scene, SolveError
from scene.scales import elastic_contact

from . import scenes
from .errors import reference, settled

WANTED = (0.1, 0.03, 0.01, 0.003)
FIRST = 7000  # seed
COUNTS = {"smooth": 400, "rough": 100}
KNOWN = 0.2  # of a wanted error: what the truth is known to where a promise is checked


@dataclass(frozen=True)
class Promise(Task):
    """A task: an answer within a wanted error.

    Its row is the answer's; measures has besides those: points, and the error as three grids show it.
    """

    scene: Scene
    quantity: str
    wanted: float
    work: float = 1e8
    packages = ("scene", "bem3d", __name__)

    @property
    def label(self) -> str:
        """Short description for people."""
        return f"{self.quantity} within {self.wanted:g}, {type(self.scene.indenter).__name__.lower()}"

    @property
    def question(self) -> Mapping:
        """The scene and what is wanted."""
        (scene,) = SCENES.dump_python((self.scene,), mode="json")
        return {"promise": scene, "quantity": self.quantity, "wanted": self.wanted}

    @property
    def tasks(self) -> tuple[Task, ...]:
        """The promise and what it is checked against."""
        return (self, *reference(self.scene))

    def solve(self) -> Outcome:
        """Answer with the settings found; NaN with its reason where there is none."""
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", Unconfirmed)
                choice = for_accuracy(self.scene, **{self.quantity: self.wanted})
        except (SolveError, ValueError) as reason:
            return self.failed(str(reason))
        found, error = row(choice.result), choice.error[self.quantity]
        more = {"points": float(choice.solver.points), "shown": error if isfinite(error) else nan}
        return Outcome((replace(found, measures={**found.measures, **more}),))


def asked() -> Iterator[Promise]:
    """Every quantity of every scene within every error wanted."""
    for kind, count in COUNTS.items():
        for seed in range(FIRST, FIRST + count):
            scene = scenes.drawn(kind, seed)
            for quantity in ("friction", "depth" if scene.motion.depth is None else "load"):
                for wanted in WANTED:
                    yield Promise(scene, quantity, wanted)


def rows(tasks: Sequence[Promise], outcomes: Mapping[Task, Outcome]) -> list[dict]:
    """Each promise and what became of it; its error is NaN where the truth is not known well enough."""
    return [_entry(task, *(outcomes[each].rows[0] for each in task.tasks)) for task in tasks]


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
    points, shown = (answer.measures.get(name, nan) for name in ("points", "shown"))
    unit = {"friction": None, "depth": elastic_contact(task.scene).depth, "load": None}[task.quantity]
    truth, unsure = settled([_value(task.quantity, each) for each in finer if each.reason is None], unit)
    error = nan
    if (
        answer.reason is None
        and unsure <= KNOWN * task.wanted
        and 2 * points <= finer[-1].settings.get("points", 0)
    ):
        error = abs(_value(task.quantity, answer) - truth) / (abs(truth) if unit is None else unit)
    return {
        "shape": type(task.scene.indenter).__name__,
        "solid": type(task.scene.elastomer).__name__,
        "body": "smooth" if task.scene.roughness is None else "rough",
        "band": band(task.scene),
        "quantity": task.quantity,
        "wanted": task.wanted,
        "points": points,
        "shown": float(f"{shown:.3g}"),
        "error": float(f"{error:.3g}"),
        "reason": answer.reason or "",
    }


def _value(quantity, answer: Row):
    names = {"friction": "friction_coefficient", "depth": "depth", "load": "normal_force"}
    return getattr(answer, names[quantity])
