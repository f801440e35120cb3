"""Claims on force and depth: smooth bodies against closed forms, rough ones in one dimension against three."""

from collections.abc import Callable, Iterator
from functools import partial
from math import nan

import numpy as np

from scene.regime import MUCH_LESS_HEIGHT
from scene.scales import elastic_contact

from ...models.exact.indentation import loading_force
from ...models.table import DEPTH, FORCE
from ...statistics.finding import Finding
from ...statistics.jackknife import mean
from .claims import claim
from .claims_friction import finding, pair_findings
from .series import ROUGH, SMOOTH, Contacts, Series


def depth_findings(contacts: Contacts) -> list[Finding]:
    """Findings at rest, and pressed in where the motion is a Program."""
    series, words = contacts.series, where(contacts.series)
    told = DEPTH if series.prescribed == "load" else FORCE
    found = [
        finding(claim(name, partial(measure, solver), dimension), contacts, SMOOTH, words, solver, plot=plot)
        for solver, dimension in contacts.labels.items()
        for name, measure, plot in _smooth(series)
    ]
    found += rest_findings(contacts, words)
    if not series.speeds and not series.pressed_in and len(series.values) > 2:
        found += pair_findings("rest.stiffness", _stiffer, contacts, ROUGH, words, "force-depth", told)
    if series.pressed_in and len(series.speeds) > 1:
        for place, name in ((0, "slow"), (-1, "fast")):
            regime = f"{series.speeds[place]:.2g} m/s; {words}"
            apart = partial(_pressed_apart, series, place)
            found += pair_findings(f"pressed-in.{name}", apart, contacts, ROUGH, regime, "force-depth", told)
    return found


def rest_findings(contacts: Contacts, words: str) -> list[Finding]:
    """Findings on depth or force at rest, where roughness is small against depth and elsewhere."""
    series = contacts.series
    depths, at_load = closed_forms(series)[1], series.prescribed == "load"

    def apart(places, one, three):
        if at_load:
            return ((mean(one, "depth_reached")[0] - mean(three, "depth_reached")[0]) / depths)[places]
        return (np.log(mean(one, "normal_force")[0]) - np.log(mean(three, "normal_force")[0]))[places]

    deep = depths * MUCH_LESS_HEIGHT >= series.scene.roughness.rms_height
    what = DEPTH if at_load else FORCE
    return [
        found
        for side, places in (("deep", deep), ("shallow", ~deep))
        if places.any()
        for found in pair_findings(
            f"rest.{what}-{side}", partial(apart, places), contacts, ROUGH, words, "force-depth", what
        )
    ]


def closed_forms(series: Series) -> tuple[np.ndarray, np.ndarray]:
    """Load [N] and depth [m] of the smooth body at rest at each load or depth: Galin and Sneddon."""
    contacts = [elastic_contact(series.at(value)) for value in series.values]
    return np.array([contact.load for contact in contacts]), np.array([contact.depth for contact in contacts])


def loading(series: Series, depths: np.ndarray | None = None) -> np.ndarray:
    """Force [N] on the smooth body pressed in at constant rates, (rates, depths): Lee and Radok.

    depths : reached [m], (rates, depths); those prescribed if absent. A march answers for the middle of its last
        step, half a step before the end
    """
    reached = (
        np.broadcast_to(series.values, (len(series.speeds), len(series.values))) if depths is None else depths
    )
    body, solid = series.scene.indenter, series.scene.elastomer
    forces = np.full(reached.shape, nan)
    for place, depth in np.ndenumerate(reached):
        if depth > 0:
            end = float(depth) / series.speeds[place[0]]
            forces[place] = loading_force(body, solid, (0.0, end), (0.0, float(depth)), (end,))[0]
    return forces


def where(series: Series) -> str:
    """Depth over rms height at all loads or depths, in words."""
    _, depths = closed_forms(series)
    over = depths / series.scene.roughness.rms_height
    return f"d/h0 {over.min():.2g} to {over.max():.2g}"


def _smooth(series) -> Iterator[tuple[str, Callable, str]]:
    """Claims on the smooth body by their ids, with what measures them in one dimensionality, and the plot."""
    load, depth = closed_forms(series)
    if series.prescribed == "load":
        yield (
            "smooth.rest-depth",
            lambda solver, it: mean(it[solver], "depth_reached")[0] / depth - 1,
            "force-depth",
        )
    else:
        yield "smooth.rest-force", lambda solver, it: mean(it[solver], "normal_force")[0] / load - 1, "force-depth"
    if series.pressed_in and series.speeds:
        yield "smooth.pressed-in", lambda solver, it: _over_smooth(series, it[solver]) - 1, "force-depth"


def _pressed_apart(series, place, *both):
    one, three = (_over_smooth(series, each)[place, -1] for each in both)
    return float(np.log(one / three))


def _stiffer(one, three):
    return np.log(_secants(one) / _secants(three))


def _over_smooth(series, answers):
    """Force over that of the smooth body in closed form, (rates, depths)."""
    return mean(answers, "normal_force")[1:] / loading(series, mean(answers, "depth_reached")[1:])


def _secants(answers):
    """Stiffness of the relaxed contact between neighbouring loads or depths."""
    return np.diff(mean(answers, "normal_force")[0]) / np.diff(mean(answers, "depth_reached")[0])
