"""Has the accuracy moved? Quantities that say how far one model is from another, beside what they were.

The baseline is a file of stored values. It says what is, and nothing is tuned to it: one that moves beyond its
tolerance is an error found, or an improvement to be reviewed and stored.
"""

import json
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import inf
from pathlib import Path

from pydantic.dataclasses import dataclass as validated

from scene import markup
from scene.quantities import CLOSED, Finite
from scene.reading import InvalidInput, read

from .accuracy import shipped
from .outcome import Outcome
from .quantity import Quantity, Unmeasured
from .store import Store, Task, write
from .sweep import Progress, SweepResult, sweep

SHIPPED = Path(__file__).with_name("baseline.toml")
# Of a stored value: no tolerance is less than what they leave.
DIGITS = 10
HEADING = "# Written by compare.regression, see docs/regression.md: quantities as they were found.\n"


@dataclass(frozen=True)
class Change:
    """One quantity today and as it was stored.

    quantity : None where the collection has it no longer
    stored : None where the baseline has it not
    value : None where there is none today, which `failure` then explains
    """

    name: str
    quantity: Quantity | None
    stored: float | None
    value: float | None = None
    failure: str | None = None

    @property
    def moved(self) -> float:
        """Relative to the stored value; infinite where that is zero, and the value is not, or one is missing."""
        if self.value == self.stored:
            return 0.0
        return inf if self.value is None or not self.stored else (self.value - self.stored) / abs(self.stored)

    @property
    def of_tolerance(self) -> float:
        """How far it has moved, in tolerances."""
        return abs(self.moved) / self.quantity.tolerance

    @property
    def verdict(self) -> str:
        """unchanged, moved, failed, new or gone: all but the first ask for somebody's attention."""
        if self.quantity is None:
            return "gone"
        if self.failure is not None:
            return "failed"
        if self.stored is None:
            return "new"
        return "moved" if self.of_tolerance > 1 else "unchanged"


class Changes(list[Change]):
    """Every quantity of the collection or of the baseline, by name. Printed, it says what has moved."""

    @property
    def wrong(self) -> list[Change]:
        """What asks for somebody's attention."""
        return wrong(self)

    def __str__(self) -> str:
        return said(self)

    def _repr_html_(self) -> str:
        rows = [
            (each.name, each.verdict, *map(_shown, (each.stored, each.value)), _why(each)) for each in self.wrong
        ]
        count = f"{len(self) - len(rows)} of {len(self)} quantities within their tolerances."
        told = markup.table(rows, ("quantity", "verdict", "stored", "today", "why")) if rows else ""
        return told + markup.paragraph(count)


def read_baseline(path: Path, quantities: Iterable[Quantity]) -> dict[str, float]:
    """Stored values by name. Raises InvalidInput if the file is none, or belongs to none of the quantities."""
    values = read(path, _Baseline).values
    if values and not values.keys() & {quantity.name for quantity in quantities}:
        raise InvalidInput(f"{path}: belongs to another collection: {min(values)!r} is no quantity of this one")
    return values


def read_or_begin(path: Path, quantities: Iterable[Quantity]) -> dict[str, float]:
    """The same, and nothing stored where there is no file yet."""
    return read_baseline(path, quantities) if path.exists() else {}


@validated(frozen=True, config=CLOSED)
class _Baseline:
    values: dict[str, Finite]


def write_baseline(path: Path, values: Mapping[str, float]) -> None:
    """One line a quantity, in the order of their names."""
    # Printable JSON strings are TOML strings.
    lines = [
        f"{json.dumps(name, ensure_ascii=False)} = {float(f'{value:.{DIGITS}g}')!r}\n"
        for name, value in sorted(values.items())
    ]
    text = HEADING + "\n[values]\n" + "".join(lines)
    write(path, lambda file: file.write(text.encode()))


def changes(
    quantities: Sequence[Quantity], stored: Mapping[str, float], outcomes: Mapping[Task, Outcome]
) -> Changes:
    """Every quantity of the collection or of the baseline, by name. Raises ValueError if two share a name."""
    named = {quantity.name: quantity for quantity in quantities}
    if len(named) < len(quantities):
        names = [quantity.name for quantity in quantities]
        raise ValueError(f"two quantities are called {next(n for n in names if names.count(n) > 1)!r}")
    found = Changes()
    for name in sorted(named.keys() | stored.keys()):
        quantity, before = named.get(name), stored.get(name)
        try:
            value, failure = (quantity.value(outcomes) if quantity else None), None
        except Unmeasured as reason:
            value, failure = None, str(reason)
        found.append(Change(name, quantity, before, value, failure))
    return found


