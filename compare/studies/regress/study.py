"""Has the accuracy moved? Ratios between models, held against their stored values.

The baseline is a file of stored values. It says what is, and nothing is tuned to it: one that moves beyond its
tolerance is an error found, or an improvement to be reviewed and stored.
"""

import json
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import isfinite, nan
from pathlib import Path
from typing import Any

import numpy as np
import xarray
from pandas import DataFrame
from pydantic.dataclasses import dataclass as validated

from scene.printable import brief, printable
from scene.quantities import CLOSED, Finite
from scene.reading import InvalidInput, read

from ...report.page import Block, Findings, Section, Table, Text
from ...solving.folders import hold, write
from ...solving.outcome import Outcome
from ...solving.runner import sweep
from ...solving.store import Store
from ...solving.task import Batch, Task
from ...solving.vocabulary import attributes
from ...statistics.finding import FAILS, HOLDS, UNDECIDED, Claim, Finding
from ..study import Judgement, Study
from .quantities import shipped
from .quantity import Quantity, Unmeasured

SHIPPED = Path(__file__).with_name("baseline.toml")
# Digits of a stored value: no tolerance is less than these leave.
DIGITS = 10
HEADING = "# Written by `crosscheck regress --update`, see docs/howto/regression.md: quantities as found.\n"
NEW, GONE = "not in the baseline", "no longer measured"
SIDES = "numerator", "denominator"


