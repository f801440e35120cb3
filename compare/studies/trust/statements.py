"""What the map states of scenes held out: errors, coverage and advice, by region."""

from collections.abc import Iterator, Mapping
from itertools import product
from typing import Any, TypeAlias

import numpy as np

from ...trustmap.model import NORMAL
from ...trustmap.regions import BODIES, COVERED, REGIONS, ROUGHNESS, SPEEDS, SURFACES, Condition, parts
from ...trustmap.verdict import MULTIPLY, SOLVE, USE
from .scoring import Score, of_count

# Scenes of a regime below which nothing is said of its advice.
FEWEST = 5
# Scenes of a region from which on it fails if its coverage is below what was promised, with 95 % of confidence.
ENOUGH, PROMISED = 40, 0.95
# Of the narrower of two intervals, of 1D and of the law.
BEST = "best-advice"
STATED = {**REGIONS, "prescribed": COVERED["prescribed"], "surface": SURFACES}
# A score, and the groups of its scenes by name.
Scored: TypeAlias = tuple[Score, Mapping[str, np.ndarray]]


def of_surfaces(scores: Mapping[str, Scored], name: str) -> dict[str, Scored]:
    """Scores on the scenes with surfaces of one kind, see `regions.SURFACES`."""
    found: dict[str, Scored] = {}
    for each, (score, groups) in scores.items():
        here = SURFACES[name](groups)
        found[each] = score.taken(here), {key: values[here] for key, values in groups.items()}
    return found


def error_rows(scores: Mapping[str, Scored]) -> Iterator[dict[str, Any]]:
    """Errors as measured and share within the interval, by ratio and region, a kind of region at a time.

    fails : like that of `coverage_rows`
    """
    kinds = {"all": {"all": lambda groups: groups["shape"] == groups["shape"]}, **STATED}
    for (name, (score, groups)), (kind, regions) in product(scores.items(), kinds.items()):
        for region, condition in regions.items():
            here = condition(groups) & np.isfinite(score.measured.logarithm)
            used = score.taken(here & score.usable)
            if not used.usable.size:
                continue
            half, most = np.quantile(np.abs(used.errors), (0.5, 0.9))
            row = {"ratio": name, "by": kind, "region": region, "scenes": int(here.sum())}
            row |= {"usable": float(score.usable[here].mean()), "median": half, "nine in ten": most}
            yield row | _held(used)


def _held(used):
    """Share within the interval with its own, and whether it fails what was promised."""
    tried = used.usable.size
    low, high = of_count(int(used.held.sum()), tried)
    fails = tried >= ENOUGH and high < PROMISED
    return {"in 95 %": used.covered, "least": low, "most": high, "fails": fails}


def coverage_rows(scores: Mapping[str, Scored]) -> Iterator[dict[str, Any]]:
    """Share of the usable ratios within their interval, by quantity and region, with the interval of the count.

    fails : whether a region of enough scenes has significantly fewer than what was promised
    """
    for name, (score, groups) in scores.items():
        counts = score.usable & np.isfinite(score.measured.logarithm)
        for named, here in parts(COVERED, groups):
            used = score.taken(here & counts)
            if used.usable.size:
                row = dict(zip(COVERED, named, strict=True)) | {"quantity": name, "scenes": used.usable.size}
                yield row | _held(used)


def advice_rows(
    scores: Mapping[str, Scored], bodies: Mapping[str, Condition] = BODIES
) -> Iterator[dict[str, Any]]:
    """Factor on 1D, half its interval, and share of each advice, by quantity, speed, roughness and body.

    The factor is that of the usable scenes, from the lowest to the highest of nine in ten.
    """
    regimes = list(product(SPEEDS.items(), ROUGHNESS.items(), bodies.items()))
    for (name, (score, groups)), named in product(scores.items(), regimes):
        here = np.all([condition(groups) for _, condition in named], axis=0)
        part = score.taken(here)
        if here.sum() < FEWEST:
            continue
        row: dict[str, Any] = dict(zip(("speed", "roughness", "body"), (each for each, _ in named), strict=True))
        row |= {"quantity": name, "scenes": part.usable.size}
        row |= {kind: float(np.mean(part.advice == kind)) for kind in (USE, MULTIPLY, SOLVE)}
        if part.usable.any():
            known = part.taken(part.usable).predicted
            low, middle, high = np.quantile(np.exp(-known.logarithm), (0.05, 0.5, 0.95))
            half = np.median(np.expm1(NORMAL * known.error))
            row |= {"factor": middle, "from": low, "to": high, "interval": half}
        yield row