def wrong(found: Iterable[Change]) -> list[Change]:
    """What asks for somebody's attention."""
    return [change for change in found if change.verdict != "unchanged"]


def rewrite(path: Path, found: Iterable[Change]) -> list[Change]:
    """Store what has moved, is new or is gone, and nothing else. Returns what cannot be stored: what has failed.

    What moved within its tolerance stays as it is stored: many small steps do not pass unseen.
    """
    found = list(found)
    values = {change.name: change.stored for change in found if change.stored is not None}
    for change in found:
        if change.value is not None and change.verdict in ("moved", "new"):
            values[change.name] = change.value
        elif change.verdict == "gone":
            del values[change.name]
    failed = [change for change in found if change.verdict == "failed"]
    if len(wrong(found)) > len(failed):
        write_baseline(path, values)
    return failed


def said(found: Sequence[Change]) -> str:
    """A table of what has moved, what is wrong otherwise, and how many have not."""
    by: dict[str, list[Change]] = {verdict: [] for verdict in ("moved", "failed", "new", "gone", "unchanged")}
    for change in found:
        by[change.verdict].append(change)
    lines = _table(sorted(by["moved"], key=lambda change: -change.of_tolerance))
    lines += [f"failed: {change.name}: {change.failure}" for change in by["failed"]]
    lines += [f"not in the baseline: {change.name} = {change.value:.{DIGITS}g}" for change in by["new"]]
    lines += [f"no longer measured: {c.name}, stored as {c.stored:.{DIGITS}g}" for c in by["gone"]]
    lines.append(f"{len(by['unchanged'])} of {len(found)} quantities within their tolerances")
    if by["unchanged"]:
        farthest = max(by["unchanged"], key=lambda change: change.of_tolerance)
        lines[-1] += f", at most {farthest.of_tolerance:.2g} of it ({farthest.name})"
    return "\n".join(lines)


def _table(moved):
    """Columns of equal width, what a row means below it; why the tolerances are what they are, once."""
    if not moved:
        return []
    width = max(len(change.name) for change in moved)
    lines = [f"{'moved':{width}}  {'stored':>13}  {'today':>13}  {'change':>9}  tolerances"]
    for change in moved:
        lines += [
            f"{change.name:{width}}  {change.stored:13.8g}  {change.value:13.8g}  {change.moved:+9.1e}  "
            f"{change.of_tolerance:10.3g}",
            f"  {change.quantity.meaning}",
        ]
    reasons = (f"tolerance {c.quantity.tolerance:g}: {c.quantity.reason}" for c in moved)
    return lines + list(dict.fromkeys(reasons))


def _shown(value):
    return "" if value is None else f"{value:.{DIGITS}g}"


def _why(change):
    if change.verdict == "moved":
        return f"{change.of_tolerance:.3g} tolerances; {change.quantity.meaning}"
    return change.failure or ""


def measure(
    quantities: Sequence[Quantity], folder: Path, workers: int | None = None, progress: Progress | None = None
) -> SweepResult:
    """Solve what the quantities need in worker processes, and keep it in a folder."""
    return sweep([task for quantity in quantities for task in quantity.tasks], Store(folder), workers, progress)


def check(
    baseline: str | Path = SHIPPED,
    quantities: Sequence[Quantity] | None = None,
    folder: Path | None = None,
    workers: int | None = None,
) -> None:
    """For use in a test: nothing has moved. Raises AssertionError that lists what has, InvalidInput.

    baseline, quantities : those of the package, unless others are given
    folder : of what has been solved; without it all is solved again, and nothing kept
    """
    found = _found(baseline, read_baseline, quantities, folder, workers)
    if wrong(found):
        raise AssertionError(f"accuracy has moved from {baseline}\n{said(found)}")


def update(
    baseline: str | Path,
    quantities: Sequence[Quantity] | None = None,
    folder: Path | None = None,
    workers: int | None = None,
) -> str:
    """Rewrite a baseline, or begin one; arguments as for check. Returns what was stored, in words."""
    found = _found(baseline, read_or_begin, quantities, folder, workers)
    rewrite(Path(baseline), found)
    return said(found)


def _found(baseline, reader, quantities, folder, workers):
    quantities = shipped() if quantities is None else quantities
    stored = reader(Path(baseline), quantities)
    with tempfile.TemporaryDirectory() as passing:
        swept = measure(quantities, folder or Path(passing), workers)
    return changes(quantities, stored, swept.outcomes)
