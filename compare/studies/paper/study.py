"""The study of the command `paper`: what is solved for the figures of the paper, and its page."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import xarray
from pandas import DataFrame

from scene.reading import InvalidInput

from ...figures import shifted_curves
from ...report.page import Block, Findings, Section, Table, Text
from ...comparison import curve
from ...solving.cost import MOST_DRAWS, Cost
from ...solving.outcome import Outcome
from ...comparison.curve import FAILED, Curve
from ...solving.task import Batch, Task
from ...statistics import eq23
from ...statistics.finding import FAILS
from ..study import Judgement, Study
from . import figures, law, losses, parameter_studies, parameters
from .claims import findings, lines
from .contacts import contact_grid, contact_tables, with_nodes
from .parameter_studies import ParameterStudies
from .text import ABOUT, OPEN, SHIFTS

SIZES = {"quick": 20, "standard": 50, "full": parameters.PROFILES}


@dataclass(frozen=True)
class Reproduction:
    """Data of every figure, from what was solved.

    slow : Fig. 3; fits : straight lines through it
    laws : Fig. 4, one a shape; rubbers : Figs. 5 to 7
    """

    slow: parameter_studies.SlowFriction
    fits: Mapping[str, parameter_studies.Line]
    laws: tuple[law.Law, ...]
    rubbers: tuple[losses.Lossy, ...]


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
    def of(cls, size: str = "full", profiles: int | None = None) -> "Paper":
        """The study at a size, or on so many profiles. Raises InvalidInput."""
        if size not in SIZES:
            raise InvalidInput(f"size = {size!r}: one of {', '.join(SIZES)}")
        if profiles is not None and not (isinstance(profiles, int) and 3 <= profiles <= MOST_DRAWS):
            raise InvalidInput(f"profiles = {profiles!r}: a whole number from 3 to {MOST_DRAWS}")
        return cls(SIZES[size] if profiles is None else profiles)

    @property
    def inputs(self) -> Mapping[str, Any]:
        """Number of profiles."""
        return {"profiles": self.profiles}

    @property
    def _studies(self) -> ParameterStudies:
        return ParameterStudies(values=self.values, profiles=self.profiles)

    def grids(self) -> Mapping[str, Curve]:
        """Contacts of Fig. 1, of Fig. 4, and of Figs. 5 to 7."""
        return self._grids

    @cached_property
    def _grids(self):
        # kept, as they keep their scenes
        found = {f"contact-{shape}": contact_grid(shape) for shape in parameters.SHAPES}
        found |= {f"law-{shape}": law.parameter_grid(shape, self.profiles) for shape in parameters.SHAPES}
        for loss in parameters.LOSSES:
            found |= losses.grids(loss, min(self.profiles, parameters.LOSS_PROFILES))
        return found

    def cost(self) -> Cost:
        """Parameter grids, the parameter studies of Fig. 3, and Fig. 4 of planes."""
        return super().cost() + Cost.of(self._own)

    def batches(self) -> Sequence[Batch]:
        """Everything that is solved: grids, the parameter studies of Fig. 3, and Fig. 4 of planes."""
        return (Batch([*self._own, *curve.tasks_of(self.grids())]),)

    @cached_property
    def _own(self):
        return [*self._studies.tasks(), *(law.planes(shape) for shape in parameters.SHAPES)]

    def answers(self, outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
        """Everything that was solved: a Dataset for each figure, shape and rubber."""
        grids = self.grids()
        tree = curve.tree(grids, outcomes)
        parts = {parameter_studies.NODE: self._studies.dataset(outcomes)}
        for shape in parameters.SHAPES:
            parts[f"law-{shape}/planes"] = law.planes_dataset(shape, outcomes)
            name = f"contact-{shape}"
            parts[f"{name}/MDR"] = with_nodes(_dataset(tree, f"{name}/MDR"), grids[name].fields(outcomes))
        for path, dataset in parts.items():
            tree[path] = xarray.DataTree(dataset)
        return tree

    def reproduction(self, answers: xarray.DataTree) -> Reproduction:
        """Data of every figure. Raises SolveError where all of a figure is missing."""
        slow = parameter_studies.slow_friction(self._studies, _dataset(answers, parameter_studies.NODE))
        laws = (
            law.law(shape, *(_dataset(answers, f"law-{shape}/{model}") for model in ("MDR", "planes")))
            for shape in parameters.SHAPES
        )
        rubbers = (
            losses.lossy(loss, *(_dataset(answers, f"{name}/MDR") for name in losses.grids(loss)))
            for loss in parameters.LOSSES
        )
        return Reproduction(slow, lines(slow), tuple(laws), tuple(rubbers))

    def judge(self, answers: xarray.DataTree) -> Judgement:
        """Figures of the paper and its claims, in its order, and the shift of Eq. 23."""
        found = self.reproduction(answers)
        judged = findings(found.slow, found.fits, found.laws, found.rubbers)
        shifts = _shifts(found.rubbers, judged)
        blocks: list[Block] = [
            *self._plots(found, answers, judged),
            Findings(judged, "Claims of the paper, with intervals of 95 % over rough profiles."),
            Section("The shift of Eq. 23", [Text(SHIFTS), Table("shifts", shifts, "Exponents of the shift.")]),
        ]
        setting: list[Block] = [
            Text(ABOUT),
            Text(_solved(answers, found.slow)),
            Section("How this departs from the paper", [Text(OPEN)]),
        ]
        return Judgement(judged, blocks=blocks, setting=setting)

    def _plots(self, found, answers, judged):
        """Figures of the paper, in its order."""
        contacts = {shape: _dataset(answers, f"contact-{shape}/MDR") for shape in parameters.SHAPES}
        drawn = [
            figures.contacts.plot(*contact_tables(contacts)),
            figures.sketch.plot(),
            figures.studies.plot(found.slow.points, _fits(found.fits)),
            figures.law.plot([each.points for each in found.laws], DataFrame([each.row for each in found.laws])),
            *(self._shifted(each, judged) for each in found.rubbers),
        ]
        return [each for each in drawn if each is not None]

    def _shifted(self, lossy, findings):
        rows = [
            shifted_curves.ShiftedCurves(
                title=lossy.where(of),
                collapse=found,
                findings={each.claim.id: each for each in findings if each.where == lossy.where(of)},
                expected=lossy.exponent,
                powers={name: lossy.powers[name] for name in losses.comparable(of)},
                conditions=lossy.conditions(of),
            )
            for of, found in lossy.collapses.items()
        ]
        return shifted_curves.plot(rows, f"shifted-curves{lossy.loss.suffix}")


def _dataset(answers, path):
    return answers[path].to_dataset(inherit=False)


def _fits(fits):
    rows = [{"points_fitted": name, **fit.row} for name, fit in fits.items() if np.isfinite(fit.slope.value)]
    return DataFrame(rows, columns=["points_fitted", *next(iter(fits.values())).row])


def _shifts(rubbers, findings):
    """Exponents of the shift: expected, of each form of Eq. 22, and simulated; unknown where curves part."""
    rows, of_claim = [], {(each.claim.id, each.where): each for each in findings}
    for lossy in rubbers:
        ratio = lossy.points[losses.STIFFNESS]
        row = {
            "rubber": lossy.loss.symbols,
            "least_modulus": ratio.min(),
            "greatest_modulus": ratio.max(),
            "exponent_expected": lossy.exponent,
            **{f"exponent_of_{name.replace(' ', '_')}": power for name, power in lossy.powers.items()},
        }
        for of, name in ((losses.WHOLE, "whole"), (losses.ROUGH, "excess")):
            collapse, exponent = (of_claim[each.id, lossy.where(of)] for each in (eq23.COLLAPSE, eq23.EXPONENT))
            known = (exponent.value, *exponent.interval) if collapse.verdict != FAILS else (np.nan,) * 3
            row[f"collapse_{name}"] = collapse.verdict
            row |= dict(zip((f"exponent_{name}{end}" for end in ("", "_low", "_high")), known, strict=True))
        rows.append(row)
    return DataFrame(rows)


def _solved(answers, slow):
    """Number of contacts that were solved, and what failed."""
    failed = sum(int((node["status"] == FAILED).sum()) for node in answers.subtree if "status" in node)
    left = f"{failed} solves failed and are left out of the averages." if failed else "No solve failed."
    return (
        f"Fig. 3 alone is {slow.samples.size} contacts under a prescribed load, {slow.sweeps:.1f} sweeps along "
        f"the profile for each. {left} Profiles have the seeds from 0 on."
    )
