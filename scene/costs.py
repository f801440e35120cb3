"""Expected costs of a solve: those of a plain contact, times the factors of the parts of a scene."""

import csv
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from math import prod
from pathlib import Path

COSTS = "operator_applications", "seconds"
# Share of a solve to 1e-7 that each power of ten in the tolerance saves. Contacts at rest and sliding, smooth
# and rough, took 0.81 of the applications to 1e-5 and 0.57 to 1e-3, of the seconds 0.89 and 0.71: medians of 22.
DECADE, LEAST = {"operator_applications": 0.1, "seconds": 0.07}, 0.5


@dataclass(frozen=True)
class Expected:
    """A cost. value : None where it is not known; why : what it rests on, or why it is not known."""

    value: float | None
    why: str

    def times(self, factor: float, why: str) -> "Expected":
        """So many times as much; what is not known stays so."""
        return self if self.value is None else Expected(self.value * factor, f"{self.why}, times {why}")

    def __str__(self) -> str:
        return f"not known: {self.why}" if self.value is None else f"{two_digits(self.value)}, {self.why}"


def at_tolerance(counted: Mapping[str, float], decades: float) -> dict[str, float]:
    """Costs of a solve to a tolerance that is so many powers of ten wider than that they were counted at."""
    return {cost: value * max(1 - DECADE[cost] * decades, LEAST) for cost, value in counted.items()}


def two_digits(value: float) -> str:
    """Two digits of a number, written out up to a million."""
    return f"{float(f'{value:.2g}'):g}"


def not_known(why: str) -> dict[str, Expected]:
    """None of `COSTS` is."""
    return dict.fromkeys(COSTS, Expected(None, why))


def expected(
    plain: Callable[[], Mapping[str, float]], why: str, parts: Iterable[object], table: Path
) -> dict[str, Expected]:
    """Expected costs by the names of `COSTS`.

    plain : gives those of a contact without these parts, by `why`; asked only where all parts are known
    parts : of a scene, each of which multiplies them by its line of the table
    """
    names, known = [type(part).__name__ for part in parts], multiples(table)
    if unknown := [name for name in names if name not in known]:
        return not_known(f"what {' and '.join(unknown)} takes was not measured")
    if names:
        why += f", times what {' and '.join(names)} took of a sphere"
    counted = plain()
    return {cost: Expected(counted[cost] * prod(known[name][cost] for name in names), why) for cost in COSTS}


@cache
def multiples(table: Path) -> Mapping[str, Mapping[str, float]]:
    """Factors on each of `COSTS` by the name of a part's type, from a CSV of part and costs."""
    with table.open(encoding="utf-8", newline="") as file:
        return {row["part"]: {cost: float(row[cost]) for cost in COSTS} for row in csv.DictReader(file)}
