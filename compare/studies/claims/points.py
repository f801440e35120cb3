"""Points of a series: means over its surfaces with intervals of 95 %, their regime, and failed solves."""

from collections.abc import Callable, Mapping
from math import nan
from typing import Any

import numpy as np
from pandas import DataFrame, concat

from ...solving.parameter_grid import COARSE, FINE
from ...statistics import means
from ...statistics.jackknife import friction, mean
from ...statistics.means import Interval, compared
from .laws import regimes
from .series import CONTACT, ROUGH, Contacts

# Ratios of a rough point, see `regime.ratios`.
GROUPS = (
    "depth_over_height",
    "shortest_in_contact",
    "pressure_over_slope",
    "memory_over_contact",
    "memory_over_shortest",
    "contact_fraction",
    "contact_over_period",
    "macro_over_rough",
)


def interval(statistic: Callable[[Mapping], np.ndarray], contacts: Contacts, body: str, *solvers: str) -> Interval:
    """Array of numbers on one body, with intervals of 95 % from the scatter of surfaces and the change on halving.

    solvers : of which surfaces are left out; both if absent
    """
    fine, coarse = (contacts.sample(grid, body, *(solvers or contacts.labels)) for grid in (FINE, COARSE))
    return compared(statistic, fine, coarse).interval


def friction_at(contacts: Contacts, solver: str, body: str = ROUGH) -> Interval:
    """Coefficient of friction at every point that slides (speeds, values)."""
    return interval(lambda sample: friction(sample[solver])[1:], contacts, body, solver)


def force_at(contacts: Contacts, solver: str, body: str = ROUGH) -> Interval:
    """Normal force [N] at every point that moves (speeds, values)."""
    return interval(lambda sample: mean(sample[solver], "normal_force")[1:], contacts, body, solver)


def stacked(frames: Mapping[Any, DataFrame], *names: str) -> DataFrame:
    """Tables one below the other, with the words that name each of them in its first columns."""
    for words, frame in frames.items():
        for place, (name, word) in enumerate(zip(names, words, strict=True)):
            frame.insert(place, name, word)
    parts = list(frames.values())
    return concat([each for each in parts if len(each)] or parts[:1], ignore_index=True)


def interval_columns(name: str, found: Interval) -> dict[str, np.ndarray]:
    """Numbers and both ends of their intervals, flat, under a name."""
    return {f"{name}{end}": np.ravel(each) for end, each in zip(("", "_low", "_high"), found, strict=True)}


def place_columns(series, name="speed") -> dict[str, np.ndarray]:
    """Speed, and load or depth, of each point, flat."""
    speeds, values = np.meshgrid(series.speeds, series.values, indexing="ij")
    return {name: speeds.ravel(), series.prescribed: values.ravel()}


def points(contacts: Contacts) -> DataFrame:
    """A row for each solver, body, speed, and load or depth: means, intervals of 95 %, dimensionless groups."""
    frames = {(contacts.labels[solver], body): _rows(contacts, solver, body) for solver, body in contacts.datasets}
    return stacked(frames, "dimension", "body")


def failures(contacts: Contacts) -> DataFrame:
    """Every solve that failed, with its reason."""
    found = {
        (contacts.labels[solver], body): means.failures(each) for (solver, body), each in contacts.datasets.items()
    }
    return stacked(found, "dimension", "body")


def _rows(contacts, solver, body):
    dataset = contacts.datasets[solver, body]
    touching = CONTACT[contacts.series.models[solver].draws]
    if touching in dataset:
        dataset = dataset.assign(contact=dataset[touching])
    groups = regimes(contacts.series, contacts(solver)) if body == ROUGH and "rms_slope" in dataset else {}
    return means.means(dataset).assign(**{name: groups[name].ravel() if groups else nan for name in GROUPS})
