"""First paragraph on a scene: what each model answers, how far they are apart, and what to do with 1D."""

from math import isfinite

from ...figures.prefixes import prefixed
from ...library.describe import conditions
from ...models.table import Model
from ...solving.words import capital, interval, off, share, with_unit
from ...statistics.finding import Finding
from ...statistics.multilevel import WORDS
from ...trustmap.verdict import CALLED, MULTIPLY, NONE, SMALL, USE, Advice, Correction
from .claims import CaseFindings, own_means
from .curves import OWN

APART = "This map and these means do not agree within their intervals: solve more surfaces."
UNITS = {"depth_reached": "m", "normal_force": "N"}


def opening(case: CaseFindings, advice: Advice) -> str:
    """A scene, its friction, its depth or force, the advice on both, and what the numbers are means of."""
    told = [f"{case.case.title or case.name}, {conditions(case.case.motion)}."]
    for mean in own_means(case.case):
        told.append(_answers(case, mean))
        cheap = getattr(advice, WORDS[mean])
        if cheap and {"MDR", "BEM"} <= set(case.models.labels):
            told.append(_advised(cheap, advice.law if cheap is advice.friction else None))
            told += [
                APART
                for name, model, found in case.own_ratios
                if name == mean and _contradicts(model, found, cheap)
            ]
    return " ".join(dict.fromkeys([*told, _averaged(case)])).strip()


def _answers(case: CaseFindings, mean: str) -> str:
    """Answers of the models with their intervals, and how far they are from the reference."""
    found = case.own(mean)
    answers = {model.label: found[model.label] for model in case.models if model.label in found}
    values = [value for value, _, _ in answers.values()]
    factor, unit = prefixed(values, UNITS[mean]) if mean in UNITS else (1.0, "")
    told = [f"{_number(factor, each, unit)} in {label}" for label, each in answers.items()]
    reference = case.models[case.models.reference].label
    apart = [_apart(model.label, found, reference) for name, model, found in case.own_ratios if name == mean]
    return f"{capital(WORDS[mean])} {', '.join(told)}{': ' if apart else ''}{'; '.join(apart)}."


def _number(factor, found, unit):
    value, low, high = (factor * each for each in found)
    return with_unit(interval(value, low, high, 3), unit) if isfinite(value) else "not known"


def _apart(label: str, ratio: Finding, reference: str) -> str:
    """Say how far a model is from the reference."""
    low, high = ratio.interval
    if not (low > 0 and isfinite(high)):
        return f"how far {label} is off is not known"
    if low >= 1 - SMALL and high <= 1 + SMALL:
        return f"{label} is within {share(SMALL)} of {reference}"
    if low <= 1 <= high:
        return f"{label} is between {off(low)} and {off(high)}"
    return f"{label} is {off(ratio.value)}"


def _advised(cheap: Correction, law: Correction | None) -> str:
    """What the trust map says of the answer of 1D."""
    why = cheap.reason.partition(": ")[2] or cheap.reason
    if cheap.advice == NONE:
        return cheap.reason
    if cheap.advice == USE:
        return "The trust map takes 1D as it is."
    if cheap.advice == MULTIPLY:
        by_law = law is not None and law.advice == USE
        other = f", or takes {CALLED[law.model]}, {off(law.low)} to {off(law.high)}" if by_law else ""
        return f"Do not use 1D as it is: the trust map multiplies it by {cheap.times}{other}, as {why}"
    return f"Do not use 1D: the trust map says to solve in 3D, as {why}"


def _contradicts(model: Model, solved: Finding, foretold: Correction) -> bool:
    """Whether means over surfaces and what the trust map foretells of 1D have no ratio in common."""
    low, high = solved.interval
    return model.name == "MDR" and solved.draws > 0 and (low > foretold.high or high < foretold.low)


def _averaged(case: CaseFindings) -> str:
    """What the numbers are means of; empty of a smooth body."""
    points = case.points[case.points["curve"] == OWN].set_index("solver")
    drawn = [
        f"{points.loc[model.name, 'surfaces']:.0f} {model.draws} in {model.label}"
        for model in case.models.drawn
        if model.name in points.index
    ]
    return f"Means of {' and '.join(drawn)}." if case.case.roughness and drawn else ""
