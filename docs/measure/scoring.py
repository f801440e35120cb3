"""Scores of the trust map on scenes held out: errors, coverage and advice, by region."""

from itertools import product

import numpy as np
from pandas import Categorical, DataFrame, concat
from scipy.special import ndtr
from tables import of_count

from compare.trustmap.measured import beyond_measured, limits
from compare.trustmap.model import LAW, MOST_SCATTER, NAMES, NORMAL, regions_of
from compare.trustmap.table import column, measurements
from compare.trustmap.verdict import SOLVE, USE, advice_on

# Regions of each kind in which errors and advice are stated, in the order of their numbers.
REGIONS = {
    "all": ["all"],
    "speed": ["at rest", "slow", "fast"],
    "roughness": ["pressed flat", "touching in part", "as high as the body is deep"],
    "prescribed": ["load", "depth"],
    "body": ["cone", "n from 1 to 2", "sphere", "blunt, n > 2"],
    "solid": ["E_g up to 10^2 E_r", "E_g 10^2 to 10^4 E_r", "Kelvin-like, E_g > 10^4 E_r"],
    "waves": ["less than 2 waves on the radius", "2 to 6 waves", "more than 6 waves"],
    "surface": ["spectrum", "as measured"],
}
COVERED = ["speed", "roughness", "prescribed", "body"]  # what coverage is stated by
# Scenes of a regime below which its advice is left out.
FEWEST = 5
# Scenes of a region from which on it fails if its coverage is below what was promised, with 95 % of confidence.
ENOUGH, PROMISED = 40, 0.95
# Of the narrower of two intervals, of 1D and of the law.
BEST = "best-advice"


def placed(groups, slides):
    """Region of each scene, a column for each kind."""
    numbers = regions_of(groups)
    numbers |= {
        "all": 0 * slides,
        "speed": slides * (1 + numbers["speed"]),
        "solid": np.digitize(groups["stiffening"], np.log([1e2, 1e4]), right=True),
        "waves": np.digitize(groups["sliding_waves"], np.log([2, 6]), right=True),
        "surface": (groups["side"] > 0) | (groups["gaussian"] > 0),
    }
    return {kind: Categorical.from_codes(np.array(numbers[kind], int), names) for kind, names in REGIONS.items()}


def score(measured, predicted, slides):
    """Ratios predicted and measured, a row for each scene: its region of each kind, and

    ratio, error : predicted, with the standard error of its logarithm
    advice : on it; usable : whether that is "use" or "multiply"
    off : relative error of corrected 1D, the scatter of the truth in it; NaN where a mean is not above zero
    held : whether the ratio is within the interval of 95 %, widened by the noise of the truth
    surface_held : share of single surfaces, as they were measured, within the interval of one, where it has one

    slides : whether each of them does
    """
    apart, ratio, error = measured.logarithm - predicted.logarithm, np.exp(predicted.logarithm), predicted.error
    advice = np.array([advice_on(*each) for each in zip(ratio, error, strict=True)])
    width, scatter = NORMAL * np.hypot(error, predicted.scatter), np.maximum(np.nan_to_num(measured.scatter), 1e-9)
    inside = ndtr((width - apart) / scatter) - ndtr((-width - apart) / scatter)
    return DataFrame(
        {
            **placed(DataFrame(measured.groups, columns=NAMES), slides),
            "ratio": ratio,
            "error": error,
            "advice": advice,
            "usable": advice != SOLVE,
            "off": np.expm1(apart),
            "held": np.abs(apart) < NORMAL * np.sqrt(error**2 + measured.variance(predicted.scatter)),
            "surface_held": np.where(predicted.scatter < MOST_SCATTER, inside, np.nan),
        }
    )


def used(score):
    """Scenes that are usable and have a ratio: whose errors count."""
    return score[score["usable"] & score["off"].notna()]


def best(first, second):
    """Score that takes for each scene the narrower of two intervals, and is usable where either is."""
    alike = first["usable"] == second["usable"]
    ours = (alike & (first["error"] <= second["error"])) | (~alike & first["usable"])
    return concat([first[ours], second[~ours]]).sort_index()


def scored(held_out, models):
    """Score of each model on the scenes of a table, and of the best advice on friction.

    Off the map nothing is known: the advice is to solve.
    """
    found = {}
    for name, model in models.items():
        rows, measured = measurements(held_out, name)
        off = np.array([bool(beyond_measured(place)) for place in measured.groups], bool)
        predicted = model.predicted(np.clip(measured.groups, *limits()))
        predicted = predicted._replace(error=np.where(off, np.inf, predicted.error))
        found[name] = score(measured, predicted, held_out[column("friction", "surfaces")][rows] > 0)
    return {**found, BEST: best(found["friction"], found[LAW])}


def of_surfaces(scores, name):
    """Scores on the scenes with surfaces of one kind."""
    return {each: score[score["surface"] == name] for each, score in scores.items()}


def error_rows(scores, kinds=REGIONS):
    """Errors as measured and share within the interval, by region, a kind of region at a time, and ratio.

    fails : as in `coverage_rows`
    """
    for kind in kinds:
        for region, (name, score) in product(REGIONS[kind], scores.items()):
            here = score[(score[kind] == region) & score["off"].notna()]
            if len(counted := used(here)):
                half, most = np.quantile(np.abs(counted["off"]), (0.5, 0.9))
                row = {"ratio": name, "by": kind, "region": region, "scenes": len(here)}
                row |= {"usable": here["usable"].mean(), "median": half, "nine in ten": most}
                yield row | _held(counted)


def _held(used):
    """Share within the interval with its own, and whether it fails what was promised."""
    low, high = of_count(int(used["held"].sum()), len(used))
    fails = len(used) >= ENOUGH and high < PROMISED
    return {"in 95 %": used["held"].mean(), "least": low, "most": high, "fails": fails}


def coverage_rows(scores):
    """Share of the usable ratios within their interval, by quantity and region, with the interval of the count.

    fails : whether a region of enough scenes has significantly fewer than what was promised
    """
    for name, score in scores.items():
        for region, own in used(score).groupby(COVERED, observed=True):
            row = dict(zip(COVERED, region, strict=True)) | {"quantity": name, "scenes": len(own)}
            yield row | _held(own)


def advice_rows(scores):
    """A row for each regime, a cell for each score: factor on it, half its interval, and share to solve."""
    for speed, region in product(("slow", "fast", "at rest"), REGIONS["roughness"]):
        cells = (_advice(score[(score["speed"] == speed) & (score["roughness"] == region)]) for score in scores)
        yield f"{speed}, {region}", *cells


def _advice(part):
    """Advice of most scenes; a factor with its range, from the lowest to the highest of nine in ten."""
    if len(part) < FEWEST:
        return ""
    known = part[part["usable"]]
    left = 1 - len(known) / len(part)
    solve = f"solve {100 * left:.0f} %"
    if left > 0.5:
        return solve
    low, middle, high = np.quantile(1 / known["ratio"], (0.05, 0.5, 0.95))
    kind = "use" if part["advice"].eq(USE).mean() > 0.5 else f"× {middle:.2f} ({low:.2f} to {high:.2f})"
    half = 100 * np.median(np.expm1(NORMAL * known["error"]))
    return f"{kind}, ±{half:.2g} %" + (f"; {solve}" if left > 0.005 else "")
