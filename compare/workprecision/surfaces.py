"""Statistical error beside that of the grid: on how many points, over how many surfaces, to average in 3D."""

from collections.abc import Sequence
from math import ceil, inf, isfinite

from . import regimes
from .answers import LEVELS, answer, failures, named
from .diagram import Diagram
from .ensemble import JudgedEnsemble, Standing
from .statistics import Way, cheapest
from .wording import seconds, share

SPEED = ("rest", "middle")


def plain(standing: Standing) -> list[Way]:
    """Of the 3D solver on one grid each."""
    return [way for way in standing.of("BEM") if not way.corrected]


def corrected(standing: Standing) -> list[Way]:
    """Of the 3D solver on its first grid, corrected on a finer one."""
    return [way for way in standing.of("BEM") if way.corrected]


def advice(found: Sequence[JudgedEnsemble]) -> str:
    """How to share time between points and surfaces, from the numbers."""
    standings = [(each, standing) for each in found for standing in each.standings.values()]
    said = [_parts(standings), *(_recipe(each, standing) for each, standing in standings)]
    unsolved = [f"{named(each)}, {reason}" for each in found for reason in failures(each)]
    if unsolved:
        said.append(f"Not solved: {'; '.join(unsolved)}.")
    return " ".join(said)


def _parts(standings):
    """Scatter and bias of the first grid, and from how many surfaces on the second counts."""
    firsts = [plain(standing)[0] for _, standing in standings]
    known = [
        (way.draws[0].scatter.value, way.bias.size)
        for way in firsts
        if isfinite(way.draws[0].scatter.value) and isfinite(way.bias.size) and way.bias.size > 0
    ]
    if not known:
        return "How surfaces scatter is not known."
    scatters, biases = zip(*known, strict=True)
    fewest = min(ceil((scatter / bias) ** 2) for scatter, bias in known)
    points = sorted({way.draws[0].points[0] for way in firsts})
    return (
        f"One surface scatters by {_range(scatters)}, while the coarsest grid ({', '.join(map(str, points))} "
        f"points) is off by {_range(biases)}: more points gain something only from {fewest:,} surfaces on."
    )


def _recipe(found, standing):
    """What the smallest wanted error that is reached takes, and what the corrections save."""
    name = standing.quantity.name
    label = f"{standing.quantity.label} of the {named(found)}"
    reached = [level for level in LEVELS if answer(found, name, level, "BEM") is not None]
    if not reached:
        return f"No error of {', '.join(map(share, LEVELS))} is known to be reached in the {label}."
    least = min(reached)
    best = answer(found, name, least, "BEM")
    said = f"For the {label} within {share(least)} (expected, rms) take {best.settings}: {seconds(best.seconds)}"
    alone = cheapest(plain(standing), least)
    if alone is None:
        said += "; no single grid is known to reach it"
    elif alone.seconds > best.seconds:
        said += f", where the best single grid ({alone.way.label} points) takes {seconds(alone.seconds)}"
    if least != LEVELS[-1]:
        lacking = next(level for level in LEVELS if level < least)
        said += f"; {share(lacking)} is not reached, as {_hindrance(standing, lacking)}"
    return f"{said}."


def _hindrance(standing, level):
    """The grid of the truth, or of all ways that could be taken the bias with its interval."""
    if standing.discretisation >= level:
        return f"the truth is known to {share(standing.discretisation)} of grid"
    known = min(way.bias.most for way in standing.of("BEM") if way.reaching(inf) is not None)
    return f"the bias is known only to {share(known)}"


def _range(values):
    low, high = min(values), max(values)
    return share(low) if share(low) == share(high) else f"{share(low)} to {share(high)}"


def _contests(size: str):
    return [each for each in regimes.rough(size) if each.name.endswith(SPEED)]


DIAGRAM = Diagram(
    name="surfaces",
    title="How many surfaces, on how many points",
    about=(
        "A rough contact has the mean over surfaces as its answer. The error of a mean is what the grid leaves, "
        "however many surfaces are solved, and what their scatter leaves, however fine the grid."
    ),
    contests=_contests,
    advice=advice,
)
