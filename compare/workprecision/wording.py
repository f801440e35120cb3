"""What a reader can do with a ladder, in words: settings with their times, and what cannot be had."""

from collections.abc import Sequence
from itertools import groupby
from math import isfinite

import numpy as np

from .contest import Climbed, Judged

# Errors alike: what is gained by less than this factor is not worth having.
ALIKE = 1.5
HOUR = 3600.0


def seconds(value: float) -> str:
    """Two digits with a unit."""
    if not isfinite(value):
        return "an unknown time"
    if value < 0.995e-4:
        return f"{1e6 * value:.2g} µs"
    if value < 0.0995:
        return f"{1e3 * value:.2g} ms"
    if value < 2 * HOUR:
        return f"{value:.2g} s" if value < 99.5 else f"{value:.0f} s"
    return f"{value / HOUR:.2g} h" if value < 99.5 * HOUR else f"{value / HOUR:.0f} h"


def share(value: float) -> str:
    """Relative error: per cent while they are readable."""
    if not isfinite(value):
        return "an unknown error"
    if value >= 0.995:
        return f"{100 * value:.0f} %"
    return f"{100 * value:.2g} %" if value >= 0.99e-4 else f"{value:.0e}".replace("e-0", "e-")


def digits(value: float) -> str:
    """A setting as it is written at a point: 1024, 0.5, 1e-3."""
    return f"{value:g}" if value >= 0.01 else f"{value:.0e}".replace("e-0", "e-")


def setting(name: str, value: float) -> str:
    """One rung of a ladder."""
    if name in ("points", "steps"):
        return f"{digits(value)} {name if value != 1 else name[:-1]}"
    return f"{name}{' ' if name == 'tolerance' else ' = '}{digits(value)}"


def levels(judged: Judged, climbed: Climbed, quantity: str, wanted: Sequence[float]) -> str:
    """The cheapest rung for each of some errors, falling: 1 % takes 32 points (14 ms), 0.1 % takes ..."""
    if (why := unsolved(climbed, quantity)) is not None:
        return why
    own = judged.known[quantity].relative_error
    told = [level for level in wanted if level >= own]
    reached = [(level, climbed.reaching(quantity, level)) for level in told]
    said = []
    for k, group in groupby((pair for pair in reached if pair[1] is not None), key=lambda pair: pair[1]):
        shares = [share(level) for level, _ in group]
        said.append(f"{' and '.join(shares)} take{'s' if len(shares) == 1 else ''} {rung(climbed, k)}")
    missed = [level for level, k in reached if k is None]
    if missed:
        said.append(f"{share(missed[0])} is reached by no rung, the best has {_best(climbed, quantity)}")
    elif len(told) < len(wanted):
        said.append(
            f"{share(wanted[len(told)])} cannot be told, since the reference is only known to {share(own)}"
        )
    return ", ".join(said)


def rung(climbed: Climbed, k: int) -> str:
    """A setting and its time."""
    ladder = climbed.ladder
    return f"{setting(ladder.setting, ladder.values[k])} ({seconds(climbed.processor[k])})"


def loosest(climbed: Climbed, quantity: str) -> int | None:
    """The cheapest rung from which on errors are as small as on the last, ALIKE; None where that one failed."""
    return climbed.reaching(quantity, ALIKE * climbed.errors[quantity][-1])


def enough(climbed: Climbed, quantity: str) -> str:
    """From which rung on nothing is gained."""
    if (why := unsolved(climbed, quantity)) is not None:
        return why
    k, ladder = loosest(climbed, quantity), climbed.ladder
    last = setting(ladder.setting, ladder.values[-1])
    if k is None:
        return f"with {last} it was not solved, so that what is enough cannot be told"
    if k == len(ladder.values) - 1:
        return f"up to {last} ({seconds(climbed.processor[-1])}) every rung gains"
    least = share(climbed.errors[quantity][-1])
    return f"{rung(climbed, k)} will do: {least} is left with {last} too"


def order(judged: Judged, climbed: Climbed, quantity: str) -> str:
    """How the error falls."""
    found = judged.order(climbed, quantity)
    if not isfinite(found.order):
        return "too few rungs show an error of their own to tell its order"
    if found.order <= 0:
        return f"the error does not fall with the {climbed.ladder.setting}"
    return f"the error falls as the power {found.order:.1f} of the {climbed.ladder.setting}"


def unsolved(climbed: Climbed, quantity: str) -> str | None:
    """Why there is no error at all, None where there is one."""
    if np.isfinite(climbed.errors[quantity]).any():
        return None
    reasons = [reason for reason in climbed.reasons if reason is not None]
    return f"no rung was solved ({reasons[0]})" if reasons else "the reference was not solved"


def failures(found: Sequence[Judged]) -> str:
    """A sentence on every solve that failed, or nothing."""
    failed = [
        f"{judged.contest.title}, {climbed.ladder.label}, "
        f"{setting(climbed.ladder.setting, climbed.ladder.values[k])}: {reason}"
        for judged in found
        for climbed in judged.climbed
        for k, reason in enumerate(climbed.reasons)
        if reason is not None
    ]
    return f" Not solved: {'; '.join(failed)}." if failed else ""


def _best(climbed, quantity):
    errors = climbed.errors[quantity]
    k = int(np.nanargmin(errors))
    return f"{share(errors[k])} with {rung(climbed, k)}"
