"""Whether settings chosen by `BEM.for_accuracy` keep their promise, on scenes that its ladder does not know."""

import hashlib
import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import isfinite, nan

import numpy as np

from bem3d import BEM
from bem3d.accuracy import LADDER, Unconfirmed, apart, band
from compare.outcome import Outcome, Row, row
from compare.task import SCENES, SceneTask, Task
from scene import (
    Cone,
    Fractional,
    Indent,
    Plane,
    PowerLaw,
    Prony,
    Scene,
    SelfAffine,
    Slide,
    SolveError,
    Sphere,
    StandardLinearSolid,
)
from scene.rheology import Elastomer
from scene.scales import elastic_contact

from .ladder import TIGHT, missing

WANTED = (0.1, 0.03, 0.01, 0.003)
FINEST, TRUTH = 1024, 2  # points of the truth, and how many times those chosen they have to be
# Elastomers of several times, of a glass a hundred times as stiff, and of a loss as a power of the frequency.
SOLIDS: dict[str, Elastomer] = {
    "three modes": Prony(equilibrium_modulus=0.25, moduli=(0.25, 0.5, 1.0), relaxation_times=(10.0, 1.0, 0.1)),
    "standard linear, E_g/E_r = 100": StandardLinearSolid(0.25, 25.0, 0.01),
    "fractional": Fractional(
        modulus=0.25,
        relaxation_time=1.0,
        exponent=0.5,
        lowest_frequency=1e-3,
        highest_frequency=1e3,
    ),
}


@dataclass(frozen=True)
class Promise:
    """A task: an answer with settings chosen for a wanted error.

    Its row is the answer's; measures has besides those: points, expected and promised_seconds of a promise that
    was made, and the change of the quantity from half the points to all.
    """

    scene: Scene
    quantity: str
    wanted: float
    work: float = 1e8
    keeps_fields = False
    packages = ("scene", "bem3d", f"{__package__}.ladder", __name__)

    @property
    def label(self) -> str:
        """Short description for people."""
        return f"{self.quantity} within {self.wanted:g}, {type(self.scene.indenter).__name__.lower()}"

    @property
    def question(self) -> Mapping:
        """The scene and what is wanted."""
        (scene,) = SCENES.dump_python((self.scene,), mode="json")
        ladder = hashlib.sha256(LADDER.read_bytes()).hexdigest()
        return {"promise": scene, "quantity": self.quantity, "wanted": self.wanted, "ladder": ladder}

    def solve(self) -> Outcome:
        """Answer with the settings promised; NaN with its reason where none was made."""
        try:
            choice = BEM.for_accuracy(self.scene, **{self.quantity: self.wanted})
        except (SolveError, ValueError) as reason:
            return Outcome((Row(reason=str(reason)),))
        made = {
            "points": float(choice.solver.points),
            "expected": choice.expected[self.quantity],
            "promised_seconds": choice.seconds,
        }
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", Unconfirmed)
                answer = choice.solve()
        except SolveError as reason:
            return Outcome((Row(reason=str(reason), measures=made),))
        found, change = row(answer.result), {"change": answer.change[self.quantity]}
        return Outcome((replace(found, measures={**found.measures, **made, **change}),))

    def failed(self, reason: str) -> Outcome:
        """One row, with the reason."""
        return Outcome((Row(reason=reason),))

    def fits(self, outcome: Outcome) -> bool:
        """One row."""
        return len(outcome.rows) == 1


def asked() -> list[Promise]:
    """Every quantity of every scene within every error wanted."""
    return [
        Promise(scene, quantity, wanted)
        for scene in scenes()
        for quantity in _quantities(scene)
        for wanted in WANTED
    ]


def truth(scene: Scene) -> SceneTask:
    """Task against which the answers to a scene are checked."""
    solver = BEM(points=FINEST, tolerance=TIGHT)
    return SceneTask(solver, (scene,), work=FINEST**2.2 * 50.0)


def rows(tasks: Sequence[Promise], outcomes: Mapping[Task, Outcome]) -> list[dict]:
    """Each promise and what became of it; its error is NaN where the truth is not twice as fine, or failed."""
    return [_entry(task, outcomes[task].rows[0], outcomes[truth(task.scene)].rows[0]) for task in tasks]


