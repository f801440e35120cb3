"""Intervals of what follows from averages over rough surfaces, by leaving some of them out (Tukey 1958).

The same surfaces stand behind all points: each is left out everywhere at once. What leaving it out changes tells
the scatter of a number and its skewness; percentiles of resampled surfaces are too narrow where there are few.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from math import inf, nan, sqrt
from typing import Any, NamedTuple, Protocol, Self, TypeAlias

import numpy as np
import xarray

from .finding import HALVED, UNKNOWN, Claim, Finding
from .intervals import Estimated, RmsMisfit, skewness

Source: TypeAlias = tuple[str, int]  # solver and stratum of some surfaces, whose scatter is one
# Statistics are found this often at most for each stratum: above that, surfaces are left out in groups.
MOST_GROUPS = 20


class Group(NamedTuple):
    """Surfaces that are left out together.

    surfaces : their indices
    stratum : those on the same grids, whose scatter is one; of others it is independent
    solver : whose surfaces they are; those of others are independent
    """

    surfaces: np.ndarray
    stratum: int = 0
    solver: str = ""


class Grouped(Protocol):
    """Something averaged over surfaces."""

    @property
    def groups(self) -> Sequence[Group]:
        """Surfaces that are left out together; none of a body that has no random surface."""

    def without(self, group: Group) -> "Grouped":
        """DrawSet without some surfaces."""


class Drawn(Grouped, Protocol):
    """Something averaged over numbers of surfaces that are told."""

    @property
    def drawn(self) -> Mapping[str, int]:
        """Number of surfaces or profiles of each solver; none of smooth bodies."""


@dataclass(frozen=True)
class Replicates:
    """A statistic, (...), and how it changes with the surfaces.

    deviations : (groups, ...), of which the mean of products estimates the covariance of the statistic
    pooled : degrees of freedom of one scatter that is common to all; None where it is that of the groups
    strata : number of each group, in their order, of those whose scatter is one; None where all are one
    sources : solver and stratum behind each of these numbers; empty where they are not told apart
    """

    value: float | np.ndarray
    deviations: np.ndarray
    pooled: float | None = None
    strata: np.ndarray | None = None
    sources: tuple[Source, ...] = ()

    @classmethod
    def first_order(cls, value: float | np.ndarray, changes: np.ndarray, strata: np.ndarray | None = None) -> Self:
        """changes : (surfaces, ...), with the deviation of each surface from the mean; none of an exact value."""
        count = len(changes)
        return cls(value, changes / sqrt(count - 1) if count > 1 else _unseen(count, value), strata=strata)

    @classmethod
    def without_one(cls, value: float | np.ndarray, without: np.ndarray) -> Self:
        """without : (surfaces, ...), the statistic found without each of them."""
        ones = np.ones(len(without))
        return cls(value, _deviations(without, ones, ones))

    def dof(self, squares: np.ndarray) -> float | np.ndarray:
        """Degrees of freedom of a sum of squares (groups, ...); of Welch where strata scatter by themselves."""
        return inf if not len(squares) else welch(squares, self.strata) if self.pooled is None else self.pooled

    def parts(self, squares: np.ndarray) -> Mapping[Source, np.ndarray]:
        """Share of each source in a sum of squares (groups, ...)."""
        with np.errstate(invalid="ignore", divide="ignore"):
            whole = squares.sum(axis=0)
            sums = {each: squares[self.strata == number] for number, each in enumerate(self.sources)}
            return {each: own.sum(axis=0) / whole for each, own in sums.items()}

    @property
    def estimated(self) -> Estimated:
        """Each number with its own error."""
        if not len(self.deviations):
            return Estimated.exact(self.value)
        error = np.sqrt(np.mean(np.square(self.deviations), axis=0))
        # One scatter common to all is taken for normal: what few measurements of it show is not skewness.
        skewed = skewness(self.deviations) if self.pooled is None else 0.0
        squares = np.square(self.deviations)
        return Estimated(self.value, error, self.dof(squares), skewed, parts=self.parts(squares))

    @property
    def rms(self) -> RmsMisfit:
        """Root mean square of all numbers together."""
        value = np.ravel(self.value)
        square = float(np.mean(np.square(value)))
        if not len(self.deviations):
            return RmsMisfit(square, 0.0, 0.0, 1.0, inf)
        deviations = self.deviations.reshape(len(self.deviations), -1) / sqrt(len(self.deviations))
        if not (np.all(np.isfinite(value)) and np.all(np.isfinite(deviations))):
            return RmsMisfit.unknown()
        products = deviations @ deviations.T
        noise, length = float(np.trace(products)), float(np.linalg.norm(value))
        longer = deviations @ value
        along = float(np.sum(np.square(longer))) / length**2 if length else 0.0
        modes = noise**2 / float(np.sum(np.square(products))) if noise else 1.0
        count, pooled = value.size, self.pooled is not None
        skewed = 0.0 if pooled else float(skewness(longer))
        dof = float(self.dof(np.diag(products)))
        parts = self.parts(np.diag(products))
        return RmsMisfit(square - noise / count, noise / count, along / count, modes, dof, pooled, skewed, parts)


def welch(squares: np.ndarray, strata: np.ndarray | None = None) -> float | np.ndarray:
    """Degrees of freedom of a sum of squares (groups, ...), by those of its strata.

    Each stratum has one less than groups (Welch 1947); where nothing scatters all of them together.
    """
    numbers = np.zeros(len(squares), int) if strata is None else strata
    known = [squares[numbers == each] for each in dict.fromkeys(numbers.tolist())]
    if len(known) == 1:
        return len(squares) - 1
    parts = np.array([each.sum(axis=0) for each in known])
    dofs = np.array([len(each) - 1 for each in known], float).reshape(-1, *(1,) * (parts.ndim - 1))
    with np.errstate(invalid="ignore", divide="ignore"):
        shares = parts / parts.sum(axis=0)
        found = 1 / np.sum(np.where(shares > 0, np.square(shares) / dofs, 0.0), axis=0)
    return np.where(np.isfinite(found), found, dofs.sum())[()]


def groups(strata: np.ndarray, solver: str = "") -> list[Group]:
    """Surfaces that are left out together: each alone, or as many as give the most groups of each stratum.

    strata : (surfaces,) number of the stratum of each
    """
    found = []
    for stratum in dict.fromkeys(strata.tolist()):
        surfaces = np.flatnonzero(strata == stratum)
        parts = np.array_split(surfaces, min(surfaces.size, MOST_GROUPS))
        found += [Group(each, stratum, solver) for each in parts]
    return found


def resample(
    statistic: Callable[[Any], Mapping[str, float | np.ndarray]], samples: Grouped
) -> dict[str, Replicates]:
    """Find statistics of all surfaces, and again without each group of them.

    Groups need not be equal (Busing, Meijer and van der Leeden, Stat. Comput. 9, 3, 1999). One group alone of any
    solver leaves the deviations NaN.
    """
    whole, left_out = statistic(samples), list(samples.groups)
    found = [statistic(samples.without(group)) for group in left_out] if len(left_out) > 1 else []
    solvers = [group.solver for group in left_out]
    own = [np.array([each == solver for each in solvers], bool) for solver in dict.fromkeys(solvers)]
    if not all(each.sum() > 1 for each in own):
        return {name: Replicates(value, _unseen(len(left_out), value)) for name, value in whole.items()}
    kinds = list(dict.fromkeys((group.solver, group.stratum) for group in left_out))
    strata = np.array([kinds.index((group.solver, group.stratum)) for group in left_out], int)
    sizes = np.array([group.surfaces.size for group in left_out])

    def deviations(without):
        made = np.empty_like(without, float)
        for each in own:  # independent of each other: their squares add up
            made[each] = sqrt(len(made) / each.sum()) * _deviations(without[each], sizes[each], strata[each])
        return made

    return {
        name: Replicates(value, deviations(np.array([each[name] for each in found])), None, strata, tuple(kinds))
        if found
        else Replicates(value, _unseen(0, value))
        for name, value in whole.items()
    }


def _unseen(count, value):
    return np.full((count, *np.shape(value)), nan)


def _deviations(without, sizes, strata):
    """Deviations of a statistic, from its values without groups of so many surfaces of a stratum each."""
    share = sizes / sizes.sum()
    middle = np.tensordot(1 - share, without, axes=1) / (sizes.size - 1)
    weight = np.sqrt(1 / share - 1)
    for stratum in np.unique(strata):
        own = strata == stratum
        part, surfaces, count = share[own].sum(), sizes[own].sum(), sizes.sum()
        if own.all():
            break
        # As by the groups of the stratum alone, whose surfaces are scaled for a mean over all.
        bessel = (surfaces - 1) * count / (surfaces * (count - 1))
        apart = part * np.sqrt(share[own] / (part - share[own]) * sizes.size / own.sum() * bessel)
        weight[own] = (1 / share[own] - 1) * apart
    return weight.reshape(-1, *(1,) * (without.ndim - 1)) * (middle - without)


def mean_ratio(
    above: np.ndarray, below: np.ndarray | float = 1.0, strata: np.ndarray | None = None
) -> Estimated[np.ndarray]:
    """Ratio of the means over the surfaces of both, the last axis, which share them; errors to first order.

    strata : (surfaces,) number of the stratum of each; None where all are one

    Surfaces with a NaN are left out where they have it. Errors are NaN with fewer than two surfaces; where none is
    left so is the ratio.
    """
    value, deviations, count = off_the_ratio(above, below)
    squares = np.square(deviations)
    with np.errstate(invalid="ignore", divide="ignore"):
        error = np.sqrt(np.sum(squares, axis=-1) / np.where(count > 1, count * (count - 1.0), nan))
        dof = np.maximum(count - 1, 0) if strata is None else welch(np.moveaxis(squares, -1, 0), strata)
        return Estimated(value, error, dof, skewness(deviations, axis=-1))


def off_the_ratio(above: np.ndarray, below: np.ndarray | float = 1.0) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Ratio of the means, how far each surface lies off it, nil of one with a NaN, and the number of others."""
    above, below = np.broadcast_arrays(above, below)
    known = np.isfinite(above) & np.isfinite(below)
    count = known.sum(axis=-1)
    with np.errstate(invalid="ignore", divide="ignore"):
        top, bottom = (np.where(known, each, 0.0).sum(axis=-1) / count for each in (above, below))
        value = top / bottom
        return value, np.where(known, above - value[..., None] * below, 0.0) / bottom[..., None], count


