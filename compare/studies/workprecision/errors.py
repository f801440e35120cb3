"""Errors against a reference, and processor times to a wanted error: ways to an answer, one a setting of a model.

On grids from fine to coarse the mean of a rough scene is that on the coarsest plus those of the differences
between neighbours, each over surfaces of its own (Giles, Oper. Res. 56, 607, 2008). The error of a grid is a sum
of these differences alone, so that it is known far below the scatter of surfaces.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from math import ceil, inf, isfinite, nan, sqrt

import numpy as np
import xarray

from ...solving.control_variates import VARIATES, controlled
from ...solving.curve import FAILED, FINER
from ...statistics.intervals import Estimated, student
from ...statistics.jackknife import mean_ratio, off_the_ratio
from ...statistics.means import at_upper_end
from ...statistics.multilevel import MEANS
from ..comparison.series import pilot
from .ladder import Ladder

QUANTITIES = {"friction": "friction_coefficient", "depth": "depth_reached", "force": "normal_force"}
INTERVAL = "interval"  # settings of surfaces on several grids, as `crosscheck run --interval` takes them
MOST_FAILED = 0.02  # share of failed surfaces above which a mean over the others is not that over all
UNKNOWN = Estimated(nan, nan, 0.0)


@dataclass(frozen=True)
class Way:
    """One setting of a model on one scene: what it leaves of an error, and what it takes.

    The error expected of n surfaces is sqrt(bias^2 + scatter^2 / n), after setup + n processor seconds; without
    draws there is no scatter. All errors are relative.

    model : name; label : for people; settings : points of the grid, or INTERVAL
    bias : error that no number of surfaces takes away, signed
    most : its largest size by the interval of 95 %, with the error of the grid of the reference
    processor : time for each surface, or for the pilot of an interval [s]
    surfaces : number that was solved
    reference_error : error of the reference, scatter and grid
    """

    case: str
    quantity: str
    model: str
    label: str
    settings: str = ""
    bias: float = nan
    most: float = nan
    scatter: float = 0.0
    processor: float = nan
    setup: float = 0.0
    surfaces: int = 0
    reference_error: float = nan
    reason: str = ""

    def error(self, count: np.ndarray | float) -> np.ndarray | float:
        """Expected error with `count` surfaces."""
        return np.sqrt(self.bias**2 + self.scatter**2 / count)

    def seconds(self, count: np.ndarray | float) -> np.ndarray | float:
        """Processor time of `count` surfaces [s]."""
        return self.setup + count * self.processor

    def count(self, level: float) -> float:
        """Surfaces for a wanted error, with the largest bias; infinite where it is not reached."""
        room = level**2 - self.most**2
        if not (room >= 0 and isfinite(self.processor)):
            return inf
        count = self.scatter**2 / room if room else inf if self.scatter else 1.0
        return max(1.0, count if self.settings == INTERVAL or count == inf else ceil(count))

    def effort(self, level: float) -> float:
        """Processor time to a wanted error [s]; infinite where it is not reached."""
        return float(self.seconds(self.count(level))) if isfinite(self.count(level)) else inf

    def half_width(self, count: float) -> float:
        """Half-width of the interval of 95 % with `count` surfaces."""
        return float(student(0.95, inf)) * self.scatter / sqrt(count) + abs(self.bias)


@dataclass(frozen=True)
class Reference:
    """What errors are measured against.

    value : with the scatter of surfaces
    left : error of its grid, the change on halving, NaN without another grid; and of waves that it leaves to a law
    scale : that errors are relative to
    source : where it is from, for people
    biases : errors of all grids of the model that it is from
    """

    value: Estimated
    left: float
    scale: float
    source: str
    biases: tuple[Estimated, ...]

    @property
    def error(self) -> float:
        """Half of the interval of 95 %, scatter and grid, relative."""
        low, high = _ends(self.value)
        return ((high - low) / 2 + self.left) / self.scale


def values(dataset: xarray.Dataset, quantity: str) -> np.ndarray:
    """Answers (level, surface) whose mean is the quantity; for friction at a depth to first order."""
    above, below = MEANS[QUANTITIES[quantity]]
    over = dataset[above].transpose("level", "surface").values
    if below is None:
        return over
    under = dataset[below].transpose("level", "surface").values
    ratio, known = off_the_ratio(over, under)[0][:, None], np.isfinite(over)
    with np.errstate(invalid="ignore", divide="ignore"):
        middle = np.where(known, under, 0.0).sum(axis=1, keepdims=True) / known.sum(axis=1, keepdims=True)
        return np.where(known, ratio + (over - ratio * under) / middle, nan)


def reference(ladder: Ladder, dataset: xarray.Dataset, quantity: str, scale: float) -> Reference:
    """The finest grid that solves, or a closed form; all is NaN where there is no answer.

    scale : that errors are relative to; NaN for the size of the answer
    """
    found, known = values(dataset, quantity), _known(dataset, quantity)
    if not known.any():
        return Reference(UNKNOWN, nan, nan, "nothing, as no grid has an answer", (UNKNOWN,) * len(found))
    top = int(np.argmax(known))
    biases = [UNKNOWN] * top + [Estimated(0.0)]
    for k in range(top, len(found) - 1):
        change = _mean((found[k] - found[k + 1])[_stratum(dataset, k)]) if known[k + 1] else UNKNOWN
        biases.append(biases[-1].less(change))
    last = max(k for k, each in enumerate(biases) if isfinite(each.value))
    value = _mean(_alone(dataset, found, last)).less(biases[last])
    points, label = dataset["points"].values, ladder.model.label
    changes = [abs(float(each.value)) for each in biases[top + 1 :]]
    left = changes[0] if changes else 0.0 if not points.any() else nan
    if (upper := at_upper_end(dataset)) is not None:
        left += abs(float(np.nanmean(values(upper, quantity)[top] - found[top])))
    return Reference(
        value,
        left=left,
        scale=abs(float(value.value)) or nan if np.isnan(scale) else scale,
        source=(f"{label} on {points[top]} points" if points.any() else label)
        + (", as finer grids have no answer" if top else ""),
        biases=tuple(biases),
    )


def against(dataset: xarray.Dataset, quantity: str, of: Reference) -> list[Estimated]:
    """Errors of another model on each of its grids, whose surfaces are not those of the reference."""
    both = zip(values(dataset, quantity), _known(dataset, quantity), strict=True)
    return [(_mean(own) if known else UNKNOWN).less(of.value) for own, known in both]


def ways(
    case: str, quantity: str, ladder: Ladder, dataset: xarray.Dataset, of: Reference, biases: Iterable[Estimated]
) -> Iterator[Way]:
    """A way for each grid of a model that is timed, no finer one known to be worse: it may be by chance."""
    worst, found = 0.0, values(dataset, quantity)
    for k, bias in list(enumerate(biases))[ladder.reference :]:
        most = (max(map(abs, _ends(bias))) + of.left) / of.scale
        worst = max(worst, most) if isfinite(most) else inf if worst else worst
        points, reasons = int(dataset["points"][k]), list(filter(None, dataset["reason"].values[k].tolist()))
        yield Way(
            case, quantity, ladder.model.name, ladder.model.label, f"{points} points" if points else "",
            bias=float(bias.value) / of.scale,
            most=worst if isfinite(most) else most,
            scatter=_scatter(found[k]) / of.scale,
            processor=float(dataset["processor"][k]),
            surfaces=int(np.isfinite(found[k]).sum()),
            reference_error=of.error,
            reason=reasons[0] if reasons else "",
        )  # fmt: skip


def sampled(finest: Way, quantity: str, ladder: Ladder, dataset: xarray.Dataset, of: Reference) -> Way:
    """The way over several grids from `finest` on, with the numbers of surfaces on each that intervals take.

    Time T leaves a variance W^2 / T, W the sum over strata of scatter times root of time; in units of the pilot.
    """
    found, first = values(dataset, quantity), ladder.reference
    changes = [(found[k] - found[k + 1])[_stratum(dataset, k)] for k in range(first, len(found) - 1)]
    spread = [_scatter(each) / of.scale for each in (*changes, _alone(dataset, found, len(found) - 1))]
    times = dataset["processor"].values[first:]
    costs = times + np.append(times[1:], 0.0)
    one = float(np.dot(pilot(costs.size), costs))
    scatter = float(np.dot(spread, np.sqrt(costs / one)))
    return replace(finest, settings=INTERVAL, scatter=scatter, processor=one)


def corrected(dataset: xarray.Dataset, line: xarray.Dataset, quantity: str) -> xarray.Dataset:
    """Answers of 1D on its finest grid, divided by the ratio of a corrected model, with the time of each."""
    name, _ = MEANS[QUANTITIES[quantity]]
    own = line.isel(level=[0])
    return own.assign({name: own[name] / float(dataset[f"{quantity}_ratio"][0, 0])})


def _known(dataset, quantity):
    """Whether a mean on each grid is one over nearly all surfaces."""
    failed = dataset["status"].isin([FAILED, FINER]).transpose("level", "surface").values.sum(axis=1)
    solved = np.isfinite(values(dataset, quantity)).sum(axis=1)
    return (solved > 0) & (failed <= MOST_FAILED * (failed + solved))


def _stratum(dataset, k):
    return dataset["stratum"].values == k if "stratum" in dataset.coords else slice(None)


def _alone(dataset, found, k):
    """Answers of a stratum on its grid; of the coarsest less what control variates explain."""
    own = found[k, _stratum(dataset, k)]
    if VARIATES not in dataset or k < len(found) - 1:
        return own
    return controlled(own, dataset[VARIATES].transpose("surface", "variate").values[_stratum(dataset, k)])


def _scatter(sample):
    known = sample[np.isfinite(sample)]
    return float(known.std(ddof=1)) if known.size > 1 else 0.0 if sample.size == 1 else nan


def _mean(sample) -> Estimated:
    return Estimated(float(sample[0])) if sample.size == 1 else mean_ratio(sample)


def _ends(found: Estimated) -> tuple[float, float]:
    """Ends of the interval of 95 %; of an exact number that number."""
    low, high = found.interval() if found.error else (found.value, found.value)
    return float(low), float(high)
