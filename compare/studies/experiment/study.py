"""The study of the experiment: every contact that is plausible, and what its curves come to."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from typing import Any

import numpy as np
import xarray
from pandas import DataFrame

from bem3d import BEM

from ...library.ready import CATALOGUE
from ...report.page import Block, Findings, Table, Text
from ...solving.outcome import Outcome
from ...solving.suggest import known
from ...solving.task import Batch, SceneTask, Task, draws_of
from ...solving.vocabulary import attributes
from ...statistics import eq23
from ...statistics.finding import EXACT, UNKNOWN, Claim, Finding, claimed, sentences
from ...statistics.jackknife import mean_ratio
from ..study import Judgement, Study
from . import figure
from .contact import RoughBall
from .curves import measured
from .setup import (
    ASSUMED,
    CHECKS,
    GLASSY,
    LOADS,
    MAIN,
    MEASURED,
    POINTS,
    POWER,
    SIZES,
    SOLIDS,
    SPEEDS,
    Check,
    Pair,
    crossover,
)

SCATTER = 0.02  # of ln mu: that of means of six measurements which scatter by 5 % each
OPEN = {"solid": "the solid", "hurst": "the Hurst exponent", "shortest": "the shortest wave", "longest": "the longest"}
AS_ASSUMED, EVERY = "as the paper assumes", "all that is plausible"
OVER = "The interval is the range over all that the paper does not state; the number is the median."


def _claim(id: str, sentence: str, expected=np.nan, tolerance=np.nan, meaning="", unit="1") -> Claim:
    return Claim(f"experiment.{id}", sentence, expected, tolerance, f"{meaning} {OVER}".strip(), unit, "3D")


CLAIMS = {
    "collapse": _claim(
        "collapse", "Shifted along the force, the curves are one", 0.0, eq23.TOLERANCE,
        "rms of ln mu about the common curve.",
    ),
    "along-friction": _claim("along-friction", "Misfit to one curve when shifted along friction instead"),
    "unshifted": _claim("unshifted", "Misfit to one curve before shifting"),
    "same": _claim(
        "same", "A shift along friction does as well as one along the force", 0.0, SCATTER,
        "Misfit along friction less misfit along the force. Means of six measurements that scatter by 5 % tell "
        "apart what is more than 2 %.",
    ),
    "exponent": _claim(
        "exponent", "The shift along the force goes with the speed to the power -3 beta/2", -1.5 * POWER,
        eq23.TOLERANCE * 1.5 * POWER, "Of curves that part or lie flat there is none.",
    ),
    "two-lines": _claim(
        "two-lines", "Two straight lines follow the curve better than a smooth one of as many unknowns", 0.0, 1.0,
        "rms of ln mu at the middle speed about two straight lines, over that about a polynomial of degree 3. "
        "Curves whose slopes differ by less than 0.02 have no break.",
    ),
    "slope-light": _claim(
        "slope-light", "Under light loads friction falls with the load, as Eq. 25 has it", -1 / 3, 1 / 3,
        "Slope of the first of two straight lines; Eq. 25 has 0 to -2/3.",
    ),
    "slope-heavy": _claim(
        "slope-heavy", "Under heavy loads friction falls with the load, as Eq. 25 has it", -1 / 3, 1 / 3,
        "Slope of the second; Eq. 25 has 0 to -2/3.",
    ),
    "break": _claim(
        "break", "The two lines meet at F* = (2/3) G_0 D^3/R", 1.0, 0.25,
        "Force at which they meet over F*; on a half-space, over that of 10 mm.",
    ),
    "ball-light": _claim("ball-light", "Share of the smooth ball in friction at the least load"),
    "ball-heavy": _claim("ball-heavy", "Share of the smooth ball in friction at the greatest load"),
    "level": _claim(
        "level", "Friction comes to the 0.5 that the paper states", MEASURED, MEASURED / 2,
        "Greatest friction at the middle speed.",
    ),
}  # fmt: skip
GLASS = _claim("glass", "Modulus that the shortest wave meets over the glassy one", meaning="At the greatest speed.")
LAW = _claim(
    "law", "Friction by the law is that of the rough ball solved by BEM", 1.0, 0.05,
    "Ratio, with the interval of 95 % over surfaces.",
)  # fmt: skip
NUMBERS = "normal_force", "friction_of_shape", "friction_of_roughness", "pressure_ratio"
ABOUT = f"""The smooth ball is solved on the layer at {len(LOADS)} loads of {LOADS[0]:g} to {LOADS[-1]:g} N and
{len(SPEEDS)} speeds of {1e3 * SPEEDS[0]:g} to {1e3 * SPEEDS[-1]:g} mm/s. Its roughness is too fine for any grid: its
friction follows from the pressure field by the law of three dimensions, without the waves on which the contact rides.

