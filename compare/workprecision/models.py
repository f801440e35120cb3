"""Error of both models against the true answer of three dimensions: what 1D gives, and what 3D costs."""

from collections.abc import Sequence
from math import isfinite

from . import regimes
from .answers import (
    DIMENSIONS,
    Answer,
    Found,
    answer,
    best,
    converges,
    failures,
    floor,
    interval,
    named,
    quantities,
)
from .diagram import Diagram
from .ensemble import JudgedEnsemble
from .wording import seconds, share

# What is asked for, and the quantities that answer it, one at most in a regime.
ASKED = {"friction": ("friction",), "depth or force": ("depth", "force")}
# Of these the advice speaks.
LEVELS = (0.1, 0.01)
# Regimes that are named one by one; of more, how many they are.
NAMED = 4


def cases(found: Sequence[Found], names: Sequence[str]) -> list[tuple[Found, str]]:
    """Regimes with the name of their quantity among some."""
    return [(each, quantity.name) for each in found for quantity in quantities(each) if quantity.name in names]


def advice(found: Sequence[Found]) -> str:
    """Which model to take when, from the numbers."""
    said = []
    for asked, names in ASKED.items():
        chosen = cases(found, names)
        if chosen:
            said += [_floors(asked, chosen), *(_choices(chosen, level) for level in LEVELS)]
    if any(isinstance(each, JudgedEnsemble) for each in found):
        said.append("The errors of rough regimes are those expected (rms) of a mean over surfaces.")
    unsolved = [f"{named(each)}, {reason}" for each in found for reason in failures(each)]
    if unsolved:
        said.append(f"Not solved: {'; '.join(unsolved)}.")
    return " ".join(said)


def _floors(asked, chosen):
    exact = [named(case[0]) for case in chosen if converges(*case)]
    none = f"none (it converges) for {', '.join(exact)}" if exact else ""
    known = [(floor(*case), named(case[0])) for case in chosen if not converges(*case)]
    known = sorted(((bias, name) for bias, name in known if isfinite(bias.size)), key=lambda pair: pair[0].size)
    if not known and exact:
        return f"Of errors in {asked} one dimension keeps {none}."
    if not known:
        return f"What error one dimension keeps in {asked} is not known."
    (least, first), (most, last) = known[0], known[-1]
    opening = f"In {asked} one dimension keeps on its finest grid an error of {interval(least)}"
    closing = f"; {none}." if exact else "."
    if len(known) == 1:
        return f"{opening} ({first}){closing}"
    return f"{opening} at best ({first}) and of {interval(most)} at worst ({last}){closing}"


def _choices(chosen, level) -> str:
    """What to take for a wanted error, and where it is out of reach."""
    taken = [(found, quantity, answer(found, quantity, level)) for found, quantity in chosen]
    parts = []
    for solver, verb in (("MDR", "will do for"), ("BEM", "is the shortest way, or the only one, for")):
        own = [(found, way) for found, _, way in taken if way is not None and way.solver == solver]
        if own:
            parts.append(f"{DIMENSIONS[solver]} {verb} {_named([f for f, _ in own], chosen)}, {_times(own)}")
    missed = [(found, quantity) for found, quantity, way in taken if way is None]
    if missed:
        parts.append(f"nothing that was tried is known to reach it for {_missed(missed, chosen)}")
    return f"Within {share(level)}: {'; '.join(parts)}."


def _times(own: Sequence[tuple[Found, Answer]]) -> str:
    """The longest last."""
    ordered = sorted(own, key=lambda pair: pair[1].seconds)
    (found, longest), shortest = ordered[-1], ordered[0][1]
    if len(own) == 1:
        return f"with {longest.settings} in {seconds(longest.seconds)}"
    return (
        f"in {seconds(shortest.seconds)} to {seconds(longest.seconds)}, the latter with {longest.settings} "
        f"({named(found)})"
    )


def _named(own: Sequence[Found], chosen) -> str:
    if len(own) == len(chosen) > 1:
        return "all regimes"
    return ", ".join(named(each) for each in own) if len(own) <= NAMED else f"{len(own)} of {len(chosen)} regimes"


def _missed(missed, chosen) -> str:
    known = [value for case in missed if isfinite(value := best(*case))]
    names = _named([found for found, _ in missed], chosen)
    return f"{names}, where {share(min(known))} is the best" if known else names


def _contests(size: str):
    return [*regimes.smooth(size), *regimes.rough(size)]


DIAGRAM = Diagram(
    name="models",
    title="Which model for which error",
    about=(
        "Both models against the true answer of three dimensions: one is fast and keeps the error of the model, "
        "the other is slow and converges. Smooth bodies have one answer; that of rough ones is the mean over "
        "surfaces, so that the scatter between surfaces counts beside the grid."
    ),
    contests=_contests,
    advice=advice,
)
