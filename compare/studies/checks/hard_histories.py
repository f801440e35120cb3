"""Hard cases of histories: marches without drift, separation and return, holds of ages."""

from functools import partial

import numpy as np

from ...models.exact import indentation
from .hardcase import by_dimension, each_of, equal, hard, line, space, square
from .law import Answer, apart, worst
from .ordinary import (
    DEPTH,
    KELVIN,
    LOAD,
    PACE,
    RADIUS,
    ROUGH,
    SOLID,
    SPHERE,
    TIME,
    program,
    resting,
    sliding,
    stage,
)

PRESSED, LOADED = stage(TIME, depth=DEPTH), stage(TIME, load=LOAD)
COARSE = partial(line, points=400), partial(space, points=24)


def _stepping(steps_1d, steps_3d):
    """Both solvers on grids on which long histories end, of so many steps."""
    return [partial(build, steps=steps) for build, steps in zip(COARSE, (steps_1d, steps_3d), strict=True)]


def _unbalanced(answer: Answer) -> float:
    """Work is what was lost and what is stored, at every step."""
    work, lost, stored = (answer.fields[name] for name in ("work", "dissipated", "stored"))
    return float(np.abs(work - lost - stored).max() / np.abs(work).max())


def _pull(answer: Answer) -> float:
    """No force is below zero, without any allowance."""
    return max(-answer.fields["normal_force"].min(), 0.0)


@hard(
    "Forces of the last quarter are those before to 1e-4, of the ripple of pixels; friction is that of steady "
    "sliding within 0.02, of 400 points; work is energy lost and stored to 1e-10.",
    lambda size: line(size, points=400, extent=2.4 * RADIUS, steps=size.steps),
)
def many_steps_1d():
    """Up to 1e5 steps of sliding: rounding and forgotten memory would add up."""
    scene = program(PRESSED, stage(12 * RADIUS / PACE, speed=PACE))

    def drift(answer):
        quarters = (np.array_split(answer.fields[name], 8) for name in ("normal_force", "friction_force"))
        return worst(apart(float(late[-1].mean()), float(late[-4].mean())) for late in quarters)

    yield each_of(drift, 1e-4, scene)
    yield equal(0.02, (scene, sliding(1.0)), of=("friction_force",))
    yield each_of(_unbalanced, 1e-10, scene)
    yield each_of(lambda answer: answer.result.settings["steps"] / answer["time_steps"], 1.0, scene)


@hard(
    "Friction spreads by at most 0.02 in the last third and is that of steady sliding within 0.05, of 24 points; "
    "every step is solved to the tolerance.",
    lambda size: square(size, points=24, extent=3.2 * RADIUS, steps=size.march),
)
def many_steps_3d():
    """Thousands of steps on a small grid."""
    scene = program(PRESSED, stage(8 * RADIUS / (0.1 * PACE), speed=0.1 * PACE))

    def spread(answer):
        friction = np.array_split(answer.fields["friction_force"], 3)[-1]
        return float(np.ptp(friction) / friction.mean())

    yield each_of(spread, 0.02, scene)
    yield equal(0.05, (scene, sliding(0.1)), of=("friction_force",))
    yield each_of(lambda answer: answer["residual"] / answer.result.settings["tolerance"], 1.0, scene)


@hard(
    "The indenter never rises, and ends at the relaxed depth: within 1e-4 in 1D and 0.02 in 3D, of the grids.",
    lambda size: COARSE[0](size, steps=size.steps // 4),
    partial(COARSE[1], steps=40),
)
def held_for_ages():
    """A load put on in a thousandth of the relaxation time and held for a billion of them."""
    scene = program(stage(1e-3 * TIME, load=LOAD), stage(1e9 * TIME))
    yield equal(by_dimension(1e-4, 0.02), (scene, {"depth": DEPTH}))
    yield each_of(lambda answer: max(-np.diff(answer.fields["depth"]).min() / DEPTH, 0.0), 1e-6, scene)


@hard(
    "Work is energy lost and stored to 1e-10; lost energy never comes back; no pull.",
    partial(line, points=500, extent=4 * RADIUS, steps=40),
)
def forty_cycles():
    """A rough body lifted to a fifth and pressed in again forty times, sliding half of the time."""
    cycle = stage(TIME / 5, depth=DEPTH / 5, speed=PACE / 10), stage(TIME / 5, depth=DEPTH)
    scene = program(PRESSED, *cycle * 40, roughness=ROUGH)
    yield each_of(_unbalanced, 1e-10, scene)
    yield each_of(_pull, 0.0, scene)
    lost = "dissipated"
    yield each_of(
        lambda answer: max(-np.diff(answer.fields[lost]).min() / answer.fields[lost][-1], 0.0), 1e-12, scene
    )


@hard("Friction falls to a hundredth of its greatest at least.", *_stepping(200, 60))
def stop():
    """Sliding that ends at once, and a rest of a thousand relaxation times."""
    scene = program(PRESSED, stage(2 * TIME, speed=PACE), stage(1e3 * TIME))
    friction = "friction_force"
    yield each_of(lambda answer: abs(answer.fields[friction][-1]) / answer.fields[friction].max(), 0.01, scene)


@hard(
    "Force at rest in the end, within 1e-4; work is energy lost and stored to 1e-10.",
    partial(line, points=1000, steps=200),
)
def dashpot_march():
    """A Kelvin body held after a ramp: its force jumps within a millionth of the relaxation time."""
    scene = program(PRESSED, stage(1e-6 * TIME), stage(50 * TIME), elastomer=KELVIN)
    yield equal(1e-4, (scene, resting()))
    yield each_of(_unbalanced, 1e-10, scene)


@hard(
    "Force at rest within 1e-4, of the sums over pixels.",
    line,
    partial(space, points=24, steps=20),
)
def brief_and_long_stages():
    """A stage of 1e-15 s, and one of 1e15 s after it."""
    yield equal(1e-4, (program(stage(1e-15, depth=DEPTH), stage(1e15)), resting()))


@hard("Force of Ting within 1e-3 of the grid in 1D; a load is met to 1e-9.", line)
def history_of_1e_300_s():
    """Stages of 1e-300 s."""
    times, depths = (0.0, 1e-300, 2e-300), (0.0, DEPTH, DEPTH / 2)
    (known,), _ = indentation.force_of_depth(SPHERE, SOLID, times, depths, 2e-300)
    back = program(stage(1e-300, depth=DEPTH), stage(1e-300, depth=DEPTH / 2))
    yield equal(1e-3, (back, {"normal_force": float(known)}))
    yield equal(1e-9, (program(stage(1e-300, load=LOAD)), {"normal_force": LOAD}))
