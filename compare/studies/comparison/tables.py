"""Tables of a series: every point of its curves with intervals, solves that failed, and processor time."""

from collections.abc import Mapping, Sequence
from math import nan
from typing import Any

import numpy as np
import xarray
from pandas import DataFrame, concat

from ...solving.outcome import Outcome
from ...solving.task import SceneTask, Task
from ...solving.vocabulary import attributes
from ...statistics import means
from .answers import Answers
from .laws import regimes
from .measures import CONTACT
from .rough import ROUGH, RoughSeries
from .series import Series

TIMES = "times"
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


def points(series: Series, answers: Answers) -> DataFrame:
    """A row for each curve, model, speed, and load or depth: means, intervals of 95 %, dimensionless groups."""
    frames = {(curve, model): _points(series, answers, curve, model) for curve, model in _solved(answers)}
    every = stacked(frames, "curve", "model")
    first = [name for name in ("curve", "model", "points", "speed", "load", "depth") if name in every]
    return every[[*first, *(name for name in every if name not in first)]]


def _points(series, answers, curve, model):
    dataset = answers.all_levels(curve, model)
    known = {each.name: each.draws for each in series.models}
    touching = CONTACT[known.get(model, "none")]
    if touching in dataset:
        dataset = dataset.assign(contact=dataset[touching])
    found = means.means(dataset)
    if isinstance(series, RoughSeries):
        rough = curve == ROUGH and {"rms_slope", "pixel"} <= {*dataset.data_vars}
        groups = regimes(series, answers(curve, model)) if rough else {}
        found = found.assign(**{name: groups[name].ravel() if groups else nan for name in GROUPS})
    return found


def failures(answers: Answers) -> DataFrame:
    """Every solve that failed, with its reason."""
    found = {place: means.failures(answers.all_levels(*place)) for place in _solved(answers)}
    return stacked(found, "curve", "model")


def _solved(answers):
    return [(curve, model) for curve, each in answers.curves.items() for model in each["model"].values.tolist()]


def times(contacts: Sequence[SceneTask], outcomes: Mapping[Task, Outcome]) -> xarray.Dataset:
    """Processor time of all solves by model, each contact once."""
    spent: dict[str, float] = {}
    for each in contacts:
        seconds = float(np.nansum([row.seconds for row in outcomes[each].rows]))
        spent[each.solver.name] = spent.get(each.solver.name, 0.0) + seconds
    models = xarray.Variable("model", list(spent), attributes("model"))
    return xarray.Dataset({"seconds": ("model", list(spent.values()), attributes("seconds"))}, {"model": models})


def stacked(frames: Mapping[Any, DataFrame], *names: str) -> DataFrame:
    """Tables one below the other, with the words that name each of them in its first columns."""
    for words, frame in frames.items():
        for place, (name, word) in enumerate(zip(names, words, strict=True)):
            frame.insert(place, name, word)
    parts = list(frames.values())
    return concat([each for each in parts if len(each)] or parts[:1], ignore_index=True)
