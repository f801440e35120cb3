"""Rates at which the judge's intervals hold the truth and its verdicts are right: tables of results/rates.md.

Friction is drawn with an answer that is known. It takes minutes on one core; every draw follows from SEED.
"""

from dataclasses import dataclass
from math import sqrt
from pathlib import Path

import numpy as np
from tables import table, write

from compare.statistics import eq23
from compare.statistics.collapse import Collapse, collapse
from compare.statistics.eq23 import TOLERANCE
from compare.statistics.frictioncurves import SimulatedCurves
from compare.statistics.intervals import student
from compare.statistics.jackknife import mean_ratio
from mdr1d.equations import interpolation

PAGE = Path(__file__).parents[1] / "results" / "rates.md"
SEED = 2014
# As in the studies [m/s], [N].
SPEED_RANGE, LOAD_RANGE = (7.5e-3, 2.0), (0.2, 20.0)
SPEEDS, LOADS = np.geomspace(*SPEED_RANGE, 8), np.geomspace(*LOAD_RANGE, 8)
# Power of p(v) for a sphere on a Kelvin solid; xi of the studies' rough sphere at the middle speed and load.
POWER, MIDDLE = -1.5, 0.11
ALONG = np.log(SPEEDS) - np.log(SPEEDS).mean()
ACROSS = np.log(LOADS) - np.log(LOADS).mean()
# In units of the range, what friction of one surface is off by at all points at once: everywhere alike, and more
# and more with speed, with load and with both.
FIELDS = np.array(
    [np.outer(u, w) for u in (np.ones(8), ALONG / ALONG[-1]) for w in (np.ones(8), ACROSS / ACROSS[-1])]
)
FIELDS /= np.sqrt(np.square(FIELDS).sum(axis=0).mean())
# Relative: of a surface, and of a point by itself.
SCATTER, OWN = 0.05, 0.005
DRAWN, SAMPLED = 20_000, (3, 5, 8, 10, 15, 20, 50)
REPEATS, SURFACES = 200, 10


def drawn(rng: np.random.Generator, exact: np.ndarray) -> SimulatedCurves:
    """Friction whose mean over all surfaces is exp(exact) (speeds, loads); relative scatter is lognormal."""
    shared = SCATTER * np.tensordot(FIELDS, rng.normal(size=(len(FIELDS), SURFACES)), axes=(0, 0))
    own = OWN * rng.normal(size=shared.shape)
    variance = SCATTER**2 * np.square(FIELDS).sum(axis=0) + OWN**2
    load = np.broadcast_to(LOADS[:, None], shared.shape)
    return SimulatedCurves(SPEEDS, load, np.exp(exact[..., None] + shared + own - variance[..., None] / 2) * load)


def knee(x: np.ndarray) -> np.ndarray:
    """ln of Eq. 19 for a sphere, over ln F shifted as at the middle speed."""
    return np.log(interpolation(MIDDLE * np.exp(-x * 2 / 3)))


def friction(law=knee, vertical: float = 0.0, shape: float = 0.0) -> np.ndarray:
    """ln mu (speeds, loads) shifted by POWER of the speed, raised by another, bent by shape times ln v."""
    bent = np.outer(ALONG, ACROSS**2 - np.mean(ACROSS**2))
    return law(ACROSS + POWER * ALONG[:, None]) + vertical * ALONG[:, None] + shape * bent


def generator(*cell: float) -> np.random.Generator:
    """Random numbers of one cell of a table."""
    return np.random.default_rng([SEED, *(round(1000 * number) for number in cell)])


# Means of skewed draws.


def mean_of_draws(normal: bool, variation: float, count: int) -> tuple[int, int, np.ndarray]:
    """Counts of intervals of a mean, ours and Student's, that hold it, and ratios of their widths."""
    draws, width = generator(3, normal, variation, count).normal(size=(DRAWN, count)), sqrt(np.log1p(variation**2))
    found = mean_ratio(1 + variation * draws if normal else np.exp(width * draws - width**2 / 2))
    (low, high), half = found.interval(), found.error * student(0.95, found.dof)
    held = (low <= 1) & (high >= 1), np.abs(found.value - 1) <= half
    return *(int(each.sum()) for each in held), (high - low) / (2 * half)


# Verdicts of the whole judge.

CLAIMS = ("one curve", "no vertical shift", "shifts as predicted", "power of v")


def line(x: np.ndarray) -> np.ndarray:
    return -2 / 3 * x


