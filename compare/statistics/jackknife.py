"""Intervals of what follows from averages over rough surfaces, by leaving some of them out (Tukey 1958).

The same surfaces stand behind all points: each is left out everywhere at once. What leaving it out changes tells
the scatter of a number and its skewness; percentiles of resampled surfaces are too narrow where there are few.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import inf, nan, sqrt
from typing import TYPE_CHECKING, Any, NamedTuple, Self, TypeAlias

import numpy as np

from .finding import Claim, Finding
from .intervals import Estimated, RmsMisfit, skewness

if TYPE_CHECKING:
    import xarray

Source: TypeAlias = tuple[str, int]  # solver and stratum of some surfaces, whose scatter is one
# Statistics are found this often at most for each stratum: above that, surfaces are left out in groups.
MOST_GROUPS = 20


class Group(NamedTuple):
    """Surfaces that are left out together.

    surfaces : their indices
    stratum : those on the same grids, whose scatter is one; of others it is independent
    solver : whose surfaces they are; those of others are independent
    number, of : index of the group in the stratum, and number of its groups
    """

    surfaces: np.ndarray
    stratum: int = 0
    solver: str = ""
    number: int = 0
    of: int = 1


@dataclass(frozen=True)
class Replicates:
    """A statistic, (...), and how it changes with the surfaces.

    deviations : (groups, ...), whose sum of products estimates the covariance of the statistic
    pooled : degrees of freedom of a scatter that is common to all; None where the groups determine them
    strata : of each group, what those whose scatter is one have in common; None where all are one
    """

    value: float | np.ndarray
    deviations: np.ndarray
    pooled: float | None = None
    strata: Sequence[Hashable] | None = None

    @classmethod
    def first_order(
        cls, value: float | np.ndarray, changes: np.ndarray, strata: Sequence[Hashable] | None = None
    ) -> Self:
        """changes : (surfaces, ...), with the deviation of each surface from the mean; none of an exact value."""
        return cls(value, changes / sqrt(len(changes) * (len(changes) - 1) or nan), strata=strata)

    @classmethod
    def without_one(cls, value: float | np.ndarray, without: np.ndarray) -> Self:
        """without : (surfaces, ...), the statistic found without each of them."""
        count = len(without)
        return cls(value, (without.mean(axis=0) - without) * sqrt(1 - 1 / count))

    def _scatter(self, deviations):
        """Share of each stratum in the sum of squares of deviations, its degrees of freedom, and its skewness."""
        if self.pooled is not None:
            # One scatter common to all is taken for normal: what few measurements of it show is not skewness.
            return {}, self.pooled, 0.0
        return *welch(np.square(deviations), self.strata), skewness(deviations)

    @property
    def estimated(self) -> Estimated:
        """Each number with its own error."""
        parts, dof, skewed = self._scatter(self.deviations)
        return Estimated(self.value, np.sqrt(np.square(self.deviations).sum(axis=0)), dof, skewed, parts=parts)

    @property
    def rms(self) -> RmsMisfit:
        """Root mean square of all numbers together."""
        value = np.ravel(self.value)
        deviations = self.deviations.reshape(len(self.deviations), value.size)
        if not (np.all(np.isfinite(value)) and np.all(np.isfinite(deviations))):
            return RmsMisfit()
        products, longer = deviations @ deviations.T, deviations @ value
        noise, length = float(np.trace(products)), float(value @ value)
        along = float(longer @ longer) / length if length else 0.0
        modes = noise**2 / float(np.sum(np.square(products))) if noise else 1.0
        parts, dof, _ = self._scatter(np.sqrt(np.diag(products)))
        return RmsMisfit(
            square=(length - noise) / value.size,
            noise=noise / value.size,
            along=along / value.size,
            modes=modes,
            dof=float(dof),
            pooled=self.pooled is not None,
            skewness=float(self._scatter(longer)[2]),
            parts=parts,
        )


def welch(
    squares: np.ndarray, strata: Sequence[Hashable] | None = None, known: np.ndarray | bool = True
) -> tuple[dict, float | np.ndarray]:
    """Share of each stratum in a sum of squares (groups, ...), and its degrees of freedom.

    Each stratum has one less than its known groups, all by default (Welch 1947); where nothing scatters all of
    them together. There are no shares where all are one stratum, and any number of degrees of freedom where there
    are no groups.
    """
    if not len(squares):
        return {}, inf
    strata = strata or [None] * len(squares)
    kinds = list(dict.fromkeys(strata))
    own = np.eye(len(kinds))[:, list(map(kinds.index, strata))]
    dofs = np.tensordot(own, np.broadcast_to(known, squares.shape), 1) - 1
    with np.errstate(invalid="ignore", divide="ignore"):
        sums = np.tensordot(own, squares, 1)
        shares = sums / sums.sum(axis=0)
        found = 1 / np.sum(np.where(shares > 0, np.square(shares) / dofs, 0.0), axis=0)
    parts = {} if kinds == [None] else dict(zip(kinds, shares, strict=True))
    return parts, np.where(np.isfinite(found), found, np.maximum(dofs, 0).sum(axis=0))[()]


def groups(strata: np.ndarray, solver: str = "") -> list[Group]:
    """Surfaces that are left out together, from the stratum of each: one each as long as these are few."""
    found = []
    for stratum in dict.fromkeys(strata.tolist()):
        surfaces = np.flatnonzero(strata == stratum)
        parts = np.array_split(surfaces, min(surfaces.size, MOST_GROUPS))
        found += [Group(each, stratum, solver, number, len(parts)) for number, each in enumerate(parts)]
    return found


def resample(statistic: Callable[[Any], Mapping[str, float | np.ndarray]], samples: Any) -> dict[str, Replicates]:
    """Find statistics of all surfaces, and again without each group of them.

    Groups need not be equal (Busing, Meijer and van der Leeden, Stat. Comput. 9, 3, 1999). One group alone of any
    solver leaves the deviations NaN.

    samples : with `groups`, none of a body that has no random surface, and `without` one of them
    """
    whole, left_out = statistic(samples), list(samples.groups)
    strata = [(group.solver, group.stratum) for group in left_out]
    solvers, kinds = np.array([solver for solver, _ in strata]), np.array([*map(strata.index, strata)])
    same = solvers[:, None] == solvers
    if not left_out or same.sum(axis=1).min() < 2:
        weights, found = np.full((len(left_out), 1), nan), [whole]
    else:
        sizes = np.array([group.surfaces.size for group in left_out])
        weights = _weights(sizes, same, kinds[:, None] == kinds)
        found = [statistic(samples.without(group)) for group in left_out]
    return {
        name: Replicates(value, np.tensordot(weights, [each[name] for each in found], 1), strata=strata)
        for name, value in whole.items()
    }


def _weights(sizes, solver, stratum):
    """Weights (groups, groups) of a statistic without each group in its deviations.

    sizes : of the groups; solver, stratum : whether a group and another (groups, groups) are of the same
    """
    count, total, surfaces = solver.sum(axis=1), solver @ sizes, stratum @ sizes
    share = sizes / total
    from_middle = solver * (1 - share) / (count - 1) - np.eye(sizes.size)
    # As by the groups of the stratum alone, whose surfaces are scaled for a mean over all.
    bessel = (surfaces - 1) * total / (surfaces * (total - 1))
    apart = surfaces / total * np.sqrt(sizes / (surfaces - sizes) / stratum.sum(axis=1) * bessel)
    return ((1 / share - 1) * apart)[:, None] * from_middle


def mean_ratio(
    above: np.ndarray | float, below: np.ndarray | float = 1.0, strata: np.ndarray | None = None
) -> Estimated[np.ndarray]:
    """Ratio of the means over the surfaces of both, the last axis, which share them; errors to first order.

    strata : (surfaces,) number of the stratum of each; None where all are one

    Surfaces with a NaN are left out where they have it. Errors are NaN with fewer than two surfaces; where none is
    left so is the ratio.
    """
    value, deviations, _ = off_the_ratio(above, below)
    known = np.broadcast_to(np.isfinite(above) & np.isfinite(below), deviations.shape)
    deviations, known = (np.moveaxis(each, -1, 0) for each in (deviations, known))
    parts, dof = welch(np.square(deviations), None if strata is None else strata.tolist(), known)
    return replace(Replicates(value, deviations).estimated, dof=dof, parts=parts)


def off_the_ratio(
    above: np.ndarray | float, below: np.ndarray | float = 1.0
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Ratio of the means, its change with each surface, 0 for a surface with a NaN, and the number of the others.

    The sum of squares of the changes estimates the variance; they are NaN with fewer than two surfaces.
    """
    above, below = np.broadcast_arrays(above, below)
    known = np.isfinite(above) & np.isfinite(below)
    count = known.sum(axis=-1)
    with np.errstate(invalid="ignore", divide="ignore"):
        top, bottom = (np.where(known, each, 0.0).sum(axis=-1) / count for each in (above, below))
        value = top / np.where(bottom, bottom, nan)
        unit = bottom * np.sqrt(np.where(count > 1, count * (count - 1.0), nan))
        return value, np.where(known, above - value[..., None] * below, 0.0) / unit[..., None], count


