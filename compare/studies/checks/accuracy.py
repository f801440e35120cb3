"""Accuracy of 1D on a user's own scene in a test: the work of the fixture `mdr_accuracy`."""

from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from math import isfinite, nan
from os import PathLike
from pathlib import Path
from typing import Any, Self

import xarray

from scene.files.reading import InvalidInput

from ...library.lookup import SceneLike, case_of
from ...models.table import QUANTITIES
from ...solving import words
from ...solving.runner import sweep
from ...solving.store import Store
from ...statistics.finding import HOLDS, Claim, Finding
from ...statistics.multilevel import WORDS
from ..comparison.comparison import Comparison
from ..comparison.series import ratio_of
from ..comparison.sweep import CONTACTS, SweepSeries
from ..study import Judgement
from .stored import Stored, held, read_values

SCENE = "scene"


@dataclass(frozen=True)
class Accuracy(Comparison):
    """Friction, and depth or force, of a scene by one model over those by another.

    within : how far from 1 each ratio may be, by the name of the mean
    """

    command: str = "accuracy"  # type: ignore[misc]
    title: str = "Accuracy of a scene"
    within: Mapping[str, float] = field(default_factory=dict)

    @classmethod
    def of(
        cls,
        scene: SceneLike,
        within: Mapping[str, float],
        surfaces: int | None = None,
        profiles: int | None = None,
        **asked: Any,
    ) -> Self:
        """Study of a scene; of all of its quantities where none is named. Raises InvalidInput, Refused.

        asked : models and reference, see `MDRAccuracy.check`
        """
        case = case_of(scene)
        plan = case.plan()
        contact = SweepSeries.of(case, draws=surfaces or plan.surfaces, **asked)
        has = {WORDS[mean]: mean for _, mean, _ in contact.wanted}
        if unknown := sorted(within.keys() - has.keys()):
            raise InvalidInput(f"{unknown[0]}: the scene has {' and '.join(has)} to compare")
        wanted = {has[each]: within.get(each, nan) for each in within or has}
        return cls((replace(contact, profiles=profiles or plan.profiles),), within=wanted)

    def judge(self, answers: xarray.DataTree) -> Judgement:
        """A finding a ratio, with what would decide it."""
        found, (series,) = [], self.series
        known = series.answers(answers)
        for mean, allowed in self.within.items():
            judged = known.judged(CONTACTS, WORDS[mean])
            for model in judged:
                both, pair = (model.name, series.models.reference), series.models.pair_label(model.name)
                id = WORDS[mean] if len(judged) == 1 else f"{WORDS[mean]}.{model.name}"
                measure = ratio_of(mean, *both)
                claim = Claim(id, f"{WORDS[mean]} {pair}", 1.0, allowed, dimension=pair, measure=measure)
                for each in series.compared(known, claim, CONTACTS, both, {(0, 0): ""}):
                    finding = series.with_remedy(each)
                    found.append(
                        finding
                        if finding.remedy or finding.undecidable
                        else replace(finding, remedy="a finer grid would decide it")
                    )
        return Judgement(found)


@dataclass(frozen=True)
class OwnScene(Stored, Accuracy):
    """Ratios of a user's own scene, compared with the values in a file.

    name : of the scene, by which its numbers are stored; tolerance : relative, of each ratio
    """

    name: str = SCENE
    tolerance: float = 1e-3

    command: str = "regress"  # type: ignore[misc]
    title: str = "Has the accuracy of the scene moved?"

    @classmethod
    def stored(
        cls,
        scene: Any,
        baseline: str | Path | None,
        update: bool = False,
        tolerance: float = 1e-3,
        **asked: Any,
    ) -> Self:
        """Study of a scene and a file; one to be updated need not be there yet. Raises InvalidInput.

        asked : models, reference, surfaces and profiles, see `MDRAccuracy.check`
        """
        if baseline is None:
            raise InvalidInput("baseline = None: the numbers of a scene of your own need a file, name one")
        path = Path(baseline)
        return replace(
            cls.of(scene, {}, **asked),
            name=named(scene),
            tolerance=tolerance,
            path=path,
            values=read_values(path, begin=update),
            update=update,
        )

    def judge(self, answers: xarray.DataTree) -> Judgement:
        """A finding a ratio, held against its stored value."""
        found = []
        for each in super().judge(answers).findings:
            id = f"{self.name}.{each.claim.id}"
            one = replace(each, claim=replace(each.claim, id=f"regress.{id}"))
            found.append(held(one, self.values.get(id, nan), self.tolerance))
        return Judgement(found)