def left_out(samples: np.ndarray) -> np.ndarray:
    """Averages over the surfaces, the last axis, without one: (..., surfaces) from (..., surfaces)."""
    count = samples.shape[-1]
    return (samples.sum(axis=-1, keepdims=True) - samples) / (count - 1)


# Claims on Datasets.

DIMENSIONS = {"1D": ("MDR",), "3D": ("BEM",), "1D/3D": ("MDR", "BEM")}


@dataclass(frozen=True)
class DrawSet(Mapping[str, xarray.Dataset]):
    """Datasets of one grid by "name/solver", from which draws can be left out.

    Draws of different solvers are independent, and are left out by themselves. Where the Datasets of one solver
    differ in their number, shares of each are left out together.
    """

    datasets: Mapping[str, xarray.Dataset]
    _left: dict[tuple[str, tuple[int, ...]], "DrawSet"] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    @classmethod
    def of(cls, answers: xarray.DataTree, names: Iterable[str], grid: str) -> Self:
        """Datasets of some nodes on one of their grids; nodes that were not asked for are left out."""
        nodes = {node.path.strip("/"): node for node in answers.subtree}
        return cls(
            {name: nodes[name].to_dataset(inherit=False).sel(level=grid) for name in names if name in nodes}
        )

    def __getitem__(self, name: str) -> xarray.Dataset:
        return self.datasets[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.datasets)

    def __len__(self) -> int:
        return len(self.datasets)

    @property
    def _strata(self) -> dict[str, list[np.ndarray]]:
        """Strata of the draws of every Dataset that has any, by the solver."""
        found: dict[str, list[np.ndarray]] = {}
        for name, each in self.items():
            if "surface" in each.dims:
                found.setdefault(_solver(name, each), []).append(strata_of(each))
        return found

    @property
    def drawn(self) -> dict[str, int]:
        """Number of surfaces or profiles of each solver, least of its Datasets; none of smooth bodies."""
        return {solver: min(each.size for each in found) for solver, found in self._strata.items()}

    @property
    def groups(self) -> Sequence[Group]:
        """Draws that are left out together; where Datasets of a solver differ in number, those of equal shares."""
        found = []
        for solver, (first, *others) in self._strata.items():
            if all(np.array_equal(first, each) for each in others):
                found += groups(first, solver)
            else:
                fewest = min(each.size for each in (first, *others))
                found += [Group(np.array([k]), 0, solver) for k in range(min(fewest, MOST_GROUPS))]
        return found

    def without(self, group: Group) -> "DrawSet":
        """The sample without one group of draws of a solver.

        It is kept, as every claim on the same Datasets asks for the same ones.
        """
        key = group.solver, tuple(group.surfaces.tolist())
        if key not in self._left:
            own = [name for name, each in self.items() if _solver(name, each) == group.solver]
            alike = len({self[name].sizes.get("surface") for name in own} - {None}) < 2
            shares = 0 if alike else sum(each.solver == group.solver for each in self.groups)
            parted = {name: _without(self[name], group.surfaces, shares) for name in own}
            self._left[key] = DrawSet({**self.datasets, **parted})
        return self._left[key]


