"""How often the judge's intervals hold the truth and its verdicts are right: tables of results/rates.md, and .csv.

Friction is drawn with an answer that is known. It takes minutes on one core; every draw follows from SEED.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import sqrt
from pathlib import Path

import numpy as np
from numpy.polynomial import Chebyshev
from tables import stored, table, write

from compare.statistics import eq23
from compare.statistics.collapse import Collapse, collapse
from compare.statistics.commoncurve import Fit, near
from compare.statistics.eq23 import TOLERANCE
from compare.statistics.frictioncurves import SimulatedCurves
from compare.statistics.intervals import student
from compare.statistics.jackknife import Group, mean_ratio, resample
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
COUNTS, FEW_AND_MANY, SIZES = (3, 5, 10, 20), (3, 10), (0.0, 0.02, 0.05, 0.10)
RATIO_SCATTER = 0.4  # of the forces whose ratio is taken
# Profiles in one dimension for each surface in three, as in the studies.
PROFILES = 6
# Degree of the common polynomial where it is not sought: what it mostly is at this scatter.
DEGREE = 8
DRAWN, SAMPLED = 20_000, (3, 5, 8, 10, 15, 20, 50)
CHEAP, REFITS, PIPELINE, SURFACES = 1000, 300, 200, 10


@dataclass(frozen=True)
class Rate:
    """How often something came out of so many repeats."""

    hits: int
    repeats: int

    def __str__(self):
        # With one more of either kind, so that the error is never nil.
        share = (self.hits + 1) / (self.repeats + 2)
        return f"{100 * self.hits / self.repeats:.1f} ± {100 * sqrt(share * (1 - share) / self.repeats):.1f}"


def drawn(rng: np.random.Generator, exact: np.ndarray, surfaces: int, scatter: float = SCATTER) -> SimulatedCurves:
    """Friction whose mean over all surfaces is exp(exact) (speeds, loads); relative scatter is lognormal."""
    shared = scatter * np.tensordot(FIELDS, rng.normal(size=(len(FIELDS), surfaces)), axes=(0, 0))
    own = OWN * rng.normal(size=shared.shape)
    variance = scatter**2 * np.square(FIELDS).sum(axis=0) + OWN**2
    load = np.broadcast_to(LOADS[:, None], shared.shape)
    return SimulatedCurves(SPEEDS, load, np.exp(exact[..., None] + shared + own - variance[..., None] / 2) * load)


def exactly(exact: np.ndarray) -> SimulatedCurves:
    """The same without scatter."""
    load = np.broadcast_to(LOADS, exact.shape)
    return SimulatedCurves(SPEEDS, load, np.exp(exact) * load)


def knee(x: np.ndarray) -> np.ndarray:
    """ln of Eq. 19 for a sphere, over ln F shifted as at the middle speed."""
    return np.log(interpolation(MIDDLE * np.exp(-x * 2 / 3)))


def friction(law: Callable = knee, power: float = POWER, vertical: float = 0.0, shape: float = 0.0) -> np.ndarray:
    """ln mu (speeds, loads) shifted by a power of the speed, raised by another, bent by shape times ln v."""
    bent = np.outer(ALONG, ACROSS**2 - np.mean(ACROSS**2))
    return law(ACROSS + power * ALONG[:, None]) + vertical * ALONG[:, None] + shape * bent


def generator(*cell: float) -> np.random.Generator:
    """Of one cell of a table."""
    return np.random.default_rng([SEED, *(round(1000 * number) for number in cell)])


def has(ends: tuple, truth: float) -> bool:
    return bool(ends[0] <= truth <= ends[1])


@dataclass(frozen=True)
class Pair:
    """Forces in 1D and in 3D, whose surfaces are independent."""

    one: SimulatedCurves
    three: SimulatedCurves

    @property
    def groups(self) -> list[Group]:
        return [*self.one.groups, *self.three.groups]

    def without(self, group: Group) -> "Pair":
        sides = self.one, self.three
        return Pair(*(side.without(group) if side.solver == group.solver else side for side in sides))


def rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.square(values))))


# Means of skewed draws.


def mean_of_draws(normal: bool, variation: float, count: int) -> tuple[int, int, np.ndarray]:
    """How often the interval of a mean and Student's hold it, and how much wider the former is."""
    draws, width = generator(3, normal, variation, count).normal(size=(DRAWN, count)), sqrt(np.log1p(variation**2))
    found = mean_ratio(1 + variation * draws if normal else np.exp(width * draws - width**2 / 2))
    (low, high), half = found.interval(), found.error * student(0.95, found.dof)
    held = (low <= 1) & (high >= 1), np.abs(found.value - 1) <= half
    return *(int(each.sum()) for each in held), (high - low) / (2 * half)


# Ratios of means.


def ratio(part: SimulatedCurves | Pair) -> dict:
    """Mean friction over mean load, or that in 1D over that in 3D."""
    above, below = (part.one, part.three.friction_force) if isinstance(part, Pair) else (part, part.load)
    return {"": above.friction_force.mean() / below.mean()}


