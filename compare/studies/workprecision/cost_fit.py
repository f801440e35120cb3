"""Costs of the steps of one ladder, and the powers that they follow."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
import xarray
from pandas import DataFrame

from ...statistics.costs import Law, NoLaw, fit, fit_whole
from .convergence import DIMENSIONS

# Points of a grid, or of a line, below which the memory of a solve drowns in that of the process.
MEMORY_FROM = 256**2
# Settings whose largest values are asked about; of the others, a power holds for all values or is none.
GROWING = ("points", "modes", "steps")
LABELS = {
    "processor": "processor time",
    "operator_applications": "operator applications",
    "per_application": "time of an application",
    "per_transform": "time of an application, of n² log n",
    "memory": "memory",
}
# Columns of the table of steps.
STEPS = (
    *("ladder", "label", "title", "solver", "dimension", "along", "x"),
    *("points", "steps", "tolerance", "precision"),
    *("processor", "wall", "repeats", "memory", "bytes_a_point", "operator_applications", "transform_pairs"),
    *("seconds_an_application", "over_limit", "stored_bytes", "status", "reason"),
)


@dataclass(frozen=True)
class CostFit:
    """Costs of the steps of a ladder, and the powers that they follow.

    name : of the ladder; title : dimensionality and label, for people
    setting : what costs are asked against
    steps : a row a step with the columns STEPS and its nodes, the points of its grid in all; NaN where a solve
        failed; over_limit is the processor time over that of the products by transforms alone
    """

    name: str
    title: str
    dimension: str
    setting: str
    steps: DataFrame

    @classmethod
    def of(cls, name: str, dataset: xarray.Dataset) -> Self:
        """Costs of the Dataset of a ladder."""
        about, rows = dataset.attrs, dataset.to_dataframe()
        dimension, label = DIMENSIONS[about["solver"]], about["title"]
        title = label if dimension in label else f"{dimension} {label}"
        nodes = rows["points"].astype(float) if dimension == "1D" else rows["points"].astype(float) ** 2
        plain = (rows["transform_pairs"] - rows["operator_applications"]) * rows["plain_product"]
        steps = rows.assign(
            ladder=name,
            label=label,
            title=title,
            solver=about["solver"],
            dimension=dimension,
            along=about["setting"],
            nodes=nodes,
            bytes_a_point=rows["memory"] / nodes,
            seconds_an_application=rows["processor"] / rows["operator_applications"],
            over_limit=rows["processor"] / (rows["operator_applications"] * rows["padded_product"] + plain),
        )
        return cls(name, title, dimension, about["setting"], steps)

    def known(self, column: str, least: float = 0.0) -> np.ndarray:
        """Numbers of a column (steps,) of the steps that have as many nodes."""
        return self.steps.loc[self.steps["nodes"] >= least, column].to_numpy()

    @cached_property
    def laws(self) -> Mapping[str, Law | NoLaw]:
        """Laws by the names of LABELS, against x: memory from MEMORY_FROM on, per_transform against n^2 log n."""
        x, each = self.known("x"), self.known("seconds_an_application")
        follows = fit if self.setting in GROWING else fit_whole
        found = {
            "processor": follows(x, self.known("processor")),
            "operator_applications": follows(x, self.known("operator_applications")),
            "per_application": follows(x, each),
        }
        if self.dimension == "3D" and self.setting == "points":
            found["per_transform"] = follows(x**2 * np.log(x), each)
        return found | {"memory": follows(self.known("x", MEMORY_FROM), self.known("memory", MEMORY_FROM))}


def fits_of(node: xarray.DataTree) -> list[CostFit]:
    """Every ladder with its laws."""
    return [CostFit.of(name, child.to_dataset(inherit=False)) for name, child in node.children.items()]
