"""What the rungs of one ladder cost, and the powers that this follows."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .contest import Ladder
from .laws import Law, NoLaw, fit, fit_whole

# Points of a grid, or of a line, below which the memory of a solve drowns in that of the process.
MEMORY_FROM = 256**2
# Settings whose largest values are asked about; of the others, a power holds for all values or is none.
GROWING = ("points", "modes", "steps")
LABELS = {
    "processor": "processor time",
    "applications": "operator applications",
    "per_application": "time of an application",
    "per_transform": "time of an application, of n² log n",
    "memory": "memory",
}


@dataclass(frozen=True)
class Bill:
    """Costs of the rungs of a ladder, arrays (rungs,) with NaN where a solve failed.

    x : what costs are asked against
    processor, wall [s], memory [bytes], repeats, applications : see Rung
    products : with operator and preconditioners, as transform pairs; NaN where the solver has none
    limit : processor time of those products alone [s], NaN where it was not measured
    stored : bytes of an answer in a store, without fields
    reasons : why a solve failed, None where it did not
    """

    ladder: Ladder
    x: np.ndarray
    processor: np.ndarray
    wall: np.ndarray
    memory: np.ndarray
    repeats: np.ndarray
    applications: np.ndarray
    products: np.ndarray
    limit: np.ndarray
    stored: np.ndarray
    reasons: tuple[str | None, ...]

    @property
    def solver(self) -> str:
        """Name of the solver."""
        return self.ladder.rungs[0].solver.name

    @property
    def dimension(self) -> str:
        return "1D" if self.solver == "MDR" else "3D"

    @property
    def nodes(self) -> np.ndarray:
        """Points of each rung in all (rungs,)."""
        points = np.array([rung.solver.points for rung in self.ladder.rungs], np.float64)
        return points if self.solver == "MDR" else points**2

    @property
    def per_application(self) -> np.ndarray:
        """Processor time over operator applications [s]."""
        return self.processor / self.applications

    @property
    def over_limit(self) -> np.ndarray:
        """Processor time over that of the products alone."""
        return self.processor / self.limit

    @property
    def bytes_a_point(self) -> np.ndarray:
        """Memory over all points."""
        return self.memory / self.nodes

    @cached_property
    def laws(self) -> Mapping[str, Law | NoLaw]:
        """By the names of LABELS: costs against x, memory from MEMORY_FROM on; per_transform against n^2 log n."""
        enough, follows = self.nodes >= MEMORY_FROM, fit if self.ladder.setting in GROWING else fit_whole
        costs = ("processor", "applications", "per_application")
        found = {name: follows(self.x, getattr(self, name)) for name in costs}
        if self.dimension == "3D" and self.ladder.setting == "points":
            found["per_transform"] = follows(self.x**2 * np.log(self.x), self.per_application)
        return found | {"memory": follows(self.x[enough], self.memory[enough])}
