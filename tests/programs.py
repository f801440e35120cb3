"""Programs of motion from their stages, and in a mirror."""

from dataclasses import replace

import numpy as np

from scene import Program, Stage


def program(*stages):
    return Program(stages=tuple(Stage(**stage) for stage in stages))


def slid(path, speed, **given):
    """A stage that slides so far, backwards where the path is negative."""
    return {"duration": abs(path / speed), "speed": np.copysign(speed, path), **given}


def mirrored(motion):
    return replace(motion, stages=tuple(replace(stage, speed=-stage.speed) for stage in motion.stages))