def kept(rows: Sequence[Mapping]) -> list[dict]:
    """By quantity and wanted error: how many promises were made, checked, kept, confirmed, and confirmed and kept.

    One that was made and then had no answer counts as checked, and not as kept.
    """
    found = []
    for quantity in dict.fromkeys(each["quantity"] for each in rows):
        for wanted in WANTED:
            asked = [each for each in rows if (each["quantity"], each["wanted"]) == (quantity, wanted)]
            made = [each for each in asked if isfinite(each["points"])]
            checked = [each for each in made if each["reason"] or isfinite(each["error"])]
            sure = [each for each in checked if each["change"] <= wanted]
            found.append(
                {
                    "quantity": quantity,
                    "wanted": wanted,
                    "asked": len(asked),
                    "made": len(made),
                    "checked": len(checked),
                    "kept": sum(each["error"] <= wanted for each in checked),
                    "confirmed": len(sure),
                    "confirmed_and_kept": sum(each["error"] <= wanted for each in sure),
                    "worst_error": max((each["error"] for each in checked), default=nan),
                    "median_points": float(np.median([each["points"] for each in made])) if made else nan,
                }
            )
    return found


def scenes() -> Iterator[Scene]:
    """Other shapes, solids, spectra, speeds and seeds than those of the ladder; drawn once, from one seed."""
    draw = np.random.default_rng(20141)
    shapes = Sphere(radius=1.0), Cone(angle=0.2), PowerLaw(coefficient=1.0, exponent=3.0)
    for k, solid in enumerate(SOLIDS.values()):
        for shape in shapes:
            depth = shape.mdr_coefficient * 0.1**shape.exponent
            load = elastic_contact(Scene(shape, solid, Indent(depth=depth))).load
            for rough in (False, True):
                roughness = SelfAffine(
                    hurst=float(draw.uniform(0, 1)),
                    rms_height=float(depth * 10 ** draw.uniform(-1.5, 0)),
                    longest=float(draw.uniform(0.15, 0.5)),
                    shortest=float(draw.uniform(0.01, 0.04)),
                    seed=int(draw.integers(1000)),
                )
                pressed = {"load": load} if k != 1 else {"depth": depth}
                length = roughness.shortest if rough else 0.1
                yield Scene(
                    shape, solid, Slide(speed=_speed(draw, solid, length), **pressed), roughness if rough else None
                )
        waves = SelfAffine(hurst=float(draw.uniform(0, 1)), rms_height=1e-2, longest=1.0, shortest=0.1, seed=k)
        pressure = float(10 ** draw.uniform(-2.5, -1))
        yield Scene(Plane(), solid, Slide(speed=_speed(draw, solid, waves.shortest), pressure=pressure), waves)


def _speed(draw, solid, length):
    """Speed at which the memory of the solid is a thousandth to a hundred times a length [m]."""
    _, compliances, times = solid.retardation()
    memory = float(compliances @ times**2 / (compliances @ times))
    return float(10 ** draw.uniform(-3, 2)) * length / memory


def _quantities(scene):
    if isinstance(scene.indenter, Plane):
        return ("friction",)
    return "friction", "depth" if scene.motion.depth is None else "load"


def _entry(task, answer: Row, finest: Row):
    names = ("points", "expected", "change", "promised_seconds", "friction_disagreement")
    measures = {name: answer.measures.get(name, nan) for name in names}
    error, points = nan, measures["points"]
    if answer.reason is None and finest.reason is None and TRUTH * points <= FINEST:
        error = apart(task.scene, task.quantity, answer, finest) * missing(points, FINEST)
    return {
        "shape": type(task.scene.indenter).__name__,
        "solid": next(name for name, solid in SOLIDS.items() if solid == task.scene.elastomer),
        "body": "smooth" if task.scene.roughness is None else "rough",
        "band": band(task.scene),
        "quantity": task.quantity,
        "wanted": task.wanted,
        **measures,
        "error": error,
        "mu": answer.friction_coefficient,
        "seconds": answer.seconds,
        "reason": answer.reason or "",
    }
