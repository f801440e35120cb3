"""A program cut into steps."""

from math import ceil

import numpy as np

from scene import Program
from scene.steps import check_count, check_told_apart

RAMP = 20  # steps at least while what is prescribed changes: in one, the surface would be thrown off the indenter
PERIOD = 40  # steps at least in a period of what oscillates: a cosine through them is right to 0.1 %
GROWTH = 1.25  # of a step over the one before: what follows a ramp is as quick as the ramp was
SLIVER = 1e-9  # of a step: less is rounding


def timeline(program: Program, pixel: float, steps: int) -> np.ndarray:
    """Times [s] at which steps begin and end (N + 1,).

    `steps` are shared out by duration, one to a stage at least, RAMP to a stage that loads or unloads, PERIOD to
    a period where it oscillates; after a shorter step they grow by GROWTH. Where the indenter slides, either way,
    they are a pixel [m] of path at most, or a whole fraction of it. The last two of a stage share what is left.
    Raises SolveError for too many, or too unlike ones.
    """
    longest = _longest(program, pixel, program.duration / steps)
    check_count(_asked(program, pixel, steps, longest), pixel)
    times, before = [0.0], np.inf
    for stage, step in zip(program.stages, longest, strict=True):
        ends = _ends(stage.duration, step, before)
        times.extend(times[-1] + ends)
        before = step
    check_told_apart(np.array(times), program)
    return np.array(times)


def in_a_pixel(program: Program, pixel: float, steps: int) -> int:
    """Steps in which a stage passes a pixel, most of all stages; 1 where none moves."""
    longest = _longest(program, pixel, program.duration / steps)
    crossings = [
        pixel / abs(stage.speed) / step for stage, step in zip(program.stages, longest, strict=True) if stage.speed
    ]
    return max(1, round(max(crossings, default=1)))


def _asked(program, pixel, steps, longest):
    """Steps of all stages, by what asks for them."""
    asked = dict.fromkeys(("steps", "stages", "path", "oscillation"), 0.0)
    for stage, step in zip(program.stages, longest, strict=True):
        needs = {
            "steps": steps * stage.duration / program.duration,
            "stages": RAMP,
            "path": abs(stage.speed) * stage.duration / pixel,
            "oscillation": PERIOD * stage.oscillation.periods if stage.oscillation else 0.0,
        }
        asked[max(needs, key=needs.get)] += stage.duration / step
    return asked


def _longest(program, pixel, share):
    """Step of each stage [s]."""
    prescribed, steps = 0.0, []
    for stage in program.stages:
        target = stage.given.get(program.pressed_by, prescribed)
        least = 1 if target == prescribed else RAMP
        if stage.oscillation is not None:
            least = max(RAMP, ceil(PERIOD * stage.oscillation.periods))
        step = stage.duration / max(least, round(stage.duration / share))
        if stage.speed != 0:
            crossing = pixel / abs(stage.speed)
            step = crossing / np.ceil(crossing / step * (1 - SLIVER))
        prescribed = target if stage.oscillation is None else target + stage.oscillation.last
        steps.append(step)
    return steps


def _ends(duration, step, before):
    """Ends of the steps in a stage, from its start: growing after a step `before` it, then equal."""
    growths = ceil(np.log(max(step / before, 1.0)) / np.log(GROWTH))
    ends = np.cumsum(before * GROWTH ** np.arange(1, growths)) if growths else np.empty(0)
    ends = ends[ends < duration - step]
    if len(ends):  # in whole steps together: a sliding indenter is then over the pixels as without them
        ends *= ceil(ends[-1] / step) * step / ends[-1]
        ends = ends[ends < duration - step]
    start = ends[-1] if len(ends) else 0.0
    count = max(1, int(np.ceil((duration - start) / step * (1 - SLIVER))))
    alike = start + step * np.arange(1, count + 1)
    alike[-1] = duration
    if count > 1:
        alike[-2] = (duration + start + step * (count - 2)) / 2
    return np.concatenate([ends, alike])
