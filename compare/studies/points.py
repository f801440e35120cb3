"""Every point of a series: means over its surfaces with intervals of 95 %, where it lies, and what failed."""

from collections.abc import Callable, Mapping
from math import nan

import numpy as np
from pandas import DataFrame, concat

from ..rectangle import COARSE, FINE
from ..statistics import means
from ..statistics.jackknife import friction, mean, resample
from ..statistics.means import Interval
from .laws import regimes
from .regime import PointRegime
from .series import ROUGH, SMOOTH, SOLVERS, Contacts

# Dimensionless groups of a point, by what has them.
GROUPS = (
    "depth_over_height",
    "shortest_in_contact",
    "pressure_over_slope",
    "memory_over_contact",
    "memory_over_shortest",
    "contact_fraction",
)
SCENE_GROUPS = ("contact_over_period", "macro_over_rough")
# Area [m²] or length [m] that touches.
CONTACT = {"MDR": "contact_length", "BEM": "contact_area"}


def interval(statistic: Callable[[Mapping], np.ndarray], contacts: Contacts, body: str, *solvers: str) -> Interval:
    """Array of numbers on one body, with intervals of 95 % from the scatter of surfaces and the change on halving.

    solvers : of which surfaces are left out; both if absent
    """
    fine, coarse = (contacts.sample(grid, body, *(solvers or SOLVERS)) for grid in (FINE, COARSE))
    with np.errstate(invalid="ignore", divide="ignore"):
        found = resample(lambda sample: {"": statistic(sample)}, fine)[""].estimated
        grid = np.abs(statistic(coarse) - found.value)
    low, high = found.interval()
    return Interval(found.value, low - grid, high + grid)


def friction_at(contacts: Contacts, solver: str, body: str = ROUGH) -> Interval:
    """Coefficient of friction at every point that slides (speeds, values)."""
    return interval(lambda sample: friction(sample[solver])[1:], contacts, body, solver)


def force_at(contacts: Contacts, solver: str, body: str = ROUGH) -> Interval:
    """Normal force [N] at every point that moves (speeds, values)."""
    return interval(lambda sample: mean(sample[solver], "normal_force")[1:], contacts, body, solver)


def points(contacts: Contacts) -> DataFrame:
    """A row for each solver, body, speed, and load or depth: means, intervals of 95 %, dimensionless groups."""
    return concat(
        [_rows(contacts, solver, body) for solver in SOLVERS for body in (ROUGH, SMOOTH)], ignore_index=True
    )


def failures(contacts: Contacts) -> DataFrame:
    """Every solve that failed, with its reason."""
    found = []
    for solver, dimension in SOLVERS.items():
        for body in (ROUGH, SMOOTH):
            frame = means.failures(contacts.dataset(solver, body))
            frame.insert(0, "dimension", dimension)
            frame.insert(1, "body", body)
            found.append(frame)
    return concat(found, ignore_index=True)


def _rows(contacts, solver, body):
    dataset = contacts.dataset(solver, body)
    if CONTACT[solver] in dataset:
        dataset = dataset.assign(contact=dataset[CONTACT[solver]])
    frame = means.means(dataset)
    frame.insert(0, "dimension", SOLVERS[solver])
    frame.insert(1, "body", body)
    groups = [_groups(None)] * len(frame)
    if body == ROUGH:
        groups = [_groups(at) for row in regimes(contacts.series, contacts(solver)) for at in row]
    return frame.join(DataFrame(groups, index=frame.index))


def _groups(at: PointRegime | None) -> dict[str, float]:
    if at is None:
        return dict.fromkeys((*GROUPS, *SCENE_GROUPS), nan)
    own = {name: float(getattr(at, name)) for name in GROUPS}
    return own | {name: float(getattr(at.regime, name)) for name in SCENE_GROUPS}