def findings(study: Accuracy, folder: Path) -> list[Finding]:
    """Findings of a study that is solved in this process; what the folder has is not solved again."""
    (batch,) = study.batches()
    with ThreadPoolExecutor(1) as here:
        swept = sweep(batch.tasks, Store(folder), executor=here)
    return list(study.judge(study.answers(swept.outcomes)).findings)


@dataclass(frozen=True)
class MDRAccuracy:
    """The fixture `mdr_accuracy`.

    folder : of solved contacts; file : of stored numbers; test_folder : where scene files are looked for first
    rewrite : whether numbers that moved are stored
    """

    folder: Path
    file: Path
    test_folder: Path
    rewrite: bool = False

    def check(self, scene: SceneLike, **asked: Any) -> None:
        """Fail unless each ratio of 1D over 3D is 1 within what is allowed, with its whole interval of 95 %.

        scene : file in the folder of the test, name of a ready scene, or an object
        friction, depth, force : how far from 1 the ratio may be, as friction=0.05; depth
            under a load, force at a depth
        models, reference : names or objects, "mdr" and "bem" if absent, and the one that others are held against
        surfaces, profiles : drawn of a rough scene; those of the scene's file, or 3 and 50, if absent

        An undecided ratio fails as undecided. Raises InvalidInput, Refused of what cannot be compared.
        """
        within = {name: asked.pop(name) for name in asked.keys() & QUANTITIES}
        if not within:
            raise InvalidInput("check: say how far from 1 a ratio may be, as friction=0.05")
        study = Accuracy.of(self._located(scene), within, **asked)
        self._fail(scene, findings(study, self.folder))

    def regression(self, scene: SceneLike, tolerance: float = 1e-3, **asked: Any) -> None:
        """Fail if a ratio moved by more than a relative tolerance from its value in the file next to the test.

        The first run writes the file and fails. With --mdr-regen numbers that moved are stored, and it fails.
        The other arguments are those of `check`.
        """
        study = OwnScene.stored(self._located(scene), self.file, True, tolerance, **asked)
        found = findings(study, self.folder)
        moved = any(each.verdict != HOLDS and isfinite(each.value) for each in found)
        if moved and (self.rewrite or not study.values):
            self.file.parent.mkdir(parents=True, exist_ok=True)
            study.store(found)
            raise AssertionError(f"{self.file} is written: look at it, keep it, and run the test again")
        self._fail(scene, found, f"; --mdr-regen stores them in {self.file}")

    def _located(self, scene):
        is_file = isinstance(scene, str | PathLike) and (self.test_folder / scene).is_file()
        return self.test_folder / scene if is_file else scene

    def _fail(self, scene, found: Sequence[Finding], hint: str = "") -> None:
        lines = [
            f"{named(scene)}: {each.claim.sentence}: {each.verdict}, expected {words.tested(each.claim)}, found "
            + "; ".join(filter(None, [words.found(each), each.why]))
            for each in found
            if each.verdict != HOLDS
        ]
        if lines:
            raise AssertionError("\n".join(lines) + hint)


def named(scene: Any) -> str:
    """Name of a scene, by which its numbers are stored."""
    return Path(scene).stem if isinstance(scene, str | PathLike) else getattr(scene, "title", "") or SCENE