def ratios(surfaces: int, pair: bool) -> Rate:
    """How often the interval of a ratio of means holds it; the true ratio is one."""
    rng, hits = generator(1, surfaces, RATIO_SCATTER, pair), 0

    def forces(count):
        logs = RATIO_SCATTER * (rng.normal(size=count) + rng.normal(size=(2, count))) / sqrt(2)
        return np.exp(logs - RATIO_SCATTER**2 / 2)

    for _ in range(CHEAP):
        three = forces(surfaces)
        one = forces(PROFILES * surfaces) if pair else three
        sides = [
            SimulatedCurves(np.ones(1), load[None, None], force[None, None], solver=solver)
            for solver, (load, force) in {"MDR": one, "BEM": three}.items()
        ]
        hits += has(resample(ratio, Pair(*sides) if pair else sides[0])[""].estimated.interval(), 1.0)
    return Rate(hits, CHEAP)


# Sizes of a misfit.


def smooth_knee() -> Chebyshev:
    """Eq. 19 as the common polynomial has it, so that no misfit is nil."""
    reach = ACROSS[-1] - POWER * ALONG[-1]
    x = np.linspace(-reach, reach, 400)
    return Chebyshev.fit(x, knee(x), DEGREE)


def sized(surfaces: int, size: float, fitted: bool) -> tuple[float, Rate]:
    """True misfit, and how often its interval holds it."""
    rng, law, still = generator(2, surfaces, size, fitted), smooth_knee(), POWER * np.diff(np.log(SPEEDS))

    def best(curves, guess):
        return near(Fit(curves, DEGREE), guess) if fitted else still

    def missed(curves, guess):
        return Fit(curves, DEGREE).residuals(best(curves, guess))

    unit = 0.01
    shape = unit * size / rms(missed(exactly(friction(law, shape=unit)).curves, still))
    exact = friction(law, shape=shape)
    truth = rms(missed(exactly(exact).curves, still))
    repeats, hits = REFITS if fitted else CHEAP, 0
    for _ in range(repeats):
        samples = drawn(rng, exact, surfaces)
        at = best(samples.curves, still)
        found = resample(lambda part, at=at: {"": missed(part.curves, at)}, samples)[""].rms
        # What rounding leaves of no misfit.
        hits += has(found.interval(), truth if size else 0.0)
    return truth, Rate(hits, repeats)


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


def answered(fits: list[Collapse], vertical: float) -> tuple[int, int]:
    """How often both shifts are the answer, and how often its intervals then hold both exponents."""
    both = [each.both for each in fits if eq23.raised(each)]
    held = [
        has(each.exponent.interval(), POWER) and has(each.vertical_exponent.interval(), vertical) for each in both
    ]
    return len(both), sum(held)


def shares(counted: tuple[int, ...]) -> str:
    return " / ".join(f"{100 * count / sum(counted):g}" for count in counted)


def repeated(law: str, surfaces: int = SURFACES, scatter: float = SCATTER) -> list[Collapse]:
    """The judge's fits of a law drawn again and again."""
    rng, exact = generator(3, list(LAWS).index(law), surfaces, scatter), friction(**LAWS[law])
    return [collapse(drawn(rng, exact, surfaces, scatter)) for _ in range(PIPELINE)]


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
        return f"{number}: {shares(self.counts)}"


def verdicts(fits: dict[str, list[Collapse]]) -> dict[str, dict[str, Said]]:
    """By row and claim."""
    exact = {law: collapse(exactly(friction(**LAWS[law]))) for law in LAWS}
    said = {}
    for row, (law, theory) in ROWS.items():
        found, truth = [asked(each, theory) for each in fits[law]], asked(exact[law], theory)
        said[row] = {}
        for claim in CLAIMS:
            kinds = [each[claim][1] for each in found]
            counts = tuple(kinds.count(kind) for kind in ("holds", "undecided", "fails"))
            said[row][claim] = Said(truth[claim][0], theory if claim == "power of v" else None, counts)
    return said


# Where the joint fit is weak.


def weak(found: list[Collapse]) -> dict[str, tuple[Rate, float, float]]:
    """By exponent: how often its interval, if there is one, holds the truth; medians of both."""
    alone = [each.horizontal for each in found if not each.horizontal.reason]
    both = [each.both for each in found if not each.both.reason]
    numbers = {
        "horizontal alone": ([each.exponent for each in alone], POWER),
        "horizontal beside vertical": ([each.exponent for each in both], POWER),
        "vertical": ([each.vertical_exponent for each in both], 0.0),
    }
    return {
        name: (
            Rate(sum(has(each.interval(), truth) for each in estimates), len(estimates)),
            float(np.median([each.value for each in estimates])),
            float(np.median([np.subtract(*each.interval()[::-1]) / 2 for each in estimates])),
        )
        for name, (estimates, truth) in numbers.items()
    }


# The page.


def _row(section, case, surfaces, hits, repeats, counted="interval holds the truth"):
    names = "section", "case", "surfaces", "counted", "hits", "repeats"
    return dict(zip(names, (section, case, surfaces, counted, hits, repeats), strict=True))


