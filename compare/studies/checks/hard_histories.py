"""Hard cases of histories: marches without drift, separation and return, holds of ages."""

from functools import partial

import numpy as np

from .hardcase import by_dimension, each_of, equal, hard, line, space
from .law import apart, worst
from .ordinary import (
    DEPTH,
    KELVIN,
    LOAD,
    PACE,
    RADIUS,
    TIME,
    program,
    resting,
    sliding,
    stage,
)

PRESSED = stage(TIME, depth=DEPTH)
coarse_line, coarse_space = partial(line, points=400), partial(space, points=24)


@hard(
    "Forces of the last quarter are those before to 1e-4, of the ripple of pixels; friction is that of steady "
    "sliding within 0.02, of 400 points. The solver refuses what does not balance work, energy lost and stored.",
    lambda size: coarse_line(size, extent=2.4 * RADIUS, steps=size.steps),
)
def many_steps_1d():
    """Up to 1e5 steps of sliding: rounding and forgotten memory would add up."""
    scene = program(PRESSED, stage(12 * RADIUS / PACE, speed=PACE))

    def drift(answer):
        eighths = (np.array_split(answer.result.fields[name], 8) for name in ("normal_force", "friction_force"))
        return worst(apart(late[-1].mean(), late[-4].mean()) for late in eighths)

    yield each_of(drift, 1e-4, scene)
    yield from equal(0.02, (scene, sliding(1.0)), of=("friction_force",))


@hard(
    "Friction spreads by at most 0.02 in the last third and is that of steady sliding within 0.05, of 24 points.",
    lambda size: coarse_space(size, steps=size.march),
)
def many_steps_3d():
    """Thousands of steps on a small grid."""
    scene = program(PRESSED, stage(8 * RADIUS / (0.1 * PACE), speed=0.1 * PACE))

    def spread(answer):
        friction = np.array_split(answer.result.fields["friction_force"], 3)[-1]
        return np.ptp(friction) / friction.mean()

    yield each_of(spread, 0.02, scene)
    yield from equal(0.05, (scene, sliding(0.1)), of=("friction_force",))


@hard(
    "The indenter never rises, and ends at the relaxed depth: within 1e-4 in 1D and 0.02 in 3D, of the grids.",
    lambda size: coarse_line(size, steps=size.steps // 4),
    partial(coarse_space, steps=40),
)
def held_for_ages():
    """A load put on in a thousandth of the relaxation time and held for a billion of them."""
    scene = program(stage(1e-3 * TIME, load=LOAD), stage(1e9 * TIME))
    yield from equal(by_dimension(1e-4, 0.02), (scene, {"depth": DEPTH}))
    yield each_of(lambda answer: -np.diff(answer.result.fields["depth"]).min() / DEPTH, 1e-6, scene)


@hard(
    "Friction falls to a hundredth of its greatest at least.",
    partial(coarse_line, steps=200),
    partial(coarse_space, steps=60),
)
def stop():
    """Sliding that ends at once, and a rest of a thousand relaxation times."""
    scene = program(PRESSED, stage(2 * TIME, speed=PACE), stage(1e3 * TIME))

    def left(answer):
        friction = answer.result.fields["friction_force"]
        return abs(friction[-1]) / friction.max()

    yield each_of(left, 0.01, scene)


@hard("Force at rest within 1e-4, of the sums over pixels.", line, partial(coarse_space, steps=20))
def brief_and_long_stages():
    """A stage of 1e-15 s, and one of 1e15 s after it; of a dashpot one of a millionth of its relaxation time."""
    march = program(PRESSED, stage(1e-6 * TIME), stage(50 * TIME), elastomer=KELVIN)
    yield from equal(1e-4, (program(stage(1e-15, depth=DEPTH), stage(1e15)), resting()), (march, resting()))