LAWS = {
    "right": {},
    "v^0.1": {"vertical": 0.1},
    "v^0.2": {"vertical": 0.2},
    "v^0.33": {"vertical": 0.33},
    "bent": {"shape": 0.008},
    "bent more": {"shape": 0.035},
    "straight": {"law": line},
}
# What is drawn, and the power of p(v) in the theory that is asked about.
ROWS = {
    "right": ("right", POWER),
    "theory says −1.575": ("right", -1.575),
    "theory says −1.65": ("right", -1.65),
    "theory says −1.8": ("right", -1.8),
    "friction times v^0.1": ("v^0.1", POWER),
    "friction times v^0.2": ("v^0.2", POWER),
    "friction times v^0.33": ("v^0.33", POWER),
    "shape changes with v, a little": ("bent", POWER),
    "shape changes with v": ("bent more", POWER),
    "straight lines": ("straight", POWER),
}


def asked(found: Collapse, theory: float) -> dict[str, tuple[float, str]]:
    """Number and verdict by claim, as the studies ask for them."""
    findings = eq23.findings(found, None, "1D", theory * np.log(SPEEDS), theory)
    named = {each.claim.id: each for each in findings}
    claims = (eq23.COLLAPSE, eq23.VERTICAL, eq23.PREDICTED, eq23.EXPONENT)
    found = {name: (named[of.id].value, named[of.id].verdict) for name, of in zip(CLAIMS, claims, strict=True)}
    if (shifted := named.get(eq23.NOT_SHIFTED.id)) is not None:
        found[CLAIMS[1]] = found[CLAIMS[1]][0], shifted.verdict
    return found


def repeated(law: str) -> list[Collapse]:
    """The judge's fits of a law drawn again and again."""
    rng, exact = generator(3, list(LAWS).index(law), SURFACES, SCATTER), friction(**LAWS[law])
    return [collapse(drawn(rng, exact)) for _ in range(REPEATS)]


@dataclass(frozen=True)
class Said:
    """Of one claim in many repeats: the number without scatter, and how often it was kept, open or rejected."""

    truth: float
    theory: float | None
    counts: tuple[int, ...]

    @property
    def within(self) -> bool:
        """Whether the claim is true."""
        if self.theory is None:
            return self.truth <= TOLERANCE
        return abs(self.truth - self.theory) <= TOLERANCE * abs(self.theory)

    @property
    def wrong(self) -> int:
        """Verdicts against the truth."""
        return self.counts[2] if self.within else self.counts[0]

    def __str__(self):
        number = f"{100 * self.truth:.1f} %" if self.theory is None else f"{self.truth:.2f}".replace("-", "−")
        return f"{number}: " + " / ".join(f"{100 * count / sum(self.counts):g}" for count in self.counts)


def verdicts() -> dict[str, dict[str, Said]]:
    """By row and claim."""
    exact = {law: friction(**numbers) for law, numbers in LAWS.items()}
    fits = {law: repeated(law) for law in LAWS}
    load = np.broadcast_to(LOADS, (len(SPEEDS), len(LOADS)))
    said = {}
    for row, (law, theory) in ROWS.items():
        found = [asked(each, theory) for each in fits[law]]
        truth = asked(collapse(SimulatedCurves(SPEEDS, load, np.exp(exact[law]) * load)), theory)
        said[row] = {}
        for claim in CLAIMS:
            kinds = [each[claim][1] for each in found]
            counts = tuple(kinds.count(kind) for kind in ("holds", "undecided", "fails"))
            said[row][claim] = Said(truth[claim][0], theory if claim == "power of v" else None, counts)
    return said


# The page.


def means() -> str:
    """Share of the samples whose intervals hold the mean, by the distribution and the number of draws."""
    lines, wider, most = [], ["normal, wider by"], ["normal, at most by"]
    for kind, variation in (("normal", 0.5), ("lognormal", 0.2), ("lognormal", 0.5), ("lognormal", 1.0)):
        cells = []
        for count in SAMPLED:
            held, of_student, factor = mean_of_draws(kind == "normal", variation, count)
            cells.append(f"{100 * held / DRAWN:.1f} ({100 * of_student / DRAWN:.1f})")
            if kind == "normal":
                wider.append(f"{factor.mean():.2f}")
                most.append(f"{np.quantile(factor, 0.95):.2f}")
        lines.append((f"{kind}, scatter {100 * variation:g} %", *cells))
    return table("draws|" + "|".join(f"n = {count}" for count in SAMPLED), [*lines, wider, most])


def judged() -> str:
    """What the judge says of each law, and of how many it is wrong at most."""
    said = verdicts()
    lines = ((row, *map(str, claims.values())) for row, claims in said.items())
    wrong, row, claim = max(
        (each.wrong, row, claim) for row, claims in said.items() for claim, each in claims.items()
    )
    told = f'{wrong} of {REPEATS} at most in a cell, most often of "{claim}" where the law is "{row}"'
    return table("law|" + "|".join(CLAIMS), lines) + f"\n\nVerdicts against the truth: {told}."


if __name__ == "__main__":
    write(PAGE, {"means": means, "verdicts": judged})