def _means(rows) -> str:
    lines, wider, most = [], ["normal, wider by"], ["normal, at most by"]
    for kind, variation in (("normal", 0.5), ("lognormal", 0.2), ("lognormal", 0.5), ("lognormal", 1.0)):
        cells = []
        for count in SAMPLED:
            held, of_student, factor = mean_of_draws(kind == "normal", variation, count)
            rows.append(_row("means", f"{kind}, scatter {variation:g}", count, held, DRAWN))
            cells.append(f"{100 * held / DRAWN:.1f} ({100 * of_student / DRAWN:.1f})")
            if kind == "normal":
                wider.append(f"{factor.mean():.2f}")
                most.append(f"{np.quantile(factor, 0.95):.2f}")
        lines.append((f"{kind}, scatter {100 * variation:g} %", *cells))
    return table("draws|" + "|".join(f"n = {count}" for count in SAMPLED), [*lines, wider, most])


def _ratios(rows) -> str:
    lines = []
    for pair, kind in ((False, "same surfaces"), (True, "1D over 3D")):
        found = [ratios(surfaces, pair) for surfaces in COUNTS]
        for surfaces, rate in zip(COUNTS, found, strict=True):
            case = f"{kind}, scatter {RATIO_SCATTER:g}, judge"
            rows.append(_row("ratios", case, surfaces, rate.hits, rate.repeats))
        lines.append((kind, *map(str, found)))
    return table("ratio|" + "|".join(f"n = {count}" for count in COUNTS), lines)


def _sizes(rows) -> str:
    lines = []
    for fitted, kind in ((False, "prescribed"), (True, "fitted")):
        for size in SIZES:
            cells = []
            for surfaces in FEW_AND_MANY:
                truth, rate = sized(surfaces, size, fitted)
                case = f"shifts {kind}, delta {size:g}, the judge"
                rows.append(_row("sizes", case, surfaces, rate.hits, rate.repeats))
                cells.append(str(rate))
            lines.append((kind, f"{100 * truth:.1f} %", *cells))
    return table("shifts|δ|" + "|".join(f"n = {count}" for count in FEW_AND_MANY), lines)


def _verdicts(rows, said) -> str:
    lines = []
    for row, claims in said.items():
        lines.append((row, *map(str, claims.values())))
        for claim, each in claims.items():
            for kind, count in zip(("kept", "undecided", "rejected"), each.counts, strict=True):
                rows.append(_row("verdicts", f"{row}, {claim}", SURFACES, count, sum(each.counts), kind))
    wrong, row, claim = max(
        (each.wrong, row, claim) for row, claims in said.items() for claim, each in claims.items()
    )
    at_most = f', most often of "{claim}" where the law is "{row}"' if wrong else ""
    told = f"Verdicts against the truth: {wrong} of {PIPELINE} at most in a cell{at_most}."
    return table("law|" + "|".join(CLAIMS), lines) + "\n\n" + told


def _weak(rows, fits) -> str:
    lines = []
    for surfaces in (3, SURFACES):
        for scatter in (SCATTER, 4 * SCATTER):
            known = (surfaces, scatter) == (SURFACES, SCATTER)
            numbers = weak(fits["right"] if known else repeated("right", surfaces, scatter))
            cells = []
            for name, (rate, middle, half) in numbers.items():
                case = f"exponent {name}, scatter {scatter:g}"
                rows.append(_row("weak", case, surfaces, rate.hits, rate.repeats))
                cells.append(f"{rate} of {rate.repeats}: {middle:.2f}, {half:.2f}".replace("-", "−"))
            lines.append((f"{surfaces}", f"{100 * scatter:g} %", *cells))
    return table("n|scatter|" + "|".join(numbers), lines)


def _both(rows, fits) -> str:
    lines = []
    for law in ("right", "v^0.1", "v^0.2", "v^0.33"):
        asked, held = answered(fits[law], -LAWS[law].get("vertical", 0.0))
        rows.append(_row("weak", f"{law}, both shifts", SURFACES, asked, PIPELINE, "both shifts are the answer"))
        rows.append(_row("weak", f"{law}, both shifts", SURFACES, held, asked))
        lines.append((law, f"{asked} of {PIPELINE}", f"{held} of {asked}"))
    return table("friction times|both shifts are the answer|of these, both exponents held", lines)


def main() -> None:
    """Measure all, and write the tables and the counts."""
    rows = []
    fits = {law: repeated(law) for law in LAWS}
    sections = {
        "means": lambda: _means(rows),
        "ratios": lambda: _ratios(rows),
        "sizes": lambda: _sizes(rows),
        "verdicts": lambda: _verdicts(rows, verdicts(fits)),
        "weak": lambda: _weak(rows, fits),
        "both": lambda: _both(rows, fits),
    }
    write(PAGE, sections)
    stored(PAGE.with_suffix(".csv"), rows)


if __name__ == "__main__":
    main()
