"""Accuracy of one dimension on a scene of one's own, in a test: what the fixture `mdr_accuracy` does."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import ceil, isfinite, nan
from os import PathLike
from pathlib import Path
from typing import Any, Self

import xarray

from scene.reading import InvalidInput

from ...library.case import Case
from ...library.lookup import SceneLike, case_of
from ...models.table import ModelLike, Models, listed
from ...solving import words
from ...solving.curve import COARSE, FINE, Curve, of_model, on_two_levels, refuse
from ...solving.outcome import Outcome
from ...solving.store import Store
from ...solving.task import Task
from ...statistics.finding import HOLDS, UNDECIDED, Claim, Finding
from ...statistics.jackknife import DrawSet, mean, measured
from ..study import Judgement, Study
from . import stored

SCENE = "scene"
# Means that are compared: above, and below if it is a ratio.
MEANS = {"friction": ("friction_force", "normal_force"), "depth": ("depth_reached",), "force": ("normal_force",)}


@dataclass(frozen=True)
class Accuracy(Study):
    """Friction, and depth or force, of a scene by one model over those by another.

    case, models : the scene with the settings of both solvers, and who answers it
    within : how far from 1 each ratio may be, by the name of the quantity
    surfaces, profiles : of a rough scene; those of the case if absent
    """

    case: Case
    models: Models
    within: Mapping[str, float]
    surfaces: int | None = None
    profiles: int | None = None

    command, title = "accuracy", "Accuracy of a scene"

    @classmethod
    def of(
        cls,
        scene: SceneLike,
        within: Mapping[str, float],
        models: Sequence[ModelLike] | None = None,
        reference: str | None = None,
        **draws: int | None,
    ) -> Self:
        """Study of a scene; of all of its quantities where none is named. Raises InvalidInput, Refused."""
        case = case_of(scene)
        case.refuse()
        compared = Models.of(listed(models or case.models), reference, {"mdr": case.mdr, "bem": case.bem})
        has = [*(["friction"] if case.slides else []), "depth" if case.motion.load is not None else "force"]
        if unknown := sorted(within.keys() - set(has)):
            raise InvalidInput(
                f"{unknown[0]} = {within[unknown[0]]!r}: the scene has {' and '.join(has)} to compare"
            )
        return cls(case, compared, within or dict.fromkeys(has, nan), **draws)

    def grids(self) -> Mapping[str, Curve]:
        """The contact of the scene, on two grids of every model."""
        plan, motion = self.case.plan(), self.case.motion
        counts = self.profiles or plan.profiles, self.surfaces or plan.surfaces
        grid = Curve(
            scene=self.case.scene,
            speeds=(getattr(motion, "speed", 0.0),),
            values=(motion.greatest,),
            levels=on_two_levels(*(each.solver for each in self.models)),
            draws={each.name: each.count(*counts) for each in self.models},
        )
        refuse([grid])
        return {SCENE: grid}

    def claims(self) -> Iterator[Claim]:
        """Each ratio is 1 within what is allowed."""
        for model in self.models.judged:
            beside = self.models.beside(model.name)
            for name, allowed in self.within.items():
                id = name if len(self.models.judged) == 1 else f"{name}.{model.name}"
                yield Claim(
                    id, f"{name} {beside}", 1.0, allowed, dimension=beside, measure=self._ratio(name, model.name)
                )

    def _ratio(self, name, model):
        def measure(sample):
            above, below = (mean(sample[each], *MEANS[name]) for each in (model, self.models.reference))
            return float((above / below).squeeze())

        return measure

    def judge(self, answers: xarray.DataTree) -> Judgement:
        """A finding a ratio, with what would decide it."""
        own = {each: of_model(answers[SCENE].to_dataset(), each) for each in self.models.labels}
        fine, coarse = (
            DrawSet({name: each.sel(level=level if level in each.level else FINE) for name, each in own.items()})
            for level in (FINE, COARSE)
        )
        return Judgement([decided_by(measured(claim, fine, coarse)) for claim in self.claims()])


def decided_by(found: Finding) -> Finding:
    """A finding with what would decide it in words, where it is undecided."""
    if found.verdict != UNDECIDED or found.undecidable:
        return found
    half, grid = (found.scatter[1] - found.scatter[0]) / 2, found.grid
    room = abs(abs(found.value - found.claim.expected) - found.claim.tolerance) - grid
    if room <= 0 or not found.draws:
        return replace(found, remedy="its grid leaves too much open: a finer one would have to decide it")
    return replace(
        found, remedy=f"some {ceil(found.draws * (half / room) ** 2)} surfaces of each model would decide it"
    )


def findings(study: Accuracy, folder: Path) -> list[Finding]:
    """Findings of a study that is solved in this process; what the folder has is not solved again."""
    store = Store(folder)
    (batch,) = study.batches()
    outcomes: dict[Task, Outcome] = dict(store.stored(batch.tasks))
    with store.writing():
        for task in batch.tasks:
            if task not in outcomes:
                outcomes[task] = task.solve()
                store.put(task, outcomes[task])
    return list(study.judge(study.answers(outcomes)).findings)


@dataclass(frozen=True)
class MDRAccuracy:
    """The fixture `mdr_accuracy`.

    folder : of what is solved; file : of stored numbers; beside : folder in which scenes are looked for first
    rewrite : whether numbers that moved are stored
    """

    folder: Path
    file: Path
    beside: Path
    rewrite: bool = False

    def check(
        self,
        scene: SceneLike,
        models: Sequence[ModelLike] | None = None,
        reference: str | None = None,
        surfaces: int | None = None,
        profiles: int | None = None,
        **within: float,
    ) -> None:
        """Fail unless each ratio of 1D over 3D is 1 within what is allowed, with its whole interval of 95 %.

        scene : file beside the test, name of a ready scene, or an object
        within : friction=0.05, and depth=0.02 under a load or force=0.02 at a depth
        models, reference : names or objects, "mdr" and "bem" if absent, and the one that others are held against
        surfaces, profiles : drawn of a rough scene; those of the scene's file, or 3 and 50, if absent

        An undecided ratio fails as undecided. Raises InvalidInput, Refused of what cannot be compared.
        """
        if not within:
            raise InvalidInput("check: say how far from 1 a ratio may be, as friction=0.05")
        draws = {"surfaces": surfaces, "profiles": profiles}
        study = Accuracy.of(self._located(scene), within, models, reference, **draws)
        self._fail(scene, [each for each in findings(study, self.folder) if each.verdict != HOLDS])

    def regression(
        self,
        scene: SceneLike,
        tolerance: float = 1e-3,
        models: Sequence[ModelLike] | None = None,
        reference: str | None = None,
        surfaces: int | None = None,
        profiles: int | None = None,
    ) -> None:
        """Fail if a ratio moved by more than a tolerance, relative, from the file that stands beside the test.

        The first run writes the file and fails. With --mdr-regen numbers that moved are stored, and it fails.
        The arguments are those of `check`.
        """
        draws = {"surfaces": surfaces, "profiles": profiles}
        study = Accuracy.of(self._located(scene), {}, models, reference, **draws)
        values = stored.read_values(self.file) if self.file.exists() else {}
        names = {f"{named(scene)}.{each.claim.id}": each for each in findings(study, self.folder)}
        moved = {
            id: each
            for id, found in names.items()
            if (each := stored.held(found, values.get(id, nan), tolerance)).stated != HOLDS
        }
        new = {id: each.value for id, each in moved.items() if isfinite(each.value)}
        if new and (self.rewrite or not values.keys() & names.keys()):
            self.file.parent.mkdir(parents=True, exist_ok=True)
            stored.write_values(self.file, values | new, "Written by pytest --mdr-regen: numbers as found.")
            raise AssertionError(f"{self.file} is written: look at it, keep it, and run the test again")
        self._fail(scene, list(moved.values()), f"; --mdr-regen stores them in {self.file}")

    def _located(self, scene):
        path = self.beside / scene if isinstance(scene, str | PathLike) else None
        return scene if path is None or not path.is_file() else path

    def _fail(self, scene, wrong: Sequence[Finding], hint: str = "") -> None:
        lines = [
            f"{named(scene)}: {each.claim.sentence}: {each.verdict}, expected {words.tested(each.claim)}, "
            f"found {words.found(each)}{f'; {each.why}' if each.why else ''}"
            for each in wrong
        ]
        if lines:
            raise AssertionError("\n".join(lines) + hint)


def named(scene: Any) -> str:
    """Name of a scene, by which its numbers are stored."""
    return Path(scene).stem if isinstance(scene, str | PathLike) else getattr(scene, "title", "") or SCENE
