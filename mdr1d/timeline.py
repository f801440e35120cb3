"""A program cut into steps: short ones after each turn, and while the indenter slides, none beyond a pixel."""

from dataclasses import dataclass

import numpy as np

from scene import Program, SolveError

MOST = 10**6
LEAST = 20  # steps of a stage
ROUNDING = 1e-9  # of a pixel, or of a step


@dataclass(frozen=True)
class Timeline:
    """Steps in time; during each the indenter stays between the same nodes of its profile.

    times : at which steps begin and end (N + 1,) [s]
    passed : whole pixels slid before each step (N,)
    begin, end : of a pixel slid beyond those at both ends of each step (N,), 0 to 1
    """

    times: np.ndarray
    passed: np.ndarray
    begin: np.ndarray
    end: np.ndarray


def timeline(program: Program, pixel: float, steps: int) -> Timeline:
    """Cut a program into about so many steps, shared out by duration, LEAST to a stage at least.

    In a stage they lengthen from its start in proportion, t_k = duration (k/n)^2: what follows a turn is quick at
    first. Where the indenter slides, steps end as it passes whole pixels [m] too. Raises SolveError for too many.
    """
    count = steps + LEAST * len(program.stages) + program.length / pixel
    if not count <= MOST:
        raise SolveError(
            f"the program takes {count:.2g} steps on pixels of {pixel:g} m, more than {MOST}: "
            f"slide a shorter path, take a larger extent or fewer points, or fewer steps than {steps}"
        )
    times, places = [np.zeros(1)], [np.zeros(1)]
    for stage in program.stages:
        slid, length = places[-1][-1], stage.speed * stage.duration / pixel
        nodes = np.arange(np.floor(slid) + 1, np.ceil(slid + length))
        nodes = nodes[(nodes > slid + ROUNDING) & (nodes < slid + length - ROUNDING)]
        number = max(LEAST, round(steps * stage.duration / program.duration))
        bounds = number * np.sqrt([0.0, *(nodes - slid) / (length or 1.0), 1.0])
        parts = np.ceil(np.diff(bounds) - ROUNDING)
        ends = np.interp(np.arange(1, parts.sum() + 1), np.append(0, np.cumsum(parts)), bounds)
        shares = (ends / number) ** 2
        times.append(times[-1][-1] + stage.duration * shares)
        # Not the path at those times: late in a program a short step is known less well than its path.
        place = slid + length * shares
        places.append(np.where(np.abs(place - np.rint(place)) < ROUNDING, np.rint(place), place))
    if not np.all(np.diff(np.concatenate(times)) > 0):
        raise SolveError(
            f"durations of the stages, from {min(stage.duration for stage in program.stages):g} to "
            f"{program.duration:g} s in all, differ by more than rounding allows: steps of the shortest are lost"
        )
    place = np.concatenate(places)
    passed = np.floor(place[:-1])
    return Timeline(np.concatenate(times), passed.astype(int), place[:-1] - passed, place[1:] - passed)
