"""To know the true answer of three dimensions within a wanted error: which model, which settings, how long."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import inf, isfinite, nan

import numpy as np

from .contest import Judged, Quantity
from .ensemble import JudgedEnsemble
from .statistics import Bias, Reached, cheapest
from .wording import seconds, share

LEVELS = (0.1, 0.03, 0.01, 0.003)
DIMENSIONS = {"MDR": "1D", "BEM": "3D"}
# Order in the points from which on an error falls.
FALLS = 0.3

Found = Judged | JudgedEnsemble


@dataclass(frozen=True)
class Answer:
    """The shortest way to a wanted error.

    solver : by name; settings : in words; seconds : of processor time
    """

    solver: str
    settings: str
    seconds: float

    @property
    def said(self) -> str:
        """In words."""
        return f"{DIMENSIONS[self.solver]}, {self.settings}: {seconds(self.seconds)}"


def title(found: Found) -> str:
    """Of the regime, for people."""
    match found:
        case Judged():
            return found.contest.title
        case JudgedEnsemble():
            return found.ensemble.title


def named(found: Found) -> str:
    """The same within a sentence."""
    return title(found).replace(", ", " at ")


def quantities(found: Found) -> tuple[Quantity, ...]:
    """Those of which the truth is asked for."""
    match found:
        case Judged():
            return tuple(each for each in found.contest.quantities if each.name in found.known)
        case JudgedEnsemble():
            return found.ensemble.quantities


def restricted(found: Sequence[Found], names: Sequence[str]) -> list[Found]:
    """Of all regimes, only the quantities of some names; regimes without any are left out."""
    return [_restricted(each, names) for each in found if any(q.name in names for q in quantities(each))]


def answer(found: Found, quantity: str, level: float, solver: str | None = None) -> Answer | None:
    """The shortest way of one solver, or of both, whose error and that of the truth stay within a level together.

    None where there is none. The time of an ensemble grows with the number of surfaces, however large.
    """
    match found:
        case Judged():
            options = list(_rungs(found, quantity, level, solver))
            return min(options, key=lambda option: option.seconds, default=None)
        case JudgedEnsemble():
            ways = [way for way in found.standings[quantity].ways if solver in (None, way.solver)]
            reached = cheapest(ways, level)
            return None if reached is None else _of_surfaces(reached)


def best(found: Found, quantity: str, solver: str | None = None) -> float:
    """Least error that one solver, or either, is known to reach with any of its settings; NaN if not known."""
    match found:
        case Judged():
            errors = [
                climbed.errors[quantity][-1] + found.known[quantity].relative_error
                for climbed in _ladders(found, solver)
            ]
        case JudgedEnsemble():
            errors = [way.bias.most for way in found.standings[quantity].ways if solver in (None, way.solver)]
    return float(np.nanmin([*errors, inf])) if np.isfinite(errors).any() else nan


def floor(found: Found, quantity: str) -> Bias:
    """Of the 1D model on its finest grid: what no setting passes, unless it converges; NaN where not solved."""
    match found:
        case Judged():
            errors = [climbed.errors[quantity][-1] for climbed in _ladders(found, "MDR")]
            return Bias(float(errors[-1]), found.known[quantity].relative_error) if errors else Bias(nan, nan)
        case JudgedEnsemble():
            return found.standings[quantity].floor or Bias(nan, nan)


def converges(found: Found, quantity: str) -> bool:
    """Whether the error of the 1D model on a smooth body still falls from its last grid but one to its finest."""
    if isinstance(found, JudgedEnsemble):
        return False
    falls = [_falls(climbed, quantity) for climbed in _ladders(found, "MDR")]
    return bool(falls) and falls[-1]


def failures(found: Found) -> list[str]:
    """What was not solved, and why."""
    match found:
        case Judged():
            return [
                f"{climbed.ladder.label} with {value:g} {climbed.ladder.setting}: {reason}"
                for climbed in found.climbed
                for value, reason in zip(climbed.ladder.values, climbed.reasons, strict=True)
                if reason is not None
            ]
        case JudgedEnsemble():
            return [
                f"{len(sample.reasons)} of {sample.count} in {DIMENSIONS[sample.solver]} with {sample.points} "
                f"points: {sample.reasons[0]}"
                for sample in found.samples
                if sample.reasons
            ]


def table(found: Sequence[Found], levels: Sequence[float] = LEVELS) -> list[dict]:
    """A row for each regime, quantity and wanted error; times in seconds, errors relative."""
    return [_row(each, quantity, level) for each in found for quantity in quantities(each) for level in levels]


def cells(found: Sequence[Found], of: Sequence[str], levels: Sequence[float] = LEVELS) -> list[dict[str, str]]:
    """In words, of the quantities of some names: regimes as rows, wanted errors as columns.

    Of rough regimes the error is that expected of a mean over surfaces (rms), of smooth ones the error itself.
    """
    return [
        {
            "regime": _regime(each) if len(of) == 1 else f"{_regime(each)}: {quantity.label}",
            **{f"within {share(level)}": _cell(each, quantity.name, level) for level in levels},
            "error that 1D keeps": _kept(each, quantity.name),
        }
        for each in found
        for quantity in quantities(each)
        if quantity.name in of
    ]


def interval(bias: Bias) -> str:
    """A size with the ends of its interval, in words."""
    if not isfinite(bias.size):
        return "not known"
    if not isfinite(bias.reach):
        return f"{share(bias.size)}, interval not known"
    if bias.reach < 0.05 * bias.size:
        return share(bias.size)
    return f"{share(bias.size)} ({percent(bias.least)} to {share(bias.most)})"


def percent(value: float) -> str:
    """A share without its unit, where the unit follows."""
    return share(value).removesuffix(" %") if value else "0"


def _restricted(found, names):
    kept = tuple(quantity for quantity in quantities(found) if quantity.name in names)
    match found:
        case Judged():
            return replace(found, contest=replace(found.contest, quantities=kept))
        case JudgedEnsemble():
            return replace(found, ensemble=replace(found.ensemble, quantities=kept))


def _regime(found: Found) -> str:
    return f"{title(found)}, expected (rms)" if isinstance(found, JudgedEnsemble) else title(found)


def _kept(found: Found, quantity: str) -> str:
    return "none (it converges)" if converges(found, quantity) else interval(floor(found, quantity))


def _cell(found: Found, quantity: str, level) -> str:
    taken, known = answer(found, quantity, level), best(found, quantity)
    if taken is not None:
        return taken.said
    return f"not reached; best known {share(known)}" if isfinite(known) else "not known"


def _row(found: Found, quantity: Quantity, level) -> dict[str, object]:
    taken, own = answer(found, quantity.name, level), floor(found, quantity.name)
    each = {solver: answer(found, quantity.name, level, solver) for solver in DIMENSIONS}
    return {
        "regime": title(found),
        "quantity": quantity.label,
        "wanted": level,
        "model": "" if taken is None else DIMENSIONS[taken.solver],
        "settings": "" if taken is None else taken.settings,
        "seconds": nan if taken is None else taken.seconds,
        **{
            f"seconds_{DIMENSIONS[solver].lower()}": nan if found is None else found.seconds
            for solver, found in each.items()
        },
        "best_known": best(found, quantity.name),
        "floor_1d": own.size,
        "floor_1d_least": own.least,
        "floor_1d_most": own.most,
        "converges_1d": converges(found, quantity.name),
    }


def _rungs(found: Judged, quantity, level, solver) -> Iterator[Answer]:
    room = level - found.known[quantity].relative_error
    for climbed in _ladders(found, solver):
        k = climbed.reaching(quantity, room)
        if k is not None:
            ladder = climbed.ladder
            settings = f"{ladder.values[k]:g} {ladder.setting}"
            yield Answer(ladder.rungs[k].solver.name, settings, float(climbed.processor[k]))


def _falls(climbed, quantity) -> bool:
    """By the order between the last two rungs; one alone cannot tell."""
    if len(climbed.ladder.values) < 2:
        return False
    (coarse, fine), (before, last) = climbed.ladder.values[-2:], climbed.errors[quantity][-2:]
    return bool(before > last * (fine / coarse) ** FALLS)


def _ladders(found: Judged, solver):
    return [each for each in found.climbed if solver in (None, each.ladder.rungs[0].solver.name)]


def _of_surfaces(reached: Reached) -> Answer:
    way = reached.way
    what = "profiles" if way.solver == "MDR" else "surfaces"
    (count, *more), (draw, *finer) = reached.counts, way.draws
    settings = f"{count:,} {what if count > 1 else what[:-1]} of {draw.points[0]} points"
    for number, correction in zip(more, finer, strict=True):
        settings += f", corrected by {number:,} of {correction.points[0]}"
    return Answer(way.solver, settings, reached.seconds)
