"""Steps in which a solver follows a program: how many are too many, and those at which it keeps its contact."""

from collections.abc import Mapping
from typing import Any

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


def nearest(times: np.ndarray, duration: float, count: int) -> np.ndarray:
    """Steps nearest to `count` instants that are equally spaced, the last of them at the end; each step once.

    times : of the steps (S,) [s], rising; duration : of the program [s]
    """
    wanted = duration * np.arange(1, count + 1) / max(count, 1)
    after = np.clip(np.searchsorted(times, wanted), 1, max(len(times) - 1, 1))
    closer = wanted - times[after - 1] <= times[np.minimum(after, len(times) - 1)] - wanted
    return np.unique(np.minimum(after - closer, len(times) - 1))


class Frames:
    """Numbers and arrays kept of some steps of a march, by name; none where no instants are asked for."""

    def __init__(self, times: np.ndarray, duration: float, count: int):
        """Arguments as for `nearest`."""
        self._steps = frozenset(nearest(times, duration, count).tolist())
        self._kept: dict[str, list[Any]] = {}

    def __contains__(self, step: int) -> bool:
        """Whether anything of a step is to be kept."""
        return step in self._steps

    def keep(self, **values: Any) -> None:
        """Keep copies of numbers and arrays, the same names in every step."""
        for name, value in values.items():
            self._kept.setdefault(name, []).append(np.array(value))

    def handed_over(self) -> dict[str, np.ndarray]:
        """All that was kept, stacked along the instants (F, ...), as fields of a result: frame_ and the name."""
        return {f"frame_{name}": np.stack(self._kept.pop(name)) for name in list(self._kept)}
