"""What the laws of the paper presuppose, at every point of a figure: ratios, and which conditions hold."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from scene import Regime

# A model that is linear and knows no length has the same contact whatever the scale of heights, slopes and loads:
# where slopes are not small the equations describe no body, but what they say of one another stands.
OF_NO_SCALE = "small slopes"


@dataclass(frozen=True)
class Conditions:
    """Points of a figure against the conditions of its law, arrays of one shape.

    ratios : by name, those of Regime and others
    flags : which conditions hold, by name
    """

    ratios: Mapping[str, np.ndarray]
    flags: Mapping[str, np.ndarray]

    @classmethod
    def of(cls, regime: Regime, shape: tuple[int, ...]) -> "Conditions":
        """Those of a regime, broadcast to the points."""
        parts = vars(regime), regime.flags
        return cls(*({name: np.broadcast_to(each, shape) for name, each in part.items()} for part in parts))

    def joined(self, name: str, ratio: np.ndarray, condition: str, flag: np.ndarray) -> "Conditions":
        """These and one more, with the name of its ratio and its own."""
        return Conditions({**self.ratios, name: ratio}, {condition: flag, **self.flags})

    @property
    def holds(self) -> np.ndarray:
        """Where all hold but that of small slopes, without which the model itself still is one."""
        return np.logical_and.reduce([flag for name, flag in self.flags.items() if name != OF_NO_SCALE])

    @property
    def columns(self) -> dict[str, np.ndarray]:
        """For a table: the ratios, each flag, and whether all hold that make a point a filled one."""
        flags = {f"holds: {name}": flag.astype(int) for name, flag in self.flags.items()}
        return {**self.ratios, **flags, "holds": self.holds.astype(int)}

    @property
    def broken(self) -> dict[str, int]:
        """At how many points a condition breaks, of those that break anywhere."""
        counts = {name: int(np.sum(~flag)) for name, flag in self.flags.items()}
        return {name: count for name, count in counts.items() if count}

    @property
    def words(self) -> str:
        """What breaks, and where, for a caption."""
        size = self.holds.size
        said = [f"{name} ({'everywhere' if count == size else count})" for name, count in self.broken.items()]
        return f"Conditions that break, of {size} points: {', '.join(said)}." if said else "All conditions hold."

    def at(self, where) -> "Conditions":
        """Of some of the points, by an index."""
        parts = self.ratios, self.flags
        return Conditions(*({name: each[where] for name, each in part.items()} for part in parts))


def gathered(parts: Sequence[Conditions]) -> Conditions:
    """Of the points of several, one at least, in one row."""
    first = parts[0]
    return Conditions(
        {name: np.concatenate([part.ratios[name] for part in parts]) for name in first.ratios},
        {name: np.concatenate([part.flags[name] for part in parts]) for name in first.flags},
    )