def strata_of(dataset: xarray.Dataset) -> np.ndarray:
    """Number of the stratum of each draw."""
    named = "stratum" in dataset.coords
    return dataset["stratum"].values if named else np.zeros(dataset.sizes["surface"], int)


def _solver(name, dataset):
    return str(dataset.attrs.get("solver", name))


def _without(dataset, group, shares):
    if "surface" not in dataset.dims:
        return dataset
    every = np.arange(dataset.sizes["surface"])
    return dataset.isel(
        surface=np.delete(every, np.array_split(every, shares)[int(group[0])] if shares else group)
    )


def mean(dataset: xarray.Dataset, name: str, below: str | None = None) -> np.ndarray:
    """Mean over draws of a variable, or ratio of two means, NaN where fewer than half of the draws have it."""
    over = _over_draws(dataset.variables[name])
    under = np.ones(()) if below is None else _over_draws(dataset.variables[below])
    if "surface" not in dataset.variables[name].dims:
        return over / under
    enough = 2 * np.isfinite(over).sum(axis=-1) >= over.shape[-1]
    return np.where(enough, mean_ratio(over, under).value, nan)


def _over_draws(variable):
    """Values with the draws last."""
    drawn = "surface" in variable.dims and variable.dims[-1] != "surface"
    return variable.transpose(..., "surface").values if drawn else variable.values