def left_out(samples: np.ndarray) -> np.ndarray:
    """Averages over the surfaces, the last axis, without one: (..., surfaces) from (..., surfaces)."""
    count = samples.shape[-1]
    return (samples.sum(axis=-1, keepdims=True) - samples) / (count - 1)


# Claims on Datasets.

_ONE = "the scatter of a single surface is not known"
_HALF = "at some point fewer than half of the surfaces have an answer, or the mean is not positive"


class DrawSet(dict[str, "xarray.Dataset"]):
    """Datasets on a level by the name of the model or of a series, from which draws can be left out.

    Draws of different solvers are independent, and are left out by themselves. Where the Datasets of a solver
    differ in their number of draws, equal shares of each are left out together.
    """

    @cached_property
    def _left(self) -> dict[tuple, DrawSet]:
        """Samples without a group: every claim on the same Datasets asks for the same ones."""
        return {}

    @property
    def _strata(self) -> dict[str, np.ndarray]:
        """Strata of the draws of each solver, of its Dataset with the fewest."""
        found: dict[str, np.ndarray] = {}
        for name, each in self.items():
            if "surface" in each.dims:
                solver, strata = _solver(name, each), strata_of(each)
                found[solver] = min(found.get(solver, strata), strata, key=len)
        return found

    @property
    def drawn(self) -> dict[str, int]:
        """Number of surfaces or profiles of each solver, least of its Datasets; none of smooth bodies."""
        return {solver: strata.size for solver, strata in self._strata.items()}

    @property
    def groups(self) -> Sequence[Group]:
        """Draws that are left out together; where Datasets of a solver differ in number, those of equal shares."""
        return [group for solver, strata in self._strata.items() for group in groups(strata, solver)]

    def without(self, group: Group) -> DrawSet:
        """The sample without one group of draws of a solver."""

        def left(name, dataset):
            if "surface" not in dataset.dims or _solver(name, dataset) != group.solver:
                return dataset
            strata = strata_of(dataset)
            rows = np.array_split(np.flatnonzero(strata == group.stratum), group.of)[group.number]
            return dataset.isel(surface=np.delete(np.arange(strata.size), rows))

        key = group[1:]
        if key not in self._left:
            self._left[key] = DrawSet({name: left(name, each) for name, each in self.items()})
        return self._left[key]


