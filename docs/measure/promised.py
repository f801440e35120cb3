"""Whether settings found by `bem3d.for_accuracy` keep what was wanted, on random scenes."""

import warnings
from dataclasses import dataclass, replace
from math import isfinite, nan

from friction_errors import Judged, reference
from random_contacts import drawn
from tables import task

from bem3d import Unconfirmed, for_accuracy
from scene import SolveError
from scene.scales import elastic_contact

WANTED = (0.1, 0.03, 0.01, 0.003)
FIRST = 7000  # seed
COUNTS = {"smooth": 400, "rough": 100}
NUMBERS = {"friction": "friction_coefficient", "depth": "depth", "load": "normal_force"}
KNOWN = 0.2  # of a wanted error: what the truth is known to where a promise is checked


@dataclass(frozen=True)
class Promised:
    """A solver that finds its settings for a wanted error; its measure `shown` is the error of three grids."""

    quantity: str
    wanted: float
    name = "BEM"
    packages = ("scene", "bem3d", __name__)
    work = 1e8

    def solve(self, scene):
        """Answer with the settings found."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", Unconfirmed)
            try:
                choice = for_accuracy(scene, **{self.quantity: self.wanted})
            except ValueError as reason:
                raise SolveError(str(reason)) from reason
        error = choice.error[self.quantity]
        return replace(choice.result, measures={"shown": error if isfinite(error) else nan})


def asked():
    """Every quantity of every scene within every error wanted, with what the promise is checked against."""
    for kind, count in COUNTS.items():
        for seed in range(FIRST, FIRST + count):
            scene = drawn(kind, seed)
            for quantity in ("friction", "depth" if scene.motion.depth is None else "load"):
                for wanted in WANTED:
                    yield Judged(kind, task(Promised(quantity, wanted), scene), reference(scene))


def rows(every, outcomes):
    """Each promise with its error as it was shown, and as it is, NaN where the truth is not known well enough."""
    for each in every:
        (scene,), promised = each.task.scenes, each.task.solver
        answer, *_, finest = (outcomes[task].rows[0] for task in each.tasks)
        unit = elastic_contact(scene).depth if promised.quantity == "depth" else None
        error, unsure = each.error(outcomes, NUMBERS[promised.quantity], unit)
        checked = unsure <= KNOWN * promised.wanted and (
            2 * answer.settings.get("points", nan) <= finest.settings.get("points", 0)
        )
        row = {"quantity": promised.quantity, "wanted": promised.wanted}
        yield row | {"shown": answer.measures.get("shown", nan), "error": error if checked else nan}


def kept(made):
    """Counts of promises by quantity and wanted error."""
    sure, wanted = made["shown"] <= made["wanted"], ["quantity", "wanted"]
    counts = {"asked": 1, "confirmed": sure, "checked": sure & made["error"].notna()}
    counts["broken"] = sure & (made["error"] > made["wanted"])
    return made[wanted].assign(**counts).groupby(wanted, sort=False, as_index=False).sum()
