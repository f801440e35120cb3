"""Costs of the steps of one ladder, and the powers that they follow."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import xarray

from ...statistics.costs import Law, NoLaw, fit, fit_whole
from .convergence import DIMENSIONS

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
class CostFit:
    """Costs of the steps of a ladder, arrays (steps,) with NaN where a solve failed, and the powers they follow.

    name : of the ladder
    dataset : of its steps, see CostDiagram.datasets
    """

    name: str
    dataset: xarray.Dataset

    def __getattr__(self, name: str) -> np.ndarray:
        """A variable of the dataset by its name."""
        if name.startswith("_") or name not in self.dataset:
            raise AttributeError(name)
        return self.dataset[name].values

    @property
    def solver(self) -> str:
        """Name of the solver."""
        return self.dataset.attrs["solver"]

    @property
    def dimension(self) -> str:
        """Dimensionality of the solver."""
        return DIMENSIONS[self.solver]

    @property
    def setting(self) -> str:
        """What costs are asked against."""
        return self.dataset.attrs["setting"]

    @property
    def title(self) -> str:
        """Dimensionality and label, for people."""
        label = self.dataset.attrs["title"]
        return label if self.dimension in label else f"{self.dimension} {label}"

    @property
    def nodes(self) -> np.ndarray:
        """Points of each step in all (steps,)."""
        points = self.points.astype(float)
        return points if self.solver == "MDR" else points**2

    @property
    def per_application(self) -> np.ndarray:
        """Processor time over operator applications [s]."""
        return self.processor / self.applications

    @property
    def limit(self) -> np.ndarray:
        """Processor time of the products by transforms alone [s], NaN where it was not measured."""
        plain = (self.transform_pairs - self.applications) * self.plain_product
        return self.applications * self.padded_product + plain

    @property
    def over_limit(self) -> np.ndarray:
        """Processor time over that of the products alone."""
        return self.processor / self.limit

    @cached_property
    def laws(self) -> Mapping[str, Law | NoLaw]:
        """Laws by the names of LABELS, against x: memory from MEMORY_FROM on, per_transform against n^2 log n."""
        enough, follows = self.nodes >= MEMORY_FROM, fit if self.setting in GROWING else fit_whole
        found = {name: follows(self.x, getattr(self, name)) for name in tuple(LABELS)[:3]}
        if self.dimension == "3D" and self.setting == "points":
            found["per_transform"] = follows(self.x**2 * np.log(self.x), self.per_application)
        return found | {"memory": follows(self.x[enough], self.memory[enough])}


def fits_of(node: xarray.DataTree) -> list[CostFit]:
    """Every ladder with its laws."""
    return [CostFit(name, child.to_dataset(inherit=False)) for name, child in node.children.items()]