def strata_of(dataset: xarray.Dataset) -> np.ndarray:
    """Number of the stratum of each draw."""
    return dataset["stratum"].values if "stratum" in dataset.coords else np.zeros(dataset.sizes["surface"], int)


def _solver(name, dataset):
    return str(dataset.attrs.get("solver", name))


def mean(dataset: xarray.Dataset, name: str, below: str | None = None) -> np.ndarray:
    """Mean over draws of a variable, or ratio of two means, NaN where fewer than half of the draws have it."""
    over = draws_of(dataset, name)
    enough = np.isfinite(over).mean(axis=-1) >= 0.5
    return np.where(enough, off_the_ratio(over, draws_of(dataset, below))[0], nan)


def draws_of(dataset: xarray.Dataset, name: str | None) -> np.ndarray:
    """Values of a variable with the draws last, one of a smooth body; 1 without a name."""
    if name is None:
        return np.ones(1)
    variable = dataset.variables[name]
    drawn = "surface" in variable.dims
    return variable.transpose(..., "surface").values if drawn else variable.values[..., None]


def estimated(dataset: xarray.Dataset, above: str, below: str | None = None) -> Estimated[np.ndarray]:
    """Mean over draws of a variable, or ratio of two means, with its error."""
    over, under = draws_of(dataset, above), draws_of(dataset, below)
    if "surface" in dataset.dims:
        return mean_ratio(over, under, strata_of(dataset))
    return Estimated(off_the_ratio(over, under)[0])


def friction(dataset: xarray.Dataset) -> np.ndarray:
    """Coefficient of friction: mean friction force over mean normal force."""
    return mean(dataset, "friction_force", "normal_force")


def measured(claim: Claim, fine: DrawSet, coarse: DrawSet, where: str = "", regime: str = "") -> Finding:
    """Finding of a claim with a measure, from samples on two grids."""
    assert claim.measure is not None
    # What has no logarithm is not known, and the finding says so.
    with np.errstate(invalid="ignore", divide="ignore"):
        replicates, change = _on_both(claim.measure, fine, coarse)
        found = replicates.rms if np.ndim(change) else replicates.estimated
        found = replace(found, grid=float(np.sqrt(np.mean(np.square(change)))))
    unknown = _ONE if 1 in fine.drawn.values() else _HALF
    return Finding.of(claim, found, unknown, where=where, drawn=fine.drawn, regime=regime)


def compared(
    statistic: Callable[[Any], np.ndarray], fine: DrawSet, coarse: DrawSet | None, size: bool = False
) -> Estimated[np.ndarray]:
    """Numbers that a statistic of Datasets gives; `coarse` are those on half the points, None if not solved.

    size : whether the numbers are never negative
    """
    with np.errstate(invalid="ignore", divide="ignore"):
        replicates, change = _on_both(statistic, fine, coarse)
        return replace(replicates.estimated, grid=change, size=size, drawn=fine.drawn)


def _on_both(statistic, fine, coarse):
    """A statistic with its scatter, and by how much it changes from half the points to all; NaN if unknown."""
    found = resample(lambda sample: {"": statistic(sample)}, fine)[""]
    return found, np.abs((nan if coarse is None else statistic(coarse)) - found.value)
