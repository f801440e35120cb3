"""Tables of a series: every point of its curves with intervals, solves that failed, and processor time."""

from functools import partial
from math import nan

from pandas import DataFrame, concat

from ...statistics import means
from .answers import Answers
from .laws import regimes
from .measures import CONTACT
from .rough import ROUGH, RoughSeries
from .series import Series

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
    every = _stacked(answers, partial(_points, series, answers))
    first = [name for name in ("curve", "model", "points", "speed", "load", "depth") if name in every]
    return every[[*first, *every.columns.difference(first, sort=False)]]


def _points(series, answers, curve, model):
    dataset = answers.all_levels(curve, model)
    known = {each.name: each.draws for each in series.models}
    touching = CONTACT[known.get(model, "none")]
    found = means.means(dataset.assign(contact=dataset[touching]) if touching in dataset else dataset)
    if isinstance(series, RoughSeries):
        rough = curve == ROUGH and {"rms_slope", "pixel"} <= {*dataset.data_vars}
        groups = regimes(series, answers(curve, model)) if rough else {}
        found = found.assign(**{name: groups[name].ravel() if groups else nan for name in GROUPS})
    return found


def failures(answers: Answers) -> DataFrame:
    """Every solve that failed, with its reason."""
    return _stacked(answers, lambda *place: means.failures(answers.all_levels(*place)))


def _stacked(answers, table):
    """Tables of every model on every curve, one below the other, with both names in the first columns."""
    every = ((name, model) for name, each in answers.curves.items() for model in each["model"].values.tolist())
    frames = [DataFrame({"curve": place[0], "model": place[1]} | dict(table(*place))) for place in every]
    return concat([each for each in frames if len(each)] or frames[:1], ignore_index=True)
