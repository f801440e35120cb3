"""Whether settings chosen by `BEM.for_accuracy` keep their promise, on scenes that its ladder does not know."""

import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from bem3d import BEM
from bem3d.accuracy import Unconfirmed, band
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
from scene.scales import elastic_contact

from ..outcome import Outcome, Row, row
from ..store import Task
from ..study import SCENES
from .promises import TIGHT, error_of

WANTED = (0.1, 0.03, 0.01, 0.003)
TRUTH, MOST = 2, 1024  # points of the truth over those chosen, and how many at most
# Elastomers of several times, of a glass a hundred times as stiff, and of a loss as a power of the frequency.
SOLIDS = {
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
    """A task, as of store: the error of an answer chosen for a wanted one, against a finer grid.

    Its row is the answer's; measures has besides those: expected, change and error of the quantity, points,
    promised_seconds, truth_points.
    """

    scene: Scene
    quantity: str
    wanted: float
    work: float = 1e8
    keeps_fields = False
    packages = ("scene", "bem3d", "compare.workprecision.promises", __name__)

    @property
    def label(self) -> str:
        """Short description for people."""
        return f"{self.quantity} within {self.wanted:g}, {type(self.scene.indenter).__name__.lower()}"

    @property
    def question(self) -> Mapping:
        """The scene and what is wanted."""
        (scene,) = SCENES.dump_python((self.scene,), mode="json")
        return {"promise": scene, "quantity": self.quantity, "wanted": self.wanted}

    def solve(self) -> Outcome:
        """What was promised, and what was kept."""
        try:
            choice = BEM.for_accuracy(self.scene, **{self.quantity: self.wanted})
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", Unconfirmed)
                answer = choice.solve()
            points = min(MOST, TRUTH * choice.solver.points)
            if points < TRUTH * choice.solver.points:
                return Outcome((Row(reason=f"{choice.solver.points} points chosen, more than can be checked"),))
            truth = row(BEM(points=points, tolerance=TIGHT).solve(self.scene))
        except (SolveError, ValueError) as error:
            return Outcome((Row(reason=str(error)),))
        found = row(answer.result)
        measures = {
            "points": float(choice.solver.points),
            "expected": choice.expected[self.quantity],
            "change": answer.change[self.quantity],
            "error": error_of(self.scene, self.quantity, found, truth),
            "promised_seconds": choice.seconds,
            "truth_points": float(points),
        }
        return Outcome((replace(found, measures={**found.measures, **measures}),))

    def fits(self, outcome: Outcome) -> bool:
        """One row."""
        return len(outcome.rows) == 1


def promises() -> list[Promise]:
    """Every quantity of every scene within every error wanted."""
    return [
        Promise(scene, quantity, wanted)
        for scene in scenes()
        for quantity in _quantities(scene)
        for wanted in WANTED
    ]


def rows(tasks: Sequence[Promise], outcomes: Mapping[Task, Outcome]) -> list[dict]:
    """Each promise and what became of it."""
    return [_entry(task, outcomes[task].rows[0]) for task in tasks]


def kept(rows: Sequence[Mapping]) -> list[dict]:
    """By quantity and wanted error: how many answers kept it, were confirmed, and were confirmed and right."""
    found = []
    for quantity in dict.fromkeys(each["quantity"] for each in rows):
        for wanted in WANTED:
            asked = [each for each in rows if (each["quantity"], each["wanted"]) == (quantity, wanted)]
            given = [each for each in asked if not each["reason"]]
            right = [each for each in given if each["error"] <= wanted]
            sure = [each for each in given if each["change"] <= wanted]
            found.append(
                {
                    "quantity": quantity,
                    "wanted": wanted,
                    "asked": len(asked),
                    "promised": len(given),
                    "kept": len(right),
                    "confirmed": len(sure),
                    "confirmed_and_kept": len([each for each in sure if each["error"] <= wanted]),
                    "worst_error": max((each["error"] for each in given), default=np.nan),
                    "median_points": float(np.median([each["points"] for each in given])) if given else np.nan,
                }
            )
    return found


def scenes() -> Iterator[Scene]:
    """Other shapes, solids, spectra, speeds and seeds than those of the ladder; drawn once, from one seed."""
    draw = np.random.default_rng(20141)
    shapes = Sphere(radius=1.0), Cone(angle=0.1), PowerLaw(coefficient=1.0, exponent=3.0)
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
    """At which the memory of the solid is a thousandth to a hundred times a length [m]."""
    _, compliances, times = solid.retardation()
    memory = float(compliances @ times**2 / (compliances @ times))
    return float(10 ** draw.uniform(-3, 2)) * length / memory


def _quantities(scene):
    if isinstance(scene.indenter, Plane):
        return ("friction",)
    return "friction", "depth" if scene.motion.depth is None else "load"


def _entry(task, answer: Row):
    names = ("points", "expected", "error", "change", "promised_seconds", "truth_points", "friction_disagreement")
    return {
        "shape": type(task.scene.indenter).__name__,
        "solid": next(name for name, solid in SOLIDS.items() if solid == task.scene.elastomer),
        "body": "smooth" if task.scene.roughness is None else "rough",
        "band": band(task.scene),
        "quantity": task.quantity,
        "wanted": task.wanted,
        **{name: answer.measures.get(name, np.nan) for name in names},
        "mu": answer.friction_coefficient,
        "seconds": answer.seconds,
        "reason": answer.reason or "",
    }