**Stated by the paper**: radii, thicknesses, G_0 = 3 MPa, G_inf = 1.5 GPa, beta = {POWER:g}, rms roughness of 0.1 um.
**Not stated, and varied**: Hurst exponent, shortest and longest wave, and where the loss begins.

**The solids.** A loss that is a power of 0.1 at every frequency rises from 3 MPa to 1.5 GPa over 27 decades: in the band
that is sampled G_inf is not reached, nor felt. In these solids the modulus at the frequency of the contact, about 1
rad/s, is 1.03, 1.1 or 1.3 of that at rest (the paper's assumption), or 2 and 4 times that. Or the loss begins at 0.3, 30
or 3000 rad/s, rises with the power 0.1, and ends at 1e10 rad/s where the modulus is G_inf."""


@dataclass(frozen=True)
class ExperimentStudy(Study):
    """The experiment in three dimensions, at a size."""

    size: str = "quick"

    command, name = "study", "experiment"
    title, about = CATALOGUE["experiment"].title, CATALOGUE["experiment"].about

    @classmethod
    def of(cls, size: str) -> "ExperimentStudy":
        """Study of a size. Raises InvalidInput where there is no such size."""
        known("size", size, SIZES)
        return cls(size)

    @property
    def place(self) -> str:  # type: ignore[override]
        return f"{self.name}-{self.size}"

    @property
    def inputs(self) -> Mapping[str, Any]:
        return {"name": self.name, "size": self.size}

    @cached_property
    def contacts(self) -> Mapping[tuple[Pair, str], list[RoughBall]]:
        """Tasks of each pair and solid, speed by speed."""
        size = SIZES[self.size]
        return {
            (pair, solid): [
                RoughBall(pair.scene(SOLIDS[solid], float(v), float(load)), size.spectra, size.points)
                for v, load in product(SPEEDS, LOADS)
            ]
            for pair, solid in product(size.pairs, size.solids)
        }

    @cached_property
    def checks(self) -> Mapping[Check, tuple[SceneTask, RoughBall]]:
        """Rough balls solved as they are, and by the law."""
        size, found = SIZES[self.size], {}
        for each in CHECKS if size.checks else ():
            rough = each.rough
            drawn = draws_of(replace(each.smooth, roughness=rough), size.checks)
            found[each] = (SceneTask(BEM(points=POINTS), drawn, work=1e7), RoughBall(each.smooth, (rough,), size.points))
        return found

    def batches(self) -> Sequence[Batch]:
        """Smooth balls, and rough ones that are solved as they are."""
        return (
            Batch([each for tasks in self.contacts.values() for each in tasks]),
            Batch([each for tasks in self.checks.values() for each in tasks]),
        )

    def answers(self, outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
        """Forces of each pair: by solid, spectrum, speed and load; and of the checks, by contact and surface."""
        size = SIZES[self.size]
        coordinates: dict[str, Any] = {"solid": list(size.solids), "speed": SPEEDS, "load": LOADS}
        for name in ("hurst", "shortest", "longest"):
            coordinates[name] = ("spectrum", [getattr(each, name) for each in size.spectra])
        found = {}
        for pair in size.pairs:
            rows = [outcomes[each].rows for solid in size.solids for each in self.contacts[pair, solid]]
            shape = len(size.solids), len(SPEEDS), len(LOADS), len(size.spectra)
            values = {
                name: (
                    ("solid", "speed", "load", "spectrum"),
                    np.array([[_number(each, name) for each in row] for row in rows]).reshape(shape),
                )
                for name in NUMBERS
            }
            found[f"/{pair.title}"] = _labelled(xarray.Dataset(values, coordinates))
        if self.checks:
            found["/checks"] = self._checked(outcomes)
        return xarray.DataTree.from_dict(found)

    def _checked(self, outcomes):
        solved = [outcomes[task].rows for task, _ in self.checks.values()]
        forces = {
            name: (("check", "seed"), np.array([[getattr(each, name) for each in rows] for rows in solved]))
            for name in ("normal_force", "friction_force")
        }
        law = [outcomes[ball].rows[0].friction_coefficient for _, ball in self.checks.values()]
        titles = {"check": [each.title for each in self.checks]}
        return _labelled(xarray.Dataset(forces | {"friction_coefficient": ("check", law)}, titles))

    def members(self, answers: xarray.DataTree) -> DataFrame:
        """Numbers of each claim for each pair, solid and roughness."""
        rows = []
        for pair in SIZES[self.size].pairs:
            found = answers[pair.title].to_dataset()
            expected = crossover(pair.radius, pair.thickness or 0.01)
            for solid, spectrum in product(found["solid"].values.tolist(), range(found.sizes["spectrum"])):
                own = found.sel(solid=solid).isel(spectrum=spectrum)
                shape, rough = (own[name].values / own["normal_force"].values for name in NUMBERS[1:3])
                waves = {name: float(own[name]) for name in list(OPEN)[1:]}
                told = measured(LOADS, SPEEDS, shape, rough, expected)
                rows.append({"curves": pair.title, "solid": solid, **waves, **told})
        return DataFrame(rows)

    def judge(self, answers: xarray.DataTree) -> Judgement:
        members = self.members(answers)
        findings = [*self._findings(members), *self._glass(), *_law(answers)]
        counted = [each for each in claimed(findings) if each.where.startswith((MAIN.title, "law"))]
        shown = figure.plot(answers, members)
        table = Table("members", members, "Every solid and roughness: what its curves come to.", long=True)
        return Judgement(findings, sentences(counted), [shown, Findings(findings), table], self.setting)

    def _findings(self, members: DataFrame) -> Iterator[Finding]:
        """Each claim for each pair over the solids of the paper's assumption; for the first over all others too."""
        for name, claim in CLAIMS.items():
            for pair in SIZES[self.size].pairs:
                own = members[members["curves"] == pair.title]
                sets = {AS_ASSUMED: own[own["solid"].isin(list(ASSUMED))]}
                if pair == MAIN:
                    sets[EVERY] = own
                for which, chosen in sets.items():
                    yield _finding(claim, name, chosen, f"{pair.title}, {which}")

    def _glass(self) -> Iterator[Finding]:
        size = SIZES[self.size]
        waves = 2 * np.pi * SPEEDS[-1] / np.array(size.shortest)
        for which, names in ((AS_ASSUMED, ASSUMED), (EVERY, SOLIDS)):
            chosen = [abs(SOLIDS[each].complex_modulus(waves)) / GLASSY for each in size.solids if each in names]
            values = np.ravel(chosen)
            ends = float(values.min()), float(values.max())
            yield Finding(GLASS, float(np.median(values)), ends, 0.0, EXACT, which)

    @property
    def setting(self) -> Sequence[Block]:
        """What is stated, and what is varied."""
        return [Text(ABOUT)]


def _finding(claim: Claim, name: str, members: DataFrame, where: str) -> Finding:
    """Finding over a set of solids and spectra; what is undecided says on what it depends most."""
    values = members[name].dropna()
    of = f"{len(values)} of {len(members)} solids and spectra"
    if values.empty:
        return Finding(claim, np.nan, where=where, regime=of, reason="no curve has one")
    ends = float(values.min()), float(values.max())
    near = int(((values - claim.expected).abs() <= claim.tolerance).sum())
    regime = of if np.isnan(claim.tolerance) else f"{of}, {near} within the tolerance"
    grouped = {told: members.groupby(column)[name].median() for column, told in OPEN.items()}
    most = max(grouped, key=lambda told: grouped[told].max() - grouped[told].min())
    return Finding(
        claim, float(values.median()), ends, 0.0, UNKNOWN, where, regime=regime, plot=figure.NAME,
        remedy=f"it depends most on {most}, which is not stated",
    )  # fmt: skip


def _law(answers: xarray.DataTree) -> Iterator[Finding]:
    """The law against rough balls that were solved as they are."""
    if "checks" not in answers:
        return
    for title, own in answers["checks"].to_dataset().groupby("check"):
        own = own.squeeze("check")
        solved = mean_ratio(own["friction_force"].values, own["normal_force"].values)
        law, (low, high) = float(own["friction_coefficient"]), solved.interval()
        ends = law / float(high), law / float(low)
        draws = own.sizes["seed"]
        yield Finding(LAW, law / float(solved.value), ends, 0.0, UNKNOWN, f"law, {title}", draws)


def _number(row, name):
    return row.normal_force if name == "normal_force" else row.measures.get(name, np.nan)


def _labelled(dataset: xarray.Dataset) -> xarray.Dataset:
    for name in dataset.variables:
        dataset[name].attrs = attributes(str(name))
    return dataset
