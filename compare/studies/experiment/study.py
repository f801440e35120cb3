"""The study of the experiment: every contact that is plausible, and what its curves come to."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import Any

import numpy as np
import xarray
from pandas import DataFrame

from ...library.ready import CATALOGUE
from ...report.page import Findings, Table, Text
from ...solving.outcome import Outcome
from ...solving.task import Batch, SceneTask, Task
from ...solving.vocabulary import attributes
from ...statistics.finding import UNKNOWN, Finding, claimed, sentences
from ..study import Judgement, SizedStudy
from . import check, figure
from .claims import ABOUT, AS_ASSUMED, CLAIMS, EVERY, OPEN
from .contact import RoughBall
from .curves import measured
from .setup import ASSUMED, LOADS, MAIN, SIZES, SOLIDS, SPEEDS, Size

NUMBERS = "friction_of_shape", "friction_of_roughness", "pressure_ratio", "contact_area"
WAVES = list(OPEN)[1:]
SETS = {AS_ASSUMED: ASSUMED, EVERY: SOLIDS}


@dataclass(frozen=True)
class ExperimentStudy(SizedStudy):
    """The experiment in three dimensions, at a size."""

    command, name = "study", "experiment"
    title, about = CATALOGUE["experiment"].title, CATALOGUE["experiment"].about
    sizes = SIZES

    @property
    def solved(self) -> Size:
        """Size of the study: solids, pairs and spectra that are solved."""
        return SIZES[self.size]

    @cached_property
    def contacts(self) -> Sequence[RoughBall]:
        """Tasks of each pair and solid, speed by speed."""
        size = self.solved
        return [
            RoughBall(pair.scene(SOLIDS[solid], float(speed), float(load)), size.spectra, size.points)
            for pair, solid, speed, load in product(size.pairs, size.solids, SPEEDS, LOADS)
        ]

    @cached_property
    def checks(self) -> Sequence[tuple[SceneTask, RoughBall]]:
        """Rough balls solved as they are, and by the law."""
        return check.tasks(self.solved.checks, self.solved.points)

    def batches(self) -> Sequence[Batch]:
        """Smooth balls, and rough ones that are solved as they are."""
        return Batch(self.contacts), Batch([each for both in self.checks for each in both])

    def answers(self, outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
        """Numbers by ball, solid, speed, load and spectrum; and of the checks, by contact and surface."""
        size, titles = self.solved, [each.title for each in self.solved.pairs]
        dims: dict[str, Any] = {"pair": titles, "solid": list(size.solids), "speed": SPEEDS, "load": LOADS}
        waves = {name: ("spectrum", [getattr(each, name) for each in size.spectra]) for name in WAVES}
        shape = *(len(each) for each in dims.values()), len(size.spectra)
        rows = [row.measures for each in self.contacts for row in outcomes[each].rows]
        own = {name: np.reshape([row.get(name, np.nan) for row in rows], shape) for name in NUMBERS}
        numbers = {name: ((*dims, "spectrum"), values) for name, values in own.items()}
        found = {"balls": xarray.Dataset(numbers, dims | waves)}
        if self.checks:
            found["checks"] = check.answers(self.checks, outcomes)
        for dataset in found.values():
            for name in dataset.variables:
                dataset[name].attrs = attributes(str(name))
        return xarray.DataTree.from_dict(found)

    def members(self, answers: xarray.DataTree) -> DataFrame:
        """Numbers of each claim for each pair, solid and roughness."""
        rows, found = [], answers["balls"].to_dataset()
        for pair, solid, place in product(self.solved.pairs, self.solved.solids, range(found.sizes["spectrum"])):
            own = found.sel(pair=pair.title, solid=solid).isel(spectrum=place)
            told = dict(measured(LOADS, SPEEDS, *(own[name].values / LOADS for name in NUMBERS[:2])))
            told["break"] /= pair.crossover
            area = np.log(own["contact_area"].values[len(SPEEDS) // 2])
            radius = np.sqrt(np.exp(np.interp(np.log(pair.crossover), np.log(LOADS), area)) / np.pi)
            told |= {"width": 2 * radius / pair.width, "pressed": float(own["pressure_ratio"].min())}
            waves = {name: own[name].item() for name in WAVES}
            rows.append({"curves": pair.title, "solid": solid, **waves, **told})
        return DataFrame(rows)

    def judge(self, answers: xarray.DataTree) -> Judgement:
        members = self.members(answers)
        findings = [*self._findings(members)]
        if "checks" in answers:
            findings += check.findings(answers["checks"].to_dataset())
        others = tuple(pair.title for pair in self.solved.pairs if pair != MAIN)
        counted = [each for each in claimed(findings) if not each.where.startswith(others)]
        shown = figure.plot(answers, members)
        table = Table("members", members, "Every solid and roughness: what its curves come to.", long=True)
        return Judgement(findings, sentences(counted), [shown, Findings(findings), table], [Text(ABOUT)])

    def _findings(self, members: DataFrame) -> Iterator[Finding]:
        """Each claim for each pair over the solids that the paper assumes; for the first over all others too."""
        for name, pair in product(CLAIMS, self.solved.pairs):
            own = members[members["curves"] == pair.title]
            for which in SETS if pair == MAIN else (AS_ASSUMED,):
                yield _finding(name, own[own["solid"].isin(list(SETS[which]))], f"{pair.title}, {which}")


def _finding(name: str, members: DataFrame, where: str) -> Finding:
    """Finding over a set of solids and spectra; what is undecided says on what it depends most."""
    claim, values = CLAIMS[name], members[name].dropna()
    of = f"{len(values)} of {len(members)} solids and spectra"
    if values.empty:
        return Finding(claim, np.nan, where=where, regime=of, reason="no curve has one")
    ends = float(values.min()), float(values.max())
    if np.isfinite(claim.tolerance):
        near = int(((values - claim.expected).abs() <= claim.tolerance).sum())
        of += f", {near} within the tolerance"
    grouped = {told: members.groupby(column)[name].median() for column, told in OPEN.items()}
    most = max(grouped, key=lambda told: grouped[told].max() - grouped[told].min())
    remedy = f"it depends most on {most}, which is not stated"
    middle = float(values.median())
    return Finding(claim, middle, ends, 0.0, UNKNOWN, where, regime=of, plot=figure.NAME, remedy=remedy)