@dataclass(frozen=True)
class Regress(Study):
    """Quantities solved again and held against stored ones.

    quantities : that are measured
    path : file of the stored values; stored : the values by id
    update : whether what has moved is stored afterwards
    """

    quantities: tuple[Quantity, ...]
    path: Path
    stored: Mapping[str, float]
    update: bool = False

    command = "regress"
    title = "Has the accuracy moved?"
    about = "Ratios that say how far one answer is from another, held against their stored values."

    def __post_init__(self):
        ids = [quantity.id for quantity in self.quantities]
        if twice := next((id for id in ids if ids.count(id) > 1), None):
            raise ValueError(f"two quantities are called {twice!r}")

    @classmethod
    def of(
        cls,
        baseline: str | Path | None = None,
        quantities: Sequence[Quantity] | None = None,
        update: bool = False,
    ) -> "Regress":
        """Study of a baseline, that of the package if absent; one to be updated need not be there yet.

        Raises InvalidInput if the file is none, or belongs to none of the quantities.
        """
        if not isinstance(baseline, str | Path | None):
            raise InvalidInput(f"baseline = {brief(repr(baseline))}: the path of a file is needed")
        asked = shipped() if quantities is None else quantities
        if not (isinstance(asked, Sequence) and all(isinstance(each, Quantity) for each in asked)):
            raise InvalidInput(f"quantities = {brief(repr(asked))}: a list of Quantity is needed")
        asked = tuple(asked)
        path = SHIPPED if baseline is None else Path(baseline)
        stored = {} if update and not path.exists() else read_baseline(path, asked)
        return cls(asked, path, stored, update)

    @property
    def inputs(self) -> Mapping[str, Any]:
        return {"baseline": printable(self.path.name)}

    def batches(self) -> Sequence[Batch]:
        return (Batch([task for quantity in self.quantities for task in quantity.tasks]),)

    def answers(self, outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
        """Every quantity of the collection or of the baseline: its ratio, and the numbers that it is made of."""
        ids = sorted(self._named.keys() | self.stored.keys())
        found = [_measured(self._named.get(id), outcomes) for id in ids]
        measured = np.full(
            (len(ids), 2, max((len(side) for *sides, _, _ in found for side in sides), default=0)), nan
        )
        for place, (*sides, _, _) in zip(measured, found, strict=True):
            for line, numbers in zip(place, sides, strict=True):
                line[: len(numbers)] = numbers
        dataset = xarray.Dataset(
            {
                "measured": (("quantity", "side", "seed"), measured),
                "value": ("quantity", [value for *_, value, _ in found]),
                "stored": ("quantity", [self.stored.get(id, nan) for id in ids]),
                "reason": ("quantity", [reason for *_, reason in found]),
            },
            {"quantity": ids, "side": list(SIDES)},
        )
        for name in dataset.variables:
            dataset[name].attrs = attributes(str(name))
        return xarray.DataTree.from_dict({"/quantities": dataset})

    @property
    def _named(self):
        return {quantity.id: quantity for quantity in self.quantities}

    def measured(self, answers: xarray.DataTree) -> Sequence[Finding]:
        """Finding of each quantity."""
        named, dataset = self._named, answers["quantities"]
        columns = (dataset[name].values.tolist() for name in ("quantity", "value", "stored", "reason"))
        return [_finding(id, named.get(id), *row) for id, *row in zip(*columns, strict=True)]

    def failed(self, findings: Sequence[Finding]) -> bool:
        """Whether anything asks for somebody's attention; after an update, whether something is not stored."""
        wrong = [each for each in findings if each.stated != HOLDS]
        if self.update:
            wrong = [each for each in wrong if not isfinite(each.value) and each.reason != GONE]
        return bool(wrong)

    def store(self, findings: Sequence[Finding]) -> None:
        """Store what has moved, is new or is gone, and nothing else; what has failed keeps its value.

        What moved within its tolerance stays as it is stored: many small steps do not pass unseen.
        """
        values, wrong = dict(self.stored), [each for each in findings if each.stated != HOLDS]
        for each in wrong:
            id = each.claim.id.removeprefix("regress.")
            if each.reason == GONE:
                del values[id]
            elif isfinite(each.value):
                values[id] = each.value
        if any(isfinite(each.value) or each.reason == GONE for each in wrong):
            write_baseline(self.path, values)

    def judge(self, answers: xarray.DataTree) -> Judgement:
        """Quantities that ask for attention, then a table of all."""
        findings = self.measured(answers)
        wrong = [each for each in findings if each.stated != HOLDS]
        rows = [
            {
                "quantity": each.claim.sentence,
                "stored": each.claim.expected,
                "found": each.value,
                "tolerances moved": tolerances_moved(each),
                "verdict": each.stated,
            }
            for each in findings
        ]
        table = Table("quantities", DataFrame(rows), f"Every quantity, against {self.path.name}.")
        attention = (
            [Findings(wrong, "Quantities that moved, are new, are gone or have no value.")] if wrong else []
        )
        return Judgement(findings, self.answer(findings), [*attention, table], self.setting)

    @staticmethod
    def answer(findings: Sequence[Finding]) -> Sequence[str]:
        """Number of quantities within their tolerances, and a sentence for each that does not."""
        held = [each for each in findings if each.stated == HOLDS]
        told = f"{len(held)} of {len(findings)} quantities lie within their tolerances"
        if held:
            farthest = max(held, key=tolerances_moved)
            told += f", at most {tolerances_moved(farthest):.2g} of it ({farthest.claim.sentence})"
        moved = sorted((each for each in findings if each.stated == FAILS), key=tolerances_moved, reverse=True)
        others = (each for each in findings if each.stated == UNDECIDED)
        return [f"{told}."] + [f"{each.claim.sentence}: {each.reason}." for each in (*moved, *others)]

    @property
    def setting(self) -> Sequence[Block]:
        """Quantities in a sentence, and the reason for each tolerance, once."""
        reasons = dict.fromkeys(f"{each.tolerance:g}: {each.reason}." for each in self.quantities)
        return [Text(self.about), Section("Tolerances", [Text(reason) for reason in reasons])]


def tolerances_moved(found: Finding) -> float:
    """Distance of a quantity from what is stored, in tolerances."""
    claim = found.claim
    if found.value == claim.expected:
        return 0.0
    return abs(found.value - claim.expected) / claim.tolerance if claim.tolerance else np.inf


def read_baseline(path: Path, quantities: Iterable[Quantity]) -> dict[str, float]:
    """Stored values by id. Raises InvalidInput if the file is none, or belongs to none of the quantities."""
    values = read(path, _Baseline).values
    if values and not values.keys() & {quantity.id for quantity in quantities}:
        raise InvalidInput(
            f"{path}: belongs to another collection: {brief(repr(min(values)))} is no quantity of this one"
        )
    return values


@validated(frozen=True, config=CLOSED)
class _Baseline:
    values: dict[str, Finite]


def write_baseline(path: Path, values: Mapping[str, float]) -> None:
    """Write one line a quantity, in the order of their ids."""
    # Printable JSON strings are TOML strings.
    lines = [
        f"{json.dumps(id, ensure_ascii=False)} = {float(f'{value:.{DIGITS}g}')!r}\n"
        for id, value in sorted(values.items())
    ]
    text = HEADING + "\n[values]\n" + "".join(lines)
    write(path, lambda file: file.write(text.encode()))


def check(
    baseline: str | Path = SHIPPED,
    quantities: Sequence[Quantity] | None = None,
    folder: str | Path | None = None,
    workers: int | None = None,
) -> None:
    """Assert in a test that nothing has moved. Raises AssertionError that lists what has, InvalidInput.

    baseline, quantities : those of the package, unless others are given
    folder : of what has been solved; without it all is solved again, and nothing kept
    """
    study = Regress.of(baseline, quantities)
    found = _solved(study, folder, workers)
    if study.failed(found):
        raise AssertionError("\n".join([f"accuracy has moved from {baseline}", *study.answer(found)]))


def update(
    baseline: str | Path,
    quantities: Sequence[Quantity] | None = None,
    folder: str | Path | None = None,
    workers: int | None = None,
) -> str:
    """Rewrite a baseline, or begin one; arguments as for check. Returns what was stored, in words."""
    study = Regress.of(baseline, quantities, update=True)
    found = _solved(study, folder, workers)
    study.store(found)
    return "\n".join(study.answer(found))


def _solved(study, folder, workers):
    (batch,) = study.batches()
    with tempfile.TemporaryDirectory() as passing, hold([place := Path(folder or passing)], str):
        outcomes = sweep(batch.tasks, Store(place), workers).outcomes
    return study.measured(study.answers(outcomes))


def _measured(quantity, outcomes):
    """Numbers of both sides, their ratio, and why there is none; without a quantity it is gone."""
    sides: tuple = ([], [])
    if quantity is None:
        return *sides, nan, GONE
    try:
        sides = quantity.measured(outcomes)
        return *sides, quantity.value(outcomes), ""
    except Unmeasured as reason:
        return *sides, nan, str(reason)


def _finding(id, quantity, value, stored, reason):
    """One quantity today, by its id; without a quantity it is gone."""
    sentence, meaning, tolerance = id, "", nan
    if quantity is not None:
        sentence, tolerance = quantity.sentence, quantity.tolerance * abs(stored)
        meaning = f"{quantity.meaning}. Tolerance {quantity.tolerance:g}: {quantity.reason}"
    found = Finding(Claim(f"regress.{id}", sentence, stored, tolerance, meaning), value, reason=reason)
    if reason:
        return replace(found, stated=UNDECIDED)
    if not isfinite(stored):
        return replace(found, stated=UNDECIDED, reason=f"{NEW}: {value:.{DIGITS}g}")
    if (moved := tolerances_moved(found)) <= 1:
        return replace(found, stated=HOLDS)
    told = f"moved by {moved:.3g} tolerances, from {stored:.{DIGITS}g} to {value:.{DIGITS}g}"
    return replace(found, stated=FAILS, reason=told)
