"""Rates at which intervals hold the truth and verdicts are right: numbers of docs/results/accuracy.md.

python docs/measure/rates.py

Friction is drawn with an answer that is known. It takes minutes on one core; every draw follows from SEED.
"""

from math import sqrt

import numpy as np
import pandas
from tables import RESULTS, fill, stored, table

from compare.statistics import eq23
from compare.statistics.collapse import collapse
from compare.statistics.frictioncurves import SimulatedCurves
from compare.statistics.intervals import student
from compare.statistics.jackknife import mean_ratio
from mdr1d.equations import interpolation

PAGE = RESULTS / "accuracy.md"
MEANS, VERDICTS = (RESULTS / f"accuracy/rates-{name}.csv" for name in ("means", "verdicts"))
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
DRAWN, SAMPLED, VARIATIONS = 20_000, (3, 10, 50), (0.2, 0.5, 1.0)
REPEATS, SURFACES = 200, 10


def drawn(rng, exact):
    """Friction whose mean over all surfaces is exp(exact) (speeds, loads); relative scatter is lognormal."""
    shared = SCATTER * np.tensordot(FIELDS, rng.normal(size=(len(FIELDS), SURFACES)), axes=(0, 0))
    own = OWN * rng.normal(size=shared.shape)
    variance = SCATTER**2 * np.square(FIELDS).sum(axis=0) + OWN**2
    load = np.broadcast_to(LOADS[:, None], shared.shape)
    return SimulatedCurves(SPEEDS, load, np.exp(exact[..., None] + shared + own - variance[..., None] / 2) * load)


def knee(x):
    """ln of Eq. 19 for a sphere, over ln F shifted as at the middle speed."""
    return np.log(interpolation(MIDDLE * np.exp(-x * 2 / 3)))


def friction(vertical=0.0, shape=0.0):
    """ln mu (speeds, loads) shifted by POWER of the speed, raised by another, bent by shape times ln v."""
    bent = np.outer(ALONG, ACROSS**2 - np.mean(ACROSS**2))
    return knee(ACROSS + POWER * ALONG[:, None]) + vertical * ALONG[:, None] + shape * bent


def generator(*cell):
    """Random numbers of one cell of a table."""
    return np.random.default_rng([SEED, *(round(1000 * number) for number in cell)])


def mean_of_draws(variation, count):
    """Share of the intervals of a mean of lognormal draws, ours and Student's, that hold it."""
    draws, width = generator(3, False, variation, count).normal(size=(DRAWN, count)), sqrt(np.log1p(variation**2))
    found = mean_ratio(np.exp(width * draws - width**2 / 2))
    (low, high), half = found.interval(), found.error * student(0.95, found.dof)
    held = {"ours": np.mean((low <= 1) & (high >= 1)), "student": np.mean(np.abs(found.value - 1) <= half)}
    return {"scatter": variation, "draws": count} | held


# What is drawn, and the power of p(v) in the theory that is asked about.
LAWS = {
    "right": ({}, POWER),
    "theory says −1.65": ({}, -1.65),
    "friction times v^0.33": ({"vertical": 0.33}, POWER),
    "shape changes with v": ({"shape": 0.035}, POWER),
}
CLAIMS = {
    "one curve": eq23.COLLAPSE,
    "no vertical shift": eq23.VERTICAL,
    "shifts as predicted": eq23.PREDICTED,
    "power of v": eq23.EXPONENT,
}
KINDS = "holds", "undecided", "fails"


def asked(found, theory):
    """Number and verdict by claim, as the studies ask for them."""
    named = {each.claim.id: each for each in eq23.findings(found, None, "1D", theory * np.log(SPEEDS), theory)}
    shifted = {eq23.VERTICAL: named.get(eq23.NOT_SHIFTED.id)}
    return {name: (named[of.id].value, (shifted.get(of) or named[of.id]).verdict) for name, of in CLAIMS.items()}


def verdicts():
    """By law and claim: the number without scatter, and how often the claim was kept, open or rejected."""
    load = np.broadcast_to(LOADS, (len(SPEEDS), len(LOADS)))
    for law, (changes, theory) in LAWS.items():
        exact, rng = friction(**changes), generator(3, list(LAWS).index(law), SURFACES, SCATTER)
        found = [asked(collapse(drawn(rng, exact)), theory) for _ in range(REPEATS)]
        truth = asked(collapse(SimulatedCurves(SPEEDS, load, np.exp(exact) * load)), theory)
        for claim, (number, _) in truth.items():
            kinds = [each[claim][1] for each in found]
            row = {"law": law, "claim": claim, "truth": number}
            yield row | {kind: kinds.count(kind) for kind in KINDS}


def parts():
    """Text between two comments of the page, by the name of the comment."""
    means, judged = pandas.read_csv(MEANS), pandas.read_csv(VERDICTS)
    shares = (
        (f"{scatter:.0%}", *(f"{100 * row.ours:.1f} ({100 * row.student:.1f})" for row in own.itertuples()))
        for scatter, own in means.groupby("scatter")
    )
    rows = ((law, *map(_shown, own.itertuples())) for law, own in judged.groupby("law", sort=False))
    return {
        "means": table("scatter of a draw|" + "|".join(f"{count} draws" for count in SAMPLED), shares),
        "verdicts": table("law|" + "|".join(CLAIMS), rows),
    }


def _shown(row):
    number = f"{row.truth:.2f}".replace("-", "−") if row.claim == "power of v" else f"{100 * abs(row.truth):.1f} %"
    return f"{number}: " + " / ".join(f"{100 * getattr(row, kind) / REPEATS:g}" for kind in KINDS)


def main():
    """Draw, and write the numbers and the parts of the page."""
    stored(MEANS, (mean_of_draws(variation, count) for variation in VARIATIONS for count in SAMPLED))
    stored(VERDICTS, verdicts())
    fill(PAGE, parts())


if __name__ == "__main__":
    main()
