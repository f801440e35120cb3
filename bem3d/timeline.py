"""A program cut into steps."""

import numpy as np

from scene import Program, SolveError

MOST = 10**6
SLIVER = 1e-9  # of a step: less is rounding


def timeline(program: Program, pixel: float, steps: int) -> np.ndarray:
    """Times [s] at which steps begin and end (N + 1,).

    `steps` are shared out by duration, one to a stage at least. Where the indenter slides they are a pixel [m] of
    path or a whole fraction of it; the last two of a stage share what is left. Raises SolveError for too many.
    """
    longest = [_longest(stage, pixel, program.duration / steps) for stage in program.stages]
    count = sum(stage.duration / step for stage, step in zip(program.stages, longest, strict=True))
    if count > MOST:
        raise SolveError(
            f"the program takes {count:.2g} steps on pixels of {pixel:g} m, more than {MOST}: "
            f"slide a shorter path, take a larger extent or fewer points, or fewer steps than {steps}"
        )
    times = [0.0]
    for stage, step in zip(program.stages, longest, strict=True):
        times.extend(times[-1] + _ends(stage.duration, step))
    return np.array(times)


def _longest(stage, pixel, share):
    """Step of a stage [s]."""
    share = stage.duration / max(1, round(stage.duration / share))
    if stage.speed == 0:
        return share
    crossing = pixel / stage.speed
    return crossing / np.ceil(crossing / share * (1 - SLIVER))


def _ends(duration, step):
    """Of the steps in a stage, from its start."""
    count = int(np.ceil(duration / step * (1 - SLIVER)))
    ends = step * np.arange(1, count + 1)
    ends[-1] = duration
    if count > 1:
        ends[-2] = (duration + step * (count - 2)) / 2
    return ends
