"""The study of the command `paper`: what is solved for the figures of the paper, and its page."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
import xarray
from pandas import DataFrame

from ...report.page import Block, Findings, Text
from ...solving import curve
from ...solving.cost import Cost
from ...solving.curve import FAILED, Curve
from ...solving.suggest import known
from ...solving.task import Batch, Outcome, Task
from ...solving.vocabulary import attributes
from ..study import Judgement, Study
from . import figures, law, parameter_studies, parameters
from .shifts import RUBBERS

SIZES = {"quick": 20, "standard": 50, "full": parameters.PROFILES}
SLOW = "parameter-studies"
ABOUT = (
    "Popov, Voll, Li, Chai and Popov (Sci. Rep. 4, 3750, 2014) derive the friction of a rough cone and a rough "
    "sphere on an elastomer from a one-dimensional foundation. This page simulates their figures and parameter "
    "studies again, in the one-dimensional model alone, and judges each claim. μ̃ is the coefficient of "
    "friction over √2 times the rms slope of the roughness, ξ is the variable of Eq. 18, and Eq. 19 "
    "is μ̃ = (1 + ξ^(−α))^(−1/α)."
    "\n\nIntervals are of 95 %, over rough profiles. The error of the grid is exactly zero: the body is the "
    "straight line between its nodes, the flow past it is solved without discretisation, and the pixel is by "
    "definition the cut-off of the roughness, one of the parameters of Fig. 3."
    "\n\nEq. 23 shifts curves along the load by v^(−3β/2) for a sphere where the loss goes as ω^β. It takes the "
    "macroscopic modulus |G(v/a)| for constant. The friction of the smooth body grows with the load while "
    "friction by the roughness falls, so no shift brings their sum onto one curve. For straight parallel lines a "
    "horizontal "
    "shift does what a vertical one does, so collapse and exponent are undecided there."
    "\n\nDepartures from the paper:"
    f"\n- What Fig. 3 does not state is as in Fig. 4, the speed is {parameters.LOW_SPEED * 1e3:g} mm/s, and θ is "
    "the angle of the body. Values are spaced geometrically, angles evenly; spacings are moved by at most 2 %."
    "\n- The rms slope is taken from finite differences. With the spectral one, which is larger, the plateau is "
    "0.86."
    "\n- The friction of Figs. 5 to 7 was not published. It is simulated, on the sphere of Fig. 4 with "
    f"H = {parameters.LOSS_ROUGH.hurst:g}, h₀ = 20 µm and G(ω) = G₀ (1 + (iωτ)^β)."
    "\n\nWith these parameters the rms slope is about 2, where no linear theory of contact applies. The figures "
    "are about the model, as published."
)


@dataclass(frozen=True)
class Paper(Study):
    """The paper simulated again in one dimension.

    profiles : averaged at most, 3 or more
    values : of each parameter study of Fig. 3; 20 as published
    """

    profiles: int = parameters.PROFILES
    values: int = 20

    command, title, about = "paper", "The paper in one dimension", ABOUT

    @classmethod
    def of(cls, size: str = "full") -> "Paper":
        """The study at a size. Raises InvalidInput."""
        known("size", size, SIZES)
        return cls(SIZES[size])

    @property
    def inputs(self) -> Mapping[str, Any]:
        """Number of profiles."""
        return {"profiles": self.profiles}

    def grids(self) -> Mapping[str, Curve]:
        """Contacts of Fig. 1, of Fig. 4, and of Figs. 5 to 7."""
        return self._grids

    @cached_property
    def _grids(self):
        # kept, as they keep their scenes
        found = {f"contact-{shape}": contact_grid(shape) for shape in parameters.SHAPES}
        found |= {f"law-{shape}": law.curve(shape, self.profiles) for shape in parameters.SHAPES}
        for rubber in RUBBERS:
            found |= rubber.grids(self.profiles)
        return found

    def cost(self) -> Cost:
        """Cost of the parameter grids and of Fig. 3."""
        return super().cost() + Cost.of(self._slow)

    def batches(self) -> Sequence[Batch]:
        """Everything that is solved: Fig. 3 and the parameter grids."""
        return (Batch([*self._slow, *curve.tasks_of(self.grids())]),)

    @property
    def _slow(self):
        return parameter_studies.tasks(self.values, self.profiles)

    def answers(self, outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
        """Everything that was solved: a Dataset for each figure, shape and rubber."""
        tree = curve.tree(self.grids(), outcomes)
        tree[SLOW] = xarray.DataTree(parameter_studies.dataset(self._slow, outcomes))
        for shape in parameters.SHAPES:
            name = f"contact-{shape}"
            kept = self.grids()[name].fields(outcomes).get("MDR", {})
            fields = {
                field: ("node", np.asarray(kept[field], float), attributes(field))
                for field in ("x", "profile", "displacement", "contact")
                if kept
            }
            tree[name] = xarray.DataTree(tree.children[name].to_dataset(inherit=False).assign(fields))
        return tree

    def judge(self, answers: xarray.DataTree) -> Judgement:
        """Figures of the paper and its claims. Raises SolveError where all of a figure is missing."""
        slow = parameter_studies.slow_friction(self.values, _dataset(answers, SLOW))
        cone, sphere = (law.law(shape, _dataset(answers, f"law-{shape}")) for shape in parameters.SHAPES)
        found = [*law.of_low_speed(slow), *law.of_law(cone, sphere)]
        fits = DataFrame([{"shape": each.shape, **each.alpha.columns("alpha")} for each in (cone, sphere)])
        plots = [
            figures.plot_contacts(sections(answers)),
            figures.plot_studies(slow.points),
            figures.plot_law([cone.points, sphere.points], fits),
        ]
        for rubber in RUBBERS:
            collapses = rubber.collapses(*(_dataset(answers, name) for name in rubber.grids(self.profiles)))
            judged = [*rubber.findings(collapses)]
            found += judged
            plots.append(rubber.plot(collapses, judged))
        table = Findings(found, "Claims of the paper, with intervals of 95 % over rough profiles.")
        blocks: list[Block] = [*(each for each in plots if each), table]
        return Judgement(found, (), blocks, setting=[Text(ABOUT), Text(_solved(answers))])


def contact_grid(shape: str) -> Curve:
    """The one contact of Fig. 1 for a shape, with its fields."""
    scene, motion = parameters.contact(shape), parameters.CONTACT
    return replace(parameters.grid(scene, [motion.speed], [motion.greatest]), keeps_fields=True)


def sections(answers: xarray.DataTree) -> dict[str, DataFrame]:
    """Profile and surface of each contact of Fig. 1 that has an answer, by its shape."""
    found = {}
    for shape in parameters.SHAPES:
        at = _dataset(answers, f"contact-{shape}")
        if "node" in at.dims:
            indenter = at["profile"].values - at["depth_reached"].item()
            columns = {"x": at["x"].values, "indenter": indenter, "surface": -at["displacement"].values}
            found[shape] = DataFrame(columns | {"touching": at["contact"].values.astype(bool)})
    return found


def _dataset(answers, name):
    found = answers[name].to_dataset(inherit=False)
    return curve.of_model(found, "MDR") if "model" in found.dims else found


def _solved(answers):
    """Number of contacts that were solved, and what failed."""
    friction = _dataset(answers, SLOW)["friction_coefficient"]
    failed = int(friction.isnull().sum())
    failed += sum(int((node["status"] == FAILED).sum()) for node in answers.subtree if "status" in node)
    left = f"{failed} solves failed and are left out of the averages." if failed else "No solve failed."
    return f"Fig. 3 alone is {friction.size} contacts. {left} Profiles have the seeds from 0 on."
