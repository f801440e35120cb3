"""Multilevel means: over many surfaces on coarse grids and few on finer ones, with intervals as narrow as wanted.

The mean on the finest grid is the mean on the coarsest plus the mean of each difference between neighbouring
grids, each over surfaces of its own (Giles, Oper. Res. 56, 607, 2008). The surfaces of a difference are a stratum.
A surface that a coarse grid cannot solve has the answer of the next finer grid in both strata: none is left out.
`pooled` makes draws on a single grid that have the mean and scatter of the sum, with Welch's degrees of freedom.

A variance sum s_k^2 / n_k costs least with n_k proportional to s_k / sqrt(c_k), where s_k is the scatter in a
stratum and c_k its planned cost: never a measured time, so that equal seeds give equal numbers on every machine.
Sampling stops when every interval is as narrow as wanted (Chow and Robbins, Ann. Math. Stat. 36, 457, 1965). A
pilot large enough to show the scatter, and few looks, keep the level; the tests measure it.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from math import ceil, isfinite, nan, sqrt
from typing import TYPE_CHECKING, Self

import numpy as np

from ..solving.control_variates import VARIATES, controlled
from ..solving.cost import MOST_DRAWS, seconds_per_work
from ..solving.curve import EMPTY, TOGETHER, Curve
from ..solving.words import seconds, share
from .collapse import PARTED
from .finding import UNDECIDED, Claim, Finding
from .intervals import Estimated
from .jackknife import Source, off_the_ratio

if TYPE_CHECKING:
    import xarray


# Means over draws: of a variable, or of the ratio of two.
MEANS = {
    "friction_coefficient": ("friction_force", "normal_force"),
    "normal_force": ("normal_force", None),
    "depth_reached": ("depth_reached", None),
}
MEAN = Claim("mean", "Mean over surfaces", expected=1.0, tolerance=0.0)
WORDS = {"friction_coefficient": "friction", "normal_force": "force", "depth_reached": "depth"}
# What is spent or left over on a grid, and is no number of the contact.
SPENT = "seconds", "operator_applications", "residual"
GROWTH = 4.0  # times the surfaces at most from one look to the next: the scatter of few is known roughly
MARGIN = 1.1  # surfaces beyond those that just suffice: they spare most of the second looks
OWN_SHARE = 0.5  # of the wanted width that is left to the scatter at least, however much the grid takes


def wanted(prescribed: str, speeds: tuple[float, ...], slides: bool) -> Iterator[tuple[str, tuple[float, ...]]]:
    """Names of the means that an interval is asked for, with their speeds: what is not prescribed, and friction.

    slides : whether there is friction to speak of
    """
    yield "normal_force" if prescribed == "depth" else "depth_reached", speeds
    if slides:
        yield "friction_coefficient", tuple(speed for speed in speeds if speed > 0)


def pooled(dataset: xarray.Dataset) -> xarray.Dataset:
    """Draws of the fine and of the coarse grid from those of all grids; one without a stratum is returned.

    dataset : grids from fine to coarse; draws of stratum k have answers on the grids k and k + 1, if there is one.
        Control variates of the draws on the coarsest grid, if it has them, are left out of what is returned
    """
    if "stratum" not in dataset.coords:
        return dataset
    variates = dataset.get(VARIATES)
    dataset = dataset.drop_vars(VARIATES, errors="ignore")
    if "status" in dataset and "friction_force" in dataset:
        # What does not touch adds nothing to either force.
        dataset = dataset.assign(friction_force=dataset["friction_force"].where(dataset["status"] != EMPTY, 0.0))
    strata, levels, made = dataset["stratum"].values, dataset.sizes["level"], {}
    for name, each in dataset.data_vars.items():
        if "surface" not in each.dims or name in SPENT or each.dtype.kind != "f":
            continue
        ordered = each.transpose("level", ..., "surface")
        values = ordered.where(np.isfinite(ordered)).values
        if variates is not None:
            rows = np.flatnonzero(strata == levels - 1)
            own = variates.transpose(*ordered.dims[1:], "variate").values[..., rows, :]
            values[-1][..., rows] = controlled(values[-1][..., rows], own)
        values[:-1] -= values[1:]
        differences = np.moveaxis(values[strata, ..., np.arange(strata.size)], 0, -1)
        draws = np.stack([_draws(differences, strata, range(first, levels)) for first in range(levels)[:2]])
        made[name] = ordered.dims, draws, each.attrs
    return dataset.isel(level=slice(2)).assign(made)


def _draws(differences, strata, counted):
    """Draws (..., seeds) whose mean is that on one grid: a surface for each, NaN where it has no answer.

    NaN too where a stratum has fewer than two, which tell no scatter.

    differences : (..., seeds) of each surface between the grid of its stratum and the next; on the last, answers
    counted : strata of this grid and of coarser ones; of finer grids nothing is seen
    """
    mean, changes = 0.0, np.zeros_like(differences)
    known = np.isfinite(differences)
    for stratum in counted:
        rows = strata == stratum
        middle, changes[..., rows], count = off_the_ratio(differences[..., rows])
        mean = mean + np.where(count > 1, middle, np.nan)
    total = known.sum(axis=-1, keepdims=True)
    return np.where(known, np.expand_dims(mean, -1) + np.sqrt(total * (total - 1.0)) * changes, np.nan)


def means_of(model: str, mean: Estimated) -> Iterator[Finding]:
    """Finding on the mean of a model at every place, over its value: only narrower intervals are asked of it."""
    for place in np.ndindex(mean.value.shape):
        one = mean.at(place)
        low, high = one.interval()
        size = abs(one.value) or nan
        half = (high - low) / 2 / size
        parts = {(model, k): float(each) for k, each in one.parts.items()}
        # A model without another grid has no error of it.
        yield Finding(MEAN, 1.0, (1 - half, 1 + half), np.nan_to_num(one.grid / size), parts=parts)


def unreached(means: Iterable[Finding], interval: float) -> str:
    """What keeps the interval of a mean wider than wanted somewhere, in words; empty where nothing does.

    interval : half-width that is wanted, relative
    """
    # What has no draws is as narrow as it can be.
    widths = (((high - low) / 2, each.grid) for each in means if each.parts for low, high in [each.interval])
    half, grid = max((each for each in widths if isfinite(each[0])), default=(0.0, 0.0))
    if half <= interval:
        return ""
    message = f"is known to {share(half)} only, {share(interval)} are wanted"
    if grid > OWN_SHARE * interval:
        return f"{message}: its grid leaves {share(grid)} open, take more points"
    return f"{message}: more surfaces would narrow it"


@dataclass(frozen=True)
class DrawnSurfaces:
    """Surfaces of some parameter grids that share them.

    counts : of each model, by stratum
    costs : planned work for a surface on all of its grids, in units of `Task.work`, likewise
    """

    counts: Mapping[str, tuple[int, ...]]
    costs: Mapping[str, tuple[float, ...]]

    @classmethod
    def of(cls, grids: Iterable[Curve]) -> Self:
        """Surfaces of grids that have as many."""
        every = list(grids)
        costs = {name: tuple(np.sum([each.costs[name] for each in every], axis=0)) for name in every[0].costs}
        return cls({name: tuple(map(len, every[0].strata(name))) for name in costs}, costs)

    def deciding(self, finding: Finding, interval: float | None = None) -> Mapping[Source, float]:
        """Numbers of draws at least cost that decide a finding if its number stays; none if nothing does.

        interval : half-width of an interval that is enough without a verdict, relative where more than one is
            expected; None if only a verdict is
        """
        if not _open(finding):
            return {}
        (low, high), claim, value = finding.scatter, finding.claim, finding.value
        edge = claim.expected + (claim.tolerance if value > claim.expected else -claim.tolerance)
        scatter = high - value if edge > value else value - low
        left = abs(edge - value) - finding.grid
        if interval is not None:
            wanted = interval * max(1.0, abs(claim.expected))
            if (high - low) / 2 + finding.grid <= wanted:
                return {}
            left = max(left, wanted - finding.grid, OWN_SHARE * wanted)
        return self._least_cost(finding.parts, scatter / left) if left > 0 else {}

    def more(self, findings: Iterable[Finding], interval: float) -> dict[str, tuple[int, ...]]:
        """Numbers of draws that decide findings, or make their intervals narrow enough; no fewer than now.

        Of no stratum there are more than MOST_DRAWS, and at most GROWTH times the draws of now.
        """
        asked = [self.deciding(each, interval) for each in findings]

        def most(*source):
            return max((each.get(source, 0.0) for each in asked), default=0.0)

        return {
            name: tuple(_more(had, most(name, k)) for k, had in enumerate(counts))
            for name, counts in self.counts.items()
        }

    def with_remedy(self, finding: Finding, words: Mapping[str, str]) -> Finding:
        """The finding with what would decide it. words : what a draw of each model is called, in the plural"""
        if not _open(finding):
            return finding
        asked = self.deciding(finding)
        if not asked:
            remedy = "its grid leaves too much open: a finer one would have to decide it"
        elif not max(asked.values()) <= MOST_DRAWS:
            drawn = " or ".join(dict.fromkeys(words[name] for name, _ in asked))
            remedy = f"only more than {MOST_DRAWS:,} {drawn} would decide it"
        else:
            totals, work = defaultdict[str, float](float), 0.0
            for (name, k), count in asked.items():
                lacking = max(count - self.counts[name][k], 0.0)
                totals[words[name]] += lacking
                work += lacking * self.costs[name][k]
            needed = " and ".join(f"{_some(max(more, 1.0))} more {word}" for word, more in totals.items() if more)
            remedy = f"some {needed}, {seconds(seconds_per_work() * work)} of processor time, would decide it"
        return replace(finding, remedy=remedy)

    def _least_cost(self, parts, times):
        """Numbers of draws by source, of least cost, that make the standard error `times` smaller.

        parts : share of each source in the variance
        """
        # Standard deviation of single draws of each source, over the standard error of the number.
        spread = {
            (name, k): sqrt(each * self.counts[name][k])
            for (name, k), each in parts.items()
            if name in self.counts
        }
        root = {(name, k): sqrt(self.costs[name][k]) for name, k in spread}
        total = sum(spread[each] * root[each] for each in spread)
        return {each: spread[each] / root[each] * total * times**2 for each in spread}


def _open(finding):
    """Whether more surfaces may decide a finding: curves that part at the least overlap may miss by too much."""
    parted = finding.reason == PARTED and finding.value > finding.claim.expected + finding.claim.tolerance
    known = all(map(isfinite, (finding.value, *finding.interval)))
    return finding.verdict == UNDECIDED and bool(finding.parts) and known and (parted or not finding.reason)


def _more(had, asked):
    """Number of surfaces of a stratum where `asked` are wanted: at most `growth` times as many as it had."""
    enough = TOGETHER * ceil(MARGIN * min(asked, MOST_DRAWS) / TOGETHER)
    return min(max(had, min(enough, int(GROWTH * had))), MOST_DRAWS)


def _some(count):
    """A number that is roughly known, rounded."""
    return f"{ceil(float(f'{count:.1g}' if count < 100 else f'{count:.2g}')):,}"
