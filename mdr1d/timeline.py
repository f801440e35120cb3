"""A program cut into steps: short ones after each turn, and while the indenter slides, none beyond a pixel."""

from dataclasses import dataclass
from math import ceil

import numpy as np

from scene import Program
from scene.steps import check_count, check_told_apart

LEAST = 20  # steps of a stage
# Steps at least in a period of what oscillates, where they are longest. A dashpot feels the mean rate of a step
# at its end: half a step late, 0.016 rad.
PERIOD = 200
ROUNDING = 1e-9  # of a pixel, or of a step


@dataclass(frozen=True)
class Timeline:
    """Steps in time; during each the indenter stays between the same nodes of its profile.

    times : at which steps begin and end (N + 1,) [s]
    passed : whole pixels forwards of where it began, in each step (N,)
    begin, end : of a pixel beyond those at both ends of each step (N,), 0 to 1; falling where it goes backwards
    """

    times: np.ndarray
    passed: np.ndarray
    begin: np.ndarray
    end: np.ndarray


def timeline(program: Program, pixel: float, steps: int) -> Timeline:
    """Cut a program into about `steps` steps, shared out by duration, LEAST to a stage at least.

    In a stage they lengthen from its start in proportion, t_k = duration (k/n)^2: what follows a turn is quick at
    first. Where it oscillates, the last and longest are PERIOD to a period. Where the indenter slides, steps end
    as it passes whole pixels [m] too. Raises SolveError for too many.
    """
    swings = [2 * PERIOD * stage.oscillation.periods if stage.oscillation else 0 for stage in program.stages]
    path = program.length / pixel
    check_count({"steps": steps, "stages": LEAST * len(swings), "path": path, "oscillation": sum(swings)}, pixel)
    times, places = [np.zeros(1)], [np.zeros(1)]
    for stage, swing in zip(program.stages, swings, strict=True):
        slid, length = places[-1][-1], stage.speed * stage.duration / pixel
        nodes = _between(slid, slid + length)
        number = max(LEAST, round(steps * stage.duration / program.duration), ceil(swing))
        bounds = number * np.sqrt([0.0, *(nodes - slid) / (length or 1.0), 1.0])
        parts = np.ceil(np.diff(bounds) - ROUNDING)
        ends = np.interp(np.arange(1, parts.sum() + 1), np.append(0, np.cumsum(parts)), bounds)
        shares = (ends / number) ** 2
        times.append(times[-1][-1] + stage.duration * shares)
        # Not the path at those times: late in a program a short step is known less well than its path.
        place = slid + length * shares
        places.append(np.where(np.abs(place - np.rint(place)) < ROUNDING, np.rint(place), place))
    check_told_apart(np.concatenate(times), program)
    place = np.concatenate(places)
    passed = np.floor(np.minimum(place[:-1], place[1:]))
    return Timeline(np.concatenate(times), passed.astype(int), place[:-1] - passed, place[1:] - passed)


def _between(start, end):
    """Whole pixels that are passed on the way from one place to another, in their order."""
    if end < start:
        return -_between(-start, -end)
    nodes = np.arange(np.floor(start) + 1, np.ceil(end))
    return nodes[(nodes > start + ROUNDING) & (nodes < end - ROUNDING)]
