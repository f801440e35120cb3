"""Steps in which a solver follows a program: how many are too many, and when they are lost to rounding."""

from collections.abc import Mapping

import numpy as np

from .motion import Program
from .protocol import SolveError

MOST = 10**6
REMEDIES = {
    "path": "slide a shorter path, take a larger extent or fewer points",
    "oscillation": "oscillate for fewer periods",
    "stages": "give fewer stages",
    "steps": "take fewer steps",
}


def check_count(asked: Mapping[str, float], pixel: float) -> None:
    """Raise SolveError for too many steps, naming what asks for most of them.

    asked : steps by what asks for them, one of REMEDIES
    pixel : a path is cut into at least [m]
    """
    count = sum(asked.values())
    if not count <= MOST:
        most = max(asked, key=lambda name: asked[name])
        raise SolveError(
            f"the program takes {count:.2g} steps on pixels of {pixel:g} m, more than {MOST}, "
            f"{asked[most]:.2g} of them for its {most}: {REMEDIES[most]}"
        )


def check_told_apart(times: np.ndarray, program: Program) -> None:
    """Raise SolveError where steps between the times [s] have no duration left."""
    if not np.all(np.diff(times) > 0):
        raise SolveError(
            f"durations of the stages, from {min(stage.duration for stage in program.stages):g} to "
            f"{program.duration:g} s in all, differ by more than rounding allows: steps of the shortest are lost"
        )