def friction(dataset: xarray.Dataset) -> np.ndarray:
    """Coefficient of friction: mean friction force over mean normal force."""
    return mean(dataset, "friction_force", "normal_force")


def judge(claim: Claim, answers: xarray.DataTree, where: str = "", regime: str = "", plot: str = "") -> Finding:
    """Measure a claim on the fine grid, its scatter by leaving draws out, its error of the grid on the coarse one.

    An array counts by its root mean square, without what scatter adds.
    """
    names = [f"{curve}/{solver}" for curve in claim.curves for solver in DIMENSIONS[claim.dimension]]
    fine, coarse = (DrawSet.of(answers, names, grid) for grid in ("fine", "coarse"))
    return measured(claim, fine, coarse, where, regime, plot)


def measured(
    claim: Claim, fine: Drawn, coarse: Drawn, where: str = "", regime: str = "", plot: str = ""
) -> Finding:
    """Finding of a claim from samples on two grids. Raises ValueError for a claim without a measure."""
    measure: Callable[[Any], Any] | None = claim.measure
    if measure is None:
        raise ValueError(f"claim {claim.id} has no measure")
    # What has no logarithm is not known, and the finding says so.
    with np.errstate(invalid="ignore", divide="ignore"):
        replicates = resample(lambda sample: {"": measure(sample)}, fine)[""]
        other = np.asarray(measure(coarse))
        found = replicates.rms if np.ndim(replicates.value) else replicates.estimated
        low, high = found.interval()
        grid = float(np.sqrt(np.mean(np.square(other - replicates.value))))
    return Finding(
        claim=claim,
        value=float(found.value),
        scatter=(float(low), float(high)),
        grid=grid,
        grid_method=HALVED if np.isfinite(grid) else UNKNOWN,
        where=where,
        drawn=fine.drawn,
        regime=regime,
        reason=_unknown(fine.drawn, (found.value, low, high, grid)),
        plot=plot,
        size=isinstance(found, RmsMisfit),
        parts={source: float(each) for source, each in found.parts.items()},
    )


def _unknown(drawn, numbers):
    """Reason why a number or one of its errors is not known; empty where all are."""
    if np.all(np.isfinite(numbers)):
        return ""
    if 1 in drawn.values():
        return "of one surface the scatter is not known"
    return "at some point fewer than half of the surfaces have an answer, or the mean is not positive"
